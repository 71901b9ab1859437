//! `hopfscope belt`: machines in physical units, from files to answers.

mod commands;
mod explorer;
#[path = "../explorer/mod.rs"]
mod explorer_session;
mod guarantee;
#[path = "../program/mod.rs"]
mod program;
mod speeds;

use std::fs;
use std::sync::Arc;

use hopfscope::flow::{Limits, Outcome};
use hopfscope::numerics::elementary::tanh;
use hopfscope::runtime::{Options, play};
use hopfscope::scene::{ScaledMachine, Scene};
use hopfscope::session::replay::script::parse;
use hopfscope::session::{Session, Size};
use hopfscope::terminal::Environment;
use program::{json, number, run};
use serde_json::Value;

/// Runs a command line whose words may contain blanks.
fn belt(words: &[&str]) -> Value {
    let words: Vec<&str> = ["belt"].into_iter().chain(words.iter().copied()).collect();
    let ran = run(&[&words[..], &["--format", "json"]].concat());
    assert_eq!((ran.code, ran.err.as_str()), (0, ""), "{words:?}");
    serde_json::from_str(&ran.out).unwrap()
}

/// The document of a command about a machine.
fn about(command: &str, machine: &str, words: &[&str]) -> Value {
    let line = [&[command, "--machine", machine, "--format", "json"], words].concat();
    let ran = run(&line);
    assert_eq!((ran.code, ran.err.as_str()), (0, ""), "{command} {words:?}");
    serde_json::from_str(&ran.out).unwrap()
}

/// The rows of `scan --machine NAME ..`.
fn scan(machine: &str, words: &[&str]) -> Vec<Value> {
    let line = [&["scan", "--machine", machine, "--format", "json"], words].concat();
    let ran = run(&line);
    assert_eq!(ran.code, 0, "{words:?}: {}", ran.err);
    ran.out.lines().map(|row| serde_json::from_str(row).unwrap()).collect()
}

#[test]
fn the_document_holds_both_units_and_they_agree() {
    let found = belt(&["textbook"]);
    let units = &found["units"];
    let (x0, omega_0) = (number(&units["displacement"]), number(&units["omega_0"]));
    // Stribeck by hand: mu(0.3) = 0.2 + 0.2/e, mu' = -0.2/(0.3 e).
    let mu = 0.2 + 0.2 / std::f64::consts::E;
    assert!((omega_0 - 50.0).abs() < 1e-13 && (x0 - 100.0 * mu / 5000.0).abs() < 1e-17);
    let d = (5.0 - 100.0 * 0.2 / 0.3 / std::f64::consts::E) / (2.0 * 2.0 * 50.0);
    assert!((number(&found["parameters"]["D"]) - d).abs() < 1e-15);
    assert!((number(&found["parameters"]["r"]) - 1.0 / (100.0 * mu)).abs() < 1e-16);
    assert_eq!(found["rest_band"]["physical"], 0.0002);
    // At rest the guide holds more.
    let held = belt(&["textbook", "--set", "R_static=2 N"]);
    assert_eq!(held["rest_band"]["physical"], 0.0004);
    assert_eq!(found["sticking_velocity"]["physical"], 0.3);
    let expansion = &found["expansion"];
    for cycle in expansion["cycles"].as_array().unwrap() {
        let scaled = number(&cycle["dimensionless"]["q_max"]) * x0;
        assert!((number(&cycle["x_max"]) / scaled - 1.0).abs() < 1e-15);
        assert_eq!(cycle["reaches_belt"], false);
        assert!(number(&cycle["taylor"]["force"]) > 0.0);
    }
    // The scaled question has the scaled answer.
    let p = &found["parameters"];
    let set = |name: &str| format!("--set {name}={:?}", number(&p[name]));
    let plain = json(&format!("cycles {} {} {} {}", set("D"), set("D2"), set("D3"), set("r")));
    assert_eq!(plain["cycles"][0]["q_max"], expansion["cycles"][0]["dimensionless"]["q_max"]);
}

