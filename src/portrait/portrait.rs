//! The fate of every motion: the cycles, and the basin of rest with its border and margins.
//!
//! Fixed points and jumps of the return map cut the line of right turning points into gaps. Within a gap all
//! motions go one way, to the next cycle on that side. One evaluation in each gap therefore settles the fate of
//! all starts; a start itself is followed only to its next right turning point.

use rayon::prelude::*;

use super::return_map::gaps::{Divide, Gap, Tendency, gaps, jumps, ways};
use super::without_belt;
use super::{Border, Cycle, Cycles, Margin, Reach, RestMargin};
use crate::flow::machine::curve::{CurvePiece, MachineCurve};
use crate::flow::{Cost, Fate, Flow, Limits, Reason};
use crate::model::{ContactState, Model, Parameters, Phase, State};
use crate::numerics::root::bisect;
use crate::portrait::basin::cycle::cycles_and_closings;
use crate::portrait::basin::orbit::{POINTS, filled, inner_radius};
use crate::portrait::basin::stability::{Share, part_within};
use crate::portrait::basin::{Basin, Counts, StartWindow, between};
use crate::portrait::return_map::machine_return::Landmarks;
use crate::portrait::return_map::machine_return::MachineReturn;

/// The border of the basin of rest, as it was traced.
#[derive(Clone, Debug)]
enum Traced {
    Nothing,
    /// A closed curve.
    Curve(MachineCurve),
    /// The orbits around the sticking set of the paper's oscillator.
    Basin(Box<Basin>),
}

/// All possible motions of a machine.
#[derive(Clone, Debug)]
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
    gaps: Vec<Gap>,
    traced: Traced,
}

impl Portrait {
    /// The portrait of a machine: by half swings that close where there is no belt, else by the return map.
    ///
    /// # Errors
    /// [`Reason`] if the motions near rest, or those that the belt releases, cannot be followed.
    pub fn of(model: &Model) -> Result<Self, Reason> {
        match without_belt::orbits(model) {
            Some((cycles, basin)) => Ok(Portrait::within(model, &cycles, basin)),
            None => Portrait::by_return_map(model),
        }
    }

    /// The portrait of the oscillator of the paper, whose separatrix is followed as far as `reach`.
    ///
    /// # Errors
    /// [`Reason`] if the search for cycles fails, or a border cannot be traced.
    pub fn of_oscillator(
        parameters: &Parameters,
        reach: f64,
        limits: &Limits,
    ) -> Result<Self, Reason> {
        let Parameters { d, d2, d3, r } = *parameters;
        let model = Model::of_mode(1.0, 1.0, &[d, 0.5 * d2, 0.5 * d3], r, r)?;
        let (found, closings) = cycles_and_closings(parameters, limits)?;
        let basin = Basin::around(parameters, &closings, reach, limits)?;
        Ok(Portrait::within(&model, &found, basin))
    }

    /// The portrait of any machine by its return map.
    ///
    /// # Errors
    /// As for [`Self::of`].
    pub fn by_return_map(model: &Model) -> Result<Self, Reason> {
        let mut flow = Flow::new(model);
        let landmarks = flow.landmarks()?;
        let found = flow.fixed_points(landmarks.as_ref())?;
        let mut marks: Vec<(f64, Divide)> = found
            .points
            .iter()
            .enumerate()
            .map(|(index, (x, _))| (*x, Divide::Cycle(index)))
            .collect();
        marks.extend(jumps(model, landmarks.as_ref()).into_iter().map(|x| (x, Divide::Jump)));
        marks.extend(found.capture.map(|x| (x, Divide::Capture)));
        marks.sort_by(|one, other| one.0.total_cmp(&other.0));
        let ways = ways(&mut flow, &marks, found.end)?;
        let mut cycles = Vec::new();
        for (index, (x, image)) in found.points.iter().enumerate() {
            let place =
                marks.iter().position(|(_, mark)| matches!(mark, Divide::Cycle(i) if *i == index));
            let attracts = |place: usize| {
                ways[place] == Tendency::Outward && ways[place + 1] == Tendency::Inward
            };
            let stable = image.sticks_from.is_some() || place.is_some_and(attracts);
            cycles.push(flow.describe(*x, image, stable)?);
        }
        let mut portrait = Portrait {
            model: model.clone(),
            cycles,
            neutral: found.neutral,
            border: Border::None,
            reach: None,
            margin: Margin::ENDLESS,
            landmarks,
            stop: found.stop,
            known: found.end,
            unresolved: found.unresolved,
            cost: Cost::default(),
            gaps: gaps(&marks, &ways, found.stop),
            traced: Traced::Nothing,
        };
        portrait.settle_border(&mut flow, &marks)?;
        portrait.cost = flow.cost();
        Ok(portrait)
    }

