//! A beside B: what a plot shows of the point that the present one is compared with.
//!
//! That is the picture of a session at the other point, as far as it differs: its lines are paler and more broken, and
//! beside lines of both stand their letters. What a machine of other units does is brought to those of the present one.

use super::{Caption, Dash, Item, LineStyle, Mark, Marks, Picture, Role, Room};
use crate::scene::{Point, View, Window};
use crate::session::{Letter, Session, VariantTag};

/// Lines that have a letter.
const LETTERED: [Role; 6] =
    [Role::Stable, Role::Unstable, Role::Velocity, Role::Energy, Role::Map, Role::Current];

/// Adds what a plot shows of the other point, behind the present one.
pub fn add<'a>(picture: &mut Picture<'a>, session: &'a Session, index: usize, room: Room) {
    let Some(other) = session.beside(index) else { return };
    let theirs = super::alone(other, index, room);
    let (view, letters) = (session.plots[index].view, session.letters());
    let style = Beside { letter: letters.map(|both| both[1]), place: session.shown(index).len() };
    let by = session.units_beside(index);
    let window = picture.window;
    let lettered = |line: &LineStyle| LETTERED.contains(&line.role).then(|| line.name.to_string());
    let lettered: Vec<String> = theirs.items.iter().filter_map(line).filter_map(lettered).collect();
    let items = theirs.items.into_iter().filter(|item| by == [1.0; 2] || keeps_units(view, item));
    let items = items.filter_map(|item| style.item(item, by));
    let items = items.filter(|item| !picture.items.iter().any(|own| alike(own, item, window)));
    let items: Vec<Item> = items.collect();
    if let Some([present, pinned]) = letters {
        for caption in theirs.captions.into_iter().filter(|it| it.role == Role::Special) {
            if !picture.captions.contains(&caption) {
                picture.captions.push(Caption { role: Role::Ghost, ..caption });
            }
        }
        let others: Vec<&str> = items.iter().filter_map(name).collect();
        for line in picture.items.iter_mut().filter_map(line_mut) {
            let tag = line.variant.get_or_insert_default();
            if tag.label.is_empty() && others.contains(&&*line.name) {
                present.name().clone_into(&mut tag.label);
            }
        }
        let own = std::mem::take(&mut picture.items);
        if !items.is_empty() {
            letter(picture, &own, present, &lettered);
            letter(picture, &items, pinned, &lettered);
        }
        picture.items = own;
    }
    // Over what is shaded, under the lines of the present point.
    let is_area = |item: &Item| {
        !matches!(item, Item::Curve(..) | Item::Graph(..) | Item::Upright(..) | Item::Marks(_))
    };
    let behind = picture.items.iter().rposition(is_area).map_or(0, |last| last + 1);
    picture.items.splice(behind..behind, items);
}

/// Whether the heights of a line are lengths where the units differ: over time those of displacements alone are.
fn keeps_units(view: View, item: &Item) -> bool {
    view != View::TimeSeries || name(item).is_some_and(|name| name.starts_with("displacement"))
}

/// How lines of the other point look.
struct Beside {
    /// Its name; `None` for a point that was left for a mark.
    letter: Option<Letter>,
    /// Its place among the variants of the picture.
    place: usize,
}

