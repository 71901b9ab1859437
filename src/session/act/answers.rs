//! What happens when an answer arrives.

use std::sync::Arc;

use crate::flow::Reason;
use crate::scene::answer::{Failure, Rows};
use crate::scene::{Answer, Answered, Fit, Request, SLOTS, Slot, View};
use crate::session::act::notice::refuse;
use crate::session::read::fit::{fitted, is_pending};
use crate::session::state::plot::Framing;
use crate::session::state::scan::Progress;
use crate::session::state::session::{Recomputed, Session};

impl Session {
    /// Takes an answer in; returns whether it is the answer to a question of today.
    ///
    /// One that comes late, to a question that is no longer asked, is still newer than what is shown,
    /// unless that is the answer to today's question.
    pub(in crate::session) fn take(&mut self, answered: Answered) -> bool {
        let slot = answered.request.slot();
        if slot == Slot::Scan {
            return self.take_rows(&answered);
        }
        let wanted: Vec<_> = (0..self.plots.len()).map(|plot| self.request(slot, plot)).collect();
        let asked = wanted.iter().flatten().any(|wanted| *wanted == answered.request);
        match &answered.result {
            Err(Failure::Reason(Reason::Interrupted)) => {}
            Err(failure) => {
                self.failures.retain(|(request, _)| *request != answered.request);
                self.failures.push((answered.request, failure.clone()));
            }
            Ok(answer) => {
                let (cost, seconds) = (answer.cost(), answered.seconds);
                if answered.request.draft().is_some() {
                    self.effort.burdens.insert(slot, cost.evaluations);
                }
                self.price.recomputed.push(Recomputed { slot, cost, seconds });
                self.failures.retain(|(request, _)| *request != answered.request);
                if let Answer::Fit(fit) = answer
                    && asked
                {
                    self.show_fit(&fit.clone());
                }
                let answered = Arc::new(answered);
                let draft_of =
                    |wanted: &Request| wanted.draft().as_ref() == Some(&answered.request);
                let of_today = asked || wanted.iter().flatten().any(draft_of);
                for (plot, wanted) in wanted.iter().enumerate() {
                    let Some(wanted) = wanted else { continue };
                    // What another plot asks today is no late answer to this one.
                    let late = !of_today && answered.request.resembles(wanted);
                    let newer = (draft_of(wanted) || late && !self.has_draft(slot, plot))
                        && self.is_stale(slot, plot);
                    if answered.request == *wanted || newer {
                        self.hold(plot, Arc::clone(&answered));
                    }
                }
            }
        }
        asked
    }

    /// Shows the motion that fits a record, and opens with it from now on; or says why there is none.
    fn show_fit(&mut self, fit: &Fit) {
        let found = match fit.found() {
            Ok(found) => found,
            Err(unfit) => return refuse(self, unfit.to_string()),
        };
        let problem = found.problem(self.problem);
        // What the user has changed meanwhile stays.
        if self.problem == self.scene.problem {
            self.problem = problem;
        }
        Arc::make_mut(&mut self.scene).problem = problem;
        for plot in &mut self.plots {
            plot.framing = Framing::Fitting;
        }
    }

    /// Keeps an answer where it is looked for.
    fn hold(&mut self, plot: usize, answered: Arc<Answered>) {
        let slot = answered.request.slot();
        if !slot.is_own() {
            self.answers.insert(slot, answered);
        } else if let Some(plot) = self.plots.get_mut(plot) {
            plot.answers.insert(slot, answered);
        }
    }

    /// Gives every plot the answers that others have to its questions, and forgets failures of
    /// questions that nobody asks any more.
    pub(in crate::session) fn share(&mut self) {
        let own = || SLOTS.into_iter().filter(|slot| slot.is_own());
        let all = (0..self.plots.len()).flat_map(|plot| own().map(move |slot| (plot, slot)));
        for (plot, slot) in all.collect::<Vec<_>>() {
            if let Some(wanted) = self.request(slot, plot).filter(|_| self.is_stale(slot, plot)) {
                let mut others =
                    (0..self.plots.len()).filter_map(|other| self.answered(slot, other));
                let found = others.find(|held| held.request == wanted).cloned();
                if let Some(found) = found {
                    self.hold(plot, found);
                }
            }
        }
        let mut failures = std::mem::take(&mut self.failures);
        failures.retain(|(failed, _)| {
            let slot = failed.slot();
            let today = |plot| self.request(slot, plot);
            let is_asked =
                |wanted: Request| wanted == *failed || wanted.draft().as_ref() == Some(failed);
            (0..self.plots.len()).filter_map(today).any(is_asked)
        });
        self.failures = failures;
    }

    /// Takes rows of the scan in; returns whether they were asked for.
    pub(in crate::session) fn take_rows(&mut self, answered: &Answered) -> bool {
        if self.scan_request().as_ref() != Some(&answered.request) {
            return false;
        }
        let Some(scanned) = &mut self.scanned else { return false };
        scanned.seconds = answered.seconds;
        match &answered.result {
            Ok(Answer::Rows(Rows { first, rows })) if *first == scanned.rows.len() => {
                scanned.rows.extend_from_slice(rows);
            }
            Ok(_) => return false,
            // What was stopped has been marked so before.
            Err(Failure::Reason(Reason::Interrupted)) => return true,
            Err(_) => scanned.progress = Progress::Stopped,
        }
        if scanned.rows.len() == scanned.scan.points() {
            scanned.progress = Progress::Done;
        }
        for plot in self.plots.iter_mut().filter(|plot| plot.view == View::Scan) {
            plot.window = scanned.window();
        }
        true
    }
}

/// Fits the plots on show that wait for it, once their answers are there.
pub(in crate::session) fn resolve(session: &mut Session) {
    for index in session.on_show() {
        let waits = session.plots[index].framing == Framing::Fitting;
        if !waits || is_pending(session, index) {
            continue;
        }
        let view = session.plots[index].view;
        let window = fitted(session, index);
        let of_scene = session.exhibit_of_scene(index, view);
        let plot = &mut session.plots[index];
        plot.window = window.unwrap_or(plot.window);
        // Where the scene leaves the window to the answers, fitting is what the scene wants.
        let scenes = of_scene.is_some_and(|of| of.window.is_none() && of.axes == plot.axes);
        plot.framing = if scenes { Framing::Scene } else { Framing::Fitted };
    }
}
