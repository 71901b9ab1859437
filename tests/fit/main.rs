//! Fits of records with known truth, made by an independent simulator or from the program's own motions with
//! noise of fixed seeds.

mod explorer;
#[path = "../explorer/mod.rs"]
mod explorer_session;
mod kinds;
mod lists;
mod noise;
#[path = "../program/mod.rs"]
mod program;
mod signals;
mod signed;
mod simulator;
mod strange;

use std::fs;

use hopfscope::fit::{
    Choice, Estimate, NAMES, NameSpec, Question, Record, Residual, Signal, StartKind, UNKNOWNS,
    Way, estimate, named,
};
use hopfscope::numerics::elementary::powi;
use hopfscope::numerics::random::Random;
use program::{json, run};
use rayon::prelude::*;
use serde_json::Value;

const NUMBERS: [&str; 6] = ["omega0", "offset", "D", "D2", "D3", "r"];

/// The unknowns of a motion, without a drift.
type Unknowns = [f64; 8];

fn without_drift(p: &Unknowns) -> hopfscope::fit::Unknowns {
    hopfscope::fit::Unknowns::from_fn(|place, _| p.get(place).copied().unwrap_or(0.0))
}

fn path(name: &str) -> String {
    format!("{}/tests/data/fit/{name}.csv", env!("CARGO_MANIFEST_DIR"))
}

/// The records with their truth: parameters, the standard errors that the Fisher information allows (for the
/// rows kept here), and the behaviour of the motion.
fn truth() -> serde_json::Map<String, Value> {
    let text =
        fs::read_to_string(format!("{}/tests/data/fit/truth.json", env!("CARGO_MANIFEST_DIR")));
    serde_json::from_str(&text.unwrap()).unwrap()
}

fn fitted(name: &str) -> Value {
    let peaks = if name.starts_with("peaks") { " --peaks" } else { "" };
    json(&format!("fit {}{peaks} --draws 40", path(name)))
}

/// The 95 % interval, infinite where the data set no bound.
fn interval(number: &Value) -> (f64, f64) {
    (
        number["lower"].as_f64().unwrap_or(f64::NEG_INFINITY),
        number["upper"].as_f64().unwrap_or(f64::INFINITY),
    )
}

#[test]
fn records_of_an_independent_simulator_are_understood_from_the_file_alone() {
    let (mut inside, mut asked) = (0, 0);
    for (name, truth) in truth() {
        let found = fitted(&name);
        for number in NUMBERS {
            let (told, true_value) =
                (&found["parameters"][number], truth["parameters"][number].as_f64().unwrap());
            let (lower, upper) = interval(told);
            asked += 1;
            inside += usize::from((lower..=upper).contains(&true_value));
            let error = told["standard_error"].as_f64().unwrap();
            let off = (told["value"].as_f64().unwrap() - true_value) / error;
            assert!(off.abs() < 4.0, "{name}: {number} is {off} standard errors off");
            let fisher = truth["standard_error"][number].as_f64().unwrap();
            assert!(
                error <= 1.3 * fisher,
                "{name}: the error of {number} is {error}, not {fisher}"
            );
        }
        assert_eq!(found["rests"], truth["rests"], "{name}");
        assert_eq!(found["half_swings"], truth["half_swings"], "{name}");
        assert_eq!(found["residuals"]["white"], true, "{name}");
        assert_eq!(found["residuals"]["systematic"], false, "{name}");
        let separable = found["separable"].as_array().unwrap();
        assert_eq!(separable.is_empty(), name != "d_or_r", "{name}: {separable:?}");
    }
    // Of 54 intervals of 95 %, 2.7 miss on average; eight or more miss in one of 200 cases.
    assert!(inside >= asked - 7, "{inside} of {asked} intervals hold the truth");
}

#[test]
fn parameters_that_cannot_be_separated_are_reported_as_a_known_combination() {
    let found = fitted("d_or_r");
    let combination = &found["separable"][0];
    let weight = |name: &str| combination["combination"][name].as_f64().unwrap();
    // 2/(pi A) and (3/8) A^2 at the amplitudes of the record, 8.7 .. 9.7.
    assert_eq!(weight("D"), 1.0);
    assert!((weight("r") - 0.069).abs() < 0.002 && (weight("D3") - 32.0).abs() < 2.0);
    // The truth: 0.004 + 0.069 x 0.03.
    let (value, error) =
        (combination["value"].as_f64().unwrap(), combination["standard_error"].as_f64().unwrap());
    assert!((value - 0.006_06).abs() < 3.0 * error && error < 3e-4, "{value} +- {error}");
    // The combination is known to 3 %, each number alone not even to its own size.
    assert!(
        found["parameters"]["D"]["standard_error"].as_f64().unwrap() > 10.0 * value.abs() / 2.0
    );
}

