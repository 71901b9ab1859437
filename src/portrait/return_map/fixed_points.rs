//! The limit cycles of a machine: the fixed points of the return map, each found and described.

use super::{Image, Landmarks};
use crate::flow::{Flow, MachineCurve, Reason, Result};
use crate::model::{ContactState, Model, Phase};
use crate::numerics::{
    PlaceTolerance, bisect, by_number, exp, exponent, ln, pow, range, real, times_power, try_newton,
};
use crate::portrait::{Bracket, Cycle, Node, Portrait, Ride, RootSearch, places};

/// A right turning point at which the return map changes.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Divide {
    /// A fixed point: a cycle, with its image.
    Cycle(Image),
    /// The map jumps: a touch becomes a ride, or the mirror band ends.
    Jump,
    /// The last one from which the guide catches the mass within one return; motions from beyond grow. The border of
    /// rest is then the motion that just reaches the end of what the guide holds.
    Capture,
}

/// A right turning point with what happens there.
pub(crate) type Mark = (f64, Divide);

/// Logarithm of the multiplier from which cycles are computed backward in time.
const STRONG: f64 = 4.0;

/// Values of the growth below this count as zero.
pub(crate) const NOTHING: f64 = 1e-12;

/// Replaces a value that does not exist because the mass comes to rest or escapes.
const FAR: f64 = 1e3;

/// The growth at `u = ln(x/unit)` where the return map leads from `x` to this image.
fn growth_to(u: f64, x: f64, image: &Image) -> Node {
    let growth = if image.x > 0.0 { ln(image.x / x) } else { -FAR };
    Node::of_growth(u, growth, exp(image.log_slope) * x / image.x - 1.0)
}

/// The right turning points at which the return map changes, by amplitude: its fixed points, and where it jumps or catches.
/// Tells the portrait how far they were sought, what ended the search, and where it did not settle. Fails with [`Reason`]
/// if even the motions next to rest cannot be followed.
pub fn fixed_points(flow: &mut Flow, portrait: &mut Portrait) -> Result<Vec<Mark>> {
    let marks = portrait.landmarks;
    let divides = jumps(flow.model, marks);
    let unit = unit(flow.model, marks);
    let mut search = FixedPointSearch { flow, unit, portrait, divides };
    search.run(marks)?;
    search.divides.sort_by(by_number(|(x, _): &Mark| *x));
    Ok(search.divides)
}

/// Jumps of the return map: where a touch becomes a ride, and where the mirror band ends.
fn jumps(model: &Model, marks: Option<Landmarks>) -> Vec<Mark> {
    let Some(Landmarks { lines, touch, beyond, .. }) = marks else { return Vec::new() };
    let ends = beyond.filter(|_| lines.release > lines.fold && beyond != touch);
    let places = touch.into_iter().chain(ends).filter(|x| *x > model.guide_static);
    places.map(|x| (x, Divide::Jump)).collect()
}

/// A power of two beyond all special lengths of the machine, so that results do not depend on their unit.
fn unit(model: &Model, marks: Option<Landmarks>) -> f64 {
    let marks = marks.into_iter().flat_map(|it| [it.touch, it.released, it.beyond]);
    let lengths = [model.guide_static, model.pull, model.speed].into_iter();
    let lengths = lengths.chain(marks.flatten()).chain(model.velocities());
    let largest = lengths.filter(|x| x.is_finite()).fold(0.0, f64::max);
    if largest > 0.0 {
        times_power(1.0, exponent(largest) + 1)
    } else {
        1.0
    }
}

/// The search for the fixed points, over the logarithm of right turning points in a unit.
struct FixedPointSearch<'f, 'm> {
    flow: &'f mut Flow<'m>,
    unit: f64,
    portrait: &'f mut Portrait,
    divides: Vec<Mark>,
}

impl FixedPointSearch<'_, '_> {
    /// The growth of the return map at a logarithm.
    fn growth(&mut self, u: f64) -> Result<Node> {
        self.flow.growth(u, self.unit)
    }

    /// The growth at a right turning point.
    fn growth_at(&mut self, x: f64) -> Result<Node> {
        self.growth(ln(x / self.unit))
    }

    /// The right turning point at a logarithm.
    fn turn(&self, u: f64) -> f64 {
        self.unit * exp(u)
    }

