//! Machine files: reads TOML into a [`Machine`], or reports the first mistake and its place in one line.

use std::collections::BTreeMap;
use std::fmt;
use std::ops::Range;

use serde::Deserialize;
use serde::de::{Deserializer, IgnoredAny, MapAccess, Visitor};
use toml::Spanned;

use super::Machine;
use super::table::table;
use crate::model::belt::FrictionLaw;
use crate::model::unit::quantity;
use crate::model::{Belt, Group, Knob, Model, Tolerances, unknown};
use crate::numerics::decimal::shortest;
use crate::numerics::spline::SmoothingSpline;
use crate::scene::misread;
use crate::scene::misread::{Complaint, Misread};

/// Maximum number of points of a table.
const MOST_POINTS: usize = 10_000;

/// The file as it is written.
#[derive(Default)]
struct MachineFile {
    title: String,
    look: String,
    /// The numbers of the machine, without those of its friction.
    numbers: BTreeMap<Knob, Spanned<Number>>,
    friction: Option<Spanned<Friction>>,
    /// Bound on a disturbing force.
    disturbance: Option<Spanned<Number>>,
    start: StartTable,
    until: Option<Spanned<Number>>,
    /// The first key that means nothing.
    unknown: Option<Spanned<String>>,
}

/// The keys that are not numbers of the machine.
const OTHER_KEYS: [&str; 6] = ["title", "look", "friction", "disturbance", "start", "until"];

/// The numbers of a machine, without those of its friction.
fn numbers() -> impl Iterator<Item = Knob> {
    Group::Machine.knobs().chain([Knob::StaticGuide])
}

impl<'de> Deserialize<'de> for MachineFile {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Keys;
        impl<'de> Visitor<'de> for Keys {
            type Value = MachineFile;

            fn expecting(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
                out.write_str("the numbers of a machine")
            }

            fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<MachineFile, A::Error> {
                let mut file = MachineFile::default();
                while let Some(key) = map.next_key::<Spanned<String>>()? {
                    match key.get_ref().as_str() {
                        "title" => file.title = map.next_value()?,
                        "look" => file.look = map.next_value()?,
                        "friction" => file.friction = Some(map.next_value()?),
                        "disturbance" => file.disturbance = Some(map.next_value()?),
                        "start" => file.start = map.next_value()?,
                        "until" => file.until = Some(map.next_value()?),
                        name => {
                            if let Some(knob) = numbers().find(|knob| knob.spec().name == name) {
                                file.numbers.insert(knob, map.next_value()?);
                            } else {
                                map.next_value::<IgnoredAny>()?;
                                file.unknown.get_or_insert(key);
                            }
                        }
                    }
                }
                Ok(file)
            }
        }
        deserializer.deserialize_map(Keys)
    }
}

/// The start of the motion.
#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct StartTable {
    x: Option<Spanned<Number>>,
    v: Option<Spanned<Number>>,
}

impl StartTable {
    /// Displacement and velocity at the start, in SI units.
    pub fn read(&self) -> Result<(f64, f64), Complaint> {
        Ok((or_usual(Knob::X, self.x.as_ref())?, or_usual(Knob::V, self.v.as_ref())?))
    }
}

/// Duration of a motion in s: the one from the file, or `PERIODS` periods of the free oscillation.
pub(super) fn duration(given: Option<&Spanned<Number>>, period: f64) -> Result<f64, Complaint> {
    const PERIODS: f64 = 20.0;
    given.map_or(Ok(PERIODS * period), |given| exact(Knob::Duration, given))
}

/// The coefficients of a polynomial in the velocity, the constant one first; each is read as the number of its
/// `name` and power, or by its unit where the table ends.
pub(super) fn polynomial(
    name: &str,
    given: &[Spanned<Number>],
    mut read: impl FnMut(Knob, &Spanned<Number>) -> Result<f64, Complaint>,
) -> Result<Vec<f64>, Complaint> {
    let coefficient = |(power, given): (usize, &Spanned<Number>)| {
        if let Ok(knob) = Knob::named(&format!("{name}{power}"), Group::SOURCE) {
            return read(knob, given);
        }
        let number = given.get_ref().in_unit(&format!("s^{power}/m^{power}"));
        number.map_err(|message| Complaint { at: given.span(), message })
    };
    given.iter().enumerate().map(coefficient).collect()
}

