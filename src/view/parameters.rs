//! The parameter pane: what the model is, in numbers that the keys change, and what follows from them.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};
use ratatui::widgets::{Paragraph, Widget, Wrap};

use super::keys;
use super::legend;
use super::look::{Look, Role};
use super::number::{exact, significant};
use super::pane::{self, Heading};
use super::quantity::with_unit;
use crate::flow::Problem;
use crate::oscillator::Symbol;
use crate::oscillator::belt::Quantity;
use crate::scene::Layer;
use crate::session::{Pane, Row, Session, Stand};
use crate::study::belt::PhysicalMargin;
use crate::study::harmonic_error::Balanced;
use crate::study::{Cycle, Cycles, Edge};

/// Columns up to the end of the values.
const VALUES: usize = 16;

/// Columns of a step.
const STEP: usize = 7;

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
    let rows = cycles(below, session, look, buffer);
    if wide {
        let text = Rect { y: below.y + rows, height: below.height.saturating_sub(rows), ..below };
        guide(text, session, look, buffer);
    }
}

/// What to look at in this scene and what to press, and below it what the lines mean.
fn guide(area: Rect, session: &Session, look: &Look, buffer: &mut Buffer) {
    let inner = Rect { x: area.x + 1, width: area.width.saturating_sub(2), ..area };
    let style = look.style(Role::Quiet);
    let [seen, pressed] = [&session.scene.look, &session.scene.press]
        .map(|text| keys::sentence(text, &session.keymap, look));
    let rows = |text: &str| {
        text.chars().count().div_ceil(usize::from(inner.width).saturating_sub(6).max(1))
    };
    // Broken lines are a few letters shorter than the pane is wide; two headings, a blank, a gap.
    let taken = rows(&seen) + rows(&pressed) + 5;
    let lines = vec![
        Line::styled("look", look.style(Role::Title)),
        Line::styled(seen, style),
        Line::default(),
        Line::styled("press", look.style(Role::Title)),
        Line::styled(pressed, style),
    ];
    Paragraph::new(lines).wrap(Wrap { trim: true }).render(inner, buffer);
    let below = area.height.saturating_sub(u16::try_from(taken).unwrap_or(u16::MAX));
    let above_status = below.saturating_sub(1);
    legend::draw(
        Rect { y: area.bottom() - below, height: above_status, ..area },
        session,
        look,
        buffer,
    );
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
    let name = row.name_in(&session.problem);
    let room = VALUES - name.len() - 2;
    let (value, of_scene) = (value(&session.stand(), row, room), Stand::of_scene(&session.scene));
    let changed = value != self::value(&of_scene, row, room);
    // Numbers changed by hand are those of no belt speed: its row is out of use until it is set again.
    let off = row == Row::Belt && session.is_on_the_belt() == Some(false);
    let value = if off { format!("({value})") } else { value };
    let gap = VALUES.saturating_sub(name.len() + value.len() + 1);
    let style = look.style(role);
    let value_style = if off && !selected {
        look.style(Role::Quiet)
    } else if changed {
        style.patch(look.style(Role::Changed))
    } else {
        style
    };
    let mut line = vec![
        Span::styled(format!("{pointer}{name}{:gap$}", ""), style),
        Span::styled(value, value_style),
    ];
    let step = step.unwrap_or_default();
    let physical = physical(session, row);
    let meaning = match &physical {
        Some((name, value)) => format!("{name} {value}"),
        None => meaning(&session.problem, row).to_owned(),
    };
    if usize::from(width) >= VALUES + STEP + 3 + meaning.len() {
        line.push(Span::styled(format!("{step:<STEP$}  {meaning}"), look.style(Role::Quiet)));
    } else {
        // On a narrow pane what the number means on the machine takes what the step leaves.
        let room = usize::from(width).saturating_sub(VALUES + step.chars().count() + 2);
        let physical = physical.map(|(_, value)| value).filter(|value| value.len() <= room);
        let physical = physical.map_or_else(String::new, |value| format!("  {value}"));
        line.push(Span::styled(step + &physical, look.style(Role::Quiet)));
    }
    line
}

