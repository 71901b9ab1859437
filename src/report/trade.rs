//! Error against cost, in every form of output: one row for each method and accuracy.

use serde::Serialize;

use super::csv::{self, CsvSheet};
use super::table::{Table, motion};
use crate::flow::method::Dial;
use crate::flow::{METHODS, Method, MethodSpec, Outcome};
use crate::numerics::elementary::{log10, pow};
use crate::oscillator::{Parameters, State};
use crate::study::accuracy::{Ending, Reference, Source};
use crate::study::trade::{self, Trade};
use crate::words::number::{count, duration, significant};

/// A trade-off with the time of each row, measured by the caller.
#[derive(Clone, Debug)]
pub struct TimedTrade {
    pub trade: Trade,
    /// Seconds for each row.
    pub seconds: Vec<f64>,
}

/// One method at one accuracy that has an error.
#[derive(Clone, Debug, Serialize)]
#[expect(clippy::struct_excessive_bools, reason = "fields of a document")]
struct TradeRow {
    method: Method,
    /// The method that `auto` chose.
    used: Method,
    tolerance: Option<f64>,
    step: Option<f64>,
    epsilon: Option<f64>,
    error: f64,
    evaluations: u64,
    seconds: f64,
    steps: u64,
    rejected: u64,
    outcome: Outcome,
    turns: usize,
    time_error: f64,
    /// Whether the motion ends as the reference does.
    agrees: bool,
    /// Whether no other row has a smaller error in less time.
    front: bool,
    /// Whether no other row has a smaller error for fewer evaluations.
    front_by_evaluations: bool,
    /// Whether this is the method and the accuracy in use.
    own: bool,
}

/// One method at one accuracy that has no error, and why.
#[derive(Clone, Debug, Serialize)]
struct Unanswered {
    method: Method,
    tolerance: Option<f64>,
    step: Option<f64>,
    epsilon: Option<f64>,
    reason: String,
    evaluations: u64,
}

#[derive(Serialize)]
struct TradeDocument<'a> {
    parameters: &'a Parameters,
    initial: &'a State,
    until: f64,
    reference: String,
    reference_error: f64,
    scale: f64,
    turns: usize,
    rows: Vec<TradeRow>,
    unanswered: Vec<Unanswered>,
}

/// A row with all columns, including the reason of a row without an error.
#[derive(Serialize)]
struct RowWithReason<'a> {
    #[serde(flatten)]
    row: &'a TradeRow,
    reason: Option<&'a str>,
}

/// Tolerance, step and epsilon of a row; `None` for those that do not set the accuracy of its method.
fn dials(row: &trade::TradePoint) -> [Option<f64>; 3] {
    let problem = &row.problem;
    let dial = problem.method.spec().dial;
    let number = |wanted: Dial, value: f64| (dial == wanted).then_some(value);
    let tolerance = matches!(dial, Dial::Tolerance | Dial::Epsilon).then_some(problem.tolerance);
    [tolerance, number(Dial::Step, problem.step), number(Dial::Epsilon, problem.epsilon)]
}

impl TimedTrade {
    /// The rows that have an error.
    fn rows(&self) -> Vec<TradeRow> {
        let trade = &self.trade;
        let by_time = trade.front(&self.seconds);
        let by_evaluations = trade.front(&trade.evaluations());
        let judged =
            trade.rows.iter().zip(&self.seconds).zip(by_time.into_iter().zip(by_evaluations));
        judged
            .filter_map(|((row, &seconds), (front, front_by_evaluations))| {
                let deviation = row.deviation.ok()?;
                let [tolerance, step, epsilon] = dials(row);
                Some(TradeRow {
                    method: row.problem.method,
                    used: row.method,
                    tolerance,
                    step,
                    epsilon,
                    error: deviation.error,
                    evaluations: row.cost.evaluations,
                    seconds,
                    steps: row.cost.steps,
                    rejected: row.cost.rejected,
                    outcome: row.outcome,
                    turns: row.turns,
                    time_error: deviation.time,
                    agrees: deviation.agrees,
                    front,
                    front_by_evaluations,
                    own: trade.is_own(row),
                })
            })
            .collect()
    }

