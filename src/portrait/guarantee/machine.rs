//! Kicks that a machine survives for certain: at all values of its numbers within their tolerances, whatever a
//! bounded force does.
//!
//! In `y dy/dx = h(y) - x - (friction) + u` with lengths for forces, every machine of the tolerances has its own
//! h and friction. A *worst* machine is one that drives the mass harder at every velocity: `h + e` along the
//! motion at least as large as that of any other, and friction less by the disturbance. An addition e along the
//! motion is friction less by e. So where the border of its basin lies below the belts' lines it bounds all
//! others, by the comparison that proves [`crate::portrait::guarantee::oscillator`]. Smaller damping and friction are worst at
//! every velocity, and need no addition; with these alone the border may touch the belt's line, where the worst
//! machine is held longest.

use nalgebra::{DMatrix, DVectorView};

use crate::flow::{Reason, Result};
use crate::model::{Belt, Knob, MONOTONE, Model, Phase, Tolerances, set};
use crate::numerics::{by_number, real, try_bisect};
use crate::portrait::{Guarantee, NoGuarantee, Portrait};

/// The portrait of a machine whose basin lies within those of all others, and the kicks, in m and N s, that every one
/// survives for certain; or why there is none. Fails with [`Reason`] where a machine within the tolerances has no model,
/// or one that bounds them has no portrait.
pub fn guaranteed(belt: &Belt, known: &Tolerances) -> Result<Guarantee> {
    let Some(corners) = Corners::new(belt, known)? else { return Ok(Err(NoGuarantee::TooMany)) };
    let least = corners.friction;
    if least < 0.0 || known.disturbance > 0.0 && least == 0.0 {
        let (disturbance, friction) = (known.disturbance, corners.belts[0].friction);
        return Ok(Err(NoGuarantee::Disturbance { disturbance, friction, unit: " N" }));
    }
    let found = if corners.belts.len() == 1 {
        Ok(Portrait::of_belt(&corners.worst(0, 0.0))?)
    } else {
        corners.bounded(belt)?
    };
    Ok(found.map(|portrait| {
        // An impulse less than the smallest `m omega_0` times a velocity starts no machine faster.
        let lightest = corners.least(|it| it.mass * it.omega_0) / portrait.model.omega_0;
        let margin = portrait.margin_within(corners.farthest_rest(), lightest);
        (portrait, margin)
    }))
}

/// A portrait whose basin of rest is bordered by a cycle of slip, and the velocities along it, divided by the natural
/// frequency.
type SlipBorder = (Portrait, (f64, f64));

/// The velocities along the border of the basin, if it is a cycle of slip; divided by the natural frequency.
fn slip_border(portrait: &Portrait) -> Option<(f64, f64)> {
    let cycle = portrait.bordering_cycle()?;
    let [slowest, fastest] = [cycle.v_min, cycle.v_max].map(|v| v / portrait.model.omega_0);
    (!cycle.sticks() && !cycle.overtakes).then_some((slowest, fastest))
}

// The machines that all others within the tolerances lie between.

/// Maximum number of other numbers that may be uncertain together.
pub const MOST: usize = 5;

/// The machines that all others lie between, each with the smallest damping and friction: three values of
/// each further number that is uncertain.
struct Corners {
    /// The machines; those next to each other in number k are `3^k` apart.
    belts: Vec<Belt>,
    models: Vec<Model>,
    /// What the disturbance leaves of the guide's smallest friction, in N.
    friction: f64,
    /// The same at rest.
    at_rest: f64,
    /// By how much more than the smallest static friction a mass at rest may be pushed, in N: by the disturbance, and by
    /// what static friction is uncertain.
    pushed: f64,
}