    /// From the cycles of the oscillator that a model without a belt is, and the orbits that part its motions.
    fn within(model: &Model, found: &Cycles, basin: Basin) -> Self {
        let mut cost = found.cost;
        cost += basin.cost;
        let mut portrait = Portrait {
            model: model.clone(),
            cycles: found.cycles.iter().map(|cycle| cycle.scaled(1.0, model.omega_0)).collect(),
            neutral: false,
            border: without_belt::border(&basin),
            reach: without_belt::reach(&basin, model),
            margin: Margin::ENDLESS,
            landmarks: None,
            stop: None,
            known: f64::INFINITY,
            unresolved: Vec::new(),
            cost,
            gaps: Vec::new(),
            traced: Traced::Basin(Box::new(basin)),
        };
        portrait.margin = portrait.margin_within(model.guide_static, model.mass);
        portrait
    }

    fn settle_border(&mut self, flow: &mut Flow, marks: &[(f64, Divide)]) -> Result<(), Reason> {
        let Some(first) = self.gaps.first() else { return Ok(()) };
        let inner = if self.neutral { Fate::Neutral } else { Fate::Rest };
        if let Fate::Unknown(stop) = first.fate {
            return Err(stop);
        }
        let last = self.gaps.iter().take_while(|gap| gap.fate == inner).count();
        let divide = last.checked_sub(1).and_then(|last| marks.get(last));
        let landmarks = self.landmarks.as_ref();
        if last == 0 {
            self.border = Border::NoBasin;
            self.reach = Some(Reach::default());
        } else if let Some((x, mark)) = divide.filter(|_| last < self.gaps.len()) {
            let mut curve = MachineCurve::default();
            let left = match mark {
                Divide::Cycle(index) => {
                    self.border = Border::Cycle;
                    let cycle = &self.cycles[*index];
                    flow.around(*x, !cycle.sticks() && !cycle.overtakes, &mut curve)?
                }
                Divide::Jump => flow.jump_border(*x, landmarks, &mut curve)?,
                Divide::Capture => flow.capture_border(*x, landmarks, &mut curve)?,
            };
            if !matches!(mark, Divide::Cycle(_)) {
                let touches = |piece: &CurvePiece| matches!(piece, CurvePiece::Line { .. });
                let touches = curve.pieces.iter().any(touches);
                self.border = if touches { Border::Grazing } else { Border::Capture };
            }
            let velocity = velocities_lost(&self.model, &curve, 0.0);
            self.reach = Some(Reach { displacement: (*x, -left), velocity });
            self.traced = Traced::Curve(curve);
        } else if let Some(stop) = self.open_end() {
            self.border = Border::Unknown(stop);
            self.reach = Some(self.covered(0.0));
        }
        self.margin = self.margin_within(self.model.guide_static, self.model.mass);
        Ok(())
    }

