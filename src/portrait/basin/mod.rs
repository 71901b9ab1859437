//! Where starts end: the plane ordered by the orbits that part it.
//!
//! Limit cycles and the escape separatrix are nested orbits around the sticking set. The region between
//! two of them has one fate. So the basin over a window needs no motion from any of its points: for each
//! column of starts the orbits' speeds at that displacement ([`self::arc`]) sort all of them.
//!
//! ```
//! use hopfscope::flow::{Fate, Limits};
//! use hopfscope::model::{Parameters, State};
//! use hopfscope::portrait::basin::basin;
//!
//! let parameters = Parameters { d: -0.3, d2: 0.0, d3: 0.5, r: 0.1 };
//! let found = basin(&parameters, 3.0, &Limits::PATIENT)?;
//! assert_eq!(found.fate(State { q: 0.2, v: 0.0 }), Fate::Rest);
//! assert_eq!(found.fate(State { q: 0.3, v: 0.0 }), Fate::Cycle(1));
//! # Ok::<(), hopfscope::flow::Reason>(())
//! ```

pub(crate) mod arc;
#[doc(hidden)]
pub mod capture;
#[warn(clippy::missing_errors_doc)]
pub mod cycle;
pub(crate) mod limit_cycle;
#[warn(clippy::missing_errors_doc)]
pub mod margin;
pub(crate) mod orbit;
pub(crate) mod stability;
pub(crate) mod works;

use serde::Serialize;

use super::closing::all::{STEP, all_closings};
use super::closing::equation::{Equation, first_side};
use super::closing::pair::Closing;
use crate::closed_form::harmonic::is_centre;
use crate::flow::{Cost, Fate, Limits, Reason};
use crate::model::sticking::rests;
use crate::model::{Parameters, State};
use crate::portrait::{Border, Margin};
use orbit::Orbit;

/// The borders of the plane, innermost first, and the fates of the regions between them.
#[derive(Clone, Debug)]
pub struct Basin {
    /// The parameters.
    pub parameters: Parameters,
    /// What borders the basin of the sticking set.
    pub border: Border,
    /// The borders, innermost first.
    pub borders: Vec<Orbit>,
    /// Fates inside the first border, between the first and the second, ..., outside the last.
    pub fates: Vec<Fate>,
    /// What it cost.
    pub cost: Cost,
}

/// A rectangle of starts, both ends included.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Window {
    /// Smallest and largest displacement.
    pub q: (f64, f64),
    /// Smallest and largest velocity.
    pub v: (f64, f64),
}

/// How many starts end where.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Counts {
    /// On the sticking set.
    pub captured: u64,
    /// On a stable limit cycle.
    pub cycle: u64,
    /// Beyond all bounds.
    pub escaped: u64,
    /// On none of these.
    pub undecided: u64,
}

impl Counts {
    /// Both together.
    #[must_use]
    pub fn and(self, other: Self) -> Self {
        Counts {
            captured: self.captured + other.captured,
            cycle: self.cycle + other.cycle,
            escaped: self.escaped + other.escaped,
            undecided: self.undecided + other.undecided,
        }
    }

    /// Counts starts with one fate.
    pub fn add<Why: Copy>(&mut self, fate: Fate<Why>, starts: u64) {
        match fate {
            Fate::Rest => self.captured += starts,
            Fate::Cycle(_) => self.cycle += starts,
            Fate::Escapes => self.escaped += starts,
            Fate::Neutral | Fate::Moving | Fate::Unknown(_) => self.undecided += starts,
        }
    }
}

/// Finds the borders and the fates between them; `reach` is the largest displacement of interest.
///
/// # Errors
/// The [`Reason`] why a border could not be computed.
pub fn basin(parameters: &Parameters, reach: f64, limits: &Limits) -> Result<Basin, Reason> {
    let mut equation = Equation::new(parameters, STEP);
    let found = all_closings(&mut equation, limits)?;
    let mut basin = Basin::around(parameters, &found, reach, limits)?;
    basin.cost += equation.cost();
    Ok(basin)
}

/// The fates of the regions that nested cycles make, from the inside out. A separatrix may already have
/// taken the sticking set's own region.
fn fates_between(parameters: &Parameters, stable: &[bool], with_centre: bool) -> Vec<Fate> {
    let outside = match stable.last() {
        Some(true) => Fate::Cycle(stable.len() - 1),
        None if with_centre => centre_fate(parameters),
        Some(false) | None => Fate::Escapes,
    };
    let inside = match stable.first() {
        Some(true) if parameters.r > 0.0 && with_centre => Fate::Rest,
        Some(true) => Fate::Cycle(0),
        Some(false) => Fate::Rest,
        None => return vec![outside],
    };
    let between = stable.iter().enumerate().skip(1);
    let between =
        between.map(|(outer, stable)| Fate::Cycle(if *stable { outer } else { outer - 1 }));
    std::iter::once(inside).chain(between).chain(std::iter::once(outside)).collect()
}

/// The fate of the whole plane where nothing parts it.
fn centre_fate(parameters: &Parameters) -> Fate {
    let Parameters { d, d3, r, .. } = *parameters;
    if r > 0.0 || d > 0.0 || (d == 0.0 && d3 > 0.0) {
        Fate::Rest
    } else if is_centre(parameters) {
        Fate::Neutral
    } else {
        Fate::Escapes
    }
}

