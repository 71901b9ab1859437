//! How a scene sets up its plots: their views, axes and windows, and how they share the screen.
//!
//! The axes of a diagram are a parameter to the right and a property of the cycles upwards. [`ORDINATES`] is the one
//! table of properties. Each is computed from the same cycles, so that a change of the ordinate needs no new branch.
//! Most also follow from the first-order harmonic balance; for the others, its curves are not drawn.

use std::f64::consts::{LN_10, TAU};

use serde::de::{Deserializer, Error};
use serde::{Deserialize, Serialize};
use strum::{IntoStaticStr, VariantArray};

use super::views::View;
use super::window::{Span, Window};
use crate::model::{Group, Knob};
use crate::portrait::Cycle;

/// A property of a cycle that the diagram can show.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Ordinate {
    QMax,
    QMin,
    VMax,
    /// Half of the distance between the turning points.
    Amplitude,
    /// The middle between the turning points.
    Mean,
    Period,
    /// Floquet multiplier, as its decimal logarithm.
    Multiplier,
}

/// The unit of lengths on the ordinate of a diagram.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Unit {
    /// The unit of length of the equation.
    #[default]
    #[serde(rename = "1")]
    One,
    /// The friction r, half the width of the sticking set: by the scaling symmetry, lengths divided by r depend
    /// on r only through `r D2` and `r^2 D3`.
    #[serde(rename = "r")]
    Friction,
}

/// One row of [`ORDINATES`].
#[derive(Clone, Copy, Debug)]
pub struct OrdinateSpec {
    pub ordinate: Ordinate,
    /// Its name in scene files.
    pub name: &'static str,
    /// Its label at the axis.
    pub label: &'static str,
    /// Its label at the axis in units of r; `None` where it is not a length.
    pub ratio: Option<&'static str>,
    /// Explanation in a few words.
    pub meaning: &'static str,
    /// Computes it for a cycle.
    pub read: fn(&Cycle) -> f64,
    /// Computes it for the first-order harmonic answer `q = A0 + A cos(tau)`, from A0 and A; `None` where that
    /// answer does not determine it.
    pub harmonic: Option<fn(f64, f64) -> f64>,
    /// Whether a fitted window has an end at zero.
    pub from_zero: bool,
}

impl OrdinateSpec {
    /// A row without a harmonic answer whose values are no lengths.
    const fn of(
        ordinate: Ordinate,
        name: &'static str,
        meaning: &'static str,
        read: fn(&Cycle) -> f64,
    ) -> Self {
        let (label, ratio, harmonic) = (name, None, None);
        OrdinateSpec { ordinate, name, label, ratio, meaning, read, harmonic, from_zero: true }
    }

    /// The same of lengths, with their label in units of r.
    const fn lengths(self, ratio: &'static str, harmonic: fn(f64, f64) -> f64) -> Self {
        OrdinateSpec { ratio: Some(ratio), harmonic: Some(harmonic), ..self }
    }
}

/// Every property, in the order in which the key visits them.
pub const ORDINATES: [OrdinateSpec; 7] = [
    OrdinateSpec::of(Ordinate::QMax, "q_max", "right turning point of the cycles", |it| it.q_max)
        .lengths("A_q/r", |mean, amplitude| mean + amplitude),
    OrdinateSpec::of(Ordinate::QMin, "q_min", "left turning point of the cycles", |it| it.q_min)
        .lengths("q_min/r", |mean, amplitude| mean - amplitude),
    OrdinateSpec::of(Ordinate::VMax, "v_max", "largest velocity of the cycles", |it| it.v_max)
        .lengths("A_v/r", |_, amplitude| amplitude),
    OrdinateSpec {
        meaning: "half of the distance between the turning points",
        ..OrdinateSpec::of(Ordinate::Amplitude, "amplitude", "", |it| 0.5 * (it.q_max - it.q_min))
            .lengths("amplitude/r", |_, amplitude| amplitude)
    },
    OrdinateSpec {
        meaning: "middle between the turning points",
        from_zero: false,
        ..OrdinateSpec::of(Ordinate::Mean, "mean", "", |it| 0.5 * (it.q_max + it.q_min))
            .lengths("mean/r", |mean, _| mean)
    },
    OrdinateSpec {
        harmonic: Some(|_, _| TAU),
        from_zero: false,
        ..OrdinateSpec::of(Ordinate::Period, "period", "period of the cycles", |it| it.period)
    },
    OrdinateSpec {
        label: "lg multiplier",
        meaning: "decimal logarithm of the Floquet multiplier; below 0 stable",
        ..OrdinateSpec::of(Ordinate::Multiplier, "multiplier", "", |it| it.log_multiplier / LN_10)
    },
];

