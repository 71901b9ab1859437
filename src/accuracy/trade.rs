//! What accuracy costs: every method over its tolerances, steps or widths on one and the same motion.
//!
//! Each row is a motion with its measured error ([`super::reference`]) and its counted cost; seconds are
//! added by the caller that has a clock. The front are the rows that no other row beats in both.

use super::{Deviation, NoComparison, Reference};
use crate::flow::{
    Cost, Detail, Limits, METHODS, Method, Motion, Outcome, Problem, Reason, Result,
};
use crate::model::{FINEST, Knob, Model};
use crate::numerics::{amount, by_number, ln, log10};

/// Tolerances, one for each digit.
const TOLERANCES: [f64; 14] =
    [1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12, 1e-13, 1e-14, 1e-15];

/// Lengths of fixed steps, two for each digit.
const STEPS: [f64; 8] = [0.3, 0.1, 0.03, 0.01, 3e-3, 1e-3, 3e-4, 1e-4];

/// Velocities over which friction is smoothed.
const EPSILONS: [f64; 6] = [1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6];

/// The smoothed motion is integrated so much better than smoothing changes it; a better integration
/// would cost more and win nothing.
const INTEGRATION: f64 = 1e-2;

/// Evaluations that one row may cost: some tenths of a second.
const MOST: u64 = 20_000_000;

/// One method at one accuracy.
#[derive(Clone, Debug, PartialEq)]
pub struct TradePoint {
    /// The question, with method, tolerance, step and epsilon.
    pub problem: Problem,
    /// The method that answered; another than asked for only with `auto`.
    pub method: Method,
    /// How it ended.
    pub outcome: Outcome,
    /// How far it is from the reference.
    pub deviation: Result<Deviation, NoComparison>,
    /// How many turning points, or changes of the sign of v, it has.
    pub turns: usize,
    pub cost: Cost,
    /// What it took, measured by the caller that has a clock; 0 without one.
    pub seconds: f64,
}

/// Every method over its tolerances on one motion.
#[derive(Clone, Debug, PartialEq)]
pub struct Trade {
    /// The motion; its method and tolerance are those of the row that is marked.
    pub problem: Problem,
    /// What the errors are measured against.
    pub reference: Reference,
    /// The rows, by method and from coarse to fine.
    pub rows: Vec<TradePoint>,
}

/// The accuracies at which a method is tried, from coarse to fine, the problem's own among them.
fn ladder(problem: &Problem, method: Method) -> Vec<Problem> {
    let closed = method == Method::Auto && problem.parameters.is_piecewise_linear();
    let numbers: &[f64] = match method.spec().dial {
        // The closed form has no tolerance, whatever chose it.
        Some(Knob::Step) => &STEPS,
        Some(Knob::Epsilon) => &EPSILONS,
        Some(_) if !closed => &TOLERANCES,
        _ => &[problem.tolerance],
    };
    let rung = |number: &f64| {
        let rung = Problem { method, ..*problem }.with_setting(*number);
        let smoothed = method.dial() == Knob::Epsilon;
        if smoothed {
            Problem { tolerance: INTEGRATION * number, ..rung }
        } else {
            rung
        }
    };
    let mut rungs: Vec<Problem> = numbers.iter().map(rung).collect();
    if method == problem.method && rungs.iter().all(|rung| rung.setting() != problem.setting()) {
        rungs.push(*problem);
        rungs.sort_by(by_number(|rung: &Problem| -rung.setting()));
    }
    rungs
}

impl TradePoint {
    /// Judges a computed motion.
    pub fn new(found: &Motion, reference: &Reference) -> Self {
        TradePoint {
            problem: found.problem,
            method: found.method,
            outcome: found.outcome,
            deviation: reference.compare(found),
            turns: found.crossings.len(),
            cost: found.cost,
            seconds: 0.0,
        }
    }

    /// The error, where there is one.
    pub fn error(&self) -> Option<f64> {
        self.deviation.ok().map(|deviation| deviation.error)
    }

    /// The decimal logarithms of evaluations and error; `None` where one of them is none or zero.
    pub fn place(&self) -> Option<(f64, f64)> {
        let place = (log10(self.evaluations()), log10(self.error()?));
        (place.0.is_finite() && place.1.is_finite()).then_some(place)
    }

    /// Its evaluations, as a cost that can be compared.
    pub fn evaluations(&self) -> f64 {
        amount(self.cost.evaluations)
    }

