//! Answers as readable text, as comma-separated values, as JSON and as pages to sign; one file for each subject.
//!
//! Each subject tells its rows once, as [`columns`]; [`csv`], [`json`], [`table`] and [`page`] write them in their
//! forms.

pub mod basin;
pub mod belt;
pub mod border;
pub mod branch;
pub mod certified;
pub mod claims;
pub mod columns;
pub mod csv;
mod cycle_numbers;
pub mod cycles;
pub mod extreme_cycles;
pub mod extremes;
pub mod fit;
pub mod guarantee;
pub mod harmonic_balance;
pub mod json;
pub mod kicks;
pub mod machine;
pub mod machine_branch;
pub mod machine_motion;
pub mod page;
mod proof;
pub mod scan;
pub mod scene_cost;
pub mod scenes;
pub mod table;
pub mod trade;
pub mod trajectory;
