//! Sessions as files: a saved session comes back, and anything else is refused in one line.

use std::path::PathBuf;

use proptest::prelude::*;

use super::strange::any_key;
use super::{Trial, answered};
use crate::model::Knob;
use crate::scene::{Request, Topic, library};
use crate::session::{
    ComputedContent, Content, Effect, KeptSession, Msg, Notice, Purpose, Session, Setup, StepSizes,
    save, update,
};

/// Everything of a session that its file holds.
fn essence(session: &Session) -> impl PartialEq + use<> {
    let marks: Vec<(char, Setup)> =
        session.marks.places.iter().map(|(name, mark)| (*name, mark.clone())).collect();
    let plots: Vec<_> = session
        .plots
        .iter()
        .map(|plot| (plot.view, plot.axes, plot.window, plot.framing, plot.cursor))
        .collect();
    (
        (session.scene.clone(), session.setup(), session.steps, session.selected, session.focus),
        (plots, session.plot, session.enlarged, session.arrangement, session.unfolded),
        (session.harmonics, session.layers.clone(), session.history.clone()),
        (session.lines.clone(), marks, session.kicks),
    )
}

/// What it asks. Questions for an overlay or for the measured error are transient and not part of a session.
fn asks(session: &Session) -> Vec<Request> {
    let passing = |request: &Request| matches!(request.topic(), Topic::Claims | Topic::Reference);
    session.wants().into_iter().filter(|request| !passing(request)).collect()
}

/// A session after it was saved and opened again: with all that its file holds, and saved as the same file.
pub(super) fn reopened(session: &Session) -> Session {
    let text = save::text(session).unwrap();
    let mut other = Trial::open("plain").session;
    save::open(&mut other, &text).unwrap_or_else(|why| panic!("{why}\n{text}"));
    assert!(essence(&other) == essence(session), "{text}");
    assert_eq!(save::text(&other), Ok(text));
    other
}

/// A session in which everything differs from the start.
fn used() -> Trial {
    let mut trial = Trial::open("linear");
    trial.press(
        "<right*3> \"a <left> [ -0.3<enter> 'a v<down><space><esc> W ; <tab*2> +++ L <left*3>",
    );
    trial.press(":set<space>r=2<enter> s/super<enter> <right*2> u u u U x Z ) ) z");
    trial
}

#[test]
fn a_saved_session_comes_back_as_it_was() {
    let trial = used();
    let other = reopened(&trial.session);
    assert_eq!(asks(&other), asks(&trial.session));
    let text = save::text(&other).unwrap();
    let mut former = Trial::open("plain").session;
    save::open(&mut former, &format!("{text}\n[registers]\nx = \"<right>\"\n")).unwrap();
    assert!(essence(&former) == essence(&other), "recorded keys of earlier versions are dropped");
}

#[test]
fn a_scene_changed_on_the_command_line_is_saved_in_full() {
    let mut trial = Trial::open("linear");
    std::sync::Arc::make_mut(&mut trial.session.scene).problem.parameters.d = -0.25;
    trial.press("R");
    let other = reopened(&trial.session);
    assert_eq!(other.scene, trial.session.scene);
    assert_eq!(other.problem.parameters.d, -0.25);
    let good = save::text(&other).unwrap();
    for field in ["name", "terms", "until", "abscissa"] {
        let damaged = good.replacen(&format!("\n{field} = "), "\n# ", 1);
        assert!(damaged != good && save::open(&mut trial.session, &damaged).is_err(), "{field}");
    }
}

fn figure(path: &str, plot: Option<usize>, replace: bool) -> Effect {
    Effect::Write {
        path: path.into(),
        content: Content::Computed(ComputedContent::Figure { plot }),
        replace,
    }
}

