//! The point of the branch that is held, in numbers.

use super::Look;
use crate::branch::SpecialKind;
use crate::portrait::Cycle;
use crate::session::{BranchStop, Session};
use crate::words::number::significant;
use crate::words::stability;

/// Significant digits: as many as fit, at most as many as distinguish special points from others.
const DIGITS: [usize; 5] = [10, 8, 6, 5, 4];

/// What is held, in a line of at most `width` columns if that is possible; `None` where nothing is.
pub fn reading(session: &Session, look: &Look, width: u16) -> Option<String> {
    let held = session.held?;
    let name = session.plots[session.plot].axes.abscissa.spec().name;
    let shown = session.shown(session.plot);
    // The present values stand in the parameter pane.
    let other = shown.get(held.variant).filter(|shown| !shown.present);
    let label = other.map_or("", |shown| shown.label.as_str());
    let line = |digits: &usize| sentence(name, label, &held, *digits, look.symbols().dot);
    // The status line begins with a blank and a symbol.
    let fits = |text: &String| text.chars().count() + 4 <= usize::from(width);
    DIGITS.iter().map(line).find(fits).or_else(|| DIGITS.last().map(line))
}

fn sentence(name: &str, label: &str, held: &BranchStop, digits: usize, dot: &str) -> String {
    let mut parts = vec![format!("{name} {}", significant(held.value, digits))];
    // The values that the variant holds, where the diagram shows several.
    parts.extend(Some(label.to_owned()).filter(|label| !label.is_empty()));
    if let Some(kind) = held.special {
        parts.insert(0, kind.name(held.cycle.as_ref()).to_owned());
    }
    match &held.cycle {
        None => parts.push("the cycle is infinite".to_owned()),
        Some(cycle) => {
            // Neither at a fold nor where the cycle vanishes.
            if !matches!(held.special, Some(SpecialKind::Fold | SpecialKind::Hopf)) {
                parts.insert(0, stability(cycle.stable).to_owned());
            }
            let short = digits.min(5);
            parts.push(format!(
                "q {} .. {}",
                significant(cycle.q_min, short),
                significant(cycle.q_max, short)
            ));
            parts.push(format!("period {}", significant(cycle.period, short)));
            parts.push(format!("multiplier {}", multiplier(cycle)));
        }
    }
    parts.join(&format!(" {dot} "))
}

/// The multiplier, as a power of e where it is too large or too small to be read.
fn multiplier(cycle: &Cycle) -> String {
    match cycle.multiplier {
        Some(multiplier) if multiplier > 0.0 => significant(multiplier, 4),
        _ => format!("e^{}", significant(cycle.log_multiplier, 4)),
    }
}
