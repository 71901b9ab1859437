//! Without a belt a machine is the oscillator of the paper: half swings that close are its cycles
//! ([`crate::portrait::closing::equation`]), and its basin of rest is bordered by orbits ([`crate::portrait::basin`]).
//!
//! Half swings are computed by their clearance from where the mass rests, which the return map loses among the digits
//! of the turning point where damping is nearly critical.

use super::{
    Arc, Border, Cycle, Edge, Equation, Orbit, Portrait, Reach, STEP, SwingPair, described,
    first_closings, first_side, picture_reach,
};
use crate::closed_form::is_centre;
use crate::flow::{Fate, Limits, Result};
use crate::model::{Belt, Model, Parameters, Source};

impl Portrait {
    /// The portrait of a machine: by half swings that close where there is no belt, else by the return map.
    ///
    /// # Errors
    /// [`Reason`](crate::model::Reason) if the motions near rest, or those that the belt releases, cannot be followed.
    pub fn of(model: &Model) -> Result<Self> {
        without_belt(model).map_or_else(|| Portrait::by_return_map(model), Ok)
    }

    /// The portrait of a mass on a belt whose friction law reaches as far as its motions do.
    ///
    /// # Errors
    /// `Reason` where it has no model, or where motions leave the law before the border of rest is known.
    pub fn of_belt(belt: &Belt) -> Result<Self> {
        Portrait::of(&Model::new(belt)?)
    }

    /// The portrait of the oscillator of the paper; `reach` is the largest displacement of interest, as far as which a
    /// separatrix is followed.
    ///
    /// ```
    /// use hopfscope::flow::{Fate, Limits};
    /// use hopfscope::model::Parameters;
    /// use hopfscope::portrait::Portrait;
    ///
    /// let parameters = Parameters { d: -0.3, d2: 0.0, d3: 0.5, r: 0.1 };
    /// let found = Portrait::of_oscillator(&parameters, 3.0, &Limits::PATIENT)?;
    /// assert_eq!(found.fate(0.2, 0.0), Ok(Fate::Rest));
    /// assert_eq!(found.fate(0.3, 0.0), Ok(Fate::Cycle(1)));
    ///
    /// // A_q = r coth(x/2) with x = -pi D/sqrt(1 - D^2), for D2 = D3 = 0.
    /// let (d, r): (f64, f64) = (-0.4, 0.1);
    /// let linear = Parameters { d, d2: 0.0, d3: 0.0, r };
    /// let found = Portrait::of_oscillator(&linear, 3.0, &Limits::PATIENT)?;
    /// let x = -std::f64::consts::PI * d / (1.0 - d * d).sqrt();
    /// let displacement = found.margin.displacement.unwrap();
    /// assert!((displacement - r / (0.5 * x).tanh()).abs() < 1e-12);
    /// # Ok::<(), hopfscope::flow::Reason>(())
    /// ```
    ///
    /// # Errors
    /// [`Reason`](crate::model::Reason) if the search for cycles fails, or a border cannot be traced.
    pub fn of_oscillator(parameters: &Parameters, reach: f64, limits: &Limits) -> Result<Self> {
        Self::by_closings(&Model::of_paper(parameters)?, parameters, usize::MAX, reach, limits)
    }

    /// The same with what lies within its innermost cycle alone, which takes half the work.
    ///
    /// # Errors
    /// As [`Self::of_oscillator`].
    pub fn innermost(parameters: &Parameters, reach: f64, limits: &Limits) -> Result<Self> {
        Self::by_closings(&Model::of_paper(parameters)?, parameters, 1, reach, limits)
    }

    /// The portrait of what the oscillator with these parameters is in other units, from as many pairs of half swings that
    /// close as are wanted.
    fn by_closings(
        model: &Model,
        parameters: &Parameters,
        most: usize,
        reach: f64,
        limits: &Limits,
    ) -> Result<Self> {
        let mut equation = Equation::new(parameters, STEP, limits);
        let found = first_closings(&mut equation, most)?;
        let mut portrait = Self::around(model, parameters, &found, reach, limits)?;
        portrait.cost += equation.cost();
        Ok(portrait)
    }

