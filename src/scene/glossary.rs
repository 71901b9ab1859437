//! The glossary: what everything that has a name on the screen is, told once.

use std::sync::LazyLock;

use crate::numerics::cells;

/// What has a definition: a line of `assets/glossary.txt`, which says what each field is.
#[derive(Debug, PartialEq)]
pub struct GlossaryEntry {
    pub name: &'static str,
    explains: &'static str,
    /// Other words by which it is found, between commas.
    pub words: &'static str,
    pub definition: &'static str,
    pub formula: &'static str,
    pub unit: &'static str,
    /// Where to read on: pages, and other entries.
    pub further: &'static str,
}

/// Every entry, in the order of the file.
pub static GLOSSARY: LazyLock<Vec<GlossaryEntry>> =
    LazyLock::new(|| include_str!("../../assets/glossary.txt").lines().filter_map(entry).collect());

/// The entry that a line of the file describes; `None` for a comment. A test reads every line.
fn entry(line: &'static str) -> Option<GlossaryEntry> {
    let told = |text: &'static str| if text == "-" { "" } else { text };
    let [name, explains, words, definition, formula, unit, further] = cells(line)?.map(told);
    Some(GlossaryEntry { name, explains, words, definition, formula, unit, further })
}

impl GlossaryEntry {
    /// The entry that explains a thing of some kind: its own, or that of the word that it is called.
    pub fn of(kind: &str, name: &str) -> Option<&'static Self> {
        let mut kinds = [kind, "word"].into_iter();
        kinds.find_map(|kind| GLOSSARY.iter().find(|entry| entry.texts(kind).any(|it| it == name)))
    }

    /// What it explains of a kind; a word is also its name.
    pub fn texts(&self, kind: &str) -> impl Iterator<Item = &'static str> {
        let own = (kind == "word").then_some(self.name);
        let of_kind = move |thing: &'static str| thing.strip_prefix(kind)?.strip_prefix(' ');
        own.into_iter().chain(self.explains.split("; ").filter_map(of_kind))
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;
    use crate::model::{KNOBS, Knob};
    use crate::scan::MEASURES;
    use crate::scene::{LAYERS, VIEWS};

    #[test]
    fn every_line_of_the_file_is_read_and_explains_what_no_other_does() {
        let lines = include_str!("../../assets/glossary.txt").lines();
        let told: Vec<_> = lines.filter(|line| line.contains(" | ")).collect();
        assert_eq!(GLOSSARY.len(), told.len());
        let (mut names, mut things) = (BTreeSet::new(), BTreeSet::new());
        for entry in GLOSSARY.iter() {
            assert!(names.insert(entry.name), "{} twice", entry.name);
            assert!(!entry.definition.is_empty(), "{}", entry.name);
            for thing in entry.explains.split("; ").filter(|it| !it.is_empty()) {
                assert!(things.insert(thing), "{thing} twice");
            }
            // A number may be unknown: the part with it is then left out.
            let outside = entry.formula.split('[').map(|part| part.split(']').next_back());
            assert!(
                outside
                    .flatten()
                    .all(|part| !part.contains('{') || part.len() == entry.formula.len())
            );
        }
    }

    #[test]
    fn everything_in_the_tables_has_its_entry() {
        let lacks = |kind: &str, name: &str| GlossaryEntry::of(kind, name).is_none();
        let numbers = KNOBS.iter().filter(|row| lacks("number", row.symbol)).map(|row| row.symbol);
        let views = VIEWS.iter().filter(|row| lacks("word", row.title)).map(|row| row.title);
        let layers = LAYERS.iter().filter(|row| lacks("layer", row.name)).map(|row| row.name);
        let measures = MEASURES.iter().filter(|row| lacks("measure", row.name));
        let columns = MEASURES.iter().flat_map(|row| &row.columns).copied();
        let columns = columns.filter(|column| lacks("line", column));
        let open = numbers.chain(views).chain(layers).chain(columns);
        let open: Vec<&str> = open.chain(measures.map(|row| row.name)).collect();
        assert_eq!(open, Vec::<&str>::new());
        assert_eq!(GlossaryEntry::of("number", Knob::R.spec().symbol).unwrap().name, "r");
    }
}
