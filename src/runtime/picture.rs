//! What a machine would show, without a terminal.

use ratatui::Terminal;
use ratatui::backend::TestBackend;
use ratatui::buffer::Buffer;
use ratatui::layout::Size;

use super::pump::Machine;

/// The picture at this size, as ratatui's cells.
#[must_use]
pub fn of(machine: &impl Machine, size: Size) -> Buffer {
    let Ok(mut terminal) = Terminal::new(TestBackend::new(size.width, size.height));
    let Ok(drawn) = terminal.draw(|frame| machine.draw(frame));
    drawn.buffer.clone()
}

/// The characters of a picture: its rows, without the blanks at their ends.
#[must_use]
pub fn text(picture: &Buffer) -> String {
    let width = usize::from(picture.area.width).max(1);
    let mut text = String::new();
    for row in picture.content.chunks(width) {
        let row: String = row.iter().map(ratatui::buffer::Cell::symbol).collect();
        text.push_str(row.trim_end());
        text.push('\n');
    }
    text
}
