//! Cells to bytes: the backend that draws ratatui's frames with as few bytes as it can.
//!
//! Over SSH bytes are the cost. ratatui hands the changed cells of a frame to [`Painter::draw`]; the
//! painter turns them into cursor moves, colour changes and text, and sends the frame as one write,
//! bracketed as a synchronized update, so that no terminal shows half of it. Two things make it
//! cheaper than crossterm's backend: the first 16 colours are written as `ESC[31m` rather than
//! `ESC[38;5;1m`, and pen and cursor are remembered from frame to frame, so that a frame in which
//! nothing changed sends nothing at all. It also never reads `NO_COLOR`: colours are the view's
//! decision, and a view without them keeps bold and reverse.

use std::io::{self, Write};

use ratatui::backend::{Backend, ClearType, WindowSize};
use ratatui::buffer::Cell;
use ratatui::layout::{Position, Size};
use ratatui::style::{Color, Modifier};
use unicode_width::UnicodeWidthStr;

/// Holds back the picture until [`END`]: synchronized update, private mode 2026.
pub const BEGIN: &str = "\x1b[?2026h";

/// Shows what was written since [`BEGIN`].
pub const END: &str = "\x1b[?2026l";

/// Asks the terminal for a cursor position report, which it sends once it has read all before it.
pub const REQUEST: &str = "\x1b[6n";

/// Back to the terminal's own colours and no attributes.
pub const PLAIN: &str = "\x1b[m";

/// Erases the screen.
const ERASE: &str = "\x1b[2J";

/// Bytes that hold any ordinary frame without growing: a full 200x60 screen has about 40 KB.
const FRAME_CAPACITY: usize = 64 * 1024;

/// Attributes of a cell that the painter draws: which, how to switch it on, and how off.
///
/// Bold and dim have one code to switch both off; [`Pen::change`] switches the other on again.
const ATTRIBUTES: [(Modifier, u8, u8); 6] = [
    (Modifier::BOLD, 1, 22),
    (Modifier::DIM, 2, 22),
    (Modifier::ITALIC, 3, 23),
    (Modifier::UNDERLINED, 4, 24),
    (Modifier::REVERSED, 7, 27),
    (Modifier::CROSSED_OUT, 9, 29),
];

/// Attributes that show on a blank cell too.
const SEEN_ON_BLANKS: Modifier =
    Modifier::UNDERLINED.union(Modifier::REVERSED).union(Modifier::CROSSED_OUT);

/// What the terminal draws the next character with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Pen {
    foreground: Color,
    background: Color,
    attributes: Modifier,
}

impl Pen {
    /// The terminal's own colours, no attributes.
    const PLAIN: Pen =
        Pen { foreground: Color::Reset, background: Color::Reset, attributes: Modifier::empty() };

    /// The pen that a cell asks for, given the present one: on a blank cell most of it is not seen.
    fn of(cell: &Cell, present: Pen) -> Pen {
        let wanted = Pen { foreground: cell.fg, background: cell.bg, attributes: cell.modifier };
        let seen = wanted.attributes.union(present.attributes).intersects(SEEN_ON_BLANKS);
        if cell.symbol() == " " && !seen {
            Pen { background: wanted.background, ..present }
        } else {
            wanted
        }
    }

    /// Parameters that turn this pen into another: switching off what it has too much, and on what
    /// it lacks.
    fn change(self, to: Pen) -> Vec<u16> {
        let mut parameters = Vec::new();
        let mut present = self.attributes;
        for (attribute, _, off) in ATTRIBUTES {
            if present.contains(attribute) && !to.attributes.contains(attribute) {
                parameters.push(u16::from(off));
                for (other, _, same) in ATTRIBUTES {
                    if same == off {
                        present.remove(other);
                    }
                }
            }
        }
        for (attribute, on, _) in ATTRIBUTES {
            if to.attributes.contains(attribute) && !present.contains(attribute) {
                parameters.push(u16::from(on));
            }
        }
        if self.foreground != to.foreground {
            push_colour(&mut parameters, to.foreground, 30);
        }
        if self.background != to.background {
            push_colour(&mut parameters, to.background, 40);
        }
        parameters
    }
}

/// Appends the parameters of a colour; `base` is 30 for the foreground and 40 for the background.
fn push_colour(parameters: &mut Vec<u16>, colour: Color, base: u16) {
    let indexed = match colour {
        Color::Reset => return parameters.push(base + 9),
        Color::Rgb(red, green, blue) => {
            return parameters.extend([base + 8, 2, red.into(), green.into(), blue.into()]);
        }
        Color::Indexed(index) => index,
        Color::Black => 0,
        Color::Red => 1,
        Color::Green => 2,
        Color::Yellow => 3,
        Color::Blue => 4,
        Color::Magenta => 5,
        Color::Cyan => 6,
        Color::Gray => 7,
        Color::DarkGray => 8,
        Color::LightRed => 9,
        Color::LightGreen => 10,
        Color::LightYellow => 11,
        Color::LightBlue => 12,
        Color::LightMagenta => 13,
        Color::LightCyan => 14,
        Color::White => 15,
    };
    match u16::from(indexed) {
        dark @ 0..8 => parameters.push(base + dark),
        bright @ 8..16 => parameters.push(base + 60 + bright - 8),
        other => parameters.extend([base + 8, 5, other]),
    }
}

