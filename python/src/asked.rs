//! Questions in the words of the command line.

use std::ops::ControlFlow;
use std::sync::atomic::Ordering;

use hopfscope::cli;
use hopfscope::runtime::scanning::rows;
use hopfscope::scan::{Scan, ScanRow, Value as Cell};
use hopfscope::words::provenance::Provenance;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use serde_json::{Value, json, to_value};

use crate::columns::{column, object};
use crate::found::{Error, Found, failed};
use crate::interrupt::on_all_cores;
use crate::source::Machine;

/// The answer to a command and its options, about a machine if one is given; and what the program would say about an
/// answer that is incomplete.
#[pyfunction]
pub fn ask(
    py: Python<'_>,
    words: Vec<String>,
    machine: Option<&Machine>,
) -> PyResult<(Found, Option<String>)> {
    let case = machine.map(|machine| machine.case.clone());
    let answered = on_all_cores(py, move |stop| {
        cli::answer(&words, case, move || stop.load(Ordering::Relaxed))
    })?;
    let (answer, trouble) = answered.map_err(failed)?;
    Ok((Found::new(|| answer.document()), trouble.map(|trouble| trouble.to_string())))
}

/// The rows of a scan as columns, with the numbers that it goes over.
#[pyfunction]
pub fn scan<'py>(
    py: Python<'py>,
    words: Vec<String>,
    machine: Option<&Machine>,
) -> PyResult<Bound<'py, PyDict>> {
    let case = machine.map(|machine| machine.case.clone());
    let (scan, jobs) = cli::scan(&words, case).map_err(failed)?;
    let asked = scan.clone();
    let computed = on_all_cores(py, move |stop| {
        let mut found = vec![None; scan.points()];
        let interrupted = || stop.load(Ordering::Relaxed);
        let mut take = |index: usize, row| {
            found[index] = Some(row);
            ControlFlow::Continue(())
        };
        rows(&scan, 0..scan.points(), jobs, 0, &interrupted, &mut take).map(|()| found)
    })?;
    let computed = computed.map_err(|why| Error::new_err(why.to_string()))?;
    let all = PyDict::new(py);
    let (columns, over) = (PyDict::new(py), PyDict::new(py));
    for (name, values) in columns_of(&asked, &computed) {
        columns.set_item(name, column(py, &values.iter().collect::<Vec<_>>())?)?;
    }
    for sweep in asked.over() {
        let values: Vec<_> = (0..sweep.count).map(|index| json!(sweep.value(index))).collect();
        over.set_item(sweep.symbol.spec().name, object(py, &Value::Array(values))?)?;
    }
    all.set_item("over", over)?;
    all.set_item("columns", columns)?;
    let inputs = asked.inputs(0).into_iter().map(|(name, _)| name).collect::<Vec<_>>();
    all.set_item("inputs", inputs)?;
    let provenance = to_value(Provenance::of(&words)).unwrap_or_default();
    all.set_item("provenance", object(py, &provenance)?)?;
    Ok(all)
}

/// The columns of a scan by name: what each row depends on, what was measured, and what could not be computed, and why.
fn columns_of(scan: &Scan, rows: &[Option<ScanRow>]) -> Vec<(String, Vec<Value>)> {
    let names = scan.inputs(0).into_iter().map(|(name, _)| name);
    let names = names.chain(scan.measured().into_iter().map(str::to_owned));
    let mut columns: Vec<_> = names.map(|name| (name, Vec::with_capacity(rows.len()))).collect();
    let mut reasons = Vec::with_capacity(rows.len());
    for (index, row) in rows.iter().enumerate() {
        let inputs = scan.inputs(index).into_iter().map(|(_, value)| value);
        let measured = row.iter().flat_map(|row| &row.values).copied();
        let cells = inputs.chain(measured).map(value);
        columns.iter_mut().zip(cells).for_each(|((_, column), cell)| column.push(cell));
        reasons.push(json!(row.as_ref().and_then(|row| row.reason.clone())));
    }
    columns.push(("reason".to_owned(), reasons));
    columns
}

/// A cell of a row.
fn value(cell: Cell) -> Value {
    match cell {
        Cell::Nothing => Value::Null,
        Cell::Number(number) => json!(number),
        Cell::Count(count) => json!(count),
        Cell::Word(word) => json!(word),
    }
}
