//! Questions asked of the flow: limit cycles, branches, folds, the basin of the sticking set.

pub mod accuracy;
pub mod arc;
pub mod balance;
pub mod basin;
pub mod belt;
pub mod branch;
pub mod capture;
pub mod chart;
pub mod claims;
pub mod closing;
pub mod closings;
pub mod continuation;
pub mod cycle;
pub mod design;
pub mod escape;
pub mod extremes;
pub mod fold;
pub mod guarantee;
pub mod half_map;
pub mod harmonic_error;
pub mod lift;
pub mod margin;
pub mod measure;
pub mod regime;
pub mod return_map;
pub mod scan;
pub mod search;
pub mod stability;
pub mod trade;
pub mod weak;
pub mod works;

pub use branch::{Branch, BranchPoint, Special, SpecialKind};
pub use cycle::{Cycle, Cycles, Edge, Picture};
pub use harmonic_error::HarmonicBalance;
pub use margin::Margin;
pub use return_map::{Return, ReturnMap};
