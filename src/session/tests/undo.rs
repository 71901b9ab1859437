//! Undo, redo, reset, and scenes.

use super::Desk;
use crate::scene::{Layer, Request, Topic};
use crate::session::{Listed, Overlay};

/// What is asked for the picture; what its error is measured against belongs to the dial.
fn asked(desk: &Desk) -> Vec<Request> {
    let mut wanted = desk.session.wants();
    wanted.retain(|request| request.topic() != Topic::Reference);
    wanted
}

#[test]
fn undo_and_redo_restore_the_requests_exactly() {
    let mut desk = Desk::open("plain");
    let mut states = vec![asked(&desk)];
    let changes =
        ["<right>", "<S-left>", "-0.3<enter>", "<down><right>", "m", "}", "i", "<tab><up><enter>"];
    for keys in changes {
        desk.press(keys);
        states.push(asked(&desk));
    }
    assert_eq!(desk.session.history.depth(), (changes.len(), 0));
    for state in states.iter().rev().skip(1) {
        desk.press("u");
        assert_eq!(asked(&desk), *state);
    }
    desk.press("u");
    assert_eq!(desk.notice(), "nothing to undo");
    for state in states.iter().skip(1) {
        desk.press("<C-r>");
        assert_eq!(asked(&desk), *state);
    }
    desk.press("U");
    assert_eq!(desk.notice(), "nothing to redo");
}

#[test]
fn undo_says_what_it_brought_back_and_leaves_the_zoom_alone() {
    let mut desk = Desk::open("plain");
    desk.press("<right> <tab>++ <run \"layer basin\">");
    let (window, layers) = (desk.session.plots[0].window, desk.session.layers.clone());
    desk.press("u");
    assert_eq!(desk.notice(), "undo: D = -0.1");
    assert_eq!((desk.session.plots[0].window, &desk.session.layers), (window, &layers));
}

#[test]
fn a_change_after_an_undo_ends_the_future() {
    let mut desk = Desk::open("plain");
    desk.press("<right*3> u u <left> U");
    assert_eq!(desk.notice(), "nothing to redo");
    assert_eq!(desk.session.problem.parameters.d, -0.1);
}

#[test]
fn a_repeated_reset_is_one_change() {
    let mut desk = Desk::open("plain");
    desk.press("<right*3>");
    assert_eq!(desk.session.history.depth(), (3, 0));
    desk.press("r r r");
    assert_eq!(desk.session.problem, desk.session.scene.problem);
    assert_eq!(desk.session.history.depth(), (4, 0));
    desk.press("R R");
    assert_eq!(desk.session.history.depth(), (4, 0), "nothing was left to reset");
    desk.press("<run \"layer basin\"> R R u");
    assert!(
        !desk.session.layers.contains(&Layer::Basin),
        "a reset of the scene brings layers back"
    );
}

#[test]
fn reset_gives_a_row_its_value_and_its_step() {
    let mut desk = Desk::open("linear");
    desk.press("[[ <right*2>");
    assert_ne!(desk.session.steps, crate::session::Steps::of_scene(&desk.session.scene));
    desk.press("r");
    assert_eq!(desk.session.steps, crate::session::Steps::of_scene(&desk.session.scene));
    assert_eq!(desk.session.value(crate::oscillator::Symbol::D), -0.4);
}

#[test]
fn scenes_are_picked_from_a_list_and_undone_as_a_whole() {
    let mut desk = Desk::open("plain");
    desk.press("<right> <tab>+ <run \"layer basin\">");
    let before = desk.session.clone();
    desk.press("s/marg<enter>");
    assert_eq!(desk.session.scene.name, "marginal");
    assert_eq!(desk.session.problem, desk.session.scene.problem);
    assert_eq!(desk.session.layers, desk.session.scene.layers);
    desk.press("<right> u u");
    assert_eq!(desk.notice(), "undo: scene plain");
    assert_eq!(desk.session.wants(), before.wants());
    assert_eq!(desk.session.plots[0].window, before.plots[0].window);
    assert_eq!(desk.session.layers, before.layers);
    desk.press("U");
    assert_eq!(desk.session.scene.name, "marginal");
}

#[test]
fn lists_move_search_and_close() {
    let mut desk = Desk::open("plain");
    desk.press("s<down*99><up><enter>");
    assert_eq!(desk.session.scene.name, "groan", "the last but one of the machines");
    desk.press("s/no such scene<enter>");
    assert!(
        matches!(desk.session.overlay, Some(Overlay::List(Listed::Scenes, _))),
        "nothing to open"
    );
    desk.press("q");
    assert_eq!((&desk.session.overlay, desk.session.quit), (&None, false));
    desk.press("v/basin<enter><space>");
    assert!(!desk.session.layers.contains(&Layer::Basin));
    desk.press("<space> v ? G gg ? q");
    assert!(desk.session.layers.contains(&Layer::Basin) && desk.session.quit);
}
