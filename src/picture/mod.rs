//! What stands in a plot, decided once: curves, areas, marks and texts in world coordinates, each with a name
//! and a role, and the ticks of its axes.
//!
//! A [`items::Picture`] knows no terminal and no file format. Each view builds one from the session; the screen
//! ([`crate::view`]) and files ([`crate::figure`]) draw the same one.

mod belt;
mod belt_path;
mod construction;
mod diagram;
mod eigenvalues;
pub mod energy_ledger;
mod energy_rate;
mod equilibria;
pub mod fit;
pub mod items;
mod kicks;
pub mod legend;
mod phase_plane;
mod reading;
mod regimes;
mod return_map;
pub mod role;
pub mod scan;
mod speeds;
pub mod ticks;
mod time_series;
pub mod trade;
pub(crate) mod units;

use items::Picture;
use ticks::Scale;

use crate::scene::View;
use crate::session::Session;

/// What the numbers along the axes of the plot with this index stand for.
pub fn scales(session: &Session, index: usize) -> [Scale; 2] {
    match session.plots[index].view {
        View::Scan => session.scanned.as_ref().map_or_else(Default::default, scan::scales),
        View::Trade => [Scale::Logarithmic; 2],
        _ => units::scales(session, index).unwrap_or_default(),
    }
}

/// Views that know the paper's oscillator alone.
const EXPANDED: [View; 5] =
    [View::Diagram, View::ReturnMap, View::Regimes, View::EnergyRate, View::Trade];

/// A picture of the fit in its window.
fn of_fit(
    session: &Session,
    index: usize,
    draw: fn(&crate::fit::Fitted) -> Option<Picture<'static>>,
) -> Picture<'static> {
    let plot = &session.plots[index];
    let drawn = session.fitted().and_then(|fitted| draw(&fitted.fit));
    let title = plot.view.spec().title;
    let mut picture = drawn.unwrap_or_else(|| Picture::new(title, "", "", plot.window));
    picture.window = plot.window;
    picture.cross(plot.cursor);
    picture
}

/// What the plot with this index shows.
pub fn of(session: &Session, index: usize) -> Picture<'_> {
    let mut picture = match session.plots[index].view {
        View::Phase => phase_plane::picture(session, index),
        View::Diagram => diagram::picture(session, index),
        View::TimeSeries => time_series::picture(session, index),
        View::EnergyLedger => energy_ledger::picture(session, index),
        View::ReturnMap => return_map::picture(session, index),
        View::Regimes => regimes::picture(session, index),
        View::Trade => trade::picture(session, index),
        View::EnergyRate => energy_rate::picture(session, index),
        View::Eigenvalues => eigenvalues::picture(session, index),
        View::Scan => scan::picture(session, index),
        View::Speeds => speeds::picture(session, index),
        View::Belt => belt::picture(session, index),
        View::Damping => of_fit(session, index, fit::damping),
        View::Residuals => of_fit(session, index, fit::residuals),
        View::Spread => of_fit(session, index, fit::margin),
    };
    // Until the draws with what is held are there, the distribution stays that of the whole fit.
    let drawn = session.fitted().is_none_or(|found| found.drawn);
    if session.plots[index].view == View::Spread && session.doubt.holds_any() && !drawn {
        picture.title = format!("{}, all numbers free", picture.title).into();
    }
    if session.draws_whole() && EXPANDED.contains(&session.plots[index].view) {
        picture.title = format!("{}, cubic expansion", picture.title).into();
    }
    picture.scales = scales(session, index);
    let shown = session.shown(index);
    picture.variants = shown.iter().map(|shown| shown.problem.parameters).collect();
    // What all of a plot is held at stands in its title; what tells several apart, at their curves.
    let held = session.held_alike(index);
    if !held.is_empty() {
        picture.title = format!("{}, {held}", picture.title).into();
    }
    picture
}
