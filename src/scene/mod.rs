//! Scenes: what is on show, the layers in which it is drawn, and the questions that these ask.

pub mod file;
pub mod library;
pub mod machine;
pub mod mistake;
pub mod placed;
pub mod plot_setup;
pub mod said;
#[expect(clippy::module_inception, reason = "the scene itself, beside what belongs to it")]
pub mod scene;
pub mod views;
pub mod window;

pub use crate::question::{Finding, Fit, Recording, Reply, Request, TOPICS, Topic};
pub use library::{find, library, plain};
pub use machine::{Machine, ScaledMachine, Setting};
pub use mistake::FileMistake;
pub use plot_setup::{
    Arrangement, Axes, Height, MOST_PLOTS, ORDINATES, Ordinate, PlotSetup, Unit, usual_values,
};
pub use scene::{Scene, Variant};
pub use views::{LAYERS, Layer, LayerSpec, Needs, VIEWS, View, ViewSpec, letters};
pub use window::{Point, Span, Window, rectangle};
