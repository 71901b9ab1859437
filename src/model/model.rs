//! The whole model of a mass on a moving belt: both switching lines, and friction by its own law.
//!
//! `m x'' + d1 x' + d3 x'^3 + c (x + x0) = T - G` with the pull of the belt
//! `T in F mu(abs(w)) sgn(w)`, `w = v0 - x'`, up to `F mu_s` where the mass sticks to the belt, and the
//! friction `G in R sgn(x')` of the guide, up to `R_static` where the mass rests. `x` counts from the
//! steady displacement `x0 = F mu(v0)/c`.
//!
//! Inside this module time is counted in `1/omega_0` and forces are divided by c, so that displacement x,
//! velocity y and force all are lengths in metres, and `x' = y`, `y' = -(x + offset) + h(y)` in each phase.
//! No length is singled out: a machine with all its lengths scaled by a power of two moves alike to the last
//! bit.

use super::{
    Belt, ForceBranch, ForcePiece, Mode, Parameters, Reason, Result, branch, first_below_zero,
};
use crate::numerics::{powi, value};

/// The last terms of a step are this small against the state where nothing else is asked for.
pub const FINEST: f64 = 1e-17;

/// The state of contact at a point of the phase plane.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ContactState {
    /// It slips in this phase.
    Slips(Phase),
    /// It rides on the belt.
    Sticks,
    /// It rests, held by the guide.
    Rests,
}

/// What the mass does on one side of the switching lines.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Phase {
    /// `y < 0`: it moves against the belt.
    Below,
    /// `0 < y < speed`: it moves with the belt, more slowly.
    Between,
    /// `y > speed`: it overtakes the belt.
    Above,
}

impl Phase {
    /// The sign of the velocity.
    #[must_use]
    pub fn sign(self) -> f64 {
        if self == Phase::Below { -1.0 } else { 1.0 }
    }
}

/// Displacements on the belt's line `y = speed` at which something changes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lines {
    /// The belt holds the mass up to here; it is released here.
    pub release: f64,
    /// The only place where a motion below the belt's speed touches the line tangentially.
    pub fold: f64,
    /// The belt holds the mass down to here.
    pub low: f64,
}

/// The whole model of a machine.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Model {
    /// Natural frequency, in 1/s.
    pub omega_0: f64,
    /// Mass, in kg.
    pub mass: f64,
    /// Stiffness, in N/m.
    pub stiffness: f64,
    /// Speed of the belt, exactly that of the belt in m/s divided by the natural frequency; infinite where there is none.
    pub speed: f64,
    /// Friction of the guide while the mass moves.
    pub guide: f64,
    /// Friction of the guide at rest.
    pub guide_static: f64,
    /// The pull of the belt at the steady position, `x0`.
    pub pull: f64,
    /// The belt's line; `None` where the law says nothing about small slips.
    pub lines: Option<Lines>,
    /// Linear damping at rest: `h(y) = -damping y + ..`; 2 D of the paper.
    pub damping: f64,
    /// Size of the last terms of each Taylor step, relative to the state.
    pub tolerance: f64,
    pub(crate) slower: ForceBranch,
    pub(crate) faster: ForceBranch,
    /// The damper alone: coefficients of 1, y, y^2, ..
    damper: Vec<f64>,
}

