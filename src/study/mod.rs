//! Questions asked of the flow: limit cycles, branches, folds, the basin of the sticking set.

pub(crate) mod accuracy;
pub(crate) mod arc;
pub(crate) mod balance;
#[warn(clippy::missing_errors_doc)]
pub mod basin;
pub(crate) mod belt;
#[warn(clippy::missing_errors_doc)]
pub mod branch;
#[doc(hidden)]
pub mod capture;
#[doc(hidden)]
pub mod chart;
#[doc(hidden)]
pub mod claims;
pub(crate) mod closed_pair;
#[doc(hidden)]
pub mod closing;
#[doc(hidden)]
pub mod closings;
pub(crate) mod continuation;
#[warn(clippy::missing_errors_doc)]
pub mod cycle;
#[warn(clippy::missing_errors_doc)]
pub mod design;
#[warn(clippy::missing_errors_doc)]
pub mod escape;
pub(crate) mod extended;
#[doc(hidden)]
pub mod extremes;
#[warn(clippy::missing_errors_doc)]
pub mod fold;
#[doc(hidden)]
pub mod fold_graph;
pub(crate) mod fold_point;
pub(crate) mod grazing;
#[warn(clippy::missing_errors_doc)]
pub mod guarantee;
#[doc(hidden)]
pub mod half_map;
#[doc(hidden)]
pub mod harmonic_error;
pub(crate) mod kicks;
pub(crate) mod limit_cycle;
#[warn(clippy::missing_errors_doc)]
pub mod margin;
#[doc(hidden)]
pub mod measure;
pub(crate) mod orbit;
#[doc(hidden)]
pub mod polish;
pub(crate) mod precise_closing;
#[doc(hidden)]
pub mod proved;
#[warn(clippy::missing_errors_doc)]
pub mod regime;
pub(crate) mod repeated;
pub(crate) mod return_map;
pub(crate) mod rim;
pub(crate) mod roundoff;
#[doc(hidden)]
pub mod scan;
pub(crate) mod search;
pub(crate) mod special;
pub(crate) mod stability;
pub mod sweep;
pub(crate) mod trade;
pub(crate) mod weak;
pub(crate) mod works;

pub use branch::{Branch, BranchPoint};
pub use harmonic_error::HarmonicBalance;
pub use limit_cycle::{BasinPicture, Cycles};
pub use return_map::{Return, ReturnMap};
pub use special::{Special, SpecialKind};
