//! The dial for the accuracy: its stops, what is computed roughly first, and when an error is measured.

use super::{COST, Trial, answered, by_hand};
use crate::accuracy::Reference;
use crate::flow::{Limits, Method, Reason};
use crate::question::{NoAnswer, answer};
use crate::scene::{Finding, Request, TOPICS, Topic, find};
use crate::session::NoErrorReason;
use crate::session::{AnswerState, Msg, update};

#[test]
fn the_dial_goes_through_its_stops_and_ends() {
    Trial::alone("supercritical").goes(&[
        ("", "dial 1e-10 normal"),
        ("}", "dial 1e-13 fine | notice fine: tolerance 1e-13; thirteen digits"),
        ("} }", "dial 1e-15 reference | notice the accuracy is at its finest, reference"),
        ("{ { {", "dial 0.0001 draft"),
        // Each change is undone separately.
        ("u u", "dial 1e-13 fine"),
        // From a typed number to the neighbouring stop; a stop can also be typed by its name.
        ("<down*7>3e-7<enter>", "dial 3e-7 -"),
        ("{", "dial 0.0001 draft"),
        ("<enter><C-u>fine<enter>", "dial 1e-13 fine"),
    ]);
}

#[test]
fn the_dial_is_the_same_whatever_its_number_is_called() {
    Trial::alone("supercritical").goes(&[
        // A step that is as fine as the tolerance was.
        ("} <down*6><enter><C-u>rk4<enter>", "dial 0.001 fine"),
        ("{", "tolerance 1e-10 | notice normal: step 0.01; ten digits, at a few percent of the .."),
        ("<down>0.05<enter>", "dial 0.05 - | tolerance 1e-10"),
        ("<enter><C-u>7<enter>", "refused step = 7 is outside its range 1e-7 .. 1"),
    ]);
}

/// The answer to a question, with this many evaluations as its cost.
fn costly(request: Request, evaluations: u64) -> Msg {
    let mut found = by_hand(&request);
    match &mut found {
        Finding::Trajectory(motion) => motion.cost.evaluations = evaluations,
        Finding::Branch(branch) => branch.cost.evaluations = evaluations,
        _ => {}
    }
    Msg::answered(request, Ok(found), 0.001)
}

/// The topics of open requests; `true` marks drafts.
fn open(trial: &Trial) -> Vec<(Topic, bool)> {
    let session = &trial.session;
    let wanted = session.wants().into_iter().filter(|request| session.is_open(request));
    // Nothing waits for a proof.
    wanted
        .filter(|request| request.topic() != Topic::Proof)
        .map(|request| {
            let present =
                session.request(request.topic(), 0).or(session.request(request.topic(), 1));
            (request.topic(), present.as_ref() != Some(&request))
        })
        .collect()
}

#[test]
fn what_took_long_is_answered_by_a_draft_first_and_refined_then() {
    let mut trial = Trial::alone("supercritical");
    update(&mut trial.session, Msg::Key("<right>".parse().unwrap()));
    assert_eq!(open(&trial), [(Topic::Trajectory, false), (Topic::Cycles, false)], "cheap so far");
    let request = trial.session.request(Topic::Trajectory, 0).unwrap();
    update(&mut trial.session, costly(request, 10_000_000));
    trial.settle();

    // The next step of a key asks for the draft first, then for the full answer.
    update(&mut trial.session, Msg::Key("<right>".parse().unwrap()));
    assert_eq!(
        open(&trial),
        [(Topic::Trajectory, true), (Topic::Trajectory, false), (Topic::Cycles, false)]
    );
    let draft = trial.session.wants()[0].clone();
    let Request::Trajectory { problem, .. } = &draft else { panic!("{draft:?}") };
    assert_eq!(problem.quality().unwrap().name, "draft");
    update(&mut trial.session, costly(draft.clone(), 1_000));
    let is_draft = |trial: &Trial| {
        matches!(trial.session.standing(Topic::Trajectory, 0), AnswerState::Draft(_))
    };
    assert!(is_draft(&trial) && trial.session.is_busy());
    assert_eq!(open(&trial), [(Topic::Trajectory, false), (Topic::Cycles, false)]);
    // The cost of a draft says nothing about that of the full answer.
    let full = trial.session.request(Topic::Trajectory, 0).unwrap();
    update(&mut trial.session, costly(full, 10_000_000));
    trial.settle();
    assert!(!is_draft(&trial));
    let topics: Vec<Topic> = trial.session.price.recomputed.iter().map(|part| part.topic).collect();
    assert_eq!(topics, [Topic::Trajectory, Topic::Trajectory, Topic::Cycles]);

    // The latest wins: a late draft does not replace a newer one.
    update(&mut trial.session, Msg::Key("<right>".parse().unwrap()));
    let superseded = trial.session.wants()[0].clone();
    update(&mut trial.session, Msg::Key("<right>".parse().unwrap()));
    let newer = trial.session.wants()[0].clone();
    assert!(superseded != newer);
    trial.settle();
    let held = trial.session.trajectory().cloned();
    update(&mut trial.session, costly(superseded, 1));
    assert_eq!(held, trial.session.trajectory().cloned());

    // At draft quality, there is nothing to refine.
    trial.press("{ {");
    update(&mut trial.session, Msg::Key("<right>".parse().unwrap()));
    assert_eq!(open(&trial), [(Topic::Trajectory, false), (Topic::Cycles, false)]);
}

