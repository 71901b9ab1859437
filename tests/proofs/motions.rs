//! Enclosed motions, margins and ranges of parameters, against references computed elsewhere and against the
//! plain computation.

use hopfscope::flow::Limits;
use hopfscope::model::{Border, Knob, Margin, Parameters};
use hopfscope::numerics::Interval;
use hopfscope::numerics::elementary::{exp, powi, sin_cos};
use hopfscope::portrait::Portrait;
use hopfscope::proof::kicks::{ProvedKicks, kicks};
use hopfscope::proof::motion::{ProvedFate, ProvedMotion, follow};
use hopfscope::proof::range::{MOST_STEPS, change_within, range};
use hopfscope::proof::{ParameterBox, prove};
use serde::Deserialize;

#[derive(Deserialize)]
struct Reference {
    #[serde(flatten)]
    parameters: Parameters,
    q0: f64,
    v0: f64,
    outcome: String,
    turning_points: Vec<[f64; 2]>,
}

fn motion(parameters: &Parameters, q: f64, v: f64, until: f64) -> ProvedMotion {
    follow(&ParameterBox::from(parameters), [q, v].map(Interval::point), until)
}

fn near(bounds: Interval, value: f64, within: f64) -> bool {
    bounds.lower() <= value + within && value - within <= bounds.upper()
}

#[test]
fn reference_motions_are_enclosed() {
    let references: Vec<Reference> =
        serde_json::from_str(include_str!("../data/trajectories.json")).unwrap();
    let mut captured = 0;
    for one in &references {
        let Reference { parameters, q0, v0, turning_points, .. } = one;
        // Motions that end on a cycle are followed as far as the reference goes.
        let last = turning_points.last().map_or(0.0, |turn| turn[0]);
        let until = if one.outcome == "captured" { 1e6 } else { last + 0.1 };
        let found = motion(parameters, *q0, *v0, until);
        for (turn, &[tau, q]) in found.turns.iter().zip(turning_points) {
            // The references have about 14 digits.
            assert!(near(turn.tau, tau, 2e-13 * tau), "{parameters:?}: {} {tau}", turn.tau);
            assert!(
                near(turn.q.unwrap(), q, 1e-12 * q0.abs().max(1.0)),
                "{parameters:?}: {} {q}",
                turn.q.unwrap()
            );
        }
        if one.outcome == "captured" {
            captured += 1;
            assert_eq!(found.turns.len(), turning_points.len(), "{parameters:?}");
            assert_eq!(found.fate, ProvedFate::Captured);
        }
    }
    assert!(captured > 3, "{captured}");
}

/// From the closed form: at D = -0.1, r = 0.5 the motion from (2, 0) is at rest after three half swings at q =
/// -0.116144440390138.
#[test]
fn motions_are_followed_to_rest_to_a_time_and_to_their_escape() {
    let linear = Parameters { d: -0.1, d2: 0.0, d3: 0.0, r: 0.5 };
    let found = motion(&linear, 2.0, 0.0, 100.0);
    let (q, tau) = (found.end.q.unwrap(), found.end.tau);
    assert_eq!(found.fate, ProvedFate::Captured);
    assert!(q.contains(-0.116_144_440_390_138) && q.width() < 1e-12 && found.turns.len() == 3);
    assert!(near(tau, 3.0 * std::f64::consts::PI / 0.99_f64.sqrt(), 1e-14));
    // Half way through a half swing: q - r = c e^(-D tau) (cos + D/omega sin), c = 2.5 from (2, 0), below v = 0.
    let found = motion(&linear, 2.0, 0.0, 1.0);
    let (q, v) = (found.end.q.unwrap(), found.end.v.unwrap());
    assert_eq!(found.fate, ProvedFate::Moving);
    let omega = 0.99_f64.sqrt();
    let (sine, cosine) = sin_cos(omega);
    let growth = 1.5 * exp(0.1);
    assert!(near(q, 0.5 + growth * (cosine - 0.1 / omega * sine), 1e-14) && q.width() < 1e-12);
    assert!(near(v, -growth * sine / omega, 1e-14) && v.width() < 1e-12);
    // v' = v^2 - x from far out, in a half plane: infinite after about 1/v.
    let escaping = Parameters { d: 0.0, d2: -1.0, d3: 0.0, r: 0.0 };
    let found = motion(&escaping, 0.0, 1e3, 1.0);
    let tau = found.end.tau;
    assert_eq!(found.fate, ProvedFate::Escaped);
    assert!(tau.contains(1e-3) || near(tau, 1e-3, 1e-8), "{tau}");
    assert!(tau.width() < 1e-7 * tau.upper(), "{tau}");
    // A start at rest, starts on both sides of v = 0, and an arrival at the end time.
    assert_eq!(motion(&linear, 0.5, 0.0, 1.0).fate, ProvedFate::Captured);
    let wide = [Interval::point(2.0), Interval::new(-1e-9, 1e-9)];
    let open = follow(&ParameterBox::from(&linear), wide, 1.0);
    assert!(open.fate == ProvedFate::Open && open.turns.is_empty());
}

