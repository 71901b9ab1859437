//! Several motions: started beside each other, taken away, undone, saved.

use super::Trial;
use crate::oscillator::State;
use crate::scene::Topic;
use crate::session::{Session, save};

/// Where the motions start, the oldest first.
fn starts(session: &Session) -> Vec<f64> {
    let mut starts: Vec<f64> = session.problems().iter().map(|problem| problem.initial.q).collect();
    starts.rotate_left(1);
    starts
}

/// In the scene the motion starts at 0.3; by hand the unstable cycle turns at 1.1.
#[test]
fn motions_are_started_beside_each_other_and_taken_away() {
    let first = Trial::open("supercritical").session.problem.initial.q;
    for (keys, expected) in [
        ("i", vec![first, 1.05]),
        ("i o", vec![first, 1.05, 1.15]),
        ("i o i", vec![first, 1.15, 1.05]),
        ("i i", vec![first, 1.05]),
        ("i o d", vec![first, 1.05]),
        ("i o d d", vec![first]),
        ("i o d d d", vec![first]),
        ("i o c", vec![1.15]),
        ("i o c d", vec![1.15]),
        ("i o u", vec![first, 1.05]),
        ("i o c u", vec![first, 1.05, 1.15]),
        ("i o d u", vec![first, 1.05, 1.15]),
        ("i o u u U U", vec![first, 1.05, 1.15]),
        ("i o R", vec![first]),
        ("i o R u", vec![first, 1.05, 1.15]),
        // The numbers are those of the newest, and the others stay.
        ("i o <down*3>2<enter>", vec![first, 1.05, 2.0]),
        ("\"a i o \"b 'a", vec![first]),
        ("\"a i o \"b 'a 'b", vec![first, 1.05, 1.15]),
    ] {
        let mut trial = Trial::open("supercritical");
        trial.press(keys);
        assert_eq!(starts(&trial.session), expected, "{keys}");
    }
}

#[test]
fn enter_in_the_phase_plane_adds_a_motion_and_of_too_many_the_oldest_gives_way() {
    let mut trial = Trial::open("supercritical");
    let first = trial.session.problem.initial;
    trial.press("<tab><up><enter>");
    assert_eq!(trial.session.others.all(), [first]);
    trial.press("<right><enter> <right><enter> <right><enter> <right><enter> <right><enter>");
    trial.press("<right><enter>");
    assert_eq!((trial.session.problems().len(), trial.notice()), (8, ""));
    trial.press("<right><enter>");
    assert_eq!(trial.notice(), "8 motions at most: the oldest gave way");
    assert_eq!(trial.session.problems().len(), 8);
    assert!(!trial.session.others.all().contains(&first));
    trial.press("c");
    assert_eq!((trial.session.problems().len(), trial.session.number(0)), (1, None));
    trial.press("d");
    assert_eq!(trial.notice(), "one motion is on show, and stays");
}

#[test]
fn each_motion_is_a_question_of_its_own() {
    use Topic::{Cycles, Trajectory};
    let mut trial = Trial::open("supercritical");
    assert_eq!(trial.press("i"), [Trajectory], "the other one is known");
    assert_eq!(trial.press("o"), [Trajectory]);
    assert_eq!(trial.press("<right>"), [Trajectory, Trajectory, Trajectory, Cycles]);
    assert_eq!(trial.press("<down*3><right>"), [Trajectory], "a step of q0 is one of the newest");
    assert_eq!(trial.press("d"), []);
    let starts = trial.session.motions().into_iter().map(|(_, motion)| motion.problem.initial.q);
    assert_eq!(starts.collect::<Vec<_>>(), [1.05, 0.3]);
}

#[test]
fn a_saved_session_keeps_motions_their_marks_and_their_history() {
    let mut trial = Trial::open("supercritical");
    trial.press("i o \"a c i");
    let text = save::text(&trial.session).unwrap();
    let mut opened = Trial::open("capture").session;
    save::open(&mut opened, &text).unwrap();
    assert_eq!(opened.setup(), trial.session.setup());
    assert_eq!(starts(&opened), [1.15, 1.05]);
    assert_eq!(opened.history, trial.session.history);
    assert_eq!(
        opened.marks.places[&'a'].setup.others,
        trial.session.marks.places[&'a'].setup.others
    );
    assert_eq!(opened.marks.places[&'a'].setup.others.all().len(), 2);
    assert_eq!(save::text(&opened).unwrap(), text);

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
