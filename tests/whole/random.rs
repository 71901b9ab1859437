//! Properties of all machines, tested on random ones.

use hopfscope::numerics::random::Random;
use hopfscope::portrait::RestMargin;

use super::*;

/// Any machine: every law, feeding and damping, with and without static friction.
fn any_machine(chance: &mut Random) -> Belt {
    let mut between = |low: f64, high: f64| low + (high - low) * chance.even();
    let kind = between(0.0, 4.0);
    let law = if kind < 1.0 {
        FrictionLaw::Constant { mu: between(0.1, 0.6) }
    } else if kind < 2.0 {
        let coefficients = vec![between(0.3, 0.8), between(-0.4, 0.1), between(0.05, 0.4)];
        FrictionLaw::Polynomial { coefficients }
    } else {
        FrictionLaw::Stribeck {
            rest: between(0.5, 1.0),
            kinetic: between(0.1, 0.5),
            velocity: between(0.05, 1.0),
            exponent: if kind < 3.0 { 1.0 } else { 2.0 },
            viscous: 0.0,
        }
    };
    let guide = if between(0.0, 1.0) < 0.4 {
        0.0
    } else {
        between(0.003, 0.2)
    };
    let held = law.mu(0.0).unwrap() * between(1.0, 1.5);
    Belt {
        mass: 1.0,
        stiffness: 1.0,
        damping: between(-0.2, 0.4),
        cubic_damping: if between(0.0, 1.0) < 0.5 {
            0.0
        } else {
            between(0.0, 0.2)
        },
        normal_force: between(0.3, 3.0),
        friction: guide,
        belt_speed: between(0.1, 2.0),
        law,
        static_coefficient: (between(0.0, 1.0) < 0.5).then_some(held),
        static_guide: None,
    }
}

#[test]
fn the_return_map_of_any_machine_never_decreases() {
    let mut chance = Random::new(0x9e37_79b9_7f4a_7c15);
    let mut compared = 0;
    for _ in 0..60 {
        let Ok(model) = Model::new(&any_machine(&mut chance)) else { continue };
        let mut flow = Flow::new(&model);
        let mut last = f64::NEG_INFINITY;
        for step in 1..60 {
            let x = model.guide_static + 0.05 * f64::from(step) * model.speed.max(model.pull);
            let image = match flow.returned(x) {
                Ok(Some(image)) => image.x,
                Ok(None) => model.guide_static,
                Err(_) => break,
            };
            assert!(image >= last - 1e-13 * image.abs(), "{model:?} at {x}: {image} after {last}");
            (last, compared) = (image, compared + 1);
        }
    }
    assert!(compared > 1000, "{compared}");
}

#[test]
fn any_start_ends_where_its_motion_goes() {
    let mut chance = Random::new(88_172_645_463_325_252);
    let mut followed = 0;
    for _ in 0..40 {
        let belt = any_machine(&mut chance);
        let Ok(model) = Model::new(&belt) else { continue };
        let Ok(found) = Portrait::of(&model) else { continue };
        for _ in 0..3 {
            let (x, v) = (6.0 * chance.even() - 3.0, 4.0 * chance.even() - 2.0);
            let Ok(fate) = found.fate(x, v) else { continue };
            if let Fate::Unknown(Reason::BeyondLaw { .. }) = fate {
                continue;
            }
            let motion = follow_by_series(&model, (x, v), 400.0);
            let ledger = motion.ledger.unwrap();
            assert!(ledger.imbalance().abs() < 1e-11, "{belt:?}: {ledger:?}");
            let late = motion.crossings.iter().filter(|turn| turn.tau > 380.0);
            let size = late.map(|turn| turn.q).fold(0.0, f64::max);
            match (fate, motion.outcome) {
                (Fate::Cycle(index), Outcome::Moving { .. }) if found.cycles[index].sticks() => {
                    let cycle = &found.cycles[index];
                    assert!(
                        close(size, cycle.q_max, 1e-9),
                        "{belt:?} from {x}, {v}: {size} {cycle:?}"
                    );
                    followed += 1;
                }
                (Fate::Cycle(_), outcome) => {
                    assert!(matches!(outcome, Outcome::Moving { .. }), "{belt:?}");
                }
                (Fate::Rest, outcome) => {
                    let rests = matches!(outcome, Outcome::Captured { .. });
                    assert!(rests || belt.friction == 0.0, "{belt:?}");
                }
                _ => {}
            }
        }
    }
    assert!(followed > 10, "{followed}");
}

