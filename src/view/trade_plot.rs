//! What accuracy costs, as a plot in letters below a table: one letter a row.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;

use super::pane::{FramedPicture, Heading};
use super::{Look, Surface, plot::Canvas, screen};
use crate::accuracy::Trade;
use crate::numerics::log10;
use crate::picture::{Picture, Role};
use crate::scene::{Point, Window};
use crate::session::{Colors, DisplaySettings, Glyphs};

/// The letter of each of the methods.
const LETTERS: [char; 10] = ['a', 'e', 't', '8', '5', '4', 'i', '~', 's', 'm'];

/// The logarithm of the error over that of the time; later methods lie below, the best choices are capitals.
///
/// Empty where no row has both.
pub fn in_letters(trade: &Trade) -> String {
    const AREA: Rect = Rect { x: 0, y: 0, width: 78, height: 24 };
    let mut points: Vec<(Point, char)> = Vec::new();
    let mut key: Vec<String> = Vec::new();
    for row in &trade.rows {
        let Ok(deviation) = row.deviation else { continue };
        let method = row.problem.method;
        let letter = LETTERS[method as usize];
        let entry = format!("{letter} {method}");
        if !key.contains(&entry) {
            key.push(entry);
        }
        if deviation.error > 0.0 && row.seconds > 0.0 {
            let at = Point { x: log10(1e3 * row.seconds), y: log10(deviation.error) };
            let is_best = trade.is_best(row, |row| row.seconds);
            points.push((at, if is_best { letter.to_ascii_uppercase() } else { letter }));
        }
    }
    let places: Vec<Point> = points.iter().map(|(place, _)| *place).collect();
    let Some(window) = Window::around(&places, 1.1) else { return String::new() };
    let look = Look::new(DisplaySettings {
        glyphs: Glyphs::Ascii,
        colors: Colors::Never,
        ..DisplaySettings::default()
    });
    let mut buffer = Buffer::empty(AREA);
    let picture = Picture::new("trade", "log10(time/ms)", "log10(error)", window);
    let framed = FramedPicture { area: AREA, picture, heading: Heading::default() };
    let screen = &mut Surface { look: &look, buffer: &mut buffer };
    let mut plot = Canvas::new(&framed, screen);
    for (point, letter) in points.into_iter().rev() {
        plot.mark(point, letter, Role::Text);
    }
    plot.finish(screen);
    format!("{}      {}\n", screen::text(&buffer), key.join("  "))
}

#[cfg(test)]
mod tests {
    #[test]
    fn every_method_has_a_letter() {
        assert_eq!(super::LETTERS.len(), crate::flow::METHODS.len());
    }
}
