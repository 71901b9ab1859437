//! The chart of regimes: what becomes of kicks, over two parameters.
//!
//! Each regime has its texture and its name; computed borders are drawn through, the border by one
//! harmonic (48) is dotted. Today's point is marked: stepping the two parameters moves it and nothing
//! else.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;

use super::dots::Dash;
use super::look::{Look, Role};
use super::pane::Heading;
use super::plot::{Names, Plot, reading};
use crate::oscillator::Symbol;
use crate::scene::{Axes, Layer, Point, View, Window};
use crate::session::{self, Pane, Session};
use crate::study::chart::{Border, Chart};
use crate::study::regime::{REGIMES, Regime};

/// Draws the plot with this index.
pub fn draw(area: Rect, session: &Session, index: usize, look: &Look, buffer: &mut Buffer) {
    let session::Plot { window, cursor, axes, .. } = session.plots[index];
    let Axes { abscissa, against, .. } = axes;
    let (right, up) = (abscissa.spec().name, against.spec().name);
    let names = Names { title: View::Regimes.spec().title, x: right, y: up };
    let today = Point { x: session.value(abscissa), y: session.value(against) };
    let found = session.chart(index);
    let mut heading = Heading::of(session, Pane::Plot(index));
    let read = |point: Point| found.and_then(|chart| chart.regime_at(point.x, point.y));
    heading.reading = Some(cursor.map_or_else(
        || read(today).map_or_else(String::new, |regime| regime.name().into()),
        |cursor| {
            let (x, y) = reading(cursor, window);
            let regime = read(cursor).map_or("", Regime::name);
            format!("{right} {x} {up} {y} {regime}")
        },
    ));
    let mut plot = Plot::new(area, window, names, &heading, look, buffer);
    let shows = |layer| session.layers.contains(&layer);

    if let Some(chart) = found.filter(|_| shows(Layer::Regimes)) {
        plot.texture_where(|point| {
            chart.regime_at(point.x, point.y).and_then(|at| texture(at, look))
        });
    }
    signs(&mut plot, abscissa, against, window);
    if let Some(chart) = found {
        if shows(Layer::HarmonicBorder) {
            border(&mut plot, chart, Border::Harmonic, Role::Harmonic, Dash::Dotted);
        }
        if shows(Layer::Borders) {
            border(&mut plot, chart, Border::Fold, Role::Special, Dash::Solid);
            border(&mut plot, chart, Border::Escape, Role::Unstable, Dash::Solid);
        }
        if shows(Layer::Regimes) {
            names_of_regimes(&mut plot, chart, window);
        }
    }
    plot.upright(today.x, Role::Current, Dash::Sparse);
    let level = [window.x.from(), window.x.to()].map(|x| Point { x, y: today.y });
    plot.curve(level, Role::Current, Dash::Sparse);
    plot.mark(today, look.symbols().head, Role::Current);
    if let Some(cursor) = cursor {
        plot.cross(cursor);
    }
    plot.finish(buffer);
}

/// What a regime looks like; nothing where every kick is survived.
fn texture(regime: Regime, look: &Look) -> Option<(char, Role)> {
    let [stable, unstable] = look.symbols().points;
    match regime {
        Regime::Global | Regime::Neutral => None,
        Regime::Finite => Some((look.symbols().shade, Role::Unstable)),
        Regime::Coexisting => Some((look.symbols().shade, Role::Stable)),
        Regime::Escape => Some((look.symbols().arrows[0], Role::Field)),
        Regime::Cycle => Some((stable, Role::Stable)),
        Regime::Repelling => Some((unstable, Role::Unstable)),
    }
}

/// Where a parameter changes its sign; D = 0 is the Hopf point of the system without friction.
fn signs(plot: &mut Plot, right: Symbol, up: Symbol, window: Window) {
    plot.upright(0.0, Role::Axis, Dash::Sparse);
    let level = [window.x.from(), window.x.to()].map(|x| Point { x, y: 0.0 });
    plot.curve(level, Role::Axis, Dash::Sparse);
    let hopf = if right == Symbol::D {
        Some(Point { x: 0.0, y: window.y.to() })
    } else {
        (up == Symbol::D).then_some(Point { x: window.x.from(), y: 0.0 })
    };
    if let Some(place) =
        hopf.filter(|place| window.x.contains(place.x) && window.y.contains(place.y))
    {
        plot.caption(place, "H", Role::Quiet);
    }
}

fn border(plot: &mut Plot, chart: &Chart, border: Border, role: Role, dash: Dash) {
    for run in chart.border(border) {
        plot.curve(run.into_iter().map(|(x, y)| Point { x, y }), role, dash);
    }
}

/// Writes each name where its regime has most room on a line, near the middle of the window.
fn names_of_regimes(plot: &mut Plot, chart: &Chart, window: Window) {
    for (regime, name, _) in REGIMES {
        let mut best: Option<(f64, Point)> = None;
        for line in &chart.lines {
            for band in line.bands.iter().filter(|band| band.regime == Some(regime)) {
                let (x, y) = chart.point(line.at, 0.5 * (band.from + band.to));
                if !(window.x.contains(x) && window.y.contains(y)) {
                    continue;
                }
                let across = if chart.along == chart.plane.right {
                    window.y.fraction(y)
                } else {
                    window.x.fraction(x)
                };
                let along = if chart.along == chart.plane.right { window.x } else { window.y };
                let room = (band.to - band.from) / along.width() * (1.0 - (across - 0.5).abs());
                if best.is_none_or(|(most, _)| room > most) {
                    best = Some((room, Point { x, y }));
                }
            }
        }
        if let Some((_, place)) = best {
            plot.caption(place, name, Role::Text);
        }
    }
}
