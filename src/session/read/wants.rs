//! What a session asks, and what it has been answered.
//!
//! A question is a pure function of the state. Most are shared by all plots; those that depend on the
//! axes or the window of a plot are that plot's own ([`Slot::is_own`]), and so are their answers. Equal
//! questions of several plots are one question, and its answer serves them all.

use std::collections::BTreeSet;
use std::sync::Arc;

use crate::flow::{Problem, Trajectory};
use crate::numerics::elementary::{exp2, hypot, log2};
use crate::oscillator::belt::Quantity;
use crate::oscillator::{Belt, Symbol};
use crate::scene::answer::{Borders, Failure};
use crate::scene::request::SPEEDS;
use crate::scene::{Answer, Answered, Axes, Fitted, Layer, Request, Slot, Span, View, Window};
use crate::session::state::overlay::{Listed, Overlay};
use crate::session::state::plot::{Framing, Pane};
use crate::session::state::rows::Row;
use crate::session::state::session::Session;
use crate::study::accuracy::{Deviation, NoComparison, Reference};
use crate::study::chart::{Chart, Plane};
use crate::study::claims::Examined;
use crate::study::harmonic_error::HarmonicBalance;
use crate::study::{Cycles, ReturnMap};

/// Evaluations beyond which an answer may take longer than a quarter of a frame: the next question of its
/// kind is answered by a draft first.
const LONG: u64 = 100_000;

/// Bands of capture that are drawn at most: more would fill the plane.
const MOST_BANDS: usize = 24;

/// Why a motion has no measured error.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unmeasured {
    /// The motion that it is measured against takes too long.
    TighterGaveUp,
    /// The motion itself was not computed to its end.
    GaveUp,
    /// One of the two escapes, and the other does not.
    OtherFate,
}

impl Session {
    /// The questions that what is on show needs answered, the most urgent first; nothing for a layer
    /// that is off, nothing twice.
    ///
    /// A question that took long last time is preceded by its draft until one of them is answered: the
    /// picture follows the keys first and refines then. What the error of the motion is measured against
    /// comes last of all.
    #[must_use]
    pub fn wants(&self) -> Vec<Request> {
        let needed: BTreeSet<(Slot, usize)> = self
            .on_show()
            .flat_map(|plot| self.needs(plot).into_iter().map(move |slot| (slot, plot)))
            .collect();
        let mut wanted = Vec::new();
        if matches!(self.overlay, Some(Overlay::List(Listed::Paper, _))) {
            wanted.push(Request::Claims);
        }
        for request in needed.into_iter().filter_map(|(slot, plot)| self.request(slot, plot)) {
            if !wanted.contains(&request) {
                wanted.push(request);
            }
        }
        let drafts: Vec<Request> =
            wanted.iter().filter_map(|request| self.draft(request)).collect();
        let last = self.measures().then(|| self.request(Slot::Reference, self.plot)).flatten();
        drafts.into_iter().chain(wanted).chain(last).chain(self.scan_request()).collect()
    }

    /// The draft of a question, if it is worth having first.
    fn draft(&self, request: &Request) -> Option<Request> {
        let long = self.effort.burdens.get(&request.slot()).is_some_and(|cost| *cost > LONG);
        let open = || self.is_open(request);
        request.draft().filter(|draft| long && open() && self.is_open(draft))
    }

    /// Whether the error of the motion on show is to be measured: while the user rests on the dial or the
    /// method, or has just turned them.
    #[must_use]
    pub fn measures(&self) -> bool {
        let rests = self.focus == Pane::Parameters
            && self.overlay.is_none()
            && matches!(self.selected, Row::Method | Row::Tolerance);
        (rests || self.effort.measuring) && self.shows(Layer::Trajectory) && !self.draws_whole()
    }

    /// The kinds of answers that the layers of a plot draw.
    #[must_use]
    pub fn needs(&self, plot: usize) -> BTreeSet<Slot> {
        let shown = |layer: &&Layer| self.shows_in(**layer, plot);
        let needed = self.layers.iter().filter(shown).filter_map(|layer| layer.spec().needs);
        needed.map(|slot| self.slot_in(slot, plot)).collect()
    }

    /// The question of a kind, with exactly the inputs that its answer depends on. The plot matters to
    /// those that are its own.
    ///
    /// `None` where there is nothing to ask: no bands without friction, no branch where the window of the
    /// diagram lies outside the range of its parameter, none of the own questions of another view.
    #[must_use]
    pub fn request(&self, slot: Slot, plot: usize) -> Option<Request> {
        match slot.of_one() {
            Some(one) => self.request_for_each(slot, one, plot),
            None => self.request_for(slot, plot, self.problem),
        }
    }

