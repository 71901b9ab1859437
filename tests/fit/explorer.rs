//! A recorded motion: opened, fitted, with numbers held, and stopped.

use super::explorer_session::{Trial, reopened};
use hopfscope::fit::{DropReason, Signal};
use hopfscope::model::Knob;
use hopfscope::numerics::elementary::{cos, exp, sin};
use hopfscope::picture::Item;
use hopfscope::scene::{Topic, View};
use hopfscope::session::{Code, Effect, Key, Msg, Purpose, save, update};

/// A decay with D = 0.02 and r = 0.05 at 10/s, without noise except for rounding to three decimals.
fn record() -> String {
    let (decay, mut text) = (exp(-std::f64::consts::PI * 0.02 / 0.9998), String::new());
    let (mut from, mut side, mut t) = (3.0_f64, 1.0, 0.0);
    let root = (1.0_f64 - 0.02 * 0.02).sqrt();
    while from > 0.05 {
        for step in 0..20 {
            let tau = std::f64::consts::PI / root * f64::from(step) / 20.0;
            let swing = exp(-0.02 * tau) * (cos(root * tau) + 0.02 / root * sin(root * tau));
            let x = side * ((from - 0.05) * swing + 0.05);
            text += &format!("{:.5},{x:.3}\n", (t + tau) / 10.0);
        }
        t += std::f64::consts::PI / root;
        (from, side) = ((from - 0.05) * decay - 0.05, -side);
    }
    format!("time [s],displacement [mm]\n{text}")
}

/// The rows of a record, each as time and displacement, after changes.
fn changed(change: impl Fn(usize, f64) -> f64) -> String {
    let text = record();
    let mut lines = text.lines();
    let head = lines.next().unwrap().to_owned();
    let row = |(index, line): (usize, &str)| {
        let (t, x) = line.split_once(',').unwrap();
        format!("{t},{:.3}", change(index, x.parse().unwrap()))
    };
    let rows = lines.enumerate().map(row);
    std::iter::once(head).chain(rows).collect::<Vec<_>>().join("\n")
}

fn opened(text: String, words: &str) -> Trial {
    let mut trial = Trial::open("plain");
    let purpose = Purpose::Fit(words.to_owned());
    trial.give(Msg::Read { path: "decay.csv".into(), purpose, result: Ok(text) });
    trial
}

/// What each plot marks under these names in its legend.
fn marked(trial: &Trial, plot: usize) -> Vec<(String, usize)> {
    let picture = hopfscope::picture::of(&trial.session, plot);
    let marks = picture.items.iter().filter_map(|item| match item {
        Item::Marks(marks) if marks.brief.contains("left out") => {
            Some((marks.brief.to_owned(), marks.at.len()))
        }
        _ => None,
    });
    marks.collect()
}

#[test]
fn what_a_fit_leaves_out_is_marked_by_what_it_is_and_is_no_part_of_the_record_on_show() {
    let mut trial = opened(changed(|index, x| if index % 97 == 60 { x + 1.5 } else { x }), "");
    let outliers = trial.session.fitted().unwrap().estimate.count(DropReason::Outlier);
    assert!(outliers > 2, "{outliers}");
    assert_eq!(marked(&trial, 1), [("outliers, left out".to_owned(), outliers)]);
    let measured = |trial: &Trial| {
        let picture = hopfscope::picture::of(&trial.session, 1);
        let curve = picture.items.iter().find_map(|item| match item {
            Item::Curve(line, points) if line.name == "record" => Some(points.len()),
            _ => None,
        });
        curve.unwrap()
    };
    let all = trial.session.fitted().unwrap().points.len();
    assert_eq!(measured(&trial), all - outliers);
    let legend = hopfscope::picture::legend::entries(&[hopfscope::picture::of(&trial.session, 1)]);
    assert!(legend.iter().any(|entry| entry.text == "outliers, left out"), "{legend:?}");
    trial.press("<run \"view residuals\">");
    let index = trial.session.plots.iter().position(|plot| plot.view == View::Residuals).unwrap();
    assert_eq!(marked(&trial, index), [("outliers, left out".to_owned(), outliers)]);

    let trial = opened(changed(|_, x| x.clamp(-2.0, 2.0)), "");
    let saturated = trial.session.fitted().unwrap().estimate.count(DropReason::Saturated);
    assert!(saturated > 10, "{saturated}");
    assert_eq!(marked(&trial, 1), [("saturated, left out".to_owned(), saturated)]);
    assert_eq!(measured(&trial), all - saturated);
}

