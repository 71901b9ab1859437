//! What is said about a machine: what becomes of its motion, and which kicks it survives, in its own units;
//! by the whole model and by its cubic expansion.

use super::pane;
use crate::flow::{Outcome, Trajectory};
use crate::machine::{BorderKind, MachineCycle, MachineFate};
use crate::scene::Topic;
use crate::session::Session;
use crate::study::Margin;
use crate::words::number::significant;
use crate::words::quantity::with_unit;

const PLACES: usize = 4;

/// What becomes of the motion by the whole model.
pub fn outcome(session: &Session, motion: &Trajectory) -> String {
    let Some((course, running)) = session.course().zip(session.running()) else {
        return String::new();
    };
    let units = &running.reduced.units;
    let within = match course.border {
        BorderKind::Cycle => " (inside the unstable cycle)",
        BorderKind::Grazing if course.touches => " (inside the motion that touches the belt)",
        BorderKind::Grazing => " (inside the motion that ends where the guide just holds)",
        BorderKind::None | BorderKind::NoBasin => "",
    };
    match (course.fate, motion.outcome) {
        (MachineFate::Rest, Outcome::Captured { tau, q }) => {
            let place = with_unit(q * units.displacement, PLACES, "m");
            let time = with_unit(tau * units.time, PLACES, "s");
            format!("comes to rest at x = {place}, after {time}{within}")
        }
        (MachineFate::Rest, _) => format!("comes to rest{within}"),
        (MachineFate::Cycle(index), _) => course.cycles.get(index).map_or_else(String::new, onto),
        (MachineFate::Neutral, _) => "is periodic, one of a family".to_owned(),
        (MachineFate::Escaped, _) => "grows without bound".to_owned(),
        (MachineFate::Unknown(stop), _) => format!("ends in a way that is not known: {stop}"),
    }
}

/// The cycle to which a motion tends.
fn onto(cycle: &MachineCycle) -> String {
    let size = with_unit(cycle.x.1, PLACES, "m");
    let over = if cycle.overtakes { "overtaking " } else { "" };
    if !cycle.sticks {
        return format!("tends to the {over}slip cycle, x up to {size}");
    }
    let part = significant(100.0 * cycle.stick_duration / cycle.period, 3);
    format!("tends to {over}stick-slip, x up to {size}; it sticks for {part} % of the time")
}

/// The kicks that are survived: by the model on show first, and by how much the expansion is wrong.
pub fn margin(session: &Session, width: usize) -> Option<String> {
    let fresh = !session.is_stale(Topic::Cycles, session.plot);
    let (kinds, running) = session.kinds().filter(|_| fresh).zip(session.running())?;
    let units = &running.reduced.units;
    let said = |margin: &Option<Margin>| match margin {
        Some(Margin { displacement: Some(q), impulse: Some(v), .. }) if *q > 0.0 => format!(
            "survives kicks up to {} or {}",
            with_unit(q * units.displacement, PLACES, "m"),
            with_unit(v * units.impulse, PLACES, "N s")
        ),
        Some(Margin { displacement: Some(_), .. }) => "no kick is survived".to_owned(),
        _ => "every kick is survived".to_owned(),
    };
    let [whole, cubic] = &kinds.margins;
    let size = |margin: &Option<Margin>| margin.and_then(|margin| margin.displacement);
    let error = match (size(whole), size(cubic)) {
        (Some(own), Some(other)) if own > 0.0 => {
            let percent = 100.0 * (other / own - 1.0);
            let way = if percent > 0.0 { "large" } else { "small" };
            format!("{} % too {way}", significant(percent.abs(), 2))
        }
        (Some(_), None) => "every kick is survived".to_owned(),
        (None, Some(_)) => "not every kick is survived".to_owned(),
        _ => "the same".to_owned(),
    };
    let texts = if session.draws_whole() {
        let whole = said(whole);
        vec![format!("{whole}; cubic expansion: {error}"), format!("{whole} (cubic: {error})")]
    } else {
        let cubic = said(cubic);
        vec![
            format!("cubic expansion {cubic}: {error}; whole model: {}", said(whole)),
            format!("cubic expansion {cubic}: {error}"),
            format!("cubic {cubic}: {error}"),
        ]
    };
    Some(pane::fitting(texts, width))
}
