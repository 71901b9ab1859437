//! The parameter pane: what the model is, in numbers that the keys change, and what follows from them.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::Span;

use super::look::{Look, Role};
use super::number::{exact, significant};
use super::pane::{self, Heading};
use crate::oscillator::Symbol;
use crate::scene::Pane;
use crate::session::{Row, Session};
use crate::study::{Cycle, Edge};

/// Columns up to the end of the values.
const VALUES: usize = 16;

/// Columns of a step.
const STEP: usize = 6;

/// Draws the pane.
pub fn draw(area: Rect, session: &Session, look: &Look, buffer: &mut Buffer) {
    let heading = Heading::of(session, Pane::Parameters);
    pane::title(area, "parameters", "", &heading, look, buffer);
    let wide = usize::from(area.width) > VALUES + STEP;
    let mut y = 1;
    for row in session.rows() {
        let selected = row == session.selected;
        let step = (selected || wide).then(|| step(session, row, look)).flatten();
        let line = row_line(session, row, step, area.width, look);
        pane::line(area, y, line, "", buffer);
        y += 1;
    }
    if let Some(folded) = folded(session) {
        pane::line(
            area,
            y,
            Span::styled(format!(" {folded}"), look.style(Role::Quiet)),
            "",
            buffer,
        );
        y += 1;
    }
    let below = Rect {
        y: area.y + (y + 1).min(area.height),
        height: area.height.saturating_sub(y + 1),
        ..area
    };
    cycles(below, session, look, buffer);
}

fn row_line(
    session: &Session,
    row: Row,
    step: Option<String>,
    width: u16,
    look: &Look,
) -> Vec<Span<'static>> {
    let selected = row == session.selected;
    let pointer = if selected { look.symbols().pointer } else { " " };
    let role = if selected { Role::Selected } else { Role::Text };
    let name = row.name();
    let value = value(session, row, VALUES - name.len() - 2);
    let gap = VALUES.saturating_sub(name.len() + value.len() + 1);
    let mut line =
        vec![Span::styled(format!("{pointer}{name}{:gap$}{value}", ""), look.style(role))];
    let step = step.unwrap_or_default();
    let meaning = meaning(row);
    if usize::from(width) >= VALUES + STEP + 3 + meaning.len() {
        line.push(Span::styled(format!("{step:<STEP$}  {meaning}"), look.style(Role::Quiet)));
    } else {
        line.push(Span::styled(step, look.style(Role::Quiet)));
    }
    line
}

fn value(session: &Session, row: Row, width: usize) -> String {
    match row {
        Row::Parameter(symbol) => exact(session.value(symbol), width),
        Row::Until => exact(session.problem.until, width),
        Row::Method => session.problem.method.to_string(),
        Row::Tolerance => exact(session.problem.tolerance, width),
    }
}

fn step(session: &Session, row: Row, look: &Look) -> Option<String> {
    let step = session.steps.of(row)?;
    let sign = look.symbols().plus_minus;
    Some(format!(" {sign}{}", exact(step.value(), STEP - 1 - sign.chars().count())))
}

fn meaning(row: Row) -> &'static str {
    match row {
        Row::Parameter(symbol) => symbol.spec().meaning,
        Row::Until => "end time",
        Row::Method => "how half swings are integrated",
        Row::Tolerance => "relative error of a step",
    }
}

/// The terms that do not stand in the pane because the scene leaves them out.
fn folded(session: &Session) -> Option<String> {
    let shown = session.rows();
    let hidden: Vec<&str> = [Symbol::D, Symbol::D2, Symbol::D3, Symbol::R]
        .into_iter()
        .filter(|symbol| !shown.contains(&Row::Parameter(*symbol)))
        .map(|symbol| symbol.spec().name)
        .collect();
    (!hidden.is_empty()).then(|| format!("{} = 0", hidden.join(" = ")))
}

/// What the cycles are, in numbers, and what borders the basin.
fn cycles(area: Rect, session: &Session, look: &Look, buffer: &mut Buffer) {
    let Some(found) = session.cycles() else { return };
    let heading = Heading { mark: None, ..Heading::default() };
    pane::title(area, "cycles", "q_max  period", &heading, look, buffer);
    let mut y = 1;
    let [stable, unstable] = look.symbols().points;
    for Cycle { stable: is_stable, q_max, period, .. } in &found.cycles {
        let (symbol, role) =
            if *is_stable { (stable, Role::Stable) } else { (unstable, Role::Unstable) };
        let numbers = format!("{:>9}{:>8}", significant(*q_max, 5), significant(*period, 4));
        let line = vec![Span::styled(format!(" {symbol} "), look.style(role)), Span::raw(numbers)];
        pane::line(area, y, line, "", buffer);
        y += 1;
    }
    if found.cycles.is_empty() {
        pane::line(area, y, " none", "", buffer);
        y += 1;
    }
    let edge = match found.edge {
        Edge::None => "every motion is captured",
        Edge::Cycle => "edge: unstable cycle",
        Edge::Separatrix => "edge: separatrix",
    };
    pane::line(area, y, Span::styled(format!(" {edge}"), look.style(Role::Quiet)), "", buffer);
}
