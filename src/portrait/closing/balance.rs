//! The closing of a cycle weighed as energy, for cycles whose multiplier is close to 1.
//!
//! As `D -> 0-` one turn changes the amplitude only by a factor of `1 + 2 pi abs(D)`, and the difference of two
//! turning points keeps as few digits. The works over the turn keep all of theirs. With
//! `K = (v^2/2 + x/(2 D2) - 1/(4 D2^2)) exp(2 D2 x)` (the first integral of the motion with D2 alone)
//! `K' = -exp(2 D2 x) (2 D v^2 + D3 v^4)`, so that D2 itself, which takes on one side what it gives on
//! the other, drops out; with D2 = 0, K is the energy. On `v = 0`, `dK/dx = x exp(2 D2 x)`. Adding both
//! swings of a turn, what friction takes must equal what the damping gives:
//!
//! `integral of x exp(2 D2 x) over [c1, c1 + 2 r] + integral of x exp(-2 D2 x) over [c0, c0 + 2 r] = W`

use super::{Direction, Equation, HalfMap, HalfSwing, Length, SwingPair, UNIT};
use crate::flow::{Limits, Result, StepPoint, Stepper};
use crate::model::{HalfPlane, PlaneField};
use crate::numerics::{GAUSS, exp, exponent, gauss, ln_1p, times_power};

/// A residual weighed as energy, and a bound on its error.
pub type Weighed = (f64, f64);

/// The pair of swings at `u = ln c0`, and its residual on [`super::equation::Route::Mixed`] with the digits that a
/// difference would lose.
///
/// Beside it a bound on its error: each work is known to rounding. `None` where a swing does not end, or where D2
/// differs by side: it then does not give in one swing what it takes in the other.
pub fn weighed_closing(equation: &mut Equation, u: f64) -> Result<Option<(SwingPair, Weighed)>> {
    if !equation.is_of_one_motion() {
        return Ok(None);
    }
    let gap = 2.0 * equation.parameters.r;
    let start = Length::from_log(u);
    // Squares of lengths leave the range of numbers long before lengths do: all in units of the start.
    let unit = exponent(start.value);
    let limits = equation.limits;
    let forward = equation.map(0, Direction::Forward);
    let d2 = times_power(forward.field.d2, unit);
    let (first, gained) = weigh(forward, start, unit, &limits)?;
    if !first.arrives() {
        return Ok(None);
    }
    // Run backward, positions and damping change their signs; the work is that of the motion forward.
    let backward = equation.map(1, Direction::Backward);
    let (second, lost) = weigh(backward, start.plus(gap), unit, &limits)?;
    if !second.arrives() {
        return Ok(None);
    }
    let closing = equation.pair(start, first, second);
    let [start, second, gap] =
        [start.value, second.end.value, gap].map(|length| times_power(length, -unit));
    let taken = friction(second, gap, d2) + friction(start, gap, -d2);
    let target = second + gap;
    let weight = target * target * exp(2.0 * d2 * target);
    let excess = (gained - lost - taken) / weight;
    let noise = UNIT * (gained.abs() + lost.abs() + taken) / weight;
    Ok(Some((closing, (ln_1p(excess), noise))))
}

/// Swings and integrates `-exp(2 D2 x) (2 D v^2 + D3 v^4)`, lengths measured in units of `2^measure`.
fn weigh(
    map: &mut HalfMap,
    start: Length,
    measure: i32,
    limits: &Limits,
) -> Result<(HalfSwing, f64)> {
    let HalfPlane { d, d2, d3 } = map.field.in_units(measure);
    let mut gained = 0.0;
    // Every part of the swing counts: none may be skipped by a closed form.
    let skipped = std::mem::replace(&mut map.linear_below, 0.0);
    let swing = map.swing_watched(start, true, limits, |stepper, unit, duration| {
        for &(node, weight) in &GAUSS {
            let StepPoint { x, v } = stepper.at(node * duration).times_power(unit - measure);
            let square = v * v;
            gained -= weight * duration * exp(2.0 * d2 * x) * square * (2.0 * d + d3 * square);
        }
    });
    map.linear_below = skipped;
    Ok((swing?, gained))
}

/// The integral of `x exp(2 d2 x)` over `[start, start + gap]`: what friction takes between two swings.
fn friction(start: f64, gap: f64, d2: f64) -> f64 {
    gap * gauss(|part| {
        let x = start + part * gap;
        x * exp(2.0 * d2 * x)
    })
}
