//! What scripts rely on: documents, their numbers, and exit codes.

mod docs;
mod files;
mod fuzz;
mod keys;
mod outside;
mod page;
mod passed_on;
#[path = "../program/mod.rs"]
mod program;
mod replay;
mod reports;
mod usage;

use program::{json, number, run};
use serde_json::Value;

use hopfscope::model::Knob;
use hopfscope::numerics::elementary::cos;
use hopfscope::scene::find;

/// The keys of an object, in alphabetical order.
fn keys(value: &Value) -> String {
    let mut keys: Vec<&str> =
        value.as_object().expect("an object").keys().map(String::as_str).collect();
    keys.sort_unstable();
    keys.join(" ")
}

fn close(found: &Value, expected: f64, tolerance: f64) -> bool {
    (number(found) / expected - 1.0).abs() <= tolerance
}

#[test]
fn a_trajectory_document_has_its_fields() {
    let motion = json("trajectory --until 50 --set D=-0.1 --set r=0.5 --set q0=2");
    assert_eq!(
        keys(&motion),
        "cost energy events initial method outcome parameters provenance tolerance"
    );
    assert_eq!(
        motion["parameters"],
        serde_json::json!({"D": -0.1, "D2": 0.0, "D3": 0.0, "r": 0.5})
    );
    assert_eq!(motion["initial"], serde_json::json!({"q": 2.0, "v": 0.0}));
    assert_eq!(keys(&motion["outcome"]), "kind q tau");
    assert_eq!(motion["outcome"]["kind"], "captured");
    assert!(close(&motion["outcome"]["q"], -0.116_144_440_390_138, 1e-9));
    assert_eq!(keys(&motion["energy"]), "cubic end friction linear quadratic residual start");
    assert_eq!(keys(&motion["cost"]), "evaluations rejected seconds steps");
    let events = motion["events"].as_array().unwrap();
    assert_eq!(events.len(), 3);
    assert_eq!(keys(&events[2]), "q tau");
    assert_eq!(events[2]["q"], motion["outcome"]["q"], "the capture is the last event");
    assert!(number(&motion["cost"]["seconds"]) > 0.0);
}

#[test]
fn each_outcome_has_its_own_fields() {
    let moving = json("trajectory --until 7 --set D=0 --set r=0");
    assert_eq!(keys(&moving["outcome"]), "kind q tau v");
    assert_eq!(moving["outcome"]["kind"], "moving");
    assert_eq!(moving["outcome"]["tau"], 7.0);
    assert!(close(&moving["outcome"]["q"], cos(7.0), 1e-8));

    let escaped = json("trajectory --until 7 --set D3=-1 --set r=0 --set q0=10");
    assert_eq!(keys(&escaped["outcome"]), "kind tau");
    assert_eq!(escaped["outcome"]["kind"], "escaped");
    assert_eq!(escaped["energy"], Value::Null, "infinite works do not exist");
}

#[test]
fn a_motion_that_cannot_be_followed_exits_with_1_and_says_how_far_it_came() {
    // The amplitude grows by e^2221 in each half swing.
    let line = "trajectory --until 1e5 --set D=-0.999999 --set r=0 --format json";
    let ran = run(&line.split_whitespace().collect::<Vec<_>>());
    assert_eq!(ran.code, 1);
    assert_eq!(ran.err.lines().count(), 1, "{}", ran.err);
    assert!(ran.err.contains("tau = ") && ran.err.contains("100000"), "{}", ran.err);
    let document: Value = serde_json::from_str(&ran.out).unwrap();
    assert_eq!(document["outcome"]["kind"], "gave-up");
    assert_eq!(keys(&document["outcome"]), "kind reason tau");
    assert!(document["outcome"]["reason"].is_string());
}

/// Every number of a JSON text, as written.
fn numbers(text: &str) -> Vec<&str> {
    text.split([',', ':', '[', ']', '{', '}'])
        .map(str::trim)
        .filter(|token| token.starts_with(|first: char| first == '-' || first.is_ascii_digit()))
        .collect()
}

