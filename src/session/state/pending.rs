//! Input that the next key completes: a count before a key, or the letter of a register or a mark.

pub const MOST: u32 = 9999;

/// Input that the next key completes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pending {
    /// The next key is another digit, or the key to press this many times. Zero means no digit yet.
    Count(u32),
    /// The letter of a register or mark.
    Letter { what: Letter, count: u32 },
}

/// The purpose of a letter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Letter {
    /// The register in which to record.
    Record,
    /// The register to play.
    Play,
    /// The mark to set.
    Mark,
    /// The mark to go to.
    GoTo,
}

impl Letter {
    /// The question for the footer.
    pub fn question(self) -> &'static str {
        match self {
            Letter::Record => "record into which register? a to z",
            Letter::Play => "play which register? a to z; the same key: the last one",
            Letter::Mark => "mark this point by which letter? a to z",
            Letter::GoTo => "go to which mark? a to z; the same key: the point left last",
        }
    }
}
