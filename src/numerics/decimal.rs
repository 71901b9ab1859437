//! Numbers as text that parses back to the same number.

/// The shortest text that parses back to this number, without a redundant `.0`.
pub fn shortest(value: f64) -> String {
    // Debug, unlike Display, writes very large and very small numbers with an exponent.
    let text = format!("{value:?}");
    text.strip_suffix(".0").map_or(text.clone(), str::to_owned)
}

/// The same with an exponent where that saves zeros: `1e12`, but `1000`.
pub fn brief(value: f64) -> String {
    let (plain, scientific) = (shortest(value), format!("{value:e}"));
    if plain.len() > scientific.len() + 1 { scientific } else { plain }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn round_numbers_are_brief() {
        for (value, text) in
            [(1e6, "1e6"), (-1e12, "-1e12"), (100.0, "100"), (0.01, "0.01"), (0.1, "0.1")]
        {
            assert_eq!(brief(value), text);
        }
    }

    #[test]
    fn numbers_are_written_short_and_read_back() {
        for (value, text) in [(1.0, "1"), (-0.1, "-0.1"), (1e300, "1e300"), (1e-10, "1e-10")] {
            assert_eq!(shortest(value), text);
            assert_eq!(text.parse(), Ok(value));
        }
    }
}
