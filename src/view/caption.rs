//! A box of text between the plots and the status lines: the caption of a tour, or what there is to see in the scene and
//! to press. It takes no keys: what it says can be tried while it is read.

use ratatui::layout::Rect;
use ratatui::text::Line;

use super::{Surface, pane};
use crate::picture::Role;
use crate::session::{Key, Session, SessionCaption};

const WIDTH: u16 = 100;

/// Columns of the frame and of a blank beside it.
const FRAME: u16 = 4;

/// How one goes back.
const BACK: &str = ", backspace: back";

/// Headings, the longest first, and paragraphs, with keys as they are written; `None` where nothing is said.
fn texts(session: &Session, write: impl Fn(Key) -> String) -> Option<(Vec<String>, Vec<String>)> {
    let filled = |text: &str| session.keymap.fill(text, &write);
    Some(match &session.caption {
        SessionCaption::Tour(caption, place) => {
            let named = caption.contains('{');
            let on = if named {
                "keys named here work, any other: on"
            } else {
                "any key: on"
            };
            (headings(session, *place, [on, BACK]), vec![filled(caption)])
        }
        SessionCaption::Asked(text, place, answer) => {
            // A task is begun again by no key.
            let task = ["do it, page down: show how", ""];
            let keys = answer.map_or(task, |_| ["y or n", BACK]);
            (headings(session, *place, keys), vec![filled(text)])
        }
        SessionCaption::Scene => {
            let [look, press] = [&session.scene.watch, &session.scene.press];
            let said = [look, press].map(|text| filled(&session.said(text)));
            (vec![filled(" {explain}: hide ")], said.to_vec())
        }
        SessionCaption::Nothing => return None,
    })
}

/// The chapter, the number of a caption and of all, and which keys are heard: in full, and where there is less room.
fn headings(session: &Session, place: Option<(usize, usize)>, keys: [&str; 2]) -> Vec<String> {
    let [how, back] = keys;
    let number = place.map_or(String::new(), |(step, of)| format!("{step} of {of}, "));
    let chapter = match &*session.chapter {
        "" => String::new(),
        chapter => format!("{chapter}: "),
    };
    let ways = [(&*chapter, back), (&chapter, ""), ("", back), ("", "")];
    ways.map(|(chapter, back)| format!(" {chapter}{number}{how}{back}, esc: leave ")).to_vec()
}

/// Rows of the box on a screen of this width; none where nothing is said.
pub fn rows(width: u16, session: &Session) -> u16 {
    // The names of keys are at least as long as their signs.
    let Some((_, paragraphs)) = texts(session, Key::said) else { return 0 };
    let lines: Vec<Line> = paragraphs.into_iter().map(Line::from).collect();
    pane::rows(&lines, width.min(WIDTH).saturating_sub(FRAME)).saturating_add(2)
}

/// Draws the box, if there is something to say and room for it.
pub fn draw(area: Rect, session: &Session, screen: &mut Surface) {
    let look = screen.look;
    let said = texts(session, |key| look.key(key)).filter(|_| area.height > 2);
    let Some((headings, paragraphs)) = said else { return };
    // A tour is read from a distance.
    let role = if session.caption == SessionCaption::Scene {
        Role::Text
    } else {
        Role::Title
    };
    let styled = |text| Line::styled(text, look.style(role));
    let width = area.width.min(WIDTH);
    let place = Rect { x: area.x + (area.width - width) / 2, width, ..area };
    let heading = pane::fitting(headings, width.saturating_sub(FRAME).into());
    let text = screen.boxed(place, &heading, "");
    screen.prose(text, paragraphs.into_iter().map(styled).collect());
}
