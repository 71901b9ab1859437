//! What may be signed after a fit: one sentence about the kicks that are survived, one-sided, and the conditions under
//! which it holds.

use serde::Serialize;

use super::number::with_unit;
use super::number::{rounded_down, significant};
use crate::fit::{
    Condition, D, Fitted, MarginQuestion, Margins, NAMES, Rival, StartKind, conditions,
};
use crate::numerics::count::real;
use crate::portrait::Margin;

/// The sentence with its numbers.
#[derive(Clone, Debug, PartialEq, Serialize)]
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
}

/// The units of the numbers of a statement.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct StatementUnits {
    /// Of `impulse`.
    pub impulse: String,
    /// Of `displacement`.
    pub displacement: String,
    /// Of `disturbance`.
    pub disturbance: String,
}

/// The sentence, and the conditions under which it holds.
#[derive(Clone, Debug, PartialEq)]
pub struct SignedStatement {
    /// The sentence.
    pub statement: Statement,
    /// The conditions; the sentence is not to be relied on unless all essential ones hold.
    pub conditions: Vec<Condition>,
}

/// What may be signed after a fit.
pub fn signed(fitted: &Fitted) -> SignedStatement {
    let margins = &fitted.margins;
    let MarginQuestion { confidence, disturbance, .. } = margins.question;
    let velocity = |omega0: f64, margin: &Margin| Some(margin.from_rest.impulse? * omega0);
    let has_mass = fitted.inertia.is_some();
    let length = if fitted.unit().is_empty() { "unit" } else { fitted.unit() };
    let units = if has_mass { ["N s", "m", "N"] } else { [length; 3] };
    let [impulse, displacement, disturbed] = units.map(str::to_owned);
    // Those of a displacement and of a velocity over omega0.
    let scales = |omega0: f64| {
        fitted.inertia.map_or((1.0, 1.0), |(it, metres)| (metres, metres * it.times(omega0, 1)))
    };
    let reach = margins.certain(|_, margin| margin.displacement);
    let reach = reach.map(|reach| reach / fitted.estimate.amplitudes().1);
    let mut statement = Statement {
        impulse: margins.certain(|omega0, it| Some(it.from_rest.impulse? * scales(omega0).1)),
        velocity: (!has_mass && fitted.record.t.is_some())
            .then(|| margins.certain(velocity))
            .flatten(),
        displacement: margins
            .certain(|omega0, it| Some(it.from_rest.displacement? * scales(omega0).0)),
        confidence,
        disturbance,
        units: StatementUnits { impulse, displacement, disturbance: disturbed },
        reach,
        text: String::new(),
    };
    let mut conditions = conditions(&fitted.estimate, margins);
    conditions.extend([amplitudes(fitted, reach), alternatives(fitted)]);
    let failing: Vec<&str> =
        conditions.iter().filter(|it| !it.holds && it.essential).map(|it| it.name).collect();
    let sentence = sentence(fitted, &statement);
    statement.text = if failing.is_empty() {
        sentence
    } else {
        format!("Not to be relied on, as a condition fails ({}): {sentence}", failing.join(", "))
    };
    SignedStatement { statement, conditions }
}

fn sentence(fitted: &Fitted, statement: &Statement) -> String {
    let confidence = format!("{} % confidence", significant(100.0 * statement.confidence, 6));
    let amount = |value: f64, unit: &str| match fitted.inertia {
        Some(_) => with_unit(rounded_down(value, 3), 3, unit),
        None => format!("{} {unit}", significant(rounded_down(value, 3), 3)),
    };
    let StatementUnits { impulse: impulse_unit, displacement: length, .. } = &statement.units;
    let force = force(fitted, statement);
    if statement.impulse == Some(0.0) || statement.displacement == Some(0.0) {
        return format!(
            "No kick, however small, is survived with {confidence}: {}.",
            lost(fitted, force)
        );
    }
    let kicks = match (statement.impulse, statement.velocity, statement.displacement) {
        (None, _, None) => "every kick is survived".to_owned(),
        (None, _, Some(shift)) => format!(
            "every impulse is survived, and every sudden change of position below {}",
            amount(shift, length)
        ),
        (Some(_), Some(velocity), _) => {
            format!(
                "a change of velocity below {} is survived",
                amount(velocity, &format!("{length}/s"))
            )
        }
        (Some(impulse), None, _) if fitted.inertia.is_some() => {
            format!("an impulse below {} is survived", amount(impulse, impulse_unit))
        }
        (Some(impulse), None, _) => {
            format!(
                "a change of velocity below {} times omega0 is survived",
                amount(impulse, length)
            )
        }
    };
    let whatever = match force {
        Some(force) => format!(", whatever {force} does{}", changes(fitted)),
        None => format!("{}, provided that no other force acts", changes(fitted)),
    };
    let sentence = format!("From any rest position, with {confidence}, {kicks}{whatever}.");
    match amplitudes(fitted, statement.reach) {
        beyond if !beyond.holds => {
            format!("{sentence} Extrapolated by the model: {}.", beyond.detail)
        }
        _ => sentence,
    }
}

