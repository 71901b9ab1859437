//! Limit cycles as data: one, all of them, what borders the basin, and the kicks that it survives.

use serde::Serialize;

use crate::closed_form::harmonic::Harmonic;
use crate::closed_form::piecewise_linear::LinearCycle;
use crate::flow::Cost;
use crate::numerics::elementary::exp_m1;
use crate::oscillator::{Ledger, Parameters, State};

/// A limit cycle.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Cycle {
    /// Whether it attracts.
    pub stable: bool,
    /// Left turning point.
    pub q_min: f64,
    /// Right turning point.
    pub q_max: f64,
    /// Smallest velocity.
    pub v_min: f64,
    /// Largest velocity.
    pub v_max: f64,
    /// Period.
    pub period: f64,
    /// Floquet multiplier; `None` where it overflows.
    pub multiplier: Option<f64>,
    /// Natural logarithm of the multiplier.
    pub log_multiplier: f64,
    /// `q_max - r`, to full relative precision; 0 where it underflows.
    pub clearance: f64,
    /// Natural logarithm of the clearance.
    pub log_clearance: f64,
    /// Largest relative error of these numbers. A multiplier that under- or overflows counts by its logarithm.
    pub error: f64,
    /// The error of each.
    pub errors: CycleErrors,
}

/// Bounds on the absolute errors of the numbers of a cycle.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct CycleErrors {
    /// Of the left turning point.
    pub q_min: f64,
    /// Of the right turning point.
    pub q_max: f64,
    /// Of the smallest velocity.
    pub v_min: f64,
    /// Of the largest velocity.
    pub v_max: f64,
    /// Of the period.
    pub period: f64,
    /// Of the logarithm of the multiplier: a relative error of the multiplier.
    pub log_multiplier: f64,
    /// Of the logarithm of the clearance: a relative error of the clearance.
    pub log_clearance: f64,
}

impl Cycle {
    /// Whether its multiplier is far below the 1 at which two cycles meet.
    pub fn is_stable_beyond_doubt(&self) -> bool {
        /// Where two cycles meet, the logarithm vanishes to about half of the digits.
        const FAR: f64 = -1.0;
        self.log_multiplier < FAR
    }
}

/// What borders the basin of attraction of the sticking set.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Edge {
    /// Nothing: every motion is captured.
    None,
    /// An unstable limit cycle.
    Cycle,
    /// A motion that separates capture from escape.
    Separatrix,
}

/// What a picture of the basin shows.
#[derive(Clone, Debug, PartialEq)]
pub struct BasinPicture {
    /// The closed curve of each cycle.
    pub curves: Vec<Vec<State>>,
    /// What each source does over one turn of each cycle.
    pub works: Vec<Ledger>,
    /// The edge of the basin: a closed curve, or the separatrix as far as it was followed; else empty.
    pub edge: Vec<State>,
    /// The kicks that are survived.
    pub margin: Margin,
    /// Area of the basin, where it is finite.
    pub area: Option<f64>,
    /// Radius of Lyapunov's disk (24) as a fraction of the margin; above 1 it promises too much, because it
    /// leaves out D2 and D3.
    pub lyapunov_share: Option<f64>,
}

/// All limit cycles, by amplitude, and what they imply for the basin.
#[derive(Clone, Debug, PartialEq)]
pub struct Cycles {
    /// The parameters.
    pub parameters: Parameters,
    /// The cycles, smallest first.
    pub cycles: Vec<Cycle>,
    /// The first-order harmonic answer, for comparison.
    pub harmonic: Vec<Harmonic>,
    /// What borders the basin of the sticking set.
    pub edge: Edge,
    /// Curves and margins, if asked for.
    pub picture: Option<BasinPicture>,
    /// What it cost.
    pub cost: Cost,
}

/// The margins; `None` where every kick is survived.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Margin {
    /// Smallest `abs(q)` at `v = 0` that is not captured.
    pub displacement: Option<f64>,
    /// Smallest `abs(v)` at `q = 0` that is not captured.
    pub impulse: Option<f64>,
    /// The smallest kicks out of rest that are not captured.
    pub from_rest: RestMargin,
}

