//! The chart of regimes: what becomes of kicks, over two parameters.
//!
//! Each regime has its texture and its name; computed borders are drawn through, the border by one
//! harmonic (48) is dotted. Today's point is marked: stepping the two parameters moves it and nothing
//! else.

use super::dots::Dash;
use super::look::Role;
use super::picture::{Item, Line, Mark, Pattern, Picture};
use super::plot::reading;
use crate::oscillator::Symbol;
use crate::scene::{Axes, Layer, Point, View};
use crate::session::{self, Session};
use crate::study::chart::{Border, Chart};
use crate::study::regime::{REGIMES, Regime};

/// What the plot with this index shows.
#[must_use]
pub fn picture(session: &Session, index: usize) -> Picture<'_> {
    let session::Plot { window, cursor, axes, .. } = session.plots[index];
    let Axes { abscissa, against, .. } = axes;
    let (right, up) = (abscissa.spec().name, against.spec().name);
    let today = Point { x: session.value(abscissa), y: session.value(against) };
    let found = session.chart(index);
    let mut picture = Picture::new(View::Regimes.spec().title, right, up, window);
    let read = |point: Point| found.and_then(|chart| chart.regime_at(point.x, point.y));
    picture.reading = Some(cursor.map_or_else(
        || read(today).map_or_else(String::new, |regime| regime.name().into()),
        |cursor| {
            let (x, y) = reading(cursor, window);
            let regime = read(cursor).map_or("", Regime::name);
            format!("{right} {x} {up} {y} {regime}")
        },
    ));
    let shows = |layer| session.layers.contains(&layer);

    if let Some(chart) = found.filter(|_| shows(Layer::Regimes)) {
        let texture = |point: Point| chart.regime_at(point.x, point.y).and_then(texture);
        picture.items.push(Item::Texture(Box::new(texture)));
    }
    signs(&mut picture, abscissa, against);
    if let Some(chart) = found {
        let mut border = |border, line: Line| {
            for run in chart.border(border) {
                picture.curve(line.clone(), run.into_iter().map(|(x, y)| Point { x, y }));
            }
        };
        if shows(Layer::HarmonicBorder) {
            let name = "fold of the first harmonic";
            border(Border::Harmonic, Line::new(name, Role::Harmonic, Dash::Dotted));
        }
        if shows(Layer::Borders) {
            border(Border::Fold, Line::new("fold", Role::Special, Dash::Solid));
            border(Border::Escape, Line::new("escape", Role::Unstable, Dash::Solid));
        }
        if shows(Layer::Regimes) {
            names_of_regimes(&mut picture, chart);
        }
    }
    let present = || Line::new("present value", Role::Current, Dash::Sparse);
    picture.upright(present(), today.x);
    let level = [window.x.from(), window.x.to()].map(|x| Point { x, y: today.y });
    picture.curve(present(), level);
    picture.mark(Mark::Head, today, Role::Current);
    picture.cross(cursor);
    picture
}

/// What a regime looks like; nothing where every kick is survived.
fn texture(regime: Regime) -> Option<(Pattern, Role)> {
    match regime {
        Regime::Global | Regime::Neutral => None,
        Regime::Finite => Some((Pattern::Shade, Role::Unstable)),
        Regime::Coexisting => Some((Pattern::Shade, Role::Stable)),
        Regime::Escape => Some((Pattern::Arrows, Role::Field)),
        Regime::Cycle => Some((Pattern::Stable, Role::Stable)),
        Regime::Repelling => Some((Pattern::Unstable, Role::Unstable)),
    }
}

/// Where a parameter changes its sign; D = 0 is the Hopf point of the system without friction.
fn signs(picture: &mut Picture, right: Symbol, up: Symbol) {
    let window = picture.window;
    picture.upright(Line::guide(), 0.0);
    let level = [window.x.from(), window.x.to()].map(|x| Point { x, y: 0.0 });
    picture.curve(Line::guide(), level);
    let hopf = if right == Symbol::D {
        Some(Point { x: 0.0, y: window.y.to() })
    } else {
        (up == Symbol::D).then_some(Point { x: window.x.from(), y: 0.0 })
    };
    if let Some(place) =
        hopf.filter(|place| window.x.contains(place.x) && window.y.contains(place.y))
    {
        picture.caption(place, "H", Role::Quiet);
    }
}

/// Writes each name where its regime has most room on a line, near the middle of the window.
fn names_of_regimes(picture: &mut Picture, chart: &Chart) {
    let window = picture.window;
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
            picture.caption(place, name, Role::Text);
        }
    }
}
