//! A page as SVG: every line a vector path, every letter text.

use std::fmt::Write;

use super::Figure;
use super::data::remarks;
use super::elements::{
    BLACK, Color, Element, Page, PageUnit, PathStep, Pen, Shape, Slant, Spot, TextLine, Tint,
};
use crate::words::printable::xml;

/// Writes a page of a figure. Several pages can stand in one document if the names of their parts differ, which begin with
/// `name`.
pub fn svg(page: &Page, figure: &Figure, name: &str) -> String {
    let (width, height) = page.size;
    // Programs agree on what a millimetre is, but not on what a point is.
    let side = |length: f64| match page.unit {
        PageUnit::Pixel => short(length),
        PageUnit::Point => format!("{}mm", short(length * 25.4 / 72.0)),
    };
    let mut writer = Writer { name, clips: 0, out: String::new() };
    page.elements.iter().for_each(|part| writer.element(part));
    format!(
        include_str!("../../assets/figure.svg"),
        size = format_args!("width=\"{}\" height=\"{}\"", side(width), side(height)),
        width = short(width),
        height = short(height),
        title = xml(&figure.title),
        remarks = xml(&remarks(figure).join("\n")),
        elements = writer.out,
    )
}

/// A number with up to three decimals.
fn short(value: f64) -> String {
    let text = format!("{value:.3}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".into() } else { text.into() }
}

fn hex([red, green, blue]: Color) -> String {
    format!("#{red:02x}{green:02x}{blue:02x}")
}

struct Writer<'a> {
    out: String,
    name: &'a str,
    /// How many parts have a name.
    clips: usize,
}

impl Writer<'_> {
    /// Adds a line. Writing to a string cannot fail.
    fn add(&mut self, line: std::fmt::Arguments) {
        let _ = writeln!(self.out, "{line}");
    }

    fn element(&mut self, element: &Element) {
        match element {
            Element::Shape(shape) => self.shape(shape),
            Element::Text(line) => self.text(line),
            Element::Clipped((x, y), (width, height), inside) => {
                let name = format!("{}{}", self.name, self.clips);
                self.clips += 1;
                let [x, y, width, height] = [x, y, width, height].map(|length| short(*length));
                self.add(format_args!(
                    "<clipPath id=\"{name}\"><rect x=\"{x}\" y=\"{y}\" width=\"{width}\" \
                     height=\"{height}\"/></clipPath>\n<g clip-path=\"url(#{name})\">"
                ));
                inside.iter().for_each(|part| self.element(part));
                self.add(format_args!("</g>"));
            }
            Element::Cells(cells) => {
                self.add(format_args!("<g shape-rendering=\"crispEdges\">"));
                cells.iter().for_each(|cell| self.shape(cell));
                self.add(format_args!("</g>"));
            }
        }
    }

    fn shape(&mut self, Shape { steps, pen, tint }: &Shape) {
        let fill = tint.map_or_else(|| " fill=\"none\"".into(), filled);
        let stroke = pen.map_or_else(String::new, stroked);
        self.add(format_args!("<path d=\"{}\"{fill}{stroke}/>", path(steps)));
    }

    fn text(&mut self, line: &TextLine) {
        let TextLine { at, anchor, size, color, edge, .. } = line;
        let (x, y) = (short(at.0), short(at.1));
        let anchor: &str = anchor.into();
        let turned = if line.upward {
            format!(" transform=\"rotate(-90 {x} {y})\"")
        } else {
            String::new()
        };
        let begun = format!(
            "<text x=\"{x}\" y=\"{y}\" text-anchor=\"{anchor}\" font-size=\"{}\"{turned}",
            short(*size)
        );
        let letters = spans(line);
        // First its edge, so that what understands no order of painting shows the letters too.
        if let Some(pen) = edge {
            let edge = stroked(*pen);
            self.add(format_args!("{begun} fill=\"none\"{edge}>{letters}</text>"));
        }
        let fill = if *color == BLACK {
            String::new()
        } else {
            format!(" fill=\"{}\"", hex(*color))
        };
        self.add(format_args!("{begun}{fill}>{letters}</text>"));
    }
}

fn filled(Tint { color, opacity }: Tint) -> String {
    let opacity = if opacity < 1.0 {
        format!(" fill-opacity=\"{}\"", short(opacity))
    } else {
        String::new()
    };
    format!(" fill=\"{}\"{opacity}", hex(color))
}

fn stroked(Pen { width, color, dash }: Pen) -> String {
    let dash: Vec<String> = dash.iter().map(|length| short(*length)).collect();
    let dash = match dash[..] {
        [] => String::new(),
        _ => format!(" stroke-dasharray=\"{}\"", dash.join(" ")),
    };
    format!(" stroke=\"{}\" stroke-width=\"{}\"{dash}", hex(color), short(width))
}

/// The data of a path.
fn path(steps: &[PathStep]) -> String {
    let at = |(x, y): Spot| format!("{} {}", short(x), short(y));
    let mut out = String::new();
    for step in steps {
        let _ = match *step {
            PathStep::Move(to) => write!(out, "M{}", at(to)),
            PathStep::Line(to) => write!(out, "L{}", at(to)),
            PathStep::Curve(leave, reach, to) => {
                write!(out, "C{} {} {}", at(leave), at(reach), at(to))
            }
            PathStep::Close => write!(out, "Z"),
        };
    }
    out
}

/// The runs of a text; what is set as its element says stands there as it is.
fn spans(line: &TextLine) -> String {
    let (mut out, mut below) = (String::new(), 0.0);
    for run in &line.runs {
        let (size, down) = run.level.set(line.size);
        let mut attributes = String::new();
        if run.slant == Slant::Italic {
            attributes += " font-style=\"italic\"";
        }
        if size != line.size {
            attributes += &format!(" font-size=\"{}\"", short(size));
        }
        if down != below {
            attributes += &format!(" dy=\"{}\"", short(down - below));
            below = down;
        }
        let text = xml(&run.text);
        match attributes.as_str() {
            "" => out += &text,
            _ => out += &format!("<tspan{attributes}>{text}</tspan>"),
        }
    }
    out
}
