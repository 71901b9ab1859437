//! Which key means which command, and where.
//!
//! A [`Keymap`] is built from the default keys of [`COMMANDS`]. Several contexts hold at once (a plot,
//! the phase plane, everywhere); no key may have two meanings in contexts that can hold together.

use std::collections::{BTreeMap, BTreeSet};

use super::command::{COMMANDS, Command, command};
use super::key::Key;
use super::overlay::{Listed, Overlay};
use super::pending::Pending;
use super::state::Session;
use crate::scene::View;

/// Where a key has its meaning.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Context {
    /// The focus is on the parameter pane.
    Parameters,
    /// The focus is on the phase plane.
    Phase,
    /// The focus is on the diagram.
    Diagram,
    /// The focus is on the time series.
    TimeSeries,
    /// The focus is on the energy ledger.
    EnergyLedger,
    /// The focus is on the return map.
    ReturnMap,
    /// The focus is on a chart of regimes.
    Regimes,
    /// The focus is on the trade of error for cost.
    Trade,
    /// The focus is on the mass on its belt.
    Belt,
    /// The focus is on the rate of the energy.
    EnergyRate,
    /// The focus is on the eigenvalues.
    Eigenvalues,
    /// The focus is on a scan.
    Scan,
    /// A point of the branch is held.
    Walk,
    /// The focus is on a plot.
    Plots,
    /// No overlay is open.
    Everywhere,
    /// The help is open.
    Help,
    /// The scene picker is open.
    Scenes,
    /// The layer list is open.
    Layers,
    /// The picker of views is open.
    Views,
    /// The claims of the paper are open.
    Paper,
    /// The palette is open.
    Palette,
    /// A count is being typed before a key.
    Count,
    /// The letter of a register or mark is waited for.
    Letter,
    /// Some list is open.
    Lists,
    /// The search of a list is being typed.
    Search,
    /// A value is being typed.
    Entry,
    /// A command is being typed.
    Prompt,
    /// A scan is being typed.
    Form,
    /// A pasted keystroke file waits for a yes.
    Offer,
    /// Whatever is open.
    Always,
}

/// Every context with its name in settings files.
pub const CONTEXTS: [(Context, &str); 30] = [
    (Context::Parameters, "parameters"),
    (Context::Phase, "phase"),
    (Context::Diagram, "diagram"),
    (Context::TimeSeries, "time-series"),
    (Context::EnergyLedger, "energy-ledger"),
    (Context::ReturnMap, "return-map"),
    (Context::Regimes, "regimes"),
    (Context::Trade, "trade"),
    (Context::Belt, "belt"),
    (Context::EnergyRate, "energy-rate"),
    (Context::Eigenvalues, "eigenvalues"),
    (Context::Scan, "scan"),
    (Context::Form, "form"),
    (Context::Walk, "walk"),
    (Context::Plots, "plots"),
    (Context::Everywhere, "everywhere"),
    (Context::Help, "help"),
    (Context::Scenes, "scenes"),
    (Context::Layers, "layers"),
    (Context::Views, "views"),
    (Context::Paper, "paper"),
    (Context::Palette, "palette"),
    (Context::Count, "count"),
    (Context::Letter, "letter"),
    (Context::Lists, "lists"),
    (Context::Search, "search"),
    (Context::Entry, "entry"),
    (Context::Prompt, "prompt"),
    (Context::Offer, "offer"),
    (Context::Always, "always"),
];

