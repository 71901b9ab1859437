//! A scan: the same measures at every point of a line or grid of parameters.
//!
//! A [`Scan`] is a list of numbered points, and a [`ScanRow`] is what was measured at one of them. Rows do
//! not depend on each other: any of them can be computed anywhere, at any time, and is the same to the
//! last bit. So a scan can be shared between cores and machines, stopped, and resumed.

use std::fmt;

use super::basin::Window;
use super::kicks::RandomKick;
use super::measure::{Conditions, MachinePoint, Measure, MeasureNeed, Value, measure, needs_of};
use crate::flow::method::Dial;
use crate::flow::{Cost, Limits, Problem, Reason};
use crate::machine::MachineProblem;
use crate::numerics::count::real;
use crate::numerics::elementary::{log10, pow};
use crate::oscillator::belt::FrictionLaw;
use crate::oscillator::unit::measured;
use crate::oscillator::{Group, Interval, Knob, ParameterBox, Parameters, State};

/// How the values of a [`Sweep`] are spaced.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Spacing {
    /// By equal differences.
    Even,
    /// By equal ratios.
    Logarithmic,
}

/// A parameter and the values through which it goes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sweep {
    /// Which parameter.
    pub symbol: Knob,
    /// First value.
    pub from: f64,
    /// Last value.
    pub to: f64,
    /// How many values.
    pub count: usize,
    /// How they are spaced.
    pub spacing: Spacing,
}

/// Fewest and most values of a [`Sweep`].
pub const COUNTS: std::ops::RangeInclusive<usize> = 2..=1_000_000;

pub const MOST_POINTS: usize = 1_000_000_000;

/// How a sweep is written.
const FORM: &str = "expected NAME=FROM:TO:COUNT, such as D=-0.95:0:400, or NAME=log:FROM:TO:COUNT";

impl Sweep {
    /// A sweep that makes sense. Fails with one line that says what is wrong and what is allowed.
    pub fn new(
        symbol: Knob,
        (from, to): (f64, f64),
        count: usize,
        spacing: Spacing,
    ) -> Result<Self, String> {
        for value in [from, to] {
            symbol.check(value).map_err(|refused| refused.to_string())?;
        }
        if from == to {
            return Err(format!("{symbol}: FROM and TO are both {from:?}"));
        }
        if !COUNTS.contains(&count) {
            return Err(format!("COUNT = {count} is not a whole number in 2 .. 1000000"));
        }
        let one_sign = (from > 0.0 && to > 0.0) || (from < 0.0 && to < 0.0);
        if spacing == Spacing::Logarithmic && !one_sign {
            return Err(format!(
                "{symbol}: log from {from:?} to {to:?}; both must have one sign and not be 0"
            ));
        }
        Ok(Sweep { symbol, from, to, count, spacing })
    }

    /// Reads `NAME=FROM:TO:COUNT` or `NAME=log:FROM:TO:COUNT`, with a number of these groups; both ends with a unit or
    /// none. Fails with one line that says what is wrong and what is allowed.
    pub fn read(text: &str, groups: &[Group]) -> Result<Self, String> {
        let (name, range) = text.split_once('=').ok_or(FORM)?;
        let symbol = Knob::named(name.trim(), groups)?;
        let (spacing, range) = match range.trim().strip_prefix("log:") {
            Some(range) => (Spacing::Logarithmic, range),
            None => (Spacing::Even, range),
        };
        let [from, to, count] = range.split(':').map(str::trim).collect::<Vec<_>>()[..] else {
            return Err(FORM.to_owned());
        };
        let whole = || format!("COUNT = {count} is not a whole number in 2 .. 1000000");
        let count = count.parse().map_err(|_| whole())?;
        let ends = (symbol.parse(from)?, symbol.parse(to)?);
        let has_unit = |text: &str| measured(text).is_ok_and(|read| read.dimension.is_some());
        if has_unit(from) != has_unit(to) {
            return Err(format!("{range:?}: FROM and TO both take a unit, or none (SI units)"));
        }
        Sweep::new(symbol, ends, count, spacing)
    }

