//! Several motions: started beside each other, removed, undone, saved.

use super::Trial;
use super::saved::reopened;
use crate::model::State;
use crate::session::save;

/// In the scene, the motion starts at 0.3; in the made-up answer, the unstable cycle turns at 1.1.
#[test]
fn motions_are_started_beside_each_other_and_taken_away() {
    for (keys, expected) in [
        ("i", "0.3 1.05"),
        ("i o", "0.3 1.05 1.15"),
        ("i o i", "0.3 1.15 1.05"),
        ("i i", "0.3 1.05"),
        ("i o d", "0.3 1.05"),
        ("i o d d", "0.3"),
        ("i o d d d", "0.3"),
        ("i o c", "1.15"),
        ("i o c d", "1.15"),
        ("i o u", "0.3 1.05"),
        ("i o c u", "0.3 1.05 1.15"),
        ("i o d u", "0.3 1.05 1.15"),
        ("i o u u U U", "0.3 1.05 1.15"),
        ("i o R", "0.3"),
        ("i o R u", "0.3 1.05 1.15"),
        // Typed numbers change the newest motion; the others stay.
        ("i o <down*3>2<enter>", "0.3 1.05 2.0"),
        ("\"a i o \"b 'a", "0.3"),
        ("\"a i o \"b 'a 'b", "0.3 1.05 1.15"),
    ] {
        Trial::open("supercritical").goes(&[(keys, &format!("starts {expected}"))]);
    }
}

#[test]
fn enter_in_the_phase_plane_adds_a_motion_and_of_too_many_the_oldest_gives_way() {
    let mut trial = Trial::open("supercritical");
    let first = trial.session.problem.initial;
    trial.press("<tab><up><enter>");
    assert_eq!(trial.session.others, [first]);
    trial.press("<right><enter> <right><enter> <right><enter> <right><enter> <right><enter>");
    trial.press("<right><enter>");
    assert_eq!((trial.session.problems().len(), trial.notice()), (8, ""));
    trial.press("<right><enter>");
    assert_eq!(trial.notice(), "8 motions at most: the oldest gave way");
    assert_eq!(trial.session.problems().len(), 8);
    assert!(!trial.session.others.contains(&first));
    trial.press("c");
    assert_eq!((trial.session.problems().len(), trial.session.number(0)), (1, None));
    trial.press("d");
    assert_eq!(trial.notice(), "the only motion cannot be removed");
}

#[test]
fn each_motion_is_a_question_of_its_own() {
    Trial::open("supercritical").goes(&[
        // The answer for the other motion is known.
        ("i", "asked Trajectory"),
        ("o", "asked Trajectory"),
        ("<right>", "asked Trajectory Trajectory Trajectory Cycles"),
        // A step of q0 moves only the newest start.
        ("<down*3><right>", "asked Trajectory"),
        ("d", "asked | starts 0.3 1.05"),
    ]);
}

#[test]
fn a_saved_session_keeps_motions_their_marks_and_their_history() {
    let mut trial = Trial::open("supercritical");
    trial.press("i o \"a c i");
    let mut opened = reopened(&trial.session);
    let text = save::text(&opened).unwrap();
    assert_eq!(opened.problems().len(), 2);
    assert_eq!(opened.marks.places[&'a'].others.len(), 2);

    let one = Trial::open("supercritical");
    assert!(!save::text(&one.session).unwrap().contains("beside"), "as files were before");
    let table = "[[present.beside]]\n";
    let more = format!("{table}q = 0.1\nv = 0.0\n").repeat(7) + table;
    let many = text.replacen(table, &more, 1);
    let refused = save::open(&mut opened, &many);
    assert!(refused.unwrap_err().contains("motions beside another; there can be 7"));
}

#[test]
fn the_ledger_has_the_works_of_every_motion_and_leads_to_their_starts() {
    let mut trial = Trial::open("supercritical");
    trial.press("i o");
    for (place, start) in [(0, 1.15), (1, 0.3), (2, 1.05)] {
        let problem = trial.session.problems()[place];
        assert_eq!(problem.initial, State { q: start, v: 0.0 });
    }
    assert_eq!([0, 1, 2].map(|place| trial.session.number(place)), [Some(3), Some(1), Some(2)]);
}
