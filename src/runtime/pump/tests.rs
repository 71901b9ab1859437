//! The loop with an application that counts.

use std::sync::Arc;

use crossbeam_channel::{Sender, unbounded};
use ratatui::layout::{Position, Rect};
use ratatui::widgets::Widget;

use super::*;
use crate::flow::Reason;
use crate::runtime::{Tell, Work};
use crate::session::{Code, ComputedContent, Key, replay};
use crate::terminal::pacing::FRAME_TIME;

/// An application that counts right-arrow keys, shows the last notice, moves for a while after `p`, and quits
/// at `q`.
#[derive(Debug, Default)]
struct Counter {
    count: u32,
    notice: String,
    /// The effect of the next enter key.
    asks: Option<Effect>,
    moving: bool,
    elapsed: u32,
    /// A figure is finished when something arrives here.
    gate: Option<Receiver<()>>,
}

impl Counter {
    /// Number of times that time passes until motion stops.
    const MOVES: u32 = 3;
}

impl Application for Counter {
    fn update(&mut self, msg: Msg) -> Vec<Effect> {
        match msg {
            Msg::Key(Key { code: Code::Right, .. }) => self.count += 1,
            Msg::Key(Key { code: Code::Char('q'), .. }) => return vec![Effect::Quit],
            Msg::Key(Key { code: Code::Enter, .. }) => {
                return self.asks.take().into_iter().collect();
            }
            Msg::Key(Key { code: Code::Char('p'), .. }) => self.moving = true,
            Msg::Elapsed { .. } => {
                self.elapsed += 1;
                self.moving = self.elapsed < Self::MOVES;
            }
            Msg::Told(notice) | Msg::Written(notice) => self.notice = notice.text,
            Msg::Say(caption, _) => self.notice = caption,
            Msg::Ask { text, .. } => self.notice = text,
            Msg::Run(line) => self.count += line.parse().unwrap_or(0),
            _ => {}
        }
        vec![]
    }

    fn is_moving(&self) -> bool {
        self.moving
    }

    fn tries(&self, key: Key) -> bool {
        self.notice.contains("try") && key.code == Code::Right
    }

    fn make(&self, path: &Path, _: ComputedContent, _: &Recorder) -> Result<Work, String> {
        let gate = self.gate.clone().ok_or("nothing to write")?;
        let path = path.to_owned();
        Ok(Box::new(move |_| {
            gate.recv().unwrap();
            Ok(vec![(path, b"curves".to_vec())])
        }))
    }

    fn picture(&self, size: Size) -> Buffer {
        let mut buffer = Buffer::empty(Rect::from((Position::ORIGIN, size)));
        format!("{} {}", self.count, self.notice).render(buffer.area, &mut buffer);
        buffer
    }
}

/// A terminal that reports what is written to it.
struct Wire(Sender<String>);

