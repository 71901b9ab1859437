//! The worker: one thread that answers the requests wanted now, and drops those that are no longer wanted.
//!
//! [`Worker::submit`] replaces the set of wanted requests. The job in progress continues if its request is
//! still among them; otherwise an atomic counter is incremented, the job notices that at its next step, and its
//! result is discarded. A long job reports its results in pieces: each is reported at once, with `complete:
//! false`, and only the last one completes the answer. A job whose turn is over while others wait is put aside
//! and starts over after them. An answer on its way is not computed again: the worker
//! remembers what it has reported until [`Worker::taken`] says that the session has it. A request that panics
//! becomes a [`NoAnswer::Panic`]; the thread survives.
//!
//! The most urgent request comes first. It must not hold up the others if it takes long, though, and how long
//! it takes is not known beforehand. So each request has turns: when its turn is over and others wait that have
//! had no more turns, it is put aside, and starts over when they have had theirs. Each turn is four times as
//! long as the last one, so that at most a third of the work is wasted. A request that merely refines a draft
//! begins with a later turn, because there is a picture already.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

use super::panics::{self, Notes};
use crate::flow::{Limits, Reason};
use crate::question::NoAnswer;
use crate::scene::{Answer, Answered, Request};
use crate::session::Msg;

/// Called by a job with its results so far; its return value is the last piece.
pub type Tell<'a> = dyn Fn(Answer) + 'a;

/// Computes the answer to a request.
pub type Compute = dyn Fn(&Request, &Limits, &Tell) -> Result<Answer, Reason> + Send + Sync;

/// Takes the messages for the session.
pub type Report = dyn Fn(Msg) + Send + Sync;

/// The handle of the worker thread; dropping it ends the thread at the next step of its job.
#[derive(Debug)]
pub struct Worker {
    shared: Arc<Shared>,
}

#[derive(Debug, Default)]
struct Shared {
    queue: Mutex<Queue>,
    changed: Condvar,
    /// Incremented when the job in progress must stop.
    generation: AtomicU64,
    /// Whether others wait that have had no more turns than the job in progress.
    contested: AtomicBool,
}

/// A request in progress.
struct Job {
    request: Request,
    generation: u64,
    /// The end of its turn.
    until: Instant,
}

impl Shared {
    fn queue(&self) -> MutexGuard<'_, Queue> {
        self.queue.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Waits for the next request; `None` when the worker was dropped.
    fn next(&self, turn: Duration) -> Option<Job> {
        let mut queue = self.queue();
        loop {
            if queue.closed {
                return None;
            }
            if let Some((request, length)) = queue.begin() {
                self.contested.store(queue.is_contested(), Ordering::Relaxed);
                let until = Instant::now() + turn.saturating_mul(length);
                let generation = self.generation.load(Ordering::Relaxed);
                return Some(Job { request, generation, until });
            }
            queue = self.changed.wait(queue).unwrap_or_else(PoisonError::into_inner);
        }
    }
}

impl Worker {
    /// Starts the thread; `turn` is the length of a request's first turn. `answer` computes; `report` gets a message
    /// for every answer that is still wanted, and [`Msg::Idle`] when there is nothing left to do. Fails if the
    /// system provides no thread.
    pub fn start(
        turn: Duration,
        answer: Arc<Compute>,
        notes: Notes,
        report: Arc<Report>,
    ) -> std::io::Result<Worker> {
        let shared = Arc::new(Shared::default());
        let theirs = Arc::clone(&shared);
        thread::Builder::new().name("worker".to_owned()).spawn(move || {
            while let Some(Job { request, generation, until }) = theirs.next(turn) {
                let superseded = || theirs.generation.load(Ordering::Relaxed) != generation;
                let aside = AtomicBool::new(false);
                let stops = || {
                    if theirs.contested.load(Ordering::Relaxed) && Instant::now() >= until {
                        aside.store(true, Ordering::Relaxed);
                    }
                    superseded() || aside.load(Ordering::Relaxed)
                };
                let limits = Limits { interrupted: &stops, ..Limits::PATIENT };
                let started = Instant::now();
                let tell = |piece: Answer| {
                    let queue = theirs.queue();
                    if queue.running.is_some() && !superseded() {
                        let seconds = started.elapsed().as_secs_f64();
                        let (request, result) = (request.clone(), Ok(piece));
                        let piece = Answered { request, result, seconds, complete: false };
                        report(Msg::Answered(Box::new(piece)));
                    }
                };
                let computed = catch_unwind(AssertUnwindSafe(|| answer(&request, &limits, &tell)));
                let result = match computed {
                    Ok(result) => result.map_err(NoAnswer::Reason),
                    Err(panic) => {
                        let told = notes.take();
                        Err(NoAnswer::Panic(told.unwrap_or_else(|| panics::message(&*panic))))
                    }
                };
                let seconds = started.elapsed().as_secs_f64();
                let mut queue = theirs.queue();
                let panicked = matches!(result, Err(NoAnswer::Panic(_)));
                if aside.into_inner() && !panicked {
                    queue.put_aside();
                } else if let Some(request) = queue.finish() {
                    report(Msg::answered(request, result, seconds));
                }
                if queue.is_idle() && !queue.closed {
                    report(Msg::Idle);
                }
            }
        })?;
        Ok(Worker { shared })
    }

