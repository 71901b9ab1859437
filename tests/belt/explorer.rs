//! A machine in the explorer: played, shown with its units, opened from a file.

use super::explorer_session::{Trial, refuses, reopened};
use super::*;
use hopfscope::flow::Sample;
use hopfscope::model::belt::ReducedBelt;
use hopfscope::model::{Belt, Group, Knob};
use hopfscope::portrait::Portrait;
use hopfscope::portrait::kicks::RandomKick;
use hopfscope::scene::View;
use hopfscope::session::{Effect, Msg, Purpose, Row, run_line, save};

/// Plays keys on a scene, without a terminal; returns the session and the last screen.
fn screen(scene: Scene, keys: &str) -> (Session, String) {
    let size = Size { width: 100, height: 30 };
    let session = Session::new(Arc::new(scene), size);
    let script = parse(keys).unwrap_or_else(|error| panic!("{keys}: {error}"));
    let played = play(
        session,
        Environment::of(|_| None),
        Options { replay: Some(script), ..Options::default() },
        &Limits::PATIENT,
    );
    assert_eq!(played.unmet, None, "{keys}");
    (played.application.session.clone(), hopfscope::view::screen::text(&played.screen))
}

fn figure() -> Scene {
    (*hopfscope::scene::find("fig01").unwrap()).clone()
}

#[test]
fn a_played_motion_moves_with_the_time_it_is_told_and_then_stands_still() {
    let (session, start) = screen(figure(), "");
    assert!(session.head().is_none() && !session.playback.playing);
    assert!(start.contains("x [mm]") && start.contains("t 0 s  x 1 mm  v 0 m/s"), "{start}");
    // The period is 4 s: after 2 s of playing, half a period has passed and the motion is near the left turning point.
    let (session, half) = screen(figure(), "<f8> <elapse 1.5> <elapse 0.5>");
    let head = session.head().unwrap();
    assert!(session.playback.playing && (head.tau - std::f64::consts::PI).abs() < 1e-12);
    assert!(head.q < -0.1 && head.v.abs() < 0.01, "{head:?}");
    assert_ne!(start, half);
    // While paused, time does not count; a step advances by a fortieth of a period.
    let (held, _) = screen(figure(), "<f8> <elapse 2> <f8> <elapse 5> <f9> <f9> <f7>");
    let step = std::f64::consts::TAU / 40.0;
    assert!((held.head().unwrap().tau - std::f64::consts::PI - step).abs() < 1e-12);
    // Captured: the motion rests at its end, and nothing moves any more.
    let (rest, _) = screen(figure(), "<f8> <elapse 600>");
    let motion = rest.trajectory().unwrap();
    let (tau, q) = match motion.outcome {
        Outcome::Captured { tau, q } => (tau, q),
        other => panic!("{other:?}"),
    };
    assert!(!rest.playback.playing);
    assert_eq!((rest.head().unwrap().tau, rest.head().unwrap().q), (tau, q));
    // Played again, it restarts.
    let (again, _) = screen(figure(), "<f8> <elapse 600> <f8> <elapse 1>");
    assert!((again.head().unwrap().tau - 0.25 * std::f64::consts::TAU).abs() < 1e-12);
    // In real time a second is omega_0 = 50.
    let (real, _) = screen(figure(), "<C-t*3> <f8> <elapse 0.01>");
    assert!((real.head().unwrap().tau - 0.5).abs() < 1e-12);
}

#[test]
fn playing_computes_nothing() {
    let (before, _) = screen(figure(), "<f8>");
    let (after, _) = screen(figure(), "<f8> <elapse 0.3> <f9> <elapse 0.2> <C-t>");
    assert!(after.price.recomputed.is_empty());
    assert_eq!(before.wants(), after.wants());
}

#[test]
fn few_cells_change_from_frame_to_frame() {
    let cells = |text: &str| -> Vec<char> {
        text.lines().flat_map(|row| row.chars().chain(std::iter::repeat(' ')).take(100)).collect()
    };
    let mut keys = "<f8> <elapse 1>".to_owned();
    let mut last = cells(&screen(figure(), &keys).1);
    for _ in 0..5 {
        keys += " <elapse 0.016>";
        let next = cells(&screen(figure(), &keys).1);
        let changed = last.iter().zip(&next).filter(|(one, other)| one != other).count();
        assert!(next.len() == last.len() && changed < 220, "{changed} cells of {}", next.len());
        last = next;
    }
}