    /// What hides a border farther out, where none was met.
    fn open_end(&self) -> Option<Reason> {
        let Model { omega_0, speed, .. } = self.model;
        let slip = (speed - self.model.least_velocity()) * omega_0;
        let ends = self.model.law_ends().then_some(Reason::BeyondLaw { slip });
        let hides = |stop: &Reason| !matches!(stop, Reason::Escapes | Reason::Settles);
        self.stop.filter(hides).or(ends)
    }

    /// The closed curve that borders the basin, if there is one.
    #[must_use]
    pub fn border_curve(&self) -> Option<&MachineCurve> {
        match &self.traced {
            Traced::Curve(curve) => Some(curve),
            Traced::Nothing | Traced::Basin(_) => None,
        }
    }

    /// The cycle that borders the basin of rest.
    #[must_use]
    pub fn bordering_cycle(&self) -> Option<&Cycle> {
        let x = self.reach.filter(|_| self.border == Border::Cycle)?.displacement.0;
        self.cycles.iter().find(|cycle| cycle.q_max == x)
    }

    /// The margin if the mass, of this size, may rest up to a `farthest` place on either side, in m.
    ///
    /// Above `v = 0` the border has no minimum of its speed between its ends, below it likewise
    /// ([`crate::portrait::basin`]), so over the places of rest it is lowest at one of the ends.
    #[must_use]
    pub fn margin_within(&self, farthest: f64, mass: f64) -> Margin {
        let Some(reach) = self.reach else { return Margin::ENDLESS };
        let ends = [farthest, -farthest];
        let (gap, [one, other]) = match &self.traced {
            Traced::Basin(basin) => {
                let speed = |speed: f64| mass * (speed * self.model.omega_0);
                return reach
                    .margin(mass, basin.margin_within(farthest).from_rest.map(|x| x, speed));
            }
            Traced::Curve(border) => {
                let least = reach.displacement.0.min(reach.displacement.1);
                let ends = ends.map(|x| velocities_lost(&self.model, border, x));
                ((least - farthest).max(0.0), ends)
            }
            Traced::Nothing if self.border == Border::NoBasin => return Margin::ZERO,
            Traced::Nothing => {
                let [right, left] = ends.map(|x| self.covered(x));
                (right.displacement.0.min(left.displacement.1), [right.velocity, left.velocity])
            }
        };
        let lowest = one.0.min(one.1).min(other.0).min(other.1);
        let impulse = if gap > 0.0 { mass * lowest } else { 0.0 };
        reach.margin(mass, RestMargin { displacement: Some(gap), impulse: Some(impulse) })
    }

    /// The kicks from rest at `from` that certainly come to rest, if motions that slip faster than the law covers are
    /// unknown, or some could not be followed. Motions do not cross, so in each direction these are all kicks up to a
    /// largest one. It is sought beyond [`Self::known`] only where the law ends.
    fn covered(&self, from: f64) -> Reach {
        /// Halvings down to rounding.
        const HALVINGS: u32 = 60;
        let model = &self.model;
        let most = |far: f64, start: &dyn Fn(f64) -> (f64, f64)| {
            let lost = |kick: f64| {
                let (x, y) = start(kick);
                self.fate(x, y * model.omega_0) != Ok(Fate::Rest)
            };
            if lost(far) { bisect(0.0, far, HALVINGS, lost).0 } else { far }
        };
        let (x, y) = if model.law_ends() {
            (4.0 * self.known, 4.0 * self.known.max(-model.least_velocity()))
        } else {
            (self.known, self.known)
        };
        let speed = |y: f64| y * model.omega_0;
        Reach {
            displacement: (
                most(self.known, &|kick| (from + kick, 0.0)),
                most(x, &|kick| (from - kick, 0.0)),
            ),
            velocity: (speed(most(y, &|kick| (from, kick))), speed(most(y, &|kick| (from, -kick)))),
        }
    }

    /// Between which velocities, in m/s, motions from a displacement (m) lie within the border of the basin.
    #[must_use]
    pub fn span_at(&self, x: f64) -> Option<(f64, f64)> {
        let (low, high) = self.span_within(x)?;
        Some((low * self.model.omega_0, high * self.model.omega_0))
    }

