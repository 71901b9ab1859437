//! Recordings: they replay what was recorded, from the same start to the same end.

use std::sync::Arc;

use proptest::prelude::*;
use strum::VariantArray;

use super::Trial;
use super::strange::any_key;
use crate::flow::METHODS;
use crate::model::Knob;
use crate::numerics::powi;
use crate::scene::machine::library::machines;
use crate::scene::{ScaledMachine, Scene, library};
use crate::session::replay::{Recorder, text};
use crate::session::save::opening;
use crate::session::{
    Answers, Colors, DisplaySettings, Effect, Glyphs, Msg, Notice, Session, Size, Theme, save,
};

/// A session as options of the command line start it, with its recording.
fn started(scene: Arc<Scene>, look: DisplaySettings) -> (Trial, Recorder) {
    let mut session = Session::new(scene, Size { width: 80, height: 24 });
    session.display = look;
    recording(session)
}

/// A session that begins, with its recording.
fn recording(session: Session) -> (Trial, Recorder) {
    let recorder = Recorder::new("hopfscope".to_owned(), opening(&session).unwrap());
    let mut trial = Trial { session, asked: Vec::new(), effects: Vec::new() };
    trial.settle();
    (trial, recorder)
}

/// The session that a recording leads to, whatever the state before.
fn replayed(text: &str, before: &str) -> Trial {
    let mut trial = Trial::open(before);
    trial.press("<right> \"a <right> W");
    trial.press(text);
    trial
}

/// A session without its cost, and without answers that are no longer asked for.
fn alike(session: &Session) -> Session {
    let mut session = session.clone();
    session.price = crate::session::Price::default();
    (session.chord, session.asked) = (0, 0);
    session.answers = Answers::default();
    session.other = None;
    session.interrupted.clear();
    session.history.forget_windows();
    session
}

pub(super) fn assert_alike(one: &Session, other: &Session, text: &str) {
    let (one, other) = (alike(one), alike(other));
    if one != other {
        let [one, other] = [one, other].map(|session| format!("{session:#?}"));
        let mut lines = one.lines().zip(other.lines());
        let (first, second) = lines.find(|(first, second)| first != second).unwrap_or_default();
        panic!("{text}\nlive:   {first}\nplayed: {second}");
    }
}

/// A scene with numbers from the command line.
fn with_numbers(scene: &Arc<Scene>, change: impl FnOnce(&mut Scene)) -> Arc<Scene> {
    let mut scene = Arc::clone(scene);
    change(Arc::make_mut(&mut scene));
    scene
}

/// Sets a number like `--set`.
fn set(scene: &mut Scene, symbol: Knob, value: f64) {
    scene.problem.set(symbol, value);
    if !matches!(symbol, Knob::Q0 | Knob::V0) {
        scene.terms.insert(symbol);
    }
}

#[test]
fn a_recording_begins_with_the_lines_that_lead_to_its_start() {
    let scene = crate::scene::find("supercritical").unwrap();
    let scene = with_numbers(&scene, |scene| {
        set(scene, Knob::Q0, 0.5);
        set(scene, Knob::D2, 0.0);
    });
    let look = DisplaySettings { theme: Theme::Light, ..DisplaySettings::default() };
    let begun = text("", started(scene, look).1.steps());
    assert_eq!(
        begun,
        "<run \"theme light\"> <run \"scene supercritical\"> <run \"set q0=0.5\">\n<start D2>\n"
    );
    let begun = text("", started(crate::scene::plain(), DisplaySettings::default()).1.steps());
    assert_eq!(begun, "<run \"scene plain\"> <start>\n");
}

#[test]
fn a_machine_and_a_saved_session_begin_as_they_were() {
    for machine in machines() {
        let scene = Arc::new(ScaledMachine::try_from(machine.clone()).unwrap().scene());
        let scene = with_numbers(&scene, |scene| set(scene, Knob::Q0, 0.5));
        let (live, recorder) = started(scene, DisplaySettings::default());
        let begun = text("", recorder.steps());
        assert_alike(&live.session, &replayed(&begun, "fig17").session, &begun);
    }
    let mut used = Trial::open("linear");
    used.press("<right*3> \"a <left> [ -0.3<enter> 'a W ; <tab*2> +++ u");
    let saved = save::text(&used.session).unwrap();
    let mut session = Session::new(crate::scene::plain(), Size { width: 80, height: 24 });
    save::open(&mut session, &saved).unwrap();
    session.notice = Some(Notice { error: false, text: "opened start.toml".to_owned() });
    let (live, recorder) = recording(session);
    let begun = text("", recorder.steps());
    assert_alike(&live.session, &replayed(&begun, "fig17").session, &begun);
}

prop_compose! {
    /// A scene and its numbers, as options of the command line choose them.
    fn any_start()(
        scene in 0..library().len(),
        given in prop::collection::vec((0..6_usize, 0..5_u8), 0..4),
        method in prop::option::of(0..METHODS.len()),
        dials in prop::collection::vec(prop::option::of(0..4_u8), 3),
    ) -> Arc<Scene> {
        with_numbers(&library()[scene], |scene| {
            for (which, tenths) in given {
                let knob = Knob::MOTION[which];
                set(scene, knob, knob.check(f64::from(tenths) / 10.0).unwrap());
            }
            let problem = &mut scene.problem;
            problem.method = method.map_or(problem.method, |which| METHODS[which].method);
            let dial = |which: usize, now: f64| {
                dials[which].map_or(now, |digits| 0.3 * powi(0.1, i32::from(digits) + 2))
            };
            problem.tolerance = dial(0, problem.tolerance);
            problem.step = dial(1, problem.step);
            problem.epsilon = dial(2, problem.epsilon);
        })
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(96))]

    #[test]
    fn any_recording_plays_what_was_recorded(
        scene in any_start(),
        (glyphs, color, theme) in (0..Glyphs::VARIANTS.len(), 0..Colors::VARIANTS.len(), 0..Theme::VARIANTS.len()),
        mouse in any::<bool>(),
        keys in prop::collection::vec(any_key(), 0..60),
        before in 0..library().len(),
    ) {
        let look = DisplaySettings {
            fine: Colors::Auto,
            glyphs: Glyphs::VARIANTS[glyphs],
            colors: Colors::VARIANTS[color],
            theme: Theme::VARIANTS[theme],
            mouse,
            stretched: mouse,
            dimensionless: mouse,
            lecture: mouse,
        };
        let (mut live, mut recorder) = started(scene, look);
        // The tour is left out, because it expects texts on the screen.
        for key in keys.into_iter().filter(|key| key.to_string() != "<f6>") {
            let message = Msg::Key(key);
            recorder.note(&message);
            let since = live.effects.len();
            live.give(message);
            let mut given: Vec<Effect> = live.effects[since..].to_vec();
            while let Some(Effect::Play(script)) = given.pop() {
                live.press(&text("", &script.steps.into_iter().map(|it| it.step).collect::<Vec<_>>()));
            }
            if live.session.quit {
                break;
            }
        }
        let recorded = recorder.text();
        let mut other = Trial::open(&library()[before].name);
        other.session.display = DisplaySettings::default();
        other.press(&recorded);
        assert_alike(&live.session, &other.session, &recorded);
    }
}
