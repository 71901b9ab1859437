//! The speed of the belt as one of the numbers: it moves D, D2, D3 and r along the machine's path.

use super::Trial;
use super::saved::reopened;
use crate::model::{Knob, ReducedBelt};
use crate::scene::Layer;
use crate::session::{Msg, Row, save};

/// The textbook machine at a speed of its belt, reduced without a session.
fn at(speed: f64) -> ReducedBelt {
    let mut machine = crate::scene::machine::library::find("textbook").unwrap().clone();
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
    assert_eq!((&trial.session.setting, trial.session.running()), (&None, None));
    trial.press("'a");
    assert_eq!(trial.session.setting, None, "the numbers come along, not the belt");
    assert_eq!(trial.session.problem.parameters, at(0.32).parameters);
    trial.press("u u");
    runs_at(&trial, 0.35);
    // Sessions saved before this number existed show the machine at its own speed.
    let older = text.replacen("belt = 0.35\n", "", 1);
    save::open(&mut other, &older).unwrap();
    assert_eq!(other.setting.as_ref().and_then(|it| it.get(Knob::BeltSpeed)), Some(0.3));
    for wrong in ["-1.0", "0.0", "nan"] {
        let broken = text.replacen("belt = 0.35", &format!("belt = {wrong}"), 1);
        let why = save::open(&mut other, &broken).unwrap_err();
        assert!(why.contains("is outside its range") && !why.contains('\n'), "{why}");
    }
    // The refused files changed nothing.
    trial.give(Msg::Elapsed { seconds: 0.0 });
    runs_at(&trial, 0.35);
    assert_eq!(trial.session.scene.machine.as_ref().unwrap().reduced, at(0.3));
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
fn the_selected_row_of_a_machine_is_on_show() {
    let mut trial = Trial::open("slow-belt");
    for keys in ["x <down*30>", "x", "<right>", "<left>", "<up>", "x <up>", "x"] {
        trial.press(keys);
        assert!(trial.session.rows().contains(&trial.session.selected), "{keys}");
    }
    assert!(!trial.session.rows().contains(&Row::Tolerance));
}
