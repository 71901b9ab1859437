//! What a caption says about a figure, as text: what each panel shows, how each line is drawn, and with which numbers.

use super::data::computed;
use super::elements::PageUnit;
use super::lines::FAINT;
use super::paper::PageLayout;
use super::{Figure, MarkedPoint, Outline, Panel};
use crate::model::{Group, Knob};
use crate::picture::Scale;
use crate::scene::Span;
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
        let Panel { title, names: [x, y], window, scales, .. } = panel;
        let above = if y.is_empty() { String::new() } else { format!("{y} ") };
        lines.extend([String::new(), format!("panel {}: {title}, {above}over {x}", number + 1)]);
        // As the axes have them: in the unit of a machine.
        let ends = |span: Span, scale: Scale| span.ends().map(|end| scale.value(end));
        let [left, right] = ends(window.x, scales[0]).map(|end| significant(end, 6));
        let [low, high] = ends(window.y, scales[1]).map(|end| significant(end, 6));
        lines.push(format!("  from {left} to {right} to the right, from {low} to {high} upwards"));
        let outlines = panel.curves.iter().chain(&panel.areas);
        lines.extend(outlines.map(|it| drawn(it, figure, &paper, unit)));
        let mark = |MarkedPoint { name, mark, role, .. }: &MarkedPoint| {
            format!("  {name}: {}, {}", mark.shape(), paper.word(*role))
        };
        lines.extend(panel.marks.iter().map(mark));
    }
    lines.dedup();
    joined(lines.iter().map(|line| printable::line(line).into_owned() + "\n"), "")
}

/// How a line or an area is drawn, and with which numbers where these are not those of the figure.
fn drawn(
    Outline { name, role, style, parameters, .. }: &Outline,
    figure: &Figure,
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
    // What holds for the whole figure is said once.
    let value =
        |name: &str| Knob::named(name, &[Group::Motion]).map(|it| figure.parameters.value(it));
    let own = parameters.iter().any(|(name, held)| value(name) != Ok(*held));
    let own = parameters.iter().filter(|_| own);
    let held = joined(own.map(|(name, value)| format!("{name} = {value}")), ", ");
    format!("  {name}: {look}; {held}").trim_end_matches("; ").to_owned()
}