    /// Sets the requests that are wanted now and not answered yet, the most urgent first.
    pub fn submit(&self, wanted: Vec<Request>) {
        let mut queue = self.shared.queue();
        if queue.want(wanted) {
            self.shared.generation.fetch_add(1, Ordering::Relaxed);
        }
        self.shared.contested.store(queue.is_contested(), Ordering::Relaxed);
        drop(queue);
        self.shared.changed.notify_one();
    }

    /// Notes that the answer to a request has arrived at the session. If the request is wanted after that, it
    /// is computed again.
    pub fn taken(&self, request: &Request) {
        self.shared.queue().taken(request);
    }

    /// Whether nothing is in progress and nothing waits.
    pub fn is_idle(&self) -> bool {
        self.shared.queue().is_idle()
    }
}

impl Drop for Worker {
    fn drop(&mut self) {
        self.shared.queue().close();
        self.shared.generation.fetch_add(1, Ordering::Relaxed);
        self.shared.changed.notify_one();
    }
}

/// The first turn: half a frame.
pub const TURN: Duration = Duration::from_millis(8);

/// Ratio of the lengths of successive turns.
const LONGER: u32 = 4;

/// The turn with which a request begins if its draft is wanted too.
const REFINEMENT: u32 = 2;

#[derive(Debug, Default)]
struct Queue {
    /// The wanted requests, the most urgent first, including the one in progress.
    wanted: Vec<QueuedRequest>,
    /// The request in progress, unless it is no longer wanted.
    running: Option<Request>,
    /// Requests whose answers were reported but have not arrived at the session yet.
    reported: Vec<Request>,
    /// Whether the thread is computing an answer, wanted or not.
    busy: bool,
    closed: bool,
}

/// A request that waits or is in progress.
#[derive(Debug)]
struct QueuedRequest {
    request: Request,
    turns: u32,
}

impl Queue {
    /// Replaces the wanted requests; `true` if the request in progress is no longer among them.
    fn want(&mut self, wanted: Vec<Request>) -> bool {
        let before = std::mem::take(&mut self.wanted);
        let turns = |request: &Request| {
            let known = before.iter().find(|known| known.request == *request);
            let refines = || request.draft().is_some_and(|draft| wanted.contains(&draft));
            known.map_or_else(|| if refines() { REFINEMENT } else { 0 }, |known| known.turns)
        };
        let turns: Vec<u32> = wanted.iter().map(turns).collect();
        let all = wanted.into_iter().zip(turns);
        self.wanted = all
            .filter(|(request, _)| !self.reported.contains(request))
            .map(|(request, turns)| QueuedRequest { request, turns })
            .collect();
        let wanted = &self.wanted;
        let is_wanted = |running: &Request| wanted.iter().any(|it| it.request == *running);
        self.running.take_if(|running| !is_wanted(running)).is_some()
    }

    fn waiting(&self) -> impl Iterator<Item = &QueuedRequest> {
        self.wanted.iter().filter(|wanted| self.running.as_ref() != Some(&wanted.request))
    }