#[test]
fn a_margin_within_the_record_is_found_and_one_beyond_it_is_marked_as_extrapolated() {
    for (name, extrapolated) in [("near_fold", false), ("negative_captured", true)] {
        let line = format!("fit {} --draws 80", path(name));
        let margin = &json(&line)["margin"];
        let (lower, upper) = interval(&margin["displacement"]);
        let true_margin = truth()[name]["margin"].as_f64().unwrap();
        assert!((lower..=upper).contains(&true_margin), "{name}: {lower} .. {upper}");
        assert!(upper - lower < 0.15 * true_margin, "{name}: {lower} .. {upper}");
        assert_eq!(margin["extrapolated"], extrapolated, "{name}");
        assert_eq!((&margin["displacement"]["none"], &margin["failed"]), (&0.0.into(), &0.into()));
    }
}

/// A record of the program's own motion with added noise.
#[derive(Clone, Copy)]
struct Simulated {
    p: Unknowns,
    start: StartKind,
    seconds: f64,
    samples: u32,
    noise: f64,
    /// Correlation between successive samples.
    memory: f64,
    signal: Signal,
}

impl Simulated {
    fn times(&self) -> Vec<f64> {
        (0..self.samples).map(|i| self.seconds * f64::from(i) / f64::from(self.samples)).collect()
    }

    fn record(&self, seed: u64) -> Record {
        let t = self.times();
        let data = Record {
            x: vec![0.0; t.len()],
            t: t.clone(),
            signal: self.signal,
            ..Record::default()
        };
        let way = Way { reach: 1e9, ..Way::default() };
        let motion = data.compare(self.start, &without_drift(&self.p), way).unwrap().residuals;
        let mut chance = Random::new(seed);
        let mut error = chance.normal();
        let fresh = (1.0 - self.memory * self.memory).sqrt();
        let noisy = |seen: &Residual| {
            error = self.memory * error + fresh * chance.normal();
            self.noise * error - seen.value
        };
        let x = motion.iter().map(noisy).collect();
        Record { t, x, signal: self.signal, ..Record::default() }
    }

    fn fitted(&self, seed: u64) -> Estimate {
        estimate(&self.record(seed), &Question::default(), &|| false).unwrap()
    }
}

/// omega0, offset, D, D2, D3, r, q0, t0: fourteen half swings and a rest.
const DECAY: Unknowns = [10.0, 0.5, 0.02, 0.005, 0.0005, 0.15, 6.0, 0.3];

/// This decay for six seconds, with independent noise.
const RELEASED: Simulated = Simulated {
    p: DECAY,
    start: StartKind::Release,
    seconds: 6.0,
    samples: 600,
    noise: 0.05,
    memory: 0.0,
    signal: Signal::Displacement,
};

/// Fails unless each of these numbers is within this many standard errors of the truth.
fn assert_near<'a>(
    found: &Estimate,
    truth: &Unknowns,
    errors: f64,
    rows: impl IntoIterator<Item = &'a NameSpec>,
) {
    for row in rows {
        let off = (found.p[row.place] - truth[row.place]) / found.covariance.error(row.place);
        assert!(off.abs() < errors, "{} is {off} standard errors off", row.name);
    }
}

#[test]
fn a_first_guess_with_a_wrong_number_of_half_swings_is_corrected() {
    // Correlated noise and asymmetric damping: the first descent ends with one half swing too many.
    let p = [8.0, -3.0, 0.01, -0.04, 0.001, 0.15, -6.0, 0.7];
    let decay = Simulated { p, seconds: 14.0, samples: 800, memory: 0.6, ..RELEASED };
    for seed in [3, 5, 6] {
        let found = decay.fitted(seed);
        assert_eq!(found.half_swings, 15, "{:?}", found.rivals);
        assert_near(&found, &p, 3.5, named("r"));
    }
}

#[test]
fn ten_thousand_samples_take_at_most_forty_motions_with_derivatives() {
    // A weakly damped oscillation, digitised in steps of 0.005.
    let ringing = Simulated {
        p: [31.4, 0.0, 0.0008, 0.0, 2e-5, 0.001, 6.0, 0.5],
        start: StartKind::Moving,
        seconds: 30.0,
        samples: 10_000,
        noise: 0.006,
        ..RELEASED
    };
    let mut record = ringing.record(3);
    record.x.iter_mut().for_each(|x| *x = (*x / 0.005).round() * 0.005);
    let found = estimate(&record, &Question::default(), &|| false).unwrap();
    assert!(found.motions.0 <= 40, "{:?}", found.motions);
    assert_eq!(found.half_swings, 300);
    assert_near(&found, &ringing.p, 3.5, &NAMES);
    let decay = Simulated { samples: 10_000, ..RELEASED };
    let found = decay.fitted(11);
    assert!(found.motions.0 <= 40, "{:?}", found.motions);
}

