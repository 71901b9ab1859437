//! The contexts in which keys have their meanings. Several hold at once: a plot, the phase plane, everywhere.

use std::sync::LazyLock;

use crate::scene::{VIEWS, View};
use crate::session::Listed;

/// A context in which a key can have a meaning.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Context {
    /// The focus is on the parameter pane.
    Parameters,
    /// The focus is on a plot that shows this view.
    View(View),
    /// A point of the branch is held.
    Walk,
    /// The focus is on a plot.
    Plots,
    /// No overlay is open.
    Everywhere,
    /// This list is open and not being searched; that of the costs has the keys of the palette.
    List(Listed),
    /// The palette is being searched.
    Palette,
    /// A count is being typed before a key.
    Count,
    /// The next key is the letter of a mark.
    Letter,
    /// Some list is open.
    Lists,
    /// The search of a list is being typed.
    Search,
    /// A value is being typed.
    Entry,
    /// A command is being typed.
    Prompt,
    /// A pasted keystroke file waits for a yes.
    Offer,
    Always,
}

/// The kind of a context, which decides on the others that hold with it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum ContextKind {
    /// A pane that is not an ordinary plot.
    Pane,
    Plot,
    /// A point of the branch is held.
    Held,
    List,
    /// A line in which characters are typed.
    Text,
    /// A question that is answered by one key.
    Question,
    Shared,
    /// Holds with every list.
    SharedByLists,
}

/// The description of a context.
#[derive(Clone, Copy, Debug)]
pub struct ContextSpec {
    pub context: Context,
    /// Its name in settings files.
    pub name: &'static str,
    /// A heading for its keys.
    pub title: &'static str,
    kind: ContextKind,
}

const fn row(
    context: Context,
    name: &'static str,
    title: &'static str,
    kind: ContextKind,
) -> ContextSpec {
    ContextSpec { context, name, title, kind }
}

/// All contexts other than those of the views.
#[rustfmt::skip]
const OTHERS: [ContextSpec; 19] = [
    row(Context::Parameters, "parameters", "Parameters", ContextKind::Pane),
    row(Context::Walk, "walk", "Walking along the branch", ContextKind::Held),
    row(Context::Plots, "plots", "Every plot", ContextKind::Shared),
    row(Context::Everywhere, "everywhere", "Everywhere", ContextKind::Shared),
    row(Context::List(Listed::Palette), "help", "In this list", ContextKind::List),
    row(Context::List(Listed::Scenes), "scenes", "In the scene picker", ContextKind::List),
    row(Context::List(Listed::Layers), "layers", "In the layer list", ContextKind::List),
    row(Context::List(Listed::Views), "views", "In the picker of views", ContextKind::List),
    row(Context::List(Listed::Paper), "paper", "In the list of claims", ContextKind::List),
    row(Context::List(Listed::Interrupted), "interrupted", "In the list of interrupted sessions", ContextKind::List),
    row(Context::Palette, "palette", "While searching the list", ContextKind::Text),
    row(Context::Count, "count", "After a count", ContextKind::Question),
    row(Context::Letter, "letter", "Before the letter of a mark", ContextKind::Question),
    row(Context::Lists, "lists", "In every list", ContextKind::SharedByLists),
    row(Context::Search, "search", "While searching", ContextKind::Text),
    row(Context::Entry, "entry", "While typing a value", ContextKind::Text),
    row(Context::Prompt, "prompt", "On the command line", ContextKind::Text),
    row(Context::Offer, "offer", "After pasting keystrokes", ContextKind::Question),
    row(Context::Always, "always", "At any time", ContextKind::Shared),
];

/// All contexts; those of the views come after the first one.
pub fn contexts() -> impl Iterator<Item = ContextSpec> {
    let views = VIEWS.iter().map(|row| Context::View(row.view).spec());
    OTHERS[..1].iter().copied().chain(views).chain(OTHERS[1..].iter().copied())
}

impl Context {
    fn spec(self) -> ContextSpec {
        if let Context::View(view) = self {
            let kind = if view == View::Scan { ContextKind::Pane } else { ContextKind::Plot };
            return row(self, view.spec().name, view.spec().heading, kind);
        }
        let own = |row: &&ContextSpec| row.context == self;
        *OTHERS.iter().find(own).expect("every other context has its row")
    }

    /// The name in settings files.
    pub fn name(self) -> &'static str {
        self.spec().name
    }

    /// A heading for the keys of this context.
    pub fn title(self) -> &'static str {
        self.spec().title
    }

    /// Whether characters that are no commands are typed into a line.
    pub fn takes_text(self) -> bool {
        self.spec().kind == ContextKind::Text
    }

    /// Whether this context holds only while something is open or awaited.
    pub fn is_overlay(self) -> bool {
        matches!(
            self.spec().kind,
            ContextKind::List
                | ContextKind::Text
                | ContextKind::Question
                | ContextKind::SharedByLists
        )
    }

    /// The view that must have the focus for this context to hold; `None` if it depends on no view.
    pub fn view(self) -> Option<View> {
        if let Context::View(view) = self { Some(view) } else { None }
    }
}

/// All sets of contexts that hold together, each with the most specific context first.
pub fn chains() -> &'static [Vec<Context>] {
    static CHAINS: LazyLock<Vec<Vec<Context>>> = LazyLock::new(|| {
        let others: fn(ContextKind) -> Option<&'static [Context]> = |kind| match kind {
            ContextKind::Plot => Some(&[Context::Plots, Context::Everywhere, Context::Always]),
            ContextKind::Pane => Some(&[Context::Everywhere, Context::Always]),
            ContextKind::List => Some(&[Context::Lists, Context::Always]),
            ContextKind::Held | ContextKind::Text | ContextKind::Question => {
                Some(&[Context::Always])
            }
            ContextKind::Shared | ContextKind::SharedByLists => None,
        };
        let chain = |row: ContextSpec| Some([&[row.context], others(row.kind)?].concat());
        contexts().filter_map(chain).collect()
    });
    &CHAINS
}

/// The contexts that hold together with this one, which is the most specific of them.
pub fn chain(first: Context) -> &'static [Context] {
    let chains = chains();
    chains.iter().find(|chain| chain[0] == first).unwrap_or(&chains[0])
}