#[test]
fn a_machine_is_a_scene_with_physical_values_beside_the_numbers() {
    let machine = hopfscope::scene::machine::library::find("textbook").unwrap();
    let scene = ScaledMachine::try_from(machine.clone()).unwrap().scene();
    let (session, text) = screen(scene.clone(), "");
    assert_eq!(session.contact(), None);
    // Its own numbers come first, in their units; those that follow and what sets them stand beneath.
    let mut rows = text.lines().map(str::trim_start);
    for start in
        ["m              2 kg", "c           5000 N/m", "F            100 N", "R   ", "rest  "]
            .into_iter()
            .chain(["belt         0.3 m/s", ">D    -0.097626", "D2  ", "D3  ", "r       0.036553"])
    {
        assert!(rows.any(|row| row.starts_with(start)), "{start} in {text}");
    }
    let (_, unfolded) = screen(scene.clone(), "x");
    assert!(unfolded.contains("d3           600") && !text.contains("d3  "), "{unfolded}");
    let (_, below) = screen(scene.clone(), "x <down*30>");
    assert!(below.contains("until        100  t 2 s"), "{below}");
    for words in ["x 1 mm", "margin from rest: 1.249 mm, 0.1448 N s"] {
        assert!(text.contains(words), "{words} in {text}");
    }
    // The line is where the velocity of the mass equals that of the belt.
    let line = |text: &str| text.matches("belt").count();
    let (_, without) = screen(scene.clone(), "<tab> v e <esc>");
    assert!(line(&without) < line(&text));
    // Less damping: the whole model sticks to the belt.
    let (whole, text) = screen(scene.clone(), "<left*30> o");
    assert!(whole.contact().is_none() && text.contains("tends to stick-slip"), "{text}");
    assert!(text.contains("whole model") && text.contains("cubic expansion: "), "{text}");
    // The expansion overtakes the belt; a motion that does so is stopped there.
    let (wild, text) = screen(scene, "| <left*30> o");
    let (tau, _) = wild.contact().expect("a motion that reaches the belt");
    assert!(
        text.contains("sticks to the belt at t = ") && text.contains("! stable cycle > belt"),
        "{text}"
    );
    let (end, _) = screen((*wild.scene).clone(), "| <left*30> o <f8> <elapse 3600>");
    assert!(!end.playback.playing && (end.head().unwrap().tau / tau - 1.0).abs() < 1e-12);
}

#[test]
fn a_machine_of_a_file_opens_in_the_explorer_only_if_it_is_one() {
    run(&["--belt", "nowhere.toml"]).is_refused(&["the machines of the program are textbook"]);
}

/// The textbook machine at a speed of its belt, reduced without a session.
fn at(speed: f64) -> ReducedBelt {
    let mut machine = hopfscope::scene::machine::library::find("textbook").unwrap().clone();
    machine.belt.belt_speed = speed;
    machine.belt.reduce().unwrap()
}

/// Checks that the session shows the machine at this speed, with all its numbers.
fn runs_at(trial: &Trial, speed: f64) {
    let session = &trial.session;
    assert_eq!(session.setting.as_ref().and_then(|it| it.get(Knob::BeltSpeed)), Some(speed));
    assert_eq!(session.problem.parameters, at(speed).parameters);
    assert_eq!(session.is_on_the_belt(), Some(true));
    let running = session.running().unwrap();
    assert_eq!((running.machine.belt.belt_speed, running.reduced), (speed, at(speed)));
    let x = session.problem.initial.q * running.reduced.units.displacement;
    assert!((x / 1e-3 - 1.0).abs() < 1e-15, "the start is 1 mm, whatever the unit of length");
}

