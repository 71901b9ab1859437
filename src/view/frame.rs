//! The whole screen: layout, panes, and what lies over them; and from a cell of it to what stands there, for the mouse.

use ratatui::buffer::Buffer;
use ratatui::layout::{Position, Rect, Size};
use ratatui::widgets::{Clear, Paragraph, Widget, Wrap};

use super::layout::{Layout, SMALLEST, layout};
use super::pane::{self, FramedPicture, Heading};
use super::plot::{point_at, room, shown};
use super::{
    Look, Surface, caption, energy_ledger, explain, footer, help, lecture, legend, lists,
    paint::paint, parameters, playback, scan, signs, status,
};
use crate::picture::{self, Role, legend::entries};
use crate::scene::View;
use crate::session::{Glyphs, Overlay, Pane, PointerTarget, Session};

/// The screen of a session at this size. Nothing is decided or computed here except what a visible cell shows.
pub fn picture(size: Size, session: &Session, look: &Look) -> Buffer {
    let mut buffer = Buffer::empty(Rect::from((Position::ORIGIN, size)));
    render(buffer.area, session, look, &mut buffer);
    buffer
}

/// Draws a session into a part of a screen.
pub fn render(area: Rect, session: &Session, look: &Look, buffer: &mut Buffer) {
    let screen = &mut Surface { look, buffer };
    match layout(area, session) {
        None => card(area, screen),
        Some(parts) => {
            panes(&parts, session, screen);
            caption::draw(parts.caption, session, screen);
            // What becomes of the motion stays in sight.
            let above = Rect { height: parts.status.y.saturating_sub(area.y) + 1, ..area };
            lists::draw(preview(area, session, screen).unwrap_or(above), session, screen);
            footer::draw(parts.footer, session, screen);
            help::draw(area, session, screen);
            explained(&parts, session, screen);
        }
    }
    match look.glyphs {
        Glyphs::Ascii => signs::only_letters(screen.buffer),
        // The fonts of terminals that have no more than blocks need not have one.
        Glyphs::Block => {}
        _ => {
            // What is being typed stands there as it will be read.
            let typing = matches!(session.overlay, Some(Overlay::Prompt(_)));
            signs::minus(area, screen.buffer, |y| typing && y + 1 == area.bottom());
        }
    }
}

fn panes(parts: &Layout, session: &Session, screen: &mut Surface) {
    status::title(parts.title, session, screen);
    status::sentence(parts.sentence, session, screen);
    let shown = parts.plots.iter().enumerate().filter(|(_, area)| !area.is_empty());
    let all: Vec<(usize, FramedPicture)> =
        shown.map(|(index, area)| (index, framed(*area, session, index))).collect();
    if session.display.lecture {
        lecture::numbers(parts.parameters, session, screen);
    } else {
        parameters::draw(parts.parameters, session, screen);
    }
    let entries = entries(all.iter().map(|(_, framed)| &framed.picture));
    legend::draw(parts.legend, entries, screen);
    for (index, framed) in all {
        plot(framed, session, index, screen);
    }
    playback::draw(parts.playback, session, screen);
    if session.display.lecture {
        lecture::outcome(parts.status, session, screen);
    } else {
        status::draw(parts.status, session, screen);
    }
}

/// Fewest columns of a list beside a scene.
const NARROWEST_LIST: u16 = 40;

/// Draws the scene that is selected in the list of scenes, as it would open; returns the area that is left for the list.
fn preview(area: Rect, session: &Session, screen: &mut Surface) -> Option<Rect> {
    let preview = session.preview.as_ref()?;
    let width = (area.width / 2).max(SMALLEST.0);
    if area.width < width + NARROWEST_LIST {
        return None;
    }
    let list = Rect { width: area.width - width, ..area };
    let beside = Rect { x: list.right(), width, ..area };
    let parts = layout(beside, preview)?;
    Clear.render(area, screen.buffer);
    panes(&parts, preview, screen);
    Some(list)
}

