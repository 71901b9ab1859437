//! The parameter pane: what the model is, in numbers that the keys change, and what follows from them.

use std::ops::Range;

use ratatui::layout::Rect;
use ratatui::text::{Line, Span};

use super::fitted::{fitted, spread};
use super::pane::{self, Heading};
use super::{Look, Surface, compare, gauge, margin, number_line, verdict::multiplier};
use crate::accuracy::BalanceResult;
use crate::flow::Problem;
use crate::model::{Knob, Units};
use crate::picture::{Role, cycle_mark, cycle_name, cycle_role, units};
use crate::portrait::{Border, Cycle, Drawing, compare};
use crate::scene::Layer;
use crate::session::{Pane, Row, Session, Setup};
use crate::words::{
    Notation, cycles as cycles_in_words, exact, fitting, joined, significant, with_unit,
};

/// Columns up to the end of the values.
const VALUES: usize = 17;

/// Columns of a step where they stand below each other.
const STEP: usize = 10;

/// Digits of a number that follows from others, on a machine or from a record.
const FOLLOWING: usize = 5;

/// Columns from which on what numbers mean stands beside their steps.
const WITH_MEANINGS: u16 = 50;

pub fn draw(area: Rect, session: &Session, screen: &mut Surface) {
    let look = screen.look;
    let heading = Heading::of(session, Pane::Parameters);
    let (rows, shown) = (session.rows(), shown(session, area.height));
    let letter = session.letter().map(str::to_owned);
    let number = session.number(0).map(|number| format!("motion {number}"));
    let of = match &joined(letter.into_iter().chain(number), ", ")[..] {
        "" if shown.len() < rows.len() => format!("+{} more", rows.len() - shown.len()),
        "" => String::new(),
        whose => format!("of {whose}"),
    };
    screen.title(area, "parameters", &of, &heading);
    let rows = rows[shown].iter().copied();
    let mut lines: Vec<Line> = rows.map(|row| row_line(session, row, area.width, look)).collect();
    lines.extend(folded(session).map(|folded| look.span(format!(" {folded}"), Role::Quiet).into()));
    let below = cycles(session, area.width.into(), look);
    // The numbers of a machine leave little room.
    let apart = session.running().is_none() || lines.len() + below.len() < area.height.into();
    let number_line = number_line::line(session, area.width.into(), look).unwrap_or_default();
    lines.extend(apart.then_some(number_line));
    lines.extend(below);
    let taken = pane::cells(lines.len());
    let body = pane::below(area, 1);
    screen.lines(body, lines);
    if is_wide(area.width) {
        guide(pane::below(body, taken), session, screen);
    }
}

/// Whether steps stand beside all values, and texts below.
fn is_wide(width: u16) -> bool {
    usize::from(width) >= VALUES + STEP
}

/// The rows on show, the selected one among them: a machine can have more rows than fit above the cycles.
pub fn shown(session: &Session, height: u16) -> Range<usize> {
    /// Lines of the heading and of two cycles below, unless fewer than `FEW` rows were left.
    const BELOW: usize = 4;
    const FEW: usize = 10;
    let rows = session.rows();
    let most = usize::from(height).saturating_sub(BELOW).max(FEW);
    let selected = rows.iter().position(|row| *row == session.selected).unwrap_or(0);
    let first = (selected + 1).saturating_sub(most);
    first..rows.len().min(first + most)
}

