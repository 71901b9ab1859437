//! Starts that are certainly safe or certainly lost, for all parameters within their intervals and all bounded
//! disturbances, as the phase plane draws them and the pane states them.

use std::sync::Arc;

use crate::flow::{Cost, Limits, Reason};
use crate::model::{Belt, ParameterBox, State, Tolerances};
use crate::portrait::guarantee::{Uncertain, machine, oscillator};
use crate::portrait::{Margin, Portrait, picture_reach};

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

impl UncertainSubject {
    /// What its border parts at the nominal parameters without disturbance. Fails with the [`Reason`] why the border
    /// could not be computed.
    pub fn nominal(&self, limits: &Limits) -> Result<Portrait, Reason> {
        match self {
            UncertainSubject::Parameters { known, .. } => oscillator::nominal(known, limits),
            UncertainSubject::Machine { belt, .. } => Portrait::of_belt(belt),
        }
    }

    /// That whose basin lies within all others, and the margin that holds for certain, or why there is none; a border that
    /// is not closed is followed as far as `reach`. Fails with the [`Reason`] why the border could not be computed.
    pub fn guaranteed(
        &self,
        reach: f64,
        limits: &Limits,
    ) -> Result<Result<(Portrait, Margin), Uncertain>, Reason> {
        match self {
            UncertainSubject::Parameters { known, disturbance } => {
                oscillator::guaranteed(known, *disturbance, reach, limits)
            }
            UncertainSubject::Machine { belt, tolerances } => machine::guaranteed(belt, tolerances),
        }
    }

    /// That whose basin all others lie within, where it is known.
    fn hopeful(&self, reach: f64, limits: &Limits) -> Result<Option<Portrait>, Reason> {
        match self {
            UncertainSubject::Parameters { known, disturbance } => {
                oscillator::hopeful(known, *disturbance, reach, limits)
            }
            UncertainSubject::Machine { belt, tolerances } => machine::hopeful(belt, tolerances),
        }
    }
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

/// The zones, with `points` on each step of a border; of a machine in the units of its oscillator. Fails with the
/// [`Reason`] why a border could not be computed.
pub(super) fn zones(
    subject: &UncertainSubject,
    points: u16,
    limits: &Limits,
) -> Result<CertainZones, Reason> {
    let reach = match subject {
        UncertainSubject::Parameters { known, .. } => {
            picture_reach(known.d2.lower().abs().min(known.d2.upper().abs()))
        }
        // On a belt every border is closed.
        UncertainSubject::Machine { .. } => 0.0,
    };
    let nominal = subject.nominal(limits)?;
    let found = subject.guaranteed(reach, limits)?;
    let hopeful = subject.hopeful(reach, limits)?;
    let mut cost = nominal.cost;
    let others = found.iter().map(|(worst, _)| worst).chain(&hopeful);
    others.for_each(|portrait| cost += portrait.cost);
    let extent = |portrait: &Portrait| match portrait.edge() {
        Some(edge) => Extent::Within(nominal.places(edge, points)),
        None if portrait.has_basin() => Extent::Everything,
        None => Extent::Nothing,
    };
    let certain = found.as_ref();
    Ok(CertainZones {
        safe: certain.map_or(Extent::Nothing, |(worst, _)| extent(worst)),
        hopeful: hopeful.as_ref().map_or(Extent::Everything, extent),
        nominal: nominal.in_drawing(&nominal.margin),
        guaranteed: certain
            .map(|(_, margin)| nominal.in_drawing(margin))
            .map_err(ToString::to_string),
        cost,
    })
}