impl Write for Wire {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let _ = self.0.send(String::from_utf8_lossy(bytes).into_owned());
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

fn size() -> Size {
    Size { width: 60, height: 1 }
}

struct Bench {
    pump: Pump<Counter, Wire>,
    events: Sender<Event>,
    written: Receiver<String>,
}

fn bench() -> Bench {
    bench_with(Options::default())
}

/// A loop that plays a file.
fn playing(file: &str) -> Bench {
    bench_with(Options { replay: Some(replay::parse(file).unwrap()), ..Options::default() })
}

fn bench_with(options: Options) -> Bench {
    let (write, written) = unbounded();
    let (events, received) = unbounded();
    let channel = (events.clone(), received);
    let screen = Screen::new(Wire(write), size());
    let job = |_: &Request, _: &crate::flow::Limits, _: &Tell| Err(Reason::OutOfRange);
    let pump = Pump::new(Counter::default(), screen, Arc::new(job), channel, options, size);
    Bench { pump, events, written }
}

fn key(name: &str) -> Event {
    Event::Session(Msg::Key(name.parse().unwrap()))
}

#[test]
fn what_moves_is_told_the_time_and_what_stands_still_costs_nothing() {
    let Bench { mut pump, .. } = bench();
    pump.draw().unwrap();
    assert_eq!(pump.due(), None);
    pump.handle(key("p")).unwrap();
    pump.draw().unwrap();
    assert_eq!(pump.application.elapsed, 0, "no time has passed when it begins");
    for told in 1..=Counter::MOVES {
        let (beat, due) = (pump.beat.unwrap(), pump.due().unwrap());
        assert!(due >= beat + FRAME_TIME);
        pump.draw().unwrap();
        assert_eq!(pump.application.elapsed, told);
    }
    assert_eq!((pump.due(), pump.beat), (None, None));
}

#[test]
fn after_a_stop_no_frame_waits_for_the_terminal() {
    let Bench { mut pump, .. } = bench();
    pump.repaint().unwrap();
    pump.handle(Event::Shown).unwrap();
    pump.draw().unwrap();
    pump.hold();
    pump.repaint().unwrap();
    assert!(pump.due().unwrap() <= Instant::now() + FRAME_TIME);
}

/// Plays a file and returns what is on the screen at its end.
fn play(file: &str) -> String {
    let Bench { mut pump, events, written } = playing(file);
    let running = std::thread::spawn(move || (pump.run(), pump));
    while !written.recv().unwrap().contains("replay") {}
    events.send(key("q")).unwrap();
    let (stop, pump) = running.join().unwrap();
    assert_eq!(stop, LoopEnd::Quit);
    view::screen::text(&pump.application.picture(size()))
}

#[test]
fn a_replay_types_its_keys_and_says_how_it_ended() {
    assert_eq!(play("<right*3> <resize 20x5> <screen a> <expect \"3\">"), "3 replay done\n");
    let stopped = play("<right> <expect \"2\"> <right>");
    assert!(stopped.starts_with("1 replay stopped: line 1, column 9"), "{stopped}");
}

fn written_to(path: &Path, content: Content) -> Effect {
    Effect::Write { path: path.to_owned(), content, replace: false }
}

#[test]
fn a_replay_goes_on_without_a_file_that_it_may_not_write_and_says_so_at_the_end() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.toml");
    for may_play_write in [false, true] {
        let Bench { mut pump, events, written } = playing("<enter> <right>");
        let content = Content::Text("text".to_owned());
        pump.application.asks = Some(written_to(&path, content));
        pump.options.files.may_play_write = may_play_write;
        let running = std::thread::spawn(move || (pump.run(), pump));
        while !written.recv().unwrap().contains("done") {}
        events.send(key("q")).unwrap();
        let (_, pump) = running.join().unwrap();
        let refused = pump.application.notice.contains("--allow-write");
        assert_eq!((pump.application.count, refused), (1, !may_play_write));
        assert_eq!(folder.path().join("a.toml").exists(), may_play_write);
    }
}

/// By the order of events: two keys are answered on the screen before the figure is finished.
#[test]
fn keys_are_answered_while_a_figure_is_written() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.svg");
    let Bench { mut pump, events, written } = bench();
    let (open, gate) = unbounded();
    let asks = written_to(&path, Content::Computed(ComputedContent::Figure { plot: None }));
    (pump.application.asks, pump.application.gate) = (Some(asks), Some(gate));
    events.send(key("<enter>")).unwrap();
    let running = std::thread::spawn(move || pump.run());
    for count in ["1", "2"] {
        events.send(key("<right>")).unwrap();
        while !written.recv().unwrap().contains(count) {}
    }
    assert!(!path.exists());
    open.send(()).unwrap();
    while !written.recv().unwrap().contains("written") {}
    assert_eq!(std::fs::read(path).unwrap(), b"curves");
    events.send(key("q")).unwrap();
    assert_eq!(running.join().unwrap(), LoopEnd::Quit);
}

/// A tour, the keys pressed at each text that appears, and the number of steps at the end.
type Tour<'a> = (&'a str, &'a [(&'a str, &'a [&'a str])], u32);

/// At `done`, the tour is over, so q quits the program.
#[rustfmt::skip]
const TOURS: [Tour; 9] = [
    // A caption waits for a key without another effect: the first q continues the tour.
    ("<right> <say \"look\"> <right>", &[("look", &["q"]), ("done", &["q"])], 2),
    // On to the second caption, back to the first one, on again and to the end.
    ("<right> <say \"one\"> <right> <say \"two\"> <right>", &[
        ("one", &["<space>"]), ("two", &["<backspace>"]), ("one", &["<space>"]), ("two", &["<space>"]), ("done", &["q"]),
    ], 2 + 3),
    // A key that has its usual effect at a caption is tried twice here; then the whole file is played as if it
    // had not been.
    ("<right> <say \"try\"> <right> <say \"second\">", &[
        ("try", &["<right>", "<right>", "n"]), ("second", &["n"]), ("done", &["q"]),
    ], 1 + 2 + 2),
    ("<right> <say \"look\"> <right>", &[("look", &["<esc>"]), ("stopped", &["q"])], 1),
    // A question waits for y or n, whatever else is pressed, and the next caption says whether that was right.
    ("<ask \"wo\" y> <right> <say \"on\">", &[
        ("wo", &["q", "<space>", "y"]), ("Right. on", &["x"]), ("1 of 1 right", &["q"]),
    ], 1),
    ("<ask \"wo\" y> <say \"on\">", &[("wo", &["n"]), ("No. on", &["x"]), ("0 of 1 right", &["q"])], 0),
    // A task waits until the screen shows a text; page down does it, but not as the user's own.
    ("<until \"go\" \"2 go\" \"2\"> <right>", &[("go", &["<right>", "x", "<right>"]), ("1 of 1 right", &["q"])], 3),
    ("<until \"go\" \"2 go\" \"2\"> <say \"on\">", &[
        ("go", &["<pgdn>"]), ("Shown: on", &["x"]), ("lesson done: 0 of 1 right", &["q"]),
    ], 2),
    // On to the next chapter.
    ("<say \"one\"> <right> <say \"two\"> <chapter \"B\"> <right> <say \"six\">", &[
        ("one", &["<tab>"]), ("six", &["x"]), ("done", &["q"]),
    ], 2),
];

