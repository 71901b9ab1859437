//! Any keys in any order: nothing panics, nothing impossible is asked, nothing is lost by accident.

use proptest::prelude::*;

use super::Trial;
use crate::scene::{Request, library};
use crate::session::commands;
use crate::session::{Effect, Key, Msg, Pane, Plot, Session, update};

/// Keys that have a meaning in some context, and some that are only typed.
pub(super) fn any_key() -> impl Strategy<Value = Key> {
    let bound: Vec<Key> = commands()
        .flat_map(|command| command.keys.iter().flat_map(|(_, keys)| keys.iter().copied()))
        .collect();
    let typed = prop::char::range(' ', '~').prop_map(|char| {
        let code = crate::session::Code::Char(char);
        Key::plain(code)
    });
    prop_oneof![4 => prop::sample::select(bound), 1 => typed]
}

/// Checks what must hold after any keys.
pub(super) fn check(session: &Session) {
    assert!(session.rows().contains(&session.selected));

    if let Pane::Plot(plot) = session.focus {
        assert!(session.on_show().contains(&plot));
    }
    for Plot { window, .. } in &session.plots {
        for span in [window.x, window.y] {
            assert!(span.width() > 0.0 && span.width().is_finite());
        }
    }
    for plot in &session.plots {
        if let Some(cursor) = plot.cursor {
            assert!(cursor.x.is_finite() && cursor.y.is_finite());
        }
    }
    for knob in crate::model::Knob::MOTION {
        let value = session.value(knob);
        assert_eq!(knob.check(value), Ok(value));
    }
    for request in session.wants() {
        if let Request::Branch { range: (from, to), parameter, .. } = request {
            let spec = parameter.spec();
            assert!(from < to && spec.min <= from && to <= spec.max);
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(128))]

    #[test]
    fn any_keys_keep_a_session_whole(
        scene in 0..library().len(),
        keys in prop::collection::vec(any_key(), 0..120),
    ) {
        let mut trial = Trial::open(&library()[scene].name);
        for key in keys {
            trial.give(Msg::Key(key));
            check(&trial.session);
        }
    }

    #[test]
    fn escape_never_quits_and_never_discards(keys in prop::collection::vec(any_key(), 0..40)) {
        let mut trial = Trial::open("supercritical");
        for key in keys {
            trial.give(Msg::Key(key));
            let mut session = trial.session.clone();
            let effects = update(&mut session, Msg::Key("<esc>".parse().unwrap()));
            prop_assert!(!effects.contains(&Effect::Quit));
            prop_assert_eq!(session.problem, trial.session.problem);
            prop_assert_eq!(session.history, trial.session.history.clone());
        }
    }

    #[test]
    fn undoing_everything_leads_back_to_the_start(keys in prop::collection::vec(any_key(), 0..60)) {
        let mut trial = Trial::open("supercritical");
        let start = trial.session.clone();
        for key in keys {
            trial.give(Msg::Key(key));
        }
        trial.press("<esc*3>");
        prop_assert_eq!((&trial.session.overlay, trial.session.pending), (&None, None));
        while trial.session.history.depth().1 > 0 {
            trial.press("U");
        }
        let last = trial.session.problem;
        while trial.session.history.depth().0 > 0 {
            trial.press("u");
        }
        prop_assert_eq!(trial.session.problem, start.problem);
        prop_assert_eq!(&trial.session.scene.name, &start.scene.name);
        while trial.session.history.depth().1 > 0 {
            trial.press("U");
        }
        prop_assert_eq!(trial.session.problem, last);
    }

    #[test]
    fn the_same_keys_do_the_same_on_every_screen(
        keys in prop::collection::vec(any_key(), 0..60),
        width in 1..500_u16,
        height in 1..200_u16,
    ) {
        let mut here = Trial::open("plain");
        let mut there = Trial::open("plain");
        there.give(Msg::Resize { width, height });
        for key in keys {
            here.give(Msg::Key(key));
            there.give(Msg::Key(key));
        }
        there.session.size = here.session.size;
        // A wide screen asks for more: it shows the scene that is selected in their list.
        for session in [&mut here.session, &mut there.session] {
            (session.preview, session.answers) = (None, crate::session::Answers::default());
            (session.price, session.other) = (crate::session::Price::default(), None);
        }
        prop_assert!(here.session == there.session);
    }
}
