//! What a caption says about a figure, as text: what each panel shows, how each line is drawn, and with which numbers.

use super::data::{computed, said};
use super::elements::PageUnit;
use super::lines::FAINT;
use super::paper::PageLayout;
use super::{Figure, MarkedPoint, Outline};
use crate::words::{joined, printable, significant};

/// The facts for the caption of a figure, a line each.
pub fn facts(figure: &Figure) -> String {
    let paper = PageLayout::of(figure);
    let unit = if paper.unit == PageUnit::Point {
        "pt"
    } else {
        "pixels"
    };
    let mut lines = computed(figure);
    lines.push(format!("curves drawn to within {FAINT} {unit}"));
    for (number, panel) in figure.panels.iter().enumerate() {
        let [left, right, low, high] =
            [panel.x.from, panel.x.to, panel.y.from, panel.y.to].map(|end| significant(end, 6));
        lines.extend([String::new(), said(number, panel)]);
        lines.push(format!("  from {left} to {right} to the right, from {low} to {high} upwards"));
        lines.extend(panel.curves.iter().chain(&panel.areas).map(|it| drawn(it, &paper, unit)));
        let mark = |MarkedPoint { name, mark, role, .. }: &MarkedPoint| {
            format!("  {name}: {}, {}", mark.shape(), paper.word(*role))
        };
        lines.extend(panel.marks.iter().map(mark));
    }
    lines.dedup();
    joined(lines.iter().map(|line| printable::line(line).into_owned() + "\n"), "")
}

/// How a line or an area is drawn, and with which numbers.
fn drawn(
    Outline { name, role, style, parameters, .. }: &Outline,
    paper: &PageLayout,
    unit: &str,
) -> String {
    let color = paper.word(*role);
    let look = match style {
        None => format!("area, pale {color}"),
        Some(dash) => format!(
            "{} line, {color}, {} {unit}",
            <&str>::from(dash),
            paper.pen(*role, *dash).width
        ),
    };
    let held = joined(parameters.iter().map(|(name, value)| format!("{name} = {value}")), ", ");
    format!("  {name}: {look}; {held}").trim_end_matches("; ").to_owned()
}
