//! What the lines of the pictures mean: a sample of each that is seen, drawn by the same pens.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;

use super::dots::{Dash, Dots, Pen};
use super::look::{Look, Role};
use super::pane;
use super::picture::{Item, Mark, Picture, common};
use crate::scene::View;

/// Columns of a sample.
const SAMPLE: u16 = 4;

/// What a sample shows.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Sample {
    Line(Dash),
    Bar,
    Shade,
    Arrow,
    Point,
}

/// What there is to explain: how it is drawn, its role, and what it is.
#[derive(Clone, Debug, PartialEq)]
struct Entry(Sample, Role, String);

/// Names of lines that the legend says otherwise: in fewer words, or in words that stand for several.
const WORDS: [(&str, &str); 14] = [
    ("sticking set", "sticking set (at rest)"),
    ("basin of the sticking set", "comes to rest"),
    ("border of a band of capture", "one half swing more"),
    ("motion left", "the point left"),
    ("cycle left", "the point left"),
    ("cycle of N harmonics", "N harmonics"),
    ("speed of the belt", "sticks to the belt"),
    ("over the speed of the belt", "over the belt's speed"),
    ("half turn about the left end", "half turns"),
    ("half turn about the right end", "half turns"),
    ("the same spiral before and after", "how they go on"),
    ("fold of the first harmonic", "fold of one harmonic"),
    ("largest velocity A_v", "largest velocity"),
    ("from the origin", ""),
];

/// What the pictures on show have to explain, in the order in which they are painted.
fn entries(pictures: &[(View, Picture)]) -> Vec<Entry> {
    let mut entries: Vec<Entry> = Vec::new();
    for (view, picture) in pictures {
        for item in &picture.items {
            let entry = entry(*view, picture, item);
            // An area whose edge has its name goes without saying.
            let known = |entry: &Entry| {
                entries.iter().any(|other| (other.1, &other.2) == (entry.1, &entry.2))
            };
            entries.extend(entry.filter(|entry| !entry.2.is_empty() && !known(entry)));
        }
    }
    entries
}

fn entry(view: View, picture: &Picture, item: &Item) -> Option<Entry> {
    let sample = match item {
        // The parts of a machine, the bars of the ledger and the curves of methods have their names on them.
        _ if matches!(view, View::Belt | View::EnergyLedger) => return None,
        Item::Mark(Mark::Stable, _, role) if view == View::Trade => {
            return Some(Entry(Sample::Point, *role, "best choices".to_owned()));
        }
        _ if view == View::Trade => return None,
        Item::Mark(Mark::Stable | Mark::Unstable, _, role) if view == View::ReturnMap => {
            return Some(Entry(Sample::Point, *role, "cycle".to_owned()));
        }
        Item::Arrows(role, _) => {
            return Some(Entry(Sample::Arrow, *role, "direction of flow".to_owned()));
        }
        Item::Bar(..) => Sample::Bar,
        Item::Shade(..) | Item::Columns(..) | Item::Rows(..) => Sample::Shade,
        Item::Curve(line, _)
        | Item::Path(line, _)
        | Item::Graph(line, _)
        | Item::Upright(line, _) => Sample::Line(line.dash),
        Item::Texture(_)
        | Item::Mark(..)
        | Item::Milestone(..)
        | Item::Marks(..)
        | Item::Caption { .. }
        | Item::Cross(_) => return None,
    };
    let line = item.seen(picture.window)?;
    let name = common(&line.name);
    let words = WORDS.iter().find(|(known, _)| *known == name).map_or(name, |(_, words)| words);
    Some(Entry(sample, line.role, words.to_owned()))
}

/// Draws the legend of some pictures from the top of `area` down, as far as there is room.
pub fn draw(area: Rect, pictures: &[(View, Picture)], look: &Look, buffer: &mut Buffer) {
    if area.width < SAMPLE + 8 {
        return;
    }
    for (y, Entry(sample, role, text)) in (area.y..area.bottom()).zip(entries(pictures)) {
        let place = Rect { x: area.x + 1, y, width: SAMPLE, height: 1 };
        draw_sample(place, role, sample, look, buffer);
        let room = usize::from(area.width - SAMPLE - 3);
        let text = pane::cut(&text, room, look);
        buffer.set_string(place.right() + 1, y, text, look.style(Role::Quiet));
    }
}

fn draw_sample(place: Rect, role: Role, sample: Sample, look: &Look, buffer: &mut Buffer) {
    let mut dots = Dots::new(place, look.glyphs);
    let (width, height) = dots.size();
    let mut line = |y: f64, dash| dots.stroke([(0.0, y), (width - 0.5, y)], Pen { role, dash });
    match sample {
        Sample::Line(dash) => line(height / 2.0, dash),
        Sample::Bar => {
            line(height / 2.0 - 0.5, Dash::Solid);
            line(height / 2.0, Dash::Solid);
        }
        Sample::Shade => {
            (0..SAMPLE).step_by(2).for_each(|x| dots.texture(x, 0, look.symbols().shade, role));
        }
        Sample::Point => dots.symbol(1, 0, look.symbols().points[0], role),
        Sample::Arrow => dots.texture(1, 0, look.symbols().arrows[0], role),
    }
    dots.paint(buffer, look);
}
