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
pub fn entries(pictures: &[Picture]) -> Vec<LegendEntry> {
    let mut entries: Vec<LegendEntry> = Vec::new();
    for picture in pictures {
        for entry in picture.items.iter().filter_map(|item| entry(picture, item)) {
            // An area whose edge has its name needs no entry.
            let known =
                |other: &LegendEntry| (other.role, &other.text) == (entry.role, &entry.text);
            if !entry.text.is_empty() && !entries.iter().any(known) {
                entries.push(entry);
            }
        }
    }
    entries
}

fn entry(picture: &Picture, item: &Item) -> Option<LegendEntry> {
    let sample = match item {
        Item::Marks(Marks { mark, role, brief, .. }) => {
            return Some(LegendEntry {
                sample: LegendSample::Point(*mark),
                role: *role,
                text: (*brief).to_owned(),
            });
        }
        Item::Arrows(role, _) => {
            let text = "flow".to_owned();
            return Some(LegendEntry { sample: LegendSample::Arrow, role: *role, text });
        }
        Item::Bar(_, from, to) if from == to => LegendSample::Spot,
        Item::Bar(..) => LegendSample::Line(Dash::Thick),
        Item::Shade(..) | Item::Beyond(..) | Item::Columns(..) | Item::Rows(..) => {
            LegendSample::Shade
        }
        Item::Curve(line, _)
        | Item::Path(line, _)
        | Item::Graph(line, _)
        | Item::Upright(line, _) => LegendSample::Line(line.dash),
        Item::Texture(_) | Item::Caption(_) => return None,
    };
    let line = item.seen(picture.window)?;
    let text = line.brief.unwrap_or(&line.name).to_owned();
    Some(LegendEntry { sample, role: line.role, text })
}
