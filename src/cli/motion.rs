//! `hopfscope trajectory` and `hopfscope trade`: one motion, and what its accuracy costs.

use clap::Args;

use super::times::TimeOptions;
use super::{
    CERTIFY, Failure, QuestionOptions, Result, in_turn, number, provable, second, timed, troubled,
};
use crate::accuracy::Trade;
use crate::flow::{Detail, Limits, Method, Motion, Outcome, Problem};
use crate::model::{Knob, Model};
use crate::numerics::Interval;
use crate::proof::{ParameterBox, follow as enclosed};
use crate::report::motion::MomentRow;
use crate::report::{About, motion};
use crate::runtime::tell;
use crate::view::trade_plot::in_letters;

/// The motion that is asked for.
struct AskedMotion<'a> {
    about: About,
    problem: Problem,
    /// That of a machine, whose motions are in SI units; `None` for the oscillator of the paper.
    model: Option<Model>,
    limits: Limits<'a>,
}

impl<'a> AskedMotion<'a> {
    /// The motion of the scene or the machine until a time. That of a machine is followed by the method and to the
    /// tolerance that are asked for or else its own.
    fn new(
        QuestionOptions { source, output }: &'a QuestionOptions,
        until: Option<&String>,
    ) -> Result<Self> {
        let mut case = source.case()?;
        let motion = &mut case.described.subject.motion;
        let end = number("--until", until, source.numbers()?.until)?;
        motion.until = end.unwrap_or(motion.until);
        let case = case.checked()?;
        let (mut problem, model) = case.described.subject.problem().map_err(troubled)?;
        if model.is_some()
            && let Some(way) = second(source.start.method)?
        {
            problem.method = way;
            problem.tolerance = source.start.tol.unwrap_or(Knob::Tolerance.usual());
        }
        let about = case.about().told_as(output.format());
        Ok(AskedMotion { about, problem, model, limits: output.limits() })
    }

    /// Follows the motion, as a problem that may have another method or accuracy.
    fn follow(&self, problem: &Problem, energy: bool) -> Motion {
        let detail = Detail { energy, ..Detail::default() };
        problem.followed(self.model.as_ref(), detail, &self.limits)
    }

    /// Where the motion is at these times; a time at which that is not known keeps its row, and a note says so.
    fn at_times(&self, times: &[f64]) -> Vec<MomentRow> {
        let model = self.model.as_ref();
        let (found, samples) = self.problem.at_times(model, times, Detail::default(), &self.limits);
        let unknown = samples.iter().filter(|sample| sample.is_none()).count();
        if unknown > 0 {
            let (word, tau) = (found.outcome.word(), found.outcome.tau());
            tell(format!("note: {word} at tau = {tau:?}, so {unknown} times have no state"));
        }
        times.iter().copied().zip(samples).collect()
    }
}

/// Computes one motion: its turning points, how it ends, where its energy goes
#[derive(Args)]
pub struct TrajectoryCommand {
    /// Time at which to stop, 0 .. 1e9 (default: the scene's)
    #[arg(long, value_name = "T")]
    until: Option<String>,
    #[arg(long, help = CERTIFY)]
    certify: bool,
    #[command(flatten)]
    times: TimeOptions,
}

impl TrajectoryCommand {
    pub fn run(&self, question: &QuestionOptions) -> Result<()> {
        let asked = AskedMotion::new(question, self.until.as_ref())?;
        let (problem, is_machine) = (&asked.problem, asked.model.is_some());
        provable(self.certify, is_machine)?;
        let (mut found, seconds) =
            timed(question.output.repeat, || asked.follow(problem, is_machine));
        // The energy ledger of the oscillator only checks the motion and is no part of its cost, so it is computed in a
        // second run.
        if !is_machine && !matches!(found.outcome, Outcome::GaveUp { .. }) {
            found = asked.follow(problem, true);
        }
        let times = self.times.asked(question.source.numbers()?.until, problem.until)?;
        if is_machine && times.is_some() && problem.method != Method::Taylor {
            return Err("at times a machine is followed by --method auto or taylor".into());
        }
        let samples = times.map(|times| asked.at_times(&times));
        let enclose = || {
            let start = [problem.initial.q, problem.initial.v].map(Interval::point);
            enclosed(&ParameterBox::from(&problem.parameters), start, problem.until)
        };
        let certified = self.certify.then(enclose);
        let answer = motion::motion(&asked.about, &found, certified.as_ref(), seconds);
        question.output.print(answer.sampled(samples.as_deref()))?;
        match found.outcome {
            Outcome::GaveUp { tau, reason } if !is_machine => {
                let place = format!("gave up at tau = {tau:?} of {:?}", problem.until);
                Err(Failure::unanswered(place, reason))
            }
            outcome => outcome.answered().map_err(troubled),
        }
    }
}

/// Shows what accuracy costs: every method at all its tolerances on the same motion
#[derive(Args)]
pub struct TradeCommand {
    /// Time at which to stop, 0 .. 1e9 (default: the scene's)
    #[arg(long, value_name = "T")]
    until: Option<String>,
}

impl TradeCommand {
    pub fn run(&self, question: &QuestionOptions) -> Result<()> {
        let asked = AskedMotion::new(question, self.until.as_ref())?;
        let machine = asked.model.as_ref();
        let unmeasured = |reason| match machine {
            Some(_) => troubled(reason),
            None => Failure::unanswered("there is nothing to measure errors against", reason),
        };
        let found = Trade::of(machine, &asked.problem, &asked.limits);
        let mut found = found.map_err(unmeasured)?;
        let seconds = in_turn(question.output.repeat, found.rows.len(), |index| {
            // A row that was given up used its whole budget; it is not repeated.
            let row = &found.rows[index];
            row.error().map(|_| asked.follow(&row.problem, false))
        });
        found.rows.iter_mut().zip(seconds).for_each(|(row, seconds)| row.seconds = seconds);
        question.output.print(motion::trade(&asked.about, &found, &in_letters(&found)))
    }
}