#[test]
fn a_step_of_the_belt_moves_all_four_parameters_and_keeps_the_start_in_metres() {
    let mut trial = Trial::open("fig01");
    runs_at(&trial, 0.3);
    trial.press("<up>");
    assert_eq!(trial.session.selected, Row::BELT);
    trial.press("<right>");
    runs_at(&trial, 0.31);
    trial.press("*5<left>");
    runs_at(&trial, 0.26);
    trial.press("u");
    runs_at(&trial, 0.31);
    assert_eq!(trial.notice(), "undo: belt = 0.31 m/s");
    trial.press("u");
    runs_at(&trial, 0.3);
    let own = trial.session.scene.problem;
    assert_eq!(trial.session.problem, own, "to the last bit");
    trial.press("U U");
    runs_at(&trial, 0.26);
    trial.press("<backspace>");
    runs_at(&trial, 0.3);
    assert_eq!(trial.session.problem, own);
}

#[test]
fn a_number_changed_by_hand_leaves_the_belt_and_a_step_of_the_belt_comes_back() {
    let mut trial = Trial::open("fig01");
    trial.press("<right>");
    assert_eq!(trial.session.is_on_the_belt(), Some(false));
    assert_eq!(
        trial.session.setting.as_ref().and_then(|it| it.get(Knob::BeltSpeed)),
        Some(0.3),
        "the units stay those of this speed"
    );
    assert!(trial.notice().starts_with("off the belt: "), "{}", trial.notice());
    trial.press("<up> <right>");
    runs_at(&trial, 0.31);
    trial.press("u");
    assert_eq!(trial.session.is_on_the_belt(), Some(false));
    // Coming back to the same speed is a change, too.
    trial.press(":set<space>belt=0.3<enter>");
    runs_at(&trial, 0.3);
    // The start and the end time do not depend on the belt.
    trial.press(":set<space>q0=0.5<space>until=9<enter>");
    assert_eq!(trial.session.is_on_the_belt(), Some(true));
}

#[test]
fn speeds_are_typed_with_units_or_in_metres_per_second() {
    for keys in [
        "<up><enter><C-u>0.2<enter>",
        "<up><enter><C-u>20<space>cm/s<enter>",
        "<up>0.2m/s<enter>",
        ":set<space>belt=0.2<enter>",
        ":set<space>D=-0.5<space>belt=200<space>mm/s<enter>",
    ] {
        let mut trial = Trial::open("fig01");
        trial.press(keys);
        runs_at(&trial, 0.2);
        assert_eq!(trial.session.history.depth(), (1, 0), "{keys}: one change");
    }
    let mut trial = Trial::open("fig01");
    trial.press(":set<space>belt=0.2<space>D=-0.5<enter>");
    assert_eq!(trial.session.problem.parameters.d, -0.5);
    assert_eq!(trial.session.is_on_the_belt(), Some(false));
}

#[test]
fn speeds_that_are_none_are_refused_in_one_line() {
    let refused = [
        ("set belt=0", "v0 = 0 m/s is outside its range"),
        ("set belt=-0.3", "v0 = -0.3 m/s is outside its range"),
        ("set belt=nan", "\"nan\" is not a number"),
        ("set belt=1e999", "\"1e999\" is not a finite number"),
        ("set belt=3 N", "has the wrong unit; it takes one such as m/s"),
        ("set belt=fast", "\"fast\" is not a number"),
    ];
    refuses("fig01", &refused);
    refuses("plain", &[("set belt=0.3", "set: no number \"belt\"; there are D, D2")]);
    assert!(!Trial::open("plain").session.rows().contains(&Row::BELT));
    // Steps down stop above zero, with the reason.
    let mut trial = Trial::open("fig01");
    trial.press("<up> *40<left>");
    assert!(trial.notice().starts_with("v0 = 0 m/s is outside its range"), "{}", trial.notice());
    runs_at(&trial, 0.01);
}