/// Number of characters of a select-graphic-rendition sequence with these parameters.
fn length(parameters: &[u16]) -> usize {
    let digits = |number: &u16| if *number < 10 { 1 } else { 2 + usize::from(*number > 99) };
    parameters.iter().map(|number| digits(number) + 1).sum()
}

/// A ratatui backend for a terminal that understands ECMA-48.
#[derive(Debug)]
pub struct Painter<W: Write> {
    out: W,
    size: Size,
    /// The frame in work, empty or starting with [`BEGIN`].
    frame: Vec<u8>,
    /// Whether the next frame ends with [`REQUEST`].
    asking: bool,
    pen: Option<Pen>,
    cursor: Option<Position>,
    cursor_shown: bool,
    written: u64,
}

impl<W: Write> Painter<W> {
    /// A painter for a terminal of this size, whose cursor is hidden and whose pen is unknown.
    pub fn new(out: W, size: Size) -> Painter<W> {
        Painter {
            out,
            size,
            frame: Vec::with_capacity(FRAME_CAPACITY),
            asking: false,
            pen: None,
            cursor: None,
            cursor_shown: false,
            written: 0,
        }
    }

    /// Bytes written so far.
    #[must_use]
    pub fn written(&self) -> u64 {
        self.written
    }

    /// Tells the painter the size of the terminal; ratatui clears and repaints when it differs.
    pub fn set_size(&mut self, size: Size) {
        self.size = size;
    }

    /// The size that the painter was told.
    #[must_use]
    pub fn shown_size(&self) -> Size {
        self.size
    }

    /// Forgets what is known of the terminal: something else has written to it.
    pub fn forget(&mut self) {
        self.pen = None;
        self.cursor = None;
        self.cursor_shown = false;
    }

    /// Whether frames ask the terminal to say when it has shown them.
    pub fn ask(&mut self, asking: bool) {
        self.asking = asking;
    }

    /// Writes a control sequence that draws nothing, outside of frames.
    ///
    /// # Errors
    /// The error of writing to the terminal.
    pub fn control(&mut self, sequence: &str) -> io::Result<()> {
        self.out.write_all(sequence.as_bytes())?;
        self.out.flush()?;
        self.written += sequence.len() as u64;
        Ok(())
    }

    /// Where the frame goes; opens the bracket at the first use.
    fn frame(&mut self) -> &mut Vec<u8> {
        if self.frame.is_empty() {
            self.frame.extend_from_slice(BEGIN.as_bytes());
        }
        &mut self.frame
    }

    fn put(&mut self, text: &str) {
        self.frame().extend_from_slice(text.as_bytes());
    }

    fn put_formatted(&mut self, text: std::fmt::Arguments) {
        self.frame().write_fmt(text).expect("a vector takes any number of bytes");
    }

    /// Moves the cursor, by the shortest way that works from where it is known to be.
    fn go_to(&mut self, target: Position) {
        let Position { x, y } = target;
        match self.cursor {
            Some(cursor) if cursor == target => {}
            Some(cursor) if cursor.y == y && cursor.x < x => match x - cursor.x {
                1 => self.put("\x1b[C"),
                gap => self.put_formatted(format_args!("\x1b[{gap}C")),
            },
            Some(cursor) if cursor.y + 1 == y && x == 0 => self.put("\r\n"),
            _ if x == 0 => self.put_formatted(format_args!("\x1b[{}H", y + 1)),
            _ => self.put_formatted(format_args!("\x1b[{};{}H", y + 1, x + 1)),
        }
        self.cursor = Some(target);
    }

    /// Takes up the pen, by switching what differs or by starting anew, whichever is shorter.
    fn take(&mut self, pen: Pen) {
        if self.pen == Some(pen) {
            return;
        }
        let anew = Pen::PLAIN.change(pen);
        let parameters = match self.pen.map(|present| present.change(pen)) {
            Some(change) if length(&change) <= length(&anew) + 2 => change,
            _ if pen == Pen::PLAIN => anew,
            _ => std::iter::once(0).chain(anew).collect(),
        };
        self.put("\x1b[");
        for (place, parameter) in parameters.iter().enumerate() {
            let separator = if place == 0 { "" } else { ";" };
            self.put_formatted(format_args!("{separator}{parameter}"));
        }
        self.put("m");
        self.pen = Some(pen);
    }
}

impl<W: Write> Backend for Painter<W> {
    type Error = io::Error;

