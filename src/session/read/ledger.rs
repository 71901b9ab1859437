//! The energy ledger as lines: the work of every source, for each cycle and for the motions.
//!
//! Line `i` lies between the heights `-i` and `-i - 1` of the view's world, so that the view draws the same
//! lines at every size and the cursor points at one of them.

use crate::machine;
use crate::numerics::count::real;
use crate::oscillator::{Ledger, Parameters, State};
use crate::portrait::Cycle;
use crate::scene::Layer;
use crate::session::state::session::Session;
use crate::study::works::works_until;

/// The owner of a part of the ledger.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Owner {
    /// One turn of a cycle.
    Cycle(Cycle),
    /// A motion on show from its start to its end, by its index among these and its number.
    Motion(usize, Option<usize>),
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LedgerLine {
    /// The owner of the works in the lines below.
    Title(Owner),
    /// The work of a source.
    Work {
        source: &'static str,
        /// Energy that the source supplied; negative if it took energy.
        work: f64,
        /// The work as a fraction of the largest work of its owner.
        part: f64,
        /// The work until the moment of playback, as the same fraction; only for the motion.
        so_far: Option<f64>,
    },
    /// The energy that the works do not account for, as a fraction of the largest work.
    Residual(f64),
}

impl Session {
    /// The lines of the energy ledger, for the layers that are on.
    pub fn ledger(&self) -> Vec<LedgerLine> {
        let mut lines = Vec::new();
        if self.draws_whole() {
            self.ledger_of_machine(&mut lines);
            return lines;
        }
        if self.layers.contains(&Layer::CycleWorks)
            && let Some(found) = self.cycles()
        {
            let works = found.picture.iter().flat_map(|picture| &picture.works);
            for (cycle, ledger) in found.cycles.iter().zip(works) {
                add(&mut lines, Owner::Cycle(*cycle), ledger, None, &found.parameters);
            }
        }
        if self.layers.contains(&Layer::MotionWorks) {
            for (place, found) in self.motions() {
                let Some(ledger) = &found.ledger else { continue };
                let head = self.head().filter(|_| place == 0);
                let until = head.and_then(|head| works_until(found, head.tau));
                let owner = Owner::Motion(place, self.number(place));
                add(&mut lines, owner, ledger, until.as_ref(), &found.problem.parameters);
            }
        }
        lines
    }

    /// The lines of a machine by the whole model.
    fn ledger_of_machine(&self, lines: &mut Vec<LedgerLine>) {
        if self.layers.contains(&Layer::CycleWorks)
            && let (Some(found), Some(kinds)) = (self.cycles(), self.kinds())
        {
            for (cycle, ledger) in found.cycles.iter().zip(&kinds.works) {
                add_works(lines, Owner::Cycle(*cycle), ledger);
            }
        }
        if self.layers.contains(&Layer::MotionWorks)
            && let Some(course) = self.course()
        {
            add_works(lines, Owner::Motion(0, self.number(0)), &course.ledger);
        }
    }

    /// The start that a line of the ledger leads to: on its cycle, or that of its motion.
    pub fn start_of_line(&self, height: f64) -> Option<State> {
        let lines = self.ledger();
        let line = lines.iter().enumerate().rev().find(|(index, entry)| {
            let top = -(real(*index));
            matches!(entry, LedgerLine::Title(_)) && height <= top
        });
        match line {
            Some((_, LedgerLine::Title(Owner::Cycle(cycle)))) => {
                Some(State { q: cycle.q_max, v: 0.0 })
            }
            Some((_, LedgerLine::Title(Owner::Motion(place, _)))) => {
                self.problems().get(*place).map(|problem| problem.initial)
            }
            _ => None,
        }
    }
}

/// Adds the lines of one owner by the whole model.
fn add_works(lines: &mut Vec<LedgerLine>, owner: Owner, ledger: &machine::MachineLedger) {
    let machine::MachineLedger { start, end, belt, damper, guide } = *ledger;
    let works = [("belt", belt), ("damper", -damper), ("guide", -guide)];
    let stored = matches!(owner, Owner::Motion(..)).then_some(("stored", end - start));
    let largest = works.iter().chain(&stored).map(|(_, work)| work.abs()).fold(0.0, f64::max);
    let part = |work: f64| if largest > 0.0 { work / largest } else { 0.0 };
    lines.push(LedgerLine::Title(owner));
    for (source, work) in works.into_iter().filter(|(_, work)| *work != 0.0).chain(stored) {
        lines.push(LedgerLine::Work { source, work, part: part(work), so_far: None });
    }
    lines.push(LedgerLine::Residual(part(end - start - (belt - damper - guide))));
}

/// A source of energy: its name, its strength, and how to read its work.
type EnergySource = (&'static str, f64, fn(&Ledger) -> f64);

/// Adds the lines of one owner, with the works until the present moment if `until` is given; terms that the
/// model does not have get no line.
fn add(
    lines: &mut Vec<LedgerLine>,
    owner: Owner,
    ledger: &Ledger,
    until: Option<&Ledger>,
    parameters: &Parameters,
) {
    let Parameters { d, d2, d3, r } = *parameters;
    let sources: [EnergySource; 4] = [
        ("linear", d, |ledger| ledger.linear),
        ("quadratic", d2, |ledger| ledger.quadratic),
        ("cubic", d3, |ledger| ledger.cubic),
        ("friction", r, |ledger| ledger.friction),
    ];
    let stored = |ledger: &Ledger| ledger.end - ledger.start;
    let works = sources.iter().map(|(.., read)| read(ledger).abs());
    let largest = works.fold(stored(ledger).abs(), f64::max);
    let part = |work: f64| if largest > 0.0 { work / largest } else { 0.0 };
    lines.push(LedgerLine::Title(owner));
    let mut add = |source, read: fn(&Ledger) -> f64| {
        let work = read(ledger);
        let so_far = until.map(|until| part(read(until)));
        lines.push(LedgerLine::Work { source, work, part: part(work), so_far });
    };
    for (source, _, read) in sources.iter().filter(|(_, strength, _)| *strength != 0.0) {
        add(source, *read);
    }
    if matches!(owner, Owner::Motion(..)) {
        add("stored", stored);
    }
    lines.push(LedgerLine::Residual(part(ledger.residual)));
}