    /// The same for another motion than the present one.
    pub(in crate::session) fn request_for(
        &self,
        slot: Slot,
        plot: usize,
        problem: Problem,
    ) -> Option<Request> {
        let Problem { parameters, tolerance, initial, .. } = problem;
        let own = |view: View| self.plots.get(plot).filter(|plot| plot.view == view);
        Some(match slot {
            Slot::Claims => Request::Claims,
            Slot::Fit => Request::Fit { recording: self.scene.recording.clone()? },
            Slot::Trajectory => match self.machine().filter(|_| self.draws_whole()) {
                Some(belt) => Request::Machine { belt: Arc::new(belt), problem },
                None => Request::Trajectory(problem),
            },
            Slot::Scan => return self.scan_request(),
            Slot::Cycles => match self.machine() {
                // The error of the expansion is told beside it.
                Some(belt) => {
                    let cubic = !self.draws_whole();
                    Request::Portrait { belt: Arc::new(belt), parameters, cubic }
                }
                None => Request::Cycles { parameters },
            },
            Slot::Balance => Request::Balance { parameters, harmonics: self.harmonics },
            Slot::Trade => {
                let Problem { initial, until, .. } = self.problem;
                Request::Trade { parameters, initial, until }
            }
            Slot::Reference => {
                let Problem { initial, until, .. } = self.problem;
                Request::Reference { parameters, initial, until }
            }
            Slot::Capture if parameters.r == 0.0 => return None,
            Slot::Capture => {
                let reach = reach(own(View::Phase)?.window);
                Request::Capture { parameters, reach, most: MOST_BANDS }
            }
            Slot::Branch => {
                let plot = own(View::Diagram)?;
                let parameter = plot.axes.abscissa;
                let spec = parameter.spec();
                let range = plot.window.x.within(spec.min, spec.max)?;
                let mut others = parameters;
                parameter.set(&mut others, &mut { initial }, 0.0);
                Request::Branch {
                    parameters: others,
                    parameter,
                    range: (range.from(), range.to()),
                    tolerance,
                }
            }
            Slot::Speeds => {
                let plot = own(View::Speeds)?;
                let spec = Quantity::BeltSpeed.spec();
                let range = plot.window.x.within(spec.min, spec.max)?;
                let belt = Arc::new(Belt { belt_speed: 1.0, ..self.machine()? });
                Request::Speeds { belt, range: (range.from(), range.to()), count: SPEEDS }
            }
            Slot::ReturnMap => {
                // As long as the window is not known there is nothing to ask.
                let plot = own(View::ReturnMap)?;
                let range = (plot.framing != Framing::Fitting).then_some(plot.window.x)?;
                Request::ReturnMap { parameters, range: (range.from(), range.to()) }
            }
            Slot::Regimes => {
                let plot = own(View::Regimes)?;
                let Axes { abscissa, against, .. } = plot.axes;
                let within = |symbol: Symbol, span: Span| {
                    let spec = symbol.spec();
                    span.within(spec.min, spec.max).map(|span| (span.from(), span.to()))
                };
                let plane = Plane {
                    right: abscissa,
                    up: against,
                    right_range: within(abscissa, plot.window.x)?,
                    up_range: within(against, plot.window.y)?,
                };
                let mut others = parameters;
                for symbol in [abscissa, against] {
                    symbol.set(&mut others, &mut { self.problem.initial }, 0.0);
                }
                Request::Regimes { parameters: others, plane, rough: false }
            }
            Slot::VariantMotions | Slot::VariantCycles | Slot::VariantBranches => return None,
        })
    }

    /// The last good answer of a kind with its question, as a plot has it; stale or not.
    #[must_use]
    pub fn answered(&self, slot: Slot, plot: usize) -> Option<&Arc<Answered>> {
        if slot.is_own() {
            self.plots.get(plot)?.answers.get(&slot)
        } else {
            self.answers.get(&slot)
        }
    }

    /// The last good answer of a kind, as a plot has it; stale or not.
    #[must_use]
    pub fn answer(&self, slot: Slot, plot: usize) -> Option<&Answer> {
        let found = self.answered(slot, plot)?.result.as_ref().ok()?;
        Some(if let Answer::Whole(whole) = found { &whole.drawn } else { found })
    }

    /// Whether what a plot has of a kind is not the answer to today's question.
    #[must_use]
    pub fn is_stale(&self, slot: Slot, plot: usize) -> bool {
        self.answered(slot, plot).map(|held| &held.request) != self.request(slot, plot).as_ref()
    }

    /// Whether what a plot has of a kind is the draft of the answer to today's question.
    #[must_use]
    pub fn has_draft(&self, slot: Slot, plot: usize) -> bool {
        let draft = self.request(slot, plot).and_then(|request| request.draft());
        draft.is_some() && self.answered(slot, plot).map(|held| &held.request) == draft.as_ref()
    }

    /// Whether this is asked, and every plot that asks it has a draft of its answer to show meanwhile.
    #[must_use]
    pub fn is_refinement(&self, request: &Request) -> bool {
        let slot = request.slot();
        let plots = 0..self.plots.len();
        let mut asking = plots
            .filter(|plot| self.request(slot, *plot).as_ref() == Some(request))
            .map(|plot| self.has_draft(slot, plot))
            .peekable();
        asking.peek().is_some() && asking.all(|drafted| drafted)
    }

