//! Error against cost, in every form of output: one row for each method and accuracy.

use super::motion::from;
use super::{About, Answer, Columns, Quantity, Table};
use crate::accuracy::reference::{Deviation, Reference, ReferenceSource};
use crate::accuracy::trade;
use crate::accuracy::trade::{Trade, TradePoint};
use crate::flow::{METHODS, Method, MethodSpec, Outcome};
use crate::model::Knob;
use crate::numerics::elementary::{log10, pow};
use crate::words::number::count;
use crate::words::{counted, duration, significant};

/// A trade-off with the time of each row, measured by the caller.
#[derive(Clone, Debug)]
pub struct TimedTrade {
    pub trade: Trade,
    /// Seconds for each row.
    pub seconds: Vec<f64>,
}

/// One method at one accuracy.
struct TradeRow<'a> {
    point: &'a TradePoint,
    /// How far it is from the reference; a row without one comes last.
    deviation: Option<Deviation>,
    seconds: f64,
    /// Whether no other row has a smaller error in less time.
    front: bool,
    /// Whether no other row has a smaller error for fewer evaluations.
    front_by_evaluations: bool,
    /// Whether this is the method and the accuracy in use.
    own: bool,
}

impl<'a> TradeRow<'a> {
    /// What is told only if there is an error.
    fn answered(&self) -> Option<&'a TradePoint> {
        self.deviation.map(|_| self.point)
    }

    fn error(&self) -> Option<f64> {
        self.deviation.map(|deviation| deviation.error)
    }

    /// Why there is no error.
    fn reason(&self) -> Option<String> {
        self.point.deviation.err().map(|reason| reason.to_string())
    }

    /// What its accuracy is set to.
    fn setting(&self) -> Option<String> {
        let [tolerance, step, epsilon] = dials(self.point);
        step.or(epsilon).or(tolerance).map(|setting| format!("{setting:e}"))
    }
}

/// Tolerance, step and epsilon of a row; `None` for those that do not set the accuracy of its method.
fn dials(row: &TradePoint) -> [Option<f64>; 3] {
    let problem = &row.problem;
    let dial = problem.method.spec().dial;
    let number = |wanted: Knob| (dial == Some(wanted)).then(|| problem.get(wanted));
    let [tolerance, step, epsilon] = [Knob::Tolerance, Knob::Step, Knob::Epsilon].map(number);
    [tolerance.or(epsilon.map(|_| problem.tolerance)), step, epsilon]
}

/// The columns of files for what the accuracy of a method is set to.
fn dial_columns<'a>() -> Columns<'a, TradeRow<'a>> {
    let names = ["tolerance", "step", "epsilon"].into_iter().enumerate();
    names.fold(Columns::default(), |columns, (index, name)| {
        columns.file(name, move |row: &TradeRow| dials(row.point)[index])
    })
}

/// The columns of rows that have an error. The best choices are marked with `*`, the method in use with `<`.
fn columns<'a>() -> Columns<'a, TradeRow<'a>> {
    let marks = |row: &TradeRow| {
        let best = if row.front { "*" } else { "" };
        let own = if row.own { "<" } else { "" };
        format!("{best}{own}")
    };
    Columns::default()
        .word("method", |row: &TradeRow| row.point.problem.method)
        .text("set to", |row| row.setting().unwrap_or("-".to_owned()))
        .file("used", |row| row.answered().map(|it| it.method))
        .and(dial_columns())
        .number("error", Quantity::pure(2), TradeRow::error)
        .word("evaluations", |row| row.point.cost.evaluations)
        .number("seconds", Quantity::of("s", 2), |row| row.deviation.map(|_| row.seconds))
        .titled("time")
        .file("steps", |row| row.answered().map(|it| it.cost.steps))
        .file("rejected", |row| row.answered().map(|it| it.cost.rejected))
        .field("outcome", |row| row.point.outcome)
        .word("turns", |row| row.answered().map(|it| it.turns))
        .file("time_error", |row| row.deviation.map(|it| it.time))
        .file("agrees", |row| row.deviation.map(|it| it.agrees))
        .file("front", |row| row.deviation.map(|_| row.front))
        .file("front_by_evaluations", |row| row.deviation.map(|_| row.front_by_evaluations))
        .file("own", |row| row.deviation.map(|_| row.own))
        .text("ends", |row| row.point.outcome.word().to_owned())
        .text("at", |row| {
            let outcome = row.point.outcome;
            significant(outcome.state().map_or(outcome.tau(), |(q, _)| q), 6)
        })
        .text("", marks)
}

