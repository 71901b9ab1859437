//! Undo, redo, reset, and scenes.

use super::Trial;
use crate::scene::{Request, Topic};

/// The questions for the picture; the reference belongs to the dial.
fn asked(trial: &Trial) -> Vec<Request> {
    let mut wanted = trial.session.wants();
    wanted.retain(|request| request.topic() != Topic::Reference);
    wanted
}

#[test]
fn undo_and_redo_restore_the_requests_exactly() {
    let mut trial = Trial::open("plain");
    let mut states = vec![asked(&trial)];
    let changes =
        ["<right>", "<S-left>", "-0.3<enter>", "<down><right>", "m", "}", "i", "<tab><up><enter>"];
    for keys in changes {
        trial.press(keys);
        states.push(asked(&trial));
    }
    assert_eq!(trial.session.history.depth(), (changes.len(), 0));
    for state in states.iter().rev().skip(1) {
        trial.press("u");
        assert_eq!(asked(&trial), *state);
    }
    trial.press("u");
    assert_eq!(trial.notice(), "nothing to undo");
    for state in states.iter().skip(1) {
        trial.press("<C-r>");
        assert_eq!(asked(&trial), *state);
    }
    trial.press("U");
    assert_eq!(trial.notice(), "nothing to redo");
}

#[test]
fn undo_says_what_it_brought_back_and_leaves_the_zoom_alone() {
    let mut trial = Trial::open("plain");
    trial.press("<right> <tab>++ <run \"layer basin\">");
    let (window, layers) = (trial.session.plots[0].window, trial.session.layers.clone());
    trial.goes(&[("u", "notice undo: D = -0.1")]);
    assert_eq!((trial.session.plots[0].window, &trial.session.layers), (window, &layers));
}

#[test]
fn a_change_after_an_undo_ends_the_future_and_a_repeated_reset_is_one_change() {
    Trial::open("plain").goes(&[("<right*3> u u <left> U", "notice nothing to redo | D -0.1")]);
    let mut trial = Trial::open("plain");
    trial.goes(&[("<right*3>", "changes 3 0"), ("r r r", "changes 4 0")]);
    assert_eq!(trial.session.problem, trial.session.scene.problem);
    trial.goes(&[
        // The second reset has no effect; resetting the scene restores layers.
        ("R R", "changes 4 0"),
        ("<run \"layer basin\"> R R u", "-basin"),
    ]);
}

#[test]
fn reset_gives_a_row_its_value_and_its_step() {
    let mut trial = Trial::open("linear");
    trial.press("[[ <right*2>");
    assert_ne!(trial.session.steps, crate::session::StepSizes::of_scene(&trial.session.scene));
    trial.press("r");
    assert_eq!(trial.session.steps, crate::session::StepSizes::of_scene(&trial.session.scene));
    assert_eq!(trial.session.value(crate::model::Knob::D), -0.4);
}

#[test]
fn scenes_are_picked_from_a_list_and_undone_as_a_whole() {
    let mut trial = Trial::open("plain");
    trial.press("<right> <tab>+ <run \"layer basin\">");
    let before = trial.session.clone();
    trial.press("s/marg<enter>");
    assert_eq!(trial.session.scene.name, "marginal");
    assert_eq!(trial.session.problem, trial.session.scene.problem);
    assert_eq!(trial.session.layers, trial.session.scene.layers);
    trial.press("<right> u u");
    assert_eq!(trial.notice(), "undo: scene plain");
    assert_eq!(trial.session.wants(), before.wants());
    assert_eq!(trial.session.plots[0].window, before.plots[0].window);
    assert_eq!(trial.session.layers, before.layers);
    trial.press("U");
    assert_eq!(trial.session.scene.name, "marginal");
}

#[test]
fn lists_move_search_and_close() {
    Trial::open("plain").goes(&[
        // The last but one of the machines.
        ("s<down*99><up><enter>", "scene groan"),
        ("s/no such scene<enter>", "open Scenes"),
        ("q", "open none | quit false"),
        ("v/basin<enter><space>", "-basin"),
        ("<space> v ?? G gg ? q", "+basin | quit true"),
    ]);
}
