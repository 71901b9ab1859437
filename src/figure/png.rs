//! A figure as PNG: its SVG, painted with a font that comes with the program, so that it looks the same on
//! every machine.

use std::fmt::Write;

use resvg::tiny_skia::{Pixmap, Transform};
use resvg::usvg::{Options, Tree};
use roxmltree::{Document, Node};
use ttf_parser::{Face, GlyphId, OutlineBuilder};

/// Dots of a PNG along a pixel of the vector picture, which is a 96th of an inch: 288 to the inch.
const SCALE: f32 = 3.0;

/// Upright and slanted letters.
const FONTS: [&[u8]; 2] = [
    include_bytes!("../../assets/fonts/DejaVuSans.ttf"),
    include_bytes!("../../assets/fonts/DejaVuSans-Oblique.ttf"),
];

/// Attributes that say how letters are set; all others say how they are painted.
const SETTING: [&str; 5] = ["x", "y", "text-anchor", "font-size", "font-style"];

/// Paints an SVG. Fails with one line if it is not one, or too large.
pub fn png(svg: &str) -> Result<Vec<u8>, String> {
    let tree = Tree::from_str(&outlined(svg)?, &Options::default()).map_err(failed)?;
    let size = tree.size().to_int_size().scale_by(SCALE).ok_or_else(|| failed("it has no size"))?;
    let mut dots =
        Pixmap::new(size.width(), size.height()).ok_or_else(|| failed("it is too large"))?;
    resvg::render(&tree, Transform::from_scale(SCALE, SCALE), &mut dots.as_mut());
    dots.encode_png().map_err(failed)
}

fn failed(why: impl std::fmt::Display) -> String {
    format!("not painted: {why}")
}

/// The SVG with its texts as paths, so that painting it takes no fonts.
fn outlined(svg: &str) -> Result<String, String> {
    let document = Document::parse(svg).map_err(failed)?;
    let [upright, slanted] = FONTS.map(|font| Face::parse(font, 0));
    let (upright, slanted) = (upright.map_err(failed)?, slanted.map_err(failed)?);
    let mut out = String::with_capacity(2 * svg.len());
    let mut copied = 0;
    for text in document.descendants().filter(|node| node.has_tag_name("text")) {
        let italic = text.attribute("font-style") == Some("italic");
        let path = outline(&text, if italic { &slanted } else { &upright });
        out.push_str(&svg[copied..text.range().start]);
        let _ = write!(out, "<path d=\"{path}\"");
        for painted in text.attributes().filter(|it| !SETTING.contains(&it.name())) {
            let _ = write!(out, " {}=\"{}\"", painted.name(), painted.value());
        }
        out.push_str("/>");
        copied = text.range().end;
    }
    out.push_str(&svg[copied..]);
    Ok(out)
}

/// The letters of a text element as the data of a path.
fn outline(text: &Node, font: &Face) -> String {
    let number = |name| text.attribute(name).and_then(|it| it.parse().ok()).unwrap_or(0.0);
    let size = text.ancestors().find_map(|node| node.attribute("font-size")?.parse().ok());
    let scale = size.unwrap_or(12.0) / f32::from(font.units_per_em());
    let letters = text.text().unwrap_or_default().chars();
    let glyphs: Vec<GlyphId> =
        letters.map(|letter| font.glyph_index(letter).unwrap_or_default()).collect();
    let step = |glyph: &GlyphId| scale * f32::from(font.glyph_hor_advance(*glyph).unwrap_or(0));
    let width: f32 = glyphs.iter().map(step).sum();
    let before = match text.attribute("text-anchor") {
        Some("middle") => width / 2.0,
        Some("end") => width,
        _ => 0.0,
    };
    let mut letter =
        GlyphPath { scale, left: number("x") - before, base: number("y"), path: String::new() };
    for glyph in glyphs {
        // A space has no outline; the fonts are those of the program, so that no glyph is damaged.
        let _ = font.outline_glyph(glyph, &mut letter);
        letter.left += step(&glyph);
    }
    letter.path
}

/// A letter that is written to the data of a path: where it stands, and the size of a unit of its font.
struct GlyphPath {
    scale: f32,
    left: f32,
    base: f32,
    path: String,
}

impl GlyphPath {
    /// Adds a command of a path with its points. Letters grow upwards, the picture downwards.
    fn add(&mut self, command: char, points: &[(f32, f32)]) {
        self.path.push(command);
        for &(x, y) in points {
            let (x, y) = (self.left + self.scale * x, self.base - self.scale * y);
            let _ = write!(self.path, "{x:.3} {y:.3} ");
        }
    }
}

impl OutlineBuilder for GlyphPath {
    fn move_to(&mut self, x: f32, y: f32) {
        self.add('M', &[(x, y)]);
    }

    fn line_to(&mut self, x: f32, y: f32) {
        self.add('L', &[(x, y)]);
    }

    fn quad_to(&mut self, x1: f32, y1: f32, x: f32, y: f32) {
        self.add('Q', &[(x1, y1), (x, y)]);
    }

    fn curve_to(&mut self, x1: f32, y1: f32, x2: f32, y2: f32, x: f32, y: f32) {
        self.add('C', &[(x1, y1), (x2, y2), (x, y)]);
    }

    fn close(&mut self) {
        self.add('Z', &[]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn letters_become_outlines_where_they_stood() {
        let svg = r##"<svg xmlns="http://www.w3.org/2000/svg" font-size="20"><text x="50" y="30" text-anchor="middle" fill="#123456">o</text></svg>"##;
        let outlined = outlined(svg).unwrap();
        assert!(
            !outlined.contains("<text") && outlined.contains(r##"fill="#123456"/>"##),
            "{outlined}"
        );
        let (_, path) = outlined.split_once("d=\"M").unwrap();
        let numbers = path.split('"').next().unwrap().split(|it: char| !".0123456789".contains(it));
        let numbers: Vec<f64> = numbers.filter_map(|number| number.parse().ok()).collect();
        let (across, up): (Vec<f64>, Vec<f64>) = numbers.chunks(2).map(|it| (it[0], it[1])).unzip();
        let extent = |of: &[f64]| {
            (of.iter().copied().fold(f64::MAX, f64::min), of.iter().copied().fold(0.0, f64::max))
        };
        // The letter is symmetric, 0.55 of the size high, and reaches a little below its base line.
        let ((left, right), (top, bottom)) = (extent(&across), extent(&up));
        assert!((f64::midpoint(left, right) - 50.0).abs() < 0.05, "{left} {right}");
        assert!((bottom - 30.0).abs() < 0.5 && (bottom - top - 11.0).abs() < 1.0, "{top} {bottom}");
    }
}
