//! `hopfscope trajectory`: one motion.

use clap::Args;

use super::failure::Failure;
use super::input::{self, given};
use super::machine::{MachineCase, print, second, troubled};
use super::output::{Certify, Format, Output};
use super::source::SourceOptions;
use super::timing::timed;
use crate::flow::trajectory::trajectory;
use crate::flow::{Detail, Fate, Limits, MachineMotion, Method, Outcome, Problem};
use crate::model::{Knob, MachineProblem, State};
use crate::numerics::Interval;
use crate::proof::ParameterBox;
use crate::proof::motion::{ProvedMotion, follow as enclosed};
use crate::report::{certified, machine_motion, trajectory as report};

/// Computes one motion: its turning points, how it ends, where its energy goes
#[derive(Debug, Args)]
pub struct Arguments {
    #[command(flatten)]
    source: SourceOptions,
    #[command(flatten)]
    output: Output,
    #[command(flatten)]
    certify: Certify,
    /// Time at which to stop, 0 .. 1e9 (default: the scene's)
    #[arg(long, value_name = "T", allow_hyphen_values = true)]
    until: Option<String>,
}

impl Arguments {
    pub fn run(&self) -> Result<(), Failure> {
        let until = self.until.as_ref();
        if let Some(mut case) = self.source.machine()? {
            let end = given("--until", until, |text| Knob::Duration.parse(text))?;
            case.problem.until = end.unwrap_or(case.problem.until);
            return self.of_machine(&case.checked()?);
        }
        let mut problem = self.source.start.problem()?;
        problem.until = given("--until", until, input::until)?.unwrap_or(problem.until);
        let follow = |energy| {
            let detail = Detail { energy, ..Detail::default() };
            trajectory(&problem, detail, &Limits::PATIENT)
        };
        // The energy ledger only checks the motion and is no part of its cost, so it is computed in a second run.
        let (mut motion, seconds) = timed(self.output.repeat, || follow(false));
        if !matches!(motion.outcome, Outcome::GaveUp { .. }) {
            motion = follow(true);
        }
        let State { q, v } = problem.initial;
        let enclose = || {
            let start = [q, v].map(Interval::point);
            enclosed(&ParameterBox::from(&problem.parameters), start, problem.until)
        };
        let certified = self.certify.ask(enclose);
        let line = |it: &ProvedMotion| certified::motion_line(it, problem.until);
        self.output.print(&match self.output.format {
            Format::Table => {
                report::table(&motion, seconds) + &certified.as_ref().map(line).unwrap_or_default()
            }
            Format::Json => report::json(&motion, certified.as_ref(), seconds),
            Format::Csv => report::csv(&motion, certified.as_ref()),
        })?;
        match motion.outcome {
            Outcome::GaveUp { tau, reason } => {
                let Problem { until, .. } = problem;
                Err(Failure::Unanswered(format!("gave up at tau = {tau:?} of {until:?}: {reason}")))
            }
            _ => Ok(()),
        }
    }

    fn of_machine(&self, case: &MachineCase) -> Result<(), Failure> {
        let MachineProblem { subject, start, until, .. } = &case.problem;
        let model = subject.model().map_err(troubled)?;
        let head = case.head();
        let way = second(self.source.start.method)?;
        let own = if way.is_some() { Knob::Tolerance.usual() } else { model.tolerance };
        let asked = (way.unwrap_or(Method::Taylor), self.source.start.tol.unwrap_or(own));
        let detail = Detail { energy: true, ..Detail::default() };
        let follow = || MachineMotion::by(&model, asked, *start, *until, detail);
        let (found, seconds) = timed(self.output.repeat, follow);
        print(&self.output, machine_motion::motion(&head, &case.problem, &found, seconds))?;
        let outcome = found.outcome;
        if let Fate::Unknown(stop) = outcome { Err(troubled(stop)) } else { Ok(()) }
    }
}
