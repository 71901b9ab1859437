//! What changes along a number: branches of cycles, their folds and other special points, the boundaries of regimes over
//! two numbers.

pub mod along;
#[doc(hidden)]
pub mod chart;
pub(crate) mod continuation;
pub mod escape;
pub(crate) mod extended;
pub mod fold;
#[doc(hidden)]
pub mod fold_graph;
#[doc(hidden)]
pub mod machine;
pub mod regime;
pub(crate) mod special;

pub(crate) use self::{
    chart::*, continuation::*, escape::*, extended::*, fold::*, fold_graph::*, machine::*,
    regime::*, special::*,
};
pub use along::{Branch, BranchPoint, Points, branch};
pub use special::{Jump, JumpEnd, Special, SpecialKind};
