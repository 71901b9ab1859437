//! Limit cycles along a parameter, with the special points of their branches.
//!
//! The cycles at both ends of the range and at a few values between are found first; from each, the
//! curve is followed ([`super::continuation`]) until it leaves the range, goes to infinity or shrinks to
//! nothing. Along D, D3 and r a curve is a graph over the amplitude: each of them changes the energy
//! balance of a swing in one direction only, so for a given clearance one value closes the cycle.
//!
//! ```
//! use hopfscope::flow::Limits;
//! use hopfscope::model::{Parameters, Knob};
//! use hopfscope::branch::SpecialKind;
//! use hopfscope::branch::along::{Points, branch};
//!
//! let parameters = Parameters { d: 0.0, d2: 0.0, d3: 0.01, r: 0.1 };
//! let range = (-0.1, 0.0);
//! let found = branch(&parameters, Knob::D, range, Points::Followed, 1e-8, &Limits::PATIENT)?;
//! let fold = found.special.iter().find(|special| special.kind == SpecialKind::Fold).unwrap();
//! assert!((fold.value + 0.046_814_10).abs() < 1e-8);
//! # Ok::<(), hopfscope::flow::Reason>(())
//! ```

use std::f64::consts::PI;

use rayon::prelude::*;

use super::{
    CurvePlace, CurvePoint, CycleCurve, Special, SpecialKind, Tangent, covers, escape_point,
    escape_product, is_beside, passes, vanishing,
};
use crate::flow::{Cost, Limits, Reason, Result};
use crate::model::{Knob, Parameters, Side};
use crate::numerics::{by_number, cbrt, ln, pow, powi, range, real};
use crate::portrait::{
    Cycle, Equation, Route, STEP, SwingPair, closings, first_side, natural_size, polish_near,
    upper_end, weak_closing,
};

/// A cycle and the parameter value at which it lives.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BranchPoint {
    /// Value of the branch's parameter.
    pub value: f64,
    /// The cycle there.
    pub cycle: Cycle,
}

/// The cycles along a parameter.
#[derive(Clone, Debug, PartialEq)]
pub struct Branch {
    /// The parameter that varies.
    pub parameter: Knob,
    /// Connected pieces, each in order along the curve.
    pub pieces: Vec<Vec<BranchPoint>>,
    /// The special points, by value.
    pub special: Vec<Special>,
    /// Values at which a point was left out, because doubles and thirty digits leave its cycle vague.
    pub vague: Vec<f64>,
    /// What it cost.
    pub cost: Cost,
}

/// How many points a connected piece of a branch has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Points {
    /// This many, evenly spaced.
    Even(usize),
    /// Those that were needed to follow it, in long strides, and not to where its cycles cannot be told
    /// from the sticking set: a picture on a screen shows no difference.
    Followed,
}

/// Follows the cycles while `parameter` runs over `range`.
///
/// Each point is a cycle whose clearance has a relative error of at most `tolerance`.
///
/// # Errors
/// The [`Reason`] why the branch could not be completed; [`Reason::NotApplicable`] for initial values.
pub fn branch(
    parameters: &Parameters,
    parameter: Knob,
    range: (f64, f64),
    points: Points,
    tolerance: f64,
    limits: &Limits,
) -> Result<Branch> {
    if !parameter.is_parameter() {
        return Err(Reason::NotApplicable { needs: "one of D, D2, D3, r to vary" });
    }
    let (mut from, to) = (range.0.min(range.1), range.0.max(range.1));
    if parameter == Knob::R {
        // Without friction the innermost cycle has shrunk to the steady state: begin just above.
        from = from.max(LEAST_FRICTION * to);
    }
    let mut curve = CycleCurve::new(parameters, parameter, to - from, tolerance, limits);
    if points == Points::Followed {
        (curve.strides, curve.budget) = (LONG_STRIDES, BUDGET);
    }
    let (pieces, special, vague) = Default::default();
    let found = Branch { parameter, pieces, special, vague, cost: Cost::default() };
    let mut tracer = CurveTracer { curve, range: (from, to), points, found };
    if parameter == Knob::D && parameters.is_piecewise_linear() {
        tracer.found.pieces.extend(linear_branch(parameters.r, from, to, points));
        tracer.hopf(parameters.r);
        return Ok(tracer.found);
    }
    tracer.special_points()?;
    // The side of the first swing follows the sign of D2, so a curve in D2 is followed on each side of 0.
    let through = parameter == Knob::D2 && from < 0.0 && to > 0.0;
    let parts = if through {
        vec![(from, 0.0), (0.0, to)]
    } else {
        vec![(from, to)]
    };
    for part in parts {
        tracer.range = part;
        tracer.trace()?;
    }
    let mut found = tracer.found;
    found.cost += tracer.curve.cost;
    found.special.sort_by(by_number(|special: &Special| special.value));
    Ok(found)
}

