//! Proofs: half swings that are enclosed whatever the rounding, and from them the limit cycles, all of them.
//!
//! A [`swing`] carries a ball around a Taylor polynomial in plain doubles ([`step`]) through one half plane, for
//! every [`field`] in a box of parameters. Two of them are the return [`map`], with bounds from both sides, its
//! inverse and its derivative. A [`barrier`] says what swings do that cannot be computed, and so gives the
//! [`ends`] between which all cycles lie; the [`count`] excludes every clearance between them, or finds it in
//! an interval with exactly one cycle, which is then enclosed ([`enclose`], [`affine`]). Where a [`theorems`]
//! decides, nothing is computed. [`cycles`] puts it together. "Unknown" and "open" are answers everywhere;
//! nothing here shares code with the search in `study`.
//!
//! Comparisons are written so that what is not a number fails them. The lemmas that the comments count on, with
//! their proofs, are in `docs/proofs.md`.

#![expect(
    clippy::neg_cmp_op_on_partial_ord,
    reason = "a comparison with what is not a number fails, and its negation is the safe side"
)]

pub mod affine;
pub mod barrier;
pub mod count;
pub mod cycles;
pub mod enclose;
pub mod ends;
pub mod field;
pub mod map;
pub mod step;
pub mod swing;
pub mod theorems;

pub use cycles::{Proof, prove};
pub use enclose::Enclosure;
pub use field::ParameterBox;
