//! The screen, on which the loop draws frames: pictures converted to bytes, as few as possible, each in one write.
//!
//! Over SSH, bytes are the cost. The cells of a picture that differ from what the terminal shows become cursor moves,
//! colour changes and text, bracketed as a synchronized update so that no terminal shows half of it. Two things make
//! that cheaper than the backend of crossterm. The first 16 colours are written as `ESC[31m` rather than
//! `ESC[38;5;1m`. Pen and cursor are remembered from frame to frame, so that a frame without changes sends nothing at
//! all. `NO_COLOR` is not read: colours are the view's decision, and a view without colours keeps bold and reverse.
//! Nor is the terminal ever asked where its cursor is: the reply would arrive among the keys (ratatui#2691).

use std::io::{self, Write};
use std::time::{Duration, Instant};

use ratatui::buffer::Buffer;
use ratatui::layout::Size;

use super::pacing::{FRAME_TIME, Pacing};
use super::pen::Pen;
use super::strokes::{self, TerminalState};
use crate::numerics::real;

/// Holds back the picture until [`END`]: a synchronized update, private mode 2026.
pub const BEGIN: &str = "\x1b[?2026h";

/// Shows what was written since [`BEGIN`].
pub const END: &str = "\x1b[?2026l";

/// Asks the terminal for a cursor position report, which it sends once it has read everything before.
pub const REQUEST: &str = "\x1b[6n";

/// Asks the terminal for its background colour, which it reports in the same form.
pub const BACKGROUND: &str = "\x1b]11;?\x1b\\";

/// Resets to the terminal's default colours and no attributes.
pub const PLAIN: &str = "\x1b[m";

const ERASE: &str = "\x1b[2J";

/// The size to draw at where the terminal reports none, as some unattended terminals do.
const UNKNOWN: Size = Size { width: 80, height: 24 };

/// A terminal to draw on, which understands ECMA-48 and has its cursor hidden.
pub struct Screen<W: Write> {
    out: W,
    size: Size,
    /// What the terminal shows; `None` where that is not known.
    shown: Option<Buffer>,
    hand: TerminalState,
    /// When the next frame may be sent.
    pub pacing: Pacing,
    /// Bytes of the last frame.
    sent: usize,
}

/// Longest time between two frames of a motion, such as after one that draws the whole screen.
const LONGEST_PAUSE: Duration = Duration::from_millis(250);

/// Bytes a second that a motion may take for each cell of the screen: 3.8 kB at 80x24, 9.6 kB at 120x40.
const RATE: f64 = 2.0;

impl<W: Write> Screen<W> {
    /// A screen of this size on a terminal that was just taken.
    pub fn new(out: W, size: Size) -> Screen<W> {
        let (hand, pacing) = (TerminalState::default(), Pacing::default());
        Screen { out, size: known(size), shown: None, hand, pacing, sent: 0 }
    }

    /// Asks a terminal that was just taken whether it answers, and for its background colour if `background`. The
    /// next frame does not wait for the answers, which may take long on a slow line.
    pub fn probe(&mut self, now: Instant, background: bool) -> io::Result<()> {
        let question = if background { BACKGROUND } else { "" };
        self.control(&format!("{question}{REQUEST}"))?;
        self.pacing.asked(now);
        Ok(())
    }

    /// Draws a picture of the size of the screen; one that looks like the last one sends nothing.
    pub fn draw(&mut self, now: Instant, picture: Buffer) -> io::Result<()> {
        let mut frame = BEGIN.to_owned();
        let shown = self.shown.take().unwrap_or_else(|| {
            frame.extend([PLAIN, ERASE]);
            self.hand = TerminalState { pen: Some(Pen::PLAIN), cursor: None };
            Buffer::empty(picture.area)
        });
        let (text, hand) = strokes::draw(&shown, &picture, self.hand);
        frame.push_str(&text);
        (self.shown, self.hand) = (Some(picture), hand);
        if frame == BEGIN {
            return Ok(());
        }
        let asks = self.pacing.asks();
        frame.extend([END, if asks { REQUEST } else { "" }]);
        self.control(&frame)?;
        self.sent = frame.len();
        self.pacing.sent(now, asks);
        Ok(())
    }

