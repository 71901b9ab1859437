//! How motions end.

use super::number::significant;
use crate::flow::{Outcome, Trajectory};

/// How a motion ended, in a sentence.
pub fn sentence(motion: &Trajectory) -> String {
    let swings = swings(motion);
    let three = |value| significant(value, 3);
    match motion.outcome {
        Outcome::Captured { q, .. } if motion.crossings.is_empty() => {
            format!("at rest at q = {} from the start", three(q))
        }
        Outcome::Captured { tau, q } => {
            format!("comes to rest at q = {}{swings}, tau = {}", three(q), three(tau))
        }
        Outcome::Moving { tau, q, v } => {
            format!("moving at tau = {}{swings}: q = {}, v = {}", three(tau), three(q), three(v))
        }
        Outcome::Escaped { tau } => {
            format!("escapes at tau = {}{swings}", significant(tau, 4))
        }
        Outcome::GaveUp { tau, reason } => {
            format!("gave up at tau = {}{swings}: {reason}", three(tau))
        }
    }
}

/// ` after 3 half swings`; empty if there were none.
pub fn swings(motion: &Trajectory) -> String {
    match motion.crossings.len() {
        0 => String::new(),
        1 => " after 1 half swing".to_owned(),
        number => format!(" after {number} half swings"),
    }
}