impl TimedTrade {
    /// The rows that have an error, and those that have none.
    fn rows(&self) -> (Vec<TradeRow<'_>>, Vec<TradeRow<'_>>) {
        let trade = &self.trade;
        let by_time = trade.front(&self.seconds);
        let by_evaluations = trade.front(&trade.evaluations());
        let row = |index: usize, point| TradeRow {
            point,
            deviation: point.deviation.ok(),
            seconds: self.seconds[index],
            front: by_time[index],
            front_by_evaluations: by_evaluations[index],
            own: trade.is_own(point),
        };
        let rows = trade.rows.iter().enumerate().map(|(index, point)| row(index, point));
        rows.partition(|row| row.deviation.is_some())
    }
}

/// The source of the reference and its accuracy, in a sentence.
fn reference(trade: &Trade) -> String {
    let reference = &trade.reference;
    let (first, second) = match reference.source {
        ReferenceSource::TwicePrecision => (
            "Taylor series of order 32 in twice the working precision",
            "another of order 28 with other steps",
        ),
        ReferenceSource::ClosedForm => ("closed form", "taylor at 1e-13"),
        ReferenceSource::Implicit => ("stiff at 1e-14", "auto at 1e-13"),
        ReferenceSource::Machine => {
            return "Taylor series whose last terms are below rounding".to_owned();
        }
    };
    let differs = if reference.error.is_finite() {
        format!("differs by {}", significant(reference.error, 1))
    } else {
        "ends otherwise: no error is certain".to_owned()
    };
    let closed = trade.rows.iter().find(|row| row.problem.method == Method::Exact);
    let closed = closed.filter(|_| reference.source == ReferenceSource::TwicePrecision);
    let closed = closed.and_then(trade::TradePoint::error).map_or_else(String::new, |error| {
        format!(", the closed form in doubles by {}", significant(error, 1))
    });
    format!("{first}; {second} {differs}{closed}")
}

/// The trade-off with a plot of it below the text: one line for each method and accuracy; those without an error come last.
pub fn trade<'a>(
    about: &About,
    timed: &'a TimedTrade,
    plot: impl FnOnce() -> String,
) -> Answer<'a> {
    let Trade { problem, reference: known, .. } = &timed.trade;
    let until = format!("{}; until tau = {}", from(problem), significant(problem.until, 6));
    let (rows, unanswered) = timed.rows();
    let is_in_use = rows.iter().any(|row| row.own);
    let in_use = if is_in_use { "; <: the method in use" } else { "" };
    let given_up = unanswered.iter().map(|row| {
        let setting = row.setting().map_or_else(String::new, |setting| format!(" at {setting}"));
        format!("{}{setting}: {}", row.point.problem.method, row.reason().unwrap_or_default())
    });
    let given_up: Vec<_> = given_up.collect();
    let without_error = Columns::default()
        .file("method", |row: &TradeRow| row.point.problem.method)
        .and(dial_columns())
        .file("reason", TradeRow::reason)
        .file("evaluations", |row| row.point.cost.evaluations);
    let answer = if about.is_machine() { about.answer() } else { about.answer_to(&until) };
    let answer = answer
        .with("initial", problem.initial)
        .with("until", problem.until)
        .with("reference", reference(&timed.trade))
        .with("reference_error", known.error)
        .with("scale", known.scale)
        .with("turns", known.turns.len())
        .objects("rows", columns(), timed.rows().0)
        .objects("unanswered", without_error, timed.rows().1)
        .csv(
            columns().file("reason", TradeRow::reason),
            timed.rows().0.into_iter().chain(unanswered),
        )
        .lines([end_of(known), format!("reference: {}", reference(&timed.trade))])
        .captioned("", || columns().table(rows).unbroken())
        .lines(given_up)
        .lines([format!("*: nothing else is better for less time{in_use}")])
        .lines(["\n".to_owned() + &plot()])
        .captioned("", || digits(timed));
    if about.is_machine() { answer.cost(known.cost, timed.seconds.iter().sum()) } else { answer }
}

