//! Numbers with known errors, computed without the formulas that they are compared with.
//!
//! A motion is integrated by two methods that share nothing but the field, and the error is what they
//! differ by. Cycles come from the general search, also where a closed form exists.

use std::ops::Deref;

use super::{Approximation, Conclusion};
use crate::flow::{Detail, Limits, Method, Motion, Outcome, Problem, Reason, Result, trajectory};
use crate::model::{Knob, Parameters, Side, State};
use crate::numerics::Interval;
use crate::portrait::{
    Arc, Border, Cycle, Direction, Equation, Length, Portrait, closings, matching,
};
use crate::proof::{
    Enclosure, ParameterBox, ProvedFate, ProvedMotion, change_within, follow, kicks, prove,
};

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

impl BoundedCycle {
    /// A number made from those of the cycle, and the same from their bounds.
    pub fn known(&self, value: f64, bounds: impl Fn(&Enclosure) -> Interval) -> Approximation {
        Approximation::relative(value, self.error.unwrap_or(f64::INFINITY) + ROUNDED)
            .within(self.bounds.as_ref().map(bounds))
    }

    /// The extent `q_max`.
    pub fn extent(&self) -> Approximation {
        self.known(self.q_max, |it| it.q_max)
    }

    /// The largest velocity.
    pub fn speed(&self) -> Approximation {
        self.known(self.v_max, |it| it.v_max)
    }

    /// Half of what lies between the turning points.
    pub fn amplitude(&self) -> Approximation {
        self.known(0.5 * (self.q_max - self.q_min), |it| (it.q_max - it.q_min) * 0.5)
    }
}

/// All cycles of the search; certain, if it is proved that there are these and no others.
pub type AllFound = Conclusion<Vec<BoundedCycle>>;

pub fn at_rest(q: f64) -> State {
    State { q, v: 0.0 }
}

/// The two methods that answer every question about a motion, with the relative error of a step.
const METHODS: [(Method, f64); 2] = [(Method::Taylor, 1e-15), (Method::Dop853, 1e-14)];

/// Longer than any half swing asked for here.
const LONG: f64 = 1000.0;

/// A question whose answer should exist did not have one.
pub fn missing(sought: &'static str) -> Reason {
    Reason::NoConvergence { sought, change: f64::NAN }
}

/// An oscillator at which a claim is put to the test.
///
/// Its questions are answered within its limits, or fail with the [`Reason`] why there is no answer.
#[derive(Clone)]
pub struct ClaimCase<'a> {
    /// Where this is, in the words of the table of claims.
    pub place: String,
    parameters: Parameters,
    /// What the place says beside the parameters: where a motion starts, a size, D in units of one that is computed.
    pub more: f64,
    /// How long each question may take.
    pub limits: Limits<'a>,
}

impl Deref for ClaimCase<'_> {
    type Target = Parameters;

    fn deref(&self) -> &Parameters {
        &self.parameters
    }
}

impl<'a> ClaimCase<'a> {
    /// The cases of a line of the table, such as `D = -0.9 -0.3, r = 0.1, from q = 1`: one for each combination of its
    /// values, the last of which vary fastest. Parameters that it does not name are 0.
    pub fn all(line: &str, limits: &Limits<'a>) -> Vec<Self> {
        let (place, parameters) = (String::new(), Parameters::from([0.0; 4]));
        let nowhere = ClaimCase { place, parameters, more: 0.0, limits: *limits };
        line.split(", ").fold(vec![nowhere], |cases, part| {
            cases.iter().flat_map(|case| case.with(part)).collect()
        })
    }

    /// This case for each value of a part of a line. A value with words behind it is that of no parameter.
    fn with(&self, part: &str) -> Vec<Self> {
        let said = |more: &str| match self.place.as_str() {
            "" => more.to_owned(),
            place => format!("{place}, {more}"),
        };
        let (name, values) = part.split_once(" = ").unwrap_or_default();
        let values: Vec<&str> = values.split(' ').collect();
        let count = values.iter().take_while(|text| text.parse::<f64>().is_ok()).count();
        let (numbers, unit) = values.split_at(count);
        let is_named = |knob: &Knob| name.rsplit(' ').next() == Some(knob.spec().name);
        let knob = Knob::PARAMETERS.into_iter().find(|knob| unit.is_empty() && is_named(knob));
        let case = |number: &&str| {
            let value = number.parse().unwrap_or(f64::NAN);
            let place = said(&[&[name, "=", number], unit].concat().join(" "));
            let (parameters, more) = match knob {
                Some(knob) => (self.parameters.with(knob, value), self.more),
                None => (self.parameters, value),
            };
            ClaimCase { place, parameters, more, limits: self.limits }
        };
        match numbers {
            [] => vec![ClaimCase { place: said(part), ..self.clone() }],
            _ => numbers.iter().map(case).collect(),
        }
    }

