//! A scan: a curve over one parameter, a map of shades over two, or the table of its rows.
//!
//! Rows appear as they are computed. The title says how far the scan is and what stands at the point
//! that is looked at; the last line says what the shades, or the numbers that stand for words, mean.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};

use super::dots::Dash;
use super::look::{Look, Role};
use super::number::{remaining, significant};
use super::pane::{self, Heading};
use super::picture::{self, Picture};
use super::plot::{Names, Plot};
use super::scan_table;
use crate::export::scan::rounded;
use crate::scene::{Point, View};
use crate::session::keymap::Keymap;
use crate::session::scan::{Progress, Scanned, WORDS};
use crate::session::settings::Glyphs;
use crate::session::{Pane, Session};

/// Digits of a value in the title and in the legend.
const DIGITS: usize = 4;

/// Draws the plot with this index.
pub fn draw(area: Rect, session: &Session, index: usize, look: &Look, buffer: &mut Buffer) {
    let mut heading = Heading::of(session, Pane::Plot(index));
    let Some(scanned) = &session.scanned else {
        return empty(area, &session.keymap, &heading, look, buffer);
    };
    let progress = progress(scanned);
    heading.reading = Some(reading(scanned)).filter(|reading| !reading.is_empty());
    let title = format!("{} {progress}", View::Scan.spec().title);
    if scanned.table {
        pane::title(area, &title, "", &heading, look, buffer);
        let body = Rect { y: area.y + 1, height: area.height.saturating_sub(1), ..area };
        return scan_table::draw(body, scanned, look, buffer);
    }
    let measured = scanned.scan.measured();
    let height = measured.get(scanned.column).copied().unwrap_or_default();
    let over = scanned.scan.over();
    let x = Scanned::axis(&over[0]);
    let y = over.get(1).map_or_else(|| height.to_owned(), Scanned::axis);
    let body = Rect { height: area.height.saturating_sub(1), ..area };
    let names = Names { title: &title, x: &x, y: &y, marks: None };
    let mut plot = Plot::new(body, session.plots[index].window, names, &heading, look, buffer);
    let legend = if scanned.is_grid() {
        map(&plot, scanned, height, look, buffer)
    } else {
        curve(&mut plot, scanned, height, look)
    };
    if let Some(point) = scanned.place(scanned.at) {
        plot.cross(point);
    }
    plot.finish(buffer);
    pane::line(area, area.height.saturating_sub(1), legend, "", buffer);
}

/// The curve over one parameter as data; a map of shades is for the screen, and its rows for files.
pub fn picture(session: &Session, index: usize) -> Picture<'_> {
    let title = View::Scan.spec().title;
    let window = session.plots[index].window;
    let Some(scanned) = &session.scanned else { return Picture::new(title, "", "", window) };
    let over = scanned.scan.over();
    let measured = scanned.scan.measured();
    let height = measured.get(scanned.column).copied().unwrap_or_default();
    let y = over.get(1).map_or_else(|| height.to_owned(), Scanned::axis);
    let mut picture = Picture::new(title, Scanned::axis(&over[0]), y, window);
    if !scanned.is_grid() {
        let line = picture::Line::new(height, Role::Trajectory, Dash::Solid);
        let nowhere = Point { x: f64::NAN, y: f64::NAN };
        let points = 0..scanned.rows.len();
        picture.curve(line, points.map(|index| scanned.place(index).unwrap_or(nowhere)));
    }
    picture
}

/// What stands where there is no scan.
fn empty(area: Rect, keymap: &Keymap, heading: &Heading, look: &Look, buffer: &mut Buffer) {
    pane::title(area, View::Scan.spec().title, "", heading, look, buffer);
    let key =
        keymap.key_of("scan-form").map(|key| super::keys::name(key, look)).unwrap_or_default();
    let text = format!(" no scan yet; {key} asks what to scan over and what to measure");
    pane::line(area, 2, Span::styled(text, look.style(Role::Quiet)), "", buffer);
}

/// How far a scan is: `120 of 400, 3 s left`.
#[must_use]
pub fn progress(scanned: &Scanned) -> String {
    let (rows, points) = (scanned.rows.len(), scanned.scan.points());
    let given_up = scanned.rows.iter().filter(|row| row.reason.is_some()).count();
    let given_up = if given_up > 0 { format!(", {given_up} given up") } else { String::new() };
    match scanned.progress {
        Progress::Done => format!("{points} points{given_up}"),
        Progress::Stopped => format!("{rows} of {points}, stopped{given_up}"),
        Progress::Running { from } if rows == from => format!("{rows} of {points}"),
        Progress::Running { from } => {
            let left = remaining(scanned.seconds, rows - from, points - from);
            format!("{rows} of {points}, {left} left{given_up}")
        }
    }
}

/// What stands at the point that is looked at.
fn reading(scanned: &Scanned) -> String {
    let Some(row) = scanned.rows.get(scanned.at) else { return String::new() };
    let place = scanned.scan.place(scanned.at);
    let values = scanned.scan.over().iter().zip(place).map(|(sweep, which)| {
        format!("{} {}", sweep.symbol, significant(sweep.value(which), DIGITS))
    });
    let measured = scanned.scan.measured();
    let name = measured.get(scanned.column).copied().unwrap_or_default();
    let value = row.values.get(scanned.column).map(|value| rounded(*value)).unwrap_or_default();
    let reason = row.reason.as_ref().map(|reason| format!("{name} - {reason}"));
    values.chain([reason.unwrap_or(format!("{name} {value}"))]).collect::<Vec<_>>().join(" ")
}

