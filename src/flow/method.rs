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
    /// What it promises, and under which assumption.
    pub guarantee: &'static str,
}

/// Makes [`Method`] and [`METHODS`] from one list, in display order: name, the number that sets the accuracy, whether
/// events are found, and what is promised.
macro_rules! methods {
    ($($(#[$attribute:meta])* $method:ident: $name:literal, $dial:expr, $events:literal, $guarantee:literal;)*) => {
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
            guarantee: $guarantee,
        }),*];
    };
}

methods! {
    /// The cheapest method that meets the requested tolerance; what it costs was measured, see the trade table.
    Auto: "auto", Some(Knob::Tolerance), true,
        "exact where D2 = D3 = 0, else taylor, stiff while stability limits its steps";
    /// Closed form of the piecewise linear oscillator (equations 25 to 33, corrected).
    Exact: "exact", None, true, "rounding error only; D2 = D3 = 0";
    /// Taylor series of the polynomial field, of order 8 to 26 with the tolerance (Jorba and Zou, Experimental
    /// Mathematics 14, 2005).
    Taylor: "taylor", Some(Knob::Tolerance), true,
        "relative error of a step below the tolerance; crossings are roots of its polynomial";
    /// Explicit Runge-Kutta pair of order 8, with error estimates of order 5 and 3 (Hairer, Norsett and Wanner, Solving
    /// Ordinary Differential Equations I).
    Dop853: "dop853", Some(Knob::Tolerance), true, "relative error of a step below the tolerance";
    /// Explicit Runge-Kutta pair of order 5, with an error estimate of order 4 (Dormand and Prince, J. Comp. Appl. Math.
    /// 6, 1980).
    Dopri5: "dopri5", Some(Knob::Tolerance), true, "relative error of a step below the tolerance";
    /// The classical Runge-Kutta method of order 4, with a fixed step and no error estimate (Kutta, Z. Math. Phys. 46,
    /// 1901).
    Rk4: "rk4", Some(Knob::Step), true,
        "crossings as good as its steps; refuses steps that are unstable";
    /// Implicit collocation for stiff motions, of order 5, 9 or 13 with the tolerance (Radau IIA; Hairer and Wanner, J.
    /// Comp. Appl. Math. 111, 1999).
    Stiff: "stiff", Some(Knob::Tolerance), true,
        "relative error of a step near the tolerance; L-stable, analytic Jacobian";
    /// Friction smoothed to `r tanh(v/epsilon)` in place of `r sign(v)`, without events, as is common practice; of order
    /// 1 in epsilon.
    Smoothed: "smoothed", Some(Knob::Epsilon), false,
        "never sticks: it creeps at a speed of order epsilon; cost grows as 1/epsilon (dop853)";
    /// The classical Runge-Kutta method with `sign(v)` in the field, without events, as is common practice; of order 1,
    /// since each passage of `v = 0` costs the rest.
    SignRk4: "sign-rk4", Some(Knob::Step), false,
        "none: it chatters across v = 0 and rests nowhere";
    /// Moreau and Jean's time stepping, without events; of order 2 within a half swing, 1 across `v = 0` (Moreau, 1988;
    /// Jean, Comput. Methods Appl. Mech. Eng. 177, 1999).
    TimeStepping: "time-stepping", Some(Knob::Step), false,
        "sticks where the balance of one step says so; no crossing is located";
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
        }
    }
}
