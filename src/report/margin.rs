//! How large a kick is survived: margins, nominal and guaranteed, the basin over a window of starts, and random kicks.

use super::{About, Answer, Columns, Document, Quantity, cycles, kick_columns};
use crate::model::basin::UNKNOWN;
use crate::portrait::guarantee::Guarantee;
use crate::portrait::{
    Border, Counts, Margin, NoGuarantee, Portrait, RandomKick, StartWindow, Survival,
};
use crate::proof::ProvedKicks;
use crate::words::significant;

/// What a margin is called, and how large it is.
pub(super) type MarginRow = (&'static str, Margin);

/// The name of a margin that holds whatever is not known exactly, and whatever disturbs.
pub(super) const GUARANTEED: &str = "guaranteed";

/// The columns of margins.
pub(super) fn margin_columns<'a>(about: &About, digits: usize) -> Columns<'a, MarginRow> {
    let [length, impulse] = sizes(about, digits);
    Columns::default()
        .number("displacement", length, |(_, margin): &MarginRow| margin.displacement)
        .number("impulse", impulse, |(_, margin)| margin.impulse)
        .number("from_rest_displacement", length, |(_, margin)| margin.from_rest.displacement)
        .number("from_rest_impulse", impulse, |(_, margin)| margin.from_rest.impulse)
}

/// Displacements and impulses.
fn sizes(about: &About, digits: usize) -> [Quantity; 2] {
    ["m", "N s"].map(|unit| about.quantity(unit, digits).or("none"))
}

/// A guaranteed margin, which text must not round up.
pub(super) fn guaranteed(about: &About, margin: Margin, digits: usize) -> MarginRow {
    let [length, impulse] = sizes(about, digits);
    (GUARANTEED, margin.map(|size| length.down(size), |size| impulse.down(size)))
}

/// The margins, nominal and guaranteed whatever a force of at most `disturbance` does: a row for each, or why
/// nothing is guaranteed.
pub fn margins(
    about: &About,
    (nominal, border): (Margin, Border),
    certain: Result<Margin, NoGuarantee>,
    disturbance: f64,
) -> Answer {
    let reason = certain.err().map(|why| why.to_string());
    let margin = certain.unwrap_or(Margin::ENDLESS);
    let regime = certain.as_ref().map_or(UNKNOWN, |margin| margin.regime(Border::None));
    let rows = [("nominal", nominal), (GUARANTEED, margin)];
    let shown = certain.map(|margin| guaranteed(about, margin, 12));
    let shown = [rows[0]].into_iter().chain(shown);
    let name = |(name, _): &MarginRow| *name;
    let why = reason.clone();
    let columns = Columns::default()
        .word("margin", name)
        .and(margin_columns(about, 12))
        .file("reason", move |(name, _)| why.clone().filter(|_| *name == GUARANTEED));
    let known = about.parameters(|known| known);
    let nothing = reason.as_ref().map(|why| format!("nothing is guaranteed: {why}"));
    let bound = about.quantity("N", 12).text(disturbance);
    about
        .answer_to(&format!("; disturbance {bound}"))
        .with("nominal", read_as(nominal.regime(border), &nominal))
        .with(GUARANTEED, read_as(regime, &margin).with("reason", reason))
        .with("disturbance", disturbance)
        .with("parameters", known)
        .csv(&columns, rows)
        .table(columns.table(shown).transposed())
        .lines(nothing)
}

/// The margins of the oscillator of the paper, with its parameters in a box, and what they cost.
pub fn of_box(
    about: &About,
    nominal: &Portrait,
    certain: Guarantee,
    disturbance: f64,
    seconds: f64,
) -> Answer {
    let mut cost = nominal.cost;
    let certain = certain.map(|(worst, margin)| {
        cost += worst.cost;
        margin
    });
    let answer = margins(about, (nominal.margin, nominal.border), certain, disturbance);
    answer.cost(cost, seconds)
}

/// A margin in a document, and how it is to be read.
fn read_as(regime: &str, margin: &Margin) -> Document {
    Document::default().and(margin).with("regime", regime)
}

impl Answer {
    /// With the labels of starts, a row for each velocity, and what each label means.
    pub fn labels(self, [q, v]: [Vec<f64>; 2], labels: &[u8]) -> Self {
        let rows: Vec<_> = labels.chunks(q.len()).collect();
        self.with("labels", rows).with("legend", Counts::LABELS).with("q", q).with("v", v)
    }
}

/// The basin, where the starts of a window end, and what is proved of it.
pub fn basin(
    about: &About,
    found: &Portrait,
    (window, counts): (&StartWindow, Counts),
    certified: Option<&ProvedKicks>,
    seconds: f64,
) -> Answer {
    let (area, share) = (found.area(), found.lyapunov_share());
    let on_paper = !about.is_machine();
    let (captured, lines) = if on_paper {
        (Some(counts.captured_part()), vec![cycles::border(found.border)])
    } else {
        let captured = found.rest_share(window.q, window.v).map(|share| share.part);
        (captured, cycles::known(found))
    };
    let ending = Quantity::pure(10).or("not known");
    let whole = Columns::default().number("area", Quantity::pure(10), move |_: &MarginRow| area);
    let known =
        Columns::default().number("lyapunov_share", Quantity::pure(4), move |_: &MarginRow| share);
    let proved = certified
        .map(|kicks| Columns::default().part("certified", kick_columns(), move |_| Some(kicks)));
    let heading = "starts of the window, margins";
    let columns = Columns::default()
        .text(heading, |(name, _): &MarginRow| *name)
        .word("captured", move |_| counts.captured)
        .word("cycle", move |_| counts.cycle)
        .word("escaped", move |_| counts.escaped)
        .word("undecided", move |_| counts.undecided)
        .and(margin_columns(about, 10))
        .and(on_paper.then_some(whole))
        .number("captured_part", ending, move |_| captured)
        .and(on_paper.then_some(known))
        .and(proved);
    let row = ("", found.margin);
    let too_large = share.is_some_and(|share| on_paper && share > 1.0);
    about
        .answer()
        .lines(lines)
        .with("edge", found.border)
        .with("counts", counts)
        .with("margin", read_as(found.margin.regime(found.border), &found.margin))
        .with("captured", captured)
        .with_any("area", on_paper.then_some(area))
        .with_any("lyapunov_share", on_paper.then_some(share))
        .with_any("certified", certified.map(|it| kick_columns().object(&it)))
        .csv(&columns, [row])
        .table(columns.table([row]).transposed())
        .lines(too_large.then_some("Lyapunov's disk is too large, as it ignores D2 and D3"))
        .cost(found.cost, seconds)
}

/// What becomes of random kicks; `held` is the farthest place of rest on either side. The mean is null in a document if
/// no kick is ever lost; rows are the density of the places of rest, one for each cell of the sticking set.
pub fn kicks(about: &About, law: &RandomKick, found: &Survival, held: f64, seconds: f64) -> Answer {
    let density = Columns::default()
        .file("q", |(q, _): &(f64, f64)| *q)
        .file("density", |(_, density)| *density);
    let repeated = Document::of("lost", found.later)
        .with("mean", found.mean)
        .with("error", found.error)
        .with("density", &found.density);
    about
        .answer_to(&format!("; kicks {law}"))
        .with("kicks", law)
        .with("lost", found.first)
        .with("repeated", repeated)
        .csv(&density, found.places(held))
        .lines(lost(found))
        .cost(found.cost, seconds)
}

/// What is lost, and the mean number of kicks until one is.
fn lost(Survival { first, later, mean, error, .. }: &Survival) -> [String; 4] {
    let number = |value: f64| significant(value, 6);
    let mean = if mean.is_finite() {
        number(*mean)
    } else {
        "none is ever lost".to_owned()
    };
    let (part, about) = (number(first.part), significant(first.error, 2));
    [
        format!("lost, of kicks from the middle of the rest  {part} +- {about}"),
        format!("lost, of kicks after many                   {}", number(*later)),
        format!("mean number until one is lost               {mean}"),
        format!("relative error of the last two              {}", significant(*error, 2)),
    ]
}
