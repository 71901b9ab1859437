//! The content of the plots, and which of them are on show. A plot may show several variants of the present problem,
//! drawn over each other: a variant holds some values; the others follow the keys.

use std::collections::BTreeMap;

use crate::accuracy::TradePoint;
use crate::branch::Branch;
use crate::flow::Problem;
use crate::model::{Group, Knob};
use crate::numerics::{by_number, hypot};
use crate::scene::{
    Finding, Height, Layer, Needs, PlotSetup, Point, Request, Topic, Variant, View, Window,
};
use crate::session::{Framing, Pane, Plot, Row, ScreenSetup, Session};
use crate::words::joined;

impl Session {
    /// Whether a plot draws circles round.
    pub fn has_equal_units(&self, plot: usize) -> bool {
        self.plots[plot].view == View::Phase && !self.display.stretched
    }

    /// The indices of the plots on show.
    pub fn on_show(&self) -> std::ops::Range<usize> {
        if self.enlarged {
            self.plot..self.plot + 1
        } else if self.display.lecture {
            // The one in use and the next.
            let first = self.plot.min(self.plots.len().saturating_sub(2));
            first..self.plots.len().min(first + 2)
        } else {
            0..self.plots.len()
        }
    }

    pub fn focused(&self) -> Option<&Plot> {
        let Pane::Plot(index) = self.focus else { return None };
        self.plots.get(index)
    }

    /// Whether a layer is on and a plot on show has its view.
    pub fn shows(&self, layer: Layer) -> bool {
        self.on_show().any(|index| self.shows_in(layer, index))
    }

    /// Whether a layer is on and belongs to the view of a plot.
    pub fn shows_in(&self, layer: Layer, plot: usize) -> bool {
        self.layers.contains(&layer) && self.plots[plot].view == layer.spec().view
    }

