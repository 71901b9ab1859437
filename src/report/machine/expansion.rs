//! What the oscillator of the paper says about a mass on a belt, whose friction it knows by its cubic expansion alone,
//! beside the whole model.

use crate::flow::{Limits, Result};
use crate::model::{Belt, ReducedBelt};
use crate::portrait::{Cycle, Margin, Portrait, picture_reach};
use crate::report::cycle_numbers::of_machine;
use crate::report::{Document, PLACES};
use crate::words::{too_large, with_unit};

/// A mass on a belt by the cubic expansion of its friction.
pub struct CubicExpansion<'a> {
    pub belt: &'a Belt,
    /// Its dimensionless form.
    pub reduced: ReducedBelt,
    /// What it does, or why the search gave up.
    portrait: Result<Portrait>,
}

impl<'a> CubicExpansion<'a> {
    /// Finds its cycles and its basin. Fails with `Reason` where the machine has no dimensionless form.
    pub fn new(belt: &'a Belt, limits: &Limits) -> Result<Self> {
        let reduced = belt.reduce()?;
        let reach = picture_reach(reduced.parameters.d2);
        let portrait = Portrait::of_oscillator(&reduced.parameters, reach, limits);
        Ok(CubicExpansion { belt, reduced, portrait })
    }

    /// How far out the guide holds the mass at rest, in m.
    pub(super) fn held(&self) -> f64 {
        self.belt.static_guide.unwrap_or(self.belt.friction) / self.belt.stiffness
    }

    /// A margin of the expansion in m and N s.
    fn in_units(&self, own: &Margin) -> Margin {
        let units = &self.reduced.units;
        own.map(|size| size * units.displacement, |size| size * units.impulse)
    }

    /// The answer for a document, beside that of the `whole` model.
    pub(super) fn document(&self, whole: &Portrait) -> Document {
        let found = self.portrait.as_ref();
        let cycles = found.iter().flat_map(|found| &found.cycles);
        Document::of("parameters", self.reduced.parameters)
            .with_any("reason", found.err())
            .with("cycles", cycles.map(|cycle| self.cycle(cycle, whole)).collect::<Vec<_>>())
            .with("edge", found.ok().map(|found| found.border))
            .with("margin", found.ok().map(|found| self.margin(&found.margin, &whole.margin)))
    }

    /// A cycle in SI units, with the differences to the nearest cycle of the same stability of the whole model, and the
    /// error of the cubic over its velocities.
    fn cycle(&self, cycle: &Cycle, whole: &Portrait) -> Document {
        let ReducedBelt { units, sticking_velocity, .. } = &self.reduced;
        let physical = cycle.scaled(units.displacement, units.omega_0);
        let alike = whole.cycles.iter().filter(|whole| whole.stable == cycle.stable);
        let distance = |whole: &Cycle| (whole.q_max - physical.q_max).abs();
        let nearest = alike.min_by(|one, other| distance(one).total_cmp(&distance(other)));
        let taylor = self.belt.taylor_error((physical.v_min, physical.v_max));
        Document::of("stable", cycle.stable)
            .and(&numbers(&physical, &Cycle::default()))
            // There the expansion does not hold.
            .with("reaches_belt", cycle.v_max >= *sticking_velocity)
            .with("taylor", taylor.filter(|error| error.force.is_finite()))
            .with("error", nearest.map(|whole| numbers(&physical, whole)))
            .with("dimensionless", cycle)
    }

    /// A margin with its differences to that of the whole model, in SI units and dimensionless.
    fn margin(&self, own: &Margin, whole: &Margin) -> Document {
        let physical = self.in_units(own);
        let error = Document::of("displacement", excess(physical.displacement, whole.displacement))
            .with("impulse", excess(physical.impulse, whole.impulse));
        let velocity = own.impulse.map(|impulse| impulse * self.reduced.units.velocity);
        Document::default()
            .and(&physical)
            .with("velocity", velocity)
            .with("dimensionless", own)
            .with("error", error)
    }

    /// The answer in a sentence: how large the margin is, and how wrong.
    pub(super) fn sentence(&self, whole: &Portrait) -> String {
        let lead = "friction as a cubic (the oscillator of the paper) says: ";
        let found = match &self.portrait {
            Ok(found) => found,
            Err(reason) => return format!("{lead}nothing; {reason}"),
        };
        let margin = self.in_units(&found.margin).displacement.map(|own| {
            let judged = match excess(Some(own), whole.margin.displacement) {
                Some(error) if error != 0.0 && own != error => {
                    format!(", {}", too_large(error / (own - error).abs()))
                }
                _ => String::new(),
            };
            format!("margin {}{judged}", with_unit(own, PLACES, "m"))
        });
        let margin = margin.unwrap_or_else(|| "every kick is survived".to_owned());
        let count = |stable| found.cycles.iter().filter(|cycle| cycle.stable == stable).count();
        let (unstable, stable) = (count(false), count(true));
        format!("{lead}{margin}; {unstable} unstable and {stable} stable cycles")
    }
}

/// By how much a kick of the expansion exceeds that of the whole model, where both exist.
fn excess(own: Option<f64>, whole: Option<f64>) -> Option<f64> {
    Some(own? - whole?)
}

/// The extremes and the period of a cycle, less those of another.
fn numbers(cycle: &Cycle, other: &Cycle) -> Document {
    of_machine().take(5).fold(Document::default(), |all, number| {
        let both = (number.value)(cycle).zip((number.value)(other));
        all.with(&number.physical_name(), both.map(|(own, other)| own - other))
    })
}
