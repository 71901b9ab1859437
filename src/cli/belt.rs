//! `hopfscope belt`: a machine in physical units.

use std::path::Path;
use std::sync::Arc;

use clap::Args;

use super::failure::Failure;
use super::output::{Format, Output, print};
use super::timing::timed;
use crate::export::belt::branch::{Borders, Branched};
use crate::export::belt::mode::ModeAnswer;
use crate::export::belt::{self, Answer, Designed, Sweep, SweepPoint};
use crate::flow::Limits;
use crate::machine::Portrait;
use crate::machine::branch::{borders, branch, spaced};
use crate::machine::design::friction_for;
use crate::machine::survey::{Course, Trouble, portrait, survey};
use crate::machine::varied::Varied;
use crate::oscillator::belt::Dimension;
use crate::scene::machine::file::{FARTHEST_START, parse};
use crate::scene::machine::library::{TEXTBOOK, find, machines};
use crate::scene::machine::mode::{self, Mode, is_mode};
use crate::scene::machine::unit::{Measured, measured};
use crate::scene::{Machine, Rig, Scene};
use crate::study::design::Kick;

/// Says what a mass on a belt does, in physical units
#[derive(Debug, Args)]
#[command(long_about = long_about())]
pub struct Belt {
    /// File of the machine, or the name of one that comes with the program
    #[arg(value_name = "FILE", default_value = TEXTBOOK)]
    machine: String,
    /// Sets a number of the machine or its friction law, such as "v0=0.2 m/s"; repeatable; also the start x, v
    #[arg(long, value_name = "NAME=VALUE", value_parser = assignment, allow_hyphen_values = true)]
    set: Vec<(Name, f64)>,
    /// Start of the motion, such as "x=1 mm,v=0 m/s"
    #[arg(long, value_name = "x=..,v=..", value_parser = start, allow_hyphen_values = true)]
    start: Option<Start>,
    /// Window "XMIN:XMAX,VMIN:VMAX": tells the part of it from which the mass comes to rest
    #[arg(long, value_name = "WINDOW", value_parser = window, allow_hyphen_values = true)]
    window: Option<Window>,
    /// Varies a number, such as "v0=0.1 m/s:0.5 m/s:21": margins and cycles along its way
    #[arg(long, value_name = "NAME=FROM:TO:COUNT", value_parser = range, allow_hyphen_values = true)]
    sweep: Option<Range>,
    /// Follows the cycles along a number and locates every change of them: Hopf, fold, grazing, annihilation ..
    #[arg(long, value_name = "NAME=FROM:TO:COUNT", value_parser = range, allow_hyphen_values = true,
          conflicts_with_all = ["sweep", "design"])]
    branch: Option<Range>,
    /// With --branch: the changes at each value of another number
    #[arg(long, value_name = "NAME=FROM:TO:COUNT", value_parser = range, allow_hyphen_values = true,
          requires = "branch")]
    against: Option<Range>,
    /// Asks how much friction R a margin needs: a displacement ("2 mm") or an impulse ("0.1 N s")
    #[arg(long, value_name = "MARGIN", value_parser = margin, allow_hyphen_values = true)]
    design: Option<(Kick, f64)>,
    #[command(flatten)]
    output: Output,
}

fn long_about() -> String {
    let known: Vec<String> = machines()
        .iter()
        .map(|machine| format!("  {:9} {}", machine.name, machine.title))
        .collect();
    format!(
        "Says what a mass on a belt does, in physical units: its cycles, slipping and sticking, the border of \
         what comes to rest and the margins up to it, and by how much the cubic expansion of friction is wrong \
         about them.\n\nMachines of the program:\n{}",
        known.join("\n")
    )
}

/// What `--set` can set.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Name {
    /// A number of the machine.
    Number(Varied),
    /// Displacement at the start, in m.
    Displacement,
    /// Velocity at the start, in m/s.
    Velocity,
}

/// A number and the values through which it goes.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Range {
    varied: Varied,
    ends: (f64, f64),
    count: usize,
}

/// Where a motion starts; what is not given stays.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Start {
    x: Option<f64>,
    v: Option<f64>,
}

/// A window of the phase plane, in m and m/s.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Window {
    x: (f64, f64),
    v: (f64, f64),
}

/// A measured value as a value of a number of the machine.
fn value_of(varied: Varied, read: &Measured) -> Result<f64, String> {
    varied.check(read.as_a(varied.dimension(), varied.unit())?)
}

