//! A chart of regimes over two parameters: exact boundaries, and what lies between them.
//!
//! The chart is cut into lines along one of its parameters. On each line the boundaries are numbers: the
//! fold `D_F`, the escape point `D_c`, and the places where a parameter changes its sign. Where D is a
//! parameter of the chart, lines run along D and each takes one fold. Where it is not, the place on the
//! line is sought at which the fold comes to the given D. Between two boundaries one regime holds
//! ([`Regime::of`]): nothing is scanned.

mod trace;

pub use trace::{Band, ChartLine};
use trace::{HALVINGS, Tracer, values};

use super::regime::Regime;
use crate::flow::{Cost, Limits, Reason};
use crate::model::{Knob, Parameters};

/// What a chart is drawn over: two different ones of D, D2, D3, r, and their ranges.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plane {
    /// The parameter to the right.
    pub right: Knob,
    /// The parameter upwards.
    pub up: Knob,
    pub right_range: (f64, f64),
    /// Range of the one upwards.
    pub up_range: (f64, f64),
}

/// A chart of regimes.
#[derive(Clone, Debug, PartialEq)]
pub struct Chart {
    /// What it is drawn over.
    pub plane: Plane,
    /// The parameter along which lines run.
    pub along: Knob,
    /// The lines, by the value of the other parameter.
    pub lines: Vec<ChartLine>,
    pub cost: Cost,
}

impl Plane {
    /// The parameter along which lines run: D where it is one of the two, else the one that moves a fold
    /// from everywhere to everywhere.
    pub fn along(&self) -> Knob {
        let has = |symbol: Knob| self.right == symbol || self.up == symbol;
        [Knob::D, Knob::R, Knob::D3].into_iter().find(|&symbol| has(symbol)).unwrap_or(self.up)
    }

    fn range(&self, symbol: Knob) -> (f64, f64) {
        if symbol == self.right { self.right_range } else { self.up_range }
    }
}

/// How finely a chart is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Resolution {
    /// Lines that it has in any case, about.
    pub lines: usize,
    /// Largest distance between a boundary and its chord from line to line, as a fraction of the range; where
    /// it is more, further lines are drawn between. Infinite: none are.
    pub chord: f64,
    /// Relative error of the clearance at a fold; that of the boundaries is at most a hundred times this.
    pub tolerance: f64,
}

/// Draws a chart; the two parameters of the plane do not matter. Fails with [`Reason::Interrupted`], or
/// [`Reason::NotApplicable`] where the plane is invalid. What fails on a line is reported there.
pub fn chart(
    parameters: &Parameters,
    plane: Plane,
    resolution: Resolution,
    limits: &Limits,
) -> Result<Chart, Reason> {
    let charted = |symbol| matches!(symbol, Knob::D | Knob::D2 | Knob::D3 | Knob::R);
    if plane.right == plane.up || !charted(plane.right) || !charted(plane.up) {
        return Err(Reason::NotApplicable { needs: "two different ones of D, D2, D3, r" });
    }
    let along = plane.along();
    let across = if along == plane.right { plane.up } else { plane.right };
    let mut tracer = Tracer {
        parameters: *parameters,
        along,
        across,
        range: plane.range(along),
        across_range: plane.range(across),
        limits,
        cost: Cost::default(),
        tolerance: resolution.tolerance,
        ratio: 1.0,
        known: None,
    };
    let mut lines: Vec<ChartLine> = Vec::new();
    for at in values(across, plane.range(across), resolution.lines) {
        let line = tracer.line(at)?;
        if let Some(before) = lines.last().cloned() {
            tracer.between(&before, &line, resolution.chord, HALVINGS, &mut lines)?;
        }
        lines.push(line);
    }
    Ok(Chart { plane, along, lines, cost: tracer.cost })
}

impl Chart {
    /// The places of a boundary on each line, as points (right, up), in runs without a gap.
    pub fn boundary(&self, place: fn(&ChartLine) -> Option<f64>) -> Vec<Vec<(f64, f64)>> {
        let mut runs: Vec<Vec<(f64, f64)>> = vec![Vec::new()];
        for line in &self.lines {
            match (place(line), runs.last_mut()) {
                (Some(place), Some(run)) => run.push(self.point(line.at, place)),
                (None, Some(run)) if !run.is_empty() => runs.push(Vec::new()),
                _ => {}
            }
        }
        runs.retain(|run| !run.is_empty());
        runs
    }

    /// The point (right, up) at a place on a line.
    pub fn point(&self, at: f64, along: f64) -> (f64, f64) {
        if self.along == self.plane.right { (along, at) } else { (at, along) }
    }

    /// The regime at a point (right, up); `None` outside and where it could not be found out.
    ///
    /// Between two lines with the same bands their ends are interpolated; else the nearer line counts.
    pub fn regime_at(&self, right: f64, up: f64) -> Option<Regime> {
        let (at, along) = if self.along == self.plane.right { (up, right) } else { (right, up) };
        let after = self.lines.partition_point(|line| line.at < at);
        let (before, after) = (self.lines.get(after.wrapping_sub(1)), self.lines.get(after));
        let (Some(before), Some(after)) = (before, after) else {
            return before.or(after)?.regime_at(along);
        };
        let part = (at - before.at) / (after.at - before.at);
        if before.alike(after) {
            let mut pairs = before.bands.iter().zip(&after.bands);
            let inside =
                |pair: &(&Band, &Band)| along <= pair.0.to + part * (pair.1.to - pair.0.to);
            return pairs.find(inside).and_then(|(band, _)| band.regime);
        }
        if part < 0.5 { before.regime_at(along) } else { after.regime_at(along) }
    }
}

impl ChartLine {
    fn regime_at(&self, along: f64) -> Option<Regime> {
        self.bands.iter().find(|band| along <= band.to).and_then(|band| band.regime)
    }

    /// Whether the same regimes follow each other.
    fn alike(&self, other: &ChartLine) -> bool {
        let regimes =
            |line: &ChartLine| line.bands.iter().map(|band| band.regime).collect::<Vec<_>>();
        regimes(self) == regimes(other)
    }
}

#[cfg(test)]
mod tests;
