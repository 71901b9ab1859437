//! The Galerkin equations of N harmonics, with the set-valued friction projected exactly, and their solution by
//! Newton's method, damped so that it cannot overshoot unnoticed.
//!
//! With the angle `t = eta tau`, what the ansatz (34) leaves of equation (4) is
//!
//! `R(t) = q + eta^2 q'' + 2 D eta p + D2 eta^2 p^2 + D3 eta^3 p^3 + r sign(p)`,  `p = q'(t)`,  `v = eta p`.
//!
//! R is made orthogonal to 1, `cos(k t)` and `sin(k t)` for `k <= N`. Where the angle begins is free,
//! which fixes `b_1 = 0` and makes the frequency eta an unknown in its place.
//!
//! No term is sampled. Powers of p are convolutions of coefficients. Friction is constant between the
//! sign changes of p, so that its projection is a sum over them; a sign change at `t_j` moves with the
//! unknowns by `-dp(t_j)/p'(t_j)`, which puts friction into the Jacobian in closed form too. On `v = 0`
//! itself friction is set-valued, but a trigonometric polynomial stands there for single instants only,
//! and these weigh nothing. Any number of sign changes is projected rightly; a cycle has two.

use std::f64::consts::PI;

use nalgebra::{Complex, ComplexField, DMatrix, DVector, Dyn, LU};

use super::{Fourier, SignChange, sign_changes};
use crate::model::{Parameters, Reason, Result};
use crate::numerics::{real, sin_cos};

/// An approximate cycle: its frequency and its displacement over one turn of the angle.
#[derive(Clone, Debug, PartialEq)]
pub struct Ansatz {
    /// Frequency eta.
    pub frequency: f64,
    /// Displacement q over the angle, with `b_1 = 0`.
    pub q: Fourier,
}

/// One unknown, and the equation of the same name.
#[derive(Clone, Copy, Debug)]
struct Unknown {
    harmonic: usize,
    /// What it adds to the coefficient of its harmonic: 1 for the mean A0, 1/2 for `a_k`, -i/2 for `b_k`.
    unit: Complex<f64>,
}

impl Unknown {
    /// Whether it is `b_1`, in place of which the frequency is unknown.
    fn is_frequency(self) -> bool {
        self.harmonic == 1 && self.unit.im != 0.0
    }

    /// Reads this equation out of the residual's coefficient of its harmonic: the residual weighted by 1,
    /// `cos(k t)` or `sin(k t)`.
    fn of(self, coefficient: Complex<f64>) -> f64 {
        (coefficient * self.unit.conj()).re / self.unit.norm_sqr()
    }
}

/// The residual at one ansatz, taken apart into what the equations and their derivatives need.
pub struct BalanceResidual {
    parameters: Parameters,
    /// The ansatz, with room for all N harmonics.
    pub ansatz: Ansatz,
    /// The powers of `p = q'(t)` from 0 to 3: the first as long as it is, the square up to harmonic `2 N`, the cube up
    /// to harmonic N.
    powers: [Fourier; 4],
    /// Where p changes its sign, so that the ansatz stands on `v = 0`, twice at a cycle; with `e^(i k t)` there for every
    /// harmonic k.
    pub crossings: Vec<(SignChange, Vec<Complex<f64>>)>,
}

impl BalanceResidual {
    /// The residual of an ansatz with `count` harmonics, of which those that are new are zero.
    pub fn new(parameters: &Parameters, count: usize, ansatz: &Ansatz) -> Self {
        let mut ansatz = ansatz.clone();
        ansatz.q.coefficients.resize(count + 1, Complex::default());
        let p = ansatz.q.derivative();
        let square = p.product(&p, 2 * count);
        let cube = square.product(&p, count);
        let waves = |change: SignChange| {
            let angles = (0..=count).map(|k| sin_cos(real(k) * change.angle));
            (change, angles.map(|(sin, cos)| Complex::new(cos, sin)).collect())
        };
        let crossings = sign_changes(&p).into_iter().map(waves).collect();
        let one = Fourier { coefficients: vec![Complex::from(1.0)] };
        let powers = [one, p, square, cube];
        BalanceResidual { parameters: *parameters, ansatz, powers, crossings }
    }

