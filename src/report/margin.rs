//! How large a kick is survived: margins, nominal and guaranteed, the basin over a window of starts, and random kicks.

use std::collections::BTreeMap;

use super::certified::{kick_columns, kicks_lines, named};
use super::{About, Answer, Columns, Document, Quantity, Table, cycles};
use crate::flow::Cost;
use crate::model::{Interval, Knob, MachineProblem, ParameterBox};
use crate::portrait::basin::{Counts, SurveyedBasin};
use crate::portrait::guarantee::Uncertain;
use crate::portrait::guarantee::oscillator::Guarantee;
use crate::portrait::kicks::RandomKick;
use crate::portrait::kicks::repeated::Repeated;
use crate::portrait::{Border, Margin, Portrait, RestMargin};
use crate::proof::kicks::ProvedKicks;
use crate::words::significant;

/// Margins, nominal and guaranteed.
pub struct MarginAnswer {
    nominal: Margin,
    guaranteed: Margin,
    /// Why nothing is guaranteed.
    reason: Option<String>,
    /// Bound on a disturbing force.
    disturbance: f64,
    /// Where each number lies.
    known: Vec<(Knob, Interval)>,
    /// What borders the basin of a machine, and what is not known, a line each.
    notes: Vec<String>,
    cost: Cost,
}

impl From<&Guarantee> for MarginAnswer {
    fn from(found: &Guarantee) -> Self {
        let ParameterBox { d, d2, d3, r } = found.known;
        MarginAnswer {
            nominal: found.nominal,
            guaranteed: found.guaranteed.unwrap_or(Margin::ENDLESS),
            reason: found.guaranteed.err().map(|why| why.to_string()),
            disturbance: found.disturbance,
            known: Knob::PARAMETERS.into_iter().zip([d, d2, d3, r]).collect(),
            notes: Vec::new(),
            cost: found.cost,
        }
    }
}

impl MarginAnswer {
    /// The margins of a machine as it is, and those for certain within its tolerances.
    pub fn of_machine(
        MachineProblem { subject, tolerances, .. }: &MachineProblem,
        nominal: &Portrait,
        certain: Result<Margin, Uncertain>,
    ) -> Self {
        let uncertain = subject.of_belt().map(|belt| tolerances.intervals(belt));
        let exact = subject.numbers().map(|(knob, value)| (knob, Interval::point(value)));
        let known: BTreeMap<Knob, Interval> =
            exact.chain(uncertain.into_iter().flatten()).collect();
        MarginAnswer {
            nominal: nominal.margin,
            guaranteed: certain.unwrap_or(Margin::ENDLESS),
            reason: certain.err().map(|why| why.to_string()),
            disturbance: tolerances.disturbance,
            known: known.into_iter().collect(),
            notes: cycles::known(nominal),
            cost: cycles::steps(nominal),
        }
    }

    /// One row for the nominal and one for the guaranteed margin.
    pub fn answer<'a>(&'a self, about: &'a About, seconds: f64) -> Answer<'a> {
        let reason = self.reason.as_ref();
        let document = move || {
            let known = self.known.iter().map(|(knob, interval)| (knob.spec().name, interval));
            Document::default()
                .with("nominal", self.nominal)
                .with(
                    "guaranteed",
                    Document::default().and(&self.guaranteed).with("reason", reason),
                )
                .with("disturbance", self.disturbance)
                .with(
                    "parameters",
                    known.fold(Document::default(), |all, (name, it)| all.with(name, it)),
                )
        };
        let csv = move || {
            Columns::default()
                .file("margin", |(name, _): &(&str, Margin)| (*name).to_owned())
                .and(margin_columns(|(_, margin)| *margin))
                .file("reason", move |(name, _)| reason.filter(|_| *name == "guaranteed"))
                .csv([("nominal", self.nominal), ("guaranteed", self.guaranteed)])
        };
        about.answer(self.cost, seconds, document, csv, move || self.text(about))
    }

