//! The energy ledger as lines: the work of every source, for each cycle and for the motions.
//!
//! Line `i` lies between the heights `-i` and `-i - 1` of the view's world, so that the view draws the same
//! lines at every size and the cursor points at one of them.

use crate::model::{Ledger, State};
use crate::portrait::{Cycle, works_until};
use crate::scene::Layer;
use crate::session::Session;

/// The owner of a part of the ledger.
#[derive(Clone, Copy, Debug)]
pub enum Owner {
    /// One turn of a cycle.
    Cycle(Cycle),
    /// A motion on show from its start to its end, by its index among these and its number.
    Motion(usize, Option<usize>),
}

#[derive(Clone, Copy, Debug)]
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
            for (cycle, works) in found.cycles.iter().zip(&found.works) {
                add(&mut lines, Owner::Cycle(*cycle), works, None);
            }
        }
        if self.layers.contains(&Layer::MotionWorks) {
            for (place, found) in self.motions() {
                let Some(ledger) = found.ledger.as_ref().filter(|_| !whole || place == 0) else {
                    continue;
                };
                let head = self.head().filter(|_| place == 0 && !whole);
                let until = head.and_then(|head| works_until(found, head.tau));
                let owner = Owner::Motion(place, self.number(place));
                add(&mut lines, owner, ledger, until.as_ref());
            }
        }
        lines
    }

    /// The start that a line of the ledger leads to: on its cycle, or that of its motion.
    pub fn start_of_line(&self, height: f64) -> Option<State> {
        let lines = self.ledger().into_iter().zip(0_u32..);
        let owners = lines.filter_map(|(line, index)| match line {
            LedgerLine::Title(owner) if height <= -f64::from(index) => Some(owner),
            _ => None,
        });
        match owners.last()? {
            Owner::Cycle(cycle) => Some(State { q: cycle.q_max, v: 0.0 }),
            Owner::Motion(place, _) => self.problems().get(place).map(|problem| problem.initial),
        }
    }
}

/// Adds the lines of an owner, with the works until the present moment if these are given.
fn add(lines: &mut Vec<LedgerLine>, owner: Owner, ledger: &Ledger, until: Option<&Ledger>) {
    let sources = |ledger: &Ledger| {
        let stored = ("stored", ledger.end - ledger.start, matches!(owner, Owner::Motion(..)));
        let works = ledger.works.iter().map(|work| (work.source, work.amount, work.acts));
        works.chain([stored]).filter(|(.., acts)| *acts).collect::<Vec<_>>()
    };
    let so_far = until.map(sources).unwrap_or_default();
    let sources = sources(ledger);
    let largest = sources.iter().map(|(_, work, _)| work.abs()).fold(0.0, f64::max);
    let part = |work: f64| if largest > 0.0 { work / largest } else { 0.0 };
    lines.push(LedgerLine::Title(owner));
    for (index, (source, work, _)) in sources.into_iter().enumerate() {
        let so_far = so_far.get(index).map(|(_, work, _)| part(*work));
        lines.push(LedgerLine::Work { source, work, part: part(work), so_far });
    }
    lines.push(LedgerLine::Residual(part(ledger.residual)));
}
