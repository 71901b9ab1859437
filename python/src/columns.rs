//! Documents as Python objects: rows of objects become tables of arrays, lists of numbers arrays.

use numpy::{Element, PyArray1, PyArray2};
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::{PyDict, PyType};
use serde_json::{Map, Value};

/// A value as a Python object.
pub fn object(py: Python<'_>, value: &Value) -> PyResult<Py<PyAny>> {
    Ok(match value {
        Value::Null => py.None(),
        Value::Bool(value) => value.into_pyobject(py)?.to_owned().into_any().unbind(),
        Value::Number(number) => match number.as_i64() {
            Some(whole) => whole.into_pyobject(py)?.into_any().unbind(),
            None => number.as_f64().into_pyobject(py)?.into_any().unbind(),
        },
        Value::String(text) => text.into_pyobject(py)?.into_any().unbind(),
        Value::Array(values) => column(py, &values.iter().collect::<Vec<_>>())?,
        Value::Object(fields) => {
            let all = PyDict::new(py);
            for (name, value) in fields {
                all.set_item(name, object(py, value)?)?;
            }
            of_class(py, "Record")?.call1((all,))?.unbind()
        }
    })
}

/// Values of one column, or of a list: an array of numbers, in which nothing is NaN; an array of two dimensions; a table;
/// or an array of objects.
pub fn column(py: Python<'_>, values: &[&Value]) -> PyResult<Py<PyAny>> {
    if values.iter().any(|value| value.is_object()) {
        return table(py, values);
    }
    if let Some(whole) = all(values, Value::as_i64).filter(|whole| !whole.is_empty()) {
        return Ok(PyArray1::from_vec(py, whole).into_any().unbind());
    }
    if let Some(numbers) = all(values, number) {
        return Ok(PyArray1::from_vec(py, numbers).into_any().unbind());
    }
    if let Some(marks) = all(values, Value::as_bool) {
        return Ok(PyArray1::from_vec(py, marks).into_any().unbind());
    }
    if let Some(array) = rows(py, values, Value::as_i64).or_else(|| rows(py, values, number)) {
        return Ok(array);
    }
    let objects = values.iter().map(|value| object(py, value)).collect::<PyResult<Vec<_>>>()?;
    // Filled cell by cell, because numpy would look into arrays that lie in cells.
    let array = py.import("numpy")?.call_method1("empty", (objects.len(), "O"))?;
    for (index, object) in objects.into_iter().enumerate() {
        array.set_item(index, object)?;
    }
    Ok(array.unbind())
}

/// What each of the values is, if all of them are that.
fn all<T>(values: &[&Value], of: impl Fn(&Value) -> Option<T>) -> Option<Vec<T>> {
    values.iter().map(|value| of(value)).collect()
}

/// A number, or NaN in place of one that does not exist.
fn number(value: &Value) -> Option<f64> {
    if value.is_null() {
        Some(f64::NAN)
    } else {
        value.as_f64()
    }
}

/// Lists of one length as an array of two dimensions, if all that they hold is of one type.
fn rows<T: Element>(
    py: Python<'_>,
    values: &[&Value],
    of: impl Fn(&Value) -> Option<T>,
) -> Option<Py<PyAny>> {
    let row = |value: &Value| value.as_array()?.iter().map(&of).collect::<Option<Vec<_>>>();
    Some(PyArray2::from_vec2(py, &all(values, row)?).ok()?.into_any().unbind())
}

/// Objects as a table: a column for each name, empty where a row has none of it.
fn table(py: Python<'_>, rows: &[&Value]) -> PyResult<Py<PyAny>> {
    let mut names: Map<String, Value> = Map::new();
    for fields in rows.iter().filter_map(|row| row.as_object()) {
        names.extend(
            fields
                .keys()
                .filter(|name| !names.contains_key(*name))
                .cloned()
                .map(|name| (name, Value::Null))
                .collect::<Vec<_>>(),
        );
    }
    let columns = PyDict::new(py);
    for name in names.keys() {
        let cells: Vec<_> = rows.iter().map(|row| row.get(name).unwrap_or(&Value::Null)).collect();
        columns.set_item(name, column(py, &cells)?)?;
    }
    Ok(of_class(py, "Table")?.call1((columns,))?.unbind())
}

/// A class of the package.
fn of_class<'py>(py: Python<'py>, name: &str) -> PyResult<Bound<'py, PyType>> {
    static CLASSES: [PyOnceLock<Py<PyType>>; 2] = [const { PyOnceLock::new() }; 2];
    CLASSES[usize::from(name == "Table")].import(py, "hopfscope._answers", name).cloned()
}
