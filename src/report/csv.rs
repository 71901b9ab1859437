//! Rows as comma-separated values: a line of names, then one line each; all digits, and nothing where a value does
//! not exist.

use csv::Writer;
use serde::Serialize;
use serde_json::{Map, Value};

/// Rows below a line of names.
#[derive(Debug)]
pub struct Sheet {
    names: Vec<String>,
    out: Writer<Vec<u8>>,
}

impl Sheet {
    /// No rows yet, with a column for each field of such a row; a field that is itself a record or a list has none.
    /// Columns may be called otherwise than their fields: `(field, name)`.
    pub fn like(row: &impl Serialize, called: &[(&str, &str)]) -> Self {
        let single = |(_, value): &(String, Value)| !value.is_object() && !value.is_array();
        let names: Vec<String> =
            fields(row).into_iter().filter(single).map(|(name, _)| name).collect();
        let mut sheet = Sheet { names, out: Writer::from_writer(Vec::new()) };
        let shown = |name: &String| {
            let other = called.iter().find(|(field, _)| field == name);
            other.map_or(name.clone(), |(_, other)| (*other).to_owned())
        };
        let heading: Vec<String> = sheet.names.iter().map(shown).collect();
        sheet.write(&heading);
        sheet
    }

    /// Adds a row. Its fields are found by their names; the cells of others stay empty.
    pub fn row(&mut self, row: &impl Serialize) {
        let fields = fields(row);
        let cells: Vec<String> =
            self.names.iter().map(|name| fields.get(name).map_or_else(String::new, cell)).collect();
        self.write(&cells);
    }

    fn write(&mut self, cells: &[String]) {
        // A vector takes everything, and all rows are of one length.
        let _ = self.out.write_record(cells);
    }

    pub fn into_text(self) -> String {
        let bytes = self.out.into_inner().unwrap_or_default();
        String::from_utf8(bytes).unwrap_or_default()
    }
}

/// These rows, below the names of the fields of one.
pub fn sheet<R: Serialize>(like: &impl Serialize, rows: impl IntoIterator<Item = R>) -> String {
    let mut sheet = Sheet::like(like, &[]);
    rows.into_iter().for_each(|row| sheet.row(&row));
    sheet.into_text()
}

fn fields(row: &impl Serialize) -> Map<String, Value> {
    match serde_json::to_value(row) {
        Ok(Value::Object(fields)) => fields,
        _ => Map::new(),
    }
}

fn cell(value: &Value) -> String {
    match value {
        Value::Number(number) if number.is_f64() => number.as_f64().map_or_else(String::new, exact),
        Value::Number(_) | Value::Bool(_) => value.to_string(),
        Value::String(text) => text.clone(),
        Value::Null | Value::Array(_) | Value::Object(_) => String::new(),
    }
}

/// All digits that tell this double from its neighbours: `0.1`, `-3.0`, `1e-300`.
fn exact(value: f64) -> String {
    format!("{value:?}")
}

/// Cells as a line; those with a separator or quotes in them are quoted.
pub fn line(cells: &[String]) -> String {
    let mut sheet = Sheet { names: Vec::new(), out: Writer::from_writer(Vec::new()) };
    sheet.write(cells);
    sheet.into_text()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[derive(Serialize, Default)]
    struct Row {
        name: &'static str,
        number: f64,
        #[serde(flatten)]
        more: More,
        list: Vec<f64>,
    }

    #[derive(Serialize, Default)]
    struct More {
        count: u64,
        unknown: Option<f64>,
    }

    #[test]
    fn columns_are_the_fields_and_numbers_have_all_digits() {
        let row = |number| Row { name: "a,b", number, ..Row::default() };
        let text = sheet(&Row::default(), [row(0.1 + 0.2), row(-3.0), row(5e-5), row(f64::NAN)]);
        let lines = [
            "name,number,count,unknown",
            "\"a,b\",0.30000000000000004,0,",
            "\"a,b\",-3.0,0,",
            "\"a,b\",5e-5,0,",
            "\"a,b\",,0,",
        ];
        assert_eq!(text.lines().collect::<Vec<_>>(), lines);
    }

    #[test]
    fn a_row_fills_the_columns_that_it_knows() {
        let mut sheet = Sheet::like(&Row::default(), &[("count", "how many")]);
        sheet.row(&More { count: 2, unknown: Some(1.0) });
        assert_eq!(sheet.into_text(), "name,number,how many,unknown\n,,2,1.0\n");
    }

    #[test]
    fn cells_with_separators_are_quoted() {
        let cells = ["a,b", "say \"x\"", "plain"].map(str::to_owned);
        assert_eq!(line(&cells), "\"a,b\",\"say \"\"x\"\"\",plain\n");
    }
}
