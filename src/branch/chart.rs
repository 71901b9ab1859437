//! A chart of regimes over two parameters: exact boundaries, and what lies between them.
//!
//! The chart is cut into lines along one of its parameters. On each line the boundaries are numbers: the
//! fold `D_F`, the escape point `D_c`, and the places where a parameter changes its sign. Where D is a
//! parameter of the chart, lines run along D and each takes one fold. Where it is not, the place on the
//! line is sought at which the fold comes to the given D. Between two boundaries one regime holds
//! ([`Regime::of`]): nothing is scanned.

mod trace;

pub use trace::{Band, ChartLine, Plane, Resolution};
use trace::{HALVINGS, Tracer, values};

use super::Regime;
use crate::flow::{Cost, Limits, Reason, Result};
use crate::model::Parameters;

/// A chart of regimes.
#[derive(Clone, Debug, PartialEq)]
pub struct Chart {
    /// What it is drawn over.
    pub plane: Plane,
    /// The lines, by the value of the other parameter.
    pub lines: Vec<ChartLine>,
    pub cost: Cost,
}

/// Draws a chart; the two parameters of the plane do not matter. What fails on a line is reported there.
///
/// # Errors
/// [`Reason::Interrupted`], or [`Reason::NotApplicable`] where the plane is invalid.
pub fn chart(
    parameters: &Parameters,
    plane: Plane,
    resolution: Resolution,
    limits: &Limits,
) -> Result<Chart> {
    if plane.right == plane.up || !plane.right.is_parameter() || !plane.up.is_parameter() {
        return Err(Reason::NotApplicable { needs: "two different ones of D, D2, D3, r" });
    }
    let (parameters, across, cost) = (*parameters, plane.across(), Cost::default());
    let (lines, ratio, known) = (Vec::new(), 1.0, None);
    let mut tracer = Tracer { parameters, plane, resolution, limits, lines, cost, ratio, known };
    for at in values(across, plane.range(across), resolution.lines) {
        let line = tracer.line(at)?;
        if let Some(before) = tracer.lines.last().cloned() {
            tracer.between(&before, &line, HALVINGS)?;
        }
        tracer.lines.push(line);
    }
    Ok(Chart { plane, lines: tracer.lines, cost: tracer.cost })
}

impl Chart {
    /// The places of a boundary on each line, as points (right, up), in runs without a gap.
    pub fn boundary(&self, place: fn(&ChartLine) -> Option<f64>) -> Vec<Vec<(f64, f64)>> {
        let point = |line: &ChartLine| Some(self.point(line.at, place(line)?));
        let runs = self.lines.split(|line| place(line).is_none()).filter(|run| !run.is_empty());
        runs.map(|run| run.iter().filter_map(point).collect()).collect()
    }

    /// The point (right, up) at a place on a line.
    pub fn point(&self, at: f64, along: f64) -> (f64, f64) {
        if self.plane.along() == self.plane.right {
            (along, at)
        } else {
            (at, along)
        }
    }

    /// The regime at a point (right, up); `None` outside and where it could not be found out.
    ///
    /// Between two lines with the same bands their ends are interpolated; else the nearer line counts.
    pub fn regime_at(&self, right: f64, up: f64) -> Option<Regime> {
        // Both ways the two change places, or neither.
        let (at, along) = self.point(right, up);
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
            return pairs.find(inside)?.0.regime;
        }
        if part < 0.5 {
            before.regime_at(along)
        } else {
            after.regime_at(along)
        }
    }
}

impl ChartLine {
    fn regime_at(&self, along: f64) -> Option<Regime> {
        self.bands.iter().find(|band| along <= band.to)?.regime
    }

    /// Whether the same regimes follow each other.
    fn alike(&self, other: &ChartLine) -> bool {
        let others = other.bands.iter().map(|band| band.regime);
        self.bands.iter().map(|band| band.regime).eq(others)
    }
}

#[cfg(test)]
mod tests;
