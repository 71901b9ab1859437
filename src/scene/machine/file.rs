//! Machine files: reads TOML into a [`Machine`], or reports the first mistake and its place in one line.

use std::collections::BTreeMap;
use std::ops::Range;

use serde::Deserialize;
use toml::Spanned;

use super::Machine;
use super::table::table;
use super::unit::{Measured, Toleranced, measured, toleranced};
use crate::machine::{Model, Tolerances};
use crate::numerics::decimal::shortest;
use crate::numerics::spline::SmoothingSpline;
use crate::oscillator::Belt;
use crate::oscillator::belt::{Dimension, FrictionLaw, QUANTITIES, Quantity};
use crate::scene::misread::{self, Complaint, Misread};

/// Largest displacement or velocity of a start, in SI units, in either direction.
pub const FARTHEST_START: f64 = 1e6;

/// Allowed disturbances, in N.
const DISTURBANCES: (f64, f64) = (0.0, 1e6);

/// Allowed durations of a motion, in s.
pub const UNTIL_RANGE: (f64, f64) = (0.0, 1e6);

/// Range of the velocity in Stribeck's characteristic, in m/s.
const STRIBECK_VELOCITY: (f64, f64) = (1e-12, 1e12);

/// Range of the exponent in Stribeck's characteristic.
const STRIBECK_EXPONENT: (f64, f64) = (0.1, 10.0);

/// Largest magnitude of the coefficients of friction and damping, in SI units.
const LARGEST_COEFFICIENT: f64 = 1e12;

/// Range of a coefficient that is not restricted otherwise.
const ANY: (f64, f64) = (-LARGEST_COEFFICIENT, LARGEST_COEFFICIENT);

/// The dimension whose product with a velocity is a pure number.
const SLOWNESS: Dimension = Dimension::new(0, -1, 1);

/// Maximum number of points of a table.
const MOST_POINTS: usize = 10_000;

/// The file as it is written.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct MachineFile {
    #[serde(default)]
    title: String,
    #[serde(default)]
    look: String,
    m: Option<Spanned<Number>>,
    c: Option<Spanned<Number>>,
    d1: Option<Spanned<Number>>,
    d3: Option<Spanned<Number>>,
    #[serde(rename = "F")]
    f: Option<Spanned<Number>>,
    #[serde(rename = "R")]
    r: Option<Spanned<Number>>,
    #[serde(rename = "R_static")]
    r_static: Option<Spanned<Number>>,
    v0: Option<Spanned<Number>>,
    friction: Spanned<Friction>,
    /// Bound on a disturbing force.
    disturbance: Option<Spanned<Number>>,
    #[serde(default)]
    start: StartTable,
    until: Option<Spanned<Number>>,
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
        let far = (-FARTHEST_START, FARTHEST_START);
        let x = number("x", self.x.as_ref(), Dimension::LENGTH, "m", far, 0.0)?;
        let v = number("v", self.v.as_ref(), Dimension::VELOCITY, "m/s", far, 0.0)?;
        Ok((x, v))
    }
}

/// Duration of a motion in s: the one from the file, or `PERIODS` periods of the free oscillation.
pub(super) fn duration(given: Option<&Spanned<Number>>, period: f64) -> Result<f64, Complaint> {
    const PERIODS: f64 = 20.0;
    number("until", given, Dimension::TIME, "s", UNTIL_RANGE, PERIODS * period)
}

