//! The energy ledger as lines: for each cycle and for the motion, what every source did.
//!
//! Line `i` stands between the heights `-i` and `-i - 1` of the view's world, so that the view draws the
//! same lines at every size and the cursor points at one of them.

use super::state::Session;
use crate::oscillator::{Ledger, Parameters, State};
use crate::scene::Layer;
use crate::study::Cycle;

/// Whose energy it is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Owner {
    /// One turn of a cycle.
    Cycle(Cycle),
    /// The motion on show, from its start to its end.
    Motion,
}

/// A line of the ledger.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Entry {
    /// Whose works the lines below are.
    Title(Owner),
    /// What a source did, and as a part of the largest work of its owner.
    Work {
        /// The source.
        source: &'static str,
        /// Energy that it gave; negative where it took.
        work: f64,
        /// The same as a part of the largest.
        part: f64,
    },
    /// What is missing, as a part of the largest work.
    Residual(f64),
}

impl Session {
    /// The lines of the energy ledger, of the layers that are on.
    #[must_use]
    pub fn ledger(&self) -> Vec<Entry> {
        let mut lines = Vec::new();
        if self.layers.contains(&Layer::CycleWorks)
            && let Some(found) = self.cycles()
        {
            let works = found.picture.iter().flat_map(|picture| &picture.works);
            for (cycle, ledger) in found.cycles.iter().zip(works) {
                add(&mut lines, Owner::Cycle(*cycle), ledger, &found.parameters);
            }
        }
        if self.layers.contains(&Layer::MotionWorks)
            && let Some(found) = self.trajectory()
            && let Some(ledger) = &found.ledger
        {
            add(&mut lines, Owner::Motion, ledger, &found.problem.parameters);
        }
        lines
    }

    /// The state that a line of the ledger leads to: a start on its cycle, or the start of the motion.
    #[must_use]
    pub fn start_of_line(&self, height: f64) -> Option<State> {
        let lines = self.ledger();
        let line = lines.iter().enumerate().rev().find(|(index, entry)| {
            #[expect(clippy::cast_precision_loss, reason = "a few dozen lines")]
            let top = -(*index as f64);
            matches!(entry, Entry::Title(_)) && height <= top
        });
        match line {
            Some((_, Entry::Title(Owner::Cycle(cycle)))) => Some(State { q: cycle.q_max, v: 0.0 }),
            Some((_, Entry::Title(Owner::Motion))) => Some(self.problem.initial),
            _ => None,
        }
    }
}

/// Adds the lines of one owner; a term that the model does not have gets none.
fn add(lines: &mut Vec<Entry>, owner: Owner, ledger: &Ledger, parameters: &Parameters) {
    let Parameters { d, d2, d3, r } = *parameters;
    let stored = ledger.end - ledger.start;
    let sources = [
        ("linear", d, ledger.linear),
        ("quadratic", d2, ledger.quadratic),
        ("cubic", d3, ledger.cubic),
        ("friction", r, ledger.friction),
    ];
    let largest = sources.iter().map(|(_, _, work)| work.abs()).fold(stored.abs(), f64::max);
    let part = |work: f64| if largest > 0.0 { work / largest } else { 0.0 };
    lines.push(Entry::Title(owner));
    let present = sources.iter().filter(|(_, strength, _)| *strength != 0.0);
    lines.extend(present.map(|(source, _, work)| Entry::Work {
        source,
        work: *work,
        part: part(*work),
    }));
    if owner == Owner::Motion {
        lines.push(Entry::Work { source: "stored", work: stored, part: part(stored) });
    }
    lines.push(Entry::Residual(part(ledger.residual)));
}
