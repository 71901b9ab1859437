//! Guaranteed margins of machines: no machine within the tolerances has a smaller margin, under any disturbance.

use crate::program::{json, run};
use hopfscope::model::{Belt, Group, Knob, Tolerances};
use hopfscope::portrait::Margin;
use hopfscope::portrait::Portrait;
use hopfscope::portrait::guarantee::{NoGuarantee, machine::guaranteed};
use hopfscope::scene::machine::library::find;

fn machine(name: &str) -> Belt {
    find(name).unwrap().belt.clone()
}

fn tolerances(parts: &[(&str, f64)], belt: &Belt, disturbance: f64) -> Tolerances {
    let half = |(name, part): &(&str, f64)| {
        let value = Knob::named(name, Group::SOURCE).unwrap().of_belt(belt).unwrap();
        ((*name).to_owned(), part * value.abs())
    };
    Tolerances { half_widths: parts.iter().map(half).collect(), disturbance }
}

/// Displacement and impulse from the steady position, then from the worst rest position; infinite where every kick
/// is survived.
fn kicks(margin: &Margin) -> [f64; 4] {
    let Margin { displacement, impulse, from_rest } = margin;
    [*displacement, *impulse, from_rest.displacement, from_rest.impulse]
        .map(|size| size.unwrap_or(f64::INFINITY))
}

/// Component of an evenly spread point in a cube, in -1 .. 1.
fn part(draw: u32, number: usize) -> f64 {
    const STEPS: [f64; 6] = [0.754_877, 0.569_840, 0.430_159, 0.324_717, 0.245_122, 0.185_037];
    2.0 * (0.5 + f64::from(draw) * STEPS[number]).fract() - 1.0
}

/// Machines and tolerances, as fractions of the values, with a disturbance in N.
fn cases() -> Vec<(Belt, Tolerances)> {
    let case = |name: &str, parts: &[(&str, f64)], disturbance: f64| {
        let belt = machine(name);
        let known = tolerances(parts, &belt, disturbance);
        (belt, known)
    };
    vec![
        case("textbook", &[("F", 0.05)], 0.0),
        case("textbook", &[("R", 0.1), ("d1", 0.02), ("v0", 0.03)], 0.05),
        case("textbook", &[("m", 0.05), ("c", 0.05), ("rest", 0.02), ("velocity", 0.02)], 0.0),
        case("clutch", &[("R", 0.05), ("F", 0.02), ("v0", 0.02), ("m", 0.02)], 0.0),
        case("slideway", &[("c", 0.03), ("F", 0.03)], 0.0),
    ]
}

fn no_draw_is_below(draws: u32) {
    for (belt, known) in cases() {
        let found = guaranteed(&belt, &known).unwrap();
        let (_, found) = found.unwrap_or_else(|reason| panic!("{known:?}: {reason}"));
        let (found, nominal) = (kicks(&found), kicks(&Portrait::of_belt(&belt).unwrap().margin));
        // A guarantee of nothing would also hold.
        let says = found.iter().zip(nominal).all(|(found, nominal)| *found > 0.3 * nominal);
        assert!(says, "{known:?}: {found:?} of {nominal:?}");
        for draw in 0..draws {
            let mut drawn = belt.clone();
            for (number, (varied, interval)) in known.intervals(&belt).into_iter().enumerate() {
                let value = interval.middle()
                    + part(draw, number) * 0.5 * (interval.upper() - interval.lower());
                varied.set_in_belt(&mut drawn, value).unwrap();
            }
            // The worst disturbance acts like reduced friction.
            drawn.friction -= known.disturbance;
            let mut own = kicks(&Portrait::of_belt(&drawn).unwrap().margin);
            // Before the kick it may have pushed the other way.
            own[2] -= 2.0 * known.disturbance / drawn.stiffness;
            let kept = own.iter().zip(found).all(|(own, found)| *own >= found * (1.0 - 1e-9));
            assert!(kept, "{known:?}: draw {draw}: {own:?} below {found:?}");
        }
    }
}

