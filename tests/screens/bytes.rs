//! The cost of a screen in bytes: full frames and single steps, counted.

use std::cell::RefCell;
use std::io::{self, Write};
use std::rc::Rc;
use std::time::Instant;

use hopfscope::flow::Limits;
use hopfscope::question::{NoAnswer, answer};
use hopfscope::scene::{Scene, find, library};
use hopfscope::session::settings::{Colors, Glyphs};
use hopfscope::session::{Msg, Session, Size, settings, settle, update};
use hopfscope::terminal::Screen;
use hopfscope::view;
use hopfscope::view::Look;
use hopfscope::view::layout::layout;
use ratatui::buffer::Buffer;
use ratatui::layout::Rect;

/// A terminal that counts bytes.
#[derive(Clone, Default)]
pub struct Line(Rc<RefCell<usize>>);

impl Write for Line {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        *self.0.borrow_mut() += bytes.len();
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

/// A session on a screen, with its requests answered at once.
pub struct Explorer {
    pub session: Session,
    pub screen: Screen<Line>,
    line: Line,
    look: Look,
}

impl Explorer {
    pub fn open(scene: &std::sync::Arc<Scene>, width: u16, height: u16) -> Explorer {
        let line = Line::default();
        let size = ratatui::layout::Size { width, height };
        Explorer {
            session: Session::new(scene.clone(), Size { width, height }),
            screen: Screen::new(line.clone(), size),
            line,
            look: Look::new(settings::DisplaySettings {
                glyphs: Glyphs::Braille,
                colors: Colors::Sixteen,
                ..settings::DisplaySettings::default()
            }),
        }
    }

    /// Answers all requests and draws; returns the number of bytes written.
    pub fn draw(&mut self) -> usize {
        settle(&mut self.session, |_, request| {
            let result = answer(request, &Limits::PATIENT).map_err(NoAnswer::Reason);
            Some(Msg::answered(request.clone(), result, 0.000_25))
        });
        update(&mut self.session, Msg::Elapsed { seconds: 0.0 });
        *self.line.0.borrow_mut() = 0;
        let picture = view::picture(self.screen.size(), &self.session, &self.look);
        self.screen.draw(Instant::now(), picture).unwrap();
        *self.line.0.borrow()
    }

    /// Bytes of the same screen as a whole, without the equation in the title line and the number line of the pane.
    fn bare(&self) -> usize {
        let mut picture = view::picture(self.screen.size(), &self.session, &self.look);
        let parts = layout(picture.area, &self.session).unwrap();
        let text = |area: Rect| -> String {
            area.positions().map(|cell| picture[cell].symbol().replace('\u{2212}', "-")).collect()
        };
        let pane = parts.parameters.rows().find(|area| text(*area).contains('\u{2500}'));
        let (title, equation) = (text(parts.title), self.session.equation());
        let told = title.split_once(&equation).map(|(before, _)| Rect {
            x: u16::try_from(before.chars().count()).unwrap(),
            width: u16::try_from(equation.chars().count()).unwrap(),
            ..parts.title
        });
        for area in pane.into_iter().chain(told) {
            for cell in area.positions() {
                picture[cell].reset();
            }
        }
        let line = Line::default();
        Screen::new(line.clone(), self.screen.size()).draw(Instant::now(), picture).unwrap();
        *line.0.borrow()
    }

