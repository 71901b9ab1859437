//! From numbers to a verdict, by one rule.
//!
//! Claims are judged by numbers with bounds, and by answers to questions: beside a number stands an interval that certainly
//! holds it, beside the answer to a question whether it is certain. From these follows the [`Certainty`] of a claim.

use std::fmt;

use serde::Serialize;

use crate::numerics::{Interval, real};

/// An approximation that is off by more than this does not count as one. More would let
/// a fold that D2 moves by an eighth pass as one that D2 does not move.
pub const POOR: f64 = 0.1;

/// What is claimed about the two numbers.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Sense {
    /// They are equal.
    Equal,
    /// The paper's approximates the computed one.
    Near,
    /// The paper's is a lower bound of the computed one.
    AtMost,
    /// They approach each other in a limit.
    Tends,
    /// Something holds in all cases: the paper's number is how many cases there are, the computed one in
    /// how many of them it holds.
    Always,
}

/// A number and how far it may be off.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Approximation {
    /// The number.
    pub value: f64,
    /// Bound on its error.
    pub error: f64,
    /// An interval that certainly holds it, where a proof gave one.
    pub bounds: Option<Interval>,
}

impl Approximation {
    /// A number and how far it may be off.
    pub fn new(value: f64, error: f64) -> Self {
        Approximation { value, error, bounds: None }
    }

    /// With an interval that certainly holds it.
    pub fn within(self, bounds: impl Into<Option<Interval>>) -> Self {
        Approximation { bounds: bounds.into(), ..self }
    }

    /// With another number added.
    pub fn plus(self, shift: f64) -> Self {
        let bounds = self.bounds.map(|it| it + Interval::point(shift));
        Approximation { value: self.value + shift, bounds, ..self }
    }

    /// A multiple of it.
    pub fn times(self, factor: f64) -> Self {
        let bounds = self.bounds.map(|it| it * factor);
        Approximation { value: factor * self.value, error: (factor * self.error).abs(), bounds }
    }

    /// Whether it is larger than a number.
    pub fn exceeds(&self, limit: f64) -> Conclusion<bool> {
        let value = self.value > limit;
        let certain = self.bounds.is_some_and(|it| {
            if value {
                it.lower() > limit
            } else {
                it.upper() <= limit
            }
        });
        Conclusion { value, certain }
    }

    /// A number that is what it is, such as a count.
    pub fn exact(value: f64) -> Self {
        Approximation::new(value, 0.0)
    }

    /// A number with a relative error.
    pub fn relative(value: f64, part: f64) -> Self {
        Approximation::new(value, part * value.abs())
    }

    /// Two answers to one question: the first, with their difference as its error.
    pub fn twice(value: f64, again: f64) -> Self {
        Approximation::new(value, (value - again).abs() + 4.0 * f64::EPSILON * value.abs())
    }
}

/// The answer to a question, and whether that is proved.
#[derive(Clone, Copy, Debug)]
pub struct Conclusion<T> {
    /// The answer.
    pub value: T,
    /// Whether it is proved.
    pub certain: bool,
}

impl From<bool> for Conclusion<bool> {
    fn from(value: bool) -> Self {
        Conclusion { value, certain: false }
    }
}

impl<T> Conclusion<T> {
    /// The answer to a question that this one decides.
    pub fn map<A>(&self, decide: impl FnOnce(&T) -> A) -> Conclusion<A> {
        Conclusion { value: decide(&self.value), certain: self.certain }
    }
}

impl<T: Copy + PartialEq> Conclusion<T> {
    /// Whether it is as expected.
    pub fn is(&self, expected: T) -> Conclusion<bool> {
        self.map(|value| *value == expected)
    }
}

/// What is certain about a claim; about several cases, the variant among them that stands last.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Certainty {
    /// It holds in all cases that were tested.
    Proved,
    /// The number with which it is compared is enclosed: to as many digits as that gives, it holds.
    Enclosed,
    /// It does not hold: in one of these at least.
    Refuted,
}