/// Four diagrams over the same range, each with its own variants: none uses the draft of another, and all get
/// their full answers.
#[test]
fn plots_with_like_questions_keep_their_drafts_apart() {
    let mut session = Trial::open("fig17").session;
    for request in session.wants() {
        update(&mut session, costly(request, 10_000_000));
    }
    update(&mut session, Msg::Key("<right>".parse().unwrap()));
    session.problem.tolerance = 1e-12;
    let branches: usize = (0..session.plots.len()).map(|plot| session.shown(plot).len()).sum();
    let mut asked: Vec<Request> = Vec::new();
    while let Some(request) = session.wants().into_iter().find(|request| session.is_open(request)) {
        assert!(!asked.contains(&request), "asked again: {request:?}");
        asked.push(request.clone());
        update(&mut session, answered(request));
    }
    assert_eq!(asked.len(), 2 * branches, "a draft and an answer for each");
    for plot in 0..session.plots.len() {
        assert!(session.is_fresh(Topic::Branch, plot));
    }
}

#[test]
fn a_draft_that_fails_is_not_tried_again() {
    let mut trial = Trial::alone("supercritical");
    update(&mut trial.session, Msg::Key("<right>".parse().unwrap()));
    let request = trial.session.request(Topic::Trajectory, 0).unwrap();
    update(&mut trial.session, costly(request, 10_000_000));
    update(&mut trial.session, Msg::Key("<right>".parse().unwrap()));
    let draft = trial.session.wants()[0].clone();
    let failed = Err(NoAnswer::Reason(Reason::OutOfRange));
    update(&mut trial.session, Msg::answered(draft.clone(), failed, 0.0));
    assert!(!trial.session.wants().contains(&draft));
    assert_eq!(trial.notice(), "", "what it is a draft of may still be answered");
}

#[test]
fn an_error_is_measured_only_while_the_user_rests_on_the_dial() {
    let mut trial = Trial::alone("supercritical");
    assert_eq!(
        trial
            .press("<right><left> <down*4><right>")
            .iter()
            .filter(|topic| **topic == Topic::Reference)
            .count(),
        0
    );
    assert!(!trial.session.measures());
    // The reference is computed last, and only once.
    assert_eq!(trial.press("}"), [Topic::Trajectory, Topic::Branch, Topic::Reference]);
    assert_eq!(TOPICS.last(), Some(&Topic::Reference));
    // The reference does not depend on the accuracy or the method.
    assert_eq!(trial.press("} {"), [Topic::Trajectory, Topic::Branch], "the way back is known");
    assert_eq!(trial.press("m"), [Topic::Trajectory]);
    // After another key, the error is no longer measured; selecting the row measures it again.
    trial.press("g");
    assert!(!trial.session.measures());
    assert_eq!(trial.press("<down*7>"), [], "known still");
    assert!(trial.session.measures());
    assert_eq!(trial.press("<up*3><right><down*3>"), [Topic::Trajectory, Topic::Reference]);
    trial.press("<run \"layer trajectory\">");
    assert!(!trial.session.measures(), "a hidden motion has no error on the screen");
}

#[test]
fn the_measured_error_is_that_of_the_motion_on_show() {
    let mut trial = Trial::open("capture");
    trial.press("<down*5><enter><C-u>dop853<enter>{");
    let session = &mut trial.session;
    for topic in [Topic::Trajectory, Topic::Reference] {
        let request = session.request(topic, 0).unwrap();
        let result = Ok(answer(&request, &Limits::PATIENT).unwrap());
        update(session, Msg::answered(request, result, 0.0));
    }
    assert_eq!(session.problem.method, Method::Dop853);
    let (deviation, reference) = session.measured().unwrap().unwrap();
    assert!(reference.error < 1e-28, "{:e}", reference.error);
    assert!((1e-10..1e-3).contains(&deviation.error) && deviation.agrees, "{deviation:?}");
    assert!(trial.session.price.evaluations() > COST);
}

/// If only the reference escapes, there is no distance, and the reason is given.
#[test]
fn why_there_is_no_measured_error_is_known() {
    let mut trial = Trial::open("capture");
    trial.press("<down*5>");
    let mut session = trial.session.clone();
    for (problem, why) in
        [(find("escape").unwrap().problem, Some(NoErrorReason::OtherFate)), (session.problem, None)]
    {
        for topic in [Topic::Trajectory, Topic::Reference] {
            let request = session.request(topic, 0).unwrap();
            let result = match topic {
                Topic::Reference => {
                    let found = Reference::of(None, &problem, &Limits::PATIENT).unwrap();
                    Finding::Reference(Ok(Box::new(found)))
                }
                _ => answer(&request, &Limits::PATIENT).unwrap(),
            };
            update(&mut session, Msg::answered(request, Ok(result), 0.0));
        }
        assert!(session.measures());
        let measured = session.measured().unwrap();
        assert_eq!(measured.err(), why);
    }
}