    /// The unknowns. For `D2 = 0` the oscillator is symmetric and its cycles have odd harmonics only; the others, and the
    /// mean, are then no unknowns at all and exactly zero.
    fn unknowns(&self) -> impl Iterator<Item = Unknown> {
        let odd = self.parameters.d2 == 0.0;
        let mean = (!odd).then_some(Unknown { harmonic: 0, unit: Complex::from(1.0) });
        let units = [Complex::from(0.5), Complex::new(0.0, -0.5)];
        let harmonics = (1..=self.ansatz.q.degree()).step_by(if odd { 2 } else { 1 });
        let both = harmonics.flat_map(move |harmonic| units.map(|unit| Unknown { harmonic, unit }));
        mean.into_iter().chain(both)
    }

    /// The ansatz with `part` of a change of the unknowns added.
    fn moved(&self, changes: &DVector<f64>, part: f64) -> Ansatz {
        let mut to = self.ansatz.clone();
        for (unknown, change) in self.unknowns().zip(changes.iter()) {
            if unknown.is_frequency() {
                to.frequency += part * change;
            } else {
                to.q.coefficients[unknown.harmonic] += unknown.unit * (part * change);
            }
        }
        to
    }

    /// What every equation leaves.
    fn values(&self) -> DVector<f64> {
        let values =
            self.unknowns().map(|equation| equation.of(self.coefficient(equation.harmonic)));
        DVector::from_vec(values.collect())
    }

    /// The largest of what the equations leave, relative to the largest term in them.
    pub fn relative(&self) -> f64 {
        let largest =
            |it: &Fourier| it.coefficients.iter().map(|c| c.modulus()).fold(0.0, f64::max);
        let sizes = self.factors().into_iter().zip(&self.powers[1..]);
        let sizes = sizes.map(|(factor, power)| factor.abs() * largest(power));
        let terms = sizes.chain([largest(&self.ansatz.q)]);
        self.values().amax() / terms.fold(self.parameters.r, f64::max)
    }

    /// The factors of p, its square and its cube in the damping.
    fn factors(&self) -> [f64; 3] {
        let (Parameters { d, d2, d3, .. }, eta) = (self.parameters, self.ansatz.frequency);
        [2.0 * d * eta, d2 * eta * eta, d3 * eta * eta * eta]
    }

    /// Coefficient `k` of the damping, with each power of p lowered by this many and its factor weighted.
    fn damping(&self, k: isize, lowered: usize, weight: impl Fn(usize) -> f64) -> Complex<f64> {
        let terms = (1..).zip(self.factors());
        let term = |(power, factor): (usize, f64)| {
            self.powers[power - lowered].coefficient(k) * (weight(power) * factor)
        };
        terms.map(term).sum()
    }

    /// Derivatives of every equation (rows) by every unknown (columns).
    fn jacobian(&self) -> DMatrix<f64> {
        // The derivative of the damping by p: `2 D eta + 2 D2 eta^2 p + 3 D3 eta^3 p^2`.
        let slope =
            (0..=2 * self.ansatz.q.degree()).map(|k| self.damping(k.cast_signed(), 1, real));
        let slope = Fourier { coefficients: slope.collect() };
        let size = self.unknowns().count();
        let mut jacobian = DMatrix::zeros(size, size);
        for (mut column, unknown) in jacobian.column_iter_mut().zip(self.unknowns()) {
            // The equations weighted by cosine and sine stand together and read one coefficient.
            let mut last = (usize::MAX, Complex::default());
            for (cell, equation) in column.iter_mut().zip(self.unknowns()) {
                let m = equation.harmonic;
                if last.0 != m {
                    last = (m, self.by_unknown(&slope, unknown, m));
                }
                *cell = equation.of(last.1);
            }
        }
        jacobian
    }

