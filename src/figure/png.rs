//! A figure as PNG: its SVG, painted with a font that comes with the program, so that it looks the same on
//! every machine.

use std::sync::Arc;

use resvg::tiny_skia::{Pixmap, Transform};
use resvg::usvg::{self, Tree, fontdb};

/// Dots of a PNG along a pixel of the vector picture, which is a 96th of an inch: 288 to the inch.
const SCALE: f32 = 3.0;

/// Upright and slanted letters.
const FONTS: [&[u8]; 2] = [
    include_bytes!("../../assets/fonts/DejaVuSans.ttf"),
    include_bytes!("../../assets/fonts/DejaVuSans-Oblique.ttf"),
];

/// What the fonts are called.
const FAMILY: &str = "DejaVu Sans";

/// Paints an SVG. Fails with one line if it is none, or too large.
pub(super) fn png(svg: &str) -> Result<Vec<u8>, String> {
    let mut fonts = fontdb::Database::new();
    for font in FONTS {
        fonts.load_font_data(font.to_vec());
    }
    // What the SVG asks for first may not be there.
    fonts.set_sans_serif_family(FAMILY);
    let options = usvg::Options {
        font_family: FAMILY.to_owned(),
        fontdb: Arc::new(fonts),
        ..usvg::Options::default()
    };
    let tree = Tree::from_str(svg, &options).map_err(|error| format!("not painted: {error}"))?;
    let size = tree.size().to_int_size().scale_by(SCALE);
    let size = size.ok_or("not painted: it has no size")?;
    let mut dots = Pixmap::new(size.width(), size.height()).ok_or("not painted: too large")?;
    resvg::render(&tree, Transform::from_scale(SCALE, SCALE), &mut dots.as_mut());
    dots.encode_png().map_err(|error| format!("not painted: {error}"))
}
