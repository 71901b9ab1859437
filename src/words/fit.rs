//! What is said of a fit, in sentences: what was left out, what cannot be determined, whether the model holds, and what may
//! be signed, one sentence about the kicks that are survived, one-sided, with the conditions under which it holds.

use std::collections::BTreeSet;

use serde::Serialize;

use super::{counted, in_unit, joined, rounded_down, significant, with_unit};
use crate::fit::{
    AllowedLoss, Combination, Condition, D, DropReason, FitResult, MarginQuestion, Margins, NAMES,
    NameSpec, R, Rival, StartKind, combination, conditions,
};
use crate::numerics::real;
use crate::portrait::Margin;

/// All that is said of a fit.
pub fn sentences(fitted: &FitResult) -> Vec<String> {
    let statement = signed(fitted);
    let told = statement.conditions.iter().filter(|it| is_told(it, fitted));
    let told = told.map(|it| format!("{}: {}", it.name, it.detail));
    let broken = statement.broken().into_iter();
    let all = broken.chain(left_out(fitted)).chain(undetermined(fitted)).chain(told);
    all.chain([statement.text.clone()]).collect()
}

/// Whether a condition is told beside those that fail: not what is as it should be, but for the residuals.
fn is_told(condition: &Condition, fitted: &FitResult) -> bool {
    let is_of_interest = match condition.name {
        "residuals" => true,
        "zero" => !condition.holds || fitted.estimate.drift().is_some(),
        "alternatives" => fitted.estimate.contenders().nth(1).is_some(),
        _ => false,
    };
    is_of_interest && (condition.holds || !condition.essential)
}

/// What cannot be determined, or not by a standard error.
pub fn undetermined(fitted: &FitResult) -> Vec<String> {
    let inseparable = combination(&fitted.estimate).map(|one| inseparable(fitted, &one));
    inseparable.into_iter().chain(bounds(fitted)).collect()
}

/// `D and r`, `D, D3 and r`.
fn listed(names: &[&str]) -> String {
    match names {
        [all @ .., last] if !all.is_empty() => format!("{} and {last}", all.join(", ")),
        _ => names.concat(),
    }
}

/// Why samples are left out, in the order in which that is said.
const REASONS: [(DropReason, &str); 6] = [
    (DropReason::Before, "at rest before the mass was struck"),
    (DropReason::After, "after the mass was excited again: fit them as a file of their own"),
    (DropReason::Saturated, "flattened at full scale"),
    (DropReason::Jump, "next to the turning points, where an acceleration jumps"),
    (DropReason::Alike, "at rest that the steps of the converter round alike"),
    (DropReason::Outlier, "impossible for this motion and noise (4.5 deviations)"),
];

/// What was left out of a record, and why, a sentence each.
pub fn left_out(fitted: &FitResult) -> Vec<String> {
    let rows = [
        (fitted.record.missing, "row", "without a number"),
        (fitted.record.repeated, "row", "repeating another one"),
    ];
    let samples = REASONS.map(|(why, words)| (fitted.estimate.count(why), "sample", words));
    let said = rows.into_iter().chain(samples).filter(|(count, ..)| *count > 0);
    said.map(|(count, what, why)| format!("left out: {} {why}", counted(count, what))).collect()
}

/// `D + 0.069 r`.
fn formula(combination: &Combination) -> String {
    let term = |(index, (row, weight)): (usize, &(&NameSpec, f64))| {
        if index == 0 {
            return row.name.to_owned();
        }
        let sign = if *weight < 0.0 { "-" } else { "+" };
        format!(" {sign} {} {}", significant(weight.abs(), 3), row.name)
    };
    combination.terms.iter().enumerate().map(term).collect()
}

fn inseparable(fitted: &FitResult, combination: &Combination) -> String {
    let names: Vec<&str> = combination.terms.iter().map(|(row, _)| row.name).collect();
    let (low, high) = fitted.estimate.amplitudes();
    let (names, formula) = (listed(&names), formula(combination));
    let value = significant(combination.value, 4);
    let error = significant(combination.standard_error, 2);
    let span = significant(high / low, 2);
    let known = format!("only {formula} = {value} +- {error} is known");
    format!("{names} cannot be told apart: {known}; the amplitudes span a factor of {span}")
}

fn bounds(fitted: &FitResult) -> Vec<String> {
    let estimate = &fitted.estimate;
    let interval = estimate.intervals[R];
    let is_unseen = estimate.free[R] && interval.lower == Some(0.0);
    let most = interval.upper.filter(|_| is_unseen).map(|upper| significant(upper, 3));
    let most = most.map(|most| format!("no friction is shown: r is at most {most} (95 %)"));
    let is_bent = |place: usize| estimate.free[place] && !estimate.intervals[place].quadratic;
    let bent = NAMES.iter().filter(|row| is_bent(row.place));
    let bent = joined(bent.map(|row| row.name), ", ");
    let why = "by the profile of the likelihood, which is not quadratic there";
    let bent = (!bent.is_empty()).then(|| format!("intervals of {bent} {why}"));
    most.into_iter().chain(bent).collect()
}

