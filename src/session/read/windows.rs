//! Windows fitted to what is on show.

use crate::accuracy::TradePoint;
use crate::closed_form::lyapunov;
use crate::fit::{DropReason, RecordPoint, Signal};
use crate::flow::{Outcome, Problem};
use crate::model::{Knob, Parameters, energy};
use crate::numerics::{hypot, real, truncated};
use crate::scene::{Axes, Finding, Layer, Point, Request, Span, Topic, View, Window, usual_values};
use crate::session::state::setup::size;
use crate::session::{Framing, ScanOnShow, Session};

/// Width of a fitted window, relative to its content.
const ROOM: f64 = 1.1;

/// How far an escaping motion is followed, relative to the extent of everything else.
const ESCAPE: f64 = 2.0;

/// Length of the time axis for a motion that comes to rest, relative to the time of rest.
const REST: f64 = 1.2;

/// End of a return map, relative to the largest cycle.
const FARTHER: f64 = 1.25;

/// Largest velocity in the plot of the rate of the energy, relative to the Lyapunov circle.
const FASTER: f64 = 1.6;

/// Number of velocities at which the rate of the energy is computed to fit its window.
const RATES: u32 = 64;

/// Margin outside of the sticking set, as a fraction of its half width.
const MARGIN: f64 = 0.2;

/// Largest velocity of the belt that is included in a window, relative to the extent of everything else.
const BELT: f64 = 2.0;

/// Fraction of the points of a branch that must fit, from above and from below: the end of a branch that goes
/// to infinity need not.
const QUANTILE: f64 = 0.9;

/// The window that shows the whole content of a plot, and that of a pinned point; `None` if there is none yet.
pub fn fitted(session: &Session, index: usize) -> Option<Window> {
    let own = alone(session, index)?;
    let beside = session.letters().and(session.beside(index));
    let Some(theirs) = beside.and_then(|other| alone(other, index)) else { return Some(own) };
    let [across, up] = session.units_beside(index);
    let both = |own: Span, theirs: Span, by: f64| {
        let ends = own.ends().into_iter().chain(theirs.ends().map(|end| by * end));
        Span::covering(ends).unwrap_or(own)
    };
    Some(Window { x: both(own.x, theirs.x, across), y: both(own.y, theirs.y, up) })
}

/// The window that shows the whole content of a plot at the present point alone.
fn alone(session: &Session, index: usize) -> Option<Window> {
    let view = session.plots[index].view;
    let usual = view.spec().window;
    match view {
        View::Phase => phase(session, index),
        View::Diagram => diagram(session, index),
        View::TimeSeries => time_series(session, index),
        View::EnergyLedger => {
            let lines = real(session.ledger().len().max(1));
            Some(Window { y: Span::new(-lines, 0.0).ok()?, ..usual })
        }
        View::ReturnMap => return_map(session),
        View::Regimes => {
            let Axes { abscissa, against, .. } = session.plots[index].axes;
            Some(Window { x: session.values_around(abscissa), y: session.values_around(against) })
        }
        View::Trade => {
            let places = session.trade()?.rows.iter().filter_map(TradePoint::place);
            Window::around(&places.map(Point::from).collect::<Vec<_>>(), ROOM)
        }
        View::Belt => belt(session),
        View::EnergyRate => energy_rate(session),
        View::Eigenvalues => {
            let far = usual.x.to().max(2.0 * ROOM * session.problem.parameters.d.abs());
            Some(Window { x: Span::new(-far, far).ok()?, ..usual })
        }
        View::BeltDiagram => belt_diagram(session, index),
        View::Damping => Window::of(session.fitted()?.curves.damping.extent),
        View::Residuals => Window::of(session.fitted()?.residual_extent()?),
        View::Spread => Window::of(session.fitted()?.curves.spread_extent),
        View::Scan => session.scanned.as_ref().map(ScanOnShow::window),
    }
}

/// The question whose answer the window of a plot waits for, if the plot is on show and is being fitted.
pub fn awaited(session: &Session, plot: usize) -> Option<Request> {
    let fits = session.on_show().contains(&plot) && session.plots[plot].framing == Framing::Fitting;
    let mut asked = if fits { session.asked_by(plot) } else { Vec::new() }.into_iter();
    asked.find(|request| session.is_open(request))
}

