//! A machine approximated by the oscillator of the paper, whose friction is a cubic, and the errors of this
//! approximation.

use crate::portrait::on_belt::PhysicalMargin;
use crate::portrait::{CubicExpansion, Cycle, Margin, Portrait};
use crate::report::Document;
use crate::report::answer::PLACES;
use crate::words::{significant, with_unit};

/// The margins of the expansion: dimensionless, physical, and by how much its displacement and its impulse exceed those
/// of the whole model, where both exist.
struct ExpandedMargin {
    dimensionless: Margin,
    physical: PhysicalMargin,
    error: [Option<f64>; 2],
}

impl ExpandedMargin {
    /// `None` if the expansion has no answer.
    fn new(expansion: &CubicExpansion, portrait: &Portrait) -> Option<Self> {
        let dimensionless = expansion.cycles.as_ref().ok()?.picture.as_ref()?.margin;
        let physical = PhysicalMargin::new(&dimensionless, &expansion.reduced.units);
        let whole = portrait.margin;
        let excess = |own: Option<f64>, whole: Option<f64>| Some(own? - whole?);
        let error = [
            excess(physical.displacement, whole.displacement),
            excess(physical.impulse, whole.impulse),
        ];
        Some(ExpandedMargin { dimensionless, physical, error })
    }

    fn document(&self) -> Document {
        let [displacement, impulse] = self.error;
        let error = Document::default().with("displacement", displacement).with("impulse", impulse);
        Document::default()
            .and(&self.physical)
            .with("dimensionless", self.dimensionless)
            .with("error", error)
    }

    fn sentence(&self) -> String {
        let Some(own) = self.physical.displacement else {
            return "every kick is survived".to_owned();
        };
        let judged = match self.error[0] {
            Some(error) if error != 0.0 && own != error => {
                let percent = significant(100.0 * error.abs() / (own - error).abs(), 2);
                format!(", {percent} % too {}", if error > 0.0 { "large" } else { "small" })
            }
            _ => String::new(),
        };
        format!("margin {}{judged}", with_unit(own, PLACES, "m"))
    }
}

/// The answer of the expansion, for a document.
pub(super) fn document(expansion: &CubicExpansion, portrait: &Portrait) -> Document {
    let found = expansion.cycles.as_ref();
    let cycles = found.iter().flat_map(|found| &found.cycles);
    let cycles: Vec<_> = cycles.map(|cycle| expanded(cycle, expansion, portrait)).collect();
    let margin = ExpandedMargin::new(expansion, portrait);
    Document::default()
        .with("parameters", expansion.reduced.parameters)
        .with_any("reason", found.err().map(ToString::to_string))
        .with("cycles", cycles)
        .with("edge", found.ok().map(|found| found.border))
        .with("margin", margin.map(|margin| margin.document()))
}

/// A cycle of the expansion in SI units, with the differences to the nearest cycle of the same stability of the whole
/// model, and the error of the cubic over its velocities.
fn expanded(cycle: &Cycle, expansion: &CubicExpansion, portrait: &Portrait) -> Document {
    let CubicExpansion { belt, reduced, .. } = expansion;
    let units = &reduced.units;
    let physical = Cycle {
        q_min: cycle.q_min * units.displacement,
        q_max: cycle.q_max * units.displacement,
        v_min: cycle.v_min * units.velocity,
        v_max: cycle.v_max * units.velocity,
        period: cycle.period * units.time,
        ..*cycle
    };
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
    let Some(margin) = ExpandedMargin::new(expansion, portrait) else {
        return format!("{lead}nothing; ");
    };
    let count = |stable| found.cycles.iter().filter(|cycle| cycle.stable == stable).count();
    let (unstable, stable) = (count(false), count(true));
    format!("{lead}{}; {unstable} unstable and {stable} stable cycles", margin.sentence())
}
