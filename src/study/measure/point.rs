//! One point of a scan: each computation that its measures need, once.

use super::{CYCLES, Measure, Need, Value, needs_of};
use crate::flow::trajectory::trajectory;
use crate::flow::{Cost, Detail, Limits, Outcome, Problem, Reason, Trajectory};
use crate::study::basin::{Basin, Window};
use crate::study::closing::Equation;
use crate::study::closings::{STEP, innermost_closing};
use crate::study::cycle::{Cycle, Cycles, cycles};
use crate::study::escape::escape_point;
use crate::study::fold::{FoldPoint, fold};

/// What was computed at a point; `None` for what no measure needed.
#[derive(Clone, Debug, Default)]
pub struct Point {
    motion: Option<Trajectory>,
    cycles: Option<Cycles>,
    edge: Option<Basin>,
    fold: Option<FoldPoint>,
    escape: Option<f64>,
    /// What all of it cost.
    pub cost: Cost,
    /// What could not be computed, and why.
    pub failures: Vec<(Need, Reason)>,
}

/// Fills the columns of these measures at a point, in their order; `window` is that of
/// [`Measure::Stability`]. What could not be computed is [`Value::Nothing`], and [`Point::failures`]
/// says why.
///
/// # Errors
/// [`Reason::Interrupted`], and no other.
pub fn measure(
    problem: &Problem,
    measures: &[Measure],
    window: &Window,
    limits: &Limits,
) -> Result<(Vec<Value>, Point), Reason> {
    let mut point = Point::default();
    // The edge has to be followed as far as the window reaches only if the window matters.
    let windowed = measures.contains(&Measure::Stability);
    let reach = if windowed { window.q.0.abs().max(window.q.1.abs()) } else { 0.0 };
    for need in needs_of(measures) {
        match point.compute(need, problem, reach, limits) {
            Ok(()) => {}
            Err(Reason::Interrupted) => return Err(Reason::Interrupted),
            Err(reason) => point.failures.push((need, reason)),
        }
    }
    let values = measures.iter().flat_map(|&measure| point.columns(measure, window)).collect();
    Ok((values, point))
}

impl Point {
    fn compute(
        &mut self,
        need: Need,
        problem: &Problem,
        reach: f64,
        limits: &Limits,
    ) -> Result<(), Reason> {
        let parameters = &problem.parameters;
        match need {
            Need::Motion => {
                let motion = trajectory(problem, Detail::default(), limits);
                self.cost += motion.cost;
                let outcome = motion.outcome;
                self.motion = Some(motion);
                if let Outcome::GaveUp { reason, .. } = outcome {
                    return Err(reason);
                }
            }
            Need::Cycles => {
                let found = cycles(parameters, false, limits)?;
                self.cost += found.cost;
                self.cycles = Some(found);
            }
            Need::Edge => {
                let mut equation = Equation::new(parameters, STEP);
                // What is beyond the edge does not matter here.
                let inner = innermost_closing(&mut equation, limits)?;
                self.cost += equation.cost();
                let basin = Basin::around(parameters, inner.as_slice(), reach, limits)?;
                self.cost += basin.cost;
                self.edge = Some(basin);
            }
            Need::Fold => {
                let (found, cost) = fold(parameters, limits)?;
                self.cost += cost;
                self.fold = found;
            }
            Need::Escape => self.escape = escape_point(parameters, limits)?,
        }
        Ok(())
    }

    /// The cells of a measure, as many as it has columns.
    fn columns(&self, measure: Measure, window: &Window) -> Vec<Value> {
        match measure {
            Measure::Outcome => self.outcome().to_vec(),
            Measure::Rest => match self.motion.as_ref().map(|motion| motion.outcome) {
                Some(Outcome::Captured { tau, q }) => vec![q.into(), tau.into()],
                _ => vec![Value::Nothing; 2],
            },
            Measure::Cycles => {
                let count = self.cycles.as_ref().map(|found| Value::Count(found.cycles.len()));
                let extremes = |cycle: &Cycle| [cycle.q_min, cycle.q_max, cycle.v_min, cycle.v_max];
                let cells = self.each_cycle(|cycle| extremes(cycle).map(Value::from));
                std::iter::once(count.unwrap_or(Value::Nothing)).chain(cells).collect()
            }
            Measure::Multipliers => self.each_cycle(|cycle| {
                [cycle.period.into(), cycle.multiplier.into(), cycle.log_multiplier.into()]
            }),
            Measure::Margin => {
                let margin = self.edge.as_ref().map(Basin::margin);
                vec![
                    margin.and_then(|margin| margin.displacement).into(),
                    margin.and_then(|margin| margin.impulse).into(),
                ]
            }
            Measure::Stability => {
                let share = self.edge.as_ref().map(|basin| basin.captured_share(window));
                vec![share.map(|share| share.part).into(), share.map(|share| share.error).into()]
            }
            Measure::Area => vec![self.edge.as_ref().and_then(Basin::area).into()],
            Measure::Fold => {
                let fold = self.fold;
                vec![fold.map(|fold| fold.d).into(), fold.map(|fold| fold.q_max).into()]
            }
            Measure::Escape => vec![self.escape.into()],
        }
    }