/// What to look at in this scene and what to press. Where there is no room for a text, the key that shows both stands in
/// its place.
fn guide(area: Rect, session: &Session, screen: &mut Surface) {
    // A first screen begins with both; while a question is open, they would tell its answer.
    if session.scene.next.is_some() || session.is_asked() {
        return;
    }
    let look = screen.look;
    let quiet = |text: &str| look.span(text.to_owned(), Role::Quiet);
    let sentence = |text: &str| look.sentence(text, &session.keymap);
    let section = |heading: &'static str, remark: &str, text: &str| {
        let title = vec![look.span(heading, Role::Title), quiet(&sentence(remark))];
        [Line::from(title), Line::from(quiet(&sentence(&session.said(text))))]
    };
    // The text starts from the values with which the scene opens.
    let moved = session.setup() != Setup::of_scene(&session.scene);
    let remark = if moved {
        "  as opened; {reset-scene} goes back"
    } else {
        ""
    };
    let watch = section("look", "", &session.scene.watch);
    let press = section("press", remark, &session.scene.press);
    let [short, _] = section("press", "  {explain} says what", "");
    let apart = [&watch[..], &[Line::default()], &press].concat();
    let together = [&watch[..], &press].concat();
    let inner = Rect { x: area.x + 1, width: area.width.saturating_sub(2), ..area };
    let full = [apart, together].into_iter();
    let mut full = full.filter(|lines| pane::rows(lines, inner.width) <= area.height);
    let lines = full.next().unwrap_or_else(|| {
        let rows = pane::rows(&watch, inner.width) + 1;
        let blank = (rows < area.height).then(Line::default);
        let watch = watch.into_iter().filter(|_| rows <= area.height);
        watch.chain(blank).chain([short]).collect()
    });
    screen.prose(inner, lines);
}

fn row_line(session: &Session, row: Row, width: u16, look: &Look) -> Line<'static> {
    let selected = row == session.selected;
    let pointer = if selected { &look.symbols().pointer } else { " " };
    let role = if selected { Role::Selected } else { Role::Text };
    let name = row.name_in(&session.problem);
    let tail = tail(session, row, width, look);
    // Two blanks before the value and, where there is room, two behind it.
    let end = VALUES.min(usize::from(width).saturating_sub(tail.chars().count()));
    let room = end.saturating_sub(3 + name.len());
    let text = |setup: &Setup| value(session, setup, row, room, look);
    let (value, of_scene) = (text(&session.setup()), text(&Setup::of_scene(&session.scene)));
    let changed = value != of_scene;
    // Numbers changed by hand are those of no belt speed: its row is out of use until it is set again.
    let off = row.is_of_machine() && session.is_on_the_belt() == Some(false);
    let value = if off { format!("({value})") } else { value };
    let unit_alone = row.is_of_machine() && !selected && !is_wide(width);
    let gap = end.saturating_sub(name.len() + value.chars().count() + 1).max(1);
    let style = look.style(role);
    let value_style = if off && !selected {
        look.style(Role::Quiet)
    } else if changed {
        style.patch(look.style(Role::Changed))
    } else {
        style
    };
    Line::from(vec![
        Span::styled(format!("{pointer}{name}{:gap$}", ""), style),
        Span::styled(value, value_style),
        look.span(tail, if unit_alone { Role::Text } else { Role::Quiet }),
    ])
}

/// What stands behind a value: its step, and what the number means.
fn tail(session: &Session, row: Row, width: u16, look: &Look) -> String {
    let room = usize::from(width).saturating_sub(VALUES);
    let value = |of: &Session, width| value(of, &of.setup(), row, width, look);
    if let Some(text) = compare::row(session, row, room, value) {
        return text;
    }
    let selected = row == session.selected;
    let step = step(session, row).filter(|_| selected || is_wide(width));
    // On a narrow pane the error of a fitted number matters more than its step.
    let recorded = session.scene.recording.is_some() && width < WITH_MEANINGS;
    let step = step.filter(|_| !recorded).unwrap_or_default();
    let room = usize::from(width).saturating_sub(VALUES);
    let fits = |text: &String| text.chars().count() + 2 <= room;
    // Of a fitted number its error says more than what the step is.
    let physical = physical(session, row).or_else(|| {
        let told = pane::fitting(fitted(session, row, look), room - 2);
        Some(told).filter(|told| !told.is_empty())
    });
    if width >= WITH_MEANINGS {
        let meaning = meaning(&session.problem, row).to_owned();
        let on_the_belt = row.is_of_machine() && session.is_on_the_belt() == Some(true);
        let texts = match physical {
            Some(unit) if on_the_belt => vec![format!("{unit}, {meaning}"), unit],
            None if on_the_belt => vec![meaning, String::new()],
            physical => vec![physical.unwrap_or(meaning)],
        };
        return format!("  {step:<STEP$}  {}", pane::fitting(texts, room - STEP - 4));
    }
    // On a narrow pane what the number means on the machine stands in place of the step, of which the
    // selected row alone needs to speak; the unit of a number of the machine stands right behind it.
    let text = match physical {
        Some(unit) if row.is_of_machine() && selected => Some(format!("{step} {unit}")),
        Some(unit) if row.is_of_machine() && fits(&unit) => return format!(" {unit}"),
        physical => physical.filter(|_| !selected || recorded),
    };
    let text = text.filter(fits).unwrap_or(step);
    // Where there is no room behind the values, the selected one moves to the left.
    let blanks = if fits(&text) { 2 } else { 1 };
    if text.is_empty() {
        text
    } else {
        format!("{:blanks$}{text}", "")
    }
}