/// `NAME=VALUE`, the value with or without a unit.
fn assignment(text: &str) -> Result<(Name, f64), String> {
    let form = "expected NAME=VALUE, such as \"v0=0.2 m/s\"";
    let (name, value) = text.split_once('=').ok_or(form)?;
    let read = measured(value)?;
    if let Some(varied) = Varied::named(name.trim()) {
        let value = value_of(varied, &read).map_err(|error| format!("{name}: {error}"))?;
        return Ok((Name::Number(varied), value));
    }
    let (name, dimension, unit) = match name.trim() {
        "x" => (Name::Displacement, Dimension::LENGTH, "m"),
        "v" => (Name::Velocity, Dimension::VELOCITY, "m/s"),
        other => {
            let names = Varied::names();
            return Err(format!("there is no quantity {other:?}; there are {names}, x, v"));
        }
    };
    let value = read.as_a(dimension, unit)?;
    if value.abs() <= FARTHEST_START {
        Ok((name, value))
    } else {
        Err(format!(
            "{text:?} is outside its range; allowed: {:?} .. {FARTHEST_START:?}",
            -FARTHEST_START
        ))
    }
}

/// `x=..,v=..`, one of them or both.
fn start(text: &str) -> Result<Start, String> {
    let mut start = Start::default();
    for part in text.split(',') {
        match assignment(part)? {
            (Name::Displacement, x) => start.x = Some(x),
            (Name::Velocity, v) => start.v = Some(v),
            (Name::Number(_), _) => {
                return Err(format!("{part:?} is no start; expected x=.. and v=.."));
            }
        }
    }
    Ok(start)
}

/// `XMIN:XMAX,VMIN:VMAX`.
fn window(text: &str) -> Result<Window, String> {
    let form =
        || format!("{text:?} is no window; expected XMIN:XMAX,VMIN:VMAX, such as -2mm:2mm,0:1");
    let pair = |part: &str, dimension, unit| {
        let (from, to) = part.split_once(':').ok_or_else(form)?;
        let read = |text| measured(text).and_then(|read| read.as_a(dimension, unit));
        let (from, to) = (read(from)?, read(to)?);
        if from < to { Ok((from, to)) } else { Err(format!("{part:?}: {from} is not below {to}")) }
    };
    let (x, v) = text.split_once(',').ok_or_else(form)?;
    Ok(Window { x: pair(x, Dimension::LENGTH, "m")?, v: pair(v, Dimension::VELOCITY, "m/s")? })
}

/// `NAME=FROM:TO:COUNT`.
fn range(text: &str) -> Result<Range, String> {
    /// Most points of a sweep.
    const MOST: usize = 100_000;
    let form = || "expected NAME=FROM:TO:COUNT, such as \"v0=0.1 m/s:0.5 m/s:21\"".to_owned();
    let (name, range) = text.split_once('=').ok_or_else(form)?;
    let unknown = || format!("there is no quantity {name:?}; there are {}", Varied::names());
    let varied = Varied::named(name.trim()).ok_or_else(unknown)?;
    let [from, to, count] = range.split(':').collect::<Vec<_>>()[..] else { return Err(form()) };
    let (from, to) = (measured(from)?, measured(to)?);
    if from.dimension.is_some() != to.dimension.is_some() {
        return Err(format!("{range:?}: FROM and TO both take a unit, or none (SI units)"));
    }
    let (from, to) = (value_of(varied, &from)?, value_of(varied, &to)?);
    let parsed = count.trim().parse().ok().filter(|count| (2..=MOST).contains(count));
    let count =
        parsed.ok_or_else(|| format!("COUNT = {count} is not a whole number in 2 .. {MOST}"))?;
    if from == to {
        return Err(format!("FROM and TO are both {from:?}"));
    }
    Ok(Range { varied, ends: (from, to), count })
}

/// A margin: a displacement or an impulse, told apart by the unit.
fn margin(text: &str) -> Result<(Kick, f64), String> {
    let read = measured(text)?;
    let kick = match read.dimension {
        Some(Dimension::LENGTH) => Kick::Displacement,
        Some(Dimension::IMPULSE) => Kick::Impulse,
        _ => {
            return Err(format!(
                "{text:?} is no margin; expected a displacement, such as \"2 mm\", or an impulse, such as \
                 \"0.1 N s\""
            ));
        }
    };
    if read.value > 0.0 { Ok((kick, read.value)) } else { Err(format!("{text:?} is not positive")) }
}

/// The machine of a file, or of the program.
pub fn machine(name: &str) -> Result<Machine, Failure> {
    let path = Path::new(name);
    let text = match std::fs::read_to_string(path) {
        Ok(text) => text,
        Err(error) => {
            return find(name).cloned().ok_or_else(|| {
                let known: Vec<&str> =
                    machines().iter().map(|machine| machine.name.as_str()).collect();
                Failure::Usage(format!(
                    "{name}: {error}; the machines of the program are {}",
                    known.join(", ")
                ))
            });
        }
    };
    let title = path.file_stem().unwrap_or(path.as_os_str()).to_string_lossy();
    let fetch = |table: &str| {
        let beside = path.with_file_name(table);
        std::fs::read_to_string(&beside).map_err(|error| format!("{}: {error}", beside.display()))
    };
    parse(&title, name, &text, fetch).map_err(|error| Failure::Usage(error.to_string()))
}

