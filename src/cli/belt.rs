//! `hopfscope belt`: a machine in physical units.

use std::path::Path;
use std::sync::Arc;

use clap::Args;

use super::failure::Failure;
use super::output::{Format, Output, print};
use super::timing::timed;
use crate::export::belt::{self, Answer, Designed, Sweep};
use crate::flow::{Limits, Reason};
use crate::oscillator::belt::{Dimension, QUANTITIES, Quantity, Reduced};
use crate::scene::machine::file::{FARTHEST_START, parse, value_of};
use crate::scene::machine::library::{TEXTBOOK, find, machines};
use crate::scene::machine::unit::measured;
use crate::scene::{Machine, Rig, Scene};
use crate::study::belt::{survey, sweep};
use crate::study::design::{Kick, friction_for};

/// Says what a mass on a belt does, in physical units
#[derive(Debug, Args)]
#[command(long_about = long_about())]
pub struct Belt {
    /// File of the machine, or the name of one that comes with the program
    #[arg(value_name = "FILE", default_value = TEXTBOOK)]
    machine: String,
    /// Sets a quantity, such as "v0=0.2 m/s"; repeatable: m, c, d1, d3, F, R, v0, and the start x, v
    #[arg(long, value_name = "NAME=VALUE", value_parser = assignment, allow_hyphen_values = true)]
    set: Vec<(Name, f64)>,
    /// Varies a quantity, such as "v0=0.1 m/s:0.5 m/s:21": margins, cycles and alarms along its way
    #[arg(long, value_name = "NAME=FROM:TO:COUNT", value_parser = range, allow_hyphen_values = true)]
    sweep: Option<Range>,
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
        "Says what a mass on a belt does, in physical units: its dimensionless numbers, cycles and margins, what \
         the Taylor expansion of friction leaves out, and whether anything overtakes the belt.\n\nMachines of \
         the program:\n{}",
        known.join("\n")
    )
}

/// What `--set` can set.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Name {
    /// A quantity of the machine.
    Quantity(Quantity),
    /// Displacement at the start, in m.
    Displacement,
    /// Velocity at the start, in m/s.
    Velocity,
}

/// A quantity and the values through which it goes.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Range {
    quantity: Quantity,
    ends: (f64, f64),
    count: usize,
}

/// A quantity by its name.
fn quantity(name: &str) -> Option<Quantity> {
    Quantity::named(name.trim())
}

fn names() -> String {
    QUANTITIES.map(|row| row.name).join(", ")
}

