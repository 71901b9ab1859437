//! JSON documents: numbers in the shortest form that reads back exactly, `null` for a value that does not exist;
//! what is not printable is escaped.

use serde::Serialize;
use serde_json::{Map, Value};

use crate::words::printable;

/// An object, told field by field.
#[derive(Clone, Debug, Default, Serialize)]
#[serde(transparent)]
pub struct Document(Map<String, Value>);

impl Document {
    /// An object with this field.
    pub fn of(name: &str, value: impl Serialize) -> Self {
        Document::default().with(name, value)
    }

    /// The document with this field.
    pub fn with(mut self, name: &str, value: impl Serialize) -> Self {
        self.0.insert(name.to_owned(), self::value(&value));
        self
    }

    /// The document with this field, or without it if there is no value.
    pub fn with_any(self, name: &str, value: Option<impl Serialize>) -> Self {
        match value {
            Some(value) => self.with(name, value),
            None => self,
        }
    }

    /// The document with the fields of a record.
    pub fn and(mut self, record: &impl Serialize) -> Self {
        if let Value::Object(fields) = value(record) {
            self.0.extend(fields);
        }
        self
    }

    /// What stands in a field that is a list.
    pub(super) fn list(&mut self, name: &str) -> Option<&mut Vec<Value>> {
        self.0.get_mut(name)?.as_array_mut()
    }

    /// The value at the end of these names, each a field of the one before; null if there is none.
    pub(super) fn at(&self, place: &[String]) -> &Value {
        let Some((name, inner)) = place.split_first() else { return &Value::Null };
        let found = inner.iter().fold(self.0.get(name), |found, name| found?.get(name));
        found.unwrap_or(&Value::Null)
    }

    /// The names of its fields that are neither records nor lists.
    pub(super) fn singles(&self) -> impl Iterator<Item = &str> {
        let single = self.0.iter().filter(|(_, value)| !value.is_object() && !value.is_array());
        single.map(|(name, _)| name.as_str())
    }

    /// The names and values of its numbers.
    pub(super) fn numbers(&self) -> Vec<(String, f64)> {
        let number = |(name, value): (&String, &Value)| Some((name.clone(), value.as_f64()?));
        self.0.iter().filter_map(number).collect()
    }
}

/// Anything as a value of a document.
///
/// # Panics
/// Never: strings, numbers and structs of them can always be written, and keys are strings.
pub(super) fn value(it: &impl Serialize) -> Value {
    serde_json::to_value(it)
        .unwrap_or_else(|error| unreachable!("a document cannot hold it: {error}"))
}

/// The document on one line, with a newline.
///
/// # Panics
/// Never: strings, numbers and structs of them can always be written, and keys are strings.
pub fn text(document: &impl Serialize) -> String {
    let text = serde_json::to_string(document)
        .unwrap_or_else(|error| unreachable!("a document cannot be written: {error}"));
    printable::json(&text).into_owned() + "\n"
}