#[test]
fn a_machine_of_the_program_opens_by_its_name_which_can_be_completed() {
    let mut trial = Trial::open("plain");
    trial.press(":belt<space>cl<tab><enter>");
    assert_eq!(trial.session.running().unwrap().machine.name, "clutch");
    assert!(trial.session.draws_whole());
    let known = "there are textbook, clutch, slideway, straight, bstab, groan";
    let refused = format!("belt: no machine \"tractor\"; {known}");
    assert_eq!(run_line(&mut trial.session, "belt tractor"), Err(refused));
    trial.press("u");
    assert_eq!(trial.session.scene.name, "plain");
}

#[test]
fn a_machine_opens_from_its_file_and_the_table_beside_it() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/assets/belts/");
    let text = |name: &str| std::fs::read_to_string(format!("{folder}{name}")).unwrap();
    let mut trial = Trial::open("plain");
    let read = |trial: &mut Trial, path: &str, text: Result<String, String>| {
        trial.press(&format!(":machine<space>{path}<enter>"));
        let asked = Effect::Read { path: path.into(), purpose: Purpose::Machine };
        assert_eq!(trial.effects.last(), Some(&asked));
        trial.give(Msg::Read { path: path.into(), purpose: Purpose::Machine, result: text });
    };
    read(&mut trial, "a/clutch.toml", Ok(text("clutch.toml")));
    assert_eq!(trial.session.running().unwrap().machine.name, "clutch");
    // The table beside the file is asked for.
    for (table, opens) in
        [(Err("no such file".to_owned()), false), (Ok(text("slideway.csv")), true)]
    {
        read(&mut trial, "a/slideway.toml", Ok(text("slideway.toml")));
        let Some(Effect::Read { path, purpose }) = trial.effects.last().cloned() else { panic!() };
        assert_eq!(path.to_str(), Some("a/slideway.csv"));
        trial.give(Msg::Read { path, purpose, result: table });
        let name = &trial.session.running().unwrap().machine.name;
        assert_eq!(name == "slideway", opens, "{name}");
        assert_eq!(trial.notice().starts_with("a/slideway.toml:"), !opens, "{}", trial.notice());
    }
    // The mistake is described in one line, and nothing changes.
    let mode = "frequency = 120\nmodal_mass = 0.2\ndamping_ratio = [-0.05]\nR = 3\n";
    for (text, words) in [
        (Err("b.toml: no such file".to_owned()), "b.toml: no such file"),
        (Ok("m = 1".to_owned()), "b.toml:1:1: friction is missing"),
        (Ok(text("clutch.toml").replace("v0", "v9")), "b.toml:"),
        (Ok("modal_mass = 1".to_owned()), "b.toml:1:1: damping_ratio is missing"),
        (Ok(mode.to_owned()), "b.toml: a vibration mode has no belt"),
    ] {
        read(&mut trial, "b.toml", text);
        assert!(trial.notice().starts_with(words), "{}", trial.notice());
        assert!(!trial.notice().contains('\n'));
        assert_eq!(trial.session.running().unwrap().machine.name, "slideway");
    }
    // What is unlikely is read, and told, also where it is typed.
    read(&mut trial, "b.toml", Ok(text("textbook.toml").replace("5 N/mm", "5")));
    assert!(trial.notice().starts_with("x0 = 5.5 m"), "{}", trial.notice());
    trial.press(":set<space>c=5000<enter>");
    assert!(!trial.notice().contains("x0"), "{}", trial.notice());
    trial.press(":set<space>c=5<enter>");
    assert!(trial.notice().starts_with("x0 = 5.5 m"), "{}", trial.notice());
}

