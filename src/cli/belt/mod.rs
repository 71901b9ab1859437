//! `hopfscope belt`: a machine in physical units.

mod input;

use std::path::Path;
use std::sync::Arc;

use clap::Args;

use self::input::{
    Name, RangeInUnits, StartOverride, WindowInUnits, assignment, disturbance, margin, range,
    start, window,
};
use super::failure::Failure;
use super::input::method;
use super::output::{Format, Output};
use super::start::tolerance;
use super::timing::timed;
use crate::flow::Limits;
use crate::flow::Method;
use crate::machine::branch::{borders, branch, spaced};
use crate::machine::design::friction_for;
use crate::machine::guarantee::guaranteed;
use crate::machine::stepped::{ALLOWED, SteppedMethod};
use crate::machine::survey::{Course, Trouble, survey};
use crate::machine::{Body, Portrait, Subject, Tolerances};
use crate::report::belt::branch::{Borders, Branched};
use crate::report::belt::mode::ModeAnswer;
use crate::report::belt::{self, BeltAnswer, Designed, Head, RestShare, Sweep, SweepPoint};
use crate::runtime::bounded;
use crate::scene::machine::file::parse;
use crate::scene::machine::library::{TEXTBOOK, find, machines};
use crate::scene::machine::mode::{self, Mode, is_mode};
use crate::scene::machine::unit::Toleranced;
use crate::scene::usual::TOLERANCE;
use crate::scene::{Machine, ScaledMachine, Scene};
use crate::study::design::Kick;

/// Says what a mass on a belt does, in physical units
#[derive(Debug, Args)]
#[command(long_about = long_about())]
pub struct Arguments {
    /// File of the machine, or the name of one that comes with the program
    #[arg(value_name = "FILE", default_value = TEXTBOOK)]
    machine: String,
    /// Sets a number of the machine or its friction law, such as "v0=0.2 m/s", or with a tolerance "R=1 N +- 0.2 N";
    /// repeatable; also the start x, v
    #[arg(long, value_name = "NAME=VALUE", value_parser = assignment, allow_hyphen_values = true)]
    set: Vec<(Name, Toleranced)>,
    /// Bound on a force that disturbs the mass in any way, such as "0.1 N": also tells what is survived for certain
    #[arg(long, value_name = "FORCE", value_parser = disturbance, allow_hyphen_values = true)]
    disturbance: Option<f64>,
    /// Start of the motion, such as "x=1 mm,v=0 m/s"
    #[arg(long, value_name = "x=..,v=..", value_parser = start, allow_hyphen_values = true)]
    start: Option<StartOverride>,
    /// Window "XMIN:XMAX,VMIN:VMAX": tells the part of it from which the mass comes to rest
    #[arg(long, value_name = "WINDOW", value_parser = window, allow_hyphen_values = true)]
    window: Option<WindowInUnits>,
    /// Counts the window's displacements from the relaxed spring, and not from the steady position
    #[arg(long, requires = "window")]
    elongation: bool,
    /// Varies a number, such as "v0=0.1 m/s:0.5 m/s:21": margins and cycles along its way
    #[arg(long, value_name = "NAME=FROM:TO:COUNT", value_parser = range, allow_hyphen_values = true)]
    sweep: Option<RangeInUnits>,
    /// Follows the cycles along a number and locates every change of them: Hopf, fold, grazing, annihilation ..
    #[arg(long, value_name = "NAME=FROM:TO:COUNT", value_parser = range, allow_hyphen_values = true,
          conflicts_with_all = ["sweep", "design"])]
    branch: Option<RangeInUnits>,
    /// With --branch: the changes at each value of another number
    #[arg(long, value_name = "NAME=FROM:TO:COUNT", value_parser = range, allow_hyphen_values = true,
          requires = "branch")]
    against: Option<RangeInUnits>,
    /// Asks how much friction R a margin needs: a displacement ("2 mm") or an impulse ("0.1 N s")
    #[arg(long, value_name = "MARGIN", value_parser = margin, allow_hyphen_values = true)]
    design: Option<(Kick, f64)>,
    /// Way of integrating: auto or taylor, by Taylor series; dop853 or dopri5 follow the motion once more, and the
    /// difference is told
    #[arg(long, value_name = "NAME", value_parser = method)]
    method: Option<Method>,
    /// Size of the last terms of a step, relative to the state, 1e-15 .. 0.01 (default: below rounding)
    #[arg(long, value_name = "X", value_parser = tolerance, allow_hyphen_values = true)]
    tol: Option<f64>,
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

