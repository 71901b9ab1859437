//! What a fitted record says in the pane: numbers with their errors, in physical units where these are known.

use super::{Look, pane};
use crate::fit::{FitResult, OMEGA0, row_of, rows};
use crate::model::Knob;
use crate::session::{Row, Session};
use crate::words::fit::signed;
use crate::words::{Notation, in_unit, significant, with_unit};

/// What a fitted number stands for with its standard error, and the error alone; or that it is held.
pub fn fitted(session: &Session, row: Row, look: &Look) -> Vec<String> {
    let (Row::Number(symbol), Some(found)) = (row, session.fitted()) else { return Vec::new() };
    let (sign, error) = (&look.symbols().plus_minus, found.error(symbol));
    let (spec, length) = (row_of(symbol), found.unit());
    let told = match error {
        Some(error) => {
            let bare = format!("{sign}{}", significant(error, 2));
            let unit = spec.map_or_else(|| length.to_owned(), |spec| spec.unit(length));
            vec![in_unit(&bare, if length.is_empty() { "" } else { &unit }), bare]
        }
        None if found.holds(symbol) => vec!["held".to_owned()],
        None => return Vec::new(),
    };
    let with_error = |value, error: Option<f64>, unit| {
        let error = error.map(|error| format!("{sign}{}", with_unit(error, 2, unit)));
        format!("{} {}", with_unit(value, 4, unit), error.as_deref().unwrap_or("held"))
    };
    let place = spec.map(|spec| spec.place);
    let mut physical = rows(found).into_iter();
    let physical = physical.find(|row| row.unknown.is_some() && row.unknown == place);
    let physical = if let Some(row) = physical {
        let error = error.map(|_| row.standard_error);
        Some(format!("{} {}", row.name, with_error(row.value, error, row.unit)))
    } else {
        let scale = found.units().and_then(|units| match symbol {
            Knob::R | Knob::Q0 => Some((units.displacement, "m")),
            Knob::V0 => Some((units.velocity, "m/s")),
            _ => None,
        });
        let value = session.value(symbol);
        scale.map(|(one, unit)| with_error(value * one, error.map(|error| error * one), unit))
    };
    physical.into_iter().chain(told).collect()
}

/// Where the smallest shift from rest that is not survived lies with 95 %, with numbers held how much worse the fit is,
/// and the frequency of a record.
pub fn spread(session: &Session, width: usize, look: &Look) -> Vec<String> {
    let Some(fit) = session.fitted() else { return Vec::new() };
    let FitResult { estimate, rise, drawn, .. } = fit;
    let hertz = |value: f64| value / std::f64::consts::TAU;
    let error = hertz(estimate.covariance.error(OMEGA0));
    let frequency = with_unit(hertz(estimate.p[OMEGA0]), 4, "Hz");
    let frequency =
        format!("f0 {frequency} {}{}", look.symbols().plus_minus, with_unit(error, 2, "Hz"));
    let spread = fit.margins.kicks.from_rest.displacement;
    let notation = Notation(fit.units());
    let end = |end: Option<f64>| end.map_or("any".to_owned(), |end| notation.length(end, 3));
    let held = session.doubt.held.contains(&true);
    let rise = held.then(|| format!("held: chi^2 +{}", significant(*rise, 3)));
    let margin = if spread.lower.is_none() {
        "95 %: every kick".to_owned()
    } else {
        let range = between(&end(spread.lower), &end(spread.upper));
        let texts = ["95 % from rest: ", "95 %: rest ", "rest: "];
        pane::fitting(texts.map(|before| format!("{before}{range}")), width)
    };
    let frequency = estimate.free[OMEGA0].then_some(frequency);
    // What matters most first: a low pane has no room for what follows.
    let margin = (*drawn || !held).then_some(margin);
    rise.into_iter().chain(margin).chain(frequency).collect()
}

/// What the record allows to be signed, in a line of this width if that is possible; a test that fails comes first.
/// `None` until it is known for what is held and unsure.
pub fn statement(session: &Session, width: usize) -> Option<String> {
    Some(shortened(&signed(session.drawn()?).text, width))
}

/// How a statement begins whose conditions fail.
pub const UNRELIABLE: &str = "Not to be relied on";

/// Shorter words for those of a statement that say the same, in the order in which they are used.
const SHORTER: &str = include_str!("../../assets/shorter.txt");

/// A statement in at most so many columns, if that is possible.
fn shortened(text: &str, width: usize) -> String {
    let fits = |text: &str| text.chars().count() <= width;
    if fits(text) {
        return text.to_owned();
    }
    // That it is extrapolated is said before, how far is said elsewhere.
    let mut short = match text.split_once(" Extrapolated") {
        None => text.to_owned(),
        Some((sentence, _)) if sentence.starts_with(UNRELIABLE) => sentence.to_owned(),
        Some((sentence, _)) => format!("Extrapolated: {}", sentence.replacen("From", "from", 1)),
    };
    short.truncate(short.trim_end_matches('.').len());
    for (long, brief) in SHORTER.lines().filter_map(|line| line.split_once('|')) {
        if fits(&short) {
            break;
        }
        // `whatever a force does`, `against a force`.
        let verb = if long.contains("whatever") && short.contains(long) {
            " does"
        } else {
            ""
        };
        short = short.replace(long, brief).replacen(verb, "", 1);
    }
    short
}

/// Two numbers, with one unit where both have the same.
fn between(low: &str, high: &str) -> String {
    let unit = high.find(' ').map_or("", |at| &high[at..]);
    format!("{} .. {high}", low.strip_suffix(unit).unwrap_or(low))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_unit_that_both_ends_have_is_told_once() {
        assert_eq!(between("0.1 m", "0.3 m"), "0.1 .. 0.3 m");
        assert_eq!(between("20 mm", "0.3 m"), "20 mm .. 0.3 m");
        assert_eq!(between("0.1 m", "any"), "0.1 m .. any");
    }

    #[test]
    fn a_statement_is_shortened_to_a_screen_and_says_the_same() {
        let sure =
            "From any rest position, with 95 % confidence, an impulse below 0.231 N s is survived";
        let alone = format!("{sure}, provided that no other force acts.");
        let against = format!("{sure}, whatever a force of at most 0.5 N does.");
        let far =
            " Extrapolated by the model: motions reach 3.1 times the largest amplitude measured.";
        let failed = format!("Not to be relied on, as a condition fails (residuals): {alone}{far}");
        let short = |text: &str| shortened(text, 79);
        assert_eq!(shortened(&alone, 120), alone);
        assert_eq!(
            short(&alone),
            "From rest, 95 %: an impulse below 0.231 N s is survived, if no other force acts"
        );
        assert_eq!(
            short(&against),
            "From rest, 95 %: impulses below 0.231 N s survived, against 0.5 N"
        );
        let told = short(&format!("{alone}{far}"));
        assert_eq!(
            told,
            "Extrapolated: from rest, 95 %: impulses below 0.231 N s survived, undisturbed"
        );
        assert!(short(&failed).starts_with("Not to be relied on (residuals): From rest, 95 %"));
        assert!(told.len() <= 79);
    }
}