    /// Guaranteed numbers are not rounded up.
    fn text(&self, about: &About) -> String {
        let nothing = self.reason.as_ref().map(|why| format!("nothing is guaranteed: {why}\n"));
        let guaranteed = nothing.is_none().then_some(self.guaranteed);
        let title = "smallest kick that is not survived";
        let table = margin_table(title, about.kicks(12), self.nominal, guaranteed);
        let notes: String = self.notes.iter().flat_map(|note| [note.as_str(), "\n"]).collect();
        format!(
            "{}; disturbance {}\n\n{table}{}\n{notes}",
            about.heading(&self.known),
            about.quantity("N", 12).text(self.disturbance),
            nothing.unwrap_or_default(),
        )
    }
}

/// The columns of margins.
fn margin_columns<'a, R: 'a>(margin: impl Fn(&R) -> Margin + Copy + 'a) -> Columns<'a, R> {
    Columns::default()
        .file("displacement", move |row| margin(row).displacement)
        .file("impulse", move |row| margin(row).impulse)
        .file("from_rest_displacement", move |row| margin(row).from_rest.displacement)
        .file("from_rest_impulse", move |row| margin(row).from_rest.impulse)
}

/// Margins in text, in a row those from any place of rest and in another those from the middle; guaranteed numbers are
/// not rounded up.
pub(super) fn margin_table(
    title: &'static str,
    [length, impulse]: [Quantity; 2],
    nominal: Margin,
    guaranteed: Option<Margin>,
) -> Table {
    let below = |size: f64| length.below(size);
    let guaranteed = guaranteed.map(|margin| ("guaranteed", margin.map(below, below)));
    let rows = |(name, margin): (&str, Margin)| {
        let Margin { displacement, impulse, from_rest } = margin;
        [
            (format!("{name}, from any rest position"), from_rest),
            (format!("{name}, from q = 0"), RestMargin { displacement, impulse }),
        ]
    };
    Columns::default()
        .text(title, |(name, _): &(String, RestMargin)| name.clone())
        .text("displacement", move |(_, kicks)| length.or("none").text(kicks.displacement))
        .text("impulse", move |(_, kicks)| impulse.or("none").text(kicks.impulse))
        .table([("nominal", nominal)].into_iter().chain(guaranteed).flat_map(rows))
}

/// Where the starts of a window end, and the margins.
pub struct BasinAnswer<'a> {
    border: Border,
    counts: Counts,
    margin: Margin,
    /// The part of the window that comes to rest; `None` where it is not known.
    captured: Option<f64>,
    /// What is known of the oscillator of the paper alone, and what is proved of it.
    surveyed: Option<(&'a SurveyedBasin, Option<&'a ProvedKicks>)>,
    /// What borders the basin, and what is not known, a line each.
    notes: Vec<String>,
    cost: Cost,
}

impl<'a> BasinAnswer<'a> {
    /// The basin of the oscillator of the paper.
    pub fn new(found: &'a SurveyedBasin, certified: Option<&'a ProvedKicks>) -> Self {
        BasinAnswer {
            border: found.border,
            counts: found.counts,
            margin: found.margin,
            captured: Some(found.captured),
            surveyed: Some((found, certified)),
            notes: vec![cycles::border(found.border)],
            cost: found.cost,
        }
    }

    /// The basin of a machine.
    pub fn of_machine(found: &Portrait, counts: Counts, captured: Option<f64>) -> Self {
        BasinAnswer {
            border: found.border,
            counts,
            margin: found.margin,
            captured,
            surveyed: None,
            notes: cycles::known(found),
            cost: cycles::steps(found),
        }
    }