    pub fn press(&mut self, key: &str) -> usize {
        update(&mut self.session, Msg::Key(key.parse().unwrap()));
        self.draw()
    }
}

impl Explorer {
    /// Lets time pass and draws; returns the number of bytes written.
    pub fn elapse(&mut self, seconds: f64) -> usize {
        update(&mut self.session, Msg::Elapsed { seconds });
        self.draw()
    }
}

#[test]
fn at_80x24_a_full_frame_takes_about_three_kilobytes_and_a_step_about_one() {
    /// What goes with the first frame: colours as they were, a clear screen, and the question whether it is shown.
    const CLEARED: usize = b"\x1b[m\x1b[2J\x1b[6n".len();
    let mut steps = Vec::new();
    for scene in library() {
        let mut explorer = Explorer::open(scene, 80, 24);
        let full = explorer.draw();
        // What has been added since to the panes and the plots has an allowance of its own.
        let bare = explorer.bare();
        assert!(bare <= 2_900 + CLEARED, "{}: {bare} bytes for a full frame", scene.name);
        assert!(full <= bare + 120, "{}: {full} bytes, {bare} without them", scene.name);
        for key in ["<right>", "<right>", "<left>", "<right>"] {
            let step = explorer.press(key);
            assert!(step <= 1_500, "{}: {step} bytes for {key}", scene.name);
            steps.push(step);
        }
    }
    let mean = steps.iter().sum::<usize>() / steps.len();
    assert!(mean <= 1_000, "{mean} bytes for a step on average: {steps:?}");
}

#[test]
fn what_did_not_change_is_not_sent() {
    for scene in library() {
        let mut explorer = Explorer::open(scene, 120, 40);
        explorer.draw();
        assert_eq!(explorer.draw(), 0, "{}", scene.name);
    }
}

/// What the second status line says.
fn told(explorer: &mut Explorer) -> String {
    explorer.draw();
    let Size { width, height } = explorer.session.size;
    let area = Rect::new(0, 0, width, height);
    let mut buffer = Buffer::empty(area);
    view::frame::render(area, &explorer.session, &explorer.look, &mut buffer);
    (0..width).map(|x| buffer[(x, height - 2)].symbol()).collect::<String>().trim().to_owned()
}

/// What a command of the program answers as JSON.
fn answered(arguments: &[&str]) -> serde_json::Value {
    let program = env!("CARGO_BIN_EXE_hopfscope");
    let output = std::process::Command::new(program).args(arguments).output().unwrap();
    serde_json::from_slice(&output.stdout).unwrap()
}

/// The numbers after these words, with the factors of their units.
fn numbers(text: &str, after: &str) -> Vec<f64> {
    let rest = text.split_once(after).unwrap_or_else(|| panic!("{after}: {text}")).1;
    let rest = rest.split(';').next().unwrap().split(" (").next().unwrap();
    let number = |part: &str| {
        let words = part.split_whitespace().filter(|it| !["shift", "impulse"].contains(it));
        let words: Vec<&str> = words.collect();
        let unit = match words.get(1).and_then(|unit| unit.chars().next()) {
            Some('u') => 1e-6,
            Some('m') if words[1] != "m" => 1e-3,
            _ => 1.0,
        };
        unit * words[0].parse::<f64>().unwrap_or_else(|_| panic!("{text}"))
    };
    rest.split(", ").map(number).collect()
}

fn agrees(told: &[f64], answer: &serde_json::Value) {
    let expected = ["displacement", "impulse"].map(|name| answer[name].as_f64().unwrap());
    assert_eq!(told.len(), 2);
    for (told, expected) in told.iter().zip(expected) {
        // Four digits.
        assert!((told / expected - 1.0).abs() < 6e-4, "{told} {expected}");
    }
}

#[test]
fn the_headline_is_the_margin_from_the_worst_rest_position_that_the_command_line_answers() {
    let scene = find("supercritical").unwrap();
    for (width, height) in [(80, 24), (120, 40), (200, 60)] {
        let mut explorer = Explorer::open(&scene, width, height);
        let line = told(&mut explorer);
        let answer = answered(&["margin", "--scene", "supercritical", "--format", "json"]);
        agrees(&numbers(&line, "margin from rest: "), &answer["nominal"]["from_rest"]);
        agrees(&numbers(&line, "from q = 0: "), &answer["nominal"]);

        update(&mut explorer.session, Msg::Run("set w=0.02 r=0.1+-0.01".to_owned()));
        let line = told(&mut explorer);
        let disturbed = ["--set", "r=0.1+-0.01", "--disturbance", "0.02", "--format", "json"];
        let answer = answered(&[&["margin", "--scene", "supercritical"], &disturbed[..]].concat());
        agrees(&numbers(&line, "margin from rest: "), &answer["nominal"]["from_rest"]);
        let certain = numbers(&line, "guaranteed: ");
        agrees(&certain, &answer["guaranteed"]["from_rest"]);
        let bound = &answer["guaranteed"]["from_rest"]["displacement"];
        assert!(certain[0] <= bound.as_f64().unwrap(), "a bound is not rounded up: {line}");

        update(&mut explorer.session, Msg::Run("belt textbook".to_owned()));
        let line = told(&mut explorer);
        let answer = answered(&["belt", "textbook", "--format", "json"]);
        agrees(&numbers(&line, "margin from rest: "), &answer["margin"]["from_rest"]);
    }
}

#[test]
fn no_number_of_a_margin_is_cut_on_a_small_screen() {
    let doubts = ["", "set w=0.00123456 D=-0.3+-0.00123456", "set r=1.23456e-7 w=0"];
    for scene in library() {
        for doubt in doubts {
            let mut explorer = Explorer::open(scene, 80, 24);
            update(&mut explorer.session, Msg::Run(doubt.to_owned()));
            let line = told(&mut explorer);
            let whole = !line.contains('\u{2026}') || line.contains("nothing is certain");
            assert!(whole, "{}: {doubt}: {line}", scene.name);
        }
    }
}