impl Ordinate {
    /// The row of [`ORDINATES`] that describes this property.
    pub fn spec(self) -> &'static OrdinateSpec {
        &ORDINATES[self as usize]
    }

    /// The value of this property for a cycle.
    pub fn of(self, cycle: &Cycle) -> f64 {
        (self.spec().read)(cycle)
    }
}

/// The measure of heights in a diagram: a property of cycles and its unit.
#[derive(Clone, Copy, Debug)]
pub struct Height {
    pub ordinate: Ordinate,
    /// Unit of lengths.
    pub unit: Unit,
    /// The friction r throughout the diagram; `None` where r itself is the abscissa.
    pub friction: Option<f64>,
}

impl Height {
    /// The height of a cycle at a value of the parameter of the diagram.
    pub fn of(&self, value: f64, cycle: &Cycle) -> f64 {
        self.scaled(value, self.ordinate.of(cycle))
    }

    /// The height that corresponds to this value of the property; infinite or NaN in units of a friction that
    /// is zero.
    pub fn scaled(&self, value: f64, size: f64) -> f64 {
        if self.is_ratio() {
            size / self.friction.unwrap_or(value)
        } else {
            size
        }
    }

    /// Whether heights are in units of r.
    pub fn is_ratio(&self) -> bool {
        self.unit == Unit::Friction && self.ordinate.spec().ratio.is_some()
    }
}

/// The first range of a parameter in a diagram.
pub fn usual_values(knob: Knob) -> Span {
    let (from, to) = knob.spec().drawn;
    Span::known(from, to)
}

/// Maximum number of plots on a screen: more would be too small to read.
pub const MOST_PLOTS: usize = 4;

/// The axes of a plot. A view that leaves no choice ignores them and keeps them for other views.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Axes {
    /// The parameter to the right.
    pub abscissa: Knob,
    /// The property of the cycles upwards.
    pub ordinate: Ordinate,
    /// The unit of the ordinate, where that is a length.
    #[serde(default)]
    pub unit: Unit,
    /// The parameter upwards, in a chart over two parameters.
    pub against: Knob,
    /// The number of a machine to the right, in a diagram of its cycles.
    #[serde(default = "belt_speed", skip_serializing_if = "is_usual")]
    #[serde(deserialize_with = "number_of_machine")]
    pub machine: Knob,
}

fn belt_speed() -> Knob {
    Knob::BeltSpeed
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "serde gives a reference")]
fn is_usual(machine: &Knob) -> bool {
    *machine == belt_speed()
}

fn number_of_machine<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Knob, D::Error> {
    let name = String::deserialize(deserializer)?;
    Knob::named(&name, &[Group::Machine, Group::Law]).map_err(D::Error::custom)
}

impl Default for Axes {
    /// The axes of the paper's diagrams.
    fn default() -> Self {
        Axes {
            abscissa: Knob::D,
            ordinate: Ordinate::QMax,
            unit: Unit::One,
            against: Knob::D3,
            machine: Knob::BeltSpeed,
        }
    }
}

impl Axes {
    /// The number to the right in a view.
    pub fn right(&self, view: View) -> Knob {
        if view == View::BeltDiagram {
            self.machine
        } else {
            self.abscissa
        }
    }

    /// The same with another number to the right in a view.
    pub fn with_right(self, view: View, knob: Knob) -> Self {
        match view {
            View::BeltDiagram => Axes { machine: knob, ..self },
            _ => Axes { abscissa: knob, ..self },
        }
    }

