//! The fate of every motion: the cycles, and the basin of rest with its border and margins.
//!
//! Fixed points and jumps of the return map cut the line of right turning points into gaps. Within a gap all
//! motions go one way, to the next cycle on that side. One evaluation in each gap therefore settles the fate of
//! all starts; a start itself is followed only to its next right turning point.

use serde::Serialize;

use super::arc::{Flow, LostMotion};
use super::curve::{CurvePiece, MachineCurve, Rectangle};
use super::cycles::MachineCycle;
use super::gaps::{Divide, Gap, Tendency, gaps, jumps, ways};
use super::landmarks::Landmarks;
use super::margin::MachineMargin;
use super::model::{Model, Phase};
use super::return_map::MachineReturn;
use super::separatrix;
use super::turn::ContactState;
use crate::flow::Fate;
use crate::numerics::root::bisect;
use crate::study::basin::{Basin, Window};
use crate::study::margin::Margin;

/// What borders the basin of rest.
#[derive(Clone, Debug)]
pub enum MachineBorder {
    /// The unstable cycle with this index.
    Cycle(usize, MachineCurve),
    /// An orbit that touches the belt's line, with a piece of that line; or one that just reaches the end of
    /// what the guide holds.
    Grazing(MachineCurve),
    /// A motion that just escapes.
    Separatrix(Box<Basin>),
    /// Nothing: everything comes to rest.
    None,
    /// Rest itself repels.
    NoBasin,
}

/// The kind of a [`MachineBorder`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum BorderKind {
    /// An unstable cycle.
    Cycle,
    /// An orbit that touches the belt's line or the end of what the guide holds.
    Grazing,
    /// A motion that just escapes.
    Separatrix,
    /// Everything comes to rest.
    None,
    /// Rest repels.
    NoBasin,
}

impl MachineBorder {
    /// Its kind.
    #[must_use]
    pub fn kind(&self) -> BorderKind {
        match self {
            MachineBorder::Cycle(..) => BorderKind::Cycle,
            MachineBorder::Grazing(_) => BorderKind::Grazing,
            MachineBorder::Separatrix(_) => BorderKind::Separatrix,
            MachineBorder::None => BorderKind::None,
            MachineBorder::NoBasin => BorderKind::NoBasin,
        }
    }

    /// Whether the border touches the belt's line; otherwise a cycle or the end of what the guide holds borders
    /// the basin.
    #[must_use]
    pub fn touches(&self) -> bool {
        let line = |piece: &CurvePiece| matches!(piece, CurvePiece::Line { .. });
        matches!(self, MachineBorder::Grazing(curve) if curve.pieces.iter().any(line))
    }

    /// The closed curve, if there is one.
    #[must_use]
    pub fn curve(&self) -> Option<&MachineCurve> {
        match self {
            MachineBorder::Cycle(_, curve) | MachineBorder::Grazing(curve) => Some(curve),
            MachineBorder::Separatrix(_) | MachineBorder::None | MachineBorder::NoBasin => None,
        }
    }
}

/// All possible motions of a machine.
#[derive(Clone, Debug)]
pub struct Portrait {
    /// Its model.
    pub model: Model,
    /// The cycles, by amplitude.
    pub cycles: Vec<MachineCycle>,
    /// Whether there is a family of periodic orbits.
    pub neutral: bool,
    /// The border of the basin of rest; of the neutral family, if rest belongs to one.
    pub border: MachineBorder,
    /// The kicks that are survived; `None` if every kick is. If all motions that the law covers come to rest,
    /// these are the kicks that it covers.
    pub margin: Option<MachineMargin>,
    /// Where the line of the belt is met.
    pub landmarks: Option<Landmarks>,
    /// Why motions that turn beyond [`Self::known`] are unknown; `None` if all are known.
    pub stop: Option<LostMotion>,
    /// Right turning point up to which the return map was evaluated.
    pub known: f64,
    /// Intervals of right turning points in which the search for cycles did not settle: pairs of cycles may
    /// hide there.
    pub unresolved: Vec<(f64, f64)>,
    /// Number of integration steps.
    pub steps: u64,
    gaps: Vec<Gap>,
}

