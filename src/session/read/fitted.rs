//! The fit of the record on show: of all numbers, or of the others while some are held by hand.

use crate::model::Knob;
use crate::model::belt::Units;
use crate::question;
use crate::question::fit::Unsure;
use crate::question::{Fit, Fitted};
use crate::scene::{Answer, Request, Topic};
use crate::session::state::{AnswerState, Session, Uncertainty};

impl Session {
    /// The fit of the record on show with the held numbers; until it is there, the most similar one.
    pub fn fitted(&self) -> Option<&Fitted> {
        // With the distribution of the margin once that is there.
        let drawn = self.refit_request(true).map(|request| self.answers.standing(&request));
        let held = drawn
            .filter(|standing| standing.is_fresh())
            .or_else(|| self.refit_request(false).map(|request| self.answers.standing(&request)));
        let held = held.and_then(AnswerState::answer).and_then(|answer| match answer {
            Answer::Refit(fit) => fit.found().ok(),
            _ => None,
        });
        held.or_else(|| self.fit_of_all()?.found().ok())
    }

    /// The fit only if the distribution of its margin is that for the held numbers and for what is unsure.
    pub fn drawn(&self) -> Option<&Fitted> {
        let drawn = self.refit_request(true).map(|request| self.answers.standing(&request));
        self.fitted().filter(|_| drawn.is_none_or(AnswerState::is_fresh))
    }

    /// The fit only if it is up to date with the held numbers.
    pub(in crate::session) fn followed(&self) -> Option<&Fitted> {
        let pending =
            self.refit_request(false).is_some_and(|it| !self.answers.standing(&it).is_fresh());
        if pending { None } else { self.fitted() }
    }

    /// The fit of all numbers; `None` until it is there.
    fn fit_of_all(&self) -> Option<&Fit> {
        let standing = self.standing(Topic::Fit, self.plot);
        match standing.answer()? {
            Answer::Fit(fit) if standing.is_fresh() => Some(fit),
            _ => None,
        }
    }

    /// The question for the fit with the held numbers, if `drawn` with the distribution of the margin; `None`
    /// if nothing is held, and nothing unsure that a margin is drawn for.
    pub(in crate::session) fn refit_request(&self, drawn: bool) -> Option<Request> {
        let held =
            Knob::PARAMETERS.map(|symbol| self.doubt.holds(symbol).then(|| self.value(symbol)));
        let asks = held.iter().any(Option::is_some) || (drawn && !self.doubt.is_certain());
        let fit = self.fit_of_all().filter(|_| asks)?.clone();
        let Uncertainty { half_widths, disturbance, .. } = self.doubt;
        let drawn = drawn.then_some(Unsure { disturbance, half_widths });
        Some(Request::Refit(question::refit::Inputs { fit, held, drawn }))
    }

    /// Whether the record on show is being fitted.
    pub fn is_fitting(&self) -> bool {
        let request = self.request(Topic::Fit, self.plot);
        request.is_some_and(|request| self.is_open(&request))
    }

    /// The units of the machine or of the record on show.
    pub fn units(&self) -> Option<Units> {
        match self.running() {
            Some(running) => Some(running.reduced.units),
            None => self.fitted()?.fit.units(),
        }
    }
}