#[test]
fn numbers_are_written_in_their_shortest_form_that_reads_back() {
    let line = "trajectory --until 60 --set D3=0.05 --set q0=3 --set r=1e-150 --format json";
    let ran = run(&line.split_whitespace().collect::<Vec<_>>());
    let written = numbers(ran.out.trim());
    assert!(written.len() > 40, "{}", ran.out);
    for text in written.into_iter().filter(|text| text.contains(['.', 'e'])) {
        let value: f64 = text.parse().unwrap();
        assert_eq!(serde_json::to_string(&value).unwrap(), text);
    }
}

#[test]
fn a_mirrored_question_has_the_mirrored_answer_to_the_last_digit() {
    let options = "trajectory --until 30 --set D=-0.2 --set D3=0.5 --set r=0.1 --tol 1e-9";
    let plain = json(&format!("{options} --set D2=0.2 --set q0=0.4 --set v0=0.1"));
    let mirrored = json(&format!("{options} --set D2=-0.2 --set q0=-0.4 --set v0=-0.1"));
    let events = |answer: &Value, sign: f64| -> Vec<(f64, f64)> {
        let events = answer["events"].as_array().unwrap();
        events.iter().map(|event| (number(&event["tau"]), sign * number(&event["q"]))).collect()
    };
    assert!(events(&plain, 1.0).len() > 5);
    assert_eq!(events(&plain, 1.0), events(&mirrored, -1.0));
}

#[test]
fn every_method_is_accepted_and_named() {
    for method in ["exact", "taylor", "dop853"] {
        let answer = json(&format!("trajectory --until 20 --method {method}"));
        assert_eq!(answer["method"], method);
    }
    let chosen = json("trajectory --until 20 --method auto");
    assert_ne!(chosen["method"], "auto", "the method that answered is named");
    assert_eq!(json("trajectory --until 20 --tol 1e-6")["tolerance"], 1e-6);
}

#[test]
fn repetitions_change_nothing_but_the_time() {
    let mut once = json("trajectory --until 40 --set D3=0.1");
    let mut often = json("trajectory --until 40 --set D3=0.1 --repeat 9");
    let command = |answer: &Value| answer["provenance"]["command"].as_str().unwrap().to_owned();
    assert_eq!(command(&once), command(&often).replace(" --repeat 9", ""));
    for answer in [&mut once, &mut often] {
        answer["cost"]["seconds"] = Value::Null;
        answer["provenance"] = Value::Null;
    }
    assert_eq!(once, often);
}

#[test]
fn the_last_of_two_values_counts_and_scenes_give_the_others() {
    let answer = json("trajectory --scene subcritical --set D=0.2 --set D=0.1 --until 1");
    assert_eq!(answer["parameters"]["D"], 0.1);
    assert!(number(&answer["parameters"]["D3"]) < 0.0, "the subcritical scene has D3 < 0");
}

#[test]
fn a_cycles_document_has_its_fields() {
    let answer = json("cycles --set D=-0.2 --set D2=0.2 --set D3=0.5 --set r=0.1");
    assert_eq!(keys(&answer), "basin cost count cycles harmonic parameters provenance");
    assert_eq!(keys(&answer["cost"]), "evaluations rejected seconds steps");
    let cycles = answer["cycles"].as_array().unwrap();
    assert_eq!(cycles.len(), 2);
    for field in [
        "stable",
        "q_min",
        "q_max",
        "v_min",
        "v_max",
        "period",
        "multiplier",
        "log_multiplier",
        "clearance",
        "log_clearance",
    ] {
        assert!(!cycles[0][field].is_null(), "{field}");
    }
    assert_eq!((&cycles[0]["stable"], &cycles[1]["stable"]), (&false.into(), &true.into()));
    assert!(close(&cycles[0]["q_max"], 0.350_058_845_389_937_26, 1e-10));
    assert!(close(&cycles[1]["multiplier"], 0.355_865_264_037_352_1, 1e-7));
    assert_eq!(answer["basin"]["edge"], "cycle");
    let harmonic = json("cycles --set D=-0.4 --set r=0.1");
    assert_eq!(keys(&harmonic["harmonic"][0]), "amplitude mean stable");
    assert!(close(&harmonic["harmonic"][0]["amplitude"], 0.5 / std::f64::consts::PI, 1e-14));
}

