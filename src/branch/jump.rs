//! Where a stable state ends along a number of a machine, and what its motions become there.

use serde::ser::SerializeStruct;
use serde::{Serialize, Serializer};

use crate::flow::Fate;
use crate::model::Model;
use crate::portrait::{Border, Portrait};

/// The model along a number: `None` where there is none.
pub type Family<'a> = &'a (dyn Fn(f64) -> Option<Model> + Sync);

/// The end of a stable state.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Jump {
    /// Largest displacement of the cycle that ends, in m; 0 for rest.
    pub from: f64,
    /// What its motions become.
    pub to: Fate,
    /// Largest displacement of the cycle to which they tend, in m; 0 for rest, else infinite.
    pub x_max: f64,
}

impl Jump {
    /// How far it goes.
    fn size(&self) -> f64 {
        (self.x_max - self.from).abs()
    }
}

impl Serialize for Jump {
    fn serialize<S: Serializer>(&self, out: S) -> Result<S::Ok, S::Error> {
        #[derive(Serialize)]
        struct To {
            kind: &'static str,
            #[serde(rename = "q_max", skip_serializing_if = "Option::is_none")]
            x_max: Option<f64>,
        }
        let (kind, x_max) = match self.to {
            Fate::Rest => ("rest", None),
            Fate::Cycle(_) => ("cycle", Some(self.x_max)),
            Fate::Escapes => ("escaped", None),
            Fate::Neutral | Fate::Moving | Fate::Unknown(_) => ("unknown", None),
        };
        let mut jump = out.serialize_struct("Jump", 2)?;
        jump.serialize_field("from", &self.from)?;
        jump.serialize_field("to", &To { kind, x_max })?;
        jump.end()
    }
}

/// The jumps at a place, on the way up and on the way down.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Jumps {
    /// While the number grows.
    pub up: Option<Jump>,
    /// While it falls.
    pub down: Option<Jump>,
}

impl Jumps {
    /// The jumps at `value`, found from the states so far `aside` of it. What shrinks with the distance, as
    /// a cycle does that is born at rest, is not a jump.
    pub fn at(family: Family, value: f64, aside: f64) -> Self {
        /// How much farther one looks as well.
        const FARTHER: f64 = 100.0;
        let portrait = |value| Portrait::of(&family(value)?).ok();
        let jumps = |aside: f64| {
            let (below, above) = (portrait(value - aside)?, portrait(value + aside)?);
            Some(Jumps { up: jump(&below, &above), down: jump(&above, &below) })
        };
        let (Some(far), Some(near)) = (jumps(FARTHER * aside), jumps(aside)) else {
            return Jumps::default();
        };
        let stays = |far: Option<Jump>, near: Option<Jump>| {
            far.zip(near).filter(|(far, near)| near.size() > 0.5 * far.size()).map(|(_, near)| near)
        };
        Jumps { up: stays(far.up, near.up), down: stays(far.down, near.down) }
    }
}

/// The first stable state of one machine that its neighbour does not have.
fn jump(from: &Portrait, to: &Portrait) -> Option<Jump> {
    /// A state that has moved by less, as a fraction of the largest cycle, is the same.
    const MOVED: f64 = 1e-3;
    /// The kick that shows whether rest holds, as a fraction of the same.
    const KICK: f64 = 1e-9;
    let cycles = from.cycles.iter().chain(&to.cycles).map(|cycle| cycle.q_max);
    let size = cycles.fold(0.0, f64::max);
    let rests = !from.neutral && from.border != Border::NoBasin;
    let stable = from.cycles.iter().filter(|cycle| cycle.stable).map(|cycle| cycle.q_max);
    rests.then_some(0.0).into_iter().chain(stable).find_map(|state| {
        let fate = to.fate(state.max(KICK * size), 0.0).unwrap_or_else(Fate::Unknown);
        let x_max = match fate {
            Fate::Rest => 0.0,
            Fate::Cycle(index) => to.cycles[index].q_max,
            Fate::Neutral => return None,
            Fate::Moving | Fate::Escapes | Fate::Unknown(_) => f64::INFINITY,
        };
        Some(Jump { from: state, to: fate, x_max }).filter(|jump| jump.size() > MOVED * size)
    })
}
