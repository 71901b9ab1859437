//! Proofs: half swings enclosed rigorously, whatever the rounding, and from them all limit cycles.
//!
//! A [`ball`] of motions is carried around Taylor polynomials in plain doubles ([`series`], [`step`]) through one
//! half plane, for every [`field`] in a box of parameters: a [`mod@swing`]. Swings too stiff for this run through a
//! [`funnel`]. Two half swings form the return [`map`], with bounds from both sides, its inverse and its
//! derivative. The [`count`] excludes every clearance, or finds it in an interval with exactly one cycle, which is
//! then enclosed ([`mod@enclose`]). Where a theorem decides, nothing is computed. [`cycles`] combines these parts.
//!
//! [`bifurcation`] encloses the value of a parameter at which the number of cycles changes, [`mod@range`] decides
//! that number piece by piece, [`motion`] follows single motions, and [`mod@kicks`] bounds the margins.
//!
//! "Unknown" and "open" are possible answers everywhere. Nothing here shares code with the search in `portrait`.
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

pub(crate) mod ball;
#[doc(hidden)]
pub mod bifurcation;
#[cfg(feature = "explorer")]
#[doc(hidden)]
pub mod certificate;
pub(crate) mod count;
pub mod cycles;
#[doc(hidden)]
pub mod enclose;
#[doc(hidden)]
pub mod field;
pub(crate) mod funnel;
#[doc(hidden)]
pub mod kicks;
#[doc(hidden)]
pub mod map;
#[doc(hidden)]
pub mod motion;
#[doc(hidden)]
pub mod range;
pub(crate) mod series;
pub(crate) mod step;
#[doc(hidden)]
pub mod swing;

pub(crate) use self::{
    ball::*, count::*, cycles::*, enclose::*, field::*, funnel::*, kicks::*, map::*, motion::*,
    range::*, series::*, step::*, swing::*,
};
#[doc(hidden)]
pub use ball::StartBox;
pub use cycles::{Proof, prove};
pub use enclose::Enclosure;
pub use field::ParameterBox;
