//! One point of a scan: each computation that its measures need, once.

use super::table::{CYCLES, Conditions, Measure, MeasureNeed, Value, needs_of};
use crate::branch::escape::escape_point;
use crate::branch::fold::fold;
use crate::branch::special::FoldPoint;
use crate::flow::trajectory::trajectory;
use crate::flow::{Cost, Detail, Limits, Outcome, Problem, Reason, Trajectory};
use crate::model::State;
use crate::numerics::Interval;
use crate::portrait::basin::cycle::cycles_and_closings;
use crate::portrait::basin::stability::Share;
use crate::portrait::basin::{Basin, Window};
use crate::portrait::closing::all::{STEP, innermost_closing};
use crate::portrait::closing::equation::Equation;
use crate::portrait::closing::pair::Closing;
use crate::portrait::design::{FrictionNeeded, friction_for};
use crate::portrait::guarantee::oscillator::{Uncertain, guaranteed};
use crate::portrait::kicks::repeated::{Repeated, repeated};
use crate::portrait::proved::proved;
use crate::portrait::{Border, Cycle, Cycles, Margin, RestMargin};
use crate::proof::Proof;

/// What was computed at a point; `None` for what no measure needed.
#[derive(Clone, Debug, Default)]
pub struct ScanPoint {
    motion: Option<Trajectory>,
    cycles: Option<Cycles>,
    /// Those of the cycles, for the edge.
    closings: Option<Vec<Closing>>,
    edge: Option<Basin>,
    fold: Option<FoldPoint>,
    escape: Option<f64>,
    guaranteed: Option<Margin>,
    settling: Option<Settling>,
    repeated: Option<Repeated>,
    proof: Option<Proof>,
    needed: Option<FrictionNeeded>,
    pub cost: Cost,
    /// What could not be computed, and why.
    pub failures: Vec<(MeasureNeed, Reason)>,
    /// Why nothing is guaranteed.
    pub uncertain: Option<Uncertain>,
}

/// Fills the columns of these measures at a point, in their order. What could not be computed is [`Value::Nothing`],
/// and [`ScanPoint::failures`] says why. Fails with [`Reason::Interrupted`], and no other.
pub fn measure(
    problem: &Problem,
    measures: &[Measure],
    conditions: &Conditions,
    limits: &Limits,
) -> Result<(Vec<Value>, ScanPoint), Reason> {
    let mut point = ScanPoint::default();
    // The edge has to be followed as far as the window or the kicks reach only if these matter.
    let far = [(Measure::Stability, conditions.reach()), (Measure::Lost, conditions.kicks.reach())];
    let reaches = far.iter().filter(|(measure, _)| measures.contains(measure));
    let reach = reaches.map(|(_, reach)| *reach).fold(0.0, f64::max);
    for need in needs_of(measures) {
        match point.compute(need, problem, (conditions, reach), limits) {
            Ok(()) => {}
            Err(Reason::Interrupted) => return Err(Reason::Interrupted),
            Err(reason) => point.failures.push((need, reason)),
        }
    }
    let values = measures.iter().flat_map(|&measure| point.columns(measure, conditions)).collect();
    Ok((values, point))
}

