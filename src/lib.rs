//! hopfscope: how dry friction turns a Hopf bifurcation into a set of equilibria with a basin that
//! one must know.
//!
//! The oscillator `q'' + 2 D q' + D2 q'^2 + D3 q'^3 + q in f_R` rests wherever `abs(q) <= r`, and comes
//! to rest there from nearby whatever its damping: the question "is it stable?" becomes "how large a kick
//! does it survive?". This library answers it in rings; each uses only rings further in, and a test
//! (`tests/architecture.rs`) keeps it so.
//!
//! ```
//! use hopfscope::flow::Limits;
//! use hopfscope::model::Parameters;
//! use hopfscope::portrait::Portrait;
//!
//! let parameters = Parameters { d: -0.3, d2: 0.0, d3: 0.5, r: 0.1 };
//! let portrait = Portrait::of_oscillator(&parameters, 0.0, &Limits::PATIENT)?;
//! let [inner, outer] = &portrait.cycles[..] else { panic!("two cycles") };
//! assert!(!inner.stable && outer.stable);
//! // Kicks up to the inner cycle are survived.
//! assert_eq!(portrait.margin.displacement, Some(inner.q_max));
//! # Ok::<(), hopfscope::flow::Reason>(())
//! ```
//!
//! The folder `examples` has more: margins that hold for certain, branches and scans, machines. The package in `python/`
//! asks the same questions in Python.
//!
//! - [`model`] has the numbers: the [`model::Parameters`] of the paper, a machine or a vibration mode, and the
//!   [`model::Model`] that they yield; the smooth field of one half plane in a frame in which both look alike, the sticking
//!   set, energy. [`model::Knob`] is the one table of every number that can be set. [`closed_form`] is what follows in
//!   formulas.
//! - [`flow`] computes motions. A motion is a chain of smooth half swings glued at `v = 0`; a
//!   [`flow::step::Stepper`] takes one step of the smooth field, [`mod@flow::swing`] runs it to the next
//!   `v = 0`, [`mod@flow::trajectory`] glues. No step ever crosses the discontinuity. [`flow::machine`] follows a mass on
//!   its belt: friction by its own law, two switching lines, riding on the belt and overtaking it.
//!   A [`flow::Subject`] is what a question is about, the oscillator of the paper or a machine.
//! - [`numerics`] is the ground floor: roots in brackets, quadrature, cubics, splines, sums, numbers of twice the
//!   precision, intervals with outward rounding. [`proof`] encloses half swings in intervals, and proves how many
//!   limit cycles there are and where; [`check`] verifies what it writes down.
//! - [`portrait`] says what an oscillator does: its cycles, what borders the basin of rest, the kicks that it survives
//!   ([`portrait::Portrait`]). Without a belt everything rests on the half-swing map, which contains no friction, is
//!   increasing, and is inverted by itself with the damping reversed ([`portrait::closing`]); within a half plane every motion
//!   is a graph over q, so basins and margins are comparisons ([`portrait::basin`]). On a belt one return map, which never
//!   decreases, orders all cycles, and what a start ends as is read off the next turning point ([`mod@portrait::return_map`]).
//! - [`branch`] follows cycles along a number by continuation; folds are roots of their own ([`branch::extended`],
//!   [`mod@branch::fold`]), and boundaries of regimes are curves over two numbers ([`mod@branch::chart`]).
//! - [`scan`] measures at many points, and follows level curves over two numbers; [`accuracy`] holds methods against each
//!   other and against references, to the extremes; [`paper`] puts the paper's own equations and sentences to the test.
//! - [`fit`] turns a recorded motion into estimates of all these numbers, with their errors, and the margin
//!   that they leave.
//! - [`question`] has the questions that the screen asks, and their answers: a [`question::Request`] names exactly the
//!   inputs that its answer depends on. [`scene`] says what is on show, and
//!   [`session`] is a pure machine: `update(&mut Session, Msg) -> Vec<Effect>` and
//!   `Session::wants() -> Vec<Request>`. What has not changed is not asked again; a hidden layer asks
//!   nothing. One table of commands feeds keys, footer and help.
//! - [`words`] has the words for numbers and answers. [`picture`] decides what stands in a plot: curves, marks and
//!   texts with their roles. [`view`] draws it in cells of the terminal, [`figure`] as PDF, SVG, PNG and data;
//!   [`report`] writes answers as tables, CSV, JSON and pages. None of the three knows another.
//! - [`terminal`], [`runtime`] and [`cli`] have the side effects: the screen, the threads, the files. The
//!   pump drains messages, gives the workers what the session wants, and draws when something changed;
//!   the newest wants win.

#![forbid(unsafe_code)]
// They panic where nobody reads; `runtime::standard` does not.
#![cfg_attr(not(test), warn(clippy::print_stdout, clippy::print_stderr))]
#![cfg_attr(
    not(feature = "explorer"),
    allow(
        dead_code,
        unused_imports,
        reason = "the explorer uses more of the inner rings than their public surface"
    )
)]

#[doc(hidden)]
pub mod accuracy;
#[warn(clippy::missing_errors_doc)]
pub mod branch;
#[warn(clippy::missing_errors_doc)]
pub mod closed_form;
#[warn(clippy::missing_errors_doc)]
pub mod fit;
#[warn(clippy::missing_errors_doc)]
pub mod flow;
#[warn(clippy::missing_errors_doc)]
pub mod model;
#[doc(hidden)]
pub mod numerics;
#[doc(hidden)]
pub mod paper;
#[warn(clippy::missing_errors_doc)]
pub mod portrait;
#[warn(clippy::missing_errors_doc)]
pub mod proof;
#[warn(clippy::missing_errors_doc)]
pub mod scan;

#[cfg(feature = "explorer")]
#[doc(hidden)]
pub mod check;
#[cfg(feature = "explorer")]
#[doc(hidden)]
pub mod cli;
#[cfg(feature = "explorer")]
#[doc(hidden)]
pub mod figure;
#[cfg(feature = "explorer")]
#[doc(hidden)]
pub mod picture;
#[cfg(feature = "explorer")]
#[doc(hidden)]
pub mod question;
#[cfg(feature = "explorer")]
#[doc(hidden)]
pub mod report;
#[cfg(feature = "explorer")]
#[doc(hidden)]
pub mod runtime;
#[cfg(feature = "explorer")]
#[doc(hidden)]
pub mod scene;
#[cfg(feature = "explorer")]
#[doc(hidden)]
pub mod session;
#[cfg(feature = "explorer")]
#[doc(hidden)]
pub mod terminal;
#[cfg(feature = "explorer")]
#[doc(hidden)]
pub mod view;
#[cfg(feature = "explorer")]
#[doc(hidden)]
pub mod words;