#[test]
fn numbers_of_the_friction_law_are_set_like_those_of_the_machine() {
    let mut trial = Trial::open("fig01");
    let before = trial.session.setup();
    trial.press("x:set<space>rest=0.45<space>velocity=0.2m/s<enter>");
    let mut machine = hopfscope::scene::machine::library::find("textbook").unwrap().clone();
    for (knob, value) in [(Knob::Rest, 0.45), (Knob::Velocity, 0.2)] {
        knob.set_in_belt(&mut machine.belt, value).unwrap();
    }
    let session = &trial.session;
    assert_eq!(session.problem.parameters, machine.belt.reduce().unwrap().parameters);
    assert_eq!(session.machine().unwrap(), machine.belt);
    assert_eq!(session.value(Knob::StaticCoefficient), 0.45, "at rest it is that of the law");
    let rows = session.rows().into_iter().filter_map(Row::stepped);
    let law = rows.filter(|knob| knob.spec().group == Group::Law).map(|knob| knob.spec().name);
    let law: Vec<&str> = law.collect();
    let stribeck = ["mu_s", "R_static", "rest", "kinetic", "velocity", "exponent", "viscous"];
    assert_eq!(law, stribeck);
    assert_eq!(reopened(session).machine(), session.machine());
    trial.session.selected = Row::Number(Knob::Viscous);
    trial.press("<right>");
    assert_eq!(trial.session.value(Knob::Viscous), 0.05);
    trial.press("uu");
    assert_eq!(trial.notice(), "undo: rest = as in its file, velocity = as in its file");
    assert_eq!(trial.session.setup(), before);
    refuses(
        "fig01",
        &[
            ("set mu_s=0.1", "mu_s = 0.1 is below the coefficient 0.4 of the law at rest"),
            ("set R_static=0.5 N", "R_static = 0.5 N is below R = 1 N"),
            ("set mu=0.3", "no number \"mu\""),
        ],
    );
}

#[test]
fn numbers_of_a_machine_are_typed_with_units_stepped_undone_and_saved() {
    let mut trial = Trial::open("fig01");
    let before = trial.session.setup();
    trial.press(":set<space>R=2<space>N<space>m=1.5kg<enter>");
    let mut machine = hopfscope::scene::machine::library::find("textbook").unwrap().clone();
    (machine.belt.friction, machine.belt.mass) = (2.0, 1.5);
    let expected = machine.belt.reduce().unwrap();
    let session = &trial.session;
    assert_eq!(session.problem.parameters, expected.parameters);
    assert_eq!(session.is_on_the_belt(), Some(true));
    assert_eq!(session.running().unwrap().reduced, expected);
    assert_eq!(session.machine().unwrap(), machine.belt, "what the whole model answers for");
    let x = session.problem.initial.q * expected.units.displacement;
    assert!((x / 1e-3 - 1.0).abs() < 1e-15, "the start is 1 mm, whatever the unit of length");
    assert!(session.rows().contains(&Row::Number(Knob::Mass)));
    assert_eq!(reopened(session).machine(), session.machine());
    // A step of the row, and undo.
    trial.session.selected = Row::Number(Knob::Friction);
    trial.press("<right>");
    assert!(trial.session.machine().unwrap().friction > 2.0);
    trial.press("u");
    assert_eq!(trial.session.machine().unwrap().friction, 2.0);
    trial.press("u");
    assert_eq!(trial.notice(), "undo: m = as in its file, R = as in its file");
    assert_eq!(trial.session.setup(), before);
    trial.press("U");
    trial.session.selected = Row::Number(Knob::Friction);
    trial.press("<backspace>");
    assert_eq!(trial.session.machine().unwrap().friction, 1.0, "reset to its file's");
}

#[test]
fn tolerance_and_disturbance_of_a_machine_are_typed_in_newtons() {
    let mut trial = Trial::open("fig01");
    trial.press(":set<space>R=1<space>N<space>+-<space>0.2<space>N<space>w=0.1<space>N<enter>");
    let session = &trial.session;
    let force = session.running().unwrap().reduced.units.force;
    assert!((session.doubt.disturbance * force / 0.1 - 1.0).abs() < 1e-12);
    let known = session.doubt.on_machine(session.running().unwrap(), &session.machine().unwrap());
    assert!((known.unwrap().half_widths["R"] / 0.2 - 1.0).abs() < 1e-12);
    // A number typed without a tolerance is exact, as everywhere.
    trial.press(":set<space>R=2<space>N<enter>");
    assert_eq!(trial.session.doubt.half_width(Knob::R), 0.0);
    refuses(
        "fig01",
        &[
            ("set m=2 N", "one such as kg"),
            ("set m=0", "m = 0 kg is outside its range"),
            ("set F=10 N +- 1 N", "F has no uncertainty here"),
            ("set w=1 mm", "one such as N"),
            ("set R=-1", "R = -1 N is outside its range"),
        ],
    );
}

