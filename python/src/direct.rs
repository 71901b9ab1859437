//! Questions that are answered faster than options are read: asked at once.

use std::time::Instant;

use hopfscope::flow::{Detail, Limits, METHODS, Problem, Subject};
use hopfscope::model::{Knob, ParameterBox, Parameters as Numbers, RangeError};
use hopfscope::portrait::guarantee::oscillator::guaranteed;
use hopfscope::portrait::{self, Portrait};
use hopfscope::report::motion::motion;
use hopfscope::report::{self, About, Answer, Format};
use hopfscope::words::one_of;
use hopfscope::words::provenance::Provenance;
use numpy::PyReadonlyArray1;
use pyo3::prelude::*;
use serde_json::Value;

use crate::found::{Found, InputError, unanswered};
use crate::interrupt::hearing;
use crate::source::{Machine, Parameters};

/// What a question is about.
#[derive(FromPyObject)]
pub enum Source<'py> {
    Parameters(Bound<'py, Parameters>),
    Machine(Bound<'py, Machine>),
}

/// The words of the command line for a question about these parameters.
fn words(command: &str, parameters: &Numbers) -> Vec<String> {
    let numbers = Knob::PARAMETERS.into_iter().zip(parameters.numbers());
    let set = |(knob, value): (Knob, f64)| ["--set".to_owned(), format!("{knob}={value:?}")];
    std::iter::once(command.to_owned()).chain(numbers.flat_map(set)).collect()
}

/// Why a number is refused.
fn refused(why: RangeError) -> PyErr {
    InputError::new_err(why.to_string())
}

/// The document of an answer, with where it comes from.
fn document(answer: Answer, words: &[String]) -> Value {
    answer.from(&Provenance::of(words)).document()
}

/// Every limit cycle, without a proof.
#[pyfunction]
pub fn cycles(py: Python<'_>, parameters: &Parameters) -> PyResult<Found> {
    let (numbers, started) = (parameters.0, Instant::now());
    let found = hearing(py, |limits: &Limits| portrait::cycles(&numbers, limits))?;
    let found = found.map_err(unanswered("the search gave up"))?;
    let seconds = started.elapsed().as_secs_f64();
    Ok(Found::new(move || {
        let answer = report::cycles::cycles(&found, None, None, seconds);
        document(answer, &words("cycles", &numbers))
    }))
}

/// The margin, nominal and guaranteed.
#[pyfunction]
pub fn margin(py: Python<'_>, parameters: &Parameters, disturbance: f64) -> PyResult<Found> {
    Knob::Disturbance.check(disturbance).map_err(refused)?;
    let (numbers, started) = (parameters.0, Instant::now());
    let known = ParameterBox::from(&numbers);
    let found = hearing(py, |limits: &Limits| {
        let nominal = Portrait::innermost(&numbers, 0.0, limits)?;
        let certain = guaranteed(&known, disturbance, 0.0, limits)?;
        Ok((nominal, certain))
    })?;
    let (nominal, certain) = found.map_err(unanswered("the margin could not be computed"))?;
    let seconds = started.elapsed().as_secs_f64();
    Ok(Found::new(move || {
        let about = About::boxed(&known).told_as(Format::Json);
        let answer = report::margin::of_box(&about, &nominal, certain, disturbance, seconds);
        let mut words = words("margin", &numbers);
        if disturbance > 0.0 {
            words.extend(["--disturbance".to_owned(), format!("{disturbance:?}")]);
        }
        document(answer, &words)
    }))
}

/// The motion of the oscillator or of a machine, as far as its own end or another, and at times.
#[pyfunction]
#[pyo3(signature = (source, *, q0 = None, v0 = None, until = None, method = None, tol = None, times = None))]
#[expect(clippy::too_many_arguments, reason = "each is an option of the command line")]
pub fn trajectory(
    py: Python<'_>,
    source: Source<'_>,
    q0: Option<f64>,
    v0: Option<f64>,
    until: Option<f64>,
    method: Option<&str>,
    tol: Option<f64>,
    times: Option<PyReadonlyArray1<'_, f64>>,
) -> PyResult<(Found, Option<String>)> {
    let (mut subject, about, mut words) = match &source {
        Source::Parameters(it) => {
            let problem = Problem { parameters: it.get().0, ..Problem::default() };
            (
                problem.into(),
                About::boxed(&ParameterBox::from(&it.get().0)),
                words("trajectory", &it.get().0),
            )
        }
        Source::Machine(it) => {
            let Machine { case, words, .. } = it.get();
            let subject: Subject = case.described.subject.clone();
            let about = About::new(&case.described.name, &case.described.title, &subject.source);
            (subject, about, [&["trajectory".to_owned()], &words[..]].concat())
        }
    };
    for (knob, value) in [(Knob::Q0, q0), (Knob::V0, v0), (Knob::Until, until)] {
        let Some(value) = value else { continue };
        knob.check(value).map_err(refused)?;
        subject.set(knob, value).map_err(InputError::new_err)?;
        words.extend(match knob {
            Knob::Until => ["--until".to_owned(), format!("{value:?}")],
            _ => ["--set".to_owned(), format!("{knob}={value:?}")],
        });
    }
    let (mut problem, model) = subject.problem().map_err(unanswered("no motion"))?;
    if let Some(name) = method {
        let methods = METHODS.iter().map(|row| (row.name, row.method));
        problem.method = one_of("method", name, methods).map_err(InputError::new_err)?;
        words.extend(["--method".to_owned(), name.to_owned()]);
    }
    if let Some(tol) = tol {
        problem.tolerance = Knob::Tolerance.check(tol).map_err(refused)?;
        words.extend(["--tol".to_owned(), format!("{tol:?}")]);
    }
    let times = times.map(|times| times.as_array().to_vec());
    if let Some(times) = &times {
        let is_outside = |time: &&f64| !(0.0..=problem.until).contains(*time);
        if let Some(time) = times.iter().find(is_outside) {
            let range = format!("{time:?} is outside of the motion, 0 .. {:?}", problem.until);
            return Err(InputError::new_err(format!("times: {range}, see until")));
        }
        words.extend(["--times", "/dev/stdin"].map(str::to_owned));
    }
    let detail = Detail { energy: true, ..Detail::default() };
    let started = Instant::now();
    let (found, samples) = hearing(py, |limits: &Limits| match &times {
        Some(times) => problem.at_times(model.as_ref(), times, detail, limits),
        None => (problem.followed(model.as_ref(), detail, limits), Vec::new()),
    })?;
    let seconds = started.elapsed().as_secs_f64();
    let trouble = found.outcome.answered().err().map(|why| why.to_string());
    let answer = Found::new(move || {
        let rows = times.map(|times| times.into_iter().zip(samples).collect::<Vec<_>>());
        let about = about.told_as(Format::Json);
        document(motion(&about, &found, None, seconds).sampled(rows.as_deref()), &words)
    });
    Ok((answer, trouble))
}
