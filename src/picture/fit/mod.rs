//! What a recorded motion says, in pictures.

mod damping;
mod pictures;
mod pieces;
mod sampled;

pub use pictures::pictures;