#[test]
fn the_friction_of_a_design_gives_the_margin_that_was_asked_for() {
    for (margin, key, wanted) in [
        ("2 mm", "displacement", 0.002),
        ("0.2 N s", "impulse", 0.2),
        ("40 kg cm/s", "impulse", 0.4),
    ] {
        let found = belt(&["clutch", "--set", "v0=80 cm/s", "--design", margin]);
        let force = number(&found["design"]["R"]);
        let set = format!("R={force:?}");
        let again = belt(&["clutch", "--set", "v0=0.8 m/s", "--set", &set]);
        let reached = number(&again["margin"][key]);
        assert!((reached / wanted - 1.0).abs() < 1e-9, "{margin}: {reached}");
    }
    let beyond = belt(&["textbook", "--design", "1 m"]);
    assert_eq!(beyond["design"]["needed"]["kind"], "fold");
    let set = format!("R={:?}", 1.001 * number(&beyond["design"]["R"]));
    assert_eq!(belt(&["textbook", "--set", &set])["margin"]["displacement"], Value::Null);
    let damped = belt(&["textbook", "--set", "d1=100", "--design", "5 mm"]);
    assert_eq!(
        (&damped["design"]["needed"]["kind"], &damped["design"]["R"]),
        (&"any".into(), &Value::Null)
    );
    // Without the friction element nothing comes to rest.
    let none = belt(&["textbook", "--set", "R=0"]);
    assert_eq!(none["margin"]["displacement"], 0.0);
}

/// A machine file with a Stribeck law, in a folder of its own.
fn file(folder: &tempfile::TempDir, quantities: &str, friction: &str) -> String {
    let path = folder.path().join("own.toml");
    fs::write(&path, format!("title = \"Own\"\n{quantities}\n[friction]\n{friction}\n")).unwrap();
    path.to_str().unwrap().to_owned()
}

#[test]
fn a_machine_is_answered_by_the_whole_model_and_by_the_expansion_with_its_error() {
    let folder = tempfile::tempdir().unwrap();
    // The open benchmark of basin stability, at a belt speed of 1.5.
    let name = file(
        &folder,
        "m = 1\nc = 1\nd1 = 0.1\nF = 1\nv0 = 1.5",
        "stribeck = { rest = 1, kinetic = 0.5, velocity = 0.5 }",
    );
    let steady = 0.524_893_534_183_931_9;
    let window = format!("{:?}:{:?},0:2", -2.0 - steady, 2.0 - steady);
    let found = belt(&[&name, "--start", "x=1.4 m,v=0 m/s", "--window", &window]);
    let kinds = |key: &str| -> Vec<String> {
        let cycles = found["cycles"].as_array().unwrap();
        cycles.iter().map(|cycle| cycle[key].to_string()).collect()
    };
    assert_eq!(kinds("kind"), ["\"slip\"", "\"stick-slip\""]);
    assert_eq!(
        (kinds("stable"), kinds("overtakes")),
        (vec!["false".into(), "true".into()], vec!["false".into(); 2])
    );
    assert_eq!((&found["model"], &found["neutral"]), (&"whole".into(), &false.into()));
    assert_eq!(found["border"]["kind"], "cycle");
    assert_eq!(
        (&found["motion"]["outcome"]["kind"], &found["motion"]["outcome"]["cycle"]),
        (&"cycle".into(), &1.into())
    );
    assert!((number(&found["margin"]["displacement"]) / 1.174_982_361_957_011 - 1.0).abs() < 1e-13);
    assert!((number(&found["rest_share"]) - 0.307_126_137_781_600_8).abs() < 1e-12);
    // The cubic expansion promises 15 % too much, and the report says so.
    let expanded = &found["expansion"]["margin"];
    let error = number(&expanded["error"]["displacement"]);
    assert!((error - (number(&expanded["displacement"]) - 1.174_982_361_957_011)).abs() < 1e-12);
    assert!((error / 1.174_982_361_957_011 - 0.15).abs() < 0.01, "{error}");
    let table = run(&["belt", &name]);
    assert!(table.out.contains("15 % too large"), "{}", table.out);
    assert!(table.out.contains("stable stick-slip"), "{}", table.out);
}

#[test]
fn no_kick_that_ends_on_the_belt_is_reported_as_survived() {
    // The cubic expansion has no border at all; by the full law a displacement of -4 mm ends in stick-slip.
    let folder = tempfile::tempdir().unwrap();
    let name = file(
        &folder,
        "m = 2\nc = \"5 kN/m\"\nd1 = 4\nd3 = 300\nF = 100\nR = 1\nv0 = 0.3",
        "stribeck = { rest = 0.8, kinetic = 0.2, velocity = 0.05 }",
    );
    let found = belt(&[&name, "--start", "x=-4 mm"]);
    assert_eq!(found["expansion"]["margin"]["displacement"], Value::Null);
    assert_eq!(found["motion"]["outcome"]["kind"], "cycle");
    let cycle = &found["cycles"].as_array().unwrap().last().unwrap();
    assert_eq!(cycle["kind"], "stick-slip");
    assert!((number(&cycle["x_max"]) - 12.8e-3).abs() < 0.1e-3, "{cycle}");
    assert!(number(&found["margin"]["displacement"]) < 4e-3);
}

