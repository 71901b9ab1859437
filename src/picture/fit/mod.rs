//! What a recorded motion says, in pictures.

mod damping;
pub mod dropped;
mod pictures;
mod pieces;

pub use damping::damping;
pub use pictures::{margin, pictures, residuals};
