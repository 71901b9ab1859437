//! What the lines of the pictures mean: a sample of each that is seen, drawn by the same pens.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;

use super::dots::{Dots, Pen};
use super::look::Look;
use crate::picture::items::Picture;
use crate::picture::legend::{LegendEntry, Sample, entries};
use crate::picture::role::{Dash, Role};

/// Columns of a sample.
const SAMPLE: u16 = 3;

/// Columns between entries.
const GAP: u16 = 2;

/// Draws the legend of some pictures side by side, in as many rows as `area` has, the main things first; a
/// mark says that there is more.
pub fn draw(area: Rect, pictures: &[Picture], look: &Look, buffer: &mut Buffer) {
    let mut entries = entries(pictures);
    entries.sort_by_key(|entry| rank(entry.sample));
    let (mut x, mut y) = (area.x + 1, area.y);
    for (index, LegendEntry { sample, role, text }) in entries.iter().enumerate() {
        let columns = u16::try_from(text.chars().count()).unwrap_or(u16::MAX);
        let wanted = columns.saturating_add(SAMPLE + 1);
        let room = |x: u16, y: u16| {
            let more = y + 1 < area.bottom() || index + 1 == entries.len();
            area.right().saturating_sub(if more { x } else { x + GAP })
        };
        if wanted > room(x, y) && y + 1 < area.bottom() {
            (x, y) = (area.x + 1, y + 1);
        }
        if y >= area.bottom() {
            return;
        }
        if wanted > room(x, y) {
            buffer.set_string(x, y, look.symbols().more, look.style(Role::Quiet));
            return;
        }
        let place = Rect { x, y, width: SAMPLE, height: 1 };
        draw_sample(place, *role, *sample, look, buffer);
        buffer.set_string(place.right() + 1, y, text, look.style(Role::Quiet));
        x += wanted + GAP;
    }
}

/// What is drawn through is asked for first.
fn rank(sample: Sample) -> u8 {
    match sample {
        Sample::Line(Dash::Solid | Dash::Dashed) | Sample::Bar => 0,
        Sample::Line(Dash::Dotted | Dash::Sparse) => 1,
        Sample::Point | Sample::Shade | Sample::Arrow => 2,
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
