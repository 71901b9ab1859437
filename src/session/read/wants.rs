//! The questions of a session, and the state of their answers.
//!
//! A plot shows a list of problems, usually only the present one. Each layer asks a separate question about
//! each problem, which is a pure function of the state. Answers are stored by their questions
//! ([`crate::session::state::answers`]): equal questions are one question, whoever asks.

use std::collections::BTreeSet;
use std::sync::Arc;

use crate::accuracy::reference::{Deviation, NoComparison, Reference};
use crate::branch::chart::{Chart, Plane};
use crate::flow::Problem;
use crate::model::{Belt, Knob, Parameters};
use crate::numerics::elementary::{exp2, hypot, log2};
use crate::paper::ClaimResult;
use crate::proof::Proof;
use crate::question;
use crate::question::{Motion, NoAnswer};
use crate::scene::{Answer, Axes, Layer, Request, Span, TOPICS, Topic, View, Window};
use crate::session::state::{AnswerState, Framing, Listed, Overlay, Pane, Row, Session};

/// Number of evaluations above which answers on a topic may take longer than a quarter of a frame: further
/// questions on it are first answered by drafts.
const LONG: u64 = 100_000;

/// The topics that are drawn of the point that was left for a mark.
pub(in crate::session) const COMPARED: [Topic; 2] = [Topic::Trajectory, Topic::Cycles];

/// Maximum number of bands of capture that are drawn: more would fill the plane.
const MOST_BANDS: usize = 24;

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

impl Session {
    /// The questions for what is on show, the most urgent first; none for a layer that is off, and none twice.
    ///
    /// Questions that took long last time are preceded by their drafts until these are answered: the picture
    /// follows the keys first and is refined then. The reference for the error of the motion comes last.
    pub fn wants(&self) -> Vec<Request> {
        let asked = self.asks();
        let cost = |topic: Topic| -> u64 {
            let alike = asked.iter().filter(|request| request.topic() == topic);
            alike.map(|request| self.answers.cost(request)).sum()
        };
        let long: BTreeSet<Topic> =
            TOPICS.iter().copied().filter(|topic| cost(*topic) > LONG).collect();
        let open = |request: &&Request| long.contains(&request.topic()) && self.is_open(request);
        let drafts = asked.iter().filter(open).filter_map(Request::draft);
        let mut wanted: Vec<Request> = drafts.filter(|draft| self.is_open(draft)).collect();
        wanted.extend(asked);
        wanted
    }

    /// The questions without drafts. The one that a press waits for comes first, whether a layer asks it or
    /// not.
    pub fn asks(&self) -> Vec<Request> {
        let needed: BTreeSet<(Topic, usize)> = self
            .on_show()
            .flat_map(|plot| self.needs(plot).into_iter().map(move |topic| (topic, plot)))
            .collect();
        let claims = matches!(self.overlay, Some(Overlay::List(Listed::Paper, _)));
        let each = needed.iter().flat_map(|(topic, plot)| self.requests(*topic, *plot));
        let last = self.measures().then(|| self.request(Topic::Reference, self.plot)).flatten();
        let awaited = self.waiting.iter().map(|waiting| waiting.request.clone());
        let all = awaited
            .chain(self.refit_request(false))
            .chain(claims.then_some(Request::Claims(question::claims::Inputs)))
            .chain(each.map(|each| each.1));
        let mut asked = Vec::new();
        let proof = || self.request(Topic::Proof, self.plot);
        let proof = needed.iter().any(|(topic, _)| *topic == Topic::Cycles).then(proof).flatten();
        // The distribution of the margin is drawn, and the second status line tells of it.
        let spread = self.on_show().any(|plot| self.plots[plot].view == View::Spread);
        let told = self.size.tells_margin() && !self.measures();
        let drawn = (spread || told).then(|| self.refit_request(true)).flatten();
        for request in all.chain(last).chain(proof).chain(drawn).chain(self.scan_request()) {
            if !asked.contains(&request) {
                asked.push(request);
            }
        }
        asked
    }

    /// The questions of one plot.
    pub fn asked_by(&self, plot: usize) -> Vec<Request> {
        let needed = self.needs(plot).into_iter();
        needed.flat_map(|topic| self.requests(topic, plot)).map(|(_, request)| request).collect()
    }

    /// The questions whose answers are drawn for the point that was left.
    pub(in crate::session) fn compared(&self) -> impl Iterator<Item = &Request> {
        let left = self.marks.left.iter().filter(|_| self.shows(Layer::Ghost));
        left.flat_map(|left| &left.asked)
    }

    /// The answers for the point that was left.
    pub fn answers_left(&self) -> impl Iterator<Item = &Answer> {
        self.compared().filter_map(|request| match self.answers.standing(request) {
            AnswerState::Fresh(found) => found.result.as_ref().ok(),
            _ => None,
        })
    }

