//! Which samples of a record do not count in its fit, and why.

use super::estimate::Estimate;
use super::noise::IMPOSSIBLE;
use super::observation::Data;
use super::record::Record;

/// Why a sample does not count.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Dropped {
    /// It cannot belong to the motion.
    Outlier,
    /// It is flattened at full scale, or next to such samples.
    Saturated,
    /// The mass had not yet been struck.
    Before,
    /// The mass had been excited again.
    After,
    /// It lies next to a jump of an acceleration.
    Jump,
    /// At rest, it only repeats the rounding error of others.
    Alike,
}

/// Why a sample of the data of an estimate does not count; `None` if it does.
pub fn dropped_of_fitted(estimate: &Estimate, index: usize) -> Option<Dropped> {
    let limit = IMPOSSIBLE * estimate.covariance.deviation;
    let alike = estimate.alike > 0 && estimate.residuals[index].abs() <= limit;
    let why = match alike {
        _ if estimate.jumps.binary_search(&index).is_ok() => Dropped::Jump,
        true => Dropped::Alike,
        false => Dropped::Outlier,
    };
    (!estimate.used[index]).then_some(why)
}

/// For each sample of a record why it does not count; `None` if it does.
pub fn dropped(record: &Record, estimate: &Estimate) -> Vec<Option<Dropped>> {
    let (t, x) = match &estimate.data {
        Data::Samples { t, x, .. } => (t, x),
        Data::Peaks { x, .. } => {
            return (0..x.len()).map(|index| dropped_of_fitted(estimate, index)).collect();
        }
    };
    let (first, last) = (t[0], t[t.len() - 1]);
    let mut left = t.iter().zip(x).enumerate().peekable();
    let all = record.t.iter().flatten().zip(&record.x);
    all.map(|(at, value)| match left.next_if(|(_, (t, x))| (*t, *x) == (at, value)) {
        Some((index, _)) => dropped_of_fitted(estimate, index),
        None if estimate.before > 0 && *at < first => Some(Dropped::Before),
        None if estimate.after > 0 && *at > last => Some(Dropped::After),
        None => Some(Dropped::Saturated),
    })
    .collect()
}
