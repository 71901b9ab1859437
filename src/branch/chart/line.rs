//! A line of a chart: the boundaries on it and the bands between them.

use crate::branch::regime::Regime;
use crate::flow::Reason;

/// A part of a line in which one regime holds; `None` where it could not be found out.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Band {
    /// Where it begins.
    pub from: f64,
    /// Where it ends.
    pub to: f64,
    /// What holds there.
    pub regime: Option<Regime>,
}

/// The bands at one value of the other parameter, and the boundaries between them.
#[derive(Clone, Debug, PartialEq)]
pub struct ChartLine {
    /// Value of the other parameter.
    pub at: f64,
    /// From one end of the range to the other.
    pub bands: Vec<Band>,
    /// The fold, also where it lies outside of the range.
    pub fold: Option<f64>,
    /// The fold by one harmonic (48).
    pub harmonic: Option<f64>,
    /// The escape point.
    pub escape: Option<f64>,
    /// Why the boundaries could not be computed.
    pub failure: Option<Reason>,
}