#[test]
fn lines_write_open_and_play_files_without_touching_any() {
    let mut trial = used();
    trial.press("z :write<space>a.toml<enter>");
    let Some(Effect::Write { path, content, replace: false }) = trial.effects.last().cloned()
    else {
        panic!("{:?}", trial.effects.last());
    };
    let Content::Text(text) = content else { panic!("{content:?}") };
    assert_eq!(path, PathBuf::from("a.toml"));
    let mut other = Trial::open("plain");
    other.press(":open<space>a.toml<enter>");
    let asked = Effect::Read { path: path.clone(), purpose: Purpose::Open };
    assert_eq!(other.effects.last(), Some(&asked));
    other.give(Msg::Read { path, purpose: Purpose::Open, result: Ok(text) });
    assert_eq!(other.notice(), "opened a.toml");
    assert!(essence(&other.session) == essence(&trial.session));
    other.press(":write!<space>a.toml<enter>");
    assert!(matches!(other.effects.last(), Some(Effect::Write { replace: true, .. })));
    other.press(":figure<space>a.SVG<enter>");
    assert_eq!(other.effects.last(), Some(&figure("a.SVG", None, false)));
    // Only one figure is written at a time; the key that stops a scan also stops a figure.
    other.press(":figure<space>b.svg<enter>");
    assert_eq!(other.effects.last(), Some(&figure("a.SVG", None, false)));
    other.press("<esc> <esc>");
    assert_eq!(other.effects.last(), Some(&Effect::StopWriting));
    let stopped = Notice { error: false, text: "a.SVG not written: stopped".to_owned() };
    other.give(Msg::Written(stopped.clone()));
    assert_eq!(other.notice(), stopped.text);
    other.press("<esc>");
    other.press(":figure<space>a.eps<enter> <esc>");
    assert_eq!(other.effects.last(), Some(&Effect::StopWriting), "and no other file");
    other.press("<A-f><enter>");
    assert_eq!(other.effects.last(), Some(&figure("supercritical-2.svg", Some(1), false)));
    other.give(Msg::Written(stopped.clone()));
    // A file that ends as a figure is one.
    other.press(":write<space>b.pdf<enter>");
    assert_eq!(other.effects.last(), Some(&figure("b.pdf", None, false)));
    other.give(Msg::Written(stopped.clone()));
    other.press("W <A-f> <backspace*3>png<enter>");
    assert_eq!(other.effects.last(), Some(&figure("supercritical-3.png", Some(2), false)));
    other.give(Msg::Written(stopped.clone()));
    for (keys, path, content) in [
        ("<A-h><enter>", "supercritical.html", ComputedContent::Page { forget: 2 }),
        ("<A-s><enter>", "supercritical.wav", ComputedContent::Sound),
    ] {
        other.press(keys);
        let content = Content::Computed(content);
        let asked = Effect::Write { path: path.into(), content, replace: false };
        assert_eq!(other.effects.last(), Some(&asked));
        other.give(Msg::Written(stopped.clone()));
    }
    other.press("Q :figure-pane!<space>a.csv<enter>");
    assert_eq!(other.effects.last(), Some(&figure("a.csv", Some(1), true)));
    other.press("<right> :record<space>a.keys<enter>");
    let content = Content::Record { forget: 15 };
    let asked = Effect::Write { path: "a.keys".into(), content, replace: false };
    assert_eq!(other.effects.last(), Some(&asked));
    let path = PathBuf::from("a.keys");
    let result = Err("a.keys: no such file".to_owned());
    other.give(Msg::Read { path, purpose: Purpose::Play, result });
    assert_eq!(other.notice(), "a.keys: no such file");
}

#[test]
fn several_interrupted_sessions_are_listed_and_one_is_taken_or_forgotten() {
    let said = save::summary(&save::text(&used().session).unwrap()).unwrap();
    assert!(said.starts_with("supercritical (") && said.ends_with("changes, 1 mark)"), "{said}");
    let mut trial = Trial::open("linear");
    trial.press("-0.3<enter>");
    let said = save::summary(&save::text(&trial.session).unwrap());
    assert_eq!(said.as_deref(), Ok("linear D = -0.3 (1 change)"));
    let kept =
        |name: &str| KeptSession { path: name.into(), when: String::new(), what: name.to_owned() };
    trial.session.interrupted = ["a", "b", "c", "d"].map(kept).to_vec();
    trial.press("<f3> <down> x");
    assert_eq!(trial.effects.last(), Some(&Effect::PutAside("b".into())));
    trial.press("/d<enter> <enter>");
    let asked = Effect::Read { path: "d".into(), purpose: Purpose::Restore };
    assert_eq!(trial.effects.last(), Some(&asked));
    assert_eq!(trial.session.overlay, None);
    trial.press("<f3> <esc> <f3> X");
    let last = &trial.effects[trial.effects.len() - 2..];
    assert_eq!(last, [Effect::PutAside("c".into()), Effect::PutAside("a".into())]);
    assert_eq!((trial.session.overlay.clone(), trial.session.interrupted.len()), (None, 0));
}

