//! Measuring how long a computation takes.

use std::hint::black_box;
use std::time::Instant;

/// Computes `times` times (at least once); returns the last answer and the median time in seconds.
pub fn timed<T>(times: u32, mut compute: impl FnMut() -> T) -> (T, f64) {
    let mut once = || {
        let started = Instant::now();
        let answer = black_box(compute());
        (answer, started.elapsed().as_secs_f64())
    };
    let (mut answer, first) = once();
    let mut seconds = vec![first];
    for _ in 1..times {
        let (again, next) = once();
        answer = again;
        seconds.push(next);
    }
    (answer, median(&mut seconds))
}

/// If no number of repetitions is asked for, a computation is measured this often, so that one disturbed measurement
/// does not affect the median, unless that takes more than [`LONG`].
const ROUNDS: usize = 5;

/// Time in seconds after which a computation is not measured again unasked.
const LONG: f64 = 0.5;

/// A computation that takes less than this many seconds is measured over as many runs as take this long, after one that
/// warms the caches: a single run of a short computation is unreliable.
const SHORT: f64 = 1e-3;

/// The median times in seconds of `count` computations. Each is measured `times` times, or if that is 1, as
/// [`ROUNDS`] says.
///
/// The computations take turns, so that other load on the machine disturbs all of them alike.
pub fn in_turn<T>(times: u32, count: usize, mut compute: impl FnMut(usize) -> T) -> Vec<f64> {
    let mut seconds = vec![Vec::new(); count];
    let rounds = if times > 1 { times as usize } else { ROUNDS };
    for _ in 0..rounds {
        for (index, seconds) in seconds.iter_mut().enumerate() {
            if times > 1 || seconds.iter().sum::<f64>() < LONG {
                seconds.push(settled(|| compute(index)));
            }
        }
    }
    seconds.iter_mut().map(|seconds| median(seconds)).collect()
}

/// The time of a computation in seconds; that of a short one is the mean of several runs.
fn settled<T>(mut compute: impl FnMut() -> T) -> f64 {
    let (_, cold) = timed(1, &mut compute);
    if cold >= SHORT {
        return cold;
    }
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "at most 1000")]
    let times = (SHORT / cold.max(1e-9)).ceil().min(1000.0) as u32;
    let started = Instant::now();
    for _ in 0..times {
        black_box(compute());
    }
    started.elapsed().as_secs_f64() / f64::from(times)
}

/// The median; of an even number of values, the mean of the middle two.
fn median(values: &mut [f64]) -> f64 {
    values.sort_by(f64::total_cmp);
    let middle = values.len() / 2;
    if values.len() % 2 == 1 { values[middle] } else { 0.5 * (values[middle - 1] + values[middle]) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_median_ignores_outliers() {
        assert_eq!(median(&mut [1e9, 2.0, 1.0]), 2.0);
        assert_eq!(median(&mut [4.0, 1.0, 2.0, 1e9]), 3.0);
    }

    #[test]
    fn every_repetition_computes() {
        let mut count = 0;
        let (last, _) = timed(5, || {
            count += 1;
            count
        });
        assert_eq!((last, count), (5, 5));
    }
}
