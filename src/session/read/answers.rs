//! The last answer on each topic, named after its content; and the fit of the record on show, of all numbers or of the
//! others while some are held by hand.

use crate::accuracy::{Deviation, HarmonicBalance, NoComparison, Reference, Trade};
use crate::branch::{Chart, MachineBranch};
use crate::fit::FitResult;
use crate::flow::Motion;
use crate::model::{Knob, State, Units};
use crate::paper::ClaimResult;
use crate::portrait::{Drawing, ReturnMap};
use crate::proof::Proof;
use crate::question::{CertainZones, Fit, NoAnswer};
use crate::scene::{Axes, Finding, Request, Topic};
use crate::session::{AnswerState, Session};

/// Why a motion has no measured error.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NoErrorReason {
    /// Its reference takes too long.
    TighterGaveUp,
    /// The motion itself was not computed to its end.
    GaveUp,
    /// Only one of the motion and its reference escapes.
    OtherFate,
}

/// The last answers, stale or not: for the plot in use, or for any plot.
impl Session {
    pub fn trajectory(&self) -> Option<&Motion> {
        self.answer(Topic::Trajectory, self.plot)?.try_as_trajectory_ref()
    }

    pub fn cycles(&self) -> Option<&Drawing> {
        Some(self.answer(Topic::Cycles, self.plot)?.try_as_cycles_ref()?.0)
    }

    pub fn balance(&self) -> Option<&HarmonicBalance> {
        self.answer(Topic::Balance, self.plot)?.try_as_balance_ref()
    }

    pub fn zones(&self) -> Option<&CertainZones> {
        self.answer(Topic::Zones, self.plot)?.try_as_zones_ref()
    }

    pub fn trade(&self) -> Option<&Trade> {
        self.answer(Topic::Trade, self.plot)?.try_as_trade_ref().map(|found| &**found)
    }

    /// The borders between bands of capture.
    pub fn borders(&self, plot: usize) -> Option<&Vec<Vec<State>>> {
        Some(self.answer(Topic::Capture, plot)?.try_as_capture_ref()?.0)
    }

    pub fn return_map(&self, plot: usize) -> Option<&ReturnMap> {
        self.answer(Topic::ReturnMap, plot)?.try_as_return_map_ref()
    }

    pub fn machine_branch(&self, plot: usize) -> Option<&MachineBranch> {
        self.answer(Topic::MachineBranch, plot)?.try_as_machine_branch_ref()
    }

    /// The chart over the two parameters of a plot.
    pub fn chart(&self, plot: usize) -> Option<&Chart> {
        let Axes { abscissa, against, .. } = self.plots[plot].axes;
        let found = self.answer(Topic::Regimes, plot)?.try_as_regimes_ref();
        found.filter(|found| (found.plane.right, found.plane.up) == (abscissa, against))
    }

    /// The proof about the cycles at the present parameters; `None` until it is there.
    pub fn proof(&self) -> Option<&Proof> {
        self.standing(Topic::Proof, self.plot).fresh().answer()?.try_as_proof_ref()
    }

    /// The fit of the record on show with the held numbers; until it is there, the most similar one.
    pub fn fitted(&self) -> Option<&FitResult> {
        // With the distribution of the margin once that is there.
        let held = self.refit(true).filter(|drawn| drawn.is_fresh()).or_else(|| self.refit(false));
        let held = held.and_then(AnswerState::answer).and_then(Finding::try_as_refit_ref);
        held.and_then(|fit| fit.found().ok()).or_else(|| self.fit_of_all()?.found().ok())
    }

    /// The fit only if the distribution of its margin is that for the held numbers and for what is unsure.
    pub fn drawn(&self) -> Option<&FitResult> {
        self.fitted().filter(|_| self.refit(true).is_none_or(AnswerState::is_fresh))
    }

    /// The fit only if it is up to date with the held numbers.
    pub(crate) fn followed(&self) -> Option<&FitResult> {
        self.fitted().filter(|_| self.refit(false).is_none_or(AnswerState::is_fresh))
    }

