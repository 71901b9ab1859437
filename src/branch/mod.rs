//! What changes along a number: branches of cycles, their folds and other special points, the boundaries of regimes over
//! two numbers.

#[warn(clippy::missing_errors_doc)]
pub mod along;
#[doc(hidden)]
pub mod chart;
pub(crate) mod continuation;
#[warn(clippy::missing_errors_doc)]
pub mod escape;
pub(crate) mod extended;
#[warn(clippy::missing_errors_doc)]
pub mod fold;
#[doc(hidden)]
pub mod fold_graph;
#[doc(hidden)]
pub mod machine;
#[warn(clippy::missing_errors_doc)]
pub mod regime;
pub(crate) mod special;

pub use along::{Branch, BranchPoint};
pub use special::{Jump, Special, SpecialKind};