impl Certainty {
    /// One word for scripts and tables.
    pub fn name(self) -> &'static str {
        match self {
            Certainty::Proved => "proved",
            Certainty::Refuted => "refuted",
            Certainty::Enclosed => "enclosed",
        }
    }

    /// The mark of what certainly holds, or certainly fails.
    fn decided(holds: bool, fails: bool) -> Option<Certainty> {
        let refuted = fails.then_some(Certainty::Refuted);
        refuted.or(holds.then_some(Certainty::Proved))
    }

    /// The mark of a formula beside what it is compared with.
    pub(crate) fn of(sense: Sense, formula: f64, computed: &Approximation) -> Option<Self> {
        let bounds = computed.bounds?;
        let formula = with_rounding(formula, computed.error);
        let [holds, fails] = match sense {
            Sense::Equal => [false, formula.intersection(bounds).is_none()],
            Sense::AtMost => [formula.upper() <= bounds.lower(), formula.lower() > bounds.upper()],
            Sense::Near => {
                let miss = miss(formula, bounds);
                [miss.upper() <= POOR, miss.lower() > POOR]
            }
            Sense::Tends | Sense::Always => return None,
        };
        let enclosed = bounds.is_finite().then_some(Certainty::Enclosed);
        Certainty::decided(holds, fails).or(enclosed)
    }

    /// The mark of a limit, from the formula and what it is compared with far from it and nearer.
    pub(crate) fn of_limit(
        far: (f64, &Approximation),
        near: (f64, &Approximation),
    ) -> Option<Certainty> {
        let miss = |(formula, computed): (f64, &Approximation)| {
            Some(miss(with_rounding(formula, computed.error), computed.bounds?))
        };
        let (far, near) = (miss(far)?, miss(near)?);
        let decided = Certainty::decided(near.upper() < far.lower(), near.lower() > far.upper());
        decided.or(Some(Certainty::Enclosed))
    }
}

/// A formula that was evaluated in doubles.
fn with_rounding(formula: f64, error: f64) -> Interval {
    /// Far more than the rounding of any formula here, as a fraction of its value.
    const ROUNDING: f64 = 1e-9;
    Interval::around(formula, ROUNDING * formula.abs() + error)
}

/// The relative error of a formula, or its absolute error if one of the two is zero.
fn miss(formula: Interval, bounds: Interval) -> Interval {
    let difference = formula - bounds;
    let zero = Interval::point(0.0);
    let part = if formula == zero || bounds == zero {
        difference
    } else {
        difference / bounds
    };
    let size = part.square().sqrt();
    Interval::new(size.lower().max(0.0), size.upper())
}

/// Rounding of a formula, as a fraction of its value.
const ROUNDING: f64 = 16.0 * f64::EPSILON;

/// The numbers that decide a claim.
#[derive(Clone, Debug, PartialEq)]
pub struct Evidence {
    /// What is claimed about them.
    pub sense: Sense,
    /// Where: parameters, start, what is counted.
    pub place: String,
    /// The paper's formula evaluated; `None` where the paper is silent.
    pub paper: Option<f64>,
    /// The corrected formula evaluated, or the formula for what the paper is silent about.
    pub corrected: Option<f64>,
    /// The same thing computed without the formula.
    pub computed: Approximation,
    /// Of a limit, the relative difference further from it.
    before: f64,
    /// How many cases this one, the worst, was chosen from.
    pub cases: usize,
    /// In how many of these it holds as printed.
    pub held: usize,
    /// What is certain, of all cases.
    pub mark: Option<Certainty>,
}

/// What the numbers say about a claim.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Verdict {
    /// It holds as far as the computed numbers are known.
    Agrees,
    /// It holds approximately.
    Approximates {
        /// Relative difference.
        within: f64,
    },
    /// It fails as printed, and holds in its corrected form.
    Corrected {
        /// Relative difference of the corrected form, where that is an approximation.
        within: Option<f64>,
    },
    /// It holds in some cases, or over a part of its range.
    InPart,
    /// It does not hold.
    False,
}

impl Evidence {
    /// A formula and what it should be equal to.
    pub fn equal(paper: f64, computed: Approximation) -> Self {
        Self::new(Sense::Equal, paper, computed)
    }

    fn new(sense: Sense, paper: f64, computed: Approximation) -> Self {
        let mut evidence = Evidence {
            sense,
            place: String::new(),
            paper: Some(paper),
            corrected: None,
            computed,
            before: 0.0,
            cases: 1,
            held: 0,
            mark: Certainty::of(sense, paper, &computed),
        };
        evidence.held = usize::from(evidence.holds(paper));
        evidence
    }

    /// A formula and what it should approximate.
    pub fn near(paper: f64, computed: Approximation) -> Self {
        Self::new(Sense::Near, paper, computed)
    }

    /// A formula and what it should be a lower bound of.
    pub fn at_most(paper: f64, computed: Approximation) -> Self {
        Self::new(Sense::AtMost, paper, computed)
    }

