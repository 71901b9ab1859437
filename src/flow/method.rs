//! The methods that integrate a motion.

use std::fmt;
use std::sync::LazyLock;

use serde::{Deserialize, Serialize};

use crate::model::{Group, Knob};
use crate::numerics::{cells, named};

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

/// Every method as the lines of `assets/methods.txt` describe it, in display order.
pub static METHODS: LazyLock<Vec<MethodSpec>> = LazyLock::new(|| {
    let described = include_str!("../../assets/methods.txt").lines().filter_map(cells);
    // A line of another name than those of methods is none of the table.
    let rows = described.filter_map(|[name, dial, events, guarantee]| {
        let dial = Knob::named(dial, &[Group::Setting]).ok();
        Some(MethodSpec { method: named(name)?, name, dial, events: events == "events", guarantee })
    });
    rows.collect()
});

/// An integration method.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Method {
    /// The cheapest method that meets the requested tolerance; what it costs was measured, see the trade table.
    Auto,
    /// Closed form of the piecewise linear oscillator (equations 25 to 33, corrected).
    Exact,
    /// Taylor series of the polynomial field, of order 8 to 26 with the tolerance (Jorba and Zou, Experimental
    /// Mathematics 14, 2005).
    Taylor,
    /// Explicit Runge-Kutta pair of order 8, with error estimates of order 5 and 3 (Hairer, Norsett and Wanner, Solving
    /// Ordinary Differential Equations I).
    Dop853,
    /// Explicit Runge-Kutta pair of order 5, with an error estimate of order 4 (Dormand and Prince, J. Comp. Appl. Math.
    /// 6, 1980).
    Dopri5,
    /// The classical Runge-Kutta method of order 4, with a fixed step and no error estimate (Kutta, Z. Math. Phys. 46,
    /// 1901).
    Rk4,
    /// Implicit collocation for stiff motions, of order 5, 9 or 13 with the tolerance (Radau IIA; Hairer and Wanner, J.
    /// Comp. Appl. Math. 111, 1999).
    Stiff,
    /// Friction smoothed to `r tanh(v/epsilon)` in place of `r sign(v)`, without events, as is common practice; of order
    /// 1 in epsilon.
    Smoothed,
    /// The classical Runge-Kutta method with `sign(v)` in the field, without events, as is common practice; of order 1,
    /// since each passage of `v = 0` costs the rest.
    SignRk4,
    /// Moreau and Jean's time stepping, without events; of order 2 within a half swing, 1 across `v = 0` (Moreau, 1988;
    /// Jean, Comput. Methods Appl. Mech. Eng. 177, 1999).
    TimeStepping,
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
        let lines = include_str!("../../assets/methods.txt").lines();
        assert_eq!(METHODS.len(), lines.filter(|line| line.contains(" | ")).count());
        for [name, _, events, _] in
            include_str!("../../assets/methods.txt").lines().filter_map(cells)
        {
            assert!(["events", "-"].contains(&events), "{name}: {events}");
        }
        for row in METHODS.iter() {
            assert_eq!(row.method.spec().name, row.name);
            assert_eq!(row.dial.is_none(), row.method == Method::Exact);
        }
    }
}
