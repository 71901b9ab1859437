//! From a cell of the screen to what stands there: for the mouse.

use ratatui::layout::{Position, Rect};

use super::plot::{point_at, shown};
use super::{energy_ledger, layout::layout, parameters, scan};
use crate::picture;
use crate::scene::View;
use crate::session::{PointerTarget, Session};

/// What a cell of the screen stands for, if anything: a row of the parameter pane or a point of a plot.
pub fn place(screen: Rect, session: &Session, cell: Position) -> Option<PointerTarget> {
    let parts = layout(screen, session)?;
    if parts.parameters.contains(cell) {
        // The first line is the title.
        let line = (cell.y - parts.parameters.y).checked_sub(1).map(usize::from);
        let first = parameters::first(session, parts.parameters.height);
        return line.map(|line| PointerTarget::Row(first + line));
    }
    let index = parts.plots.iter().position(|area| area.contains(cell))?;
    let area = parts.plots[index];
    let scales = picture::scales(session, index);
    let window = shown(area, session, index, scales);
    let point = match session.plots[index].view {
        View::EnergyLedger => {
            let (window, marks) = energy_ledger::marks(area, &session.ledger(), window);
            point_at(area, window, scales, Some(marks), cell)
        }
        View::Scan => point_at(scan::body(area), window, scales, None, cell),
        _ => point_at(area, window, scales, None, cell),
    };
    point.map(|point| PointerTarget::Plot(index, point))
}
