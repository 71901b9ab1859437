//! The limit cycles: of the oscillator of the paper with what is proved about them and the answers of harmonic balance,
//! of a machine in SI units.

use super::cycle_numbers::machine_cycles;
use super::{About, Answer, Columns, Document, PLACES, ProvedRow, Quantity, with_proof};
use crate::accuracy::{BalanceResult, HarmonicBalance};
use crate::closed_form::{Harmonic, HarmonicCycle, amplitudes};
use crate::flow::Sample;
use crate::model::Knob;
use crate::model::ParameterBox;
use crate::portrait::{Border, Cycle, Cycles, Portrait};
use crate::proof::Proof;
use crate::words::{stability, with_unit};

/// Every cycle, with what is proved about it, if that is known, to the digits that are proved in text; the border of the
/// basin; the harmonic balance if asked for.
pub fn cycles(
    found: &Cycles,
    proof: Option<&Proof>,
    rungs: Option<&[HarmonicBalance]>,
    seconds: f64,
) -> Answer {
    const SHORT: Quantity = Quantity::pure(6);
    let by_one = amplitudes(&found.parameters);
    let harmonic = Columns::default()
        .text("by one harmonic", |it: &Harmonic| stability(it.stable))
        .number("amplitude", SHORT, |it| it.amplitude)
        .number("mean", SHORT, |it| it.mean);
    let answer = About::boxed(&ParameterBox::from(&found.parameters)).answer();
    let answer = match proof {
        Some(proof) => with_proof(answer, &ProvedRow::found(&found.cycles, proof), proof),
        None => answer.with("cycles", &found.cycles),
    };
    let mut answer = answer
        .with("harmonic", &by_one)
        .with_any("balance", rungs.map(|rungs| balance_columns().objects(balances(rungs))))
        .with("basin", Document::of("edge", found.border))
        .lines([border(found.border)])
        .lines(by_one.is_empty().then_some("by one harmonic: no cycle"))
        .table(harmonic.table(by_one));
    if let Some(balances) = rungs.map(balances) {
        let table = balance_columns().table(&balances).captioned(BALANCE);
        answer = answer.csv(&balance_columns(), balances).table(table);
    }
    answer.cost(found.cost, seconds)
}

/// Every cycle of a machine, and what borders the basin.
pub fn of_machine(about: &About, found: &Portrait, seconds: f64) -> Answer {
    let columns = machine_cycles(|cycle: &Cycle| Some(*cycle));
    about
        .answer()
        .with("cycles", columns.objects(&found.cycles))
        // The number of cycles is not proved; where the search did not settle is known.
        .with("count", Document::of("proved", false).with("open", &found.unresolved))
        .with("neutral", found.neutral)
        .with("basin", Document::of("edge", found.border))
        .rows(&columns, &found.cycles)
        .lines(found.cycles.is_empty().then_some(NO_CYCLE))
        .portrayed(found, seconds)
}

impl Answer {
    /// With what is known of the motions of a machine, and what its portrait cost.
    pub fn portrayed(self, portrait: &Portrait, seconds: f64) -> Self {
        self.lines(known(portrait)).cost(portrait.cost, seconds)
    }
}

/// The value of what varies, if anything does, and the orbit of a cycle there, if it closes.
pub type OrbitRow = (f64, Option<Vec<Sample>>);

impl Answer {
    /// With orbits, if they are asked for: a field of each object in this list of its document, and rows of their points, by
    /// number in the list.
    pub fn orbits(self, list: &str, along: Option<Knob>, found: Option<Vec<OrbitRow>>) -> Self {
        let Some(found) = found else { return self };
        let along = along.map(|along| along.spec().name);
        let names: Vec<_> = ["cycle"].into_iter().chain(along).chain(["tau", "q", "v"]).collect();
        let rows = found.iter().zip(1_u32..).flat_map(|((value, orbit), number)| {
            let row = move |Sample { tau, q, v }: &Sample| {
                let of = along.map(|_| *value).into_iter().chain([*tau, *q, *v]);
                std::iter::once(number.into()).chain(of.map(Into::into)).collect()
            };
            orbit.iter().flatten().map(row)
        });
        let answer = self.points(None, &names, &rows.collect::<Vec<_>>());
        answer.extended(list, "orbit", found.iter().map(|(_, orbit)| orbit))
    }
}

