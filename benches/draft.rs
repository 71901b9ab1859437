//! Time from a key press to its picture at draft quality: `cargo bench --bench draft`.
//!
//! This covers the whole path, as in the explorer: the key enters the loop, the session asks, the worker
//! answers from its thread, the screen writes. Measured for every scene, every row of its parameter pane
//! (including the dial) and both arrows: the time from the key to the last byte of the first picture in which
//! every layer has a current answer, draft or not. The terminal accepts each picture at once.

use std::io::{self, Write};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use crossbeam_channel::{Receiver, Sender, unbounded};
use hopfscope::flow::quality::DRAFT;
use hopfscope::runtime::explorer::answer;
use hopfscope::runtime::{Application, Event, Explorer, Options, Pump};
use hopfscope::scene::{Request, Scene, Topic, library};
use hopfscope::session::{Effect, Msg, Session, Size};
use hopfscope::terminal::{Environment, Screen};
use ratatui::buffer::Buffer;

/// The screen sizes measured.
const SIZES: [(u16, u16); 2] = [(80, 24), (200, 60)];

/// Measurements of each key; the median counts.
const TIMES: usize = 3;

/// Silence after which, with no request pending, everything is done.
const QUIET: Duration = Duration::from_millis(25);

fn main() {
    // `cargo test --benches` only checks that the program runs.
    if std::env::args().any(|argument| argument == "--test") {
        return;
    }
    println!("{:>14}  {:>8}  {:>8}  worst key", "", "80x24", "200x60");
    let mut worst = (Duration::ZERO, String::new());
    for scene in library() {
        let [small, large] = SIZES.map(|size| costliest(scene, size));
        println!(
            "{:>14}  {:>5.2} ms  {:>5.2} ms  {}",
            scene.name,
            milliseconds(small.0),
            milliseconds(large.0),
            large.1
        );
        for (time, key) in [small, large] {
            worst = worst.max((time, format!("{}, {key}", scene.name)));
        }
    }
    println!("worst: {:.2} ms, {}", milliseconds(worst.0), worst.1);
}

/// The explorer, with flags that tell whether its picture is complete.
struct Watched {
    explorer: Explorer,
    /// Whether each layer of the last picture has a current answer.
    complete: Arc<AtomicBool>,
    /// Whether no request is pending.
    idle: Arc<AtomicBool>,
}

impl Application for Watched {
    fn update(&mut self, msg: Msg) -> Vec<Effect> {
        self.explorer.update(msg)
    }

    fn wants(&self) -> Vec<Request> {
        let wants = self.explorer.wants();
        self.idle.store(wants.is_empty(), Ordering::Release);
        wants
    }

    fn picture(&self, size: ratatui::layout::Size) -> Buffer {
        let session = &self.explorer.session;
        let missing = |request: &Request| {
            request.topic() != Topic::Reference
                && !matches!(
                    session.answers.standing(request),
                    hopfscope::session::AnswerState::Draft(_)
                )
        };
        self.complete.store(!self.explorer.wants().iter().any(missing), Ordering::Release);
        self.explorer.picture(size)
    }
}

/// A terminal that reports when bytes arrive, and answers at once.
struct Line {
    complete: Arc<AtomicBool>,
    arrived: Sender<(Instant, bool)>,
    events: Sender<Event>,
}

impl Write for Line {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        // The receiver may be gone when the program ends.
        let _ = self.arrived.send((Instant::now(), self.complete.load(Ordering::Acquire)));
        let _ = self.events.send(Event::Shown);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

/// The user: keyboard and eyes.
struct User {
    events: Sender<Event>,
    arrived: Receiver<(Instant, bool)>,
    idle: Arc<AtomicBool>,
}

impl User {
    fn key(&self, name: &str) {
        let key = name.parse().expect("a key");
        self.events.send(Event::Session(Msg::Key(key))).expect("the loop runs");
    }

    /// Waits until everything is computed and drawn.
    fn settle(&self) {
        loop {
            let quiet = self.arrived.recv_timeout(QUIET).is_err();
            if quiet && self.idle.load(Ordering::Acquire) {
                return;
            }
        }
    }

    /// Presses a key; returns the time until its first complete picture is written.
    fn press(&self, name: &str) -> Duration {
        let begun = Instant::now();
        self.key(name);
        let (at, _) = self.arrived.iter().find(|(_, complete)| *complete).expect("a picture");
        self.settle();
        at - begun
    }
}

/// The most expensive key of a scene, and its time.
fn costliest(scene: &Arc<Scene>, (width, height): (u16, u16)) -> (Duration, String) {
    let mut session = Session::new(Arc::clone(scene), Size { width, height });
    session.problem = session.problem.at(&DRAFT);
    let rows = session.rows();
    let (events, received) = unbounded();
    let (arrive, arrived) = unbounded();
    let (complete, idle) = (Arc::new(AtomicBool::new(false)), Arc::new(AtomicBool::new(false)));
    let line = Line { complete: Arc::clone(&complete), arrived: arrive, events: events.clone() };
    let size = ratatui::layout::Size { width, height };
    let (answer, channel) = (Arc::new(answer), (events.clone(), received));
    let screen = Screen::new(line, size);
    let explorer = Explorer::new(session, Environment::of(|_| None));
    let application = Watched { explorer, complete, idle: Arc::clone(&idle) };
    let mut pump =
        Pump::new(application, screen, answer, channel, Options::default(), Default::default);
    let running = std::thread::spawn(move || drop(pump.run()));
    let user = User { events, arrived, idle };
    user.settle();
    let mut costliest = (Duration::ZERO, String::new());
    for row in rows {
        let mut times = [Vec::new(), Vec::new()];
        for _ in 0..TIMES {
            for (key, times) in ["<right>", "<left>"].into_iter().zip(&mut times) {
                times.push(user.press(key));
            }
        }
        for (key, times) in ["<right>", "<left>"].into_iter().zip(&mut times) {
            times.sort_unstable();
            costliest = costliest.max((times[TIMES / 2], format!("{key} on {}", row.name())));
        }
        user.key("<down>");
        user.settle();
    }
    user.key("q");
    running.join().expect("no panic");
    costliest
}

fn milliseconds(time: Duration) -> f64 {
    time.as_secs_f64() * 1e3
}
