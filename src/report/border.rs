//! The fold and the escape point along a second parameter.

use super::certified::BorderProof;
use super::columns::{Columns, Quantity, bounds};
use super::json::Document;
use super::table::{cost, parameters};
use crate::branch::fold::{Boundary, BoundaryPoint};
use crate::words::number::significant;

/// The fold and the escape point at one value of the second parameter, and what is proved of them.
type BorderRow<'a> = (&'a BoundaryPoint, Option<&'a BorderProof>);

/// The columns; with those of the enclosures if there are any.
fn columns<'a>(found: &Boundary, is_certified: bool) -> Columns<'a, BorderRow<'a>> {
    const EXACT: Quantity = Quantity::pure(12);
    const SHORT: Quantity = Quantity::pure(8);
    let certified = Columns::default()
        .bounds("D_F", |proof: &&BorderProof| proof.fold)
        .bounds("D_c", |proof| proof.escape)
        .file("proved", |proof| proof.open.is_empty())
        .file("open", |proof| proof.open.join(", "));
    let certified = Columns::default().part("certified", certified, |row: &BorderRow<'a>| row.1);
    let kind = |grazes: bool| if grazes { "grazing" } else { "fold" };
    Columns::default()
        .number(found.second.spec().name, Quantity::pure(10), |(point, _): &BorderRow| point.value)
        .number("D_F", EXACT, |(point, _)| point.fold.map(|fold| fold.d))
        .text("is a", move |(point, _)| point.fold.map_or("-", |fold| kind(fold.grazes)).to_owned())
        .number("q_max", SHORT, |(point, _)| point.fold.map(|fold| fold.q_max))
        .titled("q_max there")
        .file("period", |(point, _)| point.fold.map(|fold| fold.period))
        .number("D_F_harmonic", SHORT, |(point, _)| point.harmonic_fold)
        .titled("D_F of (48)")
        .number("D_c", EXACT, |(point, _)| point.escape)
        .file("reason", |(point, _)| point.reason.clone())
        .and(is_certified.then_some(certified))
}

pub fn json(found: &Boundary, certified: Option<&[BorderProof]>, seconds: f64) -> String {
    let proved = |proof: &BorderProof| {
        Document::default()
            .with("value", proof.value)
            .with("fold", proof.fold.map(bounds))
            .with("escape", proof.escape.map(bounds))
            .with("proved", proof.open.is_empty())
            .with("open", &proof.open)
    };
    let certified = certified.map(|all| all.iter().map(proved).collect::<Vec<_>>());
    Document::default()
        .with("parameters", found.parameters)
        .with("parameter", found.second)
        .with("points", &found.points)
        .with_any("certified", certified)
        .cost(&found.cost, seconds)
        .text()
}

/// One row for each value of the second parameter.
pub fn csv(found: &Boundary, certified: Option<&[BorderProof]>) -> String {
    let proof = |index| certified.and_then(|all| all.get(index));
    let rows = found.points.iter().enumerate().map(|(index, point)| (point, proof(index)));
    columns(found, certified.is_some()).csv(rows)
}

/// A table with one row for each value of the second parameter.
pub fn table(found: &Boundary, seconds: f64) -> String {
    let table = columns(found, false).table(found.points.iter().map(|point| (point, None)));
    let given_up = found.points.iter().filter_map(|point| {
        let reason = point.reason.as_ref()?;
        Some(format!("\n{} = {}: {reason}", found.second, significant(point.value, 10)))
    });
    let given_up: String = given_up.collect();
    let fixed = parameters(&found.parameters, Some(found.second));
    format!("{fixed}\n\n{table}{given_up}\n{}", cost(found.cost, seconds))
}