    /// Whether a question has neither an answer nor a reason for having none.
    #[must_use]
    pub fn is_open(&self, request: &Request) -> bool {
        let slot = request.slot();
        if slot == Slot::Scan {
            return self.scan_request().as_ref() == Some(request);
        }
        let answered =
            |plot| self.answered(slot, plot).is_some_and(|held| held.request == *request);
        let failed = self.failures.iter().any(|(failed, _)| failed == request);
        !failed && !(0..self.plots.len()).any(answered)
    }

    /// Whether something on show is still to be computed.
    #[must_use]
    pub fn is_busy(&self) -> bool {
        self.wants().iter().any(|request| self.is_open(request))
    }

    /// Why today's question of a kind has no answer.
    #[must_use]
    pub fn failure(&self, slot: Slot, plot: usize) -> Option<&Failure> {
        let wanted = self.request(slot, plot)?;
        self.failures.iter().find(|(request, _)| *request == wanted).map(|(_, why)| why)
    }

    /// The last motion computed, stale or not.
    #[must_use]
    pub fn trajectory(&self) -> Option<&Trajectory> {
        match self.answer(Slot::Trajectory, self.plot)? {
            Answer::Trajectory(found) => Some(found),
            _ => None,
        }
    }

    /// The fit of the record on show; `None` until it is found.
    #[must_use]
    pub fn fitted(&self) -> Option<&Fitted> {
        match self.answer(Slot::Fit, self.plot)? {
            Answer::Fit(fit) if !self.is_stale(Slot::Fit, self.plot) => fit.found().ok(),
            _ => None,
        }
    }

    /// The last cycles computed, stale or not.
    #[must_use]
    pub fn cycles(&self) -> Option<&Cycles> {
        match self.answer(Slot::Cycles, self.plot)? {
            Answer::Cycles(found) => Some(found),
            _ => None,
        }
    }

    /// The last harmonic balance computed, stale or not.
    #[must_use]
    pub fn balance(&self) -> Option<&HarmonicBalance> {
        match self.answer(Slot::Balance, self.plot)? {
            Answer::Balance(found) => Some(found),
            _ => None,
        }
    }

    /// The error of the motion on show, and what it was measured against, where both are known.
    ///
    /// `None` until both are computed, and where there is no error: [`Session::unmeasured`] says why.
    #[must_use]
    pub fn measured(&self) -> Option<(Deviation, &Reference)> {
        self.comparison()?.ok()
    }

    /// Why the motion on show has no measured error; `None` as long as it may have one.
    #[must_use]
    pub fn unmeasured(&self) -> Option<Unmeasured> {
        self.comparison()?.err()
    }

    /// The motion on show against its reference; `None` until both are computed.
    fn comparison(&self) -> Option<Result<(Deviation, &Reference), Unmeasured>> {
        let stale = |slot| self.is_stale(slot, self.plot);
        if !self.measures() || stale(Slot::Reference) {
            return None;
        }
        let Answer::Reference(reference) = self.answer(Slot::Reference, self.plot)? else {
            return None;
        };
        let Ok(reference) = reference else { return Some(Err(Unmeasured::TighterGaveUp)) };
        let motion = self.trajectory().filter(|_| !stale(Slot::Trajectory))?;
        Some(match reference.compare(motion) {
            Ok(deviation) => Ok((deviation, reference)),
            Err(NoComparison::GaveUp(_)) => Err(Unmeasured::GaveUp),
            Err(NoComparison::OtherFate) => Err(Unmeasured::OtherFate),
        })
    }

    /// The last borders of capture bands computed for a phase plane, stale or not.
    #[must_use]
    pub fn borders(&self, plot: usize) -> Option<&Borders> {
        match self.answer(Slot::Capture, plot)? {
            Answer::Capture(found) => Some(found),
            _ => None,
        }
    }

    /// The claims of the paper, examined; none until they are.
    #[must_use]
    pub fn examined(&self) -> &[Examined] {
        match self.answer(Slot::Claims, self.plot) {
            Some(Answer::Claims(examined)) => examined,
            _ => &[],
        }
    }

    /// The last chart computed over the two parameters of a plot, stale or not.
    #[must_use]
    pub fn chart(&self, plot: usize) -> Option<&Chart> {
        let Axes { abscissa, against, .. } = self.plots.get(plot)?.axes;
        match self.answer(Slot::Regimes, plot)? {
            Answer::Regimes(found)
                if (found.plane.right, found.plane.up) == (abscissa, against) =>
            {
                Some(found)
            }
            _ => None,
        }
    }

    /// The last return map computed for a plot, stale or not.
    #[must_use]
    pub fn return_map(&self, plot: usize) -> Option<&ReturnMap> {
        match self.answer(Slot::ReturnMap, plot)? {
            Answer::ReturnMap(found) => Some(found),
            _ => None,
        }
    }
}

/// How far out bands of capture can be seen, rounded up to a power of two: small changes of the window
/// ask nothing new.
fn reach(Window { x, y }: Window) -> f64 {
    let farthest = |span: Span| span.from().abs().max(span.to().abs());
    exp2(log2(hypot(farthest(x), farthest(y))).ceil())
}
