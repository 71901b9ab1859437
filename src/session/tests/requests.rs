//! A key recomputes only what depends on it.

use super::{COST, Trial, answered};
use crate::flow::Reason;
use crate::model::Parameters;
use crate::question::NoAnswer;
use crate::scene::{Request, Topic};
use crate::session::{Msg, update};

const MOTION: &[Topic] = &[Topic::Trajectory];
const MEASURED: &[Topic] = &[Topic::Trajectory, Topic::Reference];
const BRANCH: &[Topic] = &[Topic::Branch];
const POINT: &[Topic] = &[Topic::Trajectory, Topic::Cycles];

#[test]
fn a_key_recomputes_exactly_what_depends_on_it() {
    for (keys, recomputed) in [
        ("m", MEASURED), // the method integrates the motion
        ("}", &[Topic::Trajectory, Topic::Branch, Topic::Reference]), // cycles are computed to rounding
        ("[ ] x x <tab> <S-tab> ? <esc> g T", &[]),                   // looks and lists
        ("<tab>+-", &[]),        // the phase plane is drawn from its answers
        ("<tab><tab>+", BRANCH), // the diagram computes what it shows
        ("<tab><tab>L", BRANCH),
        ("<tab><tab>J", &[]),
        ("<tab><right><up>", &[]),
        ("<tab><right><enter>", MOTION),
        ("<tab><tab><right><enter>", POINT),
        ("i", MOTION),
        ("<tab><tab>X", BRANCH),          // another parameter, another branch
        ("<tab><tab>Y Y Y Y Y Y Y", &[]), // another look at the same cycles
        ("<tab><tab>w <left> <tab> <S-right> Y <esc>", &[]),
        ("<tab><tab>w <right> <enter>", POINT),
        ("va<esc>", &[Topic::Capture]),
        ("<run \"kicks q=0+-0.1,v=0+-0.05\">", &[Topic::Kicks]),
        ("vn<esc> ) (", &[Topic::Balance, Topic::Balance]), // another N, another answer; the first is known
        ("va<esc> <tab>L K vaa<esc>", &[Topic::Capture]),   // as far as the next power of two
    ] {
        let mut trial = Trial::alone("supercritical");
        assert_eq!(trial.press(keys), recomputed, "{keys}");
    }
}

#[test]
fn a_hidden_layer_asks_nothing() {
    let mut trial = Trial::alone("supercritical");
    trial.goes(&[
        ("<run \"layer trajectory\">", "-trajectory"),
        ("<right>", "asked Cycles"),
        // Cycles and basin share an answer, which is needed as long as one of them is on.
        ("<run \"layer cycles\">", "-cycles"),
        ("<right>", "asked Cycles"),
        ("<run \"layer basin\"><run \"layer margin\">", "-basin | -margin"),
        ("<right>", "asked"),
        ("<run \"layer branch\"><run \"layer special\">", "-branch | -special"),
    ]);
    assert_eq!(trial.session.wants(), []);
    assert_eq!(trial.session.requirements(), []);
    trial.goes(&[
        ("<right> <down><right> } <down*7>", "asked"),
        ("<home><down><right> <run \"layer branch\">", "asked Branch"),
    ]);
}

#[test]
fn what_was_answered_or_is_replaced_by_another_plot_is_not_asked() {
    let twice = "<run \"layer trajectory\"><run \"layer cycles\"><run \"layer branch\">".repeat(2);
    Trial::alone("supercritical").goes(&[
        (&twice, "asked"),
        ("<down*3>", "asked"),
        // The way back is known.
        ("<right>u", "asked Trajectory"),
    ]);
    Trial::alone("supercritical").goes(&[
        ("<tab> z <S-tab>", ""),
        ("<down><right>", "asked Trajectory Cycles"),
        // The diagram becomes visible, up to date.
        ("<tab><tab>", "asked Branch"),
    ]);
}

