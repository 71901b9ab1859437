//! Records of velocities and accelerations, and records whose zero drifts.

use hopfscope::fit::{
    DropReason, LAST, Margins, OFFSET, OMEGA0, RecordFormat, SLOPE, conditions, parse,
};
use hopfscope::model::{ParameterBox, Parameters};
use hopfscope::numerics::elementary::sin;

use super::kinds::{Outcome, outcomes, percentage, silent_errors};
use super::signed::rest_margin;
use super::simulator::{DRIFTS, SIGNALS, simulated};
use super::*;

const ALL: [Signal; 3] = [Signal::Displacement, Signal::Velocity, Signal::Acceleration];

fn assert_covered(found: &[Outcome], least: f64) {
    let silent = silent_errors(found);
    assert!(silent.is_empty(), "{silent:#?}");
    let covered = percentage(found.iter(), None);
    assert!(covered >= least, "{covered} % of the intervals hold the truth");
    let warned = found.iter().filter(|it| it.warns).count();
    assert!(10 * warned <= found.len(), "{warned} of {} are not relied on", found.len());
}

#[test]
fn velocities_and_accelerations_tell_the_same_numbers_as_displacements_do() {
    assert_covered(&outcomes(&SIGNALS, 1..=8, 0), 91.0);
}

/// `cargo test --release --test fit -- --ignored --nocapture` (some minutes).
#[test]
#[ignore = "takes minutes; run in release"]
fn intervals_of_a_hundred_signals_and_drifts_hold_the_truth_as_often_as_they_say() {
    let kinds: Vec<&'static str> = SIGNALS.into_iter().chain(DRIFTS).collect();
    let found = outcomes(&kinds, 1..=100, 0);
    let covered = kinds.iter().map(|kind| {
        let each = || found.iter().filter(|it| it.kind == *kind);
        let numbers = NUMBERS.map(|name| percentage(each(), Some(name)));
        let warned = each().filter(|it| it.warns).count();
        let answered = each().count();
        println!(
            "{kind:22} {:5.1} {numbers:5.1?} answered {answered}, warned {warned}",
            percentage(each(), None)
        );
        assert!(answered >= 97, "{kind}: {answered} of 100 answered");
        percentage(each(), None)
    });
    let covered: Vec<f64> = covered.collect();
    println!("{:#?}", silent_errors(&found));
    assert!(covered.iter().all(|it| (92.0..=98.0).contains(it)), "{covered:?}");
    assert_covered(&found, 93.0);
}

#[test]
fn a_drift_of_the_zero_is_seen_and_fitted_and_the_answer_rests_on_it() {
    DRIFTS.into_par_iter().for_each(|kind| {
        for seed in 1..=5 {
            let record = simulated(kind, seed).record;
            let found = estimate(&record, &Question::default(), &|| false).unwrap();
            let drift = found.drift();
            assert!(drift.is_some(), "{kind} {seed}: {:?}", found.left_drift);
            assert_eq!(found.left_drift.evidence, 0.0, "{kind} {seed}");
            assert!(found.repeated.is_some_and(|off| off < 4.5), "{kind} {seed}");
        }
    });
    assert_covered(&outcomes(&DRIFTS, 1..=8, 0), 91.0);
}

/// Writes a record with a header, and says what the program answers about it as JSON.
fn answered(header: &str, record: &Record, scale: f64, options: &[&str]) -> (Value, i32) {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("record.csv").display().to_string();
    let rows = record.t.iter().zip(&record.x);
    let rows: Vec<String> = rows.map(|(t, x)| format!("{t},{}", x / scale)).collect();
    fs::write(&file, format!("{header}\n{}", rows.join("\n"))).unwrap();
    let mut words = vec!["fit", &file, "--draws", "40", "--format", "json"];
    words.extend(options);
    let ran = run(&words);
    (serde_json::from_str(&ran.out).unwrap_or_default(), ran.code)
}