#[test]
fn static_friction_is_read_and_laws_that_cannot_be_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let numbers = "m = 1\nc = 100\nF = 10\nR = 0.2\nv0 = 0.2";
    let coulomb = "static = 0.5\nconstant = { mu = 0.3 }";
    let found = belt(&[&file(&folder, numbers, coulomb)]);
    assert_eq!(
        (&found["friction"]["mu_s"], &found["border"]["kind"]),
        (&0.5.into(), &"grazing".into())
    );
    assert!((number(&found["margin"]["displacement"]) - 0.022).abs() < 1e-15);
    assert!((number(&found["margin"]["impulse"]) - 0.2).abs() < 1e-15);
    let varied = belt(&[&file(&folder, numbers, "constant = { mu = 0.3 }"), "--set", "mu_s=0.5"]);
    assert_eq!(varied["cycles"], found["cycles"]);
    // At rest the guide holds more friction than while the mass moves.
    let held = belt(&[
        &file(&folder, &format!("{numbers}\nR_static = 0.4"), coulomb),
        "--start",
        "x=3 mm",
    ]);
    assert_eq!(
        (&held["motion"]["outcome"]["kind"], &held["motion"]["outcome"]["x"]),
        (&"rest".into(), &0.003.into())
    );
    for (numbers, friction, words) in [
        (
            numbers,
            "static = 0.2\nconstant = { mu = 0.3 }",
            "mu_s = 0.2 is below the coefficient 0.3",
        ),
        (&format!("{numbers}\nR_static = 0.1"), coulomb, "R_static = 0.1 N is below R = 0.2 N"),
        (numbers, "polynomial = { coefficients = [0.5, -1.2] }", "coefficient falls below 0"),
        (
            numbers,
            "table = { points = [[0, 0.4], [0.1, 0.3], [0.2, 0.25], [0.3, 0.22], [0.35, 0.21]] }",
            "where the friction law ends",
        ),
        (
            numbers,
            "constant = { mu = 0.3 }\npolynomial = { coefficients = [1] }",
            "friction takes one law",
        ),
    ] {
        let name = file(&folder, numbers, friction);
        let ran = run(&["belt", &name]);
        ran.is_refused(&[words]);
        // What is known within the range of the law is reported nevertheless.
        let known = friction.starts_with("polynomial") || friction.starts_with("table");
        assert_eq!(ran.out.contains("beyond the margin an unstable cycle is crossed"), known);
    }
}

#[test]
fn a_tolerance_is_that_of_the_steps() {
    let margin =
        |more: &[&str]| number(&belt(&[&["bstab"], more].concat())["margin"]["displacement"]);
    let exact = margin(&["--method", "taylor"]);
    let error = |tolerance| (margin(&["--tol", tolerance]) / exact - 1.0).abs();
    assert!(error("1e-6") > 1e-11 && error("1e-6") < 1e-4, "{:e}", error("1e-6"));
    assert!(error("1e-15") < 1e-13, "{:e}", error("1e-15"));
    // A second, different method finds the same.
    for (machine, start) in [
        ("bstab", "x=2,v=0"),
        ("bstab", "x=-1,v=2.5"),
        ("groan", "x=1.5 mm"),
        ("textbook", "x=3 mm,v=0.4 m/s"),
    ] {
        for (method, tolerance, least) in [("dop853", "1e-13", 1e-9), ("dopri5", "1e-9", 1e-5)] {
            let found = belt(&[machine, "--start", start, "--method", method, "--tol", tolerance]);
            let second = &found["motion"]["second"];
            assert_eq!(second["method"], method, "{second}");
            let speed = number(&found["motion"]["velocity"][1]);
            let size = number(&found["motion"]["displacement"][1]);
            assert!(number(&second["difference"]["x"]).abs() < least * size, "{machine} {second}");
            assert!(number(&second["difference"]["v"]).abs() < least * speed, "{machine} {second}");
        }
    }
    run(&["belt", "bstab", "--method", "rk4"]).is_refused(&["allowed are auto, taylor"]);
}

