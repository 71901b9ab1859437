//! A page as SVG: every line a vector path, every letter text.

use std::fmt::Write;

use tiny_skia_path::{PathSegment, Point};

use super::Figure;
use super::data::remarks;
use super::elements::{Color, Element, Page, PlotPen, Shape, TextLine, Tint};
use super::symbols::LetterStyle;
use crate::words::printable::xml;

/// Writes a page of a figure. Several pages can stand in one document if the names of their parts differ, which begin with
/// `name`.
pub fn svg(page: &Page, figure: &Figure, name: &str) -> String {
    let (width, height) = page.size;
    let mut elements = String::new();
    add(&mut elements, &page.elements, name);
    format!(
        include_str!("../../assets/figure.svg"),
        // Programs agree on what a millimetre is, but not on what a point is.
        across = short(width * page.unit.in_points() * 25.4 / 72.0),
        down = short(height * page.unit.in_points() * 25.4 / 72.0),
        width = short(width),
        height = short(height),
        title = xml(&figure.title),
        remarks = xml(&remarks(figure).join("\n")),
        elements = elements,
    )
}

/// A number with up to three decimals.
fn short(value: impl Into<f64>) -> String {
    let text = format!("{:.3}", value.into());
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".into() } else { text.into() }
}

fn hex([red, green, blue]: Color) -> String {
    format!("#{red:02x}{green:02x}{blue:02x}")
}

fn add(out: &mut String, elements: &[Element], name: &str) {
    for element in elements {
        match element {
            Element::Shape(shape) => {
                let fill = shape.tint.map_or(" fill=\"none\"".into(), filled);
                let stroke = shape.pen.map_or(String::new(), stroked);
                *out += &format!("<path d=\"{}\"{fill}{stroke}/>\n", path(shape));
            }
            Element::Text(line) => text(out, line),
            Element::Clipped(corner, size, inside) => {
                // Nothing else of the name begins at the same place of the document.
                let name = format!("{name}-{}", out.len());
                let window = path(&Shape::rectangle(*corner, *size));
                *out += &format!(
                    "<clipPath id=\"{name}\"><path d=\"{window}\"/></clipPath>\n\
                     <g clip-path=\"url(#{name})\">\n"
                );
                add(out, inside, &name);
                *out += "</g>\n";
            }
        }
    }
}

fn text(out: &mut String, line: &TextLine) {
    let (x, y, size) = (short(line.at.0), short(line.at.1), short(line.size));
    let (anchor, letters): (&str, _) = (line.anchor.into(), spans(line));
    let turned = line.upward.then(|| format!(" transform=\"rotate(-90 {x} {y})\""));
    let turned = turned.unwrap_or_default();
    // First its edge, so that what understands no order of painting shows the letters too.
    let edge = line.edge.map(|pen| format!(" fill=\"none\"{}", stroked(pen)));
    for painted in edge.into_iter().chain([format!(" fill=\"{}\"", hex(line.color))]) {
        *out += &format!(
            "<text x=\"{x}\" y=\"{y}\" text-anchor=\"{anchor}\" font-size=\"{size}\"{turned}\
             {painted}>{letters}</text>\n"
        );
    }
}

fn filled(Tint { color, opacity }: Tint) -> String {
    let opacity = (opacity < 1.0).then(|| format!(" fill-opacity=\"{}\"", short(opacity)));
    format!(" fill=\"{}\"{}", hex(color), opacity.unwrap_or_default())
}

fn stroked(PlotPen { width, color, dash }: PlotPen) -> String {
    let dash: Vec<String> = dash.iter().map(|length| short(*length)).collect();
    let dashes = format!(" stroke-dasharray=\"{}\"", dash.join(" "));
    let dashes = if dash.is_empty() { "" } else { &dashes };
    format!(" stroke=\"{}\" stroke-width=\"{}\"{dashes}", hex(color), short(width))
}

/// The data of a path.
fn path(shape: &Shape) -> String {
    let at = |point: Point| format!("{} {}", short(point.x), short(point.y));
    let mut out = String::new();
    for segment in shape.path.iter().flat_map(|path| path.segments()) {
        let _ = match segment {
            PathSegment::MoveTo(to) => write!(out, "M{}", at(to)),
            PathSegment::LineTo(to) => write!(out, "L{}", at(to)),
            PathSegment::QuadTo(by, to) => write!(out, "Q{} {}", at(by), at(to)),
            PathSegment::CubicTo(one, two, to) => {
                write!(out, "C{} {} {}", at(one), at(two), at(to))
            }
            PathSegment::Close => write!(out, "Z"),
        };
    }
    out
}

/// The runs of a text; one that is set as its element says stands there as it is.
fn spans(line: &TextLine) -> String {
    let (mut out, mut below) = (String::new(), 0.0);
    for run in &line.runs {
        let ((size, down), text) = (run.setting.of(line.size), xml(&run.text));
        let style = if run.setting == LetterStyle::Italic {
            "italic"
        } else {
            "normal"
        };
        let (size, dy) = (short(size), short(down - below));
        let span = format!(
            "<tspan font-style=\"{style}\" font-size=\"{size}\" dy=\"{dy}\">{text}</tspan>"
        );
        let plain = run.setting == LetterStyle::Upright && dy == "0";
        out += if plain { &text } else { &span };
        below = down;
    }
    out
}
