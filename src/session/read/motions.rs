//! The motions on show: the present one, which the numbers and the sentences are about, and those beside it.

use crate::flow::{Problem, Trajectory};
use crate::scene::{Answer, Topic};
use crate::session::state::session::Session;

impl Session {
    /// The present motion first, then those beside it, the oldest first.
    pub fn problems(&self) -> Vec<Problem> {
        let others = self.others.all().iter();
        let others = others.map(|start| Problem { initial: *start, ..self.problem });
        std::iter::once(self.problem).chain(others).collect()
    }

    /// The number of the motion in this place among [`Session::problems`], from 1 in the order in which they
    /// were started: the present one is the last. `None` where it is alone.
    pub fn number(&self, place: usize) -> Option<usize> {
        match (self.others.all().len(), place) {
            (0, _) => None,
            (count, 0) => Some(count + 1),
            _ => Some(place),
        }
    }

    /// What has been computed of them, stale or not; each with its place.
    pub fn motions(&self) -> Vec<(usize, &Trajectory)> {
        let asked = self.problems().into_iter().enumerate();
        let found = asked.filter_map(|(place, problem)| {
            let request = self.request_for(Topic::Trajectory, self.plot, problem)?;
            let answer = self.answers.standing(&request).answer()?;
            let Answer::Trajectory(found) = answer else { return None };
            Some((place, found))
        });
        found.collect()
    }
}
