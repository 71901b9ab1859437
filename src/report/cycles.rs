//! The limit cycles, with what is proved about them.

use serde::Serialize;

use super::csv;
use super::json::{self, CountedCost};
use super::proof::{self, CycleBounds, certain, enclosure};
use super::table::{Table, parameters};
use super::{basin, harmonic_balance};
use crate::closed_form::harmonic::Harmonic;
use crate::oscillator::Parameters;
use crate::portrait::{Border, Cycle, CycleErrors};
use crate::proof::cycles::Proof;
use crate::proof::enclose::Enclosure;
use crate::study::Cycles;
use crate::study::harmonic_error::HarmonicBalance;
use crate::words::number::{duration, significant};
use crate::words::stability;

#[derive(Serialize)]
struct Basin {
    edge: Border,
}

#[derive(Serialize)]
struct CycleDocument<'a> {
    parameters: &'a Parameters,
    cycles: Vec<proof::ProvedCycleDocument<'a>>,
    count: proof::Count<'a>,
    harmonic: &'a [Harmonic],
    #[serde(skip_serializing_if = "Option::is_none")]
    balance: Option<Vec<harmonic_balance::BalanceRow>>,
    basin: Basin,
    cost: CountedCost,
}

/// Every cycle with what is proved about it, and the harmonic balance if asked for.
pub fn json(
    found: &Cycles,
    proof: &Proof,
    rungs: Option<&[HarmonicBalance]>,
    seconds: f64,
) -> String {
    json::text(&CycleDocument {
        parameters: &found.parameters,
        cycles: proof::rows(&found.cycles, proof),
        count: proof::count(proof),
        harmonic: &found.harmonic,
        balance: rungs.map(harmonic_balance::rows),
        basin: Basin { edge: found.border },
        cost: CountedCost { counted: found.cost, seconds },
    })
}

/// One row for each cycle and one for each interval of clearances that is open.
pub fn csv(found: &Cycles, proof: &Proof) -> String {
    #[derive(Serialize)]
    struct CycleRow<'a> {
        #[serde(flatten)]
        cycle: Option<&'a Cycle>,
        certified: CycleBounds,
    }
    let cycles = found.cycles.iter().map(|cycle| CycleRow {
        cycle: Some(cycle),
        certified: CycleBounds::of(enclosure(proof, cycle)),
    });
    let open = CycleBounds::open(proof).map(|certified| CycleRow { cycle: None, certified });
    let like = CycleRow {
        cycle: Some(&Cycle { errors: Some(CycleErrors::default()), ..Cycle::default() }),
        certified: CycleBounds::like(),
    };
    csv::sheet(&like, cycles.chain(open))
}

/// Titles of the columns that describe a cycle.
pub(super) const COLUMNS: [&str; 8] =
    ["cycle", "q_min", "q_max", "v_min", "v_max", "period", "multiplier", "clearance"];

/// The cells of these columns.
pub(super) fn cells(cycle: &Cycle, places: usize) -> Vec<String> {
    let multiplier = match cycle.multiplier {
        Some(multiplier) => significant(multiplier, places),
        None => format!("exp({})", significant(cycle.log_multiplier, places)),
    };
    let clearance = if cycle.clearance > 0.0 {
        significant(cycle.clearance, places)
    } else {
        format!("exp({})", significant(cycle.log_clearance, places))
    };
    let mut cells = vec![stability(cycle.stable).to_owned()];
    let numbers = [cycle.q_min, cycle.q_max, cycle.v_min, cycle.v_max, cycle.period];
    cells.extend(numbers.map(|value| significant(value, places)));
    cells.extend([multiplier, clearance]);
    cells
}

/// These cells, with the digits that are certain.
fn certain_cycle(cycle: &Cycle, bounds: &Enclosure, places: usize) -> Vec<String> {
    let mut cells = self::cells(cycle, places);
    let Enclosure { q_min, q_max, v_min, v_max, period, multiplier, clearance } = *bounds;
    let numbers = [q_min, q_max, v_min, v_max, period, multiplier, clearance];
    for (cell, bounds) in cells.iter_mut().skip(1).zip(numbers) {
        *cell = certain(bounds, places);
    }
    cells
}

/// Every cycle to the digits that are proved, the answer of harmonic balance, and the border of the basin.
pub fn table(found: &Cycles, proof: &Proof, seconds: f64) -> String {
    /// Digits shown; cycles are computed to rounding error.
    const PLACES: usize = 12;
    let mut out = format!("{}\n\n", parameters(&found.parameters, None));
    if !found.cycles.is_empty() {
        let mut table = Table::new(&COLUMNS);
        for found in &found.cycles {
            table.row(if let Some(bounds) = enclosure(proof, found) {
                certain_cycle(found, &bounds, PLACES)
            } else {
                let mut cells = self::cells(found, PLACES - 2);
                cells[0] += ", not proved";
                cells
            });
        }
        let table = table.to_string();
        out += &format!("{table}\n{}", proof::uncertain(&table));
    }
    out += &proof::sentence(found.cycles.len(), proof);
    out += "\nby one harmonic, for comparison: ";
    if found.harmonic.is_empty() {
        out += "none\n";
    }
    for (index, harmonic) in found.harmonic.iter().enumerate() {
        out += &format!(
            "{}{} amplitude {}, mean {}",
            if index == 0 { "" } else { "; " },
            stability(harmonic.stable),
            significant(harmonic.amplitude, 6),
            significant(harmonic.mean, 6),
        );
    }
    if !found.harmonic.is_empty() {
        out.push('\n');
    }
    out += basin::border(found.border);
    out += &format!("{} evaluations, {}\n", found.cost.evaluations, duration(seconds));
    out
}