#[test]
fn no_contact_is_too_shallow_to_be_seen() {
    // Between rest and the belt, motions under constant friction are circles: one reaches v0 if and only if its
    // radius does.
    for (guide, speed) in [(0.0, 0.2), (0.2, 0.2), (0.7, 0.05)] {
        let belt = coulomb(guide, speed);
        let model = Model::new(&belt).unwrap();
        let (rho, radius) = (guide / belt.stiffness, model.speed);
        for power in 3..14 {
            for sign in [-1.0, 1.0] {
                let excess = sign * powi(10.0, -power);
                let left = -(rho + radius * (1.0 + excess));
                let motion = follow_by_series(&model, (left, 0.0), 0.9 * PI / model.omega_0);
                let stuck = motion.legs.iter().any(|leg| leg.place == ContactState::Sticks);
                assert_eq!(stuck, excess > 0.0, "{guide} {speed} {excess:e}");
            }
        }
    }
    // And where the law is curved, on both sides of the orbit that touches.
    for name in ["bstab-1.5", "guide-only", "graze-slip"] {
        let model = Model::new(&machine(name)).unwrap();
        let mut flow = Flow::new(&model);
        let touch = flow.landmarks().unwrap().unwrap().touch.unwrap();
        for power in 3..13 {
            for sign in [-1.0, 1.0] {
                let x = touch * (1.0 + sign * powi(10.0, -power));
                let Ok(Some(image)) = flow.returned(x) else { panic!("{name}") };
                assert_eq!(image.sticks_from.is_some(), sign > 0.0, "{name} at {x}");
            }
        }
    }
}

#[test]
fn what_comes_to_ride_on_the_belt_leaves_it_as_one() {
    let mut chance = Random::new(0x0dd_ba11_5eed_cafe);
    let mut merged = 0;
    for _ in 0..40 {
        let Ok(model) = Model::new(&any_machine(&mut chance)) else { continue };
        let mut flow = Flow::new(&model);
        let Ok(Some(marks)) = flow.landmarks() else { continue };
        let (Some(touch), Some(released)) = (marks.touch, marks.released) else { continue };
        let end = marks.beyond.unwrap_or(3.0 * touch).min(3.0 * touch);
        for part in [1e-9, 0.1, 0.5, 0.999] {
            let x = touch + part * (end - touch);
            let Ok(Some(image)) = flow.returned(x) else { continue };
            let from = image.sticks_from.unwrap_or_else(|| panic!("{model:?} at {x}: {image:?}"));
            assert_eq!((image.x, image.log_slope), (released, f64::NEG_INFINITY), "{model:?}");
            assert!(from <= marks.lines.release && from >= marks.lines.low, "{model:?}");
            merged += 1;
        }
    }
    assert!(merged > 60, "{merged}");
}

#[test]
fn any_kick_below_the_smallest_one_is_survived_from_wherever_the_mass_rests() {
    let mut chance = Random::new(0x2545_f491_4f6c_dd1d);
    let mut looked = 0;
    for _ in 0..160 {
        let mut belt = any_machine(&mut chance);
        belt.static_guide = (chance.even() < 0.3).then_some(1.2 * belt.friction);
        let Ok(model) = Model::new(&belt) else { continue };
        let Ok(found) = Portrait::of(&model) else { continue };
        let held = model.guide_static;
        if found.reach.is_none() || held == 0.0 || found.stop.is_some() {
            continue;
        }
        let RestMargin { displacement, impulse } = found.margin.from_rest;
        let infinite = f64::INFINITY;
        let (shift, push) =
            (displacement.unwrap_or(infinite), impulse.map_or(infinite, |it| it / model.mass));
        let rests = |from: f64, x: f64, v: f64| {
            follow_by_series(&model, (from + x, v), 2000.0).outcome.rest().unwrap().is_some()
        };
        let mut lost = [0; 2];
        for sign in [-1.0, 1.0] {
            for part in [-1.0, -0.3, 0.0, 0.6, 1.0] {
                let from = part * held;
                let inside = [(sign * shift, 0.0), (0.0, sign * push)];
                let outside = [
                    (sign * (shift + 0.01 * held), 0.0),
                    (0.0, sign * (1.01 * push + 1e-3 * held)),
                ];
                for (kind, ((x, v), (x_out, v_out))) in inside.into_iter().zip(outside).enumerate()
                {
                    assert!(
                        rests(from, 0.99 * x, 0.99 * v),
                        "{belt:?}: {x} m, {v} m/s from {from}"
                    );
                    lost[kind] += usize::from(!rests(from, x_out, v_out));
                }
            }
        }
        assert!(lost.iter().all(|count| *count > 0), "{belt:?}: {:?} {lost:?}", found.margin);
        looked += 1;
    }
    assert!(looked >= 20, "{looked}");
}
