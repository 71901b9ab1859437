//! The times at which a motion is evaluated.

use std::path::{Path, PathBuf};

use clap::Args;

use super::{Failure, Result, number};
use crate::model::Knob;
use crate::numerics::{real, truncated};
use crate::runtime::bounded;
use crate::scan::few_digits;

/// At which times; none unless one of both is given.
#[derive(Args)]
pub struct TimeOptions {
    /// Evaluates the motion at times this far apart, from 0 on
    #[arg(long, value_name = "STEP", conflicts_with = "times")]
    sample: Option<String>,
    /// Evaluates the motion at the times in FILE: the first cell of each line, below tau if a line has names
    #[arg(long, value_name = "FILE")]
    times: Option<PathBuf>,
}

/// Most times at which a motion is evaluated.
const MOST: usize = 1_000_000;

impl TimeOptions {
    /// The times, if any are asked for, of a motion that ends at this one; `knob` reads them.
    pub fn asked(&self, knob: Knob, until: f64) -> Result<Option<Vec<f64>>> {
        let step = number("--sample", self.sample.as_ref(), knob)?;
        let apart = step.map(|step| apart(step, until));
        apart.or_else(|| Some(within(self.times.as_ref()?, knob, until))).transpose()
    }
}

/// Times from 0 on, this far apart.
fn apart(step: f64, until: f64) -> Result<Vec<f64>> {
    let rounding = 4.0 * f64::EPSILON;
    let count = (until / step * (1.0 + rounding)).floor();
    if step > 0.0 && count < real(MOST) {
        let time = |index| few_digits(real(index) * step, rounding * until).min(until);
        return Ok((0..=truncated(count)).map(time).collect());
    }
    let least = until / real(MOST);
    Err(format!("--sample {step:?}: expected {least:?} or more, for at most {MOST} times").into())
}

/// The times in a file, which may have a line of names.
fn within(path: &Path, knob: Knob, until: f64) -> Result<Vec<f64>> {
    let text = bounded::text(path)?;
    let cells = text.lines().map(|line| line.split(',').next().unwrap_or_default().trim());
    let is_time = |(cell, line): &(&str, usize)| {
        !cell.is_empty() && !cell.starts_with('#') && (*line > 1 || !["tau", "t"].contains(cell))
    };
    let time = |(cell, line): (&str, usize)| {
        let outside = || format!("{cell} is outside of the motion, 0 .. {until:?}, see --until");
        let inside = |time| Some(time).filter(|time| *time <= until).ok_or_else(outside);
        let time = knob.parse(cell).and_then(inside);
        time.map_err(|why| Failure::file(path, format!("line {line}: {why}")))
    };
    cells.zip(1..).filter(is_time).map(time).collect()
}
