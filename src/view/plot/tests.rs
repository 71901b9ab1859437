//! Everything at a place of the world stands at one place of the screen, and names stand at their own curves.

use proptest::prelude::*;

use super::*;
use crate::numerics::real;
use crate::picture::{Caption, Picture, Scale};
use crate::scene::Span;
use crate::session::settings::choices;
use crate::session::{DisplaySettings, Glyphs};
use crate::view::pane::Heading;

fn look(glyphs: Glyphs) -> Look {
    Look::new(DisplaySettings { glyphs, ..DisplaySettings::default() })
}

/// A canvas with unnamed axes.
fn canvas<'a>(size: (u16, u16), window: Window, screen: &mut Surface<'a>) -> Canvas<'a> {
    let picture = Picture::new("", "", "y", window);
    let area = Rect::new(0, 0, size.0, size.1);
    Canvas::new(&FramedPicture { area, picture, heading: Heading::default() }, screen)
}

/// The rows in which something stands.
fn rows_drawn(plot: &Canvas) -> Vec<u16> {
    let Rect { width, height, .. } = plot.inner;
    let covering = |column: u16, row: u16| plot.dots.covering((column.into(), row.into()));
    let drawn = |row: &u16| (0..width).any(|column| covering(column, *row) > Covering::Texture);
    (0..height).filter(drawn).collect()
}

proptest! {
    /// Places at the border of two rows are the hard ones: windows and values are short decimal numbers.
    #[test]
    fn what_is_at_one_height_stands_in_one_row(
        (low, width) in (-40_i32..40, 1_i32..60), part in 0_u32..=40, (across, down) in (22_u16..60, 10_u16..50),
    ) {
        let tenth = |count: i32| f64::from(count) / 10.0;
        let (from, to) = (tenth(low), tenth(low + width));
        let window = Window { x: Span::known(-1.0, 1.0), y: Span::new(from, to).unwrap() };
        let y = from + (to - from) * f64::from(part) / 40.0;
        let ends = [-0.7, 0.7].map(|x| Point { x, y });
        let mut all = Vec::new();
        for (_, glyphs) in choices::<Glyphs>() {
            let look = look(glyphs);
            let mut buffer = Buffer::empty(Rect::new(0, 0, across, down));
            let draws: [&dyn Fn(&mut Canvas); 5] = [
                &|plot| plot.curve(ends, Role::Stable, Dash::Solid),
                &|plot| plot.function(Role::Stable, Dash::Dashed, |_| Some(y)),
                &|plot| plot.function(Role::Axis, Dash::Sparse, |_| Some(y)),
                &|plot| plot.curve(ends, Role::Sticking, Dash::Thick),
                &|plot| plot.mark(ends[0], 'X', Role::Current),
            ];
            for draw in draws {
                let mut plot = canvas((across, down), window, &mut Surface { look: &look, buffer: &mut buffer });
                draw(&mut plot);
                all.push(rows_drawn(&plot));
            }
        }
        prop_assert_eq!(all[0].len(), 1, "{:?}", &all);
        prop_assert!(all.iter().all(|rows| *rows == all[0]), "{:?}", all);
    }

    #[test]
    fn a_tick_stands_in_the_row_of_the_curve_at_its_value(
        (low, width) in (-40_i32..40, 1_i32..60), (across, down) in (22_u16..60, 10_u16..50),
    ) {
        let tenth = |count: i32| f64::from(count) / 10.0;
        let y = Span::new(tenth(low), tenth(low + width)).unwrap();
        let window = Window { x: Span::known(-1.0, 1.0), y };
        let look = look(Glyphs::Braille);
        let mut buffer = Buffer::empty(Rect::new(0, 0, across, down));
        let area = Rect::new(0, 0, across, down);
        for tick in Geometry::of(area, window, [Scale::Even; 2], None).upward.ticks {
            let value: f64 = tick.label.parse().unwrap();
            let mut plot = canvas((across, down), window, &mut Surface { look: &look, buffer: &mut buffer });
            plot.function(Role::Stable, Dash::Solid, |_| Some(value));
            prop_assert_eq!(rows_drawn(&plot), vec![plot.row(tick.fraction)], "{}", value);
        }
    }

    #[test]
    fn a_name_stands_nearer_to_its_own_curve_than_to_others(
        apart in proptest::collection::vec(3_u16..12, 2), slope in 0.1..1.5_f64, (across, down) in (50_u16..90, 14_u16..40),
    ) {
        let window = Window { x: Span::known(0.0, 100.0), y: Span::known(0.0, 1.0) };
        let starts = [20.0, 20.0 + f64::from(apart[0]), 20.0 + f64::from(apart[0] + apart[1])];
        let at = |start: f64, y: f64| Point { x: start + 20.0 * slope * y, y };
        let curves = starts.map(|start| (0..=80).map(|part| at(start, f64::from(part) / 80.0)).collect::<Vec<_>>());
        let texts = ["r = 0.01", "r = 0.02", "r = 0.03"];
        let names: Vec<Caption> = texts.iter().zip(&curves).map(|(text, curve)| Caption {
            at: curve[80],
            or_at: curve.iter().rev().skip(1).copied().collect(),
            // Such a name is rather left out than taken for that of another curve.
            long: "".into(),
            short: (*text).into(),
            role: Role::Special,
        }).collect();
        let look = look(Glyphs::Braille);
        let mut buffer = Buffer::empty(Rect::new(0, 0, across, down));
        let mut screen = Surface { look: &look, buffer: &mut buffer };
        let mut plot = canvas((across, down), window, &mut screen);
        for curve in &curves {
            plot.curve(curve.iter().copied(), Role::Stable, Dash::Solid);
        }
        let followed = curves.each_ref().map(Vec::as_slice);
        plot.names(&names.iter().collect::<Vec<_>>(), &followed);
        let inner = plot.inner;
        let cells = |curve: &Vec<Point>| -> Vec<(f64, f64)> {
            let cell = |point: &Point| {
                let (x, y) = plot.place(*point);
                ((x / 2.0).floor(), (y / 4.0).floor())
            };
            curve.iter().map(cell).collect()
        };
        let cells = curves.each_ref().map(cells);
        plot.finish(&mut screen);
        for (own, text) in texts.iter().enumerate() {
            let rows = (0..inner.height).map(|row| {
                (0..inner.width).map(|column| buffer[(inner.x + column, inner.y + row)].symbol()).collect::<Vec<_>>()
            });
            let found = rows.enumerate().find_map(|(row, letters)| {
                let start = letters.windows(text.len()).position(|part| part.concat() == *text)?;
                Some((real(start), real(row)))
            });
            let Some((left, row)) = found else { continue };
            let right = left + real(text.len() - 1);
            // In rows; a column is half as wide.
            let distance = |curve: &Vec<(f64, f64)>| {
                let from = |(x, y): &(f64, f64)| {
                    let aside = (left - x).max(x - right).max(0.0) / 2.0;
                    aside.max((row - y).abs())
                };
                curve.iter().map(from).fold(f64::INFINITY, f64::min)
            };
            let others = (0..3).filter(|other| *other != own).map(|other| distance(&cells[other]));
            let others = others.fold(f64::INFINITY, f64::min);
            prop_assert!(distance(&cells[own]) <= others, "{} at {} {}: {}", text, left, row, others);
        }
    }
}