#[test]
fn held_numbers_stay_and_only_the_requested_ones_are_reported() {
    let file = path("coulomb_rest");
    let found = json(&format!("fit {file} --free D,r --draws 40"));
    let told: Vec<&String> = found["parameters"].as_object().unwrap().keys().collect();
    assert_eq!(told, ["D", "r"]);
    assert_eq!(found["held"], serde_json::json!({"D2": 0.0, "D3": 0.0}));
    let both = json(&format!("fit {file} --draws 40"));
    let error = |document: &Value| document["parameters"]["r"]["standard_error"].as_f64().unwrap();
    // With fewer unknowns the errors are smaller: 1.33e-4 against 2.92e-4 for all rows of this record.
    assert!(error(&found) < 0.6 * error(&both));
    let held = json(&format!("fit {file} --set r=0.15 --set D3=0 --draws 40"));
    assert_eq!(held["held"], serde_json::json!({"D3": 0.0, "r": 0.15}));
    assert!(held["parameters"]["r"].is_null());
}

#[test]
fn with_a_mass_forces_are_given_in_newtons() {
    let found = json(&format!("fit {} --mass 2kg --draws 40", path("coulomb_rest")));
    let number = |name: &str| found["physical"]["numbers"][name]["value"].as_f64().unwrap();
    // c = m omega0^2, R = c r with r = 0.15 mm, d1 = 2 D m omega0.
    let stiffness = 2.0 * 31.4_f64 * 31.4;
    assert!((number("c") / stiffness - 1.0).abs() < 1e-3);
    assert!((number("R") / (stiffness * 0.15e-3) - 1.0).abs() < 0.02);
    assert!((number("d1") / (2.0 * 0.01 * 2.0 * 31.4) - 1.0).abs() < 0.06);
    let same = json(&format!("fit {} --stiffness 1971.92N/m --draws 40", path("coulomb_rest")));
    let mass = same["physical"]["numbers"]["m"]["value"].as_f64().unwrap();
    assert!((mass - 2.0).abs() < 2e-3, "{mass}");
}

#[test]
fn the_zeros_of_the_damping_over_amplitude_are_the_cycles() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("fit.json");
    let name = file.display().to_string();
    let found = json(&format!("fit {} --draws 40 --output {name}", path("near_fold")));
    let drawn: Value = serde_json::from_str(&fs::read_to_string(&file).unwrap()).unwrap();
    let titles: Vec<&str> = drawn["panels"]
        .as_array()
        .unwrap()
        .iter()
        .map(|panel| panel["title"].as_str().unwrap())
        .collect();
    assert_eq!(
        titles,
        [
            "record and fit",
            "residuals",
            "memory of the residuals",
            "damping over amplitude",
            "phase plane",
            "margin from rest, distribution",
            "D and r together"
        ]
    );
    let number = |name: &str| found["parameters"][name]["value"].as_f64().unwrap();
    let set = ["D", "D2", "D3", "r"].map(|name| format!("--set {name}={}", number(name)));
    let cycles = json(&format!("cycles {}", set.join(" ")));
    let cycle = &cycles["cycles"][0];
    let turn = |name: &str| cycle[name].as_f64().unwrap();
    let amplitude = 0.5 * (turn("q_max") - turn("q_min"));
    let marks = drawn["panels"][3]["marks"].as_array().unwrap();
    let zero = marks.iter().find(|mark| mark["name"] == "unstable cycle").unwrap();
    let off = zero["x"].as_f64().unwrap() / amplitude - 1.0;
    assert!(off.abs() < 1e-3, "{zero} {amplitude}");
    // An existing file is not replaced without permission.
    let line = format!("fit {} --draws 40 --output {name}", path("d_or_r"));
    let ran = run(&line.split_whitespace().collect::<Vec<_>>());
    assert_eq!(ran.code, 2, "{}", ran.err);
}