/// `a force of at most 0.5 N`.
fn force(fitted: &Fitted, statement: &Statement) -> Option<String> {
    let Statement { disturbance, units, .. } = statement;
    let size = match fitted.inertia {
        Some(_) => with_unit(*disturbance, 6, "N"),
        None => {
            format!("{} {} times the stiffness", significant(*disturbance, 6), units.disturbance)
        }
    };
    (*disturbance > 0.0).then(|| format!("a force of at most {size}"))
}

/// `, even if D changes by up to 0.001 and r by up to 0.01 mm`.
fn changes(fitted: &Fitted) -> String {
    let widths = fitted.margins.question.half_widths;
    let rows = NAMES.iter().filter(|row| row.place >= D).zip(widths).filter(|it| it.1 > 0.0);
    let mut all = String::new();
    for (row, half) in rows {
        let (start, verb) = if all.is_empty() { (", even if", " changes") } else { (" and", "") };
        let half = format!("{} {}", significant(half, 6), row.unit(fitted.unit()));
        all += &format!("{start} {}{verb} by up to {}", row.name, half.trim_end());
    }
    all
}

/// Why no kick is survived: in which share of the draws the mass may leave its rest without one.
fn lost(fitted: &Fitted, force: Option<String>) -> String {
    let Margins { each, failed, .. } = &fitted.margins;
    let lost = each.iter().filter(|(_, it)| it.from_rest.displacement == Some(0.0)).count();
    let share = significant(100.0 * real(lost) / real(each.len().max(1)), 2);
    let alone = force.map_or("the mass leaves its rest by itself".to_owned(), |force| {
        format!("{force} alone may carry the mass away")
    });
    let unknown = if *failed > 0 { ", or its margin could not be computed" } else { "" };
    format!("in {share} % of what the record allows, {alone}{unknown}")
}

/// Whether the motions of the sentence are among those measured; `reach` is in largest amplitudes.
fn amplitudes(fitted: &Fitted, reach: Option<f64>) -> Condition {
    let (low, high) = fitted.estimate.amplitudes();
    let unit = fitted.unit();
    let range = format!("{} .. {} {unit}", significant(low, 3), significant(high, 3));
    let range = range.trim_end();
    let holds = reach.is_some_and(|it| it == 0.0 || (it <= 1.0 && it * high >= low));
    let detail = match (reach, fitted.margins.allowed) {
        (Some(reach), _) if holds || reach > 1.0 => format!(
            "motions reach {} times the largest amplitude measured ({range})",
            significant(reach, 2)
        ),
        (Some(reach), _) => format!(
            "motions reach {} of the smallest amplitude measured ({range})",
            significant(reach * high / low, 2)
        ),
        (None, Some((name, value, at))) => format!(
            "amplitudes measured were {range}; with {name} = {}, which the record does not exclude, a displacement of {} \
             is not survived, {} times the largest amplitude",
            significant(value, 2),
            format!("{} {unit}", significant(at, 3)).trim_end(),
            significant(at / high, 2)
        ),
        (None, None) => {
            format!(
                "amplitudes measured were {range}; no D2 or D3 within its interval changes that"
            )
        }
    };
    Condition { name: "amplitudes", holds, essential: false, detail }
}

/// Whether all motions that explain the record are among the draws.
fn alternatives(fitted: &Fitted) -> Condition {
    let estimate = &fitted.estimate;
    let listed = |rivals: &mut dyn Iterator<Item = &Rival>| {
        let mut numbers: Vec<usize> = rivals.map(|it| it.half_swings).collect();
        numbers.sort_unstable();
        numbers.dedup();
        numbers.iter().map(usize::to_string).collect::<Vec<_>>().join(", ")
    };
    let tried = listed(&mut estimate.rivals.iter());
    let fitting = listed(&mut estimate.contenders());
    // Normal draws come from the best motion only; those that follow the likelihood visit the others, too.
    let holds = estimate.contenders().count() < 2 || fitted.margins.motions > 0;
    let releases = match estimate.start {
        StartKind::Release if !estimate.data.has_peaks() => ", and releases some periods off,",
        _ => "",
    };
    let detail = format!("{tried} half swings{releases} compared; the record allows {fitting}");
    Condition { name: "alternatives", holds, essential: false, detail }
}
