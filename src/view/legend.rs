//! What the lines of the pictures mean: a sample of each that is seen, drawn by the same pens.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;

use super::dots::{Dots, Pen};
use super::look::Look;
use super::pane;
use crate::picture::items::Picture;
use crate::picture::legend::{Entry, Sample, entries};
use crate::picture::role::{Dash, Role};

/// Columns of a sample.
const SAMPLE: u16 = 4;

/// Draws the legend of some pictures from the top of `area` down, as far as there is room.
pub fn draw(area: Rect, pictures: &[Picture], look: &Look, buffer: &mut Buffer) {
    if area.width < SAMPLE + 8 {
        return;
    }
    for (y, Entry { sample, role, text }) in (area.y..area.bottom()).zip(entries(pictures)) {
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
