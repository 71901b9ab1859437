//! What a key takes at draft quality until its first picture: `cargo bench --bench draft`.
//!
//! For every scene and every number of its parameter pane: the time from the key through the answers that
//! the first picture needs to the picture itself, all on one core and without a terminal; and the worst.

use std::sync::Arc;
use std::time::{Duration, Instant};

use hopfscope::flow::Limits;
use hopfscope::flow::quality::DRAFT;
use hopfscope::scene::answer::{Failure, answer};
use hopfscope::scene::{Answered, Request, Slot, library};
use hopfscope::session::{Msg, Row, Session, Size, update};
use hopfscope::view::frame::render;
use hopfscope::view::look::Look;
use ratatui::buffer::Buffer;
use ratatui::layout::Rect;

/// The screen.
const SIZE: Size = Size { width: 120, height: 40 };

/// Times that a key is measured; the median counts.
const TIMES: usize = 5;

fn main() {
    // `cargo test --benches` only wants to know that it runs.
    if std::env::args().any(|argument| argument == "--test") {
        return;
    }
    let mut worst = (Duration::ZERO, String::new());
    for scene in library() {
        let mut session = Session::new(Arc::clone(scene), SIZE);
        session.problem = session.problem.at(&DRAFT);
        // Windows are fitted after the first answers.
        for _ in 0..3 {
            for request in open(&session) {
                give(&mut session, request);
            }
        }
        let mut dearest = (Duration::ZERO, String::new());
        for row in session.rows() {
            // The other way on the dial leads to a finer quality, whose draft is on show already.
            let keys = ["<right>", "<left>"].into_iter();
            for key in keys.take(if row == Row::Tolerance { 1 } else { 2 }) {
                let mut times: Vec<Duration> = (0..TIMES)
                    .map(|_| {
                        let mut stepped = session.clone();
                        stepped.selected = row;
                        press(&mut stepped, key)
                    })
                    .collect();
                times.sort_unstable();
                let name = format!("{} on {}", key, row.name());
                dearest = dearest.max((times[TIMES / 2], name));
            }
        }
        println!("{:>14}  {:>6.2} ms  {}", scene.name, milliseconds(dearest.0), dearest.1);
        worst = worst.max((dearest.0, format!("{}, {}", scene.name, dearest.1)));
    }
    println!("{:>14}  {:>6.2} ms  {}", "worst", milliseconds(worst.0), worst.1);
}

/// The questions without an answer.
fn open(session: &Session) -> Vec<Request> {
    session.wants().into_iter().filter(|request| session.is_open(request)).collect()
}

fn give(session: &mut Session, request: Request) {
    let result = answer(&request, &Limits::PATIENT);
    let result = result.map_err(Failure::Reason);
    let answered = Answered { request, result, seconds: 0.0, complete: true };
    update(session, Msg::Answered(Box::new(answered)));
}

/// Presses a key: the time until the picture of the first answer of each kind that it needs.
fn press(session: &mut Session, key: &str) -> Duration {
    let Ok(key) = key.parse() else { return Duration::MAX };
    let begun = Instant::now();
    update(session, Msg::Key(key));
    session.effort.measuring = false;
    let mut answered = Vec::new();
    for request in open(session) {
        // References are computed while the user rests, when the picture has long been there.
        let slot = request.slot();
        if !answered.contains(&slot) && slot != Slot::Reference {
            answered.push(slot);
            give(session, request);
        }
    }
    let screen = Rect::new(0, 0, SIZE.width, SIZE.height);
    render(screen, session, &Look::new(session.look), &mut Buffer::empty(screen));
    begun.elapsed()
}

fn milliseconds(time: Duration) -> f64 {
    time.as_secs_f64() * 1e3
}
