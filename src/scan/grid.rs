//! A scan: the same measures at every point of a line or grid of parameters, or of a list.
//!
//! A [`Scan`] is a list of numbered points, and a [`ScanRow`] is what was measured at one of them. Rows do
//! not depend on each other: any of them can be computed anywhere, at any time, and is the same to the
//! last bit. So a scan can be shared between cores and machines, stopped, and resumed.

use super::{Conditions, Measure, OF_THE_PAPER, Origin, ScanRow, Sweep, Value, measure};
use crate::flow::{Cost, Limits, Problem, Result, Subject};
use crate::model::{FrictionLaw, Interval, Knob, State};
use crate::portrait::{RandomKick, StartWindow};

/// Most points of a scan.
pub const MOST_POINTS: usize = 1_000_000_000;

/// A number and its values at all points of a list.
pub type Column = (Knob, Vec<f64>);

/// What is scanned, and what is measured at each point.
#[derive(Clone, Debug, PartialEq)]
pub struct Scan {
    /// What is scanned: the sweeps replace its numbers.
    base: Subject,
    over: Vec<Sweep>,
    /// The columns of a list of points; none of a grid.
    list: Vec<Column>,
    measures: Vec<Measure>,
    conditions: Conditions,
}

impl Scan {
    /// A scan that makes sense: each sweep moves something that is measured.
    ///
    /// # Errors
    /// One line that says what is wrong and what is allowed.
    pub fn new(
        base: impl Into<Subject>,
        over: Vec<Sweep>,
        measures: Vec<Measure>,
        conditions: impl Into<Conditions>,
    ) -> Result<Self, String> {
        let (base, conditions) = (base.into(), conditions.into());
        Scan { base, over, list: Vec::new(), measures, conditions }.checked()
    }

    /// The same at the points of a list, in their order.
    ///
    /// # Errors
    /// One line, as for [`Self::new`].
    pub fn of_list(
        base: impl Into<Subject>,
        list: Vec<Column>,
        measures: Vec<Measure>,
        conditions: impl Into<Conditions>,
    ) -> Result<Self, String> {
        let (base, conditions) = (base.into(), conditions.into());
        Scan { base, over: Vec::new(), list, measures, conditions }.checked()
    }

    /// The scan, if it makes sense.
    fn checked(self) -> Result<Self, String> {
        let Scan { base, measures, conditions, .. } = &self;
        if self.points() > MOST_POINTS {
            return Err(format!("too many points; allowed: {MOST_POINTS}"));
        }
        if self.points() == 0 || self.list.len() + self.over.len() == 0 || measures.is_empty() {
            return Err("a scan goes over at least one parameter and measures something".to_owned());
        }
        let mut trial = base.clone();
        for (symbol, values) in &self.list {
            if values.len() != self.points() {
                return Err(format!(
                    "{symbol} has {} values for {} points",
                    values.len(),
                    self.points()
                ));
            }
            values.iter().try_for_each(|value| trial.set(*symbol, *value))?;
        }
        let first = self.values(0);
        for (index, (symbol, value)) in first.iter().enumerate() {
            base.clone().set(*symbol, *value)?;
            if first[..index].iter().any(|(other, _)| other == symbol) {
                return Err(format!("{symbol} is scanned over twice"));
            }
            // A list may have columns that others of its measures need.
            let counts = |measure: &Measure| measure.depends_on(*symbol);
            if self.list.is_empty() && !measures.iter().any(counts) {
                let names: Vec<_> = measures.iter().map(|measure| measure.spec().name).collect();
                return Err(format!("{} does not depend on {symbol}", names.join(", ")));
            }
        }
        for (index, measure) in measures.iter().enumerate() {
            if measures[..index].contains(measure) {
                return Err(format!("{} is measured twice", measure.spec().name));
            }
            if base.paper().is_none() && OF_THE_PAPER.contains(measure) {
                return Err(format!("{} is not measured of a machine", measure.spec().name));
            }
            if *measure == Measure::Design && conditions.wanted.is_none() {
                return Err("design needs the margin that is wanted".to_owned());
            }
        }
        Ok(self)
    }

    /// The same scan of one measure, through so many values of each number.
    ///
    /// # Errors
    /// What [`Scan::new`] refuses, in one line.
    pub fn on_lattice(&self, measure: Measure, count: usize) -> Result<Self, String> {
        let over = self.over.iter().map(|sweep| Sweep { count, ..*sweep }).collect();
        Scan::new(self.base.clone(), over, vec![measure], self.conditions.clone())
    }

    /// The numbers that are scanned over; the last one varies fastest.
    pub fn over(&self) -> &[Sweep] {
        &self.over
    }

    /// The numbers that differ from point to point.
    pub fn varied(&self) -> Vec<Knob> {
        self.values(0).into_iter().map(|(symbol, _)| symbol).collect()
    }

    /// What is measured at each point.
    pub fn measures(&self) -> &[Measure] {
        &self.measures
    }