#[test]
fn a_wrong_turning_point_does_not_flatten_the_decrements() {
    let extent = |trial: &Trial| trial.session.fitted().unwrap().curves.damping.extent;
    let [right, wrong] = [1.0, 8.0].map(|factor| {
        opened(changed(|index, x| if (217..224).contains(&index) { factor * x } else { x }), "")
    });
    let height = |trial: &Trial| extent(trial)[3] - extent(trial)[2];
    assert!(height(&wrong) < 3.0 * height(&right), "{:?} {:?}", extent(&wrong), extent(&right));
    let beyond = |trial: &Trial| {
        let picture = hopfscope::picture::of(&trial.session, 0);
        let found = hopfscope::picture::legend::entries(&[picture]);
        let entry = found.iter().find(|entry| entry.text.starts_with("measured")).unwrap();
        entry.text.clone()
    };
    assert_eq!(beyond(&right), "measured");
    assert!(beyond(&wrong).ends_with("beyond the plot"), "{}", beyond(&wrong));
}

#[test]
fn the_statement_is_drawn_for_the_disturbance_of_the_session_and_only_where_it_is_told() {
    let mut trial = fitted();
    let best = trial.session.drawn().unwrap().margins.question;
    assert_eq!((best.confidence, best.disturbance), (0.95, 0.0));
    trial.press(":set<space>w=0.005<space>N<enter>");
    let asked = trial.session.drawn().unwrap().margins.question;
    assert!((asked.disturbance - 0.005).abs() < 1e-12, "{asked:?}");
    assert_eq!(asked.half_widths, [0.0; 4]);
    // Neither the second status line nor the distribution is on show.
    trial.press(
        "<run \"set w=0 N\"> <run \"remove-plot\"> <run \"remove-plot\"> <run \"remove-plot\">",
    );
    trial.press("<run \"view phase\">");
    trial.give(Msg::Resize { width: 80, height: 18 });
    let asked = trial.press("<run \"set w=0.01 N\">");
    assert!(!asked.contains(&Topic::Refit), "{asked:?}");
}

fn fitted() -> Trial {
    let mut trial = Trial::open("plain");
    trial.give(Msg::Run("fit decay.csv mass=2 kg".to_owned()));
    let purpose = Purpose::Fit("mass=2 kg".to_owned());
    assert_eq!(
        trial.effects,
        [Effect::Read { path: "decay.csv".into(), purpose: purpose.clone() }]
    );
    trial.give(Msg::Read { path: "decay.csv".into(), purpose, result: Ok(record()) });
    trial
}

#[test]
fn a_record_opens_with_its_pictures_and_a_number_stepped_is_held_while_the_others_follow() {
    let mut trial = fitted();
    let views: Vec<View> = trial.session.plots.iter().map(|plot| plot.view).collect();
    assert_eq!(views, [View::Damping, View::TimeSeries, View::Phase, View::Spread]);
    let look = &trial.session.scene.watch;
    assert!(
        look.contains("seconds; with units off lengths are in mm and times in 1/omega0"),
        "{look}"
    );
    let best = trial.session.problem;
    assert!((best.parameters.d - 0.02).abs() < 1e-3 && (best.parameters.r - 0.05).abs() < 1e-2);
    // c = m omega0^2 = 200 N/m, so 1 mm corresponds to 0.2 N.
    let force = trial.session.units().unwrap().force;
    assert!((force - 0.2).abs() < 1e-3, "{force}");

    let asked = trial.press("<run \"set r=0.06\">");
    assert!(asked.contains(&Topic::Refit), "{asked:?}");
    let held = trial.session.problem.parameters;
    assert!(trial.session.doubt.holds(Knob::R) && held.r == 0.06);
    let margin = hopfscope::picture::of(&trial.session, 3).title;
    assert_eq!(margin, "margin from rest, distribution");
    // Once its draws are there, the distribution is that with r held: more friction, less damping.
    let told = trial.session.fitted().unwrap();
    assert!(told.drawn && told.margins.draws.iter().all(|draw| draw.r == 0.06));
    assert!(held.d < best.parameters.d, "more friction leaves less damping: {held:?}");
    trial.press("u");
    assert_eq!(trial.session.problem, best);
    assert!(!trial.session.doubt.holds(Knob::R));
}

