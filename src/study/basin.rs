//! Where starts end: the plane ordered by the orbits that part it.
//!
//! Limit cycles and the escape separatrix are nested orbits around the sticking set. The region between
//! two of them has one fate. So the basin over a window needs no motion from any of its points: for each
//! column of starts the orbits' speeds at that displacement ([`super::arc`]) sort all of them.

use serde::Serialize;

use super::arc::{Arc, Direction};
use super::closing::{Closing, Equation, first_side};
use super::closings::all_closings;
use super::cycle::Edge;
use super::half_map::{Length, NoEnd};
use super::margin::Margin;
use crate::flow::{Cost, Limits, Reason};
use crate::oscillator::{Parameters, Side, State};

/// Where a start ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Fate {
    /// On the sticking set (at r = 0: at the steady state, in infinite time).
    Captured,
    /// On a stable limit cycle.
    Cycle,
    /// Beyond all bounds.
    Escaped,
    /// On none of these: neutral motion of a centre.
    Undecided,
}

/// An orbit that parts the plane: an upper and a lower arc over the displacement.
#[derive(Clone, Debug)]
pub struct Border {
    /// Above `v = 0`.
    pub upper: Arc,
    /// Below `v = 0`.
    pub lower: Arc,
}

impl Border {
    /// The border as a polyline in the order of time, `count` points on each integration step, beginning
    /// with the arc that comes first; a cycle is closed by its first point.
    #[must_use]
    pub fn curve(&self, count: u16) -> Vec<State> {
        // Of a separatrix the arc that leaves for infinity comes last.
        let upper_first = self.upper.swing.is_err() || !self.upper.is_backward();
        let arcs =
            if upper_first { [&self.upper, &self.lower] } else { [&self.lower, &self.upper] };
        let mut points: Vec<State> = arcs.iter().flat_map(|arc| arc.points(count)).collect();
        if !self.upper.is_backward() {
            points.extend(points.first().copied());
        }
        points
    }

    /// The velocities at displacement `q` between which a start lies inside; `None` where none does.
    #[must_use]
    pub fn span_at(&self, q: f64) -> Option<(f64, f64)> {
        let lower = self.lower.speed_at(q)?;
        let upper = self.upper.speed_at(q)?;
        Some((-lower, upper))
    }
}

/// The borders of the plane, innermost first, and the fates of the regions between them.
#[derive(Clone, Debug)]
pub struct Basin {
    /// The parameters.
    pub parameters: Parameters,
    /// What borders the basin of the sticking set.
    pub edge: Edge,
    /// The borders, innermost first.
    pub borders: Vec<Border>,
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
    /// Counts one start more.
    pub fn add(&mut self, fate: Fate, starts: u64) {
        match fate {
            Fate::Captured => self.captured += starts,
            Fate::Cycle => self.cycle += starts,
            Fate::Escaped => self.escaped += starts,
            Fate::Undecided => self.undecided += starts,
        }
    }
}

/// Finds the borders and the fates between them; `reach` is the largest displacement of interest.
///
/// # Errors
/// The [`Reason`] why a border could not be computed.
pub fn basin(parameters: &Parameters, reach: f64, limits: &Limits) -> Result<Basin, Reason> {
    let mut equation = Equation::new(parameters, f64::EPSILON);
    let found = all_closings(&mut equation, limits)?;
    let mut basin = Basin::around(parameters, &found, reach, limits)?;
    basin.cost += equation.cost();
    Ok(basin)
}

/// The fates of the regions that nested cycles make, from the inside out. A separatrix may already have
/// taken the sticking set's own region.
fn fates_between(parameters: &Parameters, stable: &[bool], with_centre: bool) -> Vec<Fate> {
    let outside = match stable.last() {
        Some(true) => Fate::Cycle,
        None if with_centre => centre_fate(parameters),
        Some(false) | None => Fate::Escaped,
    };
    let inside = match stable.first() {
        Some(true) if parameters.r > 0.0 && with_centre => Fate::Captured,
        Some(true) => Fate::Cycle,
        Some(false) => Fate::Captured,
        None => return vec![outside],
    };
    let between = std::iter::repeat_n(Fate::Cycle, stable.len() - 1);
    std::iter::once(inside).chain(between).chain(std::iter::once(outside)).collect()
}

/// The fate of the whole plane where nothing parts it.
fn centre_fate(parameters: &Parameters) -> Fate {
    let Parameters { d, d2, d3, r } = *parameters;
    if r > 0.0 || d > 0.0 || (d == 0.0 && d3 > 0.0) {
        Fate::Captured
    } else if d == 0.0 && d3 == 0.0 {
        debug_assert!(r == 0.0 && d2.is_finite());
        Fate::Undecided
    } else {
        Fate::Escaped
    }
}

