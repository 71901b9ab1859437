//! A basin over a window of starts.

use super::certified::kick_columns;
use super::columns::Columns;
use super::guarantee::margin_columns;
use super::json::Document;
use super::table::{Table, parameters, rounded};
use crate::portrait::{Border, Margin};
use crate::proof::kicks::ProvedKicks;
use crate::study::basin::{Counts, SurveyedBasin};
use crate::words::number::{duration, significant};

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
        .and(Some(margin_columns(|it: &&SurveyedBasin| it.margin)))
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
    const PLACES: usize = 10;
    let mut out = format!("{}\n{}\n", parameters(&found.parameters, None), border(found.border));
    let Counts { captured, cycle, escaped, undecided } = found.counts;
    let mut counts = Table::new(&["starts that", "count"]);
    for (fate, count) in [
        ("are captured", captured),
        ("end on a stable cycle", cycle),
        ("escape", escaped),
        ("stay undecided", undecided),
    ] {
        counts.row(vec![fate.to_owned(), count.to_string()]);
    }
    let mut kicks = Table::new(&["smallest kick that is not captured", "size"]);
    let Margin { displacement, impulse, from_rest } = found.margin;
    for (kick, size) in [
        ("displacement from the worst rest position", from_rest.displacement),
        ("impulse at the worst rest position", from_rest.impulse),
        ("displacement from q = 0", displacement),
        ("impulse at q = 0", impulse),
    ] {
        kicks.row(vec![kick.to_owned(), rounded(size, PLACES)]);
    }
    out += &format!("{counts}\n{kicks}\n");
    out += &format!("area of the basin: {}\n", rounded(found.area, PLACES));
    if let Some(share) = found.lyapunov_share {
        let verdict = if share > 1.0 { ": too large, as it ignores D2 and D3" } else { "" };
        out += &format!("Lyapunov's disk (24): {} of the margin{verdict}\n", significant(share, 4));
    }
    out + &format!("{} evaluations, {}\n", found.cost.evaluations, duration(seconds))
}
