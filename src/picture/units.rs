//! The axes of a machine in its own units: metres, seconds, and parts of these.

use super::reading::CELLS;
use super::ticks::Scale;
use crate::oscillator::belt::Units as Physical;
use crate::scene::{Layer, Point, Span, View, Window};
use crate::session::Session;
use crate::words::number::resolved;

/// Names of an axis with the units that it can have, the largest first, and how many of them are one in SI units.
type AxisUnits = [(&'static str, &'static str, f64); 3];

const LENGTHS: AxisUnits = [("x [m]", "m", 1.0), ("x [mm]", "mm", 1e3), ("x [um]", "um", 1e6)];

const VELOCITIES: AxisUnits =
    [("v [m/s]", "m/s", 1.0), ("v [mm/s]", "mm/s", 1e3), ("v [um/s]", "um/s", 1e6)];

const TIMES: AxisUnits = [("t [s]", "s", 1.0), ("t [ms]", "ms", 1e3), ("t [us]", "us", 1e6)];

/// The units of the machine or the record in which a session shows its axes.
fn shown(session: &Session) -> Option<Physical> {
    session.units().filter(|_| !session.look.dimensionless)
}

/// The largest unit of which the axis reaches one, when 1 on it is so much in SI units.
fn chosen(units: &AxisUnits, one: f64, span: Span) -> (&'static str, &'static str, f64) {
    let far = one * span.from().abs().max(span.to().abs());
    let (name, unit, per_si) =
        *units.iter().find(|(.., per_si)| far * per_si >= 1.0).unwrap_or(&units[2]);
    (name, unit, one * per_si)
}

fn scale(units: &AxisUnits, one: f64, span: Span) -> Scale {
    let (name, _, factor) = chosen(units, one, span);
    Scale::Times { factor, name }
}

/// The axes of the plot with this index in the units of the machine; `None` where there is none, or where the plot
/// has no such axes.
pub fn scales(session: &Session, index: usize) -> Option<[Scale; 2]> {
    let units = shown(session)?;
    let plot = session.plots.get(index)?;
    let Window { x, y } = plot.window;
    let length = |span| scale(&LENGTHS, units.displacement, span);
    Some(match plot.view {
        View::Phase => [length(x), scale(&VELOCITIES, units.velocity, y)],
        View::Belt => [length(x), Scale::Even],
        View::TimeSeries => {
            // Curves of other quantities have no length.
            let others = [Layer::Velocity, Layer::Friction, Layer::Energy];
            let alone = !others.iter().any(|layer| session.layers.contains(layer));
            let upward = if alone { length(y) } else { Scale::Even };
            [scale(&TIMES, units.time, x), upward]
        }
        _ => return None,
    })
}

/// A place of the phase plane in the units of the machine, to the digits that can be told apart.
pub fn reading(session: &Session, at: Point, window: Window) -> Option<String> {
    let units = shown(session)?;
    let text = |table: &AxisUnits, one: f64, value: f64, span: Span| {
        let (_, unit, factor) = chosen(table, one, span);
        format!("{} {unit}", resolved(factor * value, factor * span.width() / CELLS))
    };
    Some(format!(
        "x {} v {}",
        text(&LENGTHS, units.displacement, at.x, window.x),
        text(&VELOCITIES, units.velocity, at.y, window.y)
    ))
}