/// Explains what is asked about; the plot that draws it is drawn a second time, so that it stands out.
fn explained(parts: &Layout, session: &Session, screen: &mut Surface) {
    let Some(thing) = explain::pointed(parts, session, screen.buffer) else { return };
    if let Some((index, role)) = thing.drawn {
        let (area, look) = (parts.plots[index], screen.look.clone().pointing(role));
        Clear.render(area, screen.buffer);
        let screen = &mut Surface { look: &look, buffer: screen.buffer };
        plot(framed(area, session, index), session, index, screen);
    }
    explain::draw(parts, &thing, session, screen);
}

/// The picture of a plot in its place.
fn framed(area: Rect, session: &Session, index: usize) -> FramedPicture<'_> {
    let mut picture = picture::in_room(session, index, room(area));
    // The mass on its belt is drawn to its room.
    if session.plots[index].view != View::Belt {
        picture.window = shown(area, session, index, picture.scales);
    }
    if session.plots[index].view == View::EnergyLedger {
        energy_ledger::seat(area, &mut picture, &session.ledger());
    }
    FramedPicture { area, picture, heading: Heading::of(session, Pane::Plot(index)) }
}

fn plot(mut framed: FramedPicture, session: &Session, index: usize, screen: &mut Surface) {
    let FramedPicture { area, picture, heading } = &mut framed;
    let draws = match session.plots[index].view {
        View::EnergyLedger => !session.ledger().is_empty(),
        View::Scan => session.scanned.is_some(),
        _ => picture.draws(),
    };
    if let Some(text) = session.nothing(index).filter(|_| !draws) {
        screen.title(*area, &picture.title, "", heading);
        let text = screen.look.sentence(&text, &session.keymap);
        return nothing(*area, text, screen);
    }
    heading.reading.clone_from(&picture.reading);
    match (session.plots[index].view, &session.scanned) {
        // Its lines are whole rows of the screen.
        (View::EnergyLedger, _) => energy_ledger::draw(framed, &session.ledger(), screen),
        // Its shades fill cells, and its table is text.
        (View::Scan, Some(scanned)) => scan::draw(framed, scanned, screen),
        _ => paint(&framed, screen),
    }
}

/// What a plot says in place of empty axes.
fn nothing(area: Rect, text: String, screen: &mut Surface) {
    let line = vec![screen.look.span(text, Role::Text).into()];
    let body = pane::below(area, 1);
    let width = area.width.saturating_sub(2);
    let height = pane::rows(&line, width).min(body.height);
    let y = body.y + (body.height - height) / 2;
    screen.prose(Rect { x: area.x + 1, y, width, height }, line);
}

/// What a screen too small for everything else shows.
fn card(area: Rect, screen: &mut Surface) {
    let Rect { width, height, .. } = area;
    let (columns, rows) = SMALLEST;
    let text = format!("hopfscope needs {columns} x {rows}\nthis screen is {width} x {height}");
    let text = Paragraph::new(text).style(screen.look.style(Role::Text)).centered();
    let middle = pane::below(area, height.saturating_sub(2) / 2);
    text.wrap(Wrap { trim: true }).render(middle, screen.buffer);
}

/// Every plot of a session for itself, each as large as its screen.
pub fn panels(session: &Session, look: &Look) -> Vec<Buffer> {
    let area = Rect::new(0, 0, session.size.width, session.size.height);
    let panel = |index: usize| {
        let mut buffer = Buffer::empty(area);
        let screen = &mut Surface { look, buffer: &mut buffer };
        plot(framed(area, session, index), session, index, screen);
        buffer
    };
    (0..session.plots.len()).map(panel).collect()
}

/// What a cell of the screen stands for, if anything: a row of the parameter pane or a point of a plot.
pub fn place(screen: Rect, session: &Session, cell: Position) -> Option<PointerTarget> {
    let parts = layout(screen, session)?;
    if parts.parameters.contains(cell) && !session.display.lecture {
        // The first line is the title.
        let line = (cell.y - parts.parameters.y).checked_sub(1)?;
        let mut rows = parameters::shown(session, parts.parameters.height);
        return rows.nth(line.into()).map(PointerTarget::Row);
    }
    let index = parts.plots.iter().position(|area| area.contains(cell))?;
    let area = parts.plots[index];
    let FramedPicture { picture, .. } = framed(area, session, index);
    let area = if session.plots[index].view == View::Scan {
        scan::body(area)
    } else {
        area
    };
    let point = point_at(area, &picture, cell);
    point.map(|point| PointerTarget::Plot(index, point))
}
