//! The motions on show, the present one, which the numbers and the sentences describe, and those beside it; and playback:
//! a head moves along the present one.
//!
//! Nothing here reads a clock. The outer rings report how much time has passed (`super::Msg::Elapsed`) while
//! [`Session::is_moving`], and a keystroke file does the same with `<elapse SECONDS>`.

use std::f64::consts::TAU;

use crate::flow::{Method, Motion, Outcome, Problem, Sample};
use crate::model::{Parameters, State};
use crate::numerics::{by_number, tanh};
use crate::portrait::first_at;
use crate::scene::{Topic, View};
use crate::session::{Pace, Session};

impl Session {
    /// The computed state of the motion that is nearest to a time; after it has come to rest, the place of
    /// rest.
    pub fn state_at(&self, tau: f64) -> Option<State> {
        let found = self.trajectory()?;
        if let Outcome::Captured { tau: rest, q } = found.outcome
            && tau >= rest
        {
            return Some(State { q, v: 0.0 });
        }
        let samples = &found.samples;
        let (before, after) = samples.split_at(samples.partition_point(|it| it.tau < tau));
        let distance = |sample: &&Sample| (sample.tau - tau).abs();
        before
            .last()
            .into_iter()
            .chain(after.first())
            .min_by(by_number(distance))
            .map(Sample::state)
    }
}

/// The turning points of a motion in the order of time: the start if it is one, every arrival at `v = 0`, and
/// finally the place of rest.
///
/// Without friction, arrivals are not located, and the turning points are interpolated between samples.
pub fn turning_points(motion: &Motion) -> Vec<f64> {
    let start = motion.problem.initial;
    let mut points: Vec<f64> = (start.v == 0.0).then_some(start.q).into_iter().collect();
    if motion.crossings.is_empty() && motion.problem.parameters.r == 0.0 {
        points.extend(motion.samples.windows(2).filter_map(between));
    } else {
        points.extend(motion.crossings.iter().map(|crossing| crossing.q));
    }
    points
}

/// The displacement where the velocity changes its sign between two samples, by linear interpolation.
fn between(pair: &[Sample]) -> Option<f64> {
    let [one, other] = pair else { return None };
    let turns = (one.v > 0.0 && other.v <= 0.0) || (one.v < 0.0 && other.v >= 0.0);
    let time = (other.tau - one.tau) * one.v / (one.v - other.v);
    turns.then_some(one.q + 0.5 * one.v * time)
}

/// The force of dry friction along a motion as a polyline of (time, force), up to `end` if the motion comes to
/// rest: `-r sign(v)` while it moves, and the force that balances the spring at rest. It lies in `[-r, r]`.
pub fn friction_force(motion: &Motion, end: f64) -> Vec<(f64, f64)> {
    let Problem { parameters: Parameters { r, .. }, epsilon, .. } = motion.problem;
    let mut force = Vec::new();
    for pair in motion.samples.windows(2) {
        let [from, to] = [pair[0], pair[1]];
        if motion.method == Method::Smoothed {
            force.push((to.tau, -r * tanh(to.v / epsilon)));
            continue;
        }
        // Each half swing begins and ends on v = 0, so the sign comes from the samples between.
        let sum = from.v + to.v;
        let value = if sum == 0.0 { 0.0 } else { -r * sum.signum() };
        match force.last_mut() {
            Some((last, same)) if *same == value => *last = to.tau,
            _ => force.extend([(from.tau, value), (to.tau, value)]),
        }
    }
    if let Outcome::Captured { tau, q } = motion.outcome {
        force.extend([(tau, q), (end.max(tau), q)]);
    }
    force
}

impl Session {
    /// The present motion, followed by the others, the oldest first.
    pub fn problems(&self) -> Vec<Problem> {
        let starts = std::iter::once(&self.problem.initial).chain(&self.others);
        starts.map(|start| Problem { initial: *start, ..self.problem }).collect()
    }

    /// The number of the motion at this index of [`Session::problems`], counted from 1 in the order in which
    /// motions were started, so the present one has the largest. `None` if there is only one motion.
    pub fn number(&self, place: usize) -> Option<usize> {
        match (self.others.len(), place) {
            (0, _) => None,
            (count, 0) => Some(count + 1),
            _ => Some(place),
        }
    }

    /// The computed motions, stale or not, each with its index.
    pub fn motions(&self) -> Vec<(usize, &Motion)> {
        let motion = |(place, problem)| {
            let request = self.request_for(Topic::Trajectory, self.plot, problem)?;
            Some((place, self.answers.standing(&request).answer()?.try_as_trajectory_ref()?))
        };
        self.problems().into_iter().enumerate().filter_map(motion).collect()
    }
}

impl Session {
    /// Whether playback advances with time. It pauses while the motion is recomputed, so that the position of
    /// the head does not depend on how long that takes.
    pub fn is_moving(&self) -> bool {
        let asked = self.request(Topic::Trajectory, self.plot);
        self.playback.playing && asked.is_none_or(|request| !self.is_open(&request))
    }

