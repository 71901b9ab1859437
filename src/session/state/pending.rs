//! Input that the next key completes: a count before a key, or the letter of a mark.

pub const MOST: u32 = 9999;

/// Input that the next key completes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pending {
    /// The next key is another digit, or the key to press this many times. Zero means no digit yet.
    Count(u32),
    /// The letter of a mark.
    Letter(Letter),
}

/// The purpose of a letter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Letter {
    /// The mark to set.
    Mark,
    /// The mark to go to.
    GoTo,
}

impl Letter {
    /// The question for the footer.
    pub fn question(self) -> &'static str {
        match self {
            Letter::Mark => "mark this point by which letter? a to z",
            Letter::GoTo => "go to which mark? a to z; the same key: the point left last",
        }
    }
}
