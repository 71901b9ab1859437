//! Every limit cycle at given parameters, described: extremes, period, multiplier, and what borders the
//! basin. The closed pairs of half swings behind them are found in [`crate::portrait::closing::all`].
//!
//! ```
//! use hopfscope::flow::Limits;
//! use hopfscope::model::Parameters;
//! use hopfscope::portrait::Border;
//! use hopfscope::portrait::basin::cycle::cycles;
//!
//! let parameters = Parameters { d: -0.3, d2: 0.0, d3: 0.5, r: 0.1 };
//! let found = cycles(&parameters, &Limits::PATIENT)?;
//! let [inner, outer] = &found.cycles[..] else { panic!("two cycles") };
//! assert!(!inner.stable && outer.stable && inner.q_max < outer.q_max);
//! assert_eq!(found.border, Border::Cycle);
//! # Ok::<(), hopfscope::flow::Reason>(())
//! ```

use super::orbit::works as works_over;
use crate::flow::{Cost, Flow, Limits, Result};
use crate::model::{Ledger, Model, Parameters, Side, State};
use crate::numerics::{by_number, exp};
use crate::portrait::{
    Border, Cycle, CycleErrors, Edge, Equation, Errors, Margin, Portrait, STEP, SwingPair,
    all_closings, first_side, share,
};

/// How far a separatrix is followed for a picture, in units of `1/abs(D2)`.
pub(crate) fn picture_reach(d2: f64) -> f64 {
    20.0 / d2.abs().max(f64::MIN_POSITIVE)
}

/// Finds all limit cycles at these parameters.
///
/// The piecewise linear cycle comes from its closed form, all others from the search. Clearances are
/// computed to rounding; `error` of each cycle says what that is worth near a fold.
///
/// # Errors
/// The [`Reason`](crate::model::Reason) why the search could not be completed.
pub fn cycles(parameters: &Parameters, limits: &Limits) -> Result<Cycles> {
    let mut equation = Equation::new(parameters, STEP, limits);
    let closings = all_closings(&mut equation)?;
    let cycles = described(parameters, &closings);
    let border = Border::around(parameters, &cycles);
    let (parameters, cost) = (*parameters, equation.cost());
    Ok(Cycles { parameters, cycles, closings, border, cost })
}

/// The cycles that these closed pairs of half swings are.
pub(crate) fn described(parameters: &Parameters, found: &[SwingPair]) -> Vec<Cycle> {
    let side = first_side(parameters);
    found.iter().map(|closing| closing.describe(parameters, side)).collect()
}

impl Portrait {
    /// Its cycles and what borders the basin, drawn in units of the oscillator of the paper, which for a machine has these
    /// parameters; with this many points on each integration step of a curve.
    ///
    /// # Errors
    /// [`Reason`](crate::model::Reason) why a cycle on a belt could not be followed once more.
    pub fn drawn(self, parameters: &Parameters, points: u16) -> Result<Drawing> {
        let model = &self.model;
        let unit = model.drawing_length();
        let energy = model.stiffness * unit * unit;
        let (mut curves, mut works) = (Vec::new(), Vec::new());
        if self.fates.is_empty() {
            let mut flow = Flow::new(model);
            flow.follows = true;
            for cycle in &self.cycles {
                let (curve, _) = flow.around(cycle.q_max, cycle.is_followed_backward())?;
                works.push(curve.ledger(model).scaled(1.0 / energy));
                curves.push(self.places(&Edge::Curve(curve), points));
            }
        }
        // A separatrix lies within all cycles.
        let orbits = self.borders.iter().skip(self.borders.len().saturating_sub(self.cycles.len()));
        for edge in orbits {
            if let Edge::Orbit(orbit) = edge {
                curves.push(self.places(edge, points));
                works.push(works_over(orbit, parameters));
            }
        }
        let farthest = model.guide_static / unit;
        let area = self.area().filter(|_| !self.fates.is_empty());
        let cycle = |cycle: &Cycle| cycle.scaled(1.0 / unit, 1.0 / model.omega_0);
        Ok(Drawing {
            parameters: *parameters,
            cycles: self.cycles.iter().map(cycle).collect(),
            curves,
            works,
            edge: self.edge().map(|edge| self.places(edge, points)).unwrap_or_default(),
            margin: self.in_drawing(&self.margin),
            nearest: self.nearest_border([farthest, -farthest]),
            area: area.map(|area| area / (unit * unit * model.omega_0)),
            lyapunov_share: self.lyapunov_share(),
            portrait: Box::new(self),
        })
    }

    /// The points of a border in these units.
    #[must_use]
    pub fn places(&self, edge: &Edge, points: u16) -> Vec<State> {
        let unit = self.model.drawing_length();
        let scaled = |State { q, v }| State { q: q / unit, v: v / unit };
        edge.curve(points).into_iter().map(scaled).collect()
    }

    /// Displacement and velocity of a state in these units.
    #[must_use]
    pub fn from_drawing(&self, State { q, v }: State) -> (f64, f64) {
        let unit = self.model.drawing_length();
        (q * unit, v * unit * self.model.omega_0)
    }

