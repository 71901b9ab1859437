//! A scan: a curve over one parameter, a map of shades over two, or the table of its rows.
//!
//! Rows appear as they are computed. The title says how far the scan is. Of the three lines below the plot the
//! first says the values at the selected point, the second what the shades, or the numbers that
//! stand for words, mean, and the third what it means that there is no number.

use ratatui::layout::Rect;

use super::pane::{self, FramedPicture};
use super::{Surface, paint::paint, scan_map};
use crate::picture::map::{measured, nothing};
use crate::picture::{Danger, Role};
use crate::scan::Value;
use crate::scene::View;
use crate::session::{ScanOnShow, ScanProgress, WORDS};
use crate::words::{joined, measurement, remaining, significant};

/// Digits of a value, as many as fit; the first are those of a table.
const DIGITS: [usize; 5] = [8, 6, 5, 4, 3];

/// Lines below the plot.
const BELOW: u16 = 3;

/// The part of a pane that the plot itself takes.
pub fn body(area: Rect) -> Rect {
    Rect { height: area.height.saturating_sub(BELOW), ..area }
}

pub fn draw(mut framed: FramedPicture, scanned: &ScanOnShow, screen: &mut Surface) {
    let look = screen.look;
    let (area, name) = (framed.area, View::Scan.spec().title);
    let title = format!("{name} {}", progress(scanned));
    if scanned.table {
        screen.title(area, &title, "", &framed.heading);
        return table(pane::below(area, 1), scanned, screen);
    }
    let width = usize::from(area.width);
    // The names of the axes stand there in any case; how far the scan is, where there is room.
    let axes = framed.picture.y.len() + framed.picture.x.len();
    let full = title.chars().count() + axes + 9 <= width;
    framed.picture.title = if full { title.into() } else { name.into() };
    framed.area = body(area);
    paint(&framed, screen);
    let legend = match framed.picture.map {
        Some(_) => scan_map::legend(scanned, width, look),
        None => look.span(meaning(scanned, width), Role::Quiet).into(),
    };
    let running = matches!(scanned.progress, ScanProgress::Running { .. });
    let reading = if running && !full {
        format!(" {}", progress(scanned))
    } else {
        reading(scanned, width)
    };
    let reading = look.span(reading, Role::Cursor);
    let without = look.span(scan_map::without_numbers(scanned, width), Role::Quiet);
    let below = pane::below(area, area.height.saturating_sub(BELOW));
    screen.lines(below, [reading.into(), legend, without.into()]);
}

/// How far a scan is: `120 of 400, 3 s left`.
pub fn progress(scanned: &ScanOnShow) -> String {
    let (rows, points) = (scanned.rows.len(), scanned.scan.points());
    let given_up = scanned.rows.iter().filter(|row| row.reason.is_some()).count();
    let given_up = if given_up > 0 {
        format!(" ({given_up} given up)")
    } else {
        String::new()
    };
    match scanned.progress {
        ScanProgress::Done => format!("{points} points{given_up}"),
        ScanProgress::Stopped => format!("{rows} of {points}: stopped{given_up}"),
        ScanProgress::Running { from } if rows == from => format!("{rows} of {points}"),
        ScanProgress::Running { from } => {
            let left = remaining(scanned.seconds, rows - from, points - from);
            format!("{rows} of {points}: {left} left{given_up}")
        }
    }
}

/// What stands at the point that is looked at, to as many digits as fit.
fn reading(scanned: &ScanOnShow, width: usize) -> String {
    let Some(row) = scanned.rows.get(scanned.at) else { return String::new() };
    let name = measured(scanned);
    let place = scanned.scan.place(scanned.at);
    let found = |digits: usize| match (&row.reason, scanned.value(scanned.at)) {
        (Some(reason), _) => format!("- {reason}"),
        (None, Some(value)) => {
            nothing(scanned, scanned.at).map_or(measurement(value, Some(digits)), str::to_owned)
        }
        (None, None) => String::new(),
    };
    let text = |digits: &usize| {
        let at = scanned.scan.over().iter().zip(&place).map(|(sweep, which)| {
            format!("{} {}", sweep.symbol, significant(sweep.value(*which), *digits))
        });
        format!(" {name} {} at {}", found(*digits), joined(at, " "))
    };
    pane::fitting(DIGITS.iter().map(text), width)
}