/// The coefficients of a polynomial in the velocity, the constant one first.
pub(super) fn polynomial(name: &str, given: &[Spanned<Number>]) -> Result<Vec<f64>, Complaint> {
    let coefficient = |(power, given): (usize, &Spanned<Number>)| {
        let power = i8::try_from(power).unwrap_or(i8::MAX);
        let dimension = Dimension::ONE.times(SLOWNESS, power).unwrap_or(Dimension::ONE);
        let unit = match power {
            0 => String::new(),
            1 => "s/m".to_owned(),
            _ => format!("s^{power}/m^{power}"),
        };
        number(name, Some(given), dimension, &unit, ANY, 0.0)
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
    table: Option<Table>,
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
struct Table {
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
    #[serde(skip)]
    Read(Measured),
}

impl Number {
    fn read(&self) -> Result<Measured, String> {
        match self {
            Number::Plain(value) => Ok(Measured { value: *value, dimension: None }),
            Number::Text(text) => measured(text),
            Number::Read(read) => Ok(*read),
        }
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
    let mut read: MachineFile = misread::toml(file, text)?;
    let half_widths = half_widths(&mut read);
    half_widths
        .and_then(|half_widths| machine(name, read, half_widths, fetch))
        .map_err(|complaint| complaint.in_file(file, text))
}

/// Takes the tolerances of a machine's numbers out of the file and leaves the middle values. Half widths are in
/// SI units.
fn half_widths(read: &mut MachineFile) -> Result<BTreeMap<String, f64>, Complaint> {
    let MachineFile { m, c, d1, d3, f, r, r_static, v0, friction, .. } = read;
    let Friction { at_rest, constant, polynomial, stribeck, .. } = friction.get_mut();
    let mut numbers: Vec<(String, &mut Spanned<Number>)> = Vec::new();
    let mut put = |name: &str, given| numbers.push((name.to_owned(), given));
    let named = ["m", "c", "d1", "d3", "F", "R", "R_static", "v0", "mu_s"];
    for (name, given) in named.into_iter().zip([m, c, d1, d3, f, r, r_static, v0, at_rest]) {
        if let Some(given) = given {
            put(name, given);
        }
    }
    if let Some(law) = constant {
        put("mu", &mut law.mu);
    }
    for (power, given) in polynomial.iter_mut().flat_map(|law| &mut law.coefficients).enumerate() {
        put(&format!("mu{power}"), given);
    }
    if let Some(Stribeck { rest, kinetic, velocity, exponent, viscous }) = stribeck {
        [("rest", rest), ("kinetic", kinetic), ("velocity", velocity)]
            .into_iter()
            .chain(exponent.as_mut().map(|given| ("exponent", given)))
            .chain(viscous.as_mut().map(|given| ("viscous", given)))
            .for_each(|(name, given)| put(name, given));
    }
    let mut found = BTreeMap::new();
    for (name, given) in numbers {
        let Number::Text(text) = given.get_ref() else { continue };
        let refuse = |message| Complaint { at: given.span(), message: self::named(&name, message) };
        let Toleranced { middle, half_width } = toleranced(text).map_err(refuse)?;
        *given.get_mut() = Number::Read(middle);
        if half_width > 0.0 {
            found.insert(name, half_width);
        }
    }
    Ok(found)
}

fn machine(
    name: &str,
    read: MachineFile,
    half_widths: BTreeMap<String, f64>,
    fetch: impl FnOnce(&str) -> Result<String, String>,
) -> Result<Machine, Complaint> {
    let whole = read.friction.span();
    let friction = read.friction.into_inner();
    let any = (0.0, LARGEST_COEFFICIENT);
    let pure = |given| number("static", given, Dimension::ONE, "", any, 0.0);
    let at_rest = friction.at_rest.as_ref().map(|given| pure(Some(given))).transpose()?;
    let guide = |given| quantity_as("R_static", Quantity::Friction, given);
    let mut belt = Belt {
        mass: 0.0,
        stiffness: 0.0,
        damping: 0.0,
        cubic_damping: 0.0,
        normal_force: 0.0,
        friction: 0.0,
        belt_speed: 0.0,
        law: law(friction, &whole, fetch)?,
        static_coefficient: at_rest,
        static_guide: read.r_static.as_ref().map(guide).transpose()?,
    };
    let given = [&read.m, &read.c, &read.d1, &read.d3, &read.f, &read.r, &read.v0];
    for (row, given) in QUANTITIES.iter().zip(given) {
        let value = match (given, row.default) {
            (Some(given), _) => quantity_as(row.name, row.quantity, given)?,
            (None, Some(default)) => default,
            (None, None) => {
                let message = format!(
                    "{} ({}) is missing; such as {0} = \"1 {}\"",
                    row.name, row.meaning, row.unit
                );
                return Err(Complaint { at: 0..0, message });
            }
        };
        belt.set(row.quantity, value);
    }
    let unfit = |message| Complaint { at: whole.clone(), message };
    let reduced = belt.reduce().map_err(|error| unfit(error.to_string()))?;
    Model::new(&belt).map_err(|error| unfit(error.to_string()))?;
    let disturbance = read.disturbance.as_ref();
    let disturbance = number("disturbance", disturbance, Dimension::FORCE, "N", DISTURBANCES, 0.0)?;
    let tolerances = Tolerances { half_widths, disturbance };
    tolerances.check(&belt).map_err(unfit)?;
    let (displacement, velocity) = read.start.read()?;
    Ok(Machine {
        name: name.to_owned(),
        title: if read.title.is_empty() { name.to_owned() } else { read.title },
        look: read.look,
        belt,
        tolerances,
        displacement,
        velocity,
        until: duration(read.until.as_ref(), std::f64::consts::TAU * reduced.units.time)?,
    })
}

/// A value of this quantity, under another name.
pub(super) fn quantity_as(
    name: &str,
    quantity: Quantity,
    given: &Spanned<Number>,
) -> Result<f64, Complaint> {
    given
        .get_ref()
        .read()
        .and_then(|read| value_of(quantity, &read))
        .map_err(|message| Complaint { at: given.span(), message: named(name, message) })
}

/// A value of this quantity, checked against its range. Fails with one line that says what is allowed.
pub fn value_of(quantity: Quantity, read: &Measured) -> Result<f64, String> {
    let row = quantity.spec();
    let value = read.as_a(row.dimension, row.unit)?;
    quantity.check(value).map_err(|outside| outside.to_string())
}

/// A message that begins with the name of the number concerned.
fn named(name: &str, message: String) -> String {
    if message.starts_with(&format!("{name} =")) { message } else { format!("{name}: {message}") }
}

/// A number of this dimension, checked against its range, or its default.
pub(super) fn number(
    name: &str,
    given: Option<&Spanned<Number>>,
    dimension: Dimension,
    unit: &str,
    (min, max): (f64, f64),
    default: f64,
) -> Result<f64, Complaint> {
    let Some(given) = given else { return Ok(default) };
    let refuse = |message| Complaint { at: given.span(), message: named(name, message) };
    let value = given.get_ref().read().and_then(|read| read.as_a(dimension, unit));
    let value = value.map_err(refuse)?;
    if (min..=max).contains(&value) {
        return Ok(value);
    }
    let blank = if unit.is_empty() { "" } else { " " };
    Err(refuse(format!(
        "{name} = {}{blank}{unit} is outside its range {min:?} .. {max:?}{blank}{unit}",
        shortest(value)
    )))
}

fn law(
    given: Friction,
    whole: &Range<usize>,
    fetch: impl FnOnce(&str) -> Result<String, String>,
) -> Result<FrictionLaw, Complaint> {
    match (given.constant, given.polynomial, given.stribeck, given.table) {
        (Some(law), None, None, None) => {
            Ok(FrictionLaw::Constant { mu: coefficient("mu", &law.mu)? })
        }
        (None, Some(law), None, None) => {
            let coefficients = polynomial("coefficients", &law.coefficients)?;
            Ok(FrictionLaw::Polynomial { coefficients })
        }
        (None, None, Some(law), None) => stribeck(&law),
        (None, None, None, Some(law)) => spline(law, whole, fetch),
        _ => {
            let message = "friction takes one law: constant, polynomial, stribeck or table";
            Err(Complaint { at: whole.clone(), message: message.to_owned() })
        }
    }
}

fn coefficient(name: &str, given: &Spanned<Number>) -> Result<f64, Complaint> {
    number(name, Some(given), Dimension::ONE, "", ANY, 0.0)
}

fn stribeck(law: &Stribeck) -> Result<FrictionLaw, Complaint> {
    let speed = Dimension::VELOCITY;
    let (exponent, viscous) = (law.exponent.as_ref(), law.viscous.as_ref());
    Ok(FrictionLaw::Stribeck {
        rest: coefficient("rest", &law.rest)?,
        kinetic: coefficient("kinetic", &law.kinetic)?,
        velocity: number("velocity", Some(&law.velocity), speed, "m/s", STRIBECK_VELOCITY, 1.0)?,
        exponent: number("exponent", exponent, Dimension::ONE, "", STRIBECK_EXPONENT, 1.0)?,
        viscous: number("viscous", viscous, SLOWNESS, "s/m", ANY, 0.0)?,
    })
}

fn spline(
    law: Table,
    whole: &Range<usize>,
    fetch: impl FnOnce(&str) -> Result<String, String>,
) -> Result<FrictionLaw, Complaint> {
    let scatter = (0.0, LARGEST_COEFFICIENT);
    let scatter = number("scatter", law.scatter.as_ref(), Dimension::ONE, "", scatter, 0.0)?;
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
            return Err(Complaint { at: whole.clone(), message: message.to_owned() });
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
    let read = |(v, mu): &(Number, Number)| {
        Ok((v.read()?.as_a(Dimension::VELOCITY, "m/s")?, mu.read()?.as_a(Dimension::ONE, "")?))
    };
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
