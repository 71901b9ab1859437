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

use std::f64::consts::{PI, TAU};

use nalgebra::{Complex, DMatrix, DVector, Dyn, LU};

use super::fourier::{Fourier, SignChange, sign_changes};
use crate::model::{Parameters, Reason};
use crate::numerics::{real, sin_cos};

/// An approximate cycle: its frequency and its displacement over one turn of the angle.
#[derive(Clone, Debug, PartialEq)]
pub struct Ansatz {
    /// Frequency eta.
    pub frequency: f64,
    /// Displacement q over the angle, with `b_1 = 0`.
    pub q: Fourier,
}

/// Which harmonics are unknown.
///
/// For `D2 = 0` the oscillator is symmetric and its cycles have odd harmonics only; the others, and the
/// mean, are then no unknowns at all and exactly zero.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Basis {
    /// The highest harmonic N.
    pub count: usize,
    /// Whether there are odd harmonics only, and no mean.
    pub odd: bool,
}

/// One unknown, and the equation of the same name.
#[derive(Clone, Copy, Debug, PartialEq)]
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

impl Basis {
    /// The harmonics up to `count` that these parameters ask for.
    pub fn new(parameters: &Parameters, count: usize) -> Self {
        Basis { count, odd: parameters.d2 == 0.0 }
    }

    fn entries(self) -> impl Iterator<Item = Unknown> {
        let mean = (!self.odd).then_some(Unknown { harmonic: 0, unit: Complex::from(1.0) });
        let units = [Complex::from(0.5), Complex::new(0.0, -0.5)];
        let harmonics = (1..=self.count).step_by(if self.odd { 2 } else { 1 });
        let both = harmonics.flat_map(move |harmonic| units.map(|unit| Unknown { harmonic, unit }));
        mean.into_iter().chain(both)
    }

    /// The ansatz, which has room for all harmonics, with `part` of a change of the unknowns added.
    pub fn moved(self, from: &Ansatz, changes: &DVector<f64>, part: f64) -> Ansatz {
        let mut to = from.clone();
        for (entry, change) in self.entries().zip(changes.iter()) {
            if entry.is_frequency() {
                to.frequency += part * change;
            } else {
                to.q.coefficients[entry.harmonic] += entry.unit * (part * change);
            }
        }
        to
    }
}

/// The residual at one ansatz, taken apart into what the equations and their derivatives need.
#[derive(Clone, Debug)]
pub struct BalanceResidual {
    parameters: Parameters,
    basis: Basis,
    /// The ansatz, with room for the harmonics of the basis.
    pub ansatz: Ansatz,
    /// `p = q'(t)`.
    p: Fourier,
    /// `p^2`, up to harmonic `2 N`.
    square: Fourier,
    /// `p^3`, up to harmonic N.
    cube: Fourier,
    /// Where p changes its sign.
    crossings: Vec<ChangeWaves>,
}

/// A sign change of p, with `e^(i k t)` there for every harmonic k.
#[derive(Clone, Debug)]
struct ChangeWaves {
    change: SignChange,
    waves: Vec<Complex<f64>>,
}

impl ChangeWaves {
    fn new(change: SignChange, count: usize) -> Self {
        let wave = |k| {
            let (sin, cos) = sin_cos(real(k) * change.angle);
            Complex::new(cos, sin)
        };
        ChangeWaves { change, waves: (0..=count).map(wave).collect() }
    }
}

impl BalanceResidual {
    /// The residual of an ansatz, in which harmonics that are new are zero.
    pub fn new(parameters: &Parameters, basis: Basis, ansatz: &Ansatz) -> Self {
        let mut ansatz = ansatz.clone();
        ansatz.q.coefficients.resize(basis.count + 1, Complex::default());
        let p = ansatz.q.derivative();
        let square = p.product(&p, 2 * basis.count);
        let cube = square.product(&p, basis.count);
        let crossing = |change| ChangeWaves::new(change, basis.count);
        BalanceResidual {
            parameters: *parameters,
            basis,
            crossings: sign_changes(&p).into_iter().map(crossing).collect(),
            ansatz,
            p,
            square,
            cube,
        }
    }

    /// Number of instants in a turn at which the ansatz stands on `v = 0`; two at a cycle.
    pub fn crossings(&self) -> usize {
        self.crossings.len()
    }

    /// What every equation leaves.
    pub fn values(&self) -> DVector<f64> {
        let values = self.basis.entries().map(|entry| entry.of(self.coefficient(entry.harmonic)));
        DVector::from_vec(values.collect())
    }

