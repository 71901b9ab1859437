//! `hopfscope belt`: a machine in physical units.

use std::path::PathBuf;

use clap::Args;

use super::figure::printed;
use super::input::{self, MACHINE, tolerance};
use super::{CommandCase, Output, Result, second, timed, troubled, write};
use crate::figure::panels;
use crate::flow::{Detail, Fate, Flow, Limits, Method, Problem, Reason, Subject};
use crate::model::{Knob, TolerancedNumber};
use crate::portrait::guarantee::machine::guaranteed;
use crate::portrait::{Kick, Portrait, StartWindow, friction_for};
use crate::question::Fineness;
use crate::report::About;
use crate::report::machine::{CubicExpansion, DesignAnswer, MachineAnswer, RestShare, machine};
use crate::runtime::print::{complete, figure};
use crate::runtime::provenance_file;
use crate::scene::machine::library::{TEXTBOOK, machines};

/// Analyses a mass on a belt in physical units
///
/// Tells its cycles, slipping and sticking, the border of what comes to rest and the margins up to it, and by how much the
/// cubic expansion of friction is wrong about them.
#[derive(Args)]
#[command(after_long_help = known())]
pub struct BeltCommand {
    /// Machine file, or the name of a built-in machine
    #[arg(value_name = "FILE", default_value = TEXTBOOK)]
    machine: String,
    /// Sets a quantity of the machine or its friction law, such as "v0=0.2 m/s", or with its uncertainty "R=1 N +- 0.2 N";
    /// repeatable; also the start x, v
    #[arg(long, value_name = "NAME=VALUE", value_parser = |text: &str| MACHINE.assignment(text))]
    set: Vec<(Knob, TolerancedNumber)>,
    /// Bound on a force that disturbs the mass in any way, such as "0.1 N": also reports the margin that is guaranteed under it
    #[arg(long, value_name = "FORCE", value_parser = |text: &str| Knob::DisturbingForce.parse(text))]
    disturbance: Option<f64>,
    /// Start of the motion, such as "x=1 mm,v=0 m/s"
    #[arg(long, value_name = "x=..,v=..", value_parser = input::start, value_delimiter = ',')]
    start: Vec<(Knob, TolerancedNumber)>,
    /// Window "XMIN:XMAX,VMIN:VMAX": reports the share of its starts that come to rest
    #[arg(long, value_parser = |text: &str| MACHINE.window(text))]
    window: Option<StartWindow>,
    /// Measures the window's displacements from the relaxed spring instead of the steady position
    #[arg(long, requires = "window")]
    elongation: bool,
    /// Finds the friction R that a margin needs: a displacement ("2 mm") or an impulse ("0.1 N s")
    #[arg(long, value_name = "MARGIN", value_parser = input::physical_margin)]
    design: Option<(Kick, f64)>,
    /// Integration method: auto or taylor (Taylor series); with dop853 or dopri5 the motion is computed a second
    /// time and the difference reported
    #[arg(long, value_name = "NAME", value_parser = input::method)]
    method: Option<Method>,
    /// Size of the last terms of a step, relative to the state, 1e-15 .. 0.01 (default: below rounding)
    #[arg(long, value_name = "X", value_parser = tolerance)]
    tol: Option<f64>,
    /// Also writes the answer as a page to print and sign: margins, cycles, pictures, SHA-256 of the machine file
    #[arg(long, value_name = "FILE.html", value_parser = |text: &str| input::file(text, "a page", "html"))]
    report: Option<PathBuf>,
    /// Replaces the page if the file holds something else
    #[arg(long, requires = "report")]
    force: bool,
    #[command(flatten)]
    output: Output,
}

fn known() -> String {
    let lead = "Machines of the program:".to_owned();
    machines().iter().fold(lead, |all, it| format!("{all}\n  {:9} {}", it.name, it.title))
}

