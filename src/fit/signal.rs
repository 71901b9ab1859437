//! What a sensor measures, and its units: a displacement, a velocity or an acceleration.

use std::fmt;

use serde::{Deserialize, Serialize};

use crate::model::{LENGTH, in_si};

/// A measured quantity: the displacement, differentiated so many times by the time.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "explorer", derive(clap::ValueEnum))]
#[serde(rename_all = "kebab-case")]
pub enum Signal {
    /// The displacement itself.
    #[default]
    Displacement,
    /// Its derivative.
    Velocity,
    /// Its second derivative.
    Acceleration,
}

/// The signals with what follows the unit of length in theirs; that of a record comes first.
const SIGNALS: [(Signal, &str, &[&str]); 3] = [
    (Signal::Displacement, "displacement", &[""]),
    (Signal::Velocity, "velocity", &["/s"]),
    (Signal::Acceleration, "acceleration", &["/s^2", "/s2", "/s\u{b2}", "/s**2", "/s/s"]),
];

/// Units of quantities that are none of these.
const OTHERS: [(&str, &[&str]); 3] = [
    ("force", &["N", "mN", "kN", "lbf"]),
    ("voltage", &["V", "mV", "uV"]),
    ("current", &["A", "mA"]),
];

/// Standard gravity in m/s^2, the unit `g` of accelerometers.
const GRAVITY: f64 = 9.806_65;

impl fmt::Display for Signal {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.write_str(SIGNALS[self.order()].1)
    }
}

impl Signal {
    /// Whether the displacement itself is measured.
    #[must_use]
    pub fn is_displacement(&self) -> bool {
        *self == Signal::Displacement
    }

    /// How often the displacement is differentiated.
    #[must_use]
    pub fn order(self) -> usize {
        self as usize
    }

    /// The factor that makes the signal of an oscillation with this frequency swing as its displacement does.
    #[must_use]
    pub fn as_displacement(self, omega0: f64) -> f64 {
        let sign = if self == Signal::Acceleration { -1.0 } else { 1.0 };
        sign / self.scale(omega0)
    }

    /// What its dimensionless value is multiplied by for a motion with this frequency.
    #[must_use]
    pub fn scale(self, omega0: f64) -> f64 {
        (0..self.order()).fold(1.0, |scale, _| scale * omega0)
    }

    /// The names of all signals.
    #[must_use]
    pub fn names() -> String {
        SIGNALS.map(|(_, name, _)| name).join(", ")
    }

    /// The unit of the signal of a record with this unit of length; empty if that is unknown.
    #[must_use]
    pub fn unit(self, length: &str) -> String {
        let per_time = SIGNALS[self.order()].2[0];
        if length.is_empty() {
            String::new()
        } else {
            format!("{length}{per_time}")
        }
    }
}

/// The usual units of length.
pub const LENGTHS: [&str; 7] = ["m", "mm", "um", "cm", "nm", "in", "km"];

/// The value of a unit of length in metres; `None` if it is none, or made of several such as mm^2/m.
#[must_use]
pub fn length_in_metres(unit: &str) -> Option<f64> {
    in_si(unit, LENGTH).filter(|_| unit.chars().all(char::is_alphabetic))
}

/// What the column of a record holds.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SignalUnit {
    /// The signal.
    pub signal: Signal,
    /// The unit of length that belongs to its unit, if that is known; for a displacement the unit as it is written.
    pub length: Option<String>,
    /// What numbers are multiplied by to be in that unit of length and in s.
    pub scale: f64,
}

