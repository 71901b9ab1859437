//! Aligned columns of text, for reading.

use std::fmt;

use super::proof::{certain, enclosure, sentence as sentence_of_proof};
use crate::flow::{Problem, Trajectory};
use crate::oscillator::{PARAMETERS, Parameters, State, Symbol};
use crate::proof::cycles::Proof;
use crate::proof::enclose::Enclosure;
use crate::study::basin::{Counts, Survey};
use crate::study::fold::Border;
use crate::study::{Branch, Cycle, Cycles, Edge};
use crate::view::number::{duration, exact, significant};
use crate::view::status::sentence;

/// A table: titles, and rows of as many cells; numbers stand with their points above each other.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Table {
    titles: Vec<&'static str>,
    rows: Vec<Vec<String>>,
}

impl Table {
    /// A table with these titles and no rows.
    #[must_use]
    pub fn new(titles: &[&'static str]) -> Self {
        Table { titles: titles.to_vec(), rows: Vec::new() }
    }

    /// Adds a row.
    pub fn row(&mut self, cells: Vec<String>) {
        self.rows.push(cells);
    }

    /// The table as text with every column aligned at its left end: for words.
    #[must_use]
    pub fn aligned_left(&self) -> String {
        let titles = self.titles.iter().map(|title| (*title).to_owned()).collect();
        let rows: Vec<&Vec<String>> = std::iter::once(&titles).chain(&self.rows).collect();
        let width = |column: usize| {
            let cells = rows.iter().filter_map(|row| row.get(column));
            cells.map(|cell| cell.chars().count()).max().unwrap_or(0)
        };
        let widths: Vec<usize> = (0..titles.len()).map(width).collect();
        let line = |row: &&Vec<String>| {
            let cells = row.iter().zip(&widths).map(|(cell, width)| format!("{cell:width$}"));
            cells.collect::<Vec<_>>().join("  ").trim_end().to_owned() + "\n"
        };
        rows.iter().map(line).collect()
    }

    /// Width of a column before and from the point on.
    fn widths(&self, column: usize) -> (usize, usize) {
        let cells = self.rows.iter().filter_map(|row| row.get(column));
        let (whole, part) = cells.map(|cell| split(cell)).fold((0, 0), |widest, (whole, part)| {
            (widest.0.max(whole.chars().count()), widest.1.max(part.chars().count()))
        });
        let title = self.titles.get(column).map_or(0, |title| title.chars().count());
        (whole.max(title.saturating_sub(part)), part)
    }
}

/// A cell before and from its decimal point on.
fn split(cell: &str) -> (&str, &str) {
    cell.split_at(cell.find('.').unwrap_or(cell.len()))
}

impl fmt::Display for Table {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let widths: Vec<_> = (0..self.titles.len()).map(|column| self.widths(column)).collect();
        let titles = self.titles.iter().zip(&widths);
        let titles = titles.map(|(title, (whole, part))| format!("{title:>0$}", whole + part));
        writeln!(out, "{}", titles.collect::<Vec<_>>().join("  "))?;
        for row in &self.rows {
            let cells = row.iter().zip(&widths).map(|(cell, &(before, after))| {
                let (whole, part) = split(cell);
                format!("{whole:>before$}{part:<after$}")
            });
            writeln!(out, "{}", cells.collect::<Vec<_>>().join("  ").trim_end())?;
        }
        Ok(())
    }
}

/// How many digits a tolerance makes trustworthy, 3 to 16.
fn digits(tolerance: f64) -> usize {
    (3..16)
        .find(|&digits| 10.0_f64.powi(-digits) <= tolerance * 1.5)
        .map_or(16, |digits| usize::try_from(digits).unwrap_or(16))
}

