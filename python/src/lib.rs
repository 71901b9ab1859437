//! The Python package `hopfscope`: a thin face of the library.
//!
//! A question is put in the words of the command line ([`asked`]), so that it knows every option and refuses in the same
//! lines. Three questions are asked so often, and are answered so fast, that they go to the library at once ([`direct`]).
//! Every answer is a document, the one that the program prints as JSON; [`columns`] makes Python objects and arrays of it.

mod asked;
mod columns;
mod direct;
mod found;
mod interrupt;
mod source;

/// What the package in Python imports.
#[pyo3::pymodule]
mod _hopfscope {
    #[pymodule_export]
    use super::asked::{ask, scan};
    #[pymodule_export]
    use super::direct::{cycles, margin, trajectory};
    #[pymodule_export]
    use super::found::Found;
    #[pymodule_export]
    use super::source::{Machine, Parameters};

    use std::ffi::OsString;
    use std::sync::atomic::Ordering;

    use hopfscope::runtime::{provenance_file::WORDS, standard::CLOSED};
    use pyo3::prelude::*;

    /// Runs the program with these words, the first of which is its name; returns the exit code.
    #[pyfunction]
    fn program(py: Python<'_>, words: Vec<OsString>, is_closed: bool) -> u8 {
        CLOSED.store(is_closed, Ordering::Relaxed);
        // The program runs once a process, and then ends it.
        let _ = WORDS.set(words);
        py.detach(hopfscope::cli::main)
    }
}
