//! Damping over amplitude from the decrements of successive turning points.
//!
//! Averaging the energy over a half swing of amplitude A gives the relative loss of amplitude per unit of time
//!
//! `delta(A) = D + 2 r/(pi A) + (3/8) D3 A^2`,
//!
//! so half peak-to-peak values `P` fall by `P_k - P_{k+1} = pi A delta(A)`, which is linear in r, D and D3 and
//! independent of the offset. D2 shifts the midpoints of the swings:
//! `(x_k + 2 x_{k+1} + x_{k+2})/4 = offset - (2/3) D2 A^2`.

use std::f64::consts::PI;

use nalgebra::{DMatrix, DVector};

use super::{D, D2, D3, Extreme, OFFSET, R, UNKNOWNS, Unknowns, robust_deviation};
use crate::model::Parameters;
use crate::numerics::elementary::powi;

/// The relative loss of amplitude per unit of time by averaging.
pub fn averaged(parameters: &Parameters, amplitude: f64) -> f64 {
    let Parameters { d, d3, r, .. } = *parameters;
    d + 2.0 * r / (PI * amplitude) + 0.375 * d3 * amplitude * amplitude
}

/// Sets of terms that are fitted to the decrements, as indices into r, D, D3. A fit of few terms cannot go far
/// wrong if the motion hardly decays.
const TERMS: [&[usize]; 4] = [&[0, 1, 2], &[0, 1], &[1, 2], &[1]];

/// The unknowns with damping, friction and offset from the turning points, one result for each of `TERMS` that can be
/// fitted; of a single swing one for each of several intensities of friction. Empty for fewer than two turning points.
pub fn regressions(extremes: &[Extreme]) -> Vec<Unknowns> {
    let largest =
        extremes.windows(2).map(|two| 0.5 * (two[1].x - two[0].x).abs()).fold(0.0, f64::max);
    if largest <= 0.0 || extremes.len() < 2 {
        return Vec::new();
    }
    if let [one, other] = extremes {
        return of_one_swing(one.x, other.x);
    }
    // In units of the largest amplitude, so that the columns have similar norms.
    let unit: Vec<Extreme> =
        extremes.iter().map(|it| Extreme { x: (it.x - extremes[0].x) / largest, ..*it }).collect();
    let mut found = Vec::new();
    for terms in TERMS {
        let Some([r, d, d3]) = damping(&unit, terms) else { continue };
        let Some((offset, d2)) = middle(&unit, d) else { continue };
        let mut p = [0.0; UNKNOWNS];
        (p[D], p[D2], p[D3]) = (d, d2 / largest, d3 / (largest * largest));
        (p[R], p[OFFSET]) = (r * largest, extremes[0].x + offset * largest);
        found.push(p);
    }
    found
}

/// A single swing tells offset and friction only together: `x_0 + x_1 = 2 (offset + r)` if it begins on the right.
fn of_one_swing(begin: f64, end: f64) -> Vec<Unknowns> {
    /// Intensities of friction as parts of the amplitude.
    const PARTS: [f64; 6] = [0.02, 0.05, 0.1, 0.15, 0.2, 0.3];
    /// Moderate damping.
    const DAMPING: f64 = 0.02;
    let of = |part: f64| {
        let right = 0.5 * part * (begin - end);
        let mut p = [0.0; UNKNOWNS];
        (p[D], p[R], p[OFFSET]) = (DAMPING, right.abs(), 0.5 * (begin + end) - right);
        p
    };
    PARTS.map(of).to_vec()
}

/// r, D and D3 from the decrements; `None` for fewer decrements than terms, or if the friction is negative.
fn damping(extremes: &[Extreme], terms: &[usize]) -> Option<[f64; 3]> {
    let halves: Vec<f64> =
        extremes.windows(2).map(|two| 0.5 * (two[1].x - two[0].x).abs()).collect();
    let row = |a: f64| [2.0, PI * a, 0.375 * PI * a * a * a];
    let rows: Vec<(Vec<f64>, f64)> = halves
        .windows(2)
        .map(|two| {
            let row = row(0.5 * (two[0] + two[1]));
            (terms.iter().map(|&term| row[term]).collect(), two[0] - two[1])
        })
        .collect();
    if rows.len() < terms.len() {
        return None;
    }
    let mut found = [0.0; 3];
    for (&term, value) in terms.iter().zip(robust(&rows)?.iter()) {
        found[term] = *value;
    }
    (found[0] >= 0.0).then_some(found)
}