    fn draw<'a, I>(&mut self, content: I) -> io::Result<()>
    where
        I: Iterator<Item = (u16, u16, &'a Cell)>,
    {
        for (x, y, cell) in content {
            self.go_to(Position { x, y });
            self.take(Pen::of(cell, self.pen.unwrap_or(Pen::PLAIN)));
            self.put(cell.symbol());
            let width = u16::try_from(cell.symbol().width()).unwrap_or(1);
            self.cursor = Some(Position { x: x.saturating_add(width), y });
        }
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

    /// Never asks: the reply would arrive among the keys (ratatui#2691).
    fn get_cursor_position(&mut self) -> io::Result<Position> {
        self.cursor.ok_or_else(|| io::Error::other("where the cursor is, is not known"))
    }

    fn set_cursor_position<P: Into<Position>>(&mut self, position: P) -> io::Result<()> {
        self.go_to(position.into());
        Ok(())
    }

    fn clear(&mut self) -> io::Result<()> {
        self.put(PLAIN);
        self.put(ERASE);
        self.pen = Some(Pen::PLAIN);
        Ok(())
    }

    /// Clears everything, whatever the region: the full screen is all that this program uses.
    fn clear_region(&mut self, _: ClearType) -> io::Result<()> {
        self.clear()
    }

    fn size(&self) -> io::Result<Size> {
        Ok(self.size)
    }

    fn window_size(&mut self) -> io::Result<WindowSize> {
        Ok(WindowSize { columns_rows: self.size, pixels: Size::default() })
    }

    /// Sends the frame, if there is one, in one write.
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
    use ratatui::style::{Style, Stylize};
    use ratatui::text::Line;

    use super::*;

    fn terminal(width: u16, height: u16) -> Terminal<Painter<Vec<u8>>> {
        Terminal::new(Painter::new(Vec::new(), Size { width, height })).unwrap()
    }

    /// What a frame sent, without its bracket.
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
        assert_eq!(frame(&mut terminal, &Line::from("abc")), "\x1b[1H\x1b[mabc");
        assert_eq!(frame(&mut terminal, &Line::from("abc")), "");
        assert_eq!(terminal.backend().written(), 26);
    }

    #[test]
    fn only_what_differs_is_sent() {
        let mut terminal = terminal(10, 1);
        frame(&mut terminal, &Line::from("abcdef"));
        assert_eq!(frame(&mut terminal, &Line::from("aXcdeY")), "\x1b[1;2HX\x1b[3CY");
    }

    #[test]
    fn the_sixteen_colours_are_short_and_attributes_survive_without_colour() {
        let mut terminal = terminal(10, 1);
        let sent = frame(
            &mut terminal,
            &Line::from_iter(["a".red(), "b".light_red().bold(), "c".bold(), "d".reversed()]),
        );
        assert_eq!(sent, "\x1b[1H\x1b[0;31ma\x1b[1;91mb\x1b[39mc\x1b[0;7md");
    }

    #[test]
    fn switching_bold_off_keeps_dim() {
        let mut terminal = terminal(10, 1);
        let sent =
            frame(&mut terminal, &Line::from_iter(["a".red().bold().dim(), "b".red().dim()]));
        assert_eq!(sent, "\x1b[1H\x1b[0;1;2;31ma\x1b[22;2mb");
    }

    #[test]
    fn a_request_follows_the_frame_and_only_a_frame() {
        let mut terminal = terminal(4, 1);
        terminal.backend_mut().ask(true);
        for _ in 0..2 {
            terminal.draw(|frame| frame.render_widget("x", frame.area())).unwrap();
        }
        let sent = String::from_utf8(terminal.backend().out.clone()).unwrap();
        assert_eq!(sent, format!("{BEGIN}\x1b[1H\x1b[mx{END}{REQUEST}"));
    }

    #[test]
    fn repainting_never_asks_where_the_cursor_is() {
        let mut terminal = terminal(4, 1);
        frame(&mut terminal, &Line::from("x"));
        terminal.backend_mut().forget();
        terminal.resize(ratatui::layout::Rect::new(0, 0, 4, 1)).unwrap();
        assert_eq!(frame(&mut terminal, &Line::from("x")), "\x1b[m\x1b[2J\x1b[1Hx");
    }

    /// Any style a view could use.
    fn style() -> impl Strategy<Value = Style> {
        let colour = prop_oneof![
            Just(Color::Reset),
            Just(Color::Red),
            Just(Color::Gray),
            Just(Color::White),
            any::<u8>().prop_map(Color::Indexed),
            any::<(u8, u8, u8)>().prop_map(|(r, g, b)| Color::Rgb(r, g, b)),
        ];
        // The emulator keeps only the last of bold and dim, so no cell here has both.
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
        let symbol = prop_oneof![Just(" "), Just("a"), Just("\u{28ff}")];
        prop::collection::vec((0..12u16, 0..4u16, symbol, style()), 0..60).prop_map(|cells| {
            let mut buffer = Buffer::empty(ratatui::layout::Rect::new(0, 0, 12, 4));
            for (x, y, symbol, style) in cells {
                buffer.set_string(x, y, symbol, style);
            }
            buffer
        })
    }

    /// The colour that the terminal emulator of these tests says a cell has.
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
        /// Whatever is drawn after whatever, a terminal shows exactly the last picture.
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
