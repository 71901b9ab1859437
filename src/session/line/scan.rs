//! Lines that scan, and that write what was found.

use crate::oscillator::PARAMETERS;
use crate::session::message::Effect;
use crate::session::scan::scan_of;
use crate::session::state::Session;
use crate::session::update::scan as update;
use crate::study::measure::MEASURES;
use crate::study::scan::Sweep;

/// `NAME=FROM:TO:COUNT .. MEASURE,..`
///
/// # Errors
/// One line that says what is wrong and what is allowed.
pub fn scan(session: &mut Session, rest: &str) -> Result<Vec<Effect>, String> {
    let (sweeps, measures): (Vec<&str>, Vec<&str>) =
        rest.split_whitespace().partition(|word| word.contains('='));
    let over = sweeps.into_iter().map(str::parse).collect::<Result<Vec<Sweep>, _>>()?;
    let measures = if measures.is_empty() { "margin".to_owned() } else { measures.join(",") };
    let scan = scan_of(session, over, &measures)?;
    Ok(update::start(session, scan))
}

/// Parameters with their `=`; behind one of them also measures.
pub fn words(_: &Session, words: &[&str]) -> Vec<String> {
    let sweeps = PARAMETERS.iter().map(|row| format!("{}=", row.name));
    let moved = words.iter().any(|word| word.contains('='));
    let measures = MEASURES.iter().filter(|_| moved).map(|row| row.name.to_owned());
    sweeps.chain(measures).collect()
}

/// The file for the rows.
///
/// # Errors
/// One line, where there is no scan.
pub fn save(session: &mut Session, rest: &str) -> Result<Vec<Effect>, String> {
    if session.scanned.is_none() {
        return Err("there is no scan".to_owned());
    }
    Ok(update::save(session, rest.into()))
}
