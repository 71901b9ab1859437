//! The contexts that hold at present, the keys that matter in them, and the pane in which a command applies; and the
//! commands that must wait for an answer that is still being computed.
//!
//! A press that waits has not been taken in: it has no effect yet, and nor has anything after it. So the same
//! keys lead to the same result, however fast they are typed. Whoever gives messages to a session holds back
//! further input meanwhile ([`Session::waiting`]). If the computation gives up, the command is run all the
//! same and reports that.

use std::collections::BTreeSet;

use crate::scene::{Request, TOPICS, Topic, VIEWS, View};
use crate::session::read::windows;
use crate::session::{
    Code, Command, Context, Key, ListKind, MouseAction, Msg, Overlay, PaletteRow, Pane,
    PendingInput, PointerTarget, Prompt, Session, SessionCaption, called,
};

impl Session {
    /// The question that must be answered before this message can be taken in.
    pub(crate) fn awaited(&self, message: &Msg) -> Option<Request> {
        match message {
            Msg::Key(key) => self.awaited_by_key(*key),
            Msg::Run(line) => self.awaited_by_line(line),
            Msg::Pointed(MouseAction { place: PointerTarget::Plot(index, _), .. }) => {
                windows::awaited(self, *index)
            }
            _ => None,
        }
    }

    fn awaited_by_key(&self, key: Key) -> Option<Request> {
        match self.pending {
            Some(pending) if self.keymap.command(&[pending.context()], key).is_some() => {
                return None;
            }
            Some(PendingInput::GoTo | PendingInput::Mark) => return None,
            Some(PendingInput::Count(_)) | None => {}
        }
        let Some(command) = self.keymap.command(self.contexts_at_rest(), key) else {
            return self.awaited_by_command(elsewhere(self, key)?);
        };
        match (&self.overlay, command.name) {
            (Some(Overlay::Prompt(prompt)), "run-line") => {
                self.awaited_by_line(prompt.input.text().trim())
            }
            (Some(Overlay::List(ListKind::Palette, list)), "run-command") => {
                match self.palette_rows(list).get(list.selected)? {
                    // One that takes words only opens the line for them.
                    PaletteRow::Command(command) if command.words().is_none() => {
                        self.awaited_by_command(command)
                    }
                    _ => None,
                }
            }
            _ => self.awaited_by(command, self.plot),
        }
    }

    fn awaited_by_line(&self, line: &str) -> Option<Request> {
        let (name, words) = called(line);
        match self.keymap.named(name) {
            Some(command) if words.is_empty() => self.awaited_by_command(command),
            _ => self.awaited_by(self.keymap.line(name)?, self.plot),
        }
    }

    /// The question that must be answered before a command that is run by name, in the pane where it applies.
    pub(crate) fn awaited_by_command(&self, command: &Command) -> Option<Request> {
        let plot = match place(self, command).ok()?.unwrap_or(self.focus) {
            Pane::Plot(index) => index,
            Pane::Parameters => self.plot,
        };
        self.awaited_by(command, plot)
    }

    fn awaited_by(&self, command: &Command, plot: usize) -> Option<Request> {
        // It must not matter whether a layer asks: the answer may have been computed before the layer was
        // switched off.
        let is_open = |request: &Request| self.is_open(request);
        let open = |topic| self.requests(topic, plot).into_iter().flatten().find(is_open);
        command.needs.split(' ').find_map(|need| match need {
            "cycles-at-present" => self.request(Topic::Cycles, plot).filter(is_open),
            "motion-over-time" if self.plots[plot].view == View::TimeSeries => {
                open(Topic::Trajectory)
            }
            "window" => windows::awaited(self, plot),
            "everything" => {
                let mut wants = self.wants().into_iter();
                wants.find(|request| !request.is_long() && is_open(request))
            }
            topic => TOPICS.iter().find(|known| known.name() == topic).copied().and_then(open),
        })
    }
}

/// Whether a message cancels the press that waits.
pub fn forgets(message: &Msg) -> bool {
    matches!(message, Msg::Key(key) if *key == Key::plain(Code::Esc))
}

