//! The answer about a machine in sentences.

use super::{CubicExpansion, DesignAnswer, MachineAnswer};
use crate::flow::{Motion, Sample};
use crate::model::{Derivatives, FrictionLaw, Knob, Source};
use crate::portrait::{FrictionNeed, Kick};
use crate::report::{PLACES, interval};
use crate::words::motion::of_machine;
use crate::words::{joined, rounded_down, significant, with_unit};

/// The sentence about the impulse that is survived from any rest position: the guaranteed one, if it was asked for. Its
/// number is rounded down.
pub(super) fn statement(answer: &MachineAnswer) -> (String, bool) {
    let margin = match answer.certain {
        Some(Err(reason)) => {
            let known = answer.allowed();
            return (format!("No margin is guaranteed, for {known}: {reason}."), false);
        }
        Some(Ok(margin)) => margin,
        None => answer.portrait.margin,
    };
    let kick = match margin.from_rest.impulse {
        None => "every impulse".to_owned(),
        Some(0.0) => "no impulse, however small,".to_owned(),
        Some(least) => {
            format!("an impulse below {}", with_unit(rounded_down(least, 3), 3, "N s"))
        }
    };
    let varying = joined(answer.varying(), ", ");
    let whichever = if varying.is_empty() {
        varying
    } else {
        format!(", with {varying}")
    };
    let whatever = answer.disturbance().map_or_else(
        || "provided that no other force acts".to_owned(),
        |force| format!("whatever a force of at most {force} does"),
    );
    let text = format!("From any rest position{whichever}, {kick} is survived, {whatever}.");
    (text, margin.from_rest.impulse != Some(0.0))
}

impl MachineAnswer<'_> {
    /// The numbers that are not known exactly, each with its interval.
    fn varying(&self) -> Vec<String> {
        self.uncertain().iter().map(interval).collect()
    }

    /// The largest force of a disturbance, if there is one.
    fn disturbance(&self) -> Option<String> {
        let force = Some(self.subject.tolerances.disturbance).filter(|force| *force > 0.0);
        force.map(|force| with_unit(force, 12, "N"))
    }

    /// What the guaranteed margins allow for.
    fn allowed(&self) -> String {
        let disturbance = self.disturbance().map(|force| format!("disturbance {force}"));
        joined(self.varying().into_iter().chain(disturbance), ", ")
    }
}

/// For what the margins are guaranteed, if that was asked for.
pub(super) fn allowance(answer: &MachineAnswer) -> Option<String> {
    let known = answer.allowed();
    Some(match answer.certain? {
        Ok(_) => format!("guaranteed for {known}"),
        Err(reason) => format!("nothing is guaranteed for {known}: {reason}"),
    })
}

/// The motion, and what else was asked for, a line each.
pub(super) fn remarks(found: &MachineAnswer) -> Vec<String> {
    let mut all = vec![fate(found)];
    all.extend(found.second.as_ref().map(|second| by(second, found.motion.end())));
    all.extend(found.rest_share.map(|share| match share {
        Some(share) => format!("of the window, {} comes to rest", significant(share, 10)),
        None => "of the window, the part that comes to rest is not known: motions from its corners leave what \
                 is known"
            .to_owned(),
    }));
    all.extend(found.expansion.as_ref().map(|expansion| expansion.sentence(&found.portrait)));
    all.extend(found.design.map(|designed| designed.sentence(&found.subject.source)));
    all
}

impl DesignAnswer {
    /// The answer for a machine in a sentence.
    pub(super) fn sentence(&self, source: &Source) -> String {
        let (name, unit) = match self.kick {
            Kick::Displacement => ("displacement", "m"),
            Kick::Impulse => ("impulse", "N s"),
        };
        let number = |knob: Knob, unit| Some(with_unit(source.get(knob)?, PLACES, unit));
        let wanted = with_unit(self.wanted, PLACES, unit);
        let at = number(Knob::BeltSpeed, "m/s").map(|speed| format!(" at v0 = {speed}"));
        let has = number(Knob::Friction, "N").unwrap_or_default();
        let lead = format!("for a margin of {wanted} ({name}){}: ", at.unwrap_or_default());
        let force = self.needed.least().map(|force| with_unit(force, 10, "N")).unwrap_or_default();
        lead + &match self.needed {
            FrictionNeed::Any => "any R suffices, however small; damping alone keeps it".to_owned(),
            FrictionNeed::Friction { .. } => {
                format!("R = {force} is needed (the machine has {has})")
            }
            FrictionNeed::Fold { below, .. } => format!(
                "R above {force} is needed (the machine has {has}); every kick is survived then, while just \
                 below the margin is {}",
                with_unit(below, PLACES, unit)
            ),
        }
    }
}

/// The friction law at the belt speed.
pub(super) fn friction(CubicExpansion { belt, reduced, .. }: &CubicExpansion) -> String {
    let Derivatives { value, first, second, third } = reduced.mu;
    let from = match &belt.law {
        FrictionLaw::Table(spline) => {
            let (points, away) = (spline.points(), significant(spline.missed, 3));
            format!("the smoothest curve near {points} points, {away} away in the quadratic mean")
        }
        law => law.name().to_owned(),
    };
    let [mu, first, second, third] =
        [value, first, second, third].map(|number| significant(number, PLACES));
    let higher = format!("mu'' = {second} s^2/m^2, mu''' = {third} s^3/m^3");
    format!("friction ({from}) at v0: mu = {mu}, mu' = {first} s/m, {higher}")
}

/// How the motion ends, in a sentence.
fn fate(MachineAnswer { subject, portrait, motion, fate, rest, .. }: &MachineAnswer) -> String {
    let (x, v) = subject.start();
    let (x, v) = (with_unit(x, PLACES, "m"), with_unit(v, PLACES, "m/s"));
    let time = motion.outcome.rest().ok().flatten();
    let end = of_machine(*fate, [*rest, time], portrait.tends_to(*fate), "", PLACES);
    format!("from x = {x}, v = {v}: {end}")
}

/// The motion by the second method, compared with the first, in a sentence.
fn by(second: &Motion, first: Sample) -> String {
    let lead = format!("by {} at {:e}: ", second.method, second.problem.tolerance);
    let end = match second.known_end() {
        Ok(end) => end,
        Err(stop) => return format!("{lead}{stop}"),
    };
    let moment = with_unit(first.tau, PLACES, "s");
    let state = |q: f64, v: f64, digits| (with_unit(q, digits, "m"), with_unit(v, digits, "m/s"));
    let (x, v) = state(end.q, end.v, 12);
    let (shift, change) = state((end.q - first.q).abs(), (end.v - first.v).abs(), 2);
    format!("{lead}at t = {moment} x = {x}, v = {v}; Taylor series differ by {shift} and {change}")
}