/// What the heights of a curve mean: their range, or the words that they stand for.
fn meaning(scanned: &ScanOnShow, width: usize) -> String {
    let name = measured(scanned);
    if scanned.plots_words() {
        let meanings = WORDS.iter().enumerate().map(|(number, word)| format!("{number} {word}"));
        let meanings = joined(meanings, ", ");
        return pane::fitting([format!(" {name}: {meanings}"), format!(" {meanings}")], width);
    }
    let Some((low, high)) = scanned.range() else { return format!(" {name}") };
    let ends = Danger::of(scanned).map_or([""; 2], |scale| scale.ends());
    let [lowest, highest] = ends.map(|end| {
        if end.is_empty() {
            String::new()
        } else {
            format!(" ({end})")
        }
    });
    let range = |digits: &usize| {
        let [low, high] = [low, high].map(|value| significant(value, *digits));
        format!(" {name} {low}{lowest} .. {high}{highest}")
    };
    pane::fitting(DIGITS[3..].iter().map(range), width)
}

/// Draws a table that scrolls: the names and the rows around the one that is looked at. The column that is plotted comes
/// first of those that are measured, and the others follow as far as they fit whole.
fn table(area: Rect, scanned: &ScanOnShow, screen: &mut Surface) {
    let look = screen.look;
    let room = usize::from(area.height).saturating_sub(1);
    let first = pane::first_seen(scanned.at, scanned.rows.len(), room);
    let seen = first..scanned.rows.len().min(first + room);
    let names = names(scanned);
    let rows: Vec<Vec<String>> = seen.clone().map(|index| cells(scanned, index)).collect();
    let mut used = 0;
    let fits = |width: &usize| {
        used += width + 1;
        used < usize::from(area.width)
    };
    let width = |column: usize| {
        let texts = std::iter::once(&names).chain(&rows).map(|row| row[column].chars().count());
        texts.max().unwrap_or(0)
    };
    let widths: Vec<usize> = (0..names.len()).map(width).take_while(fits).collect();
    // Columns that are left out have a mark in place of their names.
    let more = if widths.len() < names.len() {
        &look.symbols().more
    } else {
        ""
    };
    let line = |row: &[String]| {
        let cells = row.iter().zip(&widths).map(|(text, width)| format!("{text:>width$} "));
        cells.collect::<String>()
    };
    let names = look.span(line(&names) + more, Role::Title);
    let rows = rows.iter().zip(seen).map(|(row, index)| {
        let reason = &scanned.rows[index].reason;
        let role = match (index == scanned.at, reason) {
            (true, _) => Role::Selected,
            (false, Some(_)) => Role::Warning,
            (false, None) => Role::Text,
        };
        look.span(line(row) + reason.as_deref().unwrap_or_default(), role)
    });
    screen.lines(area, std::iter::once(names).chain(rows));
}

/// The names of the columns.
fn names(scanned: &ScanOnShow) -> Vec<String> {
    let over = scanned.scan.over().iter().map(|sweep| sweep.symbol.spec().name);
    let mut measured = scanned.scan.measured();
    measured.rotate_left(scanned.column);
    over.chain(measured).map(str::to_owned).collect()
}

/// What stands below them in a row.
fn cells(scanned: &ScanOnShow, index: usize) -> Vec<String> {
    let mut values = scanned.rows[index].values.clone();
    values.resize(scanned.scan.measured().len(), Value::Nothing);
    values.rotate_left(scanned.column);
    let place = scanned.scan.place(index);
    let over = scanned.scan.over().iter().zip(&place);
    let over = over.map(|(sweep, which)| significant(sweep.value(*which), DIGITS[0]));
    over.chain(values.into_iter().map(|value| measurement(value, Some(8)))).collect()
}
