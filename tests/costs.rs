//! Cost of answers, counted in evaluations; the bounds are a few per cent above the need.

use hopfscope::branch::along::{Points, branch};
use hopfscope::branch::chart::{Plane, Resolution, chart};
use hopfscope::branch::fold::{border, fold};
use hopfscope::branch::fold_graph::highest_cycle;
use hopfscope::flow::Limits;
use hopfscope::model::{Knob, Parameters};
use hopfscope::portrait::basin::cycle::cycles;

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
        let graph = graph.unwrap().point();
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
        let found = cycles(&at(d, d2, d3, 0.1), false, LIMITS).unwrap();
        let cost = found.cost.evaluations;
        assert!(cost <= most, "D = {d}, D2 = {d2}, D3 = {d3}: {cost} evaluations");
    }
}

#[test]
fn a_cycle_that_grazes_the_sticking_set_is_the_way_that_leaves_its_end() {
    for d2 in [0.6, -0.6] {
        let point = fold(&at(0.0, d2, 0.125, 2.0), LIMITS).unwrap().0.unwrap();
        let beside = cycles(&at(point.d * (1.0 + 1e-9), d2, 0.125, 2.0), false, LIMITS).unwrap();
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
