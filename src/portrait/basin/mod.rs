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
pub(crate) mod orbit;
#[doc(hidden)]
pub mod stability;

use arc::Arc;
use orbit::{Orbit, POINTS, filled, inner_radius};
use serde::Serialize;

use super::closing::all::{STEP, all_closings};
use super::closing::equation::{Equation, first_side};
use super::closing::pair::Closing;
use crate::closed_form::harmonic::is_centre;
use crate::closed_form::lyapunov;
use crate::flow::{Cost, Fate, Limits, Reason};
use crate::model::parameters::rests;
use crate::model::{Parameters, State};
use crate::portrait::{Border, Margin, RestMargin};

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
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct StartWindow {
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
    /// Basin stability: the fraction of the starts that is captured.
    #[must_use]
    pub fn captured_part(&self) -> f64 {
        let all = self.captured + self.cycle + self.escaped + self.undecided;
        #[expect(clippy::cast_precision_loss, reason = "at most 1e10 starts")]
        let part = self.captured as f64 / all as f64;
        part
    }

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
    pub fn add(&mut self, fate: Fate, starts: u64) {
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
    let mut equation = Equation::new(parameters, STEP, limits);
    let found = all_closings(&mut equation)?;
    let mut basin = Basin::around(parameters, &found, reach, limits)?;
    basin.cost += equation.cost();
    Ok(basin)
}

/// The fates of the regions that nested cycles make, from the inside out. A separatrix may already have
/// taken the sticking set's own region.
fn fates_between(parameters: &Parameters, stable: &[bool], with_centre: bool) -> Vec<Fate> {
    let within = |outer: usize| {
        let inner = outer.checked_sub(1).and_then(|inner| stable.get(inner));
        match (inner, stable.get(outer)) {
            (None, Some(true)) if parameters.r > 0.0 && with_centre => Fate::Rest,
            (_, Some(true)) => Fate::Cycle(outer),
            (None, Some(false)) => Fate::Rest,
            (None, None) if with_centre => centre_fate(parameters),
            (None | Some(false), None) => Fate::Escapes,
            (Some(_), _) => Fate::Cycle(outer - 1),
        }
    };
    (0..=stable.len()).map(within).collect()
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
        window: &StartWindow,
        (columns, rows): (usize, usize),
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

/// Value number `index` of `count` evenly spaced over a range, both ends included.
pub(crate) fn between(range: (f64, f64), index: usize, count: usize) -> f64 {
    if index + 1 == count && count > 1 {
        return range.1;
    }
    #[expect(clippy::cast_precision_loss, reason = "grids of starts are small")]
    let fraction = if count > 1 { index as f64 / (count - 1) as f64 } else { 0.5 };
    range.0 + fraction * (range.1 - range.0)
}

// How large a kick the sticking set survives.
//
// The smallest displacement at rest, and the smallest impulse, that does not come back to the sticking set: where
// the edge of its basin meets `v = 0`, and its height above the point where the mass rests.
//
// From the worst rest position these are the gap between the edge and the sticking set on `v = 0`, and the height
// of the edge above an end of the set: the upper half of the edge is a graph `v(q)` with slope `a/v`, and where it is
// level (`a = 0`) its second derivative is `-1/v`, because the spring's force falls with q. So it has no minimum
// between its ends, and over a segment it is lowest at an end; the lower half likewise.

impl Basin {
    /// The margins.
    ///
    /// ```
    /// use hopfscope::flow::Limits;
    /// use hopfscope::model::Parameters;
    /// use hopfscope::portrait::basin::basin;
    ///
    /// // A_q = r coth(x/2) with x = -pi D/sqrt(1 - D^2), for D2 = D3 = 0.
    /// let (d, r): (f64, f64) = (-0.4, 0.1);
    /// let found = basin(&Parameters { d, d2: 0.0, d3: 0.0, r }, 3.0, &Limits::PATIENT)?;
    /// let x = -std::f64::consts::PI * d / (1.0 - d * d).sqrt();
    /// let displacement = found.margin().displacement.unwrap();
    /// assert!((displacement - r / (0.5 * x).tanh()).abs() < 1e-12);
    /// # Ok::<(), hopfscope::flow::Reason>(())
    /// ```
    #[must_use]
    pub fn margin(&self) -> Margin {
        self.margin_within(self.parameters.r)
    }

    /// The margins if the mass may rest up to a `farthest` place on either side, which is r or beyond.
    #[must_use]
    pub fn margin_within(&self, farthest: f64) -> Margin {
        let Parameters { d, d3, r, .. } = self.parameters;
        if r == 0.0 && !(d > 0.0 || (d == 0.0 && d3 > 0.0)) {
            // Neither friction nor damping: nothing comes to rest, however small the kick.
            return Margin::ZERO;
        }
        let edge = self.borders.first().filter(|_| self.border != Border::None);
        let Some(edge) = edge else { return Margin::ENDLESS };
        let clearances = [&edge.upper, &edge.lower].into_iter().filter_map(Arc::clearance);
        let clearance = clearances.map(|clearance| clearance.value).reduce(f64::min);
        let gap = clearance.map(|clearance| (clearance - (farthest - r)).max(0.0));
        let impulse = |q: f64| edge.span_at(q).map_or(0.0, |(low, high)| high.min(-low));
        let finite = |impulse: f64| Some(impulse).filter(|impulse| impulse.is_finite());
        let least = impulse(farthest).min(impulse(-farthest));
        Margin {
            displacement: clearance.map(|clearance| r + clearance),
            impulse: finite(impulse(0.0)),
            from_rest: RestMargin {
                displacement: gap,
                impulse: if gap == Some(0.0) { gap } else { finite(least) },
            },
        }
    }

    /// Radius of the disk that Lyapunov's method proves to be captured (equation 24), as a fraction of the
    /// true margin: how conservative it is.
    #[must_use]
    pub fn lyapunov_share(&self) -> Option<f64> {
        let Margin { displacement, impulse, .. } = self.margin();
        let margin = displacement?.min(impulse?);
        lyapunov::radius(&self.parameters).map(|radius| radius / margin)
    }

    /// Radius of the largest circle about the origin that lies within the basin; `None` where nothing borders it.
    ///
    /// The least distance of the border, refined between the points of its curve.
    #[must_use]
    pub fn inner_radius(&self) -> Option<f64> {
        if self.border == Border::None {
            return None;
        }
        let edge = self.borders.first()?;
        inner_radius(&edge.curve(POINTS), &|q| edge.span_at(q))
    }

    /// The fraction of the basin's area that this circle fills; `None` where the area is infinite.
    #[must_use]
    pub fn integrity(&self) -> Option<f64> {
        Some(filled(self.inner_radius()?, self.area()?))
    }

    /// Area of the basin in the phase plane: the integral of `v^2` over one turn of its edge; `None`
    /// where it is infinite, or where there is no basin.
    #[must_use]
    pub fn area(&self) -> Option<f64> {
        let captured = self.fates.first() == Some(&Fate::Rest) && self.border != Border::None;
        let edge = self.borders.first().filter(|edge| captured && edge.is_closed())?;
        Some(edge.upper.area() + edge.lower.area())
    }
}