    /// The displacements, in m, at which the border of the basin may have a corner.
    #[must_use]
    pub fn corners(&self) -> Vec<f64> {
        match &self.traced {
            Traced::Curve(curve) => curve.ends(),
            Traced::Nothing | Traced::Basin(_) => Vec::new(),
        }
    }

    /// The same, divided by the natural frequency.
    fn span_within(&self, x: f64) -> Option<(f64, f64)> {
        match &self.traced {
            Traced::Nothing => None,
            Traced::Basin(basin) => basin.borders.first()?.span_at(x),
            Traced::Curve(curve) => {
                let (up, down) = curve.velocities_at(x, self.model.speed);
                // Next to a turning point only one of both may be met.
                Some((down.or(up.map(|_| 0.0))?, up.unwrap_or(0.0)))
            }
        }
    }

    /// The fate of a motion that starts at displacement `x` (m) with velocity `v` (m/s).
    ///
    /// # Errors
    /// [`Reason`] if it does not reach its next right turning point.
    pub fn fate(&self, x: f64, v: f64) -> Result<Fate, Reason> {
        let y = self.model.scaled_velocity(v);
        if self.model.place(x, y) == ContactState::Rests {
            return Ok(Fate::Rest);
        }
        if let Traced::Basin(basin) = &self.traced
            && !self.model.holds_more_at_rest()
        {
            return Ok(basin.fate(State { q: x, v: y }));
        }
        let mut flow = Flow::new(&self.model);
        let turn = match flow.to_the_right(x, y) {
            Ok(turn) => turn,
            Err(Reason::Settles) => return Ok(Fate::Rest),
            Err(Reason::Escapes) => return Ok(Fate::Escapes),
            Err(stop) => return Err(stop),
        };
        let Some(mut x) = turn else { return Ok(Fate::Rest) };
        // Far out, every swing is checked: it may leave the known range.
        while x > self.known {
            match flow.returned(x) {
                Ok(MachineReturn::Turns(image)) if image.x < x => x = image.x,
                Ok(MachineReturn::Turns(_)) => break,
                Ok(MachineReturn::Rests(_)) => return Ok(Fate::Rest),
                Err(Reason::Escapes) => return Ok(Fate::Escapes),
                Err(stop) => return Err(stop),
            }
        }
        Ok(self.fate_of_turn(x))
    }

    /// Why the portrait is incomplete: the friction law ends before all motions are known.
    #[must_use]
    pub fn incomplete(&self) -> Option<Reason> {
        let outermost = self.gaps.last().map(|gap| gap.fate);
        let open = matches!(outermost, Some(Fate::Unknown(_)));
        let stop = self.stop.filter(|stop| matches!(stop, Reason::BeyondLaw { .. }));
        let borderless = matches!(self.border, Border::None | Border::Unknown(_));
        stop.filter(|_| open || borderless)
    }

    /// The fate of a motion that turns on the right at `x`.
    fn fate_of_turn(&self, x: f64) -> Fate {
        if let Traced::Basin(basin) = &self.traced {
            return basin.fate(State { q: x, v: 0.0 });
        }
        let gap = self.gaps.iter().find(|gap| x <= gap.to).or(self.gaps.last());
        gap.map_or(Fate::Rest, |gap| if x == gap.to { gap.end } else { gap.fate })
    }

    /// The area within [`Self::border`], in m^2/s; `None` where it is infinite, or where there is no basin.
    #[must_use]
    pub fn area(&self) -> Option<f64> {
        let area = match &self.traced {
            Traced::Nothing => None,
            Traced::Basin(basin) => basin.area(),
            Traced::Curve(curve) => Some(curve.area(self.model.speed)),
        };
        area.map(|area| area * self.model.omega_0)
    }

