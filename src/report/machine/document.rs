//! The answer about a machine as a JSON document; physical quantities are in SI units.

use std::collections::BTreeMap;

use super::{DesignAnswer, MachineAnswer, OnBelt, excess, in_units};
use crate::flow::{Fate, Sample, Trajectory};
use crate::model::Group;
use crate::model::belt::{Derivatives, FrictionLaw};
use crate::portrait::guarantee::Uncertain;
use crate::portrait::{Course, CubicExpansion, Cycle, Margin, Portrait};
use crate::report::cycle_numbers::of_machine;
use crate::report::motion::{energy, phases};
use crate::report::{Columns, Document};

/// The whole answer about a machine as a document.
pub(super) fn document(all: Document, answer: &MachineAnswer) -> Document {
    let MachineAnswer { course, on_belt, rest_share, .. } = answer;
    let on_belt = on_belt.as_ref();
    let certain = |belt: &OnBelt| Some(guaranteed(belt, belt.certain.as_ref()?));
    let expanded = |belt: &OnBelt| expansion(&belt.expansion, &course.portrait);
    let quantities = on_belt.map(|belt| quantities(&belt.expansion));
    all.with("model", "whole")
        .and(&quantities.unwrap_or_default())
        .and(&motions(&course.portrait))
        .with("motion", motion(answer.start, course))
        .with_any("guaranteed", on_belt.and_then(certain))
        .with_any("rest_share", *rest_share)
        .with_any("design", answer.design.as_ref().map(design))
        .with_any("expansion", on_belt.map(expanded))
}

/// The numbers of a mass on a belt, and its dimensionless form.
fn quantities(CubicExpansion { belt, reduced, .. }: &CubicExpansion) -> Document {
    let knobs = Group::Machine.knobs();
    let numbers = knobs.filter_map(|knob| Some((knob.spec().name, knob.of_belt(belt)?)));
    let held = belt.static_guide.unwrap_or(belt.friction) / belt.stiffness;
    let both = |dimensionless: f64, physical: f64| {
        Document::default().with("dimensionless", dimensionless).with("physical", physical)
    };
    let Derivatives { value, first, second, third } = reduced.mu;
    // Root mean square distance of a table's points from the law.
    let missed = match &belt.law {
        FrictionLaw::Table(spline) => Some(spline.missed()),
        _ => None,
    };
    let friction = Document::default()
        .with("law", belt.law.name())
        .with_any("missed", missed)
        .with("mu", value)
        .with("mu1", first)
        .with("mu2", second)
        .with("mu3", third)
        .with("mu_s", belt.static_coefficient.or_else(|| belt.law.mu(0.0)));
    Document::default()
        .with("quantities", numbers.collect::<BTreeMap<_, _>>())
        .with("friction", friction)
        .with("units", reduced.units)
        .with("parameters", reduced.parameters)
        .with("sticking_velocity", both(reduced.sticking_velocity, belt.belt_speed))
        .with("rest_band", both(held / reduced.units.displacement, held))
}

/// The kicks that are survived for certain, with what they allow for: the disturbance in N, and the intervals of the
/// numbers that are not known exactly. Null if every kick is survived or nothing is certain.
fn guaranteed(belt: &OnBelt, certain: &Result<Margin, Uncertain>) -> Document {
    let tolerances = belt.uncertain().into_iter().map(|(knob, value)| (knob.spec().name, value));
    Document::default()
        .and(&certain.unwrap_or(Margin::ENDLESS))
        .with("reason", certain.err().map(|reason| reason.to_string()))
        .with("disturbance", belt.tolerances.disturbance)
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
    let limit = portrait.stop.map(|stop| {
        Document::default().with("displacement", portrait.known).with("reason", stop.to_string())
    });
    Document::default()
        .with("cycles", cycle_columns().objects(&portrait.cycles))
        .with("neutral", portrait.neutral)
        .with("border", Document::default().with("kind", portrait.border))
        .with("margin", margin)
        .with_any("limit", limit)
        // Right turning points between which the search for cycles did not settle.
        .with("unresolved", &portrait.unresolved)
}

/// The motion from a start.
fn motion((x, v): (f64, f64), course: &Course) -> Document {
    let motion = &course.motion;
    let end = motion.end();
    let second = course.second.as_ref().map(|second| by_second(second, end));
    let [displacement, velocity] = motion.extremes.unwrap_or_default();
    Document::default()
        .with("start", Document::default().with("x", x).with("v", v))
        .with("outcome", outcome(course))
        .with("until", end.tau)
        .with("displacement", displacement)
        .with("velocity", velocity)
        .with("phases", phases(&motion.legs, ["t", "x"]))
        .with("energy", motion.ledger.as_ref().map(|ledger| energy(ledger, true)))
        .with("end", state(end))
        .with_any("second", second)
}

