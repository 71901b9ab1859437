//! The fate of every motion: the cycles, and the basin of rest with its border and margins.
//!
//! Fixed points and jumps of the return map cut the line of right turning points into gaps. Within a gap all
//! motions go one way, to the next cycle on that side. One evaluation in each gap therefore settles the fate of
//! all starts; a start itself is followed only to its next right turning point.

use std::borrow::Cow;

use rayon::prelude::*;

use super::{
    Border, Counts, Cycle, Edge, Kicks, Landmarks, Margin, Orbit, Reach, Share, StartWindow,
    evenly, part_within,
};
use crate::closed_form::lyapunov;
use crate::flow::{Cost, Fate, Flow, Limits, Reason, Result};
use crate::model::{ContactState, Model, Phase, RestKicks};
use crate::numerics::bisect;

/// A gap between right turning points.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Gap {
    /// Its upper end.
    pub to: f64,
    pub fate: Fate,
    /// Fate of a motion that turns exactly at the upper end.
    pub end: Fate,
}

/// All possible motions of a machine.
#[derive(Clone, Debug, Default)]
pub struct Portrait {
    /// Its model.
    pub model: Model,
    /// The cycles, by amplitude.
    pub cycles: Vec<Cycle>,
    /// Whether there is a family of periodic orbits.
    pub neutral: bool,
    /// The border of the basin of rest; of the neutral family, if rest belongs to one.
    pub border: Border,
    /// The kicks that are survived in each direction; `None` if every kick is. If all motions that the law covers come
    /// to rest, these are the kicks that it covers.
    pub reach: Option<Reach>,
    /// The smallest kicks that are not survived, in m and N s.
    pub margin: Margin,
    /// Where the line of the belt is met.
    pub landmarks: Option<Landmarks>,
    /// Why motions that turn beyond [`Self::known`] are unknown; `None` if all are known.
    pub stop: Option<Reason>,
    /// Right turning point up to which the return map was evaluated.
    pub known: f64,
    /// Intervals of right turning points in which the search for cycles did not settle: pairs of cycles may
    /// hide there.
    pub unresolved: Vec<(f64, f64)>,
    /// What it cost.
    pub cost: Cost,
    /// The borders that were traced, innermost first, velocities being divided by the natural frequency: without a belt
    /// all of them, on a belt that of the basin of rest.
    pub borders: Vec<Edge>,
    /// Fates inside the first border, between the first and the second, .., outside the last; empty where only gaps are
    /// known.
    pub(super) fates: Vec<Fate>,
    /// How far out a border that is not closed was followed, in m.
    pub(super) followed: f64,
    pub(super) gaps: Vec<Gap>,
}

impl PartialEq for Portrait {
    /// Portraits of one model that were followed equally far are equal where cycles and border are: all else follows.
    fn eq(&self, other: &Self) -> bool {
        self.model == other.model
            && self.followed == other.followed
            && self.cycles == other.cycles
            && self.border == other.border
    }
}

impl Portrait {
    /// The portrait of a model all of whose motions come to rest, as far as is known yet.
    pub(crate) fn blank(model: &Model) -> Self {
        let (model, all) = (model.clone(), f64::INFINITY);
        Portrait { model, known: all, followed: all, ..Portrait::default() }
    }

    /// The border of the basin, if one was traced.
    #[must_use]
    pub fn edge(&self) -> Option<&Edge> {
        self.borders.first().filter(|_| !matches!(self.border, Border::None | Border::NoBasin))
    }

    /// Whether motions next to rest come to rest, or belong to a family of periodic ones with it.
    #[must_use]
    pub fn has_basin(&self) -> bool {
        self.border != Border::NoBasin && self.fates.first().is_none_or(|fate| *fate == Fate::Rest)
    }

    /// The cycle that borders the basin of rest.
    #[must_use]
    pub fn bordering_cycle(&self) -> Option<&Cycle> {
        let x = self.reach.filter(|_| self.border == Border::Cycle)?.displacement.0;
        self.cycles.iter().find(|cycle| cycle.q_max == x)
    }