impl ScanPoint {
    fn compute(
        &mut self,
        need: MeasureNeed,
        problem: &Problem,
        (conditions, reach): (&Conditions, f64),
        limits: &Limits,
    ) -> Result<(), Reason> {
        let parameters = &problem.parameters;
        match need {
            MeasureNeed::Motion => {
                let motion = trajectory(problem, Detail::default(), limits);
                self.cost += motion.cost;
                let outcome = motion.outcome;
                self.motion = Some(motion);
                if let Outcome::GaveUp { reason, .. } = outcome {
                    return Err(reason);
                }
            }
            MeasureNeed::Cycles => {
                let (found, closings) = cycles_and_closings(parameters, limits)?;
                self.cost += found.cost;
                (self.cycles, self.closings) = (Some(found), Some(closings));
            }
            MeasureNeed::Edge => {
                // What is beyond the edge does not matter here.
                let inner = if let Some(closings) = self.closings.take() {
                    closings.into_iter().next()
                } else {
                    let mut equation = Equation::new(parameters, STEP);
                    let inner = innermost_closing(&mut equation, limits);
                    self.cost += equation.cost();
                    inner?
                };
                let basin = Basin::around(parameters, inner.as_slice(), reach, limits)?;
                self.cost += basin.cost;
                self.edge = Some(basin);
            }
            MeasureNeed::Fold => {
                let (found, cost) = fold(parameters, limits)?;
                self.cost += cost;
                self.fold = found;
            }
            MeasureNeed::Escape => {
                let (found, cost) = escape_point(parameters, limits)?;
                self.cost += cost;
                self.escape = found;
            }
            MeasureNeed::Guarantee => {
                let known = conditions.around(parameters);
                let (found, cost) = guaranteed(&known, conditions.disturbance, limits)?;
                self.cost += cost;
                self.guaranteed = Some(found.margin);
                self.uncertain = found.reason;
            }
            MeasureNeed::Settling => {
                let cost = &mut self.cost;
                let found = Settling::of(&conditions.window, |initial| {
                    let problem = Problem { initial, ..*problem };
                    let motion = trajectory(&problem, Detail::default(), limits);
                    *cost += motion.cost;
                    match motion.outcome {
                        Outcome::Captured { tau, .. } => Ok(Some(tau)),
                        Outcome::GaveUp { reason, .. } => Err(reason),
                        Outcome::Moving { .. } | Outcome::Escaped { .. } => Ok(None),
                    }
                });
                self.settling = Some(found?);
            }
            MeasureNeed::Proof => {
                if self.cycles.is_none() {
                    self.compute(MeasureNeed::Cycles, problem, (conditions, reach), limits)?;
                }
                let differ =
                    |_| Reason::NotApplicable { needs: "a search that agrees with its proof" };
                let found = self.cycles.as_ref().map(proved).transpose().map_err(differ)?;
                self.proof = found;
            }
            MeasureNeed::Design => {
                let Some((kick, wanted)) = conditions.wanted else { return Ok(()) };
                let found = friction_for(parameters, kick, wanted, limits)?;
                self.cost += found.cost;
                self.needed = Some(found.needed);
            }
            // Without friction there is no set of places to rest.
            MeasureNeed::Chain if parameters.r == 0.0 => {}
            MeasureNeed::Chain => {
                let found = repeated(parameters, &conditions.kicks, limits)?;
                self.cost += found.cost;
                self.repeated = Some(found);
            }
        }
        Ok(())
    }

    /// Why cells are empty, a sentence for each computation.
    pub fn reasons(&self) -> Vec<String> {
        let failed = |(need, reason): &(MeasureNeed, Reason)| format!("{}: {reason}", need.name());
        let uncertain = self.uncertain.iter().map(|why| format!("guaranteed: {why}"));
        self.failures.iter().map(failed).chain(uncertain).collect()
    }

