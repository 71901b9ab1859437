//! Values of TOML files, each with its place, as serde reads them: in one way wherever they stand, so that every type is
//! compiled for one reader. The library has several, for a file, a table, a value, a date, and their names.

use std::marker::PhantomData;

use serde::de::value::MapAccessDeserializer;
use serde::de::{
    DeserializeOwned, DeserializeSeed, Error, IntoDeserializer, MapAccess, SeqAccess, Visitor,
};
use serde::{Deserialize, Deserializer, forward_to_deserialize_any};
use serde_spanned::de::{SpannedDeserializer, is_spanned};
use toml::Spanned;
use toml::de::{DeArray, DeFloat, DeTable, DeValue};

use super::mistake::{Complaint, FileMistake, Result};

/// Reads a TOML file. Fails with the first mistake as a [`FileMistake`].
pub fn toml<T: DeserializeOwned>(file: &str, text: &str) -> Result<T, FileMistake> {
    let read = DeTable::parse(text).map_err(Complaint::from);
    let read = read.and_then(|table| Placed::from(table).read());
    read.map_err(|complaint| complaint.in_file(file, text))
}

/// A value and its place.
pub struct Placed<'de>(pub Spanned<DeValue<'de>>);

impl<'de> From<Spanned<DeTable<'de>>> for Placed<'de> {
    fn from(table: Spanned<DeTable<'de>>) -> Self {
        Placed(Spanned::new(table.span(), DeValue::Table(table.into_inner())))
    }
}

impl<'de> Placed<'de> {
    /// What the value says. Fails with the first mistake, which is about this value where it has no narrower place.
    pub fn read<T: Deserialize<'de>>(self) -> Result<T> {
        self.seeded(PhantomData)
    }

    fn seeded<S: DeserializeSeed<'de>>(self, seed: S) -> Result<S::Value> {
        let at = self.0.span();
        seed.deserialize(self).map_err(|complaint| complaint.or_at(at))
    }
}

/// The entries of a table that are not yet read, and the value whose name was read last.
struct Entries<'de, I> {
    left: I,
    value: Option<Placed<'de>>,
}

/// The entries of a table, none of them read.
fn entries(table: DeTable<'_>) -> impl MapAccess<'_, Error = Complaint> {
    let left = table.into_iter().map(|(name, value)| {
        let (at, name) = (name.span(), name.into_inner());
        (Placed(Spanned::new(at, DeValue::String(name))), Placed(value))
    });
    Entries { left, value: None }
}

impl<'de, I: Iterator<Item = (Placed<'de>, Placed<'de>)>> MapAccess<'de> for Entries<'de, I> {
    type Error = Complaint;

    fn next_key_seed<S: DeserializeSeed<'de>>(&mut self, seed: S) -> Result<Option<S::Value>> {
        let Some((name, value)) = self.left.next() else { return Ok(None) };
        self.value = Some(value);
        name.seeded(seed).map(Some)
    }

    fn next_value_seed<S: DeserializeSeed<'de>>(&mut self, seed: S) -> Result<S::Value> {
        let value = self.value.take().ok_or_else(|| Complaint::custom("a value without a name"));
        value.and_then(|value| value.seeded(seed))
    }
}

/// The elements of a list that are not yet read.
struct Elements<'de>(<DeArray<'de> as IntoIterator>::IntoIter);

impl<'de> SeqAccess<'de> for Elements<'de> {
    type Error = Complaint;

    fn next_element_seed<S: DeserializeSeed<'de>>(&mut self, seed: S) -> Result<Option<S::Value>> {
        self.0.next().map(|value| Placed(value).seeded(seed)).transpose()
    }
}

fn float(digits: &DeFloat) -> Result<f64> {
    let value = digits.as_str().parse().map_err(Complaint::custom)?;
    // Infinity that is not written as `inf` is an overflow.
    if f64::is_infinite(value) && !digits.as_str().ends_with("inf") {
        return Err(Complaint::custom("floating-point number overflowed"));
    }
    Ok(value)
}

impl<'de> Deserializer<'de> for Placed<'de> {
    type Error = Complaint;

    fn deserialize_any<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value> {
        match self.0.into_inner() {
            DeValue::String(text) => visitor.visit_str(&text),
            DeValue::Integer(digits) => {
                match i64::from_str_radix(digits.as_str(), digits.radix()) {
                    Ok(value) => visitor.visit_i64(value),
                    // Larger ones can only be meant as real numbers, which have decimal digits.
                    Err(_) if digits.radix() == 10 => {
                        visitor.visit_f64(digits.as_str().parse().map_err(Complaint::custom)?)
                    }
                    Err(_) => Err(Complaint::custom("a whole number beyond 64 bits")),
                }
            }
            DeValue::Float(digits) => visitor.visit_f64(float(&digits)?),
            DeValue::Boolean(value) => visitor.visit_bool(value),
            DeValue::Datetime(_) => Err(Complaint::custom("a date or a time; nothing here is one")),
            DeValue::Array(values) => visitor.visit_seq(Elements(values.into_iter())),
            DeValue::Table(table) => visitor.visit_map(entries(table)),
        }
    }

    fn deserialize_option<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value> {
        visitor.visit_some(self)
    }

    fn deserialize_newtype_struct<V: Visitor<'de>>(
        self,
        _: &'static str,
        visitor: V,
    ) -> Result<V::Value> {
        visitor.visit_newtype_struct(self)
    }

    fn deserialize_struct<V: Visitor<'de>>(
        self,
        name: &'static str,
        _: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value> {
        let at = self.0.span();
        if is_spanned(name) {
            return visitor.visit_map(SpannedDeserializer::new(self, at));
        }
        self.deserialize_any(visitor)
    }

    /// A variant is its name, or a table that has its content under its name.
    fn deserialize_enum<V: Visitor<'de>>(
        self,
        _: &'static str,
        _: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value> {
        match self.0.into_inner() {
            DeValue::String(name) => visitor.visit_enum(name.into_deserializer()),
            DeValue::Table(table) if table.len() == 1 => {
                visitor.visit_enum(MapAccessDeserializer::new(entries(table)))
            }
            _ => Err(Complaint::custom("wanted a text, or a table with one entry")),
        }
    }

    forward_to_deserialize_any! {
        bool i8 i16 i32 i64 i128 u8 u16 u32 u64 u128 f32 f64 char str string bytes byte_buf unit unit_struct seq tuple
        tuple_struct map identifier ignored_any
    }
}

impl<'de> IntoDeserializer<'de, Complaint> for Placed<'de> {
    type Deserializer = Self;

    fn into_deserializer(self) -> Self {
        self
    }
}