impl Basin {
    /// The basin that all cycles, given by their closings, leave to the sticking set.
    ///
    /// # Errors
    /// The [`Reason`] why a border could not be computed.
    pub fn around(
        parameters: &Parameters,
        found: &[Closing],
        reach: f64,
        limits: &Limits,
    ) -> Result<Self, Reason> {
        let side = first_side(parameters);
        let stable: Vec<bool> =
            found.iter().map(|closing| closing.log_multiplier(parameters) < 0.0).collect();
        let border = Border::around(parameters, &stable);
        let mut borders = Vec::new();
        let mut fates = Vec::new();
        if border == Border::Separatrix {
            borders.push(Orbit::separatrix(parameters, reach, limits)?);
            fates.push(if is_centre(parameters) { Fate::Neutral } else { Fate::Rest });
        }
        for closing in found {
            borders.push(Orbit::of_cycle(parameters, side, closing, limits)?);
        }
        fates.extend(fates_between(parameters, &stable, fates.is_empty()));
        let mut cost = Cost::default();
        for border in &borders {
            cost += border.upper.cost;
            cost += border.lower.cost;
        }
        Ok(Basin { parameters: *parameters, border, borders, fates, cost })
    }

    /// Where a start ends.
    #[must_use]
    pub fn fate(&self, start: State) -> Fate {
        if self.rests(start) {
            return Fate::Rest;
        }
        let inside = |border: &Orbit| {
            border.span_at(start.q).is_some_and(|(low, high)| start.v > low && start.v < high)
        };
        let region = self.borders.iter().position(inside).unwrap_or(self.borders.len());
        self.fates[region]
    }

    /// Whether a start is one of the positions of rest that friction makes.
    fn rests(&self, start: State) -> bool {
        self.parameters.r > 0.0 && rests(start, self.parameters.r)
    }

    /// Counts the fates of `columns` by `rows` starts, evenly spaced, the window's ends included.
    ///
    /// # Errors
    /// [`Reason::Interrupted`], asked for at each column.
    pub fn count(
        &self,
        window: &Window,
        columns: usize,
        rows: usize,
        limits: &Limits,
    ) -> Result<Counts, Reason> {
        let mut counts = Counts::default();
        let velocities: Vec<f64> = (0..rows).map(|row| between(window.v, row, rows)).collect();
        for column in 0..columns {
            if (limits.interrupted)() {
                return Err(Reason::Interrupted);
            }
            let q = between(window.q, column, columns);
            // The rows between two speeds, a row at rest included: next to a node none else may be.
            let rows_within = |(low, high): (f64, f64)| {
                let rests = |v: f64| self.rests(State { q, v });
                let first = velocities.partition_point(|&v| v <= low && !rests(v));
                let end = velocities.partition_point(|&v| v < high || rests(v));
                end.saturating_sub(first)
            };
            // The rows inside each border; nested, so that each takes what the inner ones left.
            let mut taken = 0;
            for (border, &fate) in self.borders.iter().zip(&self.fates) {
                let rows_inside = rows_within(border.span_at(q).unwrap_or((0.0, 0.0)));
                counts.add(fate, rows_inside.saturating_sub(taken) as u64);
                taken = taken.max(rows_inside);
            }
            counts.add(self.fates[self.borders.len()], (rows - taken) as u64);
        }
        Ok(counts)
    }
}

/// A basin, surveyed over a window of starts.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SurveyedBasin {
    /// The parameters.
    pub parameters: Parameters,
    /// What borders the basin of the sticking set.
    #[serde(rename = "edge")]
    pub border: Border,
    /// How many of the starts end where.
    pub counts: Counts,
    /// The kicks that are survived.
    pub margin: Margin,
    /// Area of the basin, where it is finite.
    pub area: Option<f64>,
    /// Basin stability: the fraction of the starts that is captured.
    pub captured: f64,
    /// Radius of Lyapunov's disk (24) as a fraction of the margin.
    pub lyapunov_share: Option<f64>,
    /// What it cost.
    #[serde(skip)]
    pub cost: Cost,
}

impl SurveyedBasin {
    /// Surveys a grid of `columns` by `rows` starts.
    ///
    /// # Errors
    /// The [`Reason`] why a border could not be computed.
    pub fn of(
        parameters: &Parameters,
        window: &Window,
        (columns, rows): (usize, usize),
        limits: &Limits,
    ) -> Result<Self, Reason> {
        let reach = window.q.0.abs().max(window.q.1.abs());
        let basin = basin(parameters, reach, limits)?;
        let counts = basin.count(window, columns, rows, limits)?;
        #[expect(clippy::cast_precision_loss, reason = "at most 1e10 starts")]
        let captured = counts.captured as f64 / (columns * rows) as f64;
        Ok(SurveyedBasin {
            parameters: *parameters,
            border: basin.border,
            counts,
            margin: basin.margin(),
            area: basin.area(),
            captured,
            lyapunov_share: basin.lyapunov_share(),
            cost: basin.cost,
        })
    }
}

/// Value number `index` of `count` evenly spaced over a range, both ends included.
pub(crate) fn between(range: (f64, f64), index: usize, count: usize) -> f64 {
    if index + 1 == count && count > 1 {
        return range.1;
    }
    #[expect(clippy::cast_precision_loss, reason = "grids of starts are small")]
    let fraction = if count > 1 { index as f64 / (count - 1) as f64 } else { 0.5 };
    range.0 + fraction * (range.1 - range.0)
}
