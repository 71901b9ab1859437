//! The fate of a motion and its reason, from the cycles that divide its turning points.
//!
//! A motion turns repeatedly on the line `v = 0`, and its turning points on one side move in one direction,
//! from unstable cycles towards stable ones. So the first of them decides, by its position relative to the
//! cycles. The end time limits how far a motion is followed, but not what is known of it.

use std::ops::RangeBounds;

use crate::flow::{Fate, Outcome, Sample, Trajectory};
use crate::model::Parameters;
use crate::numerics::elementary::hypot;
use crate::portrait::{Border, Cycle, Cycles, Portrait};
use crate::scene::said;
use crate::scene::said::TextCondition;
use crate::session::{Session, Setup};

/// The fate of a motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum End {
    /// It comes to rest.
    Rests,
    /// It tends to a stable cycle, from inside or from outside.
    Onto {
        /// The right turning point of the cycle.
        q_max: f64,
        /// Whether it grows on the way.
        grows: bool,
    },
    /// It grows without bound.
    Grows,
    /// It decays towards the only equilibrium, without friction.
    Decays,
    /// It starts on an unstable cycle within this relative distance: rounding decides.
    OnTheEdge {
        /// The difference of its clearance from that of the cycle, relative to the latter.
        distance: f64,
    },
}

/// Relative distance from a cycle below which rounding decides: of a start at a turning point, and of a
/// computed turning point, which carries the error of the motion up to there.
const NEAR: [f64; 2] = [1e-12, 1e-8];

/// Clearance in units of r above which it is resolved by the difference of two displacements.
const RESOLVED: f64 = 1e-6;

/// The fate of a motion among these cycles; `None` if it is unknown.
pub fn fate(found: &Cycles, motion: &Trajectory) -> Option<End> {
    match found.border {
        border if border.parts_without_cycle() => beside_separatrix(found, motion),
        _ if !found.cycles.is_empty() => among(found, motion),
        Border::None if found.parameters.r > 0.0 => Some(End::Rests),
        // Without friction, D2 and cycles, damping decides.
        _ => {
            let decays = found.parameters.d > 0.0 && found.parameters.d3 >= 0.0;
            (found.parameters.d2 == 0.0 && decays).then_some(End::Decays)
        }
    }
}

/// The fate without friction and nonlinear damping, where the sign of D decides and no cycles are needed.
fn linear(motion: &Trajectory) -> Option<End> {
    let (Parameters { d, d2, d3, r }, start) = (motion.problem.parameters, motion.problem.initial);
    let moves = start.q != 0.0 || start.v != 0.0;
    let alone = [d2, d3, r] == [0.0; 3] && d != 0.0 && moves;
    alone.then_some(if d > 0.0 { End::Decays } else { End::Grows })
}

/// The first turning point of a motion, and whether it is the start. Where turning points were not located,
/// only the start can be one.
fn turning(motion: &Trajectory, r: f64) -> Option<(f64, bool)> {
    let start = motion.samples.first()?;
    if start.v == 0.0 && start.q.abs() > r {
        return Some((start.q, true));
    }
    motion.crossings.first().map(|crossing| (crossing.q, false))
}

/// The fate if there are cycles, each inside the next.
fn among(found: &Cycles, motion: &Trajectory) -> Option<End> {
    let r = found.parameters.r;
    let Some((q, exact)) = turning(motion, r) else {
        return matches!(motion.outcome, Outcome::Captured { .. }).then_some(End::Rests);
    };
    // In the frame of the side on which the motion turns; only D2 makes the sides different.
    let mirrored = q < 0.0 && found.parameters.d2 != 0.0;
    let clearance = |cycle: &Cycle| if mirrored { -cycle.q_min - r } else { cycle.clearance };
    if mirrored && found.cycles.iter().any(|cycle| clearance(cycle) <= RESOLVED * r) {
        return None;
    }
    let own = q.abs() - r;
    let distance = |cycle: &Cycle| (own / clearance(cycle) - 1.0).abs();
    let onto =
        |cycle: &Cycle| Some(End::Onto { q_max: cycle.q_max, grows: own < clearance(cycle) });
    let near = NEAR[usize::from(!exact)];
    if let Some(cycle) = found.cycles.iter().find(|cycle| distance(cycle) <= near) {
        let edge = End::OnTheEdge { distance: distance(cycle) };
        return if cycle.stable { onto(cycle) } else { Some(edge) };
    }
    let outer = found.cycles.iter().find(|cycle| clearance(cycle) > own);
    let inner = found.cycles.iter().rfind(|cycle| clearance(cycle) < own);
    match (inner, outer) {
        (_, Some(outer)) if outer.stable => onto(outer),
        (Some(inner), _) if inner.stable => onto(inner),
        (None, Some(_)) if r > 0.0 => Some(End::Rests),
        (None, Some(_)) => Some(End::Decays),
        (Some(_), None) => Some(End::Grows),
        _ => None,
    }
}

/// The fate if a separatrix borders the basin: a motion that turns within the margin is captured; otherwise,
/// its outcome tells.
fn beside_separatrix(found: &Cycles, motion: &Trajectory) -> Option<End> {
    let margin = found.picture.as_ref()?.margin.displacement;
    let within = |q: f64| margin.is_some_and(|margin| q.abs() < margin);
    let turned = || turning(motion, found.parameters.r).is_some_and(|(q, _)| within(q));
    match motion.outcome {
        Outcome::Escaped { .. } => Some(End::Grows),
        Outcome::Captured { .. } => Some(End::Rests),
        _ => turned().then_some(End::Rests),
    }
}