/// `D = -0.1, D2 = 0, ...`.
pub(super) fn parameters(parameters: &Parameters, but: Option<Symbol>) -> String {
    let initial = State { q: 0.0, v: 0.0 };
    let symbols = PARAMETERS.iter().map(|row| row.symbol);
    let shown =
        symbols.filter(|&symbol| !matches!(symbol, Symbol::Q0 | Symbol::V0) && Some(symbol) != but);
    let one =
        |symbol: Symbol| format!("{symbol} = {}", exact(symbol.get(parameters, &initial), 24));
    shown.map(one).collect::<Vec<_>>().join(", ")
}

fn rounded(value: Option<f64>, digits: usize) -> String {
    value.map_or_else(|| "-".to_owned(), |value| significant(value, digits))
}

/// Which motion: parameters and start.
pub(super) fn motion(problem: &Problem) -> String {
    let State { q, v } = problem.initial;
    let parameters = parameters(&problem.parameters, None);
    format!("{parameters}; from q = {}, v = {}", exact(q, 24), exact(v, 24))
}

/// A motion: the question, every turning point, the outcome, where the energy went, the cost.
#[must_use]
pub fn trajectory(motion: &Trajectory, seconds: f64) -> String {
    let problem = &motion.problem;
    let places = digits(problem.tolerance);
    let mut turns = Table::new(&["half swing", "tau", "q"]);
    for (index, crossing) in motion.crossings.iter().enumerate() {
        let number = (index + 1).to_string();
        turns.row(vec![number, significant(crossing.tau, places), significant(crossing.q, places)]);
    }
    let mut out = format!("{}\n{}\n\n", self::motion(problem), sentence(motion));
    if !turns.rows.is_empty() {
        out += &format!("{turns}\n");
    }
    if let Some(energy) = &motion.ledger {
        let mut ledger = Table::new(&["energy", "amount"]);
        for (name, value) in [
            ("at the start", energy.start),
            ("from linear damping", energy.linear),
            ("from quadratic damping", energy.quadratic),
            ("from cubic damping", energy.cubic),
            ("from friction", energy.friction),
            ("at the end", energy.end),
            ("unaccounted for", energy.residual),
        ] {
            ledger.row(vec![name.to_owned(), significant(value, 6)]);
        }
        out += &format!("{ledger}\n");
    }
    let cost = motion.cost;
    out += &format!(
        "method {}, tolerance {}: {} evaluations, {} steps, {} rejected, {}\n",
        motion.method,
        exact(problem.tolerance, 24),
        cost.evaluations,
        cost.steps,
        cost.rejected,
        duration(seconds),
    );
    out
}

/// Titles of the columns that describe a cycle.
const CYCLE: [&str; 8] =
    ["cycle", "q_min", "q_max", "v_min", "v_max", "period", "multiplier", "clearance"];

fn cycle(cycle: &Cycle, places: usize) -> Vec<String> {
    let multiplier = match cycle.multiplier {
        Some(multiplier) => significant(multiplier, places),
        None => format!("exp({})", significant(cycle.log_multiplier, places)),
    };
    let clearance = if cycle.clearance > 0.0 {
        significant(cycle.clearance, places)
    } else {
        format!("exp({})", significant(cycle.log_clearance, places))
    };
    let stability = if cycle.stable { "stable" } else { "unstable" };
    let mut cells = vec![stability.to_owned()];
    let numbers = [cycle.q_min, cycle.q_max, cycle.v_min, cycle.v_max, cycle.period];
    cells.extend(numbers.map(|value| significant(value, places)));
    cells.extend([multiplier, clearance]);
    cells
}

/// The same in the digits that are certain.
fn certain_cycle(cycle: &Cycle, bounds: &Enclosure, places: usize) -> Vec<String> {
    let mut cells = self::cycle(cycle, places);
    let Enclosure { q_min, q_max, v_min, v_max, period, multiplier, clearance } = *bounds;
    let numbers = [q_min, q_max, v_min, v_max, period, multiplier, clearance];
    for (cell, bounds) in cells.iter_mut().skip(1).zip(numbers) {
        // What over- or underflows is told by its logarithm.
        if !cell.starts_with("exp") {
            *cell = certain(bounds, places);
        }
    }
    cells
}

