//! One motion of a machine, and what all of its motions come to.

use serde::Serialize;

use super::belt::{Head, border, gaps};
use super::machine::{MachineCycleRow, MachineReport};
use crate::flow::Fate;
use crate::machine::guarantee::MachineUncertain;
use crate::machine::motion::{Leg, MachineState, turns};
use crate::machine::turn::ContactState;
use crate::machine::{LostMotion, MachineLedger, MachineProblem, Subject};
use crate::oscillator::{Interval, Knob};
use crate::portrait::{Border, Margin, Portrait};
use crate::study::basin::Counts;
use crate::words::number::significant;

/// What is known about the number of cycles: it is not proved.
#[derive(Serialize)]
struct Count<'a> {
    proved: bool,
    /// Right turning points between which the search did not settle.
    open: &'a [(f64, f64)],
}

#[derive(Serialize)]
struct Basin {
    edge: Border,
}

#[derive(Serialize)]
pub struct CyclesDocument<'a> {
    cycles: Vec<MachineCycleRow>,
    count: Count<'a>,
    neutral: bool,
    basin: Basin,
}

/// Every cycle, and what borders the basin.
pub fn cycles<'a>(
    head: &'a Head,
    subject: &'a Subject,
    found: &'a Portrait,
    seconds: f64,
) -> MachineReport<'a, CyclesDocument<'a>, MachineCycleRow> {
    let rows: Vec<MachineCycleRow> = found.cycles.iter().map(MachineCycleRow::from).collect();
    let none = rows.is_empty().then(|| "no cycle".to_owned());
    MachineReport {
        head,
        subject,
        document: CyclesDocument {
            cycles: rows.clone(),
            count: Count { proved: false, open: &found.unresolved },
            neutral: found.neutral,
            basin: Basin { edge: found.border },
        },
        like: MachineCycleRow::default(),
        rows,
        called: Vec::new(),
        notes: none.into_iter().chain([border(found).to_owned()]).chain(gaps(found)).collect(),
        steps: found.steps,
        seconds,
    }
}

/// Where the starts of a window end, and the smallest kicks that are lost.
#[derive(Clone, Copy, Serialize)]
pub struct BasinRow {
    #[serde(flatten)]
    counts: Counts,
    #[serde(flatten)]
    margin: Margin,
    /// The part of the window that comes to rest; `None` where that is not known.
    captured_part: Option<f64>,
}

#[derive(Serialize)]
pub struct BasinDocument {
    edge: Border,
    counts: Counts,
    margin: Margin,
    captured: Option<f64>,
}

/// The counts, the part of the window that comes to rest, and the margins.
pub fn basin<'a>(
    head: &'a Head,
    subject: &'a Subject,
    (found, counts, captured): (&Portrait, Counts, Option<f64>),
    seconds: f64,
) -> MachineReport<'a, BasinDocument, BasinRow> {
    let margin = found.margin;
    let row = BasinRow { counts, margin, captured_part: captured };
    let share = captured.map_or("not known".to_owned(), |part| significant(part, 10));
    let share = format!("part of the window that comes to rest: {share}");
    MachineReport {
        head,
        subject,
        document: BasinDocument { edge: found.border, counts, margin, captured },
        like: row,
        rows: vec![row],
        called: Vec::new(),
        notes: [share, border(found).to_owned()].into_iter().chain(gaps(found)).collect(),
        steps: found.steps,
        seconds,
    }
}

/// A margin; `None` where every kick is survived, or with a reason where nothing is certain.
#[derive(Clone, Serialize)]
pub struct MarginRow {
    #[serde(rename = "margin")]
    kind: &'static str,
    #[serde(flatten)]
    found: Margin,
    reason: Option<String>,
}

#[derive(Serialize)]
struct Guaranteed {
    #[serde(flatten)]
    margin: Margin,
    reason: Option<String>,
}

#[derive(Serialize)]
pub struct MarginDocument {
    nominal: Margin,
    guaranteed: Guaranteed,
    disturbance: f64,
    intervals: serde_json::Map<String, serde_json::Value>,
}

