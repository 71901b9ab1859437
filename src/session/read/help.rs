//! The page of help: the keys that matter where the focus is, and what is on show there. `assets/help.txt` says which; the
//! keys are those of the keymap.

use crate::numerics::cells;
use crate::session::{Context, Hint, Overlay, Session};
use crate::words::joined;

/// Most lines of keys: they fit on the smallest screen that this is designed for.
const MOST: usize = 10;

impl Session {
    /// The contexts that the page of help is about; `None` if it is not open.
    pub fn helped(&self) -> Option<&'static [Context]> {
        let Some(Overlay::Help(below)) = &self.overlay else { return None };
        Some(self.contexts_in(below.as_deref()))
    }

    /// The keys that matter in these contexts, with what they do.
    pub fn help_rows(&self, contexts: &[Context]) -> Vec<Hint> {
        let key = |name: &str| {
            let command = self.keymap.named(name)?;
            contexts.iter().find_map(|at| self.keymap.keys_in(*at, command).next())
        };
        let lines = contexts.iter().flat_map(|at| lines(*at));
        let rows = lines.map(|(commands, text)| Hint {
            keys: commands.split(' ').filter_map(key).collect(),
            text,
        });
        rows.filter(|row| !row.keys.is_empty()).take(MOST).collect()
    }

    /// What is on show where these contexts hold.
    pub fn help_about(&self, contexts: &[Context]) -> String {
        let told = lines(contexts[0]).find(|(commands, _)| *commands == "-");
        let Some(view) =
            contexts.iter().find_map(|context| context.view()).filter(|_| told.is_none())
        else {
            return told.map_or("", |(_, text)| text).to_owned();
        };
        let layers = self.layers.iter().map(|layer| layer.spec());
        let drawn = joined(layers.filter(|it| it.view == view).map(|it| it.name), ", ");
        format!("{}; layers: {drawn}", view.spec().meaning)
    }
}

/// The lines of a context: commands and text.
fn lines(context: Context) -> impl Iterator<Item = (&'static str, &'static str)> {
    let lines = include_str!("../../../assets/help.txt").lines().filter_map(cells);
    lines.filter_map(move |[name, commands, text]| {
        (name == context.spec().name).then_some((commands, text))
    })
}