    /// The cells of a measure, as many as it has columns.
    fn columns(&self, measure: Measure, conditions: &Conditions) -> Vec<Value> {
        let portrayed = Portrayed {
            cycles: self.cycles.as_ref().map(|found| &found.cycles[..]),
            margin: self.edge.as_ref().map(Basin::margin),
            border: self.edge.as_ref().map(|basin| basin.border),
            guaranteed: self.guaranteed,
            needed: self.needed,
            settling: self.settling.as_ref(),
        };
        match measure {
            Measure::Outcome => self.outcome().to_vec(),
            Measure::Rest => match self.motion.as_ref().map(|motion| motion.outcome) {
                Some(Outcome::Captured { tau, q }) => vec![q.into(), tau.into()],
                _ => vec![Value::Nothing; 2],
            },
            Measure::Stability => {
                part(self.edge.as_ref().map(|basin| basin.captured_share(&conditions.window)))
            }
            Measure::Lost => part(self.edge.as_ref().map(|basin| conditions.kicks.lost(basin))),
            Measure::Integrity => {
                let radius = self.edge.as_ref().and_then(Basin::inner_radius);
                let integrity = self.edge.as_ref().and_then(Basin::integrity);
                vec![radius.into(), integrity.into()]
            }
            Measure::Repeated => chain(self.repeated.as_ref()),
            Measure::Area => vec![self.edge.as_ref().and_then(Basin::area).into()],
            Measure::Fold => {
                let fold = self.fold;
                vec![fold.map(|fold| fold.d).into(), fold.map(|fold| fold.q_max).into()]
            }
            Measure::Escape => vec![self.escape.into()],
            Measure::Proved => {
                let word = |it: &Proof| Value::Word(if it.is_complete() { "yes" } else { "no" });
                let bounds = |index: usize| {
                    let cycle = self.proof.as_ref().and_then(|it| it.cycles.get(index));
                    let q_max = cycle.and_then(|it| it.enclosure).map(|it| it.q_max);
                    [q_max.map(Interval::lower), q_max.map(Interval::upper)].map(Value::from)
                };
                let proved = self.proof.as_ref().map_or(Value::Nothing, word);
                std::iter::once(proved).chain((0..CYCLES).flat_map(bounds)).collect()
            }
            _ => portrayed.columns(measure),
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
}

/// What is measured of the paper's oscillator and of machines alike; `None` where it is not known.
pub(crate) struct Portrayed<'a> {
    pub cycles: Option<&'a [Cycle]>,
    pub margin: Option<Margin>,
    pub border: Option<Border>,
    pub guaranteed: Option<Margin>,
    pub needed: Option<FrictionNeeded>,
    pub settling: Option<&'a Settling>,
}

impl Portrayed<'_> {
    /// The cells of a measure; nothing of any other.
    pub fn columns(&self, measure: Measure) -> Vec<Value> {
        match measure {
            Measure::Cycles => {
                let extremes = |it: &Cycle| [it.q_min, it.q_max, it.v_min, it.v_max];
                let count = self.cycles.map_or(Value::Nothing, |all| Value::Count(all.len()));
                let cells = self.each_cycle(|cycle| extremes(cycle).map(Value::from));
                std::iter::once(count).chain(cells).collect()
            }
            Measure::Multipliers => self.each_cycle(|cycle| {
                [cycle.period.into(), cycle.multiplier.into(), cycle.log_multiplier.into()]
            }),
            Measure::Margin | Measure::Guaranteed => {
                let known = if measure == Measure::Margin { self.margin } else { self.guaranteed };
                let Margin { displacement, impulse, .. } = known.unwrap_or_default();
                vec![displacement.into(), impulse.into()]
            }
            Measure::FromRest => {
                let RestMargin { displacement, impulse } =
                    self.margin.unwrap_or_default().from_rest;
                vec![displacement.into(), impulse.into()]
            }
            Measure::Border => {
                vec![self.border.map_or(Value::Nothing, |border| Value::Word(border.name()))]
            }
            Measure::Design => vec![self.needed.map(FrictionNeeded::least).into()],
            Measure::Settling => {
                let times = self.settling.and_then(Settling::times);
                [0, 1].map(|index| times.map(|times| times[index]).into()).to_vec()
            }
            Measure::FiniteTime => {
                let rested = self.settling.map(Settling::rested);
                [0, 1].map(|index| rested.map(|rested| rested[index]).into()).to_vec()
            }
            _ => vec![Value::Nothing; measure.spec().columns.len()],
        }
    }

