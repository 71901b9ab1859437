//! Cost of answers, counted in evaluations; the bounds are a few per cent above the need.

use std::sync::Arc;

use crate::explorer::Trial;
use hopfscope::branch::Branch;
use hopfscope::branch::along::{Points, branch};
use hopfscope::branch::chart::{Plane, Resolution, chart};
use hopfscope::branch::fold::{border, fold};
use hopfscope::branch::fold_graph::highest_cycle;
use hopfscope::flow::quality::DRAFT;
use hopfscope::flow::{Limits, Method};
use hopfscope::model::{Knob, Parameters};
use hopfscope::numerics::elementary::hypot;
use hopfscope::portrait::basin::cycle::cycles;
use hopfscope::question::{NoAnswer, answer};
use hopfscope::scene::{Finding, Request, TOPICS, Topic, library};
use hopfscope::session::{AnswerState, Msg, Row, Session, Size, update};

const LIMITS: &Limits = &Limits::PATIENT;

fn at(d: f64, d2: f64, d3: f64, r: f64) -> Parameters {
    Parameters { d, d2, d3, r }
}

#[test]
fn a_border_takes_two_thousand_evaluations_a_point() {
    let found = border(&at(0.0, 0.2, 0.0, 0.1), Knob::D3, (0.1, 2.0), 100, LIMITS).unwrap();
    assert!(found.points.iter().all(|point| point.fold.is_some()));
    assert!(found.cost.evaluations <= 220_000, "{:?}", found.cost);
}

#[test]
fn a_single_fold_costs_no_more_than_one_of_many() {
    for index in 0..20 {
        let d3 = 0.1 + 0.1 * f64::from(index);
        let (_, cost) = fold(&at(0.0, 0.2, d3, 0.1), LIMITS).unwrap();
        assert!(cost.evaluations <= 2_500, "D3 = {d3}: {cost:?}");
    }
}

#[test]
fn folds_are_the_tops_of_the_graph_of_all_cycles() {
    // The other method follows the graph and takes up to twenty times as long.
    for (d2, d3, r) in [
        (0.0, 1e-6, 1.0),
        (0.2, 0.5, 0.1),
        (-0.3, 0.1, 1.0),
        (0.05, 1e-3, 1.0),
        (0.1, 0.6, 1.0),
        (3.0, 40.0, 0.1),
        (0.0, 0.95, 1.0),
    ] {
        let parameters = at(0.0, d2, d3, r);
        let (found, cost) = fold(&parameters, LIMITS).unwrap();
        let found = found.unwrap();
        let (graph, slow) = highest_cycle(&parameters, 1e-13, LIMITS);
        let (graph, _) = graph.unwrap();
        assert!((found.d / graph.d - 1.0).abs() < 1e-13, "{parameters:?}: {found:?} {graph:?}");
        assert!((found.q_max / graph.q_max - 1.0).abs() < 1e-9, "{found:?} {graph:?}");
        assert!(5 * cost.evaluations < slow.evaluations, "{cost:?} {slow:?}");
    }
}

#[test]
fn no_evaluations_are_wasted_on_folds_where_the_cycle_grazes_the_sticking_set() {
    let found = border(&at(0.0, 0.0, 0.0, 1.0), Knob::D3, (8.0, 12.0), 5, LIMITS).unwrap();
    assert!(found.points.iter().all(|point| point.fold.is_some_and(|fold| fold.grazes)));
    assert!(found.cost.evaluations <= 230_000, "{:?}", found.cost);
}

#[test]
fn all_cycles_take_less_than_a_hundred_half_swings() {
    for (d, d2, d3, most) in [
        (-0.2, 0.2, 0.5, 5_700),
        (-0.175, 0.2, 0.5, 6_300),
        (-0.2, 0.0, -0.5, 2_400),
        (-0.05, 0.2, 0.0, 4_800),
    ] {
        let found = cycles(&at(d, d2, d3, 0.1), LIMITS).unwrap();
        let cost = found.cost.evaluations;
        assert!(cost <= most, "D = {d}, D2 = {d2}, D3 = {d3}: {cost} evaluations");
    }
}