#[test]
fn no_machine_within_the_tolerances_has_a_smaller_margin() {
    no_draw_is_below(8);
}

#[test]
#[ignore = "1e3 machines of each kind: minutes"]
fn no_machine_of_a_thousand_within_the_tolerances_has_a_smaller_margin() {
    no_draw_is_below(1000);
}

#[test]
fn tolerances_of_friction_and_damping_and_a_disturbance_are_those_of_one_machine() {
    let belt = machine("textbook");
    let known = tolerances(&[("R", 0.2), ("d1", 0.1)], &belt, 0.1);
    let (_, found) = guaranteed(&belt, &known).unwrap().unwrap();
    let friction = 0.8 * belt.friction - 0.1;
    let worst = Belt { friction, damping: 0.9 * belt.damping, ..belt.clone() };
    let portrait = Portrait::of_belt(&worst).unwrap();
    let [displacement, impulse, shift, push] = kicks(&found);
    let [exact, exact_impulse, ..] = kicks(&portrait.margin);
    assert!((displacement / exact - 1.0).abs() < 1e-12);
    assert!((impulse / exact_impulse - 1.0).abs() < 1e-12);
    // The mass rests where friction and the disturbance hold it together.
    let farthest = (0.8 * belt.friction + 0.1) / belt.stiffness;
    let from_rest = portrait.margin_within(farthest, belt.mass).from_rest;
    assert!((shift / (exact - farthest) - 1.0).abs() < 1e-12);
    assert!((push / (from_rest.impulse.unwrap()) - 1.0).abs() < 1e-12);
    let refused = guaranteed(&belt, &tolerances(&[], &belt, belt.friction)).unwrap();
    assert!(matches!(refused, Err(NoGuarantee::Disturbance { .. })), "{refused:?}");
}

#[test]
fn the_command_reports_both_margins_and_the_friction_that_guarantees_one() {
    let line = ["belt", "textbook", "--set", "R=1 N +- 0.2 N", "--disturbance", "0.1 N"];
    let told = run(&line).out;
    for words in [" nominal ", " guaranteed\n", "from any rest position", "R in 0.8 N .. 1.2 N"] {
        assert!(told.contains(words), "{words}: {told}");
    }
    let alone = json("belt textbook --set R=0.7");
    let certain = json("belt textbook --set R=0.8..1.2 --disturbance 0.1");
    let number = |value: &serde_json::Value| value.as_f64().unwrap();
    let (one, other) = (&certain["guaranteed"]["displacement"], &alone["margin"]["displacement"]);
    assert!((number(one) / number(other) - 1.0).abs() < 1e-9, "{one} {other}");
    // Its bounds are rounded outwards.
    let low = number(&certain["guaranteed"]["tolerances"]["R"][0]);
    assert!(low <= 0.8 && low > 0.8 - 1e-15, "{low}");
    assert!(alone["guaranteed"].is_null());
    // A machine with the R that guarantees 1 mm guarantees 1 mm.
    let designed = json("belt textbook --set R=1+-0.2 --disturbance 0.1 --design 1mm");
    let r = number(&designed["design"]["R"]);
    let check = json(&format!("belt textbook --set R={r}+-0.2 --disturbance 0.1"));
    let kept = number(&check["guaranteed"]["displacement"]);
    assert!((kept / 1e-3 - 1.0).abs() < 1e-6, "R = {r} N: {kept}");
    for (set, words) in [
        ("R=1 N +- 2 N", "R = -1 N is outside its range"),
        ("R=1 N +- 1 mm", "both numbers take the same unit"),
        ("x=1 mm +- 1 mm", "a start has no uncertainty"),
    ] {
        let ran = run(&["belt", "textbook", "--set", set]);
        ran.is_refused(&[words]);
    }
}
