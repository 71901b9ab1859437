//! Motions and cycles, of the paper's oscillator or of a machine by the whole model, drawn in the units of the former,
//! so that every view that draws the one draws the other.

use crate::flow::trajectory::trajectory;
use crate::flow::{Detail, Limits, Method, MotionUnits, Problem, Reason, Trajectory, follow};
use crate::model::{Belt, Model, Parameters};
use crate::portrait::{Cycles, Margin, Portrait, picture_reach};

/// A motion with `between` points between the ends of each step: of the paper's oscillator, or of a machine by the whole
/// model.
pub fn motion(
    problem: &Problem,
    machine: Option<&Belt>,
    between: u16,
    limits: &Limits,
) -> Result<Trajectory, Reason> {
    let Some(belt) = machine else {
        // Without friction, nothing happens at v = 0, so crossings are not located.
        let crossings = problem.parameters.r > 0.0;
        let detail = Detail { crossings, samples_per_step: between.into(), energy: true };
        return Ok(trajectory(problem, detail, limits));
    };
    let model = Model::new(belt)?;
    if !problem.method.follows_machines() {
        let needs =
            "to know both switching lines of a machine, as auto, taylor, dop853 and dopri5 do";
        return Err(Reason::NotApplicable { needs });
    }
    let units = MotionUnits::of_paper(&model);
    let detail =
        Detail { samples_per_step: usize::from(between) + 1, energy: true, ..Detail::default() };
    let mut found = follow(&model, problem, units, detail);
    if found.ledger.is_none() {
        let by_series = Problem { method: Method::Taylor, ..*problem };
        let detail = Detail { samples_per_step: 0, ..detail };
        found.ledger = follow(&model, &by_series, units, detail).ledger;
    }
    Ok(found)
}

/// The cycles with their curves, `points` on each step, and the border of the basin: of the paper's oscillator, or of a
/// machine by the `whole` model or by its cubic expansion; beside them its margins by both, without units: every kick is
/// survived where the expansion has no answer.
pub fn cycles(
    parameters: &Parameters,
    machine: Option<&Belt>,
    whole: bool,
    points: u16,
    limits: &Limits,
) -> Result<(Cycles, Option<[Margin; 2]>), Reason> {
    let expansion = Portrait::of_oscillator(parameters, picture_reach(parameters.d2), limits);
    let Some(belt) = machine else { return Ok((expansion?.drawn(parameters, points)?, None)) };
    let found = Portrait::of_belt(belt);
    let expanded = expansion.as_ref().map_or(Margin::ENDLESS, |found| found.margin);
    let margins = found.as_ref().map(|found| [found.in_drawing(&found.margin), expanded]).ok();
    let shown = if whole { found } else { expansion };
    Ok((shown?.drawn(parameters, points)?, margins))
}