/// A branch over D or D3 ends at this fraction of the range from where its cycle is infinite, and at this fraction of the
/// natural amplitude where it shrinks to nothing.
const NEAREST: f64 = 1e-4;

/// Relative error of a clearance that is good enough, in units of the tolerance.
const POLISHED: f64 = 1e5;

/// Relative error of a clearance at which a cycle on its way to infinity is followed no further.
const VAGUE: f64 = 1e-3;

/// Relative error of a clearance beyond which a point that was followed is not shown: a picture of the branch could
/// tell.
const SHOWN: f64 = 0.1;

/// Folds closer than this fraction of the range are one.
const SAME: f64 = 1e-9;

/// A branch over r begins at this fraction of the largest r.
const LEAST_FRICTION: f64 = 1e-6;

/// Longest stride of [`Points::Followed`], in units of the usual one.
const LONG_STRIDES: f64 = 2.0;

/// Evaluations of a half map in a search for cycles of [`Points::Followed`]: where it takes more, the
/// other values have to do.
const SEED_BUDGET: u64 = 40_000;

/// Evaluations after which [`Points::Followed`] follows no further.
const BUDGET: u64 = 200_000;

/// Points of the closed form where as many are taken as are needed.
const LINEAR_POINTS: usize = 40;

/// Smallest `ln c0` that is followed, and how far below `ln r` [`Points::Followed`] ends: a millionth of a
/// millionth.
const DEEPEST: f64 = -600.0;
const SHALLOW: f64 = 28.0;

/// A branch in progress.
struct CurveTracer<'a> {
    curve: CycleCurve<'a>,
    /// The part of the range that is traced.
    range: (f64, f64),
    points: Points,
    found: Branch,
}

/// Amplitudes beyond this, in units of friction and of the natural scale, are not followed.
const LOG_FAR: f64 = 25.0;

