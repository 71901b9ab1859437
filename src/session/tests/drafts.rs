//! Drafts: the counted cost of the first picture after a key, and how close it is to the final one.

use std::sync::Arc;

use crate::branch::Branch;
use crate::flow::Limits;
use crate::flow::quality::DRAFT;
use crate::model::Knob;
use crate::numerics::elementary::hypot;
use crate::question;
use crate::question::{NoAnswer, answer};
use crate::scene::{Answer, Request, TOPICS, Topic, library};
use crate::session::{Msg, Row, Session, Size, update};

const SIZE: Size = Size { width: 120, height: 40 };

/// Evaluations in at most half a frame of 16 ms: one takes 20 to 30 ns.
const HALF_FRAME: u64 = 200_000;

/// Answers a question; returns the number of evaluations.
fn give(session: &mut Session, request: Request) -> u64 {
    let found = answer(&request, &Limits::PATIENT);
    let evaluations = found.as_ref().map_or(0, |found| found.cost().evaluations);
    let result = found.map_err(NoAnswer::Reason);
    update(session, Msg::answered(request, result, 0.0));
    evaluations
}

fn open(session: &Session) -> Vec<Request> {
    session.wants().into_iter().filter(|request| session.is_open(request)).collect()
}

/// Counted for every scene and every number of its pane in both directions, including the accuracy: the cost
/// until each layer on show has an answer for the present numbers, draft or not.
#[test]
fn at_draft_quality_every_key_takes_half_a_frame_at_most() {
    let (mut costliest, mut missed) = ((0, String::new()), Vec::new());
    for scene in library() {
        let mut session = Session::new(Arc::clone(scene), SIZE);
        session.problem = session.problem.at(&DRAFT);
        // Windows are fitted after the first answers; from the second key on, the cost of the first is known.
        for _ in 0..3 {
            for request in open(&session) {
                give(&mut session, request);
            }
        }
        for (row, count) in session.rows().into_iter().flat_map(|row| [(row, 1), (row, -1)]) {
            let mut stepped = session.stepped(row, count);
            stepped.selected = Row::Number(Knob::Until);
            stepped.measuring = false;
            let mut evaluations = 0;
            let wanted = open(&stepped);
            for request in wanted.iter().cloned() {
                let refines = request.draft().is_some_and(|draft| wanted.contains(&draft));
                if !refines && !stepped.is_refinement(&request) {
                    evaluations += give(&mut stepped, request);
                }
            }
            let step = format!("{}, {count} step of {}", scene.name, row.name());
            if evaluations >= HALF_FRAME {
                missed.push(format!("{step}: {evaluations}"));
            }
            costliest = costliest.max((evaluations, step));
        }
    }
    println!(
        "the most expensive key at draft quality: {} evaluations, {}",
        costliest.0, costliest.1
    );
    assert!(missed.is_empty(), "{missed:#?}");
}

/// Cycles, bands of capture, harmonics and return maps are asked without drafts, because their answers are
/// cheap: counted for every scene after a step of each of its numbers, shown there or not.
#[test]
fn what_has_no_draft_needs_none() {
    const UNDRAFTED: [Topic; 4] = [Topic::Cycles, Topic::Capture, Topic::Balance, Topic::ReturnMap];
    for scene in library() {
        let session = Session::new(Arc::clone(scene), SIZE);
        let rows = session
            .rows()
            .into_iter()
            .filter(|row| row.stepped().is_some_and(|knob| Knob::MOTION.contains(&knob)));
        for (row, count) in rows.flat_map(|row| [(row, 1), (row, -1), (row, 10)]) {
            let mut stepped = session.stepped(row, count);
            let plots = 0..stepped.plots.len();
            let asked =
                UNDRAFTED.iter().flat_map(|topic| plots.clone().map(move |plot| (topic, plot)));
            let asked = asked.filter_map(|(topic, plot)| stepped.request(*topic, plot));
            for request in asked.collect::<Vec<_>>() {
                assert_eq!(request.draft(), None);
                let evaluations = give(&mut stepped, request.clone());
                let step = format!("{}, {count} steps of {}", scene.name, row.name());
                assert!(evaluations < HALF_FRAME, "{step}: {request:?} takes {evaluations}");
            }
        }
    }
}

