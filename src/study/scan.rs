//! A scan: the same measures at every point of a line or grid of parameters.
//!
//! A [`Scan`] is a list of numbered points, and a [`ScanRow`] is what was measured at one of them. Rows do
//! not depend on each other: any of them can be computed anywhere, at any time, and is the same to the
//! last bit. So a scan can be shared between cores and machines, stopped, and resumed.

use std::fmt;
use std::str::FromStr;

use super::basin::Window;
use super::kicks::RandomKick;
use super::measure::{Conditions, Measure, MeasureNeed, Value, measure, needs_of};
use crate::flow::method::Dial;
use crate::flow::{Cost, Limits, Problem, Reason};
use crate::numerics::count::real;
use crate::numerics::elementary::{log10, pow};
use crate::oscillator::{Group, Knob, ParameterBox, Parameters, State};

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

impl FromStr for Sweep {
    type Err = String;

    /// Reads `NAME=FROM:TO:COUNT` or `NAME=log:FROM:TO:COUNT`.
    fn from_str(text: &str) -> Result<Self, String> {
        let (name, range) = text.split_once('=').ok_or(FORM)?;
        let symbol = Knob::named(name.trim(), &[Group::Motion])?;
        let (spacing, range) = match range.trim().strip_prefix("log:") {
            Some(range) => (Spacing::Logarithmic, range),
            None => (Spacing::Even, range),
        };
        let [from, to, count] = range.split(':').map(str::trim).collect::<Vec<_>>()[..] else {
            return Err(FORM.to_owned());
        };
        let whole = || format!("COUNT = {count} is not a whole number in 2 .. 1000000");
        let count = usize::from_str(count).map_err(|_| whole())?;
        Sweep::new(symbol, (symbol.parse(from)?, symbol.parse(to)?), count, spacing)
    }
}

impl fmt::Display for Sweep {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Sweep { symbol, from, to, count, spacing } = self;
        let log = if *spacing == Spacing::Logarithmic { "log:" } else { "" };
        write!(out, "{symbol}={log}{from:?}:{to:?}:{count}")
    }
}

/// What is scanned, and what is measured at each point.
#[derive(Clone, Debug, PartialEq)]
pub struct Scan {
    /// The motion whose numbers the sweeps replace.
    base: Problem,
    over: Vec<Sweep>,
    measures: Vec<Measure>,
    conditions: Conditions,
}

/// Columns for the ends of the intervals of D, D2, D3 and r.
const ENDS: [[&str; 2]; 4] =
    [["D_from", "D_to"], ["D2_from", "D2_to"], ["D3_from", "D3_to"], ["r_from", "r_to"]];

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
        base: Problem,
        over: Vec<Sweep>,
        measures: Vec<Measure>,
        conditions: impl Into<Conditions>,
    ) -> Result<Self, String> {
        if over.is_empty() || measures.is_empty() {
            return Err("a scan goes over at least one parameter and measures something".to_owned());
        }
        let needs = needs_of(&measures);
        for (index, Sweep { symbol, .. }) in over.iter().enumerate() {
            if over[..index].iter().any(|other| other.symbol == *symbol) {
                return Err(format!("{symbol} is scanned over twice"));
            }
            if !needs.iter().any(|need| need.depends_on().contains(symbol)) {
                let names: Vec<_> = measures.iter().map(|measure| measure.spec().name).collect();
                return Err(format!("{} does not depend on {symbol}", names.join(", ")));
            }
        }
        for (index, measure) in measures.iter().enumerate() {
            if measures[..index].contains(measure) {
                return Err(format!("{} is measured twice", measure.spec().name));
            }
        }
        let points = over.iter().try_fold(1_usize, |points, sweep| points.checked_mul(sweep.count));
        if points.is_none_or(|points| points > MOST_POINTS) {
            return Err(format!("too many points; allowed: {MOST_POINTS}"));
        }
        Ok(Scan { base, over, measures, conditions: conditions.into() })
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
    pub fn problem(&self, index: usize) -> Problem {
        let mut problem = self.base;
        for (sweep, which) in self.over.iter().zip(self.place(index)) {
            let Problem { parameters, initial, .. } = &mut problem;
            sweep.symbol.set(parameters, initial, sweep.value(which));
        }
        problem
    }

    /// Measures point number `index`. Fails with [`Reason::Interrupted`], and no other.
    pub fn row(&self, index: usize, limits: &Limits) -> Result<ScanRow, Reason> {
        let problem = self.problem(index);
        let (values, point) = measure(&problem, &self.measures, &self.conditions, limits)?;
        let reasons =
            point.failures.iter().map(|(need, reason)| format!("{}: {reason}", need.name()));
        let uncertain = point.uncertain.iter().map(|why| format!("guaranteed: {why}"));
        let reasons: Vec<_> = reasons.chain(uncertain).collect();
        let reason = (!reasons.is_empty()).then(|| reasons.join("; "));
        Ok(ScanRow { values, reason, cost: point.cost })
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
    pub fn inputs(&self, index: usize) -> Vec<(&'static str, Value)> {
        let Problem { parameters, initial, until, method, tolerance, step, epsilon } =
            self.problem(index);
        let Parameters { d, d2, d3, r } = parameters;
        let mut inputs: Vec<(&str, Value)> =
            vec![("D", d.into()), ("D2", d2.into()), ("D3", d3.into()), ("r", r.into())];
        let needs = needs_of(&self.measures);
        if needs.contains(&MeasureNeed::Motion) {
            let State { q, v } = initial;
            inputs.extend([("q0", q.into()), ("v0", v.into())]);
        }
        if needs.contains(&MeasureNeed::Motion) || needs.contains(&MeasureNeed::Settling) {
            let name = method.spec().name;
            inputs.push(("until", until.into()));
            inputs.push(("method", Value::Word(name)));
            match method.spec().dial {
                Dial::Nothing => {}
                Dial::Tolerance => inputs.push(("tolerance", tolerance.into())),
                Dial::Step => inputs.push(("step", step.into())),
                Dial::Epsilon => inputs.push(("epsilon", epsilon.into())),
            }
        }
        let windowed = [Measure::Stability, Measure::Settling, Measure::FiniteTime];
        if windowed.iter().any(|measure| self.measures.contains(measure)) {
            let Window { q, v } = self.conditions.window;
            inputs.extend([("q_from", q.0.into()), ("q_to", q.1.into())]);
            inputs.extend([("v_from", v.0.into()), ("v_to", v.1.into())]);
        }
        if self.measures.contains(&Measure::Guaranteed) {
            inputs.push(("w", self.conditions.disturbance.into()));
            let ParameterBox { d, d2, d3, r } = self.conditions.around(&parameters);
            for ([from, to], it) in ENDS.into_iter().zip([d, d2, d3, r]) {
                inputs.extend([(from, it.lower().into()), (to, it.upper().into())]);
            }
        }
        if [Measure::Lost, Measure::Repeated].iter().any(|one| self.measures.contains(one)) {
            let RandomKick { law, q, v } = self.conditions.kicks;
            inputs.push(("kick_law", Value::Word(law.name())));
            inputs.extend([("kick_q", q.0.into()), ("kick_q_spread", q.1.into())]);
            inputs.extend([("kick_v", v.0.into()), ("kick_v_spread", v.1.into())]);
        }
        inputs
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sweep(text: &str) -> Result<Sweep, String> {
        text.parse()
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
            let parameters = grid.problem(index).parameters;
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
        let names = |measures: &[Measure]| -> Vec<&str> {
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
