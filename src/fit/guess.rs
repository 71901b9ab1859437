//! A first guess of all unknowns, from the record alone.

use std::f64::consts::PI;

use super::{
    D, D2, Extreme, LAST, Noise, OFFSET, OMEGA0, Q0, R, Signal, StartKind, Unknowns, amplitudes,
    dominant_frequency, index_at, least_squares, median, range, rate, regressions,
    robust_deviation, smoothed, turning_points, without_jumps,
};
use crate::numerics::{ln, real, sin_cos};

/// A way in which a record may begin, with guesses of the unknowns.
#[derive(Clone, Debug)]
pub struct Beginning {
    /// How the motion begins.
    pub start: StartKind,
    /// Whether the record leaves no doubt about this.
    pub certain: bool,
    /// Guesses of the unknowns.
    pub guesses: Vec<Unknowns>,
}

/// First guesses, and the turning points from which they were made.
#[derive(Clone, Debug)]
pub struct Guess {
    /// The ways in which the record may begin, the more likely one first.
    pub beginnings: Vec<Beginning>,
    /// The turning points.
    pub extremes: Vec<Extreme>,
    /// The first sample in motion, if the mass seems to have been struck at rest.
    pub struck: Option<usize>,
    /// The last sample before the mass was excited again.
    pub again: Option<usize>,
}

/// Makes first guesses from a record; `None` if fewer than two turning points, including a hold and a rest, can
/// be distinguished from noise.
///
/// A velocity is divided by the frequency, an acceleration by its square and its sign changed. Both are then swings of
/// the size of the displacement that lose as much per half swing, but begin a quarter or half a period earlier, and
/// are zero while the mass is held or rests.
pub fn guess(t: &[f64], x: &[f64], noise: &Noise, signal: Signal) -> Option<Guess> {
    /// Periods by which the release may be earlier or later.
    const PERIODS: [f64; 7] = [0.0, -0.2, 0.2, -1.0, 1.0, -2.0, 2.0];
    let cleaned = if noise.has_outliers {
        without_jumps(x)
    } else {
        x.to_vec()
    };
    let (low, high) = range(&cleaned);
    let mut period = 1.0 / dominant_frequency(t, &cleaned)?;
    let mut extremes = Vec::new();
    // Two rounds, since the extremes give a better period.
    for _ in 0..2 {
        let averaged = samples_within(t, period / 12.0);
        // The range that smoothed noise covers grows with its number of independent values.
        let chances = (real(t.len()) / averaged).max(2.0);
        let covered = 1.5 + 2.0 * (2.0 * ln(chances)).sqrt();
        let hysteresis = (covered * noise.deviation / averaged.sqrt()).max(0.02 * (high - low));
        extremes = turning_points(t, &cleaned, period, hysteresis);
        period = period_of(&extremes).unwrap_or(period);
    }
    let again = excited_again(t, &cleaned, &extremes);
    let first = *extremes.first()?;
    let is_displacement = signal.is_displacement();
    // From the release to the first extreme.
    let lead = 0.5 - 0.25 * real(signal.order());
    let (start, is_clear) = begins(t, &cleaned, noise, first, (period, lead));
    let is_held = start == StartKind::Release;
    let certain = is_clear && (is_held || is_displacement);
    let begin = first.t - lead * period;
    let level_before = |begin: f64| median(cleaned[..index_at(t, begin).max(1)].to_vec());
    let hold = level_before(begin);
    let struck = if is_displacement {
        struck_at(t, &cleaned, noise, hold, &extremes)
    } else {
        Some(index_at(t, first.t + 0.25 * period))
    };
    let struck = struck.filter(|_| is_held);
    let tail =
        (6.0 * noise.deviation / samples_within(t, period / 12.0).sqrt()).max(0.02 * (high - low));
    let mut with_rest = extremes.clone();
    if is_displacement {
        with_rest.extend(rest(t, &cleaned, &extremes, period, tail));
    }
    let unknowns = |averaged: &Unknowns, q0: f64, last: f64| {
        let mut p = *averaged;
        // The middles of the swings of a velocity are not shifted.
        if !is_displacement {
            p[D2] = 0.0;
        }
        (p[OMEGA0], p[Q0], p[LAST]) = (2.0 * PI / period, q0, last);
        p
    };
    let moving = || {
        let guess = |averaged: &Unknowns| {
            let [cosine, sine] = first_state(t, &cleaned, averaged[OFFSET], period)?;
            let is_velocity = signal == Signal::Velocity;
            let (q0, v0) = if is_velocity { (-sine, cosine) } else { (cosine, sine) };
            Some(unknowns(averaged, q0, v0))
        };
        regressions(&with_rest).iter().filter_map(guess).collect()
    };
    // The first turning points may be noise of the hold, or those of a growth too small to be seen: the release
    // may have been earlier or later.
    let released = || {
        let begins = PERIODS.map(|periods| begin + periods * period);
        let guesses = begins.into_iter().filter(|begin| t[0] < *begin && *begin < t[t.len() - 1]);
        let at = |begin: f64| {
            let hold = level_before(begin);
            let next = begin + if signal == Signal::Velocity { 0.1 } else { 0.25 } * period;
            let swings = with_rest.iter().filter(|extreme| extreme.t > next);
            let held = is_displacement.then_some(Extreme { t: begin, x: hold });
            let swings: Vec<Extreme> = held.into_iter().chain(swings.copied()).collect();
            let guess = |it: &Unknowns| unknowns(it, held_at(&swings, it, signal), begin);
            regressions(&swings).iter().map(guess).collect::<Vec<_>>()
        };
        guesses.flat_map(at).collect()
    };
    let beginning = |start, certain| {
        let guesses = if start == StartKind::Release {
            released()
        } else {
            moving()
        };
        Beginning { start, certain, guesses }
    };
    let other = if is_held {
        StartKind::Moving
    } else {
        StartKind::Release
    };
    let beginnings = vec![beginning(start, certain), beginning(other, false)];
    if is_held && is_displacement {
        with_rest.insert(0, Extreme { t: begin, x: hold });
    }
    let is_guessed = beginnings.iter().any(|beginning| !beginning.guesses.is_empty());
    is_guessed.then_some(Guess { beginnings, extremes: with_rest, struck, again })
}

