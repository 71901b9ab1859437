//! Which pane stands where, for every size of the screen.
//!
//! Designed for 80 columns and 24 rows up. Where there is less, parts drop in this order: below 80
//! columns the plot without focus, below 20 rows the second status line, below 60 x 16 everything,
//! and a card says what is needed.

use ratatui::layout::Rect;

use crate::scene::Pane;
use crate::session::Session;

/// Smallest screen on which anything but a card is drawn.
pub const SMALLEST: (u16, u16) = (60, 16);

/// Smallest screen for which everything is designed.
const DESIGNED: (u16, u16) = (80, 20);

/// Columns of the parameter pane, by the columns of the screen: with names and values, with all
/// steps, with meanings.
const COLUMNS: [(u16, u16); 3] = [(150, 52), (110, 32), (0, 23)];

/// The parts of the screen; an empty area is not shown.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Layout {
    /// Scene.
    pub title: Rect,
    /// Parameter pane.
    pub parameters: Rect,
    /// Phase plane.
    pub phase: Rect,
    /// Bifurcation diagram.
    pub diagram: Rect,
    /// Status lines.
    pub status: Rect,
    /// Keys, notices and the entry line.
    pub footer: Rect,
}

/// Divides a screen among what the session has on show; `None` if it is too small.
#[must_use]
pub fn layout(screen: Rect, session: &Session) -> Option<Layout> {
    let Rect { width, height, .. } = screen;
    if width < SMALLEST.0 || height < SMALLEST.1 {
        return None;
    }
    let band = |y: u16, rows: u16| Rect { y: screen.y + y, height: rows, ..screen };
    let status = if height < DESIGNED.1 { 1 } else { 2 };
    let body = band(1, height - 2 - status);
    let column =
        COLUMNS.iter().find(|(least, _)| width >= *least).map_or(23, |(_, columns)| *columns);
    let rest = Rect { x: body.x + column + 1, width: width - column - 1, ..body };
    let both = width >= DESIGNED.0 && session.panes().len() == 3;
    let (phase, diagram) = match (both, session.plot) {
        (true, _) => halves(rest),
        (false, Pane::Diagram) => (Rect::default(), rest),
        (false, _) => (rest, Rect::default()),
    };
    Some(Layout {
        title: band(0, 1),
        parameters: Rect { width: column, ..body },
        phase,
        diagram,
        status: band(height - 1 - status, status),
        footer: band(height - 1, 1),
    })
}

/// The phase plane beside the diagram or above it, whichever leaves both nearer to squares.
fn halves(area: Rect) -> (Rect, Rect) {
    // A cell is about twice as high as wide.
    let beside = (area.width / 2).min(2 * area.height);
    let above = area.width.min(2 * (area.height / 2));
    if beside >= above {
        let width = phase_columns(area);
        let first = Rect { width, ..area };
        (first, Rect { x: area.x + width + 1, width: area.width - width - 1, ..area })
    } else {
        let height = area.height / 2;
        let first = Rect { height, ..area };
        (first, Rect { y: area.y + height, height: area.height - height, ..area })
    }
}

/// Columns of the phase plane beside the diagram: a square, so that circles look round, if that leaves
/// the diagram its share; never less than half.
fn phase_columns(area: Rect) -> u16 {
    /// Columns that the diagram needs to be legible.
    const LEGIBLE: u16 = 36;
    let half = area.width / 2;
    let square = 2 * area.height;
    let most = (area.width / 5 * 3).min(area.width.saturating_sub(LEGIBLE + 1));
    square.min(most).max(half)
}