#[test]
fn a_line_and_a_parabola_are_told_with_their_errors_and_what_is_neither_is_no_noise() {
    let decay = Simulated { noise: 0.02, ..RELEASED };
    let still = decay.record(4);
    let drifting = |zero: &dyn Fn(f64) -> f64| {
        let x = decay.times().into_iter().zip(&still.x).map(|(t, x)| x + zero(t)).collect();
        Record { x, ..still.clone() }
    };
    let (told, code) = answered("t [s],x [mm]", &drifting(&|t| 0.1 * t), 1.0, &[]);
    let number = |name: &str| told["drift"][name].as_f64().unwrap();
    // From the first to the last sample, 5.99 s.
    let off = (number("change") - 0.599) / number("standard_error");
    assert!(off.abs() < 3.0 && number("standard_error") < 0.01 && code == 0, "{told}");
    assert_eq!(number("bend"), 0.0);
    // The drift is told with the digits that its error leaves.
    let zero = told["conditions"].as_array().unwrap().iter().find(|it| it["name"] == "zero");
    let detail = zero.unwrap()["detail"].as_str().unwrap();
    let change = detail.split_whitespace().nth(3).unwrap().parse::<f64>().unwrap();
    assert!((change - number("change")).abs() < 0.05 * number("standard_error"), "{detail}");
    assert!(detail.contains("along a line"), "{detail}");
    let parabola = |t: f64| 0.02 * (t - 2.0) * (t - 2.0);
    let (told, code) = answered("t [s],x [mm]", &drifting(&parabola), 1.0, &[]);
    // The ends of a parabola b t^2 of duration T lie b T^2/4 above its middle.
    let number = |name: &str| told["drift"][name].as_f64().unwrap();
    let off = (number("bend") - 0.02 * 5.99 * 5.99 / 4.0) / number("bend_standard_error");
    assert!(off.abs() < 3.0 && code == 0, "{told}");
    let holds = |told: &Value, name: &str| {
        let conditions = told["conditions"].as_array().unwrap();
        conditions.iter().find(|it| it["name"] == name).unwrap()["holds"].as_bool().unwrap()
    };
    assert!(holds(&told, "zero"));
    let (told, code) = answered("t [s],x [mm]", &drifting(&|t| 0.3 * sin(2.5 * t)), 1.0, &[]);
    assert!(code == 1 && !holds(&told, "residuals"), "{told}");
    let (told, _) = answered("t [s],x [mm]", &still, 1.0, &[]);
    assert!(told.get("drift").is_none() && holds(&told, "zero"), "{told}");
}

#[test]
fn the_gradient_of_every_signal_is_that_of_differences() {
    for signal in ALL {
        for start in [StartKind::Release, StartKind::Moving] {
            let mut p = without_drift(&DECAY);
            (p[LAST], p[SLOPE], p[SLOPE + 1]) = (0.3, 0.7, -0.4);
            let t: Vec<f64> = (0..200_u8).map(|i| 0.013 + 0.02 * f64::from(i)).collect();
            let data = Record { x: vec![0.0; t.len()], t, signal, ..Record::default() };
            let compared = |p: &_, with_derivatives| {
                let way = Way { with_derivatives, reach: 1e9, ..Way::default() };
                data.compare(start, p, way).unwrap().residuals
            };
            let exact = compared(&p, true);
            for place in 0..UNKNOWNS {
                let step = 1e-6 * p[place].abs().max(1e-2);
                let moved = |by: f64| {
                    let mut p = p;
                    p[place] += by;
                    compared(&p, false)
                };
                let (above, below) = (moved(step), moved(-step));
                let largest = exact.iter().map(|it| it.by[place].abs()).fold(0.0, f64::max);
                for ((exact, above), below) in exact.iter().zip(&above).zip(&below) {
                    let difference = (below.value - above.value) / (2.0 * step);
                    let off = (exact.by[place] - difference).abs();
                    assert!(off < 1e-5 * largest, "{signal} {start:?} {place}: {off} of {largest}");
                }
            }
        }
    }
}

#[test]
fn a_blow_on_a_mass_at_rest_is_cut_off_where_nothing_else_explains_the_record() {
    for (signal, noise) in [(Signal::Velocity, 0.3), (Signal::Acceleration, 5.0)] {
        let p = [16.0, 0.2, 0.015, 0.0, 0.0, 0.1, 0.0, 5.0];
        let struck = Simulated {
            p,
            start: StartKind::Moving,
            seconds: 6.0,
            samples: 1200,
            noise,
            signal,
            ..RELEASED
        };
        let motion = struck.record(5);
        let mut chance = Random::new(6);
        let still = (0..100).map(|_| p[OFFSET] + noise * chance.normal());
        let x: Vec<f64> = still.chain(motion.x).collect();
        let t =
            (0..u32::try_from(x.len()).unwrap()).map(|index| 0.005 * f64::from(index)).collect();
        let record = Record { t, x, signal, ..Record::default() };
        let found = estimate(&record, &Question::default(), &|| false).unwrap();
        let before = found.count(DropReason::Before);
        assert!(before >= 100 && found.start == StartKind::Moving, "{before}");
        assert!(!found.whiteness.systematic, "{signal}");
        let damping = NAMES.iter().filter(|row| row.place != OFFSET);
        assert_near(&found, &struck.p, 4.0, damping);
    }
}

