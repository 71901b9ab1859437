//! The limit cycles, found by the search and then proved.
//!
//! The two share no code but the parameters. Where both are sure and differ, one of them is wrong, and the
//! answer is a [`Contradiction`] instead of either.

use std::fmt;

use super::cycle::{Cycle, Cycles};
use crate::proof::cycles::{Proof, ProvedCycle, prove};
use crate::proof::field::ParameterBox;

/// The search and the proof say different things: an error of this program.
#[derive(Clone, Debug, PartialEq)]
pub struct Contradiction {
    /// What differs.
    pub what: String,
}

impl fmt::Display for Contradiction {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            out,
            "search and proof contradict each other, so that one of them is wrong: {}; please report these \
             parameters",
            self.what
        )
    }
}

impl std::error::Error for Contradiction {}

/// Proves what the search found, for the parameters as the doubles that they are. Fails with a [`Contradiction`]
/// where the proof excludes a cycle that was found, or proves one that was not.
pub fn proved(found: &Cycles) -> Result<Proof, Contradiction> {
    let hints: Vec<f64> = found.cycles.iter().map(|cycle| cycle.clearance).collect();
    let proof = prove(&ParameterBox::from(&found.parameters), &hints);
    compare(&found.cycles, &proof)?;
    Ok(proof)
}

/// Compares the cycles of the search with a proof. Fails with a [`Contradiction`] where they differ.
pub fn compare(found: &[Cycle], proof: &Proof) -> Result<(), Contradiction> {
    let contradiction = |what| Err(Contradiction { what });
    for cycle in found {
        let clearance = cycle.clearance;
        let open = proof.open.iter().any(|it| (it.lower..=it.upper).contains(&clearance));
        if matching(proof, cycle).is_none() && !open {
            return contradiction(format!("there is no cycle with q_max = {:?}", cycle.q_max));
        }
    }
    for proved in &proof.cycles {
        let inside = |cycle: &&Cycle| is_match(proved, cycle);
        match found.iter().filter(inside).count() {
            1 => {}
            0 => {
                let within = proved.within;
                return contradiction(format!(
                    "a cycle with a clearance in {within} was not found"
                ));
            }
            more => {
                return contradiction(format!("{more} of the cycles found are the same one"));
            }
        }
    }
    Ok(())
}

/// The proved cycle that a cycle of the search is, if there is one.
pub fn matching<'a>(proof: &'a Proof, cycle: &Cycle) -> Option<&'a ProvedCycle> {
    proof.cycles.iter().find(|proved| is_match(proved, cycle))
}

/// Whether a cycle of the search is a proved one: its clearance is that far off at most that rounding explains.
fn is_match(proved: &ProvedCycle, cycle: &Cycle) -> bool {
    /// Relative distance of a number of the search from its enclosure, for rounding of steep and of flat maps.
    const ROUNDING: f64 = 1e-6;
    let near = proved.enclosure.map_or(proved.within, |it| it.clearance);
    let slack = ROUNDING * cycle.clearance;
    near.lower() - slack <= cycle.clearance && cycle.clearance <= near.upper() + slack
}
