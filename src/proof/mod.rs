//! Proofs: half swings enclosed rigorously, whatever the rounding, and from them all limit cycles.
//!
//! A [`swing`] carries a ball, measured in a [`norm`], around Taylor polynomials in plain doubles ([`series`],
//! [`step`], [`rounding`]) through one half plane, for every [`field`] in a box of parameters. Swings too stiff
//! for this run through a [`funnel`], and those next to a node above a [`barrier`]. Two half swings form the
//! return [`map`], with bounds from both sides, its inverse and its derivative. The [`ends`] are clearances
//! between which all cycles lie. The [`count`] excludes every clearance between them, or finds it in an
//! interval with exactly one cycle, which is then enclosed ([`enclose`], [`affine`]). Where one of the
//! [`theorems`] decides, nothing is computed. [`cycles`] combines these parts.
//!
//! [`derivatives`] are those of the map with respect to its parameters ([`sensitivity`], [`model`]). [`fold`]
//! and [`escape`] enclose the value of a parameter at which the number of cycles changes, by a [`bracket`] of
//! verdicts.
//!
//! "Unknown" and "open" are possible answers everywhere. Nothing here shares code with the search in `study`.
//!
//! Comparisons are written so that NaN fails them. The lemmas cited in comments, with their proofs, are in
//! `docs/proofs.md`.
//!
//! ```
//! use hopfscope::model::Parameters;
//! use hopfscope::proof::{ParameterBox, prove};
//!
//! let parameters = Parameters { d: -0.3, d2: 0.0, d3: 0.5, r: 0.1 };
//! let proof = prove(&ParameterBox::from(&parameters), &[]);
//! assert!(proof.is_complete());
//! assert_eq!(proof.cycles.len(), 2);
//! ```

#![expect(
    clippy::neg_cmp_op_on_partial_ord,
    reason = "a comparison with what is not a number fails, and its negation is the safe side"
)]

pub(crate) mod affine;
pub(crate) mod barrier;
pub(crate) mod bracket;
#[cfg(feature = "explorer")]
#[doc(hidden)]
pub mod certificate;
pub(crate) mod count;
pub mod cycles;
#[doc(hidden)]
pub mod derivatives;
#[doc(hidden)]
pub mod enclose;
pub(crate) mod ends;
#[doc(hidden)]
pub mod escape;
#[doc(hidden)]
pub mod field;
#[doc(hidden)]
pub mod fold;
pub(crate) mod funnel;
#[doc(hidden)]
pub mod kicks;
#[doc(hidden)]
pub mod map;
pub(crate) mod model;
#[doc(hidden)]
pub mod motion;
pub(crate) mod norm;
#[doc(hidden)]
pub mod range;
pub(crate) mod ride;
pub(crate) mod rounding;
pub(crate) mod sensitivity;
pub(crate) mod series;
pub(crate) mod step;
#[doc(hidden)]
pub mod swing;
pub(crate) mod theorems;

pub use cycles::{Proof, prove};
pub use enclose::Enclosure;
pub use field::ParameterBox;