impl CurveTracer<'_> {
    /// Follows every curve that passes one of the probing values.
    fn trace(&mut self) -> Result<()> {
        /// Fractions of the range at which cycles are sought: both ends, and between for curves that
        /// reach neither.
        const PROBES: [f64; 5] = [0.0, 1.0, 0.5, 0.25, 0.75];
        let (from, to) = self.range;
        let mut curves = Vec::new();
        self.curve.side = first_side(&self.curve.parameters_at(0.5 * (from + to)));
        for fraction in PROBES {
            let p = if fraction == 1.0 {
                to
            } else {
                from + fraction * (to - from)
            };
            for seed in self.seeds(p, &self.known(&curves))? {
                let graph = self.found.parameter != Knob::D2;
                let covered = |curve: &Vec<CurvePoint>| {
                    (graph && covers(curve, &seed)) || passes(curve, &seed)
                };
                if curves.iter().any(covered) {
                    continue;
                }
                let mut points = if fraction > 0.0 {
                    self.follow(seed, -1.0)?
                } else {
                    vec![seed]
                };
                points.reverse();
                if fraction < 1.0 {
                    points.pop();
                    points.extend(self.follow(seed, 1.0)?);
                }
                curves.push(points);
            }
        }
        for points in &curves {
            self.keep(points)?;
        }
        self.zero_crossings(&curves)
    }

    /// The intervals of u over which all cycles are known: those of the curves, where a curve is a graph
    /// over the amplitude.
    fn known(&self, curves: &[Vec<CurvePoint>]) -> Vec<(f64, f64)> {
        if self.found.parameter == Knob::D2 {
            return Vec::new();
        }
        curves.iter().map(|curve| range(curve.iter().map(|it| it.u))).collect()
    }

    /// All cycles at one value outside of known intervals of u, as points of curves.
    fn seeds(&mut self, p: f64, known: &[(f64, f64)]) -> Result<Vec<CurvePoint>> {
        let parameters = self.curve.parameters_at(p);
        let rough = self.points == Points::Followed;
        let limits = self.curve.limits.up_to(if rough { SEED_BUDGET } else { u64::MAX });
        let mut equation =
            Equation::on_side(&parameters, self.curve.side, self.curve.fineness(), &limits);
        let closings = closings(&mut equation, usize::MAX, known);
        self.curve.cost += equation.cost();
        let closings = match closings {
            Err(Reason::Budget { .. } | Reason::NoConvergence { .. }) if rough => Vec::new(),
            closings => closings?,
        };
        let point = |closing| CurvePoint::of(closing, p, &parameters);
        Ok(closings.into_iter().map(point).collect())
    }

    /// Follows one curve and ends it exactly at the border that it crosses.
    fn follow(&mut self, seed: CurvePoint, direction: f64) -> Result<Vec<CurvePoint>> {
        let ((from, to), bounds) = (self.range, self.bounds_of_u());
        // With D3 = 0 a cycle only ever fades by going to infinity.
        let fades = matches!(self.points, Points::Even(_))
            && self.found.parameter != Knob::D3
            && self.curve.parameters_at(from).d3 == 0.0;
        let leaves = move |point: &CurvePoint| {
            (fades && point.closing.uncertainty > VAGUE)
                || !(from..=to).contains(&point.p)
                || !(bounds.0..=bounds.1).contains(&point.u)
        };
        let mut points = self.curve.follow(seed, direction, &leaves)?;
        if let [.., inside, outside] = points[..]
            && !(from..=to).contains(&outside.p)
        {
            points.pop();
            points.extend(self.crossing(&inside, &outside)?);
        }
        Ok(points)
    }

    /// The cycle between a point inside the range and one outside, at the border of the range.
    fn crossing(
        &mut self,
        inside: &CurvePoint,
        outside: &CurvePoint,
    ) -> Result<Option<CurvePoint>> {
        let (from, to) = self.range;
        let border = if outside.p > to { to } else { from };
        let fraction = (border - inside.p) / (outside.p - inside.p);
        let u = inside.u + fraction * (outside.u - inside.u);
        let found = self.curve.correct((u, border), Tangent::ACROSS_U, inside.route())?;
        let scale = self.curve.scale;
        Ok(found.filter(|it| is_beside([inside, outside], (it.u, it.p), scale)))
    }

    /// Smallest and largest `ln c0` followed: beyond, a curve counts as gone to nothing or to infinity.
    ///
    /// Over D3 a cycle goes to infinity at `D3 = 0`: it is followed to within [`NEAREST`] of the range from
    /// there, because values of the parameter are known relative to the range.
    fn bounds_of_u(&self) -> (f64, f64) {
        let parameters = self.curve.parameters_at(self.curve.scale);
        let Parameters { d, d2, d3, r } = parameters;
        let natural = natural_size(d2, d3);
        let natural = if natural.is_finite() { natural } else { r };
        let deepest = match self.points {
            Points::Followed if r > 0.0 => ln(r) - SHALLOW,
            _ => DEEPEST,
        };
        if d3 == 0.0 && d2 != 0.0 {
            return (deepest, upper_end(&parameters));
        }
        // Towards a Hopf point D goes to 0 as the square of the amplitude.
        let smallest = if r > 0.0 { deepest } else { ln(natural) + ln(NEAREST) };
        if self.found.parameter != Knob::D3 {
            return (smallest, ln(natural.max(r)) + LOG_FAR);
        }
        let least = NEAREST * self.curve.scale;
        // Sizes there: by linear and cubic damping alone (52), by friction and cubic damping (50), on the slow manifold
        // by asymmetric and cubic damping; finally those of the cycles that go through D3 = 0.
        let sizes = [
            (8.0 * d.abs() / (3.0 * least)).sqrt(),
            cbrt(16.0 * r / (3.0 * PI * least)),
            d2.abs() * powi(d2 / least, 2),
            if d == 0.0 { 0.0 } else { 4.0 * r / d.abs() },
            if d2 == 0.0 { 0.0 } else { 60.0 / d2.abs() },
        ];
        (smallest, ln(sizes.into_iter().fold(0.0, f64::max)))
    }

    /// Notes the cycles at `D = 0`: where the curves pass it, and what else there may be.
    fn zero_crossings(&mut self, curves: &[Vec<CurvePoint>]) -> Result<()> {
        let friction = self.curve.parameters_at(0.0).r > 0.0;
        if self.found.parameter != Knob::D || !friction || !self.reaches(0.0) {
            return Ok(());
        }
        let mut found = self.seeds(0.0, &self.known(curves))?;
        for pair in curves.iter().flat_map(|points| points.windows(2)) {
            let [one, other] = pair else { continue };
            if (one.p < 0.0) != (other.p < 0.0) {
                let u = one.u - one.p * (other.u - one.u) / (other.p - one.p);
                let route = Route::contracting(0.5 * (one.log_multiplier + other.log_multiplier));
                found.extend(self.curve.correct((u, 0.0), Tangent::ACROSS_U, route)?);
            }
        }
        for point in &found {
            self.note(SpecialKind::ZeroCrossing, point);
        }
        Ok(())
    }

    /// Spreads points over the parts of a curve within the range and describes each; notes the folds.
    fn keep(&mut self, points: &[CurvePoint]) -> Result<()> {
        let mut part: Vec<CurvePoint> = points.iter().take(1).copied().collect();
        for pair in points.windows(2) {
            let [one, other] = pair else { continue };
            let turns = (one.log_multiplier > 0.0) != (other.log_multiplier > 0.0);
            let fold = if turns {
                self.curve.fold_between(one, other)?
            } else {
                None
            };
            match fold {
                Some(fold) if !self.reaches(fold.p) => {
                    // Between both points the curve leaves the range and comes back.
                    part.extend(self.crossing(one, &fold)?);
                    self.keep_part(&std::mem::take(&mut part))?;
                    part.extend(self.crossing(other, &fold)?);
                }
                Some(fold) => self.note_fold(&fold),
                None => {}
            }
            part.push(*other);
        }
        self.keep_part(&part)
    }

    /// Notes a fold, once: next to it the multiplier may cross 1 back and forth by rounding.
    fn note_fold(&mut self, fold: &CurvePoint) {
        let near = |it: &Special| {
            it.kind == SpecialKind::Fold && (it.value - fold.p).abs() <= SAME * self.curve.scale
        };
        if !self.found.special.iter().any(near) {
            self.note(SpecialKind::Fold, fold);
        }
    }

    /// Spreads points over a part of a curve and describes each.
    fn keep_part(&mut self, points: &[CurvePoint]) -> Result<()> {
        let mut piece = Vec::new();
        if let Points::Even(count) = self.points {
            let (places, curve) = (self.curve.spread(points, count.max(2))?, &self.curve);
            let polished = places.par_iter().map(|place| polished(curve, place));
            let polished: Vec<_> = polished.collect::<Result<_, _>>()?;
            for (place, polished) in places.iter().zip(polished) {
                match self.curve.cost.spend(polished) {
                    Some(cycle) => piece.push(BranchPoint { value: place.p, cycle }),
                    None => self.found.vague.push(place.p),
                }
            }
        } else {
            let clear = points.iter().filter(|at| at.closing.uncertainty <= SHOWN);
            piece.extend(clear.map(|at| BranchPoint { value: at.p, cycle: self.describe(at) }));
        }
        if !piece.is_empty() {
            self.found.pieces.push(piece);
        }
        Ok(())
    }

    fn describe(&self, point: &CurvePoint) -> Cycle {
        point.closing.describe(&self.curve.parameters_at(point.p), self.curve.side)
    }

    /// Notes a cycle of a curve that is a special point.
    fn note(&mut self, kind: SpecialKind, point: &CurvePoint) {
        self.found.special.push(Special::new(kind, point.p, Some(self.describe(point))));
    }

    /// Notes the Hopf point: without friction the steady state changes its stability at `D = 0`.
    fn hopf(&mut self, r: f64) {
        if self.found.parameter == Knob::D && r == 0.0 && self.reaches(0.0) {
            self.found.special.push(Special::new(SpecialKind::Hopf, 0.0, Some(vanishing())));
        }
    }

    /// The special points that are not folds.
    fn special_points(&mut self) -> Result<()> {
        let parameters = self.curve.parameters_at(0.0);
        self.hopf(parameters.r);
        let values = match self.found.parameter {
            Knob::D => [self.found.cost.spend(escape_point(&parameters, self.curve.limits)?), None],
            Knob::D2 | Knob::R if parameters.d3 == 0.0 => {
                // Only the product of friction and asymmetric damping matters.
                let other = if self.found.parameter == Knob::R {
                    parameters.d2
                } else {
                    parameters.r
                };
                let product = escape_product(parameters.d, self.curve.limits)?;
                let value = self.found.cost.spend(product).map(|product| product / other.abs());
                // One of them at most lies within a range of friction, which is never negative.
                [value, value.map(|value| -value)]
            }
            _ => [None; 2],
        };
        let values = values.into_iter().flatten().filter(|value| self.reaches(*value));
        let escapes = values.map(|value| Special::new(SpecialKind::Escape, value, None));
        self.found.special.extend(escapes.collect::<Vec<_>>());
        Ok(())
    }

    fn reaches(&self, value: f64) -> bool {
        (self.range.0..=self.range.1).contains(&value)
    }
}

