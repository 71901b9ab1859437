//! The fate of a motion and its reason, from the portrait that its cycles come with. The end time limits how far a motion
//! is followed, but not what is known of it.

use std::ops::RangeBounds;

use crate::flow::{Fate, Motion, Outcome, Problem};
use crate::model::{Parameters, State, rests};
use crate::portrait::{Border, Cycle, Drawing, Portrait};
use crate::scene::Topic;
use crate::scene::said::{self, TextCondition};
use crate::session::{Course, Session, Setup};

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

/// The fate of a start among these cycles, and whether a motion onto one of them starts within it; `None` if it is
/// unknown.
fn told(portrait: &Portrait, start: State) -> Option<(Fate, bool)> {
    /// Half swings after which a start far out is given up: a key must not wait for it.
    const MOST: usize = 100;
    let (x, v) = portrait.from_drawing(start);
    let fate = portrait.fate_within(x, v, MOST).ok().filter(|fate| *fate != Fate::Moving)?;
    let cycle = portrait.tends_to(fate);
    Some((fate, cycle.is_some_and(|cycle| portrait.starts_within(cycle, x, v))))
}

/// The fate of a motion among these cycles; `None` if it is unknown.
pub fn fate(found: &Drawing, motion: &Motion) -> Option<End> {
    end(found, motion, told(&found.portrait, motion.problem.initial))
}

fn end(found: &Drawing, motion: &Motion, told: Option<(Fate, bool)>) -> Option<End> {
    if let Some(distance) = on_the_edge(found, motion) {
        return Some(End::OnTheEdge { distance });
    }
    let (portrait, (fate, grows)) = (&found.portrait, told?);
    let Problem { parameters, initial, .. } = motion.problem;
    Some(match fate {
        Fate::Rest if portrait.model.guide_static > 0.0 || rests(initial, parameters.r) => {
            End::Rests
        }
        Fate::Rest => End::Decays,
        Fate::Cycle(_) => {
            let q_max = portrait.tends_to(fate)?.q_max / portrait.model.drawing_length();
            End::Onto { q_max, grows }
        }
        Fate::Escapes => End::Grows,
        Fate::Neutral | Fate::Moving | Fate::Unknown(_) => return None,
    })
}

/// The fate without friction and nonlinear damping, where the sign of D decides and no cycles are needed.
fn linear(motion: &Motion) -> Option<End> {
    let (Parameters { d, d2, d3, r }, start) = (motion.problem.parameters, motion.problem.initial);
    let moves = start.q != 0.0 || start.v != 0.0;
    let alone = [d2, d3, r] == [0.0; 3] && d != 0.0 && moves;
    alone.then_some(if d > 0.0 { End::Decays } else { End::Grows })
}

/// How near the first turning point of a motion is to an unstable cycle, if so near that rounding decides. Where turning
/// points were not located, only the start can be one.
fn on_the_edge(found: &Drawing, motion: &Motion) -> Option<f64> {
    let Parameters { d2, r, .. } = found.parameters;
    let start = motion.problem.initial;
    let (q, near) = if start.v == 0.0 && start.q.abs() > r {
        (start.q, NEAR[0])
    } else {
        (motion.crossings.first()?.q, NEAR[1])
    };
    // In the frame of the side on which the motion turns; only D2 makes the sides different.
    let mirrored = q < 0.0 && d2 != 0.0;
    let clearance = |cycle: &Cycle| if mirrored { -cycle.q_min - r } else { cycle.clearance };
    let unstable = found.cycles.iter().filter(|cycle| !cycle.stable);
    let mut distances = unstable.map(|cycle| ((q.abs() - r) / clearance(cycle) - 1.0).abs());
    distances.find(|distance| *distance <= near)
}

impl Session {
    /// The parts of a text of the scene that hold for what is on show.
    pub fn said(&self, text: &str) -> String {
        said::said(text, |condition| self.holds(condition))
    }

