//! The page of help, over the panes: what is on show where the focus is, and the keys that matter there.

use ratatui::layout::Rect;
use ratatui::text::Line;

use super::{Surface, pane};
use crate::picture::Role;
use crate::session::Session;

const WIDTH: u16 = 78;

/// Draws the page into the middle of the screen, if it is open.
pub fn draw(area: Rect, session: &Session, screen: &mut Surface) {
    let Some(contexts) = session.helped() else { return };
    let look = screen.look;
    let rows = session.help_rows(contexts);
    let keys: Vec<String> = rows.iter().map(|row| look.keys(row.keys.iter().copied())).collect();
    let column = keys.iter().map(|keys| keys.chars().count()).max().unwrap_or(0);
    let about = Line::from(look.span(session.help_about(contexts), Role::Quiet));
    let mut lines = vec![about, Line::default()];
    lines.extend(keys.into_iter().zip(rows).map(|(keys, row)| {
        let keys = look.span(format!(" {keys:<column$}  "), Role::Key);
        Line::from(vec![keys, look.span(row.text, Role::Text)])
    }));
    let width = area.width.min(WIDTH);
    // The footer stays in sight.
    let most = area.height.saturating_sub(1);
    let height = most.min(pane::rows(&lines, width - 4) + 2);
    let (x, y) = (area.x + (area.width - width) / 2, area.y + (most - height) / 2);
    let heading = format!(" help: {} ", contexts[0].spec().title.to_lowercase());
    let on = " these keys work from here; {help} again: everything; {back} closes ";
    let on = look.sentence(on, &session.keymap);
    let text = screen.boxed(Rect { x, y, width, height }, &heading, &on);
    screen.prose(text, lines);
}
