//! A figure as data: one row of comma-separated values a point.

use serde::Serialize;

use super::{Figure, MarkedPoint, Outline, Panel};
use crate::picture::{MapCell, ScanMap};
use crate::report::Columns;
use crate::words::printable;

/// One row for each cell of a map, and each point of each curve, area and mark.
pub fn csv(figure: &Figure) -> String {
    // Only a map has values.
    let map = figure.panels.iter().any(|panel| panel.map.is_some());
    let value = map.then(|| Columns::default().file("value", |row: &PointRow| row.value));
    let columns = Columns::default().fields(&PointRow::default(), |row| Some(*row)).and(value);
    columns.csv((1..).zip(&figure.panels).flat_map(|(number, shown)| rows(number, shown)))
}

/// A cell of a map, a point of a curve, of the edge of an area, or a mark: a column for each field.
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
    #[serde(skip)]
    value: Option<MapCell>,
}

/// The cells and points of a panel.
fn rows<'a>(panel: u32, shown: &'a Panel) -> Vec<PointRow<'a>> {
    let mut rows = Vec::new();
    if let Some(ScanMap { name, x, y, values, .. }) = &shown.map {
        for (&x, column) in x.iter().zip(values) {
            let row = PointRow { panel, kind: "map", number: 1, name, x, ..PointRow::default() };
            let cells = y.iter().zip(column);
            rows.extend(cells.map(|(&y, cell)| PointRow { y, value: Some(*cell), ..row }));
        }
    }
    let mut add = |row: PointRow<'a>, points: &[[f64; 2]]| {
        rows.extend(points.iter().map(|&[x, y]| PointRow { panel, x, y, ..row }));
    };
    let plain = PointRow::default();
    for (kind, lines) in [("curve", &shown.curves), ("area", &shown.areas)] {
        for (number, Outline { name, role, style, points, .. }) in (1..).zip(lines) {
            let (role, style) = (role.name(), style.map_or("", Into::into));
            add(PointRow { kind, number, name, role, style, ..plain }, points);
        }
    }
    for (number, MarkedPoint { name, role, at, .. }) in (1..).zip(&shown.marks) {
        add(PointRow { kind: "mark", number, name, role: role.name(), ..plain }, &[(*at).into()]);
    }
    rows
}

/// What a figure was computed with, and what its panels show, a line each.
pub fn remarks(figure: &Figure) -> Vec<String> {
    let mut remarks = computed(figure);
    let said = |(number, Panel { title, x, y, .. }): (usize, &Panel)| {
        format!("panel {number}: {title}, {} over {}", y.name, x.name)
    };
    remarks.extend((1..).zip(&figure.panels).map(said));
    remarks.iter().map(|remark| printable::line(remark).into_owned()).collect()
}

/// What a figure was computed with, a line each.
pub fn computed(figure: &Figure) -> Vec<String> {
    let p = &figure.parameters;
    let start = &figure.initial;
    let mut remarks = vec![
        format!("{}: {}", figure.figure, figure.title),
        format!("D = {:?}, D2 = {:?}, D3 = {:?}, r = {:?}", p.d, p.d2, p.d3, p.r),
        format!("q0 = {:?}, v0 = {:?}, until = {:?}", start.q, start.v, figure.until),
        format!("method {}, tolerance {:?}, {}", figure.method, figure.tolerance, figure.program),
        figure.units.clone(),
    ];
    remarks.extend(figure.machine.clone());
    if let Some(provenance) = &figure.provenance {
        remarks.push(format!("{}: {}", provenance.build(), provenance.command));
    }
    remarks
}
