//! What a mass on a belt does, in physical units: its cycles and margins, how far the Taylor expansion
//! and the model itself hold, and the same along a sweep of one quantity.
//!
//! The oscillator of the paper does not know the belt's speed: it leaves the model where the velocity of
//! the mass reaches it, because the mass then sticks to the belt. Every motion and cycle is held against
//! that line.

use serde::Serialize;

use super::cycle::{Cycles, cycles};
use super::escape::escape_point;
use super::fold::{FoldPoint, fold};
use super::margin::Margin;
use crate::flow::trajectory::trajectory;
use crate::flow::{Cost, Detail, Limits, Problem, Reason, Trajectory};
use crate::oscillator::belt::{BeltError, Quantity, Reduced, TaylorError, Units};
use crate::oscillator::{Belt, HalfPlane, Parameters, Side, State};

/// Velocities that a motion or a cycle reaches, and what the model leaves out there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reach {
    /// Smallest and largest velocity of the mass, in m/s; of a motion that reaches the belt, until then.
    pub velocity: (f64, f64),
    /// Smallest and largest displacement, in m; of a motion that reaches the belt, until then.
    pub displacement: (f64, f64),
    /// Where the speed of the belt is first reached; `None` where it is not.
    pub sticks: Option<Contact>,
    /// What the Taylor expansion of friction leaves out on the way; `None` where it cannot be measured.
    pub taylor: Option<TaylorError>,
}

/// Where a mass reaches the speed of the belt.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Contact {
    /// When, in s; 0 for a cycle.
    pub t: f64,
    /// At which displacement, in m; 0 for a cycle.
    pub x: f64,
}

/// What a mass on a belt does.
#[derive(Clone, Debug, PartialEq)]
pub struct Survey {
    /// The machine.
    pub belt: Belt,
    /// Its dimensionless form.
    pub reduced: Reduced,
    /// Its limit cycles, with the basin's edge and margins.
    pub cycles: Cycles,
    /// How far each cycle reaches.
    pub reaches: Vec<Reach>,
    /// The motion, dimensionless.
    pub motion: Trajectory,
    /// How far it reaches.
    pub reach: Reach,
    /// What it cost.
    pub cost: Cost,
}

impl Survey {
    /// The kicks that are survived, dimensionless.
    #[must_use]
    pub fn margin(&self) -> Margin {
        let none = Margin { displacement: None, impulse: None };
        self.cycles.picture.as_ref().map_or(none, |picture| picture.margin)
    }
}

/// A place where the model does not hold: where the mass would overtake the belt, because it sticks there,
/// and where the friction law promises a pull backward.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case", tag = "kind")]
pub enum Alarm {
    /// The motion reaches the belt's speed.
    Motion {
        /// Where.
        #[serde(flatten)]
        at: Contact,
    },
    /// A cycle is as fast as the belt, or faster.
    Cycle {
        /// Whether it is the stable one.
        stable: bool,
        /// Its largest velocity, in m/s.
        v_max: f64,
    },
    /// The friction law falls below 0 at velocities that occur.
    Law {
        /// The smallest coefficient of friction that occurs.
        mu: f64,
    },
    /// The smallest kick that is not survived is as fast as the belt, or faster.
    Kick {
        /// Its velocity, in m/s.
        velocity: f64,
    },
}

impl Survey {
    /// Everything that overtakes the belt, and friction that is none.
    #[must_use]
    pub fn alarms(&self) -> Vec<Alarm> {
        let motion = self.reach.sticks.map(|at| Alarm::Motion { at });
        let cycles = self.cycles.cycles.iter().zip(&self.reaches);
        let cycles = cycles.filter(|(_, reach)| reach.sticks.is_some());
        let cycles = cycles
            .map(|(cycle, reach)| Alarm::Cycle { stable: cycle.stable, v_max: reach.velocity.1 });
        let margin = PhysicalMargin::new(&self.margin(), &self.reduced.units);
        let kick = margin.velocity.filter(|velocity| *velocity >= self.belt.belt_speed);
        let kick = kick.map(|velocity| Alarm::Kick { velocity });
        let reaches = self.reaches.iter().chain([&self.reach]);
        let least = reaches.filter_map(|reach| reach.taylor).map(|taylor| taylor.least_mu);
        let law = least.reduce(f64::min).filter(|mu| *mu < 0.0).map(|mu| Alarm::Law { mu });
        motion.into_iter().chain(cycles).chain(kick).chain(law).collect()
    }
}