impl Model {
    /// The whole model of a mass on a belt.
    ///
    /// # Errors
    /// [`Reason`] where the law, the static friction or the numbers allow none.
    pub fn new(belt: &Belt) -> Result<Self> {
        let v0 = belt.belt_speed;
        let mu = belt.law.mu(v0).ok_or(Reason::OutsideLaw { v0, range: belt.law.range() })?;
        if !(mu.is_finite() && mu > 0.0) {
            return Err(Reason::NoFriction { v0, mu });
        }
        let omega_0 = (belt.stiffness / belt.mass).sqrt();
        let per_stiffness = 1.0 / belt.stiffness;
        let force = belt.normal_force * per_stiffness;
        let damper = vec![
            0.0,
            belt.damping * omega_0 * per_stiffness,
            0.0,
            belt.cubic_damping * powi(omega_0, 3) * per_stiffness,
        ];
        let speed = v0 / omega_0;
        let parts = belt.law.parts();
        let law = parts.scaled(force, omega_0);
        let pull = force * mu;
        let (moving, at_rest) = (belt.friction, belt.static_guide.unwrap_or(belt.friction));
        let reach = belt.law.range().1.min(first_below_zero(&parts)) / omega_0;
        let side = |above| branch(&law, &damper, speed, pull, reach, above);
        let mut model = Model {
            omega_0,
            mass: belt.mass,
            stiffness: belt.stiffness,
            speed,
            guide: moving * per_stiffness,
            guide_static: at_rest * per_stiffness,
            pull,
            tolerance: FINEST,
            slower: side(false),
            faster: side(true),
            damper,
            ..Model::default()
        };
        if model.guide_static < model.guide {
            return Err(Reason::GuideStatic { at_rest, moving });
        }
        model.damping = -model.slower.at(0.0).1;
        if let Some(mu_rest) = belt.law.mu(0.0) {
            let mu_s = belt.static_coefficient.unwrap_or(mu_rest);
            if mu_s < mu_rest {
                return Err(Reason::StaticBelowKinetic { mu_s, mu: mu_rest });
            }
            let fold = model.slower.at(speed).0 - model.guide;
            let (excess, both) = (force * (mu_s - mu_rest), force * (mu_s + mu_rest));
            model.lines = Some(Lines { release: fold + excess, fold, low: fold - both });
        }
        let numbers = [omega_0, speed, pull, model.guide, model.guide_static, model.damping];
        if numbers.iter().all(|number| number.is_finite()) && speed > 0.0 {
            Ok(model)
        } else {
            Err(Reason::OutOfRange)
        }
    }

    /// The oscillator of the paper, with a mass and a stiffness of one.
    ///
    /// # Errors
    /// [`Reason`] where the numbers allow none.
    pub fn of_paper(parameters: &Parameters) -> Result<Self> {
        let Parameters { d, d2, d3, r } = *parameters;
        Model::of_mode(1.0, 1.0, &[d, 0.5 * d2, 0.5 * d3], r, r)
    }

    /// A vibration mode without a belt: natural frequency in 1/s, modal mass in kg, damping ratio as a
    /// polynomial in the velocity (coefficients of 1, v, v^2, .. in SI units), and the friction of the guide
    /// in N.
    ///
    /// # Errors
    /// [`Reason`] where the static friction or the numbers allow none.
    pub fn of_mode(
        omega_0: f64,
        mass: f64,
        damping_ratio: &[f64],
        moving: f64,
        at_rest: f64,
    ) -> Result<Self> {
        if at_rest < moving {
            return Err(Reason::GuideStatic { at_rest, moving });
        }
        let stiffness = mass * omega_0 * omega_0;
        let ratio = |(k, number): (i32, &f64)| 2.0 * number * powi(omega_0, k);
        let ratios = (0..).zip(damping_ratio).map(ratio);
        let damper: Vec<f64> = [0.0].into_iter().chain(ratios).collect();
        let coefficients = damper.iter().map(|number| 0.0 - number).collect();
        let (low, high) = (f64::NEG_INFINITY, f64::INFINITY);
        let model = Model {
            omega_0,
            mass,
            stiffness,
            speed: f64::INFINITY,
            guide: moving / stiffness,
            guide_static: at_rest / stiffness,
            damping: *damper.get(1).unwrap_or(&0.0),
            tolerance: FINEST,
            slower: ForceBranch {
                pieces: vec![ForcePiece { low, high, center: 0.0, coefficients, falls: false }],
                fall: None,
            },
            damper,
            ..Model::default()
        };
        let finite = model.damper.iter().all(|number| number.is_finite());
        if finite && stiffness.is_finite() && stiffness > 0.0 {
            Ok(model)
        } else {
            Err(Reason::OutOfRange)
        }
    }