/// The fate by the whole model.
fn of_course((portrait, fate): (&Portrait, Fate), motion: &Trajectory) -> Option<End> {
    Some(match fate {
        Fate::Rest => End::Rests,
        Fate::Cycle(_) => {
            let cycle = portrait.tends_to(fate)?;
            let size = |sample: &Sample| hypot(sample.q, sample.v);
            let (first, last) = (motion.samples.first()?, motion.samples.last()?);
            let grows = cycle.stable && size(first) <= size(last);
            End::Onto { q_max: cycle.q_max / portrait.model.drawing_length(), grows }
        }
        Fate::Escapes => End::Grows,
        Fate::Neutral | Fate::Moving | Fate::Unknown(_) => return None,
    })
}

impl Session {
    /// The parts of a text of the scene that hold for what is on show.
    pub fn said(&self, text: &str) -> String {
        said::said(text, |condition| self.holds(condition))
    }

    /// Whether a condition holds, by the answers on show.
    fn holds(&self, condition: TextCondition) -> bool {
        let any = |is: &dyn Fn(&Cycle) -> bool| {
            self.cycles().is_some_and(|found| found.cycles.iter().any(is))
        };
        let border = self.cycles().map(|found| found.border);
        match condition {
            TextCondition::Here => {
                let (own, scene) = (self.problem, self.scene.problem);
                (own.parameters, own.initial) == (scene.parameters, scene.initial)
                    && self.setting == Setup::of_scene(&self.scene).setting
            }
            TextCondition::Path => self.is_on_the_belt() == Some(true),
            TextCondition::Opened => {
                let own = self.plots.iter().map(|plot| (plot.view, plot.axes));
                own.eq(self.scene.plots.iter().map(|plot_setup| (plot_setup.view, plot_setup.axes)))
            }
            // Of a machine only the unstable cycle that borders the basin counts.
            TextCondition::Unstable if self.draws_whole() => border == Some(Border::Cycle),
            TextCondition::Unstable => any(&|cycle| !cycle.stable),
            TextCondition::Stable => any(&|cycle| cycle.stable),
            TextCondition::Separatrix => border.is_some_and(Border::parts_without_cycle),
            TextCondition::Safe => {
                matches!(border, Some(Border::None | Border::Unknown(_)))
                    && self.cycles().is_some_and(|found| found.parameters.r > 0.0)
            }
            TextCondition::Sticks => any(&Cycle::sticks),
            TextCondition::Compares(symbol, bounds) => bounds.contains(&self.value(symbol)),
            TextCondition::Shows(layer) => self.shows(layer),
            TextCondition::Rests => matches!(self.fate(), Some(End::Rests)),
            TextCondition::Grows => {
                matches!(self.fate(), Some(End::Grows | End::Onto { grows: true, .. }))
            }
        }
    }

    /// The cycles at the parameters of a motion; `None` until they are known.
    pub(crate) fn cycles_beside(&self, motion: &Trajectory) -> Option<&Cycles> {
        self.cycles().filter(|found| found.parameters == motion.problem.parameters)
    }

    /// The fate of the motion that was computed last; `None` until its cycles are known, and for methods
    /// that miss the turning points.
    pub fn fate(&self) -> Option<End> {
        let motion = self.trajectory()?;
        if self.draws_whole() {
            return of_course(self.course()?, motion);
        }
        if !motion.problem.method.spec().events || self.contact().is_some() {
            return None;
        }
        let found = self.cycles_beside(motion);
        let end = found.map_or_else(|| linear(motion), |found| fate(found, motion));
        // A coarse step can end on the wrong side.
        end.filter(|end| match motion.outcome {
            Outcome::Captured { .. } => matches!(end, End::Rests | End::OnTheEdge { .. }),
            Outcome::Escaped { .. } => matches!(end, End::Grows | End::OnTheEdge { .. }),
            Outcome::Moving { .. } => true,
            Outcome::GaveUp { .. } => false,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::flow::trajectory::trajectory;
    use crate::flow::{Detail, Limits, Problem};
    use crate::model::State;

    fn motion(parameters: Parameters, initial: State, until: f64) -> Trajectory {
        let problem =
            Problem { parameters, initial, until, tolerance: 1e-10, ..Problem::default() };
        let detail = Detail { crossings: true, samples_per_step: 2, energy: false };
        trajectory(&problem, detail, &Limits::PATIENT)
    }

    #[test]
    fn without_friction_and_nonlinear_damping_the_sign_of_damping_decides() {
        let fate = |d, q, r| {
            let parameters = Parameters { d, d2: 0.0, d3: 0.0, r };
            linear(&motion(parameters, State { q, v: 0.0 }, 8.0))
        };
        assert_eq!(fate(-0.05, 0.5, 0.0), Some(End::Grows));
        assert_eq!(fate(0.1, 0.5, 0.0), Some(End::Decays));
        assert_eq!([fate(0.0, 0.5, 0.0), fate(-0.05, 0.0, 0.0), fate(-0.05, 0.5, 0.1)], [None; 3]);
    }
}
