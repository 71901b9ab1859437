//! The energy ledger as lines: the work of every source, for each cycle and for the motions.
//!
//! Line `i` lies between the heights `-i` and `-i - 1` of the view's world, so that the view draws the same
//! lines at every size and the cursor points at one of them.

use crate::flow::MachineLedger;
use crate::model::{Ledger, Parameters, State};
use crate::numerics::count::real;
use crate::portrait::Cycle;
use crate::portrait::basin::orbit::works_until;
use crate::scene::Layer;
use crate::session::Session;

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
        let whole = self.draws_whole();
        if self.layers.contains(&Layer::CycleWorks)
            && let Some(found) = self.cycles()
        {
            let picture = found.picture.iter().filter(|_| !whole);
            let works = picture.flat_map(|picture| &picture.works);
            let works = works.map(|ledger| WorkTable::of(ledger, &found.parameters));
            let kinds = self.kinds().into_iter().filter(|_| whole);
            let by_machine = kinds.flat_map(|kinds| &kinds.works).map(WorkTable::of_machine);
            for (cycle, works) in found.cycles.iter().zip(works.chain(by_machine)) {
                works.add_to(&mut lines, Owner::Cycle(*cycle), None);
            }
        }
        if self.layers.contains(&Layer::MotionWorks) {
            let owner = |place| Owner::Motion(place, self.number(place));
            if let Some(course) = self.course().filter(|_| whole) {
                WorkTable::of_machine(&course.ledger).add_to(&mut lines, owner(0), None);
            }
            for (place, found) in self.motions().into_iter().filter(|_| !whole) {
                let Some(ledger) = &found.ledger else { continue };
                let parameters = &found.problem.parameters;
                let head = self.head().filter(|_| place == 0);
                let until = head.and_then(|head| works_until(found, head.tau));
                let until = until.map(|until| WorkTable::of(&until, parameters));
                WorkTable::of(ledger, parameters).add_to(&mut lines, owner(place), until);
            }
        }
        lines
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

/// The works of one owner.
struct WorkTable {
    /// The sources of energy that the model has, each with the energy that it supplied.
    sources: Vec<(&'static str, f64)>,
    /// The energy gained.
    stored: f64,
    /// The energy that the sources do not account for.
    residual: f64,
}

impl WorkTable {
    fn of(ledger: &Ledger, parameters: &Parameters) -> Self {
        let Parameters { d, d2, d3, r } = *parameters;
        let sources = [
            (d, "linear", ledger.linear),
            (d2, "quadratic", ledger.quadratic),
            (d3, "cubic", ledger.cubic),
            (r, "friction", ledger.friction),
        ];
        let there = sources.into_iter().filter(|(strength, ..)| *strength != 0.0);
        WorkTable {
            sources: there.map(|(_, source, work)| (source, work)).collect(),
            stored: ledger.end - ledger.start,
            residual: ledger.residual,
        }
    }

    /// The works by the whole model of a machine.
    fn of_machine(ledger: &MachineLedger) -> Self {
        let MachineLedger { start, end, belt, damper, guide } = *ledger;
        let sources = [("belt", belt), ("damper", -damper), ("guide", -guide)];
        WorkTable {
            sources: sources.into_iter().filter(|(_, work)| *work != 0.0).collect(),
            stored: end - start,
            residual: end - start - (belt - damper - guide),
        }
    }

    /// Adds the lines of the owner, with the works until the present moment if these are given.
    fn add_to(mut self, lines: &mut Vec<LedgerLine>, owner: Owner, until: Option<WorkTable>) {
        let so_far = until.iter().flat_map(|until| &until.sources).map(|(_, work)| *work);
        let mut so_far: Vec<f64> = so_far.collect();
        if matches!(owner, Owner::Motion(..)) {
            self.sources.push(("stored", self.stored));
            so_far.extend(until.map(|until| until.stored));
        }
        let sizes = self.sources.iter().map(|(_, work)| work.abs());
        let largest = sizes.fold(0.0, f64::max);
        let part = |work: f64| if largest > 0.0 { work / largest } else { 0.0 };
        lines.push(LedgerLine::Title(owner));
        for (index, (source, work)) in self.sources.into_iter().enumerate() {
            let so_far = so_far.get(index).copied().map(part);
            lines.push(LedgerLine::Work { source, work, part: part(work), so_far });
        }
        lines.push(LedgerLine::Residual(part(self.residual)));
    }
}
