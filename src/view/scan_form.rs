//! The form in which a scan is typed: one line a field, and why it was refused.

use ratatui::layout::Rect;

use super::{Surface, footer::typed, pane};
use crate::picture::Role;
use crate::scan::measure::MEASURES;
use crate::session::overlay::{FIELDS, ScanForm};
use crate::session::{Overlay, Session};

const WIDTH: u16 = 74;

/// Rows below the fields: about the field, and why the form was refused.
const BELOW: u16 = 3;

/// Draws the form, if it is open, into the middle of the screen.
pub fn draw(area: Rect, session: &Session, screen: &mut Surface) {
    let look = screen.look;
    let Some(Overlay::Scan(form)) = &session.overlay else { return };
    let rows = u16::try_from(FIELDS.len()).unwrap_or(u16::MAX) + BELOW;
    let width = WIDTH.min(area.width);
    let height = (rows + 2).min(area.height.saturating_sub(1));
    let area = pane::centred(area, width, height);
    if area.width < 20 || area.height < 6 {
        return;
    }
    let inner = screen.boxed(area, " scan ", "");
    for (row, (index, (name, _))) in (0..inner.height).zip(FIELDS.iter().enumerate()) {
        let active = index == form.at;
        let pointer = if active { look.symbols().pointer } else { " " };
        let name = format!("{pointer} {name:<9}");
        let role = if active { Role::Focus } else { Role::Quiet };
        let mut line = vec![look.span(name, role)];
        let input = &form.inputs[index];
        if active {
            line.extend(typed(input, look));
        } else {
            line.push(look.span(input.text(), Role::Text));
        }
        screen.line(inner, row, line);
    }
    let below = inner.height.saturating_sub(2);
    let quiet = |text: String| look.span(text, Role::Quiet);
    screen.line(inner, below, quiet(about(form)));
    if let Some(why) = &form.refused {
        screen.line(inner, below + 1, look.span(why.clone(), Role::Failure));
    }
}

/// What the field takes, or what the measure in it means.
fn about(form: &ScanForm) -> String {
    let text = form.inputs[form.at].text();
    let measure = MEASURES.iter().find(|row| form.at == ScanForm::MEASURE && row.name == text);
    measure.map_or(FIELDS[form.at].1, |row| row.meaning).to_owned()
}