/// What a row means on the machine: the quantity and its value.
fn physical(session: &Session, row: Row) -> Option<String> {
    let on_the_belt = session.is_on_the_belt();
    let (name, value, unit) = match (row, session.units(), session.running()) {
        (Row::Number(Knob::Disturbance), Some(units), _) if units.force.is_finite() => {
            ("w", session.doubt.disturbance * units.force, "N")
        }
        (Row::Number(Knob::Until), Some(units), _) => {
            ("t", session.problem.until * units.time, "s")
        }
        (Row::BELT, ..) if on_the_belt == Some(false) => {
            return Some("off the belt".to_owned());
        }
        (Row::Number(knob), ..) if row.is_of_machine() => {
            return Some(knob.spec().unit.to_owned()).filter(|unit| !unit.is_empty());
        }
        // On the belt R has a row of its own.
        (Row::Number(knob), _, Some(running)) if knob != Knob::R || on_the_belt == Some(false) => {
            let (knob, value) = running.meaning(knob, session.value(knob))?;
            (knob.spec().name, value, knob.spec().unit)
        }
        _ => return None,
    };
    // A pure number stands in its row as it is.
    (!unit.is_empty()).then(|| format!("{name} {}", with_unit(value, 4, unit)))
}

pub fn value(session: &Session, setup: &Setup, row: Row, width: usize, look: &Look) -> String {
    let (Setup { problem, doubt, .. }, sign) = (setup, &look.symbols().plus_minus);
    match row {
        Row::Number(knob) if row.is_of_machine() => exact(session.value_in(setup, knob), width),
        Row::Number(knob) => {
            let (value, half) = (session.value_in(setup, knob), doubt.half_width(knob));
            if half == 0.0 {
                return number(session, value, width);
            }
            let half =
                format!(" {sign}{}", number(session, half, width.div_ceil(2).saturating_sub(1)));
            number(session, value, width.saturating_sub(half.chars().count())) + &half
        }
        Row::Method => problem.method.to_string(),
        Row::Tolerance => exact(problem.setting(), width),
    }
}

/// The step of a row; of the dial the name of its stop.
fn step(session: &Session, row: Row) -> Option<String> {
    if row == Row::Tolerance {
        return session.problem.quality().map(|quality| quality.name.to_owned());
    }
    Some(format!("step {}", exact(session.steps.of(row.stepped()?).value(), STEP - "step ".len())))
}

/// A number in this many columns, exact if that is possible. Where numbers have units, one that is not was
/// computed from typed ones, and a few digits say as much.
fn number(session: &Session, value: f64, width: usize) -> String {
    let text = exact(value, width);
    if session.units().is_none() || text.parse() == Ok(value) {
        return text;
    }
    fitting(value, FOLLOWING, width).unwrap_or(text)
}

fn meaning(problem: &Problem, row: Row) -> &'static str {
    match row {
        Row::Method => "integrator of half swings",
        row => row.knob_in(problem).spec().meaning,
    }
}

/// The terms that do not stand in the pane because the scene leaves them out.
fn folded(session: &Session) -> Option<String> {
    let shown = session.rows();
    let hidden: Vec<&str> = Knob::PARAMETERS
        .into_iter()
        .filter(|symbol| !shown.contains(&Row::Number(*symbol)))
        .map(|symbol| symbol.spec().name)
        .collect();
    (!hidden.is_empty()).then(|| format!("{} = 0", hidden.join(" = ")))
}