    /// The same cells for each cycle that has columns, nothing where there is no such cycle.
    fn each_cycle<const N: usize>(&self, cells: impl Fn(&Cycle) -> [Value; N]) -> Vec<Value> {
        let found = self.cycles.unwrap_or_default();
        let cell = |index| found.get(index).map_or([Value::Nothing; N], &cells);
        (0..CYCLES).flat_map(cell).collect()
    }
}

/// The cells of repeated kicks.
pub(crate) fn chain(chain: Option<&Repeated>) -> Vec<Value> {
    let column = |of: fn(&Repeated) -> f64| Value::from(chain.map(of));
    vec![column(|it| it.mean), column(|it| it.later), column(|it| it.error)]
}

/// The cells of a fraction.
pub(crate) fn part(share: Option<Share>) -> Vec<Value> {
    vec![share.map(|share| share.part).into(), share.map(|share| share.error).into()]
}

// How long starts over a window take to come to rest.

/// Starts along each side of the window, evenly spaced in the middles of as many cells.
const SIDE: u16 = 32;

/// When the starts of a window come to rest.
#[derive(Clone, Debug)]
pub struct Settling {
    /// Row by row; `None` for a start that is not at rest in the end.
    times: Vec<Option<f64>>,
}

impl Settling {
    /// Asks when the motion from each start is at rest, if it is in the end. Fails with why one of them was given up.
    pub fn of<Why>(
        window: &Window,
        mut rests: impl FnMut(State) -> Result<Option<f64>, Why>,
    ) -> Result<Self, Why> {
        let cell = |(from, to): (f64, f64), index: u16| {
            from + (to - from) * (f64::from(index) + 0.5) / f64::from(SIDE)
        };
        let starts = (0..SIDE).flat_map(|row| (0..SIDE).map(move |column| (row, column)));
        let times = starts.map(|(row, column)| {
            rests(State { q: cell(window.q, column), v: cell(window.v, row) })
        });
        Ok(Settling { times: times.collect::<Result<_, _>>()? })
    }

    /// Largest and mean time to rest; `None` where a start is not at rest in the end.
    pub fn times(&self) -> Option<[f64; 2]> {
        let times: Vec<f64> = self.times.iter().copied().collect::<Option<_>>()?;
        let largest = times.iter().copied().fold(0.0, f64::max);
        let mean = times.iter().sum::<f64>() / f64::from(SIDE * SIDE);
        Some([largest, mean])
    }

