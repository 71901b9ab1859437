//! Typing a value: the line opens, takes characters, and its text is accepted or refused.

use crate::flow::{METHODS, Method, Problem, QUALITIES};
use crate::numerics::decimal::shortest;
use crate::oscillator::belt::{Dimension, Quantity};
use crate::oscillator::{Interval, ParameterBox, Symbol};
use crate::scene::machine::file::value_of;
use crate::scene::machine::unit::{measured, toleranced};
use crate::session::act::notice::warn_of_units;
use crate::session::act::parameters::put;
use crate::session::effect::Effect;
use crate::session::message::key::Key;
use crate::session::read::numbers::{range, typed, with_number};
use crate::session::state::doubt::{Doubt, symbol_of};
use crate::session::state::overlay::{Entry, Overlay};
use crate::session::state::rows::Row;
use crate::session::state::session::Session;
use crate::session::state::setup::Setup;

/// Opens the line with the value of the selected row.
pub fn edit(session: &mut Session) -> Vec<Effect> {
    let row = session.selected;
    let text = match row {
        Row::Method => session.problem.method.to_string(),
        Row::Quantity(quantity) => {
            format!("{} {}", shortest(session.quantity(quantity)), quantity.spec().unit)
        }
        Row::Parameter(_) | Row::Disturbance | Row::Until | Row::Tolerance => {
            typed(&session.setup(), row)
        }
    };
    session.overlay = Some(Overlay::Entry(Entry::new(row, text)));
    Vec::new()
}

/// Opens the line with the character that was typed.
pub fn begin(session: &mut Session, key: Key) -> Vec<Effect> {
    let text = key.typed().map(String::from).unwrap_or_default();
    session.overlay = Some(Overlay::Entry(Entry::new(session.selected, text)));
    Vec::new()
}

/// Accepts the typed value, or says in the line why it is refused.
pub fn accept(session: &mut Session) -> Vec<Effect> {
    let Some(Overlay::Entry(entry)) = &session.overlay else { return Vec::new() };
    match read(session, &session.setup(), entry.row, entry.input.text()) {
        Ok(setup) => {
            session.overlay = None;
            put(session, &setup);
            return warn_of_units(session);
        }
        Err(why) => {
            if let Some(Overlay::Entry(entry)) = &mut session.overlay {
                entry.refused = Some(why);
            }
        }
    }
    Vec::new()
}

/// The setup with the typed value in a row. Fails with one line that says what is allowed.
pub(in crate::session) fn read(
    session: &Session,
    setup: &Setup,
    row: Row,
    text: &str,
) -> Result<Setup, String> {
    if let Row::Quantity(quantity) = row {
        return built(session, setup, quantity, &plain_minus(text));
    }
    if row == Row::Disturbance {
        return disturbed(session, setup, text);
    }
    if let Row::Parameter(symbol) = row {
        return within(setup, symbol, text);
    }
    let problem = read_number(setup.problem, row, text)?;
    Ok(Setup { problem, ..*setup })
}

/// The setup with the typed number of the machine. It may have a tolerance if a parameter corresponds to it;
/// without one, it is known exactly.
fn built(
    session: &Session,
    setup: &Setup,
    quantity: Quantity,
    text: &str,
) -> Result<Setup, String> {
    let read = toleranced(&text.replace('\u{b1}', "+-"))?;
    let built = session.with_quantity(setup, quantity, value_of(quantity, &read.middle)?)?;
    if read.half_width == 0.0 && symbol_of(quantity).is_none() {
        return Ok(built);
    }
    let doubt = session.with_tolerance(&built, quantity, read.half_width)?;
    Ok(Setup { doubt, ..built })
}

/// The setup with the typed bound on the disturbance, in the unit of r or with a unit of force.
fn disturbed(session: &Session, setup: &Setup, text: &str) -> Result<Setup, String> {
    let refused = || format!("{text:?} is not a disturbance; w takes 0 or more");
    let read = measured(&plain_minus(text)).map_err(|_| refused())?;
    let unit = match read.dimension {
        None => 1.0,
        Some(_) => session.unit_of_force(setup)?,
    };
    let value = read.as_a(Dimension::FORCE, "N")? / unit;
    let disturbance = Some(value).filter(|it| *it >= 0.0).ok_or_else(refused)?;
    Ok(Setup { doubt: Doubt { disturbance: disturbance + 0.0, ..setup.doubt }, ..*setup })
}

/// The setup with the typed value of a parameter, which may have a half width; without one, it is known
/// exactly.
fn within(setup: &Setup, symbol: Symbol, text: &str) -> Result<Setup, String> {
    let row = Row::Parameter(symbol);
    let typed = plain_minus(text).replace('\u{b1}', "+-");
    if !(typed.contains("+-") || typed.contains("..")) {
        let problem = read_number(setup.problem, row, text)?;
        let doubt = setup.doubt.with_half_width(symbol, 0.0).unwrap_or(setup.doubt);
        return Ok(Setup { problem, doubt, ..*setup });
    }
    let known: Interval = typed.parse()?;
    let mut within = ParameterBox::from(&setup.problem.parameters);
    within.set(symbol, known)?;
    // The typed numbers themselves, not the outward-rounded ends that enclose them.
    let (value, half) = match typed.split_once("+-") {
        Some((value, half)) => (number_in(value)?, number_in(half)?),
        None => (known.middle(), 0.5 * known.upper() - 0.5 * known.lower()),
    };
    let problem = with_number(setup.problem, row, value + 0.0);
    Ok(Setup { problem, doubt: setup.doubt.with_half_width(symbol, half)?, ..*setup })
}

fn number_in(text: &str) -> Result<f64, String> {
    text.trim().parse().map_err(|_| format!("{text:?} is not a number"))
}

/// Replaces the typographic minus sign, which documents use.
fn plain_minus(text: &str) -> String {
    text.trim().replace('\u{2212}', "-")
}

/// The motion with the typed value in a row.
fn read_number(problem: Problem, row: Row, text: &str) -> Result<Problem, String> {
    let text = text.trim();
    if row == Row::Method {
        let method = Method::named(text).ok_or_else(|| {
            let names: Vec<_> = METHODS.iter().map(|row| row.name).collect();
            format!("no method {text:?}; there are {}", names.join(", "))
        })?;
        return Ok(Problem { method, ..problem });
    }
    if row == Row::Tolerance
        && let Some(quality) = QUALITIES.iter().find(|quality| quality.name == text)
    {
        return Ok(problem.at(quality));
    }
    let name = row.name_in(&problem);
    let (min, max) = range(&problem, row);
    let takes = format!("{name} takes {} to {}", shortest(min), shortest(max));
    let value: f64 =
        plain_minus(text).parse().map_err(|_| format!("{text:?} is not a number; {takes}"))?;
    if !value.is_finite() {
        return Err(format!("{text} is not a finite number; {takes}"));
    }
    if !(min..=max).contains(&value) {
        return Err(format!("{name} = {text} is out of range; {takes}"));
    }
    if let Row::Parameter(symbol) = row {
        symbol.spec().check(value).map_err(|refused| refused.to_string())?;
    }
    // Adding 0.0 turns -0.0 into 0.0.
    Ok(with_number(problem, row, value + 0.0))
}