#[test]
fn a_harmonic_balance_stands_beside_the_cycles_if_asked_for() {
    let answer = json("cycles --set D=-0.7 --set r=0.1 --harmonics 9");
    assert_eq!(keys(&answer), "balance basin cost count cycles harmonic parameters provenance");
    let rows = answer["balance"].as_array().unwrap();
    let harmonics: Vec<f64> = rows.iter().map(|row| number(&row["harmonics"])).collect();
    assert_eq!(harmonics, [1.0, 3.0, 5.0, 9.0]);
    for (row, q_max) in [(0, 0.0909), (1, 0.1018), (3, 0.1075)] {
        assert!((number(&rows[row]["q_max"]) - q_max).abs() < 0.51e-4, "{}", rows[row]);
    }
    assert_eq!(rows[0]["amplitude"], answer["harmonic"][0]["amplitude"]);
    let exact = number(&answer["cycles"][0]["q_max"]);
    for row in rows {
        assert!(close(&row["amplitude"], exact * (1.0 + number(&row["amplitude_error"])), 1e-14));
        assert_eq!((&row["stable"], &row["crossings"]), (&false.into(), &2.into()), "{row}");
        assert!(number(&row["residual"]) < 1e-14 && row["lost"].is_null(), "{row}");
    }
    let frequency = number(&answer["cycles"][0]["period"]) / std::f64::consts::TAU;
    assert!(close(&rows[0]["frequency_error"], frequency - 1.0, 1e-12), "{}", rows[0]);
}

#[test]
fn a_harmonic_balance_says_what_it_has_lost_and_what_is_not_there() {
    // Between the fold of one harmonic and the true one.
    let answer = json("cycles --set D=-0.1727 --set D2=0.2 --set D3=0.5 --set r=0.1 --harmonics 3");
    let rows = answer["balance"].as_array().unwrap();
    assert_eq!(rows.len(), 4);
    for row in rows {
        assert!(row["amplitude_error"].is_null() && row["frequency_error"].is_null(), "{row}");
        assert_eq!(row["harmonics"] == 1, row["lost"].is_null(), "{row}");
    }
    let lost = rows[1]["lost"].as_str().unwrap();
    assert!(lost.starts_with("no cycle of 3 harmonics") && rows[1]["q_max"].is_null(), "{lost}");
    assert_eq!(json("cycles --set D=0.1 --harmonics 3")["balance"], serde_json::json!([]));

    let ran = run(&["cycles", "--set", "D=-1.5", "--harmonics", "9"]);
    assert!(ran.out.contains("there is no such cycle to compare with"), "{}", ran.out);
    let ran = run(&["cycles", "--set", "D=-0.01", "--set", "D2=0.2", "--harmonics", "31"]);
    assert!(ran.out.contains("instants of a turn, a cycle at 2"), "{}", ran.out);
}

#[test]
fn near_critical_damping_the_clearance_keeps_its_digits_and_then_its_logarithm() {
    let cycle = &json("cycles --set D=-0.999 --set r=1")["cycles"][0];
    assert!(close(&cycle["clearance"], 6.539_330_848_996_454e-31, 1e-12));
    assert!(close(&cycle["log_multiplier"], 140.390_900_439_616_33, 1e-12));
    let cycle = &json("cycles --set D=-0.999999 --set r=1")["cycles"][0];
    assert_eq!((number(&cycle["clearance"]), &cycle["multiplier"]), (0.0, &Value::Null));
    assert!(close(&cycle["log_clearance"], -2_220.746_655_785_235, 1e-12));
    assert!(close(&cycle["v_max"], 0.735_759_372_849_116_9, 1e-12));
}

#[test]
fn without_a_cycle_the_list_is_empty_and_the_basin_has_no_edge() {
    let answer = json("cycles --set D=0.3 --set D3=0.5");
    assert_eq!(answer["cycles"], serde_json::json!([]));
    assert_eq!(answer["basin"]["edge"], "none");
}

