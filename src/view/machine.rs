//! What becomes of the motion of a machine, in its own units, by the whole model.

use crate::flow::{Fate, Outcome, Trajectory};
use crate::portrait::{Border, Cycle};
use crate::session::Session;
use crate::words::{number::significant, quantity::with_unit};

const PLACES: usize = 4;

/// What becomes of the motion by the whole model.
pub fn outcome(session: &Session, motion: &Trajectory) -> String {
    let Some((course, running)) = session.course().zip(session.running()) else {
        return String::new();
    };
    let units = &running.reduced.units;
    let within = match course.border {
        Border::Cycle => " (inside the unstable cycle)",
        Border::Grazing => " (inside the motion that touches the belt)",
        Border::Capture => " (inside the motion that ends where the guide just holds)",
        Border::Separatrix => " (inside the separatrix)",
        Border::None | Border::NoBasin | Border::Unknown(_) => "",
    };
    match (course.fate, motion.outcome) {
        (Fate::Rest, Outcome::Captured { tau, q }) => {
            let place = with_unit(q * units.displacement, PLACES, "m");
            let time = with_unit(tau * units.time, PLACES, "s");
            format!("comes to rest at x = {place}, after {time}{within}")
        }
        (Fate::Rest, _) => format!("comes to rest{within}"),
        (Fate::Cycle(_), _) => {
            course.cycle.map_or_else(String::new, |cycle| onto(&cycle, units.displacement))
        }
        (Fate::Neutral, _) => "is periodic, one of a family".to_owned(),
        (Fate::Moving, _) => "still moves".to_owned(),
        (Fate::Escapes, _) => "grows without bound".to_owned(),
        (Fate::Unknown(stop), _) => format!("ends in a way that is not known: {stop}"),
    }
}

/// The cycle to which a motion tends.
fn onto(cycle: &Cycle, unit: f64) -> String {
    let size = with_unit(cycle.q_max * unit, PLACES, "m");
    let over = if cycle.overtakes { "overtaking " } else { "" };
    if !cycle.sticks() {
        return format!("tends to the {over}slip cycle, x up to {size}");
    }
    let part = significant(100.0 * cycle.stick_duration() / cycle.period, 3);
    format!("tends to {over}stick-slip, x up to {size}; it sticks for {part} % of the time")
}