#[test]
fn a_mode_is_answered_by_the_same_command() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("blade.toml");
    // A damping ratio of -0.05 at rest and a friction joint: the closed form of equation 32.
    let text = "title = \"A blade\"\nfrequency = \"120 1/s\"\nmodal_mass = \"0.2 kg\"\n\
                damping_ratio = [-0.05]\nR = \"3 N\"\nstart = { x = \"1 mm\" }\n";
    fs::write(&path, text).unwrap();
    let name = path.to_str().unwrap();
    let found = belt(&[name]);
    let omega = 240.0 * std::f64::consts::PI;
    let swing = 0.05 * std::f64::consts::PI / (1.0_f64 - 0.0025).sqrt();
    let amplitude = 3.0 / (0.2 * omega * omega) / tanh(0.5 * swing);
    assert!((number(&found["margin"]["displacement"]) / amplitude - 1.0).abs() < 1e-13);
    assert_eq!(found["cycles"].as_array().unwrap().len(), 1);
    assert_eq!(found["motion"]["outcome"]["kind"], "escaped");
    // Damping that grows with the square of the velocity bounds the motion.
    let bounded = text.replace("[-0.05]", "[-0.05, 0, \"0.02 s^2/m^2\"]");
    fs::write(&path, bounded).unwrap();
    let found = belt(&[name]);
    assert_eq!(found["motion"]["outcome"]["kind"], "cycle");
    assert_eq!(found["cycles"].as_array().unwrap().len(), 2);
    // Without a belt there is no belt speed, and there are no tolerances.
    for (option, value, words) in [
        ("--set", "v0=1", "no v0 here; there are R, R_static, frequency"),
        ("--set", "mu_s=0.1", "no mu_s here; there are"),
        ("--set", "ratio3=1", "no ratio3 here; there are"),
        ("--set", "R=3N+-1N", "takes no uncertainties"),
        ("--disturbance", "1 N", "no --disturbance"),
    ] {
        run(&["belt", name, option, value]).is_refused(&[words]);
    }
    fs::write(&path, text.replace("-0.05", "\"1 kg\"")).unwrap();
    run(&["belt", name]).is_refused(&["ratio0 = 1 kg has a unit; it takes none"]);
}

#[test]
fn the_study_of_the_open_benchmark_is_one_scan() {
    let window = ["--window=-2:2,0:2", "--elongation"];
    let study = scan(
        "bstab",
        &[&["--over", "v0=1.625:1.775:2", "--measure", "stability"], &window[..]].concat(),
    );
    let shares: Vec<f64> = study.iter().map(|row| number(&row["captured_part"])).collect();
    for (share, expected) in shares.iter().zip([0.428_097_973_459_205_5, 0.558_366_582_309_877_2]) {
        assert!((share - expected).abs() < 1e-12, "{share} {expected}");
    }
    // Counted from the steady position, which is beyond 0.5 m, the window is a different one.
    let half = "--window=0:2,0:2";
    let alone = |more: &[&str]| {
        let asked = [&["bstab", "--set", "v0=1.625", half], more].concat();
        number(&belt(&asked)["rest_share"])
    };
    assert!(alone(&["--elongation"]) > alone(&[]) + 0.05);
}

#[test]
fn a_share_that_is_not_known_leaves_no_column_out() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("short.toml");
    // Friction is unknown beyond a slip of 0.4086 m/s.
    let text = "m = 0.415\nc = 1.735\nd1 = 0.25665\nd3 = 0.233634\nF = 0.1876\nR = 0.008091\nv0 = 0.1379\n\
                friction.polynomial.coefficients = [0.62, -1.11435, -0.98584]\n";
    fs::write(&path, text).unwrap();
    let name = path.to_str().unwrap();
    let window = "--window=-0.1:0.1,-0.18:0.18";
    let rows = scan(name, &["--over", "v0=0.1:0.2:2", "--measure", "stability", window]);
    let [known, unknown] = [0, 1].map(|row| rows[row]["captured_part"].clone());
    assert_eq!((number(&known), unknown), (1.0, Value::Null));
}

