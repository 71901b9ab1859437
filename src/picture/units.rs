//! Numbers along axes: in the units of a machine (metres, seconds, and parts of these), and to the digits that can be
//! told apart.

use super::Scale;
use crate::model::{Knob, Units as Physical};
use crate::scene::{Layer, Span, View, Window};
use crate::session::{Plot, Session};
use crate::words::resolved;

/// How many of the units that an axis can have are one in SI units, the largest unit first.
const PER_SI: [f64; 3] = [1.0, 1e3, 1e6];

/// The names of an axis with these units.
type AxisNames = [&'static str; 3];

const LENGTHS: AxisNames = ["x [m]", "x [mm]", "x [um]"];

const VELOCITIES: AxisNames = ["v [m/s]", "v [mm/s]", "v [um/s]"];

const CYCLES: AxisNames = ["x_max [m]", "x_max [mm]", "x_max [um]"];

const TIMES: AxisNames = ["t [s]", "t [ms]", "t [us]"];

/// The units of the machine or the record in which a session shows its axes.
pub fn shown(session: &Session) -> Option<Physical> {
    session.units().filter(|_| !session.display.dimensionless)
}

/// The scale in the largest unit of which the axis reaches one, when 1 on it is so much in SI units.
fn scale(names: AxisNames, one: f64, span: Span) -> Scale {
    let far = one * span.farthest();
    let unit = PER_SI.iter().position(|per_si| far * per_si >= 1.0).unwrap_or(2);
    Scale::Times { factor: one * PER_SI[unit], name: names[unit] }
}

/// The axes of the plot with this index in the units of the machine; `None` where there is none, or where the plot
/// has no such axes.
pub fn scales(session: &Session, index: usize) -> Option<[Scale; 2]> {
    let units = shown(session)?;
    let Plot { view, window: Window { x, y }, .. } = session.plots[index];
    let length = |span| scale(LENGTHS, units.displacement, span);
    Some(match view {
        View::Phase => [length(x), scale(VELOCITIES, units.velocity, y)],
        View::Belt => [length(x), Scale::Even],
        View::TimeSeries => {
            // Curves of other quantities have no length.
            let others = [Layer::Velocity, Layer::Friction, Layer::Energy];
            let alone = !others.iter().any(|layer| session.layers.contains(layer));
            let upward = if alone { length(y) } else { Scale::Even };
            [scale(TIMES, units.time, x), upward]
        }
        // It has SI units by itself.
        View::BeltDiagram => [Scale::Even, scale(CYCLES, 1.0, y)],
        _ => return None,
    })
}

/// `name [unit]`.
pub fn with_unit(name: &str, unit: &str) -> String {
    if unit.is_empty() {
        name.into()
    } else {
        format!("{name} [{unit}]")
    }
}

/// The label of an axis over a number.
pub fn label(knob: Knob) -> String {
    with_unit(knob.spec().name, knob.spec().unit)
}

/// A number along an axis under its name there, or under `name` where the axis has no other unit, to the digits that
/// can be told apart.
pub fn said(scale: Scale, name: &str, value: f64, span: Span) -> String {
    /// Cells of a large plot: what a cursor can tell apart.
    const CELLS: f64 = 200.0;
    let factor = if let Scale::Times { factor, .. } = scale {
        factor
    } else {
        1.0
    };
    let number = resolved(factor * value, factor * span.width() / CELLS);
    match scale.title(name).split_once(" [") {
        Some((symbol, unit)) => format!("{symbol} {number} {}", unit.trim_end_matches(']')),
        None => format!("{} {number}", scale.title(name)),
    }
}
