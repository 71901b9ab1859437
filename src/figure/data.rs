//! A figure as data: one JSON document, or one CSV row a point.

use serde::Serialize;

use super::content::{Area, Figure, FigureCurve};
use crate::picture::map::{MapCell, ScanMap};
use crate::report::csv::CsvSheet;
use crate::report::json::text;
use crate::words::printable;

/// One document; what is not a number is `null`.
pub fn json(figure: &Figure) -> String {
    text(figure)
}

/// What it was computed with in lines that begin with `#`, then one row for each cell of a map, and each point of
/// each curve, area and mark.
pub fn csv(figure: &Figure) -> String {
    let mut out = String::new();
    for remark in remarks(figure) {
        out += &format!("# {remark}\n");
    }
    // Only a map has values.
    let map = figure.panels.iter().any(|panel| panel.map.is_some());
    let value = map.then_some(MapCell::Number(0.0));
    let mut sheet = CsvSheet::like(&PointRow { value, ..PointRow::default() }, &[]);
    for (panel, shown) in (1..).zip(&figure.panels) {
        if let Some(ScanMap { name, x, y, values, .. }) = &shown.map {
            for (x, column) in x.iter().zip(values) {
                for (y, value) in y.iter().zip(column) {
                    let row = PointRow { kind: "map", number: 1, name, ..PointRow::default() };
                    sheet.row(&PointRow { panel, x: *x, y: *y, value: Some(*value), ..row });
                }
            }
        }
        let mut add = |row: PointRow, points: &[[f64; 2]]| {
            for [x, y] in points {
                sheet.row(&PointRow { panel, x: *x, y: *y, ..row });
            }
        };
        for (number, curve) in (1..).zip(&shown.curves) {
            let FigureCurve { name, role, style, points, .. } = curve;
            add(
                PointRow { kind: "curve", number, name, role, style, ..PointRow::default() },
                points,
            );
        }
        for (number, area) in (1..).zip(&shown.areas) {
            let Area { name, role, edge, .. } = area;
            add(PointRow { kind: "area", number, name, role, ..PointRow::default() }, edge);
        }
        for (number, mark) in (1..).zip(&shown.marks) {
            let (name, role) = (&mark.name, mark.pen.name());
            add(
                PointRow { kind: "mark", number, name, role, ..PointRow::default() },
                &[[mark.x, mark.y]],
            );
        }
    }
    out + &sheet.into_text()
}

/// A cell of a map, a point of a curve, of the edge of an area, or a mark.
#[derive(Clone, Copy, Default, Serialize)]
struct PointRow<'a> {
    panel: u32,
    kind: &'static str,
    number: u32,
    name: &'a str,
    role: &'static str,
    style: &'static str,
    x: f64,
    y: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    value: Option<MapCell>,
}

/// What a figure was computed with, a line each.
pub(super) fn remarks(figure: &Figure) -> Vec<String> {
    let p = &figure.parameters;
    let start = &figure.initial;
    let mut remarks = vec![
        format!("{}: {}", figure.figure, figure.title),
        format!("D = {:?}, D2 = {:?}, D3 = {:?}, r = {:?}", p.d, p.d2, p.d3, p.r),
        format!("q0 = {:?}, v0 = {:?}, until = {:?}", start.q, start.v, figure.until),
        format!("method {}, tolerance {:?}, {}", figure.method, figure.tolerance, figure.program),
        figure.units.to_owned(),
    ];
    if let Some(provenance) = &figure.provenance {
        remarks.push(format!("{}: {}", provenance.build(), provenance.command));
    }
    for (number, panel) in (1..).zip(&figure.panels) {
        remarks.push(format!(
            "panel {number}: {}, {} over {}",
            panel.title, panel.y.name, panel.x.name
        ));
    }
    remarks.iter().map(|remark| printable::line(remark).into_owned()).collect()
}
