//! Machine files: reads TOML into a [`Description`], or reports the first mistake and its place in one line.
//!
//! Most files describe a mass on a belt. Any other self-excited vibration mode is described by its frequency, its
//! modal mass and a damping ratio that depends on velocity.

use std::collections::BTreeMap;
use std::f64::consts::TAU;
use std::ops::Range;

use serde::Deserialize;
use serde::de::DeserializeOwned;
use toml::Spanned;
use toml::de::DeTable;

use super::Description;
use super::table::table;
use crate::flow::{Reason, Subject};
use crate::model::{
    Belt, Body, FrictionLaw, Group, Knob, KnobSpec, Mode, Source, Tolerances, quantity, unknown,
};
use crate::numerics::{SmoothingSpline, shortest};
use crate::scene::mistake::{Complaint, FileMistake, Result};
use crate::scene::placed::Placed;

/// Maximum number of points of a table.
const MOST_POINTS: usize = 10_000;

/// The numbers of friction at rest, which are not those of a law.
const AT_REST: [Knob; 2] = [Knob::StaticCoefficient, Knob::StaticGuide];

/// A table of the file, and its place.
struct Section<'a> {
    entries: &'a DeTable<'a>,
    at: Range<usize>,
}

impl<'a> Section<'a> {
    /// What stands under a name.
    fn get<T: DeserializeOwned>(&self, name: &str) -> Result<Option<Spanned<T>>> {
        let Some(given) = self.entries.get(name) else { return Ok(None) };
        Ok(Some(Spanned::new(given.span(), Placed(given.clone()).read()?)))
    }

    /// The text under a name, or an empty one.
    fn text(&self, name: &str) -> Result<String> {
        Ok(self.get(name)?.map(Spanned::into_inner).unwrap_or_default())
    }

    /// The table under a name.
    fn section(&self, name: &str) -> Result<Option<Section<'a>>> {
        let Some(given) = self.entries.get(name) else { return Ok(None) };
        let (at, found) = (given.span(), given.get_ref());
        if let Some(entries) = found.as_table() {
            return Ok(Some(Section { entries, at }));
        }
        let message = format!("{name} is a table, not a value of type {}", found.type_str());
        Err(Complaint { at, message })
    }

    /// Fails at a name that is not among these.
    fn has_only(&self, known: &[&str]) -> Result<()> {
        let mut names = self.entries.keys();
        let stray = names.find(|name| !known.contains(&name.get_ref().as_ref()));
        stray.map_or(Ok(()), |name| {
            Err(Complaint { at: name.span(), message: unknown(name.get_ref(), known) })
        })
    }
}

/// The numbers of a machine without those of its friction, or those of a mode without its damping ratio.
fn numbers(is_mode: bool) -> impl Iterator<Item = Knob> + Clone {
    let mode = [Knob::Frequency, Knob::ModalMass, Knob::Friction].into_iter();
    let belt = Group::Machine.knobs().filter(move |_| !is_mode);
    belt.chain(mode.filter(move |_| is_mode)).chain([Knob::StaticGuide])
}

/// The names that are not such numbers.
fn other_names(is_mode: bool) -> &'static [&'static str] {
    if is_mode {
        &["title", "look", "damping_ratio", "start", "until"]
    } else {
        &["title", "look", "friction", "disturbance", "start", "until"]
    }
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

/// Reads a machine or a mode; `name` is the name by which it is opened, `file` the one in error messages. `fetch`
/// returns the text of a table that the file names, or why it cannot. Fails with [`FileMistake`], which names the place
/// and what is allowed there.
pub fn parse(
    name: &str,
    file: &str,
    text: &str,
    mut fetch: impl FnMut(&str) -> Result<String, String>,
) -> Result<Description, FileMistake> {
    let described = |read: Spanned<DeTable>| {
        let is_mode = read.get_ref().contains_key("modal_mass");
        let half_widths = BTreeMap::new();
        let reader = MachineReader { is_mode, half_widths, fetch: &mut fetch };
        reader.described(name, &Section { entries: read.get_ref(), at: 0..0 })
    };
    let read = DeTable::parse(text).map_err(Complaint::from);
    read.and_then(described).map_err(|complaint| complaint.in_file(file, text))
}

fn lacks(message: impl Into<String>) -> Complaint {
    Complaint { at: 0..0, message: message.into() }
}

/// What reads a file.
struct MachineReader<'a> {
    is_mode: bool,
    /// The tolerances of the numbers read so far: half widths in SI units, by name.
    half_widths: BTreeMap<String, f64>,
    /// Returns the text of a table.
    fetch: &'a mut dyn FnMut(&str) -> Result<String, String>,
}

