//! Words for numbers, quantities and answers, the same on the screen, in tables and in figures.

pub mod claim;
pub mod measured;
pub mod motion;
pub mod number;
pub mod provenance;
pub mod quantity;

/// Whether something attracts.
pub fn stability(stable: bool) -> &'static str {
    if stable { "stable" } else { "unstable" }
}