    /// A formula and what it should approach, at two places, the second nearer to the limit.
    pub fn tends(
        (far, far_computed): (f64, Approximation),
        (near, near_computed): (f64, Approximation),
    ) -> Self {
        let mark = Certainty::of_limit((far, &far_computed), (near, &near_computed));
        let before = Self::near(far, far_computed).miss();
        let evidence = Evidence { before, mark, ..Self::new(Sense::Tends, near, near_computed) };
        Evidence { held: usize::from(evidence.holds(near)), ..evidence }
    }

    /// What should hold in each of these cases; the place becomes the first in which it does not. Fails with the
    /// first error among them.
    pub fn always<E>(
        cases: impl IntoIterator<Item = Result<(impl fmt::Display, Conclusion<bool>), E>>,
    ) -> Result<Self, E> {
        let answers = cases.into_iter().collect::<Result<Vec<_>, E>>()?;
        let failing: Vec<_> = answers.iter().filter(|(_, answer)| !answer.value).collect();
        let (cases, held) = (answers.len(), answers.len() - failing.len());
        let place = failing.first().map(|(case, _)| format!("first fails at {case}"));
        let is_refuted = failing.iter().any(|(_, answer)| answer.certain);
        let is_proved = answers.iter().all(|(_, answer)| answer.certain);
        let mark = Certainty::decided(is_proved && cases > 0, is_refuted);
        let numbers = Self::new(Sense::Always, real(cases), Approximation::exact(real(held)));
        Ok(Evidence { place: place.unwrap_or_default(), cases, held, mark, ..numbers })
    }

    /// The same, but the paper is silent: its formula is one of ours.
    pub fn unsaid(self) -> Self {
        Evidence { corrected: self.paper.or(self.corrected), paper: None, ..self }
    }

    /// With the formula as it should read.
    pub fn corrected(self, value: f64) -> Self {
        Evidence { corrected: Some(value), ..self }
    }

    /// With a description of the place.
    pub fn at(self, place: impl fmt::Display) -> Self {
        Evidence { place: place.to_string(), ..self }
    }

    /// Of several cases of one claim, the one that misses most; first of all one that the corrected formula
    /// misses too. Fails with the first error among them.
    pub fn worst<E>(each: impl IntoIterator<Item = Result<Self, E>>) -> Result<Self, E> {
        let all = each.into_iter().collect::<Result<Vec<_>, E>>()?;
        let cases = all.iter().map(|it| it.cases).sum();
        let held = all.iter().map(|it| it.held).sum();
        let mark = all.iter().try_fold(Certainty::Proved, |mark, it| Some(mark.max(it.mark?)));
        let order = |it: &Self| (it.corrected.is_some_and(|at| !it.holds(at)), it.strain());
        let worse = |one: Self, next: Self| if order(&next) > order(&one) { next } else { one };
        let none = || Self::new(Sense::Always, 0.0, Approximation::exact(0.0));
        let worst = all.into_iter().reduce(worse).unwrap_or_else(none);
        Ok(Evidence { cases, held, mark, ..worst })
    }

    /// The paper's number minus the computed one; the corrected one's where the paper is silent.
    pub fn difference(&self) -> Option<f64> {
        Some(self.paper.or(self.corrected)? - self.computed.value)
    }

    /// That difference as a fraction of the computed number, or as it is if one of the two is zero.
    pub fn miss(&self) -> f64 {
        self.difference().map_or(f64::NAN, |difference| self.part(difference))
    }

    fn part(&self, difference: f64) -> f64 {
        (difference / self.scale()).abs()
    }

    /// What differences are measured against.
    pub fn scale(&self) -> f64 {
        let (formula, computed) = (self.paper.or(self.corrected), self.computed.value);
        if formula == Some(0.0) || computed == 0.0 {
            1.0
        } else {
            computed.abs()
        }
    }

    /// How near the claim is to failing, above 1 where it fails; for bounds, how little they leave.
    fn strain(&self) -> f64 {
        let difference = self.difference().unwrap_or(f64::NAN);
        match self.sense {
            Sense::AtMost => difference / self.scale(),
            _ => difference.abs() / self.bound(),
        }
    }

    /// The largest difference with which the claim still holds.
    pub fn bound(&self) -> f64 {
        let known = self.computed.error + ROUNDING * self.scale();
        match self.sense {
            Sense::Equal | Sense::AtMost => known,
            Sense::Near => known + POOR * self.scale(),
            Sense::Tends => self.before * self.scale(),
            Sense::Always => 0.0,
        }
    }

