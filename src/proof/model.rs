//! Taylor models in one variable: a polynomial over a step, and a bound on what it omits.
//!
//! The variable of the polynomial is the elapsed fraction of the step, from 0 to 1. Its coefficients are plain
//! doubles, taken as exact; everything else, including rounding, is in the bound.

use super::rounding::{INFLATE, UNDERFLOW, UNIT};
use super::series::{INVERSE, ORDER};
use crate::numerics::Interval;

/// All functions on a step that are within `rest` of a polynomial.
#[derive(Clone, Copy, Debug)]
pub struct TaylorModel {
    terms: [f64; ORDER],
    rest: f64,
}

impl TaylorModel {
    /// The functions within `rest` of a polynomial with these coefficients of powers of time, on a step of
    /// length `h`.
    ///
    /// The power and its product round at most `k + 1` times for the coefficient of degree k. Coefficients
    /// beyond the degree of the model go to the rest.
    #[must_use]
    pub fn of_series(coefficients: &[f64], h: f64, rest: f64) -> Self {
        let mut model = TaylorModel { terms: [0.0; ORDER], rest };
        let (mut power, mut roundings) = (1.0, 1.0);
        for (k, &coefficient) in coefficients.iter().take(ORDER + 1).enumerate() {
            let term = coefficient * power;
            match model.terms.get_mut(k) {
                Some(place) => *place = term,
                None => model.rest += term.abs(),
            }
            model.rest += roundings * UNIT * term.abs();
            power *= h;
            roundings += 1.0;
        }
        model.inflated()
    }

    /// A bound of the magnitude of all members.
    #[must_use]
    pub fn magnitude(&self) -> f64 {
        (self.polynomial() + self.rest) * INFLATE
    }

    fn polynomial(&self) -> f64 {
        self.terms.iter().map(|term| term.abs()).sum()
    }

    /// Covers underflow and the rounding of the sums that produced `rest`.
    fn inflated(mut self) -> Self {
        self.rest = self.rest * INFLATE + UNDERFLOW;
        self
    }

    /// Every member times every number of an interval, plus every member of `other`.
    #[must_use]
    pub fn times_plus(&self, factor: Interval, other: &Self) -> Self {
        let middle = factor.middle();
        let mut sum = *other;
        for (place, term) in sum.terms.iter_mut().zip(&self.terms) {
            let product = middle * term;
            *place += product;
            sum.rest += UNIT * (product.abs() + place.abs());
        }
        sum.rest += factor.magnitude() * self.rest + factor.radius() * self.polynomial();
        sum.inflated()
    }

    /// All members plus a number.
    #[must_use]
    pub fn plus(mut self, number: Interval) -> Self {
        self.terms[0] += number.middle();
        self.rest += UNIT * self.terms[0].abs() + number.radius();
        self.inflated()
    }

    /// Every member times every member of `other`. A coefficient is a sum of at most [`ORDER`] products.
    #[must_use]
    pub fn times(&self, other: &Self) -> Self {
        let mut product = TaylorModel { terms: [0.0; ORDER], rest: 0.0 };
        let mut tail = 0.0;
        let mut tails = [0.0; ORDER + 1];
        for k in (0..ORDER).rev() {
            tails[k] = tails[k + 1] + other.terms[k].abs();
        }
        for (i, one) in self.terms.iter().enumerate() {
            for (place, two) in product.terms[i..].iter_mut().zip(&other.terms) {
                *place += one * two;
            }
            // What meets this term in the omitted degrees.
            tail += one.abs() * tails[ORDER - i];
        }
        let (one, two) = (self.polynomial(), other.polynomial());
        #[expect(clippy::cast_precision_loss, reason = "28")]
        let roundings = (ORDER + 1) as f64 * UNIT * one * two;
        product.rest =
            tail + roundings + self.rest * two + other.rest * one + self.rest * other.rest;
        product.inflated()
    }

    /// The integral from the beginning of the step, in units of its length.
    #[must_use]
    pub fn integral(&self) -> Self {
        let mut integral = TaylorModel { terms: [0.0; ORDER], rest: self.rest };
        for (k, term) in self.terms.iter().enumerate() {
            let term = term * INVERSE[k + 1];
            match integral.terms.get_mut(k + 1) {
                Some(place) => *place = term,
                None => integral.rest += term.abs(),
            }
            integral.rest += 2.0 * UNIT * term.abs();
        }
        integral.inflated()
    }

