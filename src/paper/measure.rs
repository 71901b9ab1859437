//! Numbers with known errors, computed without the formulas that they are compared with.
//!
//! A motion is integrated by two methods that share nothing but the field, and the error is what they
//! differ by. Cycles come from the general search, also where a closed form exists.

use std::ops::Deref;

use super::Evidence;
use super::known::{Certain, Known};
use crate::flow::trajectory::trajectory;
use crate::flow::{Detail, Limits, Method, Outcome, Problem, Reason, Trajectory};
use crate::model::{Knob, Parameters, Side, State};
use crate::numerics::Interval;
use crate::portrait::basin::arc::Arc;
use crate::portrait::basin::basin;
use crate::portrait::closing::all::closings;
use crate::portrait::closing::equation::Equation;
use crate::portrait::closing::half_map::{Direction, Length};
use crate::portrait::proved::matching;
use crate::portrait::{Border, Cycle};
use crate::proof::motion::{ProvedFate, ProvedMotion, follow};
use crate::proof::range::change_within;
use crate::proof::{Enclosure, ParameterBox, kicks, prove};

/// Rounding of a number that several operations made from a computed one.
const ROUNDED: f64 = 1e-14;

/// A cycle of the search, and bounds of its numbers.
#[derive(Clone, Copy, Debug)]
pub struct BoundedCycle {
    cycle: Cycle,
    /// Where it is proved.
    pub bounds: Option<Enclosure>,
}

impl Deref for BoundedCycle {
    type Target = Cycle;

    fn deref(&self) -> &Cycle {
        &self.cycle
    }
}

/// All cycles of the search; certain, if it is proved that there are these and no others.
pub type AllFound = Certain<Vec<BoundedCycle>>;

/// A number made from those of a cycle, and the same from their bounds.
pub fn of_cycle(
    cycle: &BoundedCycle,
    value: f64,
    bounds: impl Fn(&Enclosure) -> Interval,
) -> Known {
    Known::relative(value, cycle.error.unwrap_or(f64::INFINITY) + ROUNDED)
        .within(cycle.bounds.as_ref().map(bounds))
}

/// The extent `q_max` of a cycle.
pub fn extent(cycle: &BoundedCycle) -> Known {
    of_cycle(cycle, cycle.q_max, |it| it.q_max)
}

/// The largest velocity of a cycle.
pub fn speed(cycle: &BoundedCycle) -> Known {
    of_cycle(cycle, cycle.v_max, |it| it.v_max)
}

/// An oscillator, in the order of the equation.
pub fn oscillator(d: f64, d2: f64, d3: f64, r: f64) -> Parameters {
    Parameters { d, d2, d3, r }
}

/// The parameters that are not zero, D always: `D = -0.4, r = 0.1`.
pub fn place(parameters: &Parameters) -> String {
    let Parameters { d, d2, d3, r } = *parameters;
    let mut text = format!("D = {}", short(d));
    for (name, value) in [("D2", d2), ("D3", d3), ("r", r)] {
        if value != 0.0 {
            text += &format!(", {name} = {}", short(value));
        }
    }
    text
}

/// A number in full, or rounded where it has more digits than anyone typed.
fn short(value: f64) -> String {
    /// Room for what people type.
    const TYPED: usize = 10;
    let full = format!("{value}");
    if full.len() <= TYPED { full } else { format!("{value:.6}") }
}

/// The worst comparison over some oscillators; its place is the oscillator, unless it has one.
pub fn over(
    cases: impl IntoIterator<Item = Parameters>,
    compare: impl Fn(&Parameters) -> Result<Evidence, Reason>,
) -> Result<Evidence, Reason> {
    Evidence::worst(cases.into_iter().map(|parameters| {
        let evidence = compare(&parameters)?;
        let unnamed = evidence.place.is_empty();
        Ok(if unnamed { evidence.at(place(&parameters)) } else { evidence })
    }))
}

/// What should hold for each of some oscillators.
pub fn everywhere<A: Into<Certain<bool>>>(
    cases: impl IntoIterator<Item = Parameters>,
    holds: impl Fn(&Parameters) -> Result<A, Reason>,
) -> Result<Evidence, Reason> {
    Evidence::always(cases.into_iter().map(|it| Ok((place(&it), holds(&it)?))))
}

/// How a formula and what it should approach differ far from the limit and near it.
pub fn towards(
    [far, near]: [Parameters; 2],
    compare: impl Fn(&Parameters) -> Result<(f64, Known), Reason>,
) -> Result<Evidence, Reason> {
    Ok(Evidence::tends(compare(&far)?, compare(&near)?).at(place(&near)))
}

pub fn at_rest(q: f64) -> State {
    State { q, v: 0.0 }
}

/// The two methods that answer every question about a motion, with the relative error of a step.
const METHODS: [(Method, f64); 2] = [(Method::Taylor, 1e-15), (Method::Dop853, 1e-14)];

