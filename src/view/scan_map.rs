//! A scan over two parameters: a map of shades of one hue, the stronger the more dangerous.
//!
//! Where values spread over several decades, each shade takes an equal range of their logarithms.

use ratatui::buffer::Buffer;
use ratatui::style::Style;
use ratatui::text::{Line, Span};

use super::look::Look;
use super::pane;
use super::plot::Canvas;
use crate::numerics::count::{real, whole};
use crate::numerics::elementary::{ln, pow};
use crate::picture::role::Role;
use crate::picture::scan::measured;
use crate::scene::Point;
use crate::session::scan::{Scanned, WORDS};
use crate::session::settings::Glyphs;
use crate::study::scan::Sweep;
use crate::words::number::significant;

/// Columns of measures of which the small values are the dangerous ones; of all others the large are.
const SMALL_IS_DANGEROUS: [&str; 4] = ["displacement", "impulse", "captured_part", "area"];

/// Shades from the weakest to the strongest, and the letters that do without colour.
const SHADES: &str = "\u{b7}\u{2591}\u{2592}\u{2593}\u{2588}";
const LETTERS: &str = ".-+*#";

/// The letters of words, in the order of [`WORDS`], and how dangerous each is; of the last that is unknown.
const OF_WORDS: [(char, Option<f64>); 4] =
    [('.', Some(0.0)), ('o', Some(0.5)), ('^', Some(1.0)), ('?', None)];

/// Where there is a row but no number.
const NOTHING: char = '-';

/// Ratio of the largest to the smallest value from which on shades are parts of a logarithm.
const SPREAD: f64 = 30.0;

/// The shades of a map and the values between which each stands, from the smallest value up.
struct Ramp {
    shades: Vec<char>,
    low: f64,
    high: f64,
    logarithmic: bool,
    /// Whether the small values are the dangerous ones.
    reversed: bool,
}

impl Ramp {
    fn of(scanned: &Scanned, look: &Look) -> Option<Self> {
        let (low, high) = scanned.range()?;
        let plain = look.glyphs == Glyphs::Ascii;
        let mut shades: Vec<char> = if plain { LETTERS } else { SHADES }.chars().collect();
        let reversed = SMALL_IS_DANGEROUS.contains(&measured(scanned));
        if reversed {
            shades.reverse();
        }
        let logarithmic = low > 0.0 && high / low >= SPREAD;
        Some(Ramp { shades, low, high, logarithmic, reversed })
    }

    /// The shade of a value, and how dangerous it is.
    fn shade(&self, value: f64) -> (char, f64) {
        let part = if self.logarithmic {
            ln(value / self.low) / ln(self.high / self.low)
        } else {
            (value - self.low) / (self.high - self.low)
        };
        let last = self.shades.len() - 1;
        let step = if part.is_finite() { whole(part * real(self.shades.len())) } else { 0 };
        (self.shades[step.min(last)], if self.reversed { 1.0 - part } else { part })
    }

    /// The value at which a shade begins.
    fn begin(&self, step: usize) -> f64 {
        let part = real(step) / real(self.shades.len());
        if self.logarithmic {
            self.low * pow(self.high / self.low, part)
        } else {
            self.low + (self.high - self.low) * part
        }
    }
}

/// Fills each cell with the shade of the point nearest to it.
pub fn draw(plot: &Canvas, scanned: &Scanned, look: &Look, buffer: &mut Buffer) {
    let words = scanned.plots_words();
    let ramp = Ramp::of(scanned, look);
    let shade = |value: f64| match &ramp {
        _ if words => {
            let (letter, danger) = OF_WORDS[(whole(value)).min(OF_WORDS.len() - 1)];
            (letter, of_word(danger, look))
        }
        Some(ramp) => {
            let (shade, danger) = ramp.shade(value);
            (shade, look.danger(danger))
        }
        None => (NOTHING, look.style(Role::Quiet)),
    };
    let nothing = (NOTHING, look.style(Role::Quiet));
    let over = scanned.scan.over();
    // Of more than two parameters the others stay at their first values.
    let stride: usize = over[2..].iter().map(|sweep| sweep.count).product();
    let inner = plot.inner();
    for column in 0..inner.width {
        for row in 0..inner.height {
            let Point { x, y } = plot.world(column, row);
            let (across, upward) = (nearest(&over[0], x), nearest(&over[1], y));
            let (Some(across), Some(upward)) = (across, upward) else { continue };
            let index = (across * over[1].count + upward) * stride;
            if index >= scanned.rows.len() {
                continue;
            }
            let (symbol, style) = scanned.height(index).map_or(nothing, shade);
            buffer[(inner.x + column, inner.y + row)].set_char(symbol).set_style(style);
        }
    }
}

