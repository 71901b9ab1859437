//! How large a kick the sticking set survives.
//!
//! The smallest displacement at rest, and the smallest impulse, that does not come back to the sticking set: where
//! the edge of its basin meets `v = 0`, and its height above the point where the mass rests.
//!
//! From the worst rest position these are the gap between the edge and the sticking set on `v = 0`, and the height
//! of the edge above an end of the set: the upper half of the edge is a graph `v(q)` with slope `a/v`, and where it is
//! level (`a = 0`) its second derivative is `-1/v`, because the spring's force falls with q. So it has no minimum
//! between its ends, and over a segment it is lowest at an end; the lower half likewise.
//!
//! ```
//! use hopfscope::flow::Limits;
//! use hopfscope::model::Parameters;
//! use hopfscope::portrait::basin::basin;
//!
//! // A_q = r coth(x/2) with x = -pi D/sqrt(1 - D^2), for D2 = D3 = 0.
//! let (d, r): (f64, f64) = (-0.4, 0.1);
//! let found = basin(&Parameters { d, d2: 0.0, d3: 0.0, r }, 3.0, &Limits::PATIENT)?;
//! let x = -std::f64::consts::PI * d / (1.0 - d * d).sqrt();
//! let displacement = found.margin().displacement.unwrap();
//! assert!((displacement - r / (0.5 * x).tanh()).abs() < 1e-12);
//! # Ok::<(), hopfscope::flow::Reason>(())
//! ```

use super::Basin;
use super::arc::Arc;
use crate::closed_form::lyapunov;
use crate::flow::Fate;
use crate::model::{Parameters, State};
use crate::numerics::elementary::hypot;
use crate::numerics::root::maximum;
use crate::portrait::{Border, Margin, RestMargin};

impl Basin {
    /// The margins.
    #[must_use]
    pub fn margin(&self) -> Margin {
        self.margin_within(self.parameters.r)
    }

    /// The margins if the mass may rest up to a `farthest` place on either side, which is r or beyond.
    #[must_use]
    pub fn margin_within(&self, farthest: f64) -> Margin {
        let Parameters { d, d3, r, .. } = self.parameters;
        if r == 0.0 && !(d > 0.0 || (d == 0.0 && d3 > 0.0)) {
            // Neither friction nor damping: nothing comes to rest, however small the kick.
            return Margin::ZERO;
        }
        let edge = self.borders.first().filter(|_| self.border != Border::None);
        let Some(edge) = edge else { return Margin::ENDLESS };
        let clearances = [&edge.upper, &edge.lower].into_iter().filter_map(Arc::clearance);
        let clearance = clearances.map(|clearance| clearance.value).reduce(f64::min);
        let gap = clearance.map(|clearance| (clearance - (farthest - r)).max(0.0));
        let impulse = |q: f64| edge.span_at(q).map_or(0.0, |(low, high)| high.min(-low));
        let finite = |impulse: f64| Some(impulse).filter(|impulse| impulse.is_finite());
        let least = impulse(farthest).min(impulse(-farthest));
        Margin {
            displacement: clearance.map(|clearance| r + clearance),
            impulse: finite(impulse(0.0)),
            from_rest: RestMargin {
                displacement: gap,
                impulse: if gap == Some(0.0) { gap } else { finite(least) },
            },
        }
    }

    /// Radius of the disk that Lyapunov's method proves to be captured (equation 24), as a fraction of the
    /// true margin: how conservative it is.
    #[must_use]
    pub fn lyapunov_share(&self) -> Option<f64> {
        let Margin { displacement, impulse, .. } = self.margin();
        let margin = displacement?.min(impulse?);
        lyapunov::radius(&self.parameters).map(|radius| radius / margin)
    }

    /// Radius of the largest circle about the origin that lies within the basin; `None` where nothing borders it.
    ///
    /// The least distance of the border, refined between the points of its curve.
    #[must_use]
    pub fn inner_radius(&self) -> Option<f64> {
        /// Points on each integration step, and the part of the way between the neighbours of the nearest in which
        /// the distance is flat.
        const POINTS: u16 = 24;
        const FLAT: f64 = 1e-9;
        if self.border == Border::None {
            return None;
        }
        let edge = self.borders.first()?;
        let curve = edge.curve(POINTS);
        let far = |state: &State| hypot(state.q, state.v);
        let nearest = (0..curve.len())
            .min_by(|one, other| far(&curve[*one]).total_cmp(&far(&curve[*other])))?;
        let State { v, .. } = curve[nearest];
        let distance = |q: f64| {
            let span = edge.span_at(q);
            span.map_or(f64::INFINITY, |(low, high)| hypot(q, if v < 0.0 { low } else { high }))
        };
        let ends = [nearest.saturating_sub(1), (nearest + 1).min(curve.len() - 1)];
        let [one, other] = ends.map(|index| curve[index].q);
        let (low, high) = (one.min(other), one.max(other));
        let (low, high) = maximum(low, high, FLAT * (high - low), |q| -distance(q));
        Some(distance(f64::midpoint(low, high)).min(far(&curve[nearest])))
    }

    /// The fraction of the basin's area that this circle fills; `None` where the area is infinite.
    #[must_use]
    pub fn integrity(&self) -> Option<f64> {
        let radius = self.inner_radius()?;
        Some(std::f64::consts::PI * radius * radius / self.area()?)
    }

    /// Area of the basin in the phase plane: the integral of `v^2` over one turn of its edge; `None`
    /// where it is infinite, or where there is no basin.
    #[must_use]
    pub fn area(&self) -> Option<f64> {
        let captured = self.fates.first() == Some(&Fate::Rest) && self.border != Border::None;
        let edge = self.borders.first().filter(|edge| captured && edge.is_closed())?;
        Some(edge.upper.area() + edge.lower.area())
    }
}