/// What a row means on the machine: the quantity and its value.
fn physical(session: &Session, row: Row) -> Option<(&'static str, String)> {
    let running = session.running()?;
    let (name, value, unit) = match row {
        Row::Belt if session.is_on_the_belt() == Some(false) => {
            return Some(("v0", "off the belt".to_owned()));
        }
        Row::Belt => ("v0", running.speed, "m/s"),
        Row::Parameter(symbol) => running.meaning(symbol, session.value(symbol))?,
        Row::Until => ("t", session.problem.until * running.reduced.units.time, "s"),
        Row::Method | Row::Tolerance => return None,
    };
    Some((name, with_unit(value, 4, unit)))
}

fn value(stand: &Stand, row: Row, width: usize) -> String {
    let Stand { problem, belt_speed } = stand;
    match row {
        Row::Belt => belt_speed.map_or_else(String::new, |speed| exact(speed, width)),
        Row::Parameter(symbol) => exact(symbol.get(&problem.parameters, &problem.initial), width),
        Row::Until => exact(problem.until, width),
        Row::Method => problem.method.to_string(),
        Row::Tolerance => exact(problem.setting(), width),
    }
}

/// The step of a row; of the dial the name of its stop.
fn step(session: &Session, row: Row, look: &Look) -> Option<String> {
    if row == Row::Tolerance {
        return session.problem.quality().map(|quality| format!(" {}", quality.name));
    }
    let step = session.steps.of(row)?;
    let sign = look.symbols().plus_minus;
    Some(format!(" {sign}{}", exact(step.value(), STEP - 1 - sign.chars().count())))
}