#[test]
fn a_mode_is_set_swept_followed_and_designed_as_a_belt_is() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("mode.toml");
    let text = "frequency = 120\nmodal_mass = 0.2\ndamping_ratio = [-0.05]\nR = 3\n";
    fs::write(&path, text).unwrap();
    let name = path.to_str().unwrap();
    let omega = 240.0 * std::f64::consts::PI;
    let amplitude = |ratio: f64, force: f64| {
        let swing = ratio * std::f64::consts::PI / (1.0 - ratio * ratio).sqrt();
        force / (0.2 * omega * omega) / tanh(0.5 * swing)
    };
    let close = |found: &Value, expected: f64| (number(found) / expected - 1.0).abs() < 1e-12;
    let set = belt(&[name, "--set", "ratio0=-0.1", "--set", "R=5 N"]);
    assert!(close(&set["margin"]["displacement"], amplitude(0.1, 5.0)));
    let rows = scan(name, &["--over", "R=1:3:3", "--measure", "margin"]);
    for (row, force) in rows.iter().zip([1.0, 2.0, 3.0]) {
        assert!(close(&row["displacement"], amplitude(0.05, force)), "{row}");
    }
    let wanted = amplitude(0.05, 4.0);
    let design = ["belt", name, "--design", &format!("{wanted:?} m")];
    let designed = belt(&design[1..]);
    assert!((number(&designed["design"]["R"]) - 4.0).abs() < 1e-9, "{}", designed["design"]);
    let rows = run(&[&design[..], &["--format", "csv"]].concat()).out;
    assert!(
        rows.contains(&format!("\nR for the margin,,{:?},N\n", number(&designed["design"]["R"])))
    );
    // Damping of third degree bounds the growth. The two cycles fold where friction dissipates all the energy
    // fed in, at a ratio that increases with friction.
    let bounded = text.replace("[-0.05]", "[-0.05, 0, 0.02]");
    fs::write(&path, bounded).unwrap();
    let folds = about("border", name, &["--along", "ratio0=-0.2:0.05:6", "--over", "R=1:3:3"]);
    let rows = folds["points"].as_array().unwrap();
    let values: Vec<f64> = rows
        .iter()
        .map(|row| {
            assert_eq!(
                (&row["special"][0]["kind"], row["special"].as_array().unwrap().len()),
                (&"fold".into(), 1)
            );
            number(&row["special"][0]["value"])
        })
        .collect();
    assert!(values[0] > values[1] && values[1] > values[2] && values[0] < 0.0, "{values:?}");
    // --tol also applies along a branch.
    let coarse = about("branch", name, &["--over", "ratio0=-0.2:0.05:6", "--tol", "1e-6"]);
    let error = (number(&coarse["special"][0]["value"]) - values[2]).abs();
    assert!(error > 0.0 && error < 1e-5, "{error:e}");
    assert_eq!(coarse["special"][0]["jumps"]["up"]["to"]["kind"], "rest");
    assert!(coarse["special"][0]["jumps"]["down"].is_null());
}

#[test]
fn a_scan_is_the_same_machine_at_each_speed() {
    let measures = "margin,from-rest,cycles,multipliers,border,guaranteed,design";
    let asked = ["--design", "3 mm", "--set", "R=2N+-0.1N"];
    let line = [&["--over", "v0=60 cm/s:1 m/s:3", "--measure", measures], &asked[..]].concat();
    let rows = scan("clutch", &line);
    assert_eq!(rows.len(), 3);
    for row in rows {
        let set = format!("v0={:?}", number(&row["v0"]));
        let alone = belt(&[&["clutch", "--set", &set], &asked[..]].concat());
        let cycles = alone["cycles"].as_array().unwrap();
        assert_eq!(row["cycles"], cycles.len());
        let margin = &alone["margin"];
        let certain = &alone["guaranteed"];
        for (column, expected) in [
            ("displacement", &margin["displacement"]),
            ("impulse", &margin["impulse"]),
            ("from_rest_displacement", &margin["from_rest"]["displacement"]),
            ("from_rest_impulse", &margin["from_rest"]["impulse"]),
            ("border", &alone["border"]["kind"]),
            ("q_max_1", &cycles[0]["x_max"]),
            ("v_min_1", &cycles[0]["v_min"]),
            ("period_1", &cycles[0]["period"]),
            ("multiplier_1", &cycles[0]["multiplier"]),
            ("guaranteed_displacement", &certain["displacement"]),
            ("guaranteed_impulse", &certain["impulse"]),
            ("friction_needed", &alone["design"]["R"]),
        ] {
            assert_eq!(&row[column], expected, "{column} at {set}");
        }
        assert_eq!((&row["R"], &row["reason"]), (&2.0.into(), &Value::Null));
    }
}