#[test]
fn what_is_free_held_and_how_residuals_count_may_stand_behind_the_file() {
    let mut trial = Trial::open("plain");
    let words = "loss=cauchy free=D r=0.05 mass=2 kg";
    trial.give(Msg::Run(format!("fit decay.csv {words}")));
    let purpose = Purpose::Fit(words.to_owned());
    trial.give(Msg::Read { path: "decay.csv".into(), purpose, result: Ok(record()) });
    let found = trial.session.fitted().unwrap();
    assert!(found.holds(Knob::R) && found.holds(Knob::D2) && !found.holds(Knob::D));
    assert_eq!(trial.session.problem.parameters.r, 0.05);
    let recording = trial.session.scene.recording.as_ref().unwrap();
    assert_eq!(recording.question.loss, hopfscope::fit::LossName::Cauchy);
    // A reopened session asks the same again.
    reopened(&trial.session);
}

#[test]
fn a_number_that_is_free_and_held_at_once_is_refused() {
    let mut trial = Trial::open("plain");
    let words = "free=D,r r=0.05".to_owned();
    trial.give(Msg::Run(format!("fit decay.csv {words}")));
    let purpose = Purpose::Fit(words);
    trial.give(Msg::Read { path: "decay.csv".into(), purpose, result: Ok(record()) });
    assert!(trial.notice().ends_with("r is both --free and --set; it can be one of them"));
    assert!(trial.session.scene.recording.is_none());
}

#[test]
fn a_number_that_was_not_free_can_be_held_at_another_value() {
    let mut trial = opened(record(), "free=D");
    trial.press("<run \"set r=0.06\">");
    let found = trial.session.fitted().unwrap();
    assert!(found.holds(Knob::R) && !found.holds(Knob::D));
    assert_eq!(trial.session.problem.parameters.r, 0.06);
}

#[test]
fn a_saved_session_keeps_what_is_held() {
    let mut trial = fitted();
    trial.press("<run \"set r=0.06\">");
    let session = reopened(&trial.session);
    let other = Trial::of(session);
    assert!(other.session.doubt.holds(Knob::R));
    let (one, two) = (trial.session.problem.parameters, other.session.problem.parameters);
    assert!((one.d - two.d).abs() < 1e-9 && one.r == two.r, "{one:?} {two:?}");
}

#[test]
fn escape_stops_a_fit_and_what_was_there_is_back() {
    let mut trial = Trial::open("supercritical");
    let before = trial.session.problem;
    let purpose = Purpose::Fit(String::new());
    let message = Msg::Read { path: "decay.csv".into(), purpose, result: Ok(record()) };
    update(&mut trial.session, message);
    assert!(trial.session.is_fitting());
    update(&mut trial.session, Msg::Key(Key::plain(Code::Esc)));
    assert_eq!(
        (trial.session.scene.name.as_str(), trial.session.problem),
        ("supercritical", before)
    );
    assert!(!trial.session.is_fitting());
    assert_eq!(trial.notice(), "the fit was stopped");
}

/// The velocities or the accelerations of the decay of [`record`], in mm/s or mm/s^2 without a header that says so.
fn decay_of(signal: Signal) -> String {
    let (mut from, mut side, mut t, mut text) = (3.0_f64, 1.0, 0.0, String::new());
    let root = (1.0_f64 - 0.02 * 0.02).sqrt();
    while from > 0.05 {
        for step in 0..20 {
            let tau = std::f64::consts::PI / root * f64::from(step) / 20.0;
            let swing = -side * (from - 0.05) * exp(-0.02 * tau);
            let (v, a) = (sin(root * tau) / root, cos(root * tau) - 0.02 * sin(root * tau) / root);
            let seen = swing
                * if signal == Signal::Velocity {
                    10.0 * v
                } else {
                    100.0 * a
                };
            text += &format!("{:.5},{seen:.2}\n", (t + tau) / 10.0);
        }
        t += std::f64::consts::PI / root;
        (from, side) = ((from - 0.05) * exp(-0.02 * std::f64::consts::PI / root) - 0.05, -side);
    }
    text
}

