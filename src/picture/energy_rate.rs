//! The rate V' of the energy over the velocity, of which alone it is a function (17 to 19): what damping
//! feeds, what friction takes, and between which velocities friction takes more.

use super::{LineStyle, Mark, Picture, Role};
use crate::closed_form::lyapunov::{self, energy_rate};
use crate::model::Parameters;
use crate::scene::{Layer, Point};
use crate::session::Session;

pub fn draw(picture: &mut Picture, session: &Session) {
    picture.axes("v", "V'");
    let parameters = session.problem.parameters;
    let on_curve = |v: f64| Point { x: v, y: energy_rate(&parameters, v) };
    // The cursor reads the curve.
    picture.reading = picture.cursor.map(|at| picture.coordinates(on_curve(at.x)));
    if session.layers.contains(&Layer::Rate) {
        curves(picture, parameters);
    }
    picture.mark(Mark::Start, on_curve(session.problem.initial.v), Role::Trajectory);
    if let Some(head) = session.head() {
        picture.mark(Mark::Head, on_curve(head.v), Role::Cursor);
    }
}

fn curves(picture: &mut Picture, parameters: Parameters) {
    picture.level(LineStyle::guide(), 0.0);
    picture.upright(LineStyle::guide(), 0.0);
    let smooth = Parameters { r: 0.0, ..parameters };
    let dry = Parameters { d: 0.0, d2: 0.0, d3: 0.0, ..parameters };
    for (name, of) in [
        ("fed by damping", smooth),
        ("taken by friction", dry),
        ("rate of the energy V'", parameters),
    ] {
        picture.graph(name, move |v| Some(energy_rate(&of, v)));
    }
    if let Some(radius) = lyapunov::radius(&parameters).filter(|radius| *radius > 0.0) {
        for (v, name) in [(radius, "l"), (-radius, "-l")] {
            let at = [v, energy_rate(&parameters, v)];
            picture.mark(Mark::Turn, at, Role::Lyapunov);
            picture.caption(at, name, Role::Lyapunov);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::picture::items::Item;
    use crate::scene::{View, find};
    use crate::session::Size;

    #[test]
    fn the_parts_add_up_and_the_energy_falls_within_the_lyapunov_radius() {
        let scene = find("fig04").unwrap();
        let session = Session::new(scene, Size { width: 120, height: 40 });
        let plot = session.plots.iter().position(|plot| plot.view == View::EnergyRate).unwrap();
        let picture = crate::picture::of(&session, plot);
        let radius = lyapunov::radius(&session.problem.parameters).unwrap();
        let graphs: Vec<_> = picture
            .items
            .iter()
            .filter_map(|item| match item {
                Item::Graph(line, value) if !line.name.is_empty() => Some(value),
                _ => None,
            })
            .collect();
        let [fed, taken, whole] = graphs[..] else { panic!("{} graphs", graphs.len()) };
        for v in [-2.0, -0.3, 0.7, 1.9] {
            let (fed, taken, whole) = (fed(v).unwrap(), taken(v).unwrap(), whole(v).unwrap());
            assert!(fed > 0.0 && taken < 0.0 && (fed + taken - whole).abs() < 1e-14);
            assert_eq!(whole < 0.0, v.abs() < radius);
        }
    }
}
