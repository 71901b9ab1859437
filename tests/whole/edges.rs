//! Machines of kinds not in the reference: the guide captures what no cycle encloses, rest without swings, laws
//! that end beyond the cycles.

use super::portrait;
use hopfscope::flow::{Fate, Flow, Limits, Reason};
use hopfscope::model::belt::FrictionLaw;
use hopfscope::model::{Belt, Body, Mode, Source};
use hopfscope::numerics::elementary::exp;
use hopfscope::portrait::{Border, Cycle, Portrait};
use hopfscope::scene::Machine;
use hopfscope::scene::machine::file::parse;

/// The mass on a belt that the text of a file describes.
fn belt(text: &str) -> Belt {
    let described = parse("x", "x.toml", text, |_| Err(String::new())).unwrap();
    Machine::try_from(described).unwrap().belt
}

/// A clutch whose friction feeds a small swing: without static friction an unstable cycle borders rest, from
/// -5.4195 mm to 5.4989 mm.
fn clutch(held: f64) -> Belt {
    let stiffness = 2e5;
    Belt {
        mass: 20.0,
        stiffness,
        damping: 100.0,
        cubic_damping: 0.0,
        normal_force: 4000.0,
        friction: 60.0,
        belt_speed: 1.0,
        law: FrictionLaw::Polynomial { coefficients: vec![0.38, -0.08, 0.01] },
        static_coefficient: None,
        static_guide: Some(held * stiffness),
    }
}

#[test]
fn a_guide_that_holds_one_turning_point_of_a_cycle_leaves_no_cycle() {
    let held = 5.45e-3;
    let found = portrait(&clutch(held));
    assert!(found.cycles.iter().all(Cycle::sticks), "{:?}", found.cycles);
    assert!(found.border == Border::Capture);
    let margin = found.reach.unwrap();
    assert!((margin.displacement.1 / held - 1.0).abs() < 1e-12, "{margin:?}");
    for (x, v) in [
        (margin.displacement.0, 0.0),
        (-margin.displacement.1, 0.0),
        (0.0, margin.velocity.0),
        (0.0, -margin.velocity.1),
    ] {
        assert_eq!(found.fate(x * (1.0 - 1e-9), v * (1.0 - 1e-9)), Ok(Fate::Rest), "{x} {v}");
        assert_eq!(found.fate(x * (1.0 + 1e-9), v * (1.0 + 1e-9)), Ok(Fate::Cycle(0)), "{x} {v}");
        // Followed for one return, a motion just inside comes to rest, one just outside continues.
        if v == 0.0 && x > 0.0 {
            let mut flow = Flow::new(&found.model);
            assert!(matches!(flow.returned(x * (1.0 - 1e-9)), Ok(None)));
            assert!(matches!(flow.returned(x * (1.0 + 1e-9)), Ok(Some(_))));
        }
    }
    // A guide that holds neither turning point leaves the cycle; one that holds both removes it.
    let cycles = |held| portrait(&clutch(held)).cycles.iter().filter(|it| !it.sticks()).count();
    assert_eq!([5.4e-3, 5.45e-3, 5.51e-3].map(cycles), [1, 0, 0]);
}

/// A slow belt whose friction falls so steeply that rest is a repelling node.
fn node(guide_static: f64) -> Belt {
    let friction = 0.011_265_246_624_523_249;
    Belt {
        mass: 1.119_672_575_862_049_2,
        stiffness: 17_998.281_964_583_042,
        damping: 0.0,
        cubic_damping: 936_488.339_107_141_4,
        normal_force: 3.243_884_327_265_006,
        friction,
        belt_speed: 0.001_051_212_574_713_570_2,
        law: FrictionLaw::Stribeck {
            rest: 0.615_720_952_756_171_3,
            kinetic: 0.246_562_109_014_203_78,
            velocity: 0.000_496_389_768_690_595_6,
            exponent: 1.0,
            viscous: 0.0,
        },
        static_coefficient: Some(0.942_423_272_986_699_9),
        static_guide: Some(guide_static * friction),
    }
}