    /// The margin if the mass, of this size, may rest up to a `farthest` place on either side, in m.
    ///
    /// From the worst rest position it is the gap between the border and the places of rest on `v = 0`, and the height of
    /// the border above the farthest of them: the upper half of the border is a graph `v(q)` with slope `a/v`, and where
    /// it is level (`a = 0`) its second derivative is `-1/v`, because the spring's force falls with q. So it has no
    /// minimum between its ends, and over a segment it is lowest at an end; the lower half likewise.
    #[must_use]
    pub fn margin_within(&self, farthest: f64, mass: f64) -> Margin {
        let Some(Reach { displacement: (right, left), velocity: (up, down) }) = self.reach else {
            return Margin::ENDLESS;
        };
        if !self.has_basin() {
            return Margin::ZERO;
        }
        let (nearest, ends) = (right.min(left), [farthest, -farthest]);
        let (gap, heights) = if let Some(edge) = self.edge() {
            let left = match edge {
                // Of a border next to the places of rest, the clearance has digits that its place has not.
                Edge::Orbit(orbit) => orbit.clearance() - (farthest - self.model.guide),
                Edge::Curve(_) => nearest - farthest,
            };
            (left.max(0.0), ends.map(|x| self.kept_within(edge, x)))
        } else {
            let [right, left] = ends.map(|x| self.covered(x));
            (right.displacement.0.min(left.displacement.1), [right.velocity, left.velocity])
        };
        let [one, other] = heights.map(|(up, down)| up.min(down));
        let impulse = if gap > 0.0 { mass * one.min(other) } else { 0.0 };
        let finite = |size: &f64| Some(*size).filter(|size| size.is_finite());
        let sizes = Kicks {
            displacement: nearest,
            impulse: mass * up.min(down),
            from_rest: RestKicks { displacement: gap, impulse },
        };
        sizes.each(finite, finite)
    }

    /// Radius of the disk that Lyapunov's method proves to be captured (equation 24), as a fraction of the true margin:
    /// how conservative it is, or by how much it is wrong, because it leaves out D2 and D3. `None` on a belt.
    #[must_use]
    pub fn lyapunov_share(&self) -> Option<f64> {
        let Margin { displacement, impulse, .. } = self.in_drawing(&self.margin);
        let margin = displacement?.min(impulse?);
        lyapunov::radius(&self.model.parameters()?).map(|radius| radius / margin)
    }

    /// The kicks from rest at `from` that certainly come to rest, if motions that slip faster than the law covers are
    /// unknown, or some could not be followed. Motions do not cross, so in each direction these are all kicks up to a
    /// largest one. It is sought beyond [`Self::known`] only where the law ends.
    pub(super) fn covered(&self, from: f64) -> Reach {
        /// Halvings down to rounding.
        const HALVINGS: u32 = 60;
        let Model { omega_0, .. } = self.model;
        let most = |far: f64, (right, up): (f64, f64)| {
            let fate = |kick: f64| self.fate(from + kick * right, kick * up * omega_0);
            let lost = |kick: f64| fate(kick) != Ok(Fate::Rest);
            if lost(far) {
                bisect(0.0, far, HALVINGS, lost).0
            } else {
                far
            }
        };
        let known = self.known;
        let (x, y) = if self.model.law_ends() {
            (4.0 * known, 4.0 * known.max(-self.model.least_velocity()))
        } else {
            (known, known)
        };
        Reach {
            displacement: (most(known, (1.0, 0.0)), most(x, (-1.0, 0.0))),
            velocity: (omega_0 * most(y, (0.0, 1.0)), omega_0 * most(y, (0.0, -1.0))),
        }
    }

