//! What the lines of the pictures mean: a sample of each that is seen, drawn by the same pens.

use ratatui::layout::Rect;

use super::dots::{DotPen, Dots};
use super::{Surface, pane};
use crate::picture::{Dash, LegendEntry, LegendSample, Mark, Role};

const SAMPLE: u16 = 3;

const GAP: u16 = 2;

/// Columns of what says how much is left out.
const MORE: u16 = 8;

/// Draws what some pictures have to explain, each entry in the first row with room, the main things first; what is
/// left out is counted.
pub fn draw(area: Rect, mut entries: Vec<LegendEntry>, screen: &mut Surface) {
    entries.sort_by_key(|entry| rank(entry.sample));
    let letters = entries.iter().map(|entry| pane::cells(entry.text.chars().count()));
    let widths: Vec<u16> = letters.map(|count| count.saturating_add(SAMPLE + 1)).collect();
    let mut places = places(&widths, area, 0).0;
    let quiet = screen.look.style(Role::Quiet);
    if places.contains(&None) && area.height > 0 {
        let (shorter, x) = self::places(&widths, area, MORE + GAP);
        places = shorter;
        let left = places.iter().filter(|place| place.is_none()).count();
        screen.buffer.set_string(x, area.bottom() - 1, format!("+{left} more"), quiet);
    }
    for (LegendEntry { sample, role, text }, place) in entries.iter().zip(places) {
        if let Some(place) = place {
            draw_sample(Rect { width: SAMPLE, ..place }, *role, *sample, screen);
            screen.buffer.set_string(place.x + SAMPLE + 1, place.y, text, quiet);
        }
    }
}

/// Where entries of these widths stand, each in the first row with room, the last of which ends this many columns
/// earlier; and where that row ends.
fn places(widths: &[u16], area: Rect, reserved: u16) -> (Vec<Option<Rect>>, u16) {
    let mut ends: Vec<u16> = area.rows().map(|row| row.x + 1).collect();
    let places = widths.iter().map(|&width| {
        let rooms = ends.iter_mut().zip(area.rows());
        let room = |(end, row): &(&mut u16, Rect)| {
            let last = row.bottom() == area.bottom();
            let right = row.right().saturating_sub(if last { reserved } else { 0 });
            right.saturating_sub(**end) >= width
        };
        let (end, row) = rooms.into_iter().find(room)?;
        let place = Rect { x: *end, width, ..row };
        *end += width + GAP;
        Some(place)
    });
    let places = places.collect();
    (places, ends.last().copied().unwrap_or(area.x))
}

/// What is drawn through is asked for first, and what was left out of a record.
fn rank(sample: LegendSample) -> u8 {
    match sample {
        LegendSample::Point(Mark::Outlier | Mark::Saturated | Mark::Aside)
        | LegendSample::Line(Dash::Solid | Dash::Thick | Dash::Dashed)
        | LegendSample::Spot => 0,
        LegendSample::Line(Dash::DashDot | Dash::Dotted | Dash::Sparse) => 1,
        LegendSample::Point(_) | LegendSample::Shade | LegendSample::Arrow => 2,
    }
}

fn draw_sample(place: Rect, role: Role, sample: LegendSample, screen: &mut Surface) {
    let look = screen.look;
    let mut dots = Dots::new(place, look.glyphs);
    let (width, height) = dots.size();
    let mut line = |y: f64, dash| dots.stroke([(0.0, y), (width - 0.5, y)], DotPen { role, dash });
    match sample {
        LegendSample::Line(dash) => line(height / 2.0, dash),
        LegendSample::Spot => {
            let at = (width / 2.0, height / 2.0);
            dots.stroke([at, at], DotPen { role, dash: Dash::Thick });
        }
        LegendSample::Shade => {
            (0..SAMPLE.into()).for_each(|x| dots.texture((x, 0), look.symbols().shade, role));
        }
        LegendSample::Point(mark) => dots.symbol((1, 0), look.symbols().mark(mark), role),
        LegendSample::Arrow => dots.texture((1, 0), look.symbols().arrows[0], role),
    }
    dots.paint(screen);
}