    fn run(&mut self, marks: Option<Landmarks>) -> Result<()> {
        let held = self.flow.model.guide_static;
        let caught = match self.smallest() {
            // Every motion comes to rest at once, or leaves the law.
            Err(stop @ Reason::BeyondLaw { .. }) => {
                let within = Node::of_growth(ln(held / self.unit), -FAR, 0.0);
                let end = self.edge(within, 0.0).at;
                (self.portrait.stop, self.portrait.known) = (Some(stop), self.turn(end));
                return Ok(());
            }
            smallest => smallest?,
        };
        // By rounding, a motion from there may still come to rest.
        let beyond = |x: f64| x * (1.0 + 1e-12);
        let mut smallest = caught.max(beyond(held));
        let slips = smallest.is_finite();
        // A cycle that repels so strongly that the map itself cannot resolve it is met a few turns before rest.
        let innermost = if held > 0.0 && slips {
            self.settled_backward(smallest)?
        } else {
            None
        };
        if let Some((x, image)) = innermost {
            self.divides.push((x, Divide::Cycle(image)));
            smallest = x;
        }
        smallest = beyond(smallest);
        // The motion that touches the belt's line, as if it slipped.
        let touch = marks.and_then(|marks| Some((marks.touch?, marks.grazing)));
        let touches_before = touch.is_some_and(|(touch, _)| touch > held && touch <= smallest);
        if held > 0.0 && slips && !touches_before && innermost.is_none() {
            let grows = self.growth_at(smallest)?.value > 0.0;
            self.divides.extend(grows.then_some((caught, Divide::Capture)));
        }
        // Where motions only slip: up to the one that touches the belt's line.
        if slips && touch.is_none_or(|(touch, _)| touch > smallest) {
            let last = match touch {
                Some((touch, image)) => growth_to(ln(touch / self.unit), touch, &image),
                None => self.farthest(smallest)?,
            };
            let first = self.growth_at(smallest)?;
            self.portrait.known = self.turn(last.at);
            self.portrait.neutral = self.is_neutral(first, last)?;
            if !self.portrait.neutral {
                self.zeros_between(first, last)?;
            }
        }
        // Where they are released by the belt, and where they overtake it.
        let released = marks.and_then(|marks| marks.released);
        if let Some(released) = released.filter(|x| touch.is_some_and(|(touch, _)| *x >= touch)) {
            match self.flow.returned(released) {
                Ok(Some(image)) if image.sticks_from.is_some() => {
                    self.divides.push((released, Divide::Cycle(image)));
                }
                // What escapes is known.
                Err(stop) if stop != Reason::Escapes => self.portrait.stop = Some(stop),
                _ => {}
            }
        }
        if let Some(beyond) = marks.and_then(|marks| marks.beyond) {
            let start = beyond * (1.0 + 4.0 * f64::EPSILON);
            let start = if slips { start.max(smallest) } else { start };
            if let Ok(first) = self.growth_at(start) {
                let last = self.farthest(start)?;
                self.portrait.known = self.turn(last.at);
                self.zeros_between(first, last)?;
            }
        }
        if self.portrait.stop.is_none() && self.flow.model.law_ends() {
            // Motions that come to ride on the belt are known as far as the law reaches.
            let from = if slips { smallest } else { beyond(held) };
            let last = self.farthest(from.max(self.portrait.known))?;
            self.portrait.known = self.portrait.known.max(self.turn(last.at));
        }
        Ok(())
    }

    /// The right turning point below which every motion comes to rest; without friction of the guide, a point
    /// below which the map is linear.
    fn smallest(&mut self) -> Result<f64> {
        /// Growth below this is about to be lost in rounding.
        const WEAK: f64 = 1e-9;
        let held = self.flow.model.guide_static;
        if held > 0.0 {
            // A motion that comes to rest there was released by the belt: those that only slip rest before.
            let before = self.flow.preimage(held)?;
            return Ok(before.map_or(f64::INFINITY, |before| before.x.max(held)));
        }
        let mut x = self.unit * 1e-3;
        let linear = self.flow.model.linear_growth();
        for _ in 0..12 {
            let here = self.growth_at(x)?.value;
            let settled = (here - linear).abs() <= 0.1 * linear.abs() || here.abs() < WEAK;
            if settled || !linear.is_finite() {
                break;
            }
            x *= 0.1;
        }
        Ok(x)
    }

