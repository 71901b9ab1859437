//! The questions of a session: those that its layers ask, and which of them must be asked again after a step.
//!
//! A plot shows a list of problems, usually only the present one. Each layer asks a separate question about
//! each problem, which is a pure function of the state. Answers are stored by their questions
//! ([`crate::session::state::answers`]): equal questions are one question, whoever asks.

use std::collections::BTreeSet;
use std::sync::Arc;

use crate::branch::Plane;
use crate::flow::{Cost, Problem};
use crate::model::Knob;
use crate::numerics::{distinct, exp2, hypot, log2};
use crate::scene::{Layer, LayerSpec, Reply, Request, Span, TOPICS, Topic, View, Window};
use crate::session::{Framing, List, ListKind, Overlay, Pane, Plot, Row, Session};
use crate::words::{count, duration, joined};

/// Number of evaluations above which answers on a topic may take longer than a quarter of a frame: further
/// questions on it are first answered by drafts.
const LONG: u64 = 100_000;

/// Maximum number of bands of capture that are drawn: more would fill the plane.
const MOST_BANDS: usize = 24;

impl Session {
    /// The questions for what is on show, the most urgent first; none for a layer that is off, and none twice.
    ///
    /// Questions that took long last time are preceded by their drafts until these are answered: the picture
    /// follows the keys first and is refined then. The reference for the error of the motion comes last, and after it what
    /// the scene shows that is selected in the list of scenes.
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
        let previewed = self.preview.iter().flat_map(|preview| preview.wants());
        let new: Vec<Request> = previewed.filter(|request| !wanted.contains(request)).collect();
        wanted.extend(new);
        wanted
    }

    /// The questions without drafts. The one that a press waits for comes first, whether a layer asks it or
    /// not.
    pub fn asks(&self) -> Vec<Request> {
        let of_plot = |plot| self.needs(plot).into_iter().map(move |topic| (topic, plot));
        let needed: BTreeSet<(Topic, usize)> = self.on_show().flat_map(of_plot).collect();
        let each = needed.iter().flat_map(|(topic, plot)| self.requests(*topic, *plot)).flatten();
        let measures = self.measures();
        let last = measures.then(|| self.request(Topic::Reference, self.plot)).flatten();
        let awaited = self.waiting.iter().map(|waiting| waiting.request.clone());
        let claims = matches!(self.overlay, Some(Overlay::List(ListKind::Paper, _)));
        let claims = claims.then_some(Request::Claims);
        let beside = self.on_show().flat_map(|plot| self.compared(plot));
        let all = awaited.chain(self.refit_request(false)).chain(claims).chain(each).chain(beside);
        let proof = || self.request(Topic::Proof, self.plot);
        let proof = needed.iter().any(|(topic, _)| *topic == Topic::Cycles).then(proof).flatten();
        // The distribution of the margin is drawn, and the second status line tells of it.
        let spread = self.on_show().any(|plot| self.plots[plot].view == View::Spread);
        let told = self.size.tells_margin() && !measures;
        let drawn = (spread || told).then(|| self.refit_request(true)).flatten();
        distinct(all.chain(last).chain(proof).chain(drawn).chain(self.scan_request()))
    }

    /// The questions of one plot.
    pub fn asked_by(&self, plot: usize) -> Vec<Request> {
        let needed = self.needs(plot).into_iter();
        let own = needed.flat_map(|topic| self.requests(topic, plot)).flatten();
        own.chain(self.compared(plot)).collect()
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
        let zones = self.tells_certain(plot).then_some(Topic::Zones);
        let levels = (!self.levels.is_empty()).then_some(Topic::Level);
        let mut needed: BTreeSet<Topic> = needed.chain(zones).chain(levels).collect();
        // What becomes of a motion by the whole model, and of a kick that is tried, is told by its cycles.
        let told = needed.contains(&Topic::Trajectory) && (self.draws_whole() || self.kicking);
        needed.extend(told.then_some(Topic::Cycles));
        needed
    }

    /// The questions on this topic for each problem that a plot shows; none where there is nothing to ask.
    pub fn requests(&self, topic: Topic, plot: usize) -> Vec<Option<Request>> {
        if topic == Topic::Level {
            return self.levels.iter().map(|it| self.level_request(*it, plot).ok()).collect();
        }
        let problems = match self.variants(plot).filter(|_| topic.is_of_variants()) {
            Some(variants) => variants.iter().map(|variant| variant.of(self.problem)).collect(),
            None if topic == Topic::Trajectory => self.problems(),
            None => vec![self.problem],
        };
        problems.into_iter().map(|it| self.request_for(topic, plot, it)).collect()
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
    pub(crate) fn request_for(
        &self,
        topic: Topic,
        plot: usize,
        problem: Problem,
    ) -> Option<Request> {
        let Problem { parameters, tolerance, .. } = problem;
        let own = |view: View| Some(&self.plots[plot]).filter(|plot| plot.view == view);
        let motion = || {
            let Problem { initial, until, .. } = self.problem;
            Problem { parameters, initial, until, ..Problem::default() }
        };
        Some(match topic {
            Topic::Claims => Request::Claims,
            Topic::Fit => Request::Fit { recording: self.scene.recording.clone()? },
            Topic::Refit => self.refit_request(false)?,
            Topic::Trajectory => {
                let machine = self.machine().filter(|_| self.draws_whole()).map(Arc::new);
                Request::Trajectory { problem, machine }
            }
            Topic::Scan => return self.scan_request(),
            Topic::Level => return self.level_request(*self.levels.first()?, plot).ok(),
            Topic::Cycles => {
                // The error of the expansion is stated beside it.
                let machine = self.machine().map(Arc::new);
                Request::Cycles { parameters, machine, whole: self.draws_whole() }
            }
            Topic::Balance => Request::Balance { parameters, harmonics: self.harmonics },
            Topic::Trade => Request::Trade(motion()),
            Topic::Reference => Request::Reference(motion()),
            // The whole model of a machine has no proof.
            Topic::Proof if self.draws_whole() => return None,
            Topic::Proof => Request::Proof { parameters },
            Topic::Zones => {
                let (source, _) = self.source(&parameters);
                let tolerances = match source.of_belt() {
                    // None where something uncertain corresponds to no part of the machine.
                    Some(belt) => self.doubt.on_machine(self.running()?, belt).ok()?,
                    None => self.doubt.tolerances(),
                };
                Request::Zones { source: Arc::new(source), tolerances }
            }
            Topic::Kicks => {
                let (source, units) = self.source(&parameters);
                let kicks = self.kicks.in_units(1.0 / units.displacement, 1.0 / units.velocity);
                Request::Kicks { source: Arc::new(source), kicks }
            }
            Topic::Capture if parameters.r == 0.0 => return None,
            Topic::Capture => {
                let reach = reach(own(View::Phase)?.window);
                Request::Capture { parameters, reach, most: MOST_BANDS }
            }
            Topic::Branch => {
                let plot = own(View::Diagram)?;
                let parameter = plot.axes.abscissa;
                let range = within(parameter, plot.window.x)?;
                let parameters = parameters.with(parameter, 0.0);
                Request::Branch { parameters, parameter, range, tolerance }
            }
            Topic::MachineBranch => {
                let plot = own(View::BeltDiagram)?;
                let varied = plot.axes.machine;
                let range = within(varied, plot.window.x)?;
                let mut belt = self.machine()?;
                varied.set_in_belt(&mut belt, 1.0).ok()?;
                Request::MachineBranch { belt: Arc::new(belt), varied, range, rough: false }
            }
            Topic::ReturnMap => {
                // Until the window is known, there is nothing to ask.
                let plot = own(View::ReturnMap)?;
                let range = (plot.framing != Framing::Fitting).then_some(plot.window.x)?;
                Request::ReturnMap { parameters, range: range.ends().into() }
            }
            Topic::Regimes => {
                let Plot { axes, window, .. } = own(View::Regimes)?;
                let (right, up) = (axes.abscissa, axes.against);
                let (right_range, up_range) = (within(right, window.x)?, within(up, window.y)?);
                let plane = Plane { right, up, right_range, up_range };
                let parameters = parameters.with(right, 0.0).with(up, 0.0);
                Request::Regimes { parameters, plane, rough: false }
            }
        })
    }
}

