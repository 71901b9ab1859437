//! The whole model of the mass on a belt, against machines computed independently (80-bit Taylor series with
//! polynomial events, and DOP853), against closed forms, and against itself.

mod edges;
mod paper;
mod precise;
mod random;

use std::f64::consts::PI;

use hopfscope::branch::SpecialKind;
use hopfscope::branch::machine::MachineBranch;
use hopfscope::flow::{Detail, Fate, Flow, Limits, Method, Motion, Outcome, Problem, Reason};
use hopfscope::model::belt::FrictionLaw;
use hopfscope::model::{Belt, ContactState, Group, Knob, Model, Source, State};
use hopfscope::numerics::elementary::{
    asin, atan, atan2, cos, exp, exp_m1, hypot, ln, powi, sin, tanh,
};
use hopfscope::portrait::basin::StartWindow;
use hopfscope::portrait::{Border, Portrait};
use serde_json::{Value, json};

/// A motion from displacement and velocity (m, m/s), followed for `until` seconds by Taylor series, with its ledger.
fn follow_by_series(model: &Model, (q, v): (f64, f64), until: f64) -> Motion {
    let (method, tolerance) = (Method::Taylor, model.tolerance);
    let problem =
        Problem { initial: State { q, v }, until, method, tolerance, ..Problem::default() };
    problem.followed(Some(model), Detail { energy: true, ..Detail::default() }, &Limits::PATIENT)
}

fn data() -> Value {
    serde_json::from_str(include_str!("../data/belts.json")).unwrap()
}

fn machine(name: &str) -> Belt {
    serde_json::from_value(data()["machines"][name]["belt"].clone()).unwrap()
}

fn portrait(belt: &Belt) -> Portrait {
    Portrait::of(&Model::new(belt).unwrap()).unwrap()
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value} is not a number"))
}

/// Equal up to `relative` of the larger one.
fn close(one: f64, other: f64, relative: f64) -> bool {
    (one - other).abs() <= relative * one.abs().max(other.abs())
}

#[test]
fn every_reference_machine_has_its_cycles_margins_and_border() {
    for (name, expected) in data()["machines"].as_object().unwrap() {
        let found = portrait(&machine(name));
        let cycles = expected["cycles"].as_array().unwrap();
        assert_eq!(found.cycles.len(), cycles.len(), "{name}");
        for (cycle, expected) in found.cycles.iter().zip(cycles) {
            let kind = [
                ("sticks", cycle.sticks()),
                ("stable", cycle.stable),
                ("overtakes", cycle.overtakes),
            ];
            for (key, value) in kind {
                assert_eq!(expected[key], value, "{name} {key}");
            }
            for (key, value) in [
                ("x_min", cycle.q_min),
                ("x_max", cycle.q_max),
                ("v_min", cycle.v_min),
                ("v_max", cycle.v_max),
                ("period", cycle.period),
                ("stick_duration", cycle.stick_duration()),
                ("multiplier", cycle.multiplier.unwrap()),
            ] {
                assert!(close(value, number(&expected[key]), 1e-13), "{name} {key}: {value}");
            }
        }
        assert_eq!(expected["border"], json!(found.border), "{name}");
        assert_eq!(expected["neutral"], found.neutral, "{name}");
        let margin = found.reach.map(|margin| {
            [margin.displacement.0, margin.displacement.1, margin.velocity.0, margin.velocity.1]
        });
        assert_eq!(expected["margin"].is_null(), margin.is_none(), "{name}");
        for (value, expected) in
            margin.iter().flatten().zip(expected["margin"].as_array().into_iter().flatten())
        {
            assert!(close(*value, number(expected), 1e-13), "{name}: margin {value}, {expected}");
        }
    }
}

#[test]
fn every_reference_start_ends_where_it_should() {
    for (name, expected) in data()["machines"].as_object().unwrap() {
        let belt = machine(name);
        let found = portrait(&belt);
        for end in expected["ends"].as_array().unwrap() {
            let (x, v) = (number(&end[0]), number(&end[1]));
            let fate = found.fate(x, v).unwrap();
            let told = match fate {
                Fate::Rest => Value::from("rest"),
                Fate::Cycle(index) => Value::from(index),
                Fate::Neutral => Value::from("neutral"),
                other => panic!("{name}: {other:?}"),
            };
            assert_eq!(told, end[2], "{name} from {x}, {v}");
            if fate == Fate::Rest {
                let rest = Flow::new(&found.model)
                    .rest_of(x, v / found.model.omega_0, &Limits::PATIENT)
                    .unwrap();
                let error = (rest - number(&end[3])).abs();
                assert!(
                    error <= 1e-11 * belt.friction / belt.stiffness,
                    "{name} from {x}, {v}: {error:e}"
                );
            }
        }
    }
}