#[test]
fn where_no_cycle_repels_the_basin_ends_where_the_guide_just_holds() {
    for guide_static in [1.0, 2.0, 4.0] {
        let belt = node(guide_static);
        let found = portrait(&belt);
        assert!(found.border == Border::Capture);
        assert!(found.cycles.iter().all(Cycle::sticks), "{:?}", found.cycles);
        let held = guide_static * belt.friction / belt.stiffness;
        let margin = found.reach.unwrap();
        for size in [margin.displacement.0, margin.displacement.1] {
            assert!((size / held - 1.0).abs() < 1e-15, "{guide_static}: {size} {held}");
        }
        // Motions confirm the place of the border.
        for (sign, kick) in [(1.0, margin.velocity.0), (-1.0, margin.velocity.1)] {
            assert_eq!(found.fate(0.0, sign * kick * (1.0 - 1e-9)), Ok(Fate::Rest));
            assert_eq!(found.fate(0.0, sign * kick * (1.0 + 1e-9)), Ok(Fate::Cycle(0)));
        }
        assert_eq!(found.fate(held, 0.0), Ok(Fate::Rest));
        assert_eq!(found.fate(held * (1.0 + 1e-9), 0.0), Ok(Fate::Cycle(0)));
        // A window within the basin is entirely captured. Of one that reaches ten times as far as the guide
        // holds, less than half is.
        let (x, v) = (1e-3 * held, 1e-3 * margin.velocity.0.min(margin.velocity.1));
        assert!((found.rest_share((-x, x), (-v, v)).unwrap().part - 1.0).abs() < 1e-12);
        let x = 10.0 * held;
        let fastest = x * found.model.omega_0;
        let share = found.rest_share((-x, x), (-fastest, fastest)).unwrap().part;
        assert!(share > 0.0 && share < 0.5, "{share}");
    }
}

#[test]
fn where_the_law_ends_it_is_not_said_that_every_kick_is_survived() {
    // The guide brakes so strongly that slip ends at once; the law falls below zero at a slip of 0.4086 m/s.
    let text = "m = 0.415\nc = 1.735\nd1 = 0.25665\nd3 = 0.233634\nF = 0.1876\nR = 0.008091\nv0 = 0.1379\n\
                friction.polynomial.coefficients = [0.62, -1.11435, -0.98584]\n";
    let found = portrait(&belt(text));
    let margin = found.reach.unwrap();
    assert!(matches!(found.stop, Some(Reason::BeyondLaw { .. })) && found.incomplete().is_some());
    // A kick against the belt gets slightly faster at first.
    let fastest = 0.408_645_154 - 0.1379;
    assert!((0.9999 * fastest..fastest).contains(&margin.velocity.1), "{margin:?}");
    for (x, v) in [(margin.displacement.0, 0.0), (-margin.displacement.1, 0.0)] {
        assert_eq!(found.fate(0.999 * x, v), Ok(Fate::Rest), "{x}");
        assert!(matches!(found.fate(1.001 * x, v), Err(_) | Ok(Fate::Unknown(_))), "{x}");
    }
    // In a window within the known range everything comes to rest; for a larger one the share is unknown.
    let near = 0.5 * margin.velocity.1;
    assert_eq!(found.rest_share((-0.01, 0.01), (-near, near)).unwrap().part, 1.0);
    assert_eq!(found.rest_share((-1.0, 1.0), (-1.0, 1.0)), None);
}

#[test]
fn where_motions_take_too_many_steps_the_margin_is_what_was_followed() {
    let text = "m = 0.767\nc = 3.325\nd3 = 97.188237\nF = 7.9579\nv0 = 0.0539\nfriction.static = 0.982\n\
                friction.polynomial.coefficients = [0.437, 2.72777, 2.16231, 57.38058, 272.78022]\n";
    let found = portrait(&belt(text));
    let margin = found.reach.unwrap();
    assert_eq!((found.stop, margin.displacement.0), (Some(Reason::Steps), found.known));
    assert!(margin.displacement.0 > 10.0 && margin.velocity.1 > 10.0, "{margin:?}");
    assert!(found.cost.steps < 100_000, "{} steps", found.cost.steps);
}

/// A light mass without guide friction, whose law is a table that falls by half up to some slip.
fn measured(damping: f64, velocity: f64, end: f64) -> Belt {
    let point = |index: i32| {
        let part = f64::from(index) / 40.0;
        let slip = end * part * part;
        format!("[{slip:?}, {:?}]", 0.3 + 0.3 * exp(-slip / velocity))
    };
    let points: Vec<_> = (0..=40).map(point).collect();
    let text = format!(
        "m = 0.25\nc = 100\nd1 = {damping}\nF = 6\nv0 = 0.02\nfriction.table.points = [{}]",
        points.join(", ")
    );
    belt(&text)
}

