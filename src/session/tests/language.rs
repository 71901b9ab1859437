//! Combinations of keys: counts and marks.

use super::Trial;

#[test]
fn a_count_presses_the_next_key_so_often_as_one_change() {
    Trial::open("plain").goes(&[
        ("*12l", "D 0.02 | changes 1 0"),
        ("u", "D -0.1"),
        ("<tab> 3<gt>", "D -0.07 | changes 1 0"),
    ]);
}

#[test]
fn where_digits_are_values_they_stay_values_and_where_zero_fits_it_fits() {
    Trial::open("plain").goes(&[
        ("5", "open entry"),
        ("<esc><tab> + 0", "pending none | framing Fitted"),
        ("10", "pending Count(10)"),
        ("<backspace>", "pending Count(1)"),
        ("<esc>", "pending none"),
        ("99999999", "pending Count(9999)"),
        ("<esc*2> s3j", "list 3"),
    ]);
}

#[test]
fn a_count_ends_where_the_key_is_refused_or_opens_something() {
    Trial::open("linear").goes(&[
        ("<tab> *9999?", "open help"),
        ("? 5j <esc> <S-tab> <right> <right> *50u", "notice nothing to undo | changes 0 2"),
        ("<tab> 7<f11>", "notice ..no meaning here.."),
    ]);
}

#[test]
fn between_two_marks_nothing_is_computed_twice_and_the_other_one_is_a_ghost() {
    let mut trial = Trial::open("plain");
    trial
        .goes(&[("\"a <right*5> \"b", "D -0.05"), ("'a", "asked | D -0.1 | +ghost | ghost -0.05")]);
    let other = trial.session.other.as_deref().expect("the point left is on show");
    let left = trial.session.marks.left.as_ref().unwrap();
    assert_eq!(other.trajectory().map(|found| found.problem), Some(left.problem));
    assert!(other.cycles().is_some_and(|it| it.parameters == left.problem.parameters));
    trial.goes(&[
        ("'b", "asked"),
        ("''", "asked | D -0.1"),
        ("''", "asked"),
        ("'b", "asked | D -0.05 | ghost -0.1 | notice here already"),
        // A jump is a change like any other.
        ("u", "D -0.1"),
    ]);
}

#[test]
fn a_mark_without_a_letter_or_a_point_is_refused() {
    Trial::open("plain").goes(&[
        ("'x", "notice there is no mark x"),
        ("''", "notice no mark has been visited yet"),
        ("\"7", "notice 7 is not a letter from a to z"),
        ("\"<C-c>", "quit true"),
    ]);
}