/// The two arcs of a cycle.
fn cycle_border(
    parameters: &Parameters,
    side: Side,
    closing: &Closing,
    limits: &Limits,
) -> Result<Border, Reason> {
    let arc = |side, start| Arc::new(parameters, side, Direction::Forward, start, limits);
    let (first, second) = (arc(side, closing.first)?, arc(side.opposite(), closing.second)?);
    Ok(match side {
        Side::Upper => Border { upper: first, lower: second },
        Side::Lower => Border { upper: second, lower: first },
    })
}

/// The orbit that parts capture from escape where no cycle does.
///
/// With `D3 = 0` escape happens on the side in whose frame `D2 < 0`. The separatrix is the motion that
/// goes out along the parabola `v^2 = 1/(2 D2^2) - q/D2` for ever; run backward it attracts, so it is
/// found by a backward swing from far beyond the window, to rounding after `20/abs(D2)`. Before its
/// turning point it came from infinity on the other side. With `D <= -1` it is the motion from the end
/// point of the sticking set, a node, to its other end point.
fn separatrix(parameters: &Parameters, reach: f64, limits: &Limits) -> Result<Border, Reason> {
    /// Clearance, in units of `1/abs(D2)`, within which a motion has found the separatrix.
    const FORGETS: f64 = 40.0;
    let gap = 2.0 * parameters.r;
    let arc = |side, length| Arc::new(parameters, side, Direction::Backward, length, limits);
    if parameters.d <= -1.0 {
        let end = Length::new(gap);
        return Ok(Border { upper: arc(Side::Upper, end)?, lower: arc(Side::Lower, end)? });
    }
    let escaping = first_side(parameters).opposite();
    let far = Length::new(reach + gap + FORGETS / parameters.d2.abs());
    let out = arc(escaping, far)?;
    let turning = match &out.swing {
        Ok(swing) => swing.end,
        // Overdamped: run backward it never turns, and parts nothing but the half plane itself.
        Err(NoEnd::Never | NoEnd::Escapes) => Length { value: 0.0, log: f64::NEG_INFINITY },
        Err(NoEnd::Failed(reason)) => return Err(*reason),
    };
    let before = arc(escaping.opposite(), turning.plus(gap))?;
    Ok(match escaping {
        Side::Upper => Border { upper: out, lower: before },
        Side::Lower => Border { upper: before, lower: out },
    })
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
        let edge = Edge::around(parameters, &stable);
        let mut borders = Vec::new();
        let mut fates = Vec::new();
        if edge == Edge::Separatrix {
            borders.push(separatrix(parameters, reach, limits)?);
            fates.push(Fate::Captured);
        }
        for closing in found {
            borders.push(cycle_border(parameters, side, closing, limits)?);
        }
        fates.extend(fates_between(parameters, &stable, fates.is_empty()));
        let mut cost = Cost::default();
        for border in &borders {
            cost += border.upper.cost;
            cost += border.lower.cost;
        }
        Ok(Basin { parameters: *parameters, edge, borders, fates, cost })
    }

    /// Where a start ends.
    #[must_use]
    pub fn fate(&self, start: State) -> Fate {
        let inside = |border: &Border| {
            border.span_at(start.q).is_some_and(|(low, high)| start.v > low && start.v < high)
        };
        let region = self.borders.iter().position(inside).unwrap_or(self.borders.len());
        self.fates[region]
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
            // The rows inside each border; nested, so that each takes what the inner ones left.
            let mut taken = 0;
            for (border, &fate) in self.borders.iter().zip(&self.fates) {
                let rows_inside = border.span_at(q).map_or(0, |(low, high)| {
                    let first = velocities.partition_point(|&v| v <= low);
                    let end = velocities.partition_point(|&v| v < high);
                    end.saturating_sub(first)
                });
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
pub struct Survey {
    /// The parameters.
    pub parameters: Parameters,
    /// What borders the basin of the sticking set.
    pub edge: Edge,
    /// How many of the starts end where.
    pub counts: Counts,
    /// The kicks that are survived.
    pub margin: Margin,
    /// Area of the basin, where it is finite.
    pub area: Option<f64>,
    /// Basin stability: the part of the starts that is captured.
    pub captured: f64,
    /// Radius of Lyapunov's disk (24) as a part of the margin.
    pub lyapunov_share: Option<f64>,
    /// What it cost.
    #[serde(skip)]
    pub cost: Cost,
}

impl Survey {
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
        Ok(Survey {
            parameters: *parameters,
            edge: basin.edge,
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
pub(super) fn between(range: (f64, f64), index: usize, count: usize) -> f64 {
    if index + 1 == count && count > 1 {
        return range.1;
    }
    #[expect(clippy::cast_precision_loss, reason = "grids of starts are small")]
    let fraction = if count > 1 { index as f64 / (count - 1) as f64 } else { 0.5 };
    range.0 + fraction * (range.1 - range.0)
}
