//! The curves in the pictures of a fit. They are computed once, with the answer; drawing them computes nothing.

use std::f64::consts::TAU;

use super::{
    Estimate, Margins, OFFSET, OMEGA0, Q0, Way, autocorrelations, averaged, follow, parameters,
    quantile, range, rate, sorted,
};
use crate::model::{Parameters, State};
use crate::numerics::{real, truncated};

/// A point of a curve.
pub type PlotPoint = [f64; 2];

/// The window of a picture: left, right, bottom, top.
pub type Extent = [f64; 4];

/// The curves in the pictures of a fit.
#[derive(Clone, Debug)]
pub struct Curves {
    /// The fitted motion: time in s, displacement from the offset, velocity over omega0, and the signal with its offset;
    /// none for a record of peaks only.
    pub motion: Vec<[f64; 4]>,
    /// Damping over amplitude.
    pub damping: Damping,
    /// The fraction of draws whose smallest change of position from rest that is not survived is less than the abscissa.
    pub spread: Vec<PlotPoint>,
    /// The window in which `spread` is shown.
    pub spread_extent: Extent,
}

/// Damping over amplitude.
#[derive(Clone, Debug)]
pub struct Damping {
    /// Measured: amplitude, relative loss of amplitude, and its standard error.
    pub measured: Vec<[f64; 3]>,
    /// Exact, from motions with the fitted parameters.
    pub exact: Vec<PlotPoint>,
    /// By averaging, with the fitted parameters.
    pub averaged: Vec<PlotPoint>,
    /// The outline of 90 % of the draws by averaging: the lower bound, then back along the upper one.
    pub band: Vec<PlotPoint>,
    /// The window in which the damping is shown.
    pub extent: Extent,
}

impl Curves {
    /// Computes all curves.
    pub fn of(estimate: &Estimate, margins: &Margins) -> Self {
        let (spread, spread_extent) = spread(estimate, margins);
        let motion = motion(estimate);
        let places: Vec<f64> = if motion.is_empty() {
            // What was measured at a peak less its residual is how far the fitted motion goes.
            let peaks = estimate.data.x.iter().zip(&estimate.residuals);
            peaks.map(|(x, residual)| x - residual - estimate.p[OFFSET]).collect()
        } else {
            motion.iter().map(|[_, q, ..]| *q).collect()
        };
        let farthest = places.into_iter().map(f64::abs).fold(0.0, f64::max);
        Curves { damping: damping(estimate, margins, farthest), motion, spread, spread_extent }
    }
}

/// Autocorrelation of the residuals over lags in s, up to two periods.
pub fn memory(estimate: &Estimate) -> Vec<PlotPoint> {
    const LAGS: usize = 400;
    if estimate.data.has_peaks() {
        return Vec::new();
    }
    let step = 1.0 / rate(&estimate.data.t);
    let kept: Vec<f64> = estimate.kept_residuals().collect();
    let periods = 2.0 * TAU / estimate.p[OMEGA0];
    let most = truncated(periods / step).clamp(4, (kept.len() / 2).max(4));
    let lags: Vec<usize> = (1..most).step_by(most.div_ceil(LAGS)).collect();
    let values = autocorrelations(&kept, &lags);
    lags.iter().zip(values).map(|(lag, rho)| [real(*lag) * step, rho]).collect()
}

/// Amplitude and relative loss of amplitude per unit of time, from four successive turning points.
fn pair(q: &[f64]) -> Option<PlotPoint> {
    let half = |k: usize| 0.5 * (q[k + 1] - q[k]).abs();
    (q.len() == 4 && half(1) > 0.0).then(|| [half(1), (half(0) - half(2)) / (TAU * half(1))])
}

/// The exact damping, computed from a motion released at a displacement in the same way as from a record.
fn exact(parameters: &Parameters, from: f64) -> Option<PlotPoint> {
    let way = Way { reach: 1e3 * from, turns: 3, ..Way::default() };
    let found = follow(parameters, State { q: from, v: 0.0 }, &[40.0], way, |_, _| {}).ok()?;
    let turns: Vec<f64> =
        std::iter::once(from).chain(found.turns.iter().map(|turn| turn.q)).collect();
    pair(&turns)
}

