//! The limit cycles, found by the search and then proved.
//!
//! The two share no code but the parameters. Where both are sure and differ, one of them is wrong, and the
//! answer is a [`Contradiction`] instead of either.

use thiserror::Error;

use super::{Cycle, Cycles, Portrait};
use crate::model::Parameters;
use crate::numerics::Interval;
use crate::proof::{ParameterBox, Proof, ProvedCycle, ProvedKicks, kicks, prove};

/// The search and the proof say different things: an error of this program.
#[derive(Clone, Debug, PartialEq, Error)]
#[error(
    "search and proof contradict each other, so that one of them is wrong: {what}; please report these parameters"
)]
pub struct Contradiction {
    /// What differs.
    pub what: String,
}

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
        let is_open = |gap: &Interval| is_near(*gap, cycle.clearance);
        if matching(proof, cycle).is_none() && !proof.open.iter().any(is_open) {
            return contradiction(format!("there is no cycle with q_max = {:?}", cycle.q_max));
        }
    }
    for proved in &proof.cycles {
        let is_it = |cycle: &&Cycle| matching(proof, cycle) == Some(proved);
        return contradiction(match found.iter().filter(is_it).count() {
            1 => continue,
            0 => format!("a cycle with a clearance in {} was not found", proved.within),
            more => format!("{more} of the cycles found are the same one"),
        });
    }
    Ok(())
}

/// What is proved about the edge of the basin of the oscillator with these parameters, of which this was found.
pub fn proved_kicks(parameters: &Parameters, found: &Portrait) -> ProvedKicks {
    let proof = prove(&ParameterBox::from(parameters), &[]);
    agreed(kicks(&proof, &found.margin), found)
}

/// What is proved about the edge of a basin; nothing where the search says otherwise.
pub fn agreed(proved: ProvedKicks, found: &Portrait) -> ProvedKicks {
    const DIFFERENT: &str = "not proved, because the proof contradicts the numbers above";
    let agree = |(bounds, value): (&Option<Interval>, &Option<f64>)| {
        bounds.zip(*value).is_none_or(|(bounds, value)| is_near(bounds, value))
    };
    let same = proved.edge.is_none_or(|edge| edge == found.border);
    if same && proved.sizes.all().into_iter().zip(found.margin.all()).all(agree) {
        return proved;
    }
    ProvedKicks { open: Some(DIFFERENT), ..ProvedKicks::default() }
}

/// The proved cycle that a cycle of the search is, if there is one.
///
/// Next to a fold two cycles may both be near: one of them attracts, the other repels.
pub fn matching<'a>(proof: &'a Proof, cycle: &Cycle) -> Option<&'a ProvedCycle> {
    let place = |it: &ProvedCycle| it.enclosure.map_or(it.within, |it| it.clearance);
    let mut alike = proof.cycles.iter().filter(|proved| proved.stable == cycle.stable);
    alike.find(|proved| is_near(place(proved), cycle.clearance))
}

/// Whether a number of the search is off its enclosure at most by what rounding explains.
fn is_near(enclosure: Interval, value: f64) -> bool {
    /// Relative distance, for rounding of steep and of flat maps.
    const ROUNDING: f64 = 1e-6;
    let slack = ROUNDING * value;
    enclosure.lower() - slack <= value && value <= enclosure.upper() + slack
}
