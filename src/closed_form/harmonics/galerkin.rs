//! The Galerkin equations of N harmonics, with the set-valued friction projected exactly.
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

use nalgebra::{Complex, DMatrix, DVector};

use super::fourier::{Fourier, factor};
use super::sign_changes::{SignChange, sign_changes};
use crate::model::Parameters;
use crate::numerics::elementary::sin_cos;

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
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Unknown {
    /// `A0`; the residual weighted by 1.
    Mean,
    /// `a_k`; the residual weighted by `cos(k t)`.
    Cosine(usize),
    /// `b_k`, or the frequency for `k = 1`; the residual weighted by `sin(k t)`.
    Sine(usize),
}

impl Unknown {
    /// The harmonic that it belongs to.
    fn harmonic(self) -> usize {
        match self {
            Unknown::Mean => 0,
            Unknown::Cosine(k) | Unknown::Sine(k) => k,
        }
    }

    /// Reads this equation out of the residual's coefficient of its harmonic.
    fn of(self, coefficient: Complex<f64>) -> f64 {
        match self {
            Unknown::Mean => coefficient.re,
            Unknown::Cosine(_) => 2.0 * coefficient.re,
            Unknown::Sine(_) => -2.0 * coefficient.im,
        }
    }
}

impl Basis {
    /// The harmonics up to `count` that these parameters ask for.
    pub fn new(parameters: &Parameters, count: usize) -> Self {
        Basis { count, odd: parameters.d2 == 0.0 }
    }

    fn entries(self) -> impl Iterator<Item = Unknown> {
        let mean = (!self.odd).then_some(Unknown::Mean);
        let pairs = (1..=self.count).step_by(if self.odd { 2 } else { 1 });
        mean.into_iter().chain(pairs.flat_map(|k| [Unknown::Cosine(k), Unknown::Sine(k)]))
    }

    /// Number of unknowns, and of equations.
    pub fn unknowns(self) -> usize {
        self.entries().count()
    }

    /// The ansatz with `part` of a change of the unknowns added, and with room for all harmonics.
    pub fn moved(self, from: &Ansatz, changes: &DVector<f64>, part: f64) -> Ansatz {
        let mut to = self.widened(from);
        for (entry, change) in self.entries().zip(changes.iter()) {
            let change = part * change;
            match entry {
                Unknown::Mean => to.q.coefficients[0].re += change,
                Unknown::Cosine(k) => to.q.coefficients[k].re += 0.5 * change,
                Unknown::Sine(1) => to.frequency += change,
                Unknown::Sine(k) => to.q.coefficients[k].im -= 0.5 * change,
            }
        }
        to
    }

    /// The ansatz with room for all harmonics; new ones are zero.
    pub fn widened(self, from: &Ansatz) -> Ansatz {
        let mut to = from.clone();
        to.q.coefficients.resize(self.count + 1, Complex::default());
        to
    }
}

/// The residual at one ansatz, taken apart into what the equations and their derivatives need.
#[derive(Clone, Debug)]
pub struct BalanceResidual {
    parameters: Parameters,
    basis: Basis,
    frequency: f64,
    q: Fourier,
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
            let (sin, cos) = sin_cos(factor(k) * change.angle);
            Complex::new(cos, sin)
        };
        ChangeWaves { change, waves: (0..=count).map(wave).collect() }
    }
}