/// Numbers that users type to see what happens.
const UGLY: [&[(Knob, f64)]; 11] = [
    &[(Knob::D, -0.999)],
    &[(Knob::D, -1.5)],
    &[(Knob::D, -1e-12)],
    &[(Knob::R, 1e-6)],
    &[(Knob::R, 100.0)],
    &[(Knob::D2, 5.0)],
    &[(Knob::D2, -1e3)],
    &[(Knob::D3, -1.0)],
    &[(Knob::D3, 1e-9)],
    &[(Knob::D2, 5.0), (Knob::D3, -1.0)],
    &[(Knob::D, 0.5), (Knob::D2, 2.0), (Knob::D3, -1e-3)],
];

/// Counted for every scene: no first answer takes more than a few frames, whatever the numbers. Answers that
/// take more than one frame do not hold up the others, because the worker puts them aside.
#[test]
fn wherever_the_numbers_are_no_first_answer_takes_more_than_a_few_frames() {
    let kinds = || TOPICS.iter().copied().filter(|topic| *topic < Topic::Trade);
    let mut costliest = (0, String::new());
    let mut answered: Vec<Request> = Vec::new();
    for (scene, numbers) in library().iter().flat_map(|scene| UGLY.map(|ugly| (scene, ugly))) {
        let mut session = Session::new(Arc::clone(scene), SIZE);
        session.problem = session.problem.at(&DRAFT);
        for (symbol, value) in numbers {
            let problem = &mut session.problem;
            symbol.set(&mut problem.parameters, &mut problem.initial, *value);
        }
        let plots = 0..session.plots.len();
        let asked = plots.flat_map(|plot| kinds().map(move |topic| (topic, plot)));
        let asked = asked.filter_map(|(topic, plot)| session.request(topic, plot));
        for request in asked.collect::<Vec<_>>() {
            let request = request.draft().unwrap_or(request);
            if !answered.contains(&request) {
                answered.push(request.clone());
                let kind = request.topic().name();
                costliest = costliest.max((
                    give(&mut session, request),
                    format!("{} {kind} {numbers:?}", scene.name),
                ));
            }
        }
    }
    println!("the most expensive first answer: {} evaluations, {}", costliest.0, costliest.1);
    assert!(costliest.0 < 8 * HALF_FRAME, "{costliest:?}");
}

/// The branch that a request asks for, with the parameter in units of its range and displacements in units of
/// the largest.
fn diagram(request: &Request, extent: Option<f64>) -> (Vec<Vec<(f64, f64)>>, f64) {
    let Request::Branch(question::branch::Inputs { range, .. }) = request else {
        panic!("{request:?}")
    };
    let Ok(Answer::Branch(Branch { pieces, .. })) = answer(request, &Limits::PATIENT) else {
        panic!("no branch")
    };
    let largest = pieces.iter().flatten().fold(0.0, |most: f64, point| most.max(point.cycle.q_max));
    let extent = extent.unwrap_or(largest);
    let place = |value: f64, q: f64| ((value - range.0) / (range.1 - range.0), q / extent);
    let pieces = pieces
        .iter()
        .map(|piece| piece.iter().map(|point| place(point.value, point.cycle.q_max)).collect());
    (pieces.collect(), extent)
}

fn distance((x, y): (f64, f64), from: (f64, f64), to: (f64, f64)) -> f64 {
    let (dx, dy) = (to.0 - from.0, to.1 - from.1);
    let square = dx * dx + dy * dy;
    let part = if square > 0.0 { ((x - from.0) * dx + (y - from.1) * dy) / square } else { 0.0 };
    let part = part.clamp(0.0, 1.0);
    hypot(x - from.0 - part * dx, y - from.1 - part * dy)
}

/// A branch at draft quality has only the points that its continuation needed, but the curve through them
/// agrees with the full one to a dot of a large plot.
#[test]
fn a_drafted_branch_is_the_branch_to_the_eye() {
    /// Half a row of an 80x24 screen.
    const DOT: f64 = 1.0 / 100.0;
    let mut compared = 0;
    for scene in library() {
        let session = Session::new(Arc::clone(scene), SIZE);
        for plot in 0..session.plots.len() {
            let Some(full) = session.request(Topic::Branch, plot) else { continue };
            let (pieces, extent) = diagram(&full, None);
            let (drafted, _) = diagram(&full.draft().unwrap(), Some(extent));
            for point in pieces.iter().flatten() {
                let chords = drafted.iter().flat_map(|piece| piece.windows(2));
                let nearest = chords
                    .map(|chord| distance(*point, chord[0], chord[1]))
                    .fold(f64::INFINITY, f64::min);
                assert!(nearest < DOT, "{}: {point:?} is {nearest} from the draft", scene.name);
                compared += 1;
            }
        }
    }
    assert!(compared > 1000);
}
