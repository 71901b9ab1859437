//! Where an output comes from: the program, its version and revision, and the command line.

use serde::{Deserialize, Serialize};

use super::joined;

/// What computed an output, and how to compute it again.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Provenance {
    /// Name of the program.
    pub program: String,
    pub version: String,
    /// The revision of its source, where the build knew it: from git, or from `HOPFSCOPE_REVISION`.
    pub revision: Option<String>,
    /// The command line, quoted for a POSIX shell.
    pub command: String,
    /// For a file of rows, the checksum of those that were written.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub checksum: Option<Checksum>,
}

/// A checksum of the first rows of a file, which shows that one of them was altered. It guards against mishaps,
/// not against forgery.
///
/// As text it always has the same length, so that it can be renewed in place.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(into = "String", try_from = "String")]
pub struct Checksum {
    /// Number of rows.
    pub rows: usize,
    /// The 64-bit FNV-1a hash of their bytes, line ends included.
    hash: u64,
}

impl Checksum {
    /// The checksum of no row: the offset basis of FNV-1a.
    pub const NONE: Checksum = Checksum { rows: 0, hash: 0xcbf2_9ce4_8422_2325 };

    /// The checksum of these rows and one more.
    pub fn and(self, row: &[u8]) -> Checksum {
        /// The prime of FNV-1a.
        const PRIME: u64 = 0x0100_0000_01b3;
        let hash = |hash: u64, byte: &u8| (hash ^ u64::from(*byte)).wrapping_mul(PRIME);
        Checksum { rows: self.rows + 1, hash: row.iter().fold(self.hash, hash) }
    }
}

impl From<Checksum> for String {
    fn from(Checksum { rows, hash }: Checksum) -> String {
        format!("{hash:016x} of {rows:020} rows")
    }
}

impl TryFrom<String> for Checksum {
    type Error = &'static str;

    fn try_from(text: String) -> Result<Self, Self::Error> {
        let read = || {
            let (hash, rows) = text.strip_suffix(" rows")?.split_once(" of ")?;
            let hash = u64::from_str_radix(hash, 16).ok()?;
            Some(Checksum { rows: rows.parse().ok()?, hash })
        };
        read().ok_or("not a checksum")
    }
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
            checksum: None,
        }
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
    joined(words.iter().map(quoted), " ")
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
                let (inside, rest) = chars.as_str().split_once('\'')?;
                word.get_or_insert_default().push_str(inside);
                chars = rest.chars();
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
    fn a_checksum_is_that_of_fnv_1a_and_reads_back() {
        // Test vectors of the authors of FNV, www.isthe.com/chongo/tech/comp/fnv.
        for (text, hash) in [("a", 0xaf63_dc4c_8601_ec8c), ("foobar", 0x8594_4171_f739_67e8)] {
            let checksum = Checksum::NONE.and(text.as_bytes());
            assert_eq!(checksum, Checksum { rows: 1, hash });
            assert_eq!(Checksum::try_from(String::from(checksum)), Ok(checksum));
        }
        let apart = Checksum::NONE.and(b"foo").and(b"bar");
        assert_eq!(apart, Checksum { rows: 2, ..Checksum::NONE.and(b"foobar") });
        assert_eq!(String::from(apart).len(), String::from(Checksum::NONE).len());
    }

    proptest! {
        #[test]
        fn the_arguments_come_back_from_the_line(words in proptest::collection::vec(".*", 0..5)) {
            prop_assert_eq!(Provenance::of(&words).arguments(), Some(words));
        }
    }
}