    /// The rows that have no error.
    fn unanswered(&self) -> Vec<Unanswered> {
        let rows = self.trade.rows.iter();
        rows.filter_map(|row| {
            let reason = row.deviation.err()?.to_string();
            let [tolerance, step, epsilon] = dials(row);
            let (method, evaluations) = (row.problem.method, row.cost.evaluations);
            Some(Unanswered { method, tolerance, step, epsilon, reason, evaluations })
        })
        .collect()
    }
}

/// The source of the reference and its accuracy, in a sentence.
pub fn reference(trade: &Trade) -> String {
    let reference = &trade.reference;
    let (first, second) = match reference.source {
        Source::TwicePrecision => (
            "Taylor series of order 32 in twice the working precision",
            "another of order 28 with other steps",
        ),
        Source::ClosedForm => ("closed form", "taylor at 1e-13"),
        Source::Implicit => ("stiff at 1e-14", "auto at 1e-13"),
    };
    let differs = if reference.error.is_finite() {
        format!("differs by {}", significant(reference.error, 1))
    } else {
        "ends otherwise: no error is certain".to_owned()
    };
    let closed = trade.rows.iter().find(|row| row.problem.method == Method::Exact);
    let closed = closed.filter(|_| reference.source == Source::TwicePrecision);
    let closed = closed.and_then(trade::TradePoint::error).map_or_else(String::new, |error| {
        format!(", the closed form in doubles by {}", significant(error, 1))
    });
    format!("{first}; {second} {differs}{closed}")
}

pub fn json(timed: &TimedTrade) -> String {
    let Trade { problem, reference: known, .. } = &timed.trade;
    super::json::text(&TradeDocument {
        parameters: &problem.parameters,
        initial: &problem.initial,
        until: problem.until,
        reference: reference(&timed.trade),
        reference_error: known.error,
        scale: known.scale,
        turns: known.turns.len(),
        rows: timed.rows(),
        unanswered: timed.unanswered(),
    })
}

/// One line for each method and accuracy; those without an error come last.
pub fn csv(timed: &TimedTrade) -> String {
    let (rows, unanswered) = (timed.rows(), timed.unanswered());
    let Some(first) = rows.first() else { return csv::sheet(&unanswered.first(), &unanswered) };
    let mut sheet = CsvSheet::like(&RowWithReason { row: first, reason: None }, &[]);
    for row in &rows {
        sheet.row(row);
    }
    for row in &unanswered {
        sheet.row(row);
    }
    sheet.into_text()
}

/// A table of all rows, and a plot of them below it. The best choices are marked with `*`, the method in use
/// with `<`.
pub fn table(timed: &TimedTrade, plot: &str) -> String {
    let Trade { problem, reference: known, .. } = &timed.trade;
    let mut out = format!(
        "{}; until tau = {}\n{}\nreference: {}\n\n",
        motion(problem),
        significant(problem.until, 6),
        ending(known),
        reference(&timed.trade)
    );
    let rows = Table::of(
        &timed.rows(),
        &[
            ("method", &|row| row.method.to_string()),
            ("set to", &|row| {
                let setting = row.step.or(row.epsilon).or(row.tolerance);
                setting.map_or_else(|| "-".to_owned(), |setting| format!("{setting:e}"))
            }),
            ("error", &|row| format!("{:.1e}", row.error)),
            ("evaluations", &|row| count(row.evaluations)),
            ("time", &|row| duration(row.seconds)),
            ("half swings", &|row| row.turns.to_string()),
            ("ends", &|row| end_of(&row.outcome)),
            ("", &|row| {
                let best = if row.front { "*" } else { "" };
                let own = if row.own { "<" } else { "" };
                format!("{best} {own}").trim().to_owned()
            }),
        ],
    );
    out += &rows.to_string();
    for row in timed.unanswered() {
        let setting = row.step.or(row.epsilon).or(row.tolerance);
        let setting = setting.map_or_else(String::new, |setting| format!(" at {setting:e}"));
        out += &format!("{}{setting}: {}\n", row.method, row.reason);
    }
    out += "\n*: nothing else is better for less time; <: the method in use\n\n";
    out += &format!("{plot}\n");
    out + &digits(timed)
}