#[test]
fn headers_and_flags_say_what_was_measured() {
    let of = |signal: Signal| Simulated { signal, noise: 0.05 * 10.0, ..RELEASED };
    let moving = of(Signal::Velocity).record(3);
    let [name, unit] = ["signal", "unit"];
    let (told, code) = answered("t [s],v [mm/s]", &moving, 1.0, &[]);
    assert_eq!((code, &told[name], &told[unit]), (0, &"velocity".into(), &"mm".into()));
    let value = |told: &Value, number: &str| told["parameters"][number]["value"].as_f64().unwrap();
    assert!((value(&told, "r") - DECAY[5]).abs() < 0.02, "{told}");
    let (flagged, _) = answered("t,v", &moving, 1.0, &["--signal", "velocity", "--unit", "mm/s"]);
    assert_eq!(flagged["parameters"], told["parameters"]);
    // An accelerometer counts in g, and its lengths are metres.
    let shaking = Simulated { noise: 5.0, ..of(Signal::Acceleration) }.record(3);
    let (told, code) = answered("t [s],a [g]", &shaking, 9.806_65, &["--mass", "2 kg"]);
    assert_eq!((code, &told[name], &told[unit]), (0, &"acceleration".into(), &"m".into()));
    assert!((value(&told, "r") - DECAY[5]).abs() < 0.02, "{told}");
    let stiffness = told["physical"]["numbers"]["c"]["value"].as_f64().unwrap();
    assert!((stiffness / (2.0 * DECAY[OMEGA0] * DECAY[OMEGA0]) - 1.0).abs() < 1e-2);
    assert!((value(&told, "offset") - DECAY[OFFSET]).abs() < 1.0, "{told}");
}

/// A growth from near an unstable cycle, in mm, that is fitted with a margin.
const GROWTH: Simulated = Simulated {
    p: [10.0, 0.5, -0.05, 0.0, 0.0037, 0.069, 1.2, 1.0],
    seconds: 20.0,
    samples: 1600,
    noise: 0.03,
    ..RELEASED
};

#[test]
fn the_sentence_that_may_be_signed_says_the_same_of_every_signal_and_of_a_fitted_drift() {
    let [omega0, _, d, d2, d3, r, ..] = GROWTH.p;
    let known = ParameterBox::from(&Parameters { d, d2, d3, r });
    let is = rest_margin(&known, 0.0).impulse.unwrap();
    let check = |told: &Value, code: i32, length: &str| {
        let impulse = told["statement"]["impulse"].as_f64().unwrap();
        assert!(code == 0 && (0.9 * is..is).contains(&impulse), "{impulse} {is} {told}");
        let text = told["statement"]["text"].as_str().unwrap();
        assert!(text.starts_with("From any rest position, with 95 % confidence, "), "{text}");
        assert!(text.contains(&format!(" {length}/s is survived")), "{text}");
        assert_eq!(told["statement"]["units"]["impulse"], length);
    };
    for (signal, unit) in ALL.into_iter().zip(["mm", "mm/s", "mm/s^2"]) {
        let scale = powi(omega0, i32::try_from(signal.order()).unwrap());
        let record = Simulated { signal, noise: GROWTH.noise * scale, ..GROWTH }.record(8);
        let (told, code) = answered(&format!("t [s],x [{unit}]"), &record, 1.0, &[]);
        check(&told, code, "mm");
        let name = signal.to_string();
        let (bare, code) = answered("t,x", &record, 1.0, &["--signal", &name]);
        check(&bare, code, "unit");
        let words = ["--mass", "2 kg", "--unit", unit, "--signal", &name];
        let (heavy, _) = answered("t,x", &record, 1.0, &words);
        let impulse = heavy["statement"]["impulse"].as_f64().unwrap();
        let part = impulse / (2.0 * omega0 * 1e-3 * is);
        assert!((0.9..1.0).contains(&part), "{heavy}");
        assert!(heavy["statement"]["text"].as_str().unwrap().contains(" mN s is survived"));
    }
    let mut drifting = GROWTH.record(8);
    let rows = drifting.t.iter().zip(&mut drifting.x);
    rows.for_each(|(t, x)| *x += 0.02 * t);
    let (told, code) = answered("t [s],x [mm]", &drifting, 1.0, &[]);
    check(&told, code, "mm");
    let zero = told["conditions"].as_array().unwrap().iter().find(|it| it["name"] == "zero");
    assert!(zero.unwrap()["detail"].as_str().unwrap().contains("which is fitted"), "{told}");
}

