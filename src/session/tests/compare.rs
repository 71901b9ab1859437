//! A beside B: a pinned state and the present one.

use super::Trial;
use crate::scene::{Request, Topic};
use crate::session::{EarlierState, Effect, Session, save};

/// The value of D of the present state and of the pinned one, with their letters.
fn told(session: &Session) -> String {
    let Some([present, pinned]) = session.letters() else {
        return format!("{}", session.problem.parameters.d);
    };
    let there = session.marks.left.as_ref().unwrap().problem.parameters.d;
    format!("{present} {} | {pinned} {there}", session.problem.parameters.d)
}

/// Presses keys and says which is which.
fn after(trial: &mut Trial, keys: &str) -> String {
    trial.press(keys);
    told(&trial.session)
}

#[test]
fn a_pinned_state_stays_while_keys_change_the_other_and_swapping_computes_nothing() {
    for scene in ["plain", "supercritical", "slow-belt", "linear"] {
        let mut trial = Trial::open(scene);
        trial.goes(&[("p", "asked | notice A is pinned.."), ("<right*2>", "notice")]);
        let [a, b] = [trial.session.marks.left.clone().unwrap(), trial.session.setup()];
        assert_ne!(a, b, "{scene}");
        trial.goes(&[("b", "asked | notice A is present: .. | changes 3 0")]);
        assert_eq!((trial.session.setup(), trial.session.marks.left.clone()), (a, Some(b)));
        trial.goes(&[
            ("b", "asked | notice B is present: .."),
            ("''", "asked | notice A is present: .."),
        ]);
    }
}

#[test]
fn everything_that_is_drawn_of_both_is_asked_of_both_and_nothing_else() {
    let mut trial = Trial::open("plain");
    let alone = trial.session.wants();
    trial.press("p");
    assert_eq!(trial.session.wants(), alone, "they are the same so far");
    trial.press("<right> <down> <down> <right>");
    let asked = trial.session.wants();
    let of = |topic: Topic| asked.iter().filter(|it| it.topic() == topic).count();
    assert_eq!([Topic::Trajectory, Topic::Cycles, Topic::Branch].map(of), [2, 2, 2]);
    assert_eq!([Topic::Proof, Topic::Capture].map(of), [1, 0]);
    // The branch over D is that of both where D alone differs.
    trial.press("<down*9> u");
    let branches = trial.session.wants().into_iter();
    let branches: Vec<Request> = branches.filter(|it| it.topic() == Topic::Branch).collect();
    assert_eq!(branches.len(), 1);
}

#[test]
fn escape_takes_the_cursor_first_and_then_lets_go() {
    Trial::open("plain").goes(&[
        ("p <tab> <right>", "cursor .."),
        ("<esc>", "cursor none | notice"),
        ("<esc>", "notice A is let go | ghost none"),
        ("b", "notice nothing is pinned: p pins the present state"),
        ("p b", "notice A and B are the same"),
    ]);
}

#[test]
fn undo_and_redo_never_lose_the_pinned_state() {
    let mut trial = Trial::open("plain");
    for (keys, expected) in [
        ("p <right>", "B -0.09 | A -0.1"),
        ("u", "B -0.1 | A -0.1"),
        ("U b", "A -0.1 | B -0.09"),
        ("<right*2>", "A -0.08 | B -0.09"),
        // An exchange is one of the steps, and both come back where they were.
        ("u u", "A -0.1 | B -0.09"),
        ("u", "B -0.09 | A -0.1"),
        ("u", "B -0.1 | A -0.1"),
        ("U U U U", "A -0.08 | B -0.09"),
        // A state that was pinned since is kept.
        ("p u u u", "B -0.09 | A -0.08"),
    ] {
        assert_eq!(after(&mut trial, keys), expected, "{keys}");
    }
}

#[test]
fn the_pinned_state_goes_with_the_oscillator_into_another_scene() {
    let mut trial = Trial::open("plain");
    trial.goes(&[
        ("p <right>", "ghost -0.1"),
        (": scene supercritical", "ghost -0.1"),
        (": belt clutch", "ghost none | notice A is let go"),
        ("p <down*7><right> R", "notice scene clutch as it was opened"),
    ]);
    assert!(trial.session.marks.pinned.is_some(), "it is the same machine");
    // Of a machine the units can differ, and with them what the same start means.
    let mut trial = Trial::open("slow-belt");
    trial.press("p");
    assert_eq!(trial.session.units_beside(0), [1.0; 2]);
    trial.press(":set<space>belt=0.3<enter>");
    let [length, velocity] = trial.session.units_beside(0);
    assert!(length != 1.0 && (velocity / length - 1.0).abs() < 1e-12, "the frequency is the same");
}

