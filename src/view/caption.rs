//! A box of text above the status lines: the caption of a tour, or what there is to see in the scene and
//! to press. It takes no keys: what it says can be tried while it is read.

use ratatui::layout::Rect;
use ratatui::text::Line;

use super::{Surface, pane};
use crate::picture::Role;
use crate::session::{Session, SessionCaption};

const WIDTH: u16 = 100;

/// Draws the box at the bottom of `area`, if there is something to say and room for it.
pub fn draw(area: Rect, session: &Session, screen: &mut Surface) {
    let look = screen.look;
    let filled = |text: &str| look.sentence(text, &session.keymap);
    let (heading, paragraphs) = match &session.caption {
        SessionCaption::Tour(caption, place) => {
            let place = place.map_or(String::new(), |(step, of)| format!("{step} of {of}, "));
            let named = caption.contains('{');
            let on = if named {
                "keys named here work, any other: on"
            } else {
                "any key: on"
            };
            let heading = format!(" {place}{on}, backspace: back, esc: leave ");
            (heading, vec![filled(caption)])
        }
        SessionCaption::Scene => {
            let heading = filled(" {explain}: hide ");
            let [look, press] = [&session.scene.watch, &session.scene.press];
            (heading, [look, press].map(|text| filled(&session.said(text))).to_vec())
        }
        SessionCaption::Nothing => return,
    };
    let width = area.width.min(WIDTH);
    let inner = width.saturating_sub(4);
    // A tour is read from a distance.
    let role = if session.caption == SessionCaption::Scene {
        Role::Text
    } else {
        Role::Title
    };
    let styled = |text| Line::styled(text, look.style(role));
    let lines: Vec<Line> = paragraphs.into_iter().map(styled).collect();
    let height = pane::rows(&lines, inner).saturating_add(2).min(area.height);
    let place =
        Rect { x: area.x + (area.width - width) / 2, y: area.bottom() - height, width, height };
    let text = screen.boxed(place, &heading, "");
    screen.prose(text, lines);
}