impl Beside {
    /// A part of its picture in the units of the present point; `None` for what would hide the present one.
    fn item<'a>(&self, item: Item<'a>, [across, up]: [f64; 2]) -> Option<Item<'a>> {
        let at = |at: Point| Point { x: across * at.x, y: up * at.y };
        Some(match item {
            Item::Curve(line, points) => {
                Item::Curve(self.line(line)?, points.into_iter().map(at).collect())
            }
            Item::Graph(line, value) => {
                let value = move |x: f64| value(x / across).map(|y| up * y);
                Item::Graph(self.line(line)?, Box::new(value))
            }
            Item::Upright(line, x) => Item::Upright(self.line(line)?, across * x),
            Item::Marks(marks) => {
                let (letter, places) = (self.letter?.name(), marks.at.iter().copied().map(at));
                let name = format!("{}, {letter}", marks.name).into();
                Item::Marks(Marks {
                    role: Role::Ghost,
                    name,
                    brief: "",
                    at: places.collect(),
                    ..marks
                })
            }
            _ => return None,
        })
    }

    /// A line of it; `None` for what is only there to be read against.
    fn line(&self, line: LineStyle) -> Option<LineStyle> {
        if line.name.is_empty() {
            return None;
        }
        let (role, kind) = match line.role {
            Role::Stable | Role::GhostStable => (Role::GhostStable, 1),
            Role::Unstable | Role::GhostUnstable => (Role::GhostUnstable, 2),
            _ => (Role::Ghost, 0),
        };
        let dash = match line.dash {
            Dash::Thick => Dash::Solid,
            Dash::Solid => Dash::Dotted,
            Dash::Dashed => Dash::Sparse,
            broken => broken,
        };
        let (label, brief) = match self.letter {
            Some(Letter::A) => ("A", ["A", "A: stable", "A: unstable"][kind]),
            Some(Letter::B) => ("B", ["B", "B: stable", "B: unstable"][kind]),
            None => ("the point left", "the point left"),
        };
        let tag = VariantTag { index: self.place, label: label.to_owned() };
        Some(LineStyle { role, dash, ..line.briefly(brief) }.of(&tag))
    }
}

/// Whether two parts of a picture are the same, however they are drawn.
fn alike(own: &Item, other: &Item, window: Window) -> bool {
    /// Places at which functions are compared.
    const PLACES: u32 = 50;
    let same = name(own) == name(other);
    match (own, other) {
        (Item::Curve(_, own), Item::Curve(_, other)) => {
            let bits = |at: &Point| [at.x, at.y].map(f64::to_bits);
            same && own.iter().map(bits).eq(other.iter().map(bits))
        }
        (Item::Graph(_, own), Item::Graph(_, other)) => {
            let bits = |value: Option<f64>| value.map(f64::to_bits);
            same && window.x.evenly(PLACES).all(|x| bits(own(x)) == bits(other(x)))
        }
        (Item::Upright(_, own), Item::Upright(_, other)) => same && own == other,
        (Item::Marks(own), Item::Marks(other)) => (own.mark, &own.at) == (other.mark, &other.at),
        _ => false,
    }
}

fn line<'it>(item: &'it Item) -> Option<&'it LineStyle> {
    match item {
        Item::Curve(line, _) | Item::Graph(line, _) | Item::Upright(line, _) => Some(line),
        _ => None,
    }
}

fn line_mut<'it>(item: &'it mut Item) -> Option<&'it mut LineStyle> {
    match item {
        Item::Curve(line, _) | Item::Graph(line, _) | Item::Upright(line, _) => Some(line),
        _ => None,
    }
}

fn name<'it>(item: &'it Item) -> Option<&'it str> {
    line(item).map(|line| &*line.name)
}

/// Writes the letter of a point where its motions end, and beside one of its lines of each of these names that has it.
fn letter(picture: &mut Picture, items: &[Item], letter: Letter, names: &[String]) {
    /// Places of a function that it is written beside.
    const PLACES: u32 = 60;
    let (window, letter) = (picture.window, letter.name());
    let mut named: Vec<&str> = Vec::new();
    for item in items {
        if let Item::Marks(Marks { mark: Mark::Head | Mark::Rest, at, role, .. }) = item {
            at.iter().for_each(|at| picture.caption(*at, letter, *role));
        }
        let Some(LineStyle { name, role, variant: Some(tag), .. }) = line(item) else { continue };
        if tag.label != letter || named.contains(&&**name) || !names.iter().any(|it| it == name) {
            continue;
        }
        named.push(name);
        match item {
            Item::Curve(_, points) => picture.name_curve(points, letter, letter, *role),
            Item::Graph(_, value) => {
                let at = |x| Some(Point { x, y: value(x)? });
                let points: Vec<Point> = window.x.evenly(PLACES).filter_map(at).collect();
                picture.name_curve(&points, letter, letter, *role);
            }
            Item::Upright(_, x) => picture.caption([*x, window.y.to()], letter, *role),
            _ => {}
        }
    }
}
