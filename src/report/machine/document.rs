//! The answer about a machine as a JSON document; physical quantities are in SI units.

use std::collections::BTreeMap;

use super::{CubicExpansion, MachineAnswer};
use crate::flow::{Fate, Motion, Sample};
use crate::model::{Derivatives, FrictionLaw, Group};
use crate::portrait::{Cycle, Margin, NoGuarantee, Portrait};
use crate::report::cycle_numbers::of_machine;
use crate::report::motion::{energy, phases};
use crate::report::{Columns, Document};

/// The whole answer about a machine as a document.
pub(super) fn document(answer: &MachineAnswer) -> Document {
    let MachineAnswer { portrait, expansion, .. } = answer;
    let design = answer.design.map(|designed| {
        Document::of("kick", designed.kick)
            .with("margin", designed.wanted)
            .with("R", designed.needed.least())
            .with("needed", designed.needed)
            .with("message", designed.sentence(&answer.subject.source))
    });
    Document::of("model", "whole")
        .and(&expansion.as_ref().map(quantities).unwrap_or_default())
        .and(&motions(portrait))
        .with("motion", motion(answer))
        .with_any("guaranteed", answer.certain.map(|certain| guaranteed(answer, certain)))
        .with_any("rest_share", answer.rest_share)
        .with_any("design", design)
        .with_any("expansion", expansion.as_ref().map(|it| it.document(portrait)))
}

/// The numbers of a mass on a belt, and its dimensionless form.
fn quantities(expansion: &CubicExpansion) -> Document {
    let CubicExpansion { belt, reduced, .. } = expansion;
    let knobs = Group::Machine.knobs();
    let numbers = knobs.filter_map(|knob| Some((knob.spec().name, knob.of_belt(belt)?)));
    let both = |physical: f64, one: f64| {
        Document::of("dimensionless", physical / one).with("physical", physical)
    };
    let Derivatives { value, first, second, third } = reduced.mu;
    // Root mean square distance of a table's points from the law.
    let missed = match &belt.law {
        FrictionLaw::Table(spline) => Some(spline.missed),
        _ => None,
    };
    let friction = Document::of("law", belt.law.name())
        .with_any("missed", missed)
        .with("mu", value)
        .with("mu1", first)
        .with("mu2", second)
        .with("mu3", third)
        .with("mu_s", belt.static_coefficient.or_else(|| belt.law.mu(0.0)));
    Document::of("quantities", numbers.collect::<BTreeMap<_, _>>())
        .with("friction", friction)
        .with("units", reduced.units)
        .with("parameters", reduced.parameters)
        .with("sticking_velocity", both(belt.belt_speed, reduced.units.velocity))
        .with("rest_band", both(expansion.held(), reduced.units.displacement))
}

/// The kicks that are survived for certain, with what they allow for: the disturbance in N, and the intervals of the
/// numbers that are not known exactly. Null if every kick is survived or nothing is certain.
fn guaranteed(answer: &MachineAnswer, certain: Result<Margin, NoGuarantee>) -> Document {
    let tolerances = answer.uncertain().into_iter().map(|(knob, value)| (knob.spec().name, value));
    Document::default()
        .and(&certain.unwrap_or(Margin::ENDLESS))
        .with("reason", certain.err().map(|reason| reason.to_string()))
        .with("disturbance", answer.subject.tolerances.disturbance)
        .with("tolerances", tolerances.collect::<BTreeMap<_, _>>())
}

/// All motions of a machine by the whole model.
fn motions(portrait: &Portrait) -> Document {
    let reach = portrait.reach;
    let margin = Document::default()
        .and(&portrait.margin)
        // To the right and to the left, in m; with and against the belt, in m/s.
        .with("displacements", reach.map(|reach| reach.displacement))
        .with("velocities", reach.map(|reach| reach.velocity));
    // The right turning point beyond which motions are not known, and why.
    let limit =
        portrait.stop.map(|stop| Document::of("displacement", portrait.known).with("reason", stop));
    // Beside them `x` is the displacement.
    let cycles = Columns::default()
        .field("kind", Cycle::kind)
        .field("overtakes", |cycle| cycle.overtakes)
        .field("stable", |cycle| cycle.stable);
    let cycles = of_machine()
        .fold(cycles, |all, number| all.file(&number.physical_name(), number.value))
        // Null for a multiplier of 0.
        .field("log_multiplier", |cycle| cycle.log_multiplier);
    Document::of("cycles", cycles.objects(&portrait.cycles))
        .with("neutral", portrait.neutral)
        .with("border", Document::of("kind", portrait.border))
        .with("margin", margin)
        .with_any("limit", limit)
        // Right turning points between which the search for cycles did not settle.
        .with("unresolved", &portrait.unresolved)
}

/// The motion from the start.
fn motion(answer: &MachineAnswer) -> Document {
    let (motion, (x, v)) = (&answer.motion, answer.subject.start());
    let end = motion.end();
    let [displacement, velocity] = motion.extremes.unwrap_or_default();
    Document::of("start", Document::of("x", x).with("v", v))
        .with("outcome", outcome(answer))
        .with("until", end.tau)
        .with("displacement", displacement)
        .with("velocity", velocity)
        .with("phases", phases(&motion.legs, ["t", "x"]))
        .with("energy", motion.ledger.as_ref().map(|ledger| energy(ledger, true)))
        .with("end", state(end))
        .with_any("second", answer.second.as_ref().map(|second| by_second(second, end)))
}

/// A moment of a motion in SI units.
fn state(Sample { tau, q, v }: Sample) -> Document {
    Document::of("t", tau).with("x", q).with("v", v)
}

/// What becomes of the motion: the index of its cycle, or where it rests, and when, if that is within the time followed.
fn outcome(MachineAnswer { motion, fate, rest, .. }: &MachineAnswer) -> Document {
    let named = |kind: &str| Document::of("kind", kind);
    match fate {
        Fate::Rest => {
            let at = motion.outcome.rest().ok().flatten();
            named("rest").with_any("x", *rest).with_any("t", at)
        }
        Fate::Cycle(index) => named("cycle").with("cycle", index),
        Fate::Neutral => named("neutral"),
        Fate::Moving => named("moving"),
        Fate::Escapes => named("escaped"),
        Fate::Unknown(_) => named("unknown"),
    }
}

/// The motion by a second method, and the difference between the ends.
fn by_second(second: &Motion, first: Sample) -> Document {
    let end = second.known_end();
    let less =
        |end: Sample| Sample { tau: end.tau - first.tau, q: end.q - first.q, v: end.v - first.v };
    Document::of("method", second.method)
        .with("tolerance", second.problem.tolerance)
        .with_any("end", end.ok().map(state))
        .with_any("difference", end.ok().map(less).map(state))
        .with_any("reason", end.err())
}