#[test]
fn a_tour_waits_at_captions_goes_back_lets_keys_be_tried_and_is_left_by_escape() {
    for (file, pressed, count) in TOURS {
        let Bench { mut pump, events, written } = playing(file);
        let running = std::thread::spawn(move || (pump.run(), pump));
        for (seen, names) in pressed {
            while !written.recv().unwrap().contains(seen) {}
            for name in *names {
                events.send(key(name)).unwrap();
            }
        }
        let (stop, pump) = running.join().unwrap();
        assert_eq!((stop, pump.application.count), (LoopEnd::Quit, count), "{file}");
    }
}

#[test]
fn what_was_pressed_is_written_without_what_asks_for_it() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("walk.keys");
    let recorder = Recorder::new("hopfscope basin".to_owned(), Vec::new());
    let Bench { mut pump, .. } = bench_with(Options { recorder, ..Options::default() });
    for name in ["<right>", "<right>", ":"] {
        pump.handle(key(name)).unwrap();
    }
    pump.application.asks = Some(written_to(&path, Content::Record { forget: 2 }));
    pump.handle(key("<enter>")).unwrap();
    let written = std::fs::read_to_string(path).unwrap();
    assert!(written.ends_with("\n# hopfscope basin\n<right*2>\n"), "{written}");
}

/// The recorded steps, without the comments.
fn recorded(pump: &Pump<Counter, Wire>) -> String {
    replay::text("", pump.options.recorder.steps())
}

#[test]
fn the_users_keys_stop_hold_or_leave_a_replay_and_are_no_part_of_it() {
    let step = |pump: &mut Pump<Counter, Wire>| {
        pump.draw().unwrap();
        pump.play().unwrap();
    };
    let Bench { mut pump, .. } = playing("<right*3>");
    step(&mut pump);
    for ignored in ["<right>", "x", "<enter>"] {
        assert_eq!(pump.handle(key(ignored)), Ok(()));
    }
    assert_eq!(pump.application.count, 1, "keys of the user are not mixed into it");
    pump.handle(key("<space>")).unwrap();
    assert!(pump.application.notice.contains("paused"), "{}", pump.application.notice);
    step(&mut pump);
    assert_eq!(pump.application.count, 1, "paused");
    pump.handle(key("<space>")).unwrap();
    step(&mut pump);
    assert_eq!(pump.application.count, 2, "and on");
    for leaves in ["q", "<C-c>"] {
        assert_eq!(pump.handle(key(leaves)), Err(LoopEnd::Quit));
    }
    pump.handle(key("<esc>")).unwrap();
    assert_eq!(pump.application.notice, "replay stopped");
    step(&mut pump);
    assert_eq!(pump.application.count, 2);
    pump.handle(key("<right>")).unwrap();
    assert_eq!(pump.application.count, 3, "the keys are the user's again");
    assert_eq!(recorded(&pump), "<right*3>\n", "what was played, and then pressed");
}

#[test]
fn what_was_not_played_to_its_end_is_recorded_as_far_as_it_went() {
    let Bench { mut pump, .. } = bench();
    pump.application.asks = Some(Effect::Play(replay::parse("<right*3>").unwrap()));
    pump.handle(key("<enter>")).unwrap();
    for _ in 0..2 {
        pump.draw().unwrap();
        pump.play().unwrap();
    }
    pump.handle(key("<esc>")).unwrap();
    assert_eq!(recorded(&pump), "<right*2>\n");
}
