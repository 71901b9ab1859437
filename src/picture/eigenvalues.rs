//! The eigenvalues of the rest without friction in the complex plane, and the way that they take as D
//! moves (9): a circle on which the motion swings, and the real axis on which it does not.

use super::items::{Item, LineStyle, Picture};
use super::reading::reading;
use super::role::{Dash, Mark, Role};
use crate::numerics::elementary::{cos, sin};
use crate::oscillator::Symbol;
use crate::scene::{Layer, Point, View};
use crate::session::{self, Session};

/// What the plot with this index shows.
pub fn picture(session: &Session, index: usize) -> Picture<'_> {
    let session::Plot { window, cursor, .. } = session.plots[index];
    let title = View::Eigenvalues.spec().title;
    let mut picture = Picture::new(title, "Re", "Im", window);
    picture.varied = vec![Symbol::D];
    picture.reading = cursor.map(|cursor| {
        let (re, im) = reading(cursor, window);
        format!("Re {re} Im {im}")
    });
    if session.layers.contains(&Layer::Locus) {
        locus(&mut picture);
        for shown in session.shown(index) {
            pair(&mut picture, shown.problem.parameters.d);
        }
    }
    picture.cross(cursor);
    picture
}

/// The way of the eigenvalues over D; on the left of the imaginary axis, shaded, the rest is stable.
fn locus(picture: &mut Picture) {
    const CORNERS: u16 = 240;
    let left = picture.window.x.from();
    let stable = LineStyle::new("the rest is stable", Role::Basin, Dash::Solid);
    picture.items.push(Item::Columns(stable, left.min(0.0), 0.0));
    picture.upright(LineStyle::guide(), 0.0);
    let circle = (0..=CORNERS).map(|corner| {
        let angle = std::f64::consts::TAU * f64::from(corner) / f64::from(CORNERS);
        Point { x: cos(angle), y: sin(angle) }
    });
    let way = || LineStyle::new("eigenvalues over D", Role::Asymptote, Dash::Dotted);
    picture.curve(way(), circle);
    picture.level(way(), 0.0);
    for (at, name) in [((0.0, 1.0), "D = 0"), ((-1.0, 0.0), "D = 1"), ((1.0, 0.0), "D = -1")] {
        picture.caption(Point { x: at.0, y: at.1 }, name, Role::Special);
    }
}

/// Both eigenvalues `-D +- sqrt(D^2 - 1)`.
fn eigenvalues(d: f64) -> [Point; 2] {
    let discriminant = (d - 1.0) * (d + 1.0);
    let root = discriminant.abs().sqrt();
    if discriminant < 0.0 {
        [root, -root].map(|im| Point { x: -d, y: im })
    } else {
        // The one that is a difference of equal numbers, from the product of both, which is 1.
        let large = -d - root.copysign(d);
        [large, 1.0 / large].map(|re| Point { x: re, y: 0.0 })
    }
}

fn pair(picture: &mut Picture, d: f64) {
    let mark = if d > 0.0 { Mark::Stable } else { Mark::Unstable };
    for at in eigenvalues(d) {
        let arm = [Point { x: 0.0, y: 0.0 }, at];
        let line = LineStyle::new("from the origin", Role::Current, Dash::Sparse);
        picture.curve(line.captioned(), arm);
        picture.mark(mark, at, Role::Current);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sum_and_product_of_the_eigenvalues_are_those_of_the_characteristic_polynomial() {
        for d in [-1e8, -1.5, -1.0, -0.3, 0.0, 0.7, 1.0, 2.0, 1e8] {
            let [a, b] = eigenvalues(d);
            assert!((a.x + b.x + 2.0 * d).abs() <= 4.0 * f64::EPSILON * d.abs(), "{d}");
            let product = a.x * b.x - a.y * b.y;
            assert!((product - 1.0).abs() <= 4.0 * f64::EPSILON, "{d}: {product}");
            assert_eq!(a.y, -b.y);
        }
    }
}
