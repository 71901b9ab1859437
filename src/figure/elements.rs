//! The elements of SVG that a figure is made of.

use std::fmt::Write;

use strum::IntoStaticStr;

use super::paper::Spot;
use crate::words::printable::{signs, xml};

/// Writes a path with these commands and attributes.
pub fn path(out: &mut String, commands: &str, attributes: &str) {
    let _ = writeln!(out, "<path d=\"{commands}\" {attributes}/>");
}

/// Writes an upright rectangle: its upper left corner, and its width and height.
pub fn rectangle(out: &mut String, (x, y): Spot, (width, height): Spot, attributes: &str) {
    let _ = writeln!(
        out,
        "<rect x=\"{x:.3}\" y=\"{y:.3}\" width=\"{width}\" height=\"{height}\" {attributes}/>"
    );
}

/// Writes a circle around a spot.
pub fn circle(out: &mut String, (x, y): Spot, radius: f64, attributes: &str) {
    let _ = writeln!(out, "<circle cx=\"{x:.3}\" cy=\"{y:.3}\" r=\"{radius}\" {attributes}/>");
}

/// What a spot is of the text that is written there.
#[derive(Clone, Copy, IntoStaticStr)]
#[strum(serialize_all = "lowercase")]
pub enum Anchor {
    Start,
    Middle,
    End,
}

/// Writes a text on its base line, of which a spot is the start, the middle or the end.
pub fn text(out: &mut String, (x, y): Spot, anchor: Anchor, attributes: &str, text: &str) {
    let (anchor, text): (&str, _) = (anchor.into(), xml(&signs(text)));
    let _ = writeln!(
        out,
        "<text x=\"{x:.2}\" y=\"{y:.2}\" text-anchor=\"{anchor}\" {attributes}>{text}</text>"
    );
}
