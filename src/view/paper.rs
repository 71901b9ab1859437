//! The page of the paper: its claims with their verdicts, and the numbers of the selected one.

use ratatui::text::Line;

use super::Look;
use super::list::{ListContent, TEXT};
use crate::numerics::cells;
use crate::paper::{Claim, ClaimResult, Verdict};
use crate::picture::Role;
use crate::session::{List, Session};
use crate::words::{claim, significant};

/// The list, section by section.
pub(super) fn content(session: &Session, list: &List, look: &Look) -> ListContent {
    let found = session.claim_rows(list);
    let mut content =
        ListContent { below: TEXT, ..ListContent::new("the paper against computation") };
    for (claim, examined) in &found {
        let (verdict, role) = match examined {
            Some(examined) => (claim::verdict(examined), role(examined)),
            None => ("computing".to_owned(), Role::Quiet),
        };
        let cells = [
            look.span(format!("{:<14} ", claim.equation), Role::Key),
            look.span(format!("{verdict:<17} "), role),
            look.span(claim.statement, Role::Text),
        ];
        content.row(heading(claim.section), cells);
    }
    if let Some((claim, examined)) = found.get(list.selected) {
        content.about = about(claim, *examined, look);
    }
    if !session.examined().is_empty() {
        let summary = claim::summary(session.examined());
        content.about.push(Line::styled(summary, look.style(Role::Quiet)));
    }
    content
}

/// What stands above the claims of a section.
fn heading(section: &'static str) -> &'static str {
    let mut rows = include_str!("../../assets/sections.txt").lines().filter_map(cells);
    rows.find(|[number, _]| *number == section).map_or(section, |[_, heading]| heading)
}

/// What holds is quiet, what does not is loud.
fn role(examined: &ClaimResult) -> Role {
    match examined.verdict() {
        Some(Verdict::Agrees | Verdict::Approximates { .. }) => Role::Text,
        Some(Verdict::Corrected { .. } | Verdict::InPart) => Role::Warning,
        Some(Verdict::False) => Role::Failure,
        None => Role::Quiet,
    }
}

/// The claim in full, its numbers, and the scene that shows it.
fn about(claim: &Claim, examined: Option<&ClaimResult>, look: &Look) -> Vec<Line<'static>> {
    let text = |text: String| Line::styled(text, look.style(Role::Text));
    let mut lines = vec![text(format!("{}: {}", claim.equation, claim.statement))];
    match examined.map(|examined| &examined.evidence) {
        None => {}
        Some(Err(reason)) => lines.push(text(format!("not computed: {reason}"))),
        Some(Ok(evidence)) => {
            let number = |name: &str, value: Option<f64>| {
                value.map(|value| format!("{name} {}", significant(value, 10)))
            };
            let error = Some(evidence.computed.error).filter(|error| *error > 0.0);
            let parts = [
                number("paper", evidence.paper),
                number("corrected", evidence.corrected),
                number("computed", Some(evidence.computed.value)),
                error.map(|error| format!("known to {}", significant(error, 1))),
            ];
            lines.push(text(parts.into_iter().flatten().collect::<Vec<_>>().join(", ")));
            let judged = [
                &format!("compared with: {}", claim.basis),
                &claim::sense(evidence.sense),
                &evidence.place,
            ];
            let judged = judged.into_iter().filter(|text| !text.is_empty());
            let judged: Vec<&str> = judged.map(String::as_str).collect();
            lines.push(Line::styled(judged.join("; "), look.style(Role::Quiet)));
        }
    }
    if let Some(scene) = claim.scene {
        lines.push(Line::styled(format!("scene {scene}"), look.style(Role::Quiet)));
    }
    lines
}