    /// The same questions to another oscillator.
    pub fn of(&self, parameters: Parameters) -> Self {
        ClaimCase { parameters, ..self.clone() }
    }

    /// A motion from `initial` until `until` by a method and to a tolerance.
    fn run(
        &self,
        (initial, until): (State, f64),
        (method, tolerance): (Method, f64),
        energy: bool,
    ) -> Result<Motion> {
        let problem =
            Problem { method, tolerance, ..Problem::new(self.parameters, initial, until) };
        let motion = trajectory(&problem, Detail { energy, ..Detail::default() }, &self.limits);
        motion.outcome.answered().map(|()| motion)
    }

    /// A motion by both methods, each reduced to numbers by `read`. Fails, too, where one has none.
    fn motions<const N: usize>(
        &self,
        course: (State, f64),
        sought: &'static str,
        read: impl Fn(&Motion) -> Option<[f64; N]>,
    ) -> Result<[Approximation; N]> {
        let [first, second] =
            METHODS.map(|method| Ok::<_, Reason>(read(&self.run(course, method, true)?)));
        let both = first?.zip(second?);
        let (first, second) = both.ok_or(missing(sought))?;
        Ok(std::array::from_fn(|index| Approximation::twice(first[index], second[index])))
    }

    /// Place and time of the first arrival at `v = 0` from rest.
    pub fn half_swing(&self, from: f64) -> Result<[Approximation; 2]> {
        let initial = at_rest(from);
        // Stopping at the arrival needs its time; a first run over one half swing finds it.
        let until = self.omega().map_or(LONG, |omega| 2.0 * std::f64::consts::PI / omega);
        let [q, tau] = self.motions((initial, until), "an arrival at v = 0", |motion| {
            motion.crossings.first().map(|crossing| [crossing.q, crossing.tau])
        })?;
        let turn = self.enclosed(initial, until).turns.first().copied();
        Ok([q.within(turn.and_then(|turn| turn.q)), tau.within(turn.map(|turn| turn.tau))])
    }

    /// State at a time before the motion comes to rest.
    pub fn state_at(&self, initial: State, tau: f64) -> Result<[Approximation; 2]> {
        let read = |motion: &Motion| match motion.outcome {
            Outcome::Moving { q, v, .. } => Some([q, v]),
            _ => None,
        };
        let [q, v] = self.motions((initial, tau), "a state in motion", read)?;
        let bounds = self.enclosed_state(initial, tau);
        Ok([q.within(bounds.map(|it| it[0])), v.within(bounds.map(|it| it[1]))])
    }

    /// Change of the energy over a motion from rest, and the works of linear damping and of friction.
    pub fn energy_change(&self, from: f64, until: f64) -> Result<[Approximation; 3]> {
        let initial = at_rest(from);
        let read = |motion: &Motion| {
            let ledger = motion.ledger.as_ref()?;
            Some([ledger.end - ledger.start, ledger.work("linear"), ledger.work("friction")])
        };
        let [change, linear, friction] =
            self.motions((initial, until), "an energy ledger", read)?;
        let energy = |[q, v]: [Interval; 2]| (q.square() + v.square()) * 0.5;
        let start = energy([initial.q, initial.v].map(Interval::point));
        let end = self.enclosed_state(initial, until).map(energy);
        Ok([change.within(end.map(|end| end - start)), linear, friction])
    }

    /// A motion until `until`.
    pub fn motion(&self, initial: State, until: f64) -> Result<Motion> {
        self.run((initial, until), (Method::Auto, 1e-12), false)
    }

    /// Whether a motion comes to rest before `until`.
    pub fn captured(&self, initial: State, until: f64) -> Result<Conclusion<bool>> {
        let end = self.motion(initial, until)?.outcome;
        let value = matches!(end, Outcome::Captured { .. });
        let certain = match self.enclosed(initial, until).fate {
            ProvedFate::Captured => value,
            ProvedFate::Moving | ProvedFate::Escaped => !value,
            ProvedFate::Open => false,
        };
        Ok(Conclusion { value, certain })
    }

