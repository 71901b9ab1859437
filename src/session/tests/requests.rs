//! A key recomputes what depends on it and nothing else.

use super::{COST, Desk, answered};
use crate::flow::Reason;
use crate::oscillator::{Parameters, Symbol};
use crate::question;
use crate::question::Failure;
use crate::scene::{Answered, Request, Topic};
use crate::session::{Msg, update};

const MOTION: &[Topic] = &[Topic::Trajectory];
const MEASURED: &[Topic] = &[Topic::Trajectory, Topic::Reference];
const BRANCH: &[Topic] = &[Topic::Branch];
const POINT: &[Topic] = &[Topic::Trajectory, Topic::Cycles];
const ALL: &[Topic] = &[Topic::Trajectory, Topic::Cycles, Topic::Branch];

#[test]
fn a_key_recomputes_exactly_what_depends_on_it() {
    for (keys, recomputed) in [
        ("<right>", POINT),          // D is the abscissa of the branch
        ("<down><right>", ALL),      // D3 of this scene
        ("<down*2><right>", ALL),    // r
        ("<down*3><right>", MOTION), // q0
        ("<down*4><right>", MOTION), // v0
        ("<down*5><right>", MOTION), // until
        ("m", MEASURED),             // the method integrates the motion
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
        ("vn<esc> ) (", &[Topic::Balance, Topic::Balance]), // another N, another answer; the first is known
        ("va<esc> <tab>L K vaa<esc>", &[Topic::Capture]),   // as far as the next power of two
    ] {
        let mut desk = Desk::open("supercritical");
        let selecting = keys.trim_end_matches("<right>");
        if keys.starts_with("<down") {
            assert_eq!(desk.press(selecting), [], "{selecting}");
            assert_eq!(desk.press("<right>"), recomputed, "{keys}");
        } else {
            assert_eq!(desk.press(keys), recomputed, "{keys}");
        }
    }
}

#[test]
fn a_hidden_layer_asks_nothing() {
    let mut desk = Desk::open("supercritical");
    desk.press("<run \"layer trajectory\">");
    assert_eq!(desk.press("<right>"), [Topic::Cycles]);
    // Cycles and basin share an answer: it is needed as long as one of them is on.
    desk.press("<run \"layer cycles\">");
    assert_eq!(desk.press("<right>"), [Topic::Cycles]);
    desk.press("<run \"layer basin\">");
    assert_eq!(desk.press("<right>"), []);
    desk.press("<run \"layer branch\"><run \"layer special\">");
    assert_eq!(desk.session.wants(), []);
    assert_eq!(desk.press("<down><right> <run \"layer branch\">"), BRANCH);
}

#[test]
fn a_plot_that_the_other_has_replaced_asks_nothing() {
    let mut desk = Desk::open("supercritical");
    desk.press("<tab> z <S-tab>");
    assert_eq!(desk.press("<down><right>"), POINT);
    assert_eq!(desk.press("<tab><tab>"), BRANCH, "the diagram comes to the front, up to date");
}

#[test]
fn what_was_answered_is_not_asked_again() {
    let mut desk = Desk::open("supercritical");
    assert_eq!(desk.press("<run \"layer trajectory\"><run \"layer trajectory\"><run \"layer cycles\"><run \"layer cycles\"><run \"layer branch\"><run \"layer branch\">"), []);
    assert_eq!(desk.press("<down*3>"), []);
    assert_eq!(desk.press("<right>u"), [Topic::Trajectory], "the way back is known");
}

#[test]
fn terms_that_a_scene_does_not_declare_are_zero_until_the_user_unfolds_them() {
    let mut desk = Desk::open("capture");
    let Parameters { d2, d3, .. } = desk.session.problem.parameters;
    assert_eq!((d2, d3), (0.0, 0.0));
    for request in desk.session.wants() {
        let parameters = match request {
            Request::Claims(question::claims::Asked) | Request::Fit(_) => continue,
            Request::Trajectory(problem) => problem.parameters,
            Request::Machine(_)
            | Request::Portrait(_)
            | Request::MachineZones(_)
            | Request::Speeds(_) => unreachable!("the scene is of no machine"),
            Request::Zones(question::zones::Asked { known, .. }) => known.middle(),
            Request::Cycles(question::cycles::Asked { parameters })
            | Request::Capture(question::capture::Asked { parameters, .. })
            | Request::Balance(question::balance::Asked { parameters, .. })
            | Request::ReturnMap(question::return_map::Asked { parameters, .. })
            | Request::Regimes(question::regimes::Asked { parameters, .. })
            | Request::Branch(question::branch::Asked { parameters, .. })
            | Request::Trade(question::trade::Asked { parameters, .. })
            | Request::Reference(question::reference::Asked { parameters, .. }) => parameters,
            Request::Scan(_) => unreachable!("nobody asked for a scan"),
        };
        assert!(parameters.is_piecewise_linear());
    }
    let names = |desk: &Desk| {
        desk.session.rows().iter().map(|row| row.name()).collect::<Vec<_>>().join(" ")
    };
    assert_eq!(names(&desk), "D r q0 v0 until method tolerance");
    desk.press("x");
    assert_eq!(names(&desk), "D D2 D3 r w q0 v0 until method tolerance");
    desk.press("<down*2><right>x");
    assert_eq!(
        names(&desk),
        "D D3 r q0 v0 until method tolerance",
        "a term in effect is not hidden"
    );
    desk.press("<left>");
    assert_eq!(names(&desk), "D r q0 v0 until method tolerance");
    assert_eq!(desk.session.selected.name(), "r");
}