/// The part of a span within the range of a number, by its ends.
pub fn within(knob: Knob, span: Span) -> Option<(f64, f64)> {
    span.allowed(knob).map(|span| span.ends().into())
}

/// The distance up to which bands of capture are visible, rounded up to a power of two, so that small changes
/// of the window ask no new question.
fn reach(Window { x, y }: Window) -> f64 {
    exp2(log2(hypot(x.farthest(), y.farthest())).ceil())
}

/// A question and the layers for which it is asked.
#[derive(Clone, Debug, PartialEq)]
pub struct Requirement {
    pub request: Request,
    /// The names of the layers that draw its answer.
    pub layers: Vec<&'static str>,
}

/// A row of the list of costs.
#[derive(Clone, Debug)]
pub struct CostRow {
    /// A question, formulas, or a row that is stepped.
    pub name: &'static str,
    /// What it took and for which layers, or what the step asks again and what stays the same.
    pub text: String,
    pub is_step: bool,
}

impl Session {
    /// What each question of the picture took, and what a step of each number asks again.
    pub fn cost_rows(&self, list: &List) -> Vec<CostRow> {
        let present = self.requirements();
        let row = |name, text| CostRow { name, text, is_step: false };
        let asked = present.iter().map(|Requirement { request, layers }| {
            let held = self.answers.standing(request).fresh().reply();
            let price = held.map_or_else(|| "not answered".to_owned(), price);
            row(request.topic().name(), format!("{price} for {}", layers.join(", ")))
        });
        let formulas = Some(self.drawn_by_formulas()).filter(|layers| !layers.is_empty());
        let formulas = formulas.map(|it| row("formulas", format!("nothing for {}", it.join(", "))));
        let is_asked = |request: &Request| present.iter().any(|it| it.request == *request);
        let steps = self.rows().into_iter().map(|row| {
            let (mut reused, mut anew) = (Vec::new(), Vec::new());
            for Requirement { request, .. } in self.stepped_once(row).requirements() {
                let topics = if is_asked(&request) { &mut reused } else { &mut anew };
                topics.push(request.topic());
            }
            let text = consequence(&reused, &anew);
            CostRow { name: row.name_in(&self.problem), text, is_step: true }
        });
        let rows = asked.chain(formulas).chain(steps);
        rows.filter(|row| list.matches(&[row.name])).collect()
    }

