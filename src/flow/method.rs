//! The methods that integrate a motion.

use std::fmt;

use serde::{Deserialize, Serialize};

use crate::model::Knob;

/// One row of [`METHODS`].
#[derive(Clone, Copy, Debug)]
pub struct MethodSpec {
    /// The method.
    pub method: Method,
    /// Its name on the command line and on the screen.
    pub name: &'static str,
    /// The number that sets its accuracy: the relative error or the length of a step, or the velocity over which
    /// friction is smoothed; `None` if it is exact.
    pub dial: Option<Knob>,
    /// Whether it locates the arrivals at `v = 0`, and hence where a motion rests.
    pub events: bool,
    /// Order of accuracy, in words.
    pub order: &'static str,
    /// What it promises, and under which assumption.
    pub guarantee: &'static str,
    /// Its origin: publication, equations or practice.
    pub source: &'static str,
}

/// Makes [`Method`] and [`METHODS`] from one list, in display order: name, the number that sets the accuracy, whether
/// events are found, order, guarantee, source.
macro_rules! methods {
    ($($(#[$attribute:meta])* $method:ident: $name:literal, $dial:expr, $events:literal, $order:literal,
        $guarantee:literal, $source:literal;)*) => {
        /// An integration method.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
        #[serde(rename_all = "kebab-case")]
        pub enum Method {
            $($(#[$attribute])* $method,)*
        }

        /// Every method, in display order.
        pub const METHODS: &[MethodSpec] = &[$(MethodSpec {
            method: Method::$method,
            name: $name,
            dial: $dial,
            events: $events,
            order: $order,
            guarantee: $guarantee,
            source: $source,
        }),*];
    };
}

methods! {
    /// The cheapest method that meets the requested tolerance.
    Auto: "auto", Some(Knob::Tolerance), true, "that of the method chosen",
        "exact where D2 = D3 = 0, else taylor, stiff while stability limits its steps",
        "measured, see the trade table";
    /// Closed form of the piecewise linear oscillator.
    Exact: "exact", None, true, "closed form",
        "rounding error only; D2 = D3 = 0",
        "equations 25 to 33, corrected";
    /// Taylor series of the polynomial field.
    Taylor: "taylor", Some(Knob::Tolerance), true, "8 to 26 with the tolerance",
        "relative error of a step below the tolerance; crossings are roots of its polynomial",
        "Jorba and Zou, Experimental Mathematics 14 (2005)";
    /// Explicit Runge-Kutta pair of order 8.
    Dop853: "dop853", Some(Knob::Tolerance), true, "8, error estimates 5 and 3",
        "relative error of a step below the tolerance",
        "Hairer, Norsett and Wanner, Solving Ordinary Differential Equations I";
    /// Explicit Runge-Kutta pair of order 5.
    Dopri5: "dopri5", Some(Knob::Tolerance), true, "5, error estimate 4",
        "relative error of a step below the tolerance",
        "Dormand and Prince, J. Comp. Appl. Math. 6 (1980)";
    /// The classical Runge-Kutta method of order 4, with a fixed step.
    Rk4: "rk4", Some(Knob::Step), true, "4, no error estimate",
        "crossings as good as its steps; refuses steps that are unstable",
        "Kutta, Z. Math. Phys. 46 (1901)";
    /// Implicit collocation for stiff motions.
    Stiff: "stiff", Some(Knob::Tolerance), true, "5, 9 or 13 with the tolerance",
        "relative error of a step near the tolerance; L-stable, analytic Jacobian",
        "Radau IIA; Hairer and Wanner, J. Comp. Appl. Math. 111 (1999)";
    /// Friction smoothed to `r tanh(v/epsilon)`, without events.
    Smoothed: "smoothed", Some(Knob::Epsilon), false, "1 in epsilon",
        "never sticks: it creeps at a speed of order epsilon; cost grows as 1/epsilon (dop853)",
        "common practice: sign(v) becomes tanh(v/epsilon)";
    /// The classical Runge-Kutta method with `sign(v)` in the field, without events.
    SignRk4: "sign-rk4", Some(Knob::Step), false, "1: each passage of v = 0 costs the rest",
        "none: it chatters across v = 0 and rests nowhere",
        "common practice: rk4 with sign(v) in the field";
    /// Moreau and Jean's time stepping, without events.
    TimeStepping: "time-stepping", Some(Knob::Step), false, "2 within a half swing, 1 across v = 0",
        "sticks where the balance of one step says so; no crossing is located",
        "Moreau (1988); Jean, Comput. Methods Appl. Mech. Eng. 177 (1999)";
}

impl Method {
    /// The row of [`METHODS`] that describes this method.
    #[must_use]
    pub fn spec(self) -> &'static MethodSpec {
        &METHODS[self as usize]
    }

    /// The number that sets its accuracy; for the closed form the tolerance, which has no effect.
    #[must_use]
    pub fn dial(self) -> Knob {
        self.spec().dial.unwrap_or(Knob::Tolerance)
    }

    /// The method with this name.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        METHODS.iter().find(|row| row.name == name).map(|row| row.method)
    }
}

impl fmt::Display for Method {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.write_str(self.spec().name)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_method_stands_at_its_own_row() {
        for row in METHODS {
            assert_eq!(row.method.spec().name, row.name);
            assert_eq!(Method::named(row.name), Some(row.method));
        }
    }
}
