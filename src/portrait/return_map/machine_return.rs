//! The return map: from a right turning point to the next one.
//!
//! It never decreases, because motions in the plane may merge but not cross. On one interval it is constant: all
//! motions that come to ride on the belt leave it at the same place. So at most one cycle sticks to the belt, and its
//! multiplier is exactly 0; the fixed points order everything else.

use crate::flow::{
    ArcEnd, Flow, Limits, MachineCurve, MachineStep, PhaseSeries, Reason, Result, Turn,
};
use crate::model::{ContactState, Lines, Phase};
use crate::numerics::ln;

/// The image of a right turning point.
#[derive(Clone, Copy, Debug)]
pub struct Image {
    /// The next right turning point.
    pub x: f64,
    /// The left turning point between them.
    pub left: f64,
    /// Logarithm of the derivative of the map; minus infinity if it is constant there.
    pub log_slope: f64,
    /// Displacement at which the mass began to ride on the belt.
    pub sticks_from: Option<f64>,
    /// Displacement at which it left the belt's line upwards.
    pub overtakes_from: Option<f64>,
}

impl Image {
    /// The image by a motion that only slips.
    fn slipping(x: f64, left: f64, log_slope: f64) -> Self {
        Image { x, left, log_slope, sticks_from: None, overtakes_from: None }
    }

    /// Whether the motion only slips, below the speed of the belt.
    pub fn slips(&self) -> bool {
        self.sticks_from.is_none() && self.overtakes_from.is_none()
    }
}

/// The places at which the return map changes its form.
#[derive(Clone, Copy, Debug)]
pub struct Landmarks {
    /// The places on the belt's line.
    pub lines: Lines,
    /// Right turning point of the orbit that touches the line; `None` if no motion comes from one.
    pub touch: Option<f64>,
    /// The image by that orbit, as if it continued to slip; the derivative is that from below.
    pub grazing: Image,
    /// Right turning point after a release from the belt; `None` if the mass then comes to rest at once.
    pub released: Option<f64>,
    /// Left turning point from which the lower end of the stick band is reached.
    pub low_left: f64,
    /// Right turning point beyond which motions overtake the belt instead of ending on the band; `None` if all
    /// end on it.
    pub beyond: Option<f64>,
}