    /// The state of the motion at the head, at its start while one is asked what becomes of it; `None` before the first
    /// playback.
    pub fn head(&self) -> Option<Sample> {
        let at = if self.is_asked() { 0.0 } else { self.playback.at? };
        self.trajectory()?.at(at.min(self.last_moment()))
    }

    /// The moment up to which the present motion is drawn: the head before it has reached the end, so that a motion that
    /// is played is seen as it happens, and does not tell how it ends.
    pub fn drawn_until(&self) -> Option<Sample> {
        let goes_on = self.playback.at.is_some_and(|at| at < self.last_moment());
        self.head().filter(|_| goes_on || self.is_asked())
    }

    /// The samples of the motion in this place among those on show, as far as it is drawn.
    pub fn seen<'a>(&self, place: usize, motion: &'a Motion) -> impl Iterator<Item = Sample> + 'a {
        let head = self.drawn_until().filter(|_| place == 0);
        let last = head.map_or(f64::INFINITY, |head| head.tau);
        motion.samples.iter().copied().take_while(move |sample| sample.tau <= last).chain(head)
    }

    /// The stretches on which that motion sticks, as far as it is drawn.
    pub fn sticking(&self, place: usize, motion: &Motion) -> Vec<[Sample; 2]> {
        let all = motion.sticks(motion.problem.until);
        let head = self.drawn_until().filter(|_| place == 0);
        let Some(head) = head else { return all.collect() };
        let begun = all.filter(|[from, _]| from.tau <= head.tau);
        begun.map(|[from, to]| [from, if to.tau <= head.tau { to } else { head }]).collect()
    }

    /// The line about playback is on show where there is something to play, or a motion is being played.
    pub fn tells_playback(&self) -> bool {
        let sketched = self.on_show().any(|plot| self.plots[plot].view == View::Belt);
        sketched || self.playback.at.is_some()
    }

    /// The end of playback: the end of the motion, or where the mass would overtake its belt.
    pub fn last_moment(&self) -> f64 {
        let contact = self.contact().map(|(tau, _)| tau);
        contact.or_else(|| self.trajectory().map(|found| found.outcome.tau())).unwrap_or(0.0)
    }

    /// Time and displacement where the motion reaches the speed of the belt; `None` if it does not, or there is
    /// no belt.
    pub fn contact(&self) -> Option<(f64, f64)> {
        self.contact_of(self.trajectory()?)
    }

    /// The same for any motion on show.
    pub fn contact_of(&self, motion: &Motion) -> Option<(f64, f64)> {
        if self.draws_whole() {
            return None;
        }
        first_at(motion, self.running()?.reduced.sticking_velocity)
    }

    /// Dimensionless time per second at a pace.
    pub fn rate(&self, pace: Pace) -> f64 {
        match (pace, self.running()) {
            (Pace::Period(seconds), _) => TAU / seconds,
            (Pace::Real, Some(machine)) => machine.reduced.units.omega_0,
            (Pace::Real, None) => TAU,
        }
    }

    /// The pace in words.
    pub fn pace(&self) -> String {
        match (self.playback.pace, self.running()) {
            (Pace::Period(seconds), None) => format!("{seconds} s a period"),
            (Pace::Period(seconds), Some(machine)) => {
                let slower = machine.reduced.units.omega_0 * seconds / TAU;
                let (times, way) = if slower >= 1.0 {
                    (slower, "slower")
                } else {
                    (1.0 / slower, "faster")
                };
                format!("{times:.1} times {way} than real time")
            }
            (Pace::Real, _) => "real time".to_owned(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::flow::Limits;

    const BRAKED: Parameters = Parameters { d: 0.02, d2: 0.1, d3: 0.05, r: 0.125 };
    const START: State = State { q: 1.5, v: 0.0 };

    #[test]
    fn a_state_is_read_where_the_motion_was_computed_and_at_rest_for_ever() {
        let mut session =
            Session::new(crate::scene::plain(), crate::session::Size { width: 80, height: 24 });
        assert_eq!(session.state_at(1.0), None);
        session.problem = Problem { parameters: BRAKED, initial: START, ..session.problem };
        let request = session.request(crate::scene::Topic::Trajectory, 0).unwrap();
        let answer = crate::question::answer(&request, &Limits::PATIENT).unwrap();
        session.take(crate::scene::Reply {
            request,
            result: Ok(answer),
            seconds: 0.0,
            complete: true,
        });
        assert_eq!(session.state_at(0.0), Some(START));
        let found = session.trajectory().unwrap();
        let sample = found.samples[40];
        assert_eq!(session.state_at(sample.tau), Some(State { q: sample.q, v: sample.v }));
        let Outcome::Captured { q, .. } = found.outcome else { panic!("it comes to rest") };
        assert_eq!(session.state_at(1e9), Some(State { q, v: 0.0 }));
    }
}