impl BalanceResidual {
    /// The residual of an ansatz that has room for the harmonics of the basis.
    pub fn new(parameters: &Parameters, basis: Basis, ansatz: &Ansatz) -> Self {
        let p = ansatz.q.derivative();
        let square = p.product(&p, 2 * basis.count);
        let cube = square.product(&p, basis.count);
        let crossing = |change| ChangeWaves::new(change, basis.count);
        BalanceResidual {
            parameters: *parameters,
            basis,
            frequency: ansatz.frequency,
            crossings: sign_changes(&p).into_iter().map(crossing).collect(),
            q: ansatz.q.clone(),
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
        let values = self.basis.entries().map(|entry| entry.of(self.coefficient(entry.harmonic())));
        DVector::from_iterator(self.basis.unknowns(), values)
    }

    /// The largest of what the equations leave, relative to the largest term in them.
    pub fn relative(&self) -> f64 {
        let Parameters { d, d2, d3, r } = self.parameters;
        let eta = self.frequency;
        let terms = [
            (&self.q, 1.0),
            (&self.p, 2.0 * d * eta),
            (&self.square, d2 * eta * eta),
            (&self.cube, d3 * eta * eta * eta),
        ];
        let size = |(series, weight): (&Fourier, f64)| {
            let largest = series.coefficients.iter().map(|c| c.norm()).fold(0.0, f64::max);
            weight.abs() * largest
        };
        let largest = terms.into_iter().map(size).fold(r, f64::max);
        self.values().amax() / largest
    }

    /// Derivatives of every equation (rows) by every unknown (columns).
    pub fn jacobian(&self) -> DMatrix<f64> {
        let damping = self.damping_slope();
        let size = self.basis.unknowns();
        let mut jacobian = DMatrix::zeros(size, size);
        for (mut column, unknown) in jacobian.column_iter_mut().zip(self.basis.entries()) {
            let change = |m: usize| match unknown {
                Unknown::Mean => self.by_coefficient(&damping, 0, Complex::from(1.0), m),
                Unknown::Cosine(k) => self.by_coefficient(&damping, k, Complex::from(0.5), m),
                Unknown::Sine(1) => self.by_frequency(m),
                Unknown::Sine(k) => self.by_coefficient(&damping, k, Complex::new(0.0, -0.5), m),
            };
            // The equations weighted by cosine and sine stand together and read one coefficient.
            let mut last = (usize::MAX, Complex::default());
            for (cell, equation) in column.iter_mut().zip(self.basis.entries()) {
                if last.0 != equation.harmonic() {
                    last = (equation.harmonic(), change(equation.harmonic()));
                }
                *cell = equation.of(last.1);
            }
        }
        jacobian
    }

    /// Coefficient `k` of the residual.
    fn coefficient(&self, k: usize) -> Complex<f64> {
        let Parameters { d, d2, d3, r } = self.parameters;
        let (eta, m) = (self.frequency, k.cast_signed());
        self.q.coefficient(m) * spring_and_inertia(eta, k)
            + self.p.coefficient(m) * (2.0 * d * eta)
            + self.square.coefficient(m) * (d2 * eta * eta)
            + self.cube.coefficient(m) * (d3 * eta * eta * eta)
            + self.sign(k) * r
    }

    /// Coefficient `k` of `sign(p)`, which is constant between the sign changes.
    fn sign(&self, k: usize) -> Complex<f64> {
        if k == 0 {
            return Complex::from(self.mean_sign());
        }
        let jumps = self.crossings.iter().map(|at| at.waves[k].conj() * at.change.direction());
        jumps.sum::<Complex<f64>>() / Complex::new(0.0, PI * factor(k))
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
        let Parameters { d, d2, d3, .. } = self.parameters;
        let eta = self.frequency;
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

    /// Change of coefficient `m` of the residual when coefficient `k` of q changes by `unit`, and
    /// coefficient `-k` by its conjugate.
    fn by_coefficient(
        &self,
        damping: &Fourier,
        k: usize,
        unit: Complex<f64>,
        m: usize,
    ) -> Complex<f64> {
        let (row, column) = (m.cast_signed(), k.cast_signed());
        let speed = unit * Complex::new(0.0, factor(k));
        let mut change = damping.coefficient(row - column) * speed
            + damping.coefficient(row + column) * speed.conj();
        if m == k {
            change += unit * spring_and_inertia(self.frequency, k);
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
        let (eta, row) = (self.frequency, m.cast_signed());
        self.q.coefficient(row) * (-2.0 * eta * factor(m) * factor(m))
            + self.p.coefficient(row) * (2.0 * d)
            + self.square.coefficient(row) * (2.0 * d2 * eta)
            + self.cube.coefficient(row) * (3.0 * d3 * eta * eta)
    }
}

/// `1 - (k eta)^2`, with the digits that the difference would lose near resonance.
fn spring_and_inertia(eta: f64, k: usize) -> f64 {
    let speed = eta * factor(k);
    (1.0 - speed) * (1.0 + speed)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::numerics::elementary::{cos, powi, sin};

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
        let jet = ansatz.q.at(angle);
        let (eta, v) = (ansatz.frequency, ansatz.frequency * jet.slope);
        let friction = if v == 0.0 { 0.0 } else { r * v.signum() };
        eta * eta * jet.curvature + 2.0 * d * v + d2 * v * v + d3 * v * v * v + jet.value + friction
    }

    /// `integral of f over [from, to]` by Gauss's rule of three points on short pieces.
    fn integral(from: f64, to: f64, f: impl Fn(f64) -> f64) -> f64 {
        let pieces = 400;
        let half = 0.5 * (to - from) / f64::from(pieces);
        let node = 0.6_f64.sqrt();
        (0..pieces)
            .map(|piece| {
                let middle = from + half * f64::from(2 * piece + 1);
                let outer = f(middle - node * half) + f(middle + node * half);
                half * (5.0 * outer + 8.0 * f(middle)) / 9.0
            })
            .sum()
    }

    #[test]
    fn projections_are_the_integrals_that_they_stand_for() {
        let (ansatz, basis) = (ansatz(), Basis { count: 5, odd: false });
        let crossings = sign_changes(&ansatz.q.derivative());
        let [first, second] = crossings[..] else { panic!("two sign changes") };
        let weighted = |weight: &dyn Fn(f64) -> f64| {
            let density = |t: f64| pointwise(&GENERAL, &ansatz, t) * weight(t);
            integral(first.angle, second.angle, density)
                + integral(second.angle, first.angle + TAU, density)
        };
        let got = values(&GENERAL, basis, &ansatz);
        for (got, entry) in got.iter().zip(basis.entries()) {
            let expected = match entry {
                Unknown::Mean => weighted(&|_| 1.0) / TAU,
                Unknown::Cosine(k) => weighted(&|t| cos(factor(k) * t)) / PI,
                Unknown::Sine(k) => weighted(&|t| sin(factor(k) * t)) / PI,
            };
            assert!((got - expected).abs() < 1e-12, "{entry:?}: {got} for {expected}");
        }
    }

    #[test]
    fn friction_is_projected_rightly_whatever_the_number_of_sign_changes() {
        // v = cos(3 t) has six; its sign is (4/pi) (cos 3t - cos(9 t)/3 + ..).
        let mut q = Fourier::zero(9);
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
            for column in 0..basis.unknowns() {
                let unit = DVector::from_fn(basis.unknowns(), |row, _| f64::from(u8::from(row == column)));
                let at = |part| values(&parameters, basis, &basis.moved(&ansatz, &unit, part));
                let slope = (at(width) - at(-width)) / (2.0 * width);
                let error = (slope - jacobian.column(column)).amax();
                prop_assert!(error < 1e-8, "column {column}: {error:e}");
            }
        }
    }
}