/// Headings and widths of the table of cycles: in numbers of the oscillator, and in the units of a machine.
const COLUMNS: [[(&str, usize); 5]; 2] = [
    [("q_max", 10), ("period", 8), ("v_max", 9), ("multiplier", 12), ("error", 8)],
    [("x_max", 11), ("period", 9), ("v_max", 11), ("multiplier", 12), ("error", 8)],
];

/// A cycle in the cells of the table.
fn cells(cycle: &Cycle, units: Option<Units>) -> [String; 5] {
    let Cycle { q_max, period, v_max, .. } = *cycle;
    let (notation, digits) = (Notation(units), if units.is_some() { 4 } else { 5 });
    let (size, speed) = (notation.length(q_max, digits), notation.velocity(v_max, digits));
    let error = cycle.error.map_or_else(String::new, |error| significant(error, 1));
    [size, notation.time(period, 4), speed, multiplier(cycle), error]
}

/// What the cycles are, in numbers in as many columns as fit, what borders the basin, and a blank line; nothing
/// until they are known.
fn cycles(session: &Session, width: usize, look: &Look) -> Vec<Line<'static>> {
    /// Columns of the symbol before the numbers.
    const SYMBOL: usize = 3;
    // They would tell the answer of a question.
    let Some(found) = session.cycles().filter(|_| !session.is_asked()) else { return Vec::new() };
    let units = units::shown(session);
    let mut used = SYMBOL;
    let fits = |(_, columns): &&(&str, usize)| {
        used += columns;
        used <= width
    };
    let columns: Vec<_> =
        COLUMNS[usize::from(units.is_some())].iter().take_while(fits).copied().collect();
    let aligned = |cells: [String; 5]| {
        let cells = cells.into_iter().zip(&columns);
        let cells = cells.map(|(cell, (_, width))| format!("{cell:>width$}"));
        cells.collect::<String>()
    };
    let title = " cycles";
    let headings = columns.iter().map(|(name, width)| format!("{name:>width$}"));
    let headings = headings.collect::<String>().split_off(title.len() - SYMBOL);
    let mut lines: Vec<Vec<Span>> =
        vec![vec![look.span(title, Role::Title), look.span(headings, Role::Quiet)]];
    lines.extend(found.cycles.iter().map(|cycle| {
        let mark = look.symbols().mark(cycle_mark(cycle.stable));
        let symbol = look.span(format!(" {mark} "), cycle_role(cycle.stable));
        vec![symbol, Span::raw(aligned(cells(cycle, units)))]
    }));
    let room = width.saturating_sub(1);
    let words = basin(session, found, room, look).into_iter().chain(balance(session, room));
    let words = words.map(|text| (text, Role::Quiet));
    let below = std::iter::once(counted(session, found, room)).chain(words);
    lines.extend(below.map(|(text, role)| vec![look.span(format!(" {text}"), role)]));
    // While a kick is tried, its gauge stands in the status line.
    let gauge = gauge::gauge(session, width, look).filter(|_| !session.kicking);
    lines.extend(gauge);
    lines.push(Vec::new());
    lines.into_iter().map(Line::from).collect()
}

/// How many cycles there are, and whether that is proved.
fn counted(session: &Session, found: &Drawing, width: usize) -> (String, Role) {
    if let Some(both) = compare::counts(session) {
        return (both, Role::Text);
    }
    let count = cycles_in_words(found.cycles.len());
    let Some(proof) = session.proof().filter(|_| found.parameters == session.problem.parameters)
    else {
        return (count, Role::Quiet);
    };
    match compare(&found.cycles, proof) {
        Err(_) => (format!("{count}, proof differs"), Role::Failure),
        Ok(()) if proof.is_complete() => {
            let texts = [format!("{count}, proved"), format!("{}, proved", found.cycles.len())];
            (pane::fitting(texts, width), Role::Text)
        }
        Ok(()) => (format!("{count}, others open"), Role::Quiet),
    }
}

