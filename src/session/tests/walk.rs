//! Walking along the branch, which by hand is: unstable at 1.1, a fold at 1.5, stable at 3.1.

use super::Desk;
use crate::oscillator::State;
use crate::session::{Context, Stop};
use crate::study::SpecialKind;

fn held(desk: &Desk) -> Stop {
    desk.session.held.expect("a point is held")
}

fn q_max(desk: &Desk) -> f64 {
    held(desk).cycle.unwrap().q_max
}

#[test]
fn the_arrows_walk_along_the_branch_and_esc_lets_go() {
    let mut desk = Desk::open("supercritical");
    desk.press("<tab><tab>w<home>");
    assert_eq!((q_max(&desk), desk.session.contexts()[0]), (1.1, Context::Walk));
    let walk = [("<right>", 1.5), ("l", 3.1), ("<right>", 3.1), ("<down>", 1.5), ("<home>", 1.1)];
    for (keys, size) in walk {
        desk.press(keys);
        assert_eq!(q_max(&desk), size, "{keys}");
    }
    desk.press("<S-right>");
    assert_eq!(q_max(&desk), 3.1);
    desk.press("<right>");
    assert!(desk.notice().starts_with("the branch ends here"));
    desk.press("<esc>");
    assert_eq!((desk.session.held, desk.session.quit), (None, false));
    assert_eq!(desk.session.contexts()[0], Context::Diagram);
}

#[test]
fn tab_jumps_to_special_points_and_ends_and_around() {
    let mut desk = Desk::open("supercritical");
    desk.press("<tab><tab>w<home><tab>");
    assert_eq!(held(&desk).special, Some(SpecialKind::Fold));
    desk.press("<tab>");
    assert_eq!(q_max(&desk), 3.1);
    desk.press("<tab>");
    assert_eq!(q_max(&desk), 1.1);
    desk.press("<S-tab><S-tab>");
    assert_eq!(held(&desk).special, Some(SpecialKind::Fold));
}

#[test]
fn enter_takes_the_point_into_the_phase_plane_as_one_change() {
    let mut desk = Desk::open("supercritical");
    let before = desk.session.problem;
    desk.press("<tab><tab>w<home><tab><enter>");
    let taken = desk.session.problem;
    assert_eq!(taken.parameters.d, held(&desk).value);
    assert_eq!(taken.initial, State { q: 1.5, v: 0.0 });
    assert_eq!(desk.session.history.depth(), (1, 0));
    desk.press("u");
    assert_eq!(desk.session.problem, before);
    assert!(desk.session.held.is_some(), "the walk goes on");
}

#[test]
fn the_cursor_says_where_to_take_hold() {
    let mut desk = Desk::open("supercritical");
    desk.press("<tab><tab><right>");
    desk.session.plots[1].cursor.as_mut().unwrap().y = 3.0;
    desk.press("<C-left*9> w");
    assert_eq!(q_max(&desk), 3.1);
}

#[test]
fn there_must_be_a_branch_to_hold() {
    let mut desk = Desk::open("supercritical");
    desk.press("<tab><tab> <run \"layer branch\"><run \"layer special\"> w");
    assert_eq!(desk.notice(), "the branch is not shown: v lists the layers");
    assert_eq!(desk.session.held, None);
    desk.press("<run \"layer branch\"> w<home>");
    assert!(desk.session.held.is_some());
    // Zooming computes the branch again; the hold stays on it.
    desk.press("+");
    let held = held(&desk);
    assert!(desk.branch(1).pieces.iter().flatten().any(|point| Stop::on(0, point) == held));
}

#[test]
fn of_variants_the_present_one_is_walked_first_and_each_brings_its_values() {
    // Three frictions, of which the second is the present one.
    let mut desk = Desk::open("fig16b");
    desk.press("<tab>w");
    assert_eq!(held(&desk).variant, 1);
    let mut seen = Vec::new();
    for _ in 0..9 {
        desk.press("<tab>");
        seen.push(held(&desk).variant);
    }
    assert!([0, 1, 2].iter().all(|variant| seen.contains(variant)), "{seen:?}");
    while held(&desk).variant != 2 {
        desk.press("<tab>");
    }
    desk.press("<enter>");
    let taken = desk.session.problem;
    assert_eq!((taken.parameters.r, taken.parameters.d), (0.3, held(&desk).value));
    assert_eq!(taken.initial.q, q_max(&desk));
    assert!(desk.notice().contains(", r = 0.3, and the motion starts on its cycle"));
    assert_eq!(desk.session.history.depth(), (1, 0));
}

#[test]
fn another_scene_takes_the_hold_away() {
    let mut desk = Desk::open("supercritical");
    desk.press("s/basin<enter> <tab><tab>w");
    assert!(desk.session.held.is_some());
    desk.press("u");
    assert_eq!(desk.session.held, None, "undo opened the scene before");
}