#[test]
fn the_share_that_comes_to_rest_is_that_of_the_open_benchmark() {
    for row in data()["rest_share"].as_array().unwrap() {
        let belt = Belt { belt_speed: number(&row[0]), ..machine("bstab-1.5") };
        let found = portrait(&belt);
        // The window is given in terms of the elongation of the spring.
        let steady = found.model.pull;
        let share = found.rest_share((-2.0 - steady, 2.0 - steady), (0.0, 2.0)).unwrap().part;
        assert!((share - number(&row[1])).abs() < 1e-12, "{row}: {share}");
    }
}

#[test]
fn the_share_counts_every_piece_of_the_border() {
    // A border of kind grazing, cut by the window on all sides, against a count of starts.
    for name in ["coulomb-guide", "coulomb-damped", "stribeck-guide-cubic"] {
        let found = portrait(&machine(name));
        let margin = found.reach.unwrap();
        let x = (-0.7 * margin.displacement.1, 1.2 * margin.displacement.0);
        let v = (-0.6 * margin.velocity.1, 1.1 * margin.velocity.0);
        let count = 40;
        let mut rest = 0;
        for i in 0..count {
            for j in 0..count {
                let part = |index: i32| (f64::from(index) + 0.5) / f64::from(count);
                let start = (x.0 + (x.1 - x.0) * part(i), v.0 + (v.1 - v.0) * part(j));
                rest += i32::from(found.fate(start.0, start.1) == Ok(Fate::Rest));
            }
        }
        let counted = f64::from(rest) / f64::from(count * count);
        assert!((found.rest_share(x, v).unwrap().part - counted).abs() < 5e-3, "{name}: {counted}");
    }
}

/// A machine with constant kinetic friction and a higher static one.
#[test]
fn the_area_of_a_basin_is_its_share_of_a_window_and_its_largest_circle_comes_to_rest() {
    let mut seen = 0;
    for name in data()["machines"].as_object().unwrap().keys() {
        let found = portrait(&machine(name));
        // Of a family of periodic motions the border parts those that keep moving.
        let known = found.area().zip(found.inner_radius()).filter(|_| !found.neutral);
        let Some((area, radius)) = known else { continue };
        let StartWindow { q, v } = found.surroundings();
        let share = found.rest_share(q, v).unwrap().part;
        assert!(close(share * (q.1 - q.0) * (v.1 - v.0), area, 1e-12), "{name}: {share} {area}");
        let omega_0 = found.model.omega_0;
        let rests = |radius: f64, degrees: u32| {
            let angle = PI * f64::from(degrees) / 180.0;
            found.fate(radius * cos(angle), radius * omega_0 * sin(angle)) == Ok(Fate::Rest)
        };
        assert!((0..360).all(|degrees| rests(0.999 * radius, degrees)), "{name}");
        assert!(!(0..360).all(|degrees| rests(1.001 * radius, degrees)), "{name}");
        seen += 1;
    }
    assert!(seen > 3, "{seen}");
}

fn coulomb(guide: f64, speed: f64) -> Belt {
    Belt { friction: guide, belt_speed: speed, ..machine("coulomb-guide") }
}

#[test]
fn coulomb_friction_has_its_closed_forms() {
    let belt = coulomb(0.0, 0.2);
    let omega = (belt.stiffness / belt.mass).sqrt();
    for speed in [0.02, 0.2, 0.7] {
        let delta = belt.normal_force * 0.2 / belt.stiffness;
        let u = speed / omega;
        let free = portrait(&coulomb(0.0, speed));
        let amplitude = hypot(delta, u);
        assert!(free.neutral && free.cycles.len() == 1);
        let cycle = &free.cycles[0];
        let stick = 2.0 * delta / speed;
        let period = stick + (2.0 * PI - 2.0 * atan(delta / u)) / omega;
        for (found, expected) in [
            (cycle.q_max, amplitude),
            (cycle.q_min, -amplitude),
            (cycle.v_min, -omega * amplitude),
            (cycle.v_max, speed),
            (cycle.stick_duration(), stick),
            (cycle.period, period),
            (free.reach.unwrap().displacement.0, u),
        ] {
            assert!(close(found, expected, 1e-13), "v0 = {speed}: {found}, {expected}");
        }
        let rho = 0.002;
        let guided = portrait(&coulomb(rho * belt.stiffness, speed));
        let third = amplitude - 4.0 * rho;
        assert_eq!(guided.cycles.len(), usize::from(third >= u), "v0 = {speed}");
        let Some(cycle) = guided.cycles.first() else { continue };
        let arrival = (third * third - u * u).sqrt();
        let slip = (atan(u / delta) + PI + asin(u / third)) / omega;
        let stick = (delta + arrival) / speed;
        for (found, expected) in [
            (cycle.q_max, amplitude - rho),
            (cycle.q_min, 3.0 * rho - amplitude),
            (cycle.stick_duration(), stick),
            (cycle.period, stick + slip),
            (guided.reach.unwrap().displacement.0, u + 3.0 * rho),
            (guided.reach.unwrap().displacement.1, u + rho),
        ] {
            assert!(close(found, expected, 1e-13), "v0 = {speed}: {found}, {expected}");
        }
    }
}

