//! `hopfscope trajectory` and `hopfscope trade`: one motion, and what its accuracy costs.

use clap::Args;

use super::{
    Certify, Failure, MachineCase, Output, SourceOptions, in_turn, number, second, timed, troubled,
};
use crate::accuracy::trade::Trade;
use crate::flow::trajectory::trajectory;
use crate::flow::{Detail, Limits, Method, MotionUnits, Outcome, Problem, Trajectory, follow};
use crate::model::{Knob, MachineProblem, Model, State};
use crate::numerics::Interval;
use crate::proof::ParameterBox;
use crate::proof::motion::follow as enclosed;
use crate::report::{About, motion, trade};
use crate::view::trade_plot::in_letters;

/// Which motion, how far, and how the answer is printed.
#[derive(Debug, Args)]
struct MotionOptions {
    #[command(flatten)]
    source: SourceOptions,
    #[command(flatten)]
    output: Output,
    /// Time at which to stop, 0 .. 1e9 (default: the scene's)
    #[arg(long, value_name = "T", allow_hyphen_values = true)]
    until: Option<String>,
}

impl MotionOptions {
    /// The end that is asked for.
    fn end(&self) -> Result<Option<f64>, Failure> {
        number("--until", self.until.as_ref(), self.source.numbers().until)
    }

    /// The motion of a machine, if it is about one.
    fn of_machine(&self) -> Result<Option<MachineCase>, Failure> {
        let Some(mut case) = self.source.machine()? else { return Ok(None) };
        case.described.problem.until = self.end()?.unwrap_or(case.described.problem.until);
        case.checked().map(Some)
    }

    /// The motion of a machine, by the method and to the tolerance that are asked for or else its own.
    fn problem_of_machine(&self, case: &MachineCase, model: &Model) -> Result<Problem, Failure> {
        let MachineProblem { start: (q, v), until, .. } = case.described.problem;
        let start = &self.source.start;
        let way = second(start.method)?;
        let own = if way.is_some() { Knob::Tolerance.usual() } else { model.tolerance };
        let tolerance = start.tol.unwrap_or(own);
        let (method, initial) = (way.unwrap_or(Method::Taylor), State { q, v });
        Ok(Problem { initial, until, method, tolerance, ..Problem::default() })
    }

    /// The motion of the scene with this name, or of the one among the options.
    fn problem(&self, named: Option<&str>) -> Result<Problem, Failure> {
        let mut problem = self.source.start.scene(named)?.problem;
        problem.until = self.end()?.unwrap_or(problem.until);
        Ok(problem)
    }
}

/// Computes one motion: its turning points, how it ends, where its energy goes
#[derive(Debug, Args)]
pub struct TrajectoryCommand {
    #[command(flatten)]
    asked: MotionOptions,
    #[command(flatten)]
    certify: Certify,
}

impl TrajectoryCommand {
    pub fn run(&self) -> Result<(), Failure> {
        if let Some(case) = self.asked.of_machine()? {
            return self.of_machine(&case);
        }
        let output = &self.asked.output;
        let problem = self.asked.problem(None)?;
        let follow = |energy| {
            let detail = Detail { energy, ..Detail::default() };
            trajectory(&problem, detail, &Limits::PATIENT)
        };
        // The energy ledger only checks the motion and is no part of its cost, so it is computed in a second run.
        let (mut found, seconds) = timed(output.repeat, || follow(false));
        if !matches!(found.outcome, Outcome::GaveUp { .. }) {
            found = follow(true);
        }
        let State { q, v } = problem.initial;
        let enclose = || {
            let start = [q, v].map(Interval::point);
            enclosed(&ParameterBox::from(&problem.parameters), start, problem.until)
        };
        let certified = self.certify.ask(enclose);
        let about = About::oscillator(&problem.parameters);
        output.print(motion::motion(&about, &found, certified.as_ref(), seconds))?;
        match found.outcome {
            Outcome::GaveUp { tau, reason } => {
                let Problem { until, .. } = problem;
                Err(Failure::Unanswered(format!("gave up at tau = {tau:?} of {until:?}: {reason}")))
            }
            _ => Ok(()),
        }
    }

    fn of_machine(&self, case: &MachineCase) -> Result<(), Failure> {
        let about = case.about();
        let output = &self.asked.output;
        let model = case.described.problem.subject.model().map_err(troubled)?;
        let problem = self.asked.problem_of_machine(case, &model)?;
        let detail = Detail { energy: true, ..Detail::default() };
        let units = MotionUnits::physical(&model);
        let (found, seconds) = timed(output.repeat, || follow(&model, &problem, units, detail));
        output.print(motion::motion(&about, &found, None, seconds))?;
        found.outcome.answered().map_err(troubled)
    }
}

/// Shows what accuracy costs: every method at all its tolerances on the same motion
#[derive(Debug, Args)]
pub struct TradeCommand {
    /// Scene whose motion is computed
    #[arg(value_name = "SCENE", conflicts_with_all = ["scene", "machine"])]
    named: Option<String>,
    #[command(flatten)]
    asked: MotionOptions,
}

impl TradeCommand {
    pub fn run(&self) -> Result<(), Failure> {
        let detail = Detail::default();
        if let Some(case) = self.asked.of_machine()? {
            let about = case.about();
            let model = case.described.problem.subject.model().map_err(troubled)?;
            let problem = self.asked.problem_of_machine(&case, &model)?;
            let found = Trade::of_machine(&model, &problem).map_err(troubled)?;
            let units = MotionUnits::physical(&model);
            return self.tell(&about, found, |problem| follow(&model, problem, units, detail));
        }
        let problem = self.asked.problem(self.named.as_deref())?;
        let found = Trade::of(&problem, &Limits::PATIENT).map_err(|reason| {
            Failure::Unanswered(format!("there is nothing to measure errors against: {reason}"))
        })?;
        let about = About::oscillator(&problem.parameters);
        self.tell(&about, found, |problem| trajectory(problem, detail, &Limits::PATIENT))
    }

    /// Tells a trade with the times that its rows take when they are followed again.
    fn tell(
        &self,
        about: &About,
        found: Trade,
        again: impl Fn(&Problem) -> Trajectory,
    ) -> Result<(), Failure> {
        let output = &self.asked.output;
        let seconds = in_turn(output.repeat, found.rows.len(), |index| {
            // A row that was given up used its whole budget; it is not repeated.
            let row = &found.rows[index];
            row.error().map(|_| again(&row.problem))
        });
        let timed = trade::TimedTrade { trade: found, seconds };
        output.print(trade::trade(about, &timed, || in_letters(&timed.trade, &timed.seconds)))
    }
}
