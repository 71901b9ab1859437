//! The answer about a machine in sentences.

use super::{DesignAnswer, MachineAnswer, OnBelt, excess, in_units};
use crate::flow::{Sample, Trajectory};
use crate::model::belt::{Derivatives, FrictionLaw};
use crate::portrait::{Course, CubicExpansion, FrictionNeeded, Kick, Margin, Portrait};
use crate::report::answer::{PLACES, interval};
use crate::words::motion::of_machine;
use crate::words::number::rounded_down;
use crate::words::{significant, with_unit};

/// The sentence about the impulse that is survived from any rest position: the guaranteed one, if it was asked for. Its
/// number is rounded down.
pub(super) fn statement(answer: &MachineAnswer) -> (String, bool) {
    let belt = answer.on_belt.as_ref();
    let certain = belt.and_then(|belt| Some((belt, belt.certain.as_ref()?)));
    let nominal = answer.course.portrait.margin;
    let margin = match certain {
        Some((belt, Err(reason))) => {
            let text = format!("No kick is survived for certain, for {}: {reason}.", allowed(belt));
            return (text, false);
        }
        Some((_, Ok(margin))) => *margin,
        None => nominal,
    };
    let kick = match margin.from_rest.impulse {
        None => "every impulse".to_owned(),
        Some(0.0) => "no impulse, however small,".to_owned(),
        Some(least) => {
            format!("an impulse below {}", with_unit(rounded_down(least, 3), 3, "N s"))
        }
    };
    let varying = belt.map(varying).unwrap_or_default();
    let whichever = match varying[..] {
        [] => String::new(),
        _ => format!(", with {}", varying.join(", ")),
    };
    let whatever = belt.and_then(disturbance).map_or_else(
        || "provided that no other force acts".to_owned(),
        |force| format!("whatever a force of at most {force} does"),
    );
    let text = format!("From any rest position{whichever}, {kick} is survived, {whatever}.");
    (text, margin.from_rest.impulse != Some(0.0))
}

/// The numbers that are not known exactly, each with its interval.
fn varying(belt: &OnBelt) -> Vec<String> {
    belt.uncertain().iter().map(interval).collect()
}

/// The largest force of a disturbance, if there is one.
fn disturbance(belt: &OnBelt) -> Option<String> {
    let force = Some(belt.tolerances.disturbance).filter(|force| *force > 0.0);
    force.map(|force| with_unit(force, 12, "N"))
}

/// What the guaranteed margins allow for.
fn allowed(belt: &OnBelt) -> String {
    let disturbance = disturbance(belt).map(|force| format!("disturbance {force}"));
    varying(belt).into_iter().chain(disturbance).collect::<Vec<_>>().join(", ")
}

/// For what the margins are guaranteed, if that was asked for.
pub(super) fn allowance(belt: &OnBelt) -> Option<String> {
    Some(match belt.certain? {
        Ok(_) => format!("guaranteed for {}", allowed(belt)),
        Err(reason) => format!("nothing is guaranteed for {}: {reason}", allowed(belt)),
    })
}

/// The motion, and what else was asked for, a line each.
pub(super) fn remarks(found: &MachineAnswer) -> Vec<String> {
    let fate = fate(found.start, &found.course);
    let mut all: Vec<String> = fate.lines().map(str::to_owned).collect();
    all.extend(found.rest_share.map(|share| match share {
        Some(share) => format!("of the window, {} comes to rest", significant(share, 10)),
        None => "of the window, the part that comes to rest is not known: motions from its corners leave what \
                 is known"
            .to_owned(),
    }));
    let expansion = found.on_belt.as_ref().map(|belt| &belt.expansion);
    all.extend(expansion.map(|it| by_expansion(it, &found.course.portrait)));
    all.extend(found.design.as_ref().map(DesignAnswer::sentence));
    all
}

/// The result of the cubic expansion, in a sentence.
fn by_expansion(expansion: &CubicExpansion, portrait: &Portrait) -> String {
    let lead = "friction as a cubic (the oscillator of the paper) says: ";
    let found = match &expansion.portrait {
        Ok(found) => found,
        Err(reason) => return format!("{lead}nothing; {reason}"),
    };
    let margin = margin_sentence(&in_units(&found.margin, expansion), &portrait.margin);
    let count = |stable| found.cycles.iter().filter(|cycle| cycle.stable == stable).count();
    let (unstable, stable) = (count(false), count(true));
    format!("{lead}{margin}; {unstable} unstable and {stable} stable cycles")
}