impl MachineReader<'_> {
    fn described(mut self, name: &str, read: &Section) -> Result<Description> {
        /// Periods of the free oscillation for which a motion is followed where nothing is said.
        const PERIODS: f64 = 20.0;
        let numbers = numbers(self.is_mode);
        let known = numbers.clone().map(|knob| knob.spec().name);
        read.has_only(&known.chain(other_names(self.is_mode).to_vec()).collect::<Vec<_>>())?;
        let (body, section) = if self.is_mode {
            self.mode(read)?
        } else {
            self.belt(read)?
        };
        let mut source = Source::from(body);
        for knob in numbers {
            let is_given = read.entries.contains_key(knob.spec().name);
            if knob != Knob::StaticGuide || is_given {
                source.set(knob, self.number(read, knob)?).map_err(lacks)?;
            }
        }
        let unfit = |message| Complaint { at: section.clone(), message };
        let refused = |error: Reason| unfit(error.to_string());
        let period = match &source.body {
            Body::Belt(belt) => TAU * belt.reduce().map_err(refused)?.units.time,
            Body::Mode(mode) => 1.0 / mode.frequency,
            Body::Paper(_) => TAU,
        };
        source.model().map_err(refused)?;
        let disturbance = self.number(read, Knob::DisturbingForce)?;
        let mut start = (0.0, 0.0);
        if let Some(given) = read.section("start")? {
            given.has_only(&["x", "v"])?;
            start = (self.number(&given, Knob::X)?, self.number(&given, Knob::V)?);
        }
        let until = read.get(Knob::Duration.spec().name)?;
        let until = until.map_or(Ok(PERIODS * period), |it| self.read(Knob::Duration, &it))?;
        let tolerances = Tolerances { half_widths: self.half_widths, disturbance };
        if let Some(belt) = source.of_belt() {
            tolerances.check(belt).map_err(unfit)?;
        }
        let title = read.text("title")?;
        Ok(Description {
            name: name.to_owned(),
            title: if title.is_empty() { name.to_owned() } else { title },
            watch: read.text("look")?,
            subject: Subject::moving(source, tolerances, start, until),
        })
    }

    /// The value of a number. Those of a mass on a belt may have a tolerance; the guaranteed margins of a mode are not
    /// computed.
    fn read(&mut self, knob: Knob, given: &Spanned<Number>) -> Result<f64> {
        let may_differ = !self.is_mode && knob.is_of_machine();
        let read = match given.get_ref() {
            Number::Plain(value) => knob.check(*value).map_err(String::from),
            Number::Text(text) if may_differ => knob.parse_toleranced(text).map(|read| {
                if read.half_width > 0.0 {
                    self.half_widths.insert(knob.to_string(), read.half_width);
                }
                read.middle.value
            }),
            Number::Text(text) => knob.parse(text),
        };
        read.map_err(|message| Complaint { at: given.span(), message })
    }

    /// A number of a table of the file, or its default.
    fn number(&mut self, section: &Section, knob: Knob) -> Result<f64> {
        let KnobSpec { name, meaning, default, .. } = *knob.spec();
        if let Some(given) = section.get(name)? {
            return self.read(knob, &given);
        }
        let such = || format!("such as {knob} = \"{}\"", knob.print(1.0));
        default.ok_or_else(|| lacks(format!("{knob} ({meaning}) is missing; {}", such())))
    }

    /// The coefficients of a polynomial in the velocity, the constant one first; each is read as the number of its `name`
    /// and power, or by its unit where the table of numbers ends.
    fn polynomial(&mut self, name: &str, given: &[Spanned<Number>]) -> Result<Vec<f64>> {
        let coefficient = |(power, given): (usize, &Spanned<Number>)| {
            if let Ok(knob) = Knob::named(&format!("{name}{power}"), Group::SOURCE) {
                return self.read(knob, given);
            }
            let number = given.get_ref().in_unit(&format!("s^{power}/m^{power}"));
            number.map_err(|message| Complaint { at: given.span(), message })
        };
        given.iter().enumerate().map(coefficient).collect()
    }

    /// A mass on a belt with its friction and no other numbers yet, and the place of the friction in the file.
    fn belt(&mut self, read: &Section) -> Result<(Body, Range<usize>)> {
        let friction = read.section("friction")?;
        let friction = friction.ok_or_else(|| lacks("friction is missing"))?;
        let read = |given| self.read(Knob::StaticCoefficient, &given);
        let static_coefficient = friction.get("static")?.map(read).transpose()?;
        let mut belt = Belt { static_coefficient, ..Belt::default() };
        self.set_law(&mut belt, &friction)?;
        Ok((Body::Belt(Box::new(belt)), friction.at))
    }

    /// A mode with its damping ratio and no other numbers yet, and the place of the ratio in the file.
    fn mode(&mut self, read: &Section) -> Result<(Body, Range<usize>)> {
        let ratio = read.get::<Vec<_>>("damping_ratio")?;
        let ratio = ratio.ok_or_else(|| lacks("damping_ratio is missing"))?;
        let damping_ratio = self.polynomial("ratio", ratio.get_ref())?;
        Ok((Body::Mode(Mode { damping_ratio, ..Mode::default() }), ratio.span()))
    }

    /// Gives a mass its friction law: the one table beside the coefficient of static friction.
    fn set_law(&mut self, belt: &mut Belt, friction: &Section) -> Result<()> {
        friction.has_only(&[&["static"], &FrictionLaw::NAMES[..]].concat())?;
        let unfit =
            |message: &str| Complaint { at: friction.at.clone(), message: message.to_owned() };
        let mut laws = friction.entries.keys().map(|name| name.get_ref().as_ref());
        let mut other = || laws.find(|name| *name != "static");
        let one_of = || {
            let [others @ .., last] = FrictionLaw::NAMES;
            unfit(&format!("friction takes one law: {} or {last}", others.join(", ")))
        };
        let (Some(name), None) = (other(), other()) else { return Err(one_of()) };
        let given = friction.section(name)?.ok_or_else(one_of)?;
        if let Some(blank) = FrictionLaw::blank(name) {
            belt.law = blank;
            let own = |knob: &Knob| !AT_REST.contains(knob) && knob.of_belt(belt).is_some();
            let numbers: Vec<Knob> = Group::Law.knobs().filter(own).collect();
            given.has_only(&numbers.iter().map(|knob| knob.spec().name).collect::<Vec<_>>())?;
            for knob in numbers {
                knob.set_in_belt(belt, self.number(&given, knob)?).map_err(lacks)?;
            }
            return Ok(());
        }
        belt.law = match name {
            "polynomial" => {
                given.has_only(&["coefficients"])?;
                let listed = given.get::<Vec<_>>("coefficients")?;
                let listed = listed.ok_or_else(|| unfit("coefficients = [..] is missing"))?;
                FrictionLaw::Polynomial { coefficients: self.polynomial("mu", listed.get_ref())? }
            }
            "table" => self.spline(&given, unfit)?,
            // A law that has a name but is not read here must not pass for another one.
            _ => return Err(one_of()),
        };
        Ok(())
    }

    fn spline(
        &mut self,
        law: &Section,
        unfit: impl FnOnce(&str) -> Complaint,
    ) -> Result<FrictionLaw> {
        law.has_only(&["file", "points", "scatter"])?;
        let scatter = self.number(law, Knob::Scatter)?;
        let (at, points) = match (law.get::<String>("file")?, law.get("points")?) {
            (Some(file), None) => {
                let name = file.get_ref();
                let read = (self.fetch)(name).and_then(|text| table(name, &text));
                (file.span(), read.map_err(|message| Complaint { at: file.span(), message })?)
            }
            (None, Some(points)) => (points.span(), listed(&points)?),
            _ => {
                let either = "a table takes either file = \"NAME.csv\" or points = [[v, mu], ..]";
                return Err(unfit(either));
            }
        };
        if points.len() > MOST_POINTS {
            let message = format!("{} points; {MOST_POINTS} are allowed", points.len());
            return Err(Complaint { at, message });
        }
        let spline = SmoothingSpline::new(&points, scatter);
        spline.map(FrictionLaw::Table).map_err(|message| Complaint { at, message })
    }
}

/// The points that are listed in the machine file itself.
fn listed(points: &Spanned<Vec<(Number, Number)>>) -> Result<Vec<(f64, f64)>> {
    let read = |(v, mu): &(Number, Number)| Ok((v.in_unit("m/s")?, mu.in_unit("")?));
    let point = |(index, point): (usize, &(Number, Number))| {
        let message = |why: String| format!("point {index}: {why}");
        read(point).map_err(|why| Complaint { at: points.span(), message: message(why) })
    };
    (1..).zip(points.get_ref()).map(point).collect()
}

#[cfg(test)]
mod tests;