    /// Coefficient `k` of the residual.
    fn coefficient(&self, k: usize) -> Complex<f64> {
        let m = k.cast_signed();
        let spring = self.ansatz.q.coefficient(m) * spring_and_inertia(self.ansatz.frequency, k);
        spring + self.damping(m, 0, |_| 1.0) + self.sign(k) * self.parameters.r
    }

    /// Coefficient `k` of `sign(p)`, which is constant between the sign changes.
    fn sign(&self, k: usize) -> Complex<f64> {
        let Some((last, _)) = self.crossings.last() else {
            // The mean of p is zero, so that it changes its sign unless it is zero everywhere: rest, where
            // friction balances whatever it can and is given no preference here.
            return Complex::default();
        };
        if k == 0 {
            // The sign before the first change is that after the last; from each change on it is another one.
            let changes = self.crossings.iter().map(|(it, _)| it.direction * it.angle);
            return Complex::from(last.direction - changes.sum::<f64>() / PI);
        }
        let jumps = self.crossings.iter().map(|(it, waves)| waves[k].conj() * it.direction);
        jumps.sum::<Complex<f64>>() / Complex::new(0.0, PI * real(k))
    }

    /// Change of coefficient `m` of the residual with an unknown: coefficient `k` of q changes by its unit, and
    /// coefficient `-k` by the conjugate; or the frequency.
    fn by_unknown(&self, slope: &Fourier, unknown: Unknown, m: usize) -> Complex<f64> {
        let Unknown { harmonic: k, unit } = unknown;
        let (row, column) = (m.cast_signed(), k.cast_signed());
        let eta = self.ansatz.frequency;
        if unknown.is_frequency() {
            let inertia = self.ansatz.q.coefficient(row) * (-2.0 * eta * real(m) * real(m));
            return inertia + self.damping(row, 0, |power| real(power) / eta);
        }
        let speed = unit * Complex::new(0.0, real(k));
        let mut change = slope.coefficient(row - column) * speed
            + slope.coefficient(row + column) * speed.conj();
        if m == k {
            change += unit * spring_and_inertia(eta, k);
        }
        let friction = self.crossings.iter().map(|(change, waves)| {
            let moved = 2.0 * (speed * waves[k]).re / change.slope.abs();
            waves[m].conj() * moved
        });
        change + friction.sum::<Complex<f64>>() * (self.parameters.r / PI)
    }
}

/// `1 - (k eta)^2`, with the digits that the difference would lose near resonance.
fn spring_and_inertia(eta: f64, k: usize) -> f64 {
    let speed = eta * real(k);
    (1.0 - speed) * (1.0 + speed)
}

/// A change of the unknowns below which Newton's next step is below rounding.
const SETTLED: f64 = 1e-12;