#[test]
fn a_session_of_an_earlier_version_opens_with_its_whole_history() {
    let mut trial = Trial::open("plain");
    save::open(&mut trial.session, include_str!("../data/earlier-session.toml")).unwrap();
    let (d2, speed) = (
        trial.session.value(Knob::D2),
        trial.session.setting.clone().unwrap().get(Knob::BeltSpeed).unwrap(),
    );
    assert_eq!((d2, speed), (0.050_526_149_830_783_7, 1.2));
    trial.press("uuuuuu");
    let start = Trial::open("benchmark").session;
    assert_eq!(trial.session.problem, start.problem);
}

#[test]
fn a_machine_s_diagram_is_over_any_of_its_numbers() {
    let scene = (*hopfscope::scene::find("slow-belt").unwrap()).clone();
    let (session, text) = screen(scene.clone(), ":axes<space>F<enter>");
    assert!(text.contains("x_max [mm] over F [N]"), "{text}");
    let found = session.machine_branch(session.plot).unwrap();
    let belt = &scene.machine.as_ref().unwrap().machine.belt;
    assert!(found.points.len() > 30 && found.points.iter().any(|point| point.value == 300.0));
    for point in &found.points {
        let alone = Belt { normal_force: point.value, ..belt.clone() };
        let cycles = Portrait::of_belt(&alone).unwrap().cycles;
        assert_eq!(point.found.as_ref().unwrap().cycles, cycles, "F = {} N", point.value);
    }
    // Stepping its own number asks nothing again, and the number under the cursor can be taken.
    let (taken, _) = screen(scene.clone(), ":axes<space>F<enter> <right> <enter>");
    assert_eq!(taken.machine().unwrap().normal_force, 105.0);
    assert_eq!(taken.machine_branch(taken.plot), session.machine_branch(session.plot));
    // The key visits every number of the machine, and comes back to the speed of its belt in the scene's window.
    let count = session.abscissae(View::BeltDiagram).len();
    let (back, _) = screen(scene.clone(), &format!(":axes<space>v0<enter> <X*{count}>"));
    let opened = Session::new(Arc::new(scene.clone()), back.size);
    assert_eq!(back.plots[back.plot].axes, opened.plots[back.plot].axes);
    assert_eq!(back.plots[back.plot].window.x, opened.plots[back.plot].window.x);
    let (_, refused) = screen(scene, ":axes<space>F<space>period<enter>");
    assert!(refused.contains("a machine's diagram shows x_max"), "{refused}");
}

#[test]
fn a_machine_is_scanned_over_its_own_numbers_by_the_whole_model() {
    let scene = (*hopfscope::scene::find("slow-belt").unwrap()).clone();
    let line = ":scan<space>v0=0.1:0.3:3<space>F=50:100:2<space>from-rest<enter>";
    let (session, text) = screen(scene.clone(), line);
    assert!(text.contains("F [N] over v0 [m/s]"), "{text}");
    let scanned = session.scanned.as_ref().unwrap();
    let belt = &scene.machine.as_ref().unwrap().machine.belt;
    let places = [0.1, 0.2, 0.3].into_iter().flat_map(|speed| [(speed, 50.0), (speed, 100.0)]);
    for (row, (belt_speed, normal_force)) in scanned.rows.iter().zip(places) {
        let alone = Belt { belt_speed, normal_force, ..belt.clone() };
        let from_rest = Portrait::of_belt(&alone).unwrap().margin.from_rest;
        let told = row.values[..2].iter().map(|value| value.number()).collect::<Vec<_>>();
        assert_eq!(told, [from_rest.displacement, from_rest.impulse], "{belt_speed} m/s");
    }
    // A point is taken, and the cubic expansion is scanned over the parameters of the oscillator.
    let (taken, _) = screen(scene.clone(), &format!("{line} <right> <up> <enter>"));
    let machine = taken.machine().unwrap();
    assert_eq!((machine.belt_speed, machine.normal_force), (0.2, 100.0));
    // What was changed by hand stays, and kicks are those that were typed.
    let by_hand = screen(scene.clone(), ":set<space>r=0.06<enter>").0.machine().unwrap();
    let keys = ":set<space>r=0.06<enter> :scan<space>F=50:100:2<enter> <right> <enter>";
    let taken = screen(scene.clone(), keys).0.machine().unwrap();
    let ratio = taken.friction / by_hand.friction;
    assert!(taken.normal_force == 100.0 && (ratio - 1.0).abs() < 1e-12, "{ratio}");
    let keys =
        ":kicks<space>q=0+-0.3<space>mm,v=0<enter> :scan<space>v0=0.2:0.3:2<space>lost<enter>";
    let (session, _) = screen(scene.clone(), keys);
    let kicks = RandomKick::read("q=0+-3e-4,v=0", ["m", "m/s"]).unwrap();
    let lost = kicks.lost(&Portrait::of_belt(belt).unwrap()).unwrap().part;
    let told = session.scanned.unwrap().rows[0].values[0].number().unwrap();
    assert!(lost > 1e-3 && (told / lost - 1.0).abs() < 1e-6, "{told} {lost}");
    let (_, refused) = screen(scene.clone(), ":scan<space>D=-0.3:0:3<enter>");
    assert!(refused.contains("no number \"D\""), "{refused}");
    let (expansion, _) = screen(scene, "| :scan<space>D=-0.3:-0.1:3<enter>");
    assert_eq!(expansion.scanned.unwrap().rows.len(), 3);
}

