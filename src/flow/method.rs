//! The methods that integrate a motion.

use std::fmt;

use serde::{Deserialize, Serialize};

use crate::model::Knob;

/// An integration method.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Method {
    /// The cheapest method that meets the requested tolerance.
    Auto,
    /// Closed form of the piecewise linear oscillator.
    Exact,
    /// Taylor series of the polynomial field.
    Taylor,
    /// Explicit Runge-Kutta pair of order 8.
    Dop853,
    /// Explicit Runge-Kutta pair of order 5.
    Dopri5,
    /// The classical Runge-Kutta method of order 4, with a fixed step.
    Rk4,
    /// Implicit collocation for stiff motions.
    Stiff,
    /// Friction smoothed to `r tanh(v/epsilon)`, without events.
    Smoothed,
    /// The classical Runge-Kutta method with `sign(v)` in the field, without events.
    SignRk4,
    /// Moreau and Jean's time stepping, without events.
    TimeStepping,
}

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

/// Every method, in display order.
pub const METHODS: &[MethodSpec] = &[
    MethodSpec {
        method: Method::Auto,
        name: "auto",
        dial: Some(Knob::Tolerance),
        events: true,
        order: "that of the method chosen",
        guarantee: "exact where D2 = D3 = 0, else taylor, stiff while stability limits its steps",
        source: "measured, see the trade table",
    },
    MethodSpec {
        method: Method::Exact,
        name: "exact",
        dial: None,
        events: true,
        order: "closed form",
        guarantee: "rounding error only; D2 = D3 = 0",
        source: "equations 25 to 33, corrected",
    },
    MethodSpec {
        method: Method::Taylor,
        name: "taylor",
        dial: Some(Knob::Tolerance),
        events: true,
        order: "8 to 26 with the tolerance",
        guarantee: "relative error of a step below the tolerance; crossings are roots of its polynomial",
        source: "Jorba and Zou, Experimental Mathematics 14 (2005)",
    },
    MethodSpec {
        method: Method::Dop853,
        name: "dop853",
        dial: Some(Knob::Tolerance),
        events: true,
        order: "8, error estimates 5 and 3",
        guarantee: "relative error of a step below the tolerance",
        source: "Hairer, Norsett and Wanner, Solving Ordinary Differential Equations I",
    },
    MethodSpec {
        method: Method::Dopri5,
        name: "dopri5",
        dial: Some(Knob::Tolerance),
        events: true,
        order: "5, error estimate 4",
        guarantee: "relative error of a step below the tolerance",
        source: "Dormand and Prince, J. Comp. Appl. Math. 6 (1980)",
    },
    MethodSpec {
        method: Method::Rk4,
        name: "rk4",
        dial: Some(Knob::Step),
        events: true,
        order: "4, no error estimate",
        guarantee: "crossings as good as its steps; refuses steps that are unstable",
        source: "Kutta, Z. Math. Phys. 46 (1901)",
    },
    MethodSpec {
        method: Method::Stiff,
        name: "stiff",
        dial: Some(Knob::Tolerance),
        events: true,
        order: "5, 9 or 13 with the tolerance",
        guarantee: "relative error of a step near the tolerance; L-stable, analytic Jacobian",
        source: "Radau IIA; Hairer and Wanner, J. Comp. Appl. Math. 111 (1999)",
    },
    MethodSpec {
        method: Method::Smoothed,
        name: "smoothed",
        dial: Some(Knob::Epsilon),
        events: false,
        order: "1 in epsilon",
        guarantee: "never sticks: it creeps at a speed of order epsilon; cost grows as 1/epsilon (dop853)",
        source: "common practice: sign(v) becomes tanh(v/epsilon)",
    },
    MethodSpec {
        method: Method::SignRk4,
        name: "sign-rk4",
        dial: Some(Knob::Step),
        events: false,
        order: "1: each passage of v = 0 costs the rest",
        guarantee: "none: it chatters across v = 0 and rests nowhere",
        source: "common practice: rk4 with sign(v) in the field",
    },
    MethodSpec {
        method: Method::TimeStepping,
        name: "time-stepping",
        dial: Some(Knob::Step),
        events: false,
        order: "2 within a half swing, 1 across v = 0",
        guarantee: "sticks where the balance of one step says so; no crossing is located",
        source: "Moreau (1988); Jean, Comput. Methods Appl. Mech. Eng. 177 (1999)",
    },
];

impl Method {
    /// The row of [`METHODS`] that describes this method.
    ///
    /// # Panics
    /// Never: a test checks that every method has its row.
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