/// `NAME=VALUE`, the value with or without a unit.
fn assignment(text: &str) -> Result<(Name, f64), String> {
    let form = "expected NAME=VALUE, such as \"v0=0.2 m/s\"";
    let (name, value) = text.split_once('=').ok_or(form)?;
    let read = measured(value)?;
    if let Some(quantity) = quantity(name) {
        let value = value_of(quantity, &read).map_err(|error| format!("{name}: {error}"))?;
        return Ok((Name::Quantity(quantity), value));
    }
    let (name, dimension, unit) = match name.trim() {
        "x" => (Name::Displacement, Dimension::LENGTH, "m"),
        "v" => (Name::Velocity, Dimension::VELOCITY, "m/s"),
        other => {
            return Err(format!("there is no quantity {other:?}; there are {}, x, v", names()));
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

/// `NAME=FROM:TO:COUNT`.
fn range(text: &str) -> Result<Range, String> {
    /// Most points of a sweep.
    const MOST: usize = 100_000;
    let form = || "expected NAME=FROM:TO:COUNT, such as \"v0=0.1 m/s:0.5 m/s:21\"".to_owned();
    let (name, range) = text.split_once('=').ok_or_else(form)?;
    let unknown = || format!("there is no quantity {name:?}; there are {}", names());
    let quantity = quantity(name).ok_or_else(unknown)?;
    let [from, to, count] = range.split(':').collect::<Vec<_>>()[..] else { return Err(form()) };
    let (from, to) = (measured(from)?, measured(to)?);
    if from.dimension.is_some() != to.dimension.is_some() {
        return Err(format!("{range:?}: FROM and TO both take a unit, or none (SI units)"));
    }
    let (from, to) = (value_of(quantity, &from)?, value_of(quantity, &to)?);
    let parsed = count.trim().parse().ok().filter(|count| (2..=MOST).contains(count));
    let count =
        parsed.ok_or_else(|| format!("COUNT = {count} is not a whole number in 2 .. {MOST}"))?;
    if from == to {
        return Err(format!("FROM and TO are both {from:?}"));
    }
    Ok(Range { quantity, ends: (from, to), count })
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
                Name::Quantity(quantity) => machine.belt.set(quantity, value),
                Name::Displacement => machine.displacement = value,
                Name::Velocity => machine.velocity = value,
            }
        }
        Ok(machine)
    }

    /// Computes and prints.
    pub fn run(&self) -> Result<(), Failure> {
        let machine = self.machine()?;
        let gave_up = |reason: Reason| {
            Failure::Unanswered(format!("the belt could not be computed: {reason}"))
        };
        if let Some(range) = self.sweep {
            let (swept, seconds) = timed(self.output.repeat, || self.swept(&machine, range));
            let answer = Sweep { seconds, ..swept.map_err(gave_up)? };
            return print(&match self.output.format {
                Format::Table => belt::sweep_table(&answer),
                Format::Json => belt::sweep_json(&answer),
                Format::Csv => belt::sweep_csv(&answer),
            });
        }
        let reduced = machine.reduce().map_err(|error| Failure::Usage(error.to_string()))?;
        let limits = &Limits::PATIENT;
        let start = (machine.displacement, machine.velocity);
        let (found, seconds) = timed(self.output.repeat, || {
            let survey = survey(&machine.belt, &reduced, start, machine.until, limits)?;
            Ok((survey, self.designed(&reduced)?))
        });
        let (survey, design) = found.map_err(gave_up)?;
        let answer = Answer { machine: &machine, survey: &survey, design, seconds };
        print(&match self.output.format {
            Format::Table => belt::table(&answer),
            Format::Json => belt::json(&answer),
            Format::Csv => belt::csv(&answer),
        })
    }

    /// The friction for the margin, if asked for.
    fn designed(&self, reduced: &Reduced) -> Result<Option<Designed>, Reason> {
        let Some((kick, wanted)) = self.design else { return Ok(None) };
        let unit = match kick {
            Kick::Displacement => reduced.units.displacement,
            Kick::Impulse => reduced.units.impulse,
        };
        let design = friction_for(&reduced.parameters, kick, wanted / unit, &Limits::PATIENT)?;
        Ok(Some(Designed { kick, wanted, design }))
    }

    /// The sweep, with the friction for the margin at each point if asked for.
    fn swept<'a>(&self, machine: &'a Machine, range: Range) -> Result<Sweep<'a>, Reason> {
        let Range { quantity, ends, count } = range;
        let (points, mut cost) = sweep(&machine.belt, quantity, ends, count, &Limits::PATIENT)?;
        let mut answered = Vec::with_capacity(count);
        for point in points {
            let designed = match &point.found {
                Ok(found) => self.designed(&found.reduced)?,
                Err(_) => None,
            };
            if let Some(designed) = &designed {
                cost += designed.design.cost;
            }
            answered.push((point, designed));
        }
        Ok(Sweep { machine, quantity, points: answered, cost, seconds: 0.0 })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn assignments_take_units_and_refuse_others() {
        assert_eq!(assignment("m=250 g"), Ok((Name::Quantity(Quantity::Mass), 0.25)));
        assert_eq!(assignment("v0=0.2"), Ok((Name::Quantity(Quantity::BeltSpeed), 0.2)));
        assert_eq!(assignment("x=-2mm"), Ok((Name::Displacement, -0.002)));
        for (text, words) in [
            ("m", "expected NAME=VALUE"),
            ("M=1", "there are m, c, d1, d3, F, R, v0, x, v"),
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
        let expected = Range { quantity: Quantity::BeltSpeed, ends: (0.1, 0.5), count: 5 };
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