impl Corners {
    /// The corners of a machine's tolerances, unless more than [`MOST`] of its other numbers are uncertain. Fails with
    /// [`Reason`] where one of them has no model.
    fn new(belt: &Belt, known: &Tolerances) -> Result<Option<Self>> {
        let uncertain = known.intervals(belt).into_iter();
        let (monotone, others): (Vec<_>, Vec<_>) =
            uncertain.partition(|(varied, _)| MONOTONE.contains(varied));
        if others.len() > MOST {
            return Ok(None);
        }
        let with = |mut belt: Belt, varied: Knob, value: f64| {
            set(&mut belt, varied, value);
            belt
        };
        let worst = monotone
            .into_iter()
            .fold(belt.clone(), |worst, (varied, interval)| with(worst, varied, interval.lower()));
        let (moving, at_rest) = (worst.friction, worst.static_guide);
        let mut belts = vec![worst];
        for (varied, interval) in others {
            let values = [interval.lower(), interval.middle(), interval.upper()].into_iter();
            let at = |value: f64| belts.iter().map(move |it| with(it.clone(), varied, value));
            belts = values.flat_map(at).collect();
        }
        let left = |force: f64| {
            let left = force - known.disturbance;
            if known.disturbance > 0.0 {
                left.next_down()
            } else {
                left
            }
        };
        let holds = known.interval(Knob::StaticGuide, belt);
        Ok(Some(Corners {
            models: belts.iter().map(Model::new).collect::<Result<_, _>>()?,
            belts,
            friction: left(moving),
            at_rest: left(at_rest.unwrap_or(moving)),
            pushed: holds.map_or(0.0, |it| it.upper() - it.lower()) + known.disturbance,
        }))
    }

    /// How far out one of the machines may rest before a kick, in m: pushed there by the disturbance, and held by
    /// the largest static friction; by the smallest if it is that of the moving mass, because the gap to the border
    /// only grows with friction.
    fn farthest_rest(&self) -> f64 {
        let held = self.most(|model| model.guide_static);
        let softest = self.least(|model| model.stiffness);
        if self.pushed > 0.0 {
            (held + self.pushed / softest).next_up()
        } else {
            held
        }
    }

    /// The machine at a corner with the least friction of all, and less by `less` (a length).
    fn worst(&self, corner: usize, less: f64) -> Belt {
        let belt = &self.belts[corner];
        let scale = belt.stiffness / self.stiffest();
        let friction = self.friction * scale - less * belt.stiffness;
        let at_rest = (self.at_rest * scale).max(friction);
        Belt { friction, static_guide: Some(at_rest), ..belt.clone() }
    }

    /// The largest stiffness, in N/m.
    fn stiffest(&self) -> f64 {
        self.most(|model| model.stiffness)
    }

    /// The least of a number of the machines.
    fn least(&self, number: fn(&Model) -> f64) -> f64 {
        self.models.iter().map(number).fold(f64::INFINITY, f64::min)
    }

    /// The largest of a number of the machines.
    fn most(&self, number: fn(&Model) -> f64) -> f64 {
        self.models.iter().map(number).fold(0.0, f64::max)
    }

    /// The corner whose forces need the smallest addition to drive the mass harder than those of any machine
    /// at velocities in `low .. high`, and that addition, as a length.
    ///
    /// Between the corners and between the velocities forces are taken to bend by no more than twice what
    /// their second differences say.
    fn bound(&self, low: f64, high: f64) -> (usize, f64) {
        const VELOCITIES: usize = 200;
        let sides = [(Phase::Below, low), (Phase::Between, high)];
        // The forces along the motion, at velocities of both signs: a row for each, a column for each corner.
        let corners = self.models.len();
        let forces = DMatrix::from_fn(2 * (VELOCITIES + 1), corners, |place, corner| {
            let (phase, end) = sides[place / (VELOCITIES + 1)];
            let y = end * real(place % (VELOCITIES + 1)) / real(VELOCITIES);
            phase.sign() * self.models[corner].force(phase, y).0
        });
        let bound =
            |place: usize| forces.row(place).max() + self.bend(|corner| forces[(place, corner)]);
        let most: Vec<f64> = (0..forces.nrows()).map(bound).collect();
        let needed = |(corner, own): (usize, DVectorView<f64>)| {
            let excess: Vec<f64> = most.iter().zip(&own).map(|(most, own)| most - own).collect();
            let halves = excess.chunks(VELOCITIES + 1);
            let bend = halves.flat_map(|half| half.windows(3)).map(bent).fold(0.0, f64::max);
            (corner, excess.iter().copied().fold(0.0, f64::max) + 0.25 * bend)
        };
        let needed = forces.column_iter().enumerate().map(needed);
        needed.min_by(by_number(|(_, addition): &(usize, f64)| *addition)).unwrap_or((0, 0.0))
    }