/// What a name on the command line stands for.
enum Named {
    Belt(Machine),
    Mode(Mode),
}

/// The machine or mode of a file, or the machine of the program.
fn named(name: &str) -> Result<Named, Failure> {
    let path = Path::new(name);
    // Read once: it may be a pipe.
    let text = match bounded::text(path) {
        Ok(text) => text,
        Err(error) => {
            return find(name).cloned().map(Named::Belt).ok_or_else(|| {
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
    let told = |error: &dyn std::fmt::Display| Failure::Usage(error.to_string());
    if is_mode(&text) {
        return mode::parse(&title, name, &text).map(Named::Mode).map_err(|error| told(&error));
    }
    let fetch = |table: &str| {
        let beside = path.with_file_name(table);
        bounded::text(&beside).map_err(|error| format!("{}: {error}", beside.display()))
    };
    parse(&title, name, &text, fetch).map(Named::Belt).map_err(|error| told(&error))
}

/// The machine of a file, or of the program, to be looked at.
pub fn scene(name: &str) -> Result<Arc<Scene>, Failure> {
    let told = |error: &dyn std::fmt::Display| Failure::Usage(format!("{name}: {error}"));
    let machine = match named(name)? {
        Named::Belt(machine) => machine,
        Named::Mode(_) => return Err(told(&mode::NO_BELT)),
    };
    let scaled = ScaledMachine::new(machine).map_err(|error| told(&error))?;
    Ok(Arc::new(scaled.scene()))
}

impl Arguments {
    /// The machine with what was set on the command line.
    fn adjusted(&self, mut machine: Machine) -> Result<Machine, Failure> {
        for &(name, Toleranced { middle, half_width }) in &self.set {
            match name {
                Name::Number(varied) => {
                    varied.set(&mut machine.belt, middle.value).map_err(Failure::Usage)?;
                    machine.tolerances.half_widths.insert(varied.name().to_owned(), half_width);
                }
                Name::Displacement => machine.displacement = middle.value,
                Name::Velocity => machine.velocity = middle.value,
            }
        }
        let told = &mut machine.tolerances.disturbance;
        *told = self.disturbance.unwrap_or(*told);
        machine.tolerances.check(&machine.belt).map_err(Failure::Usage)?;
        let StartOverride { x, v } = self.start.unwrap_or_default();
        machine.displacement = x.unwrap_or(machine.displacement);
        machine.velocity = v.unwrap_or(machine.velocity);
        Ok(machine)
    }

    /// The method beside Taylor series.
    fn second(&self) -> Result<Option<SteppedMethod>, Failure> {
        let Some(method) = self.method else { return Ok(None) };
        let refused = |_| {
            let line = format!(
                "--method {method} knows one switching line only; a machine has two: allowed are {ALLOWED}"
            );
            Failure::Usage(line)
        };
        let Some(way) = SteppedMethod::of(method).map_err(refused)? else { return Ok(None) };
        if self.branch.is_some() || self.sweep.is_some() {
            let line =
                "--method dop853 and dopri5 follow one motion; --sweep and --branch have none";
            return Err(Failure::Usage(line.to_owned()));
        }
        Ok(Some(way))
    }

    /// The tolerance of that method.
    fn dial(&self) -> f64 {
        self.tol.unwrap_or(TOLERANCE)
    }

    /// The tolerance of the Taylor steps, which stay exact beside another method.
    fn own(&self, second: Option<SteppedMethod>) -> Option<f64> {
        self.tol.filter(|_| second.is_none())
    }

    /// Computes and prints.
    pub fn run(&self) -> Result<(), Failure> {
        let second = self.second()?;
        let machine = match named(&self.machine)? {
            Named::Mode(mode) => return self.of_mode(mode, second),
            Named::Belt(machine) => self.adjusted(machine)?,
        };
        let subject = Subject {
            tolerance: self.own(second),
            ..Body::Belt(Box::new(machine.belt.clone())).into()
        };
        if self.branch.is_some() || self.sweep.is_some() {
            return self.along(&subject, &Head::of_machine(&machine), &machine.tolerances);
        }
        let start = (machine.displacement, machine.velocity);
        let (found, seconds) = timed(self.output.repeat, || {
            let mut survey =
                survey(&machine.belt, start, machine.until, subject.tolerance, &Limits::PATIENT)?;
            if let Some(way) = second {
                survey.course.follow_by(way, self.dial(), start, machine.until);
            }
            let share = self.share(&survey.course.portrait);
            let Machine { belt, tolerances, .. } = &machine;
            let asked = !tolerances.is_none();
            let certain = asked.then(|| guaranteed(belt, tolerances)).transpose()?;
            Ok((survey, share, self.designed(&subject, tolerances)?, certain))
        });
        let (survey, rest_share, design, certain) = found.map_err(troubled)?;
        let incomplete = survey.course.portrait.incomplete();
        let answer =
            BeltAnswer { machine: &machine, survey: &survey, rest_share, design, certain, seconds };
        self.output.print(&match self.output.format {
            Format::Table => belt::table(&answer),
            Format::Json => belt::json(&answer),
            Format::Csv => belt::csv(&answer),
        })?;
        incomplete.map_or(Ok(()), |stop| Err(troubled(stop.into())))
    }

    /// The answer about a vibration mode, which has no belt.
    fn of_mode(&self, mut mode: Mode, second: Option<SteppedMethod>) -> Result<(), Failure> {
        if self.disturbance.is_some() {
            let line = "--disturbance is for belts: guaranteed margins of a mode are not computed";
            return Err(Failure::Usage(line.to_owned()));
        }
        for &(name, Toleranced { middle, half_width }) in &self.set {
            match name {
                Name::Number(_) if half_width > 0.0 => {
                    let line =
                        "a mode takes no tolerances: its guaranteed margins are not computed";
                    return Err(Failure::Usage(line.to_owned()));
                }
                Name::Number(varied) => {
                    varied.set_of_mode(&mut mode.numbers, middle.value).map_err(Failure::Usage)?;
                }
                Name::Displacement => mode.start.0 = middle.value,
                Name::Velocity => mode.start.1 = middle.value,
            }
        }
        let StartOverride { x, v } = self.start.unwrap_or_default();
        mode.start = (x.unwrap_or(mode.start.0), v.unwrap_or(mode.start.1));
        let subject =
            Subject { tolerance: self.own(second), ..Body::Mode(mode.numbers.clone()).into() };
        let none = Tolerances::default();
        if self.branch.is_some() || self.sweep.is_some() {
            return self.along(&subject, &Head::of_mode(&mode), &none);
        }
        let (found, seconds) = timed(self.output.repeat, || {
            let mut course = Course::new(&subject.model()?, mode.start, mode.until)?;
            if let Some(way) = second {
                course.follow_by(way, self.dial(), mode.start, mode.until);
            }
            Ok((course, self.designed(&subject, &none)?))
        });
        let (course, design) = found.map_err(troubled)?;
        let rest_share = self.share(&course.portrait);
        let incomplete = course.portrait.incomplete();
        let answer = ModeAnswer { mode: &mode, course: &course, rest_share, design, seconds };
        self.output.print(&match self.output.format {
            Format::Table => belt::mode::table(&answer),
            Format::Json => belt::mode::json(&answer),
            Format::Csv => belt::mode::csv(&answer),
        })?;
        incomplete.map_or(Ok(()), |stop| Err(troubled(stop.into())))
    }

    /// The answer along a number: a branch, or a sweep.
    fn along(&self, subject: &Subject, head: &Head, known: &Tolerances) -> Result<(), Failure> {
        if let Some(range) = self.branch {
            return self.branched(subject, head, range);
        }
        let Some(range) = self.sweep else { return Ok(()) };
        let (swept, seconds) =
            timed(self.output.repeat, || self.swept(subject, head, known, range));
        let answer = Sweep { seconds, ..swept? };
        self.output.print(&match self.output.format {
            Format::Table => belt::sweep_table(&answer),
            Format::Json => belt::sweep_json(&answer),
            Format::Csv => belt::sweep_csv(&answer),
        })
    }

    /// The branch, or the changes along it at values of another number.
    fn branched(&self, subject: &Subject, head: &Head, range: RangeInUnits) -> Result<(), Failure> {
        let RangeInUnits { varied, ends, count } = range;
        if let Some(other) = self.against {
            let (rows, seconds) = timed(self.output.repeat, || {
                let against = (other.varied, other.ends, other.count);
                borders(subject, (varied, ends, count), against)
            });
            let (rows, varied) = (rows.map_err(Failure::Usage)?, (varied, other.varied));
            let found = Borders { head, varied, rows, seconds };
            return self.output.print(&match self.output.format {
                Format::Table => belt::branch::borders_table(&found),
                Format::Json => belt::branch::borders_json(&found),
                Format::Csv => belt::branch::borders_csv(&found),
            });
        }
        let (found, seconds) =
            timed(self.output.repeat, || branch(subject.clone(), varied, ends, count));
        let found = Branched { head, varied, branch: found.map_err(Failure::Usage)?, seconds };
        self.output.print(&match self.output.format {
            Format::Table => belt::branch::table(&found),
            Format::Json => belt::branch::json(&found),
            Format::Csv => belt::branch::csv(&found),
        })
    }

    fn share(&self, portrait: &Portrait) -> RestShare {
        let Some(WindowInUnits { x: (from, to), v }) = self.window else {
            return RestShare::NotAsked;
        };
        let steady = if self.elongation { portrait.model.pull } else { 0.0 };
        let known = portrait.rest_share((from - steady, to - steady), v);
        known.map_or(RestShare::Unknown, RestShare::Is)
    }

    /// The friction for the margin, if asked for.
    fn designed(&self, subject: &Subject, known: &Tolerances) -> Result<Option<Designed>, Trouble> {
        let Some((kick, wanted)) = self.design else { return Ok(None) };
        let needed = friction_for(subject, known, kick, wanted)?;
        let at = subject.of_belt().map(|belt| belt.belt_speed);
        let has = subject.friction();
        Ok(needed.map(|needed| Designed { kick, wanted, needed, at, has }))
    }

    /// The sweep, with the friction for the margin at each point if asked for.
    fn swept<'a>(
        &self,
        subject: &Subject,
        head: &'a Head,
        known: &Tolerances,
        range: RangeInUnits,
    ) -> Result<Sweep<'a>, Failure> {
        let RangeInUnits { varied, ends, count } = range;
        let point = |index: usize| {
            let value = spaced(ends, index, count);
            let here = subject.with(varied, value).map_err(Failure::Usage)?;
            let found = here.portrait().map_err(|trouble| trouble.to_string());
            let rest_share = match &found {
                Ok(found) => self.share(found),
                Err(_) if self.window.is_some() => RestShare::Unknown,
                Err(_) => RestShare::NotAsked,
            };
            let design = match &found {
                Ok(_) => self.designed(&here, known).map_err(troubled)?,
                Err(_) => None,
            };
            Ok(SweepPoint { value, found, rest_share, design })
        };
        let points = (0..count).map(point).collect::<Result<_, Failure>>()?;
        Ok(Sweep { head, varied, points, seconds: 0.0 })
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