    /// With and against the belt the velocities, in m/s, up to which motions from rest at a displacement stay within a
    /// border: none where it begins at a node that repels, or does not pass there.
    pub(crate) fn kept_within(&self, edge: &Edge, x: f64) -> (f64, f64) {
        let (low, high) = edge.span_at(x).unwrap_or_default();
        ((high * self.model.omega_0).abs(), (low * self.model.omega_0).abs())
    }

    /// The fate of a motion that starts at displacement `x` (m) with velocity `v` (m/s): unknown where it leaves the law.
    ///
    /// # Errors
    /// [`Reason`] if it does not reach its next right turning point, or if a border cannot be traced to where it starts.
    pub fn fate(&self, x: f64, v: f64) -> Result<Fate> {
        self.fate_within(x, v, usize::MAX)
    }

    /// The same, if a motion that starts beyond [`Self::known`] is followed for so many half swings at `most`:
    /// [`Fate::Moving`] if it takes more.
    ///
    /// # Errors
    /// As for [`Self::fate`].
    pub fn fate_within(&self, x: f64, v: f64, most: usize) -> Result<Fate> {
        let y = v / self.model.omega_0;
        if y == 0.0 && self.model.rests_at(x) {
            return Ok(Fate::Rest);
        }
        if self.orders_starts() {
            let portrait = self.followed_to(x.abs())?;
            return Ok(portrait.fates[portrait.regions_at(x)(y)]);
        }
        match self.followed_fate(x, y, most) {
            Err(Reason::Settles) => Ok(Fate::Rest),
            Err(Reason::Escapes) => Ok(Fate::Escapes),
            Err(stop @ Reason::BeyondLaw { .. }) => Ok(Fate::Unknown(stop)),
            fate => fate,
        }
    }

    /// The fate of a start by its next right turning point. Fails with the [`Reason`] why it has none, of one that settles
    /// or escapes, too.
    fn followed_fate(&self, x: f64, y: f64, most: usize) -> Result<Fate> {
        let mut flow = Flow::new(&self.model);
        let mut half_swings = 0;
        let Some(mut x) = flow.to_the_right(x, y)? else { return Ok(Fate::Rest) };
        // Far out, every swing is checked: it may leave the known range.
        while x > self.known {
            half_swings += 2;
            if half_swings > most {
                return Ok(Fate::Moving);
            }
            let Some(image) = flow.returned(x)? else { return Ok(Fate::Rest) };
            if image.x >= x {
                break;
            }
            x = image.x;
        }
        Ok(self.fate_of_turn(x))
    }

    /// The cycle that a motion of this fate tends to, if it does.
    #[must_use]
    pub fn tends_to(&self, fate: Fate) -> Option<&Cycle> {
        match fate {
            Fate::Cycle(index) => self.cycles.get(index),
            _ => None,
        }
    }

    /// Whether a motion that starts at displacement `x` (m) with velocity `v` (m/s) begins within a cycle.
    #[must_use]
    pub fn starts_within(&self, cycle: &Cycle, x: f64, v: f64) -> bool {
        let y = v / self.model.omega_0;
        if self.orders_starts() {
            let index = self.cycles.iter().position(|own| own == cycle);
            let inner = self.borders.len() - self.cycles.len();
            return index.is_some_and(|index| self.regions_at(x)(y) <= inner + index);
        }
        let turn = Flow::new(&self.model).to_the_right(x, y);
        turn.is_ok_and(|turn| turn.is_none_or(|turn| turn < cycle.q_max))
    }

    /// Whether the borders alone say where a start ends: there is no belt, and what the guide holds at rest it holds of
    /// every motion that turns there.
    fn orders_starts(&self) -> bool {
        !self.fates.is_empty() && !self.model.holds_more_at_rest()
    }

    /// How many of the nested borders a start at a displacement lies outside of, by its velocity.
    fn regions_at(&self, x: f64) -> impl Fn(f64) -> usize {
        let spans: Vec<_> = self.borders.iter().map(|edge| edge.span_at(x)).collect();
        move |y| {
            let inside = |(low, high): (f64, f64)| y > low && y < high;
            let region = spans.iter().position(|span| span.is_some_and(inside));
            region.unwrap_or(spans.len())
        }
    }

