//! Why there is no answer.

use thiserror::Error;

use super::RangeError;

/// Why a computation has no answer, with the numbers that explain it.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
pub enum Reason {
    /// A newer question replaced this one.
    #[error("interrupted")]
    Interrupted,
    /// The budget of evaluations is spent.
    #[error("budget of {evaluations} evaluations spent")]
    Budget {
        /// Evaluations spent.
        evaluations: u64,
    },
    /// The step that the tolerance requires is too small to advance the time.
    #[error("step {step:.1e} is too small to move the time")]
    StepTooSmall {
        /// Size of that step.
        step: f64,
    },
    /// The fixed step is too long for the damping that the motion encounters.
    #[error("step {step:.1e} is unstable here; at most {stable:.1e} would do")]
    StepTooLong {
        /// The step.
        step: f64,
        /// The longest step that is stable there.
        stable: f64,
    },
    /// The motion has more half swings than are kept.
    #[error("the motion has more than {most} half swings; ask for a shorter time")]
    HalfSwings {
        /// How many are.
        most: usize,
    },
    /// A number left the floating-point range.
    #[error("left the range of floating-point numbers")]
    OutOfRange,
    /// The method does not apply to these parameters.
    #[error("the method needs {needs}")]
    NotApplicable {
        /// What the method requires.
        needs: &'static str,
    },
    /// An iteration did not converge.
    #[error("{sought} did not settle (last relative change {change:.1e})")]
    NoConvergence {
        /// The quantity sought.
        sought: &'static str,
        /// Relative change at which the iteration stopped.
        change: f64,
    },
    /// The motion runs away.
    #[error("the motion grows without bound")]
    Escapes,
    /// The motion comes to rest at the balance of its phase without another turn.
    #[error("the motion turns no more")]
    Settles,
    /// The motion takes too many steps to its next turn.
    #[error(
        "the motion takes too many steps to turn: at the velocities that it reaches its damping is many times the \
         critical one; less damping, or a smaller start, can be followed"
    )]
    Steps,
    /// The slip leaves the velocities for which the friction law is known and not negative.
    #[error(
        "motions of this machine slip by more than {slip:.6} m/s, where the friction law ends or its coefficient falls \
         below 0; it must be known and not negative there"
    )]
    BeyondLaw {
        /// The slip, in m/s.
        slip: f64,
    },
    /// The friction law does not reach the belt's speed.
    #[error(
        "v0 = {v0} m/s is outside the friction law; it reaches from {} to {} m/s",
        .range.0,
        .range.1
    )]
    OutsideLaw {
        /// Speed of the belt, in m/s.
        v0: f64,
        /// Where the law reaches, in m/s.
        range: (f64, f64),
    },
    /// The coefficient of friction at the belt's speed is not positive, or has no three derivatives.
    #[error("{}", no_friction(*.v0, *.mu))]
    NoFriction {
        /// Speed of the belt, in m/s.
        v0: f64,
        /// The coefficient.
        mu: f64,
    },
    /// The static coefficient is below the kinetic one at small slip.
    #[error(
        "mu_s = {mu_s} is below the coefficient {mu} of the law at rest; static friction is at least that"
    )]
    StaticBelowKinetic {
        /// The static coefficient.
        mu_s: f64,
        /// The coefficient at vanishing slip.
        mu: f64,
    },
    /// The guide's static friction is below its kinetic one.
    #[error(
        "R_static = {at_rest} N is below R = {moving} N; static friction is at least the kinetic one"
    )]
    GuideStatic {
        /// `R_static`, in N.
        at_rest: f64,
        /// R, in N.
        moving: f64,
    },
    /// A number that follows from others is beyond its range.
    #[error(transparent)]
    Refused(RangeError),
    /// The branch of N harmonics that begins at a first-order answer could not be followed.
    #[error(
        "no cycle of {count} harmonics: the first-order answer was lost at {:.0} % of the damping and friction",
        100.0 * .strength
    )]
    Harmonics {
        /// Number of harmonics.
        count: usize,
        /// Part of damping and friction up to which it was followed.
        strength: f64,
    },
}

/// What was computed, or why there is no answer.
pub type Result<T, E = Reason> = std::result::Result<T, E>;

impl serde::Serialize for Reason {
    fn serialize<S: serde::Serializer>(&self, out: S) -> Result<S::Ok, S::Error> {
        out.collect_str(self)
    }
}

impl Reason {
    /// What came of an attempt that may fail: only an interruption ends whatever it was for.
    ///
    /// # Errors
    /// [`Reason::Interrupted`], and no other.
    pub fn tolerated<T>(attempt: Result<T, Reason>) -> Result<Result<T, Reason>, Reason> {
        match attempt {
            Err(Reason::Interrupted) => Err(Reason::Interrupted),
            attempt => Ok(attempt),
        }
    }

    /// Whether a machine itself is at fault, and not what it takes to compute its motions.
    #[must_use]
    pub fn is_of_the_machine(&self) -> bool {
        !matches!(self, Reason::Steps | Reason::Settles | Reason::Escapes)
    }
}

/// Why there is no friction at the belt's speed v0.
fn no_friction(v0: f64, mu: f64) -> String {
    if mu.is_finite() && mu > 0.0 {
        format!("the friction law has no three derivatives at v0 = {v0} m/s")
    } else {
        format!(
            "mu = {mu} at v0 = {v0} m/s; it must be positive: x0 = F mu(v0)/c is the unit of length"
        )
    }
}
