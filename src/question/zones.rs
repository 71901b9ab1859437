//! Starts that are certainly safe or certainly lost, for all parameters within their intervals and all bounded
//! disturbances, as the phase plane draws them and the pane states them.

use std::sync::Arc;

use super::whole::{margin, places};
use crate::flow::{Cost, Limits, Reason};
use crate::model::{Belt, ParameterBox, State, Tolerances};
use crate::portrait::basin::Basin;
use crate::portrait::basin::cycle::PICTURE_REACH;
use crate::portrait::guarantee::machine;
use crate::portrait::guarantee::oscillator::{guaranteed, hopeful, nominal};
use crate::portrait::{Margin, Portrait, survey};

/// What is not known exactly, and disturbed.
#[derive(Clone, Debug, PartialEq)]
pub enum UncertainSubject {
    /// The oscillator of the paper.
    Parameters {
        /// Intervals of the parameters.
        known: ParameterBox,
        /// Bound on the disturbance.
        disturbance: f64,
    },
    /// A machine, by the whole model.
    Machine {
        belt: Arc<Belt>,
        /// Tolerances of its numbers, and the bound on the disturbance.
        tolerances: Tolerances,
    },
}

/// A region of the phase plane around the sticking set.
#[derive(Clone, Debug, PartialEq)]
pub enum Extent {
    /// The empty region.
    Nothing,
    /// The points that a curve does not separate from the origin.
    Within(Vec<State>),
    Everything,
}

/// The zones, and the margins that go with them.
#[derive(Clone, Debug, PartialEq)]
pub struct CertainZones {
    /// Starts from which every motion stays in this region.
    pub safe: Extent,
    /// Starts outside of this region certainly do not come to rest; everything where no such region is known.
    pub hopeful: Extent,
    /// The margin at the nominal parameters without disturbance.
    pub nominal: Margin,
    /// The guaranteed margin, or why there is none.
    pub guaranteed: Result<Margin, String>,
    pub cost: Cost,
}

fn extent(basin: Option<&Basin>, otherwise: Extent, points: u16) -> Extent {
    match basin.map(|basin| basin.borders.first()) {
        None => otherwise,
        Some(None) => Extent::Everything,
        Some(Some(border)) => Extent::Within(border.curve(points)),
    }
}

/// The zones of an oscillator, with `points` on each step of a border. Fails with the [`Reason`] why a border
/// could not be computed.
pub(super) fn of_oscillator(
    known: &ParameterBox,
    disturbance: f64,
    points: u16,
    limits: &Limits,
) -> Result<CertainZones, Reason> {
    let d2 = known.d2.lower().abs().min(known.d2.upper().abs());
    let reach = PICTURE_REACH / d2.max(f64::MIN_POSITIVE);
    let nominal = nominal(known, limits)?;
    let found = guaranteed(known, disturbance, reach, limits)?;
    let safe = found.as_ref().ok().map(|(basin, _)| basin);
    let hopeful = hopeful(known, disturbance, reach, limits)?;
    let mut cost = nominal.cost;
    safe.into_iter().chain(&hopeful).for_each(|basin| cost += basin.cost);
    Ok(CertainZones {
        safe: extent(safe, Extent::Nothing, points),
        hopeful: extent(hopeful.as_ref(), Extent::Everything, points),
        nominal: nominal.margin(),
        guaranteed: found.map(|(_, margin)| margin).map_err(|why| why.to_string()),
        cost,
    })
}

/// The zones of a machine by the whole model, in the units of its oscillator. Fails with [`Reason`] where a
/// machine within the tolerances has no portrait.
pub(super) fn of_machine(
    belt: &Belt,
    known: &Tolerances,
    points: u16,
) -> Result<CertainZones, Reason> {
    let Portrait { model, margin: nominal, .. } = survey::portrait(belt)?;
    let drawn = |portrait: &Portrait| match portrait.border_curve() {
        Some(curve) => Extent::Within(places(curve, &model, points)),
        None => Extent::Everything,
    };
    let (safe, guaranteed) = match machine::guaranteed(belt, known)? {
        Err(why) => (Extent::Nothing, Err(why.to_string())),
        Ok((portrait, certain)) => (drawn(&portrait), Ok(margin(&model, &certain))),
    };
    let hopeful = machine::hopeful(belt, known)?.as_ref().map_or(Extent::Everything, drawn);
    let nominal = margin(&model, &nominal);
    Ok(CertainZones { safe, hopeful, nominal, guaranteed, cost: Cost::default() })
}
