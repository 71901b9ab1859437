//! What stands on the diagram's axes: a parameter to the right, a property of the cycles upwards.
//!
//! [`ORDINATES`] is the one table of properties. Each is read out of a computed cycle, so that another
//! ordinate is another look at the same branch; most can be read out of the first-order harmonic answer
//! too, and where they cannot its curves are not drawn.

use std::f64::consts::{LN_10, TAU};

use serde::{Deserialize, Serialize};

use super::window::Span;
use crate::oscillator::Symbol;
use crate::study::Cycle;

/// A property of a cycle that the diagram can show.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Ordinate {
    /// Right turning point.
    QMax,
    /// Left turning point.
    QMin,
    /// Largest velocity.
    VMax,
    /// Half of the distance between the turning points.
    Amplitude,
    /// The middle between the turning points.
    Mean,
    /// Period.
    Period,
    /// Floquet multiplier, as its decimal logarithm.
    Multiplier,
}

/// One row of [`ORDINATES`].
#[derive(Clone, Copy, Debug)]
pub struct OrdinateSpec {
    /// The property.
    pub ordinate: Ordinate,
    /// Its name in scene files.
    pub name: &'static str,
    /// Its name at the axis.
    pub label: &'static str,
    /// What it is, in a few words.
    pub meaning: &'static str,
    /// Reads it out of a cycle.
    pub read: fn(&Cycle) -> f64,
    /// Reads it out of the first-order harmonic answer `q = A0 + A cos(tau)`, given A0 and A; `None`
    /// where that answer says nothing about it.
    pub harmonic: Option<fn(f64, f64) -> f64>,
    /// Whether a fitted window begins or ends at zero.
    pub from_zero: bool,
}

/// Every property, in the order in which the key visits them.
pub const ORDINATES: [OrdinateSpec; 7] = [
    OrdinateSpec {
        ordinate: Ordinate::QMax,
        name: "q_max",
        label: "q_max",
        meaning: "right turning point of the cycles",
        read: |cycle| cycle.q_max,
        harmonic: Some(|mean, amplitude| mean + amplitude),
        from_zero: true,
    },
    OrdinateSpec {
        ordinate: Ordinate::QMin,
        name: "q_min",
        label: "q_min",
        meaning: "left turning point of the cycles",
        read: |cycle| cycle.q_min,
        harmonic: Some(|mean, amplitude| mean - amplitude),
        from_zero: true,
    },
    OrdinateSpec {
        ordinate: Ordinate::VMax,
        name: "v_max",
        label: "v_max",
        meaning: "largest velocity of the cycles",
        read: |cycle| cycle.v_max,
        harmonic: Some(|_, amplitude| amplitude),
        from_zero: true,
    },
    OrdinateSpec {
        ordinate: Ordinate::Amplitude,
        name: "amplitude",
        label: "amplitude",
        meaning: "half of the distance between the turning points",
        read: |cycle| 0.5 * (cycle.q_max - cycle.q_min),
        harmonic: Some(|_, amplitude| amplitude),
        from_zero: true,
    },
    OrdinateSpec {
        ordinate: Ordinate::Mean,
        name: "mean",
        label: "mean",
        meaning: "middle between the turning points",
        read: |cycle| 0.5 * (cycle.q_max + cycle.q_min),
        harmonic: Some(|mean, _| mean),
        from_zero: false,
    },
    OrdinateSpec {
        ordinate: Ordinate::Period,
        name: "period",
        label: "period",
        meaning: "period of the cycles",
        read: |cycle| cycle.period,
        harmonic: Some(|_, _| TAU),
        from_zero: false,
    },
    OrdinateSpec {
        ordinate: Ordinate::Multiplier,
        name: "multiplier",
        label: "lg multiplier",
        meaning: "decimal logarithm of the Floquet multiplier; below 0 stable",
        read: |cycle| cycle.log_multiplier / LN_10,
        harmonic: None,
        from_zero: true,
    },
];

impl Ordinate {
    /// The row of [`ORDINATES`] that describes this property.
    #[must_use]
    pub fn spec(self) -> &'static OrdinateSpec {
        &ORDINATES[self as usize]
    }

    /// Reads the property out of a cycle.
    #[must_use]
    pub fn of(self, cycle: &Cycle) -> f64 {
        (self.spec().read)(cycle)
    }
}

/// The parameters that the diagram can be drawn over, each with the values first looked at: what
/// happens within one of them at frictions and damping of everyday size.
pub const ABSCISSAE: [(Symbol, Span); 4] = [
    (Symbol::D, Span::known(-0.9, 0.1)),
    (Symbol::D2, Span::known(-1.0, 1.0)),
    (Symbol::D3, Span::known(-1.0, 1.0)),
    (Symbol::R, Span::known(0.0, 0.5)),
];

/// The values of a parameter that are looked at first; of one that no diagram is drawn over, those of D.
#[must_use]
pub fn usual_values(symbol: Symbol) -> Span {
    ABSCISSAE.iter().find(|(row, _)| *row == symbol).map_or(ABSCISSAE[0].1, |(_, span)| *span)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_ordinate_stands_at_its_own_row_under_the_name_of_scene_files() {
        for row in &ORDINATES {
            assert_eq!(row.ordinate.spec().name, row.name);
            assert_eq!(serde_json::to_value(row.ordinate).unwrap(), row.name);
        }
    }

    #[test]
    fn every_ordinate_is_read_out_of_a_cycle() {
        let cycle = Cycle {
            stable: true,
            q_min: -3.0,
            q_max: 1.0,
            v_min: -2.5,
            v_max: 2.0,
            period: 6.5,
            multiplier: Some(0.01),
            log_multiplier: 0.01_f64.ln(),
            clearance: 0.9,
            log_clearance: 0.9_f64.ln(),
            error: 0.0,
        };
        let [lengths @ .., multiplier] = ORDINATES.map(|row| row.ordinate.of(&cycle));
        assert_eq!(lengths, [1.0, -3.0, 2.0, 2.0, -1.0, 6.5]);
        assert!((multiplier + 2.0).abs() < 1e-15);
    }
}