/// The cycle at a place as the search for cycles finds it, to rounding, and what it cost; no cycle where it cannot be
/// told.
fn polished(curve: &CycleCurve, place: &CurvePlace) -> Result<(Option<Cycle>, Cost)> {
    let (parameters, side) = (curve.parameters_at(place.p), curve.side);
    if let Some(closing) = weak_closing(&parameters) {
        return Ok((Some(closing.describe(&parameters, side)), Cost::default()));
    }
    let mut equation = Equation::on_side(&parameters, side, STEP, curve.limits);
    let sharp = POLISHED * curve.tolerance;
    let closing = polish_near(&mut equation, place.u, place.log_multiplier, sharp);
    let closing = Reason::tolerated(closing)?.ok().flatten();
    Ok((closing.map(|closing| closing.describe(&parameters, side)), equation.cost()))
}

/// The branch of the piecewise linear oscillator over D, from its closed form.
///
/// Its amplitude grows as `2 r/(pi abs(D))` towards `D = 0`; it is followed to a ten-thousandth of the
/// range from there, with points evenly spaced in the logarithm of D.
fn linear_branch(r: f64, from: f64, to: f64, points: Points) -> Option<Vec<BranchPoint>> {
    let from = from.max((-1.0_f64).next_up());
    let to = to.min(NEAREST * from);
    if !(r > 0.0 && from < to) {
        return None;
    }
    let count = match points {
        Points::Even(count) => count.max(2),
        Points::Followed => LINEAR_POINTS,
    };
    let point = |index: usize| {
        let fraction = real(index) / real(count - 1);
        // Both ends to the last bit.
        let d = match index {
            0 => from,
            _ if index + 1 == count => to,
            _ => from * pow(to / from, fraction),
        };
        let parameters = Parameters { d, d2: 0.0, d3: 0.0, r };
        let cycle = SwingPair::linear(&parameters)?.describe(&parameters, Side::Upper);
        Some(BranchPoint { value: d, cycle })
    };
    Some((0..count).filter_map(point).collect())
}
