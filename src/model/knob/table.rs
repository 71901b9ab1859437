//! The one table of every number that can be set.
//!
//! A number is a row of [`KNOBS`]: what it is called, its unit, its range, its default and first step, and, of a
//! machine or a mode, where it stands; of a motion see `Problem::own` and `Parameters::part`. The pane, the command
//! line, the files of scenes, machines and sessions, scans, charts and all that is said about a wrong value read it.

use crate::model::{Belt, FrictionLaw, Mode};

/// What a number belongs to. Names are different within a group, and within [`Group::SOURCE`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Group {
    /// The dimensionless motion: parameters and start.
    Motion,
    /// A mass on a belt, without its friction law.
    Machine,
    /// Static friction, and the numbers of friction laws.
    Law,
    /// The points of a friction law.
    Table,
    /// A vibration mode.
    Mode,
    /// What only a recorded motion has.
    Record,
    /// The start of a motion of a machine or a mode, how long it is followed, and what disturbs it.
    Course,
    /// How long a dimensionless motion is followed, what disturbs it, and how exactly it is computed.
    Setting,
}

impl Group {
    /// What can be set and varied in a machine or a mode.
    pub const SOURCE: &[Self] = &[Group::Machine, Group::Law, Group::Mode];

    /// Its numbers, in the order of the table.
    pub fn knobs(self) -> impl Iterator<Item = Knob> + Clone {
        KNOBS.iter().filter(move |row| row.group == self).map(|row| row.knob)
    }
}

/// How a number is read from what has it, and where it is written.
#[derive(Debug)]
pub(crate) struct Access<T> {
    pub get: fn(&T) -> Option<f64>,
    pub place: fn(&mut T) -> Option<&mut f64>,
}

/// One row of [`KNOBS`].
#[derive(Clone, Copy, Debug)]
pub struct KnobSpec {
    /// Which number.
    pub knob: Knob,
    /// The name in files and on the command line.
    pub name: &'static str,
    /// The name on the screen.
    pub symbol: &'static str,
    /// What it means, in a few words.
    pub meaning: &'static str,
    /// Its SI unit; empty for a pure number.
    pub unit: &'static str,
    /// What it belongs to.
    pub group: Group,
    /// Smallest allowed value.
    pub min: f64,
    /// Largest allowed value.
    pub max: f64,
    /// Smallest allowed magnitude besides 0.
    pub least: f64,
    /// The value where nothing is said; `None` where something must be.
    pub default: Option<f64>,
    /// First step of the keys that change it; for a number of a machine, as a fraction of its value.
    pub step: f64,
    /// First range of a diagram over it: wide enough for what happens at friction and damping of everyday size.
    pub drawn: (f64, f64),
    pub(crate) belt: Option<&'static Access<Belt>>,
    pub(crate) mode: Option<&'static Access<Mode>>,
}