    /// Whether to measure the error of the motion on show: the row of the accuracy or of the method is
    /// selected, or the last key changed one of them.
    pub fn measures(&self) -> bool {
        let rests = self.focus == Pane::Parameters
            && self.overlay.is_none()
            && matches!(self.selected, Row::Method | Row::Tolerance);
        (rests || self.measuring) && self.shows(Layer::Trajectory) && !self.draws_whole()
    }

    /// The topics whose answers the layers of a plot draw.
    pub fn needs(&self, plot: usize) -> BTreeSet<Topic> {
        let shown = |layer: &&Layer| self.shows_in(**layer, plot);
        let needed = self.layers.iter().filter(shown).filter_map(|layer| layer.spec().needs);
        needed.chain(self.tells_certain(plot).then_some(Topic::Zones)).collect()
    }

    /// The questions on this topic for each problem that a plot shows, with its index among these.
    pub fn requests(&self, topic: Topic, plot: usize) -> Vec<(usize, Request)> {
        let problems = match self.variants(plot).filter(|_| topic.is_of_variants()) {
            Some(variants) => variants.iter().map(|variant| variant.of(self.problem)).collect(),
            None if topic == Topic::Trajectory => self.problems(),
            None => vec![self.problem],
        };
        let request = |problem| self.request_for(topic, plot, problem);
        let each = problems.into_iter().map(request).enumerate();
        each.filter_map(|(index, request)| Some((index, request?))).collect()
    }

    /// The question on this topic for the present problem, with exactly the inputs on which its answer depends.
    /// The plot is one of them if the answer depends on its window or axes.
    ///
    /// `None` if there is nothing to ask: no bands without friction, no branch if the window of the diagram
    /// lies outside the range of its parameter, and nothing that only another view asks.
    pub fn request(&self, topic: Topic, plot: usize) -> Option<Request> {
        self.request_for(topic, plot, self.problem)
    }

    /// The question for another motion than the present one.
    pub(in crate::session) fn request_for(
        &self,
        topic: Topic,
        plot: usize,
        problem: Problem,
    ) -> Option<Request> {
        let Problem { parameters, tolerance, initial, .. } = problem;
        let own = |view: View| self.plots.get(plot).filter(|plot| plot.view == view);
        let motion = || {
            let Problem { initial, until, .. } = self.problem;
            Motion { parameters, initial, until }
        };
        Some(match topic {
            Topic::Claims => Request::Claims(question::claims::Inputs),
            Topic::Fit => {
                Request::Fit(question::fit::Inputs { recording: self.scene.recording.clone()? })
            }
            Topic::Refit => self.refit_request(false)?,
            Topic::Trajectory => match self.machine().filter(|_| self.draws_whole()) {
                Some(belt) => {
                    Request::Machine(question::machine::Inputs { belt: Arc::new(belt), problem })
                }
                None => Request::Trajectory(problem),
            },
            Topic::Scan => return self.scan_request(),
            Topic::Cycles => match self.machine() {
                // The error of the expansion is stated beside it.
                Some(belt) => {
                    let cubic = !self.draws_whole();
                    Request::Portrait(question::portrait::Inputs {
                        belt: Arc::new(belt),
                        parameters,
                        cubic,
                    })
                }
                None => Request::Cycles(question::cycles::Inputs { parameters }),
            },
            Topic::Balance => Request::Balance(question::balance::Inputs {
                parameters,
                harmonics: self.harmonics,
            }),
            Topic::Trade => Request::Trade(question::trade::Inputs(motion())),
            Topic::Reference => Request::Reference(question::reference::Inputs(motion())),
            // The whole model of a machine has no proof, and its basin is no graph over which kicks could be
            // integrated.
            Topic::Proof | Topic::Kicks if self.draws_whole() => return None,
            Topic::Proof => Request::Proof(question::proof::Inputs { parameters }),
            Topic::Zones => self.zones_request(&parameters)?,
            Topic::Kicks => {
                Request::Kicks(question::kicks::Inputs { parameters, kicks: self.kicks })
            }
            Topic::Capture if parameters.r == 0.0 => return None,
            Topic::Capture => {
                let reach = reach(own(View::Phase)?.window);
                Request::Capture(question::capture::Inputs { parameters, reach, most: MOST_BANDS })
            }
            Topic::Branch => {
                let plot = own(View::Diagram)?;
                let parameter = plot.axes.abscissa;
                let spec = parameter.spec();
                let range = plot.window.x.within(spec.min, spec.max)?;
                let mut others = parameters;
                parameter.set(&mut others, &mut { initial }, 0.0);
                Request::Branch(question::branch::Inputs {
                    parameters: others,
                    parameter,
                    range: (range.from(), range.to()),
                    tolerance,
                })
            }
            Topic::Speeds => {
                let plot = own(View::Speeds)?;
                let spec = Knob::BeltSpeed.spec();
                let range = plot.window.x.within(spec.min, spec.max)?;
                let belt = Arc::new(Belt { belt_speed: 1.0, ..self.machine()? });
                Request::Speeds(question::speeds::Inputs {
                    belt,
                    range: (range.from(), range.to()),
                    rough: false,
                })
            }
            Topic::ReturnMap => {
                // Until the window is known, there is nothing to ask.
                let plot = own(View::ReturnMap)?;
                let range = (plot.framing != Framing::Fitting).then_some(plot.window.x)?;
                Request::ReturnMap(question::return_map::Inputs {
                    parameters,
                    range: (range.from(), range.to()),
                })
            }
            Topic::Regimes => self.regimes_request(plot, parameters)?,
        })
    }

