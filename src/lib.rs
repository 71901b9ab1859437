//! hopfscope: how dry friction turns a Hopf bifurcation into a set of equilibria with a basin that
//! one must know.

pub mod cli;
pub mod closed_form;
pub mod export;
pub mod flow;
pub mod oscillator;
pub mod runtime;
pub mod scene;
pub mod session;
pub mod study;
pub mod terminal;
pub mod view;
