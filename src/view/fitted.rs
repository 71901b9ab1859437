//! What a fitted record says in the pane: numbers with their errors, in physical units where these are known.

use super::look::Look;
use crate::fit::names::named;
use crate::fit::observation::OMEGA0;
use crate::fit::physical::rows;
use crate::oscillator::Symbol;
use crate::scene::Fitted;
use crate::session::{Row, Session};
use crate::words::number::significant;
use crate::words::quantity::with_unit;

/// What a fitted number stands for with its standard error, and the error alone; or that it is held.
pub fn fitted(session: &Session, row: Row, look: &Look) -> Vec<String> {
    let (Row::Parameter(symbol), Some(found)) = (row, session.fitted()) else { return Vec::new() };
    let sign = look.symbols().plus_minus;
    let error = found.error(symbol);
    let told = match error {
        Some(error) => {
            let bare = format!("{sign}{}", significant(error, 2));
            vec![format!("{bare} {}", unit(symbol, found.fit.unit())).trim_end().to_owned(), bare]
        }
        None if found.holds(symbol) => vec!["held".to_owned()],
        None => return Vec::new(),
    };
    let physical = rows(&found.fit).into_iter().find(|row| row.name == stands_for(symbol));
    let value = session.value(symbol);
    let physical = match (physical, found.fit.units()) {
        (Some(row), _) => {
            let error = error.map_or_else(String::new, |_| {
                format!(" {sign}{}", with_unit(row.standard_error, 2, row.unit))
            });
            Some(format!("{} {}{error}", row.name, with_unit(row.value, 4, row.unit)))
        }
        (None, Some(units)) => {
            let scale = match symbol {
                Symbol::R | Symbol::Q0 => Some((units.displacement, "m")),
                Symbol::V0 => Some((units.velocity, "m/s")),
                Symbol::D | Symbol::D2 | Symbol::D3 => None,
            };
            scale.map(|(scale, unit)| {
                let error = error.map_or_else(String::new, |error| {
                    format!(" {sign}{}", with_unit(error * scale, 2, unit))
                });
                with_unit(value * scale, 4, unit) + &error
            })
        }
        _ => None,
    };
    let held = if error.is_none() { " held" } else { "" };
    physical.map(|text| text + held).into_iter().chain(told).collect()
}

/// The unit in which a number of the record stands; nothing where the record names no unit of length.
fn unit(symbol: Symbol, length: &str) -> String {
    let row = match symbol {
        Symbol::D | Symbol::D2 | Symbol::D3 => named(symbol.spec().name),
        Symbol::R | Symbol::Q0 | Symbol::V0 => return length.to_owned(),
    };
    row.filter(|_| !length.is_empty()).map_or_else(String::new, |row| row.unit(length))
}

/// The number of a mass on a spring that a parameter is a measure of.
fn stands_for(symbol: Symbol) -> &'static str {
    match symbol {
        Symbol::D => "d1",
        Symbol::D2 => "d2",
        Symbol::D3 => "d3",
        Symbol::R => "R",
        Symbol::Q0 | Symbol::V0 => "",
    }
}

/// Where the smallest displacement that is not survived lies with 95 %, with numbers held how much worse the fit is, and
/// the frequency of a record.
pub fn spread(session: &Session, look: &Look) -> Vec<String> {
    let Some(Fitted { fit, rise, drawn, .. }) = session.fitted() else { return Vec::new() };
    let estimate = &fit.estimate;
    let hertz = |value: f64| value / std::f64::consts::TAU;
    let error = hertz(estimate.covariance.error(OMEGA0));
    let frequency = with_unit(hertz(estimate.p[OMEGA0]), 4, "Hz");
    let frequency =
        format!("f0 {frequency} {}{}", look.symbols().plus_minus, with_unit(error, 2, "Hz"));
    let spread = fit.margins.displacement;
    let scale = fit.units().map(|units| units.displacement);
    let end = |end: Option<f64>| match (end, scale) {
        (None, _) => "any".to_owned(),
        (Some(end), Some(metres)) => with_unit(end * metres, 3, "m"),
        (Some(end), None) => significant(end, 3),
    };
    let held = session.doubt.holds_any();
    let rise = held.then(|| format!("held: chi^2 +{}", significant(*rise, 3)));
    let name = if scale.is_some() { "x" } else { "q" };
    let margin = if spread.lower.is_none() {
        "95 %: every kick".to_owned()
    } else {
        format!("95 %: {name} {}", between(end(spread.lower), &end(spread.upper)))
    };
    let frequency = estimate.free[OMEGA0].then_some(frequency);
    // What matters most first: a low pane has no room for what follows.
    let margin = (*drawn || !held).then_some(margin);
    rise.into_iter().chain(margin).chain(frequency).collect()
}

/// Two numbers, with one unit where both have the same.
fn between(low: String, high: &str) -> String {
    let unit = |text: &str| text.split_once(' ').map(|(_, unit)| unit.to_owned());
    let low = match unit(high).and_then(|unit| low.strip_suffix(&unit)) {
        Some(number) => number.trim_end().to_owned(),
        None => low,
    };
    format!("{low} .. {high}")
}
