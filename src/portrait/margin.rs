//! The kicks that are survived.

use serde::Serialize;

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

impl RestMargin {
    /// The margin with functions of its displacement and of its impulse in their place.
    #[must_use]
    pub fn map(
        &self,
        displacement: impl Fn(f64) -> f64,
        impulse: impl Fn(f64) -> f64,
    ) -> RestMargin {
        RestMargin {
            displacement: self.displacement.map(displacement),
            impulse: self.impulse.map(impulse),
        }
    }
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
            from_rest: self.from_rest.map(displacement, impulse),
        }
    }

    /// No kick is survived.
    pub const ZERO: Margin = Margin {
        displacement: Some(0.0),
        impulse: Some(0.0),
        from_rest: RestMargin { displacement: Some(0.0), impulse: Some(0.0) },
    };
}

/// How far kicks out of the steady position may go in each direction so that the motion comes back to rest.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Reach {
    /// Displacements to the right and to the left.
    pub displacement: (f64, f64),
    /// Velocities upwards and downwards; on a belt, with it and against it.
    pub velocity: (f64, f64),
}

impl Reach {
    /// The margin of this mass, with what it is from rest.
    #[must_use]
    pub fn margin(&self, mass: f64, from_rest: RestMargin) -> Margin {
        let finite = |kick: f64| Some(kick).filter(|kick| kick.is_finite());
        Margin {
            displacement: finite(self.displacement.0.min(self.displacement.1)),
            impulse: finite(mass * self.velocity.0.min(self.velocity.1)),
            from_rest,
        }
    }
}