/// The mode of a file, if that is what it holds.
fn mode(name: &str) -> Result<Option<Mode>, Failure> {
    let path = Path::new(name);
    let Ok(text) = std::fs::read_to_string(path) else { return Ok(None) };
    if !is_mode(&text) {
        return Ok(None);
    }
    let title = path.file_stem().unwrap_or(path.as_os_str()).to_string_lossy();
    mode::parse(&title, name, &text).map(Some).map_err(|error| Failure::Usage(error.to_string()))
}

/// The machine of a file, or of the program, to be looked at.
pub fn scene(name: &str) -> Result<Arc<Scene>, Failure> {
    let rig =
        Rig::new(machine(name)?).map_err(|error| Failure::Usage(format!("{name}: {error}")))?;
    Ok(Arc::new(rig.scene()))
}

impl Belt {
    /// The machine with what was set on the command line.
    fn machine(&self) -> Result<Machine, Failure> {
        let mut machine = machine(&self.machine)?;
        for &(name, value) in &self.set {
            match name {
                Name::Number(varied) => {
                    varied.set(&mut machine.belt, value).map_err(Failure::Usage)?;
                }
                Name::Displacement => machine.displacement = value,
                Name::Velocity => machine.velocity = value,
            }
        }
        let Start { x, v } = self.start.unwrap_or_default();
        machine.displacement = x.unwrap_or(machine.displacement);
        machine.velocity = v.unwrap_or(machine.velocity);
        Ok(machine)
    }

    /// Computes and prints.
    pub fn run(&self) -> Result<(), Failure> {
        if let Some(mode) = mode(&self.machine)? {
            return self.of_mode(mode);
        }
        let machine = self.machine()?;
        if let Some(range) = self.branch {
            return self.branched(&machine, range);
        }
        if let Some(range) = self.sweep {
            let (swept, seconds) = timed(self.output.repeat, || self.swept(&machine, range));
            let answer = Sweep { seconds, ..swept? };
            return print(&match self.output.format {
                Format::Table => belt::sweep_table(&answer),
                Format::Json => belt::sweep_json(&answer),
                Format::Csv => belt::sweep_csv(&answer),
            });
        }
        let start = (machine.displacement, machine.velocity);
        let (found, seconds) = timed(self.output.repeat, || {
            let survey = survey(&machine.belt, start, machine.until, &Limits::PATIENT)?;
            let share =
                self.window.map(|window| survey.course.portrait.rest_share(window.x, window.v));
            Ok((survey, share, self.designed(&machine.belt)?))
        });
        let (survey, rest_share, design) = found.map_err(troubled)?;
        let answer = Answer { machine: &machine, survey: &survey, rest_share, design, seconds };
        print(&match self.output.format {
            Format::Table => belt::table(&answer),
            Format::Json => belt::json(&answer),
            Format::Csv => belt::csv(&answer),
        })
    }

    /// The answer about a vibration mode, which has no belt.
    fn of_mode(&self, mut mode: Mode) -> Result<(), Failure> {
        let numbers = !self.set.is_empty() || self.design.is_some();
        if numbers || self.sweep.is_some() || self.branch.is_some() {
            let line = "a mode takes --start and --window; --set, --sweep, --branch and --design are for belts";
            return Err(Failure::Usage(line.to_owned()));
        }
        let Start { x, v } = self.start.unwrap_or_default();
        mode.start = (x.unwrap_or(mode.start.0), v.unwrap_or(mode.start.1));
        let (found, seconds) =
            timed(self.output.repeat, || Course::new(&mode.model, mode.start, mode.until));
        let course = found.map_err(troubled)?;
        let share = |window: Window| course.portrait.rest_share(window.x, window.v);
        let rest_share = self.window.map(share);
        let answer = ModeAnswer { mode: &mode, course: &course, rest_share, seconds };
        print(&match self.output.format {
            Format::Table => belt::mode::table(&answer),
            Format::Json => belt::mode::json(&answer),
            Format::Csv => belt::mode::csv(&answer),
        })
    }