    /// Time from the last frame of a motion to the next: the longer, the more bytes the last one had.
    pub fn pause(&self) -> Duration {
        let cells = f64::from(self.size.width) * f64::from(self.size.height);
        FRAME_TIME.max(Duration::from_secs_f64(real(self.sent) / (RATE * cells)).min(LONGEST_PAUSE))
    }

    /// The current size of frames, in cells.
    pub fn size(&self) -> Size {
        self.size
    }

    /// Sets the size of the terminal and makes the next frame redraw everything, because what is on the screen is
    /// not known.
    pub fn repaint(&mut self, size: Size) {
        (self.size, self.shown) = (known(size), None);
    }

    /// Writes a sequence in one write, such as one for the clipboard, which draws nothing.
    pub fn control(&mut self, sequence: &str) -> io::Result<()> {
        self.out.write_all(sequence.as_bytes())?;
        self.out.flush()
    }
}

impl Screen<Vec<u8>> {
    /// Draws a picture, and returns what is sent.
    pub fn drawn(&mut self, now: Instant, picture: Buffer) -> String {
        // Writing to memory cannot fail.
        drop(self.draw(now, picture));
        String::from_utf8(std::mem::take(&mut self.out)).unwrap_or_default()
    }
}

/// The size, or the default one if it is empty.
fn known(size: Size) -> Size {
    if size.width == 0 || size.height == 0 {
        UNKNOWN
    } else {
        size
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use ratatui::layout::Rect;
    use ratatui::style::{Color, Modifier, Style};

    use super::super::pen::push_colour;
    use super::*;

    /// A screen whose terminal has shown the frame before the first.
    fn screen(width: u16, height: u16) -> Screen<Vec<u8>> {
        let mut screen = Screen::new(Vec::new(), Size { width, height });
        frame(&mut screen, "");
        screen
    }

    /// The bytes of a frame without its brackets.
    fn frame(screen: &mut Screen<Vec<u8>>, line: &str) -> String {
        let Size { width, height } = screen.size();
        let mut picture = Buffer::empty(Rect { x: 0, y: 0, width, height });
        picture.set_string(0, 0, line, Style::new());
        screen.draw(Instant::now(), picture).unwrap();
        let sent = String::from_utf8(std::mem::take(&mut screen.out)).unwrap();
        match sent.trim_end_matches(REQUEST) {
            "" => sent,
            sent => sent.strip_prefix(BEGIN).unwrap().strip_suffix(END).unwrap().to_owned(),
        }
    }

    #[test]
    fn a_frame_that_changes_nothing_sends_nothing() {
        let mut screen = screen(10, 2);
        assert_eq!(frame(&mut screen, "abc"), "\x1b[Habc");
        assert_eq!(frame(&mut screen, "abc"), "");
        assert!(screen.out.is_empty());
    }

    #[test]
    fn only_what_differs_is_sent() {
        let mut screen = screen(10, 1);
        frame(&mut screen, "abcdef");
        assert_eq!(frame(&mut screen, "aXcdef"), "\x1b[5DX");
    }

    #[test]
    fn a_request_follows_the_frame_and_only_a_frame() {
        let mut screen = screen(4, 1);
        for _ in 0..2 {
            screen.draw(Instant::now(), Buffer::with_lines(["x   "])).unwrap();
        }
        let sent = String::from_utf8(screen.out).unwrap();
        assert_eq!(sent, format!("{BEGIN}\x1b[Hx{END}{REQUEST}"));
    }

    #[test]
    fn repainting_never_asks_where_the_cursor_is() {
        let mut screen = screen(4, 1);
        frame(&mut screen, "x");
        screen.repaint(Size { width: 4, height: 1 });
        assert_eq!(frame(&mut screen, "x"), "\x1b[m\x1b[2J\x1b[Hx");
    }

    /// Any style that a view may use.
    fn style() -> impl Strategy<Value = Style> {
        let colour = prop_oneof![
            Just(Color::Reset),
            Just(Color::Indexed(1)),
            Just(Color::Indexed(7)),
            Just(Color::Indexed(15)),
            any::<u8>().prop_map(Color::Indexed),
            any::<(u8, u8, u8)>().prop_map(|(r, g, b)| Color::Rgb(r, g, b)),
        ];
        // The emulator keeps only the last of bold and dim, so no cell has both.
        let intensity =
            prop::sample::select(vec![Modifier::empty(), Modifier::BOLD, Modifier::DIM]);
        let others = prop::sample::subsequence(
            vec![Modifier::ITALIC, Modifier::UNDERLINED, Modifier::REVERSED],
            0..=3,
        );
        (colour.clone(), colour, intensity, others).prop_map(|(fg, bg, intensity, others)| {
            let add_modifier = others.into_iter().fold(intensity, Modifier::union);
            let sub_modifier = Modifier::all() - add_modifier;
            Style { add_modifier, sub_modifier, ..Style::new().fg(fg).bg(bg) }
        })
    }

    /// Any picture of 12x4 cells.
    fn picture() -> impl Strategy<Value = Buffer> {
        let symbol = prop::sample::select(vec![" ", "a", "\u{28ff}", "\u{b7}", "\u{25cb}"]);
        prop::collection::vec((0..12u16, 0..4u16, symbol, style()), 0..60).prop_map(|cells| {
            let mut buffer = Buffer::empty(Rect::new(0, 0, 12, 4));
            for (x, y, symbol, style) in cells {
                buffer.set_string(x, y, symbol, style);
            }
            buffer
        })
    }

    /// The colour of a cell as the tests' terminal emulator reports it.
    fn seen(colour: Color) -> vt100::Color {
        let mut parameters = Vec::new();
        push_colour(&mut parameters, colour, 30);
        match parameters[..] {
            [39] => vt100::Color::Default,
            [38, 2, red, green, blue] => {
                let byte = |part: u16| u8::try_from(part).unwrap();
                vt100::Color::Rgb(byte(red), byte(green), byte(blue))
            }
            [38, 5, index] => vt100::Color::Idx(u8::try_from(index).unwrap()),
            [dark @ 30..=37] => vt100::Color::Idx(u8::try_from(dark - 30).unwrap()),
            [bright] => vt100::Color::Idx(u8::try_from(bright - 90 + 8).unwrap()),
            _ => unreachable!("{parameters:?}"),
        }
    }

    proptest! {
        /// Whatever sequence of pictures is drawn, the terminal shows exactly the last one.
        #[test]
        fn a_terminal_shows_what_was_drawn(pictures in prop::collection::vec(picture(), 1..5)) {
            let mut screen = screen(12, 4);
            let size = |cells| std::num::NonZero::new(cells).unwrap();
            let mut terminal = vt100::Parser::new(size(4), size(12), 0);
            for picture in &pictures {
                screen.draw(Instant::now(), picture.clone()).unwrap();
                terminal.process(&std::mem::take(&mut screen.out));
            }
            let picture = &pictures[pictures.len() - 1];
            for (index, cell) in picture.content.iter().enumerate() {
                let (x, y) = picture.pos_of(index);
                let shown = terminal.screen().cell(y, x).unwrap();
                let text = if shown.contents().is_empty() { " " } else { shown.contents() };
                prop_assert_eq!(text, cell.symbol());
                prop_assert_eq!(shown.bgcolor(), seen(cell.bg));
                let has = |attribute| cell.modifier.contains(attribute);
                prop_assert_eq!(shown.inverse(), has(Modifier::REVERSED));
                prop_assert_eq!(shown.underline(), has(Modifier::UNDERLINED));
                if cell.symbol() != " " || has(Modifier::REVERSED) || has(Modifier::UNDERLINED) {
                    prop_assert_eq!(shown.fgcolor(), seen(cell.fg));
                    prop_assert_eq!(shown.bold(), has(Modifier::BOLD));
                    prop_assert_eq!(shown.dim(), has(Modifier::DIM));
                    prop_assert_eq!(shown.italic(), has(Modifier::ITALIC));
                }
            }
        }
    }
}
