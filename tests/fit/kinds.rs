//! Records of many kinds with known truth: what a fit says without a warning must be right.

use hopfscope::fit::{DRAWS, DropReason, MarginQuestion, Margins, conditions, margins};
use hopfscope::flow::Limits;
use hopfscope::model::{Model, Parameters};
use hopfscope::portrait::Portrait;
use hopfscope::portrait::closing::all::all_closings;
use hopfscope::portrait::closing::equation::Equation;

use super::simulator::{KINDS, Simulation, simulated};
use super::*;

/// What a fit says about a record.
pub struct Outcome {
    pub kind: &'static str,
    pub seed: u64,
    /// For each estimated number whether its interval holds the truth, and the distance of the truth in errors by
    /// the interval.
    pub numbers: Vec<(&'static str, bool, f64)>,
    /// Whether a condition fails, which the first line says.
    pub warns: bool,
    /// Whether the lower end of the margin is above the true margin, if that exists.
    pub too_large: Option<bool>,
}

fn outcome(kind: &'static str, seed: u64, draws: usize) -> Option<Outcome> {
    let Simulation { truth, amplitude, record, peaks } = simulated(kind, seed);
    let question = Question { peaks, ..Question::default() };
    // A refusal is no wrong answer.
    let found = estimate(&record, &question, &|| false).ok()?;
    let margins = if draws == 0 {
        Margins::default()
    } else {
        let question = MarginQuestion { draws, ..MarginQuestion::default() };
        margins(&found, &question, &Limits::PATIENT).unwrap()
    };
    // Without a margin nothing is asked of its draws.
    let counts = |name: &str| draws > 0 || name != "draws";
    let warns = conditions(&found, &margins).iter().any(|it| !it.holds && counts(it.name));
    let numbers = found.wanted().map(|row| {
        let index = NAMES.iter().position(|other| other == row).unwrap();
        let (value, interval) = (found.p[row.place], found.intervals[row.place]);
        let end = if truth[index] < value {
            interval.lower
        } else {
            interval.upper
        };
        let off = end.map_or(0.0, |end| 1.96 * ((truth[index] - value) / (end - value)).abs());
        (row.name, off <= 1.96, off)
    });
    let true_margin = true_margin(&truth, amplitude);
    let too_large =
        true_margin.map(|at| margins.kicks.displacement.lower.is_none_or(|lower| lower > at));
    Some(Outcome { kind, seed, numbers: numbers.collect(), warns, too_large })
}

fn true_margin(truth: &[f64; 6], reach: f64) -> Option<f64> {
    let parameters = Parameters { d: truth[2], d2: truth[3], d3: truth[4], r: truth[5] };
    let mut equation = Equation::new(&parameters, f64::EPSILON, &Limits::PATIENT);
    let closings = all_closings(&mut equation).ok()?;
    let model = Model::of_paper(&parameters).ok()?;
    let found = Portrait::around(&model, &parameters, &closings, reach, &Limits::PATIENT).ok()?;
    found.margin.displacement
}

/// The outcomes of the records with these numbers, of each kind.
pub fn outcomes(
    kinds: &[&'static str],
    seeds: std::ops::RangeInclusive<u64>,
    draws: usize,
) -> Vec<Outcome> {
    let all: Vec<(&'static str, u64)> =
        kinds.iter().flat_map(|kind| seeds.clone().map(move |seed| (*kind, seed))).collect();
    all.into_par_iter().filter_map(|(kind, seed)| outcome(kind, seed, draws)).collect()
}

/// The answers that are wrong by more than 4.5 errors and do not say that a condition fails.
pub fn silent_errors(outcomes: &[Outcome]) -> Vec<String> {
    outcomes
        .iter()
        .filter(|it| !it.warns && it.numbers.iter().any(|number| number.2 > 4.5))
        .map(|it| format!("{} {}: {:?}", it.kind, it.seed, it.numbers))
        .collect()
}

/// The percentage of the intervals without a warning that hold the truth.
pub fn percentage<'a>(outcomes: impl Iterator<Item = &'a Outcome>, name: Option<&str>) -> f64 {
    let numbers = outcomes.filter(|it| !it.warns).flat_map(|it| &it.numbers);
    let (count, inside) = numbers
        .filter(|number| name.is_none_or(|name| number.0 == name))
        .fold((0.0, 0.0), |(count, inside), it| (count + 1.0, inside + f64::from(u8::from(it.1))));
    100.0 * inside / f64::max(count, 1.0)
}

#[test]
fn no_answer_about_records_of_fifteen_kinds_is_wrong_without_saying_so() {
    let found = outcomes(&KINDS, 1..=5, 40);
    assert!(found.len() >= 60 && found.iter().filter(|it| it.warns).count() <= 8);
    let silent = silent_errors(&found);
    assert!(silent.is_empty(), "{silent:#?}");
    let covered = percentage(found.iter(), None);
    assert!((91.0..=98.5).contains(&covered), "{covered} % of the intervals hold the truth");
}

/// `cargo test --release --test fit -- --ignored --nocapture` (some minutes).
#[test]
#[ignore = "takes minutes; run in release"]
fn intervals_of_a_hundred_records_of_each_kind_hold_the_truth_as_often_as_they_say() {
    let found = outcomes(&KINDS, 1..=100, 40);
    for kind in KINDS {
        let each =
            NUMBERS.map(|name| percentage(found.iter().filter(|it| it.kind == kind), Some(name)));
        let warned = found.iter().filter(|it| it.kind == kind && it.warns).count();
        println!("{kind:10} {each:5.1?} warned {warned}");
        let covered = percentage(found.iter().filter(|it| it.kind == kind), None);
        assert!((90.0..=99.5).contains(&covered), "{kind}: {covered} %");
    }
    for name in NUMBERS {
        let covered = percentage(found.iter(), Some(name));
        assert!((93.0..=97.0).contains(&covered), "{name}: {covered} %");
    }
    let silent = silent_errors(&found);
    assert!(200 * silent.len() <= found.len(), "{silent:#?}");
    let with_margin = outcomes(&["growth", "cycle"], 101..=200, DRAWS);
    let told: Vec<bool> =
        with_margin.iter().filter(|it| !it.warns).filter_map(|it| it.too_large).collect();
    let above = told.iter().filter(|it| **it).count();
    println!("lower end of the margin above the truth: {above} of {}", told.len());
    assert!(25 * above <= told.len());
}

#[test]
fn a_growth_from_near_an_unstable_cycle_is_released_when_it_was() {
    for seed in [15, 27, 34, 62] {
        let Simulation { truth, record, .. } = simulated("growth", seed);
        let found = estimate(&record, &Question::default(), &|| false).unwrap();
        assert_eq!(
            (found.start, found.count(DropReason::Outlier)),
            (StartKind::Release, 0),
            "growth {seed}"
        );
        for (row, is) in NAMES.iter().zip(truth) {
            let off = (found.p[row.place] - is) / found.covariance.error(row.place);
            assert!(off.abs() < 4.5, "growth {seed}: {} is {off} errors off", row.name);
        }
    }
}

#[test]
fn two_turning_points_are_enough_if_the_curve_between_them_is_seen() {
    let found = outcomes(&["few"], 1..=24, 0);
    assert_eq!(found.len(), 24);
    let covered = percentage(found.iter(), None);
    assert!((88.0..=99.0).contains(&covered), "{covered} % of the intervals hold the truth");
}

#[test]
fn another_motion_that_the_record_hardly_excludes_is_told() {
    let Simulation { record, .. } = simulated("shorthold", 56);
    let found = estimate(&record, &Question::default(), &|| false).unwrap();
    let all = conditions(&found, &Margins::default());
    let told = all.iter().find(|it| it.name == "rivals").unwrap();
    assert!(!told.holds && told.detail.contains("chi-squared"), "{told:?}");
    let Simulation { record, .. } = simulated("release", 1);
    let found = estimate(&record, &Question::default(), &|| false).unwrap();
    // No margins are asked for, and therefore no draws.
    let all = conditions(&found, &Margins::default());
    assert!(all.iter().all(|it| it.holds || it.name == "draws"), "{all:?}");
}

/// A record that was once fitted wrongly, and its truth.
fn hard(name: &str) -> (Record, Value) {
    let folder = format!("{}/tests/data/fit/hard", env!("CARGO_MANIFEST_DIR"));
    let bytes = fs::read(format!("{folder}/{name}.csv")).unwrap();
    let record = hopfscope::fit::parse(&bytes, &hopfscope::fit::RecordFormat::default()).unwrap();
    let truth: Value =
        serde_json::from_str(&fs::read_to_string(format!("{folder}/truth.json")).unwrap()).unwrap();
    (record, truth[name].clone())
}

#[test]
fn records_with_a_turning_point_near_the_rim_or_a_late_release_are_fitted_right() {
    let names = [
        "coulomb_17",
        "coulomb_22",
        "quant_4",
        "heavy3_7",
        "narrow_18",
        "clip_2",
        "growth_24",
        "cycle_9",
    ];
    names.into_par_iter().for_each(|name| {
        let (record, truth) = hard(name);
        let found = estimate(&record, &Question::default(), &|| false).unwrap();
        for row in found.wanted() {
            let interval = found.intervals[row.place];
            let is = truth["parameters"][row.name].as_f64().unwrap();
            let value = found.p[row.place];
            let end = if is < value { interval.lower } else { interval.upper };
            let off = end.map_or(0.0, |end| 1.96 * ((is - value) / (end - value)).abs());
            assert!(off < 4.5, "{name}: {} is {is}, not {value} in {interval:?}", row.name);
        }
    });
}

#[test]
fn a_curved_valley_is_followed_by_the_draws_of_the_margin() {
    let (record, truth) = hard("cycle_9");
    let found = estimate(&record, &Question::default(), &|| false).unwrap();
    let margins = margins(&found, &MarginQuestion::default(), &Limits::PATIENT).unwrap();
    let [lower, upper] =
        [margins.kicks.displacement.lower, margins.kicks.displacement.upper].map(Option::unwrap);
    let is = truth["margin"]["displacement"].as_f64().unwrap();
    assert!(margins.effective >= 400.0, "{}", margins.effective);
    // A long Markov chain gives .131 .. .479.
    assert!(lower < is && is < upper && lower < 0.15 && upper > 0.45, "{lower} .. {upper}");
}
