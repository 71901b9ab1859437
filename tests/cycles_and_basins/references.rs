//! Motions and cycles against reference values with at least twelve digits, computed independently.

use crate::data::references;
use hopfscope::flow::trajectory::trajectory;
use hopfscope::flow::{Detail, Limits, Method, Motion, Outcome, Problem};
use hopfscope::model::{Parameters, State};
use hopfscope::portrait::Cycle;
use hopfscope::portrait::basin::cycle::cycles;
use hopfscope::session::motion::{friction_force, turning_points};
use serde::Deserialize;

/// A motion of `data/trajectories.json`, followed until tau = 200 or capture.
#[derive(Deserialize)]
struct ReferenceMotion {
    #[serde(flatten)]
    parameters: Parameters,
    q0: f64,
    v0: f64,
    outcome: String,
    turning_points: Vec<(f64, f64)>,
}

fn motions() -> Vec<ReferenceMotion> {
    serde_json::from_str(include_str!("../data/trajectories.json")).unwrap()
}

impl ReferenceMotion {
    /// The computed motion, with its energy ledger.
    fn compute(&self, method: Method, tolerance: f64) -> Motion {
        let problem = Problem {
            parameters: self.parameters,
            initial: State { q: self.q0, v: self.v0 },
            until: 200.0,
            method,
            tolerance,
            ..Problem::default()
        };
        trajectory(&problem, Detail { energy: true, ..Detail::default() }, &Limits::PATIENT)
    }

    /// The methods that apply to it.
    fn methods(&self) -> Vec<Method> {
        let mut methods = vec![Method::Auto, Method::Taylor, Method::Dop853];
        if self.parameters.is_piecewise_linear() {
            methods.push(Method::Exact);
        }
        methods
    }
}

/// Largest error in q over the turning points, relative to `max(1, abs(q))`.
fn largest_error(motion: &ReferenceMotion, found: &Motion) -> f64 {
    let pairs = motion.turning_points.iter().zip(&found.crossings);
    pairs.map(|(&(_, q), found)| (found.q - q).abs() / q.abs().max(1.0)).fold(0.0, f64::max)
}

#[test]
fn turning_points_agree_to_ten_digits_at_tolerance_one_in_ten_to_the_twelve() {
    for motion in motions() {
        for method in motion.methods() {
            let found = motion.compute(method, 1e-12);
            let case = format!("{method}, {:?} from {}", motion.parameters, motion.q0);
            assert_eq!(found.crossings.len(), motion.turning_points.len(), "{case}");
            let error = largest_error(&motion, &found);
            assert!(error <= 1e-10, "{case}: error {error:e}");
            for (&(tau, _), found) in motion.turning_points.iter().zip(&found.crossings) {
                assert!((found.tau / tau - 1.0).abs() <= 1e-10, "{case}: {} for {tau}", found.tau);
            }
        }
    }
}

#[test]
fn outcomes_agree_and_a_capture_is_the_last_arrival() {
    for motion in motions() {
        for method in motion.methods() {
            let found = motion.compute(method, 1e-12);
            match (motion.outcome.as_str(), found.outcome) {
                ("captured", Outcome::Captured { tau, q }) => {
                    let last = found.crossings.last().unwrap();
                    assert_eq!((tau, q), (last.tau, last.q));
                    assert!(
                        q.abs() <= motion.parameters.r,
                        "at rest outside the sticking set: {q}"
                    );
                }
                ("moving", Outcome::Moving { tau, .. }) => assert_eq!(tau, 200.0),
                (expected, found) => panic!("{method}: {found:?} for {expected}"),
            }
        }
    }
}

#[test]
fn a_tighter_tolerance_is_a_smaller_error() {
    // The motion of the benchmark, with 63 half swings.
    let motions = motions();
    let motion = motions.iter().find(|motion| motion.parameters.d3 == 0.05).unwrap();
    for (method, limit) in [(Method::Taylor, 1e-12), (Method::Dop853, 1e-11)] {
        let [coarse, middle, fine] = [1e-4, 1e-8, 1e-12]
            .map(|tolerance| largest_error(motion, &motion.compute(method, tolerance)));
        assert!(coarse > middle && middle > fine, "{method}: {coarse:e} {middle:e} {fine:e}");
        assert!(coarse < 1e-1 && middle < 1e-6 && fine < limit, "{coarse:e} {middle:e} {fine:e}");
    }
}

#[test]
fn the_energy_ledger_closes_to_eleven_digits_of_the_start() {
    for motion in motions() {
        for method in motion.methods().into_iter().filter(|method| *method != Method::Dop853) {
            let ledger = motion.compute(method, 1e-12).ledger.expect("no motion escapes");
            let missing = ledger.residual.abs() / ledger.start;
            assert!(missing <= 1e-11, "{method}, {:?}: {missing:e}", motion.parameters);
        }
    }
}

/// At the same tolerance the explicit pair has the larger error: one of the motions above starts with a
/// fraction of the energy that passes through it in 63 half swings, and its balance is off by 5e-11 of that fraction.
#[test]
fn the_explicit_pair_closes_it_to_eleven_digits_of_what_went_through() {
    for motion in motions() {
        let ledger = motion.compute(Method::Dop853, 1e-12).ledger.expect("no motion escapes");
        let through = ledger.start + ledger.works.iter().map(|work| work.amount.abs()).sum::<f64>();
        assert!(ledger.residual.abs() <= 1e-11 * through, "{:?}: {ledger:?}", motion.parameters);
    }
}