fn meaning(problem: &Problem, row: Row) -> &'static str {
    match row {
        Row::Belt => Quantity::BeltSpeed.spec().meaning,
        Row::Parameter(symbol) => symbol.spec().meaning,
        Row::Until => "end time",
        Row::Method => "integrator of half swings",
        Row::Tolerance => problem.method.spec().dial.meaning(),
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

/// A column of the table of cycles: heading, width, and what stands in it.
type Column = (&'static str, usize, fn(&Cycle) -> String);

/// The columns, of which as many are shown as fit.
const CYCLE_COLUMNS: [Column; 5] = [
    ("q_max", 10, |cycle| significant(cycle.q_max, 5)),
    ("period", 8, |cycle| significant(cycle.period, 4)),
    ("v_max", 9, |cycle| significant(cycle.v_max, 5)),
    ("multiplier", 12, |cycle| match cycle.multiplier {
        Some(multiplier) => significant(multiplier, 4),
        None => format!("e^{}", significant(cycle.log_multiplier, 4)),
    }),
    ("error", 8, |cycle| significant(cycle.error, 1)),
];

/// What the cycles are, in numbers, and what borders the basin; returns the rows that it took.
fn cycles(area: Rect, session: &Session, look: &Look, buffer: &mut Buffer) -> u16 {
    /// Columns of the symbol before the numbers.
    const SYMBOL: usize = 3;
    let Some(found) = session.cycles() else { return 0 };
    let mut used = SYMBOL;
    let fits = |(_, width, _): &&Column| {
        used += width;
        used <= usize::from(area.width)
    };
    let columns: Vec<&Column> = CYCLE_COLUMNS.iter().take_while(fits).collect();
    let cells = |text: &dyn Fn(&Column) -> String| -> String {
        columns
            .iter()
            .fold(String::new(), |line, column| format!("{line}{:>1$}", text(column), column.1))
    };
    let title = " cycles";
    let headings = cells(&|(heading, ..)| (*heading).to_owned());
    let headings = headings.split_at(title.len() - SYMBOL).1.to_owned();
    let heading = vec![
        Span::styled(title, look.style(Role::Title)),
        Span::styled(headings, look.style(Role::Quiet)),
    ];
    pane::line(area, 0, heading, "", buffer);
    let mut y = 1;
    let [stable, unstable] = look.symbols().points;
    for cycle in &found.cycles {
        let (symbol, role) =
            if cycle.stable { (stable, Role::Stable) } else { (unstable, Role::Unstable) };
        let numbers = cells(&|(.., number)| number(cycle));
        let line = vec![Span::styled(format!(" {symbol} "), look.style(role)), Span::raw(numbers)];
        pane::line(area, y, line, "", buffer);
        y += 1;
    }
    if found.cycles.is_empty() {
        pane::line(area, y, " none", "", buffer);
        y += 1;
    }
    let words = basin(session, found, usize::from(area.width))
        .into_iter()
        .chain(balance(session, usize::from(area.width)));
    for text in words {
        pane::line(area, y, Span::styled(format!(" {text}"), look.style(Role::Quiet)), "", buffer);
        y += 1;
    }
    y + 1
}

/// What borders the basin of the sticking set, and which kicks it survives.
fn basin(session: &Session, found: &Cycles, width: usize) -> Vec<String> {
    let edge = match found.edge {
        Edge::None if found.parameters.r == 0.0 => "no sticking set",
        Edge::None => "all motions captured",
        Edge::Cycle => "edge: unstable cycle",
        Edge::Separatrix => "edge: separatrix",
    };
    // Without friction there is no set of rests that could survive anything.
    let rests = found.picture.as_ref().filter(|_| found.parameters.r > 0.0);
    let kicks = rests.map(|picture| picture.margin).and_then(|margin| {
        let (q, v) = (margin.displacement?, margin.impulse?);
        let text =
            |digits| format!("kick q {} v {}", significant(q, digits), significant(v, digits));
        // Rather fewer digits than a number cut short.
        (1..=5).rev().map(text).find(|text| text.len() < width)
    });
    let physical = on_the_machine(session, found);
    std::iter::once(edge.to_owned()).chain(kicks).chain(physical).chain(sizes(found)).collect()
}

/// The margin on the machine, and which cycles overtake its belt.
fn on_the_machine(session: &Session, found: &Cycles) -> Vec<String> {
    let Some(running) = session.running() else { return Vec::new() };
    let margin = found.picture.as_ref().map(|picture| picture.margin);
    let margin = margin.map(|margin| PhysicalMargin::new(&margin, &running.reduced.units));
    let kick = margin.and_then(|margin| {
        let (x, impulse) = (margin.displacement?, margin.impulse?);
        Some(format!("= {}, {}", with_unit(x, 3, "m"), with_unit(impulse, 3, "N s")))
    });
    let fast = |cycle: &&Cycle| cycle.v_max >= running.reduced.sticking_velocity;
    let alarms = found.cycles.iter().filter(fast).map(|cycle| {
        format!("! {} > belt", if cycle.stable { "stable cycle" } else { "unstable cycle" })
    });
    kick.into_iter().chain(alarms).collect()
}

/// What the cycles of N harmonics are worth: the errors of amplitude and frequency of each.
fn balance(session: &Session, width: usize) -> Vec<String> {
    let Some(found) = session.balance().filter(|_| session.shows(Layer::Balance)) else {
        return Vec::new();
    };
    let lead = format!("N = {}: ", found.harmonics);
    let percent = |error: f64| significant(100.0 * error, 2);
    let line = |balanced: &Balanced| match (&balanced.cycle, &balanced.error) {
        (Err(_), _) => format!("{lead}no such cycle"),
        (Ok(_), None) if found.unknown.is_some() => format!("{lead}error unknown"),
        (Ok(_), None) => format!("{lead}no true cycle"),
        (Ok(_), Some(error)) => {
            let amplitude = format!("{lead}q {} %", percent(error.amplitude));
            let both = format!("{amplitude}, rate {} %", percent(error.frequency));
            if both.len() < width { both } else { amplitude }
        }
    };
    match &found.balanced[..] {
        [] => vec![format!("{lead}no cycle")],
        balanced => balanced.iter().map(line).collect(),
    }
}

/// How large the basin is, and how much of its margin the Lyapunov circle (24) proves: that knows the
/// linear damping only, and where D2 or D3 feed the motion it can promise more than holds.
fn sizes(found: &Cycles) -> impl Iterator<Item = String> {
    let picture = found.picture.as_ref().filter(|_| found.parameters.r > 0.0);
    let area = picture.and_then(|picture| picture.area);
    let share = picture.and_then(|picture| picture.lyapunov_share).map(|share| {
        if share > 1.0 {
            "Lyapunov: not valid".to_owned()
        } else {
            format!("Lyapunov: {} % of it", significant(100.0 * share, 2))
        }
    });
    // The share is one of the kick: it stands below it.
    share.into_iter().chain(area.map(|area| format!("area {}", significant(area, 5))))
}