/// The margins of the machine as it is, and those for certain within its tolerances.
pub fn margin<'a>(
    head: &'a Head,
    problem: &'a MachineProblem,
    nominal: &Portrait,
    certain: Result<Margin, MachineUncertain>,
    seconds: f64,
) -> MachineReport<'a, MarginDocument, MarginRow> {
    let MachineProblem { subject, tolerances, .. } = problem;
    let reason = certain.err().map(|why| why.to_string());
    let row = |kind, found, reason| MarginRow { kind, found, reason };
    let rows = vec![
        row("nominal", nominal.margin, None),
        row("guaranteed", certain.unwrap_or(Margin::ENDLESS), reason.clone()),
    ];
    let interval = |(knob, interval): (Knob, Interval)| {
        (knob.to_string(), vec![interval.lower(), interval.upper()].into())
    };
    let known = subject.of_belt().map(|belt| tolerances.intervals(belt)).unwrap_or_default();
    let notes = reason.iter().map(|why| format!("nothing is guaranteed: {why}"));
    MachineReport {
        head,
        subject,
        notes: notes.chain([border(nominal).to_owned()]).collect(),
        document: MarginDocument {
            nominal: rows[0].found,
            guaranteed: Guaranteed { margin: rows[1].found, reason },
            disturbance: tolerances.disturbance,
            intervals: known.into_iter().map(interval).collect(),
        },
        like: rows[0].clone(),
        rows,
        called: Vec::new(),
        steps: nominal.steps,
        seconds,
    }
}

/// A motion by any method.
#[derive(Clone, Copy)]
pub struct FollowedMachine<'a> {
    pub method: &'static str,
    pub tolerance: f64,
    pub legs: &'a [Leg],
    pub end: MachineState,
    pub outcome: Fate<LostMotion>,
    /// Where the energy comes from and goes; `None` by a method that does not count it.
    pub ledger: Option<MachineLedger>,
    pub evaluations: u64,
    pub steps: u64,
}

#[derive(Serialize)]
struct Place {
    q: f64,
    v: f64,
}

#[derive(Serialize)]
struct Ending {
    kind: &'static str,
    tau: f64,
    #[serde(flatten)]
    place: Option<Place>,
    #[serde(skip_serializing_if = "Option::is_none")]
    reason: Option<String>,
}

#[derive(Serialize)]
struct Event {
    tau: f64,
    q: f64,
}

#[derive(Serialize)]
struct PhaseDocument {
    tau: f64,
    q: f64,
    phase: &'static str,
}

#[derive(Serialize)]
struct Energy {
    #[serde(flatten)]
    works: MachineLedger,
    residual: f64,
}

#[derive(Serialize)]
pub struct MotionDocument<'a> {
    initial: Place,
    method: &'a str,
    tolerance: f64,
    outcome: Ending,
    events: Vec<Event>,
    phases: Vec<PhaseDocument>,
    energy: Option<Energy>,
    evaluations: u64,
}

/// The start of a motion, a standstill, or its end.
#[derive(Clone, Copy, Default, Serialize)]
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
    found: FollowedMachine<'a>,
    seconds: f64,
) -> MachineReport<'a, MotionDocument<'a>, MotionRow> {
    let FollowedMachine { method, tolerance, legs, end, outcome, ledger, .. } = found;
    let (kind, reason) = match outcome {
        Fate::Rest => ("captured", None),
        Fate::Escapes => ("escaped", None),
        Fate::Unknown(why) => ("gave-up", Some(why.to_string())),
        Fate::Cycle(_) | Fate::Neutral | Fate::Moving => ("moving", None),
    };
    let phase = |leg: &Leg| PhaseDocument {
        tau: leg.t,
        q: leg.x,
        phase: match leg.place {
            ContactState::Sticks => "stick",
            ContactState::Rests => "rest",
            ContactState::Slips(_) => "slip",
        },
    };
    let row = |what, tau, q, v| MotionRow { what, tau, q, v };
    let turned = turns(legs).map(|leg| row("turn", leg.t, leg.x, 0.0));
    let rows = [row("start", 0.0, start.0, start.1)].into_iter().chain(turned);
    let last = row(kind, end.t, end.x, end.v);
    let place = matches!(kind, "captured" | "moving").then_some(Place { q: end.x, v: end.v });
    let document = MotionDocument {
        initial: Place { q: start.0, v: start.1 },
        method,
        tolerance,
        outcome: Ending { kind, tau: end.t, place, reason: reason.clone() },
        events: turns(legs).map(|leg| Event { tau: leg.t, q: leg.x }).collect(),
        phases: legs.iter().map(phase).collect(),
        energy: ledger.map(|works| Energy { works, residual: works.residual() }),
        evaluations: found.evaluations,
    };
    MachineReport {
        head,
        subject,
        document,
        like: MotionRow::default(),
        rows: rows.chain([last]).collect(),
        called: Vec::new(),
        notes: reason.into_iter().collect(),
        steps: found.steps,
        seconds,
    }
}