    /// What a view lacks to show anything and which key gives it, by the names of commands; `None` where it
    /// lacks nothing.
    pub fn lacks(&self, view: View) -> Option<&'static str> {
        let needs = view.spec().needs;
        let there = match needs {
            Needs::Oscillator => true,
            Needs::Machine => self.scene.machine.is_some(),
            Needs::Record => self.scene.recording.is_some(),
            Needs::Scan => self.scanned.is_some(),
        };
        (!there).then(|| needs.sentence())
    }

    /// What is said in place of a picture in which nothing is drawn; `None` while it may still come.
    pub fn nothing(&self, index: usize) -> Option<String> {
        let view = self.plots[index].view;
        if let Some(lacks) = self.lacks(view) {
            return Some(lacks.to_owned());
        }
        let asked = self.asked_by(index);
        if let Some(why) = asked.iter().find_map(|request| self.answers.failure(request)) {
            return Some(format!("no answer: {why}; {{retry}} tries again"));
        }
        if asked.iter().any(|request| self.is_open(request)) {
            return None;
        }
        let shows = |layer: &Layer| self.shows_in(*layer, index);
        let on = view == View::Scan || self.layers.iter().any(shows);
        let text = if on {
            view.spec().nothing
        } else {
            "no layer is on: {layers} lists them"
        };
        Some(text.to_owned())
    }

    /// Why a layer that is on draws nothing, if the reason lies in the axes of every diagram on show or in a
    /// missing mark.
    pub fn not_drawn(&self, layer: Layer) -> Option<&'static str> {
        let drawn = |index: usize| {
            self.shows_in(layer, index) && self.plots[index].axes.ordinate.spec().harmonic.is_some()
        };
        let (lacks, text) = match layer {
            Layer::Ghost => (self.marks.left.is_none(), "not drawn: no mark has been visited yet"),
            Layer::Record | Layer::Recorded => {
                (self.scene.recording.is_none(), "not drawn: no record is open")
            }
            Layer::Belt | Layer::BeltPath | Layer::Whole => {
                (self.scene.machine.is_none(), "not drawn: the scene has no machine")
            }
            Layer::Harmonic | Layer::Asymptotes => {
                let lacks = self.shows(layer) && !self.on_show().any(drawn);
                (lacks, "not drawn: the harmonic answer has no multiplier")
            }
            _ => return None,
        };
        lacks.then_some(text)
    }

    /// The plot in use if it is a diagram, otherwise the first diagram on show.
    pub fn diagram(&self) -> Option<usize> {
        let diagrams = [View::Diagram, View::BeltDiagram];
        let is_one = |index: &usize| diagrams.contains(&self.plots[*index].view);
        Some(self.plot).filter(is_one).or_else(|| self.on_show().find(is_one))
    }

    /// The numbers over which the model that is drawn is scanned.
    pub(crate) fn scanned_groups(&self) -> &'static [Group] {
        if self.draws_whole() {
            &[Group::Machine, Group::Law]
        } else {
            &[Group::Motion]
        }
    }

    /// The numbers over which a view can be drawn.
    pub fn abscissae(&self, view: View) -> Vec<Knob> {
        if view != View::BeltDiagram {
            return Knob::PARAMETERS.to_vec();
        }
        let own = Row::all().filter(|row| row.is_of_machine() && self.has(*row));
        own.filter_map(Row::stepped).collect()
    }

    /// The scene's setup of a plot with this view: the one at the same place, otherwise the first one with that
    /// view.
    pub fn plot_of_scene(&self, plot: usize, view: View) -> Option<PlotSetup> {
        let plots = &self.scene.plots;
        plots.get(plot).into_iter().chain(plots).find(|setup| setup.view == view).copied()
    }

    /// The present setup of a plot.
    pub fn plot_setup(&self, index: usize) -> PlotSetup {
        let Plot { view, axes, family, window, framing, .. } = self.plots[index];
        let window = match framing {
            Framing::Scene => self.plot_of_scene(index, view).and_then(|of| of.window),
            Framing::Fitting => None,
            Framing::Fitted | Framing::User => Some(window),
        };
        PlotSetup { view, axes, window, family }
    }

    /// The present setup of all plots.
    pub(crate) fn screen_setup(&self) -> ScreenSetup {
        let plots = (0..self.plots.len()).map(|index| self.plot_setup(index)).collect();
        ScreenSetup { plots, arrangement: self.arrangement }
    }
}

/// One of the variants that a plot shows.
#[derive(Clone, Debug, Default)]
pub struct VariantTag {
    /// Its place among them.
    pub index: usize,
    /// The values that tell it from the others; empty where the plot shows one motion.
    pub label: String,
}

/// A motion that a plot shows, and what distinguishes it from the others there.
#[derive(Clone, Debug)]
pub struct ShownMotion {
    pub variant: VariantTag,
    pub problem: Problem,
    /// Whether nothing is held, so that it is the present motion.
    pub present: bool,
}

impl Session {
    /// The variants that a plot shows in place of the present problem, if any.
    pub fn variants(&self, plot: usize) -> Option<&[Variant]> {
        self.scene.families.get(self.plots[plot].family?).map(Vec::as_slice)
    }

    /// The problems that a plot shows: the present one, or its variants.
    pub fn shown(&self, plot: usize) -> Vec<ShownMotion> {
        let alone = [Variant::default()];
        let all = self.variants(plot).unwrap_or(&alone);
        let family = self.plots[plot].family.is_some();
        let own = self.letter().filter(|_| !family);
        let shown = |(index, (variant, label)): (usize, (&Variant, String))| ShownMotion {
            variant: VariantTag { index, label: own.map_or(label, str::to_owned) },
            problem: variant.of(self.problem),
            present: variant.held.is_empty(),
        };
        all.iter().zip(labels(all, &self.problem, false)).enumerate().map(shown).collect()
    }

    /// The parameters that all variants of a plot hold at the same values, as text that needs to be given only
    /// once.
    pub fn held_alike(&self, plot: usize) -> String {
        let all = self.variants(plot).unwrap_or_default();
        let held = all.iter().take(1).flat_map(|variant| &variant.held);
        text(held.filter(|(symbol, value)| symbol.is_parameter() && alike(all, **symbol, **value)))
    }