#[test]
fn a_cycle_that_grazes_the_sticking_set_is_the_way_that_leaves_its_end() {
    for d2 in [0.6, -0.6] {
        let point = fold(&at(0.0, d2, 0.125, 2.0), LIMITS).unwrap().0.unwrap();
        let beside = cycles(&at(point.d * (1.0 + 1e-9), d2, 0.125, 2.0), LIMITS).unwrap();
        let [cycle] = beside.cycles[..] else { panic!("{beside:?}") };
        assert!(point.grazes && point.period.is_infinite(), "{point:?}");
        assert!((cycle.q_max / point.q_max - 1.0).abs() < 1e-6, "{point:?} {cycle:?}");
    }
}

#[test]
fn each_line_of_a_chart_takes_its_fold_from_the_one_before() {
    let parameters = at(-0.2, 0.2, 0.5, 0.1);
    let resolution = Resolution { lines: 40, chord: f64::INFINITY, tolerance: 1e-13 };
    let (d, d3) = ((-0.8, 0.2), (-0.5, 2.0));
    let over_d = Plane { right: Knob::D, up: Knob::D3, right_range: d, up_range: d3 };
    let (r, d3) = ((0.0, 0.5), (0.02, 2.0));
    let at_d = Plane { right: Knob::R, up: Knob::D3, right_range: r, up_range: d3 };
    for (plane, most) in [(over_d, 120_000), (at_d, 60_000)] {
        let found = chart(&parameters, plane, resolution, LIMITS).unwrap();
        assert!(found.lines.iter().all(|line| line.failure.is_none()));
        assert!(found.cost.evaluations <= most, "{plane:?}: {:?}", found.cost);
    }
}

#[test]
fn branches_cost_a_few_closings_a_point_down_to_where_cycles_are_harmonic_to_rounding() {
    for (d3, r, most) in [(0.5, 0.0, 300_000), (0.5, 0.1, 385_000), (-0.5, 0.1, 310_000)] {
        let parameters = at(-0.2, 0.0, d3, r);
        let found = branch(&parameters, Knob::D, (-0.6, 0.4), Points::Even(160), 1e-10, LIMITS);
        let found = found.unwrap();
        assert_eq!(found.pieces.iter().map(Vec::len).sum::<usize>(), 160, "D3 = {d3}, r = {r}");
        assert!(found.cost.evaluations <= most, "D3 = {d3}, r = {r}: {:?}", found.cost);
    }
}

/// The size of the screen on which questions are asked.
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
                if !refines && !matches!(stepped.answers.standing(&request), AnswerState::Draft(_))
                {
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
            problem.set(*symbol, *value);
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
    let Request::Branch { range, .. } = request else { panic!("{request:?}") };
    let Ok(Finding::Branch(Branch { pieces, .. })) = answer(request, &Limits::PATIENT) else {
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
    let part = if square > 0.0 {
        ((x - from.0) * dx + (y - from.1) * dy) / square
    } else {
        0.0
    };
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

/// Counted in evaluations: without friction, nothing is located at `v = 0`; where there is a closed form,
/// nothing is integrated; for hidden layers, nothing is computed.
#[test]
fn what_a_scene_does_not_need_costs_nothing() {
    let cost = |keys: &str, scene: &str| {
        let mut trial = Trial::open(scene);
        trial.press(keys);
        let Some(request) = trial.session.request(Topic::Trajectory, 0) else {
            panic!("no motion")
        };
        let Ok(Finding::Trajectory(found)) = answer(&request, &Limits::PATIENT) else {
            panic!("no motion")
        };
        found
    };
    let free = cost("", "hopf");
    assert!(free.problem.parameters.r == 0.0 && free.crossings.is_empty());
    let with_friction = cost("x<down*3>1e-9<enter>", "hopf");
    assert!(with_friction.crossings.len() > 10);
    assert!(free.cost.steps < with_friction.cost.steps);
    let linear = cost("", "capture");
    assert_eq!(linear.method, Method::Exact);
    assert_eq!(linear.cost.evaluations, linear.crossings.len() as u64, "one for each half swing");
}