    /// The parameters of the paper's oscillator that this is, with displacements in m and times in `1/omega_0`; `None`
    /// with a belt, or with damping of a higher power than the third.
    #[must_use]
    pub fn parameters(&self) -> Option<Parameters> {
        let power = |power: usize| *self.damper.get(power).unwrap_or(&0.0);
        let higher = self.damper.iter().skip(4).any(|number| *number != 0.0);
        let parameters =
            Parameters { d: 0.5 * power(1), d2: power(2), d3: power(3), r: self.guide };
        (self.speed.is_infinite() && !higher).then_some(parameters)
    }

    /// The force that depends on velocity, and its derivative.
    #[must_use]
    pub fn force(&self, phase: Phase, y: f64) -> (f64, f64) {
        self.side(phase).at(y)
    }

    pub(crate) fn side(&self, phase: Phase) -> &ForceBranch {
        if phase == Phase::Above {
            &self.faster
        } else {
            &self.slower
        }
    }

    /// Where the spring's pull and the constant forces of a phase balance, with the sign reversed.
    pub(crate) fn offset(&self, phase: Phase) -> f64 {
        match phase {
            Phase::Below => -self.guide,
            Phase::Between => self.guide,
            Phase::Above => self.guide + self.pull,
        }
    }

    /// The velocities that belong to a phase.
    pub(crate) fn range(&self, phase: Phase) -> (f64, f64) {
        match phase {
            Phase::Below => (f64::NEG_INFINITY, 0.0),
            Phase::Between => (0.0, self.speed),
            Phase::Above => (self.speed, f64::INFINITY),
        }
    }

    /// The state of contact at displacement `x` and velocity `y` (divided by the natural frequency).
    pub fn place(&self, x: f64, y: f64) -> ContactState {
        if y == 0.0 && self.rests_at(x) {
            return ContactState::Rests;
        }
        let on_belt = self.lines.filter(|_| y == self.speed);
        let phase = match on_belt {
            Some(lines) if x > lines.release => Phase::Between,
            Some(lines) if x < lines.low => Phase::Above,
            Some(_) => return ContactState::Sticks,
            None if y > self.speed => Phase::Above,
            None if y < 0.0 || (y == 0.0 && x > 0.0) => Phase::Below,
            None => Phase::Between,
        };
        ContactState::Slips(phase)
    }

    /// The length, in m, for which 1 stands in drawings: `x0` as in the paper; without a belt 1 m.
    #[must_use]
    pub fn drawing_length(&self) -> f64 {
        if self.pull > 0.0 { self.pull } else { 1.0 }
    }

    /// The damper's force at a velocity.
    pub(crate) fn damper(&self, y: f64) -> f64 {
        value(&self.damper, y)
    }

    /// The smallest velocity for which the friction law says something.
    pub(crate) fn least_velocity(&self) -> f64 {
        self.slower.pieces.first().map_or(0.0, |piece| piece.low)
    }

    /// Whether the friction law ends at some slip, or falls below zero there.
    pub(crate) fn law_ends(&self) -> bool {
        /// Beyond this, in m, a law is said to be known for every slip.
        const ENDLESS: f64 = 1e200;
        -self.least_velocity() < ENDLESS
    }

    /// Whether the guide holds more at rest than while the mass moves.
    pub(crate) fn holds_more_at_rest(&self) -> bool {
        self.guide_static > self.guide
    }

    /// Whether the guide holds the mass at a displacement.
    #[must_use]
    pub fn rests_at(&self, x: f64) -> bool {
        x.abs() <= self.guide_static
    }
}

impl Mode {
    /// Its whole model.
    ///
    /// # Errors
    /// [`Reason`] where the static friction or the numbers allow none.
    pub fn model(&self) -> Result<Model> {
        let omega_0 = std::f64::consts::TAU * self.frequency;
        let at_rest = self.static_guide.unwrap_or(self.friction);
        Model::of_mode(omega_0, self.mass, &self.damping_ratio, self.friction, at_rest)
    }
}