/// Offset and D2 from the midpoints. Strong damping itself shifts the midpoints; D2 is then 0.
fn middle(extremes: &[Extreme], d: f64) -> Option<(f64, f64)> {
    let rows: Vec<(Vec<f64>, f64)> = extremes
        .windows(3)
        .map(|three| {
            let amplitude = 0.25 * (2.0 * three[1].x - three[0].x - three[2].x).abs();
            let middle = 0.25 * (three[0].x + 2.0 * three[1].x + three[2].x);
            (vec![1.0, -2.0 / 3.0 * amplitude * amplitude], middle)
        })
        .collect();
    if rows.len() >= 4 && d.abs() < 0.1 {
        let found = robust(&rows)?;
        return Some((found[0], found[1]));
    }
    let narrow: Vec<_> = rows.iter().map(|(row, middle)| (vec![row[0]], *middle)).collect();
    Some((robust(&narrow)?[0], 0.0))
}

/// Linear regression with iterated Cauchy weights, since one wrong extreme spoils three decrements.
pub fn robust(rows: &[(Vec<f64>, f64)]) -> Option<DVector<f64>> {
    const ROUNDS: usize = 12;
    let width = rows.first()?.0.len();
    let mut weights = vec![1.0; rows.len()];
    let mut solution = None;
    for _ in 0..ROUNDS {
        let matrix = DMatrix::from_fn(rows.len(), width, |i, j| weights[i] * rows[i].0[j]);
        let right = DVector::from_fn(rows.len(), |i, _| weights[i] * rows[i].1);
        let found = matrix.svd(true, true).solve(&right, 1e-12).ok()?;
        let left: Vec<f64> = rows
            .iter()
            .map(|(row, value)| {
                value - row.iter().zip(found.iter()).map(|(a, b)| a * b).sum::<f64>()
            })
            .collect();
        let scale = 2.385 * robust_deviation(left.iter().copied());
        solution = Some(found);
        if scale <= 0.0 {
            break;
        }
        for (weight, left) in weights.iter_mut().zip(left) {
            *weight = (1.0 / (1.0 + powi(left / scale, 2))).sqrt();
        }
    }
    solution
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The turning points of an undamped mass with dry friction: each half swing loses exactly 2 r.
    fn coulomb(r: f64, offset: f64) -> Vec<Extreme> {
        let turn = |k: u32| {
            let sign = if k.is_multiple_of(2) { 1.0 } else { -1.0 };
            Extreme { t: PI * f64::from(k), x: offset + sign * (5.0 - 2.0 * r * f64::from(k)) }
        };
        (0..12).map(turn).collect()
    }

    #[test]
    fn dry_friction_alone_is_read_off_exactly_in_any_unit() {
        for unit in [1e-6, 1.0, 1e6] {
            let mut extremes = coulomb(0.125, 0.5);
            for extreme in &mut extremes {
                extreme.x *= unit;
            }
            let found = regressions(&extremes)[0];
            assert!((found[R] / (0.125 * unit) - 1.0).abs() < 1e-9, "{found:?}");
            assert!(found[D].abs() < 1e-9 && (found[D3] * unit * unit).abs() < 1e-9, "{found:?}");
            assert!((found[OFFSET] / (0.5 * unit) - 1.0).abs() < 1e-9, "{found:?}");
        }
    }

    #[test]
    fn one_wrong_turning_point_does_not_spoil_the_rest() {
        let mut extremes = coulomb(0.125, 0.5);
        extremes[5].x += 2.0;
        let found = regressions(&extremes)[0];
        assert!((found[R] - 0.125).abs() < 0.01, "{found:?}");
    }

    #[test]
    fn a_single_swing_tells_friction_and_offset_only_together() {
        for two in coulomb(0.125, 0.5).windows(2) {
            let found = regressions(two);
            let side = (two[0].x - two[1].x).signum();
            assert!(found.len() > 2);
            assert!(
                found
                    .iter()
                    .all(|it| (it[OFFSET] + side * it[R] - 0.5 - side * 0.125).abs() < 1e-12)
            );
        }
        assert!(regressions(&coulomb(0.1, 0.0)[..1]).is_empty());
        assert!(regressions(&[Extreme { t: 0.0, x: 1.0 }; 5]).is_empty());
    }
}
