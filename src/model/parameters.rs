//! The numbers that define a motion: four parameters and two initial values.

use serde::{Deserialize, Serialize};

use crate::numerics::times_power;

/// The parameters of equation (4): damping, asymmetry, cubic damping, friction. All dimensionless, and each 0 or
/// within 1e-150 .. 1e150 in magnitude ([`KNOBS`](super::KNOBS)): beyond that, nothing is promised. They are numbers, or
/// intervals in which these lie ([`ParameterBox`](super::ParameterBox)).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[must_use]
pub struct Parameters<N = f64> {
    /// Effective linear damping D; negative means self-excited, `abs(D) < 1` oscillatory.
    #[serde(rename = "D")]
    pub d: N,
    /// Asymmetric (quadratic) damping D2.
    #[serde(rename = "D2")]
    pub d2: N,
    /// Cubic damping D3.
    #[serde(rename = "D3")]
    pub d3: N,
    /// Intensity r of the dry friction, not negative.
    pub r: N,
}

impl<N> From<[N; 4]> for Parameters<N> {
    /// D, D2, D3 and r.
    fn from([d, d2, d3, r]: [N; 4]) -> Self {
        Parameters { d, d2, d3, r }
    }
}

impl<N> Parameters<N> {
    /// D, D2, D3 and r, as `of` makes them of these.
    pub fn map<M>(self, of: impl Fn(N) -> M) -> Parameters<M> {
        self.numbers().map(of).into()
    }

    /// D, D2, D3 and r.
    #[must_use]
    pub fn numbers(self) -> [N; 4] {
        [self.d, self.d2, self.d3, self.r]
    }
}

/// A point of the phase plane.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct State {
    /// Displacement, dimensionless.
    pub q: f64,
    /// Velocity `dq/dtau`, dimensionless.
    pub v: f64,
}

impl State {
    /// The point reflected in the origin.
    #[must_use]
    pub fn mirrored(self) -> Self {
        State { q: -self.q, v: -self.v }
    }
}

impl Parameters {
    /// The parameters for which mirrored motions are motions: `D2` changes its sign.
    pub fn mirrored(self) -> Self {
        Parameters { d2: -self.d2, ..self }
    }

    /// The parameters for which motions `2^k` times as large are motions (scaling symmetry of equation 4).
    pub fn times_power(self, k: i32) -> Self {
        Parameters {
            d: self.d,
            d2: times_power(self.d2, -k),
            d3: times_power(times_power(self.d3, -k), -k),
            r: times_power(self.r, k),
        }
    }

    /// Whether the motion is linear on each side of `v = 0`, so that closed forms hold.
    #[must_use]
    pub fn is_piecewise_linear(&self) -> bool {
        self.d2 == 0.0 && self.d3 == 0.0
    }

    /// Frequency of the linear oscillation, `sqrt(1 - D^2)`, where `abs(D) < 1`.
    #[must_use]
    pub fn omega(&self) -> Option<f64> {
        (self.d.abs() < 1.0).then(|| ((1.0 - self.d) * (1.0 + self.d)).sqrt())
    }
}

// The segment of equilibria that dry friction makes of the steady state (equation 10).

/// Whether a motion at this point rests forever: `v = 0` and `abs(q) <= r`.
pub fn rests(state: State, r: f64) -> bool {
    state.v == 0.0 && state.q.abs() <= r
}

// Energy `V = (q^2 + v^2)/2` and where it goes: one ledger for each term of the model.
//
// `V' = -2 D v^2 - D2 v^3 - D3 v^4 - r abs(v)`. The four integrals must add up to the change of `V`;
// what is missing is an error estimate that costs almost nothing.

/// Energy that a source supplied along a motion; negative if it took energy.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Work {
    /// Name of the source.
    pub source: &'static str,
    /// The energy.
    pub amount: f64,
    /// Whether the model has this source at all.
    pub acts: bool,
}

/// Where the energy of a motion comes from and goes, and what remains unaccounted for.
#[derive(Clone, Debug, Default, PartialEq)]
#[must_use]
pub struct Ledger {
    /// Energy at the start.
    pub start: f64,
    /// Energy at the end.
    pub end: f64,
    /// What each source did.
    pub works: Vec<Work>,
    /// `end - start` minus the sum of the works.
    pub residual: f64,
}

impl Ledger {
    /// The ledger of these works between two energies.
    pub fn new((start, end): (f64, f64), works: Vec<Work>) -> Self {
        let sum: f64 = works.iter().map(|work| work.amount).sum();
        Ledger { start, end, works, residual: (end - start) - sum }
    }

    /// The ledger of the works of the terms of equation (4): of `-2 D v`, `-D2 v^2` and `-D3 v^3`, and of dry friction,
    /// which is never positive.
    pub fn of_terms(parameters: &Parameters, energies: (f64, f64), works: [f64; 4]) -> Self {
        let Parameters { d, d2, d3, r } = *parameters;
        let terms = [("linear", d), ("quadratic", d2), ("cubic", d3), ("friction", r)];
        let work = |((source, factor), amount)| Work { source, amount, acts: factor != 0.0 };
        Ledger::new(energies, terms.into_iter().zip(works).map(work).collect())
    }

    /// The work of the source with this name; 0 if there is none.
    #[must_use]
    pub fn work(&self, source: &str) -> f64 {
        self.works.iter().find(|work| work.source == source).map_or(0.0, |work| work.amount)
    }

    /// What does not add up, as a fraction of all that was exchanged; by rounding alone some 1e-15.
    #[must_use]
    pub fn imbalance(&self) -> f64 {
        let exchanged: f64 = self.works.iter().map(|work| work.amount.abs()).sum();
        let size = self.start.abs() + self.end.abs() + exchanged;
        if size > 0.0 { self.residual / size } else { 0.0 }
    }

    /// The same in a unit in which 1 is this much.
    pub fn scaled(mut self, one: f64) -> Self {
        self.works.iter_mut().for_each(|work| work.amount *= one);
        Ledger {
            start: self.start * one,
            end: self.end * one,
            residual: self.residual * one,
            ..self
        }
    }
}

/// The energy `(q^2 + v^2)/2` of a state.
pub fn energy(state: State) -> f64 {
    0.5 * (state.q * state.q + state.v * state.v)
}
