//! The state of the loop while it plays a file.

use std::collections::BTreeMap;

use crate::session::replay::{ANSWERS, Player, Script};
use crate::session::{Code, Key, Msg};

/// Why a replay is paused.
#[derive(PartialEq)]
pub(super) enum Pause {
    Not,
    /// A caption waits to be read.
    Caption,
    /// The user asked for it.
    Wished,
}

/// What is said of a question that was answered rightly or a task that was done, of a wrong answer, and of a task whose way
/// was shown.
pub(super) const RIGHT: &str = "Right. ";
const WRONG: &str = "No. ";
pub(super) const SHOWN: &str = "Shown: ";

/// A file that is being played.
pub(super) struct Replay {
    pub(super) player: Player,
    /// The player at its beginning, to start over.
    start: Player,
    /// Number of captions to skip on the way to the wanted one.
    pub(super) passed: usize,
    /// Whether keys had their usual effect since the present caption was shown.
    pub(super) tried: bool,
    pub(super) pause: Pause,
    /// The question that waits for this answer.
    pub(super) question: Option<Key>,
    /// What was said of answers and tasks, by the numbers of their captions: one of [`RIGHT`], [`WRONG`], [`SHOWN`].
    pub(super) answers: BTreeMap<usize, &'static str>,
    /// Whether the user wants to be shown how a task is done.
    pub(super) shows: bool,
    /// Why the first file that it asked for was not written.
    pub(super) unwritten: Option<String>,
}

impl Replay {
    pub(super) fn new(script: Script) -> Self {
        let (player, pause) = (Player::new(script), Pause::Not);
        let start = player.clone();
        Replay {
            player,
            start,
            passed: 0,
            tried: false,
            pause,
            question: None,
            answers: BTreeMap::new(),
            shows: false,
            unwritten: None,
        }
    }

    /// Plays everything again up to the caption after so many.
    pub(super) fn again(&mut self, passed: usize) {
        self.player = self.start.clone();
        (self.passed, self.pause, self.tried) = (passed, Pause::Not, false);
        (self.question, self.shows) = (None, false);
    }

    /// Notes how a question was answered or a task done; only the first time counts.
    pub(super) fn note(&mut self, number: usize, how: &'static str) {
        self.answers.entry(number).or_insert(how);
    }

    /// Goes on from a caption by a key: from a question only by an answer, and by Tab to the next chapter.
    pub(super) fn goes_on(&mut self, key: Key) {
        match (self.question, self.player.next_chapter()) {
            (Some(_), _) if !ANSWERS.contains(&key) => return,
            (Some(answer), _) => {
                self.note(self.player.said(), if key == answer { RIGHT } else { WRONG });
            }
            (None, Some(passed)) if key == Key::plain(Code::Tab) => self.again(passed),
            // Keys that the user has tried are undone.
            _ if self.tried => self.again(self.player.said()),
            _ => {}
        }
        self.pause = Pause::Not;
    }

    /// Waits for a key at a caption that has just been given, unless it is passed. The one behind a question says first
    /// whether the answer was right.
    pub(super) fn waits_at(&mut self, msg: Msg) -> Msg {
        let number = self.player.said();
        if number <= self.passed || self.player.has_task() {
            return msg;
        }
        let remark = self.answers.get(&(number - 1)).copied().unwrap_or_default();
        match msg {
            Msg::Say(text, place) => {
                (self.pause, self.question) = (Pause::Caption, None);
                Msg::Say(format!("{remark}{text}"), place)
            }
            Msg::Ask { answer, .. } => {
                (self.pause, self.question) = (Pause::Caption, answer);
                msg
            }
            msg => msg,
        }
    }

    /// That it is done, and how many answers were right where something was asked.
    pub(super) fn score(&self) -> String {
        let right = self.answers.values().filter(|how| **how == RIGHT).count();
        match self.answers.len() {
            0 => "replay done".to_owned(),
            all => format!("lesson done: {right} of {all} right"),
        }
    }
}