    /// The counts, the margins, the area and the share.
    pub fn answer(&'a self, about: &'a About, seconds: f64) -> Answer<'a> {
        let (captured, surveyed) = (self.captured, self.surveyed.map(|it| it.0));
        let certified = self.surveyed.and_then(|it| it.1);
        let document = move || {
            let certified = certified.map(|kicks| kick_columns().object(&kicks));
            let own = Document::default()
                .with("edge", self.border)
                .with("counts", self.counts)
                .with("margin", self.margin)
                .with("captured", captured);
            surveyed.map_or(own, |it| Document::default().and(it)).with_any("certified", certified)
        };
        let csv = move || {
            let proved =
                |kicks| Columns::default().part("certified", kick_columns(), move |()| Some(kicks));
            let area = |it: &'a SurveyedBasin| Columns::default().file("area", |()| it.area);
            let share = |it: &'a SurveyedBasin| {
                Columns::default().file("lyapunov_share", |()| it.lyapunov_share)
            };
            Columns::default()
                .fields(&self.counts, |()| Some(self.counts))
                .and(margin_columns(|()| self.margin))
                .and(surveyed.map(area))
                .file("captured_part", move |()| captured)
                .and(surveyed.map(share))
                .and(certified.map(proved))
                .csv([()])
        };
        about
            .answer(self.cost, seconds, document, csv, move || self.text(about))
            .below(move || certified.map(kicks_lines).unwrap_or_default())
    }

    fn text(&self, about: &About) -> String {
        let Counts { captured, cycle, escaped, undecided } = self.counts;
        let counts = Columns::default()
            .text("starts that", |(fate, _): &(&str, u64)| (*fate).to_owned())
            .text("count", |(_, count)| count.to_string())
            .table([
                ("are captured", captured),
                ("end on a stable cycle", cycle),
                ("escape", escaped),
                ("stay undecided", undecided),
            ]);
        let Margin { displacement, impulse, from_rest } = self.margin;
        let [length, momentum] = about.kicks(10);
        let sizes = [from_rest.displacement, from_rest.impulse, displacement, impulse];
        let kicks = Columns::default()
            .text("smallest kick that is not captured", |(kick, _): &(&str, String)| {
                (*kick).to_owned()
            })
            .text("size", |(_, size)| size.clone())
            .table(
                named(sizes)
                    .zip([length, momentum].into_iter().cycle())
                    .map(|((kick, size), quantity)| (kick, quantity.text(size))),
            );
        let heading = about.heading(&[]);
        let mut out = format!("{heading}\n{}\n\n{counts}\n{kicks}\n", self.notes.join("\n"));
        let Some((SurveyedBasin { area, lyapunov_share, .. }, _)) = self.surveyed else {
            let share = self.captured.map_or("not known".to_owned(), |part| significant(part, 10));
            return out + &format!("part of the window that comes to rest: {share}\n");
        };
        out += &format!("area of the basin: {}\n", length.text(*area));
        if let Some(share) = lyapunov_share {
            let verdict = if *share > 1.0 { ": too large, as it ignores D2 and D3" } else { "" };
            let share = significant(*share, 4);
            out += &format!("Lyapunov's disk (24): {share} of the margin{verdict}\n");
        }
        out
    }
}

/// What becomes of random kicks; `held` is the farthest place of rest on either side. The mean is null in a document if
/// no kick is ever lost; rows are the density of the places of rest, one for each cell of the sticking set.
pub fn kicks<'a>(
    about: &'a About,
    law: &'a RandomKick,
    found: &'a Repeated,
    held: f64,
    seconds: f64,
) -> Answer<'a> {
    let document = move || {
        let repeated = Document::default()
            .with("lost", found.later)
            .with("mean", found.mean)
            .with("error", found.error)
            .with("density", &found.density);
        Document::default()
            .with("kicks", law.to_string())
            .with("lost", found.first)
            .with("repeated", repeated)
    };
    let csv = move || {
        Columns::default()
            .file("q", |(q, _): &(f64, f64)| *q)
            .file("density", |(_, density)| *density)
            .csv(found.places(held))
    };
    about.answer(found.cost, seconds, document, csv, move || {
        format!("{}; kicks {law}\n\n{}\n\n", about.heading(&[]), lost(found))
    })
}

/// What is lost, and the mean number of kicks until one is.
fn lost(Repeated { first, later, mean, error, .. }: &Repeated) -> String {
    let number = |value: f64| significant(value, 6);
    let mean = if mean.is_finite() { number(*mean) } else { "none is ever lost".to_owned() };
    format!(
        "lost, of kicks from the middle of the rest  {} +- {}\n\
         lost, of kicks after many                   {}\n\
         mean number until one is lost               {mean}\n\
         relative error of the last two              {}",
        number(first.part),
        significant(first.error, 2),
        number(*later),
        significant(*error, 2),
    )
}