/// The same values of the machine's number, and all cycles at these.
fn belt_diagram(session: &Session, plot: usize) -> Option<Window> {
    let x = session.plots[plot].window.x;
    let points = session.machine_branch(plot)?.points.iter().filter(|it| x.contains(it.value));
    let cycles = points.flat_map(|it| &it.found).flat_map(|found| &found.cycles);
    let y = Span::covering(cycles.map(|cycle| cycle.q_max).chain([0.0]))?;
    Some(Window { x, y: y.scaled(0.0, ROOM) })
}

/// The motions, the cycles and the sticking sets.
fn phase(session: &Session, plot: usize) -> Option<Window> {
    let at = |x, y| Point { x, y };
    let mut points = Vec::new();
    for Problem { initial, parameters, .. } in session.shown(plot).iter().map(|it| it.problem) {
        points.extend([initial.into(), at(-parameters.r, 0.0), at(parameters.r, 0.0)]);
    }
    if session.shows_in(Layer::Cycles, plot) {
        let drawn = session.found(Topic::Cycles, plot, Finding::try_as_cycles_ref);
        for cycle in drawn.iter().flat_map(|(_, (found, _))| &found.cycles) {
            points.extend([at(cycle.q_min, cycle.v_min), at(cycle.q_max, cycle.v_max)]);
        }
    }
    if session.shows_in(Layer::Trajectory, plot) {
        for (_, found) in session.found(Topic::Trajectory, plot, Finding::try_as_trajectory_ref) {
            let last = session.contact_of(found).map_or(f64::INFINITY, |(tau, _)| tau);
            let samples = found.samples.iter().take_while(|sample| sample.tau <= last);
            let samples = samples.map(|sample| at(sample.q, sample.v));
            if let Outcome::Escaped { .. } = found.outcome {
                let far = |point: &Point| hypot(point.x, point.y);
                let extent = points.iter().map(far).fold(0.0, f64::max);
                points.extend(samples.filter(|point| far(point) <= ESCAPE * extent));
            } else {
                points.extend(samples);
            }
        }
    }
    if let Some(running) = session.running().filter(|_| session.shows_in(Layer::Belt, plot)) {
        let fastest = points.iter().map(|point| point.y.abs()).fold(0.0, f64::max);
        let belt = running.reduced.sticking_velocity;
        if belt <= BELT * fastest {
            points.push(at(session.problem.initial.q, belt));
        }
    }
    let Window { x, mut y } = Window::around(&points, ROOM)?;
    // A motion at rest has no extent in v: the window is then as high as it is wide.
    if points.iter().all(|point| point.y == 0.0) {
        y = Span::new(-0.5 * x.width(), 0.5 * x.width()).ok()?;
    }
    Some(Window { x, y })
}

/// The positions of the mass.
fn belt(session: &Session) -> Option<Window> {
    let last = session.last_moment();
    let samples = session.trajectory()?.samples.iter().take_while(|sample| sample.tau <= last);
    let places = samples.map(|sample| sample.q);
    let x = Span::covering(places.chain([session.problem.initial.q, 0.0]))?;
    Some(Window { x: x.widened(1.5 * ROOM), y: View::Belt.spec().window.y })
}

/// The same values of the parameter, and the heights of the branch there.
fn diagram(session: &Session, plot: usize) -> Option<Window> {
    let x = session.plots[plot].window.x;
    let (mut heights, mut special) = (Vec::new(), Vec::new());
    for (variant, branch) in session.branches(plot) {
        let height = session.height(plot, variant);
        let points = branch.pieces.iter().flatten().filter(|point| x.contains(point.value));
        heights.extend(points.map(|point| height.of(point.value, &point.cycle)));
        let points = branch.special.iter().filter(|point| x.contains(point.value));
        special.extend(points.filter_map(|at| Some(height.of(at.value, &at.cycle?))));
    }
    heights.retain(|height: &f64| height.is_finite());
    heights.sort_by(f64::total_cmp);
    // The value that this fraction of the heights does not exceed.
    let quantile = |part| heights.get(truncated(real(heights.len()) * part)).copied();
    let zero = session.plots[plot].axes.ordinate.spec().from_zero.then_some(0.0);
    let ends = [1.0 - QUANTILE, QUANTILE].into_iter().filter_map(quantile);
    let span = Span::covering(special.into_iter().chain(zero).chain(ends))?;
    // A window with an end at zero gets room only at the other end.
    let about = if span.contains(0.0) && zero.is_some() {
        0.0
    } else {
        span.center()
    };
    Some(Window { x, y: span.scaled(about, ROOM) })
}