    /// Starts the next request: the most urgent of those with the fewest turns. Also returns the length of its
    /// turn, in units of the first one.
    fn begin(&mut self) -> Option<(Request, u32)> {
        let next = self.waiting().min_by_key(|wanted| wanted.turns)?;
        let (request, turns) = (next.request.clone(), next.turns);
        self.running = Some(request.clone());
        self.busy = true;
        Some((request, LONGER.saturating_pow(turns)))
    }

    /// Whether another request waits that has had no more turns than the one in progress.
    fn is_contested(&self) -> bool {
        let running = self.wanted.iter().find(|it| self.running.as_ref() == Some(&it.request));
        running.is_some_and(|running| self.waiting().any(|other| other.turns <= running.turns))
    }

    /// Ends the turn of the request in progress, which remains unanswered.
    fn put_aside(&mut self) {
        self.busy = false;
        let running = self.running.take();
        let running = self.wanted.iter_mut().find(|it| running.as_ref() == Some(&it.request));
        if let Some(running) = running {
            running.turns += 1;
        }
    }

    /// Ends the request in progress; returns it if its answer is still wanted and must be reported.
    fn finish(&mut self) -> Option<Request> {
        self.busy = false;
        let request = self.running.take()?;
        self.wanted.retain(|wanted| wanted.request != request);
        self.reported.push(request.clone());
        Some(request)
    }

    /// Notes that the reported answer to a request has arrived.
    fn taken(&mut self, request: &Request) {
        if let Some(index) = self.reported.iter().position(|reported| reported == request) {
            self.reported.remove(index);
        }
    }

    /// Drops all work and accepts no more.
    fn close(&mut self) {
        self.closed = true;
        self.running = None;
        self.wanted.clear();
    }

    /// Whether nothing is in progress and nothing waits.
    fn is_idle(&self) -> bool {
        !self.busy && self.waiting().next().is_none()
    }
}

#[cfg(test)]
mod tests {
    use crossbeam_channel::{Receiver, Sender, bounded, unbounded};

    use super::*;
    use crate::flow::{Cost, Problem};
    use crate::model::Parameters;
    use crate::portrait::{Border, Cycles};

    /// A request that can be told apart from others by its number.
    fn request(number: f64) -> Request {
        let parameters = Parameters { d: number, d2: 0.0, d3: 0.0, r: 0.1 };
        Request::Cycles { parameters, machine: None, whole: false }
    }

    fn number(request: &Request) -> f64 {
        match request {
            Request::Cycles { parameters, .. } => parameters.d,
            other => unreachable!("{other:?}"),
        }
    }

    fn nothing(request: &Request) -> Answer {
        Answer::Cycles(Cycles {
            parameters: Parameters { d: number(request), d2: 0.0, d3: 0.0, r: 0.1 },
            cycles: Vec::new(),
            harmonic: Vec::new(),
            border: Border::None,
            picture: None,
            cost: Cost::default(),
        })
    }

    /// An instruction to a job.
    #[derive(Debug)]
    enum JobStep {
        /// To report a piece.
        Tell,
        /// To end with an answer.
        Finish,
    }

    /// A worker whose jobs report their start, and end when they are told to or superseded.
    struct Bench {
        worker: Worker,
        started: Receiver<f64>,
        finish: Sender<JobStep>,
        messages: Receiver<Msg>,
    }

    /// A worker whose requests are never put aside.
    fn bench() -> Bench {
        bench_with(Duration::from_secs(1_000_000))
    }

    fn bench_with(turn: Duration) -> Bench {
        let (start, started) = unbounded();
        let (finish, finished) = bounded::<JobStep>(0);
        let (message, messages) = unbounded();
        let job = move |request: &Request, limits: &Limits, tell: &Tell| {
            let _ = start.send(number(request));
            while !(limits.interrupted)() {
                match finished.try_recv() {
                    Ok(JobStep::Finish) => return Ok(nothing(request)),
                    Ok(JobStep::Tell) => tell(nothing(request)),
                    Err(_) => {}
                }
                thread::yield_now();
            }
            Err(Reason::Interrupted)
        };
        let report = move |msg| drop(message.send(msg));
        let worker =
            Worker::start(turn, Arc::new(job), Notes::default(), Arc::new(report)).unwrap();
        Bench { worker, started, finish, messages }
    }

