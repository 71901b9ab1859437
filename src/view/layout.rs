//! Which pane stands where, for every size of the screen.
//!
//! The line about playback takes a row of the plots while there is something to play; the sentence of a first screen stands
//! below the title. Designed for 80 columns and 24 rows up. Where there is less, parts drop in this order: plots that
//! would be smaller than [`SMALLEST_PLOT`], the last one without focus first; below 20 rows the second
//! status line; below 60 x 16 everything, and a message says what is needed. A caption has rows of its own, for which
//! the plots give way: it hides neither a curve nor what the curves mean.

use ratatui::layout::{Constraint, Layout as Split, Rect};

use super::{caption, pane};
use crate::scene::Arrangement;
use crate::session::{Session, Size};

/// Smallest screen on which anything but a card is drawn.
pub const SMALLEST: (u16, u16) = (60, 16);

/// Smallest plot beside others: columns and rows.
pub const SMALLEST_PLOT: (u16, u16) = (26, 8);

/// Columns of the parameter pane, by the columns of the screen: with names and values, with all
/// steps, with meanings.
const COLUMNS: [(u16, u16); 3] = [(150, 56), (110, 34), (0, 25)];

/// Columns of a screen on which the sentence of a first screen takes two rows in place of three.
const ROOMY: u16 = 100;

/// Rows of a screen whose legend has two rows.
const TALL: u16 = 24;

/// Rows that a caption leaves to the plots.
const LEAST: u16 = 5;

/// Rows of plots beside which the outcome of a lecture has large letters.
const LEAST_IN_LECTURE: u16 = 9;

/// Rows of the outcome of a lecture, and from how many rows of the screen on: large letters and two lines.
const OUTCOMES: [(u16, u16); 2] = [(40, 7), (0, 5)];

/// The parts of the screen; an empty area is not shown.
#[derive(Clone, Debug, Default)]
pub struct Layout {
    pub title: Rect,
    /// What one sees, on a first screen.
    pub sentence: Rect,
    /// In a lecture one line.
    pub parameters: Rect,
    /// Plots, by their index in the session.
    pub plots: Vec<Rect>,
    /// What the lines mean; without rows on a low screen.
    pub legend: Rect,
    /// A tour or what there is to see; without rows where nothing is said.
    pub caption: Rect,
    /// What is being played.
    pub playback: Rect,
    /// In a lecture with the outcome in large letters.
    pub status: Rect,
    /// Keys, notices and the entry line.
    pub footer: Rect,
}

/// Divides a screen among what the session has on show; `None` if it is too small.
pub fn layout(screen: Rect, session: &Session) -> Option<Layout> {
    let Rect { width, height, .. } = screen;
    if width < SMALLEST.0 || height < SMALLEST.1 {
        return None;
    }
    let designed = Size { width, height }.tells_margin();
    let lectures = session.display.lecture;
    let (mut status, numbers) = match OUTCOMES.iter().find(|(least, _)| height >= *least) {
        Some((_, rows)) if lectures && designed => (*rows, 1),
        _ => (if designed { 2 } else { 1 }, u16::from(lectures)),
    };
    let legend = match height {
        _ if !designed => 0,
        TALL.. if !lectures => 2,
        _ => 1,
    };
    let sentence = match session.scene.next {
        _ if lectures => 0,
        Some(_) if designed && width < ROOMY => 3,
        Some(_) if designed => 2,
        _ => 0,
    };
    let playback = u16::from(session.tells_playback());
    let mut body = height - 2 - numbers - sentence - legend - playback - status;
    let caption = caption::rows(width, session);
    if lectures && designed && body < caption + LEAST_IN_LECTURE {
        // A long text takes the room of the large letters, of which the sentence below says the same.
        (body, status) = (body + status - 2, 2);
    }
    let caption = caption.min(body.saturating_sub(LEAST));
    let rows = [1, sentence, numbers, body - caption, legend, caption, playback, status, 1];
    let [title, sentence, numbers, body, legend, caption, playback, status, footer] =
        Split::vertical(rows.map(Constraint::Length)).areas(screen);
    let parts =
        Layout { title, sentence, legend, caption, playback, status, footer, ..Layout::default() };
    if lectures {
        return Some(Layout { parameters: numbers, plots: plots(body, session), ..parts });
    }
    let column =
        COLUMNS.iter().find(|(least, _)| width >= *least).map_or(23, |(_, columns)| *columns);
    let rest = Rect { x: body.x + column + 1, width: width - column - 1, ..body };
    let parameters = Rect { width: column, ..body };
    let plots = plots(rest, session);
    Some(Layout { parameters, plots, ..parts })
}

/// The places of the plots, of which as many are shown as are large enough.
fn plots(area: Rect, session: &Session) -> Vec<Rect> {
    let mut shown: Vec<usize> = session.on_show().collect();
    loop {
        let places = divided(area, shown.len(), session.arrangement);
        let fits = |place: &Rect| place.width >= SMALLEST_PLOT.0 && place.height >= SMALLEST_PLOT.1;
        let dropped = shown.iter().rposition(|index| *index != session.plot);
        if let Some(dropped) = dropped.filter(|_| !places.iter().all(fits)) {
            shown.remove(dropped);
            continue;
        }
        let mut all = vec![Rect::default(); session.plots.len()];
        for (index, place) in shown.into_iter().zip(places) {
            all[index] = place;
        }
        return all;
    }
}

/// Divides an area among this many plots.
fn divided(area: Rect, count: usize, arrangement: Arrangement) -> Vec<Rect> {
    let wide = is_wide(area);
    match (count, arrangement) {
        (0 | 1, _) => vec![area],
        (_, Arrangement::Columns) => parts(area, count, true),
        (_, Arrangement::Rows) => parts(area, count, false),
        (2, Arrangement::Auto) => parts(area, 2, wide),
        (3, Arrangement::Auto) => {
            let halves = parts(area, 2, wide);
            [&halves[..1], &parts(halves[1], 2, !wide)].concat()
        }
        (_, Arrangement::Auto) => {
            parts(area, 2, false).into_iter().flat_map(|row| parts(row, 2, true)).collect()
        }
    }
}

/// Whether halves beside each other are nearer to squares than halves above each other. A cell is about
/// twice as high as wide.
fn is_wide(area: Rect) -> bool {
    let beside = (area.width / 2).min(2 * area.height);
    let above = area.width.min(2 * (area.height / 2));
    beside >= above
}

/// Equal parts of an area beside each other, with a column between them that stays empty, or above each other.
fn parts(area: Rect, count: usize, beside: bool) -> Vec<Rect> {
    let (length, gap) = if beside { (area.width, 1) } else { (area.height, 0) };
    let count = pane::cells(count);
    let begin = |part: u16| ((length + gap) * part + gap) / count;
    let part = |part: u16| {
        let (begin, length) = (begin(part), (begin(part + 1) - begin(part)).saturating_sub(gap));
        if beside {
            Rect { x: area.x + begin, width: length, ..area }
        } else {
            Rect { y: area.y + begin, height: length, ..area }
        }
    };
    (0..count).map(part).collect()
}