/// `farthest` is how far the fitted motion goes.
fn damping(estimate: &Estimate, margins: &Margins, farthest: f64) -> Damping {
    const POINTS: u32 = 160;
    let (smallest, largest) = estimate.amplitudes();
    let parameters = parameters(&estimate.p);
    let to = 1.25 * largest.min(farthest);
    let amplitudes: Vec<f64> =
        (1..=POINTS).map(|i| to * f64::from(i) / f64::from(POINTS)).collect();
    let x: Vec<f64> = estimate.extremes.iter().map(|extreme| extreme.x).collect();
    // Each half peak-to-peak value has the error of two turning points, each of which is read from the samples of about a
    // sixth of a period.
    let read = (estimate.data.samples_per_period(estimate.p[OMEGA0]) / 6.0).max(1.0);
    let error = |a: f64| estimate.covariance.deviation / read.sqrt() / (TAU * a);
    let pairs = x.windows(4).filter_map(pair);
    let measured: Vec<[f64; 3]> = pairs.map(|[a, delta]| [a, delta, error(a)]).collect();
    let exact: Vec<PlotPoint> = amplitudes.iter().filter_map(|&a| exact(&parameters, a)).collect();
    let computed = exact.iter().filter(|it| it[0] >= smallest && it[1].is_finite()).map(|it| it[1]);
    let [low, high] =
        covering(&computed.collect::<Vec<_>>(), measured.iter().map(|it| it[1]).collect());
    let room = 0.15 * (high - low).max(f64::MIN_POSITIVE);
    Damping {
        measured,
        exact,
        averaged: amplitudes.iter().map(|&a| [a, averaged(&parameters, a)]).collect(),
        band: band(margins, &amplitudes),
        extent: [0.0, to, low - room, high + room],
    }
}

/// Heights that are worth seeing: zero, all those computed, and those measured, except for single ones far from all
/// others, which would flatten the rest.
fn covering(computed: &[f64], mut measured: Vec<f64>) -> [f64; 2] {
    measured.retain(|it| it.is_finite());
    measured.sort_by(f64::total_cmp);
    let trim = measured.len().div_ceil(10);
    let usual = measured.get(trim..measured.len().saturating_sub(trim)).unwrap_or_default();
    let (low, high) = range([&[0.0], computed, usual].concat());
    let far = high - low;
    measured.retain(|it| (low - far..=high + far).contains(it));
    range([&[low, high], &measured[..]].concat()).into()
}

/// The outline of the averaged damping of 90 % of the draws.
fn band(margins: &Margins, amplitudes: &[f64]) -> Vec<PlotPoint> {
    let (mut below, mut above) = (Vec::new(), Vec::new());
    for &a in amplitudes {
        let values = sorted(margins.draws.iter().map(|draw| Some(averaged(draw, a))));
        below.extend(quantile(&values, 0.05).map(|value| [a, value]));
        above.extend(quantile(&values, 0.95).map(|value| [a, value]));
    }
    above.reverse();
    below.extend(above);
    below.extend(below.first().copied());
    below
}

/// The steps of the cumulative distribution of the margin, and the window in which they are shown.
fn spread(estimate: &Estimate, margins: &Margins) -> (Vec<PlotPoint>, Extent) {
    /// Margins are shown up to this multiple of the largest amplitude.
    const FAR: f64 = 10.0;
    let (_, largest) = estimate.amplitudes();
    let finite: Vec<f64> = margins.shifts.iter().copied().filter(|it| it.is_finite()).collect();
    let share = |count: usize| real(count) / real(margins.shifts.len());
    let mut steps = vec![[0.0, 0.0]];
    for (index, &x) in finite.iter().enumerate() {
        steps.extend([[x, share(index)], [x, share(index + 1)]]);
    }
    // Margins far beyond the record are not known well enough for their tail to be shown.
    let shift = margins.kicks.from_rest.displacement;
    let typical = shift.upper.or(shift.median);
    let far = typical.or(finite.last().copied()).unwrap_or(largest).min(FAR * largest);
    let to = far.max(largest) + 0.1 * (far.max(largest) - far.min(largest)).max(0.02 * largest);
    steps.push([to.max(finite.last().copied().unwrap_or(0.0)), share(finite.len())]);
    // The window zooms in on a narrow distribution.
    let near = shift.lower.unwrap_or(0.0).min(largest);
    let from = if near > 0.7 * to {
        near - 0.3 * (to - near)
    } else {
        0.0
    };
    (steps, [from, to, 0.0, 1.0])
}

/// The fitted motion at closely spaced times, and its signal.
fn motion(estimate: &Estimate) -> Vec<[f64; 4]> {
    /// Number of points for each half swing, and of all at most.
    const FINE: usize = 40;
    const MOST: usize = 16_000;
    if estimate.data.has_peaks() {
        return Vec::new();
    }
    let (p, t) = (&estimate.p, &estimate.data.t);
    let (first, last) = (t[0], t[t.len() - 1]);
    let (origin, start) = estimate.start.beginning(p, t);
    let count = (FINE * (estimate.half_swings + 2)).min(MOST);
    let at = |index: usize| origin + (last - origin) * real(index) / real(count);
    let taus: Vec<f64> = (0..=count).map(|index| p[OMEGA0] * (at(index) - origin)).collect();
    let signal = estimate.data.signal;
    let scale = signal.scale(p[OMEGA0]);
    let mut points = Vec::new();
    if first < origin {
        let held = if signal.is_displacement() { p[Q0] } else { 0.0 };
        points.push([first, p[Q0], 0.0, estimate.data.zero(p, first) + held]);
    }
    let way = Way { signal, ..Way::default() };
    // Cannot be lost: the fit has already followed this motion through the record.
    let _ = follow(&parameters(p), start, &taus, way, |index, point| {
        let seen = estimate.data.zero(p, at(index)) + scale * point.signal;
        points.push([at(index), point.q, point.v, seen]);
    });
    points
}
