//! The fonts that come with the program: how wide a text is, and where its letters stand, the same on every machine.

use std::sync::LazyLock;

use ttf_parser::{Face, GlyphId};

use super::elements::{Spot, TextRun};

/// Upright and slanted letters.
pub const FONTS: [&[u8]; 2] = [
    include_bytes!("../../assets/fonts/DejaVuSans.ttf"),
    include_bytes!("../../assets/fonts/DejaVuSans-Oblique.ttf"),
];

pub static FACES: LazyLock<[Face<'static>; 2]> =
    LazyLock::new(|| FONTS.map(|font| Face::parse(font, 0).expect("a font of the program")));

/// A run in its place.
#[derive(Clone, Debug)]
pub struct PlacedRun<'a> {
    pub run: &'a TextRun,
    /// Size of its letters.
    pub size: f64,
    /// Where it starts, to the right of the start of the text and down from the base line.
    pub at: Spot,
    pub letters: Vec<FontLetter>,
}

/// A letter of a font.
#[derive(Clone, Copy, Debug)]
pub struct FontLetter {
    /// Its number in its font.
    pub glyph: GlyphId,
    /// From its origin to that of the next letter, in sizes of the letters.
    pub advance: f64,
}

/// The runs of a text in their places, and how wide it is.
pub fn placed(runs: &[TextRun], size: f64) -> (Vec<PlacedRun<'_>>, f64) {
    let (mut placed, mut along) = (Vec::new(), 0.0);
    for run in runs {
        let face = &FACES[run.slant as usize];
        let letter = |char: char| {
            let glyph = face.glyph_index(char).unwrap_or_default();
            let advance = f64::from(face.glyph_hor_advance(glyph).unwrap_or(0));
            FontLetter { glyph, advance: advance / f64::from(face.units_per_em()) }
        };
        let letters: Vec<FontLetter> = run.text.chars().map(letter).collect();
        let (size, down) = run.level.set(size);
        let width = size * letters.iter().map(|letter| letter.advance).sum::<f64>();
        placed.push(PlacedRun { run, size, at: (along, down), letters });
        along += width;
    }
    (placed, along)
}

/// Width of a text.
pub fn width(runs: &[TextRun], size: f64) -> f64 {
    placed(runs, size).1
}
