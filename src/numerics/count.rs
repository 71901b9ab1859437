//! Conversion between counts and real numbers, places in a circle, order by a number, and counting things once.

use std::borrow::Borrow;
use std::cmp::Ordering;

/// A count as a double. Exact below `2^53`, which no count here reaches.
#[expect(clippy::cast_precision_loss, reason = "counts are below 2^53")]
pub const fn real(count: usize) -> f64 {
    count as f64
}

/// A count of 64 bits as a double, exact below `2^53`, too.
#[expect(clippy::cast_precision_loss, reason = "counts are below 2^53")]
pub const fn amount(count: u64) -> f64 {
    count as f64
}

/// The integer part of a number; 0 for negative numbers and NaN.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "it saturates")]
pub fn truncated(number: f64) -> usize {
    number as usize
}

/// The reciprocals of `0 .. N`, with 0 for that of 0.
pub const fn reciprocals<const N: usize>() -> [f64; N] {
    let mut table = [0.0; N];
    let mut k = 1;
    while k < N {
        table[k] = 1.0 / real(k);
        k += 1;
    }
    table
}

/// The order of things by a number that each of them has.
pub fn by_number<T>(number: impl Fn(&T) -> f64) -> impl Fn(&T, &T) -> Ordering {
    move |one, other| number(one).total_cmp(&number(other))
}

/// The smallest and the largest of some numbers.
pub fn range(numbers: impl IntoIterator<Item: Borrow<f64>>) -> (f64, f64) {
    numbers.into_iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), number| {
        (low.min(*number.borrow()), high.max(*number.borrow()))
    })
}

/// The next place (`by` is 1), the previous one (-1) or the same (0) in a circle of `count` places, at least one, counted
/// from 0.
pub fn cycled(place: usize, by: isize, count: usize) -> usize {
    place.checked_add_signed(by).unwrap_or(count - 1) % count
}

/// Each of some things once, in the order in which they first appear.
pub fn distinct<T: PartialEq>(all: impl IntoIterator<Item = T>) -> Vec<T> {
    let mut found = Vec::new();
    for thing in all {
        if !found.contains(&thing) {
            found.push(thing);
        }
    }
    found
}
