//! A scan on all cores: rows are computed side by side and come out in order.

use std::collections::{BTreeMap, BTreeSet};
use std::io;
use std::ops::{ControlFlow, Range};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::available_parallelism;
use std::time::{Duration, Instant};

use crossbeam_channel::unbounded;
use rayon::ThreadPoolBuilder;

use super::panics;
use super::worker::Tell;
use crate::flow::{Limits, Reason};
use crate::question::Rows;
use crate::scene::Answer;
use crate::study::scan::{Scan, ScanRow};

/// Rows that each thread may be ahead of the first one that is not done yet: enough that one slow row
/// does not hold the others up, few enough that they are held in memory.
const AHEAD: usize = 32;

/// What a scan may use of the machine.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Processors {
    pub jobs: usize,
    /// Whether others, such as the keys of the explorer, go first.
    pub polite: bool,
}

impl Processors {
    pub fn all() -> Self {
        Processors { jobs: available_parallelism().map_or(1, usize::from), polite: false }
    }
}

/// Who takes the rows of a scan.
pub trait Taker {
    /// Whether this row is known already: then it is neither computed nor taken.
    fn has(&self, _index: usize) -> bool {
        false
    }

    /// A row that is known before its turn; it comes again when that is there.
    fn keep(&mut self, _index: usize, _row: &ScanRow) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }

    fn take(&mut self, index: usize, row: ScanRow) -> ControlFlow<()>;
}

impl<F: FnMut(usize, ScanRow) -> ControlFlow<()>> Taker for F {
    fn take(&mut self, index: usize, row: ScanRow) -> ControlFlow<()> {
        self(index, row)
    }
}

/// Computes the rows of these points and hands each to `taker`, in their order, as soon as it and all
/// before it are known; until the taker breaks off or `interrupted` says so.
///
/// A row whose computation panics has the panic for its reason. Fails if the system gives no threads.
pub fn rows(
    scan: &Scan,
    points: Range<usize>,
    processors: Processors,
    interrupted: &(dyn Fn() -> bool + Sync),
    taker: &mut impl Taker,
) -> io::Result<()> {
    let jobs = processors.jobs.clamp(1, points.len().max(1));
    let pool = ThreadPoolBuilder::new()
        .num_threads(jobs)
        .thread_name(|index| format!("scan {index}"))
        .start_handler(move |_| step_back(processors.polite))
        .build()
        .map_err(io::Error::other)?;
    let stopped = AtomicBool::new(false);
    let is_over = || stopped.load(Ordering::Relaxed) || interrupted();
    let (ticket, tickets) = unbounded::<usize>();
    let (done, found) = unbounded::<(usize, ScanRow)>();
    pool.in_place_scope(|scope| {
        for _ in 0..jobs {
            let (tickets, done, is_over) = (tickets.clone(), done.clone(), &is_over);
            scope.spawn(move |_| {
                let limits = Limits { interrupted: is_over, ..Limits::PATIENT };
                for index in tickets {
                    let Some(row) = computed(scan, index, &limits) else { return };
                    drop(done.send((index, row)));
                }
            });
        }
        drop((tickets, done));
        let mut next = points.start;
        let mut given = points.start;
        let mut waiting = BTreeMap::new();
        let mut known = BTreeSet::new();
        while next < points.end {
            while given < points.end && given < next + AHEAD * jobs {
                if taker.has(given) {
                    known.insert(given);
                } else {
                    let _ = ticket.send(given);
                }
                given += 1;
            }
            if known.remove(&next) {
                next += 1;
                continue;
            }
            let flow = if let Some(row) = waiting.remove(&next) {
                next += 1;
                taker.take(next - 1, row)
            } else {
                let Ok((index, row)) = found.recv() else { break };
                let early = index != next;
                let flow = if early { taker.keep(index, &row) } else { ControlFlow::Continue(()) };
                waiting.insert(index, row);
                flow
            };
            if flow.is_break() {
                stopped.store(true, Ordering::Relaxed);
                return drop(ticket);
            }
        }
        drop(ticket);
    });
    Ok(())
}

/// Answers a request for the rows from point number `from` on: pieces as they come, the rest at the end. Fails with
/// [`Reason::Interrupted`]; what was told before stays true.
pub fn answer(scan: &Scan, from: usize, limits: &Limits, tell: &Tell) -> Result<Rows, Reason> {
    /// How long rows are gathered before they are shown: some frames.
    const EVERY: Duration = Duration::from_millis(60);
    let mut piece = Rows { first: from, rows: Vec::new() };
    let mut told: Option<Instant> = None;
    let processors = Processors { polite: true, ..Processors::all() };
    rows(scan, from..scan.points(), processors, limits.interrupted, &mut |index, row| {
        piece.rows.push(row);
        if told.is_none_or(|told| told.elapsed() >= EVERY) {
            told = Some(Instant::now());
            let next = Rows { first: index + 1, rows: Vec::new() };
            tell(Answer::Scan(std::mem::replace(&mut piece, next)));
        }
        ControlFlow::Continue(())
    })
    .map_err(|_| Reason::NotApplicable { needs: "threads, and the system gives none" })?;
    if (limits.interrupted)() { Err(Reason::Interrupted) } else { Ok(piece) }
}

/// A row, or nothing if the scan is over.
fn computed(scan: &Scan, index: usize, limits: &Limits) -> Option<ScanRow> {
    if (limits.interrupted)() {
        return None;
    }
    match catch_unwind(AssertUnwindSafe(|| scan.row(index, limits))) {
        Ok(row) => row.ok(),
        Err(panic) => Some(scan.failed(format!("internal error: {}", panics::message(&*panic)))),
    }
}

/// Lets other threads go first, where the system knows threads of lower priority.
fn step_back(polite: bool) {
    /// How many steps of niceness, of 19.
    const STEPS: i32 = 10;
    if polite {
        // Without it the rows are the same, but other programs are slowed down more.
        let _ = rustix::process::nice(STEPS);
    }
}
