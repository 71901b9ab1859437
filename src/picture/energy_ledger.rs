//! The energy ledger: a bar for the work of each source, over one turn of each cycle and along the motion.
//!
//! Bars are fractions of the largest work of their owner, numbers are energies in the units of the model.

use super::{Dash, LineStyle, Mark, Picture, Role};
use crate::numerics::real;
use crate::scene::Span;
use crate::session::Session;
use crate::session::ledger::{LedgerLine, Owner};
use crate::words::significant;

/// The ledger in a figure: a bar for each work, with its name and number.
pub fn draw(picture: &mut Picture, session: &Session) {
    let lines = session.ledger();
    // Lines have names of their own.
    picture.axes("part of the largest work", "");
    picture.window.y = Span::new(middle(lines.len()), 0.0).unwrap_or(Span::known(-1.0, 0.0));
    picture.reading = picture.cursor.map(|cursor| {
        let near = |(line, _): &(usize, &LedgerLine)| (middle(*line) - cursor.y).abs() <= 0.5;
        let found = lines.iter().enumerate().find(near);
        found.map_or_else(String::new, |(_, entry)| reading(entry))
    });
    picture.upright(LineStyle::guide(), 0.0);
    for (line, entry) in lines.iter().enumerate() {
        let y = middle(line);
        if let LedgerLine::Work { source, work, part, so_far } = entry {
            let role = if *work < 0.0 { Role::Loss } else { Role::Gain };
            let line = LineStyle::new(*source, role, Dash::Thick).captioned();
            picture.curve(line, [[0.0, y], [*part, y]]);
            if let Some(x) = *so_far {
                picture.mark(Mark::Head, [x, y], Role::Cursor);
            }
        }
        picture.caption([picture.window.x.at(0.02), y], reading(entry), Role::Text);
    }
}

/// The height in the middle of a line.
fn middle(line: usize) -> f64 {
    -(real(line)) - 0.5
}

/// A line in numbers.
pub fn reading(entry: &LedgerLine) -> String {
    match entry {
        LedgerLine::Title(Owner::Motion(_, None)) => "motion".to_owned(),
        LedgerLine::Title(Owner::Motion(_, Some(number))) => format!("motion {number}"),
        LedgerLine::Title(Owner::Cycle(cycle)) => format!("q_max {}", significant(cycle.q_max, 6)),
        LedgerLine::Work { source, work, .. } => format!("{source} {}", significant(*work, 6)),
        LedgerLine::Residual(part) => format!("error {}", significant(*part, 2)),
    }
}