/// Where the mass was held, from the offset. In other signals than the displacement, of which the hold is the first
/// extreme, it is not seen: it follows from the next swing and what was lost since.
fn held_at(swings: &[Extreme], averaged: &Unknowns, signal: Signal) -> f64 {
    let first = swings[0].x - averaged[OFFSET];
    let half_swings = match signal {
        Signal::Displacement => return first,
        Signal::Velocity => 0.5,
        Signal::Acceleration => 1.0,
    };
    let lost = half_swings * (2.0 * averaged[R] + PI * averaged[D] * first.abs());
    -first - first.signum() * lost
}

/// Average number of samples in a stretch of time, at least one.
fn samples_within(t: &[f64], stretch: f64) -> f64 {
    (rate(t) * stretch).max(1.0)
}

/// The period: twice the slope of the times of the extremes over their number. A gap in which extremes were missed
/// counts for as many half periods as fit.
pub fn period_of(extremes: &[Extreme]) -> Option<f64> {
    let gaps: Vec<f64> = extremes.windows(2).map(|two| two[1].t - two[0].t).collect();
    let half = median(gaps.clone());
    let (mut number, mut rows) = (0.0, vec![([1.0, 0.0], extremes.first()?.t)]);
    for (gap, extreme) in gaps.iter().zip(&extremes[1..]) {
        number += (gap / half).round().max(1.0);
        rows.push(([1.0, number], extreme.t));
    }
    let [_, slope] = least_squares(rows.into_iter())?;
    Some(2.0 * slope)
}

/// The level of a flat end of the record, as a last extreme; `None` if the record does not end flat.
fn rest(t: &[f64], x: &[f64], extremes: &[Extreme], period: f64, tail: f64) -> Option<Extreme> {
    let last = extremes.last()?;
    let from = index_at(t, last.t + 0.55 * period);
    if t.last()? - last.t < 1.2 * period {
        return None;
    }
    let smooth = smoothed(&t[from..], &x[from..], period / 12.0);
    let level = median(smooth.clone());
    let flat = smooth.iter().all(|x| (x - level).abs() <= 2.0 * tail);
    flat.then_some(Extreme { t: last.t + 0.5 * period, x: level })
}