    /// Whether the motion ends as it should: right kind of outcome, right number of half swings.
    pub fn agrees(&self) -> bool {
        self.deviation.is_ok_and(|deviation| deviation.agrees)
    }
}

impl Trade {
    /// Computes every row: of all methods, or of those that know a `machine`, whose motion is in SI units.
    ///
    /// A method that gives up for want of budget is not asked for more digits. Fails with [`Reason`] where there is
    /// no reference, or when interrupted.
    pub fn of(machine: Option<&Model>, problem: &Problem, limits: &Limits) -> Result<Self> {
        let reference = Reference::of(machine, problem, limits)?;
        let mut rows = Vec::new();
        let bounded = limits.up_to(MOST);
        // Of a machine, `auto` is another name for the series, whose finest tolerance is the reference itself.
        let told = |method: Method| method != Method::Auto && method.follows_machines();
        let methods = METHODS.iter().map(|spec| spec.method);
        for method in methods.filter(|method| machine.is_none() || told(*method)) {
            let rungs = ladder(problem, method).into_iter();
            for rung in rungs.filter(|rung| machine.is_none() || rung.tolerance > FINEST) {
                let found = rung.followed(machine, Detail::default(), &bounded);
                let row = TradePoint::new(&found, &reference);
                let deviation = row.deviation;
                rows.push(row);
                match deviation {
                    Err(NoComparison::GaveUp(end @ Reason::Interrupted)) => return Err(end),
                    Err(NoComparison::GaveUp(Reason::Budget { .. })) => break,
                    _ => {}
                }
            }
        }
        Ok(Trade { problem: *problem, reference, rows })
    }

    /// Which rows stand for the method and tolerance of the problem.
    pub fn is_own(&self, row: &TradePoint) -> bool {
        let (it, own) = (&row.problem, &self.problem);
        it.method == own.method && it.setting() == own.setting()
    }

    /// The row of a problem's method whose accuracy is nearest to the problem's.
    pub fn nearest_to(&self, problem: &Problem) -> Option<&TradePoint> {
        let far = |row: &&TradePoint| ln(row.problem.setting() / problem.setting()).abs();
        let rows = self.rows.iter().filter(|row| row.problem.method == problem.method);
        rows.filter(|row| row.error().is_some()).min_by(by_number(far))
    }

    /// The cost of all rows together.
    pub fn cost(&self) -> Cost {
        let mut sum = self.reference.cost;
        self.rows.iter().for_each(|row| sum += row.cost);
        sum
    }