    /// The motion from a state, enclosed.
    pub fn enclosed(&self, initial: State, until: f64) -> ProvedMotion {
        let start = [initial.q, initial.v].map(Interval::point);
        follow(&ParameterBox::from(&self.parameters), start, until)
    }

    /// Bounds of a state at a time before the motion comes to rest.
    fn enclosed_state(&self, initial: State, tau: f64) -> Option<[Interval; 2]> {
        let end = self.enclosed(initial, tau).end;
        Some([end.q?, end.v?])
    }

    /// All cycles by the general search, smallest first, whether or not a closed form exists.
    pub fn cycles(&self) -> Result<AllFound> {
        let mut equation = Equation::new(self, 0.5 * f64::EPSILON, &self.limits);
        let found = closings(&mut equation, usize::MAX, &[])?;
        let found = found.iter().map(|closing| closing.describe(self, equation.side)).collect();
        Ok(self.beside_proof(found))
    }

    /// Cycles that were found, with what is proved about them.
    pub fn beside_proof(&self, found: Vec<Cycle>) -> AllFound {
        let hints: Vec<f64> = found.iter().map(|cycle| cycle.clearance).collect();
        let proof = prove(&ParameterBox::from(&self.parameters), &hints);
        let certain = proof.is_complete() && proof.cycles.len() == found.len();
        let with_bounds = |cycle: Cycle| BoundedCycle {
            cycle,
            bounds: matching(&proof, &cycle).and_then(|proved| proved.enclosure),
        };
        Conclusion { value: found.into_iter().map(with_bounds).collect(), certain }
    }

    /// The smallest cycle.
    pub fn smallest(&self) -> Result<BoundedCycle> {
        self.cycles()?.value.first().copied().ok_or(missing("a limit cycle"))
    }

    /// The largest cycle.
    pub fn largest(&self) -> Result<BoundedCycle> {
        self.cycles()?.value.last().copied().ok_or(missing("a limit cycle"))
    }

    /// All motions, as far out as any edge asked for here.
    pub fn portrait(&self) -> Result<Portrait> {
        Portrait::of_oscillator(self, 10.0, &self.limits)
    }

    /// What borders the basin.
    pub fn edge(&self) -> Result<Conclusion<Border>> {
        let found = self.portrait()?;
        let proof = prove(&ParameterBox::from(&self.parameters), &[]);
        let proved = kicks::edge(&proof, found.margin.displacement);
        let certain = proved == Some(found.border);
        Ok(Conclusion { value: found.border, certain })
    }

    /// The value of D at which cycles vanish, `found` being where the search says so: enclosed to a thousandth.
    pub fn last_cycle(&self, found: f64) -> Approximation {
        /// Next to that value proofs take long.
        const AWAY: f64 = 1e-3;
        let known = ParameterBox::from(&self.parameters);
        let between = change_within(&known, Knob::D, found, AWAY);
        Approximation::relative(found, 1e-12).within(between.map(|change| change.between))
    }

    /// Mean displacement of a cycle over its period: over one turn all forces cancel, those that depend on the velocity
    /// and the spring's.
    pub fn mean(&self, cycle: &Cycle) -> Result<Approximation> {
        /// Relative error of the integrals by arcs to 1e-14.
        const INTEGRAL: f64 = 1e-11;
        let [rise, fall] = self.arcs(cycle)?;
        let Parameters { d2, d3, r, .. } = **self;
        let [second_up, third_up, _] = rise.powers().into();
        let [second_down, third_down, _] = fall.powers().into();
        let even = d2 * (second_up + second_down);
        let odd = d3 * (third_up - third_down) + r * (rise.swing.duration - fall.swing.duration);
        Ok(Approximation::new(-(even + odd) / cycle.period, INTEGRAL * cycle.q_max))
    }

    /// The arcs of a cycle above and below `v = 0`.
    pub fn arcs(&self, cycle: &Cycle) -> Result<[Arc; 2]> {
        let arc = |side, turn: f64| {
            let clearance = Length::new(turn - self.r);
            Arc::new(self, side, Direction::Forward, clearance, &self.limits)
        };
        Ok([arc(Side::Upper, -cycle.q_min)?, arc(Side::Lower, cycle.q_max)?])
    }
}
