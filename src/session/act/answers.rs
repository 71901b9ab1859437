//! Taking answers in.

use std::sync::Arc;

use crate::fit::NoEstimate;
use crate::flow::Reason;
use crate::model::Knob;
use crate::question::{NoAnswer, Rows};
use crate::scene::{Finding, Fit, Reply, Request, Topic};
use crate::session::act::scan::refit;
use crate::session::read::windows::{awaited, fitted};
use crate::session::{
    Framing, Notice, Plot, Recomputation, SCANNING, ScanProgress, Session, StepSizes,
};
use crate::words::fit::sentences;
use crate::words::level::nowhere;

impl Session {
    /// Takes an answer in; returns whether its question is asked at present.
    pub(crate) fn take(&mut self, reply: Reply) -> bool {
        let topic = reply.request.topic();
        if topic == Topic::Scan {
            return self.take_rows(&reply);
        }
        let asked = self.asks().contains(&reply.request);
        // No key waits for a proof.
        if reply.result.is_ok() && topic != Topic::Proof {
            let (cost, seconds) = (reply.cost(), reply.seconds);
            self.price.recomputed.push(Recomputation { topic, cost, seconds });
        }
        if let (Ok(Finding::Fit(fit)), true) = (&reply.result, asked) {
            if let Err(NoEstimate::Underway { motions }) = fit.found() {
                self.fitting = *motions;
                return asked;
            }
            self.fitting = 0;
            self.show_fit(fit);
        }
        if let (Request::Level { target, .. }, Ok(Finding::Level(found)), true) =
            (&reply.request, &reply.result, asked)
            && let Some(line) = nowhere(*target, found)
        {
            self.refuse(line);
        }
        self.answers.keep(reply);
        asked
    }

    /// Shows the fitted motion and makes it the opening state of the scene, or says why there is none.
    fn show_fit(&mut self, fit: &Fit) {
        let found = match fit.found() {
            Ok(found) => found,
            Err(unfit) => return self.refuse(unfit.to_string()),
        };
        let problem = found.problem(self.scene.problem);
        let errors = Knob::MOTION.into_iter().filter_map(|knob| Some((knob, found.error(knob)?)));
        let said = sentences(found);
        let scene = Arc::make_mut(&mut self.scene);
        // A step below one standard error would mean nothing.
        scene.steps.extend(errors.filter(|(_, error)| *error > 0.0));
        scene.watch = format!("{}. {}", said.join("; ").trim_end_matches('.'), scene.watch);
        if self.problem.until == scene.problem.until {
            self.problem.until = problem.until;
        }
        scene.problem = problem;
        self.steps = StepSizes::of_scene(&self.scene);
        for plot in &mut self.plots {
            plot.framing = Framing::Fitting;
        }
        let doubtful = found.estimate.whiteness.systematic;
        // A test that fails comes first.
        if let Some(text) = said.into_iter().next() {
            self.notice = Some(Notice { error: doubtful, text });
        }
    }

    /// Takes rows of the scan in; returns whether they were asked for.
    pub(crate) fn take_rows(&mut self, reply: &Reply) -> bool {
        if self.scan_request().as_ref() != Some(&reply.request) {
            return false;
        }
        let Some(scanned) = &mut self.scanned else { return false };
        scanned.seconds = reply.seconds;
        match &reply.result {
            Ok(Finding::Scan(Rows { first, rows })) if *first == scanned.rows.len() => {
                scanned.rows.extend_from_slice(rows);
            }
            Ok(_) => return false,
            // A scan that was stopped has been marked already.
            Err(NoAnswer::Reason(Reason::Interrupted)) => return true,
            Err(_) => scanned.progress = ScanProgress::Stopped,
        }
        if scanned.rows.len() == scanned.scan.points() {
            scanned.progress = ScanProgress::Done;
            if let Some(notice) = self.notice.as_mut().filter(|notice| notice.text == SCANNING) {
                notice.text = format!("scanned: {} rows", scanned.rows.len());
            }
        }
        refit(self);
        true
    }
}

/// Sets the numbers that are not held to their values in the fit.
pub fn follow_fit(session: &mut Session) {
    let fitted = session.scene.recording.as_ref().and_then(|_| session.followed());
    let Some(fitted) = fitted.map(|fitted| fitted.problem(session.problem)) else { return };
    for knob in Knob::MOTION.into_iter().filter(|knob| !session.doubt.holds(*knob)) {
        session.problem.set(knob, fitted.get(knob));
    }
}

/// Fits the plots on show that wait for it, once their answers are there.
pub fn resolve(session: &mut Session) {
    for index in session.on_show() {
        let Plot { view, framing, .. } = session.plots[index];
        if framing != Framing::Fitting || awaited(session, index).is_some() {
            continue;
        }
        let (window, of_scene) = (fitted(session, index), session.plot_of_scene(index, view));
        let plot = &mut session.plots[index];
        plot.window = window.unwrap_or(plot.window);
        // If the scene leaves the window open, a fitted window is the scene's.
        let scenes = of_scene.is_some_and(|of| of.window.is_none() && of.axes == plot.axes);
        plot.framing = if scenes { Framing::Scene } else { Framing::Fitted };
    }
}
