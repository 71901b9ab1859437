//! Typing a value: the line opens, takes characters, and its text is accepted or refused.

use crate::flow::{METHODS, Problem, QUALITIES};
use crate::model::Knob;
use crate::model::unit::measured;
use crate::session::act::notice::warn_of_units;
use crate::session::act::parameters::put;
use crate::session::message::key::Key;
use crate::session::read::numbers::typed;
use crate::session::state::uncertainty::symbol_of;
use crate::session::state::{Entry, Overlay, Row, Session, Setup};
use crate::words::one_of;

/// Opens the line with the value of the selected row.
pub fn edit(session: &mut Session) {
    let row = session.selected;
    let knob = row.knob_in(&session.problem);
    let text = typed(&session.setup(), row).unwrap_or_else(|| knob.print(session.value(knob)));
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
    let text = text.trim();
    let problem = match row {
        Row::Number(Knob::Disturbance) => {
            return session.with(setup, Knob::Disturbance, disturbance(session, setup, text)?);
        }
        Row::Number(knob) => return number(session, setup, knob, text),
        Row::Method => {
            let method = one_of("method", text, METHODS.iter().map(|row| (row.name, row.method)))?;
            Problem { method, ..setup.problem }
        }
        Row::Tolerance => match QUALITIES.iter().find(|quality| quality.name == text) {
            Some(quality) => setup.problem.at(quality),
            None => setup.problem.with_setting(row.knob_in(&setup.problem).parse(text)?),
        },
    };
    Ok(Setup { problem, ..*setup })
}

/// The setup with the typed number. A parameter, and a number of the machine to which one corresponds, may have
/// a tolerance; without one, it is known exactly.
fn number(session: &Session, setup: &Setup, knob: Knob, text: &str) -> Result<Setup, String> {
    let read = knob.parse_toleranced(text)?;
    let changed = session.with(setup, knob, read.middle.value)?;
    if read.half_width == 0.0 && !knob.is_parameter() && symbol_of(knob).is_none() {
        return Ok(changed);
    }
    let doubt = session.with_tolerance(&changed, knob, read.half_width)?;
    Ok(Setup { doubt, ..changed })
}

/// The typed bound on the disturbance, in the unit of r or with a unit of force.
fn disturbance(session: &Session, setup: &Setup, text: &str) -> Result<f64, String> {
    if measured(text).is_ok_and(|read| read.dimension.is_some()) {
        return Ok(Knob::DisturbingForce.parse(text)? / session.unit_of_force(setup)?);
    }
    Knob::Disturbance.parse(text)
}
