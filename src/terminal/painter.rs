//! The ratatui backend, which converts cells to bytes, as few as possible.
//!
//! Over SSH, bytes are the cost. ratatui hands the changed cells of a frame to [`Painter::draw`]. The painter
//! converts them to cursor moves, colour changes and text, and sends the frame in one write, bracketed as a
//! synchronized update so that no terminal shows half of it. Two things make it cheaper than crossterm's
//! backend. The first 16 colours are written as `ESC[31m` rather than `ESC[38;5;1m`. Pen and cursor are
//! remembered from frame to frame, so that a frame without changes sends nothing at all. It also never reads
//! `NO_COLOR`: colours are the view's decision, and a view without colours keeps bold and reverse.

use std::io::{self, Write};

use ratatui::backend::{Backend, ClearType, WindowSize};
use ratatui::buffer::Cell;
use ratatui::layout::{Position, Size};

use super::pen::Pen;
use super::strokes::{self, Cursor, Shown, TerminalState};

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

/// Initial capacity for a frame: any ordinary frame fits, since a full 200x60 screen takes about 40 KB.
const FRAME_CAPACITY: usize = 64 * 1024;

/// A ratatui backend for a terminal that understands ECMA-48.
#[derive(Debug)]
pub struct Painter<W: Write> {
    out: W,
    /// The size of the terminal.
    pub size: Size,
    /// The frame in progress, empty or starting with [`BEGIN`].
    frame: Vec<u8>,
    /// Whether frames end with [`REQUEST`], so that the terminal reports when it has shown them.
    pub asking: bool,
    hand: TerminalState,
    shown: Shown,
    cursor_shown: bool,
    /// Bytes written so far.
    pub written: u64,
}

impl<W: Write> Painter<W> {
    /// A painter for a terminal of this size, whose cursor is hidden and whose pen is unknown.
    pub fn new(out: W, size: Size) -> Painter<W> {
        Painter {
            out,
            size,
            frame: Vec::with_capacity(FRAME_CAPACITY),
            asking: false,
            hand: TerminalState::default(),
            shown: Shown::blank(size),
            cursor_shown: false,
            written: 0,
        }
    }

    /// Forgets the state of the terminal, because something else has written to it or it has another size, and
    /// the frame begun for that state.
    pub fn forget(&mut self) {
        self.frame.clear();
        self.hand = TerminalState::default();
        self.shown = Shown::default();
        self.cursor_shown = false;
    }

    /// Writes a control sequence that draws nothing, outside of frames.
    pub fn control(&mut self, sequence: &str) -> io::Result<()> {
        self.out.write_all(sequence.as_bytes())?;
        self.out.flush()?;
        self.written += sequence.len() as u64;
        Ok(())
    }

    /// Adds to the frame in progress; begins it with [`BEGIN`].
    fn put(&mut self, text: &str) {
        if !text.is_empty() {
            let begin = if self.frame.is_empty() { BEGIN } else { "" };
            self.frame.extend_from_slice(begin.as_bytes());
            self.frame.extend_from_slice(text.as_bytes());
        }
    }
}

impl<W: Write> Backend for Painter<W> {
    type Error = io::Error;

