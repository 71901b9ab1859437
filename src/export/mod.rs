//! Answers and screens as text: JSON, CSV, aligned tables, SVG. Draws what it is given, decides nothing.

pub mod balance;
pub mod belt;
pub mod claims;
pub mod csv;
pub mod extreme_cycles;
pub mod extremes;
pub mod figure;
pub mod fit;
pub mod guarantee;
pub mod json;
pub mod kicks;
mod proof;
pub mod provenance;
pub mod scan;
pub mod scene_cost;
pub mod screen;
pub mod table;
pub mod trade;