    impl Bench {
        /// The next answer: its number, and whether it failed.
        fn answered(&self) -> (f64, Result<(), NoAnswer>) {
            match self.messages.recv().unwrap() {
                Msg::Answered(answered) => (number(&answered.request), answered.result.map(drop)),
                other => panic!("{other:?}"),
            }
        }

        /// Lets the running job end, and expects its answer.
        fn finishes(&self, number: f64) {
            self.finish.send(JobStep::Finish).unwrap();
            assert_eq!(self.answered(), (number, Ok(())));
        }

        /// Expects the worker to report that it is idle, and nothing else.
        fn idle(&self) {
            assert!(matches!(self.messages.recv().unwrap(), Msg::Idle));
            assert!(self.worker.is_idle());
            assert!(self.messages.is_empty());
        }
    }

    /// By the order of events: with turns of zero length, the request with the fewest turns goes first.
    #[test]
    fn a_request_that_takes_long_does_not_hold_up_the_others() {
        let bench = bench_with(Duration::ZERO);
        bench.worker.submit(vec![request(1.0), request(2.0), request(3.0)]);
        for number in [3.0, 2.0, 1.0] {
            bench.finishes(number);
        }
        bench.idle();
        let started: Vec<f64> = bench.started.try_iter().collect();
        assert_eq!(started, [1.0, 2.0, 3.0, 1.0, 2.0, 1.0]);
    }

    #[test]
    fn a_newer_request_supersedes_the_running_one() {
        let bench = bench();
        bench.worker.submit(vec![request(1.0)]);
        assert_eq!(bench.started.recv(), Ok(1.0));
        bench.worker.submit(vec![request(2.0)]);
        assert_eq!(bench.started.recv(), Ok(2.0));
        bench.finishes(2.0);
        bench.idle();
    }

    #[test]
    fn a_request_that_is_wanted_again_is_answered() {
        let bench = bench();
        bench.worker.submit(vec![request(1.0)]);
        assert_eq!(bench.started.recv(), Ok(1.0));
        bench.worker.submit(vec![]);
        bench.worker.submit(vec![request(1.0)]);
        assert_eq!(bench.started.recv(), Ok(1.0));
        bench.finish.send(JobStep::Finish).unwrap();
        // The first run may have ended before the second request was submitted; the worker was then idle in
        // between.
        let answered = bench.messages.iter().find(|message| !matches!(message, Msg::Idle));
        assert!(matches!(answered, Some(Msg::Answered(answered)) if answered.result.is_ok()));
        bench.idle();
    }

    #[test]
    fn an_answer_on_its_way_is_not_computed_again() {
        let bench = bench();
        bench.worker.submit(vec![request(1.0)]);
        bench.finishes(1.0);
        bench.idle();
        // Not taken yet: a session that wants something else as well still wants this.
        bench.worker.submit(vec![request(1.0), request(2.0)]);
        bench.finishes(2.0);
        bench.idle();
        // Taken and wanted again, as when a failed request is retried.
        bench.worker.taken(&request(1.0));
        bench.worker.submit(vec![request(1.0), request(2.0)]);
        bench.finishes(1.0);
        bench.idle();
        assert_eq!(bench.started.try_iter().collect::<Vec<_>>(), [1.0, 2.0, 1.0]);
    }

    #[test]
    fn pieces_are_reported_at_once_and_the_job_goes_on() {
        let bench = bench();
        bench.worker.submit(vec![request(1.0)]);
        for _ in 0..2 {
            bench.finish.send(JobStep::Tell).unwrap();
            let Msg::Answered(piece) = bench.messages.recv().unwrap() else { panic!("no piece") };
            assert!(!piece.complete && piece.result.is_ok());
            assert!(!bench.worker.is_idle());
            // Still wanted, and not started again.
            bench.worker.submit(vec![request(1.0)]);
        }
        bench.finish.send(JobStep::Finish).unwrap();
        let Msg::Answered(last) = bench.messages.recv().unwrap() else { panic!("no answer") };
        assert!(last.complete);
        bench.idle();
        assert_eq!(bench.started.try_iter().count(), 1);
    }