/// How a record begins, judged by its first turning point, and whether that leaves no doubt.
///
/// A moving mass turns within half a period. If the first turn comes later and the record before it scatters no
/// more than the noise, the mass was held. The scatter is checked because a growing motion begins small and looks
/// like a hold. The first extreme of a held mass comes `lead` periods after its release.
fn begins(
    t: &[f64],
    x: &[f64],
    noise: &Noise,
    first: Extreme,
    (period, lead): (f64, f64),
) -> (StartKind, bool) {
    /// Fewest samples that show a hold.
    const FEWEST: usize = 5;
    let natural = (first.t - t[0]) / period;
    let begin = &x[..index_at(t, first.t - (0.05 + lead) * period)];
    let level = median(begin.to_vec());
    let spread = robust_deviation(begin.iter().map(|x| x - level));
    match natural {
        0.6.. if spread <= 2.0 * noise.deviation && begin.len() >= FEWEST => {
            (StartKind::Release, true)
        }
        0.4.. => (StartKind::Moving, false),
        _ => (StartKind::Moving, true),
    }
}

/// The first sample clearly off the level of the hold, if that level lies between the first two turning points. A
/// mass that is released was held outside them.
fn struck_at(
    t: &[f64],
    x: &[f64],
    noise: &Noise,
    hold: f64,
    extremes: &[Extreme],
) -> Option<usize> {
    /// Fractions of the first swing between which the rest level of a struck mass lies.
    const BETWEEN: std::ops::Range<f64> = 0.25..0.75;
    /// Number of standard deviations of the noise beyond which a sample is off the hold.
    const OFF: f64 = 6.0;
    let [first, second, ..] = extremes else { return None };
    let part = (hold - first.x) / (second.x - first.x);
    let moving = index_at(t, first.t);
    let near = |x: &f64| (x - hold).abs() <= OFF * noise.deviation.max(noise.step);
    let from = x[..moving].iter().rposition(near)? + 2;
    BETWEEN.contains(&part).then_some(from.min(moving))
}

/// The last sample near the turning point at which a decay suddenly turns into growth. A free motion that decays
/// keeps decaying, because its swings keep their order.
fn excited_again(t: &[f64], x: &[f64], extremes: &[Extreme]) -> Option<usize> {
    /// A swing of a decay that is wider than the preceding one by this factor was not free.
    const WIDER: f64 = 1.5;
    /// Number of swings that must be wider, including the first: one wrong turning point spoils two swings.
    const SWINGS: usize = 4;
    /// Before the excitation, a swing must be narrower than the preceding one by this factor to count as decay.
    const NARROWER: f64 = 0.9;
    /// How near a sample must be to the turning point, as a fraction of half the new swing. A rest differs by less
    /// from the last turning point before it.
    const NEAR: f64 = 0.2;
    let widths = amplitudes(extremes);
    let grows = |swings: &[f64]| {
        let (decay, grown) = swings.split_at(2);
        decay[1] < NARROWER * decay[0]
            && grown[0] > WIDER * decay[1]
            && grown.iter().all(|width| *width > decay[1])
    };
    let index = 2 + widths.windows(2 + SWINGS).position(grows)?;
    let (last, next) = (extremes[index], extremes[index + 1]);
    let [from, to] = [last, next].map(|extreme| index_at(t, extreme.t));
    let near = |x: &f64| (x - last.x).abs() <= NEAR * widths[index];
    Some(from + x[from..to].iter().rposition(near)?)
}

/// Displacement and velocity at the first sample, from an undamped oscillation fitted to the first third of a
/// period.
fn first_state(t: &[f64], x: &[f64], offset: f64, period: f64) -> Option<[f64; 2]> {
    let to = t.partition_point(|&time| time <= t[0] + period / 3.0).max(3).min(t.len());
    let row = |(time, x): (&f64, &f64)| {
        let (sine, cosine) = sin_cos(2.0 * PI / period * (time - t[0]));
        ([cosine, sine], x - offset)
    };
    least_squares(t[..to].iter().zip(x).map(row))
}
