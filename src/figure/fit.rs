//! The figure of a fit.

use super::content::{Figure, Panel};
use crate::fit::observation::{Data, LAST, OMEGA0, Q0, StartKind};
use crate::fit::{Fitted, parameters};
use crate::model::State;
use crate::picture::fit::pictures;

impl Figure {
    /// What a fitted record shows.
    pub fn of_fit(fitted: &Fitted) -> Self {
        let estimate = &fitted.estimate;
        let p = &estimate.p;
        let velocity = if estimate.start == StartKind::Moving { p[LAST] } else { 0.0 };
        Figure {
            figure: "fit".into(),
            title: format!("{}: fitted motion", fitted.name),
            program: format!("hopfscope {}", env!("CARGO_PKG_VERSION")),
            provenance: None,
            units: "lengths in the unit of the record, times in s, velocities and impulses over omega0",
            parameters: parameters(p),
            initial: State { q: p[Q0], v: velocity },
            until: duration(fitted),
            method: "half swings with exact derivatives".into(),
            tolerance: 1e-13,
            panels: pictures(fitted).iter().map(Panel::of).collect(),
        }
    }
}

/// The dimensionless duration of the record.
fn duration(fitted: &Fitted) -> f64 {
    let t = match &fitted.estimate.data {
        Data::Samples { t, .. } => Some(t),
        Data::Peaks { t, .. } => t.as_ref(),
    };
    let span = t.and_then(|t| Some(t.last()? - t.first()?));
    fitted.estimate.p[OMEGA0] * span.unwrap_or(0.0)
}
