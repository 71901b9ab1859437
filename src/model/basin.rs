//! What is said of a basin of rest, found or proved: what borders it, and the kicks that are survived.

use serde::{Serialize, Serializer};

use super::Reason;

/// What borders the basin of rest.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Border {
    /// Nothing: everything comes to rest.
    #[default]
    None,
    /// An unstable limit cycle.
    Cycle,
    /// A motion that separates rest from escape.
    Separatrix,
    /// An orbit that touches the belt's line, with a piece of that line.
    Grazing,
    /// The motion that just reaches the end of what the guide holds.
    Capture,
    /// Nothing, because rest itself repels.
    NoBasin,
    /// Not known: what could be followed comes to rest.
    Unknown(Reason),
}

impl Serialize for Border {
    fn serialize<S: Serializer>(&self, out: S) -> Result<S::Ok, S::Error> {
        out.serialize_str(self.name())
    }
}

impl Border {
    /// One word, the same for all that a guide or a belt holds, and one where no border was met.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Border::None | Border::Unknown(_) => "none",
            Border::Cycle => "cycle",
            Border::Separatrix => "separatrix",
            Border::Grazing | Border::Capture => "grazing",
            Border::NoBasin => "no-basin",
        }
    }

    /// Whether an orbit that is no cycle borders the basin.
    #[must_use]
    pub fn parts_without_cycle(self) -> bool {
        matches!(self, Border::Separatrix | Border::Grazing | Border::Capture)
    }
}

/// What is known of each of the smallest kicks that are not captured.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Kicks<T> {
    /// Of the smallest `abs(q)` at `v = 0`.
    pub displacement: T,
    /// Of the smallest `abs(v)` at `q = 0`.
    pub impulse: T,
    /// Of the smallest kicks out of rest.
    pub from_rest: RestKicks<T>,
}

/// What is known of the smallest kicks that are not captured if the mass rests where they do most, anywhere in
/// `-r .. r`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct RestKicks<T> {
    /// Of the change of position.
    pub displacement: T,
    /// Of the velocity.
    pub impulse: T,
}

/// The sizes of the kicks; `None` where every kick is survived.
pub type Margin = Kicks<Option<f64>>;

/// The sizes of the kicks out of rest; `None` where every kick is survived.
pub type RestMargin = RestKicks<Option<f64>>;

impl<T> Kicks<T> {
    /// What follows from each kick of margins, which a function picks.
    pub fn of(told: impl Fn(fn(&Margin) -> Option<f64>) -> T) -> Self {
        Kicks {
            displacement: told(|it| it.displacement),
            impulse: told(|it| it.impulse),
            from_rest: RestKicks {
                displacement: told(|it| it.from_rest.displacement),
                impulse: told(|it| it.from_rest.impulse),
            },
        }
    }

    /// That of the displacement and of the impulse, and of those from rest.
    pub fn all(&self) -> [&T; 4] {
        let RestKicks { displacement, impulse } = &self.from_rest;
        [&self.displacement, &self.impulse, displacement, impulse]
    }

    /// What follows from that of the displacements, and from that of the impulses.
    pub fn each<U>(&self, displacement: impl Fn(&T) -> U, impulse: impl Fn(&T) -> U) -> Kicks<U> {
        Kicks {
            displacement: displacement(&self.displacement),
            impulse: impulse(&self.impulse),
            from_rest: RestKicks {
                displacement: displacement(&self.from_rest.displacement),
                impulse: impulse(&self.from_rest.impulse),
            },
        }
    }
}

/// The regime of a margin of which it is not known how large it is.
pub const UNKNOWN: &str = "unknown";

impl Margin {
    /// Every kick is survived.
    pub const ENDLESS: Margin = Margin::same(None);

    /// No kick is survived.
    pub const ZERO: Margin = Margin::same(Some(0.0));

    const fn same(size: Option<f64>) -> Self {
        let from_rest = RestMargin { displacement: size, impulse: size };
        Margin { displacement: size, impulse: size, from_rest }
    }

    /// How a margin within this border is to be read: `finite`; `every kick survived`, where it has no size; `no rest`, where
    /// it is 0 because rest repels; or `unknown`, where every kick within it is survived and larger ones are not known.
    #[must_use]
    pub fn regime(&self, border: Border) -> &'static str {
        match border {
            Border::Unknown(_) => UNKNOWN,
            _ if *self == Margin::ZERO => "no rest",
            _ if *self == Margin::ENDLESS => "every kick survived",
            _ => "finite",
        }
    }

    /// The margin with functions of its displacements and of its impulses in their place: in other units, or
    /// rounded.
    #[must_use]
    pub fn map(&self, displacement: impl Fn(f64) -> f64, impulse: impl Fn(f64) -> f64) -> Self {
        self.each(|size| size.map(&displacement), |size| size.map(&impulse))
    }
}

/// How far kicks out of the steady position may go in each direction so that the motion comes back to rest.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Reach {
    /// Displacements to the right and to the left.
    pub displacement: (f64, f64),
    /// Velocities upwards and downwards; on a belt, with it and against it.
    pub velocity: (f64, f64),
}