/// Margins in physical units; `None` where every kick is survived.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct PhysicalMargin {
    /// Smallest displacement from the static one, in m, from which the mass does not come to rest.
    pub displacement: Option<f64>,
    /// Smallest impulse, in N s, after which it does not.
    pub impulse: Option<f64>,
    /// The velocity that this impulse gives, in m/s.
    pub velocity: Option<f64>,
}

impl PhysicalMargin {
    /// A margin in these units.
    #[must_use]
    pub fn new(margin: &Margin, units: &Units) -> Self {
        PhysicalMargin {
            displacement: margin.displacement.map(|size| size * units.displacement),
            impulse: margin.impulse.map(|size| size * units.impulse),
            velocity: margin.impulse.map(|size| size * units.velocity),
        }
    }
}

/// Points of each integration step in which velocities are looked at.
const SAMPLES: usize = 8;

/// What the mass does; its motion starts at `start` (displacement in m, velocity in m/s) and is followed for
/// `until` seconds.
///
/// # Errors
/// The [`Reason`] why the search for cycles gave up.
pub fn survey(
    belt: &Belt,
    reduced: &Reduced,
    start: (f64, f64),
    until: f64,
    limits: &Limits,
) -> Result<Survey, Reason> {
    let Reduced { parameters, units, sticking_velocity, .. } = *reduced;
    let cycles = cycles(&parameters, true, limits)?;
    let problem = Problem {
        parameters,
        initial: State { q: start.0 / units.displacement, v: start.1 / units.velocity },
        until: until / units.time,
        ..Problem::default()
    };
    let detail = Detail { crossings: true, samples_per_step: SAMPLES, energy: false };
    let motion = trajectory(&problem, detail, limits);
    let followed = Followed::of(&motion, sticking_velocity);
    let scaled = |(low, high): (f64, f64), unit: f64| (low * unit, high * unit);
    let reach = |displacement, velocity, sticks: Option<(f64, f64)>| {
        let velocity = scaled(velocity, units.velocity);
        Reach {
            velocity,
            displacement: scaled(displacement, units.displacement),
            sticks: sticks
                .map(|(tau, q)| Contact { t: tau * units.time, x: q * units.displacement }),
            taylor: belt.taylor_error(velocity).filter(|error| error.force.is_finite()),
        }
    };
    let reaches = cycles.cycles.iter().map(|cycle| {
        let sticks = (cycle.v_max >= sticking_velocity).then_some((0.0, 0.0));
        reach((cycle.q_min, cycle.q_max), (cycle.v_min, cycle.v_max), sticks)
    });
    let mut cost = cycles.cost;
    cost += motion.cost;
    Ok(Survey {
        belt: belt.clone(),
        reduced: *reduced,
        reaches: reaches.collect(),
        reach: reach(followed.displacement, followed.velocity, followed.sticks),
        cycles,
        motion,
        cost,
    })
}

/// A motion until it first reaches a velocity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Followed {
    /// Smallest and largest velocity.
    pub velocity: (f64, f64),
    /// Smallest and largest displacement of the samples.
    pub displacement: (f64, f64),
    /// Time and displacement where the velocity is first reached; `None` where it is not.
    pub sticks: Option<(f64, f64)>,
}

impl Followed {
    /// Follows the samples of a motion; between two of them the velocity is the cubic with the values and
    /// accelerations at both, whose error is of fourth order in their small distance.
    #[must_use]
    pub fn of(motion: &Trajectory, sticking: f64) -> Self {
        let parameters = &motion.problem.parameters;
        let State { q, v } = motion.problem.initial;
        let mut found = Followed { velocity: (v, v), displacement: (q, q), sticks: None };
        if v >= sticking {
            found.sticks = Some((0.0, q));
            return found;
        }
        for pair in motion.samples.windows(2) {
            let (from, to) = (pair[0], pair[1]);
            let h = to.tau - from.tau;
            // Both ends of the pair belong to the half swing between them.
            let side = if from.v + to.v >= 0.0 { Side::Upper } else { Side::Lower };
            let slope = |q, v| h * acceleration(parameters, side, q, v);
            let curve = Hermite {
                ends: (from.v, to.v),
                slopes: (slope(from.q, from.v), slope(to.q, to.v)),
            };
            for peak in curve.peaks().into_iter().flatten().chain([1.0]) {
                let v = curve.at(peak);
                if v >= sticking {
                    let part = curve.first(sticking, peak);
                    let q = from.q + part * (to.q - from.q);
                    found.velocity.1 = sticking;
                    found.displacement = widened(found.displacement, q);
                    found.sticks = Some((from.tau + part * h, q));
                    return found;
                }
                found.velocity = widened(found.velocity, v);
            }
            found.displacement = widened(found.displacement, to.q);
        }
        found
    }
}

