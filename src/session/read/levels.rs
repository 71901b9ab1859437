//! Level curves in charts and in scans over two numbers, and what can be walked along over two numbers.

use std::sync::Arc;

use super::wants::within;
use crate::flow::{Problem, Subject};
use crate::model::Knob;
use crate::portrait::StartWindow;
use crate::scan::{Conditions, LevelTarget, Scan, Spacing, Sweep};
use crate::scene::{Axes, Finding, Layer, Point, Request, Span, Topic, View};
use crate::session::{Plot, ScanOnShow, Session};

/// Points of each range on which level curves are sought.
const LATTICE: usize = 24;

impl Session {
    /// The question for the level curves of a column in a plot. Fails with one line that says why there are none.
    pub fn level_request(&self, target: LevelTarget, plot: usize) -> Result<Request, String> {
        const NOWHERE: &str =
            "level curves are drawn in a chart of regimes, and in a scan over two numbers";
        let scan = match (self.plots[plot].view, &self.scanned) {
            (View::Regimes, _) => self.charted(target, plot)?,
            (View::Scan, Some(scanned)) if scanned.scan.over().len() == 2 => {
                scanned.scan.on_lattice(target.measure, LATTICE)?
            }
            _ => return Err(NOWHERE.to_owned()),
        };
        Ok(Request::Level { scan: Arc::new(scan), target })
    }

    /// The scan of which the level curves in a chart are those.
    fn charted(&self, target: LevelTarget, plot: usize) -> Result<Scan, String> {
        let Plot { axes: Axes { abscissa, against, .. }, window, .. } = &self.plots[plot];
        let over = [(*abscissa, window.x), (*against, window.y)].map(|(knob, span)| {
            let range = within(knob, span).ok_or_else(|| format!("no {knob} is on show"))?;
            Sweep::new(knob, range, LATTICE, Spacing::Even)
        });
        let over = over.into_iter().collect::<Result<_, _>>()?;
        let parameters = self.problem.parameters.with(*abscissa, 0.0).with(*against, 0.0);
        // Only where the motion on show is measured does it count.
        let is_of_motion = target.measure.depends_on(Knob::Duration);
        let motion = if is_of_motion {
            self.problem
        } else {
            Problem::default()
        };
        let tolerances = self.doubt.tolerances();
        let base = Subject { tolerances, ..Problem { parameters, ..motion }.into() };
        Scan::new(base, over, vec![target.measure], self.conditions(1.0, 1.0))
    }

    /// What measures depend on beside the numbers that vary, in these units: the window for `stability` is that of a phase
    /// plane on show.
    pub fn conditions(&self, displacement: f64, velocity: f64) -> Conditions {
        let plane = self.plots.iter().find(|plot| plot.view == View::Phase);
        let window = plane.map_or(View::Phase.spec().window, |plot| plot.window);
        let ends = |span: Span, unit: f64| span.ends().map(|end| unit * end).into();
        let window = StartWindow { q: ends(window.x, displacement), v: ends(window.y, velocity) };
        let kicks = self.kicks.in_units(1.0 / displacement, 1.0 / velocity);
        Conditions { window, kicks, ..Conditions::default() }
    }

    /// The level curves in a plot, with what they are curves of, stale or not.
    pub fn level_curves(&self, plot: usize) -> Vec<(LevelTarget, Vec<Vec<[f64; 2]>>)> {
        let found = self.found(Topic::Level, plot, Finding::try_as_level_ref).into_iter();
        let points = found.map(|(tag, found)| {
            let curves = found.curves.iter().map(|curve| curve.points.clone());
            (self.levels[tag.index], curves.collect())
        });
        points.collect()
    }

    /// Where values of both numbers of a plot stand on its axes.
    pub fn on_axes(&self, plot: usize, values: [f64; 2]) -> Point {
        let scanned = self.scanned.as_ref().filter(|_| self.plots[plot].view == View::Scan);
        let over = scanned.map_or(&[][..], |scanned| scanned.scan.over());
        let [x, y] = [0, 1].map(|axis| {
            let value = values[axis];
            over.get(axis).map_or(value, |sweep| ScanOnShow::coordinate(sweep, value))
        });
        Point { x, y }
    }

    /// The numbers on the axes of a plot over two.
    pub fn numbers_over(&self, plot: usize) -> Vec<Knob> {
        let Axes { abscissa, against, .. } = self.plots[plot].axes;
        match (self.plots[plot].view, &self.scanned) {
            (View::Scan, Some(scanned)) => scanned.scan.over().iter().map(|it| it.symbol).collect(),
            (View::Regimes, _) => vec![abscissa, against],
            _ => vec![abscissa],
        }
    }

    /// The curves over two numbers that a walk in a plot can follow, with their names: boundaries and level curves.
    pub fn curves_over_two(&self, plot: usize) -> Vec<(String, Vec<[f64; 2]>)> {
        let chart = self.chart(plot).filter(|_| self.shows_in(Layer::Boundaries, plot));
        let boundaries = chart.into_iter().flat_map(|chart| {
            let lines = [
                ("fold", chart.boundary(|line| line.fold)),
                ("escape point", chart.boundary(|line| line.escape)),
            ];
            lines.into_iter().flat_map(|(name, runs)| runs.into_iter().map(move |run| (name, run)))
        });
        let boundaries = boundaries
            .map(|(name, run)| (name.to_owned(), run.into_iter().map(<[f64; 2]>::from).collect()));
        let levels = self.level_curves(plot).into_iter().flat_map(|(target, curves)| {
            curves.into_iter().map(move |curve| (target.to_string(), curve))
        });
        boundaries.chain(levels).collect()
    }
}
