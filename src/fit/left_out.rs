//! Which samples of a record do not count in its fit, and why.

use serde::Serialize;

use super::{Estimate, Record};

/// Samples that do not count, with at most one between two of them that does.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct LeftOut {
    /// Time of the first, in s.
    pub from: f64,
    /// Time of the last, in s.
    pub to: f64,
    /// Their number.
    pub samples: usize,
}

/// All samples of a record that do not count, in the order of their times; none for a list of peaks.
#[must_use]
pub fn left_out(record: &Record, estimate: &Estimate) -> Vec<LeftOut> {
    if estimate.data.has_peaks() {
        return Vec::new();
    }
    let counts = estimate.dropped.iter().map(Option::is_none);
    stretches(record.t.iter().flatten().copied().zip(counts))
}

/// Stretches of the times of samples that do not count.
fn stretches(samples: impl Iterator<Item = (f64, bool)>) -> Vec<LeftOut> {
    let mut found: Vec<LeftOut> = Vec::new();
    let mut since = 0;
    for (t, counts) in samples {
        if counts {
            since += 1;
            continue;
        }
        match found.last_mut() {
            Some(last) if since <= 1 => (last.to, last.samples) = (t, last.samples + 1),
            _ => found.push(LeftOut { from: t, to: t, samples: 1 }),
        }
        since = 0;
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn samples_that_do_not_count_are_found_in_stretches() {
        let of =
            |counted: &[u8]| stretches((0..12_u8).map(|t| (f64::from(t), counted.contains(&t))));
        let stretch = |from: i32, to: i32, samples| LeftOut {
            from: f64::from(from),
            to: f64::from(to),
            samples,
        };
        assert_eq!(of(&[2, 3, 5, 8, 9, 10, 11]), [stretch(0, 1, 2), stretch(4, 7, 3)]);
        assert_eq!(of(&(0..12).collect::<Vec<u8>>()), []);
        assert_eq!(of(&[]), [stretch(0, 11, 12)]);
    }
}