/// How the motion ends, in a sentence.
fn end_of(reference: &Reference) -> String {
    let swings = counted(reference.turns.len(), "half swing");
    match reference.end {
        Outcome::Captured { q, .. } => {
            format!("rests at q = {} after {swings}", significant(q.high, 12))
        }
        Outcome::Moving { q, v, .. } => {
            let [q, v] = [q, v].map(|number| significant(number.high, 12));
            format!("moving still after {swings}: q = {q}, v = {v}")
        }
        Outcome::Escaped { tau } | Outcome::GaveUp { tau, .. } => {
            format!("escapes at tau = {} after {swings}", significant(tau.high, 12))
        }
    }
}

/// The errors whose cost [`digits`] shows.
const LEVELS: [(f64, &str); 5] =
    [(1e-2, "1e-2"), (1e-4, "1e-4"), (1e-6, "1e-6"), (1e-9, "1e-9"), (1e-12, "1e-12")];

/// The cost of accuracy: for each method the cheapest row within each error, and the factor for one more digit.
fn digits(timed: &TimedTrade) -> Table {
    type MethodRows<'a> = (&'a MethodSpec, Vec<TradeRow<'a>>);
    let (mut rows, _) = timed.rows();
    let of = |spec: &'static MethodSpec| {
        let own = rows.extract_if(.., |row| row.point.problem.method == spec.method);
        (spec, own.collect::<Vec<_>>())
    };
    let methods: Vec<MethodRows> = METHODS.iter().map(of).filter(|it| !it.1.is_empty()).collect();
    let cheapest = |rows: &[TradeRow], level: f64| {
        let good = rows.iter().filter(|row| row.error().is_some_and(|error| error <= level));
        let least = good.min_by_key(|row| row.point.cost.evaluations)?;
        let evaluations = count(least.point.cost.evaluations);
        Some(format!("{evaluations} ({})", duration(least.seconds)))
    };
    let right = |rows: &[TradeRow]| {
        let agrees = |row: &&TradeRow| row.deviation.is_some_and(|deviation| deviation.agrees);
        match rows.iter().filter(agrees).count() {
            0 => "never".to_owned(),
            all if all == rows.len() => "always".to_owned(),
            some => format!("{some} of {}", rows.len()),
        }
    };
    let columns =
        Columns::default().text("cost of an error", |(spec, _): &MethodRows| spec.name.to_owned());
    let columns = LEVELS.into_iter().fold(columns, |columns, (error, title)| {
        columns.text(title, move |(_, rows)| cheapest(rows, error).unwrap_or("-".to_owned()))
    });
    columns
        .text("a digit more", |(_, rows)| {
            growth(rows).map_or_else(|| "-".to_owned(), |factor| format!("x{factor:.2}"))
        })
        .text("ends right", move |(_, rows)| right(rows))
        .table(methods)
}

/// The factor by which one more digit multiplies the evaluations, from the least to the most accurate row; `None`
/// if these are less than one digit apart.
fn growth(rows: &[TradeRow]) -> Option<f64> {
    let known = || {
        let cost = |row: &TradeRow| Some((row.error()?, row.point.cost.evaluations));
        rows.iter().filter_map(cost).filter(|(error, evaluations)| *error > 0.0 && *evaluations > 0)
    };
    let (worst, least) = known().max_by(|one, other| one.0.total_cmp(&other.0))?;
    let (best, most) = known().min_by(|one, other| one.0.total_cmp(&other.0))?;
    let digits = log10(worst / best);
    #[expect(clippy::cast_precision_loss, reason = "counts far below 2^53")]
    let factor = most as f64 / least as f64;
    (digits >= 1.0).then(|| pow(factor, 1.0 / digits))
}