    /// Whether the claim holds for this value of the formula.
    fn holds(&self, value: f64) -> bool {
        let difference = value - self.computed.value;
        match self.sense {
            Sense::AtMost => difference <= self.bound(),
            _ => difference.abs() <= self.bound(),
        }
    }

    /// Decides.
    ///
    /// The difference between the paper's number and the computed one is compared with
    /// [`Evidence::bound`]: the known error for an equation (with the rounding of the formula), a tenth
    /// for an approximation, the difference further away for a limit. What fails is corrected if the
    /// corrected formula passes the same comparison in all cases; a statement about cases or an approximation holds
    /// in part if it holds in any.
    pub fn verdict(&self) -> Verdict {
        let approximate = matches!(self.sense, Sense::Near | Sense::Tends);
        let counts = matches!(self.sense, Sense::Near | Sense::Always);
        match self.corrected {
            _ if self.held == self.cases => {
                if approximate && self.miss() > ROUNDING {
                    Verdict::Approximates { within: self.miss() }
                } else {
                    Verdict::Agrees
                }
            }
            Some(corrected) if self.paper.is_some() && self.holds(corrected) => {
                let within = self.part(corrected - self.computed.value);
                Verdict::Corrected { within: approximate.then_some(within) }
            }
            _ if counts && self.held > 0 => Verdict::InPart,
            _ => Verdict::False,
        }
    }
}

