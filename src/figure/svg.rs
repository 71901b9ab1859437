//! A page as SVG: every line a vector path, every letter text.

use std::fmt::Write;

use tiny_skia_path::{PathSegment, Point};

use super::Figure;
use super::data::remarks;
use super::elements::{BLACK, Color, Element, Page, Pen, Setting, Shape, TextLine, Tint};
use crate::words::printable::xml;

/// Writes a page of a figure. Several pages can stand in one document if the names of their parts differ, which begin with
/// `name`.
pub fn svg(page: &Page, figure: &Figure, name: &str) -> String {
    let (width, height) = page.size;
    let mut writer = Writer { name, clips: 0, out: String::new() };
    page.elements.iter().for_each(|part| writer.element(part));
    format!(
        include_str!("../../assets/figure.svg"),
        // Programs agree on what a millimetre is, but not on what a point is.
        across = short(width * page.unit * 25.4 / 72.0),
        down = short(height * page.unit * 25.4 / 72.0),
        width = short(width),
        height = short(height),
        title = xml(&figure.title),
        remarks = xml(&remarks(figure).join("\n")),
        elements = writer.out,
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

struct Writer<'a> {
    out: String,
    name: &'a str,
    /// How many parts have a name.
    clips: usize,
}

impl Writer<'_> {
    fn element(&mut self, element: &Element) {
        match element {
            Element::Shape(shape) => self.shape(shape),
            Element::Text(line) => self.text(line),
            Element::Clipped((x, y), (width, height), inside) => {
                let name = format!("{}{}", self.name, self.clips);
                self.clips += 1;
                let [x, y, width, height] = [x, y, width, height].map(|length| short(*length));
                self.out += &format!(
                    "<clipPath id=\"{name}\"><rect x=\"{x}\" y=\"{y}\" width=\"{width}\" \
                     height=\"{height}\"/></clipPath>\n<g clip-path=\"url(#{name})\">\n"
                );
                inside.iter().for_each(|part| self.element(part));
                self.out += "</g>\n";
            }
            Element::Cells(cells) => {
                self.out += "<g shape-rendering=\"crispEdges\">\n";
                cells.iter().for_each(|cell| self.shape(cell));
                self.out += "</g>\n";
            }
        }
    }

    fn shape(&mut self, shape: &Shape) {
        let fill = shape.tint.map_or(" fill=\"none\"".into(), filled);
        let stroke = shape.pen.map_or(String::new(), stroked);
        self.out += &format!("<path d=\"{}\"{fill}{stroke}/>\n", path(shape));
    }

    fn text(&mut self, line: &TextLine) {
        let (x, y, size) = (short(line.at.0), short(line.at.1), short(line.size));
        let (anchor, letters): (&str, _) = (line.anchor.into(), spans(line));
        let turned = if line.upward {
            format!(" transform=\"rotate(-90 {x} {y})\"")
        } else {
            String::new()
        };
        let fill = if line.color == BLACK {
            String::new()
        } else {
            format!(" fill=\"{}\"", hex(line.color))
        };
        // First its edge, so that what understands no order of painting shows the letters too.
        let edge = line.edge.map(|pen| format!(" fill=\"none\"{}", stroked(pen)));
        for painted in edge.into_iter().chain([fill]) {
            self.out += &format!(
                "<text x=\"{x}\" y=\"{y}\" text-anchor=\"{anchor}\" font-size=\"{size}\"{turned}\
                 {painted}>{letters}</text>\n"
            );
        }
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

/// The runs of a text; what is set as its element says stands there as it is.
fn spans(line: &TextLine) -> String {
    let (mut out, mut below) = (String::new(), 0.0);
    for run in &line.runs {
        let ((size, down), text) = (run.setting.of(line.size), xml(&run.text));
        let moved = if down == below {
            String::new()
        } else {
            format!(" dy=\"{}\"", short(down - below))
        };
        below = down;
        let set = match run.setting {
            Setting::Upright => String::new(),
            Setting::Italic => " font-style=\"italic\"".into(),
            Setting::Subscript | Setting::Superscript => format!(" font-size=\"{}\"", short(size)),
        };
        let attributes = set + &moved;
        out += &if attributes.is_empty() {
            text
        } else {
            format!("<tspan{attributes}>{text}</tspan>")
        };
    }
    out
}