/// The measured number over one parameter; where there is none the curve has a gap.
fn curve(plot: &mut Plot, scanned: &Scanned, height: &str, look: &Look) -> Line<'static> {
    let point = |index| scanned.place(index).unwrap_or(Point { x: f64::NAN, y: f64::NAN });
    let role = Role::Trajectory;
    if scanned.plots_words() {
        for index in 0..scanned.rows.len() {
            plot.mark(point(index), look.symbols().points[0], role);
        }
        let meanings = WORDS.iter().enumerate().map(|(number, word)| format!("{number} {word}"));
        let text = format!(" {height}: {}", meanings.collect::<Vec<_>>().join(", "));
        return Line::styled(text, look.style(Role::Quiet));
    }
    plot.curve((0..scanned.rows.len()).map(point), role, Dash::Solid);
    // Points without neighbours make no curve.
    let known = |index: usize| scanned.height(index).is_some();
    for index in (0..scanned.rows.len()).filter(|index| known(*index)) {
        let joined = (index > 0 && known(index - 1)) || known(index + 1);
        if !joined {
            plot.mark(point(index), look.symbols().points[0], role);
        }
    }
    let range = scanned.range().map_or_else(String::new, |(low, high)| {
        format!(": {} .. {}", significant(low, DIGITS), significant(high, DIGITS))
    });
    Line::styled(format!(" {height}{range}"), look.style(Role::Quiet))
}

/// The shades of a map, from the smallest value to the largest.
type Ramp = Vec<(char, Role)>;

/// From one colour through light shades to another; without colour, letters of growing weight.
fn ramp(look: &Look) -> Ramp {
    let coloured = look.style(Role::Stable).fg.is_some() && look.glyphs != Glyphs::Ascii;
    if coloured {
        let low = "█▓▒░".chars().map(|shade| (shade, Role::Stable));
        low.chain("░▒▓█".chars().map(|shade| (shade, Role::Unstable))).collect()
    } else {
        ".:-=+*#%@".chars().map(|letter| (letter, Role::Text)).collect()
    }
}

/// The shades of words, in the order of [`WORDS`].
const SHADES: [(char, Role); 4] =
    [('.', Role::Stable), ('o', Role::Trajectory), ('^', Role::Unstable), ('?', Role::Warning)];

/// Where there is a row but no number.
const NOTHING: char = '-';

/// Fills each cell with the shade of the point nearest to it, and says what the shades mean.
fn map(
    plot: &Plot,
    scanned: &Scanned,
    height: &str,
    look: &Look,
    buffer: &mut Buffer,
) -> Line<'static> {
    let words = scanned.plots_words();
    let ramp = if words { SHADES.to_vec() } else { ramp(look) };
    let (low, high) = if words { (0.0, 3.0) } else { scanned.range().unwrap_or((0.0, 0.0)) };
    let shade = |value: f64| {
        let last = ramp.len() - 1;
        let part = if high > low { (value - low) / (high - low) } else { 0.5 };
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            clippy::cast_precision_loss,
            reason = "a part of a few shades"
        )]
        let step = if words { value as usize } else { (part * ramp.len() as f64) as usize };
        ramp[step.min(last)]
    };
    let over = scanned.scan.over();
    // Of more than two parameters the others stay at their first values.
    let stride: usize = over[2..].iter().map(|sweep| sweep.count).product();
    let inner = plot.inner();
    for column in 0..inner.width {
        for row in 0..inner.height {
            let Point { x, y } = plot.world(column, row);
            let (across, upward) = (nearest(&over[0], x), nearest(&over[1], y));
            let (Some(across), Some(upward)) = (across, upward) else { continue };
            let index = (across * over[1].count + upward) * stride;
            if index >= scanned.rows.len() {
                continue;
            }
            let (symbol, role) = scanned.height(index).map_or((NOTHING, Role::Quiet), shade);
            let cell = &mut buffer[(inner.x + column, inner.y + row)];
            cell.set_char(symbol).set_style(look.style(role));
        }
    }
    let quiet = look.style(Role::Quiet);
    let mut legend = vec![Span::styled(format!(" {height} "), quiet)];
    let mut push = |symbol: char, role: Role, text: String| {
        legend.push(Span::styled(symbol.to_string(), look.style(role)));
        legend.push(Span::styled(format!(" {text}  "), quiet));
    };
    if words {
        for ((symbol, role), word) in ramp.iter().zip(WORDS) {
            push(*symbol, *role, word.to_owned());
        }
    } else if scanned.range().is_some() {
        // The value at the lower end of every other shade, so that the line stays short.
        for (step, (symbol, role)) in ramp.iter().enumerate() {
            #[expect(clippy::cast_precision_loss, reason = "a few shades")]
            let from = low + (high - low) * step as f64 / ramp.len() as f64;
            let text = if step % 2 == 0 { significant(from, 3) } else { String::new() };
            push(*symbol, *role, text);
        }
        push(' ', Role::Quiet, format!(".. {}", significant(high, 3)));
    }
    push(NOTHING, Role::Quiet, "none".to_owned());
    Line::from(legend)
}

/// Which value of a sweep a place on its axis belongs to; none beyond half a step of its ends.
fn nearest(sweep: &crate::study::scan::Sweep, place: f64) -> Option<usize> {
    let last = sweep.count - 1;
    let [from, to] = [0, last].map(|index| Scanned::coordinate(sweep, index));
    #[expect(clippy::cast_precision_loss, reason = "at most a million")]
    let steps = (place - from) / (to - from) * last as f64;
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "within the sweep, as has just been seen"
    )]
    let index = (steps >= -0.5 && steps.is_finite()).then_some((steps + 0.5) as usize);
    index.filter(|index| *index <= last)
}