impl BeltCommand {
    /// The machine and the motion, with the values set on the command line.
    fn case(&self) -> Result<CommandCase> {
        let mut case = CommandCase::named(&self.machine)?;
        case.set(&self.set)?;
        case.set(&self.start)?;
        let tolerances = &mut case.described.subject.tolerances;
        tolerances.disturbance = self.disturbance.unwrap_or(tolerances.disturbance);
        case.checked()
    }

    pub fn run(&self) -> Result<()> {
        let second = second(self.method)?;
        let mut case = self.case()?;
        // A second method takes the tolerance for itself.
        case.described.subject.source.tolerance = self.tol.filter(|_| second.is_none());
        let about = case.about();
        let (found, seconds) =
            timed(self.output.repeat, || self.answer(&case.described.subject, &about, second));
        let answer = found.map_err(troubled)?;
        if let Some(path) = &self.report {
            // The plots of a mass on a belt in the explorer; none of a mode.
            let mut pictures = Vec::new();
            if let Some(scene) = case.scene()? {
                let mut session = printed(scene);
                complete(&mut session, Fineness::PRINT, &Limits::PATIENT)?;
                let plots: Vec<_> = session.on_show().collect();
                pictures = panels(&figure(&mut session, &plots, &Limits::PATIENT));
            }
            let provenance = provenance_file::of_process();
            let is_mass = answer.expansion.is_some();
            let kind = if is_mass {
                "A mass on a belt"
            } else {
                "A vibration mode"
            };
            let page = machine(&answer, seconds).page(kind, &pictures, &provenance, &case.sources);
            write(path, page.as_bytes(), self.force)?;
        }
        self.output.print(machine(&answer, seconds))?;
        let incomplete = answer.portrait.incomplete();
        incomplete.map_or(Ok(()), |stop| Err(troubled(stop)))
    }

    /// The answer about the motion and the machine.
    fn answer<'a>(
        &self,
        subject: &'a Subject,
        about: &'a About,
        second: Option<Method>,
    ) -> Result<MachineAnswer<'a>, Reason> {
        let Subject { source, tolerances, .. } = subject;
        let (limits, belt, (x, v)) = (&Limits::PATIENT, source.of_belt(), subject.start());
        let expansion = belt.map(|belt| CubicExpansion::new(belt, limits)).transpose()?;
        let uncertain = belt.filter(|_| !tolerances.is_none());
        let certain = uncertain.map(|belt| guaranteed(belt, tolerances)).transpose()?;
        let portrait = source.portrait()?;
        let model = &portrait.model;
        let fate = portrait.fate(x, v)?;
        let rests =
            (fate == Fate::Rest).then(|| Flow::new(model).rest_of(x, v / model.omega_0, limits));
        let rest = rests.transpose()?;
        let (problem, _) = subject.problem()?;
        let follow = |problem: Problem, energy| {
            problem.followed(Some(model), Detail { energy, ..Detail::default() }, limits)
        };
        let motion = follow(problem, true);
        let second = second.map(|method| {
            let tolerance = self.tol.unwrap_or(Knob::Tolerance.usual());
            follow(Problem { method, tolerance, ..problem }, false)
        });
        let designed = |(kick, wanted)| -> Result<_, Reason> {
            let (needed, _) = friction_for(source, tolerances, kick, wanted, limits)?;
            Ok(needed.map(|needed| DesignAnswer { kick, wanted, needed }))
        };
        Ok(MachineAnswer {
            about,
            subject,
            rest_share: self.share(&portrait),
            design: self.design.map(designed).transpose()?.flatten(),
            portrait,
            motion,
            fate,
            rest,
            second,
            expansion,
            certain: certain.map(|found| found.map(|(_, margin)| margin)),
        })
    }

    fn share(&self, portrait: &Portrait) -> Option<RestShare> {
        let StartWindow { q: (from, to), v } = self.window?;
        let steady = if self.elongation { portrait.model.pull } else { 0.0 };
        Some(portrait.rest_share((from - steady, to - steady), v).map(|share| share.part))
    }
}
