//! Computes a motion until it is captured, escapes, reaches its end time or is given up.

use super::auto::Auto;
use super::comparison::TimeStepping;
use super::exact::Exact;
use super::explicit::Explicit;
use super::limits::Limits;
use super::method::Method;
pub use super::motion::{Cost, Crossing, Detail, Outcome, Problem, Sample, Trajectory};
use super::run::MotionRun;
use super::stiff::Stiff;
use super::tableau::{CLASSICAL, DOP853, DOPRI5};
use super::taylor::Taylor;
use crate::model::{HalfPlane, Reason, Side};

/// Computes a motion.
///
/// Guarantee: the result is one of the typed outcomes, and no number in it is NaN. With the methods that find
/// events, the place and time of every crossing carry the errors of the previous steps, each of relative size
/// `tolerance`.
#[must_use]
pub fn trajectory(problem: &Problem, detail: Detail, limits: &Limits) -> Trajectory {
    let Problem { parameters, tolerance, step, epsilon, .. } = *problem;
    let linear = parameters.is_piecewise_linear();
    let field = HalfPlane::new(&parameters, Side::Upper);
    let run = |method| MotionRun::new(problem, method, detail, limits);
    let asked = run(problem.method);
    match problem.method {
        Method::Auto | Method::Exact if linear => run(Method::Exact).go(&mut Exact::new()),
        Method::Exact => asked.give_up(Reason::NotApplicable { needs: "D2 = D3 = 0" }),
        Method::Auto => {
            let mut stepper = Auto::new(tolerance);
            let mut found = run(Method::Taylor).go(&mut stepper);
            found.implicit_steps = stepper.implicit_steps;
            if 2 * found.implicit_steps > found.cost.steps {
                found.method = Method::Stiff;
            }
            found
        }
        Method::Taylor => asked.go(&mut Taylor::new(tolerance)),
        Method::Dop853 => asked.go(&mut Explicit::new(&DOP853, field, tolerance)),
        Method::Dopri5 => asked.go(&mut Explicit::new(&DOPRI5, field, tolerance)),
        Method::Rk4 => asked.go(&mut Explicit::new(&CLASSICAL, field, step)),
        Method::Stiff => asked.go(&mut Stiff::new(field, tolerance)),
        Method::Smoothed => {
            asked.walk(Some(epsilon), false, |field| Explicit::new(&DOP853, field, tolerance))
        }
        Method::SignRk4 => asked.walk(None, false, |field| Explicit::new(&CLASSICAL, field, step)),
        Method::TimeStepping => asked.walk(None, true, |field| TimeStepping::new(field, step)),
    }
}

/// Why this method was chosen, in a short sentence; `None` where it was requested by name.
#[must_use]
pub fn choice(found: &Trajectory) -> Option<String> {
    if found.problem.method != Method::Auto {
        return None;
    }
    let (implicit, steps) = (found.implicit_steps, found.cost.steps);
    Some(match found.method {
        Method::Exact => "exact: D2 = D3 = 0 has a closed form".to_owned(),
        _ if steps == 0 => "nothing to integrate".to_owned(),
        _ if implicit == 0 => "taylor: accuracy limits its steps, stability none".to_owned(),
        _ => format!("stiff for {implicit} of {steps} steps, where stability would limit taylor"),
    })
}

#[cfg(test)]
mod tests;
