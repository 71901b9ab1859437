//! Jobs that do what the test says.

use crossbeam_channel::{Receiver, Sender, bounded, unbounded};

use super::*;
use crate::flow::{Cost, Problem};
use crate::model::{Parameters, State};
use crate::session::Notice;

/// A request that can be told apart from others by its number.
fn request(number: f64) -> Request {
    let parameters = Parameters { d: number, d2: 0.0, d3: 0.0, r: 0.1 };
    Request::Capture { parameters, reach: 1.0, most: 1 }
}

fn number(request: &Request) -> f64 {
    match request {
        Request::Capture { parameters, .. } => parameters.d,
        other => unreachable!("{other:?}"),
    }
}

fn nothing(request: &Request) -> Finding {
    let point = State { q: number(request), v: 0.0 };
    Finding::Capture(vec![vec![point]], Cost::default())
}

/// An instruction to a job.
#[derive(Debug)]
enum JobStep {
    /// To report a piece.
    Tell,
    /// To end with an answer.
    Finish,
}

/// Workers whose jobs report their start, and end when they are told to or superseded.
struct Bench {
    workers: Workers,
    started: Receiver<Request>,
    finish: Sender<JobStep>,
    messages: Receiver<Msg>,
}

fn bench() -> Bench {
    let (start, started) = unbounded();
    let (finish, finished) = bounded::<JobStep>(0);
    let (message, messages) = unbounded();
    let job = move |request: &Request, limits: &Limits, tell: &Tell| {
        let _ = start.send(request.clone());
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
    let workers = Workers::new(Arc::new(job), Arc::new(report));
    Bench { workers, started, finish, messages }
}

impl Bench {
    /// Waits for the start of a job.
    fn starts(&self, request: &Request) {
        assert_eq!(self.started.recv().as_ref(), Ok(request));
    }

    /// The next answer, which arrives at the session: its number, and whether it failed.
    fn answered(&mut self) -> (f64, Result<(), NoAnswer>) {
        let msg = self.messages.recv().unwrap();
        self.workers.arrived(&msg);
        match msg {
            Msg::Answered(reply) => (number(&reply.request), reply.result.map(drop)),
            other => panic!("{other:?}"),
        }
    }

    /// Lets the running job end, and expects its answer.
    fn finishes(&mut self, number: f64) {
        self.finish.send(JobStep::Finish).unwrap();
        assert_eq!(self.answered(), (number, Ok(())));
    }

    /// Expects that nothing is in progress.
    fn idle(&self) {
        assert_eq!(self.workers.asked().count(), 0);
        assert!(self.messages.is_empty());
    }
}

#[test]
fn a_request_that_takes_long_does_not_hold_up_the_others() {
    let (message, messages) = unbounded();
    let job = |request: &Request, limits: &Limits, _: &Tell| {
        while number(request) == 1.0 && !(limits.interrupted)() {
            thread::yield_now();
        }
        Ok(nothing(request))
    };
    let report = move |msg| drop(message.send(msg));
    let mut workers = Workers::new(Arc::new(job), Arc::new(report));
    workers.ask(&[1.0, 2.0, 3.0].map(request));
    for _ in 2..=3 {
        workers.arrived(&messages.recv().unwrap());
    }
    assert_eq!(workers.asked().map(number).collect::<Vec<_>>(), [1.0]);
}

#[test]
fn a_newer_request_supersedes_the_running_one() {
    let mut bench = bench();
    bench.workers.ask(&[request(1.0)]);
    bench.starts(&request(1.0));
    bench.workers.ask(&[]);
    // The channel ends with the thread of the first job.
    bench.workers.ask(&[request(2.0)]);
    bench.starts(&request(2.0));
    while Arc::strong_count(&bench.workers.report) > 2 {
        thread::yield_now();
    }
    bench.finishes(2.0);
    bench.idle();
}

#[test]
fn a_request_that_is_wanted_again_is_answered() {
    let mut bench = bench();
    bench.workers.ask(&[request(1.0)]);
    bench.starts(&request(1.0));
    bench.workers.ask(&[]);
    bench.workers.ask(&[request(1.0)]);
    bench.starts(&request(1.0));
    while Arc::strong_count(&bench.workers.report) > 2 {
        thread::yield_now();
    }
    bench.finishes(1.0);
    bench.idle();
}

#[test]
fn an_answer_on_its_way_is_not_computed_again() {
    let mut bench = bench();
    bench.workers.ask(&[request(1.0)]);
    bench.starts(&request(1.0));
    bench.finish.send(JobStep::Finish).unwrap();
    let on_its_way = bench.messages.recv().unwrap();
    // A session that wants something else as well still wants this.
    bench.workers.ask(&[request(1.0), request(2.0)]);
    bench.starts(&request(2.0));
    bench.finishes(2.0);
    bench.workers.arrived(&on_its_way);
    bench.idle();
    // Wanted again, as when a failed request is retried.
    bench.workers.ask(&[request(1.0)]);
    bench.starts(&request(1.0));
    bench.finishes(1.0);
    bench.idle();
    assert!(bench.started.is_empty());
}

#[test]
fn pieces_are_reported_at_once_and_the_job_goes_on() {
    let mut bench = bench();
    bench.workers.ask(&[request(1.0)]);
    bench.starts(&request(1.0));
    for _ in 0..2 {
        bench.finish.send(JobStep::Tell).unwrap();
        let msg = bench.messages.recv().unwrap();
        bench.workers.arrived(&msg);
        let Msg::Answered(piece) = msg else { panic!("no piece") };
        assert!(!piece.complete && piece.result.is_ok());
        assert_eq!(bench.workers.asked().count(), 1);
        // Still wanted, and not started again.
        bench.workers.ask(&[request(1.0)]);
    }
    bench.finish.send(JobStep::Finish).unwrap();
    let Msg::Answered(last) = bench.messages.recv().unwrap() else { panic!("no answer") };
    assert!(last.complete);
    assert!(bench.started.is_empty());
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
    let mut workers = Workers::new(Arc::new(job), report);
    workers.ask(&[request(1.0)]);
    assert_eq!(started.recv(), Ok(1.0));
    workers.ask(&[request(2.0)]);
    assert_eq!(started.recv(), Ok(2.0));
    for _ in 1..=2 {
        go.send(()).unwrap();
    }
    let answered: Vec<f64> = messages
        .iter()
        .take(2)
        .map(|message| match message {
            Msg::Answered(reply) => number(&reply.request),
            other => panic!("{other:?}"),
        })
        .collect();
    assert_eq!(answered, [2.0, 2.0]);
}

#[test]
fn dropping_the_workers_ends_their_threads() {
    let Bench { mut workers, started, messages, .. } = bench();
    workers.ask(&[request(1.0)]);
    assert_eq!(started.recv(), Ok(request(1.0)));
    drop(workers);
    // The channel ends when the threads do.
    assert_eq!(messages.iter().count(), 0);
}

#[test]
fn a_refinement_waits_for_its_draft() {
    let mut bench = bench();
    let parameters = Parameters { d: -0.1, d2: 0.0, d3: 0.5, r: 0.1 };
    let problem = Problem { parameters, ..Problem::default() };
    let full = Request::Trajectory { problem, machine: None };
    let draft = full.draft().unwrap();
    bench.workers.ask(&[draft.clone(), full.clone()]);
    bench.starts(&draft);
    assert_eq!(bench.workers.asked().collect::<Vec<_>>(), [&draft]);
    bench.finish.send(JobStep::Finish).unwrap();
    bench.workers.arrived(&bench.messages.recv().unwrap());
    bench.workers.ask(std::slice::from_ref(&full));
    bench.starts(&full);
}

fn workers() -> (Workers, Receiver<Msg>) {
    let Bench { workers, messages, .. } = bench();
    (workers, messages)
}

fn notice(messages: &Receiver<Msg>) -> Notice {
    match messages.recv().unwrap() {
        Msg::Written(notice) => notice,
        other => panic!("{other:?}"),
    }
}

#[test]
fn a_figure_that_cannot_be_made_leaves_its_file_as_it_was() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("figure.svg");
    std::fs::write(&path, b"curves").unwrap();
    for (work, why) in [
        (Box::new(|_: &Limits| Err("no curves".to_owned())) as Work, "no curves"),
        (Box::new(|_: &Limits| panic!("a defect")), "internal error: a defect"),
    ] {
        let (mut workers, messages) = workers();
        workers.write(&path, true, work).unwrap();
        let told = notice(&messages);
        assert!(told.error && told.text.contains(why), "{told:?}");
    }
    assert_eq!(std::fs::read(&path).unwrap(), b"curves");
}

#[test]
fn a_figure_that_is_stopped_writes_nothing_and_one_is_written_at_a_time() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("figure.svg");
    let (mut workers, messages) = workers();
    let (start, started) = bounded(0);
    let endless = move |limits: &Limits| {
        start.send(()).unwrap();
        while !(limits.interrupted)() {
            thread::yield_now();
        }
        Ok(vec![(PathBuf::from("half.svg"), b"half of the curves".to_vec())])
    };
    workers.write(&path, false, Box::new(endless)).unwrap();
    started.recv().unwrap();
    let other = workers.write(&folder.path().join("other.svg"), false, Box::new(|_| Ok(vec![])));
    assert!(other.unwrap_err().contains("other.svg not written: another"));
    workers.stop_writing();
    let told = notice(&messages);
    assert!(!told.error && told.text.contains("stopped"), "{told:?}");
    drop(workers);
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
}
