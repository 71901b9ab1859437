//! One motion: its turning points, how it ends, where its energy goes; and what its accuracy costs, one row for each method
//! and accuracy.

use super::{About, Answer, Columns, Document, Quantity, Table, digits, followed, point_columns};
use crate::accuracy::{ReferenceSource, Trade, TradePoint};
use crate::flow::{
    Cost, Crossing, Leg, METHODS, Method, MethodSpec, Motion, Outcome, Problem, Sample,
};
use crate::model::{ContactState, Knob, Ledger, State, Units, Work};
use crate::numerics::{Interval, log10, pow};
use crate::proof::{ProvedMotion, ProvedPoint};
use crate::words::motion::{ended, sentence};
use crate::words::{Notation, count, duration, shortest, significant};

/// A point of a motion, its start, an arrival at `v = 0` or its end: what it is, `tau`, `q` and `v` as far as they are
/// known, and what is proved of them.
struct MotionRow {
    what: &'static str,
    tau: f64,
    q: Option<f64>,
    v: Option<f64>,
    bounds: Option<ProvedPoint>,
}

/// A motion: its start, every arrival at `v = 0` and its end, with what is proved of each; and where its energy goes.
pub fn motion(
    about: &About,
    motion: &Motion,
    certified: Option<&ProvedMotion>,
    seconds: f64,
) -> Answer {
    let problem = &motion.problem;
    let machine = about.is_machine();
    let proved =
        Columns::default().part("certified", point_columns(), |row: &MotionRow| row.bounds);
    let digits = digits(problem.tolerance);
    let [time, length, speed] = ["s", "m", "m/s"].map(|unit| about.quantity(unit, digits));
    let columns = Columns::default()
        .word("what", |row: &MotionRow| row.what)
        .number("tau", time, |row| row.tau)
        .number("q", length, |row| row.q)
        .number("v", speed, |row| row.v);
    let energy = motion.ledger.as_ref().map(|ledger| energy(ledger, machine));
    let name = |(name, _): &(String, f64)| name.clone();
    let works = Columns::default().text("energy", name);
    let works = works.number("amount", about.quantity("J", 6), |(_, amount)| *amount);
    let Motion { method, cost: Cost { steps, rejected, .. }, .. } = motion;
    let tolerance = shortest(problem.tolerance);
    let how = format!("method {method}, tolerance {tolerance}: {steps} steps, {rejected} rejected");
    let stop = || Some(motion.outcome.answered().err()?.to_string());
    let how = if machine { stop() } else { Some(how) };
    let outcome = Document::default().and(&motion.outcome);
    let rests = machine && matches!(motion.outcome, Outcome::Captured { .. });
    let answer = if machine {
        about.answer()
    } else {
        about.answer_to(&from(problem))
    };
    answer
        .lines((!machine).then(|| sentence(motion, Notation::default())))
        .with("initial", problem.initial)
        .with("method", motion.method)
        .with("tolerance", problem.tolerance)
        .with("outcome", outcome.with_any("v", rests.then_some(0.0)))
        .with("events", &motion.crossings)
        .with_any("phases", machine.then(|| phases(&motion.legs, ["tau", "q"])))
        .with("energy", &energy)
        .with_any("evaluations", machine.then_some(motion.cost.evaluations))
        .with_any("certified", certified.map(followed))
        .rows(&columns.and(certified.map(|_| proved)), &points(motion, certified, machine))
        .table(works.table(energy.iter().flat_map(Document::numbers)))
        .lines(how)
        .cost(motion.cost, seconds)
}

/// A time, and where a motion is then, if it is known.
pub type MomentRow = (f64, Option<Sample>);

impl Answer {
    /// With a motion at times, if any are asked for: its rows in files, and more rows for reading.
    pub fn sampled(self, asked: Option<&[MomentRow]>) -> Self {
        let Some(moments) = asked else { return self };
        let row = |(tau, at): &MomentRow| {
            vec![(*tau).into(), at.map(|at| at.q).into(), at.map(|at| at.v).into()]
        };
        let rows: Vec<_> = moments.iter().map(row).collect();
        self.points(Some("samples"), &["tau", "q", "v"], &rows)
    }
}

/// The start of a motion, its turning points and its end, with what is proved of each. Of a machine it is also known how
/// far one was followed that escapes or is given up.
fn points(motion: &Motion, certified: Option<&ProvedMotion>, machine: bool) -> Vec<MotionRow> {
    let State { q, v } = motion.problem.initial;
    let [none, place, speed] = [0.0, q, v].map(Interval::point);
    let bounds = certified.map(|_| ProvedPoint::of(none, place, speed));
    let start = MotionRow { what: "start", tau: 0.0, q: Some(q), v: Some(v), bounds };
    let turn = |(index, crossing): (usize, &Crossing)| {
        let bounds = certified.and_then(|certified| certified.turns.get(index).copied());
        let (q, v) = (Some(crossing.q), Some(0.0));
        MotionRow { what: "turn", tau: crossing.tau, q, v, bounds }
    };
    let turns = motion.crossings.iter().enumerate().map(turn);
    let bounds = certified.map(|certified| certified.end);
    let Sample { tau, q, v } = motion.end();
    let (q, v) = motion.outcome.state().or(machine.then_some((q, v))).unzip();
    let end = MotionRow { what: motion.outcome.word(), tau, q, v, bounds };
    std::iter::once(start).chain(turns).chain([end]).collect()
}

