//! A change of verdict, narrowed from both sides as far as verdicts are certain.

use crate::numerics::Interval;
use crate::numerics::elementary::powi;

/// An interval near a guess in which a verdict changes: at its ends the verdict is certain and different.
///
/// Inside it may be uncertain (`None`); the ends are moved inward as far as practicable.
pub fn bracket<T: PartialEq>(
    near: f64,
    mut verdict: impl FnMut(f64) -> Option<T>,
) -> Option<Interval> {
    /// First distance from the guess relative to it, its growth factor, and the number of distances tried.
    const FIRST: f64 = 1e-15;
    const GROWTH: f64 = 8.0;
    const TIMES: i32 = 15;
    /// Attempts to move each end further in once an uncertain value was found.
    const CLOSER: usize = 4;
    let (mut low, mut high, kind) = (0..TIMES).find_map(|step| {
        let away = FIRST * powi(GROWTH, step) * near.abs();
        let kind = verdict(near - away)?;
        let other = verdict(near + away)?;
        (kind != other).then_some((near - away, near + away, kind))
    })?;
    let middle = |low: f64, high: f64| low + 0.5 * (high - low);
    loop {
        let at = middle(low, high);
        if !(at > low && at < high) {
            break;
        }
        match verdict(at) {
            Some(found) if found == kind => low = at,
            Some(_) => high = at,
            None => {
                let (mut from, mut to) = (at, at);
                for _ in 0..CLOSER {
                    let (left, right) = (middle(low, from), middle(to, high));
                    *(if verdict(left).is_some() { &mut low } else { &mut from }) = left;
                    *(if verdict(right).is_some() { &mut high } else { &mut to }) = right;
                }
                break;
            }
        }
    }
    Some(Interval::new(low, high))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_change_is_closed_in_as_far_as_it_is_certain() {
        let sign = |blur: f64| move |x: f64| (f64::abs(x - 2.0) > blur).then_some(x > 2.0);
        for blur in [0.0, 1e-13, 1e-9] {
            let found = bracket(2.0 * (1.0 + 3e-7), sign(blur)).unwrap();
            assert!(found.contains(2.0) && found.width() <= 3.0 * blur + 1e-15, "{blur} {found}");
        }
        assert!(bracket(1.0, sign(0.0)).is_none());
    }
}
