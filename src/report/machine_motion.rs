//! One motion of a machine, and what all of its motions come to.

use super::belt::{Head, border, gaps};
use super::columns::{Columns, Quantity};
use super::json::Document;
use super::machine::{IMPULSE, LENGTH, MachineReport, SPEED, TIME, machine_cycles};
use crate::accuracy::machine_trade::MachineTrade;
use crate::flow::machine::motion::{Leg, turns};
use crate::flow::machine::turn::ContactState;
use crate::flow::{Fate, MachineMotion};
use crate::model::{Interval, Knob, MachineProblem, Subject};
use crate::portrait::basin::Counts;
use crate::portrait::guarantee::machine::MachineUncertain;
use crate::portrait::{Cycle, Margin, Portrait};
use crate::words::number::significant;

/// Every cycle, and what borders the basin.
pub fn cycles<'a>(
    head: &'a Head,
    subject: &'a Subject,
    found: &Portrait,
    seconds: f64,
) -> MachineReport<'a, Cycle> {
    let columns = machine_cycles(|cycle: &Cycle| Some(*cycle));
    let none = found.cycles.is_empty().then(|| "no cycle".to_owned());
    // The number of cycles is not proved; where the search did not settle is known.
    let count = Document::default().with("proved", false).with("open", &found.unresolved);
    MachineReport {
        head,
        subject,
        document: Document::default()
            .with("cycles", columns.objects(found.cycles.clone()))
            .with("count", count)
            .with("neutral", found.neutral)
            .with("basin", Document::default().with("edge", found.border)),
        columns,
        rows: found.cycles.clone(),
        varied: Vec::new(),
        notes: none.into_iter().chain([border(found).to_owned()]).chain(gaps(found)).collect(),
        steps: found.steps,
        seconds,
    }
}

/// The columns of margins.
fn margin_columns<'a, R: 'a>(margin: impl Fn(&R) -> Margin + Copy + 'a) -> Columns<'a, R> {
    let (length, impulse) = (LENGTH.or("any"), IMPULSE.or("any"));
    Columns::default()
        .number("displacement", length, move |row| margin(row).displacement)
        .number("impulse", impulse, move |row| margin(row).impulse)
        .number("from_rest_displacement", length, move |row| margin(row).from_rest.displacement)
        .titled("from rest")
        .number("from_rest_impulse", impulse, move |row| margin(row).from_rest.impulse)
        .titled("impulse")
}

/// Where the starts of a window end, the part of it that comes to rest, and the margins.
pub fn basin<'a>(
    head: &'a Head,
    subject: &'a Subject,
    (found, counts, captured): (&Portrait, Counts, Option<f64>),
    seconds: f64,
) -> MachineReport<'a, (Counts, Margin)> {
    let share = captured.map_or("not known".to_owned(), |part| significant(part, 10));
    let share = format!("part of the window that comes to rest: {share}");
    MachineReport {
        head,
        subject,
        document: Document::default()
            .with("edge", found.border)
            .with("counts", counts)
            .with("margin", found.margin)
            .with("captured", captured),
        columns: Columns::default()
            .word("captured", |(counts, _): &(Counts, Margin)| counts.captured)
            .word("cycle", |(counts, _)| counts.cycle)
            .word("escaped", |(counts, _)| counts.escaped)
            .word("undecided", |(counts, _)| counts.undecided)
            .and(Some(margin_columns(|(_, margin)| *margin)))
            .file("captured_part", move |_| captured),
        rows: vec![(counts, found.margin)],
        varied: Vec::new(),
        notes: [share, border(found).to_owned()].into_iter().chain(gaps(found)).collect(),
        steps: found.steps,
        seconds,
    }
}