    /// The radius, in m, of the largest circle about the origin that lies within [`Self::border`], velocities being
    /// divided by the natural frequency; `None` where there is none.
    #[must_use]
    pub fn inner_radius(&self) -> Option<f64> {
        match &self.traced {
            Traced::Nothing => None,
            Traced::Basin(basin) => basin.inner_radius(),
            Traced::Curve(curve) => {
                let points = curve.points(POINTS, self.model.speed);
                inner_radius(&points, &|x| self.span_within(x))
            }
        }
    }

    /// The fraction of the area of the basin that this circle fills; `None` where the area is infinite.
    #[must_use]
    pub fn integrity(&self) -> Option<f64> {
        Some(filled(self.inner_radius()?, self.area()? / self.model.omega_0))
    }

    /// A window, in m and m/s, half as large again as the largest cycle, or as the margin where there is none.
    #[must_use]
    pub fn surroundings(&self) -> StartWindow {
        const ROOM: f64 = 1.5;
        let far = |(low, high): (f64, f64)| low.abs().max(high.abs());
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

    /// Where the starts of a window end, evenly spaced, including both of its ends.
    #[must_use]
    pub fn count(&self, window: &StartWindow, (columns, rows): (usize, usize)) -> Counts {
        let of_row = |row| {
            let mut counts = Counts::default();
            for column in 0..columns {
                let x = between(window.q, column, columns);
                let fate = self.fate(x, between(window.v, row, rows));
                counts.add(fate.unwrap_or_else(Fate::Unknown), 1);
            }
            counts
        };
        (0..rows).into_par_iter().map(of_row).reduce(Counts::default, Counts::and)
    }

    /// The fraction of a window, in m and m/s, from which the mass comes to rest; `None` if motions from the window
    /// leave the known range.
    #[must_use]
    pub fn rest_share(&self, x: (f64, f64), v: (f64, f64)) -> Option<Share> {
        let window = StartWindow { q: x, v };
        match &self.traced {
            Traced::Basin(basin) => {
                let v = (self.model.scaled_velocity(v.0), self.model.scaled_velocity(v.1));
                without_belt::rest_share(basin, &StartWindow { v, ..window })
            }
            Traced::Curve(_) => Some(part_within(&|x| self.span_at(x), &self.corners(), &window)),
            Traced::Nothing if self.border == Border::NoBasin => Some(Share::exact(0.0)),
            // Above v = 0, motions do not cross, and those from the upper end of a vertical edge go farther out than
            // those from below. Along a horizontal edge, dv/dt changes sign once, because the spring is linear:
            // motions that rise through it fall through it farther right, so the outermost ones pass a corner. The
            // same holds below v = 0.
            Traced::Nothing => {
                let rests = |x: f64, v: f64| self.fate(x, v) == Ok(Fate::Rest);
                let all = || [x.0, x.1].iter().all(|x| [v.0, v.1].iter().all(|v| rests(*x, *v)));
                (self.border == Border::None || all()).then(|| Share::exact(1.0))
            }
        }
    }
}

/// The velocities with and against the belt, in m/s, at which a motion from rest at a displacement meets the border.
fn velocities_lost(model: &Model, border: &MachineCurve, x: f64) -> (f64, f64) {
    let (up, down) = border.velocities_at(x, model.speed);
    // A border that does not pass there begins at a node that repels, or the mass rests outside of it.
    let speed = |y: Option<f64>| y.map_or(0.0, |y| (y * model.omega_0).abs());
    (speed(up), speed(down))
}

impl Flow<'_> {
    /// The next right turning point of any start; `None` if the mass comes to rest before it.
    ///
    /// # Errors
    /// [`Reason`] if it is not reached.
    pub fn to_the_right(&mut self, mut x: f64, mut y: f64) -> Result<Option<f64>, Reason> {
        if y == 0.0 && x > self.model.guide_static {
            return Ok(Some(x));
        }
        for _ in 0..2 {
            let place = self.model.place(x, y);
            let turn = self.turn(place, (x, y), &mut ())?;
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
