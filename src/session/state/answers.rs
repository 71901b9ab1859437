//! Answers, kept by their questions.
//!
//! Whatever was answered is found again by asking the same, whichever plot, variant or mark asks. Until an
//! answer is there another one stands in: that to the draft of the question, else that to the question
//! most alike.

use std::sync::Arc;

use crate::flow::Reason;
use crate::question::Failure;
use crate::scene::{Answer, Answered, Request};

/// Integration steps whose points are kept beyond what is asked: some ten megabytes.
const MOST_STEPS: u64 = 20_000;

/// Answers that are kept beyond what is asked.
const MOST: usize = 64;

/// How far the answer to a question is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Standing<'a> {
    Fresh(&'a Answered),
    /// A rough one is there.
    Draft(&'a Answered),
    /// The answer to another question is shown in its place.
    Stale(&'a Answered),
    /// There is nothing like it.
    None,
}

impl<'a> Standing<'a> {
    /// What there is, with its question.
    pub fn answered(self) -> Option<&'a Answered> {
        match self {
            Standing::Fresh(found) | Standing::Draft(found) | Standing::Stale(found) => Some(found),
            Standing::None => None,
        }
    }

    /// What there is, as views draw it.
    pub fn answer(self) -> Option<&'a Answer> {
        let found = self.answered()?.result.as_ref().ok()?;
        Some(if let Answer::Whole(whole) = found { &whole.drawn } else { found })
    }

    pub fn is_fresh(self) -> bool {
        matches!(self, Standing::Fresh(_))
    }
}

/// The answers that are kept, and the reasons why there is none.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Answers {
    /// The one used last at the end.
    held: Vec<Arc<Answered>>,
    /// What is asked at present, and what its drafts ask.
    asked: Vec<Request>,
}

impl Answers {
    /// How far the answer to a question is.
    pub fn standing(&self, request: &Request) -> Standing<'_> {
        if let Some(found) = self.good(request) {
            return Standing::Fresh(found);
        }
        if let Some(draft) = request.draft().and_then(|draft| self.good(&draft)) {
            return Standing::Draft(draft);
        }
        // What is asked for its own sake stands in for nothing else.
        let others = |held: &&Arc<Answered>| !self.asked.contains(&held.request);
        self.nearest(request, others).map_or(Standing::None, Standing::Stale)
    }

    /// Evaluations that the answer to a question took, or that to the one most like it; drafts aside.
    pub fn cost(&self, request: &Request) -> u64 {
        let found = self.nearest(request, |held| held.request.draft().is_some());
        let cost = found.and_then(|found| found.result.as_ref().ok()).map(Answer::cost);
        cost.unwrap_or_default().evaluations
    }

    /// Why a question has no answer.
    pub fn failure(&self, request: &Request) -> Option<&Failure> {
        self.held(request)?.result.as_ref().err()
    }

    /// Whether a question has neither an answer nor a reason for having none.
    pub fn is_open(&self, request: &Request) -> bool {
        self.held(request).is_none()
    }

    /// Keeps an answer, in place of the one before; an interrupted one does not count.
    pub fn keep(&mut self, answered: Answered) {
        if answered.result != Err(Failure::Reason(Reason::Interrupted)) {
            self.held.retain(|held| held.request != answered.request);
            self.held.push(Arc::new(answered));
        }
    }

    /// Notes what is asked at present. Its answers are kept, and of the others those used last.
    pub fn ask(&mut self, asked: Vec<Request>) {
        let drafts: Vec<Request> = asked.iter().filter_map(Request::draft).collect();
        self.asked = drafts.into_iter().chain(asked).collect();
        let (used, others): (Vec<_>, Vec<_>) =
            self.held.drain(..).partition(|held| self.asked.contains(&held.request));
        let mut steps = 0;
        let fits = |held: &Arc<Answered>| {
            let before = steps;
            steps += held.result.as_ref().map_or(0, |answer| answer.cost().steps);
            before <= MOST_STEPS
        };
        let mut kept: Vec<_> = others.into_iter().rev().take(MOST).take_while(fits).collect();
        kept.reverse();
        self.held = kept.into_iter().chain(used).collect();
    }

    /// Forgets what is not asked at present.
    pub fn forget_others(&mut self) {
        self.held.retain(|held| self.asked.contains(&held.request));
    }

    /// Forgets that questions have no answer; returns whether there were any.
    pub fn forget_failures(&mut self) -> bool {
        let before = self.held.len();
        self.held.retain(|held| held.result.is_ok());
        self.held.len() < before
    }

    /// Every answer, to be changed.
    #[cfg(test)]
    pub fn each(&mut self) -> impl Iterator<Item = &mut Answered> {
        self.held.iter_mut().map(Arc::make_mut)
    }

    fn held(&self, request: &Request) -> Option<&Answered> {
        self.held.iter().find(|held| held.request == *request).map(|held| &**held)
    }

    fn good(&self, request: &Request) -> Option<&Answered> {
        self.held(request).filter(|held| held.result.is_ok())
    }

    /// The good answer to the question most like this one; of several the one used last.
    fn nearest(
        &self,
        request: &Request,
        counts: impl Fn(&&Arc<Answered>) -> bool,
    ) -> Option<&Answered> {
        let good = self.held.iter().filter(|held| held.result.is_ok()).filter(counts);
        let alike = good.filter_map(|held| Some((held.request.likeness(request)?, held)));
        alike.max_by_key(|(likeness, _)| *likeness).map(|(_, held)| &**held)
    }
}