    /// The fraction of the starts that is at rest in the end, and how much that may differ from the fraction of the
    /// window: half of the cells that have a neighbour of the other kind.
    pub fn rested(&self) -> [f64; 2] {
        let side = usize::from(SIDE);
        let rests = |row: usize, column: usize| self.times[row * side + column].is_some();
        let (mut resting, mut divided) = (0_u16, 0_u16);
        for row in 0..side {
            for column in 0..side {
                let here = rests(row, column);
                resting += u16::from(here);
                let differs = |other: Option<usize>, line: bool| {
                    let other = other.filter(|index| *index < side);
                    other.is_some_and(|at| {
                        here != if line { rests(at, column) } else { rests(row, at) }
                    })
                };
                let edge = differs(row.checked_sub(1), true)
                    || differs(Some(row + 1), true)
                    || differs(column.checked_sub(1), false)
                    || differs(Some(column + 1), false);
                divided += u16::from(edge);
            }
        }
        let part = |count: u16| f64::from(count) / f64::from(SIDE * SIDE);
        [part(resting), 0.5 * part(divided)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{Knob, Parameters, State};
    use crate::portrait::basin::Window;
    use crate::portrait::design::Kick;
    use crate::scan::measure::MEASURES;

    const WINDOW: Window = Window { q: (-3.0, 3.0), v: (-3.0, 3.0) };

    fn problem(d: f64, d2: f64, d3: f64, r: f64) -> Problem {
        Problem { parameters: Parameters { d, d2, d3, r }, ..Problem::default() }
    }

    fn measured(problem: &Problem, measures: &[Measure]) -> (Vec<Value>, ScanPoint) {
        measure(problem, measures, &WINDOW.into(), &Limits::PATIENT).unwrap()
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
            // The chain of kicks follows ten thousands of motions; it has its own tests.
            let rows = MEASURES.iter().filter(|row| row.needs != MeasureNeed::Chain);
            let measures: Vec<_> = rows.clone().map(|row| row.measure).collect();
            let conditions =
                Conditions { wanted: Some((Kick::Displacement, 0.5)), ..WINDOW.into() };
            let (values, point) =
                measure(&problem, &measures, &conditions, &Limits::PATIENT).unwrap();
            assert_eq!(values.len(), rows.map(|row| row.columns.len()).sum::<usize>());
            assert!(point.failures.is_empty(), "{problem:?}: {:?}", point.failures);
            assert!(values.iter().all(|value| value.number().is_none_or(f64::is_finite)));
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
        // The edge is one of the cycles: beside them only its two arcs are followed.
        let [both, cycles] = [&[Measure::Margin, Measure::Cycles][..], &[Measure::Cycles]]
            .map(|it| cost(it).evaluations);
        assert!(both < cycles + 800, "{both} {cycles}");
        let mut sum = cost(&[Measure::Cycles]);
        sum += cost(&[Measure::Rest]);
        let all = [Measure::Cycles, Measure::Rest, Measure::Multipliers, Measure::Outcome];
        assert_eq!(cost(&all), sum);
    }

    #[test]
    fn a_guaranteed_margin_is_that_of_the_worst_and_says_where_there_is_none() {
        let problem = problem(-0.3, 0.2, 0.5, 0.1);
        let at = |conditions: &Conditions| {
            measure(&problem, &[Measure::Guaranteed], conditions, &Limits::PATIENT).unwrap()
        };
        let mut conditions = Conditions { disturbance: 0.02, ..WINDOW.into() };
        let (values, point) = at(&conditions);
        // Computed elsewhere.
        assert!((values[0].number().unwrap() - 0.1743).abs() < 5e-5 && point.uncertain.is_none());
        conditions.half_widths.push((Knob::R, 0.09));
        let (values, point) = at(&conditions);
        assert_eq!(values, [Value::Nothing; 2]);
        assert!(point.uncertain.is_some() && point.failures.is_empty());
    }

    #[test]
    fn a_circle_fills_a_part_of_the_basin_and_the_starts_settle_where_there_is_no_border() {
        let linear = problem(-0.1, 0.0, 0.0, 0.1);
        let (values, _) =
            measured(&linear, &[Measure::Integrity, Measure::Area, Measure::Settling]);
        let [radius, integrity, area] = [0, 1, 2].map(|index| values[index].number().unwrap());
        let filled = std::f64::consts::PI * radius * radius / area;
        assert!((integrity - filled).abs() < 1e-12 && (0.9..1.0).contains(&integrity));
        assert_eq!(values[3..], [Value::Nothing; 2], "the window reaches out of the basin");
        let mut damped = problem(0.1, 0.0, 0.0, 0.1);
        damped.until = 200.0;
        let (values, _) = measured(&damped, &[Measure::Settling, Measure::FiniteTime]);
        let [largest, mean, part, error] =
            [0, 1, 2, 3].map(|index| values[index].number().unwrap());
        assert!(mean < largest && largest < 30.0 && part == 1.0 && error == 0.0);
        damped.until = mean;
        let (values, _) = measured(&damped, &[Measure::Settling, Measure::FiniteTime]);
        assert_eq!(values[0], Value::Nothing);
        assert!((0.2..0.8).contains(&values[2].number().unwrap()));
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
        let ended =
            measure(&problem(-0.1, 0.1, 0.1, 0.1), &[Measure::Margin], &WINDOW.into(), &limits);
        assert_eq!(ended.unwrap_err(), Reason::Interrupted);
    }
}