#[test]
fn a_damped_slip_takes_the_time_of_its_transcendental_equation() {
    let cycle = portrait(&machine("coulomb-damped")).cycles[0];
    assert!(close(cycle.stick_duration(), 0.149_427_282_841_480_35, 1e-13));
    assert!(close(cycle.period, 0.652_507_023_097_521_8, 1e-13));
}

/// To rounding, not bit for bit: the whole model steps in metres and with its own series.
#[test]
fn a_cubic_law_far_from_the_belt_is_the_oscillator_of_the_paper() {
    use hopfscope::flow::Limits;
    let feeding = |guide: f64, belt_speed: f64| Belt {
        cubic_damping: 0.1,
        belt_speed,
        ..linear(-0.2, guide)
    };
    // For any belt speed with constant friction, and also without guide friction.
    let belts = [feeding(0.05, 10.0), feeding(0.0, 10.0), feeding(0.0, 20.0), linear(-0.2, 0.1)];
    for belt in belts.into_iter().chain([machine("clutch-static")]) {
        let found = portrait(&belt);
        let reduced = belt.reduce().unwrap();
        let cycles = Portrait::of_oscillator(&reduced.parameters, 1e3, &Limits::PATIENT)
            .and_then(|found| found.drawn(&reduced.parameters, 12))
            .unwrap();
        let slips = found.cycles.iter().filter(|cycle| !cycle.sticks());
        assert!(slips.clone().count() >= cycles.cycles.len() && !cycles.cycles.is_empty());
        let units = &reduced.units;
        for (slip, cubic) in slips.zip(&cycles.cycles) {
            assert_eq!(slip.stable, cubic.stable);
            for (whole, cubic) in [
                (slip.q_max, cubic.q_max * units.displacement),
                (slip.q_min, cubic.q_min * units.displacement),
                (slip.v_max, cubic.v_max * units.velocity),
                (slip.period, cubic.period * units.time),
                (slip.multiplier.unwrap(), cubic.multiplier.unwrap()),
            ] {
                assert!(close(whole, cubic, 1e-12), "{}: {whole} {cubic}", belt.belt_speed);
            }
        }
    }
}

#[test]
fn static_friction_below_the_kinetic_one_is_refused() {
    let belt = Belt { static_coefficient: Some(0.29), ..machine("coulomb-guide") };
    assert_eq!(Model::new(&belt), Err(Reason::StaticBelowKinetic { mu_s: 0.29, mu: 0.3 }));
    let belt = Belt { static_guide: Some(0.1), ..machine("coulomb-guide") };
    let refused = Model::new(&belt).unwrap_err().to_string();
    assert_eq!(
        refused,
        "R_static = 0.1 N is below R = 0.2 N; static friction is at least the kinetic one"
    );
}

#[test]
fn without_friction_of_the_guide_a_falling_law_leaves_no_basin() {
    let found = portrait(&Belt { damping: 0.0, ..machine("bstab-1.5") });
    assert!(found.border == Border::NoBasin);
    assert_eq!(found.margin.displacement.unwrap(), 0.0);
    assert_eq!(found.cycles.len(), 1);
    assert!(found.cycles[0].sticks() && found.fate(1e-9, 0.0) == Ok(Fate::Cycle(0)));
}

#[test]
fn the_ledger_of_a_motion_closes_with_the_work_of_the_belt() {
    for name in data()["machines"].as_object().unwrap().keys() {
        let belt = machine(name);
        let model = Model::new(&belt).unwrap();
        let far = 2.5 * model.speed;
        for start in [
            (0.3 * far, 0.0),
            (-far, 0.0),
            (0.0, 0.9 * belt.belt_speed),
            (-0.2 * far, 1.7 * belt.belt_speed),
        ] {
            let period = 2.0 * PI / model.omega_0;
            let motion = follow_by_series(&model, start, 5.3 * period);
            assert!(
                motion.ledger.as_ref().unwrap().imbalance().abs() < 1e-13,
                "{name} {start:?}: {:?}",
                motion.ledger
            );
            let rests = motion.outcome.rest().unwrap().is_some();
            assert!(rests || close(motion.end().tau, 5.3 * period, 1e-13));
        }
    }
}

