//! Rest in a bifurcation diagram: with friction the sticking set, a band that attracts; without, the
//! equilibrium at 0, stable on one side of the Hopf point and unstable on the other.

use super::{Dash, Fill, Item, LineStyle, Picture, Role};
use crate::model::{Knob, Parameters};
use crate::scene::{Height, Ordinate, Point};
use crate::session::ShownMotion;

/// The name of rest in every diagram.
pub(super) const REST: &str = "rest (attracts)";

/// Draws where one of the motions of a diagram can rest; nothing where the ordinate is not a property of a
/// rest (its period, its multiplier).
pub fn draw(
    picture: &mut Picture,
    shown: &ShownMotion,
    (name, dash): (&'static str, Dash),
    abscissa: Knob,
    height: Height,
) {
    let has_band = match height.ordinate {
        Ordinate::QMax | Ordinate::QMin | Ordinate::Mean => true,
        Ordinate::VMax | Ordinate::Amplitude => false,
        Ordinate::Period | Ordinate::Multiplier => return,
    };
    if shown.problem.parameters.r == 0.0 && abscissa != Knob::R {
        // There is no height in units of a friction that is zero.
        if !height.is_ratio() {
            point(picture, shown, abscissa);
        }
        return;
    }
    let line = LineStyle { dash, ..LineStyle::from(name) }.of(&shown.variant);
    if !has_band {
        return picture.level(line, 0.0);
    }
    let of = shown.clone();
    let edge = move |value: f64| {
        let r = of.problem.parameters.with(abscissa, value).r;
        let unit = if height.is_ratio() { r } else { 1.0 };
        (r >= 0.0 && unit > 0.0).then_some(r / unit)
    };
    let (upper, lower) = (edge, edge);
    let band = edge(picture.window.x.from()).filter(|_| abscissa != Knob::R);
    if abscissa == Knob::R {
        let fill = Fill { role: Role::Sticking, name };
        let within =
            move |place: Point| edge(place.x).filter(|edge| place.y.abs() <= *edge).map(|_| fill);
        picture.items.push(Item::Texture(Box::new(within)));
    }
    picture.graph(line.clone(), upper);
    if picture.window.y.from() < 0.0 {
        picture.graph(line.clone(), move |value| lower(value).map(|edge| -edge));
    }
    if let Some(edge) = band {
        picture.items.push(Item::Rows(line, -edge, edge));
    }
}

/// Whether the equilibrium without friction is stable: decided by the eigenvalues (9), on the imaginary axis
/// by cubic damping, whatever D2 (its first integral grows or falls with D3 alone); `None` for a centre.
fn is_stable(parameters: &Parameters) -> Option<bool> {
    let Parameters { d, d3, .. } = *parameters;
    let decisive = if d == 0.0 { d3 } else { d };
    (decisive != 0.0).then_some(decisive > 0.0)
}

/// The equilibrium at 0 without friction.
fn point(picture: &mut Picture, shown: &ShownMotion, abscissa: Knob) {
    for (stable, name) in [(true, "rest (stable)"), (false, "rest (unstable)")] {
        let of = shown.clone();
        picture.graph(LineStyle::from(name).of(&shown.variant), move |value| {
            (is_stable(&of.problem.parameters.with(abscissa, value)) == Some(stable)).then_some(0.0)
        });
    }
}
