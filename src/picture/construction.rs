//! Formulas drawn into the phase plane: levels of the energy, and the spirals that make the cycle.

use super::{Item, Mark, Picture, Role, ellipse};
use crate::closed_form::lyapunov::energy_rate;
use crate::closed_form::{LinearCycle, LinearFlow};
use crate::model::Parameters;
use crate::numerics::{TO_ROUNDING, bisect};
use crate::scene::Span;

/// Circles on which the energy V is the same, and shaded the velocities at which it falls.
pub fn levels(picture: &mut Picture, parameters: &Parameters) {
    /// Circles in the window.
    const LEVELS: u8 = 2;
    let y = picture.window.y;
    let falling = falling(parameters, y).into_iter();
    picture.items.extend(falling.map(|(from, to)| Item::Rows("energy falls".into(), from, to)));
    for level in 1..=LEVELS {
        let radius = 0.5 * y.width() * f64::from(level) / f64::from(LEVELS);
        picture.curve("level of the energy", ellipse((0.0, radius), (0.0, radius)));
    }
}

/// The intervals of velocities, within some, at which the energy falls: V' depends on nothing else
/// (17 to 19). Their ends are exact to rounding.
fn falling(parameters: &Parameters, among: Span) -> Vec<(f64, f64)> {
    /// Velocities whose sign of V' is looked at; borders between them are bisected.
    const VELOCITIES: u32 = 400;
    let falls = |v: f64| energy_rate(parameters, v) <= 0.0;
    let velocities: Vec<f64> = among.evenly(VELOCITIES).collect();
    let border = |pair: &[f64]| {
        let (inside, outside) = match [falls(pair[0]), falls(pair[1])] {
            [true, false] => (pair[0], pair[1]),
            [false, true] => (pair[1], pair[0]),
            _ => return None,
        };
        Some(bisect(inside, outside, TO_ROUNDING, |v| !falls(v)).0)
    };
    let [first, last] = [0.0, 1.0].map(|end| Some(among.at(end)).filter(|v| falls(*v)));
    let borders = velocities.windows(2).filter_map(border);
    let ends: Vec<f64> = first.into_iter().chain(borders).chain(last).collect();
    ends.chunks_exact(2).map(|pair| (pair[0], pair[1])).collect()
}

/// The half turns of two spirals, one shifted to the left by r and one to the right, whose ends meet
/// (25, 30), and their continuations.
pub fn spirals(picture: &mut Picture, parameters: &Parameters) {
    /// Points on a half turn.
    const POINTS: u16 = 160;
    let Parameters { d, r, .. } = *parameters;
    let Some(cycle) = LinearCycle::new(d, r) else { return };
    if !parameters.is_piecewise_linear() {
        return;
    }
    let duration = 0.5 * cycle.period;
    let turn = |from: f64, to: f64, side: f64| {
        (0..=POINTS).map(move |index| {
            let along = f64::from(index) / f64::from(POINTS);
            let tau = duration * (from + (to - from) * along);
            let (x, v) = LinearFlow::new(d).state(-cycle.clearance, 0.0, tau);
            [side * (x - r), side * v]
        })
    };
    for (side, name) in
        [(1.0, "half turn about the left end"), (-1.0, "half turn about the right end")]
    {
        for (from, to) in [(-2.0, 0.0), (1.0, 2.0)] {
            picture.curve("the same spiral before and after", turn(from, to, side));
        }
        picture.curve(name, turn(0.0, 1.0, side));
        picture.mark(Mark::Head, [-side * r, 0.0], Role::Special);
        let end = [side * (r + cycle.clearance), 0.0];
        picture.mark(Mark::Turn, end, Role::Special);
        picture.caption(end, if side > 0.0 { "r + c" } else { "-r - c" }, Role::Special);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numerics::elementary::tanh;
    use crate::picture::Dash;
    use crate::scene::Window;

    fn picture() -> Picture<'static> {
        let span = Span::known(-3.0, 3.0);
        Picture::new("", "q", "v", Window { x: span, y: span })
    }

    #[test]
    fn the_energy_falls_within_the_lyapunov_radius() {
        let mut picture = picture();
        levels(&mut picture, &Parameters { d: -0.4, d2: 0.0, d3: 0.0, r: 1.0 });
        let strips: Vec<_> = picture
            .items
            .iter()
            .filter_map(|item| match item {
                Item::Rows(_, from, to) => Some((*from, *to)),
                _ => None,
            })
            .collect();
        assert_eq!(strips.len(), 1);
        assert!((strips[0].0 + 1.25).abs() < 1e-12 && (strips[0].1 - 1.25).abs() < 1e-12);
    }

    #[test]
    fn the_end_of_each_half_turn_is_the_start_of_the_other() {
        let mut picture = picture();
        spirals(&mut picture, &Parameters { d: -0.2, d2: 0.0, d3: 0.0, r: 0.5 });
        let halves: Vec<_> = picture
            .items
            .iter()
            .filter_map(|item| match item {
                Item::Curve(line, points) if line.dash == Dash::Solid => Some(points.clone()),
                _ => None,
            })
            .collect();
        let [upper, lower] = &halves[..] else { panic!("{} halves", halves.len()) };
        for (end, start) in [(upper.last(), lower.first()), (lower.last(), upper.first())] {
            let (end, start) = (end.unwrap(), start.unwrap());
            assert!((end.x - start.x).abs() < 1e-13 && end.y.abs() < 1e-13);
        }
        let growth = 0.2 * std::f64::consts::PI / (1.0_f64 - 0.04).sqrt();
        assert!((upper.last().unwrap().x - 0.5 / tanh(0.5 * growth)).abs() < 1e-13);
    }
}
