//! The speed of the belt as a number among the others: it moves D, D2, D3 and r along the machine's path.

use super::Desk;
use crate::oscillator::belt::Reduced;
use crate::scene::{Layer, Rig};
use crate::session::{Effect, Msg, Overlay, Purpose, Row, save};

/// The textbook machine at a speed of its belt, reduced without the session.
fn at(speed: f64) -> Reduced {
    let mut machine = crate::scene::machine::library::find("textbook").unwrap().clone();
    machine.belt.belt_speed = speed;
    machine.reduce().unwrap()
}

/// The session shows the machine at this speed, all of it.
fn runs_at(desk: &Desk, speed: f64) {
    let session = &desk.session;
    assert_eq!(session.belt_speed, Some(speed));
    assert_eq!(session.problem.parameters, at(speed).parameters);
    assert_eq!(session.is_on_the_belt(), Some(true));
    let running = session.running().unwrap();
    assert_eq!((running.speed, running.reduced), (speed, at(speed)));
    let x = session.problem.initial.q * running.reduced.units.displacement;
    assert!((x / 1e-3 - 1.0).abs() < 1e-15, "the start is 1 mm, whatever the unit of length");
}

#[test]
fn a_step_of_the_belt_moves_all_four_parameters_and_keeps_the_start_in_metres() {
    let mut desk = Desk::open("fig01");
    runs_at(&desk, 0.3);
    desk.press("<up>");
    assert_eq!(desk.session.selected, Row::Belt);
    desk.press("<right>");
    runs_at(&desk, 0.31);
    desk.press("*5<left>");
    runs_at(&desk, 0.26);
    desk.press("u");
    runs_at(&desk, 0.31);
    assert_eq!(desk.notice(), "undo: belt = 0.31 m/s");
    desk.press("u");
    runs_at(&desk, 0.3);
    let own = desk.session.scene.problem;
    assert_eq!(desk.session.problem, own, "to the last bit");
    desk.press("U U");
    runs_at(&desk, 0.26);
    desk.press("<backspace>");
    runs_at(&desk, 0.3);
    assert_eq!(desk.session.problem, own);
}

#[test]
fn a_number_changed_by_hand_leaves_the_belt_and_a_step_of_the_belt_comes_back() {
    let mut desk = Desk::open("fig01");
    desk.press("<right>");
    assert_eq!(desk.session.is_on_the_belt(), Some(false));
    assert_eq!(desk.session.belt_speed, Some(0.3), "the units stay those of this speed");
    assert!(desk.notice().starts_with("off the belt: "), "{}", desk.notice());
    desk.press("<up> <right>");
    runs_at(&desk, 0.31);
    desk.press("u");
    assert_eq!(desk.session.is_on_the_belt(), Some(false));
    // To come back to the same speed is a change too.
    desk.press(":set<space>belt=0.3<enter>");
    runs_at(&desk, 0.3);
    // The start and the end time are not of the belt.
    desk.press(":set<space>q0=0.5<space>until=9<enter>");
    assert_eq!(desk.session.is_on_the_belt(), Some(true));
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
        let mut desk = Desk::open("fig01");
        desk.press(keys);
        runs_at(&desk, 0.2);
        assert_eq!(desk.session.history.depth(), (1, 0), "{keys}: one change");
    }
    let mut desk = Desk::open("fig01");
    desk.press(":set<space>belt=0.2<space>D=-0.5<enter>");
    assert_eq!(desk.session.problem.parameters.d, -0.5);
    assert_eq!(desk.session.is_on_the_belt(), Some(false));
}

#[test]
fn speeds_that_are_none_are_refused_in_one_line() {
    for (typed, words) in [
        ("0", "v0 = 0 m/s is outside its range"),
        ("-0.3", "v0 = -0.3 m/s is outside its range"),
        ("nan", "\"nan\" does not begin with a number"),
        ("1e999", "\"1e999\" is not a finite number"),
        ("3 N", "has another dimension; it takes a unit such as m/s"),
        ("fast", "\"fast\" does not begin with a number"),
    ] {
        let mut desk = Desk::open("fig01");
        desk.press(&format!("<up><enter><C-u><paste {typed:?}><enter>"));
        let Some(Overlay::Entry(entry)) = &desk.session.overlay else { panic!("{typed}: taken") };
        let refused = entry.refused.clone().unwrap_or_default();
        assert!(refused.contains(words) && !refused.contains('\n'), "{typed}: {refused}");
        desk.press("<esc>");
        runs_at(&desk, 0.3);
    }
    // Steps down end above zero, with the reason.
    let mut desk = Desk::open("fig01");
    desk.press("<up> *40<left>");
    runs_at(&desk, 0.01);
    assert!(desk.notice().starts_with("v0 = 0 m/s is outside its range"), "{}", desk.notice());
    let mut desk = Desk::open("plain");
    desk.press(":set<space>belt=0.3<enter>");
    let Some(Overlay::Prompt(prompt)) = &desk.session.overlay else { panic!("it is taken") };
    let refused = prompt.refused.clone().unwrap_or_default();
    assert!(refused.starts_with("set: no value \"belt\"; there are D, D2"), "{refused}");
    assert!(!desk.session.rows().contains(&Row::Belt));
}

