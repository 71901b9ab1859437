//! The screen: a session, drawn.
//!
//! [`frame::picture`] is the only way in. It divides the screen ([`layout`]); [`paint`] draws the
//! [`crate::picture`] of each plot into its part with the help of [`plot`] and [`pane`]. How things look is
//! decided in [`look`] alone.

pub mod caption;
mod compare;
pub mod dots;
pub mod energy_ledger;
pub mod explain;
mod fitted;
pub mod footer;
pub mod frame;
mod gauge;
mod help;
pub mod layout;
mod lecture;
pub mod legend;
pub mod lists;
pub mod look;
mod margin;
mod number_line;
pub mod paint;
pub mod pane;
pub mod parameters;
pub mod playback;
pub mod plot;
pub mod scan;
mod scan_map;
pub mod screen;
mod signs;
pub mod status;
pub mod trade_plot;
pub mod verdict;

pub use frame::{panels, picture, place};
pub use look::Look;
pub use pane::Surface;
