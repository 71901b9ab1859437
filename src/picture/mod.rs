//! What stands in a plot, decided once: curves, areas, marks and texts in world coordinates, each with a name
//! and a role, and the ticks of its axes.
//!
//! A [`items::Picture`] knows no terminal and no file format. Each view builds one from the session; the screen
//! ([`crate::view`]) and files ([`crate::figure`]) draw the same one.

mod belt;
mod belt_diagram;
mod compare;
mod construction;
mod diagram;
mod eigenvalues;
pub mod energy_ledger;
mod energy_rate;
pub mod fit;
pub mod items;
pub mod legend;
mod levels;
pub mod map;
mod phase_plane;
mod regimes;
mod return_map;
pub mod role;
pub mod scan;
pub mod ticks;
mod time_series;
pub mod trade;
pub(crate) mod units;

pub use self::{belt::Room, items::*, role::*, ticks::*};
pub use legend::{LegendEntry, LegendSample};
pub use map::{Danger, DangerousValues, MapCell, ScanMap};

use crate::fit::FitResult;
use crate::scene::View;
use crate::session::{Plot, Session};

/// What the numbers along the axes of the plot with this index stand for.
pub fn scales(session: &Session, index: usize) -> [Scale; 2] {
    match session.plots[index].view {
        View::Scan => session.scanned.as_ref().map(scan::scales).unwrap_or_default(),
        View::Trade => [Scale::Logarithmic(""); 2],
        _ => units::scales(session, index).unwrap_or_default(),
    }
}

/// Views that know the paper's oscillator alone.
const EXPANDED: [View; 5] =
    [View::Diagram, View::ReturnMap, View::Regimes, View::EnergyRate, View::Trade];

/// What the plot with this index shows, where nothing is known of its shape.
pub fn of(session: &Session, index: usize) -> Picture<'_> {
    /// In the shape of a figure.
    const USUAL: Room = [54.0, 21.3];
    in_room(session, index, USUAL)
}

/// What the plot with this index shows in so many columns and rows, and of the point that the present one is compared with.
pub fn in_room(session: &Session, index: usize, room: Room) -> Picture<'_> {
    let mut picture = alone(session, index, room);
    if let Some(other) = session.beside(index) {
        compare::add(&mut picture, alone(other, index, room), (session, other), index);
    }
    picture
}

/// Marks the present value of a number by an upright, and at this height the letter of its point.
fn present(picture: &mut Picture, session: &Session, x: f64, y: f64) {
    picture.upright("present value", x);
    if let Some(letter) = session.letter() {
        picture.caption([x, y], letter, Role::Current);
    }
}

/// What it shows of the present point alone.
fn alone(session: &Session, index: usize, room: Room) -> Picture<'_> {
    let Plot { view, window, cursor, .. } = session.plots[index];
    let scales = scales(session, index);
    let mut picture = Picture { scales, cursor, ..Picture::new(view.spec().title, "", "", window) };
    let fitted = |draw: fn(&FitResult) -> Option<Picture<'static>>| {
        let drawn = session.fitted().and_then(draw)?;
        Some(Picture { scales, window, cursor, ..drawn })
    };
    match view {
        View::Phase => phase_plane::draw(&mut picture, session, index),
        View::Diagram => diagram::draw(&mut picture, session, index),
        View::TimeSeries => time_series::draw(&mut picture, session),
        View::EnergyLedger => energy_ledger::draw(&mut picture, session),
        View::ReturnMap => return_map::draw(&mut picture, session, index),
        View::Regimes => regimes::draw(&mut picture, session, index),
        View::Trade => trade::draw(&mut picture, session, index),
        View::EnergyRate => energy_rate::draw(&mut picture, session),
        View::Eigenvalues => eigenvalues::draw(&mut picture, session, index),
        View::Scan => {
            scan::draw(&mut picture, session);
            levels::draw(&mut picture, session, index);
        }
        View::BeltDiagram => belt_diagram::draw(&mut picture, session, index),
        View::Belt => belt::draw(&mut picture, session, index, room),
        View::Damping => picture = fitted(fit::damping).unwrap_or(picture),
        View::Residuals => picture = fitted(fit::residuals).unwrap_or(picture),
        View::Spread => picture = fitted(fit::margin).unwrap_or(picture),
    }
    // Until margins are drawn for the held values, the distribution stays that of the whole fit.
    let drawn = session.fitted().is_none_or(|found| found.drawn);
    if view == View::Spread && session.doubt.held.contains(&true) && !drawn {
        picture.add_to_title("all numbers free");
    }
    if session.draws_whole() && EXPANDED.contains(&view) {
        picture.add_to_title("cubic expansion");
    }
    let shown = session.shown(index);
    picture.variants = shown.iter().map(|shown| shown.problem.parameters).collect();
    // Values that all variants hold stand in the title; those that distinguish them, beside their curves.
    let held = session.held_alike(index);
    if !held.is_empty() {
        picture.add_to_title(&held);
    }
    picture
}