/// The time until the motion ends or comes to rest, and the values of the layers until then.
fn time_series(session: &Session, plot: usize) -> Option<Window> {
    session.trajectory()?;
    let Problem { parameters: Parameters { r, .. }, initial, .. } = session.problem;
    let mut values = vec![0.0];
    let shown = |layer| session.shows_in(layer, plot);
    let motions = session.motions();
    for sample in motions.iter().flat_map(|(_, motion)| &motion.samples) {
        values.extend(shown(Layer::Position).then_some(sample.q));
        values.extend(shown(Layer::Velocity).then_some(sample.v));
        values.extend(shown(Layer::Energy).then(|| energy(sample.state())));
    }
    if motions.iter().any(|(_, motion)| matches!(motion.outcome, Outcome::Escaped { .. })) {
        // Where values diverge, only their beginning is shown.
        let extent = ESCAPE * hypot(initial.q, initial.v).max(r);
        values.retain(|value| value.abs() <= extent);
    }
    if shown(Layer::Friction) {
        values.extend([-r, r]);
    }
    let ends = motions.iter().map(|(_, motion)| match motion.outcome {
        Outcome::Captured { tau, .. } => (REST * tau).min(motion.problem.until),
        Outcome::Moving { tau, .. } => tau,
        Outcome::Escaped { tau } | Outcome::GaveUp { tau, .. } => ROOM * tau,
    });
    let end = ends.fold(0.0, f64::max);
    let record = session.fitted().filter(|_| shown(Layer::Record));
    let signal = record.map_or(Signal::default(), |fitted| fitted.record.signal);
    let record: &[RecordPoint] = record.map_or(&[], |fitted| &fitted.points);
    let swinging = values.iter().fold(r, |far, value| far.max(value.abs()));
    // Outliers far away are shown at the edge.
    let near = |at: &RecordPoint| {
        let y = at.shown(signal)?;
        (at.dropped != Some(DropReason::Outlier) || y.abs() < ESCAPE * swinging).then_some(y)
    };
    values.extend(record.iter().filter_map(near));
    let y = Span::covering(values)?;
    let x = Span::covering(record.iter().map(|at| at.tau).chain([0.0, end]))?;
    Some(Window { x, y: y.widened(ROOM) })
}

/// Turning points on the right: those of the cycles, otherwise those of the motion.
fn return_map(session: &Session) -> Option<Window> {
    let r = session.problem.parameters.r;
    let cycles = session.cycles().into_iter().flat_map(|found| &found.cycles);
    let largest = cycles.map(|cycle| cycle.q_max).fold(session.problem.initial.q.abs(), f64::max);
    // A map without a cycle shows some half swings that friction alone damps.
    let far = if largest > r { largest } else { 10.0 * r };
    let span = Span::new(-(1.0 + MARGIN) * r, FARTHER * far).ok()?;
    Some(Window { x: span, y: span })
}

/// Velocities around the Lyapunov circle and the start, and the rate of the energy there.
fn energy_rate(session: &Session) -> Option<Window> {
    let Problem { parameters, initial, .. } = session.problem;
    let radius = lyapunov::radius(&parameters).unwrap_or(0.0);
    let fastest = radius.max(initial.v.abs()).max(parameters.r);
    let far = FASTER * if fastest > 0.0 { fastest } else { 1.0 };
    let x = Span::new(-far, far).ok()?;
    let rate = |v: f64| lyapunov::energy_rate(&parameters, v);
    let parts = x.evenly(RATES).map(rate);
    let y = Span::covering(parts.chain([0.0]))?;
    Some(Window { x, y: y.widened(ROOM) })
}

impl Session {
    /// The first range of a diagram over a number, with room for the present value: of a machine from a tenth to three times
    /// that, and around 0 as wide as a number of its kind is large.
    pub(crate) fn values_around(&self, knob: Knob) -> Span {
        let (value, usual) = (self.value(knob), usual_values(knob));
        let size = self.running().filter(|_| knob.is_of_machine()).map(|it| size(it, knob));
        let ends = match size {
            None => [usual.from(), usual.to(), ROOM * value],
            Some(size) if value == 0.0 => [(-size).max(knob.spec().min), size, 0.0],
            Some(_) => [0.1 * value, 3.0 * value, value],
        };
        Span::covering(ends).and_then(|span| span.allowed(knob)).unwrap_or(usual)
    }
}
