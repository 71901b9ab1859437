//! hopfscope: how dry friction turns a Hopf bifurcation into a set of equilibria with a basin that
//! one must know.
//!
//! The oscillator `q'' + 2 D q' + D2 q'^2 + D3 q'^3 + q in f_R` rests wherever `abs(q) <= r`, and comes
//! to rest there from nearby whatever its damping: the question "is it stable?" becomes "how large a kick
//! does it survive?". This library answers it in rings; each uses only rings further in, and a test
//! (`tests/architecture.rs`) keeps it so.
//!
//! - [`oscillator`] is the paper's model: parameters, the smooth field of one half plane in a frame in
//!   which both look alike, the sticking set, energy. [`closed_form`] is what follows in formulas.
//! - [`flow`] computes motions. A motion is a chain of smooth half swings glued at `v = 0`; a
//!   [`flow::step::Stepper`] takes one step of the smooth field, [`flow::swing`] runs it to the next
//!   `v = 0`, [`flow::trajectory`] glues. No step ever crosses the discontinuity.
//! - [`numerics`] is arithmetic for all of them: intervals with outward rounding. [`proof`] encloses half swings
//!   in it, and proves how many limit cycles there are and where.
//! - [`study`] asks questions of the flow. Everything rests on the half-swing map
//!   ([`study::half_map`]), which contains no friction, is increasing, and is inverted by itself with
//!   the damping reversed. Cycles close two of them ([`study::closing`]); a search that excludes what
//!   cannot hold a cycle finds all ([`study::search`], [`study::closings`], [`study::cycle`]), energy decides where differences
//!   lose their digits ([`study::balance`]), continuation follows them ([`study::continuation`],
//!   [`study::branch`], [`study::fold`], [`study::escape`]). Within a half plane every motion is a graph
//!   over q ([`study::arc`]), so basins, margins and bands of capture are comparisons
//!   ([`study::basin`], [`study::margin`], [`study::capture`]). [`study::claims`] puts the paper's own
//!   equations and sentences to the test.
//! - [`machine`] is the mass on its belt by the whole model: friction by its own law, two switching lines,
//!   riding on the belt and overtaking it. One return map, which never decreases, orders all cycles; what
//!   a start ends as is read off the next turning point ([`machine::Portrait`]).
//! - [`fit`] turns a recorded motion into estimates of all these numbers, with their errors, and the margin
//!   that they leave.
//! - [`scene`] says what is on show, as [`scene::Request`] values that name exactly their inputs, and
//!   [`session`] is a pure machine: `update(&mut Session, Msg) -> Vec<Effect>` and
//!   `Session::wants() -> Vec<Request>`. What has not changed is not asked again; a hidden layer asks
//!   nothing. One table of commands feeds keys, footer and help.
//! - [`view`] draws a session, [`export`] writes answers; both decide nothing.
//! - [`terminal`], [`runtime`] and [`cli`] have the side effects: the screen, the threads, the files. The
//!   pump drains messages, gives the worker what the session wants, and draws when something changed;
//!   the worker's newest wants win.

pub mod cli;
pub mod closed_form;
pub mod export;
pub mod fit;
pub mod flow;
pub mod machine;
pub mod numerics;
pub mod oscillator;
pub mod proof;
pub mod runtime;
pub mod scene;
pub mod session;
pub mod study;
pub mod terminal;
pub mod view;
