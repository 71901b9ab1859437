//! The contexts that hold at present, and the keys that matter in them.

use std::collections::BTreeSet;

use crate::session::message::key::Key;
use crate::session::state::context::chain;
use crate::session::state::{Command, Context, Listed, Overlay, Pending, Session, SessionCaption};

impl Session {
    /// The contexts that hold at present, the most specific first: one of
    /// [`chains`](crate::session::state::context::chains).
    pub fn contexts(&self) -> &'static [Context] {
        match self.pending {
            Some(Pending::Count(_)) => chain(Context::Count),
            Some(Pending::Letter(_)) => chain(Context::Letter),
            None => self.contexts_at_rest(),
        }
    }

    /// The contexts that hold when nothing is pending.
    pub(in crate::session) fn contexts_at_rest(&self) -> &'static [Context] {
        let first = match &self.overlay {
            None => return self.contexts_below(),
            Some(overlay) if overlay.list().is_some_and(|list| list.searching) => match overlay {
                Overlay::List(Listed::Palette, _) => Context::Palette,
                _ => Context::Search,
            },
            Some(Overlay::List(Listed::Palette | Listed::Cost, _)) => Context::Help,
            Some(Overlay::List(Listed::Scenes, _)) => Context::Scenes,
            Some(Overlay::List(Listed::Layers, _)) => Context::Layers,
            Some(Overlay::List(Listed::Views, _)) => Context::Views,
            Some(Overlay::List(Listed::Paper, _)) => Context::Paper,
            Some(Overlay::List(Listed::Interrupted, _)) => Context::Interrupted,
            Some(Overlay::Entry(_)) => Context::Entry,
            Some(Overlay::Prompt(_)) => Context::Prompt,
            Some(Overlay::Scan(_)) => Context::Form,
            Some(Overlay::Offer(_)) => Context::Offer,
        };
        chain(first)
    }

    /// The contexts that hold when nothing is open.
    pub(in crate::session) fn contexts_below(&self) -> &'static [Context] {
        chain(match self.focused() {
            _ if self.held.is_some() => Context::Walk,
            Some(plot) => Context::View(plot.view),
            None => Context::Parameters,
        })
    }

    /// Whether a key has its usual effect while the caption of a tour is shown: the caption names its command,
    /// or an overlay that such a key has opened takes it.
    pub fn tries(&self, key: Key) -> bool {
        let SessionCaption::Tour(text, _) = &self.caption else { return false };
        let named = |command: &Command| text.contains(&format!("{{{}}}", command.name));
        self.overlay.is_some()
            || self.pending.is_some()
            || self.keymap.command(self.contexts(), key).is_some_and(named)
    }

    /// Whether a key runs a command or is typed in the present contexts.
    pub(in crate::session) fn means(&self, key: Key) -> bool {
        let contexts = self.contexts();
        self.keymap.command(contexts, key).is_some() || contexts[0].takes_text()
    }

    /// The keys that matter at present, with a word for each, for the footer.
    pub fn hints(&self) -> Vec<Hint> {
        let mut hints: Vec<Hint> = Vec::new();
        let mut shown = BTreeSet::new();
        for context in self.contexts() {
            for command in self.keymap.commands().filter(|command| !command.hint.is_empty()) {
                let Some(key) = self.keymap.keys_in(*context, command).next() else { continue };
                // A finished scan cannot be paused.
                let over = command.name == "scan-pause" && self.scan_request().is_none();
                if over || !shown.insert(command.name) {
                    continue;
                }
                match hints.iter_mut().find(|hint| hint.text == command.hint) {
                    Some(hint) => hint.keys.push(key),
                    None => hints.push(Hint { keys: vec![key], text: command.hint }),
                }
            }
        }
        hints
    }
}

/// An entry of the footer.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Hint {
    /// The keys of the commands that share the word.
    pub keys: Vec<Key>,
    pub text: &'static str,
}