#[test]
fn peaks_without_times_determine_all_but_the_frequency() {
    let text = fs::read_to_string(path("peaks_times")).unwrap();
    let rows = text.lines().map(|line| line.rsplit(',').next().unwrap());
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("peaks.csv");
    fs::write(&file, rows.collect::<Vec<_>>().join("\n")).unwrap();
    let found = json(&format!("fit {} --peaks --draws 40", file.display()));
    let told: Vec<&String> = found["parameters"].as_object().unwrap().keys().collect();
    assert_eq!(told, ["D", "D2", "D3", "offset", "r"]);
    let truth = &truth()["peaks_times"]["parameters"];
    for number in told {
        let (lower, upper) = interval(&found["parameters"][number]);
        assert!((lower..=upper).contains(&truth[number].as_f64().unwrap()), "{number}");
    }
}

#[test]
fn bad_files_and_options_get_one_line() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| {
        let file = folder.path().join(name);
        fs::write(&file, text).unwrap();
        file.display().to_string()
    };
    let good = path("coulomb_rest");
    let [word, short] = [("word", "t;x\n0;1\n1;abc\n2;3\n"), ("short", "t;x\n0;1\n1;2\n2;3\n")]
        .map(|(name, text)| write(name, text));
    let cases: [(Vec<&str>, i32, &str); 8] = [
        (vec![&word], 2, "line 3, column 2: \"abc\" is not a number"),
        (vec![&short], 2, "3 measured numbers cannot tell 8 unknowns"),
        (vec!["/no/such/file.csv"], 2, "No such file"),
        (
            vec![&good, "--free", "D,q"],
            2,
            "no number \"q\"; there are omega0, offset, D, D2, D3, r",
        ),
        (vec![&good, "--set", "r=-1"], 2, "r = -1 is outside its range 0 .. 1e150"),
        (vec![&good, "--free", "D", "--set", "D=0"], 2, "hopfscope: D is both --free and --set"),
        (
            vec![&good, "--half-width", "r=0.1", "--half-width", "r=0"],
            2,
            "hopfscope: r has two half widths",
        ),
        (vec![&good, "--columns", "t=1,x=7"], 2, "there is no column 7; there are 2"),
    ];
    for (arguments, code, message) in cases {
        let mut words = vec!["fit"];
        words.extend(arguments);
        let ran = run(&words);
        assert_eq!((ran.code, ran.err.lines().count()), (code, 1), "{words:?}: {}", ran.err);
        assert!(ran.err.contains(message), "{words:?}: {}", ran.err);
        assert_eq!(ran.out, "");
    }
}

#[test]
fn a_fit_is_the_same_in_any_unit() {
    // The scaling symmetry: D2 per length, D3 per length squared.
    let decay = Simulated { samples: 300, ..RELEASED };
    let record = decay.record(9);
    let larger = Record { x: record.x.iter().map(|x| 1000.0 * x).collect(), ..record.clone() };
    let question = Question { choice: Choice::default(), ..Question::default() };
    let one = estimate(&record, &question, &|| false).unwrap();
    let other = estimate(&larger, &question, &|| false).unwrap();
    for row in &NAMES {
        let length = match row.name {
            "offset" | "r" => 1,
            "D2" => -1,
            "D3" => -2,
            _ => 0,
        };
        let scaled = one.p[row.place] * powi(1000.0, length);
        let error = one.covariance.error(row.place) * powi(1000.0, length);
        assert!((other.p[row.place] - scaled).abs() < 1e-3 * error, "{}", row.name);
    }
}

#[test]
fn peaks_continue_at_rest_so_that_intervals_do_not_end_there() {
    // The last two readings belong to a motion that has nearly died away.
    let decay = [1.0, 0.3, 0.012, 0.004, 0.0004, 0.1, 8.0, 0.0];
    let data = Record { x: vec![0.0; 24], peaks: Some(1.0), ..Record::default() };
    let way = Way { reach: 1e9, ..Way::default() };
    let stronger = |r: f64| {
        let mut p = decay;
        p[5] = r;
        data.compare(StartKind::Release, &without_drift(&p), way).unwrap()
    };
    let last = |r: f64| stronger(r).residuals[23].value;
    assert!(stronger(0.13).turns.len() < 23);
    // Continuous across every rim.
    for step in 0..400_u16 {
        let r = 0.09 + 1e-4 * f64::from(step);
        assert!((last(r + 1e-4) - last(r)).abs() < 0.02, "{r}");
    }
}

#[test]
fn a_record_that_is_not_a_decay_gets_the_same_answer_every_time() {
    let t: Vec<f64> = (0..210_u8).map(|i| 0.01 * f64::from(i)).collect();
    let x = (0..210_u8).map(|i| 0.01 * f64::from(i % 7)).collect();
    let record = Record { t, x, ..Record::default() };
    let fit = || estimate(&record, &Question::default(), &|| false);
    let first = format!("{fit:?}", fit = fit());
    assert!((0..3).all(|_| format!("{fit:?}", fit = fit()) == first));
}