    /// How many points there are.
    pub fn points(&self) -> usize {
        let counts = self.over.iter().map(|sweep| sweep.count);
        let of_grid = || counts.fold(1, usize::saturating_mul);
        self.list.first().map_or_else(of_grid, |(_, values)| values.len())
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

    /// The numbers that are set at point number `index`, and their values there.
    fn values(&self, index: usize) -> Vec<(Knob, f64)> {
        let listed = self.list.iter().map(|(symbol, values)| (*symbol, values[index]));
        let swept = self.over.iter().zip(self.place(index));
        listed.chain(swept.map(|(sweep, which)| (sweep.symbol, sweep.value(which)))).collect()
    }

    /// What is measured at point number `index`.
    fn subject(&self, index: usize) -> Subject {
        self.with(self.values(index))
    }

    /// What is measured where these numbers are set.
    fn with(&self, values: impl IntoIterator<Item = (Knob, f64)>) -> Subject {
        let mut subject = self.base.clone();
        for (symbol, value) in values {
            let set = subject.set(symbol, value);
            debug_assert!(set.is_ok(), "a scan goes over numbers that there are: {set:?}");
        }
        subject
    }

    /// Its motion, if it is one of the oscillator of the paper.
    pub fn problem(&self, index: usize) -> Option<Problem> {
        self.subject(index).paper()
    }

    /// Measures point number `index`.
    ///
    /// # Errors
    /// [`Reason::Interrupted`](crate::model::Reason::Interrupted), and no other.
    pub fn row(&self, index: usize, limits: &Limits) -> Result<ScanRow> {
        measure(&self.subject(index), &self.measures, &self.conditions, limits)
    }

    /// Measures between the points, where the numbers that are scanned over have these values.
    ///
    /// # Errors
    /// [`Reason::Interrupted`](crate::model::Reason::Interrupted), and no other.
    pub fn row_at(&self, values: [f64; 2], limits: &Limits) -> Result<ScanRow> {
        let values = self.over.iter().map(|sweep| sweep.symbol).zip(values);
        measure(&self.with(values), &self.measures, &self.conditions, limits)
    }

    /// A row that could not be measured at all.
    pub fn failed(&self, reason: String) -> ScanRow {
        let values = self.measures.iter().flat_map(|it| it.spec().unfilled()).collect();
        ScanRow { values, reason: Some(reason), cost: Cost::default() }
    }

    /// The columns that are measured, in their order.
    pub fn measured(&self) -> Vec<&'static str> {
        self.measures.iter().flat_map(|measure| &measure.spec().columns).copied().collect()
    }

    /// All that the row of point number `index` depends on, by name.
    ///
    /// With it every row says for itself what it is: rows of different scans can stand in one file.
    pub fn inputs(&self, index: usize) -> Vec<(String, Value)> {
        let mut inputs = self.inputs_of(&self.subject(index));
        let Conditions { window, origin, kicks, wanted } = self.conditions;
        if self.measures.iter().any(|measure| measure.is_over_window()) {
            let StartWindow { q, v } = window;
            inputs.extend(named([("q_from", q.0), ("q_to", q.1), ("v_from", v.0), ("v_to", v.1)]));
            if origin == Origin::Relaxed {
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

    /// All that it depends on of the subject at a point.
    fn inputs_of(&self, subject: &Subject) -> Vec<(String, Value)> {
        let Subject { source, tolerances, motion } = subject;
        let (paper, belt) = (subject.paper(), source.of_belt());
        let value = |(knob, value): (Knob, f64)| (knob.to_string(), value.into());
        let mut inputs: Vec<_> = source.numbers().map(value).collect();
        if let Some(FrictionLaw::Table(table)) = belt.map(|belt| &belt.law) {
            let which = Value::Count(table.fingerprint() as usize);
            inputs.push(("friction_table".to_owned(), which));
        }
        if let Some(tolerance) = source.tolerance {
            inputs.extend(named([("tolerance", tolerance)]));
        }
        let asked = |measure| self.measures.iter().any(|it| it.with() == measure);
        if asked(Measure::Outcome) {
            let State { q, v } = motion.initial;
            let [place, speed] = if paper.is_some() { ["q0", "v0"] } else { ["x", "v"] };
            inputs.extend(named([(place, q), (speed, v)]));
        }
        if asked(Measure::Outcome) || asked(Measure::Settling) {
            inputs.extend(named([("until", motion.until)]));
            // A machine is followed by one method.
            if let Some(problem) = paper {
                let spec = problem.method.spec();
                inputs.push(("method".to_owned(), Value::Word(spec.name)));
                let dial = spec.dial.map(|dial| named([(dial.spec().name, problem.get(dial))]));
                inputs.extend(dial.into_iter().flatten());
            }
        }
        let certain = asked(Measure::Guaranteed);
        let designed = asked(Measure::Design) && !tolerances.is_none();
        if let Some(problem) = paper.filter(|_| certain) {
            let known = tolerances.around(&problem.parameters).numbers();
            inputs.extend(named([("w", tolerances.disturbance)]));
            inputs.extend(Knob::PARAMETERS.into_iter().zip(known).flat_map(ends));
        }
        if let Some(belt) = belt.filter(|_| certain || designed) {
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
    use crate::model::Group;

    fn scan(over: &[&str], measures: &[Measure]) -> Result<Scan, String> {
        let sweep = |text: &&str| Sweep::read(text, &[Group::Motion]);
        let over = over.iter().map(sweep).collect::<Result<_, _>>()?;
        let window = StartWindow { q: (-3.0, 3.0), v: (-3.0, 3.0) };
        Scan::new(Problem::default(), over, measures.to_vec(), window)
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