#[test]
fn a_branch_document_has_its_fields_and_finds_the_fold() {
    let line = "branch --over D=-0.95:0:60 --set r=0.1 --set D2=0.2 --set D3=0.5 --tol 1e-10";
    let answer = json(line);
    assert_eq!(keys(&answer), "cost parameter parameters points provenance special vague");
    assert_eq!(answer["parameter"], "D");
    let points = answer["points"].as_array().unwrap();
    assert!(points.len() >= 60, "{}", points.len());
    for field in ["value", "stable", "q_min", "q_max", "v_min", "v_max", "period"] {
        assert!(points.iter().all(|point| !point[field].is_null()), "{field}");
    }
    let inside = |point: &Value| (-0.95..=0.0).contains(&number(&point["value"]));
    assert!(points.iter().all(inside));
    let special = answer["special"].as_array().unwrap();
    let fold = special.iter().find(|special| special["kind"] == "fold").unwrap();
    assert!(close(&fold["value"], -0.172_784_103_071_94, 1e-11), "{fold}");
    assert!(close(&fold["q_max"], 0.515_541_875_076, 1e-6), "{fold}");
}

#[test]
fn csv_has_one_row_each_and_all_digits() {
    let line = "--set D=-0.1 --set r=0.5 --set q0=2 --until 50";
    let words = |command: &str, options: &str, format: &str| -> Vec<String> {
        let line = format!("{command} {options} --format {format}");
        line.split_whitespace().map(str::to_owned).collect()
    };
    let text = |words: Vec<String>| run(&words.iter().map(String::as_str).collect::<Vec<_>>()).out;
    let csv = text(words("trajectory", line, "csv"));
    let rows: Vec<Vec<&str>> = csv.lines().map(|row| row.split(',').collect()).collect();
    assert_eq!(rows[0], ["what", "tau", "q", "v"]);
    assert_eq!(rows[1], ["start", "0.0", "2.0", "0.0"]);
    let kinds: Vec<&str> = rows[2..].iter().map(|row| row[0]).collect();
    assert_eq!(kinds, ["turn", "turn", "turn", "captured"]);
    let answer = json(&format!("trajectory {line}"));
    assert_eq!(rows[3][2].parse::<f64>().unwrap(), number(&answer["events"][1]["q"]));

    let csv = text(words("cycles", "--set D=-0.2 --set D3=0.5", "csv"));
    assert_eq!(csv.lines().count(), 3);
    let columns = csv.lines().next().unwrap().split(',').count();
    assert!(csv.lines().all(|row| row.split(',').count() == columns), "{csv}");

    let csv = text(words("cycles", "--set D=-0.2 --set D3=0.5 --harmonics 5", "csv"));
    assert_eq!(csv.lines().count(), 1 + 2 * 3);
    assert!(csv.starts_with("harmonics,stable,"), "{csv}");

    let csv = text(words("branch", "--over D=-0.5:-0.1:10", "csv"));
    assert!(csv.lines().next().unwrap().starts_with("piece,D,stable,"), "{csv}");
    assert!(csv.lines().count() > 10);
}

#[test]
fn tables_are_made_to_be_read() {
    let ran = run(&["trajectory", "--until", "50", "--set", "r=0.5", "--set", "q0=2"]);
    assert_eq!((ran.code, ran.err.as_str()), (0, ""));
    assert!(
        ran.out.contains("comes to rest at q = -0.116 after 3 half swings, tau = 9.47"),
        "{}",
        ran.out
    );
    assert!(ran.out.contains("-1.556914511"), "{}", ran.out);
    assert!(ran.out.lines().all(|line| line.chars().count() <= 100 && line.trim_end() == line));
    for line in [&["cycles"][..], &["scenes"], &["branch", "--over", "D=-0.5:-0.1:5"]] {
        let ran = run(line);
        assert_eq!((ran.code, ran.err.as_str()), (0, ""), "{line:?}");
        assert!(!ran.out.contains("NaN") && !ran.out.contains("inf"), "{}", ran.out);
    }
}

#[test]
fn every_scene_that_is_listed_can_be_started_from() {
    let scenes = json("scenes");
    let scenes = scenes.as_array().unwrap();
    assert!(scenes.len() >= 8);
    for scene in scenes {
        let name = scene["name"].as_str().unwrap();
        let answer = json(&format!("trajectory --scene {name}"));
        assert_eq!(answer["parameters"], scene["parameters"], "{name}");
        json(&format!("cycles --scene {name}"));
    }
}