#[test]
fn the_jumps_of_an_acceleration_do_not_count_and_are_told_apart() {
    let record = Simulated { signal: Signal::Acceleration, noise: 5.0, ..RELEASED }.record(3);
    let found = estimate(&record, &Question::default(), &|| false).unwrap();
    let at_jumps = found.count(DropReason::Jump);
    assert!(at_jumps >= found.half_swings, "{at_jumps}");
    let (told, _) = answered("t [s],a [mm/s^2]", &record, 1.0, &[]);
    let places = told["left_out"].as_array().unwrap().iter();
    let listed: u64 = places.map(|place| place["samples"].as_u64().unwrap()).sum();
    assert_eq!(listed, found.dropped.iter().flatten().count() as u64);
}

#[test]
fn what_contradicts_a_header_is_refused_in_one_line() {
    let read = |text: &str, signal: Option<Signal>, peaks: bool| {
        let reading = RecordFormat { signal, peaks, ..RecordFormat::default() };
        parse(text.as_bytes(), &reading).map(|record| (record.signal, record.unit, record.x))
    };
    let refused = |text: &str, signal, peaks| read(text, signal, peaks).unwrap_err().to_string();
    let (velocity, rows) = (Some(Signal::Velocity), "0,1\n1,2\n2,3\n");
    assert_eq!(
        refused(&format!("t [s],x [mm]\n{rows}"), velocity, false),
        "line 1, column 2: \"mm\" is a unit of displacement, not of velocity"
    );
    assert_eq!(
        refused(&format!("t [s],F [N]\n{rows}"), velocity, false),
        "line 1, column 2: \"N\" is a unit of force; expected one of displacement, velocity, acceleration, such as \
         mm, mm/s or m/s^2"
    );
    assert!(refused(&format!("t [s],v [mm/s]\n{rows}"), None, true).contains("peaks are turning"));
    // A name without a unit, a unit after a slash, and of several columns the one that is asked for.
    let told = |text: &str, signal| read(text, signal, false).unwrap();
    let seen = |signal, unit: Option<&str>| (signal, unit.map(String::from), vec![1.0, 2.0, 3.0]);
    assert_eq!(told(&format!("t,Acceleration\n{rows}"), None), seen(Signal::Acceleration, None));
    assert_eq!(told(&format!("t/s,v/mm/s\n{rows}"), None), seen(Signal::Velocity, Some("mm")));
    let three = "t [s],x [mm],v [um/s]\n0,9,1\n1,9,2\n2,9,3\n";
    assert_eq!(told(three, velocity), seen(Signal::Velocity, Some("um")));
    assert_eq!(told(three, None).2, [9.0, 9.0, 9.0]);
    let ran = run(&["fit", &path("coulomb_rest"), "--signal", "velocity"]);
    assert_eq!((ran.code, ran.err.lines().count()), (2, 1), "{}", ran.err);
    let ran = run(&["fit", &path("coulomb_rest"), "--signal", "force"]);
    assert!(
        ran.code == 2 && ran.err.contains("displacement, velocity, acceleration"),
        "{}",
        ran.err
    );
}

#[test]
fn a_drift_too_small_to_be_seen_is_told_for_caution_where_it_would_change_the_answer() {
    // D2 is 7 of its errors off the truth, since a drift that no one can be sure of hides in it.
    let record = simulated("line", 81).record;
    let found = estimate(&record, &Question::default(), &|| false).unwrap();
    let all = conditions(&found, &Margins::default());
    let zero = all.iter().find(|it| it.name == "zero").unwrap();
    assert!(found.drift().is_none() && !found.left_drift.is_seen());
    assert_eq!(zero.verdict(), "caution", "{zero:?} {:?}", found.left_drift);
    let silent = silent_errors(&outcomes(&["line"], 81..=81, 0));
    assert!(silent.is_empty(), "{silent:#?}");
}