/// How large the margin of the expansion is, and how wrong.
fn margin_sentence(physical: &Margin, whole: &Margin) -> String {
    let Some(own) = physical.displacement else {
        return "every kick is survived".to_owned();
    };
    let judged = match excess(Some(own), whole.displacement) {
        Some(error) if error != 0.0 && own != error => {
            let percent = significant(100.0 * error.abs() / (own - error).abs(), 2);
            format!(", {percent} % too {}", if error > 0.0 { "large" } else { "small" })
        }
        _ => String::new(),
    };
    format!("margin {}{judged}", with_unit(own, PLACES, "m"))
}

impl DesignAnswer {
    /// The answer in a sentence.
    pub(super) fn sentence(&self) -> String {
        let (name, unit) = match self.kick {
            Kick::Displacement => ("displacement", "m"),
            Kick::Impulse => ("impulse", "N s"),
        };
        let wanted = with_unit(self.wanted, PLACES, unit);
        let at = self.at.map(|v0| format!(" at v0 = {}", with_unit(v0, PLACES, "m/s")));
        let has = with_unit(self.has, PLACES, "N");
        let lead = format!("for a margin of {wanted} ({name}){}: ", at.unwrap_or_default());
        let force = self.needed.least().map(|force| with_unit(force, 10, "N")).unwrap_or_default();
        lead + &match self.needed {
            FrictionNeeded::Any => {
                "any R suffices, however small; damping alone keeps it".to_owned()
            }
            FrictionNeeded::Friction { .. } => {
                format!("R = {force} is needed (the machine has {has})")
            }
            FrictionNeeded::Fold { below, .. } => format!(
                "R above {force} is needed (the machine has {has}); every kick is survived then, while just \
                 below the margin is {}",
                with_unit(below, PLACES, unit)
            ),
        }
    }
}

/// The friction law at the belt speed.
pub(super) fn friction(law: &FrictionLaw, mu: &Derivatives) -> String {
    let Derivatives { value, first, second, third } = *mu;
    let from = match law {
        FrictionLaw::Table(spline) => format!(
            "the smoothest curve near {} points, {} away in the quadratic mean",
            spline.points(),
            significant(spline.missed(), 3)
        ),
        _ => law.name().to_owned(),
    };
    let number = |value| significant(value, PLACES);
    format!(
        "friction ({from}) at v0: mu = {}, mu' = {} s/m, mu'' = {} s^2/m^2, mu''' = {} s^3/m^3",
        number(value),
        number(first),
        number(second),
        number(third)
    )
}

/// How the motion ends, in a sentence.
fn fate((x, v): (f64, f64), course: &Course) -> String {
    let (x, v) = (with_unit(x, PLACES, "m"), with_unit(v, PLACES, "m/s"));
    let cycle = course.portrait.tends_to(course.fate);
    let time = course.motion.outcome.rest().ok().flatten();
    let end = of_machine(course.fate, [course.rest, time], cycle, "", PLACES);
    let by = course.second.as_ref().map_or_else(String::new, |second| by(second, course));
    format!("from x = {x}, v = {v}: {end}{by}")
}

/// The motion by the second method, compared with the first, in a sentence.
fn by(second: &Trajectory, course: &Course) -> String {
    let Sample { tau: t, q: x, v } = course.motion.end();
    let lead = format!("\nby {} at {:e}: ", second.method, second.problem.tolerance);
    lead + &match second.known_end() {
        Ok(end) => format!(
            "at t = {} x = {}, v = {}; Taylor series differ by {} and {}",
            with_unit(t, PLACES, "s"),
            with_unit(end.q, 12, "m"),
            with_unit(end.v, 12, "m/s"),
            with_unit((end.q - x).abs(), 2, "m"),
            with_unit((end.v - v).abs(), 2, "m/s"),
        ),
        Err(stop) => stop.to_string(),
    }
}
