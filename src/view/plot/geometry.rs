//! Where the parts of a plot stand on the screen, and which point a cell stands for.

use ratatui::layout::{Position, Rect};

use crate::picture::{Picture, Room, Scale, Tick, Ticks};
use crate::scene::{Point, Span, View, Window};
use crate::session::Session;
use crate::view::pane;
use crate::words::resolved;

/// Smallest area in which axes stand outside the picture; below it labels lie inside.
const ROOMY: (u16, u16) = (22, 9);

/// Fewest columns of the labels at the left, so that the picture does not jump when they change.
const GUTTER: u16 = 5;

/// Where the parts of a plot stand, and the ticks that there is room for.
pub struct Geometry {
    /// The cells between the axes.
    pub inner: Rect,
    /// Whether the axes stand outside of them.
    pub roomy: bool,
    pub rightward: Ticks,
    /// Ticks at the left.
    pub upward: Ticks,
}

impl Geometry {
    pub fn of(area: Rect, window: Window, scales: [Scale; 2], upward: Option<Ticks>) -> Self {
        let body = pane::below(area, 1);
        let (roomy, rows) = (is_roomy(area), rows(area));
        let most = usize::from(rows / 3).clamp(2, 9);
        let upward =
            upward.unwrap_or_else(|| Ticks::on(scales[1], window.y, |ticks| ticks.len() <= most));
        let widest = upward.ticks.iter().map(|tick| tick.label.len()).max().unwrap_or(0) as u16;
        let gutter = if roomy { (widest + 1).max(GUTTER) } else { 0 };
        let inner = Rect {
            x: body.x + gutter,
            width: body.width.saturating_sub(gutter),
            height: rows,
            ..body
        };
        let spaced = |gap| Ticks::on(scales[0], window.x, |ticks| apart(ticks, inner.width, gap));
        // Two ticks make a scale: rather closer together than only one.
        let wide = Some(spaced(3)).filter(|ticks| ticks.ticks.len() > 1);
        let rightward = wide.unwrap_or_else(|| spaced(1));
        Geometry { inner, roomy, rightward, upward }
    }
}

/// The part of the world that a plot shows in `area`: its window, moved by up to half a row so that the line
/// y = 0 runs through the middle of its cells, as the marks on it do; and more where units are to be as
/// long across as up.
pub fn shown(area: Rect, session: &Session, index: usize, scales: [Scale; 2]) -> Window {
    let window = widened(area, session, index, scales);
    let (rows, y) = (f64::from(rows(area)), window.y);
    let zero = y.fraction(0.0) * rows;
    let has_zero =
        ![View::EnergyLedger, View::Trade, View::Scan].contains(&session.plots[index].view);
    // What is drawn at the edge of the picture stays there.
    if has_zero && (1.0..=rows - 1.0).contains(&zero) {
        let by = (zero - zero.floor() - 0.5) / rows;
        return Window { y: y.shifted(by), ..window };
    }
    window
}

fn widened(area: Rect, session: &Session, index: usize, scales: [Scale; 2]) -> Window {
    let window = session.plots[index].window;
    if !session.has_equal_units(index) {
        return window;
    }
    // A cell is twice as high as wide. The labels at the left may need more room in the wider window.
    let equal = |shown: Window| {
        let Rect { width, height, .. } = Geometry::of(area, shown, scales, None).inner;
        window.with_equal_units(f64::from(width), 2.0 * f64::from(height))
    };
    equal(equal(window))
}

/// Whether the axes of a plot in `area` stand outside of its cells, below a title.
fn is_roomy(area: Rect) -> bool {
    area.width >= ROOMY.0 && area.height > ROOMY.1
}

/// Columns and rows of a plot in `area` that has no ticks at the left.
pub fn room(area: Rect) -> Room {
    let gutter = if is_roomy(area) { GUTTER } else { 0 };
    [area.width.saturating_sub(gutter).into(), rows(area).into()]
}

/// Rows of the raster of a plot in `area`.
pub fn rows(area: Rect) -> u16 {
    area.height.saturating_sub(if is_roomy(area) { 3 } else { 1 })
}

/// The point of a picture in `area` that a cell stands for, to the digits that cells tell apart; `None`
/// for the cells outside of its axes.
pub fn point_at(area: Rect, picture: &Picture, cell: Position) -> Option<Point> {
    let Picture { window, scales, upward, .. } = picture;
    let Geometry { inner, .. } = Geometry::of(area, *window, *scales, upward.clone());
    if !inner.contains(cell) {
        return None;
    }
    let [right, up] = middle(inner, cell.x - inner.x, cell.y - inner.y);
    let rounded = |span: Span, fraction, cells: u16| {
        resolved(span.at(fraction), span.width() / f64::from(cells)).parse().ok()
    };
    Some(Point {
        x: rounded(window.x, right, inner.width)?,
        y: rounded(window.y, up, inner.height)?,
    })
}

/// Where the middle of a cell lies, as fractions of both axes.
pub fn middle(inner: Rect, column: u16, row: u16) -> [f64; 2] {
    let fraction = |cell: u16, cells: u16| (f64::from(cell) + 0.5) / f64::from(cells.max(1));
    [fraction(column, inner.width), 1.0 - fraction(row, inner.height)]
}

/// Where a fraction of an axis lies among this many dots or cells. Curves, marks and ticks at the border of two of
/// them all lie in the second, whatever the last digit of the fraction is.
pub fn along(fraction: f64, count: f64) -> f64 {
    const ROUNDING: f64 = 1e-9;
    let place = fraction * count + ROUNDING;
    if (place - count).abs() <= 2.0 * ROUNDING {
        count
    } else {
        place
    }
}

/// The cell in which a fraction of the axis lies.
pub fn column(fraction: f64, cells: u16) -> u16 {
    (along(fraction, cells.into()) as u16).min(cells.saturating_sub(1))
}

/// Where the label of a tick begins, so that it is centred below its tick and inside the axis.
pub fn centred(tick: &Tick, cells: u16) -> u16 {
    let length = tick.label.len() as u16;
    column(tick.fraction, cells).saturating_sub(length / 2).min(cells.saturating_sub(length))
}

/// Whether the labels of a horizontal axis fit on it with a gap between them.
fn apart(ticks: &[Tick], cells: u16, gap: u16) -> bool {
    let places = || ticks.iter().map(|tick| (centred(tick, cells), tick.label.len() as u16));
    let fits = places().all(|(start, length)| start + length <= cells);
    let clear = places()
        .zip(places().skip(1))
        .all(|((start, length), (next, _))| start + length + gap <= next);
    fits && clear
}