/// Solves the Galerkin equations of `count` harmonics near `start`.
///
/// A step is damped until the next one, taken with the same Jacobian, is shorter (the natural
/// monotonicity test, which does not depend on how the equations are scaled). Whether to stop is asked
/// before each step.
///
/// The solution comes with whether the determinant of its Jacobian is positive. It vanishes where two solutions
/// meet, and every further harmonic multiplies it by about `(1 - k^2 eta^2)^2 + (2 D k eta)^2`, which is
/// positive: so its sign is that of one harmonic, `2 D + (9/4) D3 A^2` with the sign changed, and tells unstable
/// solutions from stable ones.
///
/// # Errors
/// [`Reason`] says why it found no solution: [`Reason::Harmonics`] with a strength of 1 where the iteration does not settle.
pub fn solve(
    parameters: &Parameters,
    count: usize,
    start: &Ansatz,
    interrupted: &dyn Fn() -> bool,
) -> Result<(BalanceResidual, bool)> {
    /// Newton steps before giving up; sharp kinks need 20.
    const ITERATIONS: usize = 60;
    /// Smallest fraction of a step that is tried.
    const SMALLEST_PART: f64 = 1e-3;
    let unsettled = Reason::Harmonics { count, strength: 1.0 };
    let mut residual = BalanceResidual::new(parameters, count, start);
    let mut part: f64 = 1.0;
    for _ in 0..ITERATIONS {
        if interrupted() {
            return Err(Reason::Interrupted);
        }
        let jacobian = residual.jacobian().lu();
        let step = newton_step(&jacobian, &residual)?.ok_or(unsettled)?;
        // Relative to the amplitude, or to the frequency, about 1 and smaller.
        let change = step.amax() / residual.ansatz.q.cosine(1).abs().max(1.0);
        part = (4.0 * part).min(1.0);
        loop {
            let next = BalanceResidual::new(parameters, count, &residual.moved(&step, part));
            let shorter = matches!(newton_step(&jacobian, &next), Ok(Some(next))
                if next.amax() <= (1.0 - 0.25 * part) * step.amax());
            if shorter || change < SETTLED {
                residual = next;
                break;
            }
            part *= 0.5;
            if part < SMALLEST_PART {
                return Err(unsettled);
            }
        }
        if change < SETTLED {
            let unstable = has_positive_determinant(&residual.jacobian().lu());
            return Ok((residual, unstable));
        }
    }
    Err(unsettled)
}

/// The change of the unknowns that makes the linearised equations vanish; `None` where they are singular.
fn newton_step(
    jacobian: &LU<f64, Dyn, Dyn>,
    residual: &BalanceResidual,
) -> Result<Option<DVector<f64>>> {
    let values = -residual.values();
    if !values.amax().is_finite() {
        return Err(Reason::OutOfRange);
    }
    Ok(jacobian.solve(&values).filter(|step| step.iter().all(ComplexField::is_finite)))
}

