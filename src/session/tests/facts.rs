//! Facts about a session, so that a test is a table of keys and facts.

use super::{Trial, open_list};
use crate::model::{Group, Knob};
use crate::scene::LAYERS;
use crate::session::{Overlay, Pane, Session};

impl Trial {
    /// For each row, presses its keys and checks its facts, which are separated by ` | `. A fact is a name
    /// known to [`fact`] and its value, in which `..` stands for any text before or after. `+basin` and
    /// `-basin` say that a layer is on or off; `asked` lists the topics computed because of the keys. Keys that
    /// begin with `: ` are a line, which is pasted into the command line and entered.
    pub fn goes(&mut self, rows: &[(&str, &str)]) -> &mut Self {
        for (keys, facts) in rows {
            let line = keys.strip_prefix(": ").map(|line| format!(":<paste {line:?}><enter>"));
            let asked = self.press(line.as_deref().unwrap_or(keys));
            for expected in facts.split(" | ").filter(|fact| !fact.is_empty()) {
                let (name, expected) = expected.split_once(' ').unwrap_or((expected, ""));
                let found = match name {
                    "asked" => joined(asked.iter(), " "),
                    _ => fact(&self.session, name),
                };
                assert!(fits(&found, expected), "{keys}: {name} is {found:?}, not {expected:?}");
            }
        }
        self
    }
}

/// For each row, opens the scene and presses the keys: the line stays open with one line that says what is
/// wrong, and nothing changes; the complaint goes away when the text is changed.
pub fn refuses(scene: &str, rows: &[(&str, &str)]) {
    for (keys, said) in rows {
        let mut trial = Trial::open(scene);
        let before = trial.session.setup();
        trial.goes(&[(keys, &format!("refused {said}.."))]);
        assert!(!trial.refused().contains('\n'), "{}", trial.refused());
        assert_eq!(trial.session.setup(), before, "{keys}: all of it or nothing");
        trial.goes(&[("<backspace>", "refused"), ("<esc>", "open none")]);
    }
}

/// Whether a text matches the expected one, in which `..` at either end stands for any text.
fn fits(found: &str, expected: &str) -> bool {
    match (expected.strip_prefix(".."), expected.strip_suffix("..")) {
        (None, None) => found == expected,
        (Some(end), None) => found.ends_with(end),
        (None, Some(start)) => found.starts_with(start),
        (Some(part), Some(_)) => found.contains(part.trim_end_matches("..")),
    }
}

fn joined<T: std::fmt::Debug>(them: impl Iterator<Item = T>, between: &str) -> String {
    them.map(|it| format!("{it:?}")).collect::<Vec<_>>().join(between)
}

/// The value of a fact about a session, by its name.
fn fact(session: &Session, name: &str) -> String {
    if let Ok(knob) = Knob::named(name, &[Group::Motion]) {
        return session.value(knob).to_string();
    }
    if let Some(layer) = name.strip_prefix(['+', '-']) {
        let row = LAYERS.iter().find(|row| row.name == layer).expect("a layer");
        let on = session.layers.contains(&row.layer);
        return if on == name.starts_with('+') { "" } else { "the other" }.to_owned();
    }
    let problem = &session.problem;
    match name {
        "until" => problem.until.to_string(),
        "method" => problem.method.spec().name.to_owned(),
        "tolerance" => format!("{:?}", problem.tolerance),
        "dial" => {
            let stop = problem.quality().map_or("-", |quality| quality.name);
            format!("{:?} {stop}", problem.setting())
        }
        "scene" => session.scene.name.clone(),
        "quit" => session.quit.to_string(),
        "notice" => session.notice.as_ref().map_or("", |notice| &notice.text).to_owned(),
        "changes" => format!("{} {}", session.history.depth().0, session.history.depth().1),
        "rows" => session.rows().iter().map(|row| row.name()).collect::<Vec<_>>().join(" "),
        "selected" => session.selected.name().to_owned(),
        "pending" => session.pending.map_or_else(|| "none".to_owned(), |it| format!("{it:?}")),
        "scanned" => session.scanned.as_ref().expect("a scan").at.to_string(),
        "ghost" => {
            let left = session.marks.left.as_ref().map(|left| left.problem.parameters.d);
            left.map_or_else(|| "none".to_owned(), |d| d.to_string())
        }
        _ => overlay(session, name)
            .or_else(|| plot(session, name))
            .unwrap_or_else(|| panic!("no fact {name}")),
    }
}

/// A fact about the overlay.
fn overlay(session: &Session, name: &str) -> Option<String> {
    let overlay = session.overlay.as_ref();
    let (open, typed, refused) = match overlay {
        None => ("none".to_owned(), None, None),
        Some(Overlay::Help(_)) => ("help".to_owned(), None, None),
        Some(Overlay::List(kind, _)) => (format!("{kind:?}"), None, None),
        Some(Overlay::Prompt(it)) => {
            let what = if it.row.is_some() { "entry" } else { "prompt" };
            (what.to_owned(), Some(it.input.text()), it.refused.clone())
        }
        Some(Overlay::Offer(script)) => (format!("offer of {} keys", script.keys()), None, None),
        Some(Overlay::Explanation(shown)) => {
            let entry = shown.entry.map_or("screen", |entry| entry.name);
            (format!("explanation of {entry}"), None, None)
        }
    };
    Some(match name {
        "open" => open,
        "typed" => typed.unwrap_or_default(),
        "refused" => refused.unwrap_or_default(),
        "list" => open_list(session).map_or(0, |list| list.selected).to_string(),
        _ => return None,
    })
}

/// A fact about the plots, or about the one in focus.
fn plot(session: &Session, name: &str) -> Option<String> {
    let focused = || session.focused().expect("a plot in focus");
    let axes = || focused().axes;
    Some(match name {
        "plots" => session.plots.len().to_string(),
        "focus" if session.focus == Pane::Parameters => "parameters".to_owned(),
        "focus" => format!("{} {}", session.plot, focused().view.spec().name),
        "abscissa" => axes().abscissa.spec().name.to_owned(),
        "ordinate" => axes().ordinate.spec().name.to_owned(),
        "label" => axes().label().to_string(),
        "framing" => format!("{:?}", focused().framing),
        "cursor" => {
            let told = focused().cursor.map(|cursor| format!("{} {}", cursor.x, cursor.y));
            told.unwrap_or_else(|| "none".to_owned())
        }
        "held" => {
            let size = session.held.map(|held| held.cycle.map_or(f64::INFINITY, |it| it.q_max));
            size.map_or_else(|| "none".to_owned(), |size| size.to_string())
        }
        "special" => {
            session.held?.special.map_or_else(|| "none".to_owned(), |it| format!("{it:?}"))
        }
        "starts" => {
            // The oldest first.
            let mut starts: Vec<_> = session.problems().iter().map(|it| it.initial.q).collect();
            starts.rotate_left(1);
            joined(starts.iter(), " ")
        }
        _ => return None,
    })
}