    /// The same from its cycles, given by their closings; of some of them, from the innermost one on, what lies within
    /// the outermost.
    ///
    /// # Errors
    /// [`Reason`](crate::model::Reason) if a border cannot be traced.
    pub fn around(
        model: &Model,
        parameters: &Parameters,
        found: &[SwingPair],
        reach: f64,
        limits: &Limits,
    ) -> Result<Self> {
        let cycles = described(parameters, found);
        let border = Border::around(parameters, &cycles);
        let mut orbits = Vec::new();
        if border == Border::Separatrix {
            orbits.push(Orbit::separatrix(parameters, reach, limits)?);
        }
        for closing in found {
            let repels = closing.log_multiplier(parameters) > 0.0;
            let (both, side) = ([parameters; 2], first_side(parameters));
            orbits.push(Orbit::of_closing(both, side, closing, repels, limits)?);
        }
        let fates = fates_between(parameters, border, &cycles);
        let cycles = cycles.iter().map(|cycle| cycle.scaled(1.0, model.omega_0)).collect();
        let blank = Portrait { cycles, border, fates, followed: reach, ..Portrait::blank(model) };
        Ok(blank.parted(orbits))
    }

    /// With the orbits that part its motions, innermost first, and the kicks that follow from them.
    pub(crate) fn parted(mut self, orbits: Vec<Orbit>) -> Self {
        let arcs = orbits.iter().flat_map(|orbit| [&orbit.upper, &orbit.lower]);
        arcs.for_each(|arc| self.cost += arc.cost);
        self.borders = orbits.into_iter().map(|orbit| Edge::Orbit(Box::new(orbit))).collect();
        self.reach = if self.has_basin() {
            self.reach_within()
        } else {
            Some(Reach::default())
        };
        self.margin = self.margin_within(self.model.guide_static, self.model.mass);
        self
    }

    /// How far kicks may go within the border of the basin; `None` where nothing borders it.
    fn reach_within(&self) -> Option<Reach> {
        let Model { guide, guide_static, .. } = self.model;
        let edge @ Edge::Orbit(orbit) = self.edge()? else { return None };
        // What turns within the places that the guide holds rests there.
        let turn = |arc: &Arc| (guide + arc.clearance().value).max(guide_static);
        let displacement = (turn(&orbit.lower), turn(&orbit.upper));
        Some(Reach { displacement, velocity: self.kept_within(edge, 0.0) })
    }
}

impl Source {
    /// What it does.
    ///
    /// # Errors
    /// `Reason` where it has no model, or where motions leave the law before the border of rest is known.
    pub fn portrait(&self) -> Result<Portrait> {
        Portrait::of(&self.model()?)
    }
}

/// The portrait of a machine by the half swings that close; `None` of one with a belt, with damping of a higher power
/// than the third, with a family of periodic motions, or whose static friction holds what kinetic friction alone does
/// not: a turning point of a cycle, or a node that repels.
fn without_belt(model: &Model) -> Option<Portrait> {
    let parameters = model.parameters()?;
    let node = parameters.d <= -1.0;
    if is_centre(&parameters) || (node && model.holds_more_at_rest()) {
        return None;
    }
    let (reach, patient) = (picture_reach(parameters.d2), &Limits::PATIENT);
    let mut portrait =
        Portrait::by_closings(model, &parameters, usize::MAX, reach, patient).ok()?;
    let held = |cycle: &Cycle| cycle.q_max.min(-cycle.q_min) <= model.guide_static;
    if model.holds_more_at_rest() && portrait.cycles.iter().any(held) {
        return None;
    }
    portrait.border = match portrait.border {
        _ if !portrait.has_basin() => Border::NoBasin,
        // It comes out of the node that is the end of what the guide holds.
        Border::Separatrix if node => Border::Capture,
        border => border,
    };
    Some(portrait)
}

/// The fates of the regions that nested orbits make, from the inside out. Motions of a region go to what attracts on its
/// inner side, rest or a cycle, else to what is on its outer side, a cycle or infinity.
fn fates_between(parameters: &Parameters, border: Border, cycles: &[Cycle]) -> Vec<Fate> {
    let centre = Some(centre_fate(parameters)).filter(|fate| *fate != Fate::Escapes);
    let separatrix = (border == Border::Separatrix).then_some(None);
    let cycle = |(index, cycle): (usize, &Cycle)| cycle.stable.then_some(Fate::Cycle(index));
    let mut attracting = vec![centre];
    attracting.extend(separatrix);
    attracting.extend(cycles.iter().enumerate().map(cycle));
    attracting.push(Some(Fate::Escapes));
    let between = |sides: &[Option<Fate>]| sides[0].or(sides[1]).unwrap_or(Fate::Escapes);
    attracting.windows(2).map(between).collect()
}

/// The fate of the whole plane where nothing parts it, and next to rest.
pub(crate) fn centre_fate(parameters: &Parameters) -> Fate {
    let Parameters { d, d3, r, .. } = *parameters;
    if r > 0.0 || d > 0.0 || (d == 0.0 && d3 > 0.0) {
        Fate::Rest
    } else if is_centre(parameters) {
        Fate::Neutral
    } else {
        Fate::Escapes
    }
}