/// Whether the determinant is positive; its size may well overflow.
fn has_positive_determinant(decomposed: &LU<f64, Dyn, Dyn>) -> bool {
    let pivots = decomposed.u().diagonal();
    let negative = pivots.iter().filter(|pivot| **pivot < 0.0).count();
    negative.is_multiple_of(2) == (decomposed.p().determinant::<f64>() > 0.0)
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use proptest::prelude::*;

    use super::*;
    use crate::numerics::elementary::{cos, powi, sin};
    use crate::numerics::quadrature::integrate;

    /// A skewed curve of five harmonics on which p changes its sign twice.
    fn ansatz() -> Ansatz {
        let coefficients =
            [(0.1, 0.0), (0.5, 0.0), (0.04, -0.03), (-0.03, 0.01), (0.01, 0.01), (0.005, 0.0)];
        let coefficients = coefficients.map(|(re, im)| Complex::new(re, im)).to_vec();
        Ansatz { frequency: 0.9, q: Fourier { coefficients } }
    }

    const GENERAL: Parameters = Parameters { d: -0.3, d2: 0.4, d3: 0.25, r: 0.2 };

    /// The residual of the differential equation at one angle.
    fn pointwise(parameters: &Parameters, ansatz: &Ansatz, angle: f64) -> f64 {
        let Parameters { d, d2, d3, r } = *parameters;
        let [q, slope, curvature] = ansatz.q.at(angle);
        let (eta, v) = (ansatz.frequency, ansatz.frequency * slope);
        let friction = if v == 0.0 { 0.0 } else { r * v.signum() };
        eta * eta * curvature + 2.0 * d * v + d2 * v * v + d3 * v * v * v + q + friction
    }

    #[test]
    fn projections_are_the_integrals_that_they_stand_for() {
        let ansatz = ansatz();
        let crossings = sign_changes(&ansatz.q.derivative());
        let [first, second] = crossings[..] else { panic!("two sign changes") };
        let weighted = |weight: &dyn Fn(f64) -> f64| {
            let density = |t: f64| pointwise(&GENERAL, &ansatz, t) * weight(t);
            let turn = [(first.angle, second.angle), (second.angle, first.angle + TAU)];
            turn.map(|part| integrate(&density, part, 1e-13).value).iter().sum::<f64>()
        };
        let residual = BalanceResidual::new(&GENERAL, 5, &ansatz);
        for (got, entry) in residual.values().iter().zip(residual.unknowns()) {
            let (k, wave) = (real(entry.harmonic), if entry.unit.im == 0.0 { cos } else { sin });
            let expected = weighted(&|t| wave(k * t)) / if k == 0.0 { TAU } else { PI };
            assert!((got - expected).abs() < 1e-12, "{entry:?}: {got} for {expected}");
        }
    }

    #[test]
    fn friction_is_projected_rightly_whatever_the_number_of_sign_changes() {
        // v = cos(3 t) has six; its sign is (4/pi) (cos 3t - cos(9 t)/3 + ..).
        let mut q = Fourier { coefficients: vec![Complex::default(); 10] };
        q.coefficients[3] = Complex::new(0.0, -1.0 / 6.0);
        let parameters = Parameters { d: 0.0, d2: 0.0, d3: 0.0, r: 1.0 };
        let ansatz = Ansatz { frequency: 1.0, q };
        let residual = BalanceResidual::new(&parameters, 9, &ansatz);
        assert_eq!(residual.crossings.len(), 6);
        for k in 0..=9 {
            let expected = match k {
                3 => 2.0 / PI,
                9 => -2.0 / (3.0 * PI),
                _ => 0.0,
            };
            assert!((residual.sign(k) - Complex::from(expected)).modulus() < 1e-14, "{k}");
        }
    }

    #[test]
    fn one_harmonic_leaves_the_equations_of_the_paper() {
        // Weighted by 1, cos and sin: (40), (39) and (42) times -eta, whatever A and A0.
        let (mean, amplitude, eta) = (0.3, 1.7, 0.8);
        let q = Fourier { coefficients: vec![mean.into(), Complex::from(0.5 * amplitude)] };
        let got = BalanceResidual::new(&GENERAL, 1, &Ansatz { frequency: eta, q }).values();
        let Parameters { d, d2, d3, r } = GENERAL;
        let speed = eta * amplitude;
        let stationary = 4.0 * r / PI + 2.0 * d * speed + 0.75 * d3 * powi(speed, 3);
        let expected =
            [mean + 0.5 * d2 * speed * speed, (1.0 - eta * eta) * amplitude, -stationary];
        for (got, expected) in got.iter().zip(expected) {
            assert!((got - expected).abs() < 1e-14, "{got} for {expected}");
        }
    }

    proptest! {
        #[test]
        fn the_jacobian_is_that_of_central_differences(
            d in -1.0..1.0, d2 in -1.0..1.0, d3 in -1.0..1.0, r in 0.0..1.0, odd: bool,
        ) {
            let parameters = Parameters { d, d2: if odd { 0.0 } else { d2 }, d3, r };
            let mut ansatz = ansatz();
            if odd {
                ansatz.q.coefficients.iter_mut().step_by(2).for_each(|c| *c = Complex::default());
            }
            let residual = BalanceResidual::new(&parameters, 5, &ansatz);
            let jacobian = residual.jacobian();
            let width = 1e-6;
            let size = jacobian.ncols();
            for column in 0..size {
                let unit = DVector::from_fn(size, |row, _| f64::from(row == column));
                let moved = |part| BalanceResidual::new(&parameters, 5, &residual.moved(&unit, part));
                let at = |part| moved(part).values();
                let slope = (at(width) - at(-width)) / (2.0 * width);
                let error = (slope - jacobian.column(column)).amax();
                prop_assert!(error < 1e-8, "column {column}: {error:e}");
            }
        }
    }
}
