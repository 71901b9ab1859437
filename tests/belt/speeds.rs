//! The view of the cycles over the belt speed: every kind of cycle has its own look, and jumps up and down are
//! where the motions of the machine leave the end of a stable state.

use hopfscope::branch::machine::{MachineBranch, PortraitPoint};
use hopfscope::branch::{Jump, JumpEnd, Special, SpecialKind};
use hopfscope::flow::Limits;
use hopfscope::model::belt::FrictionLaw;
use hopfscope::model::{Belt, Group, Knob, Source};
use hopfscope::picture::Item;
use hopfscope::portrait::Cycle;
use hopfscope::portrait::Portrait;
use hopfscope::question::answer;
use hopfscope::scene::machine::library::machines;
use hopfscope::scene::{Finding, Topic, View, find};
use hopfscope::session::{Msg, Session, Size, settle};

fn machine(name: &str) -> Belt {
    machines().iter().find(|machine| machine.name == name).unwrap().belt.clone()
}

fn specials(belt: &Belt, name: &str, range: (f64, f64), count: usize) -> Vec<Special> {
    let (source, knob) = (Source::from(belt), Knob::named(name, Group::SOURCE).unwrap());
    let (values, limits) = ((count, Some([].as_slice())), &Limits::PATIENT);
    MachineBranch::along(&source, knob, range, values, limits).unwrap().special
}

#[test]
fn rest_and_stick_slip_end_at_different_speeds() {
    // Upwards: stick-slip ends, and everything comes to rest. Downwards: rest ends, and everything goes to stick-slip.
    for (from, to) in [(0.5, 2.0), (2.0, 0.5)] {
        let mut found = specials(&machine("bstab"), "v0", (from, to), 4);
        found.sort_by(|one, other| one.value.total_cmp(&other.value));
        let [hopf, end] = found[..] else { panic!("{found:?}") };
        assert_eq!((hopf.kind, end.kind), (SpecialKind::Hopf, SpecialKind::Annihilation));
        assert_eq!((hopf.jumps.unwrap().up, end.jumps.unwrap().down), (None, None), "{found:?}");
        let Some(Jump { from: 0.0, to: JumpEnd::Cycle { q_max } }) = hopf.jumps.unwrap().down
        else {
            panic!("{hopf:?}")
        };
        // The stick-slip cycle at that speed.
        let there = Belt { belt_speed: hopf.value, ..machine("bstab") };
        let cycles = Portrait::of_belt(&there).unwrap().cycles;
        let stuck = cycles.iter().find(|cycle| cycle.sticks()).unwrap();
        assert!((q_max / stuck.q_max - 1.0).abs() < 1e-6, "{q_max} {stuck:?}");
        let Some(Jump { from, to: JumpEnd::Rest }) = end.jumps.unwrap().up else {
            panic!("{end:?}")
        };
        assert!((from / end.q_max.unwrap() - 1.0).abs() < 0.01, "{end:?}");
    }
}

#[test]
fn a_cycle_that_grows_into_the_line_does_not_jump_and_one_that_folds_does() {
    let found = specials(&machine("textbook"), "v0", (0.05, 0.9), 6);
    let [touch, fold] = found[..] else { panic!("{found:?}") };
    assert_eq!((touch.kind, fold.kind), (SpecialKind::Grazing, SpecialKind::Fold));
    assert_eq!(
        (touch.jumps.unwrap().up, touch.jumps.unwrap().down, fold.jumps.unwrap().down),
        (None, None, None)
    );
    assert!(matches!(fold.jumps.unwrap().up, Some(Jump { to: JumpEnd::Rest, .. })), "{fold:?}");
}

#[test]
fn where_friction_at_rest_is_higher_stick_slip_and_slip_change_into_each_other() {
    let belt = Belt { static_coefficient: Some(0.6), ..machine("textbook") };
    let found = specials(&belt, "v0", (0.1, 0.5), 9);
    let cycle = |jump: Option<Jump>| match jump {
        Some(Jump { from, to: JumpEnd::Cycle { q_max } }) => Some((from, q_max)),
        _ => None,
    };
    // Downwards: the slipping cycle touches the line, and the motion goes on to the larger cycle that sticks.
    let touch = found.iter().find(|special| special.kind == SpecialKind::Grazing).unwrap();
    let (from, to) = cycle(touch.jumps.unwrap().down).unwrap();
    assert!(from > 0.0 && to > 1.02 * from, "{touch:?}");
    // Upwards: stick-slip ends on a faster belt than that, and jumps down to slip where it exists, not to rest.
    let end = found.iter().find(|special| special.kind == SpecialKind::Annihilation).unwrap();
    assert!(end.value > touch.value, "{found:?}");
    let fold = found.iter().find(|special| special.kind == SpecialKind::Fold).unwrap();
    assert!(end.value < fold.value, "{found:?}");
    let (from, to) = cycle(end.jumps.unwrap().up).unwrap();
    assert!(to > 0.0 && to < 0.98 * from, "{end:?}");
}

