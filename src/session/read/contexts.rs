//! The contexts that hold at present, the keys that matter in them, and the pane in which a command applies.

use std::collections::BTreeSet;

use crate::scene::VIEWS;
use crate::session::state::context::chain;
use crate::session::{
    Command, Context, Key, Listed, Overlay, Pane, Pending, Prompt, Session, SessionCaption,
};

impl Session {
    /// The contexts that hold at present, the most specific first: one of
    /// [`chains`](crate::session::state::context::chains).
    pub fn contexts(&self) -> &'static [Context] {
        let pending = self.pending.map(Pending::context);
        pending.map_or_else(|| self.contexts_at_rest(), chain)
    }

    /// The contexts that hold when nothing is pending.
    pub(crate) fn contexts_at_rest(&self) -> &'static [Context] {
        let first = match &self.overlay {
            None => return self.contexts_below(),
            Some(Overlay::List(Listed::Palette, list)) if list.searching => Context::Palette,
            Some(Overlay::List(_, list)) if list.searching => Context::Search,
            Some(Overlay::List(Listed::Cost, _)) => Context::List(Listed::Palette),
            Some(Overlay::List(listed, _)) => Context::List(*listed),
            Some(Overlay::Prompt(Prompt { row: Some(_), .. })) => Context::Entry,
            Some(Overlay::Prompt(_)) => Context::Prompt,
            Some(Overlay::Offer(_)) => Context::Offer,
        };
        chain(first)
    }

    /// The contexts that hold when nothing is open.
    pub(crate) fn contexts_below(&self) -> &'static [Context] {
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
    pub(crate) fn means(&self, key: Key) -> bool {
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

/// The pane in which a command applies, if that is not the one in focus. Fails with the context that is
/// missing.
pub(crate) fn place(session: &Session, command: &Command) -> Result<Option<Pane>, Context> {
    let here = session.contexts();
    let places: Vec<Context> = command.keys.iter().map(|(context, _)| *context).collect();
    if places.iter().any(|place| here.contains(place)) {
        return Ok(None);
    }
    let pane = places.iter().copied().find_map(|place| pane(session, place));
    match (pane, places.first()) {
        (None, Some(place)) if places.iter().all(|place| lacks(session, *place)) => Err(*place),
        (pane, _) => Ok(pane),
    }
}

/// The command of a key in a plot that is on show but not in focus, otherwise that in a view that no plot
/// shows; `None` if something is open, which keeps its keys.
pub(crate) fn elsewhere(session: &Session, key: Key) -> Option<&'static Command> {
    if session.overlay.is_some() {
        return None;
    }
    let views = VIEWS.iter().map(|row| Context::View(row.view));
    let found = views.filter_map(|context| {
        let command = session.keymap.command(&[context], key)?;
        Some((pane(session, context).is_none(), command))
    });
    found.min_by_key(|(absent, _)| *absent).map(|(_, command)| command)
}

/// The pane in which the keys of a context apply.
fn pane(session: &Session, context: Context) -> Option<Pane> {
    match context {
        Context::Parameters => Some(Pane::Parameters),
        Context::Plots => Some(Pane::Plot(session.plot)),
        _ => {
            let view = context.view()?;
            let shows = |index: &usize| session.plots[*index].view == view;
            session.on_show().find(shows).map(Pane::Plot)
        }
    }
}

/// Whether a context needs something that is missing: an open line or list, a held branch, or a view.
fn lacks(session: &Session, context: Context) -> bool {
    context.is_overlay()
        || context == Context::Walk
        || (context.view().is_some() && pane(session, context).is_none())
}
