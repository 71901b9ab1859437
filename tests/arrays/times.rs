//! Motions at given times.

use std::f64::consts::PI;
use std::fs;

use hopfscope::flow::{Detail, Limits, Method, Outcome, Problem, Sample};
use hopfscope::model::{Parameters, State};

use crate::program::{json, number, run};
use crate::{file, table, word};

/// The motion at these times.
fn at(problem: &Problem, times: &[f64]) -> Vec<Option<Sample>> {
    problem.at_times(None, times, Detail::default(), &Limits::PATIENT).1
}

#[test]
fn without_damping_half_swings_are_circles_about_the_ends_of_the_sticking_set() {
    let (r, q0) = (0.125, 2.0);
    let parameters = Parameters { d: 0.0, d2: 0.0, d3: 0.0, r };
    let times: Vec<f64> = (0..400).map(|index| 0.1 * f64::from(index)).collect();
    for (method, error) in [
        (Method::Exact, 1e-13),
        (Method::Taylor, 1e-12),
        (Method::Dop853, 1e-10),
        (Method::Stiff, 1e-9),
    ] {
        let problem = Problem {
            method,
            tolerance: 1e-13,
            ..Problem::new(parameters, State { q: q0, v: 0.0 }, 60.0)
        };
        for sample in at(&problem, &times) {
            let Sample { tau, q, v } = sample.unwrap();
            // Each half swing is 2 r shorter than the one before, and the eighth ends within the sticking set.
            let swing = (tau / PI).floor();
            let [expected, speed] = if swing < 8.0 {
                let sign = if swing % 2.0 == 0.0 { 1.0 } else { -1.0 };
                let radius = q0 - (2.0 * swing + 1.0) * r;
                let phase = tau - swing * PI;
                [sign * (r + radius * phase.cos()), -sign * radius * phase.sin()]
            } else {
                [q0 - 16.0 * r, 0.0]
            };
            assert!(
                (q - expected).abs() < error && (v - speed).abs() < error,
                "{method} {tau}: {q} {v}"
            );
        }
    }
}

#[test]
fn a_motion_at_a_time_is_where_one_that_ends_then_ends() {
    let parameters = Parameters { d: -0.2, d2: 0.3, d3: 0.5, r: 0.1 };
    let times: Vec<f64> = (1..60).map(|index| 0.37 * f64::from(index)).collect();
    for method in [Method::Auto, Method::Taylor, Method::Dop853, Method::Dopri5, Method::Stiff] {
        let problem = Problem {
            method,
            tolerance: 1e-11,
            ..Problem::new(parameters, State { q: 1.5, v: 0.2 }, 30.0)
        };
        for (tau, sample) in times.iter().zip(at(&problem, &times)) {
            let until = Problem { until: *tau, ..problem };
            let end = until.followed(None, Detail::default(), &Limits::PATIENT).end();
            let Sample { q, v, .. } = sample.unwrap();
            // Between its ends a step of the implicit method has a polynomial of lower order.
            let error = if method == Method::Stiff { 1e-8 } else { 1e-9 };
            assert!((q - end.q).abs() < error && (v - end.v).abs() < error, "{method} {tau}");
        }
    }
}

#[test]
fn times_may_stand_in_any_order_and_beyond_an_escape_there_is_no_state() {
    let parameters = Parameters { d: -0.1, d2: 0.5, d3: 0.0, r: 0.0 };
    let problem = Problem::new(parameters, State { q: 9.0, v: 0.0 }, 10.0);
    let times = [5.0, 0.5, -1.0, 0.0, 0.5, 11.0];
    let (motion, samples) = problem.at_times(None, &times, Detail::default(), &Limits::PATIENT);
    assert!(matches!(motion.outcome, Outcome::Escaped { tau } if tau < 1.0));
    let known: Vec<bool> = samples.iter().map(Option::is_some).collect();
    assert_eq!(known, [false, true, false, true, true, false]);
    assert_eq!(samples[1], samples[4]);
    assert_eq!(samples[3], Some(Sample { tau: 0.0, q: 9.0, v: 0.0 }));
    assert!(motion.samples.windows(2).all(|pair| pair[0].tau <= pair[1].tau));
}

#[test]
fn a_machine_sticks_and_slips_at_the_times_that_are_asked_for() {
    let line = "trajectory --machine clutch --set x=12mm --until 0.2 --sample 1ms";
    let answer = json(line);
    let samples = answer["samples"].as_array().unwrap();
    assert_eq!(samples.len(), 201);
    let speed = number(&answer["parameters"]["v0"]);
    let rides = answer["phases"].as_array().unwrap().windows(2);
    let rides: Vec<_> = rides
        .filter(|pair| pair[0]["phase"] == "stick")
        .map(|pair| number(&pair[0]["tau"])..number(&pair[1]["tau"]))
        .collect();
    assert!(!rides.is_empty(), "it sticks to the belt");
    for sample in samples {
        let tau = number(&sample["tau"]);
        let is_held = rides.iter().any(|ride| ride.contains(&tau));
        assert_eq!(number(&sample["v"]) == speed, is_held, "{sample}");
        if tau > 0.0 {
            let until = format!("trajectory --machine clutch --set x=12mm --until {tau}");
            let end = &json(&until)["outcome"];
            assert!((number(&end["q"]) - number(&sample["q"])).abs() < 1e-13, "{sample} {end}");
        }
    }
}

#[test]
fn the_times_of_a_file_keep_their_order_and_the_answer_has_one_table() {
    let (_folder, path) = file("times.csv");
    fs::write(&path, "tau,q\n4,1\n# measured\n0.25,2\n\n4\n").unwrap();
    let words = ["trajectory", "--set", "D=0.1", "--times", word(&path), "--format", "csv"];
    let ran = run(&words);
    assert_eq!((ran.code, ran.err.as_str()), (0, ""));
    let times: Vec<f64> = table(&ran.out).iter().map(|row| row[0]).collect();
    assert_eq!((times, ran.out.lines().next()), (vec![4.0, 0.25, 4.0], Some("tau,q,v")));
    let tenths = run(&[
        "trajectory",
        "--set",
        "D=0.1",
        "--until",
        "1",
        "--sample",
        "0.1",
        "--format",
        "csv",
    ]);
    let times: Vec<&str> =
        tenths.out.lines().skip(1).filter_map(|row| row.split(',').next()).collect();
    assert_eq!(
        times,
        ["0.0", "0.1", "0.2", "0.3", "0.4", "0.5", "0.6", "0.7", "0.8", "0.9", "1.0"]
    );
}

#[test]
fn wrong_times_are_refused_by_their_line() {
    let (_folder, path) = file("times.csv");
    for (text, expected) in [
        ("0\n1\ntwo\n", "line 3: \"two\" is not a number"),
        ("tau\n1\n99\n", "line 3: 99 is outside of the motion, 0 .. 40.0, see --until"),
    ] {
        fs::write(&path, text).unwrap();
        run(&["trajectory", "--times", word(&path)]).is_refused(&["times.csv", expected]);
    }
    for step in ["0", "-1", "1e-9"] {
        run(&["trajectory", "--sample", step]).is_refused(&[step]);
    }
    let ran = run(&["trajectory", "--machine", "clutch", "--method", "dop853", "--sample", "1ms"]);
    ran.is_refused(&["auto or taylor"]);
}
