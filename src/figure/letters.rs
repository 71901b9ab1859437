//! The fonts that come with the program: how wide a text is, and where its letters stand, the same on every machine.

use std::sync::LazyLock;

use ttf_parser::{Face, GlyphId};

use super::elements::{Anchor, Spot};
use super::symbols::{LetterStyle, TextRun};

/// Upright and slanted letters.
pub const FONTS: [&[u8]; 2] = [
    include_bytes!("../../assets/fonts/DejaVuSans.ttf"),
    include_bytes!("../../assets/fonts/DejaVuSans-Oblique.ttf"),
];

pub static FACES: LazyLock<[Face<'static>; 2]> =
    LazyLock::new(|| FONTS.map(|font| Face::parse(font, 0).expect("a font of the program")));

/// A run in its place.
#[derive(Clone, Debug)]
#[cfg_attr(not(feature = "print"), expect(dead_code, reason = "only widths are measured"))]
pub struct PlacedRun<'a> {
    pub text: &'a str,
    /// Its font: the place in [`FONTS`].
    pub font: usize,
    /// Size of its letters.
    pub size: f64,
    /// Where it starts, to the right of the spot of the text and down.
    pub at: Spot,
    /// Its letters by their numbers in the font, and how far the next one stands from each, in sizes of the letters.
    pub letters: Vec<(GlyphId, f64)>,
}

/// The runs of a text in their places, and how wide it is.
pub fn placed(runs: &[TextRun], size: f64, anchor: Anchor) -> (Vec<PlacedRun<'_>>, f64) {
    let (mut placed, mut width) = (Vec::new(), 0.0);
    for TextRun { text, setting } in runs {
        let font = usize::from(*setting == LetterStyle::Italic);
        let face = &FACES[font];
        let letter = |char: char| {
            let glyph = face.glyph_index(char).unwrap_or_default();
            let advance = f64::from(face.glyph_hor_advance(glyph).unwrap_or(0));
            (glyph, advance / f64::from(face.units_per_em()))
        };
        let letters: Vec<_> = text.chars().map(letter).collect();
        let (size, down) = setting.of(size);
        let advance = size * letters.iter().map(|(_, advance)| advance).sum::<f64>();
        placed.push(PlacedRun { text, font, size, at: (width, down), letters });
        width += advance;
    }
    let before = 0.5 * width * f64::from(anchor as u8);
    for run in &mut placed {
        run.at.0 -= before;
    }
    (placed, width)
}

/// Width of a text.
pub fn width(runs: &[TextRun], size: f64) -> f64 {
    placed(runs, size, Anchor::Start).1
}