#[test]
fn a_mark_is_visited_while_another_state_stays_pinned() {
    Trial::open("plain").goes(&[
        ("\"m <right> p <right> 'm", "D -0.1 | ghost -0.09 | -ghost"),
        ("<esc>", "ghost none"),
        ("<right*3> 'm", "D -0.1 | ghost -0.07 | +ghost"),
    ]);
}

#[test]
fn a_saved_session_keeps_both_and_what_is_computed_of_them() {
    let mut trial = Trial::open("slow-belt");
    trial.press("p <right*2> b <right>");
    let text = save::text(&trial.session).unwrap();
    assert!(text.contains("pinned = \"B\""), "{text}");
    let swaps = |it: &&EarlierState| matches!(it, EarlierState::Swap(_));
    assert_eq!(trial.session.history.past.iter().filter(swaps).count(), 1);
    let mut opened = trial.session.clone();
    save::open(&mut opened, &text).unwrap();
    assert_eq!((told(&opened), opened.wants()), (told(&trial.session), trial.session.wants()));
    assert_eq!(opened.history, trial.session.history);
    assert!(!opened.is_busy(), "answers that fit stay");
    let wrong = text.replace("pinned = \"B\"", "pinned = \"C\"");
    assert!(save::open(&mut opened, &wrong).unwrap_err().starts_with("line "));
}

#[test]
fn pasted_assignments_are_one_change_and_what_is_wrong_with_them_is_said() {
    Trial::open("plain").goes(&[
        (
            "<paste \"D=-0.3 r=0.2\">",
            "D -0.3 | r 0.2 | changes 1 0 | notice pasted: D = -0.3, r = 0.2",
        ),
        ("<paste \"D = -0.2,\\n  D3 = 0.5\\n\">", "D -0.2 | D3 0.5 | r 0.2 | changes 2 0"),
        ("<paste \"D=-0.2\">", "changes 2 0 | notice pasted: nothing differs"),
        // What was copied at a point of a branch says what was computed there, too.
        ("<paste \"D=-0.4 q_max=1.2 period=6.3 q_min=-1.2 r=0.1\">", "D -0.4 | r 0.1"),
        (
            "<paste \"D=-0.1 rr=0.2\">",
            "D -0.4 | notice pasted: no number \"rr\"; did you mean r?..",
        ),
        (
            "<paste \"D=-0.1 r=much\">",
            "D -0.4 | notice pasted: \"much\" is not a number; r takes..",
        ),
        ("<paste \"D=-0.1 r=-1\">", "D -0.4 | notice pasted: r = -1 is outside its range.."),
        ("<paste \"<right>\">", "open offer of 1 keys"),
        ("n<tab><paste \"D=-0.5\">", "D -0.5"),
        // Into an open line it goes as text.
        (":<paste \"set D=1\">", "typed set D=1"),
    ]);
    Trial::open("slow-belt").goes(&[
        ("<paste \"belt=30 cm/s R=0.5 N\">", "notice pasted: .. | changes 1 0"),
        ("<paste \"belt=30 kg\">", "notice pasted: .. | changes 1 0"),
    ]);
}

#[test]
fn what_is_copied_with_all_that_belongs_to_it_is_set_when_it_is_pasted() {
    for (scene, keys) in [
        ("supercritical", ""),
        ("supercritical", "<tab><right*3>"),
        ("supercritical", "<tab><tab>w<right*4>"),
        ("slow-belt", "<down*7>"),
        ("slow-belt", "<tab*4><right*2>"),
    ] {
        let mut trial = Trial::open(scene);
        trial.press(keys);
        trial.press("<A-r>");
        let copied = trial.effects.iter().rev().find_map(|effect| match effect {
            Effect::Copy(text) => Some(text.clone()),
            _ => None,
        });
        let copied = copied.unwrap_or_else(|| panic!("{scene} {keys}: {:?}", trial.notice()));
        trial.press(&format!("<esc><paste {copied:?}>"));
        assert!(trial.notice().starts_with("pasted: "), "{scene} {keys} {copied}");
        let refused = trial.session.notice.as_ref().is_some_and(|notice| notice.error);
        assert!(!refused, "{copied}: {}", trial.notice());
    }
}

#[test]
fn assignments_are_typed_on_the_command_line_and_behind_the_letter_of_damping() {
    Trial::open("plain").goes(&[
        (":D=-0.3<space>r=0.2<enter>", "D -0.3 | r 0.2 | changes 1 0"),
        ("D=-0.25<enter>", "D -0.25"),
        ("D3=0.5<enter>", "D3 0.5"),
        ("<tab>D2<space>=<space>0.1<enter>", "D2 0.1"),
        ("D4=1<enter>", "refused set: no number \"D4\".. | open prompt"),
    ]);
}