    /// The exponentials of all members; `None` where they are too large.
    ///
    /// `exp(y) = exp(y/2^n)^(2^n)` with `abs(y)/2^n <= 1/4`. The series is truncated after degree 14: the rest
    /// is below `0.25^15/15! exp(0.25) < 1e-21`.
    #[must_use]
    pub fn exp(&self) -> Option<Self> {
        const LARGEST: f64 = 30.0;
        const REST: f64 = 1e-21;
        let size = self.magnitude();
        if !(size <= LARGEST) {
            return None;
        }
        let (mut scale, mut squarings) = (1.0, 0);
        while size * scale > 0.25 {
            scale *= 0.5;
            squarings += 1;
        }
        let zero = TaylorModel { terms: [0.0; ORDER], rest: 0.0 };
        let small = self.times_plus(Interval::point(scale), &zero);
        let one = zero.plus(Interval::point(1.0));
        let mut sum = one;
        for k in (1..=14).rev() {
            let inverse = Interval::point(1.0) / Interval::point(f64::from(k));
            sum = small.times(&sum).times_plus(inverse, &one);
        }
        sum.rest += REST;
        for _ in 0..squarings {
            sum = sum.times(&sum);
        }
        Some(sum)
    }

    /// The values of all members at the end of the step.
    #[must_use]
    pub fn at_end(&self) -> Interval {
        let sum = self
            .terms
            .iter()
            .rev()
            .fold(Interval::point(0.0), |sum, &term| sum + Interval::point(term));
        sum + Interval::new(-self.rest, self.rest)
    }
}

#[cfg(test)]
#[expect(clippy::cast_precision_loss, reason = "small whole numbers")]
mod tests {
    use super::*;
    use crate::numerics::elementary::{exp, sin};
    use crate::numerics::twofold::Twofold;

    /// `exp` of the integral of a known function against its closed form, and the promised width.
    #[test]
    fn models_hold_closed_forms() {
        for h in [0.1, 0.7, 1.5] {
            // cos t, from its series.
            let mut series = [0.0; ORDER + 1];
            let (mut term, mut degree) = (1.0, 0.0);
            for place in series.iter_mut().step_by(2) {
                *place = term;
                term /= -(degree + 1.0) * (degree + 2.0);
                degree += 2.0;
            }
            let cosine = TaylorModel::of_series(&series, h, 1e-15);
            let sine = cosine.integral();
            let sine_end = sine.at_end() * Interval::point(h);
            assert!(sine_end.contains(sin(h)) && sine_end.width() < 1e-14, "{sine_end}");
            let squares = cosine.times(&cosine).integral().at_end() * Interval::point(h);
            let expected = 0.5 * h + 0.25 * sin(2.0 * h);
            assert!(squares.contains(expected) && squares.width() < 2e-13, "{squares}");
            let zero = sine.times_plus(Interval::point(-1.0), &sine);
            let scaled = sine.times_plus(Interval::point(h), &zero);
            let power = scaled.exp().unwrap().at_end();
            let expected = exp(sin(h));
            assert!(power.contains(expected), "{power}");
            assert!(h > 1.0 || power.width() < 1e-12, "{power}");
        }
        let large = TaylorModel { terms: [40.0; ORDER], rest: 0.0 };
        assert!(large.exp().is_none());
        let nothing = TaylorModel { terms: [f64::NAN; ORDER], rest: 0.0 };
        assert!(nothing.exp().is_none());
    }

    /// What lies within the rest of a model stays within the rests of its results.
    #[test]
    fn members_of_models_stay_members() {
        let point = Interval::point;
        let model = TaylorModel::of_series(&[1.0], 1.0, 0.25);
        let product = model.times(&model);
        for member in [0.75, 1.0, 1.25] {
            assert!(model.integral().at_end().contains(member));
            assert!(product.at_end().contains(member * member));
            assert!(model.exp().unwrap().at_end().contains(exp(member)));
            let sum = model.times_plus(Interval::new(-2.0, 3.0), &product).plus(point(1.0));
            for factor in [-2.0, 0.5, 3.0] {
                assert!(sum.at_end().contains(1.0 + factor * member + member * member));
            }
        }
        assert!(product.at_end().width() < 1.2 && model.magnitude() >= 1.25);
    }

    /// The rounding errors of a product, against its coefficients in twice the precision.
    #[test]
    fn roundings_of_products_are_in_the_rest() {
        let series: Vec<f64> = (0..ORDER / 2).map(|k| 0.1 + sin(0.7 + k as f64)).collect();
        let model = TaylorModel { rest: 0.0, ..TaylorModel::of_series(&series, 1.0, 0.0) };
        let product = model.times(&model);
        let errors = (0..ORDER - 1).map(|k| {
            let exact = (0..=k).fold(Twofold::of(0.0), |sum, i| {
                sum.plus(Twofold::of(model.terms[i]).times(model.terms[k - i]))
            });
            exact.plus(Twofold::of(-product.terms[k])).high.abs()
        });
        let off: f64 = errors.sum();
        assert!(off > 0.0 && off <= product.rest && product.rest < 1e3 * off, "{off}");
    }
}
