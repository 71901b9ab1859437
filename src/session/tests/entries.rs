//! Typed and pasted values.

use super::facts::refuses;
use super::{Trial, open_list};
use crate::session::Effect;

#[test]
fn a_value_is_typed_from_its_first_digit_or_edited_after_enter() {
    Trial::open("plain").goes(&[
        ("-0.25<enter>", "D -0.25 | open none"),
        ("<enter>", "typed -0.25"),
        ("<left><backspace>3<enter>", "D -0.35"),
        ("<enter><C-u>1e-3<home>-<enter>", "D -0.001"),
        // Escape leaves the value alone.
        ("<enter><home><del><end>5<esc>", "D -0.001"),
        ("<down*6>99<enter>", "until 99"),
        ("<down><enter><C-u>dop853<enter> <down>1e-12<enter>", "method dop853 | tolerance 1e-12"),
    ]);
    let mut trial = Trial::open("plain");
    trial.press("-0<enter>");
    assert!(trial.session.problem.parameters.d.is_sign_positive(), "zero has one sign");
}

#[test]
fn what_cannot_be_a_value_is_refused_with_the_range() {
    let [r, until, method, tolerance] = [3, 6, 7, 8];
    for (row, typed, said) in [
        (r, "nan", "\"nan\" is not a number; r takes 0 .. 1e150"),
        (r, "1e400", "\"1e400\" is not a finite number; r takes 0 .. 1e150"),
        (r, "-1", "r = -1 is outside its range 0 .. 1e150"),
        (r, "1e-151", "r = 1e-151 is too close to 0; allowed: 0, or 1e-150 and more"),
        (r, "zero", "\"zero\" is not a number; r takes 0 .. 1e150"),
        (r, "0,1", "\"0,1\" is not a number; r takes 0 .. 1e150"),
        (until, "1e10", "until = 10000000000 is outside its range 0 .. 1e9"),
        (method, "euler", "no method \"euler\"; there are auto, exact, taylor, dop853"),
        (tolerance, "1", "tolerance = 1 is outside its range 1e-15 .. 0.01"),
    ] {
        refuses("plain", &[(&format!("<down*{row}><enter><C-u>{typed}<enter>"), said)]);
    }
}

#[test]
fn a_step_beyond_the_range_stops_at_its_end() {
    Trial::open("plain").goes(&[
        ("<enter><C-u>1e6<enter><right>", "D 1000000 | notice D is at its maximum, 1e6"),
        ("<down*3><enter><C-u>0<enter><left>", "r 0 | notice r is at its minimum, 0"),
        ("<down*3><enter><C-u>0<enter><left>", "until 0 | notice until is at its minimum, 0"),
    ]);
}

#[test]
fn pasted_text_goes_into_the_open_line_or_opens_one() {
    let mut trial = Trial::open("plain");
    trial.goes(&[
        ("<enter><C-u> <paste \"\u{2212}0.2\\n\"> <enter>", "D -0.2"),
        ("<paste \" -0.3 \">", "typed -0.3"),
        ("<enter>", "D -0.3"),
        ("?/<paste \"undo\">", "open Palette"),
    ]);
    let list = open_list(&trial.session).unwrap();
    let names: Vec<_> = trial.session.palette_rows(list).iter().map(|row| row.name()).collect();
    // There is something to undo, and nothing to redo.
    assert_eq!((names[0], names.last()), ("undo", Some(&"redo")));
}

#[test]
fn pasted_keystrokes_are_offered_and_played_only_after_a_yes() {
    let mut trial = Trial::open("plain");
    trial.goes(&[
        ("<paste \"# a walk\\n<right*5> <wait> q\">", "open offer of 6 keys | D -0.1"),
        ("<esc>", "open none"),
    ]);
    assert_eq!(trial.effects, []);
    trial.goes(&[("<paste \"<right*5>\"><enter>", "D -0.05")]);
    assert!(matches!(&trial.effects[..], [Effect::Play(script)] if script.keys() == 5));
}

#[test]
fn pasted_text_that_is_nothing_gets_one_line() {
    const WRONG: &str =
        "notice the pasted text is not a keystroke file: line 2, column 3: unknown key <wrold>; ..";
    Trial::open("plain").goes(&[
        ("<paste \"hello\\n  <wrold>\">", WRONG),
        ("<paste \"hello\">", "notice the pasted text names no key.."),
        ("<paste \"# only a comment\">", "notice the pasted text presses no key | open none"),
    ]);
}