/// Every cycle in the digits that are proved, the harmonic answer beside it, and what borders the basin.
#[must_use]
pub fn cycles(found: &Cycles, proof: &Proof, seconds: f64) -> String {
    /// Cycles are computed to rounding; this many digits are for reading.
    const PLACES: usize = 12;
    let mut out = format!("{}\n\n", parameters(&found.parameters, None));
    if !found.cycles.is_empty() {
        let mut table = Table::new(&CYCLE);
        for found in &found.cycles {
            table.row(if let Some(bounds) = enclosure(proof, found) {
                certain_cycle(found, &bounds, PLACES)
            } else {
                let mut cells = cycle(found, PLACES - 2);
                cells[0] += ", not proved";
                cells
            });
        }
        out += &format!("{table}\n");
    }
    out += &sentence_of_proof(found.cycles.len(), proof);
    out += "\nby one harmonic, for comparison: ";
    if found.harmonic.is_empty() {
        out += "none\n";
    }
    for (index, harmonic) in found.harmonic.iter().enumerate() {
        out += &format!(
            "{}{} amplitude {}, mean {}",
            if index == 0 { "" } else { "; " },
            if harmonic.stable { "stable" } else { "unstable" },
            significant(harmonic.amplitude, 6),
            significant(harmonic.mean, 6),
        );
    }
    if !found.harmonic.is_empty() {
        out.push('\n');
    }
    out += edge_of_basin(found.edge);
    out += &format!("{} evaluations, {}\n", found.cost.evaluations, duration(seconds));
    out
}

fn edge_of_basin(edge: Edge) -> &'static str {
    match edge {
        Edge::None => "edge of the basin of the sticking set: none\n",
        Edge::Cycle => "edge of the basin of the sticking set: the smallest cycle\n",
        Edge::Separatrix => "edge of the basin of the sticking set: a separatrix\n",
    }
}

/// A basin over a window.
#[must_use]
pub fn basin(found: &Survey, seconds: f64) -> String {
    const PLACES: usize = 10;
    let mut out =
        format!("{}\n{}\n", parameters(&found.parameters, None), edge_of_basin(found.edge));
    let Counts { captured, cycle, escaped, undecided } = found.counts;
    let mut counts = Table::new(&["starts that", "count"]);
    for (fate, count) in [
        ("are captured", captured),
        ("end on a stable cycle", cycle),
        ("run away", escaped),
        ("stay undecided", undecided),
    ] {
        counts.row(vec![fate.to_owned(), count.to_string()]);
    }
    let mut kicks = Table::new(&["smallest kick that is not captured", "size"]);
    kicks.row(vec!["displacement".to_owned(), rounded(found.margin.displacement, PLACES)]);
    kicks.row(vec!["impulse".to_owned(), rounded(found.margin.impulse, PLACES)]);
    out += &format!("{counts}\n{kicks}\n");
    out += &format!("area of the basin: {}\n", rounded(found.area, PLACES));
    if let Some(share) = found.lyapunov_share {
        let verdict =
            if share > 1.0 { ": too much is promised, D2 and D3 are left out" } else { "" };
        out += &format!("Lyapunov's disk (24): {} of the margin{verdict}\n", significant(share, 4));
    }
    out + &format!("{} evaluations, {}\n", found.cost.evaluations, duration(seconds))
}

