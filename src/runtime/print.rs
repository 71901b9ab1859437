//! Sessions computed for print: with as many points on their curves as paper can show.

use crate::flow::{Limits, Reason};
use crate::scene::answer::{Fineness, answer_for};
use crate::scene::{Answered, Request, Slot};
use crate::session::{Msg, Session, update};

/// Computes everything on show as finely as print needs.
///
/// # Errors
/// What was asked that has no answer, and why.
pub fn complete(
    session: &mut Session,
    fineness: Fineness,
    limits: &Limits,
) -> Result<(), (Slot, Reason)> {
    loop {
        let open = session.wants().into_iter().find(|request| session.is_open(request));
        let Some(request) = open else { return Ok(()) };
        let slot = request.slot();
        ask(session, request, fineness, limits).map_err(|reason| (slot, reason))?;
    }
}

/// Computes what is on show in the explorer once more, for print. What would keep the user waiting stays
/// as it is on the screen.
pub fn refine(session: &mut Session, limits: &Limits) {
    /// Evaluations that a question may take: a second or two.
    const MOST: u64 = 40_000_000;
    let limits = Limits { evaluations: limits.evaluations.min(MOST), ..*limits };
    let drawn = |request: &Request| {
        !matches!(request.slot(), Slot::Scan | Slot::Trade | Slot::Reference | Slot::Claims)
    };
    for request in session.wants().into_iter().filter(drawn) {
        // Without a finer answer there is that of the screen.
        let _ = ask(session, request, Fineness::PRINT, &limits);
    }
}

fn ask(
    session: &mut Session,
    request: Request,
    fineness: Fineness,
    limits: &Limits,
) -> Result<(), Reason> {
    let found = answer_for(&request, fineness, limits)?;
    let answered = Answered { request, result: Ok(found), seconds: 0.0, complete: true };
    update(session, Msg::Answered(Box::new(answered)));
    Ok(())
}
