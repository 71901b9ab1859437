//! Machine files: reads TOML into a [`Description`], or reports the first mistake and its place in one line.
//!
//! Most files describe a mass on a belt. Any other self-excited vibration mode is described by its frequency, its
//! modal mass and a damping ratio that depends on velocity.

use std::collections::BTreeMap;
use std::fmt;
use std::ops::Range;

use serde::Deserialize;
use serde::de::{Deserializer, IgnoredAny, MapAccess, Visitor};
use toml::Spanned;

use super::Description;
use super::table::table;
use crate::model::belt::FrictionLaw;
use crate::model::unit::quantity;
use crate::model::{Belt, Body, Group, Knob, MachineProblem, Modal, Source, Tolerances, unknown};
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
    /// The numbers that stand by themselves.
    numbers: BTreeMap<Knob, Spanned<Number>>,
    friction: Option<Spanned<Friction>>,
    damping_ratio: Option<Spanned<Vec<Spanned<Number>>>>,
    start: StartTable,
    /// The keys of all of these.
    keys: Vec<Spanned<String>>,
}

/// Whether a text describes a mode: only modes have a modal mass.
pub fn is_mode(text: &str) -> bool {
    text.lines().any(|line| line.trim_start().starts_with("modal_mass"))
}

/// The numbers of a machine without those of its friction, or those of a mode without its damping ratio.
fn numbers(is_mode: bool) -> impl Iterator<Item = Knob> + Clone {
    let mode = [Knob::Frequency, Knob::ModalMass, Knob::Friction];
    let belt = Group::Machine.knobs().filter(move |_| !is_mode);
    belt.chain(mode.into_iter().filter(move |_| is_mode)).chain([Knob::StaticGuide])
}

/// What a file may tell of the motion besides its start.
const COURSE: [Knob; 2] = [Knob::DisturbingForce, Knob::Duration];

/// The keys that are not such numbers.
fn other_keys(is_mode: bool) -> &'static [&'static str] {
    if is_mode {
        &["title", "look", "damping_ratio", "start", "until"]
    } else {
        &["title", "look", "friction", "disturbance", "start", "until"]
    }
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
                let all = numbers(false).chain(numbers(true)).chain(COURSE);
                let mut file = MachineFile::default();
                while let Some(key) = map.next_key::<Spanned<String>>()? {
                    match key.get_ref().as_str() {
                        "title" => file.title = map.next_value()?,
                        "look" => file.look = map.next_value()?,
                        "friction" => file.friction = Some(map.next_value()?),
                        "damping_ratio" => file.damping_ratio = Some(map.next_value()?),
                        "start" => file.start = map.next_value()?,
                        name => {
                            if let Some(knob) = all.clone().find(|knob| knob.spec().name == name) {
                                file.numbers.insert(knob, map.next_value()?);
                            } else {
                                map.next_value::<IgnoredAny>()?;
                            }
                        }
                    }
                    file.keys.push(key);
                }
                Ok(file)
            }
        }
        deserializer.deserialize_map(Keys)
    }
}

impl MachineFile {
    /// Fails where the file has a key that has no meaning for what it describes.
    fn has_only_known_keys(&self, is_mode: bool) -> Result<(), Complaint> {
        let known: Vec<&str> = numbers(is_mode)
            .map(|knob| knob.spec().name)
            .chain(other_keys(is_mode).to_vec())
            .collect();
        let stray = self.keys.iter().find(|key| !known.contains(&key.get_ref().as_str()));
        stray.map_or(Ok(()), |key| {
            Err(Complaint { at: key.span(), message: unknown(key.get_ref(), &known) })
        })
    }
}

/// The start of the motion.
#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields)]
struct StartTable {
    x: Option<Spanned<Number>>,
    v: Option<Spanned<Number>>,
}