#[test]
fn an_overdamped_mass_rests_after_every_kick_that_the_law_covers() {
    let end = 0.2;
    let found = portrait(&measured(40.0, 0.05, end));
    assert!(found.model.damping > 2.0 && found.cycles.is_empty());
    assert!(matches!(found.border, Border::Unknown(_)) && found.stop.is_some());
    let margin = found.reach.unwrap();
    // A kick against the belt slips fastest at the start.
    assert!((margin.velocity.1 - (end - 0.02)).abs() < 1e-12, "{margin:?}");
    for (x, v) in [
        (margin.displacement.0, 0.0),
        (-margin.displacement.1, 0.0),
        (0.0, margin.velocity.0),
        (0.0, -margin.velocity.1),
    ] {
        assert!(x != 0.0 || v != 0.0);
        assert_eq!(found.fate(0.999 * x, 0.999 * v), Ok(Fate::Rest), "{x} {v}");
    }
}

#[test]
fn what_the_belt_releases_is_on_its_cycle_even_where_all_beyond_is_unknown() {
    // The cycle slips by less than 0.1 m/s, where the law ends.
    let long = portrait(&measured(0.5, 0.02, 1.0));
    let cycle = long.cycles.iter().find(|cycle| cycle.sticks()).unwrap();
    let end = 0.02 - 1.0001 * cycle.v_min;
    let short = portrait(&measured(0.5, 0.02, end));
    let last = short.cycles.len() - 1;
    assert!(short.cycles[last].sticks());
    let release = short.model.lines.unwrap().release;
    for part in [0.0, 0.3, 0.9] {
        assert_eq!(short.fate(release - part * cycle.q_max, 0.02), Ok(Fate::Cycle(last)));
    }
    assert_eq!(short.fate(cycle.q_max, 0.0), Ok(Fate::Cycle(last)));
}

/// A tool whose cut feeds energy into its mode at small velocities.
fn tool(friction: f64) -> Portrait {
    let damping_ratio = vec![-0.02, 0.002, 0.3];
    let mode = Mode { frequency: 250.0, mass: 4.0, damping_ratio, friction, static_guide: None };
    Source::from(Body::Mode(mode)).portrait().unwrap()
}

#[test]
fn however_much_friction_a_mode_has_it_has_an_answer() {
    use Border::{Cycle, NoBasin, None};
    let kinds = [0.0, 1.0, 20.0, 1e2, 1e3, 1e4].map(|force| tool(force).border);
    assert_eq!(kinds, [NoBasin, Cycle, Cycle, None, None, None]);
}

#[test]
fn a_loosened_tolerance_changes_no_margin_by_more_than_it_allows() {
    for speed in [0.1, 0.2, 0.3] {
        let textbook = hopfscope::scene::machine::library::find("textbook").unwrap();
        let belt = Belt { belt_speed: speed, ..textbook.belt.clone() };
        let exact = portrait(&belt).reach.unwrap();
        for tolerance in [1e-12, 1e-8, 1e-6, 1e-4] {
            let subject = Source { tolerance: Some(tolerance), ..(&belt).into() };
            let margin = subject.portrait().unwrap().reach.unwrap();
            for (one, other) in [
                (margin.displacement.0, exact.displacement.0),
                (margin.displacement.1, exact.displacement.1),
                (margin.velocity.0, exact.velocity.0),
                (margin.velocity.1, exact.velocity.1),
            ] {
                let error = (one / other - 1.0).abs();
                assert!(error < 100.0 * tolerance, "{speed} {tolerance:e}: {error:e}");
            }
        }
    }
}

#[test]
fn in_one_turn_of_a_cycle_the_belt_gives_what_damper_and_guide_take() {
    let mut looked = 0;
    for machine in hopfscope::scene::machine::library::machines() {
        let found = portrait(&machine.belt);
        for cycle in &found.cycles {
            let backward = cycle.is_followed_backward();
            let around = Flow::new(&found.model).around(cycle.q_max, backward);
            let ledger = around.unwrap().0.ledger(&found.model);
            let [belt, damper, guide] =
                ["belt", "damper", "guide"].map(|source| ledger.work(source).abs());
            let (size, left) = (belt + damper + guide, ledger.residual.abs());
            assert!(size > 0.0 && left < 1e-11 * size, "{}: {ledger:?}", machine.name);
            looked += 1;
        }
    }
    assert!(looked >= 6, "{looked}");
}

