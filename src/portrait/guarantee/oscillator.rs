//! How large a kick is survived for certain: whatever a bounded disturbance does, at whatever parameters of a box.
//!
//! `q'' + 2 D q' + D2 q'^2 + D3 q'^3 + q = friction + u(tau)` with `abs(u) <= w`. Above `v = 0` the acceleration
//! of every such system is at most that of the *worst* one, which has the smallest D, D2, D3 and the friction
//! `r - w`; below it is at least that of the same system with the largest D2. So at every point of the worst
//! system's border the true field points inwards, or along it, and no motion leaves its interior. The bound is
//! attained: the disturbance `w sign(v)` at the worst parameters keeps to the border. In the same way no motion
//! enters the basin of the *best* system from outside.
//!
//! An extreme system has a D2 of its own on each side, so it is a [`TwoSidedOscillator`]; half maps and arcs are
//! computed side by side anyway.

use crate::flow::{Fate, Limits, Reason, Result};
use crate::model::{HalfPlane, Model, ParameterBox, Parameters, Side};
use crate::numerics::Interval;
use crate::portrait::{
    Border, Equation, Guarantee, Margin, NoGuarantee, Orbit, Portrait, RestMargin, STEP, SwingPair,
    centre_fate, has_cycle, innermost_bracket, polish,
};

/// An oscillator with parameters of its own on each side of `v = 0`, the friction being the same.
pub struct TwoSidedOscillator {
    /// Where `v > 0`.
    pub upper: Parameters,
    /// Where `v < 0`.
    pub lower: Parameters,
}

impl TwoSidedOscillator {
    /// The system that keeps the smallest basin, for disturbances up to `disturbance`, which is less than the
    /// friction.
    pub fn worst(known: &ParameterBox, disturbance: f64) -> Self {
        let mut upper = known.map(Interval::lower);
        if disturbance > 0.0 {
            upper.r = (upper.r - disturbance).next_down();
        }
        TwoSidedOscillator { upper, lower: Parameters { d2: known.d2.upper(), ..upper } }
    }

    /// The system that keeps the largest basin.
    pub fn best(known: &ParameterBox, disturbance: f64) -> Self {
        let mut upper = known.map(Interval::upper);
        if disturbance > 0.0 {
            upper.r = (upper.r + disturbance).next_up();
        }
        TwoSidedOscillator { upper, lower: Parameters { d2: known.d2.lower(), ..upper } }
    }

    fn on(&self, side: Side) -> &Parameters {
        if side == Side::Upper {
            &self.upper
        } else {
            &self.lower
        }
    }

    fn field(&self, side: Side) -> HalfPlane {
        HalfPlane::new(self.on(side), side)
    }

    /// What its innermost border parts, for `D > -1`; `reach` as for [`Portrait::of_oscillator`]. The second number
    /// bounds the relative error of the border's clearance.
    ///
    /// # Errors
    /// The [`Reason`] why the border could not be computed; [`Reason::NotApplicable`] for `D <= -1`.
    pub fn portrait(&self, reach: f64, limits: &Limits) -> Result<(Portrait, f64)> {
        if self.upper.d <= -1.0 {
            return Err(Reason::NotApplicable { needs: "D above -1" });
        }
        let mut equation = self.equation(limits);
        let (first, second) = (equation.side, equation.side.opposite());
        let own = [self.on(first), self.on(second)];
        let (border, orbits, error) = if let Some((closing, error)) = self.closing(&mut equation)? {
            let orbit = Orbit::of_closing(own, first, &closing, true, limits)?;
            (Border::Cycle, vec![orbit], error)
        } else if self.upper.d3 == 0.0 && self.field(second).d2 < 0.0 {
            let orbit = Orbit::from_infinity(own, first, reach, limits)?;
            (Border::Separatrix, vec![orbit], NOISE)
        } else {
            (Border::None, Vec::new(), 0.0)
        };
        let mut fates = vec![centre_fate(&self.upper)];
        fates.extend(orbits.iter().map(|_| Fate::Escapes));
        let model = Model::of_paper(&self.upper)?;
        let blank = Portrait { border, fates, cost: equation.cost(), ..Portrait::blank(&model) };
        Ok((blank.parted(orbits), error))
    }

