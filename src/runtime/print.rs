//! Sessions computed for print, with as many points on their curves as paper can show.

use std::collections::BTreeSet;

use super::Failure;
use crate::figure::{FAINT, Figure};
use crate::flow::{Limits, Result};
use crate::numerics::{real, truncated};
use crate::picture;
use crate::question::{Fineness, answer_for};
use crate::scene::{Request, Topic};
use crate::session::read::windows::fitted;
use crate::session::{Msg, Session, update};

/// Whether a fitted window would show a line of a plot that its own does not.
pub fn unseen(session: &Session, plot: usize) -> bool {
    let Some(window) = fitted(session, plot) else { return false };
    let mut wide = session.clone();
    wide.plots[plot].window = window;
    // How far a curve is drawn depends on the window.
    let lines = |session: &Session| -> BTreeSet<String> {
        let window = session.plots[plot].window;
        let items = picture::of(session, plot).items;
        items.iter().filter_map(|item| Some(item.seen(window)?.name.to_string())).collect()
    };
    !lines(&wide).is_subset(&lines(session))
}

/// Computes everything on show as finely as print needs. Fails with the topic of the request that has no answer, and
/// the reason.
pub fn complete(session: &mut Session, fineness: Fineness, limits: &Limits) -> Result<(), Failure> {
    loop {
        let open = session.wants().into_iter().find(|request| session.is_open(request));
        let Some(request) = open else { return Ok(()) };
        let failed = format!("{} not computed", request.topic().name());
        let asked = ask(session, request, fineness, limits);
        asked.map_err(|why| Failure::unanswered(failed, why))?;
    }
}

/// Maximum number of evaluations for a question in the explorer: a second or two.
pub const MOST: u64 = 40_000_000;

/// Computes what is on show in the explorer once more, for print. Anything that would keep the user waiting
/// stays as it is on the screen.
pub fn refine(session: &mut Session, limits: &Limits) {
    for request in session.wants().into_iter().filter(|request| is_drawn(request.topic())) {
        // Without a finer answer, that of the screen remains.
        let _ = ask(session, request, Fineness::PRINT, limits);
    }
}

/// A figure of these plots whose chords deviate from their curves by less than can be seen at any
/// magnification: where they deviate more, curves are computed with more points.
pub fn figure(session: &mut Session, plots: &[usize], limits: &Limits) -> Figure {
    /// Maximum factor on the number of points: enough for a magnification of a thousand.
    const MOST: f64 = 48.0;
    /// Safety factor, because the error of a chord is only estimated.
    const MARGIN: f64 = 1.2;
    /// Maximum number of refinements.
    const ROUNDS: usize = 3;
    let mut figure = Figure::of(session, plots.iter().copied());
    let mut times = vec![1; plots.len()];
    for _ in 0..ROUNDS {
        let mut finer = false;
        for ((plot, panel), times) in plots.iter().zip(&figure.panels).zip(&mut times) {
            let missed = panel.chord();
            if missed <= FAINT / MARGIN {
                continue;
            }
            // The error of a chord is proportional to the square of its length.
            let wanted = (real(*times) * (MARGIN * MARGIN * missed / FAINT).sqrt()).ceil();
            let wanted = truncated(wanted.min(MOST));
            if wanted > *times {
                *times = wanted;
                finer = true;
                let asked = session.asked_by(*plot).into_iter();
                for request in asked.filter(|request| is_drawn(request.topic())) {
                    let _ = ask(session, request, Fineness::PRINT.finer(wanted), limits);
                }
            }
        }
        if !finer || (limits.interrupted)() {
            break;
        }
        figure = Figure::of(session, plots.iter().copied());
    }
    figure.thinned(times.into_iter().max().unwrap_or(1))
}

/// Whether answers on this topic have curves.
fn is_drawn(topic: Topic) -> bool {
    use Topic::{Claims, Fit, Proof, Reference, Scan, Trade};
    !matches!(topic, Scan | Trade | Reference | Claims | Fit | Proof)
}

fn ask(session: &mut Session, request: Request, fineness: Fineness, limits: &Limits) -> Result<()> {
    let found = answer_for(&request, fineness, limits)?;
    update(session, Msg::answered(request, Ok(found), 0.0));
    Ok(())
}
