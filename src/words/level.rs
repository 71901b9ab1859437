//! What is said of level curves.

use super::significant;
use crate::scan::{LevelTarget, Levels};

/// Between which values the column is where no curve was found; `None` where there are curves.
pub fn nowhere(target: LevelTarget, found: &Levels) -> Option<String> {
    let seen = found.seen.map(|ends| ends.map(|end| significant(end, 6)).join(" .. "));
    let seen = seen.map_or_else(|| "has no number".to_owned(), |ends| format!("is {ends}"));
    let line = || format!("no curve {target}: {} {seen} on it", target.column);
    found.curves.is_empty().then(line)
}