#[test]
fn a_cycle_that_is_born_at_rest_is_no_jump() {
    // Viscous friction that grows: the damping of third degree sustains a small cycle beyond a Hopf point.
    let law = FrictionLaw::Polynomial { coefficients: vec![0.5, -0.2] };
    let belt = Belt { law, friction: 0.0, damping: 0.0, ..machine("bstab") };
    let belt = Belt { cubic_damping: 0.3, belt_speed: 1.0, normal_force: 1.0, ..belt };
    let found = specials(&belt, "d1", (0.1, 0.3), 4);
    let [hopf] = found[..] else { panic!("{found:?}") };
    assert!(hopf.kind == SpecialKind::Hopf && (hopf.value - 0.2).abs() < 1e-12, "{hopf:?}");
    assert_eq!((hopf.jumps.unwrap().up, hopf.jumps.unwrap().down), (None, None));
}

/// A scene with all its requests answered.
fn shown(scene: &str) -> Session {
    let mut session = Session::new(find(scene).unwrap(), Size { width: 160, height: 50 });
    settle(&mut session, |_, request| {
        let found = || Ok(answer(request, &Limits::PATIENT).unwrap());
        (request.topic() != Topic::Branch).then(|| Msg::answered(request.clone(), found(), 0.0))
    });
    session
}

#[test]
fn the_view_draws_each_kind_its_own_way_and_marks_the_jumps() {
    for (scene, jumps, kinds) in [
        (
            "slow-belt",
            ["jump as numbers grow"].as_slice(),
            ["branch of stick-slip cycles", "unstable slip cycle"],
        ),
        (
            "benchmark",
            &["jump as numbers fall", "jump as numbers grow"],
            ["branch of stick-slip cycles", "unstable slip cycle"],
        ),
    ] {
        let session = shown(scene);
        let index = session.plots.iter().position(|plot| plot.view == View::BeltDiagram).unwrap();
        let picture = hopfscope::picture::of(&session, index);
        let mut looks = Vec::new();
        let mut jumping = Vec::new();
        for item in &picture.items {
            match item {
                Item::Curve(line, points) if line.name.starts_with("jump") => {
                    assert!(points.iter().all(|point| point.x == points[0].x));
                    assert!(points.iter().any(|point| point.y == 0.0), "to or from rest");
                    jumping.push(line.name.to_string());
                }
                Item::Curve(line, _) => looks.push((line.name.to_string(), Some(line.dash))),
                _ => {}
            }
        }
        assert_eq!(jumping, jumps, "{scene}");
        assert_eq!(picture.captions.len(), 2, "{scene}: both changes have their letter");
        for kind in kinds {
            assert!(looks.iter().any(|(name, _)| name == kind), "{scene}: {looks:?}");
        }
        // Distinguishable without colour: no two kinds of cycle share a line style.
        looks.retain(|(name, _)| name.ends_with("cycle"));
        looks.sort_by(|one, other| one.0.cmp(&other.0));
        looks.dedup();
        let mut dashes: Vec<_> = looks.iter().map(|(_, dash)| format!("{dash:?}")).collect();
        dashes.sort();
        dashes.dedup();
        assert_eq!(dashes.len(), looks.len(), "{looks:?}");
    }
}

#[test]
fn a_draft_is_quick_and_shows_every_kind_where_the_whole_answer_does() {
    /// Evaluations that take at most half of a frame of 16 ms.
    const HALF_FRAME: u64 = 200_000;
    for scene in ["slow-belt", "benchmark"] {
        let session = Session::new(find(scene).unwrap(), Size { width: 160, height: 50 });
        let mut asked = session.wants().into_iter();
        let asked = asked.find(|request| request.topic() == Topic::MachineBranch).unwrap();
        let found = [asked.draft().unwrap(), asked].map(|request| {
            match answer(&request, &Limits::PATIENT).unwrap() {
                Finding::MachineBranch(found) => found,
                other => panic!("{other:?}"),
            }
        });
        let [draft, whole] = &found;
        assert!(draft.cost.evaluations < HALF_FRAME, "{scene}: {}", draft.cost.evaluations);
        let belt = &find(scene).unwrap().machine.clone().unwrap().machine.belt;
        let mut compared = 0;
        for PortraitPoint { value: at, found } in &draft.points {
            let exact = Portrait::of_belt(&Belt { belt_speed: *at, ..belt.clone() });
            let (found, exact) = (&found.as_ref().unwrap().cycles, exact.unwrap().cycles);
            let kinds = |cycles: &[Cycle]| -> Vec<_> {
                cycles.iter().map(|cycle| (cycle.sticks(), cycle.stable)).collect()
            };
            assert_eq!(kinds(found), kinds(&exact), "{scene} at {at}");
            for (rough, exact) in found.iter().zip(&exact) {
                assert!((rough.q_max / exact.q_max - 1.0).abs() < 1e-2, "{scene} at {at}");
                compared += 1;
            }
        }
        assert!(draft.points.len() >= 5 && compared >= draft.points.len(), "{scene}: {compared}");
        // Near each change the curves are followed right up to it.
        for special in &whole.special {
            let near = whole.points.iter().filter(|it| (it.value - special.value).abs() < 1e-3);
            assert!(near.count() >= 2, "{scene}: {special:?}");
        }
    }
}
