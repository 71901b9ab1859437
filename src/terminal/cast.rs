//! A recording of the screen that plays in a terminal: asciicast, version 2, a header and a line for each frame.

use std::time::Instant;

use ratatui::buffer::Buffer;
use ratatui::layout::Size;
use serde_json::json;

use super::Screen;
use super::screen::{PLAIN, REQUEST};
use crate::numerics::real;
use crate::session::Msg;

/// Time in s to see what a key has done, and to read a character.
const KEY: f64 = 0.5;
const CHARACTER: f64 = 0.06;

/// How long the last frame is shown, in s.
const LAST: f64 = 2.0;

/// The frames so far.
pub struct Cast {
    lines: Vec<String>,
    screen: Screen<Vec<u8>>,
    /// That of the largest frame.
    size: Size,
    time: f64,
    /// How long it takes to see or read what stands there now, in s.
    pause: f64,
}

impl Default for Cast {
    /// A recording without a frame, on a terminal that hides its cursor.
    fn default() -> Self {
        let (size, lines) = (Size::default(), vec![r#"[0.0,"o","\u001b[?25l"]"#.to_owned()]);
        Cast { lines, screen: Screen::new(Vec::new(), size), size, time: 0.0, pause: KEY }
    }
}

impl Cast {
    /// Keeps the picture before a message for as long as it takes to see it. What comes before the start of a session is not
    /// kept.
    pub fn film(&mut self, msg: &Msg, picture: impl Fn() -> Buffer) {
        if matches!(msg, Msg::Start(_)) {
            *self = Cast::default();
            return;
        }
        self.show(picture());
        self.time += match msg {
            Msg::Elapsed { seconds } => *seconds,
            Msg::Resize { .. } => 0.0,
            _ => self.pause,
        };
        self.pause = match msg {
            Msg::Say(text, _) => KEY.max(CHARACTER * real(text.len())),
            _ => KEY,
        };
    }

    /// Shows a picture from now on.
    pub fn show(&mut self, picture: Buffer) {
        let size @ Size { width, height } = picture.area.as_size();
        self.size = Size::new(self.size.width.max(width), self.size.height.max(height));
        if self.screen.size() != size {
            self.screen.repaint(size);
        }
        // Nobody answers a question that is recorded.
        let text = self.screen.drawn(Instant::now(), picture).replace(REQUEST, "");
        if !text.is_empty() {
            self.add(&text);
        }
    }

    fn add(&mut self, text: &str) {
        // To the microsecond, as players count.
        let time = (self.time * 1e6).round() / 1e6;
        self.lines.push(json!([time, "o", text]).to_string());
    }

    /// The file, which gives the terminal back at its end.
    pub fn end(mut self) -> String {
        let Size { width, height } = self.size;
        self.time += LAST;
        self.add(&format!("{PLAIN}\x1b[{height}H\r\n\x1b[?25h"));
        let header = json!({"version": 2, "width": width, "height": height}).to_string();
        format!("{header}\n{}\n", self.lines.join("\n"))
    }
}

#[cfg(test)]
mod tests {
    use serde_json::Value;

    use super::*;

    #[test]
    fn a_terminal_that_gets_the_lines_shows_the_last_picture() {
        let mut cast = Cast::default();
        let pictures = [(["abc", "   "], 0.5), (["aXc", "   "], 0.25), (["aXc", "end"], 1.0)];
        for (lines, seconds) in pictures {
            cast.show(Buffer::with_lines(lines));
            cast.time += seconds;
        }
        // A smaller picture takes the place of the larger one.
        cast.show(Buffer::with_lines(["de"]));
        let text = cast.end();
        let mut lines = text.lines().map(|line| serde_json::from_str::<Value>(line).unwrap());
        assert_eq!(lines.next(), Some(json!({"version": 2, "width": 3, "height": 2})));
        let events: Vec<Value> = lines.collect();
        let times: Vec<f64> = events.iter().map(|event| event[0].as_f64().unwrap()).collect();
        assert_eq!(times, [0.0, 0.0, 0.5, 0.75, 1.75, 3.75]);
        let size = |cells| std::num::NonZero::new(cells).unwrap();
        let mut terminal = vt100::Parser::new(size(2), size(3), 0);
        for (event, shown) in events.iter().zip(["", "abc", "aXc", "aXc\nend", "de"]) {
            let text = event[2].as_str().unwrap();
            assert!(!text.contains(REQUEST));
            terminal.process(text.as_bytes());
            assert_eq!(terminal.screen().contents().trim_end(), shown);
        }
    }
}