/// How the motion ends, in a sentence.
fn ending(reference: &Reference) -> String {
    let turns = reference.turns.len();
    let swings = match turns {
        1 => "1 half swing".to_owned(),
        number => format!("{number} half swings"),
    };
    match reference.end {
        Ending::Rest { q } => format!("rests at q = {} after {swings}", significant(q.high, 12)),
        Ending::Moving { q, v } => {
            let [q, v] = [q, v].map(|number| significant(number.high, 12));
            format!("moving still after {swings}: q = {q}, v = {v}")
        }
        Ending::Escape { tau } => {
            format!("escapes at tau = {} after {swings}", significant(tau.high, 12))
        }
    }
}

/// How a row ends, in a few words.
fn end_of(outcome: &Outcome) -> String {
    match outcome {
        Outcome::Captured { q, .. } => format!("rests at {}", significant(*q, 6)),
        Outcome::Moving { q, .. } => format!("moving at {}", significant(*q, 6)),
        Outcome::Escaped { tau } => format!("escapes at {}", significant(*tau, 6)),
        Outcome::GaveUp { .. } => "gave up".to_owned(),
    }
}

/// The errors whose cost [`digits`] shows.
const LEVELS: [(f64, &str); 5] =
    [(1e-2, "1e-2"), (1e-4, "1e-4"), (1e-6, "1e-6"), (1e-9, "1e-9"), (1e-12, "1e-12")];

/// The cost of accuracy: for each method the cheapest row within each error, and the factor for one more digit.
pub fn digits(timed: &TimedTrade) -> String {
    let mut titles = vec!["evaluations (time) for an error of"];
    titles.extend(LEVELS.map(|level| level.1));
    titles.extend(["a digit more", "ends right"]);
    let mut table = Table::new(&titles);
    let rows = timed.rows();
    for spec in METHODS {
        let own: Vec<&TradeRow> = rows.iter().filter(|row| row.method == spec.method).collect();
        if own.is_empty() {
            continue;
        }
        table.row(line_of_digits(spec, &own));
    }
    table.to_string()
}

fn line_of_digits(spec: &MethodSpec, rows: &[&TradeRow]) -> Vec<String> {
    let cheapest = |error: f64| {
        let good = rows.iter().filter(|row| row.error <= error);
        good.min_by_key(|row| row.evaluations)
    };
    let mut cells = vec![spec.name.to_owned()];
    for (error, _) in LEVELS {
        cells.push(cheapest(error).map_or_else(
            || "-".to_owned(),
            |row| format!("{} ({})", count(row.evaluations), duration(row.seconds)),
        ));
    }
    cells.push(growth(rows).map_or_else(|| "-".to_owned(), |factor| format!("x{factor:.2}")));
    let right = rows.iter().filter(|row| row.agrees).count();
    cells.push(match right {
        0 => "never".to_owned(),
        all if all == rows.len() => "always".to_owned(),
        some => format!("{some} of {}", rows.len()),
    });
    cells
}

/// The factor by which one more digit multiplies the evaluations, from the least to the most accurate row; `None`
/// if these are less than one digit apart.
fn growth(rows: &[&TradeRow]) -> Option<f64> {
    let known = || rows.iter().filter(|row| row.error > 0.0 && row.evaluations > 0);
    let worst = known().max_by(|one, other| one.error.total_cmp(&other.error))?;
    let best = known().min_by(|one, other| one.error.total_cmp(&other.error))?;
    let digits = log10(worst.error / best.error);
    #[expect(clippy::cast_precision_loss, reason = "counts far below 2^53")]
    let factor = best.evaluations as f64 / worst.evaluations as f64;
    (digits >= 1.0).then(|| pow(factor, 1.0 / digits))
}
