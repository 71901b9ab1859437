//! Typing a value: the line opens, takes characters, and its text is accepted or refused.

use crate::flow::{METHODS, Method, Problem, QUALITIES};
use crate::oscillator::Knob;
use crate::oscillator::unit::measured;
use crate::session::act::notice::warn_of_units;
use crate::session::act::parameters::put;
use crate::session::message::key::Key;
use crate::session::read::numbers::{typed, with_number};
use crate::session::state::overlay::{Entry, Overlay};
use crate::session::state::rows::Row;
use crate::session::state::session::Session;
use crate::session::state::setup::Setup;
use crate::session::state::uncertainty::{Uncertainty, symbol_of};

/// Opens the line with the value of the selected row.
pub fn edit(session: &mut Session) {
    let row = session.selected;
    let text = match row {
        Row::Method => session.problem.method.to_string(),
        Row::Quantity(quantity) => quantity.print(session.quantity(quantity)),
        Row::Parameter(_) | Row::Disturbance | Row::Until | Row::Tolerance => {
            typed(&session.setup(), row)
        }
    };
    session.overlay = Some(Overlay::Entry(Entry::new(row, text)));
}

/// Opens the line with the character that was typed.
pub fn begin(session: &mut Session, key: Key) {
    let text = key.typed().map(String::from).unwrap_or_default();
    session.overlay = Some(Overlay::Entry(Entry::new(session.selected, text)));
}

/// Accepts the typed value, or says in the line why it is refused.
pub fn accept(session: &mut Session) {
    let Some(Overlay::Entry(entry)) = &session.overlay else { return };
    match read(session, &session.setup(), entry.row, entry.input.text()) {
        Ok(setup) => {
            session.overlay = None;
            put(session, &setup);
            warn_of_units(session);
        }
        Err(why) => {
            if let Some(Overlay::Entry(entry)) = &mut session.overlay {
                entry.refused = Some(why);
            }
        }
    }
}

/// The setup with the typed value in a row. Fails with one line that says what is allowed.
pub(in crate::session) fn read(
    session: &Session,
    setup: &Setup,
    row: Row,
    text: &str,
) -> Result<Setup, String> {
    if let Row::Quantity(quantity) = row {
        return built(session, setup, quantity, text);
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
fn built(session: &Session, setup: &Setup, quantity: Knob, text: &str) -> Result<Setup, String> {
    let read = quantity.parse_toleranced(text)?;
    let built = session.with_quantity(setup, quantity, read.middle.value)?;
    if read.half_width == 0.0 && symbol_of(quantity).is_none() {
        return Ok(built);
    }
    let doubt = session.with_tolerance(&built, quantity, read.half_width)?;
    Ok(Setup { doubt, ..built })
}

/// The setup with the typed bound on the disturbance, in the unit of r or with a unit of force.
fn disturbed(session: &Session, setup: &Setup, text: &str) -> Result<Setup, String> {
    let has_unit = measured(text).is_ok_and(|read| read.dimension.is_some());
    let disturbance = if has_unit {
        Knob::DisturbingForce.parse(text)? / session.unit_of_force(setup)?
    } else {
        Knob::Disturbance.parse(text)?
    };
    Ok(Setup { doubt: Uncertainty { disturbance, ..setup.doubt }, ..*setup })
}

/// The setup with the typed value of a parameter, which may have a half width; without one, it is known
/// exactly.
fn within(setup: &Setup, knob: Knob, text: &str) -> Result<Setup, String> {
    let read = knob.parse_toleranced(text)?;
    let mut setup = *setup;
    setup.problem.set(knob, read.middle.value);
    if read.half_width > 0.0 || knob.is_parameter() {
        setup.doubt = setup.doubt.with_half_width(knob, read.half_width)?;
    }
    Ok(setup)
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
    Ok(with_number(problem, row, row.knob_in(&problem).parse(text)?))
}