    /// Whether a condition holds, by the answers on show.
    fn holds(&self, condition: TextCondition) -> bool {
        let found = self.cycles();
        let any = |is: fn(&Cycle) -> bool| found.is_some_and(|it| it.cycles.iter().any(is));
        let border = found.map(|found| found.portrait.border);
        match condition {
            TextCondition::Here => {
                let numbers = |it: &Problem| (it.parameters, it.initial);
                numbers(&self.problem) == numbers(&self.scene.problem)
                    && self.setting == Setup::of_scene(&self.scene).setting
            }
            TextCondition::Path => self.is_on_the_belt() == Some(true),
            TextCondition::Opened => {
                let own = self.plots.iter().map(|plot| (plot.view, plot.axes));
                own.eq(self.scene.plots.iter().map(|plot_setup| (plot_setup.view, plot_setup.axes)))
            }
            // Of a machine only the unstable cycle that borders the basin counts.
            TextCondition::Unstable if self.draws_whole() => border == Some(Border::Cycle),
            TextCondition::Unstable => any(|cycle| !cycle.stable),
            TextCondition::Stable => any(|cycle| cycle.stable),
            TextCondition::Separatrix => border.is_some_and(Border::parts_without_cycle),
            TextCondition::Safe => {
                matches!(border, Some(Border::None | Border::Unknown(_)))
                    && found.is_some_and(|found| found.parameters.r > 0.0)
            }
            TextCondition::Sticks => any(Cycle::sticks),
            TextCondition::Compares(symbol, bounds) => bounds.contains(&self.value(symbol)),
            TextCondition::Shows(layer) => self.shows(layer),
            TextCondition::Rests => self.fate() == Some(End::Rests),
            TextCondition::Grows => {
                matches!(self.fate(), Some(End::Grows | End::Onto { grows: true, .. }))
            }
        }
    }

    /// The cycles at the parameters of a motion; `None` until they are known.
    pub(crate) fn cycles_beside(&self, motion: &Motion) -> Option<&Drawing> {
        self.cycles().filter(|found| found.parameters == motion.problem.parameters)
    }

    /// All motions by the model that is drawn, and the fate of the one on show; `None` until its cycles are known.
    pub fn course(&self) -> Option<(&Portrait, Fate)> {
        let found = self.cycles_beside(self.trajectory()?)?;
        let (fate, _) = self.told()?;
        Some((&found.portrait, fate))
    }

    /// Finds out what becomes of the motion on show, if that or its cycles are others than before.
    pub(crate) fn keep_course(&mut self) {
        let asked = |motion: &Motion| {
            let found = self.cycles_beside(motion)?;
            let cycles = &self.standing(Topic::Cycles, self.plot).reply()?.request;
            let start = motion.problem.initial;
            let known = self.answers.course.as_ref();
            let known = known.filter(|known| known.start == start && known.cycles == *cycles);
            Some(known.cloned().unwrap_or_else(|| Course {
                start,
                cycles: cycles.clone(),
                told: told(&found.portrait, start),
                border: found.portrait.border_toward(start),
            }))
        };
        self.answers.course = self.trajectory().and_then(asked);
    }

    /// What becomes of the motion on show, if that is known of this one.
    fn told(&self) -> Option<(Fate, bool)> {
        let start = self.trajectory()?.problem.initial;
        self.answers.course.as_ref().filter(|known| known.start == start)?.told
    }

    /// The fate of the motion that was computed last; `None` until its cycles are known, and for methods
    /// that miss the turning points.
    pub fn fate(&self) -> Option<End> {
        let motion = self.trajectory()?;
        if !motion.problem.method.spec().events || self.contact().is_some() {
            return None;
        }
        let end = match self.cycles_beside(motion) {
            Some(found) => end(found, motion, self.told()),
            None => linear(motion),
        };
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
    use crate::flow::{Detail, Limits};

    fn motion(parameters: Parameters, initial: State, until: f64) -> Motion {
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