/// The margins of the machine as it is, and those for certain within its tolerances.
pub fn margin<'a>(
    head: &'a Head,
    problem: &'a MachineProblem,
    nominal: &Portrait,
    certain: Result<Margin, MachineUncertain>,
    seconds: f64,
) -> MachineReport<'a, (&'static str, Margin)> {
    let MachineProblem { subject, tolerances, .. } = problem;
    let reason = certain.err().map(|why| why.to_string());
    let certain = certain.unwrap_or(Margin::ENDLESS);
    let known = subject.of_belt().map(|belt| tolerances.intervals(belt)).unwrap_or_default();
    let exact = subject.numbers().map(|(knob, value)| (knob, Interval::point(value)));
    let with = |document: Document, (knob, interval): (Knob, Interval)| {
        document.with(knob.spec().name, interval)
    };
    let notes = reason.iter().map(|why| format!("nothing is guaranteed: {why}"));
    let notes = notes.chain([border(nominal).to_owned()]).collect();
    MachineReport {
        head,
        subject,
        document: Document::default()
            .with("nominal", nominal.margin)
            .with("guaranteed", Document::default().and(&certain).with("reason", &reason))
            .with("disturbance", tolerances.disturbance)
            .with("parameters", exact.chain(known).fold(Document::default(), with)),
        columns: Columns::default()
            .word("margin", |(kind, _): &(&'static str, Margin)| *kind)
            .and(Some(margin_columns(|(_, margin)| *margin)))
            .file("reason", move |(kind, _)| reason.clone().filter(|_| *kind != "nominal")),
        rows: vec![("nominal", nominal.margin), ("guaranteed", certain)],
        varied: Vec::new(),
        notes,
        steps: nominal.steps,
        seconds,
    }
}

/// The start of a motion, a standstill, or its end.
pub struct MotionRow {
    what: &'static str,
    tau: f64,
    q: f64,
    v: f64,
}

/// Every standstill, how the motion ends, where it rides on the belt, and where its energy goes.
pub fn motion<'a>(
    head: &'a Head,
    MachineProblem { subject, start, .. }: &'a MachineProblem,
    found: &MachineMotion,
    seconds: f64,
) -> MachineReport<'a, MotionRow> {
    let MachineMotion { method, tolerance, legs, end, outcome, ledger, cost, .. } = found;
    let kind = outcome.word();
    let reason = if let Fate::Unknown(why) = outcome { Some(why.to_string()) } else { None };
    let place = |q: f64, v: f64| Document::default().with("q", q).with("v", v);
    let phase = |leg: &Leg| {
        let phase = match leg.place {
            ContactState::Sticks => "stick",
            ContactState::Rests => "rest",
            ContactState::Slips(_) => "slip",
        };
        Document::default().with("tau", leg.t).with("q", leg.x).with("phase", phase)
    };
    let ending = Document::default().with("kind", kind).with("tau", end.t);
    let known = matches!(kind, "captured" | "moving").then(|| place(end.x, end.v));
    let energy =
        ledger.map(|works| Document::default().and(&works).with("residual", works.residual()));
    let row = |what, tau, q, v| MotionRow { what, tau, q, v };
    let columns = Columns::default()
        .word("what", |row: &MotionRow| row.what)
        .number("tau", TIME, |row| row.tau)
        .number("q", LENGTH, |row| row.q)
        .number("v", SPEED, |row| row.v);
    let turned = turns(legs).map(|leg| row("turn", leg.t, leg.x, 0.0));
    let events = turns(legs).map(|leg| Document::default().with("tau", leg.t).with("q", leg.x));
    MachineReport {
        head,
        subject,
        document: Document::default()
            .with("initial", place(start.0, start.1))
            .with("method", method)
            .with("tolerance", tolerance)
            .with(
                "outcome",
                known.iter().fold(ending, Document::and).with_any("reason", reason.as_ref()),
            )
            .with("events", events.collect::<Vec<_>>())
            .with("phases", legs.iter().map(phase).collect::<Vec<_>>())
            .with("energy", energy)
            .with("evaluations", cost.evaluations),
        columns,
        rows: [row("start", 0.0, start.0, start.1)]
            .into_iter()
            .chain(turned)
            .chain([row(kind, end.t, end.x, end.v)])
            .collect(),
        varied: Vec::new(),
        notes: reason.into_iter().collect(),
        steps: cost.steps,
        seconds,
    }
}

/// A method at a tolerance, its error, and its time in seconds.
#[derive(Clone)]
pub struct MachineTradeRow {
    motion: MachineMotion,
    error: f64,
    seconds: f64,
}

/// Error against cost of every method on one motion; `seconds` has the time of each row.
pub fn trade<'a>(
    head: &'a Head,
    MachineProblem { subject, start, until, .. }: &'a MachineProblem,
    found: &MachineTrade,
    seconds: &[f64],
) -> MachineReport<'a, MachineTradeRow> {
    let reference = "Taylor series whose last terms are below rounding";
    let mut notes = vec![format!("errors against {reference}")];
    let mut rows = Vec::new();
    for (point, &seconds) in found.points.iter().zip(seconds) {
        let motion = point.motion.clone();
        if let Some(error) = point.error {
            rows.push(MachineTradeRow { motion, error, seconds });
        } else {
            let MachineMotion { method, tolerance, .. } = motion;
            notes.push(format!("{method} at {tolerance:e}: not the same standstills"));
        }
    }
    let columns = Columns::default()
        .word("method", |row: &MachineTradeRow| row.motion.method)
        .number("tolerance", Quantity::pure(3), |row| row.motion.tolerance)
        .number("error", Quantity::pure(3), |row| row.error)
        .word("evaluations", |row| row.motion.cost.evaluations)
        .number("seconds", Quantity::of("s", 3), |row| row.seconds)
        .word("steps", |row| row.motion.cost.steps);
    MachineReport {
        head,
        subject,
        document: Document::default()
            .with("initial", Document::default().with("q", start.0).with("v", start.1))
            .with("until", until)
            .with("reference", reference)
            .with("rows", columns.objects(rows.clone())),
        columns,
        rows,
        varied: Vec::new(),
        notes,
        steps: found.reference.cost.steps,
        seconds: seconds.iter().sum(),
    }
}