/// A moment between two samples of a motion, on one side of v = 0.
fn between(from: &Sample, to: &Sample) -> Option<Sample> {
    let middle = f64::midpoint(from.tau, to.tau);
    (from.v * to.v > 0.0).then(|| from.between(to, middle))
}

#[test]
fn all_forces_together_accelerate_the_mass() {
    for (scene, keys) in [("plain", ""), ("escape", ""), ("slow-belt", "o"), ("fig01", "")] {
        let scene = Scene::clone(&hopfscope::scene::find(scene).unwrap());
        let (session, _) = screen(scene, keys);
        let motion = session.trajectory().unwrap();
        let mut checked = 0;
        for pair in motion.samples.windows(2) {
            let moment = between(&pair[0], &pair[1]);
            // An escape accelerates within a step of the samples.
            let steady = moment.filter(|it| !session.sticks(it) && it.v.abs() < 3.0);
            let Some(moment) = steady else { continue };
            let forces = session.forces(&moment).unwrap();
            let sum = forces.spring + forces.damping.unwrap() + forces.friction;
            let acceleration = (pair[1].v - pair[0].v) / (pair[1].tau - pair[0].tau);
            let size = 1.0 + moment.q.abs() + moment.v.abs();
            assert!((sum - acceleration).abs() < 0.02 * size, "{moment:?} {forces:?}");
            checked += 1;
        }
        assert!(checked > 10, "{checked}");
    }
}

#[test]
fn friction_holds_what_the_spring_pulls_up_to_its_limit_and_no_more() {
    let (session, _) = screen(Scene::clone(&hopfscope::scene::find("plain").unwrap()), "");
    let at = |q| session.forces(&Sample { tau: 0.0, q, v: 0.0 }).unwrap();
    let r = session.problem.parameters.r;
    let held = at(0.5 * r);
    assert_eq!((held.spring + held.friction, held.damping, held.limit), (0.0, Some(0.0), r));
    assert_eq!((at(-3.0 * r).friction, at(3.0 * r).friction), (-r, r));
}

#[test]
fn a_mass_that_rides_on_its_belt_is_in_balance() {
    let (session, _) = screen(Scene::clone(&hopfscope::scene::find("slow-belt").unwrap()), "o");
    let [from, to] = session.trajectory().unwrap().rides().last().unwrap();
    let moment = Sample { tau: f64::midpoint(from.tau, to.tau), ..from };
    let forces = session.forces(&moment).unwrap();
    assert!((forces.spring + forces.damping.unwrap() + forces.friction).abs() < 1e-14);
    assert!(session.sticks(&moment));
}