#[test]
fn the_branch_does_not_contain_the_value_of_its_own_parameter() {
    let desk = Desk::open("plain");
    let wanted = desk.session.request(Topic::Branch, 1);
    for d in [-0.9, 0.0, 1e-300, 2.0] {
        let mut session = desk.session.clone();
        Symbol::D.set(&mut session.problem.parameters, &mut session.problem.initial, d);
        assert_eq!(session.request(Topic::Branch, 1), wanted);
    }
}

#[test]
fn the_price_of_a_key_is_what_it_made_necessary() {
    let mut desk = Desk::open("supercritical");
    assert_eq!(desk.session.price.key, None);
    assert_eq!(desk.session.price.evaluations(), 3 * COST, "the first picture");
    desk.press("<right>");
    let price = &desk.session.price;
    assert_eq!(price.key, "<right>".parse().ok());
    assert_eq!(price.recomputed.iter().map(|part| part.topic).collect::<Vec<_>>(), POINT);
    assert_eq!(price.evaluations(), 2 * COST);
    assert!((price.seconds() - 0.002).abs() < 1e-15);
    desk.press("<down>");
    assert_eq!(desk.session.price.evaluations(), 0);
}

#[test]
fn an_old_picture_stays_and_is_known_to_be_old() {
    let mut desk = Desk::open("plain");
    let before = desk.session.trajectory().cloned();
    update(&mut desk.session, Msg::Key("<right>".parse().unwrap()));
    assert!(desk.session.is_busy() && desk.session.is_stale(Topic::Trajectory, 1));
    assert!(!desk.session.is_stale(Topic::Branch, 1));
    assert_eq!(desk.session.trajectory().cloned(), before);
    desk.settle();
    assert!(!desk.session.is_stale(Topic::Trajectory, 1));
}

#[test]
fn a_late_answer_never_replaces_the_one_that_is_asked_for() {
    let mut desk = Desk::open("plain");
    update(&mut desk.session, Msg::Key("<right>".parse().unwrap()));
    let superseded = desk.session.request(Topic::Trajectory, 1).unwrap();
    desk.press("u");
    let held = desk.session.trajectory().cloned();
    update(&mut desk.session, Msg::Answered(Box::new(answered(superseded.clone()))));
    assert_eq!(desk.session.trajectory().cloned(), held);
    // While something else is still being computed, it is the newest there is.
    update(&mut desk.session, Msg::Key("<left>".parse().unwrap()));
    update(&mut desk.session, Msg::Answered(Box::new(answered(superseded.clone()))));
    let Request::Trajectory(problem) = superseded else { panic!("a trajectory was asked for") };
    assert_eq!(desk.session.trajectory().unwrap().problem, problem);
    assert!(desk.session.is_stale(Topic::Trajectory, 1));
}

#[test]
fn a_failure_is_told_once_and_not_tried_again() {
    let mut desk = Desk::open("plain");
    update(&mut desk.session, Msg::Key("<right>".parse().unwrap()));
    let request = desk.session.request(Topic::Cycles, 1).unwrap();
    let failed = |failure| {
        let result = Err(failure);
        Msg::Answered(Box::new(Answered {
            request: request.clone(),
            result,
            seconds: 0.0,
            complete: true,
        }))
    };
    update(&mut desk.session, failed(Failure::Reason(Reason::Interrupted)));
    assert!(desk.session.is_open(&request), "an interrupted question is still a question");
    update(&mut desk.session, failed(Failure::Reason(Reason::OutOfRange)));
    assert!(!desk.session.is_open(&request));
    assert!(desk.session.failure(Topic::Cycles, 1).is_some());
    assert_eq!(desk.notice(), "cycles: left the range of floating-point numbers; <f5> tries again");
    assert!(desk.session.is_stale(Topic::Cycles, 1) && desk.session.cycles().is_some());
    desk.settle();
    assert_eq!(desk.press("<f5>"), [Topic::Cycles]);
    assert!(!desk.session.is_stale(Topic::Cycles, 1));
    assert_eq!(desk.press("<right>"), POINT, "another value is another question");
    assert_eq!(desk.session.failure(Topic::Cycles, 1), None);
}