#[test]
fn where_motions_run_away_the_search_for_cycles_settles() {
    let text = "m = 1\nc = 1\nd1 = 0.1\nd3 = -0.05\nF = 1\nv0 = 1.5\n\
                friction.stribeck = { rest = 1, kinetic = 0.5, velocity = 0.5 }\n";
    let found = portrait(&belt(text));
    assert_eq!(found.unresolved, []);
    let outermost = found.cycles.last().unwrap().q_max;
    assert_eq!(found.fate(outermost * (1.0 + 1e-9), 0.0), Ok(Fate::Escapes));
    assert!(found.cost.steps < 4000, "{} steps", found.cost.steps);
}

/// A mass carried away from a belt with constant friction by a negative damper.
fn carried_off(damping: f64, guide: f64) -> Portrait {
    let text = format!(
        "m = 1\nc = 1\nd1 = {damping:?}\nF = 1\nR = {guide:?}\nv0 = 0.5\nfriction.constant.mu = 0.3"
    );
    portrait(&belt(&text))
}

#[test]
fn where_everything_is_carried_off_that_is_the_answer() {
    for damping in [-2.5, -5.0, -50.0] {
        let held = carried_off(damping, 0.05);
        assert_eq!(held.stop, None, "{damping}");
        assert_eq!(held.reach.unwrap().displacement, (0.05, 0.05), "{damping}");
        assert_eq!(held.fate(0.05 * (1.0 + 1e-9), 0.0), Ok(Fate::Escapes), "{damping}");
        let free = carried_off(damping, 0.0);
        assert!(free.border == Border::NoBasin && free.stop.is_none(), "{damping}");
        assert_eq!(free.fate(1e-6, 0.0), Ok(Fate::Escapes), "{damping}");
    }
}

/// A mode fed far beyond critical damping at small velocities, and damped at larger ones.
fn relaxing(ratio: f64) -> Portrait {
    let damping_ratio = vec![ratio, 0.0, 2000.0];
    let (frequency, mass, friction, static_guide) = (120.0, 0.2, 0.03, None);
    let mode = Mode { frequency, mass, damping_ratio, friction, static_guide };
    Source::from(Body::Mode(mode)).portrait().unwrap()
}

#[test]
fn a_mode_far_beyond_critical_damping_has_an_answer() {
    // Overdamped at rest: everything creeps there.
    let found = relaxing(10.0);
    assert!(found.cycles.is_empty() && found.border == Border::None, "{:?}", found.cycles);
    assert_eq!(found.fate(1e-3, 0.0), Ok(Fate::Rest));
    // Fed as strongly, it relaxes to a cycle: it creeps until feeding and damping cancel at the knee, and then jumps.
    for ratio in [-5.0_f64, -10.0] {
        let found = relaxing(ratio);
        let cycle = found.cycles.iter().find(|cycle| cycle.stable).unwrap();
        // Rayleigh: the knee of 2 ratio w - 2 c w^3 is where w^2 is a third of the value at which both cancel.
        let knee = (-ratio / 2000.0 / 3.0).sqrt();
        let size = cycle.q_max / (4.0 / 3.0 * -ratio * knee / found.model.omega_0);
        assert!((1.0..1.2).contains(&size), "{ratio}: {size}");
    }
}

#[test]
fn what_static_friction_alone_holds_survives_no_kick_along_the_belt() {
    // Rest is a repelling node: no motion that moves upwards from it turns before it reaches the belt.
    let text = "m = 1\nc = 1\nd1 = 0.08\nF = 4.7\nv0 = 0.06\nR_static = 0.05\n\
                friction.stribeck = { rest = 0.5, kinetic = 0.2, velocity = 0.1 }\n";
    let found = portrait(&belt(text));
    let margin = found.reach.unwrap();
    assert!(margin.velocity.1 == 0.0 && margin.velocity.0 < 1e-9, "{margin:?}");
    for displacement in [margin.displacement.0, margin.displacement.1] {
        assert!((displacement / 0.05 - 1.0).abs() < 1e-15, "{margin:?}");
    }
    for kick in [1e-4, -1e-4, 0.03] {
        assert!(matches!(found.fate(0.0, kick), Ok(Fate::Cycle(_))), "{kick}");
    }
    assert_eq!(found.fate(0.05 * (1.0 - 1e-9), 0.0), Ok(Fate::Rest));
    assert!(matches!(found.fate(0.05 * (1.0 + 1e-9), 0.0), Ok(Fate::Cycle(_))));
}

