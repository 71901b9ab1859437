//! What a question is about, as Python objects that do not change.

use hopfscope::cli::{CommandCase, machine};
use hopfscope::model::{Knob, Parameters as Numbers};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple};

use crate::found::{InputError, failed};

/// Parameters of the oscillator of the paper, without units:
/// ``q'' + 2 D q' + D2 q'^2 + D3 q'^3 + q = friction, within -r .. r``.
///
/// D is the linear damping (negative: self-excited), D2 the asymmetric and D3 the cubic damping, r the dry friction, not
/// negative. Objects do not change; they compare, hash and pickle by their values.
#[pyclass(frozen, eq, module = "hopfscope")]
#[derive(PartialEq)]
pub struct Parameters(pub Numbers);

#[pymethods]
impl Parameters {
    #[new]
    #[pyo3(signature = (*, D = 0.0, D2 = 0.0, D3 = 0.0, r = 0.0))]
    #[expect(non_snake_case, reason = "names of the field")]
    fn new(D: f64, D2: f64, D3: f64, r: f64) -> PyResult<Self> {
        let numbers = [D, D2, D3, r];
        for (knob, value) in Knob::PARAMETERS.into_iter().zip(numbers) {
            knob.check(value).map_err(|refused| InputError::new_err(refused.to_string()))?;
        }
        Ok(Parameters(numbers.into()))
    }

    #[getter(D)]
    fn d(&self) -> f64 {
        self.0.d
    }

    #[getter(D2)]
    fn d2(&self) -> f64 {
        self.0.d2
    }

    #[getter(D3)]
    fn d3(&self) -> f64 {
        self.0.d3
    }

    #[getter]
    fn r(&self) -> f64 {
        self.0.r
    }

    /// The same with other values.
    #[pyo3(signature = (**numbers))]
    fn replace<'py>(
        slf: &Bound<'py, Self>,
        numbers: Option<Bound<'py, PyDict>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let all = slf.get().to_dict(slf.py())?;
        if let Some(numbers) = numbers {
            all.update(numbers.as_mapping())?;
        }
        slf.get_type().call((), Some(&all))
    }

    /// The values by name.
    fn to_dict<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let all = PyDict::new(py);
        for (knob, value) in Knob::PARAMETERS.into_iter().zip(self.0.numbers()) {
            all.set_item(knob.spec().name, value)?;
        }
        Ok(all)
    }

    fn __hash__(slf: &Bound<'_, Self>) -> PyResult<isize> {
        PyTuple::new(slf.py(), slf.get().0.numbers())?.hash()
    }

    fn __getnewargs_ex__<'py>(
        &self,
        py: Python<'py>,
    ) -> PyResult<(Bound<'py, PyTuple>, Bound<'py, PyDict>)> {
        Ok((PyTuple::empty(py), self.to_dict(py)?))
    }

    fn __repr__(&self) -> String {
        let Numbers { d, d2, d3, r } = self.0;
        format!("Parameters(D={d:?}, D2={d2:?}, D3={d3:?}, r={r:?})")
    }
}

/// A machine: a mass on its belt or a vibration mode by its own numbers, in SI units.
///
/// ``name`` is a file, or one of the built-in machines. Numbers may be set, each in SI units or with a unit and a
/// tolerance: ``Machine("clutch", v0=0.2, R="60 N+-5 N")``. ``text`` is the content of a machine file in place of one.
#[pyclass(frozen, module = "hopfscope")]
pub struct Machine {
    pub case: CommandCase,
    /// The words of the command line that name it; a text is a file that the command has open as number 3.
    #[pyo3(get)]
    pub words: Vec<String>,
    #[pyo3(get)]
    name: String,
    text: Option<String>,
}

/// Where a command finds the text of a machine that is in no file.
const OF_TEXT: &str = "/dev/fd/3";

#[pymethods]
impl Machine {
    #[new]
    #[pyo3(signature = (name, *, text = None, **numbers))]
    fn new(
        name: &str,
        text: Option<String>,
        numbers: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Self> {
        let file = text.as_ref().map_or(name, |_| OF_TEXT);
        let mut words = vec!["--machine".to_owned(), file.to_owned()];
        for (knob, value) in numbers.into_iter().flatten() {
            let value = match value.extract::<f64>() {
                Ok(value) => format!("{value:?}"),
                Err(_) => value.extract::<String>()?,
            };
            words.extend(["--set".to_owned(), format!("{knob}={value}")]);
        }
        let case = machine(&words, text.as_deref().map(|text| (name, text))).map_err(failed)?;
        Ok(Machine { case, words, name: name.to_owned(), text })
    }

    #[getter]
    fn title(&self) -> &str {
        &self.case.described.title
    }

    /// Its numbers in SI units, by name.
    #[getter]
    fn numbers<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let all = PyDict::new(py);
        for (knob, value) in self.case.described.subject.source.numbers() {
            all.set_item(knob.spec().name, value)?;
        }
        Ok(all)
    }

    /// The same with other values.
    #[pyo3(signature = (**numbers))]
    fn replace(&self, py: Python<'_>, numbers: Option<&Bound<'_, PyDict>>) -> PyResult<Self> {
        let all = self.set(py)?;
        if let Some(numbers) = numbers {
            all.update(numbers.as_mapping())?;
        }
        Machine::new(&self.name, self.text.clone(), Some(&all))
    }

    fn __getnewargs_ex__<'py>(&self, py: Python<'py>) -> PyResult<((&str,), Bound<'py, PyDict>)> {
        let all = self.set(py)?;
        all.set_item("text", &self.text)?;
        Ok(((&self.name,), all))
    }

    fn __repr__(&self) -> String {
        let set = self.words[2..].iter().filter(|word| *word != "--set");
        let set = set.map(|word| word.replacen('=', "='", 1) + "'");
        let all: Vec<_> = std::iter::once(format!("{:?}", self.name)).chain(set).collect();
        format!("Machine({})", all.join(", "))
    }
}

impl Machine {
    /// The numbers that were set, as they were.
    fn set<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let all = PyDict::new(py);
        for (name, value) in self.words[2..].iter().filter_map(|word| word.split_once('=')) {
            all.set_item(name, value)?;
        }
        Ok(all)
    }
}