    fn outcome(&self) -> [Value; 3] {
        let Some(motion) = &self.motion else { return [Value::Nothing; 3] };
        let (word, tau) = match motion.outcome {
            Outcome::Captured { tau, .. } => ("captured", tau.into()),
            Outcome::Moving { tau, .. } => ("moving", tau.into()),
            Outcome::Escaped { tau } => ("escaped", tau.into()),
            Outcome::GaveUp { .. } => {
                return [Value::Word("gave-up"), Value::Nothing, Value::Nothing];
            }
        };
        [Value::Word(word), tau, Value::Count(motion.crossings.len())]
    }

    /// The same cells for each cycle that has columns, nothing where there is no such cycle.
    fn each_cycle<const N: usize>(&self, cells: impl Fn(&Cycle) -> [Value; N]) -> Vec<Value> {
        let found = self.cycles.as_ref().map_or(&[][..], |found| &found.cycles);
        let cell = |index| found.get(index).map_or([Value::Nothing; N], &cells);
        (0..CYCLES).flat_map(cell).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::oscillator::{Parameters, State};
    use crate::study::measure::MEASURES;

    const WINDOW: Window = Window { q: (-3.0, 3.0), v: (-3.0, 3.0) };

    fn problem(d: f64, d2: f64, d3: f64, r: f64) -> Problem {
        Problem { parameters: Parameters { d, d2, d3, r }, ..Problem::default() }
    }

    fn measured(problem: &Problem, measures: &[Measure]) -> (Vec<Value>, Point) {
        measure(problem, measures, &WINDOW, &Limits::PATIENT).unwrap()
    }

    #[test]
    fn every_measure_fills_its_columns_and_no_number_is_none() {
        for problem in [
            problem(-0.1, 0.0, 0.0, 0.1),
            problem(-0.25, 0.2, 0.5, 0.1),
            problem(-0.01, 0.5, 0.0, 0.1),
            problem(0.3, 0.0, -0.5, 0.1),
            problem(-0.2, 0.0, 0.3, 0.0),
            problem(-1.5, 0.0, 0.0, 0.2),
        ] {
            for row in &MEASURES {
                let (values, point) = measured(&problem, &[row.measure]);
                assert_eq!(values.len(), row.columns.len(), "{}", row.name);
                assert!(point.failures.is_empty(), "{}: {:?}", row.name, point.failures);
                for value in values {
                    assert!(value.number().is_none_or(f64::is_finite));
                }
            }
        }
    }

    #[test]
    fn measures_share_what_they_need() {
        let problem = problem(-0.2, 0.2, 0.5, 0.1);
        let cost = |measures: &[Measure]| measured(&problem, measures).1.cost;
        assert_eq!(cost(&[Measure::Cycles, Measure::Multipliers]), cost(&[Measure::Cycles]));
        assert_eq!(cost(&[Measure::Outcome, Measure::Rest]), cost(&[Measure::Outcome]));
        let edge = [Measure::Margin, Measure::Stability, Measure::Area];
        assert_eq!(cost(&edge), cost(&[Measure::Stability]));
        assert!(cost(&[Measure::Margin]).evaluations > 0);
        let mut sum = cost(&[Measure::Cycles]);
        sum += cost(&[Measure::Rest]);
        let all = [Measure::Cycles, Measure::Rest, Measure::Multipliers, Measure::Outcome];
        assert_eq!(cost(&all), sum);
    }

    #[test]
    fn what_is_measured_is_what_the_questions_answer() {
        let problem = problem(-0.2, 0.2, 0.5, 0.1);
        let limits = &Limits::PATIENT;
        let found = cycles(&problem.parameters, true, limits).unwrap();
        let (values, _) = measured(&problem, &[Measure::Cycles, Measure::Margin, Measure::Fold]);
        assert_eq!(values[0], Value::Count(found.cycles.len()));
        assert_eq!(values[2], Value::from(found.cycles[0].q_max));
        let margin = found.picture.unwrap().margin;
        assert_eq!(values[9..11], [margin.displacement.into(), margin.impulse.into()]);
        let fold = fold(&problem.parameters, limits).unwrap().0.unwrap();
        assert_eq!(values[11], Value::from(fold.d));
    }

    #[test]
    fn a_motion_that_cannot_be_followed_says_why_and_leaves_its_cells_empty() {
        let mut stuck = problem(-0.999_999, 0.0, 0.0, 0.0);
        (stuck.initial, stuck.until) = (State { q: 1.0, v: 0.0 }, 1e5);
        let (values, point) = measured(&stuck, &[Measure::Rest, Measure::Outcome]);
        assert_eq!(values[..2], [Value::Nothing; 2]);
        assert_eq!(values[2], Value::Word("gave-up"));
        assert_eq!(point.failures.len(), 1);
        let limits = Limits { interrupted: &|| true, ..Limits::PATIENT };
        let ended = measure(&problem(-0.1, 0.1, 0.1, 0.1), &[Measure::Margin], &WINDOW, &limits);
        assert_eq!(ended.unwrap_err(), Reason::Interrupted);
    }
}
