//! Windows of world coordinates, finite and never empty by construction.
//!
//! A plot divides only by widths of a [`Span`]. Therefore every span can be drawn: its ends are finite, the
//! right one is larger, and it is wide enough that its ticks differ.

use serde::{Deserialize, Serialize};

use crate::model::{Knob, KnobSpec, State};

/// Largest magnitude of an end: sums and products with a few others stay finite.
const FARTHEST: f64 = 1e300;

/// Smallest width relative to the larger end: some thousand floating-point numbers fit in.
const NARROWEST: f64 = 1e-12;

/// Smallest width of a span next to zero: well above the subnormal numbers.
const TINIEST: f64 = 1e-300;

/// An interval of one axis.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "[f64; 2]", into = "[f64; 2]")]
pub struct Span {
    from: f64,
    to: f64,
}

impl Default for Span {
    fn default() -> Self {
        Span::known(0.0, 1.0)
    }
}

impl Span {
    /// The interval between two numbers. Fails with one line unless both are finite, `from < to`, and their
    /// distance can be resolved.
    pub fn new(from: f64, to: f64) -> Result<Self, String> {
        let largest = from.abs().max(to.abs());
        // Written so that NaN fails.
        let valid = largest <= FARTHEST && to - from >= TINIEST.max(NARROWEST * largest);
        let refused = || {
            format!(
                "[{from:?}, {to:?}] is not an interval: two finite numbers up to {FARTHEST:?} are needed, \
                    the second larger"
            )
        };
        valid.then_some(Span { from, to }).ok_or_else(refused)
    }

    /// The interval between two constants, checked by the compiler.
    ///
    /// # Panics
    /// Unless `from < to`; at compile time, in a constant.
    pub const fn known(from: f64, to: f64) -> Self {
        assert!(from < to && -FARTHEST <= from && to <= FARTHEST);
        Span { from, to }
    }

    /// The smallest span around all finite values, widened if they coincide; `None` without any.
    pub fn covering(values: impl IntoIterator<Item = f64>) -> Option<Self> {
        let (from, to) = values
            .into_iter()
            .filter(|value| value.is_finite())
            .map(|value| value.clamp(-0.25 * FARTHEST, 0.25 * FARTHEST))
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(from, to), value| {
                (from.min(value), to.max(value))
            });
        if from > to {
            return None;
        }
        Span::new(from, to).ok().or_else(|| {
            let half = if from == 0.0 {
                1.0
            } else {
                (0.5 * from.abs()).max(TINIEST)
            };
            Span::new(from - half, to + half).ok()
        })
    }

    pub fn from(self) -> f64 {
        self.from
    }

    pub fn to(self) -> f64 {
        self.to
    }

    pub fn ends(self) -> [f64; 2] {
        [self.from, self.to]
    }

    /// The larger of the distances of both ends from 0.
    pub fn farthest(self) -> f64 {
        self.from.abs().max(self.to.abs())
    }

    pub fn width(self) -> f64 {
        self.to - self.from
    }

    pub fn center(self) -> f64 {
        0.5 * (self.from + self.to)
    }

    /// Whether a value lies within, ends included.
    pub fn contains(self, value: f64) -> bool {
        (self.from..=self.to).contains(&value)
    }

    /// The nearest value within; `NaN` becomes the middle.
    pub fn clamp(self, value: f64) -> f64 {
        if value.is_nan() {
            self.center()
        } else {
            value.clamp(self.from, self.to)
        }
    }

    /// Position of a value: 0 at the left end, 1 at the right one.
    pub fn fraction(self, value: f64) -> f64 {
        (value - self.from) / self.width()
    }

    /// The value at this fraction of the width; the inverse of [`Span::fraction`].
    pub fn at(self, fraction: f64) -> f64 {
        self.from + fraction * self.width()
    }

    /// The values that divide the span evenly into so many parts, at least one, both ends among them.
    pub fn evenly(self, parts: u32) -> impl Iterator<Item = f64> {
        (0..=parts).map(move |part| self.at(f64::from(part) / f64::from(parts.max(1))))
    }

    /// The span `factor` times as wide, with `about` at the same fraction; unchanged if the result would be no
    /// valid span.
    pub fn scaled(self, about: f64, factor: f64) -> Self {
        let about = self.clamp(about);
        let from = about - (about - self.from) * factor;
        let to = about + (self.to - about) * factor;
        Span::new(from, to).unwrap_or(self)
    }

    /// The span `factor` times as wide, with the same center.
    pub fn widened(self, factor: f64) -> Self {
        self.scaled(self.center(), factor)
    }

    /// The span moved by a fraction of its width; unchanged if the result would be no valid span.
    pub fn shifted(self, fraction: f64) -> Self {
        let by = fraction * self.width();
        Span::new(self.from + by, self.to + by).unwrap_or(self)
    }

    /// The part within the range of a number, if that is a valid span.
    pub fn allowed(self, knob: Knob) -> Option<Self> {
        let KnobSpec { min, max, .. } = *knob.spec();
        Span::new(self.from.max(min), self.to.min(max)).ok()
    }
}

impl TryFrom<[f64; 2]> for Span {
    type Error = String;

    fn try_from([from, to]: [f64; 2]) -> Result<Self, String> {
        Span::new(from, to)
    }
}

impl std::convert::From<Span> for [f64; 2] {
    fn from(span: Span) -> Self {
        span.ends()
    }
}

/// A rectangle in the world coordinates of a plot.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Window {
    pub x: Span,
    pub y: Span,
}

/// A point in the world coordinates of a plot.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Point {
    /// Along the horizontal axis.
    pub x: f64,
    /// Along the vertical axis.
    pub y: f64,
}

