//! Damping over amplitude: measured decrements, the exact curve, the averaged one with its terms and its band.

use std::f64::consts::PI;

use super::pieces::{curve, picture, points, window, with_unit};
use crate::fit::{D, D3, Fitted, R};
use crate::picture::items::{Item, LineStyle, Marks, Picture};
use crate::picture::role::{CycleStyle, Dash, Mark, Role, cycle_style};
use crate::scene::Point;

pub fn damping(fitted: &Fitted) -> Option<Picture<'static>> {
    let p = &fitted.estimate.p;
    let found = &fitted.curves.damping;
    let over = |value: &dyn Fn(f64) -> f64| {
        found.averaged.iter().map(|&[x, _]| Point { x, y: value(x) }).collect()
    };
    let friction = |a: f64| 2.0 * p[R] / (PI * a);
    let mut curves = vec![
        curve("linear part D", Role::Asymptote, Dash::Sparse, over(&|_| p[D])),
        curve("friction 2 r/(pi A)", Role::Sticking, Dash::Dotted, over(&friction)),
        curve(
            "cubic part (3/8) D3 A^2",
            Role::Lyapunov,
            Dash::DashDot,
            over(&|a| 0.375 * p[D3] * a * a),
        ),
        curve("averaged", Role::Harmonic, Dash::Dashed, points(&found.averaged)),
        curve("exact", Role::Trajectory, Dash::Thick, points(&found.exact)),
    ];
    let extent = window(found.extent)?;
    let measured: Vec<Point> = found.measured.iter().map(|&[x, y, _]| Point { x, y }).collect();
    let beyond = measured.iter().filter(|at| !extent.contains(**at)).count();
    let name = match beyond {
        0 => "measured".to_owned(),
        _ => format!("measured, {beyond} beyond the plot"),
    };
    curves.extend(found.measured.iter().map(|&[x, y, error]| {
        let bar = [y - error, y + error].map(|y| Point { x, y });
        (LineStyle::new(name.clone(), Role::Ghost, Dash::Solid), bar.to_vec())
    }));
    let amplitude = with_unit("amplitude A", fitted.unit());
    let names = (amplitude, "loss of amplitude".to_owned());
    let mut picture = picture("damping over amplitude", names, curves, Some(extent))?;
    let line = LineStyle::new("90 % band of averaged", Role::Field, Dash::Solid);
    picture.items.push(Item::Shade(line, points(&found.band)));
    let exact = points(&found.exact);
    let zeros = exact.windows(2).filter(|two| two[0].y * two[1].y < 0.0);
    picture.items.extend(zeros.map(|two| Item::Marks(zero(two[0], two[1]))));
    let marks = Marks::new(Mark::Turn, Role::Ghost, measured);
    picture.items.push(Item::Marks(Marks { name: "measured".into(), at_edge: true, ..marks }));
    Some(picture)
}

/// Where the damping is zero there is a cycle: stable where the damping grows through zero.
fn zero(from: Point, to: Point) -> Marks {
    let x = from.x + from.y / (from.y - to.y) * (to.x - from.x);
    let CycleStyle { mark, role, name, .. } = cycle_style(to.y > from.y);
    Marks { name: name.into(), brief: name, ..Marks::new(mark, role, vec![Point { x, y: 0.0 }]) }
}
