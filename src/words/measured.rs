//! What a scan measured at a point.

use super::number::significant;
use crate::scan::measure::Value;

/// A value with all its digits; empty if there is none.
pub fn exact(value: Value) -> String {
    match value {
        Value::Nothing => String::new(),
        Value::Number(value) => format!("{value:?}"),
        Value::Count(count) => count.to_string(),
        Value::Word(word) => word.to_owned(),
    }
}

/// A value rounded to eight digits; `-` if there is none.
pub fn rounded(value: Value) -> String {
    match value {
        Value::Nothing => "-".to_owned(),
        Value::Number(value) => significant(value, 8),
        Value::Count(_) | Value::Word(_) => exact(value),
    }
}
