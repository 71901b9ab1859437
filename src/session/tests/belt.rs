//! The speed of the belt as one of the numbers: it moves D, D2, D3 and r along the machine's path.

use super::Trial;
use super::facts::refuses;
use super::saved::reopened;
use crate::model::belt::ReducedBelt;
use crate::model::{Group, Knob};
use crate::scene::{Layer, ScaledMachine};
use crate::session::{Effect, Msg, Purpose, Row, save};

/// The textbook machine at a speed of its belt, reduced without a session.
fn at(speed: f64) -> ReducedBelt {
    let mut machine = crate::scene::machine::library::find("textbook").unwrap().clone();
    machine.belt.belt_speed = speed;
    machine.reduce().unwrap()
}

/// Checks that the session shows the machine at this speed, with all its numbers.
fn runs_at(trial: &Trial, speed: f64) {
    let session = &trial.session;
    assert_eq!(session.setting.map(|it| it.speed), Some(speed));
    assert_eq!(session.problem.parameters, at(speed).parameters);
    assert_eq!(session.is_on_the_belt(), Some(true));
    let running = session.running().unwrap();
    assert_eq!((running.speed, running.reduced), (speed, at(speed)));
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
        trial.session.setting.map(|it| it.speed),
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
    for (typed, words) in [
        ("0", "..v0 = 0 m/s is outside its range"),
        ("-0.3", "..v0 = -0.3 m/s is outside its range"),
        ("nan", "..\"nan\" is not a number"),
        ("1e999", "..\"1e999\" is not a finite number"),
        ("3 N", "..has the wrong unit; it takes one such as m/s"),
        ("fast", "..\"fast\" is not a number"),
    ] {
        refuses("fig01", &[(&format!("<up><enter><C-u><paste {typed:?}><enter>"), words)]);
    }
    refuses("plain", &[(": set belt=0.3", "set: no number \"belt\"; there are D, D2")]);
    assert!(!Trial::open("plain").session.rows().contains(&Row::BELT));
    // Steps down stop above zero, with the reason.
    let mut trial = Trial::open("fig01");
    trial.goes(&[("<up> *40<left>", "notice v0 = 0 m/s is outside its range..")]);
    runs_at(&trial, 0.01);
}

#[test]
fn marks_scenes_and_saved_sessions_know_the_speed() {
    let mut trial = Trial::open("fig01");
    trial.press("<up> <right*2> \"a <right*3>");
    runs_at(&trial, 0.35);
    let mut other = reopened(&trial.session);
    let text = save::text(&other).unwrap();
    trial.press("'a");
    runs_at(&trial, 0.32);
    trial.press("''");
    runs_at(&trial, 0.35);
    // A scene without a machine has no belt; back in one with a machine there is a belt again.
    trial.press(":scene<space>plain<enter>");
    assert_eq!((trial.session.setting, trial.session.running()), (None, None));
    trial.press("'a");
    assert_eq!(trial.session.setting, None, "the numbers come along, not the belt");
    assert_eq!(trial.session.problem.parameters, at(0.32).parameters);
    trial.press("u u");
    runs_at(&trial, 0.35);
    // Sessions saved before this number existed show the machine at its own speed.
    let older = text.replacen("belt = 0.35\n", "", 1);
    save::open(&mut other, &older).unwrap();
    assert_eq!(other.setting.map(|it| it.speed), Some(0.3));
    for wrong in ["-1.0", "0.0", "nan"] {
        let broken = text.replacen("belt = 0.35", &format!("belt = {wrong}"), 1);
        let why = save::open(&mut other, &broken).unwrap_err();
        assert!(why.contains("is outside its range") && !why.contains('\n'), "{why}");
    }
    // The refused files changed nothing.
    trial.give(Msg::Idle);
    runs_at(&trial, 0.35);
    assert_eq!(
        ScaledMachine::new(trial.session.running().unwrap().machine.clone()).unwrap().reduced,
        at(0.3)
    );
}

#[test]
fn the_path_over_the_speed_asks_nothing() {
    let mut trial = Trial::open("belt-speed");
    let with = trial.session.wants();
    assert_eq!(trial.press(":layer<space>belt-path<space>off<enter>"), []);
    assert_eq!(trial.session.wants(), with);
    assert_eq!(trial.press("<tab> <run \"layer belt-path\">"), [], "its name shows it again");
    assert!(trial.session.layers.contains(&Layer::BeltPath));
    // A chart of the same machine over other parameters has the path, too; one without a machine says why not.
    assert_eq!(trial.session.not_drawn(Layer::BeltPath), None);
    let plain = Trial::open("regimes").session;
    assert!(plain.not_drawn(Layer::BeltPath).is_some_and(|why| why.contains("no machine")));
}

#[test]
fn a_machine_of_the_program_opens_by_its_name_which_can_be_completed() {
    let mut trial = Trial::open("plain");
    trial.press(":belt<space>cl<tab><enter>");
    assert_eq!(trial.session.running().unwrap().machine.name, "clutch");
    assert!(trial.session.draws_whole());
    let known = "there are textbook, clutch, slideway, straight, bstab, groan";
    let refused = format!("refused belt: no machine \"tractor\"; {known}");
    trial.goes(&[(": belt tractor", &refused), ("<esc> u", "scene plain")]);
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
    for (text, words) in [
        (Err("b.toml: no such file".to_owned()), "b.toml: no such file"),
        (Ok("m = 1".to_owned()), "b.toml:1:1: friction is missing"),
        (Ok(text("clutch.toml").replace("v0", "v9")), "b.toml:"),
        (Ok("modal_mass = 1".to_owned()), "b.toml: a vibration mode has no belt"),
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
    let mut machine = crate::scene::machine::library::find("textbook").unwrap().clone();
    for (knob, value) in [(Knob::Rest, 0.45), (Knob::Velocity, 0.2)] {
        knob.set_in_belt(&mut machine.belt, value).unwrap();
    }
    let session = &trial.session;
    assert_eq!(session.problem.parameters, machine.reduce().unwrap().parameters);
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
            (": set mu_s=0.1", "..mu_s = 0.1 is below the coefficient 0.4 of the law at rest"),
            (": set R_static=0.5 N", "..R_static = 0.5 N is below R = 1 N"),
            (": set mu=0.3", "..no number \"mu\""),
        ],
    );
}

#[test]
fn numbers_of_a_machine_are_typed_with_units_stepped_undone_and_saved() {
    let mut trial = Trial::open("fig01");
    let before = trial.session.setup();
    trial.press(":set<space>R=2<space>N<space>m=1.5kg<enter>");
    let mut machine = crate::scene::machine::library::find("textbook").unwrap().clone();
    (machine.belt.friction, machine.belt.mass) = (2.0, 1.5);
    let expected = machine.reduce().unwrap();
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
    assert_eq!(trial.notice(), "undo: R = as in its file, m = as in its file");
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
    let known = session.doubt.on_machine(&session.running().unwrap(), &session.machine().unwrap());
    assert!((known.unwrap().half_widths["R"] / 0.2 - 1.0).abs() < 1e-12);
    // A number typed without a tolerance is exact, as everywhere.
    trial.press(":set<space>R=2<space>N<enter>");
    assert_eq!(trial.session.doubt.half_width(Knob::R), 0.0);
    refuses(
        "fig01",
        &[
            (": set m=2 N", "..one such as kg"),
            (": set m=0", "..m = 0 kg is outside its range"),
            (": set F=10 N +- 1 N", "..F has no tolerance here"),
            (": set w=1 mm", "..one such as N"),
            (": set R=-1", "..R = -1 N is outside its range"),
        ],
    );
}
