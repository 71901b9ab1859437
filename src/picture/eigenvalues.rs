//! The eigenvalues of the rest without friction in the complex plane, and the way that they take as D
//! moves (9): a circle on which the motion swings, and the real axis on which it does not.

use super::{Item, LineStyle, Picture, Role, cycle_mark, ellipse};
use crate::model::Knob;
use crate::scene::{Layer, Point};
use crate::session::Session;

pub fn draw(picture: &mut Picture, session: &Session, index: usize) {
    picture.axes("Re", "Im");
    picture.varied = vec![Knob::D];
    if session.layers.contains(&Layer::Locus) {
        locus(picture);
        for shown in session.shown(index) {
            pair(picture, shown.problem.parameters.d);
        }
    }
}

/// The way of the eigenvalues over D; on the left of the imaginary axis, shaded, the rest is stable.
fn locus(picture: &mut Picture) {
    let left = picture.window.x.from();
    picture.items.push(Item::Columns("the rest is stable".into(), left.min(0.0), 0.0));
    picture.upright(LineStyle::guide(), 0.0);
    picture.curve("eigenvalues over D", ellipse((0.0, 1.0), (0.0, 1.0)));
    picture.level("eigenvalues over D", 0.0);
    for (at, name) in [([0.0, 1.0], "D = 0"), ([-1.0, 0.0], "D = 1"), ([1.0, 0.0], "D = -1")] {
        picture.caption(at, name, Role::Special);
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
    let mark = cycle_mark(d > 0.0);
    for at in eigenvalues(d) {
        picture.curve("from the origin", [Point { x: 0.0, y: 0.0 }, at]);
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