    /// The nearest of the borders straight above and below places of rest, in these units: the place, and the velocity of
    /// the border there. `None` where no border was traced, or it begins at a place of rest.
    #[must_use]
    pub fn nearest_border(&self, places: impl IntoIterator<Item = f64>) -> Option<State> {
        self.margin.from_rest.impulse.filter(|least| *least > 0.0)?;
        let both = places.into_iter().flat_map(|q| [1.0, -1.0].map(|v| State { q, v }));
        let borders = both.filter_map(|at| Some(State { v: at.v * self.border_toward(at)?, ..at }));
        borders.min_by(by_number(|at: &State| at.v.abs()))
    }

    /// How large a kick would be that leads from rest in the direction of this state, by its velocity or along `v = 0`,
    /// and ends on the border of the basin, in these units; `None` where there is none, or no border was traced.
    #[must_use]
    pub fn border_toward(&self, State { q, v }: State) -> Option<f64> {
        let edge = self.edge().filter(|_| self.has_basin())?;
        let unit = self.model.drawing_length();
        let (low, high) = edge.span_at(q * unit)?;
        let (right, left) = self.reach?.displacement;
        let size = match (v > 0.0, v < 0.0, q > 0.0) {
            (true, ..) => high,
            (_, true, _) => low,
            (.., true) => right,
            _ => left,
        };
        Some(size.abs() / unit).filter(|size| size.is_finite() && *size > 0.0)
    }

    /// A margin of the machine in these units.
    #[must_use]
    pub fn in_drawing(&self, margin: &Margin) -> Margin {
        let Model { mass, omega_0, .. } = self.model;
        let unit = self.model.drawing_length();
        margin.map(|x| x / unit, |it| it / (mass * unit * omega_0))
    }
}

impl SwingPair {
    /// The cycle that this closed pair of swings is; the first swing runs on `side`.
    #[must_use]
    pub fn describe(&self, parameters: &Parameters, side: Side) -> Cycle {
        let Parameters { d, d3, r, .. } = *parameters;
        let log_multiplier = self.log_multiplier(parameters);
        let multiplier = exp(log_multiplier);
        let [one, other] = self.spread();
        let turning = [(self.clearances[0], one.length), (self.clearances[1], other.length)];
        let fastest = [(self.fastest[0], one.fastest), (self.fastest[1], other.fastest)];
        let Errors { duration, square, .. } = one.plus(other, 1.0);
        // The first swing starts on the far side of the half plane that it crosses.
        let ([left, right], [up, down]) = match side {
            Side::Upper => (turning, fastest),
            Side::Lower => ([turning[1], turning[0]], [fastest[1], fastest[0]]),
        };
        let unshared = turning.map(|(clearance, error)| error * (1.0 - share(clearance, 2.0 * r)));
        let terms: f64 = self.log_terms(parameters).iter().map(|term| term.abs()).sum();
        let dampings = 2.0 * d.abs() * duration + 3.0 * (d3.abs() * square);
        Cycle {
            stable: log_multiplier < 0.0,
            q_min: -(r + left.0.value),
            q_max: r + right.0.value,
            v_min: -down.0,
            v_max: up.0,
            period: self.duration,
            multiplier: multiplier.is_finite().then_some(multiplier),
            log_multiplier,
            clearance: right.0.value,
            log_clearance: right.0.log,
            ..Cycle::default()
        }
        .rounded(CycleErrors {
            q_min: left.1 * left.0.value,
            q_max: right.1 * right.0.value,
            v_min: down.1,
            v_max: up.1,
            period: duration,
            log_multiplier: unshared[0] + unshared[1] + dampings + f64::EPSILON * terms,
            log_clearance: right.1,
        })
    }
}

// Limit cycles as data: as the search finds them, and as they are drawn with the basin.

/// All limit cycles, by amplitude, and what they imply for the basin.
#[derive(Clone, Debug)]
pub struct Cycles {
    /// The parameters.
    pub parameters: Parameters,
    /// The cycles, smallest first.
    pub cycles: Vec<Cycle>,
    /// The closed pairs of half swings that they are.
    pub(crate) closings: Vec<SwingPair>,
    /// What borders the basin of the sticking set.
    pub border: Border,
    /// What it cost.
    pub cost: Cost,
}

/// All motions as a picture shows them, in units of the oscillator of the paper.
#[derive(Clone, Debug, PartialEq)]
pub struct Drawing {
    /// The parameters of that oscillator.
    pub parameters: Parameters,
    /// The cycles, smallest first.
    pub cycles: Vec<Cycle>,
    /// The closed curve of each cycle.
    pub curves: Vec<Vec<State>>,
    /// What each source does over one turn of each cycle.
    pub works: Vec<Ledger>,
    /// The border of the basin: a closed curve, or the separatrix as far as it was followed; else empty.
    pub edge: Vec<State>,
    /// The kicks that are survived.
    pub margin: Margin,
    /// Where the mass rests when the smallest impulse that is not survived meets it, with the velocity of the border there.
    pub nearest: Option<State>,
    /// Area of the basin, where it is finite.
    pub area: Option<f64>,
    /// Radius of Lyapunov's disk (24) as a fraction of the margin; above 1 it promises too much, because it
    /// leaves out D2 and D3.
    pub lyapunov_share: Option<f64>,
    /// The motions; of a machine in SI units.
    pub portrait: Box<Portrait>,
}
