//! Comma-separated values: numbers have all their digits, and a value that does not exist is an empty cell.

use csv::Writer;
use serde_json::Value;

/// A value with all its digits: the shortest decimal that reads back as the same double, as `0.1`, `-3.0`, `1e-300`.
pub(super) fn cell(value: &Value) -> String {
    match value {
        Value::Number(number) if number.is_f64() => {
            number.as_f64().map_or_else(String::new, |value| format!("{value:?}"))
        }
        Value::Number(_) | Value::Bool(_) => value.to_string(),
        Value::String(text) => text.clone(),
        Value::Null | Value::Array(_) | Value::Object(_) => String::new(),
    }
}

/// A line for each row of cells; a cell that contains a separator or a quote is quoted.
pub fn lines(rows: impl IntoIterator<Item = Vec<String>>) -> String {
    let mut out = Writer::from_writer(Vec::new());
    for cells in rows {
        // Cannot fail: a vector accepts every write, and all rows have the same length.
        let _ = out.write_record(&cells);
    }
    String::from_utf8(out.into_inner().unwrap_or_default()).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_all_their_digits() {
        let values = [Value::from(0.1 + 0.2), Value::from(-3.0), Value::from(5e-5)];
        assert_eq!(values.map(|value| cell(&value)), ["0.30000000000000004", "-3.0", "5e-5"]);
        assert_eq!([Value::from(2), Value::from(f64::NAN)].map(|value| cell(&value)), ["2", ""]);
    }

    #[test]
    fn cells_with_separators_are_quoted() {
        let cells = ["a,b", "say \"x\"", "plain"].map(str::to_owned);
        assert_eq!(lines([cells.to_vec()]), "\"a,b\",\"say \"\"x\"\"\",plain\n");
    }
}
