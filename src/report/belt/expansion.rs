//! A machine approximated by the oscillator of the paper, whose friction is a cubic, and the errors of this
//! approximation.

use serde::Serialize;

use crate::machine::survey::CubicExpansion;
use crate::oscillator::Parameters;
use crate::oscillator::belt::TaylorError;
use crate::portrait::{Border, Cycle, Margin, Portrait};
use crate::study::belt::PhysicalMargin;

/// The answer of the expansion.
#[derive(Serialize)]
pub(super) struct Expansion<'a> {
    parameters: &'a Parameters,
    /// Why there is no answer.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
    pub cycles: Vec<ExpandedCycle<'a>>,
    edge: Option<Border>,
    pub margin: Option<ExpandedMargin>,
}

#[derive(Serialize)]
pub(super) struct ExpandedCycle<'a> {
    pub stable: bool,
    pub x_min: f64,
    pub x_max: f64,
    pub v_min: f64,
    pub v_max: f64,
    pub period: f64,
    /// Whether it reaches the speed of the belt, where the expansion does not hold.
    pub reaches_belt: bool,
    /// The error of the cubic over the velocities of the cycle.
    pub taylor: Option<TaylorError>,
    /// Differences to the nearest cycle of the same stability; `None` if there is none.
    pub error: Option<CycleError>,
    dimensionless: &'a Cycle,
}

/// Differences to a cycle of the whole model, in m, m/s and s.
#[derive(Clone, Copy, Serialize)]
pub(super) struct CycleError {
    x_min: f64,
    pub x_max: f64,
    v_min: f64,
    v_max: f64,
    period: f64,
}

#[derive(Serialize)]
pub(super) struct ExpandedMargin {
    #[serde(flatten)]
    pub physical: PhysicalMargin,
    dimensionless: Margin,
    /// By how much they exceed those of the whole model; `None` if one of the two does not exist.
    pub error: MarginError,
}

/// Differences of margins, in m and N s.
#[derive(Clone, Copy, Serialize)]
pub(super) struct MarginError {
    pub displacement: Option<f64>,
    impulse: Option<f64>,
}

impl<'a> Expansion<'a> {
    pub(super) fn new(expansion: &'a CubicExpansion, portrait: &Portrait) -> Self {
        let parameters = &expansion.reduced.parameters;
        let found = match &expansion.cycles {
            Ok(found) => found,
            Err(reason) => {
                let reason = Some(reason.to_string());
                return Expansion {
                    parameters,
                    reason,
                    cycles: Vec::new(),
                    edge: None,
                    margin: None,
                };
            }
        };
        let margin = found.picture.as_ref().map(|picture| {
            let physical = PhysicalMargin::new(&picture.margin, &expansion.reduced.units);
            let Margin { displacement, impulse, .. } = portrait.margin;
            let excess = |own: Option<f64>, whole: Option<f64>| Some(own? - whole?);
            let error = MarginError {
                displacement: excess(physical.displacement, displacement),
                impulse: excess(physical.impulse, impulse),
            };
            ExpandedMargin { physical, dimensionless: picture.margin, error }
        });
        let cycles = found.cycles.iter();
        let cycles = cycles.map(|cycle| expanded(cycle, expansion, portrait)).collect();
        Expansion { parameters, reason: None, cycles, edge: Some(found.border), margin }
    }
}

fn expanded<'a>(
    cycle: &'a Cycle,
    CubicExpansion { belt, reduced, .. }: &CubicExpansion,
    portrait: &Portrait,
) -> ExpandedCycle<'a> {
    let units = &reduced.units;
    let (x_min, x_max) = (cycle.q_min * units.displacement, cycle.q_max * units.displacement);
    let (v_min, v_max) = (cycle.v_min * units.velocity, cycle.v_max * units.velocity);
    let period = cycle.period * units.time;
    let alike = portrait.cycles.iter().filter(|whole| whole.stable == cycle.stable);
    let distance = |whole: &Cycle| (whole.q_max - x_max).abs();
    let nearest = alike.min_by(|one, other| distance(one).total_cmp(&distance(other)));
    let error = nearest.map(|whole| CycleError {
        x_min: x_min - whole.q_min,
        x_max: x_max - whole.q_max,
        v_min: v_min - whole.v_min,
        v_max: v_max - whole.v_max,
        period: period - whole.period,
    });
    ExpandedCycle {
        stable: cycle.stable,
        x_min,
        x_max,
        v_min,
        v_max,
        period,
        reaches_belt: cycle.v_max >= reduced.sticking_velocity,
        taylor: belt.taylor_error((v_min, v_max)).filter(|error| error.force.is_finite()),
        error,
        dimensionless: cycle,
    }
}
