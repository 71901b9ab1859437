//! A recorded motion, for tests of what is drawn of one.

use crate::numerics::elementary::{cos, exp, sin};

/// A decay with D = 0.02 and r = 0.05 at 10/s, without noise except for rounding to three decimals.
pub(crate) fn record() -> String {
    let (decay, mut text) = (exp(-std::f64::consts::PI * 0.02 / 0.9998), String::new());
    let (mut from, mut side, mut t) = (3.0_f64, 1.0, 0.0);
    let root = (1.0_f64 - 0.02 * 0.02).sqrt();
    while from > 0.05 {
        for step in 0..20 {
            let tau = std::f64::consts::PI / root * f64::from(step) / 20.0;
            let swing = exp(-0.02 * tau) * (cos(root * tau) + 0.02 / root * sin(root * tau));
            let x = side * ((from - 0.05) * swing + 0.05);
            text += &format!("{:.5},{x:.3}\n", (t + tau) / 10.0);
        }
        t += std::f64::consts::PI / root;
        (from, side) = ((from - 0.05) * decay - 0.05, -side);
    }
    format!("time [s],displacement [mm]\n{text}")
}
