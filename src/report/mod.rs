//! Answers as readable text, as comma-separated values, as JSON and as pages to sign; one file for each subject.
//!
//! Each subject tells its rows once, as [`columns`], and gives an [`Answer`]; [`json`], [`table`] and [`page`] write it in
//! its forms.

pub mod answer;
pub mod branch;
pub mod claims;
pub mod columns;
mod cycle_numbers;
pub mod cycles;
pub mod extremes;
pub mod fit;
pub mod json;
pub mod level;
pub mod machine;
pub mod margin;
pub mod motion;
pub mod page;
pub mod proof;
pub mod scan;
pub mod scenes;
pub mod shown;
pub mod table;

pub use self::{answer::*, columns::*, json::*, proof::*, table::*};
