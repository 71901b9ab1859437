//! The cost of a screen in bytes: full frames and single steps, counted.

use std::cell::RefCell;
use std::io::{self, Write};
use std::rc::Rc;

use hopfscope::flow::Limits;
use hopfscope::question::{NoAnswer, answer};
use hopfscope::scene::Scene;
use hopfscope::scene::library::library;
use hopfscope::session::settings::{self, Colors, Glyphs};
use hopfscope::session::{Msg, Session, Size, settle, update};
use hopfscope::terminal::painter::Painter;
use hopfscope::view::{self, Look};
use ratatui::Terminal;

/// A terminal that counts bytes.
#[derive(Clone, Default)]
struct Line(Rc<RefCell<usize>>);

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
struct Explorer {
    session: Session,
    terminal: Terminal<Painter<Line>>,
    line: Line,
    look: Look,
}

impl Explorer {
    fn open(scene: &std::sync::Arc<Scene>, width: u16, height: u16) -> Explorer {
        let line = Line::default();
        let size = ratatui::layout::Size { width, height };
        Explorer {
            session: Session::new(scene.clone(), Size { width, height }),
            terminal: Terminal::new(Painter::new(line.clone(), size)).unwrap(),
            line,
            look: Look::new(settings::Wishes {
                glyphs: Glyphs::Braille,
                colors: Colors::Sixteen,
                ..settings::Wishes::default()
            }),
        }
    }

    /// Answers all requests and draws; returns the number of bytes written.
    fn draw(&mut self) -> usize {
        settle(&mut self.session, |_, request| {
            let result = answer(request, &Limits::default()).map_err(NoAnswer::Reason);
            Some(Msg::answered(request.clone(), result, 0.000_25))
        });
        update(&mut self.session, Msg::Idle);
        *self.line.0.borrow_mut() = 0;
        self.terminal.draw(|frame| view::draw(frame, &self.session, &self.look)).unwrap();
        *self.line.0.borrow()
    }

    fn press(&mut self, key: &str) -> usize {
        update(&mut self.session, Msg::Key(key.parse().unwrap()));
        self.draw()
    }
}

#[test]
fn at_80x24_a_full_frame_takes_about_three_kilobytes_and_a_step_about_one() {
    let mut steps = Vec::new();
    for scene in library() {
        let mut explorer = Explorer::open(scene, 80, 24);
        let full = explorer.draw();
        assert!(full <= 2_900, "{}: {full} bytes for a full frame", scene.name);
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
