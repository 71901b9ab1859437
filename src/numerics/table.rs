//! Tables of the program that stand in files: a row is a line, with ` | ` between its cells.

/// The cells of a line; `None` if it has another number of them, as a comment has.
pub(crate) fn cells<const N: usize>(line: &str) -> Option<[&str; N]> {
    line.split(" | ").collect::<Vec<_>>().try_into().ok()
}
