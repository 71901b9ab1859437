//! What is sought, and what is found.

use std::fmt;

use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize};

use crate::flow::Cost;
use crate::numerics::shortest;
use crate::scan::{MEASURES, Measure, holds_words};

/// A column of a scan, and the value that it has along the curves that are sought.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(into = "String")]
pub struct LevelTarget {
    /// The measure that fills the column.
    pub measure: Measure,
    /// The name of the column.
    pub column: &'static str,
    /// The value.
    pub value: f64,
}

impl LevelTarget {
    /// Reads `COLUMN=VALUE`.
    ///
    /// # Errors
    /// One line that says what is wrong and what is allowed.
    pub fn read(text: &str) -> Result<Self, String> {
        let form = || format!("{text:?}: expected COLUMN=VALUE, such as impulse=0.2");
        let (name, value) = text.split_once('=').ok_or_else(form)?;
        let value = value.trim().parse().ok().filter(|value: &f64| value.is_finite());
        let (name, value) = (name.trim(), value.ok_or_else(form)?);
        let columns =
            MEASURES.iter().flat_map(|row| row.columns.iter().map(|it| (*it, row.measure)));
        let numbers: Vec<_> = columns.filter(|(name, _)| !holds_words(name)).collect();
        let Some(&(column, measure)) = numbers.iter().find(|(column, _)| *column == name) else {
            let all: Vec<_> = numbers.iter().map(|(column, _)| *column).collect();
            return Err(format!("there is no column {name:?}; there are {}", all.join(", ")));
        };
        Ok(LevelTarget { measure, column, value })
    }
}

impl fmt::Display for LevelTarget {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(out, "{}={}", self.column, shortest(self.value))
    }
}

impl<'de> Deserialize<'de> for LevelTarget {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        LevelTarget::read(&String::deserialize(deserializer)?).map_err(D::Error::custom)
    }
}

impl From<LevelTarget> for String {
    fn from(target: LevelTarget) -> Self {
        target.to_string()
    }
}

/// Why a level curve ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LevelEnd {
    /// It leaves the ranges.
    Edge,
    /// The column has no number beyond: of a margin, every kick is survived.
    Ceases,
    /// The column could not be computed beyond, or the curve could not be followed.
    Unknown,
}

/// A curve along which the column has the value.
#[derive(Clone, Debug, PartialEq)]
pub struct LevelCurve {
    /// Points, each with the values of both numbers; of a closed curve the last one is the first.
    pub points: Vec<[f64; 2]>,
    /// Why it ends at its first and its last point; `None` of a closed curve.
    pub ends: Option<[LevelEnd; 2]>,
    /// The largest jump of the column across the curve: 0 up to rounding where the column goes through the value. A column of
    /// steps jumps over it.
    pub step: f64,
}

/// The curves along which a column has a value.
#[derive(Clone, Debug, PartialEq)]
pub struct Levels {
    /// The curves.
    pub curves: Vec<LevelCurve>,
    /// The smallest and the largest number of the column on the lattice on which curves were sought; `None` without one.
    pub seen: Option<[f64; 2]>,
    /// What they cost.
    pub cost: Cost,
}