/// The coefficients of a polynomial in the velocity, the constant one first; each is read as the number of its
/// `name` and power, or by its unit where the table ends.
fn polynomial(
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
enum Number {
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
fn exact(knob: Knob, given: &Spanned<Number>) -> Result<f64, Complaint> {
    let read = match given.get_ref() {
        Number::Plain(value) => knob.check(*value).map_err(|refused| refused.to_string()),
        Number::Text(text) => knob.parse(text),
    };
    read.map_err(|message| Complaint { at: given.span(), message })
}

/// The same, or its default.
fn or_usual(knob: Knob, given: Option<&Spanned<Number>>) -> Result<f64, Complaint> {
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

/// Reads a machine or a mode; `name` is the name by which it is opened, `file` the one in error messages. `fetch`
/// returns the text of a table that the file names, or why it cannot. Fails with [`Misread`], which names the place
/// and what is allowed there.
pub fn parse(
    name: &str,
    file: &str,
    text: &str,
    fetch: impl FnOnce(&str) -> Result<String, String>,
) -> Result<Description, Misread> {
    let read: MachineFile = misread::toml(file, text)?;
    described(name, read, is_mode(text), fetch).map_err(|complaint| complaint.in_file(file, text))
}

fn described(
    name: &str,
    mut read: MachineFile,
    is_mode: bool,
    fetch: impl FnOnce(&str) -> Result<String, String>,
) -> Result<Description, Complaint> {
    /// Periods of the free oscillation for which a motion is followed where nothing is said.
    const PERIODS: f64 = 20.0;
    read.has_only_known_keys(is_mode)?;
    let mut half_widths = HalfWidths::default();
    let (body, section) = if is_mode {
        mode(read.damping_ratio.take())?
    } else {
        belt(read.friction.take(), &mut half_widths, fetch)?
    };
    let mut subject = Source::from(body);
    set_numbers(&mut subject, numbers(is_mode), &read.numbers, &mut half_widths)?;
    let unfit = |message| Complaint { at: section.clone(), message };
    let period = match &subject.body {
        Body::Belt(belt) => {
            let reduced = belt.reduce().map_err(|error| unfit(error.to_string()))?;
            std::f64::consts::TAU * reduced.units.time
        }
        Body::Mode(mode) => 1.0 / mode.frequency,
    };
    subject.model().map_err(|error| unfit(error.to_string()))?;
    let number = |knob| or_usual(knob, read.numbers.get(&knob));
    let tolerances =
        Tolerances { half_widths: half_widths.0, disturbance: number(Knob::DisturbingForce)? };
    if let Some(belt) = subject.of_belt() {
        tolerances.check(belt).map_err(unfit)?;
    }
    let start =
        (or_usual(Knob::X, read.start.x.as_ref())?, or_usual(Knob::V, read.start.v.as_ref())?);
    let until = read.numbers.get(&Knob::Duration);
    let until = until.map_or(Ok(PERIODS * period), |given| exact(Knob::Duration, given))?;
    Ok(Description {
        name: name.to_owned(),
        title: if read.title.is_empty() { name.to_owned() } else { read.title },
        watch: read.look,
        problem: MachineProblem { subject, tolerances, start, until },
    })
}

fn lacks(message: String) -> Complaint {
    Complaint { at: 0..0, message }
}

/// A mass on a belt with this friction and no other numbers yet, and the place of the friction in the file.
fn belt(
    friction: Option<Spanned<Friction>>,
    half_widths: &mut HalfWidths,
    fetch: impl FnOnce(&str) -> Result<String, String>,
) -> Result<(Body, Range<usize>), Complaint> {
    let friction = friction.ok_or_else(|| lacks("friction is missing".to_owned()))?;
    let section = friction.span();
    let friction = friction.into_inner();
    let at_rest = friction.at_rest.as_ref();
    let static_coefficient =
        at_rest.map(|given| half_widths.read(Knob::StaticCoefficient, given)).transpose()?;
    let belt = Belt {
        mass: 0.0,
        stiffness: 0.0,
        damping: 0.0,
        cubic_damping: 0.0,
        normal_force: 0.0,
        friction: 0.0,
        belt_speed: 0.0,
        law: law(friction, &section, half_widths, fetch)?,
        static_coefficient,
        static_guide: None,
    };
    Ok((Body::Belt(Box::new(belt)), section))
}

/// A mode with this damping ratio and no other numbers yet, and the place of the ratio in the file.
fn mode(ratio: Option<Spanned<Vec<Spanned<Number>>>>) -> Result<(Body, Range<usize>), Complaint> {
    let ratio = ratio.ok_or_else(|| lacks("damping_ratio is missing".to_owned()))?;
    let damping_ratio = polynomial("ratio", ratio.get_ref(), exact)?;
    let (frequency, mass, friction) = (0.0, 0.0, 0.0);
    let mode = Modal { frequency, mass, damping_ratio, friction, static_guide: None };
    Ok((Body::Mode(mode), ratio.span()))
}

/// Sets the numbers that the file gives, and the defaults of the others.
fn set_numbers(
    subject: &mut Source,
    knobs: impl Iterator<Item = Knob>,
    given: &BTreeMap<Knob, Spanned<Number>>,
    half_widths: &mut HalfWidths,
) -> Result<(), Complaint> {
    for knob in knobs {
        let value = match (given.get(&knob), knob.spec().default) {
            // The guaranteed margins of a mode are not computed.
            (Some(given), _) if subject.of_belt().is_none() => exact(knob, given)?,
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
        subject.set(knob, value).map_err(lacks)?;
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