/// A moment of a motion in SI units.
fn state(Sample { tau, q, v }: Sample) -> Document {
    Document::default().with("t", tau).with("x", q).with("v", v)
}

/// What becomes of the motion: the index of its cycle, or where it rests, and when, if that is within the time followed.
fn outcome(Course { motion, fate, rest, .. }: &Course) -> Document {
    let named = |kind: &str| Document::default().with("kind", kind);
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
fn by_second(second: &Trajectory, first: Sample) -> Document {
    let end = second.known_end();
    let less =
        |end: Sample| Sample { tau: end.tau - first.tau, q: end.q - first.q, v: end.v - first.v };
    Document::default()
        .with("method", second.method)
        .with("tolerance", second.problem.tolerance)
        .with_any("end", end.ok().map(state))
        .with_any("difference", end.ok().map(less).map(state))
        .with_any("reason", end.err().map(|stop| stop.to_string()))
}

/// The friction needed for a margin, in N, and the margin in m or N s.
fn design(designed: &DesignAnswer) -> Document {
    Document::default()
        .with("kick", designed.kick)
        .with("margin", designed.wanted)
        .with("R", designed.needed.least())
        .with("needed", designed.needed)
        .with("message", designed.sentence())
}

/// The answer of the expansion, for a document.
fn expansion(expansion: &CubicExpansion, portrait: &Portrait) -> Document {
    let found = expansion.portrait.as_ref();
    let cycles = found.iter().flat_map(|found| &found.cycles);
    let cycles: Vec<_> = cycles.map(|cycle| expanded(cycle, expansion, portrait)).collect();
    let margin = |own: &Portrait| expanded_margin(&own.margin, expansion, &portrait.margin);
    Document::default()
        .with("parameters", expansion.reduced.parameters)
        .with_any("reason", found.err().map(ToString::to_string))
        .with("cycles", cycles)
        .with("edge", found.ok().map(|found| found.border))
        .with("margin", found.ok().map(margin))
}

/// A cycle of the expansion in SI units, with the differences to the nearest cycle of the same stability of the whole
/// model, and the error of the cubic over its velocities.
fn expanded(cycle: &Cycle, expansion: &CubicExpansion, portrait: &Portrait) -> Document {
    let CubicExpansion { belt, reduced, .. } = expansion;
    let units = &reduced.units;
    let physical = cycle.scaled(units.displacement, units.omega_0);
    let alike = portrait.cycles.iter().filter(|whole| whole.stable == cycle.stable);
    let distance = |whole: &Cycle| (whole.q_max - physical.q_max).abs();
    let nearest = alike.min_by(|one, other| distance(one).total_cmp(&distance(other)));
    let taylor = belt.taylor_error((physical.v_min, physical.v_max));
    Document::default()
        .with("stable", cycle.stable)
        .and(&numbers(&physical, &Cycle::default()))
        // There the expansion does not hold.
        .with("reaches_belt", cycle.v_max >= reduced.sticking_velocity)
        .with("taylor", taylor.filter(|error| error.force.is_finite()))
        .with("error", nearest.map(|whole| numbers(&physical, whole)))
        .with("dimensionless", cycle)
}

/// The extremes and the period of a cycle, less those of another.
fn numbers(cycle: &Cycle, other: &Cycle) -> Document {
    of_machine().take(5).fold(Document::default(), |all, number| {
        let both = (number.value)(cycle).zip((number.value)(other));
        all.with(&number.physical_name(), both.map(|(own, other)| own - other))
    })
}

/// A margin of the expansion with its differences to that of the whole model, in SI units and dimensionless.
fn expanded_margin(own: &Margin, expansion: &CubicExpansion, whole: &Margin) -> Document {
    let physical = in_units(own, expansion);
    let error = Document::default()
        .with("displacement", excess(physical.displacement, whole.displacement))
        .with("impulse", excess(physical.impulse, whole.impulse));
    let velocity = own.impulse.map(|impulse| impulse * expansion.reduced.units.velocity);
    Document::default()
        .and(&physical)
        .with("velocity", velocity)
        .with("dimensionless", own)
        .with("error", error)
}

/// The columns of a cycle, beside which `x` is the displacement.
fn cycle_columns<'a>() -> Columns<'a, Cycle> {
    let columns = Columns::default()
        .field("kind", Cycle::kind)
        .field("overtakes", |cycle| cycle.overtakes)
        .field("stable", |cycle| cycle.stable);
    of_machine()
        .fold(columns, |all, number| all.file(&number.physical_name(), number.value))
        // Null for a multiplier of 0.
        .field("log_multiplier", |cycle| cycle.log_multiplier)
}