/// The signal that a unit belongs to, or else the name of its quantity; `None` for unknown units.
pub fn quantity(unit: &str) -> Option<Result<SignalUnit, &'static str>> {
    let plain = unit.replace(['\u{b5}', '\u{3bc}'], "u").replace(' ', "");
    let of = |signal, length: &str, scale| {
        Some(Ok(SignalUnit { signal, length: Some(length.to_owned()), scale }))
    };
    if plain == "g" {
        return of(Signal::Acceleration, "m", GRAVITY);
    }
    for (signal, _, endings) in SIGNALS {
        let mut lengths = endings.iter().filter_map(|ending| plain.strip_suffix(ending));
        if let Some(length) = lengths.find(|it| length_in_metres(it).is_some()) {
            return of(signal, length, 1.0);
        }
    }
    let found = OTHERS.iter().find(|(_, units)| units.contains(&plain.as_str()));
    found.map(|(quantity, _)| Err(*quantity))
}

/// Combines the unit in the header, the unit and the signal that the user names, and the signal that the name of the
/// column suggests.
///
/// # Errors
/// One line if they contradict each other, or if the quantity is none of the signals.
pub fn measure(
    written: Option<&str>,
    said: Option<&str>,
    signal: Option<Signal>,
    suggested: Option<Signal>,
) -> Result<SignalUnit, String> {
    let mut found = SignalUnit { signal: signal.unwrap_or_default(), length: None, scale: 1.0 };
    let mut certain = signal.is_some();
    for unit in [written, said].into_iter().flatten() {
        match quantity(unit) {
            Some(Err(other)) => {
                return Err(format!(
                    "{unit:?} is a unit of {other}; expected one of {}, such as mm, mm/s or m/s^2",
                    Signal::names()
                ));
            }
            Some(Ok(known)) if certain && known.signal != found.signal => {
                return Err(format!(
                    "{unit:?} is a unit of {}, not of {}",
                    known.signal, found.signal
                ));
            }
            Some(Ok(known)) => {
                certain = true;
                // The unit of a displacement stays as it is written.
                let is_plain = known.signal.is_displacement();
                let length = if is_plain {
                    Some(unit.to_owned())
                } else {
                    known.length
                };
                found = SignalUnit { length, ..known };
            }
            None => found.length = Some(unit.to_owned()),
        }
    }
    if !certain {
        found.signal = suggested.unwrap_or_default();
    }
    if !found.signal.is_displacement() {
        found.length = found.length.filter(|length| length_in_metres(length).is_some());
    }
    Ok(found)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_tell_signal_length_and_scale() {
        for (unit, signal, length, scale) in [
            ("mm", Signal::Displacement, "mm", 1.0),
            ("\u{b5}m/s", Signal::Velocity, "um", 1.0),
            ("m/s\u{b2}", Signal::Acceleration, "m", 1.0),
            ("mm / s^2", Signal::Acceleration, "mm", 1.0),
            ("g", Signal::Acceleration, "m", 9.806_65),
        ] {
            let length = Some(length.to_owned());
            assert_eq!(quantity(unit), Some(Ok(SignalUnit { signal, length, scale })));
        }
        assert_eq!(quantity("mV"), Some(Err("voltage")));
        assert_eq!(quantity("counts"), None);
    }

    #[test]
    fn what_contradicts_is_refused_and_what_is_unknown_is_left_to_the_user() {
        let velocity = Some(Signal::Velocity);
        let refused = |written, said, signal| measure(written, said, signal, None).unwrap_err();
        assert_eq!(
            refused(Some("mm"), None, velocity),
            "\"mm\" is a unit of displacement, not of velocity"
        );
        assert_eq!(
            refused(Some("m/s"), Some("mm"), None),
            "\"mm\" is a unit of displacement, not of velocity"
        );
        assert!(refused(Some("N"), None, velocity).starts_with("\"N\" is a unit of force; "));
        let told = |written, said| measure(written, said, velocity, None).unwrap().length;
        assert_eq!(told(Some("counts"), None), None);
        assert_eq!(told(Some("counts"), Some("mm/s")), Some("mm".into()));
        let suggested = measure(None, None, None, velocity).unwrap();
        assert_eq!((suggested.signal, suggested.length), (Signal::Velocity, None));
    }
}
