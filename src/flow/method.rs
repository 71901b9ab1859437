//! The list of ways to integrate a half swing.

use std::fmt;

use serde::{Deserialize, Serialize};

/// A way to integrate.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Method {
    /// The cheapest method that meets the tolerance at hand.
    Auto,
    /// Closed form of the piecewise linear oscillator.
    Exact,
    /// Taylor series of the polynomial field.
    Taylor,
    /// Explicit Runge-Kutta pair of order 8.
    Dop853,
}

/// One row of [`METHODS`].
#[derive(Clone, Copy, Debug)]
pub struct MethodSpec {
    /// The method.
    pub method: Method,
    /// Its name on the command line and on the screen.
    pub name: &'static str,
    /// Order of accuracy, in words.
    pub order: &'static str,
    /// What it promises, and under which assumption.
    pub guarantee: &'static str,
    /// Where it comes from.
    pub source: &'static str,
}

/// Every method, in the order in which they are shown.
pub const METHODS: &[MethodSpec] = &[
    MethodSpec {
        method: Method::Auto,
        name: "auto",
        order: "that of the method chosen",
        guarantee: "exact where D2 = D3 = 0, else taylor",
        source: "measured, see the trade table",
    },
    MethodSpec {
        method: Method::Exact,
        name: "exact",
        order: "closed form",
        guarantee: "rounding error only; D2 = D3 = 0",
        source: "equations 25 to 33, corrected",
    },
    MethodSpec {
        method: Method::Taylor,
        name: "taylor",
        order: "8 to 24 with the tolerance",
        guarantee: "relative error of a step below the tolerance; crossings are roots of its polynomial",
        source: "Jorba and Zou, Experimental Mathematics 14 (2005)",
    },
    MethodSpec {
        method: Method::Dop853,
        name: "dop853",
        order: "8, error estimates 5 and 3",
        guarantee: "relative error of a step below the tolerance",
        source: "Hairer, Norsett and Wanner, Solving Ordinary Differential Equations I",
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
