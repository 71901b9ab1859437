//! What the legend of the screen explains: everything with a name that is seen, once.

use super::{Dash, Item, Mark, Marks, Picture, Role};

/// What a sample in the legend shows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LegendSample {
    Line(Dash),
    /// The single point that a bar can be.
    Spot,
    Shade,
    Arrow,
    Point(Mark),
}

#[derive(Clone, Debug, PartialEq)]
pub struct LegendEntry {
    pub sample: LegendSample,
    /// What it stands for, as far as its colour goes.
    pub role: Role,
    pub text: String,
}

/// What these pictures have to explain, in the order in which they are painted.
pub fn entries<'a>(pictures: impl IntoIterator<Item = &'a Picture<'a>>) -> Vec<LegendEntry> {
    let of = |picture: &'a Picture| picture.items.iter().filter_map(move |it| entry(picture, it));
    distinct(pictures.into_iter().flat_map(of).filter(|entry| !entry.text.is_empty()))
}

/// Entries of one colour and text once: an area whose edge has its name needs no entry of its own.
pub fn distinct(entries: impl Iterator<Item = LegendEntry>) -> Vec<LegendEntry> {
    let mut kept: Vec<LegendEntry> = Vec::new();
    for entry in entries {
        if !kept.iter().any(|it| (it.role, &it.text) == (entry.role, &entry.text)) {
            kept.push(entry);
        }
    }
    kept
}

fn entry(picture: &Picture, item: &Item) -> Option<LegendEntry> {
    let told = |sample, role, text: &str| LegendEntry { sample, role, text: text.to_owned() };
    let sample = match item {
        Item::Marks(Marks { mark, role, brief, .. }) => {
            return Some(told(LegendSample::Point(*mark), *role, brief));
        }
        Item::Arrows(_) => return Some(told(LegendSample::Arrow, Role::Field, "flow")),
        Item::Curve(_, points) if matches!(points[..], [from, to] if from == to) => {
            LegendSample::Spot
        }
        Item::Shade(..) | Item::Beyond(..) | Item::Columns(..) | Item::Rows(..) => {
            LegendSample::Shade
        }
        Item::Curve(line, _) | Item::Graph(line, _) | Item::Upright(line, _) => {
            LegendSample::Line(line.dash)
        }
        Item::Texture(_) => return None,
    };
    let line = item.seen(picture.window)?;
    Some(told(sample, line.role, line.brief.as_ref().unwrap_or(&line.name)))
}

/// What an item is called, as in the legend or where that leaves it out by its own name, and what it stands for as far as
/// its colour goes.
pub fn called(picture: &Picture, item: &Item) -> Option<(String, Role)> {
    let LegendEntry { role, text, .. } = entry(picture, item)?;
    let own = match item {
        Item::Marks(Marks { name, .. }) => Some(name),
        item => item.seen(picture.window).map(|line| &line.name),
    };
    Some((if text.is_empty() { own?.to_string() } else { text }, role))
}