impl Context {
    /// The name in settings files.
    #[must_use]
    pub fn name(self) -> &'static str {
        CONTEXTS.iter().find(|(context, _)| *context == self).map_or("", |(_, name)| name)
    }

    /// A heading for the keys of this context.
    #[must_use]
    pub fn title(self) -> &'static str {
        match self {
            Context::Parameters => "Parameters",
            Context::Phase => "Phase plane",
            Context::Diagram => "Bifurcation diagram",
            Context::TimeSeries => "Time series",
            Context::EnergyLedger => "Energy ledger",
            Context::ReturnMap => "Return map",
            Context::Regimes => "Chart of regimes",
            Context::Trade => "Trade of error for cost",
            Context::Belt => "Mass on its belt",
            Context::EnergyRate => "Rate of the energy",
            Context::Eigenvalues => "Eigenvalues",
            Context::Scan => "Scan",
            Context::Form => "While typing a scan",
            Context::Walk => "Walking along the branch",
            Context::Plots => "Every plot",
            Context::Everywhere => "Everywhere",
            Context::Help => "In this help and the list of costs",
            Context::Scenes => "In the scene picker",
            Context::Layers => "In the layer list",
            Context::Views => "In the picker of views",
            Context::Paper => "In the list of claims",
            Context::Palette => "In the palette",
            Context::Count => "After a count",
            Context::Letter => "Before the letter of a register or mark",
            Context::Lists => "In every list",
            Context::Search => "While searching",
            Context::Entry => "While typing a value",
            Context::Prompt => "On the command line",
            Context::Offer => "After pasting keystrokes",
            Context::Always => "At any time",
        }
    }

    /// Whether characters without a command are typed into a line.
    #[must_use]
    pub fn takes_text(self) -> bool {
        matches!(
            self,
            Context::Search | Context::Palette | Context::Entry | Context::Prompt | Context::Form
        )
    }

    /// Whether this holds only while something is open or waited for.
    #[must_use]
    pub fn is_overlay(self) -> bool {
        match self {
            Context::Help
            | Context::Scenes
            | Context::Layers
            | Context::Views
            | Context::Paper
            | Context::Palette
            | Context::Count
            | Context::Letter
            | Context::Lists
            | Context::Search
            | Context::Entry
            | Context::Prompt
            | Context::Form
            | Context::Offer => true,
            Context::Parameters
            | Context::Phase
            | Context::Diagram
            | Context::TimeSeries
            | Context::EnergyLedger
            | Context::ReturnMap
            | Context::Regimes
            | Context::Trade
            | Context::Belt
            | Context::EnergyRate
            | Context::Eigenvalues
            | Context::Scan
            | Context::Walk
            | Context::Plots
            | Context::Everywhere
            | Context::Always => false,
        }
    }

    /// The view that must have the focus for this to hold, if it is about one.
    #[must_use]
    pub fn view(self) -> Option<View> {
        match self {
            Context::Phase => Some(View::Phase),
            Context::Diagram => Some(View::Diagram),
            Context::TimeSeries => Some(View::TimeSeries),
            Context::EnergyLedger => Some(View::EnergyLedger),
            Context::ReturnMap => Some(View::ReturnMap),
            Context::Regimes => Some(View::Regimes),
            Context::Trade => Some(View::Trade),
            Context::Belt => Some(View::Belt),
            Context::EnergyRate => Some(View::EnergyRate),
            Context::Eigenvalues => Some(View::Eigenvalues),
            Context::Scan => Some(View::Scan),
            _ => None,
        }
    }
}

/// Every set of contexts that can hold together, the most specific first.
pub const CHAINS: [&[Context]; 26] = [
    &[Context::Parameters, Context::Everywhere, Context::Always],
    &[Context::Phase, Context::Plots, Context::Everywhere, Context::Always],
    &[Context::Diagram, Context::Plots, Context::Everywhere, Context::Always],
    &[Context::TimeSeries, Context::Plots, Context::Everywhere, Context::Always],
    &[Context::EnergyLedger, Context::Plots, Context::Everywhere, Context::Always],
    &[Context::ReturnMap, Context::Plots, Context::Everywhere, Context::Always],
    &[Context::Belt, Context::Plots, Context::Everywhere, Context::Always],
    &[Context::Regimes, Context::Plots, Context::Everywhere, Context::Always],
    &[Context::Trade, Context::Plots, Context::Everywhere, Context::Always],
    &[Context::EnergyRate, Context::Plots, Context::Everywhere, Context::Always],
    &[Context::Eigenvalues, Context::Plots, Context::Everywhere, Context::Always],
    &[Context::Scan, Context::Everywhere, Context::Always],
    &[Context::Walk, Context::Always],
    &[Context::Help, Context::Lists, Context::Always],
    &[Context::Scenes, Context::Lists, Context::Always],
    &[Context::Layers, Context::Lists, Context::Always],
    &[Context::Views, Context::Lists, Context::Always],
    &[Context::Paper, Context::Lists, Context::Always],
    &[Context::Palette, Context::Always],
    &[Context::Count, Context::Always],
    &[Context::Letter, Context::Always],
    &[Context::Search, Context::Always],
    &[Context::Entry, Context::Always],
    &[Context::Prompt, Context::Always],
    &[Context::Form, Context::Always],
    &[Context::Offer, Context::Always],
];