fn of_word(danger: Option<f64>, look: &Look) -> Style {
    match danger {
        None => look.style(Role::Quiet),
        Some(danger) if danger > 0.0 || look.has_grounds() => look.danger(danger),
        Some(_) => look.style(Role::Calm),
    }
}

/// What the shades mean, whole in `width` columns: with the value at which each begins, else with the
/// smallest and the largest alone.
pub fn legend(scanned: &Scanned, width: usize, look: &Look) -> Line<'static> {
    let name = measured(scanned);
    let none = if (0..scanned.rows.len()).any(|index| scanned.height(index).is_none()) {
        format!("  {NOTHING} none")
    } else {
        String::new()
    };
    let texts: Vec<String> = if scanned.plots_words() {
        let words =
            OF_WORDS.iter().zip(WORDS).map(|((symbol, _), word)| format!("{symbol} {word}"));
        let words = words.collect::<Vec<_>>().join("  ");
        vec![format!(" {name} {words}{none}"), format!(" {words}")]
    } else if let Some(ramp) = Ramp::of(scanned, look) {
        let begins = |(step, shade): (usize, &char)| {
            format!("{} {shade} ", significant(ramp.begin(step), 3))
        };
        let all: String = ramp.shades.iter().enumerate().map(begins).collect();
        let [low, high] = [ramp.low, ramp.high].map(|value| significant(value, 4));
        let bare: String = ramp.shades.iter().collect();
        vec![
            format!(" {name} {all}{high}{none}"),
            format!(" {name} {low} {bare} {high}{none}"),
            format!(" {low} {bare} {high}{none}"),
            format!(" {low} {bare} {high}"),
        ]
    } else {
        vec![format!(" {name}{none}")]
    };
    let text = pane::fitting(texts, width);
    let ramp = Ramp::of(scanned, look).filter(|_| !scanned.plots_words());
    let style = |letter: char| {
        let quiet = look.style(Role::Quiet);
        let Some(ramp) = &ramp else {
            let word = OF_WORDS.iter().find(|(symbol, _)| *symbol == letter);
            return word.map_or(quiet, |(_, danger)| of_word(*danger, look));
        };
        let step = ramp.shades.iter().position(|shade| *shade == letter);
        step.map_or(quiet, |step| look.danger(ramp.shade(ramp.begin(step)).1))
    };
    let alone = |at: usize| {
        let around = [at.checked_sub(1), at.checked_add(1)];
        around
            .into_iter()
            .flatten()
            .all(|at| text.chars().nth(at).is_none_or(|it| !it.is_alphanumeric()))
    };
    let span = |(at, letter): (usize, char)| {
        let style = if alone(at) { style(letter) } else { look.style(Role::Quiet) };
        Span::styled(letter.to_string(), style)
    };
    text.chars().enumerate().map(span).collect::<Vec<_>>().into()
}

/// Which value of a sweep a place on its axis belongs to; none beyond half a step of its ends.
fn nearest(sweep: &Sweep, place: f64) -> Option<usize> {
    let last = sweep.count - 1;
    let [from, to] = [0, last].map(|index| Scanned::coordinate(sweep, index));
    let steps = (place - from) / (to - from) * real(last);
    let index = (steps >= -0.5 && steps.is_finite()).then_some(whole(steps + 0.5));
    index.filter(|index| *index <= last)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::measure::MEASURES;

    #[test]
    fn what_is_dangerous_when_small_is_measured() {
        for name in SMALL_IS_DANGEROUS {
            assert!(MEASURES.iter().any(|row| row.columns.contains(&name)), "{name}");
        }
    }
}