    /// Why the portrait is incomplete: the friction law ends before all motions are known.
    #[must_use]
    pub fn incomplete(&self) -> Option<Reason> {
        let open = matches!(self.gaps.last(), Some(Gap { fate: Fate::Unknown(_), .. }));
        let stop = self.stop.filter(|stop| matches!(stop, Reason::BeyondLaw { .. }));
        let borderless = matches!(self.border, Border::None | Border::Unknown(_));
        stop.filter(|_| open || borderless)
    }

    /// The fate of a motion that turns on the right at `x`.
    fn fate_of_turn(&self, x: f64) -> Fate {
        if !self.fates.is_empty() {
            return self.fates[self.regions_at(x)(0.0)];
        }
        let gap = self.gaps.iter().find(|gap| x <= gap.to).or(self.gaps.last());
        gap.map_or(Fate::Rest, |gap| if x == gap.to { gap.end } else { gap.fate })
    }

    /// The area within [`Self::border`], in m^2/s; `None` where it is infinite, or where there is no basin.
    #[must_use]
    pub fn area(&self) -> Option<f64> {
        let edge = self.edge().filter(|_| self.has_basin())?;
        Some(edge.area()? * self.model.omega_0)
    }

    /// The radius, in m, of the largest circle about the origin that lies within [`Self::border`], velocities being
    /// divided by the natural frequency; `None` where there is none.
    #[must_use]
    pub fn inner_radius(&self) -> Option<f64> {
        self.edge()?.inner_radius()
    }

    /// The fraction of the area of the basin that this circle fills; `None` where the area is infinite.
    #[must_use]
    pub fn integrity(&self) -> Option<f64> {
        let (radius, area) = (self.inner_radius()?, self.area()? / self.model.omega_0);
        Some(std::f64::consts::PI * radius * radius / area)
    }

    /// A window, in m and m/s, half as large again as the largest cycle, or as the margin where there is none.
    #[must_use]
    pub fn surroundings(&self) -> StartWindow {
        const ROOM: f64 = 1.5;
        // A border that comes from infinity crosses an axis once.
        let far = |(low, high): (f64, f64)| {
            let ends = [low.abs(), high.abs()].into_iter();
            ends.filter(|end| end.is_finite()).fold(0.0, f64::max)
        };
        let size = |it: &Cycle| (far((it.q_min, it.q_max)), far((it.v_min, it.v_max)));
        let sizes = self.cycles.iter().map(size);
        let margin = self.reach.map(|reach| (far(reach.displacement), far(reach.velocity)));
        let held = self.model.guide_static.max(self.model.pull);
        let sizes = sizes.chain(margin).filter(|(x, v)| *x > 0.0 && *v > 0.0);
        let (x, v) = sizes
            .reduce(|one, other| (one.0.max(other.0), one.1.max(other.1)))
            .unwrap_or((held, held * self.model.omega_0));
        StartWindow { q: (-ROOM * x, ROOM * x), v: (-ROOM * v, ROOM * v) }
    }

    /// How many starts of a window end where, evenly spaced, including both of its ends.
    ///
    /// # Errors
    /// [`Reason::Interrupted`], asked for at each column, or why a border cannot be traced through the window.
    pub fn count(
        &self,
        window: &StartWindow,
        grid: (usize, usize),
        limits: &Limits,
    ) -> Result<Counts> {
        let counts = self.labelled(window, grid, limits, |labels| Counts::of(&labels))?;
        Ok(counts.into_iter().fold(Counts::default(), Counts::and))
    }