#[test]
fn a_record_of_velocities_is_shown_as_velocities_and_kept_as_such() {
    let mut trial = Trial::open("plain");
    let words = "signal=velocity unit=mm/s";
    trial.give(Msg::Run(format!("fit decay.csv {words}")));
    let purpose = Purpose::Fit(words.to_owned());
    trial.give(Msg::Read {
        path: "decay.csv".into(),
        purpose,
        result: Ok(decay_of(Signal::Velocity)),
    });
    let best = trial.session.problem;
    assert!((best.parameters.d - 0.02).abs() < 1e-3 && (best.parameters.r - 0.05).abs() < 1e-2);
    let found = trial.session.fitted().unwrap();
    // The fastest point: 3 mm released, nearly a quarter of a swing later.
    let fastest = found.points.iter().map(|point| point.v.abs()).fold(0.0, f64::max);
    assert!((fastest - 2.86).abs() < 0.02, "{fastest}");
    let drawn = hopfscope::picture::of(&trial.session, 1);
    let names = drawn.items.iter().filter_map(|item| match item {
        Item::Curve(line, _) => Some(line.name.to_string()),
        _ => None,
    });
    let names: Vec<String> = names.collect();
    assert!(
        ["record of v", "velocity v"].iter().all(|name| names.contains(&(*name).to_owned())),
        "{names:?}"
    );
    let text = save::text(&reopened(&trial.session)).unwrap();
    assert!(text.contains("signal = \"velocity\""), "{text}");
}

#[test]
fn the_jumps_of_an_acceleration_are_marked_as_such_among_its_residuals() {
    let trial = &mut opened(decay_of(Signal::Acceleration), "signal=acceleration unit=mm/s^2");
    let jumps = trial.session.fitted().unwrap().estimate.count(DropReason::Jump);
    assert!(jumps > 10, "{jumps}");
    // The accelerations themselves are none of the quantities over time.
    assert_eq!(marked(trial, 1), []);
    trial.press("<run \"view residuals\">");
    let index = trial.session.plots.iter().position(|plot| plot.view == View::Residuals).unwrap();
    assert_eq!(marked(trial, index), [("at jumps, left out".to_owned(), jumps)]);
}

#[test]
fn options_may_be_written_as_refusals_name_them_and_values_may_hold_what_looks_like_one() {
    for words in [
        "columns=t=1,x=3 set=D2=0 mass=2 kg",
        "--columns t=1, x=3 --set D2=0 --mass 2 kg --peaks",
        "columns=t=time of day,x=2 --D3 0 free=D, r",
    ] {
        let mut trial = Trial::open("plain");
        trial.give(Msg::Run(format!("fit my record.csv {words}")));
        let purpose = Purpose::Fit(words.to_owned());
        assert_eq!(trial.effects, [Effect::Read { path: "my record.csv".into(), purpose }]);
    }
}

#[test]
fn what_stands_behind_the_file_is_checked_before_it_is_read() {
    for (line, why) in [
        ("fit a.csv mass=-2 kg", "m = -2 kg is outside its range 1e-12 .. 1e12 kg"),
        ("fit a.csv columns=0,1", "columns are counted from 1"),
        (
            "fit a.csv loss=huber",
            "'huber' for '--loss <LOSS>'; [possible values: auto, linear, soft-l1, cauchy]",
        ),
        ("fit a.csv signal=force", "[possible values: displacement, velocity, acceleration]"),
        ("fit a.csv r=-1", "r = -1 is outside its range 0 .. 1e150"),
        ("fit a.csv free=D,q", "no number \"q\"; there are omega0, offset, D"),
        ("fit a.csv mass=2 m", "m = 2 m has the wrong unit; it takes one such as kg"),
        (
            "fit a.csv mass=2 kg los=cauchy",
            "no option \"los=cauchy\"; there are columns, peaks, free",
        ),
        ("fit a.csv peaks los=x", "no option \"los=x\"; there are columns, peaks, free"),
        ("fit a.csv peaks los", "no option \"los\"; there are columns, peaks, free"),
        ("fit a.csv --mass 2 kg --los x", "signal, unit, omega0, offset, D, D2, D3, r"),
        ("fit a.csv --loss huber", "'huber' for '--loss <LOSS>'; [possible values: auto"),
    ] {
        let mut trial = Trial::open("plain");
        trial.give(Msg::Run(line.to_owned()));
        let notice = trial.notice().to_owned();
        assert!(notice.contains(why), "{notice}");
    }
}
