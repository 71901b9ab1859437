//! Derivatives of a half swing with respect to the coefficients of its field, enclosed.
//!
//! For a coefficient p, the cross product `J` of the field with the variation of the motion obeys
//! `J' = -f' J + g v`, with `g = v, v^2, v^3` for a, b, c, and equals `-X dX/dp` on arrival (lemma 21). The
//! derivatives thus need the integrals of `v^2, v^3, v^4`, each weighted by the fraction of an area that
//! survives until the end. They are accumulated step by step in Taylor models.

use super::field::Field;
use super::model::TaylorModel;
use super::series::Series;
use crate::numerics::Interval;

/// The integrals of `v^2`, `v^3` and `v^4` over time so far, weighted by `exp(-integral of f' from there on)`.
#[derive(Clone, Copy, Debug)]
pub struct WeightedIntegrals(pub [Interval; 3]);

impl Default for WeightedIntegrals {
    fn default() -> Self {
        WeightedIntegrals([Interval::point(0.0); 3])
    }
}

impl WeightedIntegrals {
    /// Adds a step of length `h`, over which the velocity is within `off` of the polynomial.
    pub fn after(&self, field: &Field, series: &Series, h: f64, off: f64) -> Option<Self> {
        let Field { a, b, c } = *field;
        let step = Interval::point(h);
        let v = TaylorModel::of_series(&series.v, h, off);
        let square = v.times(&v);
        let zero = v.times_plus(Interval::point(-1.0), &v);
        let slope = square.times_plus(c * Interval::point(3.0), &zero);
        let slope = v.times_plus(b.twice(), &slope).plus(a);
        let grown = slope.integral().times_plus(step, &zero);
        let weight = grown.exp()?;
        let survives = (-grown.at_end()).exp();
        let mut power = square.times(&weight);
        let mut sums = self.0;
        for sum in &mut sums {
            let added = power.integral().at_end() * step;
            *sum = (*sum + added) * survives;
            power = power.times(&v);
        }
        Some(WeightedIntegrals(sums))
    }

    /// The integrals at a moment at most `lag` earlier or later, around which the velocity is at most `speed`
    /// in magnitude.
    pub fn within(&self, field: &Field, lag: f64, speed: f64) -> Self {
        let late = Interval::new(-lag, lag);
        let slope = field.slope(Interval::new(-speed, speed));
        let factor = (slope * late).exp();
        let speed = Interval::new(-speed, speed);
        let mut power = speed.square();
        WeightedIntegrals(self.0.map(|sum| {
            let moved = (sum + power * late * factor) * factor;
            power = power * speed;
            moved
        }))
    }

    /// The derivatives of the end with respect to a, b and c.
    pub fn derivatives(&self, end: Interval) -> [Interval; 3] {
        self.0.map(|sum| -(sum / end))
    }
}
