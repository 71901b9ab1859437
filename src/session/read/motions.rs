//! The motions on show: the present one, which the numbers and the sentences describe, and those beside it.

use crate::flow::{Problem, Trajectory};
use crate::scene::{Answer, Topic};
use crate::session::state::Session;

impl Session {
    /// The present motion, followed by the others, the oldest first.
    pub fn problems(&self) -> Vec<Problem> {
        let others = self.others.all().iter();
        let others = others.map(|start| Problem { initial: *start, ..self.problem });
        std::iter::once(self.problem).chain(others).collect()
    }

    /// The number of the motion at this index of [`Session::problems`], counted from 1 in the order in which
    /// motions were started, so the present one has the largest. `None` if there is only one motion.
    pub fn number(&self, place: usize) -> Option<usize> {
        match (self.others.all().len(), place) {
            (0, _) => None,
            (count, 0) => Some(count + 1),
            _ => Some(place),
        }
    }

    /// The computed motions, stale or not, each with its index.
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
