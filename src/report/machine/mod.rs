//! The motions of a mass on a belt or of a vibration mode, in physical units; for a belt also by the oscillator of
//! the paper.

mod document;
mod expansion;
mod quantities;
mod text;

use super::answer::PLACES;
use super::cycle_numbers::machine_cycles;
use super::cycles::{NO_CYCLE, known, steps};
use super::margin::{GUARANTEED, margin_columns};
use super::page::SourceFile;
use super::{About, Answer, Columns};
use crate::model::{Interval, Knob, Tolerances};
use crate::portrait::design::{FrictionNeeded, Kick};
use crate::portrait::guarantee::Uncertain;
use crate::portrait::{Course, CubicExpansion, Cycle, Margin};
use crate::words::provenance::Provenance;

/// A part of a window; `None` if it is not known.
pub type RestShare = Option<f64>;

/// The whole answer about a mass on a belt or a vibration mode.
pub struct MachineAnswer<'a> {
    pub about: &'a About,
    /// Displacement (m) and velocity (m/s) at the start.
    pub start: (f64, f64),
    pub course: Course,
    /// The fraction of the starts in a window from which the mass comes to rest, if asked for; of that `None` where motions
    /// from the window leave the range that is known.
    pub rest_share: Option<RestShare>,
    /// The friction needed for a margin, if asked for.
    pub design: Option<DesignAnswer>,
    /// `None` for a mode.
    pub on_belt: Option<OnBelt<'a>>,
    pub seconds: f64,
}

/// The part of the answer that only a mass on a belt has.
pub struct OnBelt<'a> {
    pub expansion: CubicExpansion,
    pub tolerances: &'a Tolerances,
    /// The kicks that are survived for certain, or why none is; `None` if not asked for.
    pub certain: Option<Result<Margin, Uncertain>>,
}

impl OnBelt<'_> {
    /// The numbers that are not known exactly, each with its interval in SI units.
    pub(super) fn uncertain(&self) -> Vec<(Knob, Interval)> {
        self.tolerances.intervals(&self.expansion.belt)
    }
}

/// The friction needed for a margin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DesignAnswer {
    /// The kick that is to be survived.
    pub kick: Kick,
    /// Its size: m for a displacement, N s for an impulse.
    pub wanted: f64,
    /// The friction needed, in N.
    pub needed: FrictionNeeded,
    /// Speed of the belt in m/s; `None` for a mode.
    pub at: Option<f64>,
    /// The friction that the machine has, in N.
    pub has: f64,
}

/// The whole answer about a machine.
pub fn machine<'a>(found: &'a MachineAnswer) -> Answer<'a> {
    let MachineAnswer { about, course, on_belt, .. } = found;
    let (about, portrait) = (*about, &course.portrait);
    let belt = on_belt.as_ref();
    let guaranteed = belt.and_then(|belt| belt.certain?.ok());
    let margins = [("nominal", portrait.margin)].into_iter();
    let margins = margins.chain(guaranteed.map(|margin| (GUARANTEED, margin)));
    let kicks = Columns::default()
        .text("smallest kick that is not survived", |(name, _): &(&str, Margin)| (*name).to_owned())
        .and(margin_columns(about, PLACES));
    let (statement, holds) = text::statement(found);
    let friction = belt
        .map(|OnBelt { expansion, .. }| text::friction(&expansion.belt.law, &expansion.reduced.mu));
    let numbers = belt.into_iter().flat_map(|belt| quantities::of_belt(&belt.expansion, portrait));
    about
        .answer()
        .fields(move |all| document::document(all, found))
        .csv(quantities::columns(), quantities::rows(found))
        .statement(statement, holds)
        .lines(known(portrait))
        .heading("Margins")
        .captioned(belt.and_then(text::allowance).unwrap_or_default(), move || {
            kicks.table(margins).transposed()
        })
        .heading("Machine")
        .table(quantities::columns(), numbers)
        .lines(friction)
        .heading("Cycles")
        .table(machine_cycles(|cycle: &Cycle| Some(*cycle)), &portrait.cycles)
        .lines(portrait.cycles.is_empty().then_some(NO_CYCLE))
        .heading("Remarks")
        .lines(text::remarks(found))
        .cost(steps(portrait), found.seconds)
}

/// The page of a machine: with its pictures, what computed it, and the files of the machine.
pub fn page(
    answer: &MachineAnswer,
    pictures: &[String],
    provenance: &Provenance,
    sources: &[SourceFile],
) -> String {
    let kind = if answer.on_belt.is_some() { "A mass on a belt" } else { "A vibration mode" };
    machine(answer).page(kind, pictures, provenance, sources)
}