/// The sentence with its numbers.
#[derive(Clone, Debug, Serialize)]
pub struct Statement {
    /// From any rest position each impulse below this is survived; `None` if each is. In N s if a mass or stiffness is
    /// known, else as velocity over `omega0`, a length in the unit of the record.
    pub impulse: Option<f64>,
    /// Without mass or stiffness: the same as a change of velocity, in the unit of the record per second.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub velocity: Option<f64>,
    /// From any rest position each sudden change of position below this is survived; `None` if each is. In m if a mass
    /// or stiffness is known, else in the unit of the record.
    pub displacement: Option<f64>,
    /// The probability with which it holds, one-sided.
    pub confidence: f64,
    /// The largest force of a disturbance: in N, or over the stiffness, a length in the unit of the record.
    pub disturbance: f64,
    /// The units of these.
    pub units: StatementUnits,
    /// The displacement that the survived motions may reach, in largest amplitudes measured; `None` if any is survived.
    pub reach: Option<f64>,
    /// The sentence; its number is rounded down.
    pub text: String,
    /// What it rests on; it is not to be relied on unless all essential conditions hold.
    #[serde(skip)]
    pub conditions: Vec<Condition>,
}

/// The units of the numbers of a statement.
#[derive(Clone, Debug, Serialize)]
pub struct StatementUnits {
    /// Of `impulse`.
    pub impulse: String,
    /// Of `displacement`.
    pub displacement: String,
    /// Of `disturbance`.
    pub disturbance: String,
}

impl Statement {
    /// The conditions of the answer that do not hold, in one line.
    pub fn broken(&self) -> Option<String> {
        let failing = self.failing().map(|it| format!("{} ({})", it.name, it.detail));
        let failing = joined(failing, "; ");
        let line = || format!("not to be relied on, because a test fails: {failing}");
        (!failing.is_empty()).then(line)
    }

    fn failing(&self) -> impl Iterator<Item = &Condition> {
        self.conditions.iter().filter(|it| !it.holds && it.essential)
    }
}

/// What may be signed after a fit.
pub fn signed(fitted: &FitResult) -> Statement {
    let margins = &fitted.margins;
    let MarginQuestion { confidence, disturbance, .. } = margins.question;
    let velocity = |omega0: f64, margin: &Margin| Some(margin.from_rest.impulse? * omega0);
    let has_mass = fitted.inertia().is_some();
    let length = if fitted.unit().is_empty() {
        "unit"
    } else {
        fitted.unit()
    };
    let units = if has_mass { ["N s", "m", "N"] } else { [length; 3] };
    let [impulse, displacement, disturbed] = units.map(str::to_owned);
    // Those of a displacement and of a velocity over omega0.
    let scales = |omega0: f64| fitted.kicks(omega0).unwrap_or((1.0, 1.0));
    let reach = margins.certain(|_, margin| margin.displacement);
    let reach = reach.map(|reach| reach / fitted.estimate.amplitudes().1);
    let mut statement = Statement {
        impulse: margins.certain(|omega0, it| Some(it.from_rest.impulse? * scales(omega0).1)),
        velocity: (!has_mass && !fitted.record.t.is_empty())
            .then(|| margins.certain(velocity))
            .flatten(),
        displacement: margins
            .certain(|omega0, it| Some(it.from_rest.displacement? * scales(omega0).0)),
        confidence,
        disturbance,
        units: StatementUnits { impulse, displacement, disturbance: disturbed },
        reach,
        text: String::new(),
        conditions: conditions(&fitted.estimate, margins),
    };
    statement.conditions.extend([amplitudes(fitted, reach), alternatives(fitted)]);
    let failing = joined(statement.failing().map(|it| it.name), ", ");
    let sentence = sentence(fitted, &statement);
    statement.text = if failing.is_empty() {
        sentence
    } else {
        format!("Not to be relied on, as a condition fails ({failing}): {sentence}")
    };
    statement
}

fn sentence(fitted: &FitResult, statement: &Statement) -> String {
    const SURVIVED: &str = " is survived";
    let confidence = format!("{} % confidence", significant(100.0 * statement.confidence, 6));
    let has_mass = fitted.inertia().is_some();
    let below = |what: &str, value: f64, unit: &str| {
        let value = rounded_down(value, 3);
        let plain = || in_unit(&significant(value, 3), unit);
        let amount = if has_mass { with_unit(value, 3, unit) } else { plain() };
        format!("{what} below {amount}")
    };
    let StatementUnits { impulse: impulse_unit, displacement: length, .. } = &statement.units;
    let force = force(fitted, statement);
    if statement.impulse == Some(0.0) || statement.displacement == Some(0.0) {
        let why = lost(fitted, force);
        return format!("No kick, however small, is survived with {confidence}: {why}.");
    }
    let change = "a change of velocity";
    let kicks = match (statement.impulse, statement.velocity, statement.displacement) {
        (None, _, None) => "every kick is survived".to_owned(),
        (None, _, Some(shift)) => {
            let shift = below("every sudden change of position", shift, length);
            format!("every impulse is survived, and {shift}")
        }
        (Some(_), Some(velocity), _) => below(change, velocity, &format!("{length}/s")) + SURVIVED,
        (Some(it), ..) if has_mass => below("an impulse", it, impulse_unit) + SURVIVED,
        (Some(it), ..) => below(change, it, &format!("{length} times omega0")) + SURVIVED,
    };
    let whatever = match force {
        Some(force) => format!(", whatever {force} does{}", changes(fitted)),
        None => format!("{}, provided that no other force acts", changes(fitted)),
    };
    let sentence = format!("From any rest position, with {confidence}, {kicks}{whatever}.");
    let Condition { holds, detail, .. } = amplitudes(fitted, statement.reach);
    if holds {
        sentence
    } else {
        format!("{sentence} Extrapolated by the model: {detail}.")
    }
}

