//! The commands that take `--machine`: a machine by its own numbers, in the words of the oscillator of the paper.

use hopfscope::flow::{Detail, Fate, Limits, Method, Motion, Outcome, Problem};
use hopfscope::model::{Model, Reason, State};
use hopfscope::numerics::elementary::ln;
use hopfscope::numerics::random::Random;
use hopfscope::portrait::Portrait;
use hopfscope::scene::machine::library::find;
use serde_json::Value;

use super::program::{json, number, run};
use super::{about, belt, scan};

/// A motion from displacement and velocity (m, m/s), followed for `until` seconds by Taylor series, with its ledger.
fn follow_by_series(model: &Model, (q, v): (f64, f64), until: f64) -> Motion {
    let (method, tolerance) = (Method::Taylor, model.tolerance);
    let problem =
        Problem { initial: State { q, v }, until, method, tolerance, ..Problem::default() };
    problem.followed(Some(model), Detail { energy: true, ..Detail::default() }, &Limits::PATIENT)
}

/// Whether two numbers agree to a part.
fn agree(found: &Value, expected: f64, part: f64) {
    let found = number(found);
    assert!((found - expected).abs() <= part * expected.abs(), "{found} {expected}");
}

/// Two cycles of the open benchmark, by two other codes: Taylor series in extended precision, and DOP853.
#[test]
fn the_cycles_of_a_machine_are_those_of_two_other_codes() {
    let found = about("cycles", "bstab", &[]);
    assert_eq!((&found["machine"], &found["parameters"]["v0"]), (&"bstab".into(), &1.5.into()));
    assert_eq!(found["basin"]["edge"], "cycle");
    let slip = [
        ("q_min", -1.174_982_361_957_011),
        ("q_max", 1.330_254_955_995_367_8),
        ("v_min", -1.252_031_254_543_534_4),
        ("v_max", 1.249_057_381_720_911_9),
        ("period", 6.295_334_793_503_008),
        ("multiplier", 1.492_750_122_878_878_6),
        ("stick_duration", 0.0),
    ];
    let stick = [
        ("q_min", -1.477_719_316_833_334),
        ("q_max", 1.681_602_595_966_091_4),
        ("v_min", -1.578_867_371_534_136_6),
        ("v_max", 1.5),
        ("period", 6.316_306_357_891_375),
        ("multiplier", 0.0),
        ("stick_duration", 0.505_485_542_355_735_6),
    ];
    for (index, (kind, stable, numbers)) in
        [("slip", false, slip), ("stick-slip", true, stick)].into_iter().enumerate()
    {
        let cycle = &found["cycles"][index];
        assert_eq!((&cycle["kind"], &cycle["stable"]), (&kind.into(), &stable.into()));
        assert_eq!(cycle["overtakes"], false);
        for (name, expected) in numbers {
            agree(&cycle[name], expected, 1e-12);
        }
    }
    let rows = run(&["cycles", "--machine", "bstab", "--format", "csv"]).out;
    let lines: Vec<&str> = rows.lines().collect();
    assert!(lines.len() == 3 && lines[0].starts_with("kind,overtakes,stable,q_min,q_max,v_min"));
}

#[test]
fn a_machine_without_a_belt_is_the_oscillator_of_the_paper() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("mode.toml");
    // D = -0.3, D3 = 0.5 with a natural frequency of 1/s: x is q, and the damping ratio is D + D3 v^2/2.
    let frequency = 0.5 / std::f64::consts::PI;
    let text = format!(
        "frequency = {frequency:?}\nmodal_mass = 1\ndamping_ratio = [-0.3, 0, 0.25]\nR = 0.1\n"
    );
    std::fs::write(&path, text).unwrap();
    let name = path.to_str().unwrap();
    let paper = "--set D=-0.3 --set D3=0.5 --set r=0.1 --set D2=0";
    let [machine, scene] = [about("cycles", name, &[]), json(&format!("cycles {paper}"))];
    for (one, other) in
        machine["cycles"].as_array().unwrap().iter().zip(scene["cycles"].as_array().unwrap())
    {
        for name in ["q_min", "q_max", "v_min", "v_max", "period", "multiplier"] {
            agree(&one[name], number(&other[name]), 1e-12);
        }
    }
    let window = "--window=-2:2,-1:1";
    let counted = about("basin", name, &[window, "--grid", "40x30"]);
    let scene = json(&format!("basin {paper} {window} --grid 40x30"));
    assert_eq!(counted["counts"], scene["counts"]);
    for kick in ["displacement", "impulse"] {
        agree(&counted["margin"][kick], number(&scene["margin"][kick]), 1e-12);
    }
    let start = ["--set", "x=0.25", "--set", "v=0.1", "--until", "40"];
    let motion = about("trajectory", name, &start);
    let scene = json(&format!("trajectory {paper} --set q0=0.25 --set v0=0.1 --until 40"));
    let [events, expected] = [&motion, &scene].map(|it| it["events"].as_array().unwrap());
    assert_eq!(events.len(), expected.len());
    for (event, expected) in events.iter().zip(expected) {
        agree(&event["tau"], number(&expected["tau"]), 1e-8);
        agree(&event["q"], number(&expected["q"]), 1e-8);
    }
    assert_eq!(motion["outcome"]["kind"], scene["outcome"]["kind"]);
    agree(&motion["outcome"]["q"], number(&scene["outcome"]["q"]), 1e-8);
    // The mode has no picture, and what is all motions' is asked of Taylor series alone.
    run(&["figure", "--machine", name]).is_refused(&["no belt to be drawn"]);
    run(&["basin", "--machine", name, "--method", "dop853"]).is_refused(&["auto or taylor"]);
    run(&["border", "--machine", name, "--over", "R=1:2:3"]).is_refused(&["--along"]);
}

