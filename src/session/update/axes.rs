//! Commands that change what stands on the diagram's axes.

use super::inform;
use crate::oscillator::Symbol;
use crate::scene::{ABSCISSAE, ORDINATES, Span, Window};
use crate::session::message::Effect;
use crate::session::state::{Framing, Plot, Session};

/// Room beside today's value where it lies outside of the values first looked at, as a factor.
const ROOM: f64 = 1.25;

/// Draws the diagram over the next parameter, around its end; the branch is another one.
pub fn next_abscissa(session: &mut Session) -> Vec<Effect> {
    let at = ABSCISSAE.iter().position(|(symbol, _)| *symbol == session.abscissa).unwrap_or(0);
    let (symbol, range) = ABSCISSAE[(at + 1) % ABSCISSAE.len()];
    session.abscissa = symbol;
    let x = first_range(session, symbol, range);
    reframe(session, x);
    inform(session, format!("over {}: {}", symbol.spec().name, symbol.spec().meaning));
    Vec::new()
}

/// Shows the next property of the cycles, around its end; the branch is the same.
pub fn next_ordinate(session: &mut Session) -> Vec<Effect> {
    let row = &ORDINATES[(session.ordinate as usize + 1) % ORDINATES.len()];
    session.ordinate = row.ordinate;
    reframe(session, session.diagram.window.x);
    inform(session, format!("{}: {}", row.label, row.meaning));
    Vec::new()
}

/// The values of a parameter that are looked at first: the scene's, else the usual ones, and in any case
/// today's.
fn first_range(session: &Session, symbol: Symbol, usual: [f64; 2]) -> Span {
    if symbol == session.scene.abscissa {
        return session.scene.diagram.x;
    }
    let today = ROOM * session.value(symbol);
    Span::covering([usual[0], usual[1], today]).unwrap_or(session.diagram.window.x)
}

/// The scene's window where the axes are the scene's, else one fitted to the branch.
fn reframe(session: &mut Session, x: Span) {
    let scene = &session.scene;
    let scenes = (scene.abscissa, scene.ordinate) == (session.abscissa, session.ordinate);
    session.diagram = if scenes && x == scene.diagram.x {
        Plot::new(scene.diagram, scene.diagram)
    } else {
        let window = Window { x, y: session.diagram.window.y };
        Plot { window, framing: Framing::Fitting, cursor: None }
    };
}
