//! The screen, on which the loop draws frames, each in one write.

use std::io::{self, Write};
use std::time::Instant;

use ratatui::layout::{Rect, Size};
use ratatui::{Frame, Terminal};

use super::pacing::Pacing;
use super::painter::{BACKGROUND, Painter, REQUEST};

/// The size to draw at where the terminal reports none, as some unattended terminals do.
const UNKNOWN: Size = Size { width: 80, height: 24 };

/// A terminal to draw on: the painter writes the bytes, the pacing says when.
#[derive(Debug)]
pub struct Screen<W: Write> {
    terminal: Terminal<Painter<W>>,
    /// When the next frame may be sent.
    pub pacing: Pacing,
}

impl<W: Write> Screen<W> {
    /// A screen of this size on a terminal that was just taken. Never fails: ratatui's signature has the
    /// `Result`.
    pub fn new(out: W, size: Size) -> io::Result<Screen<W>> {
        let terminal = Terminal::new(Painter::new(out, known(size)))?;
        Ok(Screen { terminal, pacing: Pacing::default() })
    }

    /// Asks a terminal that was just taken whether it answers, and for its background colour if `background`. The
    /// next frame does not wait for the answers, which may take long on a slow line.
    pub fn probe(&mut self, now: Instant, background: bool) -> io::Result<()> {
        let question = if background { BACKGROUND } else { "" };
        self.terminal.backend_mut().control(&format!("{question}{REQUEST}"))?;
        self.pacing.asked(now);
        Ok(())
    }

    /// Draws a frame; one that looks like the last one sends nothing.
    pub fn draw(&mut self, now: Instant, picture: impl FnOnce(&mut Frame)) -> io::Result<()> {
        let before = self.terminal.backend().written;
        let asks = self.pacing.asks();
        self.terminal.backend_mut().asking = asks;
        self.terminal.draw(picture)?;
        if self.terminal.backend().written > before {
            self.pacing.sent(now, asks);
        }
        Ok(())
    }

    /// The current size of frames, in cells.
    pub fn size(&self) -> Size {
        self.terminal.backend().size
    }

    /// Sets the size of the terminal and makes the next frame redraw everything, because what is on the screen is
    /// not known.
    pub fn repaint(&mut self, size: Size) -> io::Result<()> {
        let size = known(size);
        let painter = self.terminal.backend_mut();
        painter.size = size;
        painter.forget();
        // Not `Terminal::clear`, which asks for the cursor position and waits for the answer.
        self.terminal.resize(Rect::from((ratatui::layout::Position::ORIGIN, size)))
    }

    /// Writes a sequence that draws nothing, such as one for the clipboard.
    pub fn control(&mut self, sequence: &str) -> io::Result<()> {
        self.terminal.backend_mut().control(sequence)
    }
}

/// The size, or the default one if it is empty.
fn known(size: Size) -> Size {
    if size.width == 0 || size.height == 0 { UNKNOWN } else { size }
}
