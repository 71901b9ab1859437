//! The release of a record whose first swings say little about the motion, such as those of a growth from near an unstable
//! cycle: the motion is fitted without them, and then followed from the hold.

use super::{
    Beginning, Data, Extreme, Guess, LAST, Noise, OFFSET, OMEGA0, Observation, Optimum, Q0, Runs,
    Signal, StartKind, Task, UNKNOWNS, Unfit, Unknowns, Way, follow, guess, interrupted,
    parameters, placed,
};
use crate::model::State;

/// The minima from guesses that release the held mass so that it comes into the motion after its first swings.
/// `extremes` are the hold and the turning points. `None` if there is no such motion, or if the
/// signal does not show where the mass was held; fails with [`Unfit::Interrupted`].
pub fn released_before(
    task: &Task,
    held: &[Option<f64>; UNKNOWNS],
    noise: &Noise,
    extremes: &[Extreme],
    runs: &mut Runs,
) -> Result<Option<Vec<Optimum>>, Unfit> {
    /// Number of turning points left out, at most, and the part of all.
    const FIRST: usize = 4;
    const PART: usize = 4;
    /// Number of swings between the release and the fitted motion, at most.
    const SWINGS: usize = 60;
    let signal = Signal::Displacement;
    let Data::Samples { t, x, signal: Signal::Displacement } = task.observation.data else {
        return Ok(None);
    };
    let first = extremes[FIRST.min(extremes.len() / PART)];
    let from = t.partition_point(|&t| t < first.t);
    let (later, times) = (&x[from..], &t[from..]);
    let Some(Guess { mut beginnings, .. }) = guess(times, later, noise, signal) else {
        return Ok(None);
    };
    beginnings.retain(|beginning| beginning.start == StartKind::Moving);
    for guess in beginnings.iter_mut().flat_map(|beginning| &mut beginning.guesses) {
        *guess = placed(held, *guess);
    }
    let data = Data::Samples { t: times.to_vec(), x: later.to_vec(), signal };
    let part = Task { observation: Observation { data: &data, ..task.observation }, ..*task };
    let Some(found) = interrupted(part.search(&beginnings, runs))? else { return Ok(None) };
    let optimum = &found[0];
    let Some(turn) = optimum.seen.turns.first().filter(|_| part.explains(optimum)) else {
        return Ok(None);
    };
    let p = &optimum.p;
    let begin = State { q: extremes[0].x - p[OFFSET], v: 0.0 };
    let way = Way { reach: task.observation.reach, turns: SWINGS, ..Way::default() };
    let Ok(motion) = follow(&parameters(p), begin, &[f64::MAX], way, |_, _| {}) else {
        return Ok(None);
    };
    let released = |tau: f64| {
        let mut guess: Unknowns = *p;
        (guess[Q0], guess[LAST]) = (begin.q, times[0] + (turn.tau - tau) / p[OMEGA0]);
        guess
    };
    let same = motion.turns.iter().filter(|it| it.q * turn.q > 0.0);
    let guesses = same.map(|it| placed(held, released(it.tau))).filter(|it| it[LAST] > t[0]);
    let guesses: Vec<Unknowns> = guesses.collect();
    let beginning = Beginning { start: StartKind::Release, certain: true, guesses };
    interrupted(task.search(&[beginning], runs))
}