impl KnobSpec {
    /// The row of a number of which nothing else is said. One of a motion may not be so close to 0 that products of a
    /// few of them underflow.
    const fn of(group: Group, [name, unit]: [&'static str; 2], range: (f64, f64)) -> Self {
        KnobSpec {
            knob: Knob::D,
            name,
            symbol: name,
            meaning: "",
            unit,
            group,
            min: range.0,
            max: range.1,
            least: if matches!(group, Group::Motion) {
                1.0 / FAR
            } else {
                0.0
            },
            default: None,
            step: 0.05,
            drawn: (-1.0, 1.0),
            belt: None,
            mode: None,
        }
    }
}

/// The names of numbers and their table, group by group: of each number its name, its meaning, its unit, its range, and
/// what else is said of it.
macro_rules! knobs {
    ($([$group:ident]
        $($knob:ident $name:literal $meaning:literal $unit:literal $range:tt $({ $($more:tt)+ })?;)+
    )+) => {
        /// A number that can be set.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
        pub enum Knob {
            $($(#[doc = $meaning] $knob,)+)+
        }

        /// Every number that can be set, those of a group together.
        pub const KNOBS: &[KnobSpec] = &[$($(KnobSpec {
            knob: Knob::$knob,
            meaning: $meaning,
            $($($more)+,)?
            ..KnobSpec::of(Group::$group, [$name, $unit], $range)
        }),+),+];
    };
}

/// A number that is a field.
macro_rules! at {
    ($($field:tt)+) => {
        Some(&Access { get: |it| Some(it.$($field)+), place: |it| Some(&mut it.$($field)+) })
    };
}

/// A number of a friction law: a field of one, or the coefficient of a power in a polynomial.
macro_rules! law {
    ($law:ident $number:ident) => {
        law!(FrictionLaw::$law { $number, .. } => Some($number))
    };
    ($power:literal) => {
        law!(FrictionLaw::Polynomial { coefficients } => coefficients.into_iter().nth($power))
    };
    ($law:pat => $number:expr) => {
        Some(&Access {
            get: |belt: &Belt| if let $law = &belt.law { $number.copied() } else { None },
            place: |belt: &mut Belt| if let $law = &mut belt.law { $number } else { None },
        })
    };
}

/// A coefficient of a damping ratio.
macro_rules! ratio {
    ($power:literal) => {
        Some(&Access {
            get: |mode: &Mode| mode.damping_ratio.get($power).copied(),
            place: |mode: &mut Mode| mode.damping_ratio.get_mut($power),
        })
    };
}

/// Largest magnitude of a number without a unit; the least, besides 0, is its reciprocal. Between them products of a
/// few numbers neither over- nor underflow.
const FAR: f64 = 1e150;

/// Any number of a dimensionless motion.
const WIDE: (f64, f64) = (-FAR, FAR);

/// Any number of a machine, in SI units.
const ANY: (f64, f64) = (-1e12, 1e12);

/// A number of a machine that is 0 or more.
const NO_LESS: (f64, f64) = (0.0, 1e12);

/// A number of a machine that is more than 0.
const POSITIVE: (f64, f64) = (1e-12, 1e12);

/// A start in metres or metres per second.
const START: (f64, f64) = (-1e6, 1e6);

/// The coefficient of the belt at rest: that of the law where nothing is said.
const HELD_BY_BELT: Option<&Access<Belt>> = Some(&Access {
    get: |belt| belt.static_coefficient.or_else(|| belt.law.mu(0.0)),
    place: |belt| Some(belt.static_coefficient.get_or_insert(0.0)),
});

/// The friction of the guide at rest: that of the moving mass where nothing is said.
const HELD_BY_GUIDE: Option<&Access<Belt>> = Some(&Access {
    get: |belt| Some(belt.static_guide.unwrap_or(belt.friction)),
    place: |belt| Some(belt.static_guide.get_or_insert(0.0)),
});

/// The same of a mode.
const MODE_HELD: Option<&Access<Mode>> = Some(&Access {
    get: |mode| Some(mode.static_guide.unwrap_or(mode.friction)),
    place: |mode| Some(mode.static_guide.get_or_insert(0.0)),
});

knobs! {
    [Motion]
    D "D" "linear damping" "" (-1e6, 1e6) { default: Some(-0.1), step: 0.01, drawn: (-0.9, 0.1) };
    D2 "D2" "asymmetric damping" "" WIDE { default: Some(0.0) };
    D3 "D3" "cubic damping" "" WIDE { default: Some(0.0) };
    R "r" "dry friction" "" (0.0, FAR) { default: Some(0.1), step: 0.01, drawn: (0.0, 0.5) };
    Q0 "q0" "initial displacement" "" WIDE { default: Some(1.0) };
    V0 "v0" "initial velocity" "" WIDE { default: Some(0.0) };

    [Machine]
    Mass "m" "mass" "kg" POSITIVE { belt: at!(mass) };
    Stiffness "c" "stiffness of the spring" "N/m" POSITIVE { belt: at!(stiffness) };
    Damping "d1" "linear damping" "N s/m" ANY { default: Some(0.0), belt: at!(damping) };
    CubicDamping "d3" "cubic damping" "N s^3/m^3" ANY { default: Some(0.0), belt: at!(cubic_damping) };
    NormalForce "F" "force onto the belt" "N" POSITIVE { belt: at!(normal_force) };
    Friction "R" "friction element" "N" NO_LESS { default: Some(0.0), belt: at!(friction), mode: at!(friction) };
    BeltSpeed "v0" "belt speed" "m/s" POSITIVE { symbol: "belt", step: 1.0 / 30.0, belt: at!(belt_speed) };

    [Law]
    StaticCoefficient "mu_s" "static friction of the belt" "" NO_LESS { belt: HELD_BY_BELT };
    StaticGuide "R_static" "static friction element" "N" NO_LESS { belt: HELD_BY_GUIDE, mode: MODE_HELD };
    Mu "mu" "coefficient of friction" "" ANY { belt: law!(Constant mu) };
    Rest "rest" "coefficient of friction at rest" "" ANY { belt: law!(Stribeck rest) };
    Kinetic "kinetic" "coefficient to which friction falls" "" ANY { belt: law!(Stribeck kinetic) };
    Velocity "velocity" "velocity over which friction falls" "m/s" POSITIVE { belt: law!(Stribeck velocity) };
    Exponent "exponent" "1 exponential, 2 Gaussian" "" (0.1, 10.0) { default: Some(1.0), belt: law!(Stribeck exponent) };
    Viscous "viscous" "rise by lubrication" "s/m" ANY { default: Some(0.0), belt: law!(Stribeck viscous) };
    Mu0 "mu0" "coefficient of friction at rest" "" ANY { belt: law!(0) };
    Mu1 "mu1" "its slope at rest" "s/m" ANY { belt: law!(1) };
    Mu2 "mu2" "coefficient of v^2" "s^2/m^2" ANY { belt: law!(2) };
    Mu3 "mu3" "coefficient of v^3" "s^3/m^3" ANY { belt: law!(3) };
    Mu4 "mu4" "coefficient of v^4" "s^4/m^4" ANY { belt: law!(4) };
    Mu5 "mu5" "coefficient of v^5" "s^5/m^5" ANY { belt: law!(5) };

    [Mode]
    Frequency "frequency" "natural frequency" "Hz" (1e-9, 1e12) { mode: at!(frequency) };
    ModalMass "modal_mass" "modal mass" "kg" POSITIVE { mode: at!(mass) };
    Ratio0 "ratio0" "damping ratio at rest" "" ANY { mode: ratio!(0) };
    Ratio1 "ratio1" "its slope at rest" "s/m" ANY { mode: ratio!(1) };
    Ratio2 "ratio2" "coefficient of v^2" "s^2/m^2" ANY { mode: ratio!(2) };
    Ratio3 "ratio3" "coefficient of v^3" "s^3/m^3" ANY { mode: ratio!(3) };
    Ratio4 "ratio4" "coefficient of v^4" "s^4/m^4" ANY { mode: ratio!(4) };
    Ratio5 "ratio5" "coefficient of v^5" "s^5/m^5" ANY { mode: ratio!(5) };

    [Table]
    Scatter "scatter" "scatter of the points" "" NO_LESS { default: Some(0.0) };

    [Record]
    Omega0 "omega0" "natural frequency" "1/s" (1.0 / FAR, FAR);
    Offset "offset" "displacement of the middle" "" WIDE { default: Some(0.0) };
    Confidence "confidence" "confidence of a statement" "" (0.5, 0.999) { default: Some(0.95) };

    [Course]
    X "x" "displacement at the start" "m" START { default: Some(0.0) };
    V "v" "velocity at the start" "m/s" START { default: Some(0.0) };
    Duration "until" "end time" "s" (0.0, 1e6) { default: Some(0.0) };
    DisturbingForce "disturbance" "bound on a disturbance" "N" (0.0, 1e6) { default: Some(0.0) };

    [Setting]
    Disturbance "disturbance" "bound on a disturbance" "" (0.0, FAR) { symbol: "w", default: Some(0.0), step: 0.01 };
    Until "until" "end time" "" (0.0, 1e9) { default: Some(60.0), step: 10.0 };
    Tolerance "tolerance" "relative error of a step" "" (1e-15, 1e-2) { default: Some(1e-10) };
    Step "step" "length of a step" "" (1e-7, 1.0) { default: Some(0.01) };
    Epsilon "epsilon" "velocity that smooths" "" (1e-12, 1e6) { default: Some(1e-3) };
}

impl Knob {
    /// The six numbers of a dimensionless motion: parameters and start.
    pub const MOTION: [Self; 6] = [Knob::D, Knob::D2, Knob::D3, Knob::R, Knob::Q0, Knob::V0];

    /// The four numbers of equation (4).
    pub const PARAMETERS: [Self; 4] = [Knob::D, Knob::D2, Knob::D3, Knob::R];

    /// Whether it is a number of a mass on a belt or its friction law.
    #[must_use]
    pub fn is_of_machine(self) -> bool {
        self.spec().belt.is_some()
    }

    /// Whether it is a number of equation (4), and not of a start.
    #[must_use]
    pub fn is_parameter(self) -> bool {
        Knob::PARAMETERS.contains(&self)
    }

    /// Its place within its group.
    #[must_use]
    pub fn place(self) -> usize {
        let group = self.spec().group;
        self as usize - KNOBS.iter().position(|row| row.group == group).unwrap_or(0)
    }

    /// The row of [`KNOBS`] that describes this number.
    #[must_use]
    pub fn spec(self) -> &'static KnobSpec {
        &KNOBS[self as usize]
    }
}