    /// The state of the fit with the held numbers, if `drawn` with the distribution of the margin.
    fn refit(&self, drawn: bool) -> Option<AnswerState<'_>> {
        self.refit_request(drawn).map(|request| self.answers.standing(&request))
    }

    /// The fit of all numbers; `None` until it is there.
    fn fit_of_all(&self) -> Option<&Fit> {
        self.standing(Topic::Fit, self.plot).fresh().answer()?.try_as_fit_ref()
    }

    /// The question for the fit with the held numbers, if `drawn` with the distribution of the margin; `None`
    /// if nothing is held, and nothing unsure that a margin is drawn for.
    pub(crate) fn refit_request(&self, drawn: bool) -> Option<Request> {
        let doubt = self.doubt;
        let held = Knob::PARAMETERS.map(|symbol| doubt.holds(symbol).then(|| self.value(symbol)));
        let asks = held.iter().any(Option::is_some) || (drawn && !doubt.is_certain());
        let fit = self.fit_of_all().filter(|_| asks)?.clone();
        let asked = fit.found().ok().filter(|_| drawn);
        let drawn = asked.map(|found| found.disturbed(doubt.disturbance, doubt.half_widths));
        Some(Request::Refit { fit, held, drawn })
    }

    /// Whether the record on show is being fitted.
    pub fn is_fitting(&self) -> bool {
        self.request(Topic::Fit, self.plot).is_some_and(|request| self.is_open(&request))
    }

    /// The units of the machine or of the record on show.
    pub fn units(&self) -> Option<Units> {
        self.running().map(|it| it.reduced.units).or_else(|| self.fitted()?.units())
    }

    /// The state of the answer on this topic for the present problem, as a plot asks it.
    pub fn standing(&self, topic: Topic, plot: usize) -> AnswerState<'_> {
        let request = self.request(topic, plot);
        request.map_or(AnswerState::None, |request| self.answers.standing(&request))
    }

    /// The answer on this topic for the present problem, as a plot asks it, stale or not.
    pub fn answer(&self, topic: Topic, plot: usize) -> Option<&Finding> {
        self.standing(topic, plot).answer()
    }

    /// Whether the answer on this topic is missing for the present problem.
    pub fn is_stale(&self, topic: Topic, plot: usize) -> bool {
        !self.standing(topic, plot).is_fresh()
    }

    /// Whether there are answers on this topic for all problems that a plot shows.
    pub fn is_fresh(&self, topic: Topic, plot: usize) -> bool {
        let asked = self.requests(topic, plot);
        asked.iter().flatten().all(|request| self.answers.standing(request).is_fresh())
    }

    /// Whether a question has neither an answer nor a failure.
    pub fn is_open(&self, request: &Request) -> bool {
        if request.topic() == Topic::Scan {
            return self.scan_request().as_ref() == Some(request);
        }
        self.answers.is_open(request)
    }

    /// Whether something on show has yet to be computed.
    pub fn is_busy(&self) -> bool {
        self.wants().iter().any(|request| self.is_open(request))
    }

    /// Why there is no answer on this topic for the present problem.
    pub fn failure(&self, topic: Topic, plot: usize) -> Option<&NoAnswer> {
        self.answers.failure(&self.request(topic, plot)?)
    }

    /// The error of the motion on show, and its reference, or why there is no error; `None` until both are computed.
    pub fn measured(&self) -> Option<Result<(Deviation, &Reference), NoErrorReason>> {
        let asked = self.measures().then(|| self.standing(Topic::Reference, self.plot))?;
        let reference = asked.fresh().answer()?.try_as_reference_ref()?;
        let Ok(reference) = reference else { return Some(Err(NoErrorReason::TighterGaveUp)) };
        let motion = self.standing(Topic::Trajectory, self.plot).fresh().answer()?;
        let motion = motion.try_as_trajectory_ref()?;
        let compared = reference.compare(motion).map(|deviation| (deviation, &**reference));
        Some(compared.map_err(|why| match why {
            NoComparison::GaveUp(_) => NoErrorReason::GaveUp,
            // The rest is said of machines only, whose errors are not measured here.
            NoComparison::OtherFate | NoComparison::OtherTurns | NoComparison::NoTurns => {
                NoErrorReason::OtherFate
            }
        }))
    }

    /// The examined claims of the paper; empty until they are there.
    pub fn examined(&self) -> &[ClaimResult] {
        let examined = self.answer(Topic::Claims, self.plot).and_then(Finding::try_as_claims_ref);
        examined.map_or(&[], Vec::as_slice)
    }
}
