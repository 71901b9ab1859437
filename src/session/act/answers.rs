//! What happens when an answer arrives.

use std::sync::Arc;

use crate::flow::Reason;
use crate::question::{Failure, Rows};
use crate::scene::{Answer, Answered, Fit, Topic, View};
use crate::session::act::notice::refuse;
use crate::session::read::fit::{fitted, is_pending};
use crate::session::state::plot::Framing;
use crate::session::state::scan::{Progress, SCANNING};
use crate::session::state::session::{Recomputed, Session};

impl Session {
    /// Takes an answer in; returns whether it is the answer to a question that is asked now.
    pub(in crate::session) fn take(&mut self, answered: Answered) -> bool {
        let topic = answered.request.topic();
        if topic == Topic::Scan {
            return self.take_rows(&answered);
        }
        let asked = self.asks().contains(&answered.request);
        if let Ok(answer) = &answered.result {
            let (cost, seconds) = (answer.cost(), answered.seconds);
            // No key has waited for a proof.
            if topic != Topic::Proof {
                self.price.recomputed.push(Recomputed { topic, cost, seconds });
            }
            if let Answer::Fit(fit) = answer
                && asked
            {
                self.show_fit(&fit.clone());
            }
        }
        self.answers.keep(answered);
        asked
    }

    /// Shows the motion that fits a record, and opens with it from now on; or says why there is none.
    fn show_fit(&mut self, fit: &Fit) {
        let found = match fit.found() {
            Ok(found) => found,
            Err(unfit) => return drop(refuse(self, unfit.to_string())),
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

    /// Takes rows of the scan in; returns whether they were asked for.
    pub(in crate::session) fn take_rows(&mut self, answered: &Answered) -> bool {
        if self.scan_request().as_ref() != Some(&answered.request) {
            return false;
        }
        let Some(scanned) = &mut self.scanned else { return false };
        scanned.seconds = answered.seconds;
        match &answered.result {
            Ok(Answer::Scan(Rows { first, rows })) if *first == scanned.rows.len() => {
                scanned.rows.extend_from_slice(rows);
            }
            Ok(_) => return false,
            // What was stopped has been marked so before.
            Err(Failure::Reason(Reason::Interrupted)) => return true,
            Err(_) => scanned.progress = Progress::Stopped,
        }
        if scanned.rows.len() == scanned.scan.points() {
            scanned.progress = Progress::Done;
            if let Some(notice) = self.notice.as_mut().filter(|notice| notice.text == SCANNING) {
                notice.text = format!("scanned: {} rows", scanned.rows.len());
            }
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
        let of_scene = session.plot_of_scene(index, view);
        let plot = &mut session.plots[index];
        plot.window = window.unwrap_or(plot.window);
        // Where the scene leaves the window to the answers, fitting is what the scene wants.
        let scenes = of_scene.is_some_and(|of| of.window.is_none() && of.axes == plot.axes);
        plot.framing = if scenes { Framing::Scene } else { Framing::Fitted };
    }
}