impl Portrait {
    /// Computes the portrait of a machine.
    ///
    /// # Errors
    /// [`LostMotion`] if the motions near rest, or those that the belt releases, cannot be followed.
    pub fn new(model: &Model) -> Result<Self, LostMotion> {
        let basin = separatrix::basin_beside(model);
        if let Some(found) = basin.and_then(|basin| Portrait::beside_separatrix(model, basin)) {
            return Ok(found);
        }
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
            border: MachineBorder::None,
            margin: None,
            landmarks,
            stop: found.stop,
            known: found.end,
            unresolved: found.unresolved,
            steps: 0,
            gaps: gaps(&marks, &ways, found.stop),
        };
        portrait.settle_border(&mut flow, &marks)?;
        portrait.steps = flow.steps;
        Ok(portrait)
    }

    /// The portrait of a machine without cycles whose basin of rest a separatrix borders.
    fn beside_separatrix(model: &Model, basin: Basin) -> Option<Self> {
        let margin = separatrix::margin(&basin, model, model.guide_static)?;
        let escapes = Gap { to: f64::INFINITY, fate: Fate::Escapes, end: Fate::Escapes };
        let rests = Gap { to: margin.displacement.0, fate: Fate::Rest, ..escapes };
        Some(Portrait {
            model: model.clone(),
            cycles: Vec::new(),
            neutral: false,
            steps: basin.cost.steps,
            border: MachineBorder::Separatrix(Box::new(basin)),
            margin: Some(margin),
            landmarks: None,
            stop: None,
            known: f64::INFINITY,
            unresolved: Vec::new(),
            gaps: vec![rests, escapes],
        })
    }

    fn settle_border(
        &mut self,
        flow: &mut Flow,
        marks: &[(f64, Divide)],
    ) -> Result<(), LostMotion> {
        let model = &self.model;
        let Some(first) = self.gaps.first() else { return Ok(()) };
        let inner = if self.neutral { Fate::Neutral } else { Fate::Rest };
        if let Fate::Unknown(stop) = first.fate {
            return Err(stop);
        }
        if first.fate != inner {
            self.border = MachineBorder::NoBasin;
            self.margin = Some(MachineMargin::ZERO);
            return Ok(());
        }
        let last = self.gaps.iter().take_while(|gap| gap.fate == inner).count();
        let Some((x, mark)) = marks.get(last - 1).filter(|_| last < self.gaps.len()) else {
            let stops =
                matches!(self.stop, Some(LostMotion::OutsideLaw { .. } | LostMotion::Steps));
            if stops || model.law_ends() {
                self.margin = Some(self.covered(model.guide_static));
            }
            return Ok(());
        };
        let mut curve = MachineCurve::default();
        let left = match mark {
            Divide::Cycle(index) => {
                let cycle = &self.cycles[*index];
                let left = flow.around(*x, !cycle.sticks && !cycle.overtakes, &mut curve)?;
                self.border = MachineBorder::Cycle(*index, curve.clone());
                left
            }
            Divide::Jump => {
                let left = flow.jump_border(*x, self.landmarks.as_ref(), &mut curve)?;
                self.border = MachineBorder::Grazing(curve.clone());
                left
            }
            Divide::Capture => {
                let left = flow.capture_border(*x, self.landmarks.as_ref(), &mut curve)?;
                self.border = MachineBorder::Grazing(curve.clone());
                left
            }
        };
        let mut margin = MachineMargin { displacement: (*x, -left), ..MachineMargin::ZERO };
        margin.velocity = self.velocities_lost(&curve, 0.0);
        self.margin = Some(margin);
        self.margin = self.margin_within(model.guide_static);
        Ok(())
    }

    /// The smallest kicks that are not survived, in m and N s.
    #[must_use]
    pub fn least_kicks(&self) -> Margin {
        self.margin.map_or(Margin::ENDLESS, |margin| margin.least(self.model.mass))
    }

    /// The velocities with and against the belt, in m/s, at which a motion from rest at a displacement meets the
    /// border.
    fn velocities_lost(&self, border: &MachineCurve, x: f64) -> (f64, f64) {
        let (up, down) = border.velocities_at(x, self.model.speed);
        // A border that does not pass there begins at a node that repels, or the mass rests outside of it.
        let speed = |y: Option<f64>| y.map_or(0.0, |y| (y * self.model.omega_0).abs());
        (speed(up), speed(down))
    }

    /// The margin if the mass may rest up to a `farthest` place on either side, in m.
    ///
    /// Above `v = 0` the border has no minimum of its speed between its ends, below it likewise
    /// ([`crate::study::margin`]), so over the places of rest it is lowest at one of the ends.
    #[must_use]
    pub fn margin_within(&self, farthest: f64) -> Option<MachineMargin> {
        let margin = self.margin?;
        let border = match &self.border {
            MachineBorder::Cycle(_, curve) | MachineBorder::Grazing(curve) => curve,
            MachineBorder::NoBasin => return Some(margin),
            MachineBorder::Separatrix(basin) => {
                return separatrix::margin(basin, &self.model, farthest);
            }
            MachineBorder::None => return Some(self.covered(farthest)),
        };
        let gap = (margin.least_displacement() - farthest).max(0.0);
        let ends = [farthest, -farthest].map(|x| self.velocities_lost(border, x));
        let lowest = ends.iter().map(|(up, down)| up.min(*down)).fold(f64::INFINITY, f64::min);
        Some(MachineMargin {
            rest_displacement: gap,
            rest_velocity: if gap > 0.0 { lowest } else { 0.0 },
            ..margin
        })
    }

    /// The kicks that certainly come to rest, if motions that slip faster than the law covers are unknown, or some
    /// could not be followed; `farthest` as for [`Self::margin_within`]. Motions do not cross, so in each direction
    /// these are all kicks up to a largest one. It is sought beyond [`Self::known`] only where the law ends.
    fn covered(&self, farthest: f64) -> MachineMargin {
        /// Halvings down to rounding.
        const HALVINGS: u32 = 60;
        let model = &self.model;
        let rests = |x: f64, y: f64| self.fate(x, y * model.omega_0) == Ok(Fate::Rest);
        let most = |far: f64, rests: &dyn Fn(f64) -> bool| {
            if rests(far) { far } else { bisect(0.0, far, HALVINGS, |kick| !rests(kick)).0 }
        };
        let (x, y) = if model.law_ends() {
            (4.0 * self.known, 4.0 * self.known.max(-model.least_velocity()))
        } else {
            (self.known, self.known)
        };
        let shifts = |from: f64| {
            let right = most(self.known, &|kick| rests(from + kick, 0.0));
            (right, most(x, &|kick| rests(-from - kick, 0.0)))
        };
        let pushes = |from: f64| {
            let with = most(y, &|kick| rests(from, kick)) * model.omega_0;
            (with, most(y, &|kick| rests(from, -kick)) * model.omega_0)
        };
        let [(right, left), (one, other), (third, last)] =
            [shifts(farthest), pushes(farthest), pushes(-farthest)];
        MachineMargin {
            displacement: shifts(0.0),
            velocity: pushes(0.0),
            rest_displacement: right.min(left),
            rest_velocity: one.min(other).min(third).min(last),
        }
    }

    /// The fate of a motion that starts at displacement `x` (m) with velocity `v` (m/s).
    ///
    /// # Errors
    /// [`LostMotion`] if it does not reach its next right turning point.
    pub fn fate(&self, x: f64, v: f64) -> Result<Fate<LostMotion>, LostMotion> {
        let y = self.model.scaled_velocity(v);
        let mut flow = Flow::new(&self.model);
        let turn = match flow.to_the_right(x, y) {
            Ok(turn) => turn,
            Err(LostMotion::Settled) => return Ok(Fate::Rest),
            Err(LostMotion::Escaped) => return Ok(Fate::Escapes),
            Err(stop) => return Err(stop),
        };
        let Some(mut x) = turn else { return Ok(Fate::Rest) };
        // Far out, every swing is checked: it may leave the known range.
        while x > self.known {
            match flow.returned(x) {
                Ok(MachineReturn::Turns(image)) if image.x < x => x = image.x,
                Ok(MachineReturn::Turns(_)) => break,
                Ok(MachineReturn::Rests(_)) => return Ok(Fate::Rest),
                Err(LostMotion::Escaped) => return Ok(Fate::Escapes),
                Err(stop) => return Err(stop),
            }
        }
        Ok(self.fate_of_turn(x))
    }

    /// Why the portrait is incomplete: the friction law ends before all motions are known.
    #[must_use]
    pub fn incomplete(&self) -> Option<LostMotion> {
        let outermost = self.gaps.last().map(|gap| gap.fate);
        let open = matches!(outermost, Some(Fate::Unknown(_)));
        let stop = self.stop.filter(|stop| matches!(stop, LostMotion::OutsideLaw { .. }));
        stop.filter(|_| open || matches!(self.border, MachineBorder::None))
    }

    /// The fate of a motion that turns on the right at `x`.
    fn fate_of_turn(&self, x: f64) -> Fate<LostMotion> {
        let gap = self.gaps.iter().find(|gap| x <= gap.to).or(self.gaps.last());
        gap.map_or(Fate::Rest, |gap| if x == gap.to { gap.end } else { gap.fate })
    }

    /// The fraction of a window, in m and m/s, from which the mass comes to rest; `None` if motions from the window
    /// leave the known range.
    #[must_use]
    pub fn rest_share(&self, x: (f64, f64), v: (f64, f64)) -> Option<f64> {
        let y = (self.model.scaled_velocity(v.0), self.model.scaled_velocity(v.1));
        let window = Rectangle { x, y };
        match &self.border {
            // Above v = 0, motions do not cross, and those from the upper end of a vertical edge go farther out than
            // those from below. Along a horizontal edge, dv/dt changes sign once, because the spring is linear:
            // motions that rise through it fall through it farther right, so the outermost ones pass a corner. The
            // same holds below v = 0.
            MachineBorder::None => {
                let rests = |x: f64, v: f64| self.fate(x, v) == Ok(Fate::Rest);
                let all = || [x.0, x.1].iter().all(|x| [v.0, v.1].iter().all(|v| rests(*x, *v)));
                (self.margin.is_none() || all()).then_some(1.0)
            }
            MachineBorder::NoBasin => Some(0.0),
            MachineBorder::Separatrix(basin) => {
                separatrix::rest_share(basin, &Window { q: window.x, v: window.y })
            }
            MachineBorder::Cycle(_, curve) | MachineBorder::Grazing(curve) => {
                Some(curve.area_within(&window, self.model.speed) / window.area())
            }
        }
    }
}

impl Flow<'_> {
    /// The next right turning point of any start; `None` if the mass comes to rest before it.
    ///
    /// # Errors
    /// [`LostMotion`] if it is not reached.
    pub fn to_the_right(&mut self, mut x: f64, mut y: f64) -> Result<Option<f64>, LostMotion> {
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

impl Model {
    /// A velocity in m/s divided by the natural frequency; for that of the belt, exactly the speed of the model.
    #[must_use]
    pub fn scaled_velocity(&self, v: f64) -> f64 {
        v / self.omega_0
    }
}
