//! How much dry friction a margin needs: the margin as a function of r, inverted.
//!
//! More friction turns the field inwards everywhere but on `v = 0`: the fields of growing r are a rotated
//! family in Duff's sense. So the basin of the sticking set grows with r, and both its margins increase;
//! where an unstable and a stable cycle meet (the fold) they jump to infinity. Every margin therefore has
//! a smallest r from which on it is kept, and a bracket around it only needs halving. So does more friction of the guide
//! of a machine, wherever the mass moves.

use serde::Serialize;

use super::{Margin, Portrait};
use crate::flow::{Cost, Limits, Reason, Result};
use crate::model::{Body, Parameters, Source, Tolerances};
use crate::numerics::{PlaceTolerance, exp, illinois, ln};
use crate::portrait::guarantee::machine::guaranteed;

/// A kick out of rest.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Kick {
    /// Displaced, and let go.
    Displacement,
    /// Struck, so that it starts from the origin with a velocity.
    Impulse,
}

impl Kick {
    /// One word.
    pub fn name(self) -> &'static str {
        match self {
            Kick::Displacement => "displacement",
            Kick::Impulse => "impulse",
        }
    }

    /// The margin of this kick; infinite where every kick is survived.
    pub fn margin(self, margin: &Margin) -> f64 {
        match self {
            Kick::Displacement => margin.displacement,
            Kick::Impulse => margin.impulse,
        }
        .unwrap_or(f64::INFINITY)
    }
}

/// The friction that a margin needs.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case", tag = "kind")]
pub enum FrictionNeed {
    /// Any, however small.
    Any,
    /// This much: the margin is then as wanted.
    Friction {
        /// The least friction intensity.
        r: f64,
    },
    /// Just above this much, where the cycles that border the basin have met: every kick is survived then.
    Fold {
        /// The friction intensity at the fold.
        r: f64,
        /// The margin just below it: the largest that is finite.
        below: f64,
    },
}

impl FrictionNeed {
    /// The least friction; `None` if any suffices.
    pub fn least(self) -> Option<f64> {
        match self {
            FrictionNeed::Any => None,
            FrictionNeed::Friction { r } | FrictionNeed::Fold { r, .. } => Some(r),
        }
    }
}

/// Relative width of the bracket at which r is known.
const WIDTH: f64 = 4.0 * f64::EPSILON;

/// Relative width of a bracket so close to a fold that rounding may hide which of two cycles attracts: they
/// are apart by its square root.
const BLUR: f64 = 1e-9;

/// Steps that enclose r, and that narrow it; bisection of the whole range of doubles needs some 2100.
const STEPS: usize = 2200;

/// The least friction of the guide, in N, of the paper's oscillator its r, at which the margin, of a belt with tolerances
/// the guaranteed margin, is `wanted` (m or N s) or more, and what the search cost for the paper's oscillator; `None`
/// where no bracket of it was found. The friction that the source has does not matter.
///
/// # Errors
/// The [`Reason`] why a basin could not be computed, [`Reason::NotApplicable`] unless `wanted` is positive
/// and finite.
pub fn friction_for(
    source: &Source,
    known: &Tolerances,
    kick: Kick,
    wanted: f64,
    limits: &Limits,
) -> Result<(Option<FrictionNeed>, Cost)> {
    if !(wanted > 0.0 && wanted.is_finite()) {
        return Err(Reason::NotApplicable { needs: "a positive margin" });
    }
    let model = source.model()?;
    let uncertain = source.of_belt().is_some() && !known.is_none();
    let mut cost = Cost::default();
    let mut margin = |friction: f64| -> Result<Margin> {
        let with = source.with_friction(friction);
        Ok(match &with.body {
            Body::Belt(belt) if uncertain => {
                guaranteed(belt, known)?.map_or(Margin::ZERO, |(_, margin)| margin)
            }
            Body::Paper(parameters) => {
                let found = Portrait::of_oscillator(parameters, wanted, limits)?;
                cost += found.cost;
                found.margin
            }
            _ => with.portrait()?.margin,
        })
    };
    // The friction that holds at rest as much as is wanted.
    let holds = match kick {
        Kick::Displacement => wanted * model.stiffness,
        Kick::Impulse => wanted * model.omega_0,
    };
    if uncertain {
        // As much friction holds a displacement by itself; where even that guarantees nothing, no friction does.
        let half = known.half_widths.get("R").copied().unwrap_or(0.0);
        if kick.margin(&margin(8.0 * (holds + known.disturbance + half))?) < wanted {
            return Ok((None, cost));
        }
    }
    // The friction at which a margin of this size is the one without friction; none where the steady state repels by
    // itself.
    let any = match source.body {
        // Undamped motions come to rest by friction alone, in the end by any.
        Body::Paper(Parameters { d: 0.0, d3: 0.0, .. }) => Some(wanted * f64::EPSILON),
        Body::Paper(Parameters { d, d3, .. }) if d > 0.0 || (d == 0.0 && d3 > 0.0) => Some(0.0),
        Body::Paper(_) => None,
        _ => (model.damping > 0.0 && !uncertain).then_some(0.0),
    };
    Ok((least_friction((kick, wanted), (holds, any), &mut margin)?, cost))
}

