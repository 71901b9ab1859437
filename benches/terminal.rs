//! Cost of the explorer in a real terminal: `cargo bench --bench terminal`.
//!
//! A pty with an emulator behind it answers like a terminal. Measured for each size: the time from the start of
//! the process to the first full picture, and from a key to the resulting picture; the bytes of a key and of a
//! changed cell; and the time after 500 keys at once until the picture is right.

#[path = "../tests/pty/support.rs"]
mod support;

use std::time::{Duration, Instant};

use support::{Answers, PROGRAM, Terminal};

/// The screen sizes measured.
const SIZES: [(u16, u16); 3] = [(80, 24), (120, 40), (200, 60)];

/// Number of program starts; the median counts.
const STARTS: usize = 11;

/// Number of keys; the median counts.
const KEYS: usize = 41;

/// Silence after which a picture is complete.
const QUIET: Duration = Duration::from_millis(60);

/// Right and left arrow in turn, so that the picture moves but remains typical.
const ARROWS: [&str; 2] = ["\x1b[C", "\x1b[D"];

fn main() {
    // `cargo test --benches` only checks that the program runs.
    if std::env::args().any(|argument| argument == "--test") {
        return;
    }
    println!(
        "    size  first picture  key to picture  bytes/key  bytes/cell  500 keys settle, bytes"
    );
    for size in SIZES {
        let first = median((0..STARTS).map(|_| start(size).1).collect());
        let (mut terminal, _) = start(size);
        let keys: Vec<Key> = (0..KEYS).map(|key| press(&mut terminal, ARROWS[key % 2])).collect();
        let latency = median(keys.iter().map(|key| key.latency).collect());
        let bytes = middle(keys.iter().map(|key| key.bytes).collect());
        let cells: usize = keys.iter().map(|key| key.cells).sum();
        let all: usize = keys.iter().map(|key| key.bytes).sum();
        #[expect(clippy::cast_precision_loss, reason = "a few thousand")]
        let per_cell = all as f64 / cells as f64;
        let (settled, burst) = burst(&mut terminal);
        println!(
            "{:>8}  {:>10.1} ms  {:>11.2} ms  {bytes:>9}  {per_cell:>10.1}  {:>9.1} ms, {burst}",
            format!("{}x{}", size.0, size.1),
            milliseconds(first),
            milliseconds(latency),
            milliseconds(settled),
        );
    }
}

/// Starts the program; returns the time until its first picture.
fn start(size: (u16, u16)) -> (Terminal, Duration) {
    let begun = Instant::now();
    let mut terminal = Terminal::start(&[PROGRAM], &[], size, Answers::AtOnce);
    let took = last_frame(&mut terminal, begun);
    (terminal, took)
}

/// Cost of one key.
struct Key {
    latency: Duration,
    bytes: usize,
    cells: usize,
}

fn press(terminal: &mut Terminal, key: &str) -> Key {
    let (before, written) = (cells(terminal), terminal.written.len());
    let begun = Instant::now();
    terminal.types(key);
    let latency = last_frame(terminal, begun);
    let changed = before.iter().zip(cells(terminal)).filter(|(old, new)| **old != *new).count();
    Key { latency, bytes: terminal.written.len() - written, cells: changed }
}

/// Types 500 keys at once; returns the time from the last of them to the last frame, and the bytes.
fn burst(terminal: &mut Terminal) -> (Duration, usize) {
    let written = terminal.written.len();
    terminal.types(&ARROWS[0].repeat(500));
    let begun = Instant::now();
    (last_frame(terminal, begun), terminal.written.len() - written)
}

/// The time until the last byte of the frames that are arriving.
fn last_frame(terminal: &mut Terminal, begun: Instant) -> Duration {
    let frames = terminal.frames();
    terminal.wait("a frame", |terminal| terminal.frames() > frames);
    let mut last = begun.elapsed();
    loop {
        if terminal.next(QUIET) == 0 {
            return last;
        }
        last = begun.elapsed();
    }
}

/// Content and style of every cell.
fn cells(terminal: &Terminal) -> Vec<String> {
    let screen = terminal.screen();
    let (rows, columns) = screen.size();
    let all = (0..rows.get()).flat_map(|row| (0..columns.get()).map(move |column| (row, column)));
    all.map(|(row, column)| format!("{:?}", screen.cell(row, column))).collect()
}

fn milliseconds(time: Duration) -> f64 {
    time.as_secs_f64() * 1e3
}

fn median(mut times: Vec<Duration>) -> Duration {
    times.sort_unstable();
    times[times.len() / 2]
}

fn middle(mut numbers: Vec<usize>) -> usize {
    numbers.sort_unstable();
    numbers[numbers.len() / 2]
}
