//! Starts that are certainly safe or certainly lost, for all parameters within their intervals and all bounded
//! disturbances, as the phase plane draws them and the pane states them.

use crate::flow::{Cost, Limits, Result};
use crate::model::{Body, Source, State, Tolerances};
use crate::portrait::guarantee::certain;
use crate::portrait::{Margin, NoGuarantee, Portrait, picture_reach};

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
    pub guaranteed: Result<Margin, NoGuarantee>,
    pub cost: Cost,
}

/// The zones, with `points` on each step of a border; of a machine in the units of its oscillator. Fails with the
/// [`Reason`](crate::model::Reason) why a border could not be computed.
pub(super) fn zones(
    source: &Source,
    known: &Tolerances,
    points: u16,
    limits: &Limits,
) -> Result<CertainZones> {
    let (reach, nominal) = match &source.body {
        Body::Paper(parameters) => {
            let known = known.around(parameters);
            let d2 = known.d2.lower().abs().min(known.d2.upper().abs());
            (picture_reach(d2), Portrait::innermost(&known.middle(), 0.0, limits)?)
        }
        // On a belt every border is closed.
        Body::Belt(_) | Body::Mode(_) => (0.0, source.portrait()?),
    };
    let found = certain::guaranteed(source, known, reach, limits)?;
    let hopeful = certain::hopeful(source, known, reach, limits)?;
    let mut cost = nominal.cost;
    let others = found.iter().map(|(worst, _)| worst).chain(&hopeful);
    others.for_each(|portrait| cost += portrait.cost);
    let extent = |portrait: &Portrait| match portrait.edge() {
        Some(edge) => Extent::Within(nominal.places(edge, points)),
        None if portrait.has_basin() => Extent::Everything,
        None => Extent::Nothing,
    };
    Ok(CertainZones {
        safe: found.as_ref().map_or(Extent::Nothing, |(worst, _)| extent(worst)),
        hopeful: hopeful.as_ref().map_or(Extent::Everything, extent),
        nominal: nominal.in_drawing(&nominal.margin),
        guaranteed: found.map(|(_, margin)| nominal.in_drawing(&margin)),
        cost,
    })
}