/// `a force of at most 0.5 N`.
fn force(fitted: &FitResult, statement: &Statement) -> Option<String> {
    let Statement { disturbance, units, .. } = statement;
    let length = significant(*disturbance, 6);
    let size = match fitted.inertia() {
        Some(_) => with_unit(*disturbance, 6, "N"),
        None => format!("{length} {} times the stiffness", units.disturbance),
    };
    (*disturbance > 0.0).then(|| format!("a force of at most {size}"))
}

/// `, even if D changes by up to 0.001 and r by up to 0.01 mm`.
fn changes(fitted: &FitResult) -> String {
    let widths = fitted.margins.question.half_widths;
    let rows = NAMES.iter().filter(|row| row.place >= D).zip(widths).filter(|it| it.1 > 0.0);
    let mut all = String::new();
    for (row, half) in rows {
        let (start, verb) = if all.is_empty() {
            (", even if", " changes")
        } else {
            (" and", "")
        };
        let half = in_unit(&significant(half, 6), &row.unit(fitted.unit()));
        all += &format!("{start} {}{verb} by up to {half}", row.name);
    }
    all
}

/// Why no kick is survived: in which share of the draws the mass may leave its rest without one.
fn lost(fitted: &FitResult, force: Option<String>) -> String {
    let Margins { each, failed, .. } = &fitted.margins;
    let lost = each.iter().filter(|(_, it)| it.from_rest.displacement == Some(0.0)).count();
    let share = significant(100.0 * real(lost) / real(each.len().max(1)), 2);
    let alone = force.map_or("the mass leaves its rest by itself".to_owned(), |force| {
        format!("{force} alone may carry the mass away")
    });
    let unknown = if *failed > 0 {
        ", or its margin could not be computed"
    } else {
        ""
    };
    format!("in {share} % of what the record allows, {alone}{unknown}")
}

/// Whether the motions of the sentence are among those measured; `reach` is in largest amplitudes.
fn amplitudes(fitted: &FitResult, reach: Option<f64>) -> Condition {
    let (low, high) = fitted.estimate.amplitudes();
    let unit = fitted.unit();
    let range = in_unit(&format!("{} .. {}", significant(low, 3), significant(high, 3)), unit);
    let measured = format!("amplitudes measured were {range}");
    let holds = reach.is_some_and(|it| it == 0.0 || (it <= 1.0 && it * high >= low));
    let detail = match (reach, fitted.margins.allowed) {
        (Some(reach), _) => {
            let of_largest = holds || reach > 1.0;
            let (part, of) = if of_largest {
                (reach, "times the largest")
            } else {
                (reach * high / low, "of the smallest")
            };
            format!("motions reach {} {of} amplitude measured ({range})", significant(part, 2))
        }
        (None, Some(AllowedLoss { name, value, displacement: at })) => format!(
            "{measured}; with {name} = {}, which the record does not exclude, a displacement of {} \
             is not survived, {} times the largest amplitude",
            significant(value, 2),
            in_unit(&significant(at, 3), unit),
            significant(at / high, 2)
        ),
        (None, None) => format!("{measured}; no D2 or D3 within its interval changes that"),
    };
    Condition { name: "amplitudes", holds, essential: false, detail }
}

/// Whether all motions that explain the record are among the draws.
fn alternatives(fitted: &FitResult) -> Condition {
    let estimate = &fitted.estimate;
    let tried: BTreeSet<usize> = estimate.rivals.iter().map(|it| it.half_swings).collect();
    let fitting = |it: &Rival| match it.delta_chi2 {
        0.0 => it.half_swings.to_string(),
        rise => format!("{} (delta chi^2 = {})", it.half_swings, significant(rise, 2)),
    };
    let fitting: Vec<String> = estimate.contenders().map(fitting).collect();
    // Normal draws come from the best motion only; those that follow the likelihood visit the others, too.
    let holds = fitting.len() < 2 || fitted.margins.motions > 0;
    let releases = match estimate.start {
        StartKind::Release if !estimate.data.has_peaks() => ", and releases some periods off,",
        _ => "",
    };
    let (tried, fitting) = (joined(tried, ", "), fitting.join(", "));
    let detail = format!("{tried} half swings{releases} compared; the record allows {fitting}");
    Condition { name: "alternatives", holds, essential: false, detail }
}