    /// The largest of what the equations leave, relative to the largest term in them.
    pub fn relative(&self) -> f64 {
        let size = |(series, weight): (&Fourier, f64)| {
            let largest = series.coefficients.iter().map(|c| c.norm()).fold(0.0, f64::max);
            weight.abs() * largest
        };
        let spring = (&self.ansatz.q, 1.0);
        let terms = std::iter::once(spring).chain(self.damping_terms());
        self.values().amax() / terms.map(size).fold(self.parameters.r, f64::max)
    }

    /// The powers of p, and their factors in the residual.
    fn damping_terms(&self) -> [(&Fourier, f64); 3] {
        let (Parameters { d, d2, d3, .. }, eta) = (self.parameters, self.ansatz.frequency);
        [
            (&self.p, 2.0 * d * eta),
            (&self.square, d2 * eta * eta),
            (&self.cube, d3 * eta * eta * eta),
        ]
    }

    /// Derivatives of every equation (rows) by every unknown (columns).
    pub fn jacobian(&self) -> DMatrix<f64> {
        let damping = self.damping_slope();
        let size = self.basis.entries().count();
        let mut jacobian = DMatrix::zeros(size, size);
        for (mut column, unknown) in jacobian.column_iter_mut().zip(self.basis.entries()) {
            let change = |m: usize| {
                if unknown.is_frequency() {
                    self.by_frequency(m)
                } else {
                    self.by_coefficient(&damping, unknown, m)
                }
            };
            // The equations weighted by cosine and sine stand together and read one coefficient.
            let mut last = (usize::MAX, Complex::default());
            for (cell, equation) in column.iter_mut().zip(self.basis.entries()) {
                if last.0 != equation.harmonic {
                    last = (equation.harmonic, change(equation.harmonic));
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
        let damping = self.damping_terms().into_iter();
        damping.fold(spring, |sum, (series, weight)| sum + series.coefficient(m) * weight)
            + self.sign(k) * self.parameters.r
    }

    /// Coefficient `k` of `sign(p)`, which is constant between the sign changes.
    fn sign(&self, k: usize) -> Complex<f64> {
        if k == 0 {
            return Complex::from(self.mean_sign());
        }
        let jumps = self.crossings.iter().map(|at| at.waves[k].conj() * at.change.direction());
        jumps.sum::<Complex<f64>>() / Complex::new(0.0, PI * real(k))
    }

    fn mean_sign(&self) -> f64 {
        // The mean of p is zero, so that it changes its sign unless it is zero everywhere: rest, where
        // friction balances whatever it can and is given no preference here.
        let Some(first) = self.crossings.first() else { return 0.0 };
        let starts = self.crossings.iter().map(|at| at.change);
        let ends = starts.clone().skip(1).map(|at| at.angle).chain([first.change.angle + TAU]);
        starts.zip(ends).map(|(start, end)| start.direction() * (end - start.angle)).sum::<f64>()
            / TAU
    }

    /// The derivative of damping by p: `2 D eta + 2 D2 eta^2 p + 3 D3 eta^3 p^2`.
    fn damping_slope(&self) -> Fourier {
        let (Parameters { d, d2, d3, .. }, eta) = (self.parameters, self.ansatz.frequency);
        let coefficient = |(k, square): (usize, &Complex<f64>)| {
            let p = self.p.coefficient(k.cast_signed());
            p * (2.0 * d2 * eta * eta) + square * (3.0 * d3 * eta * eta * eta)
        };
        let mut slope = Fourier {
            coefficients: self.square.coefficients.iter().enumerate().map(coefficient).collect(),
        };
        slope.coefficients[0] += 2.0 * d * eta;
        slope
    }

    /// Change of coefficient `m` of the residual when coefficient `k` of q changes by the unit of an unknown, and
    /// coefficient `-k` by its conjugate.
    fn by_coefficient(&self, damping: &Fourier, unknown: Unknown, m: usize) -> Complex<f64> {
        let Unknown { harmonic: k, unit } = unknown;
        let (row, column) = (m.cast_signed(), k.cast_signed());
        let speed = unit * Complex::new(0.0, real(k));
        let mut change = damping.coefficient(row - column) * speed
            + damping.coefficient(row + column) * speed.conj();
        if m == k {
            change += unit * spring_and_inertia(self.ansatz.frequency, k);
        }
        let friction = self.crossings.iter().map(|at| {
            let moved = 2.0 * (speed * at.waves[k]).re / at.change.slope.abs();
            at.waves[m].conj() * moved
        });
        change + friction.sum::<Complex<f64>>() * (self.parameters.r / PI)
    }

    /// Change of coefficient `m` of the residual with the frequency.
    fn by_frequency(&self, m: usize) -> Complex<f64> {
        let Parameters { d, d2, d3, .. } = self.parameters;
        let (eta, row) = (self.ansatz.frequency, m.cast_signed());
        self.ansatz.q.coefficient(row) * (-2.0 * eta * real(m) * real(m))
            + self.p.coefficient(row) * (2.0 * d)
            + self.square.coefficient(row) * (2.0 * d2 * eta)
            + self.cube.coefficient(row) * (3.0 * d3 * eta * eta)
    }
}

/// `1 - (k eta)^2`, with the digits that the difference would lose near resonance.
fn spring_and_inertia(eta: f64, k: usize) -> f64 {
    let speed = eta * real(k);
    (1.0 - speed) * (1.0 + speed)
}

/// A change of the unknowns below which Newton's next step is below rounding.
const SETTLED: f64 = 1e-12;

/// Solves the Galerkin equations of a basis near `start`.
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
    basis: Basis,
    start: &Ansatz,
    interrupted: &dyn Fn() -> bool,
) -> Result<(BalanceResidual, bool), Reason> {
    /// Newton steps before giving up; sharp kinks need 20.
    const ITERATIONS: usize = 60;
    /// Smallest fraction of a step that is tried.
    const SMALLEST_PART: f64 = 1e-3;
    let unsettled = Reason::Harmonics { count: basis.count, strength: 1.0 };
    let mut residual = BalanceResidual::new(parameters, basis, start);
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
            let next = basis.moved(&residual.ansatz, &step, part);
            let next = BalanceResidual::new(parameters, basis, &next);
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
) -> Result<Option<DVector<f64>>, Reason> {
    let values = -residual.values();
    if !values.amax().is_finite() {
        return Err(Reason::OutOfRange);
    }
    Ok(jacobian.solve(&values).filter(|step| step.iter().all(|change| change.is_finite())))
}

/// Whether the determinant is positive; its size may well overflow.
fn has_positive_determinant(decomposed: &LU<f64, Dyn, Dyn>) -> bool {
    let pivots = decomposed.u().diagonal();
    let negative = pivots.iter().filter(|pivot| **pivot < 0.0).count();
    negative.is_multiple_of(2) == (decomposed.p().determinant::<f64>() > 0.0)
}

#[cfg(test)]
mod tests {
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

    fn values(parameters: &Parameters, basis: Basis, ansatz: &Ansatz) -> DVector<f64> {
        BalanceResidual::new(parameters, basis, ansatz).values()
    }

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
        let (ansatz, basis) = (ansatz(), Basis { count: 5, odd: false });
        let crossings = sign_changes(&ansatz.q.derivative());
        let [first, second] = crossings[..] else { panic!("two sign changes") };
        let weighted = |weight: &dyn Fn(f64) -> f64| {
            let density = |t: f64| pointwise(&GENERAL, &ansatz, t) * weight(t);
            let turn = [(first.angle, second.angle), (second.angle, first.angle + TAU)];
            turn.map(|part| integrate(&density, part, 1e-13).value).iter().sum::<f64>()
        };
        let got = values(&GENERAL, basis, &ansatz);
        for (got, entry) in got.iter().zip(basis.entries()) {
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
        let residual = BalanceResidual::new(&parameters, Basis { count: 9, odd: false }, &ansatz);
        assert_eq!(residual.crossings(), 6);
        for k in 0..=9 {
            let expected = match k {
                3 => 2.0 / PI,
                9 => -2.0 / (3.0 * PI),
                _ => 0.0,
            };
            assert!((residual.sign(k) - Complex::from(expected)).norm() < 1e-14, "{k}");
        }
    }

    #[test]
    fn one_harmonic_leaves_the_equations_of_the_paper() {
        // Weighted by 1, cos and sin: (40), (39) and (42) times -eta, whatever A and A0.
        let (mean, amplitude, eta) = (0.3, 1.7, 0.8);
        let q = Fourier { coefficients: vec![mean.into(), Complex::from(0.5 * amplitude)] };
        let got = values(&GENERAL, Basis { count: 1, odd: false }, &Ansatz { frequency: eta, q });
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
            let basis = Basis { count: 5, odd };
            let mut ansatz = ansatz();
            if odd {
                ansatz.q.coefficients.iter_mut().step_by(2).for_each(|c| *c = Complex::default());
            }
            let jacobian = BalanceResidual::new(&parameters, basis, &ansatz).jacobian();
            let width = 1e-6;
            let size = jacobian.ncols();
            for column in 0..size {
                let unit = DVector::from_fn(size, |row, _| f64::from(u8::from(row == column)));
                let at = |part| values(&parameters, basis, &basis.moved(&ansatz, &unit, part));
                let slope = (at(width) - at(-width)) / (2.0 * width);
                let error = (slope - jacobian.column(column)).amax();
                prop_assert!(error < 1e-8, "column {column}: {error:e}");
            }
        }
    }
}