    /// Whether a row is a best choice when each costs this much.
    ///
    /// No other row that ends as the motion does has a smaller error for the same or less, or the same
    /// error for less. A row that ends otherwise is never among them.
    pub fn is_best(&self, row: &TradePoint, cost: fn(&TradePoint) -> f64) -> bool {
        let judged = |row: &TradePoint| {
            let error = row.error().filter(|_| row.agrees())?;
            Some((error, cost(row)))
        };
        let Some(own) = judged(row) else { return false };
        let beats = |other: (f64, f64)| other.0 <= own.0 && other.1 <= own.1 && other != own;
        !self.rows.iter().filter_map(judged).any(beats)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{Parameters, State};

    fn trade([d, d2, d3, r]: [f64; 4], q: f64, until: f64) -> Trade {
        let problem = Problem {
            parameters: Parameters { d, d2, d3, r },
            initial: State { q, v: 0.0 },
            until,
            ..Problem::default()
        };
        Trade::of(None, &problem, &Limits::PATIENT).unwrap()
    }

    fn rows(trade: &Trade, method: Method) -> Vec<&TradePoint> {
        trade.rows.iter().filter(|row| row.problem.method == method).collect()
    }

    fn best(trade: &Trade, method: Method) -> f64 {
        rows(trade, method).iter().filter_map(|row| row.error()).fold(f64::INFINITY, f64::min)
    }

    #[test]
    fn errors_span_from_a_thousandth_to_rounding() {
        let trade = trade([-0.1, 0.0, 0.05, 0.1], 3.0, 200.0);
        assert!(trade.reference.error < 1e-27, "{:e}", trade.reference.error);
        for method in [Method::Auto, Method::Taylor] {
            let rows = rows(&trade, method);
            assert!(rows[0].error().unwrap() > 1e-3, "{:?}", rows[0]);
            assert!(best(&trade, method) < 2e-14, "{method}: {:e}", best(&trade, method));
        }
        // What controls its error obeys, and a digit more costs a few percent at high order.
        for method in [Method::Taylor, Method::Dop853, Method::Dopri5, Method::Stiff] {
            for row in rows(&trade, method) {
                let (error, tolerance) = (row.error().unwrap(), row.problem.tolerance);
                assert!(error < 400.0 * tolerance + 1e-13, "{method} {tolerance:e}: {error:e}");
            }
        }
        let cost = |row: &TradePoint| row.cost.evaluations;
        let taylor = rows(&trade, Method::Taylor);
        assert!(cost(taylor[13]) < 7 * cost(taylor[0]), "13 digits for 6 times the first");
        // Auto is never costlier than the series by a tenth at the same tolerance from three digits on.
        for (auto, taylor) in rows(&trade, Method::Auto).iter().zip(&taylor).skip(1) {
            assert!(10 * cost(auto) <= 11 * cost(taylor));
        }
    }

    #[test]
    fn what_knows_no_events_rests_in_the_wrong_place_or_never() {
        let trade = trade([-0.1, 0.0, 0.0, 0.5], 2.0, 50.0);
        for row in &trade.rows {
            let events = row.problem.method.spec().events;
            let captured = matches!(row.outcome, Outcome::Captured { .. });
            match row.problem.method {
                Method::SignRk4 => {
                    assert!(!captured && !row.agrees());
                    assert!(row.turns > 100 || row.problem.step > 0.05, "{row:?}");
                    assert!(row.error().unwrap() > 1e-5, "{row:?}");
                }
                Method::Smoothed => {
                    assert!(!captured && !row.agrees());
                    // It creeps: the error is some epsilons at least, the cost grows as 1/epsilon.
                    if let Some(error) = row.error() {
                        assert!(error > row.problem.epsilon, "{row:?}");
                    }
                }
                _ => assert!(captured && (row.agrees() || !events), "{row:?}"),
            }
        }
        assert!(best(&trade, Method::Exact) < 1e-15);
        // The place of sign-rk4 at h = 0.1 is +0.0015 instead of -0.116144.
        let coarse = rows(&trade, Method::SignRk4)[1];
        assert!(matches!(coarse.outcome, Outcome::Moving { q, .. } if (q - 0.0015).abs() < 1e-4));
        assert!(coarse.error().unwrap() > 0.1176, "{coarse:?}");
        let smoothed = rows(&trade, Method::Smoothed);
        let costlier =
            |one: usize| smoothed[one + 1].cost.evaluations > 5 * smoothed[one].cost.evaluations;
        assert!(costlier(1) && costlier(2) && costlier(3));
    }

    #[test]
    fn the_front_has_no_row_that_another_beats_and_none_that_ends_otherwise() {
        let trade = &trade([-0.1, 0.0, 0.0, 0.5], 2.0, 50.0);
        let front = |cost| trade.rows.iter().filter(move |row| trade.is_best(row, cost));
        let chosen: Vec<&TradePoint> = front(TradePoint::evaluations).collect();
        assert!(chosen.iter().any(|row| row.problem.method == Method::Exact));
        assert!(chosen.iter().all(|row| row.agrees()));
        // Three evaluations to the last digit: only what equals them is left.
        assert!(chosen.iter().all(|row| row.method == Method::Exact), "{chosen:?}");
        // If everything cost the same, the smallest error would be best.
        let errors: Vec<f64> = front(|_| 1.0).filter_map(TradePoint::error).collect();
        assert!(!errors.is_empty() && errors.iter().all(|error| *error == errors[0]));
    }

    #[test]
    fn the_method_in_use_has_its_row_whatever_its_tolerance() {
        let problem = Problem {
            parameters: Parameters { d: -0.1, d2: 0.0, d3: 0.05, r: 0.1 },
            initial: State { q: 1.0, v: 0.0 },
            until: 10.0,
            method: Method::Dopri5,
            tolerance: 3e-7,
            ..Problem::default()
        };
        let trade = Trade::of(None, &problem, &Limits::PATIENT).unwrap();
        let own: Vec<&TradePoint> = trade.rows.iter().filter(|row| trade.is_own(row)).collect();
        assert_eq!(own.len(), 1);
        assert_eq!(own[0].problem.tolerance, 3e-7);
        let dopri5 = rows(&trade, Method::Dopri5);
        assert!(
            dopri5.windows(2).all(|pair| pair[0].problem.tolerance > pair[1].problem.tolerance)
        );
        // Nothing is known of a method that does not apply but why.
        assert!(rows(&trade, Method::Exact)[0].deviation.is_err());
    }
}