    fn draw<'a, I>(&mut self, content: I) -> io::Result<()>
    where
        I: Iterator<Item = (u16, u16, &'a Cell)>,
    {
        let (text, hand) = strokes::draw(content, &mut self.shown, self.hand);
        self.put(&text);
        self.hand = hand;
        Ok(())
    }

    fn hide_cursor(&mut self) -> io::Result<()> {
        if self.cursor_shown {
            self.put("\x1b[?25l");
            self.cursor_shown = false;
        }
        Ok(())
    }

    fn show_cursor(&mut self) -> io::Result<()> {
        if !self.cursor_shown {
            self.put("\x1b[?25h");
            self.cursor_shown = true;
        }
        Ok(())
    }

    /// Never asks the terminal: the reply would arrive among the keys (ratatui#2691).
    fn get_cursor_position(&mut self) -> io::Result<Position> {
        let known = self.hand.cursor.map(|cursor| cursor.at);
        known.ok_or_else(|| io::Error::other("where the cursor is, is not known"))
    }

    fn set_cursor_position<P: Into<Position>>(&mut self, position: P) -> io::Result<()> {
        let at = position.into();
        let cursor = Some(Cursor { at, certain: true });
        if self.hand.cursor != cursor {
            let Position { x, y } = at;
            self.put(&format!("\x1b[{};{}H", y + 1, x + 1));
            self.hand.cursor = cursor;
        }
        Ok(())
    }

    fn clear(&mut self) -> io::Result<()> {
        self.put(PLAIN);
        self.put(ERASE);
        self.hand.pen = Some(Pen::PLAIN);
        self.shown = Shown::blank(self.size);
        Ok(())
    }

    /// Clears everything, whatever the region: this program only uses the full screen.
    fn clear_region(&mut self, _: ClearType) -> io::Result<()> {
        self.clear()
    }

    fn size(&self) -> io::Result<Size> {
        Ok(self.size)
    }

    fn window_size(&mut self) -> io::Result<WindowSize> {
        Ok(WindowSize { columns_rows: self.size, pixels: Size::default() })
    }

    /// Sends the frame, if any, in one write.
    fn flush(&mut self) -> io::Result<()> {
        if self.frame.is_empty() {
            return Ok(());
        }
        self.put(END);
        if self.asking {
            self.put(REQUEST);
        }
        let sent = self.out.write_all(&self.frame).and_then(|()| self.out.flush());
        self.written += self.frame.len() as u64;
        self.frame.clear();
        sent
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use ratatui::Terminal;
    use ratatui::buffer::Buffer;
    use ratatui::style::{Color, Modifier, Style};
    use ratatui::text::Line;

    use super::super::pen::push_colour;
    use super::*;

    fn terminal(width: u16, height: u16) -> Terminal<Painter<Vec<u8>>> {
        Terminal::new(Painter::new(Vec::new(), Size { width, height })).unwrap()
    }

    /// The bytes of a frame without its brackets.
    fn frame(terminal: &mut Terminal<Painter<Vec<u8>>>, line: &Line) -> String {
        terminal.draw(|frame| frame.render_widget(line, frame.area())).unwrap();
        let sent = String::from_utf8(std::mem::take(&mut terminal.backend_mut().out)).unwrap();
        match sent.as_str() {
            "" => sent,
            sent => sent.strip_prefix(BEGIN).unwrap().strip_suffix(END).unwrap().to_owned(),
        }
    }

    #[test]
    fn a_frame_that_changes_nothing_sends_nothing() {
        let mut terminal = terminal(10, 2);
        assert_eq!(frame(&mut terminal, &Line::from("abc")), "\x1b[H\x1b[mabc");
        assert_eq!(frame(&mut terminal, &Line::from("abc")), "");
        assert_eq!(terminal.backend().written, 25);
    }

    #[test]
    fn only_what_differs_is_sent() {
        let mut terminal = terminal(10, 1);
        frame(&mut terminal, &Line::from("abcdef"));
        assert_eq!(frame(&mut terminal, &Line::from("aXcdef")), "\x1b[5DX");
    }

    #[test]
    fn a_request_follows_the_frame_and_only_a_frame() {
        let mut terminal = terminal(4, 1);
        terminal.backend_mut().asking = true;
        for _ in 0..2 {
            terminal.draw(|frame| frame.render_widget("x", frame.area())).unwrap();
        }
        let sent = String::from_utf8(terminal.backend().out.clone()).unwrap();
        assert_eq!(sent, format!("{BEGIN}\x1b[H\x1b[mx{END}{REQUEST}"));
    }

    #[test]
    fn repainting_never_asks_where_the_cursor_is() {
        let mut terminal = terminal(4, 1);
        frame(&mut terminal, &Line::from("x"));
        terminal.backend_mut().forget();
        terminal.resize(ratatui::layout::Rect::new(0, 0, 4, 1)).unwrap();
        assert_eq!(frame(&mut terminal, &Line::from("x")), "\x1b[m\x1b[2J\x1b[Hx");
    }

    /// Any style that a view may use.
    fn style() -> impl Strategy<Value = Style> {
        let colour = prop_oneof![
            Just(Color::Reset),
            Just(Color::Red),
            Just(Color::Gray),
            Just(Color::White),
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
            let mut buffer = Buffer::empty(ratatui::layout::Rect::new(0, 0, 12, 4));
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
            let mut terminal = terminal(12, 4);
            let size = |cells| std::num::NonZero::new(cells).unwrap();
            let mut screen = vt100::Parser::new(size(4), size(12), 0);
            for picture in &pictures {
                terminal.draw(|frame| *frame.buffer_mut() = picture.clone()).unwrap();
                screen.process(&std::mem::take(&mut terminal.backend_mut().out));
            }
            let picture = &pictures[pictures.len() - 1];
            for (index, cell) in picture.content.iter().enumerate() {
                let (x, y) = picture.pos_of(index);
                let shown = screen.screen().cell(y, x).unwrap();
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