impl Verdict {
    /// One word for scripts.
    pub fn name(self) -> &'static str {
        match self {
            Verdict::Agrees => "agrees",
            Verdict::Approximates { .. } => "approximates",
            Verdict::Corrected { .. } => "corrected",
            Verdict::InPart => "in-part",
            Verdict::False => "false",
        }
    }

    /// Relative difference with which it or its corrected form holds, where it does so approximately.
    pub fn within(self) -> Option<f64> {
        match self {
            Verdict::Approximates { within } => Some(within),
            Verdict::Corrected { within } => within,
            Verdict::Agrees | Verdict::InPart | Verdict::False => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn known(value: f64) -> Approximation {
        Approximation::new(value, 1e-9)
    }

    #[test]
    fn an_equation_holds_as_far_as_the_number_is_known() {
        assert_eq!(Evidence::equal(2.0 + 0.9e-9, known(2.0)).verdict(), Verdict::Agrees);
        let wrong = Evidence::equal(2.0 + 2e-9, known(2.0));
        assert_eq!(wrong.verdict(), Verdict::False);
        let replaced = wrong.clone().corrected(2.0);
        assert_eq!(replaced.verdict(), Verdict::Corrected { within: None });
        assert_eq!(wrong.corrected(3.0).verdict(), Verdict::False);
    }

    #[test]
    fn an_approximation_holds_within_a_tenth_and_says_how_well() {
        let near = Evidence::near(1.09, known(1.0)).verdict();
        assert!(matches!(near, Verdict::Approximates { within } if (within - 0.09).abs() < 1e-12));
        assert_eq!(Evidence::near(1.11, known(1.0)).verdict(), Verdict::False);
        assert_eq!(Evidence::near(0.89, known(1.0)).verdict(), Verdict::False);
        let replaced = Evidence::near(-1.0, known(1.0)).corrected(1.01).verdict();
        assert!(matches!(replaced, Verdict::Corrected { within: Some(within) } if within < 0.011));
    }

    #[test]
    fn a_limit_holds_if_the_difference_falls() {
        let falls = Evidence::tends((1.0, known(1.2)), (1.0, known(1.1))).verdict();
        assert!(matches!(falls, Verdict::Approximates { within } if within < 0.1));
        let grows = Evidence::tends((1.0, known(1.1)), (1.0, known(1.2))).verdict();
        assert_eq!(grows, Verdict::False);
        let to_zero = Evidence::tends((0.0, known(0.2)), (0.0, known(1e-6))).verdict();
        assert_eq!(to_zero, Verdict::Approximates { within: 1e-6 });
    }

    #[test]
    fn a_lower_bound_may_lie_far_below_but_not_above() {
        assert_eq!(Evidence::at_most(0.1, known(1.0)).verdict(), Verdict::Agrees);
        assert_eq!(Evidence::at_most(1.1, known(1.0)).verdict(), Verdict::False);
    }

    #[test]
    fn marks_follow_from_bounds() {
        let known = known(1.0).within(Interval::new(0.99, 1.01));
        let mark = |evidence: Evidence| evidence.mark.unwrap();
        assert_eq!(mark(Evidence::equal(1.005, known)), Certainty::Enclosed);
        assert_eq!(mark(Evidence::equal(1.02, known)), Certainty::Refuted);
        assert_eq!(mark(Evidence::near(1.08, known)), Certainty::Proved);
        assert_eq!(mark(Evidence::near(1.1, known)), Certainty::Enclosed);
        assert_eq!(mark(Evidence::near(1.12, known)), Certainty::Refuted);
        assert_eq!(mark(Evidence::at_most(0.98, known)), Certainty::Proved);
        assert_eq!(mark(Evidence::at_most(1.0, known)), Certainty::Enclosed);
        assert_eq!(mark(Evidence::at_most(1.02, known)), Certainty::Refuted);
        assert_eq!(mark(Evidence::tends((1.5, known), (1.1, known))), Certainty::Proved);
        assert_eq!(mark(Evidence::tends((1.1, known), (1.5, known))), Certainty::Refuted);
        assert_eq!(Evidence::near(1.0, self::known(1.0)).mark, None);
        // A bound on one side decides or says nothing.
        let above = self::known(1.0).within(Interval::new(f64::NEG_INFINITY, 1.01));
        assert_eq!(Evidence::at_most(1.02, above).mark, Some(Certainty::Refuted));
        assert_eq!(Evidence::at_most(0.5, above).mark, None);
        // One case that certainly fails refutes, all that certainly hold prove.
        let case = |value, certain| Ok::<_, ()>(("", Conclusion { value, certain }));
        let mark_of = |cases: [_; 2]| Evidence::always(cases).unwrap().mark;
        assert_eq!(mark_of([case(true, true), case(true, true)]), Some(Certainty::Proved));
        assert_eq!(mark_of([case(true, true), case(true, false)]), None);
        assert_eq!(mark_of([case(true, false), case(false, true)]), Some(Certainty::Refuted));
        let several = [Evidence::near(1.0, known), Evidence::near(1.12, known)].map(Ok::<_, ()>);
        assert_eq!(Evidence::worst(several).unwrap().mark, Some(Certainty::Refuted));
    }

    #[test]
    fn of_several_cases_all_or_some_or_none_hold() {
        let holds = |does: [bool; 3]| {
            let cases = does.into_iter().enumerate();
            Evidence::always(cases.map(|(case, does)| Ok::<_, ()>((case, does.into())))).unwrap()
        };
        assert_eq!(holds([true; 3]).verdict(), Verdict::Agrees);
        assert_eq!(holds([true, false, true]).verdict(), Verdict::InPart);
        assert_eq!(holds([true, false, false]).place, "first fails at 1");
        assert_eq!(holds([false; 3]).verdict(), Verdict::False);
    }

    #[test]
    fn an_approximation_over_a_range_may_hold_in_a_part_of_it() {
        let over = |papers: [f64; 3]| {
            let near = papers.map(|paper| Ok::<_, ()>(Evidence::near(paper, known(1.0))));
            Evidence::worst(near).unwrap()
        };
        assert!(matches!(over([1.0, 1.09, 0.95]).verdict(), Verdict::Approximates { .. }));
        let part = over([1.3, 1.05, 0.8]);
        assert_eq!((part.verdict(), part.held, part.cases), (Verdict::InPart, 1, 3));
        assert_eq!(part.paper, Some(1.3));
        assert_eq!(over([1.3, 1.2, 0.8]).verdict(), Verdict::False);
        // A correction that fails anywhere is none.
        let mended = |corrected: [f64; 2]| {
            let of = |value| Ok::<_, ()>(Evidence::near(-3.0, known(1.0)).corrected(value));
            Evidence::worst(corrected.map(of)).unwrap().verdict()
        };
        assert!(matches!(mended([1.0, 1.05]), Verdict::Corrected { .. }));
        assert_eq!(mended([1.0, 1.2]), Verdict::False);
    }

    #[test]
    fn the_worst_of_several_findings_is_the_one_nearest_to_failing() {
        let cases = [1.0, 0.9, 1.05].map(|paper| Ok::<_, ()>(Evidence::near(paper, known(1.0))));
        let worst = Evidence::worst(cases).unwrap();
        assert_eq!((worst.paper, worst.cases), (Some(0.9), 3));
        // A lower bound that lies far below is not worse than one that all but touches.
        let bounds = [0.1, 0.95].map(|paper| Ok::<_, ()>(Evidence::at_most(paper, known(1.0))));
        assert_eq!(Evidence::worst(bounds).unwrap().paper, Some(0.95));
    }
}
