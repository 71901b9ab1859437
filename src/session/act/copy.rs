//! Copies: the pane in focus as a command line for the shell.

use crate::flow::Problem;
use crate::flow::method::Dial;
use crate::oscillator::{PARAMETERS, Symbol};
use crate::scene::View;
use crate::session::effect::Effect;
use crate::session::state::session::Session;
use crate::session::state::step_size::shortest;

/// Points of a copied branch: as many as a wide plot has columns.
const BRANCH_POINTS: usize = 200;

/// Copies the command line that gives the numbers of the pane in focus.
pub fn command(session: &mut Session) -> Vec<Effect> {
    vec![Effect::Copy(command_line(session))]
}

/// The command line that gives the numbers of the pane in focus. It writes out every number, so that
/// it means the same whatever scenes there are.
#[must_use]
pub fn command_line(session: &Session) -> String {
    let Problem { until, method, tolerance, step, epsilon, .. } = session.problem;
    let diagram = session.focused().filter(|plot| plot.view == View::Diagram);
    let abscissa = diagram.map(|plot| plot.axes.abscissa);
    let mut line = format!("hopfscope {}", if diagram.is_some() { "branch" } else { "trajectory" });
    for row in &PARAMETERS {
        let unused = matches!(row.symbol, Symbol::Q0 | Symbol::V0) || Some(row.symbol) == abscissa;
        if !(diagram.is_some() && unused) {
            line += &format!(" --set {}={}", row.name, shortest(session.value(row.symbol)));
        }
    }
    if let Some(plot) = diagram {
        let span = plot.window.x;
        let (from, to) = (shortest(span.from()), shortest(span.to()));
        line += &format!(" --over {}={from}:{to}:{BRANCH_POINTS}", plot.axes.abscissa.spec().name);
    } else {
        line += &format!(" --until {} --method {method}", shortest(until));
    }
    line + &match method.spec().dial {
        Dial::Step if diagram.is_none() => format!(" --step {}", shortest(step)),
        Dial::Epsilon if diagram.is_none() => format!(" --epsilon {}", shortest(epsilon)),
        _ => format!(" --tol {}", shortest(tolerance)),
    }
}