#[test]
fn where_the_starts_of_a_window_end_is_the_share_of_the_benchmark() {
    // Counted from the steady position, 0.5249 m from the benchmark's origin.
    let window = "--window=-2.5248935341839319:1.4751064658160681,0:2";
    let found = about("basin", "bstab", &[window, "--grid", "120x90"]);
    agree(&found["captured"], 0.307_126_137_781_600_8, 1e-12);
    let counts = &found["counts"];
    let [captured, cycle] = ["captured", "cycle"].map(|fate| number(&counts[fate]));
    assert_eq!(captured + cycle, 120.0 * 90.0);
    assert!((captured / (120.0 * 90.0) - 0.307_126).abs() < 0.02, "{counts}");
}

#[test]
fn changes_are_located_along_a_number_and_over_another() {
    let hopf = 0.5 * ln(10.0);
    let branch = about("branch", "bstab", &["--over", "v0=0.5:2:7"]);
    let special = branch["special"].as_array().unwrap();
    let kinds: Vec<&str> = special.iter().map(|it| it["kind"].as_str().unwrap()).collect();
    assert_eq!(kinds, ["hopf", "annihilation"]);
    agree(&special[0]["value"], hopf, 1e-14);
    agree(&special[1]["value"], 1.836_600_972_207_926, 1e-12);
    assert_eq!(special[1]["jumps"]["up"]["to"]["kind"], "rest");
    assert_eq!(branch["points"][0]["value"], 0.5);
    // With F both d1 and the law's slope at the Hopf point scale: exp(-2 v0) = d1/F.
    let border = about("border", "bstab", &["--along", "v0=0.5:2:7", "--over", "F=0.8:1:3"]);
    for (point, force) in border["points"].as_array().unwrap().iter().zip([0.8, 0.9, 1.0]) {
        agree(&point["value"], force, 1e-15);
        agree(&point["special"][0]["value"], 0.5 * ln(10.0 * force), 1e-13);
    }
    let rows = run(&["border", "--machine", "bstab", "--over", "F=0.9:1:2", "--format", "csv"]).out;
    let lines: Vec<&str> = rows.lines().collect();
    assert_eq!((lines[0], lines.len()), ("F,v0,kind,q_max", 5), "{rows}");
    run(&["border", "--machine", "bstab", "--over", "v0=1:2:3"]).is_refused(&["varied twice"]);
}

#[test]
fn margins_for_certain_are_those_of_the_overview() {
    let words = ["--set", "R=1N+-0.2N", "--disturbance", "0.1 N"];
    let margin = about("margin", "textbook", &words);
    let overview = belt(&[&["textbook"], &words[..]].concat());
    for (one, other) in [("nominal", "margin"), ("guaranteed", "guaranteed")] {
        for kick in ["displacement", "impulse", "from_rest"] {
            assert_eq!(margin[one][kick], overview[other][kick], "{one} {kick}");
        }
    }
    // Text is not above what holds.
    let text = run(&[&["margin", "--machine", "textbook"], &words[..]].concat()).out;
    let row = text.lines().find(|line| line.trim_start().starts_with("displacement")).unwrap();
    let told: f64 = row.split_whitespace().rev().nth(1).unwrap().parse().unwrap();
    let holds = 1e3 * margin["guaranteed"]["displacement"].as_f64().unwrap();
    assert!(told <= holds && told > holds - 1e-4, "{text} {holds}");
    let known = &margin["parameters"];
    assert_eq!(known["R"], overview["guaranteed"]["tolerances"]["R"]);
    assert_eq!((&known["m"][0], &known["m"][1]), (&2.0.into(), &2.0.into()));
    assert_eq!(
        (&margin["disturbance"], &margin["guaranteed"]["reason"]),
        (&0.1.into(), &Value::Null)
    );
    // What is known exactly is certain.
    let exact = about("margin", "textbook", &[]);
    assert_eq!(exact["nominal"]["impulse"], exact["guaranteed"]["impulse"]);
    let lost = about("margin", "textbook", &["--disturbance", "3 N"]);
    assert!(lost["guaranteed"]["reason"].as_str().unwrap().contains("disturbance of 3 N"));
}