/// A range with a value in it.
fn widened((low, high): (f64, f64), value: f64) -> (f64, f64) {
    (low.min(value), high.max(value))
}

/// Acceleration on one side of `v = 0`, dry friction included.
fn acceleration(parameters: &Parameters, side: Side, q: f64, v: f64) -> f64 {
    let field = HalfPlane::new(parameters, side);
    side.sign() * field.acceleration(side.position(q, parameters.r), side.sign() * v)
}

/// A cubic on 0 .. 1 by values and slopes at both ends.
struct Hermite {
    ends: (f64, f64),
    slopes: (f64, f64),
}

impl Hermite {
    /// Coefficients of `t`, `t^2`, `t^3`.
    fn coefficients(&self) -> [f64; 3] {
        let rise = self.ends.1 - self.ends.0;
        let (a, b) = self.slopes;
        [a, 3.0 * rise - 2.0 * a - b, a + b - 2.0 * rise]
    }

    fn at(&self, t: f64) -> f64 {
        let [a, b, c] = self.coefficients();
        if t == 1.0 { self.ends.1 } else { self.ends.0 + t * (a + t * (b + t * c)) }
    }

    /// Where it has its extrema inside, in their order.
    fn peaks(&self) -> [Option<f64>; 2] {
        let [a, b, c] = self.coefficients();
        let root = (b * b - 3.0 * a * c).sqrt();
        // The quotient that does not cancel, and the other by the product of both roots.
        let sum = -(b + root.copysign(b));
        let (one, other) = (sum / (3.0 * c), a / sum);
        let inside = |t: f64| (t > 0.0 && t < 1.0).then_some(t);
        [inside(one.min(other)), inside(one.max(other))]
    }

    /// Where it first reaches `value` before `end`, at which it has.
    fn first(&self, value: f64, end: f64) -> f64 {
        let (mut low, mut high) = (0.0, end);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if self.at(middle) >= value { high = middle } else { low = middle }
        }
        high
    }
}

/// A point of a sweep.
#[derive(Clone, Debug, PartialEq)]
pub struct SweepPoint {
    /// Value of the quantity that varies, in SI units.
    pub value: f64,
    /// What was found there, or why nothing was.
    pub found: Result<SweepFound, BeltError>,
}

/// What was found at a point of a sweep.
#[derive(Clone, Debug, PartialEq)]
pub struct SweepFound {
    /// The dimensionless oscillator.
    pub reduced: Reduced,
    /// Its cycles, with the basin's edge and margins.
    pub cycles: Cycles,
    /// The fold `D_F` at these D2, D3 and r, where cycles fold.
    pub fold: Option<FoldPoint>,
    /// The escape point `D_c`, where a cycle escapes.
    pub escape: Option<f64>,
    /// Whether a cycle reaches the speed of the belt.
    pub sticks: bool,
}

/// Sweeps a quantity of a belt over `count` values, evenly spaced, both ends included.
///
/// # Errors
/// The [`Reason`] why a point could not be computed.
pub fn sweep(
    belt: &Belt,
    quantity: Quantity,
    range: (f64, f64),
    count: usize,
    limits: &Limits,
) -> Result<(Vec<SweepPoint>, Cost), Reason> {
    let mut cost = Cost::default();
    let mut point = |index: usize| {
        let value = super::basin::between(range, index, count);
        let mut here = belt.clone();
        here.set(quantity, value);
        let reduced = match here.reduce() {
            Ok(reduced) => reduced,
            Err(error) => return Ok(SweepPoint { value, found: Err(error) }),
        };
        let parameters = reduced.parameters;
        let cycles = cycles(&parameters, true, limits)?;
        let (fold, price) = fold(&parameters, limits)?;
        cost += cycles.cost;
        cost += price;
        let fastest = cycles.cycles.iter().map(|cycle| cycle.v_max).fold(0.0, f64::max);
        let found = SweepFound {
            sticks: fastest >= reduced.sticking_velocity,
            escape: escape_point(&parameters, limits)?,
            reduced,
            cycles,
            fold,
        };
        Ok(SweepPoint { value, found: Ok(found) })
    };
    let points = (0..count).map(&mut point).collect::<Result<_, _>>()?;
    Ok((points, cost))
}

#[cfg(test)]
mod tests;