#[test]
fn lengths_scale_by_a_power_of_two_to_the_last_bit() {
    for name in ["guide-only", "graze-slip", "clutch-static", "coulomb-guide"] {
        let belt = machine(name);
        for k in [0.125, 1024.0] {
            let law = match belt.law.clone() {
                FrictionLaw::Stribeck { rest, kinetic, velocity, exponent, viscous } => {
                    let (velocity, viscous) = (velocity * k, viscous / k);
                    FrictionLaw::Stribeck { rest, kinetic, velocity, exponent, viscous }
                }
                FrictionLaw::Polynomial { coefficients } => {
                    let scaled = coefficients.iter().zip(0..).map(|(c, n)| c / powi(k, n));
                    FrictionLaw::Polynomial { coefficients: scaled.collect() }
                }
                other => other,
            };
            let scaled = Belt {
                normal_force: belt.normal_force * k,
                friction: belt.friction * k,
                belt_speed: belt.belt_speed * k,
                cubic_damping: belt.cubic_damping / (k * k),
                law,
                ..belt.clone()
            };
            let (one, other) = (portrait(&belt), portrait(&scaled));
            assert_eq!(one.cycles.len(), other.cycles.len());
            for (one, other) in one.cycles.iter().zip(&other.cycles) {
                assert_eq!((one.q_min * k, one.v_max * k), (other.q_min, other.v_max), "{name}");
                assert_eq!((one.period, one.multiplier), (other.period, other.multiplier));
            }
            let margins = [&one, &other].map(|found| found.reach.unwrap().velocity.1);
            assert_eq!(margins[0] * k, margins[1], "{name}");
        }
    }
}

/// A machine with constant friction whose belt is too fast to be met: the piecewise linear oscillator.
fn linear(damping: f64, guide: f64) -> Belt {
    let law = FrictionLaw::Constant { mu: 0.5 };
    let (mass, stiffness, normal_force) = (1.0, 1.0, 1.0);
    let base = machine("coulomb-guide");
    let belt = Belt { mass, stiffness, normal_force, damping, friction: guide, law, ..base };
    Belt { belt_speed: 1e3, static_coefficient: None, ..belt }
}

#[test]
fn a_cycle_that_repels_beyond_all_digits_is_the_border_of_rest() {
    for d in [-0.1_f64, -0.6, -0.95, -0.99, -0.999, -0.9999] {
        let found = portrait(&linear(2.0 * d, 0.1));
        assert!(found.border == Border::Cycle, "{d}: {:?}", found.border);
        let cycle = &found.cycles[0];
        // Equations (30) to (33), corrected.
        let omega = (1.0 - d * d).sqrt();
        let growth = -PI * d / omega;
        let amplitude = 0.1 / tanh(0.5 * growth);
        let margin = found.reach.unwrap();
        for size in [cycle.q_max, -cycle.q_min, margin.displacement.0, margin.displacement.1] {
            assert!(close(size, amplitude, 1e-13), "{d}: {size} {amplitude}");
        }
        let fastest = 0.2 / exp_m1(growth) * exp(-d / omega * atan2(omega, d));
        assert!(close(cycle.v_max, fastest, 1e-12), "{d}: {fastest} {cycle:?}");
        assert!(!cycle.stable && cycle.log_multiplier > 0.0);
        assert!(close(cycle.log_multiplier, 2.0 * growth, 1e-11), "{d}: {cycle:?}");
    }
}