    /// The branch, or the changes along it at values of another number.
    fn branched(&self, machine: &Machine, range: Range) -> Result<(), Failure> {
        let Range { varied, ends, count } = range;
        if let Some(other) = self.against {
            let (rows, seconds) = timed(self.output.repeat, || {
                let against = (other.varied, other.ends, other.count);
                borders(&machine.belt, (varied, ends, count), against)
            });
            let (rows, varied) = (rows.map_err(Failure::Usage)?, (varied, other.varied));
            let found = Borders { machine, varied, rows, seconds };
            return print(&match self.output.format {
                Format::Table => belt::branch::borders_table(&found),
                Format::Json => belt::branch::borders_json(&found),
                Format::Csv => belt::branch::borders_csv(&found),
            });
        }
        let (found, seconds) =
            timed(self.output.repeat, || branch(&machine.belt, varied, ends, count));
        let found = Branched { machine, varied, branch: found.map_err(Failure::Usage)?, seconds };
        print(&match self.output.format {
            Format::Table => belt::branch::table(&found),
            Format::Json => belt::branch::json(&found),
            Format::Csv => belt::branch::csv(&found),
        })
    }

    /// The friction for the margin, if asked for.
    fn designed(&self, belt: &crate::oscillator::Belt) -> Result<Option<Designed>, Trouble> {
        let Some((kick, wanted)) = self.design else { return Ok(None) };
        let needed = friction_for(belt, kick, wanted)?;
        Ok(needed.map(|needed| Designed { kick, wanted, needed }))
    }

    /// The sweep, with the friction for the margin at each point if asked for.
    fn swept<'a>(&self, machine: &'a Machine, range: Range) -> Result<Sweep<'a>, Failure> {
        let Range { varied, ends, count } = range;
        let point = |index: usize| {
            let value = spaced(ends, index, count);
            let mut here = machine.belt.clone();
            varied.set(&mut here, value).map_err(Failure::Usage)?;
            let found = portrait(&here).map_err(|trouble| trouble.to_string());
            let share = |portrait: &Portrait| {
                self.window.map(|window| portrait.rest_share(window.x, window.v))
            };
            let rest_share = found.as_ref().ok().and_then(share);
            let design = match &found {
                Ok(_) => self.designed(&here).map_err(troubled)?,
                Err(_) => None,
            };
            Ok(SweepPoint { value, found, rest_share, design })
        };
        let points = (0..count).map(point).collect::<Result<_, Failure>>()?;
        Ok(Sweep { machine, varied, points, seconds: 0.0 })
    }
}

/// A machine that has no answer: its own fault is bad input.
fn troubled(trouble: Trouble) -> Failure {
    let line = format!("the belt could not be computed: {trouble}");
    if trouble.is_of_the_machine() {
        Failure::Usage(trouble.to_string())
    } else {
        Failure::Unanswered(line)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::oscillator::belt::Quantity;

    #[test]
    fn assignments_take_units_and_refuse_others() {
        assert_eq!(
            assignment("m=250 g"),
            Ok((Name::Number(Varied::Quantity(Quantity::Mass)), 0.25))
        );
        assert_eq!(
            assignment("v0=0.2"),
            Ok((Name::Number(Varied::Quantity(Quantity::BeltSpeed)), 0.2))
        );
        assert_eq!(assignment("x=-2mm"), Ok((Name::Displacement, -0.002)));
        for (text, words) in [
            ("m", "expected NAME=VALUE"),
            ("M=1", "there are m, c, d1, d3, F, R, v0, mu_s, R_static"),
            ("m=2 N", "m: has another dimension; it takes a unit such as kg"),
            ("R=-1", "R = -1 N is outside its range 0.0 .."),
            ("x=1e9", "allowed: -1000000.0 .. 1000000.0"),
            ("v=two", "\"two\" does not begin with a number"),
        ] {
            let refused = assignment(text).unwrap_err();
            assert!(refused.contains(words), "{text}: {refused}");
        }
    }

    #[test]
    fn sweeps_and_margins_are_read() {
        let expected =
            Range { varied: Varied::Quantity(Quantity::BeltSpeed), ends: (0.1, 0.5), count: 5 };
        assert_eq!(range("v0=10 cm/s:50 cm/s:5"), Ok(expected));
        for text in ["v0", "v0=1:2", "v0=1 m/s:2:5", "v0=1:2:1", "v9=1:2:3", "v0=0:1:3", "v0=1:1:3"]
        {
            assert!(range(text).is_err(), "{text}");
        }
        assert_eq!(margin("2 mm"), Ok((Kick::Displacement, 0.002)));
        assert_eq!(margin("0.5 N s"), Ok((Kick::Impulse, 0.5)));
        assert_eq!(margin("0.5 kg m/s"), Ok((Kick::Impulse, 0.5)));
        for text in ["2", "2 kg", "-2 mm", "0 mm", ""] {
            assert!(margin(text).is_err(), "{text}");
        }
    }
}
