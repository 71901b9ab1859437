//! Comma-separated values: a line of names, then a line for each row. Numbers have all their digits; a cell whose
//! value does not exist is empty.

use csv::Writer;
use serde::Serialize;
use serde_json::{Map, Value};

/// Rows below a line of names.
#[derive(Debug)]
pub struct CsvSheet {
    names: Vec<String>,
    out: Writer<Vec<u8>>,
}

impl CsvSheet {
    /// A sheet without rows, with a column for each field of rows like `row`. A field that is a record or a
    /// list has no column, except [`FROM_REST`], whose fields have columns with its name before theirs, and
    /// [`CERTIFIED`]: each of its fields has one column, or two if it is a pair of bounds.
    ///
    /// `called` renames columns: `(field, name)`.
    pub fn like(row: &impl Serialize, called: &[(&str, &str)]) -> Self {
        let mut sheet = CsvSheet { names: names(row), out: Writer::from_writer(Vec::new()) };
        let shown = |name: &String| {
            let other = called.iter().find(|(field, _)| field == name);
            other.map_or(name.clone(), |(_, other)| (*other).to_owned())
        };
        let heading: Vec<String> = sheet.names.iter().map(shown).collect();
        sheet.write(&heading);
        sheet
    }

    /// Adds a row. Fields are matched to columns by name; a column without a field stays empty.
    pub fn row(&mut self, row: &impl Serialize) {
        let fields = fields(row);
        let cells: Vec<String> =
            self.names.iter().map(|name| fields.get(name).map_or_else(String::new, cell)).collect();
        self.write(&cells);
    }

    fn write(&mut self, cells: &[String]) {
        // Cannot fail: a vector accepts every write, and all rows have the same length.
        let _ = self.out.write_record(cells);
    }

    pub fn into_text(self) -> String {
        let bytes = self.out.into_inner().unwrap_or_default();
        String::from_utf8(bytes).unwrap_or_default()
    }
}

/// The rows, below a line with the names of the fields of `like`.
pub fn sheet<R: Serialize>(like: &impl Serialize, rows: impl IntoIterator<Item = R>) -> String {
    let mut sheet = CsvSheet::like(like, &[]);
    rows.into_iter().for_each(|row| sheet.row(&row));
    sheet.into_text()
}

/// The field of a row that holds the smallest kicks out of rest.
const FROM_REST: &str = "from_rest";

/// The field of a row that holds what is proved about it.
const CERTIFIED: &str = "certified";

/// The fields of rows like this one that have a column.
pub(super) fn names(row: &impl Serialize) -> Vec<String> {
    let single = |(_, value): &(String, Value)| !value.is_object() && !value.is_array();
    fields(row).into_iter().filter(single).map(|(name, _)| name).collect()
}

pub(super) fn fields(row: &impl Serialize) -> Map<String, Value> {
    let Ok(Value::Object(told)) = serde_json::to_value(row) else { return Map::new() };
    let mut fields = Map::new();
    for (name, value) in told {
        match value {
            Value::Object(kicks) if name == FROM_REST => {
                let kicks = kicks.into_iter();
                fields.extend(kicks.map(|(kick, size)| (format!("{name}_{kick}"), size)));
            }
            value => drop(fields.insert(name, value)),
        }
    }
    if let Some(Value::Object(certified)) = fields.remove(CERTIFIED) {
        for (name, value) in certified {
            let bounds = match value {
                Value::Object(mut of) => ["lower", "upper"].map(|end| of.remove(end)),
                Value::Array(of) => {
                    <[Value; 2]>::try_from(of).map_or([None, None], |of| of.map(Some))
                }
                single => {
                    fields.entry(name).or_insert(single);
                    continue;
                }
            };
            for (end, value) in ["lower", "upper"].into_iter().zip(bounds) {
                fields.insert(format!("{name}_{end}"), value.unwrap_or_default());
            }
        }
    }
    fields
}

/// A value with all its digits.
pub(super) fn cell(value: &Value) -> String {
    match value {
        Value::Number(number) if number.is_f64() => number.as_f64().map_or_else(String::new, exact),
        Value::Number(_) | Value::Bool(_) => value.to_string(),
        Value::String(text) => text.clone(),
        Value::Null | Value::Array(_) | Value::Object(_) => String::new(),
    }
}

/// The shortest decimal that reads back as this double: `0.1`, `-3.0`, `1e-300`.
fn exact(value: f64) -> String {
    format!("{value:?}")
}

/// A line for each row of cells; a cell that contains a separator or a quote is quoted.
pub fn lines(rows: impl IntoIterator<Item = Vec<String>>) -> String {
    let mut sheet = CsvSheet { names: Vec::new(), out: Writer::from_writer(Vec::new()) };
    rows.into_iter().for_each(|cells| sheet.write(&cells));
    sheet.into_text()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[derive(Serialize, Default)]
    struct SampleRow {
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
        let row = |number| SampleRow { name: "a,b", number, ..SampleRow::default() };
        let text =
            sheet(&SampleRow::default(), [row(0.1 + 0.2), row(-3.0), row(5e-5), row(f64::NAN)]);
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
    fn bounds_have_two_columns() {
        #[derive(Serialize)]
        struct CertifiedRow {
            q: f64,
            certified: Bounds,
        }
        #[derive(Serialize)]
        struct Bounds {
            q: [f64; 2],
            proved: bool,
        }
        let row = |q: [f64; 2]| CertifiedRow { q: 1.0, certified: Bounds { q, proved: true } };
        let rows = [row([0.5, 1.5]), row([0.5, f64::INFINITY])];
        let lines = ["q,q_lower,q_upper,proved", "1.0,0.5,1.5,true", "1.0,0.5,,true"];
        assert_eq!(sheet(&rows[0], &rows).lines().collect::<Vec<_>>(), lines);
    }

    #[test]
    fn a_row_fills_the_columns_that_it_knows() {
        let mut sheet = CsvSheet::like(&SampleRow::default(), &[("count", "how many")]);
        sheet.row(&More { count: 2, unknown: Some(1.0) });
        assert_eq!(sheet.into_text(), "name,number,how many,unknown\n,,2,1.0\n");
    }

    #[test]
    fn cells_with_separators_are_quoted() {
        let cells = ["a,b", "say \"x\"", "plain"].map(str::to_owned);
        assert_eq!(lines([cells.to_vec()]), "\"a,b\",\"say \"\"x\"\"\",plain\n");
    }
}
