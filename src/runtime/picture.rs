//! The picture of an application, without a terminal.

use ratatui::Terminal;
use ratatui::backend::TestBackend;
use ratatui::buffer::Buffer;
use ratatui::layout::Size;

use super::application::Application;

/// The picture at this size, as ratatui's cells.
pub fn of(application: &impl Application, size: Size) -> Buffer {
    let Ok(mut terminal) = Terminal::new(TestBackend::new(size.width, size.height));
    let Ok(drawn) = terminal.draw(|frame| application.draw(frame));
    drawn.buffer.clone()
}
