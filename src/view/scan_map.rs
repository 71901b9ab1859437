//! A scan over two parameters: a map of shades of one hue, the stronger the more dangerous.
//!
//! Where values spread over several decades, each shade takes an equal range of their logarithms.

use ratatui::style::Style;
use ratatui::text::{Line, Span};

use super::{Look, Surface, pane, plot::Canvas};
use crate::numerics::{distinct, real, truncated};
use crate::picture::map::{measured, nothing};
use crate::picture::{Danger, DangerousValues, MapCell, Role, ScanMap};
use crate::scene::Point;
use crate::session::{Glyphs, ScanOnShow, WORDS};
use crate::words::{joined, significant};

/// Shades from the weakest to the strongest, and the letters that do without colour.
const SHADES: [char; STEPS] = ['\u{b7}', '\u{2591}', '\u{2592}', '\u{2593}', '\u{2588}'];
const LETTERS: [char; STEPS] = ['.', '-', '+', '*', '#'];
const STEPS: usize = 5;

/// The letters of words, in the order of [`WORDS`], and how dangerous each is; of the last that is unknown.
const OF_WORDS: [(char, Option<f64>); 4] =
    [('.', Some(0.0)), ('o', Some(0.5)), ('^', Some(1.0)), ('?', None)];

/// Where there is a row but no number, and where it could not be computed.
const NOTHING: char = '-';
const UNKNOWN: char = '?';

/// The shades of a map, from the smallest value up.
fn shades(scale: Danger, look: &Look) -> [char; STEPS] {
    let mut shades = if look.glyphs == Glyphs::Ascii {
        LETTERS
    } else {
        SHADES
    };
    if scale.dangerous == Some(DangerousValues::Small) {
        shades.reverse();
    }
    shades
}

/// The style of a value's shade: how dangerous it is.
fn style(value: f64, scale: Danger, look: &Look) -> Style {
    look.danger(scale.strength(scale.part(value)))
}

/// Fills each cell with the shade of the point nearest to it.
pub fn draw(plot: &Canvas, map: &ScanMap, screen: &mut Surface) {
    let look = screen.look;
    let quiet = look.style(Role::Quiet);
    let sign = |cell: MapCell| match (cell, map.scale) {
        (MapCell::Number(value), Some(scale)) => {
            let step = truncated(scale.part(value) * real(STEPS)).min(STEPS - 1);
            (shades(scale, look)[step], style(value, scale, look))
        }
        (MapCell::Word(word), _) => match WORDS.iter().position(|known| *known == word) {
            Some(index) => (OF_WORDS[index].0, of_word(OF_WORDS[index].1, look)),
            None => (sign_of_nothing(word), quiet),
        },
        (MapCell::Number(_), None) => (NOTHING, quiet),
    };
    let inner = plot.inner;
    for place in inner.positions() {
        let Point { x, y } = plot.world(place.x - inner.x, place.y - inner.y);
        let across = nearest(&map.x, x).and_then(|across| map.values.get(across));
        let cell = nearest(&map.y, y).and_then(|upward| across?.get(upward));
        let Some((symbol, style)) = cell.copied().map(sign) else { continue };
        screen.buffer[place].set_char(symbol).set_style(style);
    }
}

/// What stands for a point without a number.
fn sign_of_nothing(meaning: &str) -> char {
    if meaning == "gave up" { UNKNOWN } else { NOTHING }
}

fn of_word(danger: Option<f64>, look: &Look) -> Style {
    match danger {
        None => look.style(Role::Quiet),
        Some(danger) if danger > 0.0 || look.has_grounds() => look.danger(danger),
        Some(_) => look.style(Role::Calm),
    }
}

/// What the signs of a map mean where there is no number; of a curve, its gaps.
pub fn without_numbers(scanned: &ScanOnShow, width: usize) -> String {
    let meanings = (0..scanned.rows.len()).filter_map(|index| nothing(scanned, index));
    let meanings = distinct(meanings);
    let sign = |meaning: &&str| match *meaning {
        _ if !scanned.is_grid() => format!("gap: {meaning}"),
        meaning => format!("{} {meaning}", sign_of_nothing(meaning)),
    };
    let signs = || meanings.iter().map(sign);
    let texts = [joined(signs(), "  "), signs().take(1).collect()];
    pane::fitting(texts.map(|text| format!(" {text}")), width)
}

/// What the shades mean, whole in `width` columns: which end is the dangerous one, with the value at which each
/// begins, else with the smallest and the largest alone.
pub fn legend(scanned: &ScanOnShow, width: usize, look: &Look) -> Line<'static> {
    let name = measured(scanned);
    let quiet = |text: String| look.span(text, Role::Quiet);
    let between = |before: String, shades: &[Span<'static>], after: String| {
        [&[quiet(before)], shades, &[quiet(after)]].concat()
    };
    let lines: Vec<Vec<Span>> = if scanned.plots_words() {
        let word = |((symbol, danger), word): (&(char, Option<f64>), &str)| {
            let symbol = Span::styled(symbol.to_string(), of_word(*danger, look));
            [quiet("  ".to_owned()), symbol, quiet(format!(" {word}"))]
        };
        let words: Vec<Span> = OF_WORDS.iter().zip(WORDS).flat_map(word).skip(1).collect();
        let leads = [format!(" {name} "), " ".to_owned()];
        leads.map(|lead| between(lead, &words, String::new())).into()
    } else if let Some(scale) = Danger::of(scanned) {
        let begins = [0, 1, 2, 3, 4].map(|step| scale.at(real(step) / real(STEPS)));
        let shade = |(value, shade): (f64, char)| {
            Span::styled(shade.to_string(), style(value, scale, look))
        };
        let shades = begins.into_iter().zip(shades(scale, look)).map(shade);
        let shades: Vec<Span> = shades.collect();
        let begin = |(value, shade): (f64, &Span<'static>)| {
            let begin = quiet(format!("{} ", significant(value, 3)));
            [begin, shade.clone(), quiet(" ".into())]
        };
        let all: Vec<Span> = begins.into_iter().zip(&shades).flat_map(begin).collect();
        let [low, high] = [scale.low, scale.high].map(|value| significant(value, 4));
        let [lowest, highest] = scale.ends().map(|end| format!(" {end} "));
        let (from, to) = (lowest.trim_start(), highest.trim_end());
        vec![
            between(format!(" {name} {from}"), &all, format!("{high}{to}")),
            between(format!(" {name} {from}{low} "), &shades, format!(" {high}{to}")),
            between(format!(" {from}{low} "), &shades, format!(" {high}{to}")),
            between(format!(" {from}"), &shades, to.to_owned()),
            between(format!(" {low} "), &shades, format!(" {high}")),
        ]
    } else {
        vec![vec![quiet(format!(" {name}"))]]
    };
    pane::fitting(lines.into_iter().map(Line::from), width)
}

/// Which of some evenly spaced places along an axis another belongs to; none beyond half a step of their ends.
fn nearest(places: &[f64], place: f64) -> Option<usize> {
    let last = places.len() - 1;
    let steps = (place - places[0]) / (places[last] - places[0]) * real(last);
    let index = (steps >= -0.5 && steps.is_finite()).then_some(truncated(steps + 0.5));
    index.filter(|index| *index <= last)
}