/// Where the motion of a machine from a start comes to rest, if it does.
fn rest(model: &Model, portrait: &Portrait, (x, v): (f64, f64)) -> Option<f64> {
    if portrait.fate(x, v) != Ok(Fate::Rest) {
        return None;
    }
    let motion = follow_by_series(model, (x, v), 1e3);
    let Outcome::Captured { q, .. } = motion.outcome else { panic!("{:?}", motion.outcome) };
    Some(q)
}

/// Kicks one after the other, each drawn and followed, against the integral and the chain.
#[test]
fn kicks_of_a_machine_are_lost_as_often_as_those_that_are_drawn() {
    // The border is an unstable cycle, and an orbit that touches the belt.
    for (name, spreads, count) in [("textbook", (5e-4, 0.04), 4000), ("groan", (4e-4, 0.03), 4000)]
    {
        let belt = find(name).unwrap().belt.clone();
        let model = Model::new(&belt).unwrap();
        let portrait = Portrait::of(&model).unwrap();
        let law = format!("q=0+-{:?} m,v=0+-{:?}", spreads.0, spreads.1);
        let found = about("kicks", name, &["--kicks", &law]);
        let mut random = Random::new(3);
        let (mut kicked, mut place, mut run, mut runs) = (0, 0.0, 0.0, Vec::new());
        let (mut first, mut lost) = (0.0, 0.0);
        while kicked < count || run > 0.0 {
            let start = (place + spreads.0 * random.normal(), spreads.1 * random.normal());
            if run == 0.0 {
                first += 1.0;
            }
            (kicked, run) = (kicked + 1, run + 1.0);
            if let Some(next) = rest(&model, &portrait, start) {
                place = next;
            } else {
                lost += f64::from(u8::from(run == 1.0));
                runs.push(run);
                (place, run) = (0.0, 0.0);
            }
        }
        let count = first;
        let mean = runs.iter().sum::<f64>() / count;
        let spread = runs.iter().map(|run| (run - mean) * (run - mean)).sum::<f64>() / count;
        let part = number(&found["lost"]["part"]);
        assert!((lost / count - part).abs() < 4.0 * (part / count).sqrt(), "{name}: {lost} {part}");
        assert!(number(&found["lost"]["error"]) < 1e-6 * part, "{found}");
        let expected = number(&found["repeated"]["mean"]);
        let error = number(&found["repeated"]["error"]) * expected + 4.0 * (spread / count).sqrt();
        assert!((mean - expected).abs() < error, "{name}: {mean} {expected} {error}");
        let row = &scan(
            name,
            &["--over", "m=1:2:2", "--measure", "lost,repeated", "--kicks", &law, "--rows", "1:1"],
        )[0];
        assert!(number(&row["lost_part"]) > 0.0 && number(&row["kicks_mean"]) > 1.0, "{row}");
    }
    // A mode that is the oscillator of the paper, where a border without a cycle separates rest from escape.
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("mode.toml");
    let frequency = 0.5 / std::f64::consts::PI;
    for (numbers, paper) in [
        ("[-0.3, 0, 0.25]", "--set D=-0.3 --set D3=0.5 --set D2=0"),
        ("[0.05, 0.25]", "--set D=0.05 --set D2=0.5 --set D3=0"),
    ] {
        let text = format!(
            "frequency = {frequency:?}\nmodal_mass = 1\ndamping_ratio = {numbers}\nR = 0.1\n"
        );
        std::fs::write(&path, text).unwrap();
        let law = ["--kicks", "q=0+-0.1,v=0.05+-0.2"];
        let machine = about("kicks", path.to_str().unwrap(), &law);
        let scene = json(&format!("kicks {paper} --set r=0.1 {}", law.join(" ")));
        agree(&machine["lost"]["part"], number(&scene["lost"]["part"]), 1e-9);
        agree(&machine["repeated"]["mean"], number(&scene["repeated"]["mean"]), 1e-5);
    }
    let ran = run(&["kicks", "--machine", "bstab", "--kicks", "q=0+-1"]);
    assert!(ran.code == 1 && ran.err.contains("friction, without which"), "{}", ran.err);
}

