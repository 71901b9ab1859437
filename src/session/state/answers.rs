//! Answers, stored by their questions.
//!
//! The same question always finds its answer, whichever plot, variant or mark asks. Until there is one, another
//! answer stands in: that to the draft of the question, otherwise that to the most similar question.

use std::sync::Arc;

use crate::flow::{Fate, Reason};
use crate::model::State;
use crate::question::NoAnswer;
use crate::scene::{Finding, Reply, Request};

/// Limit on the integration steps in answers to questions that are no longer asked: some ten megabytes of
/// points.
const MOST_STEPS: u64 = 20_000;

/// Maximum number of answers to questions that are no longer asked.
const MOST: usize = 64;

/// The state of the answer to a question.
#[derive(Clone, Copy, Debug)]
pub enum AnswerState<'a> {
    Fresh(&'a Reply),
    /// Only the answer to the draft is there.
    Draft(&'a Reply),
    /// The answer to another question is shown in its place.
    Stale(&'a Reply),
    /// No answer can stand in.
    None,
}

impl<'a> AnswerState<'a> {
    /// The answer that is there, with its question.
    pub fn reply(self) -> Option<&'a Reply> {
        use AnswerState::{Draft, Fresh, Stale};
        if let Fresh(found) | Draft(found) | Stale(found) = self {
            Some(found)
        } else {
            None
        }
    }

    /// What is there to be drawn.
    pub fn answer(self) -> Option<&'a Finding> {
        self.reply()?.result.as_ref().ok()
    }

    pub fn is_fresh(self) -> bool {
        matches!(self, AnswerState::Fresh(_))
    }

    /// The same without an answer that only stands in.
    pub fn fresh(self) -> Self {
        if self.is_fresh() { self } else { AnswerState::None }
    }
}

/// What becomes of a start. It is kept for the motion on show, so that it is computed once per answer, not wherever
/// it is told.
#[derive(Clone, Debug, PartialEq)]
pub struct Course {
    pub start: State,
    /// The question about cycles whose portrait says so.
    pub cycles: Request,
    /// Its fate, and whether a motion onto a cycle starts within that; `None` if it is unknown.
    pub told: Option<(Fate, bool)>,
    /// The size from which on a kick in its direction is lost, by the border that they trace.
    pub border: Option<f64>,
}

/// The stored answers and failures.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Answers {
    /// Sorted by last use, the most recent last.
    held: Vec<Arc<Reply>>,
    /// The present questions and their drafts.
    asked: Vec<Request>,
    /// What becomes of the motion on show by these answers.
    pub course: Option<Course>,
}

impl Answers {
    /// The state of the answer to a question.
    pub fn standing(&self, request: &Request) -> AnswerState<'_> {
        if let Some(found) = self.good(request) {
            return AnswerState::Fresh(found);
        }
        if let Some(draft) = request.draft().and_then(|draft| self.good(&draft)) {
            return AnswerState::Draft(draft);
        }
        // The answer to another present question does not stand in.
        let others = |held: &&Arc<Reply>| !self.asked.contains(&held.request);
        self.nearest(request, others).map_or(AnswerState::None, AnswerState::Stale)
    }

    /// Evaluations that the answer to this question took, or that to the most similar one that has a draft; 0
    /// if there is none.
    pub fn cost(&self, request: &Request) -> u64 {
        let found = self.nearest(request, |held| held.request.draft().is_some());
        found.map_or(0, |found| found.cost().evaluations)
    }

    /// Why a question has no answer.
    pub fn failure(&self, request: &Request) -> Option<&NoAnswer> {
        self.held(request)?.result.as_ref().err()
    }

    /// Whether a question has neither an answer nor a failure.
    pub fn is_open(&self, request: &Request) -> bool {
        self.held(request).is_none()
    }

    /// Stores an answer in place of the previous one; an interrupted one is ignored.
    pub fn keep(&mut self, reply: Reply) {
        if reply.result != Err(NoAnswer::Reason(Reason::Interrupted)) {
            self.held.retain(|held| held.request != reply.request);
            self.held.push(Arc::new(reply));
        }
    }

    /// Sets the present questions. Their answers are kept, and the most recently used of the others.
    pub fn ask(&mut self, asked: Vec<Request>) {
        let drafts: Vec<Request> = asked.iter().filter_map(Request::draft).collect();
        self.asked = drafts.into_iter().chain(asked).collect();
        let (used, others): (Vec<_>, Vec<_>) =
            self.held.drain(..).partition(|held| self.asked.contains(&held.request));
        let mut steps = 0;
        let fits = |held: &Arc<Reply>| {
            let before = steps;
            steps += held.cost().steps;
            before <= MOST_STEPS
        };
        let kept: Vec<_> = others.into_iter().rev().take(MOST).take_while(fits).collect();
        self.held = kept.into_iter().rev().chain(used).collect();
    }

    /// Forgets all answers to questions that are not asked at present.
    pub fn forget_others(&mut self) {
        self.held.retain(|held| self.asked.contains(&held.request));
    }

    /// Forgets all failures; returns whether there were any.
    pub fn forget_failures(&mut self) -> bool {
        let before = self.held.len();
        self.held.retain(|held| held.result.is_ok());
        self.held.len() < before
    }

    /// All answers, for tests that change them.
    #[cfg(test)]
    pub fn each(&mut self) -> impl Iterator<Item = &mut Reply> {
        self.held.iter_mut().map(Arc::make_mut)
    }

    fn held(&self, request: &Request) -> Option<&Reply> {
        self.held.iter().find(|held| held.request == *request).map(|held| &**held)
    }

    fn good(&self, request: &Request) -> Option<&Reply> {
        self.held(request).filter(|held| held.result.is_ok())
    }

    /// The good answer to the most similar question; of several, the one used last.
    fn nearest(&self, request: &Request, counts: impl Fn(&&Arc<Reply>) -> bool) -> Option<&Reply> {
        let good = self.held.iter().filter(|held| held.result.is_ok()).filter(counts);
        let alike = good.filter_map(|held| Some((held.request.likeness(request)?, held)));
        alike.max_by_key(|(likeness, _)| *likeness).map(|(_, held)| &**held)
    }
}
