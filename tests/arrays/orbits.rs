//! Limit cycles in time.

use hopfscope::flow::{Detail, Limits, Method, Problem, Sample};
use hopfscope::model::{Parameters, State};
use hopfscope::portrait::cycles;

use crate::program::{json, number, run};
use crate::table;

/// Parameters with cycles of every kind: near a fold, from a node that repels, stiff, linear, without friction.
const SETS: [(f64, f64, f64, f64); 8] = [
    (-0.3, 0.0, 0.5, 0.1),
    (-0.3, 0.2, 0.5, 0.1),
    (-0.1, 0.0, -0.5, 0.1),
    (-0.1, 0.0, 0.5, 0.0),
    (-0.4, 0.0, 0.0, 1.0),
    (-1.5, 0.3, 2.0, 0.01),
    (-0.9, -0.3, 2.0, 1e-3),
    (-5.0, 0.0, 1.0, 0.1),
];

#[test]
fn an_orbit_closes_turns_where_its_cycle_does_and_is_a_motion_from_point_to_point() {
    let mut known = 0;
    for (d, d2, d3, r) in SETS {
        let parameters = Parameters { d, d2, d3, r };
        for cycle in cycles(&parameters, &Limits::PATIENT).unwrap().cycles {
            known += 1;
            let problem = Problem { parameters, ..Problem::default() };
            let points = cycle.orbit(&problem, None, 161, &Limits::PATIENT).unwrap();
            let size = cycle.q_max.max(cycle.v_max);
            let near = |one: f64, other: f64| (one - other).abs() < 1e-11 * size;
            let (first, last) = (points[0], points[160]);
            assert!(
                near(first.q, last.q) && near(first.v, last.v),
                "{parameters:?} {first:?} {last:?}"
            );
            assert!(near(first.q, cycle.q_max) && last.tau == cycle.period, "{parameters:?}");
            let within = |it: &Sample| {
                let slack = 1e-11 * size;
                it.q <= cycle.q_max + slack
                    && it.q >= cycle.q_min - slack
                    && it.v <= cycle.v_max + slack
                    && it.v >= cycle.v_min - slack
            };
            assert!(points.iter().all(within), "{parameters:?}");
            for pair in points.windows(2) {
                // A step along a repelling direction multiplies what was rounded; a short one hardly.
                let from = State { q: pair[0].q, v: pair[0].v };
                let problem = Problem {
                    method: Method::Auto,
                    tolerance: 1e-13,
                    ..Problem::new(parameters, from, pair[1].tau - pair[0].tau)
                };
                let end = problem.followed(None, Detail::default(), &Limits::PATIENT).end();
                let apart = (end.q - pair[1].q).abs().max((end.v - pair[1].v).abs());
                assert!(apart < 1e-8 * size, "{parameters:?}: {end:?} {pair:?}");
            }
        }
    }
    assert!(known >= 10);
}

#[test]
fn cycles_of_machines_ride_on_the_belt_for_as_long_as_they_stick() {
    let answer = json("cycles --machine clutch --orbit 4001");
    let speed = number(&answer["parameters"]["v0"]);
    let cycles = answer["cycles"].as_array().unwrap();
    assert_eq!(cycles.len(), 2);
    for cycle in cycles {
        let orbit = cycle["orbit"].as_array().unwrap();
        let of = |name: &str| orbit.iter().map(|at| number(&at[name])).collect::<Vec<f64>>();
        let (q, v) = (of("q"), of("v"));
        let largest = |values: &[f64]| values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        assert!((q[0] - q[4000]).abs() < 1e-10 * q[0]);
        assert!((largest(&q) - number(&cycle["q_max"])).abs() < 1e-12);
        assert!((largest(&v) / number(&cycle["v_max"]) - 1.0).abs() < 1e-5);
        let held = v.iter().filter(|v| **v == speed).count();
        let part = number(&cycle["stick_duration"]) / number(&cycle["period"]);
        assert!((held as f64 / 4001.0 - part).abs() < 1e-3, "{held} {part}");
    }
}

#[test]
fn each_point_of_a_branch_has_its_orbit_in_one_table() {
    for line in [
        "branch --over D=-0.5:0:9 --set D3=0.5 --set r=0.1",
        "branch --machine clutch --over v0=0.8:2:5",
    ] {
        let document = json(&format!("{line} --orbit 3"));
        let points = document["points"].as_array().unwrap();
        let words: Vec<&str> = line.split(' ').chain(["--orbit", "3", "--format", "csv"]).collect();
        let ran = run(&words);
        let rows = table(&ran.out);
        assert_eq!(rows.len(), 3 * points.len());
        for (index, row) in rows.iter().enumerate() {
            let point = &points[index / 3];
            let at = &point["orbit"][index % 3];
            let own =
                [number(&point["value"]), number(&at["tau"]), number(&at["q"]), number(&at["v"])];
            assert_eq!(row[1..], own);
            assert_eq!(row[0], (index / 3 + 1) as f64);
        }
    }
}
