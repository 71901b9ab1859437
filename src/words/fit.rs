//! Remarks on a fit, in sentences: what was left out, what cannot be determined, whether the model holds.

use crate::fit::{
    Combination, Dropped, Fitted, FittedDrift, NAMES, NameSpec, R, combinations, conditions,
};
use crate::words::counted;
use crate::words::number::{resolved, significant};
use crate::words::statement::signed;

pub fn sentences(fitted: &Fitted) -> Vec<String> {
    let mut all: Vec<String> = broken(fitted).into_iter().collect();
    all.extend(left_out(fitted));
    all.extend(drift(fitted));
    all.extend(combinations(&fitted.estimate).iter().map(|one| inseparable(fitted, one)));
    all.extend(bounds(fitted));
    all.extend(rivals(fitted));
    all.push(residuals(fitted));
    all.push(signed(fitted).statement.text);
    all
}

/// The conditions of the answer that do not hold, in one line.
pub fn broken(fitted: &Fitted) -> Option<String> {
    let all = conditions(&fitted.estimate, &fitted.margins);
    let failing: Vec<String> = all
        .iter()
        .filter(|it| !it.holds && it.essential)
        .map(|it| format!("{} ({})", it.name, it.detail))
        .collect();
    (!failing.is_empty())
        .then(|| format!("not to be relied on, because a test fails: {}", failing.join("; ")))
}

/// `D and r`, `D, D3 and r`.
fn listed(names: &[&str]) -> String {
    match names {
        [all @ .., last] if !all.is_empty() => format!("{} and {last}", all.join(", ")),
        _ => names.concat(),
    }
}

/// What was left out of a record, and why, a sentence each.
pub fn left_out(fitted: &Fitted) -> Vec<String> {
    let dropped = |why| fitted.estimate.count(why);
    let counts = [
        (fitted.record.missing, "row", "without a number"),
        (fitted.record.repeated, "row", "repeating another one"),
        (dropped(Dropped::Before), "sample", "at rest before the mass was struck"),
        (
            dropped(Dropped::After),
            "sample",
            "after the mass was excited again: fit them as a file of their own",
        ),
        (dropped(Dropped::Saturated), "sample", "flattened at full scale"),
        (
            dropped(Dropped::Jump),
            "sample",
            "next to the turning points, where an acceleration jumps",
        ),
        (dropped(Dropped::Alike), "sample", "at rest that the steps of the converter round alike"),
        (
            dropped(Dropped::Outlier),
            "sample",
            "impossible for this motion and noise (4.5 deviations)",
        ),
    ];
    let said = counts.iter().filter(|(count, ..)| *count > 0);
    said.map(|(count, what, why)| format!("left out: {} {why}", counted(*count, what))).collect()
}

/// How far the zero drifts.
fn drift(fitted: &Fitted) -> Option<String> {
    let FittedDrift { change, standard_error, bend, bend_standard_error } =
        fitted.estimate.drift()?;
    let unit = fitted.signal_unit();
    let number = |value: f64, error: f64| {
        format!("{} +- {} {unit}", resolved(value, 0.05 * error), significant(error, 2))
            .trim_end()
            .to_owned()
    };
    let along = if bend == 0.0 {
        "along a line".to_owned()
    } else {
        format!("its ends {} above its middle", number(bend, bend_standard_error))
    };
    let change = number(change, standard_error);
    Some(format!("the zero drifts by {change} over the record, {along}: the offset is its mean"))
}

/// `D + 0.069 r`.
fn formula(combination: &Combination) -> String {
    let term = |(index, (row, weight)): (usize, &(&NameSpec, f64))| {
        let sign = match (index, *weight < 0.0) {
            (0, _) => "",
            (_, true) => " - ",
            (_, false) => " + ",
        };
        let factor = if index == 0 { String::new() } else { significant(weight.abs(), 3) + " " };
        format!("{sign}{factor}{}", row.name)
    };
    combination.terms.iter().enumerate().map(term).collect()
}

fn inseparable(fitted: &Fitted, combination: &Combination) -> String {
    let names: Vec<&str> = combination.terms.iter().map(|(row, _)| row.name).collect();
    let (low, high) = fitted.estimate.amplitudes();
    format!(
        "{} cannot be told apart: only {} = {} +- {} is known; the amplitudes span a factor of {}",
        listed(&names),
        formula(combination),
        significant(combination.value, 4),
        significant(combination.standard_error, 2),
        significant(high / low, 2),
    )
}

fn bounds(fitted: &Fitted) -> Vec<String> {
    let estimate = &fitted.estimate;
    let interval = estimate.intervals[R];
    let mut said = Vec::new();
    if let Some(upper) = interval.upper
        && estimate.free[R]
        && interval.lower == Some(0.0)
    {
        said.push(format!("no friction is shown: r is at most {} (95 %)", significant(upper, 3)));
    }
    let bent: Vec<&str> = NAMES
        .iter()
        .filter(|row| estimate.free[row.place] && !estimate.intervals[row.place].quadratic)
        .map(|row| row.name)
        .collect();
    if !bent.is_empty() {
        said.push(format!(
            "intervals of {} by the profile of the likelihood, which is not quadratic there",
            bent.join(", ")
        ));
    }
    said
}

fn rivals(fitted: &Fitted) -> Vec<String> {
    let others = fitted.estimate.contenders().skip(1);
    others
        .map(|rival| {
            format!(
                "{} half swings explain the record as well (delta chi^2 = {}): the intervals cover both",
                rival.half_swings,
                significant(rival.delta_chi2, 2)
            )
        })
        .collect()
}

fn residuals(fitted: &Fitted) -> String {
    let found = &fitted.estimate.whiteness;
    let correlation = significant(found.correlation, 2);
    if found.systematic {
        return format!(
            "the residuals swing with the motion (correlation {correlation}): the model leaves something out, and the \
             errors do not cover that"
        );
    }
    if found.white {
        return format!("the residuals are white noise (correlation {correlation})");
    }
    format!(
        "the residuals are correlated from sample to sample ({correlation}) as filtered noise is; the errors allow for it"
    )
}