    /// The answers on this topic for the problems that a plot shows, stale or not, as `read` makes them out.
    pub fn found<'a, T>(
        &'a self,
        topic: Topic,
        plot: usize,
        read: fn(&'a Finding) -> Option<T>,
    ) -> Vec<(VariantTag, T)> {
        let starts = topic == Topic::Trajectory;
        let labels = labels(self.variants(plot).unwrap_or_default(), &self.problem, starts);
        let found = |(index, request): (usize, Option<Request>)| {
            let answer = self.answers.standing(&request?).answer().and_then(read)?;
            let own = || self.letter().unwrap_or_default().to_owned();
            let label = labels.get(index).cloned().unwrap_or_else(own);
            Some((VariantTag { index, label }, answer))
        };
        self.requests(topic, plot).into_iter().enumerate().filter_map(found).collect()
    }

    /// The branches computed last over the parameter of a diagram, stale or not, each with its index among the
    /// problems that the plot shows.
    pub fn branches(&self, plot: usize) -> Vec<(usize, &Branch)> {
        let over = self.plots[plot].axes.abscissa;
        let found = self.found(Topic::Branch, plot, Finding::try_as_branch_ref).into_iter();
        let found = found.filter(|(_, branch)| branch.parameter == over);
        found.map(|(variant, branch)| (variant.index, branch)).collect()
    }

    /// The measure of heights for the cycles of a variant in a diagram, at the friction of the branch on show,
    /// stale or not.
    pub fn height(&self, plot: usize, variant: usize) -> Height {
        let asked = self.requests(Topic::Branch, plot).into_iter().nth(variant).flatten();
        let reply = asked.and_then(|request| self.answers.standing(&request).reply());
        let friction = match reply.map(|found| &found.request) {
            Some(Request::Branch { parameters, .. }) => parameters.r,
            _ => self.problem.parameters.r,
        };
        self.plots[plot].axes.height(friction)
    }
}

/// Labels that distinguish variants: the parameters that they do not all hold at the same values and, if
/// `starts`, also the starts of the motions. A variant that holds nothing has the present values.
fn labels(all: &[Variant], present: &Problem, starts: bool) -> Vec<String> {
    let tells =
        |symbol: Knob, value: f64| (starts || symbol.is_parameter()) && !alike(all, symbol, value);
    let held = all.iter().flat_map(|variant| variant.held.keys());
    let now: BTreeMap<Knob, f64> = held.map(|symbol| (*symbol, present.get(*symbol))).collect();
    let label = |variant: &Variant| {
        let values = if variant.held.is_empty() { &now } else { &variant.held };
        text(values.iter().filter(|(symbol, value)| tells(**symbol, **value)))
    };
    all.iter().map(label).collect()
}

/// Whether all of these variants hold this value.
fn alike(all: &[Variant], symbol: Knob, value: f64) -> bool {
    all.iter().all(|variant| variant.held.get(&symbol) == Some(&value))
}

fn text<'a>(held: impl Iterator<Item = (&'a Knob, &'a f64)>) -> String {
    joined(held.map(|(symbol, value)| format!("{symbol} = {value}")), ", ")
}

impl Session {
    /// The row that is nearest to the cursor of a plot on the screen.
    pub fn row_under_cursor(&self, plot: usize) -> Option<&TradePoint> {
        let plot = Some(&self.plots[plot]).filter(|plot| plot.view == View::Trade)?;
        let Point { x, y } = plot.cursor?;
        let Window { x: across, y: up } = plot.window;
        let distance = |row: &&TradePoint| {
            row.place().map_or(f64::INFINITY, |(right, high)| {
                hypot((right - x) / across.width(), (high - y) / up.width())
            })
        };
        let rows = self.trade()?.rows.iter().filter(|row| row.place().is_some());
        rows.min_by(by_number(distance))
    }
}