/// The smallest kicks that are not captured if the mass rests where they do most, anywhere in `-r .. r`; `None`
/// where every kick is survived.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct RestMargin {
    /// Change of position.
    pub displacement: Option<f64>,
    /// Velocity.
    pub impulse: Option<f64>,
}

impl Margin {
    /// Every kick is survived.
    pub const ENDLESS: Margin = Margin {
        displacement: None,
        impulse: None,
        from_rest: RestMargin { displacement: None, impulse: None },
    };

    /// The margin with functions of its displacements and of its impulses in their place: in other units, or
    /// rounded.
    #[must_use]
    pub fn map(&self, displacement: impl Fn(f64) -> f64, impulse: impl Fn(f64) -> f64) -> Margin {
        Margin {
            displacement: self.displacement.map(&displacement),
            impulse: self.impulse.map(&impulse),
            from_rest: RestMargin {
                displacement: self.from_rest.displacement.map(displacement),
                impulse: self.from_rest.impulse.map(impulse),
            },
        }
    }

    /// No kick is survived.
    pub const ZERO: Margin = Margin {
        displacement: Some(0.0),
        impulse: Some(0.0),
        from_rest: RestMargin { displacement: Some(0.0), impulse: Some(0.0) },
    };
}

impl From<&LinearCycle> for Cycle {
    /// The cycle of the piecewise linear oscillator, in closed form.
    fn from(cycle: &LinearCycle) -> Self {
        Cycle {
            stable: false,
            q_min: -cycle.q_max,
            q_max: cycle.q_max,
            v_min: -cycle.v_max,
            v_max: cycle.v_max,
            period: cycle.period,
            multiplier: cycle.multiplier,
            log_multiplier: cycle.log_multiplier,
            clearance: cycle.clearance,
            log_clearance: cycle.log_clearance,
            error: 0.0,
            errors: CycleErrors::default(),
        }
        .rounded()
    }
}

impl Edge {
    /// What borders the basin: the innermost cycle, else a separatrix where motions can escape.
    pub fn around(parameters: &Parameters, stable: &[bool]) -> Self {
        let self_excited_node = parameters.d <= -1.0 && parameters.r > 0.0;
        // Without friction a rest that repels has no basin, and nothing borders it.
        let repels = parameters.r == 0.0 && parameters.d < 0.0;
        let escapes = parameters.d3 == 0.0 && parameters.d2 != 0.0 && !repels;
        // Positive cubic damping bounds every motion: where no cycle is left for it, it comes to rest.
        let bounded = parameters.d3 > 0.0;
        match stable.first() {
            Some(false) => Edge::Cycle,
            Some(true) if !self_excited_node => Edge::None,
            None if bounded || !(escapes || self_excited_node) => Edge::None,
            _ => Edge::Separatrix,
        }
    }
}

impl Cycle {
    /// With the rounding of each number itself added to its error, and the largest relative error.
    pub(super) fn rounded(mut self) -> Self {
        let rounded = |value: f64| 2.0 * f64::EPSILON * value.abs();
        let errors = &mut self.errors;
        let lengths = [
            (&mut errors.q_min, self.q_min),
            (&mut errors.q_max, self.q_max),
            (&mut errors.v_min, self.v_min),
            (&mut errors.v_max, self.v_max),
            (&mut errors.period, self.period),
        ];
        let mut largest = 0.0_f64;
        for (error, value) in lengths {
            *error += rounded(value);
            largest = largest.max(*error / value.abs());
        }
        errors.log_multiplier += rounded(self.log_multiplier);
        errors.log_clearance += rounded(self.log_clearance.abs().max(1.0));
        let multiplier = match self.multiplier {
            Some(multiplier) if multiplier.is_normal() => exp_m1(errors.log_multiplier),
            _ => errors.log_multiplier / self.log_multiplier.abs(),
        };
        self.error = largest.max(errors.log_clearance).max(multiplier);
        self
    }
}