    /// The questions for what is on show, each once, with the layers that need it.
    pub fn requirements(&self) -> Vec<Requirement> {
        let mut found: Vec<Requirement> = Vec::new();
        for plot in self.on_show() {
            for layer in self.layers.iter().filter(|layer| self.shows_in(**layer, plot)) {
                let LayerSpec { name, needs, .. } = layer.spec();
                let each = needs.map(|topic| self.requests(topic, plot)).unwrap_or_default();
                for request in each.into_iter().flatten() {
                    match found.iter_mut().find(|requirement| requirement.request == request) {
                        Some(known) if known.layers.contains(name) => {}
                        Some(known) => known.layers.push(name),
                        None => found.push(Requirement { request, layers: vec![name] }),
                    }
                }
            }
        }
        found.sort_by_key(|requirement| requirement.request.topic());
        found
    }

    /// The names of the layers on show that are drawn by formulas and need no answer.
    pub fn drawn_by_formulas(&self) -> Vec<&'static str> {
        let shown = self.layers.iter().filter(|layer| self.shows(**layer)).map(|it| it.spec());
        shown.filter(|spec| spec.needs.is_none()).map(|spec| spec.name).collect()
    }
}

fn price(reply: &Reply) -> String {
    let Cost { evaluations, steps, .. } = reply.cost();
    let (evaluations, steps) = (count(evaluations), count(steps));
    format!("{evaluations:>6} ev {steps:>6} steps {:>8}", duration(reply.seconds))
}

/// What a step recomputes and what it reuses.
pub fn consequence(reused: &[Topic], anew: &[Topic]) -> String {
    let parts = [("recomputes", anew), ("reuses", reused)].into_iter();
    let parts = parts.filter(|(_, topics)| !topics.is_empty());
    let said = joined(parts.map(|(verb, topics)| format!("{verb} {}", named(topics, ", "))), "; ");
    if said.is_empty() {
        "nothing is asked".to_owned()
    } else {
        said
    }
}

/// The names of topics as they first occur, with a count for those that occur several times.
pub fn named(topics: &[Topic], between: &str) -> String {
    let count = |topic: &Topic| topics.iter().filter(|known| *known == topic).count();
    let named = distinct(topics).into_iter().map(|topic| match count(topic) {
        1 => topic.name().to_owned(),
        count => format!("{} x{count}", topic.name()),
    });
    joined(named, between)
}