/// What is enclosed for an interval of parameters and starts holds for those inside.
#[test]
fn intervals_hold_the_motions_inside() {
    let one = Parameters { d: -0.2, d2: 0.2, d3: 0.5, r: 0.1 };
    let mut wide = ParameterBox::from(&one);
    wide.d = Interval::new(-0.200_01, -0.199_99);
    let all = follow(&wide, [Interval::new(0.999, 1.001), Interval::new(0.3, 0.300_1)], 20.0);
    let inside = motion(&Parameters { d: -0.200_01, ..one }, 1.001, 0.300_1, 20.0);
    assert!(all.turns.len() >= 3);
    for (around, turn) in all.turns.iter().zip(&inside.turns) {
        assert!(turn.q.unwrap().is_within(around.q.unwrap()) && turn.tau.is_within(around.tau));
    }
}

fn kicked(parameters: &Parameters) -> ProvedKicks {
    kicks(&prove(&ParameterBox::from(parameters), &[]), &Margin::ENDLESS)
}

/// Margins of the piecewise linear oscillator in closed form, and of reference cycles.
#[test]
fn margins_hold_their_references() {
    let linear = kicked(&Parameters { d: -0.1, d2: 0.0, d3: 0.0, r: 0.1 });
    let displacement = linear.sizes.displacement.unwrap();
    assert!(displacement.contains(0.638_682_318_435_773_5) && displacement.width() < 1e-13);
    assert_eq!(linear.edge, Some(Border::Cycle));
    let found = kicked(&Parameters { d: -0.2, d2: 0.2, d3: 0.5, r: 0.1 });
    assert!(found.sizes.displacement.unwrap().contains(0.350_058_845_389_937_26));
    assert!(found.sizes.impulse.unwrap().width() < 1e-11);
    let captured = kicked(&Parameters { d: 0.1, d2: 0.0, d3: 0.5, r: 0.1 });
    assert_eq!(captured.edge, Some(Border::None));
    let escape = kicked(&Parameters { d: -0.02, d2: 0.5, d3: 0.0, r: 0.1 });
    assert_eq!(escape.edge, Some(Border::Separatrix));
    assert!(escape.sizes.displacement.unwrap().width() < 1e-9);
    assert!(kicked(&Parameters { d: -0.1, d2: 0.0, d3: 0.5, r: 0.0 }).open.is_some());
}

