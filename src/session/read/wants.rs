//! What a session asks, and what it has been answered.
//!
//! A plot shows a list of problems, mostly the present one alone. What its layers need of each is a
//! question of its own, and a pure function of the state. Answers are kept by their questions
//! ([`crate::session::state::answers`]): equal questions are one, whoever asks them.

use std::collections::BTreeSet;
use std::sync::Arc;

use crate::flow::Problem;
use crate::numerics::elementary::{exp2, hypot, log2};
use crate::oscillator::belt::Quantity;
use crate::oscillator::{Belt, Parameters, Symbol};
use crate::proof::Proof;
use crate::question;
use crate::question::{Failure, Motion};
use crate::scene::{Answer, Axes, Layer, Request, Span, TOPICS, Topic, View, Window};
use crate::session::state::answers::Standing;
use crate::session::state::overlay::{Listed, Overlay};
use crate::session::state::plot::{Framing, Pane};
use crate::session::state::rows::Row;
use crate::session::state::session::Session;
use crate::study::accuracy::{Deviation, NoComparison, Reference};
use crate::study::chart::{Chart, Plane};
use crate::study::claims::Examined;

/// Evaluations beyond which the answers about a topic may take longer than a quarter of a frame: the next
/// questions about it are answered by drafts first.
const LONG: u64 = 100_000;