#[test]
fn a_law_that_ends_far_out_hides_no_margin() {
    // A polynomial that falls below zero beyond a slip of 1.25 m/s, with the border well within.
    let law = FrictionLaw::Polynomial { coefficients: vec![0.5, -0.4] };
    let belt = Belt { law, damping: 0.0, friction: 0.02, ..machine("bstab-1.5") };
    let belt = Belt { belt_speed: 0.8, ..belt };
    let found = portrait(&belt);
    assert_eq!(found.border, Border::Cycle);
    let reduced = belt.reduce().unwrap();
    let limits = hopfscope::flow::Limits::PATIENT;
    let cubic = Portrait::of_oscillator(&reduced.parameters, 1e3, &limits)
        .and_then(|found| found.drawn(&reduced.parameters, 12))
        .unwrap();
    let expected = cubic.cycles[0].q_max * reduced.units.displacement;
    assert!(close(found.reach.unwrap().displacement.0, expected, 1e-13));
    assert!(matches!(found.fate(3.0, 0.0), Err(_) | Ok(Fate::Unknown(_))));
    // Where everything within the range of the law comes to rest, the margin is that range, not infinite.
    let damped = Belt { damping: 0.9, belt_speed: 1.2, ..belt };
    let found = portrait(&damped);
    let margin = found.reach.unwrap();
    assert!(matches!(found.border, Border::Unknown(_)));
    let slowest = |x: f64| follow_by_series(&found.model, (x, 0.0), 20.0).extremes.unwrap()[1].0;
    let slip = |x: f64| slowest(x).abs() + 1.2;
    assert!(found.stop.is_some() && close(slip(margin.displacement.0), 1.25, 1e-9), "{margin:?}");
    assert_eq!(found.fate(0.999 * margin.displacement.0, 0.0), Ok(Fate::Rest));
    assert_eq!(found.fate(0.0, -0.999 * margin.velocity.1), Ok(Fate::Rest));
}

#[test]
fn a_search_for_cycles_that_did_not_settle_says_so() {
    for name in data()["machines"].as_object().unwrap().keys() {
        assert_eq!(portrait(&machine(name)).unresolved, [], "{name}");
    }
}

/// The special points along a number.
fn special(belt: &Belt, name: &str, range: (f64, f64), count: usize) -> Vec<(SpecialKind, f64)> {
    let (source, knob) = (Source::from(belt), Knob::named(name, Group::SOURCE).unwrap());
    let (values, limits) = ((count, Some([].as_slice())), &Limits::PATIENT);
    let found = MachineBranch::along(&source, knob, range, values, limits).unwrap();
    found.special.iter().map(|special| (special.kind, special.value)).collect()
}

#[test]
fn every_change_of_a_portrait_is_located() {
    let bench = machine("bstab-1.5");
    let expected =
        [(SpecialKind::Hopf, 0.5 * ln(10.0)), (SpecialKind::Annihilation, 1.836_600_972_207_926)];
    for count in [4, 7] {
        let found = special(&bench, "v0", (0.5, 2.0), count);
        assert_eq!(found.len(), 2, "{found:?}");
        for ((kind, value), expected) in found.iter().zip(&expected) {
            assert_eq!(*kind, expected.0);
            assert!((value - expected.1).abs() < 1e-12, "{kind:?}: {value}");
        }
    }
    // With higher static friction the unstable cycle touches the belt first, and stick-slip survives it.
    let held = Belt { static_coefficient: Some(1.1), ..bench.clone() };
    let found = special(&held, "v0", (1.5, 2.0), 4);
    assert!(
        matches!(found[..], [(SpecialKind::Grazing, _), (SpecialKind::Annihilation, _)]),
        "{found:?}"
    );
    assert!((found[0].1 - expected[1].1).abs() < 1e-12 && found[1].1 > 1.84);
    // The stable cycle that grows into the line.
    let found = special(&machine("graze-slip"), "v0", (0.05, 0.9), 6);
    let (kind, value) = found[0];
    assert!(
        kind == SpecialKind::Grazing && (value - 0.226_957_326_340_235).abs() < 1e-12,
        "{found:?}"
    );
    assert_eq!(found[1].0, SpecialKind::Fold);
    // A machine fed by its damper: stick-slip first also overtakes the belt, and then only overtakes.
    let fed = Belt { damping: -0.3, friction: 0.02, belt_speed: 0.6, ..bench };
    let kinds: Vec<SpecialKind> =
        special(&fed, "d1", (-0.5, 0.0), 9).into_iter().map(|(kind, _)| kind).collect();
    assert_eq!(kinds, [SpecialKind::Fold, SpecialKind::Unsticking, SpecialKind::Overtaking]);
}

#[test]
fn a_fold_of_a_cubic_law_is_that_of_the_oscillator_of_the_paper() {
    let law = FrictionLaw::Polynomial { coefficients: vec![0.5, -0.4, 0.1, 0.2] };
    let belt = Belt { law, ..machine("graze-slip") };
    let found = special(&belt, "d1", (10.0, 20.0), 3);
    let [(SpecialKind::Fold, value)] = found[..] else { panic!("{found:?}") };
    let parameters = Belt { damping: value, ..belt }.reduce().unwrap().parameters;
    let limits = hopfscope::flow::Limits::PATIENT;
    let (fold, _) = hopfscope::branch::fold::fold(&parameters, &limits).unwrap();
    assert!((fold.unwrap().d - parameters.d).abs() < 1e-12, "{} {fold:?}", parameters.d);
}
