//! A recording of the screen that plays in a terminal: asciicast, version 2, a header and a line for each frame.

use std::time::Instant;

use ratatui::buffer::Buffer;
use ratatui::layout::Size;
use serde_json::json;

use super::Screen;
use super::screen::{PLAIN, REQUEST};

/// Time in s to see what a key has done.
pub const KEY: f64 = 0.5;

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
    pub pause: f64,
}

impl Default for Cast {
    /// A recording without a frame.
    fn default() -> Self {
        let size = Size::default();
        let screen = Screen::new(Vec::new(), size);
        Cast { lines: Vec::new(), screen, size, time: 0.0, pause: KEY }
    }
}

impl Cast {
    /// Shows a picture from now on.
    pub fn show(&mut self, picture: Buffer) {
        let size = picture.area.as_size();
        if self.size != size {
            self.screen.repaint(size);
            self.size =
                Size::new(self.size.width.max(size.width), self.size.height.max(size.height));
        }
        // Nobody answers a question that is recorded.
        let text = self.screen.drawn(Instant::now(), picture).replace(REQUEST, "");
        if !text.is_empty() {
            self.add(&text);
        }
    }

    /// Lets time pass, in s.
    pub fn pass(&mut self, seconds: f64) {
        self.time += seconds;
    }

    fn add(&mut self, text: &str) {
        // To the microsecond, as players count.
        let time = (self.time * 1e6).round() / 1e6;
        self.lines.push(json!([time, "o", text]).to_string());
    }

    /// The file: with the cursor hidden, and given back at the end.
    pub fn end(mut self) -> String {
        let Size { width, height } = self.size;
        self.pass(LAST);
        self.add(&format!("{PLAIN}\x1b[{height}H\r\n\x1b[?25h"));
        let header = json!({"version": 2, "width": width, "height": height}).to_string();
        let hidden = json!([0.0, "o", "\x1b[?25l"]).to_string();
        let lines = [header, hidden].into_iter().chain(self.lines);
        lines.map(|line| line + "\n").collect()
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
            cast.pass(seconds);
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