#[test]
fn steps_are_saved_by_name_and_those_of_former_sessions_in_the_order_of_the_table_are_read() {
    let listed = r#"{"parameters": [0.02, 0.05, 0.05, 0.01, 0.05, 0.2], "until": 5, "belt": 0.05,
        "machine": [0.1, 50.0, 0.2, 2.0, 5.0, 0.5], "disturbance": 0.001}"#;
    let steps: StepSizes = serde_json::from_str(listed).unwrap();
    let motion = [Knob::D, Knob::V0, Knob::Until, Knob::BeltSpeed, Knob::Disturbance];
    let found = motion.map(|knob| steps.of(knob).value());
    assert_eq!(found, [0.02, 0.2, 5.0, 0.05, 0.001]);
    let machine = [Knob::Mass, Knob::Friction].map(|knob| steps.of(knob).value());
    assert_eq!(machine, [0.1, 0.5]);
    let named = serde_json::to_value(steps).unwrap();
    assert_eq!(
        (&named["D"], &named["belt"], &named["m"]),
        (&0.02.into(), &0.05.into(), &0.1.into())
    );
    assert_eq!(serde_json::from_value::<StepSizes>(named).unwrap(), steps);
    let few: StepSizes = serde_json::from_str(r#"{"D": 0.5}"#).unwrap();
    assert_eq!([Knob::D, Knob::Until].map(|knob| few.of(knob).value()), [0.5, 10.0]);
}

#[test]
fn what_is_no_session_is_refused_in_one_line_and_changes_nothing() {
    let good = save::text(&used().session).unwrap();
    for (from, to, said) in [
        ("hopfscope = 1", "hopfscope = 2", "a session of format 2; this program reads up to 1"),
        ("hopfscope = 1\n", "", "not a saved session: it does not say hopfscope = 1"),
        ("hopfscope = 1", "hopfscope = ", "line 2: "),
        ("harmonics = ", "harmonics = 1000 # ", "harmonics = 1000, not 1 to 63"),
        ("harmonics", "harmony", "unknown field `harmony`"),
        ("focus = ", "focus = 9 # ", "focus = 9, but there are 2 plots"),
        ("selected = \"", "selected = \"no ", "no row \"no "),
        ("tolerance = ", "tolerance = 7.0 # ", "tolerance = 7 is outside its range"),
        ("parameters]\nD = ", "parameters]\nD = 1e9 # ", "D = 1000000000 is outside its range"),
        ("scene = \"linear\"", "scene = \"liner\"", "no scene \"liner\"; did you mean linear"),
    ] {
        assert!(good.contains(from), "{from}\n{good}");
        let mut trial = Trial::open("plain");
        let before = trial.session.clone();
        let said_instead = save::open(&mut trial.session, &good.replacen(from, to, 1)).unwrap_err();
        assert!(said_instead.contains(said) && !said_instead.contains('\n'), "{said_instead}");
        assert!(trial.session == before);
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn any_session_can_be_saved_and_comes_back(
        scene in 0..library().len(),
        keys in prop::collection::vec(any_key(), 0..60),
    ) {
        let mut trial = Trial::open(&library()[scene].name);
        for key in keys {
            trial.give(Msg::Key(key));
        }
        // Trying kicks and a lecture end with the program, and with them what is asked only for that.
        trial.session.kicking = false;
        trial.session.display.lecture = false;
        prop_assert_eq!(asks(&reopened(&trial.session)), asks(&trial.session));
    }

    #[test]
    fn no_file_is_too_strange(text in any::<String>(), cut in 0..2000_usize, other in any::<char>()) {
        let mut trial = Trial::open("plain");
        let _ = save::open(&mut trial.session, &text);
        let mut broken: Vec<char> = save::text(&trial.session).unwrap().chars().collect();
        let at = cut.min(broken.len() - 1);
        broken[at] = other;
        let _ = save::open(&mut trial.session, &broken.into_iter().collect::<String>());
        for request in trial.session.wants() {
            update(&mut trial.session, answered(request));
        }
    }
}
