//! Tables of the program that stand in files: a row is a line, with ` | ` between its cells.

use serde::Deserialize;
use serde::de::IntoDeserializer;
use serde::de::value::{Error, StrDeserializer};

/// The cells of a line; `None` if it has another number of them, as a comment has.
pub(crate) fn cells<const N: usize>(line: &str) -> Option<[&str; N]> {
    line.split(" | ").collect::<Vec<_>>().try_into().ok()
}

/// What has this name in files, or had it in earlier ones.
pub(crate) fn named<'de, T: Deserialize<'de>>(name: &'de str) -> Option<T> {
    let name: StrDeserializer<'de, Error> = name.into_deserializer();
    T::deserialize(name).ok()
}
