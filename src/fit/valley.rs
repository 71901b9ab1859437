//! The minima that belong to different numbers of half swings.
//!
//! A motion that comes to rest within the record has a minimum of its own for each number of half swings
//! before the rest: where a turning point crosses the rim of the sticking set the residuals are continuous and
//! their derivatives are not. So one descent never decides.

use super::levenberg_marquardt::{Effort, NoFit, Optimum, Task, interrupted};
use super::observation::{Data, R, UNKNOWNS, Unknowns};
use super::problem::{Problem, Verdict};

/// A local minimum with its number of half swings.
#[derive(Clone, Debug)]
pub struct Valley {
    /// Half swings within the record.
    pub half_swings: usize,
    /// The minimum.
    pub optimum: Optimum,
}

impl Problem<'_> {
    /// The minimum, and those of neighbouring numbers of half swings, the lowest first.
    ///
    /// From the lowest one known, one half swing more and one less are tried, until neither is lower. While the
    /// residuals are not white, other steps of r are tried too.
    ///
    /// # Errors
    /// [`NoFit::Interrupted`].
    pub fn valleys(
        &self,
        task: &Task,
        optimum: Optimum,
        effort: &mut Effort,
    ) -> Result<Vec<Valley>, NoFit> {
        /// Most minima around which others are sought.
        const MOST: usize = 6;
        /// Steps of r while the residuals are not white.
        const STEPS: [f64; 4] = [0.88, 1.14, 0.75, 1.33];
        let mut valleys = vec![Valley { half_swings: optimum.seen.turns.len(), optimum }];
        if !self.free[R] || !matches!(self.data, Data::Samples { .. }) {
            return Ok(valleys);
        }
        let (mut asked, mut stepped) = (Vec::new(), false);
        while asked.len() < MOST {
            let from = valleys[0].optimum.clone();
            let verdict = self.verdict(&from);
            let guesses = if !asked.contains(&valleys[0].half_swings) {
                asked.push(valleys[0].half_swings);
                beyond_the_rim(task, &from, verdict)
            } else if verdict != Verdict::Noise && !stepped && from.p[R] > 0.0 && from.seen.rests {
                stepped = true;
                let step = |factor: f64| {
                    let mut p = from.p;
                    p[R] *= factor;
                    p
                };
                STEPS.map(step).to_vec()
            } else {
                break;
            };
            for guess in guesses {
                let Ok(found) = interrupted(task.solve(guess, effort))? else { continue };
                let half_swings = found.seen.turns.len();
                match valleys.iter_mut().find(|valley| valley.half_swings == half_swings) {
                    Some(known) if known.optimum.cost <= found.cost => {}
                    Some(known) => known.optimum = found,
                    None => valleys.push(Valley { half_swings, optimum: found }),
                }
            }
            valleys.sort_by(|one, other| one.optimum.cost.total_cmp(&other.optimum.cost));
        }
        Ok(valleys)
    }
}

/// Points beyond the rim of the sticking set: the last half swing falls away, or one more is added.
///
/// Along the valley of r, with all other unknowns following as the linear model has it. Where the residuals
/// are white and even the linear model puts the rim far outside the noise, there is no point worth asking.
fn beyond_the_rim(task: &Task, optimum: &Optimum, verdict: Verdict) -> Vec<Unknowns> {
    /// How far beyond the rim: a part of the way to it, and standard errors.
    const BEYOND: f64 = 0.1;
    const ERRORS: f64 = 0.5;
    /// The farthest rim, in standard errors.
    const FAR: f64 = 30.0;
    let r = optimum.p[R];
    if !optimum.seen.rests || r == 0.0 {
        return Vec::new();
    }
    let Some(way) = way_of_friction(task, optimum) else { return Vec::new() };
    let turns = &optimum.seen.turns;
    let last = turns.iter().rev().take(2);
    let mut guesses = Vec::new();
    for turn in last {
        // How the clearance of this turn changes with r along the valley; by D .. q0, then r itself.
        let change: f64 =
            turn.q_by[..5].iter().zip(&way.along[2..7]).map(|(by, along)| by * along).sum();
        let slope = change * turn.q.signum() - 1.0;
        let step = -(turn.q.abs() - r) / slope;
        if step.is_finite() && (verdict != Verdict::Noise || step.abs() <= FAR * way.error) {
            let step = step + (BEYOND * step.abs() + ERRORS * way.error).copysign(step);
            let p: Unknowns =
                std::array::from_fn(|place| optimum.p[place] + step * way.along[place]);
            if p[R] > 0.0 {
                guesses.push(p);
            }
        }
    }
    guesses
}

/// How all unknowns follow a change of r, and the standard error of r.
struct WayOfFriction {
    along: Unknowns,
    error: f64,
}

fn way_of_friction(task: &Task, optimum: &Optimum) -> Option<WayOfFriction> {
    let mut columns = task.columns();
    // With r as the last column the factor's last row says how well r is known when all else follows.
    columns.retain(|&column| column != R);
    columns.push(R);
    let factor = task.factor(&optimum.seen, &columns);
    let last = columns.len() - 1;
    let inner = factor.view((0, 0), (last, last)).into_owned();
    let follow =
        inner.solve_upper_triangular(&(-factor.view((0, last), (last, 1)).into_owned()))?;
    let mut along = [0.0; UNKNOWNS];
    for (&column, value) in columns.iter().zip(follow.iter()) {
        along[column] = *value;
    }
    along[R] = 1.0;
    #[expect(clippy::cast_precision_loss, reason = "a count of samples")]
    let deviation = (optimum.cost / optimum.seen.residuals.len().max(1) as f64).sqrt();
    let error = deviation / factor[(last, last)].abs();
    error.is_finite().then_some(WayOfFriction { along, error })
}
