//! The start of the motion on show as a kick of the mass at rest: by an impulse, or by a shift; and the border of the
//! basin in its direction.

use std::f64::consts::TAU;

use crate::model::{Model, State};
use crate::scene::Topic;
use crate::session::{Session, fate::End};

/// A kick, in numbers of the oscillator.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TriedKick {
    /// Whether it is a shift from where the spring is relaxed; otherwise it is an impulse where the mass rests.
    pub is_shift: bool,
    pub size: f64,
    /// The size from which on such a kick is lost; `None` if there is none or it is not known.
    pub border: Option<f64>,
}

impl Session {
    /// The kick by which the motion on show starts, if it starts by one.
    pub fn kick(&self) -> Option<TriedKick> {
        let start @ State { q, v } = self.problem.initial;
        let rests = q.abs() <= self.farthest_rest();
        let (is_shift, size) = match (v == 0.0, rests) {
            (true, false) => (true, q.abs()),
            (false, true) => (false, v.abs()),
            _ => return None,
        };
        let course = self.answers.course.as_ref().filter(|known| known.start == start);
        Some(TriedKick { is_shift, size, border: course.and_then(|known| known.border) })
    }

    /// How far from where the spring is relaxed the mass can rest.
    fn farthest_rest(&self) -> f64 {
        let whole = self.cycles().filter(|_| self.draws_whole()).map(|found| &found.portrait.model);
        let of = |model: &Model| model.guide_static / model.drawing_length();
        whole.map_or(self.problem.parameters.r, of)
    }

    /// The unit in which the size of a kick is told, and its name: an impulse as a velocity where no mass is known.
    pub fn unit_of_kick(&self, is_shift: bool) -> (f64, &'static str) {
        match self.units() {
            None => (1.0, ""),
            Some(units) if is_shift => (units.displacement, "m"),
            Some(units) if units.force.is_finite() => (units.impulse, "N s"),
            Some(units) => (units.velocity, "m/s"),
        }
    }

    /// Whether a plot on show needs the present motion.
    pub fn follows_motion(&self) -> bool {
        let needs = |plot: usize| self.needs(plot).contains(&Topic::Trajectory);
        self.on_show().any(|plot| self.variants(plot).is_none() && needs(plot))
    }

    /// Whether the mass comes to rest again in the motion on show; `None` if that is not known, or decided by rounding.
    pub fn survives(&self) -> Option<bool> {
        match self.fate()? {
            End::Rests | End::Decays => Some(true),
            End::Onto { .. } | End::Grows => Some(false),
            End::OnTheEdge { .. } => None,
        }
    }

    /// Whether a motion is being played whose end cannot be seen yet. Of a kick that is tried one need not wait for the end.
    pub fn is_under_way(&self) -> bool {
        /// Time after which one sees that swings grow: the second is larger than the first.
        const SEEN: f64 = 2.0 * TAU;
        let grows = self.kicking && self.survives() == Some(false);
        self.drawn_until().is_some_and(|head| !grows || head.tau < SEEN)
    }
}
