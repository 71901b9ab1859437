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

/// The description of a context.
#[derive(Clone, Copy, Debug)]
pub struct ContextSpec {
    pub context: Context,
    /// Its name in settings files.
    pub name: &'static str,
    /// A heading for its keys.
    pub title: &'static str,
    /// The contexts that hold with it where it is the most specific; `None` if it never is.
    others: Option<&'static [Context]>,
}

const fn row(
    context: Context,
    name: &'static str,
    title: &'static str,
    others: Option<&'static [Context]>,
) -> ContextSpec {
    ContextSpec { context, name, title, others }
}

/// What holds with a pane that is no ordinary plot, with a plot, with a list, and with what takes all other keys.
const PANE: Option<&[Context]> = Some(&[Context::Everywhere, Context::Always]);
const PLOT: Option<&[Context]> = Some(&[Context::Plots, Context::Everywhere, Context::Always]);
const LIST: Option<&[Context]> = Some(&[Context::Lists, Context::Always]);
const ALONE: Option<&[Context]> = Some(&[Context::Always]);

/// All contexts other than those of the views.
#[rustfmt::skip]
const OTHERS: [ContextSpec; 19] = [
    row(Context::Parameters, "parameters", "Parameters", PANE),
    row(Context::Walk, "walk", "Walking along the branch", ALONE),
    row(Context::Plots, "plots", "Every plot", None),
    row(Context::Everywhere, "everywhere", "Everywhere", None),
    row(Context::List(Listed::Palette), "help", "In this list", LIST),
    row(Context::List(Listed::Scenes), "scenes", "In the scene picker", LIST),
    row(Context::List(Listed::Layers), "layers", "In the layer list", LIST),
    row(Context::List(Listed::Views), "views", "In the picker of views", LIST),
    row(Context::List(Listed::Paper), "paper", "In the list of claims", LIST),
    row(Context::List(Listed::Interrupted), "interrupted", "In the list of interrupted sessions", LIST),
    row(Context::Palette, "palette", "While searching the list", ALONE),
    row(Context::Count, "count", "After a count", ALONE),
    row(Context::Letter, "letter", "Before the letter of a mark", ALONE),
    row(Context::Lists, "lists", "In every list", None),
    row(Context::Search, "search", "While searching", ALONE),
    row(Context::Entry, "entry", "While typing a value", ALONE),
    row(Context::Prompt, "prompt", "On the command line", ALONE),
    row(Context::Offer, "offer", "After pasting keystrokes", ALONE),
    row(Context::Always, "always", "At any time", None),
];

/// All contexts; those of the views come after the first one.
pub fn contexts() -> impl Iterator<Item = ContextSpec> {
    let views = VIEWS.iter().map(|row| Context::View(row.view).spec());
    OTHERS[..1].iter().copied().chain(views).chain(OTHERS[1..].iter().copied())
}

impl Context {
    fn spec(self) -> ContextSpec {
        if let Context::View(view) = self {
            let others = if view == View::Scan { PANE } else { PLOT };
            return row(self, view.spec().name, view.spec().heading, others);
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
        matches!(self, Context::Palette | Context::Search | Context::Entry | Context::Prompt)
    }

    /// Whether this context holds only while something is open or awaited.
    pub fn is_overlay(self) -> bool {
        let of_panes = matches!(self, Context::Parameters | Context::View(_) | Context::Walk);
        !(of_panes || matches!(self, Context::Plots | Context::Everywhere | Context::Always))
    }

    /// The view that must have the focus for this context to hold; `None` if it depends on no view.
    pub fn view(self) -> Option<View> {
        if let Context::View(view) = self { Some(view) } else { None }
    }
}

/// All sets of contexts that hold together, each with the most specific context first.
pub fn chains() -> &'static [Vec<Context>] {
    static CHAINS: LazyLock<Vec<Vec<Context>>> = LazyLock::new(|| {
        let chain = |row: ContextSpec| Some([&[row.context], row.others?].concat());
        contexts().filter_map(chain).collect()
    });
    &CHAINS
}

/// The contexts that hold together with this one, which is the most specific of them.
pub fn chain(first: Context) -> &'static [Context] {
    let chains = chains();
    chains.iter().find(|chain| chain[0] == first).unwrap_or(&chains[0])
}