#[test]
fn marks_scenes_and_saved_sessions_know_the_speed() {
    let mut desk = Desk::open("fig01");
    desk.press("<up> <right*2> \"a <right*3>");
    runs_at(&desk, 0.35);
    let text = save::text(&desk.session).unwrap();
    let mut other = Desk::open("plain").session;
    save::open(&mut other, &text).unwrap();
    assert_eq!(other.stand(), desk.session.stand());
    assert_eq!(other.history, desk.session.history);
    desk.press("'a");
    runs_at(&desk, 0.32);
    desk.press("''");
    runs_at(&desk, 0.35);
    // A scene without a machine has no belt, and coming back there is one again.
    desk.press(":scene<space>plain<enter>");
    assert_eq!((desk.session.belt_speed, desk.session.running()), (None, None));
    desk.press("'a");
    assert_eq!(desk.session.belt_speed, None, "the numbers come along, not the belt");
    assert_eq!(desk.session.problem.parameters, at(0.32).parameters);
    desk.press("u u");
    runs_at(&desk, 0.35);
    // Sessions saved before there was such a number show the machine at its own speed.
    let older = text.replacen("belt = 0.35\n", "", 1);
    save::open(&mut other, &older).unwrap();
    assert_eq!(other.belt_speed, Some(0.3));
    for wrong in ["-1.0", "0.0", "nan"] {
        let broken = text.replacen("belt = 0.35", &format!("belt = {wrong}"), 1);
        let why = save::open(&mut other, &broken).unwrap_err();
        assert!(why.contains("is outside its range") && !why.contains('\n'), "{why}");
    }
    // What was on show is still there.
    desk.give(Msg::Idle);
    runs_at(&desk, 0.35);
    assert_eq!(Rig::new(desk.session.running().unwrap().machine.clone()).unwrap().reduced, at(0.3));
}

#[test]
fn the_path_over_the_speed_asks_nothing() {
    let mut desk = Desk::open("belt-speed");
    let with = desk.session.wants();
    assert_eq!(desk.press(":layer<space>belt-path<space>off<enter>"), []);
    assert_eq!(desk.session.wants(), with);
    assert_eq!(desk.press("<tab> <run \"layer belt-path\">"), [], "its name shows it again");
    assert!(desk.session.layers.contains(&Layer::BeltPath));
    // A chart of the same machine over other parameters has it too, and one of no machine says why not.
    assert_eq!(desk.session.not_drawn(Layer::BeltPath), None);
    let plain = Desk::open("regimes").session;
    assert!(plain.not_drawn(Layer::BeltPath).is_some_and(|why| why.contains("no machine")));
}

/// Why the line that is typed is refused.
fn refused(desk: &Desk) -> String {
    let Some(Overlay::Prompt(prompt)) = &desk.session.overlay else { panic!("it is taken") };
    prompt.refused.clone().unwrap_or_default()
}

#[test]
fn a_machine_of_the_program_opens_by_its_name_which_can_be_completed() {
    let mut desk = Desk::open("plain");
    desk.press(":belt<space>cl<tab><enter>");
    let running = desk.session.running().unwrap();
    assert_eq!(running.machine.name, "clutch");
    assert!(desk.session.draws_whole());
    desk.press(":belt<space>tractor<enter>");
    assert_eq!(
        refused(&desk),
        "belt: no machine \"tractor\"; there are textbook, clutch, slideway, straight, bstab, groan"
    );
    desk.press("<esc> u");
    assert_eq!(desk.session.scene.name, "plain");
}

#[test]
fn a_machine_opens_from_its_file_and_the_table_beside_it() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/assets/belts/");
    let text = |name: &str| std::fs::read_to_string(format!("{folder}{name}")).unwrap();
    let mut desk = Desk::open("plain");
    let read = |desk: &mut Desk, path: &str, text: Result<String, String>| {
        desk.press(&format!(":machine<space>{path}<enter>"));
        let asked = Effect::Read { path: path.into(), purpose: Purpose::Machine };
        assert_eq!(desk.effects.last(), Some(&asked));
        desk.give(Msg::Read { path: path.into(), purpose: Purpose::Machine, result: text });
    };
    read(&mut desk, "a/clutch.toml", Ok(text("clutch.toml")));
    assert_eq!(desk.session.running().unwrap().machine.name, "clutch");
    // The table is asked for, beside the file.
    for (table, opens) in
        [(Err("no such file".to_owned()), false), (Ok(text("slideway.csv")), true)]
    {
        read(&mut desk, "a/slideway.toml", Ok(text("slideway.toml")));
        let Some(Effect::Read { path, purpose }) = desk.effects.last().cloned() else { panic!() };
        assert_eq!(path.to_str(), Some("a/slideway.csv"));
        desk.give(Msg::Read { path, purpose, result: table });
        let name = &desk.session.running().unwrap().machine.name;
        assert_eq!(name == "slideway", opens, "{name}");
        assert_eq!(desk.notice().starts_with("a/slideway.toml:"), !opens, "{}", desk.notice());
    }
    // What is wrong stands in one line, and everything stays.
    for (text, words) in [
        (Err("b.toml: no such file".to_owned()), "b.toml: no such file"),
        (Ok("m = 1".to_owned()), "b.toml:1:1: missing field `friction`"),
        (Ok(text("clutch.toml").replace("v0", "v9")), "b.toml:"),
        (Ok("modal_mass = 1".to_owned()), "b.toml: a vibration mode has no belt"),
    ] {
        read(&mut desk, "b.toml", text);
        assert!(desk.notice().starts_with(words), "{}", desk.notice());
        assert!(!desk.notice().contains('\n'));
        assert_eq!(desk.session.running().unwrap().machine.name, "slideway");
    }
}