impl Session {
    /// The contexts that hold at present, the most specific first: one of the chains of
    /// [`CONTEXTS`](crate::session::state::keymap::CONTEXTS).
    pub fn contexts(&self) -> &'static [Context] {
        match self.pending {
            Some(pending) => &pending.context().spec().chain,
            None => self.contexts_at_rest(),
        }
    }

    /// The contexts that hold when nothing is pending.
    pub(crate) fn contexts_at_rest(&self) -> &'static [Context] {
        self.contexts_in(self.overlay.as_ref())
    }

    /// The contexts that hold where this is open.
    pub(crate) fn contexts_in(&self, overlay: Option<&Overlay>) -> &'static [Context] {
        let first = match overlay {
            None => return self.contexts_below(),
            Some(Overlay::Help(_)) => Context::Page,
            Some(Overlay::List(ListKind::Palette, list)) if list.searching => Context::Palette,
            Some(Overlay::List(_, list)) if list.searching => Context::Search,
            Some(Overlay::List(ListKind::Cost, _)) => Context::List(ListKind::Palette),
            Some(Overlay::List(kind, _)) => Context::List(*kind),
            Some(Overlay::Prompt(Prompt { row: Some(_), .. })) => Context::Entry,
            Some(Overlay::Prompt(_)) => Context::Prompt,
            Some(Overlay::Offer(_)) => Context::Offer,
            Some(Overlay::Explanation(_)) => Context::Explanation,
        };
        &first.spec().chain
    }

    /// The contexts that hold when nothing is open.
    pub(crate) fn contexts_below(&self) -> &'static [Context] {
        let first = match self.focused() {
            _ if self.held.is_some() => Context::Walk,
            Some(plot) => Context::View(plot.view),
            None => Context::Parameters,
        };
        if self.kicking {
            &first.spec().kicked
        } else {
            &first.spec().chain
        }
    }

    /// Whether a key has its usual effect while the caption of a tour is shown: the caption names its command,
    /// or an overlay that such a key has opened takes it.
    pub fn tries(&self, key: Key) -> bool {
        let (SessionCaption::Tour(text, _) | SessionCaption::Asked(text, ..)) = &self.caption
        else {
            return false;
        };
        let named = |command: &Command| text.contains(&format!("{{{}}}", command.name));
        self.overlay.is_some()
            || self.pending.is_some()
            || self.keymap.command(self.contexts(), key).is_some_and(named)
    }

    /// Whether a question of a lesson is open: until it is answered, nothing tells what becomes of the motion.
    pub fn is_asked(&self) -> bool {
        matches!(self.caption, SessionCaption::Asked(.., Some(_)))
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
        let contexts = self.contexts();
        for context in contexts {
            for command in self.keymap.commands().filter(|command| !command.hint.is_empty()) {
                // A finished scan cannot be paused.
                let over = command.name == "scan-pause" && self.scan_request().is_none();
                let key = self.keymap.keys_in(*context, command).next().filter(|_| !over);
                // While a kick is tried, its keys have no other meaning.
                let own = |key: &Key| self.keymap.command(contexts, *key) == Some(command);
                let Some(key) = key.filter(own).filter(|_| shown.insert(command.name)) else {
                    continue;
                };
                let first = command.name == "edit" && self.scene.next.is_some();
                let text = if first { "goes deeper" } else { command.hint };
                match hints.iter_mut().find(|hint| hint.text == text) {
                    Some(hint) => hint.keys.push(key),
                    None => hints.push(Hint { keys: vec![key], text }),
                }
            }
        }
        hints
    }
}

/// An entry of the footer.
#[derive(Clone, Debug)]
pub struct Hint {
    /// The keys of the commands that share the word.
    pub keys: Vec<Key>,
    pub text: &'static str,
}

/// The pane in which a command applies, if that is not the one in focus. Fails with the context that is
/// missing.
pub(crate) fn place(session: &Session, command: &Command) -> Result<Option<Pane>, Context> {
    let here = session.contexts();
    let mut places = command.contexts();
    if places.clone().any(|place| here.contains(&place)) {
        return Ok(None);
    }
    let pane = places.clone().find_map(|place| pane(session, place));
    match (pane, places.clone().next()) {
        (None, Some(place)) if places.all(|place| lacks(session, place)) => Err(place),
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
            session.on_show().find(|index| session.plots[*index].view == view).map(Pane::Plot)
        }
    }
}

/// Whether a context needs something that is missing: an open line or list, a held branch, or a view.
fn lacks(session: &Session, context: Context) -> bool {
    context.is_overlay()
        || matches!(context, Context::Walk | Context::Kick)
        || (context.view().is_some() && pane(session, context).is_none())
}