/// The contexts that hold together with this one, which is the most specific.
fn chain(first: Context) -> &'static [Context] {
    CHAINS.into_iter().find(|chain| chain[0] == first).unwrap_or(CHAINS[0])
}

impl Session {
    /// The contexts that hold now, the most specific first: one of [`CHAINS`].
    #[must_use]
    pub fn contexts(&self) -> &'static [Context] {
        match self.pending {
            Some(Pending::Count(_)) => chain(Context::Count),
            Some(Pending::Letter { .. }) => chain(Context::Letter),
            None => self.contexts_at_rest(),
        }
    }

    /// The same when nothing is pending.
    pub(super) fn contexts_at_rest(&self) -> &'static [Context] {
        let first = match &self.overlay {
            None if self.held.is_some() => Context::Walk,
            None => match self.focused().map(|plot| plot.view) {
                None => Context::Parameters,
                Some(View::Phase) => Context::Phase,
                Some(View::Diagram) => Context::Diagram,
                Some(View::TimeSeries) => Context::TimeSeries,
                Some(View::EnergyLedger) => Context::EnergyLedger,
                Some(View::ReturnMap) => Context::ReturnMap,
                Some(View::Regimes) => Context::Regimes,
                Some(View::Trade) => Context::Trade,
                Some(View::Belt) => Context::Belt,
                Some(View::EnergyRate) => Context::EnergyRate,
                Some(View::Eigenvalues) => Context::Eigenvalues,
                Some(View::Scan) => Context::Scan,
            },
            Some(Overlay::List(Listed::Palette, _)) => Context::Palette,
            Some(overlay) if overlay.list().is_some_and(|list| list.searching) => Context::Search,
            // Both are read and closed; neither is chosen from.
            Some(Overlay::List(Listed::Help | Listed::Cost, _)) => Context::Help,
            Some(Overlay::List(Listed::Scenes, _)) => Context::Scenes,
            Some(Overlay::List(Listed::Layers, _)) => Context::Layers,
            Some(Overlay::List(Listed::Views, _)) => Context::Views,
            Some(Overlay::List(Listed::Paper, _)) => Context::Paper,
            Some(Overlay::Entry(_)) => Context::Entry,
            Some(Overlay::Prompt(_)) => Context::Prompt,
            Some(Overlay::Scan(_)) => Context::Form,
            Some(Overlay::Offer(_)) => Context::Offer,
        };
        chain(first)
    }

    /// Whether a key means something now, or is typed.
    pub(super) fn means(&self, key: Key) -> bool {
        let contexts = self.contexts();
        self.keymap.command(contexts, key).is_some() || contexts[0].takes_text()
    }

    /// The keys that matter now, with a word each: for the footer.
    #[must_use]
    pub fn hints(&self) -> Vec<Hint> {
        let mut hints: Vec<Hint> = Vec::new();
        let mut shown = BTreeSet::new();
        for context in self.contexts() {
            for command in COMMANDS.iter().filter(|command| !command.hint.is_empty()) {
                let Some(key) = self.keymap.keys_in(*context, command).next() else { continue };
                if !shown.insert(command.name) {
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

/// What to press for what, in the footer.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Hint {
    /// The keys, one for each command that the word stands for.
    pub keys: Vec<Key>,
    /// The word.
    pub text: &'static str,
}

/// What a key means.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Binding {
    command: &'static Command,
    /// Where the key stands among those of the command.
    rank: usize,
}

/// Which key means which command in each context.
#[derive(Clone, Debug, PartialEq)]
pub struct Keymap {
    bindings: BTreeMap<(Context, Key), Binding>,
}

impl Default for Keymap {
    /// The default keys of every command.
    fn default() -> Self {
        let mut bindings = BTreeMap::new();
        for command in COMMANDS {
            for (context, keys) in command.keys {
                let keys = keys.iter().filter_map(|text| text.parse().ok()).enumerate();
                bindings
                    .extend(keys.map(|(rank, key)| ((*context, key), Binding { command, rank })));
            }
        }
        Keymap { bindings }
    }
}

/// Why keys cannot be given to a command.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Unbindable {
    /// A key would mean two things where contexts hold together.
    Clash {
        /// The key.
        key: Key,
        /// The command that has it.
        command: &'static str,
        /// And where.
        context: Context,
    },
    /// A key that types a character cannot be a command where text is typed.
    Types(Key),
}

impl std::fmt::Display for Unbindable {
    fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Unbindable::Clash { key, command, context } => {
                let context = context.name();
                write!(
                    out,
                    "{key} already means {command}; give that other keys in [keys.{context}] first"
                )
            }
            Unbindable::Types(key) => {
                write!(out, "{key} types a character here; use a key that types none, as <f6>")
            }
        }
    }
}