    /// Value number `index`, the first and the last of them exactly.
    pub fn value(&self, index: usize) -> f64 {
        if index == 0 {
            return self.from;
        }
        let last = self.count - 1;
        if index >= last {
            return self.to;
        }
        let [done, left, all] = [index, last - index, last].map(real);
        let mean = |from: f64, to: f64| (from * left + to * done) / all;
        match self.spacing {
            Spacing::Even => {
                let value = mean(self.from, self.to);
                let rounding = 4.0 * f64::EPSILON * self.from.abs().max(self.to.abs());
                // Where the ends have few digits the values between have few: -0.4, not -0.39999999999999997.
                let short = format!("{value:.14e}").parse().unwrap_or(value);
                if (short - value).abs() <= rounding { short } else { value }
            }
            Spacing::Logarithmic => {
                let exponent = mean(log10(self.from.abs()), log10(self.to.abs()));
                pow(10.0, exponent).copysign(self.from)
            }
        }
    }
}

impl fmt::Display for Sweep {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Sweep { symbol, from, to, count, spacing } = self;
        let log = if *spacing == Spacing::Logarithmic { "log:" } else { "" };
        write!(out, "{symbol}={log}{from:?}:{to:?}:{count}")
    }
}

/// What is scanned: a motion of the oscillator of the paper, or of a machine by its whole model.
#[derive(Clone, Debug, PartialEq)]
pub enum ScanSource {
    /// A dimensionless motion.
    Oscillator(Problem),
    /// A motion in SI units.
    Machine(Box<MachineProblem>),
}

impl From<Problem> for ScanSource {
    fn from(problem: Problem) -> Self {
        ScanSource::Oscillator(problem)
    }
}

impl ScanSource {
    /// What can be scanned over.
    pub fn groups(&self) -> &'static [Group] {
        match self {
            ScanSource::Oscillator(_) => &[Group::Motion],
            ScanSource::Machine(_) => MachineProblem::GROUPS,
        }
    }

    /// Gives a number a value. Fails with one line if there is no such number.
    fn set(&mut self, knob: Knob, value: f64) -> Result<(), String> {
        match self {
            ScanSource::Oscillator(Problem { parameters, initial, .. }) => {
                knob.set(parameters, initial, value);
                Ok(())
            }
            ScanSource::Machine(problem) => problem.set(knob, value),
        }
    }
}

/// What is scanned, and what is measured at each point.
#[derive(Clone, Debug, PartialEq)]
pub struct Scan {
    /// The motion whose numbers the sweeps replace.
    base: ScanSource,
    over: Vec<Sweep>,
    measures: Vec<Measure>,
    conditions: Conditions,
}

/// What was measured at a point.
#[derive(Clone, Debug, PartialEq)]
pub struct ScanRow {
    /// The cells, one for each column of [`Scan::measured`].
    pub values: Vec<Value>,
    /// What could not be computed, and why.
    pub reason: Option<String>,
    pub cost: Cost,
}

impl Scan {
    /// A scan that makes sense: each sweep moves something that is measured. Fails with one line that says what is
    /// wrong and what is allowed.
    pub fn new(
        base: impl Into<ScanSource>,
        over: Vec<Sweep>,
        measures: Vec<Measure>,
        conditions: impl Into<Conditions>,
    ) -> Result<Self, String> {
        let (base, conditions) = (base.into(), conditions.into());
        if over.is_empty() || measures.is_empty() {
            return Err("a scan goes over at least one parameter and measures something".to_owned());
        }
        let needs = needs_of(&measures);
        for (index, Sweep { symbol, from, .. }) in over.iter().enumerate() {
            base.clone().set(*symbol, *from)?;
            if over[..index].iter().any(|other| other.symbol == *symbol) {
                return Err(format!("{symbol} is scanned over twice"));
            }
            if !needs.iter().any(|need| need.depends_on(*symbol)) {
                let names: Vec<_> = measures.iter().map(|measure| measure.spec().name).collect();
                return Err(format!("{} does not depend on {symbol}", names.join(", ")));
            }
        }
        for (index, measure) in measures.iter().enumerate() {
            if measures[..index].contains(measure) {
                return Err(format!("{} is measured twice", measure.spec().name));
            }
            let is_of_machines = measure.spec().needs.is_of_machines()
                && !matches!(measure, Measure::Area | Measure::Integrity);
            if matches!(base, ScanSource::Machine(_)) && !is_of_machines {
                return Err(format!("{} is not measured of a machine", measure.spec().name));
            }
            if *measure == Measure::Design && conditions.wanted.is_none() {
                return Err("design needs the margin that is wanted".to_owned());
            }
        }
        let points = over.iter().try_fold(1_usize, |points, sweep| points.checked_mul(sweep.count));
        if points.is_none_or(|points| points > MOST_POINTS) {
            return Err(format!("too many points; allowed: {MOST_POINTS}"));
        }
        Ok(Scan { base, over, measures, conditions })
    }