    /// The innermost closed pair of swings, and the relative error of its clearances: from the closed form where
    /// there is one, else where the search closes.
    fn closing(&self, equation: &mut Equation) -> Result<Option<(SwingPair, f64)>> {
        if self.upper == self.lower && self.upper.is_piecewise_linear() {
            return Ok(SwingPair::linear(&self.upper).map(|closing| (closing, NOISE)));
        }
        let Some(bracket) = innermost_bracket(equation)? else {
            return if has_cycle(&self.upper) {
                Err(Reason::OutOfRange)
            } else {
                Ok(None)
            };
        };
        equation.want_fastest();
        let closing = polish(equation, bracket)?;
        let error = closing.uncertainty + NOISE / closing.node.slope.abs().min(1.0);
        Ok(Some((closing, error)))
    }

    /// The closing equation, and with it the side of its first swing: that on which D2 brakes more, because a
    /// swing of the other one, run backward, does not escape.
    fn equation<'a>(&self, limits: &Limits<'a>) -> Equation<'a> {
        let brakes = self.upper.d2 >= -self.lower.d2;
        let first = if brakes { Side::Upper } else { Side::Lower };
        let fields = [first, first.opposite()].map(|side| self.field(side));
        // How far out a search goes follows from the weaker D2.
        let weaker = fields[0].d2.abs().min(fields[1].d2.abs());
        let parameters = Parameters { d2: weaker, ..self.upper };
        Equation::on_fields(&parameters, first, fields, STEP, limits)
    }
}

/// Relative error of a clearance, of rounding and of steps, where the closing equation is not flat.
const NOISE: f64 = 1e-12;

/// The worst system, inside whose first border every motion stays for all parameters of a box and all
/// disturbances up to `disturbance`, and the margin that holds for certain, or why nothing is certain; `reach` as for
/// [`Portrait::of_oscillator`].
///
/// Guarantee: see the module; the margin is rounded down by its error, which is estimated, not enclosed.
///
/// # Errors
/// The [`Reason`] why the border could not be computed.
pub fn guaranteed(
    known: &ParameterBox,
    disturbance: f64,
    reach: f64,
    limits: &Limits,
) -> Result<Guarantee> {
    let (d, friction) = (known.d.lower(), known.r.lower());
    let worst = TwoSidedOscillator::worst(known, disturbance);
    if disturbance > 0.0 && worst.upper.r <= 0.0 {
        return Ok(Err(NoGuarantee::Disturbance { disturbance, friction, unit: "" }));
    }
    if d <= -1.0 {
        return Ok(Err(NoGuarantee::Repels { d }));
    }
    let (worst, error) = worst.portrait(reach, limits)?;
    if error > 0.5 {
        return Err(Reason::NoConvergence {
            sought: "the border of the worst system",
            change: error,
        });
    }
    // How far out the mass may rest before the kick: at the smallest friction, because the gap to the border only grows
    // with it, and on the side to which the disturbance pushes.
    let pushed = if disturbance > 0.0 {
        (friction + disturbance).next_up()
    } else {
        friction
    };
    let margin = surely_within(&worst, pushed, error);
    Ok(Ok((worst, margin)))
}

/// The margin within a border whose clearances have this relative error, rounded down.
fn surely_within(worst: &Portrait, farthest: f64, error: f64) -> Margin {
    let r = worst.model.guide;
    let Margin { displacement, impulse, from_rest } = worst.margin_within(farthest, 1.0);
    // Of a displacement only the clearance is in error; an impulse comes of an arc from that clearance.
    let shrunk = |length: f64, error: f64| (length * (1.0 - error)).next_down().max(0.0);
    // What is left of the clearance beyond the farthest rest has all of its error.
    let left = from_rest.displacement.unwrap_or(f64::INFINITY);
    let beyond = error * (1.0 + (farthest - r) / left).min(1.0 / error);
    Margin {
        displacement: displacement.map(|q| (r + shrunk(q - r, error)).next_down().max(r.min(q))),
        impulse: impulse.map(|impulse| shrunk(impulse, error)),
        from_rest: RestMargin {
            displacement: from_rest.displacement.map(|gap| shrunk(gap, beyond)),
            impulse: from_rest.impulse.map(|impulse| shrunk(impulse, beyond)),
        },
    }
}
