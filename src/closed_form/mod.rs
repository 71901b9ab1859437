//! What the paper gives in formulas, corrected and numerically safe.

pub mod harmonic;