#[test]
fn a_scan_beyond_the_friction_law_says_so_in_those_rows() {
    let rows = scan("slideway", &["--over", "v0=10 mm/s:110 mm/s:3", "--measure", "cycles,margin"]);
    assert_eq!(rows[2]["cycles"], Value::Null);
    let reason = rows[2]["reason"].as_str().unwrap();
    assert!(reason.contains("outside the friction law; it reaches from 0 to 0.06 m/s"), "{reason}");
}

#[test]
fn a_scan_of_a_machine_knows_its_friction_table_and_what_it_cannot_measure() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("press.toml");
    let text = "m = 5\nc = 2000\nF = 50\nR = 0.5\nv0 = 0.1\nfriction.table.points = \
                [[0, 0.4], [0.05, 0.36], [0.1, 0.33], [0.2, 0.29], [0.3, 0.27]]\n";
    let name = file.to_str().unwrap();
    let line = ["--over", "v0=0.1:0.15:2", "--measure", "outcome", "--set", "x=1 mm"];
    let tables = ["0.36", "0.37"].map(|mu| {
        fs::write(&file, text.replace("0.36", mu)).unwrap();
        let rows = scan(name, &line);
        assert_eq!(rows[0]["x"], 0.001);
        rows[0]["friction_table"].clone()
    });
    assert_ne!(tables[0], tables[1]);
    for (words, expected) in [
        (&["--over", "D=0:1:3", "--measure", "margin"][..], "there are m, c, d1, d3, F, R, v0"),
        (&["--over", "mu=0:1:3", "--measure", "margin"], "no mu here; there are m, c"),
        (&["--over", "v0=1:2 m/s:3", "--measure", "margin"], "both take a unit"),
        (&["--over", "x=0:1 mm:3", "--measure", "margin"], "both take a unit"),
        (&["--over", "x=0:1:3", "--measure", "margin"], "margin does not depend on x"),
        (&["--over", "R=1:2:3", "--measure", "design"], "design does not depend on R"),
        (&["--over", "c=1:2:3", "--measure", "design"], "design needs the margin"),
        (&["--over", "c=1:2:3", "--measure", "fold"], "fold is not measured of a machine"),
        (&["--over", "c=1:2:3", "--measure", "stability"], "needs a --window"),
    ] {
        run(&[&["scan", "--machine", name], words].concat()).is_refused(&[expected]);
    }
}

#[test]
fn a_file_of_ones_own_may_name_a_table_beside_it() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("press.toml");
    let text = "title = \"My press\"\nm = \"5 kg\"\nc = \"2 kN/m\"\nF = \"50 N\"\nR = \"0.5 N\"\n\
                v0 = \"0.1 m/s\"\n[friction.table]\nfile = \"mu.csv\"\n";
    fs::write(&file, text).unwrap();
    let name = file.to_str().unwrap();
    run(&["belt", name]).is_refused(&["press.toml:8:8: ", "mu.csv"]);
    fs::write(
        folder.path().join("mu.csv"),
        "v,mu\n0,0.4\n0.05,0.36\n0.1,0.33\n0.2,0.29\n0.3,0.27\n",
    )
    .unwrap();
    let found = belt(&[name]);
    assert_eq!(found["machine"], "press");
    assert_eq!(found["friction"]["law"], "table");
    assert!(number(&found["parameters"]["D"]) < 0.0);
    let table = run(&["belt", name]);
    assert!(table.out.starts_with("press: My press\nm = 5 kg, c = 2 kN/m"), "{}", table.out);
}

#[test]
fn bad_input_is_refused_in_one_line_with_what_is_allowed() {
    for (words, expected) in [
        (&["nowhere.toml"][..], "the machines of the program are textbook, clutch, slideway"),
        (&["textbook", "--set", "m=2 mm"], "m = 2 mm has the wrong unit; it takes one such as kg"),
        (&["textbook", "--set", "k=2"], "there are m, c, d1, d3, F, R, v0, mu_s, R_static"),
        (
            &["textbook", "--set", "v0=0"],
            "v0 = 0 m/s is outside its range 1e-12 .. 1e12 m/s; a belt at rest only brakes",
        ),
        (&["textbook", "--design", "2"], "expected a displacement, such as \"2 mm\""),
        (&["slideway", "--set", "v0=1"], "v0 = 1 m/s is outside the friction law"),
    ] {
        let ran = run(&[&["belt"], words].concat());
        assert_eq!(ran.out, "", "{words:?}");
        ran.is_refused(&[expected]);
    }
}
