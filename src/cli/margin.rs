//! `hopfscope margin` and `hopfscope kicks`: how large a kick is survived.

use clap::Args;

use super::{CommandCase, Output, QuestionOptions, Result, number, read, timed, troubled};
use crate::flow::Subject;
use crate::model::Knob;
use crate::portrait::guarantee::machine;
use crate::portrait::{Portrait, guaranteed, repeated};
use crate::report::About;
use crate::report::margin::{kicks, margins, of_box};

/// Finds how large a kick is survived under every bounded disturbance, at all parameters in a box
#[derive(Args)]
pub struct MarginCommand {
    /// Bound on the disturbing force, in the units of r; of a machine a force, such as "0.1 N"
    #[arg(long, value_name = "W")]
    disturbance: Option<String>,
}

impl MarginCommand {
    pub fn run(&self, asked: &QuestionOptions) -> Result<()> {
        let knob = asked.source.numbers()?.disturbance;
        let bound = number("--disturbance", self.disturbance.as_ref(), knob)?;
        if let Some(mut case) = asked.source.portrayed()? {
            let known = &mut case.described.subject.tolerances;
            known.disturbance = bound.unwrap_or(known.disturbance);
            return of_machine(&case.checked()?, &asked.output);
        }
        let (known, bound) = (asked.source.known()?, bound.unwrap_or(0.0));
        let ask = || {
            let nominal = Portrait::innermost(&known.middle(), 0.0, &asked.output.limits())?;
            Ok((nominal, guaranteed(&known, bound, 0.0, &asked.output.limits())?))
        };
        let timed = asked.output.timed("the margin could not be computed", ask)?;
        let ((nominal, certain), seconds) = timed;
        asked.output.print(of_box(&About::boxed(&known), &nominal, certain, bound, seconds))
    }
}

/// Answers about a machine; what is known exactly has its own margin for certain.
fn of_machine(case: &CommandCase, output: &Output) -> Result<()> {
    let Subject { source, tolerances, .. } = &case.described.subject;
    let (found, mut seconds) = case.portrait(output, 0.0)?;
    let certain = match source.of_belt().filter(|_| !tolerances.is_none()) {
        None => Ok(found.margin),
        Some(belt) => {
            let (certain, more) = timed(output.repeat, || machine::guaranteed(belt, tolerances));
            seconds += more;
            certain.map_err(troubled)?.map(|(_, margin)| margin)
        }
    };
    let uncertain = source.of_belt().map(|belt| tolerances.intervals(belt));
    let about = case.about().within(&uncertain.unwrap_or_default());
    let answer = margins(&about, (found.margin, found.border), certain, tolerances.disturbance);
    output.print(answer.portrayed(&found, seconds))
}

/// Finds the share of random kicks that is lost, and how many in a row are survived
#[derive(Args)]
pub struct KicksCommand {
    /// Displacement and velocity of a kick, mean and standard deviation; with uniform: before them, mean and
    /// half width
    #[arg(long, value_name = "q=MEAN+-SPREAD,v=MEAN+-SPREAD")]
    kicks: String,
}

impl KicksCommand {
    pub fn run(&self, asked: &QuestionOptions) -> Result<()> {
        let numbers = asked.source.numbers()?;
        let law = read("--kicks", &self.kicks, |text| numbers.kicks(text))?;
        let case = asked.source.exact()?;
        let r = case.described.subject.source.get(Knob::R).unwrap_or(0.0);
        let (portrait, before) = case.portrait(&asked.output, law.reach() + r)?;
        let follow = || repeated(&portrait, &law, &asked.output.limits());
        let (found, seconds) = asked.output.timed("the kicks could not be followed", follow)?;
        let held = portrait.model.guide_static;
        asked.output.print(kicks(&case.about(), &law, &found, held, before + seconds))
    }
}