/// The start of a motion.
fn from(problem: &Problem) -> String {
    let State { q, v } = problem.initial;
    format!("; from q = {}, v = {}", shortest(q), shortest(v))
}

/// When and where the mass begins to slip, to stick or to rest, under these names.
pub(super) fn phases(legs: &[Leg], [time, place]: [&str; 2]) -> Vec<Document> {
    let phase = |leg: &Leg| {
        let phase = match leg.place {
            ContactState::Sticks => "stick",
            ContactState::Rests => "rest",
            ContactState::Slips(_) => "slip",
        };
        let Sample { tau, q, .. } = leg.start;
        Document::of(time, tau).with(place, q).with("phase", phase)
    };
    legs.iter().map(phase).collect()
}

/// The works along a motion. Those of the damper and of the guide of a machine are told as what they take, in J, and what
/// does not add up as a fraction of all.
pub(super) fn energy(ledger: &Ledger, machine: bool) -> Document {
    let ends = Document::of("start", ledger.start).with("end", ledger.end);
    let works = ledger.works.iter().fold(ends, |all, Work { source, amount, .. }| {
        let takes = matches!(*source, "damper" | "guide");
        all.with(source, if takes { -amount } else { *amount })
    });
    works.with("residual", if machine { ledger.imbalance() } else { ledger.residual })
}

/// What the accuracy of a row is set to.
fn setting(row: &TradePoint) -> Option<String> {
    row.problem.method.spec().dial.map(|dial| format!("{:e}", row.problem.get(dial)))
}

/// The columns of files for what the accuracy of a method is set to: the number that sets it, and the tolerance of the
/// smoothed motion.
fn dial_columns<'a>() -> Columns<'a, &'a TradePoint> {
    let number = |row: &TradePoint, wanted: &[Knob], read: Knob| {
        let dial = row.problem.method.spec().dial;
        dial.filter(|dial| wanted.contains(dial)).map(|_| row.problem.get(read))
    };
    let by_tolerance = [Knob::Tolerance, Knob::Epsilon];
    Columns::default()
        .file("tolerance", move |row: &&TradePoint| number(row, &by_tolerance, Knob::Tolerance))
        .file("step", move |row| number(row, &[Knob::Step], Knob::Step))
        .file("epsilon", move |row| number(row, &[Knob::Epsilon], Knob::Epsilon))
}

/// The columns of rows, most of which are empty for one without an error. The best choices by their time are marked with
/// `*`, the method in use with `<`.
fn columns_of_trade(trade: &Trade) -> Columns<'_, &TradePoint> {
    let by_time = |row: &&TradePoint| trade.is_best(row, |row| row.seconds);
    let by_evaluations = |row: &&TradePoint| trade.is_best(row, TradePoint::evaluations);
    let marks = move |row: &&TradePoint| {
        let best = if by_time(row) { "*" } else { "" };
        let own = if trade.is_own(row) { "<" } else { "" };
        format!("{best}{own}")
    };
    let known = |row: &&TradePoint| row.deviation.ok();
    Columns::default()
        .word("method", |row: &&TradePoint| row.problem.method)
        .text("set to", |row| setting(row))
        .file("used", move |row| known(row).map(|_| row.method))
        .and(dial_columns())
        .number("error", Quantity::pure(2), |row| row.error())
        .word("evaluations", |row| row.cost.evaluations)
        .number("seconds", Quantity::of("s", 2), move |row| known(row).map(|_| row.seconds))
        .file("steps", move |row| known(row).map(|_| row.cost.steps))
        .file("rejected", move |row| known(row).map(|_| row.cost.rejected))
        .field("outcome", |row| row.outcome)
        .word("turns", move |row| known(row).map(|_| row.turns))
        .file("time_error", move |row| known(row).map(|it| it.time))
        .file("agrees", move |row| known(row).map(|it| it.agrees))
        .file("front", move |row| known(row).map(|_| by_time(row)))
        .file("front_by_evaluations", move |row| known(row).map(|_| by_evaluations(row)))
        .file("own", move |row| known(row).map(|_| trade.is_own(row)))
        .text("ends", |row| row.outcome.word())
        .text("at", |row| {
            let outcome = row.outcome;
            significant(outcome.state().map_or(outcome.tau(), |(q, _)| q), 6)
        })
        .text("", marks)
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
    let closed = closed.and_then(TradePoint::error).map_or_else(String::new, |error| {
        format!(", the closed form in doubles by {}", significant(error, 1))
    });
    format!("{first}; {second} {differs}{closed}")
}