    fn regimes_request(&self, plot: usize, parameters: Parameters) -> Option<Request> {
        let plot = self.plots.get(plot).filter(|plot| plot.view == View::Regimes)?;
        let Axes { abscissa, against, .. } = plot.axes;
        let within = |symbol: Knob, span: Span| {
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
        Some(Request::Regimes(question::regimes::Inputs {
            parameters: others,
            plane,
            rough: false,
        }))
    }

    /// The state of the answer on this topic for the present problem, as a plot asks it.
    pub fn standing(&self, topic: Topic, plot: usize) -> AnswerState<'_> {
        let request = self.request(topic, plot);
        request.map_or(AnswerState::None, |request| self.answers.standing(&request))
    }

    /// The answer on this topic for the present problem, as a plot asks it, stale or not.
    pub fn answer(&self, topic: Topic, plot: usize) -> Option<&Answer> {
        self.standing(topic, plot).answer()
    }

    /// Whether the answer on this topic is missing for the present problem.
    pub fn is_stale(&self, topic: Topic, plot: usize) -> bool {
        !self.standing(topic, plot).is_fresh()
    }

    /// Whether there are answers on this topic for all problems that a plot shows.
    pub fn is_fresh(&self, topic: Topic, plot: usize) -> bool {
        let mut asked = self.requests(topic, plot).into_iter();
        asked.all(|(_, request)| self.answers.standing(&request).is_fresh())
    }

    /// Whether the answer to the draft of this question is there to be shown meanwhile.
    pub fn is_refinement(&self, request: &Request) -> bool {
        matches!(self.answers.standing(request), AnswerState::Draft(_))
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

    /// The error of the motion on show, and its reference.
    ///
    /// `None` until both are computed, and if there is no error: [`Session::unmeasured`] then says why.
    pub fn measured(&self) -> Option<(Deviation, &Reference)> {
        self.comparison()?.ok()
    }

    /// Why the motion on show has no measured error; `None` while it may still get one.
    pub fn unmeasured(&self) -> Option<NoErrorReason> {
        self.comparison()?.err()
    }

    /// The comparison of the motion on show with its reference; `None` until both are computed.
    fn comparison(&self) -> Option<Result<(Deviation, &Reference), NoErrorReason>> {
        let stale = |topic| self.is_stale(topic, self.plot);
        if !self.measures() || stale(Topic::Reference) {
            return None;
        }
        let Answer::Reference(reference) = self.answer(Topic::Reference, self.plot)? else {
            return None;
        };
        let Ok(reference) = reference else { return Some(Err(NoErrorReason::TighterGaveUp)) };
        let motion = self.trajectory().filter(|_| !stale(Topic::Trajectory))?;
        Some(match reference.compare(motion) {
            Ok(deviation) => Ok((deviation, reference)),
            Err(NoComparison::GaveUp(_)) => Err(NoErrorReason::GaveUp),
            Err(NoComparison::OtherFate) => Err(NoErrorReason::OtherFate),
        })
    }

    /// The proof about the cycles at the present parameters; `None` until it is there.
    pub fn proof(&self) -> Option<&Proof> {
        let Answer::Proof(found) = self.answer(Topic::Proof, self.plot)? else { return None };
        Some(found).filter(|_| !self.is_stale(Topic::Proof, self.plot))
    }

    /// The examined claims of the paper; empty until they are there.
    pub fn examined(&self) -> &[ClaimResult] {
        match self.answer(Topic::Claims, self.plot) {
            Some(Answer::Claims(examined)) => examined,
            _ => &[],
        }
    }

    /// The chart computed last over the two parameters of a plot, stale or not.
    pub fn chart(&self, plot: usize) -> Option<&Chart> {
        let Axes { abscissa, against, .. } = self.plots.get(plot)?.axes;
        let Answer::Regimes(found) = self.answer(Topic::Regimes, plot)? else { return None };
        Some(found).filter(|found| (found.plane.right, found.plane.up) == (abscissa, against))
    }
}

/// The distance up to which bands of capture are visible, rounded up to a power of two, so that small changes
/// of the window ask no new question.
fn reach(Window { x, y }: Window) -> f64 {
    let farthest = |span: Span| span.from().abs().max(span.to().abs());
    exp2(log2(hypot(farthest(x), farthest(y))).ceil())
}
