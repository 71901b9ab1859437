//! Keys as a language: counts, macros, marks.

use super::Trial;
use crate::scene::{Answer, Layer};
use crate::session::replay::{Script, text};
use crate::session::{Listed, Overlay, Pending};

fn d(trial: &Trial) -> f64 {
    trial.session.problem.parameters.d
}

#[test]
fn a_count_presses_the_next_key_so_often_as_one_change() {
    let mut trial = Trial::open("plain");
    trial.press("*12l");
    assert_eq!(d(&trial), 0.02);
    assert_eq!(trial.session.history.depth(), (1, 0));
    trial.press("u");
    assert_eq!(d(&trial), -0.1);
    trial.press("<tab> 3<gt>");
    assert_eq!(d(&trial), -0.07);
    assert_eq!(trial.session.history.depth(), (1, 0));
}

#[test]
fn where_digits_are_values_they_stay_values_and_where_zero_fits_it_fits() {
    let mut trial = Trial::open("plain");
    trial.press("5");
    assert!(matches!(trial.session.overlay, Some(Overlay::Entry(_))));
    trial.press("<esc><tab> + 0");
    assert_eq!(trial.session.pending, None);
    assert_eq!(trial.session.plots[0].framing, crate::session::Framing::Fitted);
    trial.press("10");
    assert_eq!(trial.session.pending, Some(Pending::Count(10)));
    trial.press("<backspace>");
    assert_eq!(trial.session.pending, Some(Pending::Count(1)));
    trial.press("<esc>");
    assert_eq!(trial.session.pending, None);
    trial.press("99999999");
    assert_eq!(trial.session.pending, Some(Pending::Count(9999)));
}

#[test]
fn a_count_ends_where_the_key_is_refused_or_opens_something() {
    let mut trial = Trial::open("linear");
    trial.press("<tab> *9999?");
    assert!(matches!(trial.session.overlay, Some(Overlay::List(Listed::Palette, _))));
    trial.press("5j <esc>");
    trial.press("<S-tab> <right> <right> *50u");
    assert_eq!(trial.notice(), "nothing to undo");
    assert_eq!(trial.session.history.depth(), (0, 2));
    trial.press("<tab> 7<f12>");
    assert!(trial.notice().contains("no meaning here"), "{}", trial.notice());
}

#[test]
fn a_list_moves_by_a_count() {
    let mut trial = Trial::open("plain");
    trial.press("s3j");
    assert_eq!(trial.session.overlay.as_ref().unwrap().list().unwrap().selected, 3);
}

#[test]
fn keys_are_recorded_and_played_and_played_again() {
    let mut trial = Trial::open("plain");
    trial.press("&a <right*3> &");
    assert_eq!(trial.notice(), "register a has 3 keys");
    assert_eq!(text("", &trial.session.macros.registers[&'a']), "<right*3>\n");
    trial.press("@a");
    assert_eq!(d(&trial), -0.04);
    trial.press("@@");
    assert_eq!(d(&trial), -0.01);
    trial.press("*3@@");
    assert_eq!(d(&trial), 0.08);
    trial.press("u");
    assert_eq!(d(&trial), -0.01, "however often it is played, it is one change");
    trial.press("uu");
    assert_eq!((d(&trial), trial.session.history.depth()), (-0.07, (3, 3)));
    trial.press("@q");
    assert_eq!(trial.notice(), "register q is empty");
    trial.press("@?");
    assert_eq!(trial.notice(), "? is not a letter from a to z");
    assert_eq!(trial.session.overlay, None, "what was no letter does nothing else");
}

#[test]
fn what_is_played_while_recording_is_recorded_in_its_place() {
    let mut trial = Trial::open("plain");
    trial.press("&a <right> & &b *2@a <left> &");
    assert_eq!(text("", &trial.session.macros.registers[&'b']), "<right*2> <left>\n");
    // However recording is ended, what ends it is not recorded.
    trial.press("&c <right> :record-macro<enter>");
    assert_eq!(text("", &trial.session.macros.registers[&'c']), "<right>\n");
    trial.press("&d <right> <space>record-macro<enter>");
    assert_eq!(text("", &trial.session.macros.registers[&'d']), "<right>\n");
}

#[test]
fn a_register_is_one_change_whatever_it_changes() {
    let mut trial = Trial::open("plain");
    trial.press("&a <right> W &");
    let (plots, here) = (trial.session.plots.len(), d(&trial));
    trial.press("*2@a u");
    assert_eq!((trial.session.plots.len(), d(&trial)), (plots, here));
    trial.press("<C-r>");
    assert_eq!(trial.session.plots.len(), 4);
}

#[test]
fn a_macro_is_a_keystroke_file() {
    let mut trial = Trial::open("plain");
    trial.press("&a -0.3<enter> <tab>++ &");
    let file = text("hopfscope", &trial.session.macros.registers[&'a']);
    let mut other = Trial::open("plain");
    other.press(&file);
    assert_eq!(other.session.problem, trial.session.problem);
    assert_eq!(other.session.plots[0].window, trial.session.plots[0].window);
    assert_eq!(Script::repeated(&trial.session.macros.registers[&'a'], 2).keys(), 16);
}

#[test]
fn between_two_marks_nothing_is_computed_twice_and_the_other_one_is_a_ghost() {
    let mut trial = Trial::open("plain");
    trial.press("\"a <right*5> \"b");
    let there = trial.session.problem;
    let asked = trial.press("'a");
    assert_eq!(asked, [], "the answers of a marked point are kept");
    assert_eq!(d(&trial), -0.1);
    assert!(trial.session.layers.contains(&Layer::Ghost));
    let ghost = trial.session.marks.left.as_ref().expect("a ghost");
    assert_eq!(ghost.setup.problem, there);
    let left: Vec<&Answer> = trial.session.answers_left().collect();
    let [Answer::Trajectory(motion), Answer::Cycles(_)] = left[..] else { panic!("{left:?}") };
    assert_eq!(motion.problem, there);
    for keys in ["'b", "''", "''", "'b"] {
        assert_eq!(trial.press(keys), [], "{keys}");
    }
    assert_eq!(trial.session.problem, there);
    let parameters =
        trial.session.marks.left.as_ref().map(|ghost| ghost.setup.problem.parameters.d);
    assert_eq!(parameters, Some(-0.1));
    trial.press("'b");
    assert_eq!(trial.notice(), "here already");
    trial.press("u");
    assert_eq!(d(&trial), -0.1, "a jump is a change like another");
}

#[test]
fn a_mark_without_a_letter_or_a_point_is_refused() {
    let mut trial = Trial::open("plain");
    for (keys, said) in [
        ("'x", "there is no mark x"),
        ("''", "no mark has been gone to yet"),
        ("\"7", "7 is not a letter from a to z"),
        ("@@", "no register has been played yet"),
    ] {
        trial.press(keys);
        assert_eq!(trial.notice(), said);
    }
    trial.press("\"<C-c>");
    assert!(trial.session.quit);
}