/// The trade-off with a plot of it below the text: one line for each method and accuracy; those without an error come last.
pub fn trade(about: &About, trade: &Trade, plot: &str) -> Answer {
    let Trade { problem, reference: known, rows } = trade;
    let until = format!("{}; until tau = {}", from(problem), significant(problem.until, 6));
    let has_error = |row: &&TradePoint| row.deviation.is_ok();
    let reason = |row: &&TradePoint| row.deviation.err().map(|reason| reason.to_string());
    let (answered, unanswered): (Vec<_>, Vec<_>) = rows.iter().partition(has_error);
    let is_in_use = answered.iter().any(|row| trade.is_own(row));
    let in_use = if is_in_use { "; <: the method in use" } else { "" };
    let given_up = unanswered.iter().map(|row| {
        let setting = setting(row).map_or_else(String::new, |setting| format!(" at {setting}"));
        format!("{}{setting}: {}", row.problem.method, reason(row).unwrap_or_default())
    });
    let without_error = Columns::default()
        .file("method", |row: &&TradePoint| row.problem.method)
        .and(dial_columns())
        .file("reason", reason)
        .file("evaluations", |row| row.cost.evaluations);
    let end = known.end.map(|number| number.high);
    let notation = Notation(about.is_machine().then_some(Units::SI));
    let end = ended(&end, known.turns.len(), notation, 12);
    let answer = if about.is_machine() {
        about.answer()
    } else {
        about.answer_to(&until)
    };
    let all = [answered.as_slice(), &unanswered].concat();
    let answer = answer
        .with("initial", problem.initial)
        .with("until", problem.until)
        .with("reference", reference(trade))
        .with("reference_error", known.error)
        .with("scale", known.scale)
        .with("turns", known.turns.len())
        .with("rows", columns_of_trade(trade).objects(&answered))
        .with("unanswered", without_error.objects(&unanswered))
        .csv(&columns_of_trade(trade).file("reason", reason), all)
        .lines([end, format!("reference: {}", reference(trade))])
        .table(columns_of_trade(trade).table(&answered).unbroken(None))
        .lines(given_up)
        .lines([format!("*: nothing else is better for less time{in_use}"), format!("\n{plot}")])
        .table(price(trade));
    let seconds = rows.iter().map(|row| row.seconds).sum();
    if about.is_machine() {
        answer.cost(known.cost, seconds)
    } else {
        answer
    }
}

/// The errors whose cost [`price`] shows.
const LEVELS: [f64; 5] = [1e-2, 1e-4, 1e-6, 1e-9, 1e-12];

/// The cost of accuracy: for each method the cheapest row within each error, and the factor for one more digit.
fn price(trade: &Trade) -> Table {
    type MethodRows<'a> = (&'a MethodSpec, Vec<&'a TradePoint>);
    let of = |spec: &'static MethodSpec| {
        let rows = trade.rows.iter().filter(|row| row.error().is_some());
        (spec, rows.filter(|row| row.problem.method == spec.method).collect::<Vec<_>>())
    };
    let methods: Vec<MethodRows> = METHODS.iter().map(of).filter(|it| !it.1.is_empty()).collect();
    let cheapest = |rows: &[&TradePoint], level: f64| {
        let good = rows.iter().filter(|row| row.error().is_some_and(|error| error <= level));
        let least = good.min_by_key(|row| row.cost.evaluations)?;
        Some(format!("{} ({})", count(least.cost.evaluations), duration(least.seconds)))
    };
    let right = |rows: &[&TradePoint]| match rows.iter().filter(|row| row.agrees()).count() {
        0 => "never".to_owned(),
        all if all == rows.len() => "always".to_owned(),
        some => format!("{some} of {}", rows.len()),
    };
    let columns = Columns::default().text("cost of an error", |(spec, _): &MethodRows| spec.name);
    let columns = LEVELS.into_iter().fold(columns, |columns, error| {
        columns.text(&format!("{error:e}"), move |(_, rows)| cheapest(rows, error))
    });
    columns
        .text("a digit more", |(_, rows)| Some(format!("x{:.2}", growth(rows)?)))
        .text("ends right", move |(_, rows)| right(rows))
        .table(methods)
}

/// The factor by which one more digit multiplies the evaluations, from the least to the most accurate row; `None`
/// if these are less than one digit apart.
fn growth(rows: &[&TradePoint]) -> Option<f64> {
    let cost = |row: &&TradePoint| Some((row.error()?, row.evaluations()));
    let known = || rows.iter().filter_map(cost).filter(|(error, cost)| *error > 0.0 && *cost > 0.0);
    let (worst, least) = known().max_by(|one, other| one.0.total_cmp(&other.0))?;
    let (best, most) = known().min_by(|one, other| one.0.total_cmp(&other.0))?;
    let digits = log10(worst / best);
    (digits >= 1.0).then(|| pow(most / least, 1.0 / digits))
}
