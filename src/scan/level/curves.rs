//! All level curves within the ranges.

use std::f64::consts::{FRAC_PI_2, PI};

use rayon::prelude::*;

use super::arc::{ERROR, Excess, LevelArc, LevelMeter, Place};
use super::target::{LevelCurve, LevelEnd, LevelTarget, Levels};
use super::trail::{FIRST, Trail, passes, polar};
use crate::flow::{Cost, Limits, Reason, Result};
use crate::numerics::{PlaceTolerance, illinois, real};
use crate::scan::Scan;

impl Scan {
    /// The curves along which a column has a value, over the two numbers of this scan: every one that crosses an edge of the
    /// lattice of its points, in which chords lie within `chord`, as a part of the ranges.
    ///
    /// # Errors
    /// [`Reason::Interrupted`], or [`Reason::NotApplicable`] of a scan that does not measure the column, or goes over more or
    /// fewer numbers.
    pub fn curves(&self, target: LevelTarget, chord: f64, limits: &Limits) -> Result<Levels> {
        let [_, up] = self.over() else {
            return Err(Reason::NotApplicable { needs: "a scan over two numbers" });
        };
        let Some(column) = self.measured().iter().position(|column| *column == target.column)
        else {
            return Err(Reason::NotApplicable { needs: "a scan that measures the column" });
        };
        let (value, cost) = (target.value, Cost::default());
        let mut meter = LevelMeter { scan: self, column, value, chord, limits, cost };
        let nodes = meter.nodes()?;
        let numbers = nodes.iter().filter_map(|(_, excess)| excess.ok());
        let numbers = numbers.map(|excess| [excess + value; 2]);
        let seen = numbers.reduce(|[low, high], [one, _]| [low.min(one), high.max(one)]);
        let mut found: Vec<(Vec<Place>, LevelCurve)> = Vec::new();
        for (index, from) in nodes.iter().enumerate() {
            let above = nodes.get(index + 1).filter(|_| (index + 1) % up.count > 0);
            for to in above.into_iter().chain(nodes.get(index + up.count)) {
                let Some(seed) = meter.seed(*from, *to)? else { continue };
                let is_on =
                    |places: &[Place]| places.windows(2).any(|it| passes(it[0], it[1], &seed));
                if !found.iter().any(|(places, _)| is_on(places)) {
                    found.push(meter.curve(seed)?);
                }
            }
        }
        let curves = found.into_iter().map(|(_, curve)| curve).collect();
        Ok(Levels { curves, seen, cost: meter.cost })
    }
}

/// A point of the lattice with what is measured there.
type Node = (Place, Excess);

impl LevelMeter<'_> {
    /// The points of the lattice, column by column.
    fn nodes(&mut self) -> Result<Vec<Node>> {
        let [across, up] = [0, 1].map(|axis| self.scan.over()[axis].count);
        let part = |index: usize, count: usize| real(index) / real(count - 1);
        let node = |index: usize| {
            let place = [part(index / up, across), part(index % up, up)];
            let (excess, cost) = self.measured(place)?;
            Ok(((place, excess), cost))
        };
        let all = (0..across * up).into_par_iter().map(node).collect::<Result<Vec<_>>>()?;
        Ok(all.into_iter().map(|node| self.cost.spend(node)).collect())
    }

    /// Where a curve crosses an edge of the lattice, with larger numbers to its left.
    fn seed(&mut self, from: Node, to: Node) -> Result<Option<LevelArc>> {
        let ((from, Ok(one)), (to, Ok(other))) = (from, to) else { return Ok(None) };
        if (one > 0.0) == (other > 0.0) {
            return Ok(None);
        }
        let at = |part: f64| [0, 1].map(|axis| from[axis] + part * (to[axis] - from[axis]));
        let ends = [(0.0, one), (1.0, other)];
        let [(part, excess), _] = illinois(ends, 0.0, PlaceTolerance::Absolute(ERROR), |part| {
            Ok(self.excess(at(part))?.unwrap_or(f64::NAN))
        })?;
        let (_, uphill) = polar(from, to);
        let heading = uphill - FRAC_PI_2.copysign(other - one);
        let arc = LevelArc { from: at(part), heading, reach: FIRST, side: 1.0 };
        Ok(excess.is_finite().then_some(arc))
    }

    /// The curve through a seed, both ways, with its places.
    fn curve(&mut self, seed: LevelArc) -> Result<(Vec<Place>, LevelCurve)> {
        let Trail { mut places, end, mut step } = self.trail(seed)?;
        let mut ends = None;
        if let Some(last) = end {
            let back = LevelArc { heading: seed.heading + PI, side: -1.0, ..seed };
            let back = self.trail(back)?;
            ends = Some([back.end.unwrap_or(LevelEnd::Unknown), last]);
            step = step.max(back.step);
            places = back.places.into_iter().rev().chain(places.into_iter().skip(1)).collect();
        }
        let points = places.iter().map(|place| self.values(*place)).collect();
        Ok((places, LevelCurve { points, ends, step }))
    }
}
