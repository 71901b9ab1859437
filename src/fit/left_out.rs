//! Where in a record the samples lie that do not count in its fit.

use serde::Serialize;

use super::estimate::Estimate;
use super::observation::Data;
use super::record::Record;

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
    let Data::Samples { t, .. } = &estimate.data else { return Vec::new() };
    let counted = t.iter().zip(&estimate.used).filter(|(_, used)| **used).map(|(t, _)| *t);
    between(record.t.as_deref().unwrap_or_default(), counted)
}

/// Stretches of the times `all` that are not `counted`.
fn between(all: &[f64], counted: impl Iterator<Item = f64>) -> Vec<LeftOut> {
    let mut counted = counted.peekable();
    let mut found: Vec<LeftOut> = Vec::new();
    let mut since = 0;
    for &t in all {
        if counted.next_if_eq(&t).is_some() {
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
        let all: Vec<f64> = (0..12).map(f64::from).collect();
        let counted = [2, 3, 5, 8, 9, 10, 11].map(f64::from);
        let stretch = |from: i32, to: i32, samples| LeftOut {
            from: f64::from(from),
            to: f64::from(to),
            samples,
        };
        let found = between(&all, counted.into_iter());
        assert_eq!(found, [stretch(0, 1, 2), stretch(4, 7, 3)]);
        assert_eq!(between(&all, all.iter().copied()), []);
        assert_eq!(between(&all, [].into_iter()), [stretch(0, 11, 12)]);
    }
}