    /// Finds the zeros of the growth between two samples.
    fn zeros_between(&mut self, first: Node, last: Node) -> Result<()> {
        /// Number of intervals to begin with, and how often each is halved at most.
        const PARTS: f64 = 8.0;
        const HALVINGS: f64 = 4096.0;
        let part = (last.at - first.at) / PARTS;
        let finest = 0.5 * part / HALVINGS;
        let mut search = RootSearch { finest, nothing: NOTHING, ..RootSearch::default() };
        let mut left = first;
        while left.at < last.at {
            let next = left.at + part;
            let near_end = left.at + 1.5 * part > last.at || next <= left.at;
            let right = if near_end { last } else { self.growth(next)? };
            search.between(left, right, 0.0, &mut |u, _| self.growth(u))?;
            left = right;
        }
        for (from, to) in search.unresolved {
            let ends = (self.turn(from), self.turn(to));
            self.portrait.unresolved.push(ends);
        }
        for bracket in search.found {
            let zero = self.zero(bracket)?;
            let point = self.sharpened(self.turn(zero))?;
            self.divides.extend(point.map(|(x, image)| (x, Divide::Cycle(image))));
        }
        Ok(())
    }

    /// The zero of the growth in a bracket, by Newton's method.
    fn zero(&mut self, (left, right): Bracket) -> Result<f64> {
        let best = if left.value.abs() < right.value.abs() {
            left
        } else {
            right
        };
        if best.value == 0.0 {
            return Ok(best.at);
        }
        let bracket = places(&(left, right));
        let width = 2.0 * f64::EPSILON * (1.0 + best.at.abs()).min(2.0);
        let start = bracket.inside(best.at - best.value / best.slope);
        let root = try_newton(bracket, start, PlaceTolerance::Absolute(width), |u| {
            self.growth(u).map(|sample| (sample.value, sample.slope))
        });
        Ok(root?.0)
    }

    /// The fixed point near `x` with its image; if it repels strongly, by the inverse map.
    fn sharpened(&mut self, x: f64) -> Result<Option<(f64, Image)>> {
        let Some(image) = self.flow.returned(x)? else { return Ok(None) };
        let repels = image.slips() && image.log_slope >= STRONG;
        let sharper = if repels { self.settled_backward(x)? } else { None };
        Ok(Some(sharper.unwrap_or((x, image))))
    }

    /// The strongly repelling fixed point to which a few turns backward lead from `x`, with its image; `None` where they
    /// lead to none.
    fn settled_backward(&mut self, mut x: f64) -> Result<Option<(f64, Image)>> {
        /// Maximum number of turns.
        const TURNS: usize = 8;
        /// To rounding, a cycle that repels beyond all digits turns where the guide lets go.
        const ROUNDING: f64 = 1e-12;
        let held = self.flow.model.guide_static;
        for _ in 0..TURNS {
            // A turning point that the guide holds is on no cycle; neither is the equilibrium of a phase.
            let moves = |image: &Image| {
                let left = -image.left >= held * (1.0 - ROUNDING);
                image.x >= held && left && image.log_slope.is_finite()
            };
            let Some(image) = self.flow.preimage(x)?.filter(moves) else { return Ok(None) };
            if (image.x - x).abs() <= 2.0 * f64::EPSILON * x {
                return Ok(Some((x, image)));
            }
            if image.log_slope < STRONG {
                return Ok(None);
            }
            x = image.x;
        }
        Ok(None)
    }

    /// A right turning point far beyond the unit, or as far as motions can be followed.
    fn farthest(&mut self, from: f64) -> Result<Node> {
        /// Factor by which it lies beyond.
        const DOUBLINGS: u32 = 10;
        /// Doublings after which the shrinking of motions counts.
        const ENOUGH: u32 = 3;
        /// If a swing takes more than half of the amplitude, and the more the larger it is, dissipation dominates.
        const CONTRACTS: f64 = -0.7;
        let mut last = self.growth_at(from)?;
        let mut x = from.max(self.unit);
        for doubling in 0..DOUBLINGS {
            let before = last;
            match self.growth_at(x) {
                Ok(sample) => last = sample,
                Err(stop) => {
                    self.portrait.stop = Some(stop);
                    // Where motions take too many steps, finding the first of them costs too much.
                    let dear = stop == Reason::Steps;
                    return Ok(if dear {
                        last
                    } else {
                        self.edge(last, ln(x / self.unit))
                    });
                }
            }
            let grows_less = last.value < CONTRACTS && last.value < before.value;
            if (doubling > ENOUGH && grows_less) || last.value >= FAR {
                break;
            }
            x *= 2.0;
        }
        Ok(last)
    }

    /// The last point up to which the map is known, between one where it is and one where it is not.
    fn edge(&mut self, known: Node, unknown: f64) -> Node {
        let mut last = known;
        bisect(known.at, unknown, 40, |u| self.growth(u).map(|sample| last = sample).is_err());
        last
    }