    /// What is made, at each displacement, of the labels of these starts: each an index of [`Counts::LABELS`].
    ///
    /// # Errors
    /// As for [`Self::count`].
    pub fn labelled<T: Send>(
        &self,
        window: &StartWindow,
        (columns, rows): (usize, usize),
        limits: &Limits,
        made: impl Fn(Vec<u8>) -> T + Sync,
    ) -> Result<Vec<T>> {
        let portrait = &*self.followed_to(window.reach())?;
        let velocities: Vec<f64> = evenly(window.v, rows).collect();
        let of_column = |x| {
            limits.go_on()?;
            let region = portrait.orders_starts().then(|| portrait.regions_at(x));
            let label = |v: &f64| {
                // Without friction the one point that rests counts as what is around it.
                let rests = *v == 0.0 && self.model.guide > 0.0 && self.model.rests_at(x);
                let fate = match &region {
                    Some(region) if !rests => Ok(portrait.fates[region(*v / self.model.omega_0)]),
                    _ => portrait.fate(x, *v),
                };
                Counts::label(fate.unwrap_or_else(Fate::Unknown))
            };
            Ok(made(velocities.iter().map(label).collect()))
        };
        let displacements: Vec<f64> = evenly(window.q, columns).collect();
        displacements.into_par_iter().map(of_column).collect()
    }

    /// The fraction of a window, in m and m/s, from which the mass comes to rest; `None` if motions from the window
    /// leave the known range.
    #[must_use]
    pub fn rest_share(&self, x: (f64, f64), v: (f64, f64)) -> Option<Share> {
        if !self.has_basin() {
            return Some(Share::exact(0.0));
        }
        let scaled = (v.0 / self.model.omega_0, v.1 / self.model.omega_0);
        let window = StartWindow { q: x, v: scaled };
        let Some(edge) = self.edge() else {
            // Above v = 0, motions do not cross, and those from the upper end of a vertical edge go farther out than
            // those from below. Along a horizontal edge, dv/dt changes sign once, because the spring is linear:
            // motions that rise through it fall through it farther right, so the outermost ones pass a corner. The
            // same holds below v = 0.
            let rests = |x: f64, v: f64| self.fate(x, v) == Ok(Fate::Rest);
            let all = || [x.0, x.1].iter().all(|x| [v.0, v.1].iter().all(|v| rests(*x, *v)));
            return (self.border == Border::None || all()).then(|| Share::exact(1.0));
        };
        let portrait = self.followed_to(window.reach()).ok()?;
        Some(part_within(portrait.edge().unwrap_or(edge), &window))
    }

    /// The same with a border that is not closed followed at least to this displacement, in m.
    ///
    /// # Errors
    /// [`Reason`] if it cannot be traced there.
    pub(super) fn followed_to(&self, reach: f64) -> Result<Cow<'_, Self>> {
        let open = |edge: &Edge| matches!(edge, Edge::Orbit(orbit) if !orbit.closed);
        let index = self.borders.iter().position(open).filter(|_| reach > self.followed);
        let (Some(index), Some(parameters)) = (index, self.model.parameters()) else {
            return Ok(Cow::Borrowed(self));
        };
        let farther = Orbit::separatrix(&parameters, reach, &Limits::PATIENT)?;
        let mut portrait = Portrait { followed: reach, ..self.clone() };
        portrait.borders[index] = Edge::Orbit(Box::new(farther));
        Ok(Cow::Owned(portrait))
    }
}

impl Flow<'_> {
    /// The next right turning point of any start; `None` if the mass comes to rest before it.
    ///
    /// # Errors
    /// [`Reason`] if it is not reached.
    pub fn to_the_right(&mut self, mut x: f64, mut y: f64) -> Result<Option<f64>> {
        if y == 0.0 && x > self.model.guide_static {
            return Ok(Some(x));
        }
        for _ in 0..2 {
            let place = self.model.place(x, y);
            let turn = self.turn(place, (x, y), &mut |_| {})?;
            if turn.rests {
                return Ok(None);
            }
            if place != ContactState::Slips(Phase::Below) {
                return Ok(Some(turn.x));
            }
            (x, y) = (turn.x, 0.0);
        }
        Ok(None)
    }
}
