//! The motions of a mass on a belt or of a vibration mode, in physical units; for a belt also by the oscillator of
//! the paper.

mod document;
mod expansion;
mod page;
mod text;

pub use page::page;
pub use text::{DesignAnswer, MachineAnswer, OnBelt, RestShare};

use super::Answer;
use super::cycles::steps;

/// The whole answer about a machine.
pub fn machine<'a>(found: &'a MachineAnswer) -> Answer<'a> {
    let (document, csv) = (|| document::document(found), || text::csv(found));
    found.about.answer(steps(&found.course.portrait), found.seconds, document, csv, || found.text())
}
