//! A picture painted into a part of the screen.

use super::{Look, Surface, look::Symbols, pane::FramedPicture, plot::Canvas, scan_map};
use crate::picture::{Caption, Dash, Fill, Item, Mark, Marks, Picture, Role};
use crate::scene::Window;

/// Plots at least this wide say beside a curve what it is.
const LABELLED: u16 = 30;

/// Columns between marks that are left out where they would touch.
const APART: usize = 4;

pub fn paint(framed: &FramedPicture, screen: &mut Surface) {
    let look = screen.look;
    let Picture { window, cursor, items, captions, map, .. } = &framed.picture;
    let mut plot = Canvas::new(framed, screen);
    if let Some(map) = map {
        scan_map::draw(&plot, map, screen);
    }
    for item in items {
        put(&mut plot, item, *window, look);
    }
    // Names of curves come last, since they have many places to go to.
    let (names, beside_points): (Vec<&Caption>, Vec<&Caption>) =
        captions.iter().partition(|caption| !caption.or_at.is_empty());
    for caption in beside_points {
        plot.caption(caption);
    }
    if let Some(cursor) = cursor {
        plot.cross(*cursor);
    }
    let labelled = plot.inner.width >= LABELLED;
    let named = |name: &&Caption| labelled || !name.long.is_empty();
    // Curves that a name beside them could be taken for the name of.
    let curves = items.iter().filter_map(|item| match item {
        Item::Curve(line, points) if matches!(line.dash, Dash::Solid | Dash::Dashed) => {
            Some(&points[..])
        }
        _ => None,
    });
    let names: Vec<&Caption> = names.into_iter().filter(named).collect();
    plot.names(&names, &curves.collect::<Vec<_>>());
    plot.finish(screen);
}

fn put(plot: &mut Canvas, item: &Item, window: Window, look: &Look) {
    let symbols = look.symbols();
    match item {
        Item::Curve(line, points) => {
            plot.curve(points.iter().copied(), line.role, line.dash);
        }
        Item::Graph(line, value) => plot.function(line.role, line.dash, value),
        Item::Upright(line, x) => plot.upright(*x, line.role, line.dash),
        Item::Shade(line, edge) => plot.shade(edge, true, line.role),
        Item::Beyond(line, edge) => plot.shade(edge, false, line.role),
        Item::Columns(line, from, to) => {
            plot.shade_where(line.role, |point| (*from..=*to).contains(&point.x));
        }
        Item::Rows(line, from, to) => {
            plot.shade_where(line.role, |point| (*from..=*to).contains(&point.y));
        }
        Item::Texture(at) => {
            let filled = |Fill { role, .. }: Fill| (filling(role, symbols), role);
            plot.texture_where(|point| at(point).map(filled));
        }
        Item::Arrows(flow) => plot.arrows(flow),
        Item::Marks(Marks { mark, role, at, sparse, at_edge, .. }) => {
            let crowded = *sparse && at.len() * APART > usize::from(plot.inner.width);
            for at in at.iter().filter(|_| !crowded) {
                let (at, symbol) = match Marks::edge(*at, window).filter(|_| *at_edge) {
                    Some((at, above)) => (at, symbols.arrows[if above { 2 } else { 6 }]),
                    None => (*at, symbols.mark(*mark)),
                };
                plot.mark(at, symbol, *role);
            }
        }
    }
}

/// What fills a part of the world, by what it is: the marks of cycles where motions end on one, arrows where they leave.
fn filling(role: Role, symbols: &Symbols) -> char {
    match role {
        Role::Field => symbols.arrows[0],
        Role::Stable => symbols.mark(Mark::Stable),
        Role::Unstable => symbols.mark(Mark::Unstable),
        _ => symbols.shade,
    }
}