/// The fold and the escape point along a second parameter.
#[must_use]
pub fn border(found: &Border, seconds: f64) -> String {
    const PLACES: usize = 12;
    let mut table =
        Table::new(&[found.second.spec().name, "D_F", "is a", "q_max there", "D_F of (48)", "D_c"]);
    for point in &found.points {
        table.row(vec![
            significant(point.value, 10),
            rounded(point.fold.map(|fold| fold.d), PLACES),
            point.fold.map_or("-", |fold| if fold.grazes { "grazing" } else { "fold" }).to_owned(),
            rounded(point.fold.map(|fold| fold.q_max), 8),
            rounded(point.harmonic_fold, 8),
            rounded(point.escape, PLACES),
        ]);
    }
    let given_up = found.points.iter().filter_map(|point| {
        let reason = point.reason.as_ref()?;
        Some(format!("\n{} = {}: {reason}", found.second, significant(point.value, 10)))
    });
    let given_up: String = given_up.collect();
    let fixed = parameters(&found.parameters, Some(found.second));
    let cost = format!("{} evaluations, {}", found.cost.evaluations, duration(seconds));
    format!("{fixed}\n\n{table}{given_up}\n{cost}\n")
}

/// The cycles along a parameter, piece by piece, and the special points.
#[must_use]
pub fn branch(branch: &Branch, base: &Parameters, tolerance: f64, seconds: f64) -> String {
    let places = digits(tolerance).min(10);
    let mut out = format!("{}\n", parameters(base, Some(branch.parameter)));
    for (number, piece) in branch.pieces.iter().enumerate() {
        out += &format!("\npiece {}\n", number + 1);
        let mut titles = vec![branch.parameter.spec().name];
        titles.extend(CYCLE);
        let mut table = Table::new(&titles);
        for point in piece {
            let mut cells = vec![significant(point.value, places)];
            cells.extend(cycle(&point.cycle, places));
            table.row(cells);
        }
        out += &table.to_string();
    }
    if branch.pieces.is_empty() {
        out += "\nno limit cycle\n";
    }
    let mut special = Table::new(&["special point", branch.parameter.spec().name, "q_max"]);
    for point in &branch.special {
        special.row(vec![
            point.kind.name(point.cycle.as_ref()).to_owned(),
            significant(point.value, digits(tolerance)),
            rounded(point.q_max, digits(tolerance)),
        ]);
    }
    if !special.rows.is_empty() {
        out += &format!("\n{special}");
    }
    out += &format!("\n{} evaluations, {}\n", branch.cost.evaluations, duration(seconds));
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::closed_form::piecewise_linear::LinearCycle;
    use crate::study::{Special, SpecialKind};

    #[test]
    fn a_branch_ends_where_two_cycles_meet_or_where_one_grazes_the_rest() {
        let linear = Cycle::from(&LinearCycle::new(-0.3, 0.1).unwrap());
        let end = |log_multiplier| {
            let cycle = Cycle { log_multiplier, ..linear };
            let special = vec![Special::new(SpecialKind::Fold, -1.5, Some(cycle))];
            let cost = crate::flow::Cost::default();
            let found = Branch { parameter: Symbol::D, pieces: Vec::new(), special, cost };
            branch(&found, &Parameters { d: -1.5, d2: 0.0, d3: 10.0, r: 1.0 }, 1e-6, 0.0)
        };
        assert!(end(-1e-6).contains("fold") && !end(-1e-6).contains("grazing"));
        assert!(end(-28.0).contains("grazing") && !end(-28.0).contains("fold"));
    }

    #[test]
    fn points_of_numbers_stand_above_each_other() {
        let mut table = Table::new(&["tau", "q"]);
        table.row(vec!["1.5".to_owned(), "-0.25".to_owned()]);
        table.row(vec!["10.25".to_owned(), "1".to_owned()]);
        table.row(vec!["100".to_owned(), "-".to_owned()]);
        assert_eq!(table.to_string(), "   tau      q\n  1.5   -0.25\n 10.25   1\n100      -\n");
    }

    #[test]
    fn a_tolerance_says_how_many_digits_count() {
        let expected = [(1e-10, 10), (3e-11, 11), (1e-2, 3), (1e-15, 15), (1e-30, 16)];
        for (tolerance, places) in expected {
            assert_eq!(digits(tolerance), places, "{tolerance}");
        }
    }
}
