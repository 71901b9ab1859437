//! A scan on all cores: rows are computed in parallel.

use std::collections::{BTreeMap, BTreeSet};
use std::io;
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::{self, available_parallelism};
use std::time::{Duration, Instant};

use crossbeam_channel::unbounded;
use rayon::ThreadPoolBuilder;

use super::panics::caught;
use super::{Tell, system};
use crate::flow::{Limits, Reason, Result};
use crate::question::Rows;
use crate::scan::{Scan, ScanRow};
use crate::scene::Finding;

/// Rows that each thread may be ahead of the first unfinished one: enough that one slow row does not hold up
/// the others, few enough to be held in memory.
const AHEAD: usize = 32;

/// Computes the rows of these points, in ascending order, and passes each to `take` as soon as it is known, until that
/// breaks off or `interrupted` returns true. There are as many threads as jobs, or as cores if none are given; other
/// threads have priority by this niceness.
///
/// If the computation of a row panics, the row states the panic as its reason. Fails if the system provides no
/// threads.
pub fn rows(
    scan: &Scan,
    points: impl IntoIterator<Item = usize>,
    jobs: Option<usize>,
    niceness: i32,
    interrupted: &(dyn Fn() -> bool + Sync),
    take: &mut dyn FnMut(usize, ScanRow) -> ControlFlow<()>,
) -> io::Result<()> {
    let cores = || available_parallelism().map_or(1, usize::from);
    let jobs = jobs.unwrap_or_else(cores).clamp(1, scan.points());
    let pool = ThreadPoolBuilder::new()
        .num_threads(jobs)
        .thread_name(|index| format!("scan {index}"))
        .start_handler(move |_| system::give_way(niceness))
        .build()
        .map_err(io::Error::other)?;
    let stopped = AtomicBool::new(false);
    let is_over = || stopped.load(Ordering::Relaxed) || interrupted();
    let (ticket, tickets) = unbounded::<usize>();
    let (done, found) = unbounded::<(usize, ScanRow)>();
    // Rows divide their own work among the threads of the pool. So none of these waits for the next row: while a row
    // waits for a part of it, its thread would begin that wait, and never come back.
    thread::scope(|scope| {
        for _ in 0..jobs {
            let (tickets, done, pool, is_over) = (tickets.clone(), done.clone(), &pool, &is_over);
            thread::Builder::new().spawn_scoped(scope, move || {
                let limits = Limits { interrupted: is_over, ..Limits::PATIENT };
                for index in tickets {
                    let row = pool.install(|| computed(scan, index, &limits));
                    let Some(row) = row else { return };
                    drop(done.send((index, row)));
                }
            })?;
        }
        drop((tickets, done));
        let mut open = BTreeSet::new();
        let mut next = |open: &mut BTreeSet<usize>| {
            let Ok((index, row)) = found.recv() else { return ControlFlow::Break(()) };
            open.remove(&index);
            take(index, row)
        };
        let mut flow = points.into_iter().try_for_each(|index| {
            while open.first().is_some_and(|first| index >= first + AHEAD * jobs) {
                next(&mut open)?;
            }
            open.insert(index);
            let _ = ticket.send(index);
            ControlFlow::Continue(())
        });
        while flow.is_continue() && !open.is_empty() {
            flow = next(&mut open);
        }
        stopped.store(flow.is_break(), Ordering::Relaxed);
        drop(ticket);
        Ok(())
    })
}

/// Answers a request for the rows from the point `from` on: in pieces as they are ready, the rest at the end.
/// Fails with [`Reason::Interrupted`]; the pieces told before remain valid.
pub fn answer(scan: &Scan, from: usize, limits: &Limits, tell: &Tell) -> Result<Rows> {
    /// Interval at which gathered rows are told: some frames.
    const EVERY: Duration = Duration::from_millis(60);
    /// That the threads that react to keys have priority; the maximum is 19.
    const POLITE: i32 = 10;
    let mut piece = Rows { first: from, rows: Vec::new() };
    let mut told: Option<Instant> = None;
    // Rows whose turn has not come.
    let mut ahead = BTreeMap::new();
    rows(scan, from..scan.points(), None, POLITE, limits.interrupted, &mut |index, row| {
        ahead.insert(index, row);
        while let Some(row) = ahead.remove(&(piece.first + piece.rows.len())) {
            piece.rows.push(row);
        }
        if !piece.rows.is_empty() && told.is_none_or(|told| told.elapsed() >= EVERY) {
            told = Some(Instant::now());
            let next = Rows { first: piece.first + piece.rows.len(), rows: Vec::new() };
            tell(Finding::Scan(std::mem::replace(&mut piece, next)));
        }
        ControlFlow::Continue(())
    })
    .map_err(|_| Reason::NotApplicable { needs: "threads, and the system gives none" })?;
    limits.go_on().map(|()| piece)
}

/// A row; `None` if the scan is over.
fn computed(scan: &Scan, index: usize, limits: &Limits) -> Option<ScanRow> {
    limits.go_on().ok()?;
    match caught(|| scan.row(index, limits)) {
        Ok(row) => row.ok(),
        Err(why) => Some(scan.failed(format!("internal error: {why}"))),
    }
}