    #[test]
    fn a_superseded_job_reports_no_more_pieces() {
        let (start, started) = unbounded();
        let (go, gone) = bounded::<()>(0);
        let (message, messages) = unbounded();
        let job = move |request: &Request, _: &Limits, tell: &Tell| {
            start.send(number(request)).unwrap();
            gone.recv().unwrap();
            // The job has not noticed yet that it is no longer wanted.
            tell(nothing(request));
            Ok(nothing(request))
        };
        let report = Arc::new(move |msg| drop(message.send(msg)));
        let worker = Worker::start(TURN, Arc::new(job), Notes::default(), report).unwrap();
        worker.submit(vec![request(1.0)]);
        assert_eq!(started.recv(), Ok(1.0));
        worker.submit(vec![request(2.0)]);
        go.send(()).unwrap();
        assert_eq!(started.recv(), Ok(2.0));
        go.send(()).unwrap();
        let answered: Vec<f64> = messages
            .iter()
            .take(2)
            .map(|message| match message {
                Msg::Answered(answered) => number(&answered.request),
                other => panic!("{other:?}"),
            })
            .collect();
        assert_eq!(answered, [2.0, 2.0]);
    }

    #[test]
    fn dropping_the_worker_ends_its_thread() {
        let bench = bench();
        bench.worker.submit(vec![request(1.0)]);
        assert_eq!(bench.started.recv(), Ok(1.0));
        drop(bench.worker);
        // The channel ends when the thread does.
        assert_eq!(bench.messages.iter().count(), 0);
    }

    #[test]
    fn what_is_put_aside_comes_after_all_others_and_then_has_a_longer_turn() {
        let mut queue = Queue::default();
        let [slow, quick, last] = [1.0, 2.0, 3.0].map(request);
        assert!(!queue.want(vec![slow.clone(), quick.clone(), last.clone()]));
        assert_eq!(queue.begin(), Some((slow.clone(), 1)));
        assert!(queue.is_contested());
        queue.put_aside();
        for other in [&quick, &last] {
            assert_eq!(queue.begin(), Some((other.clone(), 1)));
            assert_eq!(queue.finish().as_ref(), Some(other));
            queue.taken(other);
            // A request that is still wanted keeps its count of turns.
            assert!(!queue.want(vec![slow.clone(), last.clone()]));
            if other == &last {
                queue.want(vec![slow.clone()]);
            }
        }
        assert_eq!(queue.begin(), Some((slow.clone(), 4)));
        assert!(!queue.is_contested(), "alone it may take as long as it likes");
        // A new key asks a new question, which has had no turn yet.
        queue.want(vec![slow, request(4.0)]);
        assert!(queue.is_contested());
    }

    #[test]
    fn a_refinement_waits_for_whatever_has_no_picture_yet() {
        let mut queue = Queue::default();
        let parameters = Parameters { d: -0.1, d2: 0.0, d3: 0.5, r: 0.1 };
        let problem = Problem { parameters, ..Problem::default() };
        let full = Request::Trajectory { problem, machine: None };
        let draft = full.draft().unwrap();
        queue.want(vec![draft.clone(), full.clone(), request(1.0)]);
        assert_eq!(queue.begin(), Some((draft.clone(), 1)));
        assert!(queue.is_contested());
        queue.finish();
        queue.taken(&draft);
        queue.want(vec![full.clone(), request(1.0)]);
        for length in [1, 4] {
            assert_eq!(queue.begin(), Some((request(1.0), length)));
            assert!(!queue.is_contested(), "a refinement has its turn later");
            queue.put_aside();
        }
        assert_eq!(queue.begin(), Some((full.clone(), 16)), "the more urgent of the two");
        assert!(queue.is_contested());
    }

    #[test]
    fn what_nobody_wants_any_more_is_superseded_and_forgotten() {
        let mut queue = Queue::default();
        queue.want(vec![request(1.0)]);
        queue.begin();
        assert!(queue.want(vec![request(2.0)]));
        assert!(!queue.is_contested() && !queue.is_idle());
        assert_eq!(queue.finish(), None, "that answer is no longer wanted");
        assert_eq!(queue.begin(), Some((request(2.0), 1)));
        assert_eq!(queue.finish(), Some(request(2.0)));
        assert!(queue.is_idle());
    }
}