/// One of four friction laws, and the coefficient of static friction.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Friction {
    #[serde(rename = "static")]
    at_rest: Option<Spanned<Number>>,
    constant: Option<Constant>,
    polynomial: Option<Polynomial>,
    stribeck: Option<Stribeck>,
    table: Option<FrictionTable>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Constant {
    mu: Spanned<Number>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Polynomial {
    coefficients: Vec<Spanned<Number>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Stribeck {
    rest: Spanned<Number>,
    kinetic: Spanned<Number>,
    velocity: Spanned<Number>,
    exponent: Option<Spanned<Number>>,
    viscous: Option<Spanned<Number>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct FrictionTable {
    file: Option<Spanned<String>>,
    points: Option<Spanned<Vec<(Number, Number)>>>,
    scatter: Option<Spanned<Number>>,
}

/// A number, or a number with a unit as text.
#[derive(Clone, Debug, Deserialize)]
#[serde(untagged, expecting = "expected a number, or a text such as \"2 kg\"")]
pub(super) enum Number {
    Plain(f64),
    Text(String),
}

impl Number {
    /// A finite number in this unit.
    fn in_unit(&self, unit: &str) -> Result<f64, String> {
        match self {
            Number::Plain(value) => quantity(&shortest(*value), unit),
            Number::Text(text) => quantity(text, unit),
        }
    }
}

/// A number that has no tolerance.
pub(super) fn exact(knob: Knob, given: &Spanned<Number>) -> Result<f64, Complaint> {
    let read = match given.get_ref() {
        Number::Plain(value) => knob.check(*value).map_err(|refused| refused.to_string()),
        Number::Text(text) => knob.parse(text),
    };
    read.map_err(|message| Complaint { at: given.span(), message })
}

/// The same, or its default.
pub(super) fn or_usual(knob: Knob, given: Option<&Spanned<Number>>) -> Result<f64, Complaint> {
    given.map_or(Ok(knob.usual()), |given| exact(knob, given))
}

/// The tolerances of the numbers read so far: half widths in SI units, by name.
#[derive(Default)]
struct HalfWidths(BTreeMap<String, f64>);

impl HalfWidths {
    /// A number that may have a tolerance.
    fn read(&mut self, knob: Knob, given: &Spanned<Number>) -> Result<f64, Complaint> {
        let Number::Text(text) = given.get_ref() else { return exact(knob, given) };
        let read = knob.parse_toleranced(text);
        let read = read.map_err(|message| Complaint { at: given.span(), message })?;
        if read.half_width > 0.0 {
            self.0.insert(knob.to_string(), read.half_width);
        }
        Ok(read.middle.value)
    }

    /// The same, or its default.
    fn or_usual(&mut self, knob: Knob, given: Option<&Spanned<Number>>) -> Result<f64, Complaint> {
        given.map_or(Ok(knob.usual()), |given| self.read(knob, given))
    }
}

/// Reads a machine; `name` is the name by which it is opened, `file` the one in error messages. `fetch` returns
/// the text of a table that the file names, or why it cannot. Fails with [`Misread`], which names the place and
/// what is allowed there.
pub fn parse(
    name: &str,
    file: &str,
    text: &str,
    fetch: impl FnOnce(&str) -> Result<String, String>,
) -> Result<Machine, Misread> {
    let read: MachineFile = misread::toml(file, text)?;
    machine(name, read, fetch).map_err(|complaint| complaint.in_file(file, text))
}

fn machine(
    name: &str,
    read: MachineFile,
    fetch: impl FnOnce(&str) -> Result<String, String>,
) -> Result<Machine, Complaint> {
    if let Some(key) = &read.unknown {
        let known = numbers().map(|knob| knob.spec().name).chain(OTHER_KEYS);
        let message = unknown(key.get_ref(), &known.collect::<Vec<_>>());
        return Err(Complaint { at: key.span(), message });
    }
    let lacks = |message: String| Complaint { at: 0..0, message };
    let friction = read.friction.ok_or_else(|| lacks("friction is missing".to_owned()))?;
    let section = friction.span();
    let friction = friction.into_inner();
    let mut half_widths = HalfWidths::default();
    let at_rest = friction.at_rest.as_ref();
    let static_coefficient =
        at_rest.map(|given| half_widths.read(Knob::StaticCoefficient, given)).transpose()?;
    let mut belt = Belt {
        mass: 0.0,
        stiffness: 0.0,
        damping: 0.0,
        cubic_damping: 0.0,
        normal_force: 0.0,
        friction: 0.0,
        belt_speed: 0.0,
        law: law(friction, &section, &mut half_widths, fetch)?,
        static_coefficient,
        static_guide: None,
    };
    set_numbers(&mut belt, &read.numbers, &mut half_widths)?;
    let unfit = |message| Complaint { at: section.clone(), message };
    let reduced = belt.reduce().map_err(|error| unfit(error.to_string()))?;
    Model::new(&belt).map_err(|error| unfit(error.to_string()))?;
    let disturbance = or_usual(Knob::DisturbingForce, read.disturbance.as_ref())?;
    let tolerances = Tolerances { half_widths: half_widths.0, disturbance };
    tolerances.check(&belt).map_err(unfit)?;
    let (displacement, velocity) = read.start.read()?;
    Ok(Machine {
        name: name.to_owned(),
        title: if read.title.is_empty() { name.to_owned() } else { read.title },
        watch: read.look,
        belt,
        tolerances,
        displacement,
        velocity,
        until: duration(read.until.as_ref(), std::f64::consts::TAU * reduced.units.time)?,
    })
}

/// Sets the numbers of a machine that its file gives, and the defaults of the others.
fn set_numbers(
    belt: &mut Belt,
    given: &BTreeMap<Knob, Spanned<Number>>,
    half_widths: &mut HalfWidths,
) -> Result<(), Complaint> {
    let lacks = |message: String| Complaint { at: 0..0, message };
    for knob in numbers() {
        let value = match (given.get(&knob), knob.spec().default) {
            (Some(given), _) => half_widths.read(knob, given)?,
            (None, Some(default)) => default,
            (None, None) if knob == Knob::StaticGuide => continue,
            (None, None) => {
                let meaning = knob.spec().meaning;
                let such = knob.print(1.0);
                return Err(lacks(format!(
                    "{knob} ({meaning}) is missing; such as {knob} = \"{such}\""
                )));
            }
        };
        knob.set_in_belt(belt, value).map_err(lacks)?;
    }
    Ok(())
}

fn law(
    given: Friction,
    section: &Range<usize>,
    half_widths: &mut HalfWidths,
    fetch: impl FnOnce(&str) -> Result<String, String>,
) -> Result<FrictionLaw, Complaint> {
    match (given.constant, given.polynomial, given.stribeck, given.table) {
        (Some(law), None, None, None) => {
            Ok(FrictionLaw::Constant { mu: half_widths.read(Knob::Mu, &law.mu)? })
        }
        (None, Some(law), None, None) => {
            let read = |knob, given: &Spanned<Number>| half_widths.read(knob, given);
            Ok(FrictionLaw::Polynomial { coefficients: polynomial("mu", &law.coefficients, read)? })
        }
        (None, None, Some(law), None) => Ok(FrictionLaw::Stribeck {
            rest: half_widths.read(Knob::Rest, &law.rest)?,
            kinetic: half_widths.read(Knob::Kinetic, &law.kinetic)?,
            velocity: half_widths.read(Knob::Velocity, &law.velocity)?,
            exponent: half_widths.or_usual(Knob::Exponent, law.exponent.as_ref())?,
            viscous: half_widths.or_usual(Knob::Viscous, law.viscous.as_ref())?,
        }),
        (None, None, None, Some(law)) => spline(law, section, fetch),
        _ => {
            let message = "friction takes one law: constant, polynomial, stribeck or table";
            Err(Complaint { at: section.clone(), message: message.to_owned() })
        }
    }
}

fn spline(
    law: FrictionTable,
    section: &Range<usize>,
    fetch: impl FnOnce(&str) -> Result<String, String>,
) -> Result<FrictionLaw, Complaint> {
    let scatter = or_usual(Knob::Scatter, law.scatter.as_ref())?;
    let (at, points) = match (law.file, law.points) {
        (Some(file), None) => {
            let at = file.span();
            let name = file.get_ref();
            let refuse = |message| Complaint { at: at.clone(), message };
            let text = fetch(name).map_err(refuse)?;
            (at.clone(), table(name, &text).map_err(refuse)?)
        }
        (None, Some(points)) => (points.span(), listed(&points)?),
        _ => {
            let message = "a table takes either file = \"NAME.csv\" or points = [[v, mu], ..]";
            return Err(Complaint { at: section.clone(), message: message.to_owned() });
        }
    };
    if points.len() > MOST_POINTS {
        let message = format!("{} points; {MOST_POINTS} are allowed", points.len());
        return Err(Complaint { at, message });
    }
    let spline = SmoothingSpline::new(&points, scatter)
        .map_err(|error| Complaint { at, message: error.to_string() })?;
    Ok(FrictionLaw::Table(spline))
}

/// The points that are listed in the machine file itself.
fn listed(points: &Spanned<Vec<(Number, Number)>>) -> Result<Vec<(f64, f64)>, Complaint> {
    let read = |(v, mu): &(Number, Number)| Ok((v.in_unit("m/s")?, mu.in_unit("")?));
    let number = points.get_ref().iter().enumerate();
    number
        .map(|(index, point)| {
            read(point).map_err(|message: String| Complaint {
                at: points.span(),
                message: format!("point {}: {message}", index + 1),
            })
        })
        .collect()
}

#[cfg(test)]
mod tests;
