//! Scenes: what is on show, the layers in which it is drawn, and the questions that these ask.

pub mod examine;
pub mod file;
pub mod glossary;
pub mod library;
pub mod machine;
pub mod mistake;
pub mod placed;
pub mod plot_setup;
pub mod said;
#[expect(clippy::module_inception, reason = "the scene itself, beside what belongs to it")]
pub mod scene;
pub mod sheet;
pub mod views;
pub mod window;

pub use self::{glossary::*, library::*, plot_setup::*, scene::*, sheet::*, views::*, window::*};
pub use crate::question::{Finding, Fit, Recording, Reply, Request, TOPICS, Topic};
pub use machine::{Machine, ScaledMachine, Setting};
pub use mistake::FileMistake;
