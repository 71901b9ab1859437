//! A fit as a page that can be signed.

use super::{NUMBERS, correlations, draws, forces, margins, numbers, start, subject};
use crate::fit::{Condition, Fitted, LeftOut, left_out};
use crate::report::page::{Page, PagePart, Section, SourceFile, origin};
use crate::report::{Columns, Table};
use crate::words::fit::{broken, left_out as counts, sentences};
use crate::words::provenance::Provenance;
use crate::words::significant;
use crate::words::statement::{SignedStatement, signed};

/// The page of a fit: with its pictures, what computed it, and the file of the record.
pub fn page(
    fitted: &Fitted,
    pictures: &[String],
    provenance: &Provenance,
    source: &SourceFile,
) -> String {
    let SignedStatement { statement, conditions } = signed(fitted);
    let broken = broken(fitted);
    let counts = counts(fitted);
    let remarks = sentences(fitted)
        .into_iter()
        .filter(|it| Some(it) != broken.as_ref() && *it != statement.text && !counts.contains(it))
        .collect();
    let statement = PagePart::Statement { holds: broken.is_none(), text: statement.text };
    let section = |heading, parts| Section { heading, parts };
    let table =
        |caption, table: Table| (!table.is_empty()).then_some(PagePart::Table(caption, table));
    let known = [
        table(NUMBERS, numbers(fitted)),
        table("in SI units, with standard errors", forces(fitted)),
        Some(PagePart::Text(start(fitted))),
    ];
    let draws = draws(fitted);
    Page {
        kind: "Fit of a recorded motion",
        title: &fitted.name,
        subject: subject(fitted),
        sections: vec![
            section(
                "",
                vec![statement, PagePart::Table("what the sentence rests on", tested(&conditions))],
            ),
            section("Numbers", known.into_iter().flatten().collect()),
            section("Margin", vec![PagePart::Table(&draws, margins(fitted))]),
            section("Record and fit", vec![PagePart::Pictures(pictures)]),
            section("Correlations", table("", correlations(fitted)).into_iter().collect()),
            section("Left out", vec![PagePart::List(counts), PagePart::Text(places(fitted))]),
            section("Remarks", vec![PagePart::List(remarks)]),
            origin(provenance, std::slice::from_ref(source)),
        ],
    }
    .html()
}

/// The conditions with their results.
fn tested(conditions: &[Condition]) -> Table {
    Columns::default()
        .text("condition", |it: &&Condition| it.name.to_owned())
        .text("result", |it| it.verdict().to_owned())
        .text("what was found", |it| it.detail.clone())
        .table(conditions)
}

/// Where the samples lie that do not count.
fn places(fitted: &Fitted) -> String {
    let time = |t| significant(t, 6);
    let place = |it: &LeftOut| match it.samples {
        1 => format!("{} s", time(it.from)),
        several => format!("{} .. {} s ({several} samples)", time(it.from), time(it.to)),
    };
    let places: Vec<String> =
        left_out(&fitted.record, &fitted.estimate).iter().map(place).collect();
    if places.is_empty() {
        return "every sample of the record that was read counts".to_owned();
    }
    format!("samples at these times do not count: {}", places.join("; "))
}