#[test]
fn terms_that_a_scene_does_not_declare_are_zero_until_the_user_unfolds_them() {
    let mut trial = Trial::open("capture");
    let Parameters { d2, d3, .. } = trial.session.problem.parameters;
    assert_eq!((d2, d3), (0.0, 0.0));
    let linear = |request: &Request| format!("{request:?}").contains("d2: 0.0, d3: 0.0");
    assert!(trial.session.wants().iter().all(linear), "{:?}", trial.session.wants());
    trial.goes(&[
        ("", "rows D r q0 v0 until method tolerance"),
        ("x", "rows D D2 D3 r w q0 v0 until method tolerance"),
        // A term that is not zero is not hidden.
        ("<down*2><right>x", "rows D D3 r q0 v0 until method tolerance"),
        ("<left>", "rows D r q0 v0 until method tolerance | selected r"),
    ]);
}

#[test]
fn the_price_of_a_key_is_what_it_made_necessary() {
    let mut trial = Trial::alone("supercritical");
    assert_eq!(trial.session.price.key, None);
    assert_eq!(trial.session.price.evaluations(), 3 * COST, "the first picture");
    trial.press("<right>");
    let price = &trial.session.price;
    assert_eq!(price.key, "<right>".parse().ok());
    assert_eq!(price.recomputed.iter().map(|part| part.topic).collect::<Vec<_>>(), POINT);
    assert_eq!(price.evaluations(), 2 * COST);
    assert!((price.seconds() - 0.002).abs() < 1e-15);
    trial.press("<down>");
    assert_eq!(trial.session.price.evaluations(), 0);
}

#[test]
fn an_old_picture_stays_and_is_known_to_be_old() {
    let mut trial = Trial::open("plain");
    let before = trial.session.trajectory().cloned();
    update(&mut trial.session, Msg::Key("<right>".parse().unwrap()));
    assert!(trial.session.is_busy() && trial.session.is_stale(Topic::Trajectory, 1));
    assert!(!trial.session.is_stale(Topic::Branch, 1));
    assert_eq!(trial.session.trajectory().cloned(), before);
    trial.settle();
    assert!(!trial.session.is_stale(Topic::Trajectory, 1));
}

#[test]
fn a_late_answer_never_replaces_the_one_that_is_asked_for() {
    let mut trial = Trial::open("plain");
    update(&mut trial.session, Msg::Key("<right>".parse().unwrap()));
    let superseded = trial.session.request(Topic::Trajectory, 1).unwrap();
    trial.press("u");
    let held = trial.session.trajectory().cloned();
    update(&mut trial.session, answered(superseded.clone()));
    assert_eq!(trial.session.trajectory().cloned(), held);
    // While something else is still being computed, this is the newest answer.
    update(&mut trial.session, Msg::Key("<left>".parse().unwrap()));
    update(&mut trial.session, answered(superseded.clone()));
    let Request::Trajectory { problem, .. } = superseded else {
        panic!("a trajectory was asked for")
    };
    assert_eq!(trial.session.trajectory().unwrap().problem, problem);
    assert!(trial.session.is_stale(Topic::Trajectory, 1));
}

#[test]
fn a_failure_is_told_once_and_not_tried_again() {
    let mut trial = Trial::open("plain");
    update(&mut trial.session, Msg::Key("<right>".parse().unwrap()));
    let request = trial.session.request(Topic::Cycles, 1).unwrap();
    let failed = |failure| Msg::answered(request.clone(), Err(failure), 0.0);
    update(&mut trial.session, failed(NoAnswer::Reason(Reason::Interrupted)));
    assert!(trial.session.is_open(&request), "an interrupted question is still a question");
    update(&mut trial.session, failed(NoAnswer::Reason(Reason::OutOfRange)));
    assert!(!trial.session.is_open(&request));
    assert!(trial.session.failure(Topic::Cycles, 1).is_some());
    assert_eq!(trial.notice(), "cycles: left the range of floating-point numbers; F5 tries again");
    assert!(trial.session.is_stale(Topic::Cycles, 1) && trial.session.cycles().is_some());
    trial.settle();
    assert_eq!(trial.press("<f5>"), [Topic::Cycles]);
    assert!(!trial.session.is_stale(Topic::Cycles, 1));
    assert_eq!(trial.press("<right>"), POINT, "another value is another question");
    assert_eq!(trial.session.failure(Topic::Cycles, 1), None);
}