    /// Whether all motions between two samples are periodic.
    fn is_neutral(&mut self, first: Node, last: Node) -> Result<bool> {
        let middle = self.growth(0.5 * (first.at + last.at))?;
        let other = self.growth(0.3 * first.at + 0.7 * last.at)?;
        Ok([first, middle, other, last].iter().all(|sample| sample.value.abs() < NOTHING))
    }
}

impl Flow<'_> {
    /// `ln(image/x)` of the return map over `u = ln(x/unit)`.
    pub(crate) fn growth(&mut self, u: f64, unit: f64) -> Result<Node> {
        let x = unit * exp(u);
        let lost = |f| Ok(Node::of_growth(u, f, 0.0));
        match self.returned(x) {
            Ok(Some(image)) => Ok(growth_to(u, x, &image)),
            Ok(None) => lost(-FAR),
            Err(Reason::Escapes) => lost(FAR),
            Err(stop) => Err(stop),
        }
    }

    /// The description of the cycle through a right turning point.
    ///
    /// # Errors
    /// [`Reason`] if rounding carries the motion away.
    pub fn describe(&mut self, x: f64, image: &Image, stable: bool) -> Result<Cycle> {
        let Model { omega_0, guide, .. } = *self.model;
        let sticks = image.sticks_from.is_some();
        let (curve, _) = self.around(x, !stable && image.slips())?;
        let peaks = curve.steps.iter().filter_map(|step| Some(step.at(step.peak?).1));
        let (slowest, fastest) = range([0.0].into_iter().chain(peaks));
        let duration: f64 = curve.steps.iter().map(|step| step.duration).sum();
        let mut rides = curve.steps.iter().filter(|step| step.place == ContactState::Sticks);
        let riding: f64 = rides.clone().map(|step| step.duration).sum();
        // The last of them, with the time spent on all.
        let ride = rides.next_back().map(|step| {
            let [from, to] = [0.0, step.duration].map(|t| step.at(t).0);
            Ride { from, to, duration: riding / omega_0 }
        });
        let log_multiplier = if sticks { f64::NEG_INFINITY } else { image.log_slope };
        Ok(Cycle {
            stable,
            q_min: image.left,
            q_max: x,
            v_min: slowest * omega_0,
            v_max: fastest * omega_0,
            period: duration / omega_0,
            multiplier: Some(exp(log_multiplier)).filter(|multiplier| multiplier.is_finite()),
            log_multiplier,
            clearance: x - guide,
            log_clearance: ln(x - guide),
            ride: ride.filter(|_| sticks),
            overtakes: image.overtakes_from.is_some(),
            ..Cycle::default()
        })
    }

    /// The motion once around from a right turning point, with its left one; backward in time if that attracts.
    ///
    /// # Errors
    /// [`Reason`] if rounding carries the motion away.
    pub fn around(&mut self, x: f64, backward: bool) -> Result<(MachineCurve, f64)> {
        let mut curve = MachineCurve::default();
        let left = if backward {
            let left = self.arc(Phase::Between, (x, 0.0), true, &mut curve.keeper())?.x;
            self.arc(Phase::Below, (left, 0.0), true, &mut curve.keeper())?;
            left
        } else {
            let [below, between] = [Phase::Below, Phase::Between].map(ContactState::Slips);
            let left = self.turn(below, (x, 0.0), &mut curve.keeper())?.x;
            self.turn(between, (left, 0.0), &mut curve.keeper())?;
            left
        };
        Ok((curve, left))
    }
}

impl Model {
    /// The logarithm by which a small motion grows in one swing around a rest without friction of the guide;
    /// infinite where it does not swing.
    pub fn linear_growth(&self) -> f64 {
        let d = 0.5 * self.damping;
        let turning = (1.0 - d * d).sqrt();
        if turning > 0.0 {
            -std::f64::consts::TAU * d / turning
        } else {
            f64::NEG_INFINITY * d
        }
    }

    /// Velocities at which the force changes its form.
    fn velocities(&self) -> Vec<f64> {
        let mut found: Vec<f64> = self.slower.fall.iter().map(|fall| fall.velocity).collect();
        for piece in &self.slower.pieces {
            let c = &piece.coefficients;
            if piece.center == 0.0 && c.len() > 2 && c[1] != 0.0 {
                let knee = |(k, c_k): (usize, &f64)| pow((c[1] / c_k).abs(), 1.0 / real(k - 1));
                found.extend(c.iter().enumerate().skip(2).filter(|(_, c)| **c != 0.0).map(knee));
            }
        }
        found
    }
}