/// A friction, and by how much the margin there exceeds the one wanted, in the logarithm.
#[derive(Clone, Copy)]
struct FrictionTrial {
    r: f64,
    excess: f64,
}

/// The least friction at which the margin of a kick, a function of friction that increases and may jump, is as `wanted`:
/// enclosed, and narrowed until rounding, or next to a fold until the search for cycles fails. The search
/// starts at the friction `first`; `any` is one that counts as none. `None` where no bracket is found.
fn least_friction(
    (kick, wanted): (Kick, f64),
    (first, any): (f64, Option<f64>),
    margin: &mut dyn FnMut(f64) -> Result<Margin>,
) -> Result<Option<FrictionNeed>> {
    let mut at = |r: f64| -> Result<FrictionTrial> {
        let excess = ln(kick.margin(&margin(r)?) / wanted).max(f64::MIN);
        Ok(FrictionTrial { r, excess })
    };
    if let Some(r) = any
        && at(r)?.excess >= 0.0
    {
        return Ok(Some(FrictionNeed::Any));
    }
    // A displacement within the sticking set is kept: the first is high enough, or nearly so.
    let mut high = at(first)?;
    let mut low = high;
    for _ in 0..STEPS {
        if high.excess < 0.0 {
            low = high;
            high = at(2.0 * high.r)?;
        } else if low.excess >= 0.0 {
            high = low;
            low = at(0.5 * low.r)?;
        } else {
            break;
        }
    }
    if high.excess < 0.0 || low.excess >= 0.0 {
        return Ok(None);
    }
    // In the logarithm of r, as a fraction of the first upper end.
    let unit = high.r;
    let ends = [(ln(low.r / unit), low.excess), (0.0, high.excess)];
    let searched = illinois(ends, WIDTH, PlaceTolerance::Absolute(WIDTH), |log| {
        let here = at(unit * exp(log))?;
        *(if here.excess < 0.0 { &mut low } else { &mut high }) = here;
        Ok(here.excess)
    });
    // The upper end is the safe one, and known, where the search for cycles fails next to a fold; it may as well meet no
    // cycle at all there.
    let failed = matches!(searched, Err(Reason::NoConvergence { .. } | Reason::Escapes));
    if !(failed && high.r - low.r <= BLUR * high.r) {
        searched?;
    }
    if low.excess >= -WIDTH {
        return Ok(Some(FrictionNeed::Friction { r: low.r }));
    }
    Ok(Some(if high.excess.is_finite() {
        FrictionNeed::Friction { r: high.r }
    } else {
        FrictionNeed::Fold { r: high.r, below: wanted * exp(low.excess) }
    }))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::branch::fold::fold;
    use crate::closed_form::piecewise_linear::LinearCycle;
    use crate::model::Belt;
    use crate::paper::model::machine as paper;

    fn found(
        parameters: Parameters,
        kick: Kick,
        wanted: f64,
    ) -> Result<Option<FrictionNeed>, Reason> {
        let exact = Tolerances::default();
        let paper = Body::Paper(parameters).into();
        Ok(friction_for(&paper, &exact, kick, wanted, &Limits::PATIENT)?.0)
    }

    fn needed(d: f64, d2: f64, d3: f64, kick: Kick, wanted: f64) -> FrictionNeed {
        let parameters = Parameters { d, d2, d3, r: 7.0 };
        found(parameters, kick, wanted).unwrap().unwrap()
    }

    fn margin(d: f64, d2: f64, d3: f64, r: f64) -> Margin {
        let parameters = Parameters { d, d2, d3, r };
        Portrait::of_oscillator(&parameters, 1.0, &Limits::PATIENT).unwrap().margin
    }

    #[test]
    fn linear_margins_are_inverted_to_the_closed_form() {
        for d in [-0.9, -0.3, -0.01, -1e-6] {
            let unit = LinearCycle::new(d, 1.0).unwrap();
            let FrictionNeed::Friction { r } = needed(d, 0.0, 0.0, Kick::Displacement, 0.3) else {
                panic!("D = {d} needs some friction")
            };
            assert!((r * unit.q_max / 0.3 - 1.0).abs() < 1e-9, "D = {d}: {r}");
        }
    }

    #[test]
    fn the_friction_found_gives_the_margin_wanted() {
        for (d, d2, d3) in
            [(-0.1, 0.0, 0.4), (-0.1, 0.2, 0.3), (-0.2, -0.1, -0.3), (-0.1, 0.1, 0.0)]
        {
            for kick in [Kick::Displacement, Kick::Impulse] {
                let found = needed(d, d2, d3, kick, 0.25);
                let FrictionNeed::Friction { r } = found else {
                    panic!("{d} {d2} {d3}: {found:?}")
                };
                let margin = kick.margin(&margin(d, d2, d3, r));
                assert!((margin / 0.25 - 1.0).abs() < 1e-9, "{d} {d2} {d3} {kick:?}: {margin}");
            }
        }
    }

    #[test]
    fn beyond_the_fold_every_kick_is_survived() {
        let found = needed(-0.1, 0.2, 0.4, Kick::Displacement, 5.0);
        let FrictionNeed::Fold { r, below } = found else { panic!("{found:?}") };
        let parameters = Parameters { d: 0.0, d2: 0.2, d3: 0.4, r };
        let fold = fold(&parameters, &Limits::PATIENT).unwrap().0.unwrap();
        assert!((fold.d + 0.1).abs() < 1e-7, "{}", fold.d);
        assert!(below > 0.3 && below < 5.0);
        assert_eq!(margin(-0.1, 0.2, 0.4, 1.001 * r).displacement, None);
        assert!(margin(-0.1, 0.2, 0.4, 0.999 * r).displacement.is_some());
    }

    #[test]
    fn every_margin_beyond_a_fold_needs_the_friction_of_the_fold() {
        let slow = Belt { belt_speed: 0.1, ..paper() };
        let half_widths = [("R".to_owned(), 0.1)].into();
        let known = Tolerances { half_widths, ..Tolerances::default() };
        for wanted in [2.0e-3, 2.1e-3, 2.2e-3, 2.4e-3] {
            let belt = Body::Belt(Box::new(slow.clone())).into();
            let kick = Kick::Displacement;
            let found = friction_for(&belt, &known, kick, wanted, &Limits::PATIENT).unwrap().0;
            let Some(FrictionNeed::Fold { r, .. }) = found else { panic!("{wanted} m: {found:?}") };
            assert!((r - 3.153_423_17).abs() < 1e-8, "{wanted} m: {r}");
        }
    }

    #[test]
    fn a_damped_rest_needs_no_friction_for_what_it_keeps_by_itself() {
        assert_eq!(needed(0.1, 0.0, 0.0, Kick::Displacement, 1e3), FrictionNeed::Any);
        assert_eq!(needed(0.1, 0.3, 0.2, Kick::Impulse, 1e3), FrictionNeed::Any);
        assert_eq!(needed(0.0, 0.0, 0.0, Kick::Impulse, 1.0), FrictionNeed::Any);
        // Undamped with D2 alone: the parabola of escape begins at 1/(2 D2).
        assert_eq!(needed(0.0, 0.5, 0.0, Kick::Displacement, 0.99), FrictionNeed::Any);
        assert!(matches!(
            needed(0.0, 0.5, 0.0, Kick::Displacement, 1.01),
            FrictionNeed::Friction { .. }
        ));
        // With D3 < 0 an unstable cycle borders the basin without friction too, near sqrt(-8 D/(3 D3)).
        assert_eq!(needed(0.1, 0.0, -0.3, Kick::Displacement, 0.9), FrictionNeed::Any);
        let FrictionNeed::Friction { r } = needed(0.1, 0.0, -0.3, Kick::Displacement, 1.2) else {
            panic!("some friction")
        };
        assert!((margin(0.1, 0.0, -0.3, r).displacement.unwrap() / 1.2 - 1.0).abs() < 1e-9);
    }

    #[test]
    fn without_friction_a_repelling_rest_has_no_margin() {
        let none = Margin::ZERO;
        for (d, d2, d3) in [(-0.1, 0.0, 0.4), (-0.1, 0.0, 0.0), (-0.1, 0.3, 0.0), (0.0, 0.0, -1.0)]
        {
            assert_eq!(margin(d, d2, d3, 0.0), none, "{d} {d2} {d3}");
        }
        assert_eq!(margin(0.1, 0.0, 0.4, 0.0).displacement, None);
    }

    #[test]
    fn margins_grow_with_friction() {
        for (d, d2, d3) in [(-0.1, 0.0, 0.4), (-0.1, 0.3, 0.3), (0.05, 0.2, -0.3), (-0.1, 0.1, 0.0)]
        {
            let mut last = (0.0, 0.0);
            for step in 1..40 {
                let margin = margin(d, d2, d3, 0.01 * f64::from(step));
                let here = (Kick::Displacement.margin(&margin), Kick::Impulse.margin(&margin));
                assert!(here.0 >= last.0 && here.1 >= last.1, "{d} {d2} {d3} at {step}");
                assert!(here.0 > last.0 || here.0.is_infinite());
                last = here;
            }
        }
    }

    #[test]
    fn far_beyond_critical_damping_rest_itself_is_the_margin() {
        let FrictionNeed::Friction { r } = needed(-1.5, 0.0, 0.0, Kick::Displacement, 0.3) else {
            panic!("some friction")
        };
        assert!((r / 0.3 - 1.0).abs() < 1e-12);
    }

    #[test]
    fn a_margin_that_is_none_is_refused() {
        for wanted in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            let parameters = Parameters::default();
            let refused = found(parameters, Kick::Impulse, wanted);
            assert!(matches!(refused, Err(Reason::NotApplicable { .. })));
        }
    }
}
