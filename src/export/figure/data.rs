//! A figure as data: one JSON document, or one CSV row a point.

use super::Figure;
use crate::export::{csv::exact_or_empty, csv::line, json::text};

/// One document; what is not a number is `null`.
#[must_use]
pub fn json(figure: &Figure) -> String {
    text(figure)
}

/// What it was computed with in lines that begin with `#`, then one row for each point of each curve,
/// area and mark.
#[must_use]
pub fn csv(figure: &Figure) -> String {
    let mut out = String::new();
    for remark in remarks(figure) {
        out += &format!("# {remark}\n");
    }
    out += "panel,kind,number,name,role,style,x,y\n";
    for (panel, shown) in (1..).zip(&figure.panels) {
        let mut row =
            |kind: &str, number: usize, name: &str, role: &str, style: &str, [x, y]: [f64; 2]| {
                out += &line(&[
                    format!("{panel}"),
                    kind.to_owned(),
                    number.to_string(),
                    name.to_owned(),
                    role.to_owned(),
                    style.to_owned(),
                    exact_or_empty(Some(x)),
                    exact_or_empty(Some(y)),
                ]);
            };
        for (number, curve) in (1..).zip(&shown.curves) {
            for point in &curve.points {
                row("curve", number, &curve.name, curve.role, curve.style, *point);
            }
        }
        for (number, area) in (1..).zip(&shown.areas) {
            for point in &area.edge {
                row("area", number, &area.name, area.role, "", *point);
            }
        }
        for (number, mark) in (1..).zip(&shown.marks) {
            row("mark", number, &mark.name, mark.pen.name(), "", [mark.x, mark.y]);
        }
    }
    out
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
    for (number, panel) in (1..).zip(&figure.panels) {
        remarks.push(format!(
            "panel {number}: {}, {} over {}",
            panel.title, panel.y.name, panel.x.name
        ));
    }
    remarks
}