/// Where a long displacement swallows a short way, the work of friction still has all its digits.
#[test]
fn friction_takes_the_energy_of_a_light_push_far_out() {
    let (r, q, v) = (1e6, 50.0, 1e-3);
    let parameters = Parameters { d: 0.1, d2: 0.0, d3: 0.5, r };
    let problem = Problem { parameters, initial: State { q, v }, ..Problem::default() };
    let detail = Detail { energy: true, ..Detail::default() };
    let ledger = trajectory(&problem, detail, &Limits::PATIENT).ledger.unwrap();
    let friction = ledger.works.last().unwrap();
    let exact = -r * v * v / (2.0 * (q + r));
    assert!((friction.amount / exact - 1.0).abs() < 1e-8, "{friction:?}, exactly {exact}");
}

fn relative(found: f64, expected: f64) -> f64 {
    (found / expected - 1.0).abs()
}

#[test]
fn cycles_agree_to_ten_digits_and_their_multipliers_to_seven() {
    for reference in references() {
        let found = cycles(&reference.parameters, &Limits::PATIENT).unwrap().cycles;
        let apart = |cycle: &Cycle| relative(cycle.q_max, reference.q_max);
        let cycle = found
            .iter()
            .min_by(|a, b| apart(a).total_cmp(&apart(b)))
            .unwrap_or_else(|| panic!("no cycle at {:?}", reference.parameters));
        for (what, found, expected) in [
            ("q_max", cycle.q_max, reference.q_max),
            ("q_min", cycle.q_min, reference.q_min),
            ("v_max", cycle.v_max, reference.v_max),
            ("v_min", cycle.v_min, reference.v_min),
            ("period", cycle.period, reference.period),
        ] {
            let error = relative(found, expected);
            assert!(error <= 1e-10, "{what} at {:?}: {error:e}", reference.parameters);
        }
        let multiplier = cycle.multiplier.unwrap();
        assert!(relative(multiplier, reference.multiplier) <= 1e-7, "{multiplier}");
        assert_eq!(cycle.stable, reference.multiplier < 1.0);
    }
}

#[test]
fn there_are_no_other_cycles_than_the_reference_ones() {
    let references = references();
    for reference in &references {
        let known =
            references.iter().filter(|other| other.parameters == reference.parameters).count();
        let found = cycles(&reference.parameters, &Limits::PATIENT).unwrap().cycles;
        assert_eq!(found.len(), known, "{:?}", reference.parameters);
        assert!(found.windows(2).all(|pair| pair[0].q_max < pair[1].q_max));
    }
}

const BRAKED: Parameters = Parameters { d: 0.02, d2: 0.1, d3: 0.05, r: 0.125 };
const START: State = State { q: 1.5, v: 0.0 };

fn followed(parameters: Parameters, initial: State, method: Method) -> Motion {
    let problem = Problem { parameters, initial, method, until: 30.0, ..Problem::default() };
    let crossings = parameters.r > 0.0;
    let detail = Detail { crossings, samples_per_step: 16, energy: true };
    trajectory(&problem, detail, &Limits::PATIENT)
}

#[test]
fn the_friction_force_lies_between_its_limits_and_jumps_at_the_turning_points() {
    for method in [Method::Taylor, Method::Dop853, Method::Smoothed] {
        let found = followed(BRAKED, START, method);
        let force = friction_force(&found, 30.0);
        assert!(force.iter().all(|(_, force)| force.abs() <= BRAKED.r), "{method}");
        assert!(force.windows(2).all(|pair| pair[0].0 <= pair[1].0), "{method}");
    }
    let found = followed(BRAKED, START, Method::Taylor);
    let force = friction_force(&found, 30.0);
    // The mass first moves to the left: friction pulls fully to the right.
    assert_eq!(force[0], (0.0, BRAKED.r));
    let jumps = force.windows(2).filter(|pair| pair[0].0 == pair[1].0).map(|pair| pair[0].0);
    let turns = found.crossings.iter().map(|crossing| crossing.tau);
    assert_eq!(jumps.clone().count(), found.crossings.len());
    // The time of a sample is computed from that of its step, with one more rounding.
    assert!(jumps.zip(turns).all(|(jump, turn)| (jump / turn - 1.0).abs() <= f64::EPSILON));
    // At rest, friction balances the spring.
    let Outcome::Captured { q, .. } = found.outcome else { panic!("it comes to rest") };
    assert_eq!(force.last(), Some(&(30.0, q)));
}

#[test]
fn turning_points_end_where_the_motion_rests() {
    let found = followed(BRAKED, START, Method::Taylor);
    let points = turning_points(&found);
    assert_eq!(points[0], START.q);
    assert_eq!(points.len(), found.crossings.len() + 1);
    assert!(points.windows(2).all(|pair| pair[1].abs() < pair[0].abs()));
    assert!(points.last().unwrap().abs() <= BRAKED.r);
    assert!(turning_points(&followed(BRAKED, State { q: 0.0, v: 1.0 }, Method::Taylor))[0] > 0.0);
}

#[test]
fn without_friction_turning_points_are_read_off_the_curve() {
    // Undamped, every turning point is as far out as the first one.
    let centre = Parameters { d: 0.0, d2: 0.0, d3: 0.0, r: 0.0 };
    let found = followed(centre, START, Method::Taylor);
    let points = turning_points(&found);
    assert_eq!(points.len(), 10, "nine half turns fit into 30");
    assert!(points.iter().all(|q| (q.abs() - 1.5).abs() < 1e-3), "{points:?}");
}
