//! The lines that say it in words: what became of the motion, how it was computed, what that cost.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::Span;

use super::look::{Look, Role};
use super::number::{count, duration, significant};
use super::pane;
use crate::flow::{Outcome, Trajectory};
use crate::scene::{Layer, Slot};
use crate::session::Session;

/// Draws the title line: what the scene is, and its name.
pub fn title(area: Rect, session: &Session, look: &Look, buffer: &mut Buffer) {
    let left = Span::styled(format!(" {}", session.scene.title), look.style(Role::Title));
    let right = Span::styled(format!("{} ", session.scene.name), look.style(Role::Quiet));
    pane::line(area, 0, left, right, buffer);
}

/// Draws the status lines: the outcome first, then method, cost and error.
pub fn draw(area: Rect, session: &Session, look: &Look, buffer: &mut Buffer) {
    let (text, role) = outcome(session);
    let busy = if session.is_busy() { "computing " } else { "" };
    let left = Span::styled(format!(" {text}"), look.style(role));
    pane::line(area, 0, left, Span::styled(busy, look.style(Role::Warning)), buffer);

    let quiet = look.style(Role::Quiet);
    let dot = look.symbols().dot;
    let spent = session.answers.get(&Slot::Trajectory).map_or(0.0, |answered| answered.seconds);
    let work = session.trajectory().map(|found| work(found, spent).join(&format!(" {dot} ")));
    let left = Span::styled(format!(" {}", work.unwrap_or_default()), quiet);
    pane::line(area, 1, left, Span::styled(format!("{} ", price(session)), quiet), buffer);
}

/// What became of the motion, in a sentence.
fn outcome(session: &Session) -> (String, Role) {
    if !session.layers.contains(&Layer::Trajectory) {
        return ("the motion is not shown".into(), Role::Quiet);
    }
    if let Some(failure) = session.failure(Slot::Trajectory) {
        return (format!("no motion: {failure}"), Role::Failure);
    }
    match session.trajectory() {
        None => ("computing the motion".into(), Role::Quiet),
        Some(found) => (sentence(found), Role::Text),
    }
}

/// How a motion ended, in a sentence.
#[must_use]
pub fn sentence(motion: &Trajectory) -> String {
    let swings = match motion.crossings.len() {
        1 => "1 half swing".to_owned(),
        number => format!("{number} half swings"),
    };
    let three = |value| significant(value, 3);
    match motion.outcome {
        Outcome::Captured { q, .. } if motion.crossings.is_empty() => {
            format!("at rest at q = {} from the start", three(q))
        }
        Outcome::Captured { tau, q } => {
            format!("captured at q = {} after {swings}, tau = {}", three(q), three(tau))
        }
        Outcome::Moving { tau, q, v } => format!(
            "still moving after {swings}: q = {}, v = {} at tau = {}",
            three(q),
            three(v),
            three(tau)
        ),
        Outcome::Escaped { tau } => {
            format!("escapes at tau = {} after {swings}", significant(tau, 4))
        }
        Outcome::GaveUp { tau, reason } => {
            format!("gave up at tau = {} after {swings}: {reason}", three(tau))
        }
    }
}

/// How a motion was computed, what it cost, and its measured error.
fn work(motion: &Trajectory, seconds: f64) -> Vec<String> {
    let mut parts = vec![
        format!("{} {}", motion.method, significant(motion.problem.tolerance, 2)),
        format!("{} evaluations", count(motion.cost.evaluations)),
        duration(seconds),
    ];
    if let Some(ledger) = motion.ledger {
        let largest = ledger.start.max(ledger.end);
        let error = if largest > 0.0 { (ledger.residual / largest).abs() } else { 0.0 };
        parts.push(format!("energy error {}", significant(error, 1)));
    }
    parts
}

/// What the last key recomputed, and what that cost.
fn price(session: &Session) -> String {
    let price = &session.price;
    if price.recomputed.is_empty() {
        return String::new();
    }
    let name = |slot| match slot {
        Slot::Trajectory => "motion",
        Slot::Cycles => "cycles",
        Slot::Branch => "branch",
    };
    let names: Vec<&str> = price.recomputed.iter().map(|part| name(part.slot)).collect();
    format!("{}: {}, {}", names.join("+"), count(price.evaluations()), duration(price.seconds()))
}