impl Point {
    /// A gap in a curve: both coordinates are NaN.
    pub const NOWHERE: Self = Point { x: f64::NAN, y: f64::NAN };

    /// Places as points.
    pub fn all<T: Copy + Into<Point>>(places: &[T]) -> Vec<Point> {
        places.iter().map(|place| (*place).into()).collect()
    }
}

impl From<State> for Point {
    /// The point of the phase plane.
    fn from(State { q, v }: State) -> Self {
        Point { x: q, y: v }
    }
}

impl From<[f64; 2]> for Point {
    fn from([x, y]: [f64; 2]) -> Self {
        Point { x, y }
    }
}

impl From<(f64, f64)> for Point {
    fn from((x, y): (f64, f64)) -> Self {
        Point { x, y }
    }
}

impl From<Point> for [f64; 2] {
    fn from(point: Point) -> Self {
        [point.x, point.y]
    }
}

impl Window {
    /// The smallest window around these points, so many times as large; `None` without any that is finite.
    pub fn around(points: &[Point], times: f64) -> Option<Self> {
        let x = Span::covering(points.iter().map(|point| point.x))?;
        let y = Span::covering(points.iter().map(|point| point.y))?;
        Some(Window { x: x.widened(times), y: y.widened(times) })
    }

    /// The window between left and right, bottom and top; `None` if it has no extent.
    pub fn of([left, right, low, high]: [f64; 4]) -> Option<Self> {
        Some(Window { x: Span::new(left, right).ok()?, y: Span::new(low, high).ok()? })
    }

    /// Whether a point lies within, edges included.
    pub fn contains(self, point: Point) -> bool {
        self.x.contains(point.x) && self.y.contains(point.y)
    }

    /// The nearest point within.
    pub fn clamp(self, point: Point) -> Point {
        Point { x: self.x.clamp(point.x), y: self.y.clamp(point.y) }
    }

    /// The smallest window around this one, with the same center, in which a circle looks round in a picture of
    /// this width and height. Unchanged at the limits, and where either side would have to grow more than
    /// `MOST` times.
    pub fn with_equal_units(self, width: f64, height: f64) -> Self {
        /// Largest factor by which the width or the height grows.
        const MOST: f64 = 8.0;
        let factor = (self.x.width() / width) / (self.y.width() / height);
        let about = self.center();
        if !(1.0 / MOST..=MOST).contains(&factor) {
            self
        } else if factor < 1.0 {
            Window { x: self.x.scaled(about.x, 1.0 / factor), ..self }
        } else {
            Window { y: self.y.scaled(about.y, factor), ..self }
        }
    }

    pub fn center(self) -> Point {
        Point { x: self.x.center(), y: self.y.center() }
    }

    /// The point at these fractions of the width and the height.
    pub fn at(self, [right, up]: [f64; 2]) -> Point {
        Point { x: self.x.at(right), y: self.y.at(up) }
    }
}

/// The outline of a rectangle, counter-clockwise from the lower left corner and back to it.
pub fn rectangle([left, right]: [f64; 2], [low, high]: [f64; 2]) -> [Point; 5] {
    [(left, low), (right, low), (right, high), (left, high), (left, low)].map(Point::from)
}

#[cfg(test)]
mod tests {
    #[test]
    fn equal_units_add_to_one_side_and_keep_the_middle() {
        let window = Window { x: Span::known(-1.0, 1.0), y: Span::known(0.0, 1.0) };
        let wide = window.with_equal_units(400.0, 100.0);
        assert_eq!(wide, Window { x: Span::known(-2.0, 2.0), ..window });
        let high = window.with_equal_units(100.0, 100.0);
        assert_eq!(high, Window { y: Span::known(-0.5, 1.5), ..window });
        assert_eq!(window.with_equal_units(200.0, 100.0), window);
        assert_eq!(window.with_equal_units(1e9, 1.0), window, "nothing would be left of it");
    }

    use proptest::prelude::*;

    use super::*;

    #[test]
    fn what_cannot_be_drawn_is_no_span() {
        for (from, to) in [
            (1.0, 1.0),
            (2.0, 1.0),
            (f64::NAN, 1.0),
            (0.0, f64::NAN),
            (0.0, f64::INFINITY),
            (-f64::MAX, f64::MAX),
            (0.0, 5e-324),
            (1.0, 1.0 + f64::EPSILON),
        ] {
            assert!(Span::new(from, to).is_err(), "[{from}, {to}]");
        }
    }

    #[test]
    fn a_single_value_is_covered_too() {
        for value in [0.0, 3.0, -1e-300, 1e300] {
            let span = Span::covering([value, f64::NAN, f64::INFINITY]).unwrap();
            assert!(span.width() > 0.0);
        }
        assert_eq!(Span::covering([f64::NAN]), None);
    }

    proptest! {
        #[test]
        fn zooming_and_panning_keep_a_span(
            a in -1e300..1e300_f64,
            b in -1e300..1e300_f64,
            factors in prop::collection::vec(0.1..10.0_f64, 0..200),
        ) {
            if let Ok(mut span) = Span::new(a.min(b), a.max(b)) {
                for factor in factors {
                    span = span.scaled(span.at(0.3), factor).shifted(factor - 5.0);
                    prop_assert!(Span::new(span.from(), span.to()).is_ok());
                }
            }
        }

        #[test]
        fn zooming_keeps_its_point_in_place(at in 0.0..1.0_f64, factor in 0.1..10.0_f64) {
            let span = Span::new(-3.0, 5.0).unwrap();
            let about = span.at(at);
            prop_assert!((span.scaled(about, factor).fraction(about) - at).abs() < 1e-12);
        }
    }
}
