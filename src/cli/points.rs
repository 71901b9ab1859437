//! The file of a list of parameter sets.

use std::path::Path;

use csv::{ReaderBuilder, Trim};

use super::{Failure, Result};
use crate::model::{Group, Knob};
use crate::runtime::bounded;
use crate::scan::Column;

/// The columns of comma-separated values whose first line names numbers of these groups; values have a unit or are in SI
/// units. Fails with what is wrong where.
pub fn columns(path: &Path, groups: &[Group]) -> Result<Vec<Column>> {
    let text = bounded::text(path)?;
    let refused = |why: String| Failure::file(path, why);
    let unreadable = |error: csv::Error| refused(error.to_string());
    let mut reader = ReaderBuilder::new().trim(Trim::All).from_reader(text.as_bytes());
    let names = reader.headers().map_err(unreadable)?;
    let named = |name| Ok((Knob::named(name, groups)?, Vec::new()));
    let mut columns = names.iter().map(named).collect::<Result<Vec<_>, _>>().map_err(refused)?;
    for record in reader.records() {
        let record = record.map_err(unreadable)?;
        let line = record.position().map_or(0, csv::Position::line);
        for ((knob, values), cell) in columns.iter_mut().zip(&record) {
            let place = |why| refused(format!("line {line}, column {knob}: {why}"));
            values.push(knob.parse(cell).map_err(place)?);
        }
    }
    Ok(columns)
}
