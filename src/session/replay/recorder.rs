//! Writing a keystroke file from what happens in a live session.

use super::Step;
use crate::session::message::Msg;

/// Longest line of a recorded file, in characters, unless one step is longer.
const LINE: usize = 72;

/// What a user did, as a keystroke file.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Recorder {
    steps: Vec<Step>,
}

impl Recorder {
    /// Notes a message, if a user can cause it; the answers of the worker come by themselves.
    ///
    /// Only what comes from the user belongs here, not what a [`super::Player`] gives.
    pub fn note(&mut self, message: &Msg) {
        match message {
            Msg::Key(pressed) => match self.steps.last_mut() {
                Some(Step::Key { key, count }) if key == pressed && *count < super::parse::MOST => {
                    *count += 1;
                }
                _ => self.steps.push(Step::Key { key: *pressed, count: 1 }),
            },
            Msg::Paste(text) if !text.is_empty() => self.steps.push(Step::Paste(text.clone())),
            Msg::Resize { width, height } => {
                let step = Step::Resize { width: *width, height: *height };
                match self.steps.last_mut() {
                    Some(last @ Step::Resize { .. }) => *last = step,
                    _ => self.steps.push(step),
                }
            }
            Msg::Pointed(pointed) => self.steps.push(Step::Pointed(*pointed)),
            Msg::Elapsed { seconds } => match self.steps.last_mut() {
                Some(Step::Elapse(passed)) => *passed += seconds,
                _ => self.steps.push(Step::Elapse(*seconds)),
            },
            Msg::Run(line) => self.steps.push(Step::Run(line.clone())),
            Msg::Paste(_)
            | Msg::Say(_)
            | Msg::Read { .. }
            | Msg::Answered(_)
            | Msg::Idle
            | Msg::Written(_)
            | Msg::Told(_) => {}
        }
    }

    /// What was noted.
    #[must_use]
    pub fn steps(&self) -> &[Step] {
        &self.steps
    }

    /// Forgets the last presses of keys, pastes and clicks.
    pub fn forget(&mut self, mut presses: u32) {
        while presses > 0 {
            match self.steps.last_mut() {
                Some(Step::Key { count, .. }) if *count > presses => {
                    *count -= presses;
                    return;
                }
                Some(Step::Key { count, .. }) => presses -= *count,
                // The size of the screen is nobody's press.
                Some(Step::Resize { .. }) => {}
                Some(_) => presses -= 1,
                None => return,
            }
            self.steps.pop();
        }
    }

    /// The file so far, below a comment that says how the session was started.
    #[must_use]
    pub fn text(&self, started: &str) -> String {
        text(started, &self.steps)
    }
}

/// A keystroke file of these steps, below a comment.
#[must_use]
pub fn text(comment: &str, steps: &[Step]) -> String {
    let mut text: String = comment.lines().flat_map(|line| ["# ", line, "\n"]).collect();
    let mut length = 0;
    for step in steps {
        let step = step.to_string();
        let added = step.chars().count() + 1;
        if length > 0 && length + added > LINE + 1 {
            text.push('\n');
            length = 0;
        }
        if length > 0 {
            text.push(' ');
        }
        text.push_str(&step);
        length += added;
    }
    if length > 0 {
        text.push('\n');
    }
    text
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::session::replay::{Action, Player, parse};

    /// What a script gives to a session that is always idle.
    fn played(text: &str) -> Vec<String> {
        let mut player = Player::new(parse(text).unwrap());
        let mut given = Vec::new();
        while let Action::Give(message) = player.next(true, String::new).unwrap() {
            given.push(format!("{message:?}"));
        }
        given
    }

    #[test]
    fn a_recording_is_short_and_readable() {
        let mut recorder = Recorder::default();
        for _ in 0..5 {
            recorder.note(&Msg::Key("<right>".parse().unwrap()));
        }
        recorder.note(&Msg::Idle);
        recorder.note(&Msg::Key("#".parse().unwrap_or("<hash>".parse().unwrap())));
        recorder.note(&Msg::Resize { width: 10, height: 10 });
        recorder.note(&Msg::Resize { width: 80, height: 24 });
        recorder.note(&Msg::Paste("a\n\"b\"".to_owned()));
        let text = recorder.text("hopfscope basin");
        assert_eq!(
            text,
            "# hopfscope basin\n<right*5> <hash> <resize 80x24> <paste \"a\\n\\\"b\\\"\">\n"
        );
    }

    #[test]
    fn the_last_presses_can_be_forgotten() {
        let mut recorder = Recorder::default();
        let key =
            |recorder: &mut Recorder, name: &str| recorder.note(&Msg::Key(name.parse().unwrap()));
        for name in ["<right>", "<right>", "<right>", "@", "a"] {
            key(&mut recorder, name);
        }
        recorder.note(&Msg::Resize { width: 80, height: 24 });
        recorder.forget(3);
        assert_eq!(recorder.text(""), "<right*2>\n");
        recorder.forget(9);
        assert_eq!(recorder.text(""), "");
    }

    proptest! {
        #[test]
        fn a_recording_plays_what_was_recorded(
            keys in prop::collection::vec((crate::session::key::tests::any_key(), 1..4), 0..60)
        ) {
            let mut recorder = Recorder::default();
            let mut wanted = Vec::new();
            for (key, count) in keys {
                for _ in 0..count {
                    recorder.note(&Msg::Key(key));
                    wanted.push(format!("{:?}", Msg::Key(key)));
                }
            }
            let text = recorder.text("a session");
            prop_assert!(text.lines().all(|line| line.chars().count() <= LINE));
            prop_assert_eq!(played(&text), wanted);
        }
    }
}
