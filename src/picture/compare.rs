//! A beside B: what a plot shows of the point that the present one is compared with.
//!
//! That is the picture of a session at the other point, as far as it differs, in lines that are paler and more broken. What
//! a machine of other units does is brought to those of the present one.

use super::{Caption, Dash, Item, LineStyle, Marks, Picture, Role};
use crate::scene::{Point, View, Window};
use crate::session::{Session, VariantTag};

/// Lines of the other point that a legend explains: what else has their colour goes with them.
const TOLD: [&str; 4] = ["motion", "stable cycle", "unstable cycle", "border of the basin"];

/// Adds what a plot shows of the other point, its picture alone, behind the present one.
pub fn add<'a>(
    picture: &mut Picture<'a>,
    theirs: Picture<'a>,
    (session, other): (&Session, &Session),
    index: usize,
) {
    let (view, by) = (session.plots[index].view, session.units_beside(index));
    let mut items: Vec<Item> = theirs.items;
    // Over time only displacements are lengths.
    let is_length = |item: &mut Item| line(item).is_some_and(|it| it.name.starts_with("displ"));
    items.retain_mut(|item| view != View::TimeSeries || by == [1.0; 2] || is_length(item));
    let label = other.letter().unwrap_or("the point left");
    let place = picture.variants.len();
    picture.variants.push(other.problem.parameters);
    let items = items.into_iter().filter_map(|item| beside(item, by, (place, label)));
    let mut items: Vec<Item> = items.collect();
    if let Some(letter) = session.letter() {
        let lines = picture.items.iter_mut().filter_map(line);
        for line in lines.filter(|it| it.variant.is_none() && it.role.tells()) {
            line.variant = Some(VariantTag { index: 0, label: letter.to_owned() });
        }
    } else {
        items.retain(|item| matches!(item, Item::Curve(..)));
    }
    // What both have in common belongs to neither.
    items.retain(|item| {
        let mut own = picture.items.iter_mut();
        let common = own.find(|own| alike(own, item, picture.window));
        let differs = common.is_none();
        if let Some(line) = common.and_then(line) {
            line.variant = None;
        }
        differs
    });
    for mut caption in theirs.captions {
        caption.or_at.iter_mut().chain([&mut caption.at]).for_each(|at| *at = brought(*at, by));
        if caption.role == Role::Special && !caption.short.starts_with(label) {
            for text in [&mut caption.long, &mut caption.short] {
                *text = format!("{label} {text}").into();
            }
        }
        let told = caption.short.starts_with(label);
        if told && picture.captions.iter().all(|own| own.at != caption.at) {
            picture.captions.push(Caption { role: Role::Ghost, ..caption });
        }
    }
    // Over what is shaded, under the lines of the present point.
    let is_area = |item: &mut Item| line(item).is_none() && !matches!(item, Item::Marks(_));
    let areas = picture.items.iter_mut().rposition(is_area);
    let behind = areas.map_or(0, |last| last + 1);
    picture.items.splice(behind..behind, items);
}

/// A part of the picture of the other point in the units of the present one; `None` for what would hide that, or is only
/// there to be read against.
fn beside<'a>(item: Item<'a>, by: [f64; 2], tag: (usize, &'static str)) -> Option<Item<'a>> {
    let at = |at: Point| brought(at, by);
    let ([across, up], pale) = (by, |line| pale(line, tag));
    Some(match item {
        Item::Curve(line, points) => Item::Curve(pale(line)?, points.into_iter().map(at).collect()),
        Item::Graph(line, value) => {
            let value = move |x: f64| value(x / across).map(|y| up * y);
            Item::Graph(pale(line)?, Box::new(value))
        }
        Item::Upright(line, x) => Item::Upright(pale(line)?, across * x),
        Item::Marks(marks) => {
            let at = marks.at.iter().copied().map(at).collect();
            let name = format!("{}, {}", marks.name, tag.1).into();
            Item::Marks(Marks { role: Role::Ghost, name, brief: "", at, ..marks })
        }
        _ => return None,
    })
}

fn brought(Point { x, y }: Point, [across, up]: [f64; 2]) -> Point {
    Point { x: across * x, y: up * y }
}

/// A line of the other point; `None` for one without a name.
fn pale(line: LineStyle, (index, label): (usize, &'static str)) -> Option<LineStyle> {
    let role = line.role.paler();
    let dash = match line.dash {
        Dash::Thick => Dash::Solid,
        Dash::Solid => Dash::Dotted,
        Dash::Dashed => Dash::Sparse,
        broken => broken,
    };
    let named = !line.name.is_empty();
    // The legend of a screen has room for what is asked of both points.
    let own = line.brief.as_ref().unwrap_or(&line.name);
    let told = if TOLD.contains(&&**own) {
        format!("{own}, {label}")
    } else {
        String::new()
    };
    let name = format!("{}, {label}", line.name).into();
    let tag = VariantTag { index, label: String::new() };
    named.then(|| LineStyle { name, role, dash, ..line.briefly(told) }.of(&tag))
}

/// Whether two parts of a picture are the same, however they are drawn.
fn alike(own: &Item, other: &Item, window: Window) -> bool {
    /// Places at which functions are compared.
    const PLACES: u32 = 50;
    let bits = |at: &Point| [at.x, at.y].map(f64::to_bits);
    match (own, other) {
        (Item::Curve(_, own), Item::Curve(_, other)) => {
            own.iter().map(bits).eq(other.iter().map(bits))
        }
        (Item::Graph(_, own), Item::Graph(_, other)) => {
            let same = |x| own(x).map(f64::to_bits) == other(x).map(f64::to_bits);
            window.x.evenly(PLACES).all(same)
        }
        (Item::Upright(_, own), Item::Upright(_, other)) => own == other,
        (Item::Marks(own), Item::Marks(other)) => (own.mark, &own.at) == (other.mark, &other.at),
        _ => false,
    }
}

fn line<'item>(item: &'item mut Item) -> Option<&'item mut LineStyle> {
    match item {
        Item::Curve(line, _) | Item::Graph(line, _) | Item::Upright(line, _) => Some(line),
        _ => None,
    }
}
