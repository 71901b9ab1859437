//! Records that begin differently, or are not motions of this oscillator.

use hopfscope::fit::{DropReason, NAMES, Question, Record, StartKind, estimate};
use hopfscope::numerics::elementary::{cos, exp, sin};
use hopfscope::numerics::random::Random;

use super::{RELEASED, Simulated, assert_near};

#[test]
fn a_mass_that_is_struck_where_it_rests_is_fitted_from_the_stroke_on() {
    // A stroke: at rest for 0.4 s, then moving through the same position.
    let struck = Simulated {
        p: [16.0, 0.2, 0.015, 0.0, 0.0, 0.1, 0.0, 5.0],
        start: StartKind::Moving,
        seconds: 4.0,
        samples: 1000,
        noise: 0.03,
        ..RELEASED
    };
    for seed in 1..=4 {
        let moving = struck.record(seed);
        let mut chance = Random::new(seed + 100);
        let before = (0..100).map(|_| struck.p[1] + struck.noise * chance.normal());
        let x: Vec<f64> = before.chain(moving.x).collect();
        let t = (0..1100_u32).map(|index| 0.004 * f64::from(index)).collect();
        let record = Record { t, x, ..Record::default() };
        let found = estimate(&record, &Question::default(), &|| false).unwrap();
        let before = found.count(DropReason::Before);
        assert!((100..106).contains(&before), "{before}");
        assert!(found.start == StartKind::Moving && found.rests && found.whiteness.white);
        assert_near(&found, &struck.p, 4.0, &NAMES);
    }
}

#[test]
fn a_mass_that_is_excited_again_is_fitted_up_to_then() {
    let release = Simulated {
        p: [20.0, 0.2, 0.02, 0.0, 0.0, 0.05, 3.0, 0.3],
        seconds: 4.0,
        samples: 1000,
        noise: 0.01,
        ..RELEASED
    };
    let blow = Simulated {
        p: [20.0, 0.2, 0.02, 0.0, 0.0, 0.05, -0.04, 2.0],
        start: StartKind::Moving,
        ..release
    };
    let strong = Simulated { p: [20.0, 0.2, 0.02, 0.0, 0.0, 0.05, 0.3, 4.0], ..blow };
    for (seed, (second, rests)) in
        [(release, true), (blow, true), (strong, false)].into_iter().enumerate()
    {
        let first = release.record(seed as u64 + 1);
        // With the second excitation at rest, or in the middle of the motion.
        let until = if rests { 1000 } else { 400 };
        let again = second.record(seed as u64 + 11).x;
        let x: Vec<f64> = first.x[..until].iter().copied().chain(again).collect();
        let t =
            (0..u32::try_from(x.len()).unwrap()).map(|index| 0.004 * f64::from(index)).collect();
        let record = Record { t, x, ..Record::default() };
        let found = estimate(&record, &Question::default(), &|| false).unwrap();
        let after = found.count(DropReason::After);
        assert!((1000..1060).contains(&after), "{seed}: {after}");
        assert!(found.whiteness.white && found.start == StartKind::Release, "{seed}");
        assert_near(&found, &release.p, 4.0, found.wanted());
    }
}

#[test]
fn a_record_of_another_system_is_reported_as_such_at_little_cost() {
    let oscillation = |phase: fn(f64) -> f64, size: fn(f64) -> f64, drift: fn(f64) -> f64| {
        let mut chance = Random::new(9);
        let t: Vec<f64> = (0..500_u32).map(|index| 0.04 * f64::from(index)).collect();
        let x = t
            .iter()
            .map(|&t| 3.0 * size(t) * cos(10.0 * t + phase(t)) + drift(t) + 0.02 * chance.normal());
        Record { x: x.collect(), t, ..Record::default() }
    };
    for (what, record) in [
        ("frequency", oscillation(|t| 1.5 * sin(0.8 * t), |_| 1.0, |_| 0.0)),
        ("amplitude", oscillation(|_| 0.0, |t| 1.0 + 0.5 * cos(0.9 * t), |_| 0.0)),
        ("level", oscillation(|_| 0.0, |t| exp(-0.1 * t), |t| 0.5 * exp(-0.2 * t))),
    ] {
        let found = estimate(&record, &Question::default(), &|| false).unwrap();
        assert!(found.whiteness.systematic && !found.whiteness.white, "{what}");
        for row in found.wanted() {
            assert!(found.covariance.error(row.place) > 0.0, "{what}: {}", row.name);
        }
        let (with, without) = found.motions;
        assert!(with + without < 3000, "{what}: {with} and {without} motions");
    }
}

#[test]
fn a_hold_beyond_full_scale_is_left_out_with_all_that_is_flattened() {
    let p = [20.0, 0.3, 0.02, 0.0, 0.0, 0.1, 6.0, 0.2];
    let seen = Simulated { p, seconds: 5.0, samples: 1500, noise: 0.02, ..RELEASED };
    for seed in 1..=3 {
        let mut record = seen.record(seed);
        record.x.iter_mut().for_each(|x| *x = x.clamp(-5.0, 5.0));
        let found = estimate(&record, &Question::default(), &|| false).unwrap();
        let saturated = found.count(DropReason::Saturated);
        assert!(saturated > 60 && found.whiteness.white, "{saturated}");
        assert_near(&found, &p, 4.0, &NAMES);
    }
}