#[test]
fn a_mode_that_asymmetric_damping_drives_away_survives_what_the_paper_says() {
    use hopfscope::flow::Limits;
    use hopfscope::model::Parameters;
    // It escapes to the left or to the right, from rest in a wide or a narrow sticking set, with static friction above
    // the kinetic one or not.
    for (d, d2, r) in [(0.2, -1.0, 0.3), (0.2, 1.0, 0.3), (0.6, 6.0, 3.0), (-0.01, -0.5, 0.1)] {
        for held in [r, 1.1 * r] {
            let (omega, mass) = (3.0, 2.0);
            let mode = Mode {
                frequency: omega / std::f64::consts::TAU,
                mass,
                damping_ratio: vec![d, 0.5 * d2 / omega],
                friction: mass * omega * omega * r,
                static_guide: Some(mass * omega * omega * held),
            };
            let found = Source::from(Body::Mode(mode)).portrait().unwrap();
            assert_eq!(found.border, Border::Separatrix, "{d} {d2} {r}");
            let parameters = Parameters { d, d2, d3: 0.0, r };
            let paper =
                Portrait::of_oscillator(&parameters, 20.0 / d2.abs(), &Limits::PATIENT).unwrap();
            let expected =
                paper.margin_within(held, 1.0).map(|length| length, |v| mass * omega * v);
            let least = found.margin;
            let close = |one: Option<f64>, other: Option<f64>| {
                let (one, other) = (one.unwrap(), other.unwrap());
                (one - other).abs() <= 1e-12 * other.max(r)
            };
            let displacement = expected.displacement.map(|length| length.max(held));
            assert!(close(least.displacement, displacement), "{least:?} {expected:?}");
            assert!(close(least.impulse, expected.impulse), "{least:?} {expected:?}");
            let (rest, from) = (least.from_rest, expected.from_rest);
            assert!(close(rest.displacement, from.displacement), "{rest:?} {from:?}");
            assert!(close(rest.impulse, from.impulse), "{rest:?} {from:?}");
            // Each motion says the same, followed by itself.
            let margin = found.reach.unwrap();
            let (right, left) = margin.displacement;
            for (x, v) in
                [(right, 0.0), (-left, 0.0), (0.0, margin.velocity.0), (0.0, -margin.velocity.1)]
            {
                if x.is_finite() && v.is_finite() {
                    let (inside, outside) = (1.0 - 1e-9, 1.0 + 1e-9);
                    assert_eq!(found.fate(inside * x, inside * v), Ok(Fate::Rest), "{x} {v}");
                    assert_eq!(found.fate(outside * x, outside * v), Ok(Fate::Escapes), "{x} {v}");
                }
            }
        }
    }
}

#[test]
fn a_window_around_a_basin_that_is_open_to_infinity_is_finite_and_holds_its_border() {
    let damping_ratio = vec![0.05, -0.6];
    let mode = Mode { frequency: 0.5, mass: 2.0, damping_ratio, friction: 0.3, static_guide: None };
    let found = Source::from(Body::Mode(mode)).portrait().unwrap();
    let window = found.surroundings();
    // The border crosses the axis of displacements once, at -0.165 m; growing motions reach it from infinity.
    let left = -found.reach.unwrap().displacement.1;
    assert!((left + 0.165_020_703_730_114_32).abs() < 1e-12, "{left}");
    assert!((window.q.0 - 1.5 * left).abs() < 1e-12 && window.reach().is_finite(), "{window:?}");
    let counts = found.count(&window, (16, 16), &Limits::PATIENT).unwrap();
    assert!(counts.captured > 0 && counts.escaped > 0 && counts.undecided == 0, "{counts:?}");
}