    /// The parameters that are scanned over; the last one varies fastest.
    pub fn over(&self) -> &[Sweep] {
        &self.over
    }

    pub fn measures(&self) -> &[Measure] {
        &self.measures
    }

    /// How many points there are.
    pub fn points(&self) -> usize {
        self.over.iter().map(|sweep| sweep.count).product()
    }

    /// Which value of each sweep point number `index` has.
    pub fn place(&self, index: usize) -> Vec<usize> {
        let mut place = vec![0; self.over.len()];
        let mut rest = index;
        for (which, sweep) in place.iter_mut().zip(&self.over).rev() {
            *which = rest % sweep.count;
            rest /= sweep.count;
        }
        place
    }

    /// The motion at point number `index`.
    pub fn source(&self, index: usize) -> ScanSource {
        let mut source = self.base.clone();
        for (sweep, which) in self.over.iter().zip(self.place(index)) {
            let set = source.set(sweep.symbol, sweep.value(which));
            debug_assert!(set.is_ok(), "a scan goes over numbers that there are: {set:?}");
        }
        source
    }

    /// The same if it is one of the oscillator of the paper.
    pub fn problem(&self, index: usize) -> Option<Problem> {
        match self.source(index) {
            ScanSource::Oscillator(problem) => Some(problem),
            ScanSource::Machine(_) => None,
        }
    }

    /// Measures point number `index`. Fails with [`Reason::Interrupted`], and no other.
    pub fn row(&self, index: usize, limits: &Limits) -> Result<ScanRow, Reason> {
        let (measures, conditions) = (&self.measures, &self.conditions);
        let (values, reasons, cost) = match self.source(index) {
            ScanSource::Oscillator(problem) => {
                let (values, point) = measure(&problem, measures, conditions, limits)?;
                (values, point.reasons(), point.cost)
            }
            ScanSource::Machine(problem) => {
                let point = MachinePoint::of(&problem, measures, conditions, limits)?;
                (point.values(measures, conditions), point.reasons, point.cost)
            }
        };
        let reason = (!reasons.is_empty()).then(|| reasons.join("; "));
        Ok(ScanRow { values, reason, cost })
    }

    /// A row that could not be measured at all.
    pub fn failed(&self, reason: String) -> ScanRow {
        let values = vec![Value::Nothing; self.measured().len()];
        ScanRow { values, reason: Some(reason), cost: Cost::default() }
    }

