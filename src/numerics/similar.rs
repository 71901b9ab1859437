//! Suggestions for misspelt names.

use super::by_number;

/// Least similarity of a suggestion to what was typed (0: nothing in common, 1: equal), and how far it may fall
/// short of the best suggestion.
const ALIKE: (f64, f64) = (0.7, 0.1);

/// The known names that resemble a misspelt one, best first, at most three.
pub fn similar<Name: AsRef<str>>(
    misspelt: &str,
    known: impl IntoIterator<Item = Name>,
) -> Vec<Name> {
    let misspelt = misspelt.to_lowercase();
    let rated = known
        .into_iter()
        .map(|name| (strsim::jaro(&misspelt, &name.as_ref().to_lowercase()), name));
    let mut rated: Vec<_> = rated.filter(|(likeness, _)| *likeness >= ALIKE.0).collect();
    rated.sort_by(by_number(|(likeness, _): &(f64, Name)| -likeness));
    let least = rated.first().map_or(0.0, |(best, _)| best - ALIKE.1);
    let close = rated.into_iter().take(3).take_while(|(likeness, _)| *likeness >= least);
    close.map(|(_, name)| name).collect()
}

/// The known name that resembles a misspelt one most.
pub fn most_similar<Name: AsRef<str>>(
    misspelt: &str,
    known: impl IntoIterator<Item = Name>,
) -> Option<Name> {
    similar(misspelt, known).into_iter().next()
}
