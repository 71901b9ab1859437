//! The screen: a session, drawn.
//!
//! [`frame::draw`] is the only way in. It divides the screen ([`layout`]), and each view says what it
//! shows as a [`picture`], which [`paint`] puts into its part with the help of [`plot`] and [`pane`]. How things look is decided in [`look`] alone.

pub mod belt;
mod belt_path;
pub mod caption;
mod construction;
mod costs;
pub mod diagram;
pub mod dots;
pub mod eigenvalues;
pub mod energy_ledger;
pub mod energy_rate;
mod equilibria;
pub mod footer;
pub mod frame;
pub mod keys;
pub mod layout;
pub mod legend;
pub mod lists;
pub mod look;
pub mod number;
pub mod paint;
pub mod pane;
pub mod paper;
pub mod parameters;
pub mod phase_plane;
pub mod picture;
pub mod place;
pub mod plot;
pub mod quantity;
pub mod regimes;
pub mod return_map;
pub mod scan;
pub mod scan_form;
mod scan_map;
pub mod scan_table;
pub mod status;
pub mod ticks;
pub mod time_series;
pub mod trade;
mod walk;

#[cfg(test)]
mod tests;

pub use frame::{draw, panels};
pub use look::Look;
pub use place::place;