    /// The columns that are measured, in their order.
    pub fn measured(&self) -> Vec<&'static str> {
        self.measures.iter().flat_map(|measure| measure.spec().columns).copied().collect()
    }

    /// All that the row of point number `index` depends on, by name.
    ///
    /// With it every row says for itself what it is: rows of different scans can stand in one file.
    pub fn inputs(&self, index: usize) -> Vec<(String, Value)> {
        let mut inputs = match self.source(index) {
            ScanSource::Oscillator(problem) => self.inputs_of_motion(&problem),
            ScanSource::Machine(problem) => self.inputs_of_machine(&problem),
        };
        let Conditions { window, elongation, kicks, wanted, .. } = self.conditions;
        if self.measures.iter().any(|measure| measure.is_over_window()) {
            let Window { q, v } = window;
            inputs.extend(named([("q_from", q.0), ("q_to", q.1), ("v_from", v.0), ("v_to", v.1)]));
            if elongation {
                inputs.push(("q_of".to_owned(), Value::Word("elongation")));
            }
        }
        if self.measures.iter().any(|measure| measure.is_of_kicks()) {
            let RandomKick { law, q, v } = kicks;
            inputs.push(("kick_law".to_owned(), Value::Word(law.name())));
            inputs.extend(named([("kick_q", q.0), ("kick_q_spread", q.1)]));
            inputs.extend(named([("kick_v", v.0), ("kick_v_spread", v.1)]));
        }
        if let Some((kick, size)) = wanted.filter(|_| self.measures.contains(&Measure::Design)) {
            inputs.push((format!("wanted_{}", kick.name()), size.into()));
        }
        inputs
    }

    fn inputs_of_motion(&self, problem: &Problem) -> Vec<(String, Value)> {
        let Problem { parameters, initial, until, method, tolerance, step, epsilon } = *problem;
        let Parameters { d, d2, d3, r } = parameters;
        let mut inputs: Vec<_> = named([("D", d), ("D2", d2), ("D3", d3), ("r", r)]).collect();
        let needs = needs_of(&self.measures);
        if needs.contains(&MeasureNeed::Motion) {
            let State { q, v } = initial;
            inputs.extend(named([("q0", q), ("v0", v)]));
        }
        if needs.contains(&MeasureNeed::Motion) || needs.contains(&MeasureNeed::Settling) {
            inputs.extend(named([("until", until)]));
            inputs.push(("method".to_owned(), Value::Word(method.spec().name)));
            inputs.extend(match method.spec().dial {
                Dial::Nothing => None,
                Dial::Tolerance => Some(("tolerance".to_owned(), tolerance.into())),
                Dial::Step => Some(("step".to_owned(), step.into())),
                Dial::Epsilon => Some(("epsilon".to_owned(), epsilon.into())),
            });
        }
        if self.measures.contains(&Measure::Guaranteed) {
            let ParameterBox { d, d2, d3, r } = self.conditions.around(&parameters);
            inputs.extend(named([("w", self.conditions.disturbance)]));
            inputs.extend(Knob::PARAMETERS.into_iter().zip([d, d2, d3, r]).flat_map(ends));
        }
        inputs
    }

    fn inputs_of_machine(&self, problem: &MachineProblem) -> Vec<(String, Value)> {
        let MachineProblem { subject, tolerances, start, until } = problem;
        let value = |(knob, value): (Knob, f64)| (knob.to_string(), value.into());
        let mut inputs: Vec<_> = subject.numbers().map(value).collect();
        let belt = subject.of_belt();
        if let Some(FrictionLaw::Table(table)) = belt.map(|belt| &belt.law) {
            let which = Value::Count(table.fingerprint() as usize);
            inputs.push(("friction_table".to_owned(), which));
        }
        if let Some(tolerance) = subject.tolerance {
            inputs.extend(named([("tolerance", tolerance)]));
        }
        let needs = needs_of(&self.measures);
        if needs.contains(&MeasureNeed::Motion) {
            inputs.extend(named([("x", start.0), ("v", start.1), ("until", *until)]));
        }
        let certain = needs.contains(&MeasureNeed::Guarantee)
            || (needs.contains(&MeasureNeed::Design) && !tolerances.is_none());
        if let Some(belt) = belt.filter(|_| certain) {
            inputs.extend(named([("w", tolerances.disturbance)]));
            inputs.extend(tolerances.intervals(belt).into_iter().flat_map(ends));
        }
        inputs
    }
}

/// Inputs that are numbers.
fn named<const N: usize>(
    numbers: [(&str, f64); N],
) -> impl Iterator<Item = (String, Value)> + use<N> {
    numbers.map(|(name, value)| (name.to_owned(), value.into())).into_iter()
}