impl Flow<'_> {
    /// The next right turning point after the one at `x`, outside of what the guide holds; `None` if the mass comes
    /// to rest before.
    ///
    /// # Errors
    /// [`Reason`] if the motion does not turn.
    pub fn returned(&mut self, x: f64) -> Result<Option<Image>> {
        let mut divergence = 0.0;
        let mut add = |series: &PhaseSeries| divergence += series.divergence();
        let [below, between] = [Phase::Below, Phase::Between].map(ContactState::Slips);
        let Some(left) = self.next_turn(below, (x, 0.0), &mut add)? else { return Ok(None) };
        let right = self.next_turn(between, (left.x, 0.0), &mut add)?;
        Ok(right.map(|right| Image {
            x: right.x,
            left: left.x,
            log_slope: left.log_ratio + right.log_ratio + divergence,
            sticks_from: right.sticks_from,
            overtakes_from: right.overtakes_from,
        }))
    }

    /// The next turning point of a motion, if it moves on from there: one that settles at an equilibrium comes to rest,
    /// too. Fails with [`Reason`] if it does not turn.
    fn next_turn(
        &mut self,
        place: ContactState,
        start: (f64, f64),
        watch: &mut impl FnMut(&PhaseSeries),
    ) -> Result<Option<Turn>> {
        match self.turn(place, start, watch) {
            Err(Reason::Settles) => Ok(None),
            turn => turn.map(|turn| Some(turn).filter(|turn| !turn.rests)),
        }
    }

    /// The next right turning point after the one at `x`, or where the mass comes to rest before; `None` where it escapes, or
    /// its law ends.
    pub fn next_right(&mut self, x: f64) -> Option<f64> {
        match self.returned(x) {
            Ok(Some(image)) => Some(image.x),
            Ok(None) => self.rest_of(x, 0.0, &Limits::PATIENT).ok(),
            Err(_) => None,
        }
    }

    /// An arc below the belt's line that may settle: it then ends at the equilibrium of its phase, where nothing
    /// accelerates it. Backward between rest and the belt's speed, it ends at the left turning point from which a motion
    /// comes; where there is none, at the edge of what the guide holds. Fails with [`Reason`] as [`Flow::arc`].
    fn settling_arc(
        &mut self,
        phase: Phase,
        start: (f64, f64),
        backward: bool,
        watch: &mut impl FnMut(&PhaseSeries),
    ) -> Result<ArcEnd> {
        let x = -self.model.offset(phase);
        match self.arc(phase, start, backward, watch) {
            Err(Reason::Settles) => Ok(ArcEnd { x, y: 0.0, log_ratio: f64::NEG_INFINITY }),
            end => end,
        }
    }

    /// The arc from the right turning point before the left one at `left`, followed back to it; `None` if no motion
    /// comes from one. Fails with [`Reason`] where the friction law ends or the steps run out.
    pub(crate) fn right_before(
        &mut self,
        left: f64,
        watch: &mut impl FnMut(&PhaseSeries),
    ) -> Result<Option<ArcEnd>> {
        let left = left.min(-self.model.guide_static);
        match self.settling_arc(Phase::Below, (left, 0.0), true, watch) {
            Err(Reason::Escapes) => Ok(None),
            end => end.map(Some),
        }
    }

    /// The inverse map at the right turning point `x`, for motions that always slip below the belt's speed:
    /// [`Image::x`] is the turning point before. It contracts where the map itself expands. `None` if no such motion
    /// leads to `x`.
    ///
    /// # Errors
    /// [`Reason`] where the friction law ends or the steps run out.
    pub fn preimage(&mut self, x: f64) -> Result<Option<Image>> {
        let mut divergence = 0.0;
        let mut add = |series: &PhaseSeries| divergence += series.divergence();
        let end = match self.settling_arc(Phase::Between, (x, 0.0), true, &mut add) {
            Ok(end) if end.is_on_belt() => return Ok(None),
            // Backward in time, damping adds energy: however far away it comes from, a motion turns before `x`.
            Err(Reason::Escapes) => return Ok(None),
            end => end?,
        };
        let before = self.right_before(end.x, &mut add)?;
        Ok(before.map(|before| {
            let log_slope = divergence - end.log_ratio - before.log_ratio;
            Image::slipping(before.x, end.x, log_slope)
        }))
    }

    // The special motions at the belt's line: those that touch it, are released by it, or overtake it.

    /// The landmarks; `None` without a belt, or without a law for small slips.
    ///
    /// # Errors
    /// [`Reason`] if the friction law ends before they are reached.
    pub fn landmarks(&mut self) -> Result<Option<Landmarks>> {
        let model = self.model;
        let Some(lines) = model.lines else { return Ok(None) };
        let (touch, grazing) = self.grazing(&lines)?;
        let start = (lines.release, model.speed);
        let released = self.next_turn(ContactState::Sticks, start, &mut |_| {})?;
        let released = released.map(|turn| turn.x);
        let low_left =
            self.settling_arc(Phase::Between, (lines.low, model.speed), true, &mut |_| {})?.x;
        let beyond = self.beyond(&lines, low_left)?;
        Ok(Some(Landmarks { lines, touch, grazing, released, low_left, beyond }))
    }

    /// The right turning point of the orbit that touches the line, and its image.
    fn grazing(&mut self, lines: &Lines) -> Result<(Option<f64>, Image)> {
        let (guide, start) = (self.model.guide, (lines.fold, self.model.speed));
        let mut divergence = 0.0;
        let mut add = |series: &PhaseSeries| divergence += series.divergence();
        let left = self.settling_arc(Phase::Between, start, true, &mut add)?.x;
        // If overdamped, it comes to rest without another turn.
        let after = self.settling_arc(Phase::Between, start, false, &mut add)?.x;
        let left = left.min(-self.model.guide_static);
        let before = match self.right_before(left, &mut add) {
            Err(Reason::BeyondLaw { .. }) => None,
            before => before?,
        };
        let ratio = before.map_or(0.0, |before| before.log_ratio);
        let between = (left + guide) / (after + guide);
        let turns = after > -guide;
        let log_slope = divergence - ratio + ln(between.abs());
        let log_slope = if turns { log_slope } else { f64::NEG_INFINITY };
        Ok((before.map(|before| before.x), Image::slipping(after, left, log_slope)))
    }

    /// The right turning point beyond which motions overtake the belt instead of riding on it.
    fn beyond(&mut self, lines: &Lines, low_left: f64) -> Result<Option<f64>> {
        let speed = self.model.speed;
        // The last motion that comes down on the band is followed back to where it rose above the line.
        let rose = self.arc(Phase::Above, (lines.release, speed), true, &mut |_| {});
        let Some(rose) = if_any(rose)? else { return Ok(None) };
        let mut left = low_left;
        if rose.x < lines.low {
            let start = (rose.x, speed);
            left = self.settling_arc(Phase::Between, start, true, &mut |_| {})?.x;
        }
        let right = if_any(self.right_before(left, &mut |_| {}))?.flatten();
        Ok(right.map(|right| right.x))
    }

    // The border of the basin of rest where it is not a cycle: followed backward in time from where the return map
    // jumps.

    /// The closed border through the right turning point `x`, backward in time, and its left turning point.
    ///
    /// Where the return map `jumps`, it leads from the belt's line to the line again, with the piece of line between.
    /// Else `x` is where the guide catches the mass up to: the border is the motion that comes there, and below it the one
    /// that comes to the left end of what is caught; so it is, too, where static friction holds what an orbit through a
    /// jump comes from, so that its way to the line is not on the border.
    pub(crate) fn border(
        &mut self,
        x: f64,
        jumps: bool,
        landmarks: Option<Landmarks>,
    ) -> Result<(MachineCurve, f64)> {
        let speed = self.model.speed;
        let mut curve = MachineCurve::default();
        let mut end = self.settling_arc(Phase::Between, (x, 0.0), true, &mut curve.keeper())?;
        let (mut left, mut before) = (end.x, 0);
        if let Some(Landmarks { lines, touch, .. }) = landmarks.filter(|_| end.is_on_belt()) {
            if jumps && end.x > lines.release {
                end = self.arc(Phase::Above, (end.x, speed), true, &mut curve.keeper())?;
            }
            let touches = !jumps || Some(x) == touch;
            let corner = if touches { lines.fold } else { lines.low };
            curve.steps.push(MachineStep::ride(corner, end.x, speed));
            before = if jumps { curve.steps.len() } else { 0 };
            let start = (corner, speed);
            left = self.settling_arc(Phase::Between, start, true, &mut curve.keeper())?.x;
        }
        left = left.min(-self.model.guide_static);
        self.settling_arc(Phase::Below, (left, 0.0), true, &mut curve.keeper())?;
        // A border through a jump begins where it leaves the line.
        curve.steps.rotate_left(before);
        Ok((curve, left))
    }
}

/// Where a motion comes from; `None` if it comes from nowhere that the law knows.
fn if_any<T>(found: Result<T>) -> Result<Option<T>> {
    match found {
        Err(Reason::Escapes | Reason::Settles | Reason::BeyondLaw { .. }) => Ok(None),
        found => found.map(Some),
    }
}
