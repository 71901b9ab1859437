//! Texts of a scene, reduced to the parts that hold for what is on show.
//!
//! A text has parts in brackets, `[unstable stable grows: The swings grow onto the outer cycle.]`. Such a part holds if all
//! the conditions before its colon hold. A condition is the name of one such as `grows`, a comparison such as `D<0`, or the
//! name of a layer, which must be on show. Text outside of brackets always holds.

use std::ops::Bound::{self, Excluded, Included, Unbounded};
use std::ops::RangeBounds;

use strum::EnumString;

use super::scene::Scene;
use super::views::Layer;
use crate::model::{Group, Knob};
use crate::numerics::named;

/// A condition of a part of a text, by its name in scene files.
#[derive(Clone, Copy, Debug, PartialEq, EnumString)]
#[strum(serialize_all = "lowercase")]
pub enum TextCondition {
    /// The numbers are those that the scene opens with.
    Here,
    /// The numbers are those of the machine, at any speed of its belt.
    Path,
    /// The plots show what they showed when the scene opened.
    Opened,
    /// There is an unstable cycle.
    Unstable,
    /// There is a stable cycle.
    Stable,
    /// A separatrix, a motion that just escapes, borders the basin.
    Separatrix,
    /// Every motion comes to rest.
    Safe,
    /// The motion on show comes to rest.
    Rests,
    /// The motion on show grows, onto a stable cycle or without bound.
    Grows,
    /// A cycle of the whole model sticks to the belt.
    Sticks,
    /// A number of the motion on show lies within these bounds.
    #[strum(disabled)]
    Compares(Knob, (Bound<f64>, Bound<f64>)),
    /// The layer is on, in a plot on show.
    #[strum(disabled)]
    Shows(Layer),
}

/// A text without the parts whose conditions do not hold. Brackets without conditions are kept as they are.
pub fn said(text: &str, holds: impl Fn(TextCondition) -> bool) -> String {
    let mut out = String::new();
    let mut rest = text;
    while let Some((before, after)) = rest.split_once('[') {
        out.push_str(before);
        let part = after.split_once(']').and_then(|(part, after)| {
            let (names, said) = part.split_once(": ")?;
            Some((conditions(names)?, said, after))
        });
        let Some((conditions, said, after)) = part else {
            out.push('[');
            rest = after;
            continue;
        };
        rest = after;
        if conditions.into_iter().all(&holds) {
            out.push_str(said);
        } else if out.ends_with(' ') || out.is_empty() {
            // Also removes one of the two blanks around the part.
            rest = after.trim_start();
        }
    }
    out.push_str(rest);
    out.truncate(out.trim_end().len());
    out
}

/// A text as its scene opens; what must be computed is taken not to hold.
pub fn said_by(scene: &Scene, text: &str) -> String {
    said(text, |condition| match condition {
        TextCondition::Here | TextCondition::Path | TextCondition::Opened => true,
        TextCondition::Shows(layer) => scene.layers.contains(&layer),
        TextCondition::Compares(symbol, bounds) => bounds.contains(&scene.problem.get(symbol)),
        _ => false,
    })
}

/// The conditions with these names; `None` if a name is unknown.
fn conditions(names: &str) -> Option<Vec<TextCondition>> {
    let known = |name: &str| {
        let plain = name.parse().ok().or_else(|| comparison(name));
        plain.or_else(|| named(name).map(TextCondition::Shows))
    };
    let found: Option<Vec<_>> = names.split_whitespace().map(known).collect();
    found.filter(|conditions| !conditions.is_empty())
}

/// A comparison such as `D<0`.
fn comparison(text: &str) -> Option<TextCondition> {
    // One that begins with another stands before it.
    let signs = ["<=", ">=", "<", ">", "="];
    let split = |sign| Some((sign, text.split_once(sign)?));
    let (sign, (name, number)) = signs.into_iter().find_map(split)?;
    let number = number.parse().ok()?;
    let bounds = match sign {
        "<=" => (Unbounded, Included(number)),
        ">=" => (Included(number), Unbounded),
        "<" => (Unbounded, Excluded(number)),
        ">" => (Excluded(number), Unbounded),
        _ => (Included(number), Included(number)),
    };
    Some(TextCondition::Compares(Knob::named(name, &[Group::Motion]).ok()?, bounds))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_stand_where_all_their_conditions_hold() {
        let text =
            "Always. [unstable stable grows: It grows.] [safe: It rests.] End [0, 1] [x: y].";
        let with = |conditions: &[TextCondition]| said(text, |one| conditions.contains(&one));
        assert_eq!(with(&[]), "Always. End [0, 1] [x: y].");
        assert_eq!(with(&[TextCondition::Safe]), "Always. It rests. End [0, 1] [x: y].");
        assert_eq!(with(&[TextCondition::Unstable, TextCondition::Grows]), with(&[]));
        let all = [TextCondition::Unstable, TextCondition::Stable, TextCondition::Grows];
        assert_eq!(with(&all), "Always. It grows. End [0, 1] [x: y].");
        assert_eq!(said("[safe: Gone.] Left.", |_| false), "Left.");
        let text = "[D<0: Fed.] [D>=0 D3=0.5: Not fed.] [bands: Dotted.] [E<0: none] [D<x: none]";
        let at = |d: f64| {
            said(text, |condition| match condition {
                TextCondition::Compares(Knob::D3, ..) => true,
                TextCondition::Compares(_, bounds) => bounds.contains(&d),
                condition => condition == TextCondition::Shows(Layer::Bands),
            })
        };
        assert_eq!(at(-0.1), "Fed. Dotted. [E<0: none] [D<x: none]");
        assert_eq!(at(0.0), "Not fed. Dotted. [E<0: none] [D<x: none]");
        assert_eq!(said("All rest[unstable: , but some]. [safe: Yes.]", |_| false), "All rest.");
    }
}