/// The ends of the interval of a number, as inputs.
fn ends((knob, interval): (Knob, Interval)) -> [(String, Value); 2] {
    let end = |name: &str, value: f64| (format!("{knob}_{name}"), value.into());
    [end("from", interval.lower()), end("to", interval.upper())]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sweep(text: &str) -> Result<Sweep, String> {
        Sweep::read(text, &[Group::Motion])
    }

    fn scan(over: &[&str], measures: &[Measure]) -> Result<Scan, String> {
        let over = over.iter().map(|text| sweep(text)).collect::<Result<_, _>>()?;
        let window = Window { q: (-3.0, 3.0), v: (-3.0, 3.0) };
        Scan::new(Problem::default(), over, measures.to_vec(), window)
    }

    #[test]
    fn a_sweep_keeps_its_direction_its_ends_and_round_numbers() {
        let down = sweep("D=0:-0.5:6").unwrap();
        let values: Vec<f64> = (0..6).map(|index| down.value(index)).collect();
        assert_eq!(values, [0.0, -0.1, -0.2, -0.3, -0.4, -0.5]);
        let up = sweep("D=-0.6:-0.1:6").unwrap();
        let values: Vec<f64> = (0..6).map(|index| up.value(index)).collect();
        assert_eq!(values, [-0.6, -0.5, -0.4, -0.3, -0.2, -0.1]);
        let decades = sweep("r=log:1e-3:1:4").unwrap();
        let values: Vec<f64> = (0..4).map(|index| decades.value(index)).collect();
        assert_eq!(values, [0.001, 0.01, 0.1, 1.0]);
        let negative = sweep("D=log:-0.01:-1:3").unwrap();
        assert_eq!(negative.value(1), -0.1);
        for text in ["D=0.0:-0.5:6", "r=log:0.001:1.0:4"] {
            assert_eq!(sweep(text).unwrap().to_string(), text);
        }
    }

    #[test]
    fn sweeps_that_make_no_sense_are_refused_in_one_line_with_what_is_allowed() {
        for (text, expected) in [
            ("D", "NAME=FROM:TO:COUNT"),
            ("D=0:1", "NAME=FROM:TO:COUNT"),
            ("x=0:1:3", "no number \"x\"; there are D, D2, D3, r, q0, v0"),
            ("D=a:1:3", "\"a\" is not a number; D takes -1e6 .. 1e6"),
            ("D=NaN:1:3", "\"NaN\" is not a number; D takes"),
            ("r=-1:1:3", "r = -1 is outside its range 0 .. 1e150"),
            ("D=0:0:3", "both 0.0"),
            ("D=0:1:1", "COUNT = 1 is not a whole number in 2 .. 1000000"),
            ("D=0:1:-4", "COUNT = -4 is not"),
            ("D=log:0:1:3", "one sign"),
            ("D=log:-1:1:3", "one sign"),
        ] {
            let refused = sweep(text).unwrap_err();
            assert!(refused.contains(expected) && !refused.contains('\n'), "{text}: {refused}");
        }
    }

    #[test]
    fn a_scan_measures_what_its_sweeps_move() {
        let margin = [Measure::Margin];
        assert!(scan(&["D=-1:0:3"], &margin).is_ok());
        for (over, measures, expected) in [
            (&["q0=-1:0:3"][..], &margin[..], "margin does not depend on q0"),
            (&["D=-1:0:3", "D=-2:0:3"], &margin, "D is scanned over twice"),
            (&["D=-1:0:3"], &[Measure::Fold], "fold does not depend on D"),
            (&["D=-1:0:3"], &[Measure::Margin, Measure::Margin], "margin is measured twice"),
            (&[], &margin, "at least one"),
            (&["D=-1:0:1000000", "r=0:1:100000"], &margin, "too many points"),
        ] {
            let refused = scan(over, measures).unwrap_err();
            assert!(refused.contains(expected), "{refused}");
        }
    }

    #[test]
    fn points_are_numbered_with_the_last_sweep_fastest() {
        let grid = scan(&["r=0.1:0.3:3", "D=-0.5:-0.1:2"], &[Measure::Area]).unwrap();
        assert_eq!(grid.points(), 6);
        let at = |index| {
            let parameters = grid.problem(index).unwrap().parameters;
            (parameters.r, parameters.d)
        };
        assert_eq!(
            [at(0), at(1), at(2), at(5)],
            [(0.1, -0.5), (0.1, -0.1), (0.2, -0.5), (0.3, -0.1)]
        );
        assert_eq!(grid.place(5), [2, 1]);
    }

    #[test]
    fn a_row_names_exactly_its_inputs() {
        let names = |measures: &[Measure]| -> Vec<String> {
            let scan = scan(&["D=-0.5:-0.1:2"], measures).unwrap();
            scan.inputs(0).into_iter().map(|(name, _)| name).collect()
        };
        assert_eq!(names(&[Measure::Margin]), ["D", "D2", "D3", "r"]);
        let motion = ["D", "D2", "D3", "r", "q0", "v0", "until", "method", "tolerance"];
        assert_eq!(names(&[Measure::Rest]), motion);
        let window = ["D", "D2", "D3", "r", "q_from", "q_to", "v_from", "v_to"];
        assert_eq!(names(&[Measure::Stability]), window);
    }
}