/// What borders the basin of the sticking set, and which kicks it survives.
fn basin(session: &Session, found: &Drawing, width: usize, look: &Look) -> Vec<String> {
    let whole = session.draws_whole();
    let border = match found.portrait.border {
        Border::NoBasin => "rest repels",
        Border::Grazing => "border: touches the belt",
        Border::Capture => "border: where the guide holds",
        Border::None | Border::Unknown(_) if whole && found.portrait.neutral => {
            "all motions periodic"
        }
        Border::None | Border::Unknown(_) if whole => "all motions come to rest",
        Border::None if found.parameters.r == 0.0 => "no sticking set",
        Border::None | Border::Unknown(_) => "all motions captured",
        Border::Cycle => "border: unstable cycle",
        Border::Separatrix => "border: separatrix",
    };
    // Without friction there is no set of rests that could survive anything.
    let rests = Some(found).filter(|_| found.parameters.r > 0.0);
    let kicks = rests
        .and_then(|found| margin::in_pane(session, ("from rest", &found.margin), [None; 2], width));
    // Where there is a second status line, it says what kicks are survived.
    let low = !session.size.tells_margin();
    let mut lines = vec![border.to_owned()];
    // In the units of a machine they stand below.
    let physical = units::shown(session).is_some();
    // Of a record the distribution of the margin is told.
    lines.extend(kicks.filter(|_| low && session.fitted().is_none()));
    lines.extend(spread(session, width, look));
    lines.extend(on_the_machine(session, found, width));
    lines.extend(margin::brief_guaranteed(session, width));
    let share = rests.and_then(|found| found.lyapunov_share).map(margin::share);
    let above = |share: &String| margin::status(session).is_some_and(|it| it.contains(share));
    lines.extend(share.filter(|it| low || (session.shows(Layer::Lyapunov) && !above(it))));
    let area = rests.and_then(|found| found.area).filter(|_| !physical);
    lines.extend(area.map(|area| format!("area {}", significant(area, 5))));
    lines
}

/// The frequency of the machine, and which cycles overtake its belt.
fn on_the_machine(session: &Session, found: &Drawing, width: usize) -> Vec<String> {
    let Some(running) = session.running() else { return Vec::new() };
    // The whole model covers what happens there.
    let sticking = running.reduced.sticking_velocity;
    let fast = |cycle: &&Cycle| !session.draws_whole() && cycle.v_max >= sticking;
    let alarms = found.cycles.iter().filter(fast);
    let alarms = alarms.map(|cycle| format!("! {} > belt", cycle_name(cycle.stable)));
    let units = &running.reduced.units;
    let d = significant(session.value(Knob::D), 3);
    let hertz = with_unit(units.omega_0 / std::f64::consts::TAU, 3, "Hz");
    let natural = [format!("f0 {hertz}, damping ratio {d}"), format!("f0 {hertz}")];
    std::iter::once(pane::fitting(natural, width)).chain(alarms).collect()
}

/// The errors of amplitude and frequency of the cycles of N harmonics.
fn balance(session: &Session, width: usize) -> Vec<String> {
    let Some(found) = session.balance().filter(|_| session.shows(Layer::Balance)) else {
        return Vec::new();
    };
    let lead = format!("N = {}: ", found.harmonics);
    let percent = |error: f64| significant(100.0 * error, 2);
    let line = |balanced: &BalanceResult| match (&balanced.cycle, &balanced.error) {
        (Err(_), _) => format!("{lead}no such cycle"),
        (Ok(_), None) if found.unknown.is_some() => format!("{lead}error unknown"),
        (Ok(_), None) => format!("{lead}no true cycle"),
        (Ok(_), Some(error)) => {
            let amplitude = format!("{lead}q {} %", percent(error.amplitude));
            let both = format!("{amplitude}, rate {} %", percent(error.frequency));
            pane::fitting([both, amplitude], width)
        }
    };
    match &found.balanced[..] {
        [] => vec![format!("{lead}no cycle")],
        balanced => balanced.iter().map(line).collect(),
    }
}
