//! The escape point, enclosed in a parameter: where the cycle that bounds the basin reaches infinity.
//!
//! For `D3 = 0`, `D2 != 0` one half map has a last clearance `z_c`, beyond which no motion returns, and the
//! other maps even infinity to a finite clearance B. Where `B > z_c` the return map is above the diagonal just
//! below `z_c` and below it near the sticking set, so there is a cycle between. It reaches infinity where
//! `B = z_c` (lemma 20).

use super::bracket::bracket;
use super::field::{Field, ParameterBox};
use super::funnel::Funnel;
use super::swing::{Passage, StartBox, swing};
use crate::model::{Knob, Side};
use crate::numerics::Interval;

/// Encloses the value of the parameter `symbol` (D, D2 or r) near `near` at which a cycle escapes to infinity,
/// for `D3 = 0`. The other parameters are those of `parameters`, which may be intervals. `None` where nothing
/// could be proved.
pub fn enclose_escape(parameters: &ParameterBox, symbol: Knob, near: f64) -> Option<Interval> {
    bracket(near, |at| returns_from_infinity(&parameters.with(symbol, Interval::point(at))))
}

/// Whether the half swing after one from infinity returns; `None` where that is not certain.
pub fn returns_from_infinity(parameters: &ParameterBox) -> Option<bool> {
    let d2 = parameters.d2;
    let (strong, weak) = if d2.lower() > 0.0 {
        (Side::Upper, Side::Lower)
    } else if d2.upper() < 0.0 {
        (Side::Lower, Side::Upper)
    } else {
        return None;
    };
    if parameters.d3 != Interval::point(0.0) || !(parameters.r.lower() >= 0.0) {
        return None;
    }
    let funnel = Funnel::new(&Field::new(parameters, strong), &mut 0)?;
    let bounds = [funnel.least(), funnel.greatest()];
    if !bounds.iter().all(|it| it.is_finite()) {
        return None;
    }
    let start = Interval::new(bounds[0], bounds[1]) - parameters.r.twice();
    if start.upper() <= 0.0 {
        return Some(true);
    }
    let field = Field::new(parameters, weak);
    let run =
        |field: &Field, from: f64| swing(field, &StartBox::at_rest(Interval::point(from)), false);
    // Either the nearest start escapes under the strongest damping, or the farthest start returns under the weakest.
    if start.lower() > 0.0 && run(&field.strongest(), start.lower()) == Passage::Never {
        return Some(false);
    }
    matches!(run(&field.weakest(), start.upper()), Passage::Arrives(_)).then_some(true)
}