/// A motion from `initial` until `until` by both methods, each reduced to numbers by `read`. Fails where one has none,
/// or was given up.
fn motions<const N: usize>(
    (parameters, initial, until): (Parameters, State, f64),
    (limits, sought): (&Limits, &'static str),
    read: impl Fn(&Trajectory) -> Option<[f64; N]>,
) -> Result<[Known; N], Reason> {
    let mut answers = [None; 2];
    for (answer, (method, tolerance)) in answers.iter_mut().zip(METHODS) {
        let problem =
            Problem { parameters, initial, until, method, tolerance, ..Problem::default() };
        let detail = Detail { energy: true, ..Detail::default() };
        let motion = trajectory(&problem, detail, limits);
        if let Outcome::GaveUp { reason, .. } = motion.outcome {
            return Err(reason);
        }
        *answer = read(&motion);
    }
    let [Some(first), Some(second)] = answers else { return Err(missing(sought)) };
    Ok(std::array::from_fn(|index| Known::twice(first[index], second[index])))
}

/// Longer than any half swing asked for here.
const LONG: f64 = 1000.0;

/// A question whose answer should exist did not have one.
pub fn missing(sought: &'static str) -> Reason {
    Reason::NoConvergence { sought, change: f64::NAN }
}

/// Place and time of the first arrival at `v = 0`. Fails with the [`Reason`] why the motion has none.
pub fn half_swing(
    parameters: &Parameters,
    initial: State,
    limits: &Limits,
) -> Result<[Known; 2], Reason> {
    // Stopping at the arrival needs its time; a first run over one half swing finds it.
    let until = parameters.omega().map_or(LONG, |omega| 2.0 * std::f64::consts::PI / omega);
    let sought = (limits, "an arrival at v = 0");
    let [q, tau] = motions((*parameters, initial, until), sought, |motion| {
        motion.crossings.first().map(|crossing| [crossing.q, crossing.tau])
    })?;
    let turn = enclosed(parameters, initial, until).turns.first().copied();
    Ok([q.within(turn.map(|turn| turn.q)), tau.within(turn.map(|turn| turn.tau))])
}

/// State at a time before the motion comes to rest.
pub fn state_at(
    parameters: &Parameters,
    initial: State,
    tau: f64,
    limits: &Limits,
) -> Result<[Known; 2], Reason> {
    let sought = (limits, "a state in motion");
    let [q, v] = motions((*parameters, initial, tau), sought, |motion| match motion.outcome {
        Outcome::Moving { q, v, .. } => Some([q, v]),
        _ => None,
    })?;
    let bounds = enclosed_state(parameters, initial, tau);
    Ok([q.within(bounds.map(|it| it[0])), v.within(bounds.map(|it| it[1]))])
}

/// Change of the energy over a motion, and the works of linear damping and of friction.
pub fn energy_change(
    parameters: &Parameters,
    initial: State,
    until: f64,
    limits: &Limits,
) -> Result<[Known; 3], Reason> {
    let sought = (limits, "an energy ledger");
    let [change, linear, friction] = motions((*parameters, initial, until), sought, |motion| {
        let ledger = motion.ledger.as_ref()?;
        Some([ledger.end - ledger.start, ledger.work("linear"), ledger.work("friction")])
    })?;
    let energy = |[q, v]: [Interval; 2]| (q.square() + v.square()) * 0.5;
    let start = energy([initial.q, initial.v].map(Interval::point));
    let end = enclosed_state(parameters, initial, until).map(energy);
    Ok([change.within(end.map(|end| end - start)), linear, friction])
}

/// A motion until `until`. Fails with the [`Reason`] why it was given up.
pub fn motion(
    parameters: &Parameters,
    initial: State,
    until: f64,
    limits: &Limits,
) -> Result<Trajectory, Reason> {
    let (parameters, tolerance) = (*parameters, 1e-12);
    let problem = Problem { parameters, initial, until, tolerance, ..Problem::default() };
    let motion = trajectory(&problem, Detail::default(), limits);
    if let Outcome::GaveUp { reason, .. } = motion.outcome {
        return Err(reason);
    }
    Ok(motion)
}

/// Whether a motion comes to rest before `until`. Fails with the [`Reason`] why it was given up.
pub fn captured(
    parameters: &Parameters,
    initial: State,
    until: f64,
    limits: &Limits,
) -> Result<Certain<bool>, Reason> {
    let end = motion(parameters, initial, until, limits)?.outcome;
    let value = matches!(end, Outcome::Captured { .. });
    let certain = match enclosed(parameters, initial, until).fate {
        ProvedFate::Captured { .. } => value,
        ProvedFate::Moving { .. } | ProvedFate::Escaped { .. } => !value,
        ProvedFate::Open { .. } => false,
    };
    Ok(Certain { value, certain })
}

/// All cycles by the general search, smallest first, whether or not a closed form exists. Fails with the [`Reason`]
/// why the search failed.
pub fn cycles(parameters: &Parameters, limits: &Limits) -> Result<AllFound, Reason> {
    let mut equation = Equation::new(parameters, 0.5 * f64::EPSILON, limits);
    let found = closings(&mut equation, usize::MAX, &[])?;
    let found = found.iter().map(|closing| closing.describe(parameters, equation.side)).collect();
    Ok(beside_proof(parameters, found))
}

/// Cycles that were found, with what is proved about them.
pub fn beside_proof(parameters: &Parameters, found: Vec<Cycle>) -> AllFound {
    let hints: Vec<f64> = found.iter().map(|cycle| cycle.clearance).collect();
    let proof = prove(&ParameterBox::from(parameters), &hints);
    let certain = proof.is_complete() && proof.cycles.len() == found.len();
    let with_bounds = |cycle: Cycle| BoundedCycle {
        cycle,
        bounds: matching(&proof, &cycle).and_then(|proved| proved.enclosure),
    };
    Certain { value: found.into_iter().map(with_bounds).collect(), certain }
}

/// What borders the basin. Fails with the [`Reason`] why a border could not be computed.
pub fn edge(parameters: &Parameters, limits: &Limits) -> Result<Certain<Border>, Reason> {
    let found = basin(parameters, 10.0, limits)?.border;
    let proved = kicks::edge(&prove(&ParameterBox::from(parameters), &[]));
    let certain = match found {
        Border::None => proved == Some(kicks::ProvedEdge::None),
        Border::Cycle => proved == Some(kicks::ProvedEdge::Cycle),
        Border::Separatrix => proved == Some(kicks::ProvedEdge::Separatrix),
        _ => false,
    };
    Ok(Certain { value: found, certain })
}

/// The value of D at which cycles vanish, `found` being where the search says so: enclosed to a thousandth.
pub fn last_cycle(parameters: &Parameters, found: f64, error: f64) -> Known {
    /// Next to that value proofs take long.
    const AWAY: f64 = 1e-3;
    let between = change_within(&ParameterBox::from(parameters), Knob::D, found, AWAY);
    Known::relative(found, error).within(between.map(|change| change.between))
}

/// The smallest cycle.
pub fn smallest(parameters: &Parameters, limits: &Limits) -> Result<BoundedCycle, Reason> {
    cycles(parameters, limits)?.value.first().copied().ok_or(missing("a limit cycle"))
}

/// The largest cycle.
pub fn largest(parameters: &Parameters, limits: &Limits) -> Result<BoundedCycle, Reason> {
    cycles(parameters, limits)?.value.last().copied().ok_or(missing("a limit cycle"))
}

/// Half of what lies between the turning points.
pub fn amplitude(cycle: &BoundedCycle) -> Known {
    of_cycle(cycle, 0.5 * (cycle.q_max - cycle.q_min), |it| (it.q_max - it.q_min) * 0.5)
}

/// Mean displacement of a cycle over its period: over one turn all forces cancel, those that depend on the velocity and
/// the spring's. Fails with the [`Reason`] why its arcs could not be computed.
pub fn mean(parameters: &Parameters, cycle: &Cycle, limits: &Limits) -> Result<Known, Reason> {
    /// Relative error of the integrals by arcs to 1e-14.
    const INTEGRAL: f64 = 1e-11;
    let [rise, fall] = arcs(parameters, cycle, limits)?;
    let Parameters { d2, d3, r, .. } = *parameters;
    let [up, down] = [rise.powers(), fall.powers()];
    let even = d2 * (up.second + down.second);
    let odd = d3 * (up.third - down.third) + r * (rise.swing.duration - fall.swing.duration);
    Ok(Known::new(-(even + odd) / cycle.period, INTEGRAL * cycle.q_max))
}

/// The arcs of a cycle above and below `v = 0`. Fails with the [`Reason`] why they could not be computed.
pub fn arcs(parameters: &Parameters, cycle: &Cycle, limits: &Limits) -> Result<[Arc; 2], Reason> {
    let arc = |side, turn: f64| {
        let clearance = Length::new(turn - parameters.r);
        Arc::new(parameters, side, Direction::Forward, clearance, limits)
    };
    Ok([arc(Side::Upper, -cycle.q_min)?, arc(Side::Lower, cycle.q_max)?])
}

/// The motion from a state, enclosed.
pub fn enclosed(parameters: &Parameters, initial: State, until: f64) -> ProvedMotion {
    let start = [initial.q, initial.v].map(Interval::point);
    follow(&ParameterBox::from(parameters), start, until)
}

/// Bounds of a state at a time before the motion comes to rest.
pub fn enclosed_state(parameters: &Parameters, initial: State, tau: f64) -> Option<[Interval; 2]> {
    match enclosed(parameters, initial, tau).fate {
        ProvedFate::Moving { q, v } => Some([q, v]),
        _ => None,
    }
}
