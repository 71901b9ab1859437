//! A basin over a window of starts.

use serde::Serialize;

use super::certified::{KickEnclosures, survived};
use super::csv;
use super::json::{self, CountedCost};
use super::table::{Table, parameters, rounded};
use crate::portrait::{Border, Margin};
use crate::proof::kicks::ProvedKicks;
use crate::study::basin::{Counts, SurveyedBasin};
use crate::words::number::{duration, significant};

#[derive(Serialize)]
struct BasinDocument<'a> {
    #[serde(flatten)]
    found: &'a SurveyedBasin,
    #[serde(skip_serializing_if = "Option::is_none")]
    certified: Option<KickEnclosures>,
    cost: CountedCost,
}

#[derive(Serialize)]
struct BasinRow {
    #[serde(flatten)]
    counts: Counts,
    #[serde(flatten)]
    margin: Margin,
    area: Option<f64>,
    captured_part: f64,
    lyapunov_share: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    certified: Option<KickEnclosures>,
}

pub fn json(found: &SurveyedBasin, certified: Option<&ProvedKicks>, seconds: f64) -> String {
    json::text(&BasinDocument {
        found,
        certified: certified.map(survived),
        cost: CountedCost { counted: found.cost, seconds },
    })
}

pub fn csv(found: &SurveyedBasin, certified: Option<&ProvedKicks>) -> String {
    let row = |certified| BasinRow {
        counts: found.counts,
        margin: found.margin,
        area: found.area,
        captured_part: found.captured,
        lyapunov_share: found.lyapunov_share,
        certified,
    };
    csv::sheet(&row(certified.map(|_| KickEnclosures::like())), [row(certified.map(survived))])
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