    /// A bound on how far a smooth function rises between corners above its values there.
    fn bend(&self, at: impl Fn(usize) -> f64) -> f64 {
        (0..self.models.len().ilog(3))
            .map(|number| {
                let apart = 3_usize.pow(number);
                let first = (0..self.models.len()).filter(|corner| corner / apart % 3 == 0);
                let bends = first.map(|low| bent(&[at(low), at(low + apart), at(low + 2 * apart)]));
                0.25 * bends.fold(0.0, f64::max)
            })
            .sum()
    }

    /// A machine whose border bounds all others at its own velocities.
    fn bounded(&self, belt: &Belt) -> Result<Result<Portrait, NoGuarantee>> {
        /// Ranges of velocities that are tried, each larger than the border of the one before.
        const ROUNDS: usize = 8;
        const ROOM: f64 = 1.2;
        let slowest = self.least(|model| model.speed);
        let middle = slip_border(&Portrait::of_belt(belt)?).unwrap_or((-slowest, slowest));
        let mut range = (ROOM * middle.0, (ROOM * middle.1).min(slowest));
        for _ in 0..ROUNDS {
            if self.models.iter().any(|model| model.least_velocity() > range.0) {
                return Ok(Err(NoGuarantee::OutsideLaw));
            }
            let (corner, less) = self.bound(range.0, range.1);
            if less * self.stiffest() >= self.friction {
                return Ok(Err(NoGuarantee::Tolerances));
            }
            let Some((portrait, (low, high))) = self.below_the_line(corner, less)? else {
                return Ok(Err(NoGuarantee::Unbounded));
            };
            if low >= range.0 && high <= range.1 {
                return Ok(Ok(portrait));
            }
            range = (range.0.min(ROOM * low), range.1.max(ROOM * high).min(slowest));
        }
        Ok(Err(NoGuarantee::Unbounded))
    }

    /// The portrait of a worst machine whose border stays below the line of every belt, with as much friction
    /// as that allows, and the velocities along the border.
    fn below_the_line(&self, corner: usize, less: f64) -> Result<Option<SlipBorder>> {
        const HALVINGS: u32 = 24;
        let slowest = self.least(|model| model.speed);
        let at = |less: f64| -> Result<Option<SlipBorder>> {
            let portrait = Portrait::of_belt(&self.worst(corner, less))?;
            let border = slip_border(&portrait).filter(|(_, high)| *high < slowest);
            Ok(border.map(|velocities| (portrait, velocities)))
        };
        if let Some(found) = at(less)? {
            return Ok(Some(found));
        }
        let mut best = None;
        try_bisect(less, self.friction / self.stiffest(), HALVINGS, |less| {
            let found = at(less)?;
            let holds = found.is_some();
            best = found.or_else(|| best.take());
            Ok::<_, Reason>(holds)
        })?;
        Ok(best)
    }
}

/// The second difference of three numbers; zero where it is rounding.
fn bent(three: &[f64]) -> f64 {
    const ROUNDING: f64 = 16.0 * f64::EPSILON;
    let bend = (three[0] - 2.0 * three[1] + three[2]).abs();
    let size = three.iter().map(|value| value.abs()).fold(0.0, f64::max);
    if bend <= ROUNDING * size { 0.0 } else { bend }
}
