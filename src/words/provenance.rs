//! Where an output comes from: the program, its version and revision, and the command line.

use serde::{Deserialize, Serialize};

/// What computed an output, and how to compute it again.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Provenance {
    /// Name of the program.
    pub program: String,
    pub version: String,
    /// The revision of its source, where the build knew it: from git, or from `HOPFSCOPE_REVISION`.
    pub revision: Option<String>,
    /// The command line, quoted for a POSIX shell.
    pub command: String,
}

impl Provenance {
    /// The provenance of what this build writes when called with these arguments.
    pub fn of(arguments: &[String]) -> Self {
        let program = env!("CARGO_PKG_NAME");
        Provenance {
            program: program.to_owned(),
            version: env!("CARGO_PKG_VERSION").to_owned(),
            revision: option_env!("HOPFSCOPE_REVISION").map(str::to_owned),
            command: format!("{program} {}", quoted(arguments)),
        }
    }

    /// Adds the field `provenance` to a JSON object; returns any other document unchanged.
    ///
    /// # Panics
    /// Never: a struct of strings can always be written.
    pub fn within(&self, document: &str) -> String {
        let Some(fields) = document.strip_suffix("}\n").filter(|it| it.starts_with('{')) else {
            return document.to_owned();
        };
        let own = match serde_json::to_string(self) {
            Ok(own) => own,
            Err(error) => unreachable!("strings cannot be written: {error}"),
        };
        let comma = if fields == "{" { "" } else { "," };
        format!("{fields}{comma}\"provenance\":{own}}}\n")
    }

    /// The program and its version, with the revision if it is known.
    pub fn build(&self) -> String {
        let revision = self.revision.as_ref().map(|revision| format!(" ({revision})"));
        format!("{} {}{}", self.program, self.version, revision.unwrap_or_default())
    }

    /// The arguments of the command line; `None` if [`quoted`] did not write it.
    pub fn arguments(&self) -> Option<Vec<String>> {
        let mut words = unquoted(&self.command)?.into_iter();
        words.next().filter(|program| *program == self.program)?;
        Some(words.collect())
    }
}

/// Words as one line for a POSIX shell, with quotes around those that need them.
pub fn quoted(words: &[String]) -> String {
    let plain = |char: char| char.is_ascii_alphanumeric() || "-_=+.,:/@%".contains(char);
    let quoted = |word: &String| {
        if !word.is_empty() && word.chars().all(plain) {
            word.clone()
        } else {
            format!("'{}'", word.replace('\'', r"'\''"))
        }
    };
    words.iter().map(quoted).collect::<Vec<_>>().join(" ")
}

/// The words of a line that [`quoted`] wrote; `None` if a quote is not closed.
fn unquoted(line: &str) -> Option<Vec<String>> {
    let mut words = Vec::new();
    let mut word: Option<String> = None;
    let mut chars = line.chars();
    while let Some(char) = chars.next() {
        match char {
            ' ' => words.extend(word.take()),
            '\'' => {
                let word = word.get_or_insert_default();
                loop {
                    match chars.next()? {
                        '\'' => break,
                        char => word.push(char),
                    }
                }
            }
            '\\' => word.get_or_insert_default().push(chars.next()?),
            char => word.get_or_insert_default().push(char),
        }
    }
    words.extend(word);
    Some(words)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    #[test]
    fn only_what_a_shell_would_change_is_quoted() {
        let words = ["scan", "--over", "D=-0.9:0:200", "a b", "it's", ""].map(str::to_owned);
        let line = Provenance::of(&words).command;
        assert_eq!(line, r"hopfscope scan --over D=-0.9:0:200 'a b' 'it'\''s' ''");
        let torn = Provenance { command: "hopfscope 'a".to_owned(), ..Provenance::of(&[]) };
        assert_eq!(torn.arguments(), None);
    }

    #[test]
    fn a_document_keeps_its_fields_and_says_where_it_comes_from() {
        let own = Provenance::of(&["cycles".to_owned()]);
        for document in ["{\"a\":[1.0,{\"b\":null}]}\n", "{}\n"] {
            let told: serde_json::Value = serde_json::from_str(&own.within(document)).unwrap();
            assert_eq!(told["provenance"]["command"], "hopfscope cycles", "{told}");
            let mut plain = told.clone();
            plain.as_object_mut().unwrap().remove("provenance");
            assert_eq!(plain.to_string() + "\n", document);
        }
        assert_eq!(own.within("[1]\n"), "[1]\n");
    }

    proptest! {
        #[test]
        fn the_arguments_come_back_from_the_line(words in proptest::collection::vec(".*", 0..5)) {
            prop_assert_eq!(Provenance::of(&words).arguments(), Some(words));
        }
    }
}
