//! Pseudo-random numbers for simulated noise: the same on every machine.

use std::f64::consts::TAU;

use super::{amount, cos, ln};

/// A stream of numbers (splitmix64).
#[derive(Clone, Debug)]
pub struct Random {
    state: u64,
}

impl Random {
    /// The stream for this seed.
    pub fn new(seed: u64) -> Self {
        Random { state: seed }
    }

    /// A number uniformly distributed over (0, 1).
    pub fn even(&mut self) -> f64 {
        self.state = self.state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut mixed = self.state;
        mixed = (mixed ^ (mixed >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        mixed ^= mixed >> 31;
        // 53 bits fit.
        (amount(mixed >> 11) + 0.5) / 9_007_199_254_740_992.0
    }

    /// A number normally distributed with mean 0 and standard deviation 1 (Box and Muller).
    pub fn normal(&mut self) -> f64 {
        (-2.0 * ln(self.even())).sqrt() * cos(TAU * self.even())
    }
}