/// What is drawn of the point left for a mark.
pub(in crate::session) const COMPARED: [Topic; 2] = [Topic::Trajectory, Topic::Cycles];

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
    /// Questions that took long last time are preceded by their drafts until these are answered: the
    /// picture follows the keys first and refines then. What the error of the motion is measured against
    /// comes last of all.
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

    /// The same without drafts. What a press waits for comes first, whether a layer asks it or not.
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
            .chain(claims.then_some(Request::Claims(question::claims::Asked)))
            .chain(each.map(|each| each.1));
        let mut asked = Vec::new();
        let proof = || self.request(Topic::Proof, self.plot);
        let proof = needed.iter().any(|(topic, _)| *topic == Topic::Cycles).then(proof).flatten();
        let spread = self.on_show().any(|plot| self.plots[plot].view == View::Spread);
        let drawn = spread.then(|| self.refit_request(true)).flatten();
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

    /// The questions whose answers are drawn of the point left for a mark.
    pub(in crate::session) fn compared(&self) -> impl Iterator<Item = &Request> {
        let left = self.marks.left.iter().filter(|_| self.shows(Layer::Ghost));
        left.flat_map(|left| &left.asked)
    }

    /// What is known of the point left for a mark.
    pub fn answers_left(&self) -> impl Iterator<Item = &Answer> {
        self.compared().filter_map(|request| match self.answers.standing(request) {
            Standing::Fresh(found) => found.result.as_ref().ok(),
            _ => None,
        })
    }

    /// Whether the error of the motion on show is to be measured: while the user rests on the dial or the
    /// method, or has just turned them.
    pub fn measures(&self) -> bool {
        let rests = self.focus == Pane::Parameters
            && self.overlay.is_none()
            && matches!(self.selected, Row::Method | Row::Tolerance);
        (rests || self.measuring) && self.shows(Layer::Trajectory) && !self.draws_whole()
    }

    /// What the layers of a plot draw answers about.
    pub fn needs(&self, plot: usize) -> BTreeSet<Topic> {
        let shown = |layer: &&Layer| self.shows_in(**layer, plot);
        let needed = self.layers.iter().filter(shown).filter_map(|layer| layer.spec().needs);
        needed.chain(self.tells_certain(plot).then_some(Topic::Zones)).collect()
    }

    /// The question about this topic for each problem that a plot shows, with its place among these.
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

    /// The question about this topic for the present problem, with exactly the inputs that its answer
    /// depends on. The plot matters where it does to the answer.
    ///
    /// `None` where there is nothing to ask: no bands without friction, no branch where the window of the
    /// diagram lies outside the range of its parameter, nothing that only another view asks.
    pub fn request(&self, topic: Topic, plot: usize) -> Option<Request> {
        self.request_for(topic, plot, self.problem)
    }

    /// The same for another motion than the present one.
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
            Topic::Claims => Request::Claims(question::claims::Asked),
            Topic::Fit => {
                Request::Fit(question::fit::Asked { recording: self.scene.recording.clone()? })
            }
            Topic::Refit => self.refit_request(false)?,
            Topic::Trajectory => match self.machine().filter(|_| self.draws_whole()) {
                Some(belt) => {
                    Request::Machine(question::machine::Asked { belt: Arc::new(belt), problem })
                }
                None => Request::Trajectory(problem),
            },
            Topic::Scan => return self.scan_request(),
            Topic::Cycles => match self.machine() {
                // The error of the expansion is told beside it.
                Some(belt) => {
                    let cubic = !self.draws_whole();
                    Request::Portrait(question::portrait::Asked {
                        belt: Arc::new(belt),
                        parameters,
                        cubic,
                    })
                }
                None => Request::Cycles(question::cycles::Asked { parameters }),
            },
            Topic::Balance => {
                Request::Balance(question::balance::Asked { parameters, harmonics: self.harmonics })
            }
            Topic::Trade => Request::Trade(question::trade::Asked(motion())),
            Topic::Reference => Request::Reference(question::reference::Asked(motion())),
            // Of the whole model of a machine nothing is proved, and its basin is not a graph to integrate over.
            Topic::Proof | Topic::Kicks if self.draws_whole() => return None,
            Topic::Proof => Request::Proof(question::proof::Asked { parameters }),
            Topic::Zones => self.zones_request(&parameters)?,
            Topic::Kicks => {
                Request::Kicks(question::kicks::Asked { parameters, kicks: self.kicks })
            }
            Topic::Capture if parameters.r == 0.0 => return None,
            Topic::Capture => {
                let reach = reach(own(View::Phase)?.window);
                Request::Capture(question::capture::Asked { parameters, reach, most: MOST_BANDS })
            }
            Topic::Branch => {
                let plot = own(View::Diagram)?;
                let parameter = plot.axes.abscissa;
                let spec = parameter.spec();
                let range = plot.window.x.within(spec.min, spec.max)?;
                let mut others = parameters;
                parameter.set(&mut others, &mut { initial }, 0.0);
                Request::Branch(question::branch::Asked {
                    parameters: others,
                    parameter,
                    range: (range.from(), range.to()),
                    tolerance,
                })
            }
            Topic::Speeds => {
                let plot = own(View::Speeds)?;
                let spec = Quantity::BeltSpeed.spec();
                let range = plot.window.x.within(spec.min, spec.max)?;
                let belt = Arc::new(Belt { belt_speed: 1.0, ..self.machine()? });
                Request::Speeds(question::speeds::Asked {
                    belt,
                    range: (range.from(), range.to()),
                    rough: false,
                })
            }
            Topic::ReturnMap => {
                // As long as the window is not known there is nothing to ask.
                let plot = own(View::ReturnMap)?;
                let range = (plot.framing != Framing::Fitting).then_some(plot.window.x)?;
                Request::ReturnMap(question::return_map::Asked {
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
        Some(Request::Regimes(question::regimes::Asked { parameters: others, plane, rough: false }))
    }

    /// How far the answer about this topic is for the present problem, as a plot asks it.
    pub fn standing(&self, topic: Topic, plot: usize) -> Standing<'_> {
        let request = self.request(topic, plot);
        request.map_or(Standing::None, |request| self.answers.standing(&request))
    }

    /// The answer about this topic for the present problem, as a plot asks it; stale or not.
    pub fn answer(&self, topic: Topic, plot: usize) -> Option<&Answer> {
        self.standing(topic, plot).answer()
    }

    /// Whether the answer about this topic is missing for the present problem.
    pub fn is_stale(&self, topic: Topic, plot: usize) -> bool {
        !self.standing(topic, plot).is_fresh()
    }

    /// Whether the answer about this topic is there for every problem that a plot shows.
    pub fn is_fresh(&self, topic: Topic, plot: usize) -> bool {
        let mut asked = self.requests(topic, plot).into_iter();
        asked.all(|(_, request)| self.answers.standing(&request).is_fresh())
    }

    /// Whether there is a draft of the answer to this to show meanwhile.
    pub fn is_refinement(&self, request: &Request) -> bool {
        matches!(self.answers.standing(request), Standing::Draft(_))
    }

    /// Whether a question has neither an answer nor a reason for having none.
    pub fn is_open(&self, request: &Request) -> bool {
        if request.topic() == Topic::Scan {
            return self.scan_request().as_ref() == Some(request);
        }
        self.answers.is_open(request)
    }

    /// Whether something on show is still to be computed.
    pub fn is_busy(&self) -> bool {
        self.wants().iter().any(|request| self.is_open(request))
    }

    /// Why there is no answer about this topic for the present problem.
    pub fn failure(&self, topic: Topic, plot: usize) -> Option<&Failure> {
        self.answers.failure(&self.request(topic, plot)?)
    }

    /// The error of the motion on show, and what it was measured against, where both are known.
    ///
    /// `None` until both are computed, and where there is no error: [`Session::unmeasured`] says why.
    pub fn measured(&self) -> Option<(Deviation, &Reference)> {
        self.comparison()?.ok()
    }

    /// Why the motion on show has no measured error; `None` as long as it may have one.
    pub fn unmeasured(&self) -> Option<Unmeasured> {
        self.comparison()?.err()
    }

    /// The motion on show against its reference; `None` until both are computed.
    fn comparison(&self) -> Option<Result<(Deviation, &Reference), Unmeasured>> {
        let stale = |topic| self.is_stale(topic, self.plot);
        if !self.measures() || stale(Topic::Reference) {
            return None;
        }
        let Answer::Reference(reference) = self.answer(Topic::Reference, self.plot)? else {
            return None;
        };
        let Ok(reference) = reference else { return Some(Err(Unmeasured::TighterGaveUp)) };
        let motion = self.trajectory().filter(|_| !stale(Topic::Trajectory))?;
        Some(match reference.compare(motion) {
            Ok(deviation) => Ok((deviation, reference)),
            Err(NoComparison::GaveUp(_)) => Err(Unmeasured::GaveUp),
            Err(NoComparison::OtherFate) => Err(Unmeasured::OtherFate),
        })
    }

    /// What is proved about the cycles at the present parameters; `None` until it is.
    pub fn proof(&self) -> Option<&Proof> {
        let Answer::Proof(found) = self.answer(Topic::Proof, self.plot)? else { return None };
        Some(found).filter(|_| !self.is_stale(Topic::Proof, self.plot))
    }

    /// The claims of the paper, examined; none until they are.
    pub fn examined(&self) -> &[Examined] {
        match self.answer(Topic::Claims, self.plot) {
            Some(Answer::Claims(examined)) => examined,
            _ => &[],
        }
    }

    /// The last chart computed over the two parameters of a plot, stale or not.
    pub fn chart(&self, plot: usize) -> Option<&Chart> {
        let Axes { abscissa, against, .. } = self.plots.get(plot)?.axes;
        let Answer::Regimes(found) = self.answer(Topic::Regimes, plot)? else { return None };
        Some(found).filter(|found| (found.plane.right, found.plane.up) == (abscissa, against))
    }
}

/// How far out bands of capture can be seen, rounded up to a power of two: small changes of the window
/// ask nothing new.
fn reach(Window { x, y }: Window) -> f64 {
    let farthest = |span: Span| span.from().abs().max(span.to().abs());
    exp2(log2(hypot(farthest(x), farthest(y))).ceil())
}
