//! A machine approximated by the oscillator of the paper, whose friction is a cubic, and the errors of this
//! approximation.

use crate::model::belt::Units;
use crate::portrait::{CubicExpansion, Cycle, Margin, Portrait};
use crate::report::Document;
use crate::report::answer::PLACES;
use crate::words::{significant, with_unit};

/// The margin of an expansion, dimensionless and in SI units; `None` if it has no answer.
fn margins(expansion: &CubicExpansion) -> Option<[Margin; 2]> {
    let own = expansion.cycles.as_ref().ok()?.picture.as_ref()?.margin;
    let Units { displacement, impulse, .. } = expansion.reduced.units;
    Some([own, own.map(|size| size * displacement, |size| size * impulse)])
}

/// By how much a kick of the expansion exceeds that of the whole model, where both exist.
fn excess(own: Option<f64>, whole: Option<f64>) -> Option<f64> {
    Some(own? - whole?)
}

fn margin_document(
    [own, physical]: [Margin; 2],
    expansion: &CubicExpansion,
    whole: &Margin,
) -> Document {
    let error = Document::default()
        .with("displacement", excess(physical.displacement, whole.displacement))
        .with("impulse", excess(physical.impulse, whole.impulse));
    let velocity = own.impulse.map(|speed| speed * expansion.reduced.units.velocity);
    Document::default()
        .with("displacement", physical.displacement)
        .with("impulse", physical.impulse)
        .with("velocity", velocity)
        .with("from_rest", physical.from_rest)
        .with("dimensionless", own)
        .with("error", error)
}

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

/// The answer of the expansion, for a document.
pub(super) fn document(expansion: &CubicExpansion, portrait: &Portrait) -> Document {
    let found = expansion.cycles.as_ref();
    let cycles = found.iter().flat_map(|found| &found.cycles);
    let cycles: Vec<_> = cycles.map(|cycle| expanded(cycle, expansion, portrait)).collect();
    let margin =
        margins(expansion).map(|found| margin_document(found, expansion, &portrait.margin));
    Document::default()
        .with("parameters", expansion.reduced.parameters)
        .with_any("reason", found.err().map(ToString::to_string))
        .with("cycles", cycles)
        .with("edge", found.ok().map(|found| found.border))
        .with("margin", margin)
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

/// The numbers of a cycle, less those of another.
fn numbers(cycle: &Cycle, other: &Cycle) -> Document {
    Document::default()
        .with("x_min", cycle.q_min - other.q_min)
        .with("x_max", cycle.q_max - other.q_max)
        .with("v_min", cycle.v_min - other.v_min)
        .with("v_max", cycle.v_max - other.v_max)
        .with("period", cycle.period - other.period)
}

/// The result of the cubic expansion, in a sentence.
pub(super) fn sentence(expansion: &CubicExpansion, portrait: &Portrait) -> String {
    let lead = "friction as a cubic (the oscillator of the paper) says: ";
    let found = match &expansion.cycles {
        Ok(found) => found,
        Err(reason) => return format!("{lead}nothing; {reason}"),
    };
    let Some([_, physical]) = margins(expansion) else {
        return format!("{lead}nothing; ");
    };
    let margin = margin_sentence(&physical, &portrait.margin);
    let count = |stable| found.cycles.iter().filter(|cycle| cycle.stable == stable).count();
    let (unstable, stable) = (count(false), count(true));
    format!("{lead}{margin}; {unstable} unstable and {stable} stable cycles")
}