/// For random parameters the lower bounds are never above the margins of the plain computation, nor the upper
/// bounds below. Just inside a lower bound the motion comes to rest, just outside an upper one it does not.
#[test]
fn margins_are_never_larger_than_the_truth() {
    let mut seed = 0x2545_f491_4f6c_dd1d_u64;
    let mut roll = |low: f64, high: f64| {
        seed ^= seed << 13;
        seed ^= seed >> 7;
        seed ^= seed << 17;
        #[expect(clippy::cast_precision_loss, reason = "53 bits")]
        let part = (seed >> 11) as f64 * powi(2.0, -53);
        low + part * (high - low)
    };
    let (mut compared, mut open) = (0, 0);
    for _ in 0..24 {
        let d3 = if roll(0.0, 1.0) < 0.5 { roll(-0.5, 0.5) } else { 0.0 };
        let parameters =
            Parameters { d: roll(-0.8, 0.1), d2: roll(-0.5, 0.5), d3, r: roll(0.05, 0.5) };
        let margin = Portrait::of_oscillator(&parameters, 10.0, &Limits::PATIENT).unwrap().margin;
        let proof = prove(&ParameterBox::from(&parameters), &[]);
        let found = kicks(&proof, &margin);
        open += usize::from(found.open.is_some());
        for (plain, bounds) in margin.all().into_iter().zip(found.sizes.all()) {
            let Some(bounds) = *bounds else { continue };
            let plain = plain.unwrap_or_else(|| panic!("{parameters:?}: no margin, {bounds}"));
            compared += 1;
            assert!(near(bounds, plain, 1e-9 * plain), "{parameters:?}: {plain} {bounds}");
        }
        if let Some(impulse) = found.sizes.impulse {
            let ends = |v: f64| motion(&parameters, 0.0, v, 1e5).fate;
            for sign in [-1.0, 1.0] {
                let inside = ends(sign * impulse.lower() * (1.0 - 1e-9));
                let rests = matches!(inside, ProvedFate::Captured | ProvedFate::Open);
                assert!(rests, "{parameters:?} {inside:?}");
            }
        }
    }
    assert!(compared > 24 && open <= 6, "{compared} compared, {open} open");
}

/// The fold for D3 = 0.01, r = 1 is at D = -0.217412751691 (independent computation, 12 digits).
#[test]
fn a_range_is_decided_and_its_fold_enclosed() {
    let base = ParameterBox::from(&Parameters { d: 0.0, d2: 0.0, d3: 0.01, r: 1.0 });
    let near_fold = change_within(&base, Knob::D, -0.217_412_751_691, 1e-6).unwrap();
    assert_eq!((near_fold.below.len(), near_fold.above.len()), (2, 0));
    assert_eq!(change_within(&base, Knob::D, -0.1, 1e-3), None);
    let found = range(&base, Knob::D, (-0.2175, -0.2173));
    let counts: Vec<_> = found.pieces.iter().map(|it| it.cycles.as_ref().map(Vec::len)).collect();
    assert_eq!((counts.first(), counts.last()), (Some(&Some(2)), Some(&Some(0))), "{found:?}");
    assert_eq!(found.changes.len(), 1);
    assert!(found.changes[0].between.width() < 1e-10);
    assert!(near(found.changes[0].between, -0.217_412_751_691, 1e-12), "{found:?}");
    // Pieces touch, and the open ones are narrow.
    for pair in found.pieces.windows(2) {
        assert_eq!(pair[0].over.upper(), pair[1].over.lower());
    }
    let open = found.pieces.iter().filter(|piece| piece.cycles.is_none());
    assert!(open.map(|piece| piece.over.width()).sum::<f64>() < 1e-6);
}

/// Nothing narrows what is open where both half maps are stiff, and a proof takes some ten thousand steps there.
#[test]
fn the_work_for_a_range_is_limited_and_the_answer_says_so() {
    let known = Parameters { d: 5.5, d2: 0.0, d3: -1.8e-6, r: 23.0 };
    let found = range(&ParameterBox::from(&known), Knob::D2, (-0.0485, 0.0065));
    assert!(
        found.exhausted && found.pieces.iter().any(|piece| piece.cycles.is_none()),
        "{found:?}"
    );
    assert!(found.steps < MOST_STEPS + MOST_STEPS / 20, "{}", found.steps);
    let ends = (found.pieces[0].over.lower(), found.pieces.last().unwrap().over.upper());
    assert_eq!(ends, (-0.0485, 0.0065));
    // Where the number of cycles is proved up to its changes, the work was enough.
    let known = Parameters { d: 0.0, d2: 0.0, d3: 0.5, r: 0.1 };
    let found = range(&ParameterBox::from(&known), Knob::D, (-0.5, 0.0));
    assert!(!found.exhausted && found.changes.len() == 1, "{found:?}");
}
