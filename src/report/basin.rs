//! A basin over a window of starts.

use super::certified::{kick_columns, named};
use super::columns::{Columns, Quantity};
use super::guarantee::margin_columns;
use super::json::Document;
use super::table::{cost, parameters};
use crate::portrait::basin::{Counts, SurveyedBasin};
use crate::portrait::{Border, Margin};
use crate::proof::kicks::ProvedKicks;
use crate::words::number::significant;

pub fn json(found: &SurveyedBasin, certified: Option<&ProvedKicks>, seconds: f64) -> String {
    let certified = certified.map(|kicks| kick_columns().object(&kicks));
    Document::default()
        .and(found)
        .with_any("certified", certified)
        .cost(&found.cost, seconds)
        .text()
}

pub fn csv(found: &SurveyedBasin, certified: Option<&ProvedKicks>) -> String {
    let proved = |kicks| Columns::default().part("certified", kick_columns(), move |_| Some(kicks));
    let columns = Columns::default()
        .fields(&found.counts, |it: &&SurveyedBasin| Some(it.counts))
        .and(margin_columns(|it: &&SurveyedBasin| it.margin))
        .file("area", |it| it.area)
        .file("captured_part", |it| it.captured)
        .file("lyapunov_share", |it| it.lyapunov_share)
        .and(certified.map(proved));
    columns.csv([found])
}

/// A line on the border of the basin of the sticking set.
pub(super) fn border(border: Border) -> &'static str {
    match border {
        Border::Cycle => "border of the basin of the sticking set: the smallest cycle\n",
        Border::Separatrix => "border of the basin of the sticking set: a separatrix\n",
        _ => "border of the basin of the sticking set: none\n",
    }
}

/// The counts, the margins and the area.
pub fn table(found: &SurveyedBasin, seconds: f64) -> String {
    const NUMBER: Quantity = Quantity::pure(10);
    let mut out = format!("{}\n{}\n", parameters(&found.parameters, None), border(found.border));
    let Counts { captured, cycle, escaped, undecided } = found.counts;
    let counts = Columns::default()
        .text("starts that", |(fate, _): &(&str, u64)| (*fate).to_owned())
        .text("count", |(_, count)| count.to_string())
        .table([
            ("are captured", captured),
            ("end on a stable cycle", cycle),
            ("escape", escaped),
            ("stay undecided", undecided),
        ]);
    let Margin { displacement, impulse, from_rest } = found.margin;
    let kicks = Columns::default()
        .text("smallest kick that is not captured", |(kick, _): &(&str, _)| (*kick).to_owned())
        .number("size", NUMBER, |(_, size)| *size)
        .table(named([from_rest.displacement, from_rest.impulse, displacement, impulse]));
    out += &format!("{counts}\n{kicks}\n");
    out += &format!("area of the basin: {}\n", NUMBER.text(found.area));
    if let Some(share) = found.lyapunov_share {
        let verdict = if share > 1.0 { ": too large, as it ignores D2 and D3" } else { "" };
        out += &format!("Lyapunov's disk (24): {} of the margin{verdict}\n", significant(share, 4));
    }
    out + &cost(found.cost, seconds)
}
