//! Typed and pasted values.

use super::Trial;
use crate::flow::Method;
use crate::session::{Effect, Entry, Listed, Msg, Overlay};

fn entry(trial: &Trial) -> &Entry {
    match &trial.session.overlay {
        Some(Overlay::Entry(entry)) => entry,
        other => panic!("no line is open but {other:?}"),
    }
}

#[test]
fn a_value_is_typed_from_its_first_digit_or_edited_after_enter() {
    let mut trial = Trial::open("plain");
    trial.press("-0.25<enter>");
    assert_eq!(trial.session.problem.parameters.d, -0.25);
    assert_eq!(trial.session.overlay, None);
    trial.press("<enter>");
    assert_eq!(entry(&trial).input.text(), "-0.25");
    trial.press("<left><backspace>3<enter>");
    assert_eq!(trial.session.problem.parameters.d, -0.35);
    trial.press("<enter><C-u>1e-3<home>-<enter>");
    assert_eq!(trial.session.problem.parameters.d, -1e-3);
    trial.press("<enter><home><del><end>5<esc>");
    assert_eq!(trial.session.problem.parameters.d, -1e-3, "esc leaves the value alone");
}

#[test]
fn what_cannot_be_a_value_is_refused_with_the_range() {
    for (row, typed, line) in [
        (3, "nan", "nan is no finite number; r takes 0 to 1e300"),
        (3, "1e400", "1e400 is no finite number; r takes 0 to 1e300"),
        (3, "-1", "r = -1 is out of range; r takes 0 to 1e300"),
        (3, "zero", "\"zero\" is not a number; r takes 0 to 1e300"),
        (3, "0,1", "\"0,1\" is not a number; r takes 0 to 1e300"),
        (6, "1e10", "until = 1e10 is out of range; until takes 0 to 1000000000"),
        (7, "euler", "no method \"euler\"; there are auto, exact, taylor, dop853"),
        (8, "1", "tolerance = 1 is out of range; tolerance takes 1e-15 to 0.01"),
    ] {
        let mut trial = Trial::open("plain");
        let before = trial.session.problem;
        trial.press(&format!("<down*{row}><enter><C-u>{typed}<enter>"));
        let refused = entry(&trial).refused.clone().unwrap_or_default();
        assert!(refused.starts_with(line), "{refused}");
        assert!(!refused.contains('\n'));
        assert_eq!(trial.session.problem, before);
        trial.press("<backspace>");
        assert_eq!(entry(&trial).refused, None, "the complaint goes when the text changes");
    }
}

#[test]
fn every_row_takes_its_values() {
    let mut trial = Trial::open("plain");
    trial.press("<down*6>99<enter> <down><enter><C-u>dop853<enter> <down>1e-12<enter>");
    let problem = trial.session.problem;
    assert_eq!((problem.until, problem.method, problem.tolerance), (99.0, Method::Dop853, 1e-12));
    trial.press("<home>");
    trial.press("<up*9>-0<enter>");
    assert!(trial.session.problem.parameters.d.is_sign_positive(), "zero has one sign");
}

#[test]
fn pasted_text_goes_into_the_open_line_or_opens_one() {
    let mut trial = Trial::open("plain");
    trial.press("<enter><C-u> <paste \"\u{2212}0.2\\n\"> <enter>");
    assert_eq!(trial.session.problem.parameters.d, -0.2);
    trial.press("<paste \" -0.3 \">");
    assert_eq!(entry(&trial).input.text(), "-0.3");
    trial.press("<enter>");
    assert_eq!(trial.session.problem.parameters.d, -0.3);
    trial.press("?/<paste \"undo\">");
    let Some(Overlay::List(Listed::Palette, list)) = &trial.session.overlay else {
        panic!("the help is open")
    };
    let names: Vec<_> = trial.session.palette_rows(list).iter().map(|row| row.name()).collect();
    assert_eq!(names[..2], ["undo", "redo"]);
}

#[test]
fn pasted_keystrokes_are_offered_and_played_only_after_a_yes() {
    let mut trial = Trial::open("plain");
    let before = trial.session.problem;
    trial.give(Msg::Paste("# a walk\n<right*5> <wait> q".to_owned()));
    assert!(matches!(&trial.session.overlay, Some(Overlay::Offer(script)) if script.keys() == 6));
    assert_eq!(trial.session.problem, before);
    trial.press("<esc>");
    assert_eq!((trial.effects.len(), &trial.session.overlay), (0, &None));
    trial.give(Msg::Paste("<right*5>".to_owned()));
    trial.press("<enter>");
    assert!(matches!(&trial.effects[..], [Effect::Play(script)] if script.keys() == 5));
    assert_eq!(trial.session.problem.parameters.d, -0.05);
}

#[test]
fn pasted_text_that_is_nothing_gets_one_line() {
    let mut trial = Trial::open("plain");
    trial.give(Msg::Paste("hello\n  <wrold>".to_owned()));
    assert_eq!(
        trial.notice().split("; ").next(),
        Some("the pasted text is no keystroke file: line 2, column 3: unknown key <wrold>")
    );
    trial.give(Msg::Paste("hello".to_owned()));
    assert!(trial.notice().starts_with("the pasted text names no key"), "{}", trial.notice());
    trial.give(Msg::Paste("# only a comment".to_owned()));
    assert_eq!(trial.notice(), "the pasted text presses no key");
    assert_eq!(trial.session.overlay, None);
}
