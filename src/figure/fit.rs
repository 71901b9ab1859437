//! The figure of a fit.

use super::content::{Figure, Panel};
use crate::fit::{Fitted, OMEGA0, parameters};
use crate::picture::fit::pictures;

impl Figure {
    /// What a fitted record shows.
    pub fn of_fit(fitted: &Fitted) -> Self {
        let estimate = &fitted.estimate;
        let p = &estimate.p;
        Figure {
            figure: "fit".into(),
            title: format!("{}: fitted motion", fitted.name),
            program: format!("hopfscope {}", env!("CARGO_PKG_VERSION")),
            provenance: None,
            units: "lengths in the unit of the record, times in s, velocities and impulses over omega0",
            parameters: parameters(p),
            initial: estimate.start.beginning(p, &[]).1,
            until: duration(fitted),
            method: "half swings with exact derivatives".into(),
            tolerance: 1e-13,
            panels: pictures(fitted).iter().map(Panel::of).collect(),
        }
    }
}

/// The dimensionless duration of the record.
fn duration(fitted: &Fitted) -> f64 {
    let t = fitted.estimate.data.times();
    let span = t.last().zip(t.first()).map_or(0.0, |(last, first)| last - first);
    fitted.estimate.p[OMEGA0] * span
}