impl Keymap {
    /// Takes all keys from a command in a context.
    pub fn unbind(&mut self, context: Context, command: &Command) {
        self.bindings.retain(|(at, _), bound| *at != context || bound.command != command);
    }

    /// Gives a key to a command in a context.
    ///
    /// # Errors
    /// [`Unbindable`] if the key means something else where this context holds, or types a character
    /// there.
    pub fn bind(
        &mut self,
        context: Context,
        command: &'static Command,
        key: Key,
    ) -> Result<(), Unbindable> {
        let together = CHAINS.iter().filter(|chain| chain.contains(&context));
        let contexts: BTreeSet<Context> =
            together.flat_map(|chain| chain.iter()).copied().collect();
        if key.typed().is_some() && contexts.iter().any(|context| context.takes_text()) {
            return Err(Unbindable::Types(key));
        }
        let taken = contexts.iter().find_map(|at| Some((*at, *self.bindings.get(&(*at, key))?)));
        if let Some((context, bound)) = taken.filter(|(_, bound)| bound.command != command) {
            return Err(Unbindable::Clash { key, command: bound.command.name, context });
        }
        let rank = self.keys_in(context, command).count();
        self.bindings.entry((context, key)).or_insert(Binding { command, rank });
        Ok(())
    }

    /// What a key means in contexts that hold together.
    #[must_use]
    pub fn command(&self, contexts: &[Context], key: Key) -> Option<&'static Command> {
        let mut bound = contexts.iter().filter_map(|context| self.bindings.get(&(*context, key)));
        bound.next().map(|bound| bound.command)
    }

    /// The keys of a command in a context, in the order in which they were given to it.
    pub fn keys_in(&self, context: Context, command: &Command) -> impl Iterator<Item = Key> {
        let bound = self.bindings.iter();
        let of_it = bound.filter(|((at, _), bound)| *at == context && bound.command == command);
        let mut keys: Vec<(usize, Key)> =
            of_it.map(|((_, key), bound)| (bound.rank, *key)).collect();
        keys.sort_unstable();
        keys.into_iter().map(|(_, key)| key)
    }

    /// The first key of the command with this name, for sentences that say what to press.
    #[must_use]
    pub fn key_of(&self, name: &str) -> Option<Key> {
        let (_, keys) = self.places(command(name)?).into_iter().next()?;
        keys.first().copied()
    }

    /// A sentence in which `{command}` stands for the first key of that command, as `write` names it.
    #[must_use]
    pub fn fill(&self, sentence: &str, write: impl Fn(Key) -> String) -> String {
        let mut filled = String::new();
        let mut rest = sentence;
        while let Some((before, (name, after))) =
            rest.split_once('{').and_then(|(before, rest)| Some((before, rest.split_once('}')?)))
        {
            filled += before;
            match self.key_of(name) {
                Some(key) => filled += &write(key),
                // A command without a key is in the palette under its name.
                None => filled += name,
            }
            rest = after;
        }
        filled + rest
    }

    /// The contexts in which a command has keys, with them.
    #[must_use]
    pub fn places(&self, command: &Command) -> Vec<(Context, Vec<Key>)> {
        let contexts = command.keys.iter().map(|(context, _)| *context);
        contexts
            .map(|context| (context, self.keys_in(context, command).collect::<Vec<_>>()))
            .filter(|(_, keys)| !keys.is_empty())
            .collect()
    }
}