/// What stands in place of an empty table of cycles.
pub(super) const NO_CYCLE: &str = "no cycle";

/// A line on the border of the basin of the sticking set of the oscillator of the paper.
pub(super) fn border(border: Border) -> String {
    let border = match border {
        Border::Cycle => "the smallest cycle",
        Border::Separatrix => "a separatrix",
        _ => "none",
    };
    format!("border of the basin of the sticking set: {border}")
}

/// The border of the basin of rest of a machine, and what is not known about its motions, a line each.
pub(super) fn known(portrait: &Portrait) -> Vec<String> {
    let border = match portrait.border {
        Border::Unknown(_) => "every kick within the margin is survived; larger ones are not known",
        Border::None => "every kick is survived: whatever happens, the mass comes to rest",
        Border::NoBasin => "no kick is survived, however small: rest repels",
        Border::Separatrix => "beyond the margin motions grow without bound",
        Border::Cycle => "beyond the margin an unstable cycle is crossed",
        Border::Grazing | Border::Capture if portrait.neutral => {
            "within the margin every motion is periodic; beyond it the mass sticks to the belt"
        }
        Border::Grazing => "beyond the margin the mass comes to stick to the belt",
        Border::Capture => {
            "beyond the margin the guide catches the mass no more, and it is carried off"
        }
    };
    let length = |x| with_unit(x, PLACES, "m");
    let limit = portrait.stop.map(|stop| {
        format!("motions that turn beyond x = {} are not known: {stop}", length(portrait.known))
    });
    let unresolved = portrait.unresolved.iter().map(|(from, to)| {
        let (from, to) = (length(*from), length(*to));
        format!("between x = {from} and {to} the search for cycles did not settle")
    });
    std::iter::once(border.to_owned()).chain(limit).chain(unresolved).collect()
}

/// The harmonic balance for one number of harmonics on the branch of one first-order answer. If the branch was lost
/// before, the row has no numbers and says why. A row without errors has no true cycle to be compared with.
type BalanceRow<'a> = (usize, &'a BalanceResult);

/// What the table of the harmonic balance shows.
const BALANCE: &str = "crossings: v = 0 at so many instants of a turn, a cycle at 2\n\
     errors: by a part of the number; without one there is no such cycle to compare with";

fn balance_columns<'a>() -> Columns<'a, BalanceRow<'a>> {
    /// Digits shown of a cycle, which is an approximation here.
    const NUMBER: Quantity = Quantity::pure(6);
    const ERROR: Quantity = Quantity::pure(3);
    fn of<'a>((_, balanced): &BalanceRow<'a>) -> Option<&'a HarmonicCycle> {
        balanced.cycle.as_ref().ok()
    }
    let described = |(harmonics, balanced): &BalanceRow| {
        format!("{harmonics} {}", stability(balanced.first.stable))
    };
    Columns::default()
        .text("harmonics", described)
        .file("harmonics", |(harmonics, _): &BalanceRow| *harmonics)
        .file("stable", |(_, balanced)| balanced.first.stable)
        .file("amplitude", |row| Some(of(row)?.amplitude()))
        .file("mean", |row| Some(of(row)?.mean))
        .number("q_min", NUMBER, |row| Some(of(row)?.q_min))
        .number("q_max", NUMBER, |row| Some(of(row)?.q_max))
        .number("v_min", NUMBER, |row| Some(of(row)?.v_min))
        .number("v_max", NUMBER, |row| Some(of(row)?.v_max))
        .number("period", NUMBER, |row| Some(of(row)?.period))
        .word("crossings", |row| Some(of(row)?.crossings))
        .number("residual", ERROR, |row| Some(of(row)?.residual))
        .number("amplitude_error", ERROR, |(_, it)| Some(it.error?.amplitude))
        .number("frequency_error", ERROR, |(_, it)| Some(it.error?.frequency))
        .word("lost", |(_, it)| it.cycle.as_ref().err().copied())
}

/// All rows, branch by branch.
fn balances(rungs: &[HarmonicBalance]) -> Vec<BalanceRow<'_>> {
    let branches = rungs.first().map_or(0, |rung| rung.balanced.len());
    (0..branches)
        .flat_map(|branch| rungs.iter().map(move |rung| (rung, branch)))
        .filter_map(|(rung, branch)| Some((rung.harmonics, rung.balanced.get(branch)?)))
        .collect()
}
