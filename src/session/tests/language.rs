//! Keys as a language: counts, macros, marks.

use super::Desk;
use crate::scene::{Answer, Layer};
use crate::session::replay::{Script, text};
use crate::session::{Listed, Overlay, Pending};

fn d(desk: &Desk) -> f64 {
    desk.session.problem.parameters.d
}

#[test]
fn a_count_presses_the_next_key_so_often_as_one_change() {
    let mut desk = Desk::open("plain");
    desk.press("*12l");
    assert_eq!(d(&desk), 0.02);
    assert_eq!(desk.session.history.depth(), (1, 0));
    desk.press("u");
    assert_eq!(d(&desk), -0.1);
    desk.press("<tab> 3<gt>");
    assert_eq!(d(&desk), -0.07);
    assert_eq!(desk.session.history.depth(), (1, 0));
}

#[test]
fn where_digits_are_values_they_stay_values_and_where_zero_fits_it_fits() {
    let mut desk = Desk::open("plain");
    desk.press("5");
    assert!(matches!(desk.session.overlay, Some(Overlay::Entry(_))));
    desk.press("<esc><tab> + 0");
    assert_eq!(desk.session.pending, None);
    assert_eq!(desk.session.plots[0].framing, crate::session::Framing::Fitted);
    desk.press("10");
    assert_eq!(desk.session.pending, Some(Pending::Count(10)));
    desk.press("<backspace>");
    assert_eq!(desk.session.pending, Some(Pending::Count(1)));
    desk.press("<esc>");
    assert_eq!(desk.session.pending, None);
    desk.press("99999999");
    assert_eq!(desk.session.pending, Some(Pending::Count(9999)));
}

#[test]
fn a_count_ends_where_the_key_is_refused_or_opens_something() {
    let mut desk = Desk::open("linear");
    desk.press("<tab> *9999?");
    assert!(matches!(desk.session.overlay, Some(Overlay::List(Listed::Palette, _))));
    desk.press("5j <esc>");
    desk.press("<S-tab> <right> <right> *50u");
    assert_eq!(desk.notice(), "nothing to undo");
    assert_eq!(desk.session.history.depth(), (0, 2));
    desk.press("<tab> 7<f12>");
    assert!(desk.notice().contains("no meaning here"), "{}", desk.notice());
}

#[test]
fn a_list_moves_by_a_count() {
    let mut desk = Desk::open("plain");
    desk.press("s3j");
    assert_eq!(desk.session.overlay.as_ref().unwrap().list().unwrap().selected, 3);
}

#[test]
fn keys_are_recorded_and_played_and_played_again() {
    let mut desk = Desk::open("plain");
    desk.press("&a <right*3> &");
    assert_eq!(desk.notice(), "register a has 3 keys");
    assert_eq!(text("", &desk.session.macros.registers[&'a']), "<right*3>\n");
    desk.press("@a");
    assert_eq!(d(&desk), -0.04);
    desk.press("@@");
    assert_eq!(d(&desk), -0.01);
    desk.press("*3@@");
    assert_eq!(d(&desk), 0.08);
    desk.press("@q");
    assert_eq!(desk.notice(), "register q is empty");
    desk.press("@?");
    assert_eq!(desk.notice(), "? is no letter from a to z");
    assert_eq!(desk.session.overlay, None, "what was no letter does nothing else");
}

#[test]
fn what_is_played_while_recording_is_recorded_in_its_place() {
    let mut desk = Desk::open("plain");
    desk.press("&a <right> & &b *2@a <left> &");
    assert_eq!(text("", &desk.session.macros.registers[&'b']), "<right*2> <left>\n");
    // However recording is ended, what ends it is not recorded.
    desk.press("&c <right> :record-macro<enter>");
    assert_eq!(text("", &desk.session.macros.registers[&'c']), "<right>\n");
    desk.press("&d <right> <space>record-macro<enter>");
    assert_eq!(text("", &desk.session.macros.registers[&'d']), "<right>\n");
}

#[test]
fn a_macro_is_a_keystroke_file() {
    let mut desk = Desk::open("plain");
    desk.press("&a -0.3<enter> <tab>++ &");
    let file = text("hopfscope", &desk.session.macros.registers[&'a']);
    let mut other = Desk::open("plain");
    other.press(&file);
    assert_eq!(other.session.problem, desk.session.problem);
    assert_eq!(other.session.plots[0].window, desk.session.plots[0].window);
    assert_eq!(Script::repeated(&desk.session.macros.registers[&'a'], 2).keys(), 16);
}

#[test]
fn between_two_marks_nothing_is_computed_twice_and_the_other_one_is_a_ghost() {
    let mut desk = Desk::open("plain");
    desk.press("\"a <right*5> \"b");
    let there = desk.session.problem;
    let asked = desk.press("'a");
    assert_eq!(asked, [], "the answers of a marked point are kept");
    assert_eq!(d(&desk), -0.1);
    assert!(desk.session.layers.contains(&Layer::Ghost));
    let ghost = desk.session.marks.left.as_ref().expect("a ghost");
    assert_eq!(ghost.stand.problem, there);
    let left: Vec<&Answer> = desk.session.answers_left().collect();
    let [Answer::Trajectory(motion), Answer::Cycles(_)] = left[..] else { panic!("{left:?}") };
    assert_eq!(motion.problem, there);
    for keys in ["'b", "''", "''", "'b"] {
        assert_eq!(desk.press(keys), [], "{keys}");
    }
    assert_eq!(desk.session.problem, there);
    let parameters = desk.session.marks.left.as_ref().map(|ghost| ghost.stand.problem.parameters.d);
    assert_eq!(parameters, Some(-0.1));
    desk.press("'b");
    assert_eq!(desk.notice(), "here already");
    desk.press("u");
    assert_eq!(d(&desk), -0.1, "a jump is a change like another");
}

#[test]
fn a_mark_without_a_letter_or_a_point_is_refused() {
    let mut desk = Desk::open("plain");
    for (keys, said) in [
        ("'x", "there is no mark x"),
        ("''", "no mark has been gone to yet"),
        ("\"7", "7 is no letter from a to z"),
        ("@@", "no register has been played yet"),
    ] {
        desk.press(keys);
        assert_eq!(desk.notice(), said);
    }
    desk.press("\"<C-c>");
    assert!(desk.session.quit);
}