    /// The label of the ordinate of a diagram.
    pub fn label(&self) -> &'static str {
        let spec = self.ordinate.spec();
        spec.ratio.filter(|_| self.unit == Unit::Friction).unwrap_or(spec.label)
    }

    /// The measure of heights in a diagram whose cycles are computed at this friction.
    pub fn height(&self, friction: f64) -> Height {
        let friction = (self.abscissa != Knob::R).then_some(friction);
        Height { ordinate: self.ordinate, unit: self.unit, friction }
    }
}

/// A plot as a scene sets it up: its view, its axes, and the part to show.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PlotSetup {
    pub view: View,
    /// The axes, where the view leaves a choice.
    pub axes: Axes,
    /// The part to show; `None` for a window fitted to the content.
    pub window: Option<Window>,
    /// The family of variants, by its index in the scene, that the plot shows in place of the present values.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub family: Option<usize>,
}

impl PlotSetup {
    /// A view with these axes, in a fitted window. A machine's diagram is over the speed of its belt: the range of its
    /// other numbers depends on the machine.
    pub fn fitting(view: View, axes: Axes) -> Self {
        let axes = Axes { machine: Knob::BeltSpeed, ..axes };
        PlotSetup { view, axes, window: None, family: None }
    }

    /// The window with which the plot opens, or from which fitting begins if none is given.
    pub fn opening(&self) -> Window {
        let usual = self.view.spec().window;
        self.window.unwrap_or(match self.view {
            View::Diagram => Window { x: usual_values(self.axes.abscissa), ..usual },
            View::Regimes => {
                Window { x: usual_values(self.axes.abscissa), y: usual_values(self.axes.against) }
            }
            _ => usual,
        })
    }
}

/// How the plots share the screen, in the order in which the key cycles through it.
#[derive(
    Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, IntoStaticStr, VariantArray,
)]
#[serde(rename_all = "kebab-case")]
#[strum(serialize_all = "kebab-case")]
pub enum Arrangement {
    /// The arrangement in which the plots are closest to squares.
    #[default]
    Auto,
    Columns,
    Rows,
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numerics::elementary::ln;

    #[test]
    fn every_ordinate_stands_at_its_own_row_under_the_name_of_scene_files() {
        for row in &ORDINATES {
            assert_eq!(row.ordinate.spec().name, row.name);
            assert_eq!(serde_json::to_value(row.ordinate).unwrap(), row.name);
        }
    }

    fn cycle() -> Cycle {
        Cycle {
            stable: true,
            q_min: -3.0,
            q_max: 1.0,
            v_min: -2.5,
            v_max: 2.0,
            period: 6.5,
            multiplier: Some(0.01),
            log_multiplier: ln(0.01),
            clearance: 0.9,
            log_clearance: ln(0.9),
            ..Cycle::default()
        }
    }

    #[test]
    fn lengths_are_measured_in_r_and_all_else_is_not() {
        let cycle = cycle();
        for row in &ORDINATES {
            let height = |friction| {
                let ordinate = row.ordinate;
                Height { ordinate, unit: Unit::Friction, friction }.of(0.5, &cycle)
            };
            let plain = row.ordinate.of(&cycle);
            let ratios = if row.ratio.is_some() {
                [plain / 0.25, plain / 0.5]
            } else {
                [plain; 2]
            };
            assert_eq!([height(Some(0.25)), height(None)], ratios, "{}", row.name);
            assert_eq!(row.ratio.is_some_and(|name| name.ends_with("/r")), row.ratio.is_some());
        }
    }

    #[test]
    fn every_ordinate_is_read_out_of_a_cycle() {
        let cycle = cycle();
        let [lengths @ .., multiplier] = ORDINATES.map(|row| row.ordinate.of(&cycle));
        assert_eq!(lengths, [1.0, -3.0, 2.0, 2.0, -1.0, 6.5]);
        assert!((multiplier + 2.0).abs() < 1e-15);
    }

    #[test]
    fn arrangements_have_the_names_of_scene_files() {
        for arrangement in Arrangement::VARIANTS {
            let name: &str = arrangement.into();
            assert_eq!(serde_json::to_value(arrangement).unwrap(), name);
        }
    }
}
