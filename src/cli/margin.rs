//! `hopfscope margin`, `hopfscope basin` and `hopfscope kicks`: how large a kick is survived.

use clap::Args;

use super::input::{self, WINDOW};
use super::{
    Certify, Failure, MachineCase, Output, SourceOptions, given, number, read, timed, troubled,
};
use crate::flow::Limits;
use crate::model::MachineProblem;
use crate::portrait::Portrait;
use crate::portrait::basin::basin;
use crate::portrait::guarantee::machine;
use crate::portrait::guarantee::oscillator::{guaranteed, nominal};
use crate::portrait::kicks::repeated::repeated;
use crate::portrait::proved::agreed;
use crate::proof;
use crate::proof::{ParameterBox, prove};
use crate::report::About;
use crate::report::margin::{basin_of_machine, basin_of_oscillator, kicks, margins};

/// Finds how large a kick is survived under every bounded disturbance, at all parameters in a box
#[derive(Debug, Args)]
pub struct MarginCommand {
    #[command(flatten)]
    source: SourceOptions,
    /// Bound on the disturbing force, in the units of r; of a machine a force, such as "0.1 N"
    #[arg(long, value_name = "W", allow_hyphen_values = true)]
    disturbance: Option<String>,
    #[command(flatten)]
    output: Output,
}

impl MarginCommand {
    pub fn run(&self) -> Result<(), Failure> {
        let knob = self.source.numbers().disturbance;
        let bound = number("--disturbance", self.disturbance.as_ref(), knob)?;
        if let Some(mut case) = self.source.portrayed()? {
            let known = &mut case.described.problem.tolerances;
            known.disturbance = bound.unwrap_or(known.disturbance);
            return self.of_machine(&case.checked()?);
        }
        let (known, bound) = (self.source.start.known()?, bound.unwrap_or(0.0));
        let ask = || {
            let nominal = nominal(&known, &Limits::PATIENT)?;
            Ok((nominal, guaranteed(&known, bound, 0.0, &Limits::PATIENT)?))
        };
        let timed = self.output.timed("the margin could not be computed", ask)?;
        let ((nominal, certain), seconds) = timed;
        let mut cost = nominal.cost;
        if let Ok((basin, _)) = &certain {
            cost += basin.cost;
        }
        let certain = certain.map(|(_, margin)| margin);
        let answer = margins(&About::boxed(&known), nominal.margin(), certain, bound);
        self.output.print(answer.cost(cost, seconds))
    }

    /// Answers about a machine; what is known exactly has its own margin for certain.
    fn of_machine(&self, case: &MachineCase) -> Result<(), Failure> {
        let MachineProblem { subject, tolerances, .. } = &case.described.problem;
        let (found, mut seconds) = case.portrait(&self.output)?;
        let certain = match subject.of_belt().filter(|_| !tolerances.is_none()) {
            None => Ok(found.margin),
            Some(belt) => {
                let (certain, more) =
                    timed(self.output.repeat, || machine::guaranteed(belt, tolerances));
                seconds += more;
                certain.map_err(troubled)?.map(|(_, margin)| margin)
            }
        };
        let uncertain = subject.of_belt().map(|belt| tolerances.intervals(belt));
        let about = case.about().within(&uncertain.unwrap_or_default());
        let answer = margins(&about, found.margin, certain, tolerances.disturbance);
        self.output.print(answer.portrayed(&found, seconds))
    }
}

/// Shows where the starts in a window end, and how large a kick is survived
#[derive(Debug, Args)]
pub struct BasinCommand {
    #[command(flatten)]
    source: SourceOptions,
    #[command(flatten)]
    output: Output,
    #[command(flatten)]
    certify: Certify,
    /// Displacements and velocities of the starts (default: -3:3,-3:3; of a machine one and a half times its largest
    /// cycle, or its margin)
    #[arg(long, value_name = "QMIN:QMAX,VMIN:VMAX", allow_hyphen_values = true)]
    window: Option<String>,
    /// Number of starts, evenly spaced, including both ends of the window
    #[arg(long, value_name = "WxH", default_value = "320x384", value_parser = input::grid)]
    grid: (usize, usize),
}

impl BasinCommand {
    pub fn run(&self) -> Result<(), Failure> {
        let numbers = self.source.numbers();
        let window = given("--window", self.window.as_ref(), |text| numbers.window(text))?;
        if let Some(case) = self.source.portrayed()? {
            let (found, before) = case.portrait(&self.output)?;
            let window = window.unwrap_or_else(|| found.surroundings());
            let (counts, seconds) = timed(self.output.repeat, || found.count(&window, self.grid));
            let captured = found.rest_share(window.q, window.v).map(|share| share.part);
            let seconds = before + seconds;
            let answer = basin_of_machine(&case.about(), &found, counts, captured, seconds);
            return self.output.print(answer);
        }
        let parameters = self.source.start.scene(None)?.problem.parameters;
        let window = window.unwrap_or(WINDOW);
        let reach = window.q.0.abs().max(window.q.1.abs());
        let survey = || {
            let found = basin(&parameters, reach, &Limits::PATIENT)?;
            let counts = found.count(&window, self.grid, &Limits::PATIENT)?;
            Ok((found, counts))
        };
        let timed = self.output.timed("the basin could not be completed", survey)?;
        let ((found, counts), seconds) = timed;
        let enclose = || {
            let proof = prove(&ParameterBox::from(&parameters), &[]);
            let margin = found.margin();
            let hints = [margin.displacement, margin.impulse, margin.from_rest.impulse];
            agreed(proof::kicks::kicks(&proof, hints), &found)
        };
        let certified = self.certify.ask(enclose);
        let about = About::oscillator(&parameters);
        self.output.print(basin_of_oscillator(&about, &found, counts, certified.as_ref(), seconds))
    }
}

/// Finds the share of random kicks that is lost, and how many in a row are survived
#[derive(Debug, Args)]
pub struct KicksCommand {
    #[command(flatten)]
    source: SourceOptions,
    #[command(flatten)]
    output: Output,
    /// Displacement and velocity of a kick, mean and standard deviation; with uniform: before them, mean and
    /// half width
    #[arg(
        long = "kicks",
        value_name = "q=MEAN+-SPREAD,v=MEAN+-SPREAD",
        allow_hyphen_values = true
    )]
    law: String,
}

impl KicksCommand {
    pub fn run(&self) -> Result<(), Failure> {
        const FAILED: &str = "the kicks could not be followed";
        let law = read("--kicks", &self.law, |text| self.source.numbers().kicks(text))?;
        let (about, (portrait, before)) = if let Some(case) = self.source.portrayed()? {
            (case.about(), case.portrait(&self.output)?)
        } else {
            let parameters = self.source.start.scene(None)?.problem.parameters;
            let reach = law.reach() + parameters.r;
            let ask = || Portrait::of_oscillator(&parameters, reach, &Limits::PATIENT);
            (About::oscillator(&parameters), self.output.timed(FAILED, ask)?)
        };
        let follow = || repeated(&portrait, &law, &Limits::PATIENT);
        let (found, seconds) = self.output.timed(FAILED, follow)?;
        let held = portrait.model.guide_static;
        self.output.print(kicks(&about, &law, &found, held, before + seconds))
    }
}