#[test]
fn a_motion_is_that_of_the_overview_by_every_method() {
    let words = ["--set", "x=6 mm"];
    let motion = about("trajectory", "textbook", &words);
    let overview = belt(&["textbook", "--set", "x=6 mm"])["motion"].clone();
    let end = &overview["end"];
    assert_eq!((&motion["initial"]["q"], &motion["outcome"]["q"]), (&0.006.into(), &end["x"]));
    assert_eq!((&motion["outcome"]["tau"], &motion["energy"]), (&end["t"], &overview["energy"]));
    assert_eq!(
        motion["phases"].as_array().map(Vec::len),
        overview["phases"].as_array().map(Vec::len)
    );
    let events = motion["events"].as_array().unwrap();
    assert!(events.len() > 3);
    for method in ["dop853", "dopri5"] {
        let line = [&words[..], &["--method", method, "--tol", "1e-12"]].concat();
        let other = about("trajectory", "textbook", &line);
        assert_eq!(other["method"], method);
        let others = other["events"].as_array().unwrap();
        assert_eq!(events.len(), others.len());
        for (event, other) in events.iter().zip(others) {
            agree(&event["tau"], number(&other["tau"]), 1e-6);
            agree(&event["q"], number(&other["q"]), 1e-6);
        }
    }
    run(&["trajectory", "--machine", "textbook", "--method", "rk4"])
        .is_refused(&["knows one switching line only"]);
}

/// `mu = 0.5 - 0.4 v` vanishes at 1.25 m/s, and the start slips by 1.7 m/s.
#[test]
fn a_start_beyond_the_friction_law_says_where_that_ends() {
    let model = Model::new(&find("straight").unwrap().belt).unwrap();
    let motion = follow_by_series(&model, (0.0, -1.2), 1.0);
    let Err(Reason::BeyondLaw { slip }) = motion.outcome.answered() else {
        panic!("{:?}", motion.outcome)
    };
    assert!((slip - 1.25).abs() < 1e-9, "{slip}");
}

#[test]
fn what_accuracy_costs_is_measured_on_one_motion_of_a_machine() {
    let trade = about("trade", "textbook", &["--set", "x=6 mm", "--until", "1 s"]);
    let rows = trade["rows"].as_array().unwrap();
    // The benchmark's stick-slip cycle ends where two other codes end it, so the reference is right.
    let slip = about(
        "trajectory",
        "bstab",
        &["--set", "x=1.6816025959660914", "--until", "6.316306357891375"],
    );
    assert!((number(&slip["outcome"]["q"]) - 1.681_602_595_966_091_4).abs() < 1e-11, "{slip}");
    let error = |method: &str, tolerance: f64| {
        let row = rows.iter().find(|it| it["method"] == method && it["tolerance"] == tolerance);
        number(&row.unwrap_or_else(|| panic!("{method} {tolerance}"))["error"])
    };
    // By three methods that have only the model in common.
    for method in ["taylor", "dop853", "dopri5"] {
        assert!(error(method, 1e-13) < 1e-12 && error(method, 1e-5) < 1e-3, "{method}");
    }
    // Their steps are a part of a swing at most, so the pair of order 8 is never coarse.
    for method in ["taylor", "dopri5"] {
        assert!(error(method, 1e-5) > 10.0 * error(method, 1e-12), "{method}");
    }
    let costs = rows.iter().filter(|row| row["method"] == "dopri5");
    let costs: Vec<f64> = costs.map(|row| number(&row["evaluations"])).collect();
    assert!(costs.is_sorted() && rows.iter().all(|row| number(&row["seconds"]) > 0.0));
    run(&["trade", "plain", "--machine", "textbook"]).is_refused(&["cannot be used with"]);
}

#[test]
fn the_figure_of_a_machine_is_that_of_its_numbers() {
    let figure = |more: &[&str]| {
        let ran = run(&[&["figure", "--machine", "textbook", "--format", "json"], more].concat());
        assert_eq!(ran.code, 0, "{}", ran.err);
        serde_json::from_str::<Value>(&ran.out).unwrap()
    };
    assert_ne!(figure(&[])["panels"], figure(&["--set", "R=2 N"])["panels"]);
}
