//! Letters as paths, for what paints them without knowing fonts, and for the line around them.

use tiny_skia_path::{Path, PathBuilder, Transform};
use ttf_parser::OutlineBuilder;

use super::elements::{Shape, TextLine, single};
use super::letters::{FACES, placed};

impl TextLine {
    /// From places to the right of its spot and down to places on the page: the rows of a matrix.
    pub fn turned(&self) -> [f32; 6] {
        let (x, y) = (single(self.at.0), single(self.at.1));
        if self.upward {
            [0.0, -1.0, 1.0, 0.0, x, y]
        } else {
            [1.0, 0.0, 0.0, 1.0, x, y]
        }
    }

    /// The line around its letters, and the letters.
    pub fn shapes(&self) -> [Shape; 2] {
        let letters = Shape { path: self.outline(), pen: None, tint: None };
        [Shape { pen: self.edge, ..letters.clone() }, letters.solid(self.color)]
    }

    fn outline(&self) -> Option<Path> {
        let [sx, ky, kx, sy, tx, ty] = self.turned();
        let turned = Transform::from_row(sx, ky, kx, sy, tx, ty);
        let mut outline = PathBuilder::new();
        for run in placed(&self.runs, self.size, self.anchor).0 {
            let face = &FACES[run.font];
            let scale = single(run.size / f64::from(face.units_per_em()));
            let (mut along, down) = run.at;
            for (glyph, advance) in run.letters {
                let mut letter = GlyphPath(PathBuilder::new());
                // A space has no outline; the fonts are those of the program, so that no letter is damaged.
                let _ = face.outline_glyph(glyph, &mut letter);
                let place =
                    Transform::from_row(scale, 0.0, 0.0, -scale, single(along), single(down));
                let path =
                    letter.0.finish().and_then(|path| path.transform(place.post_concat(turned)));
                if let Some(path) = path {
                    outline.push_path(&path);
                }
                along += run.size * advance;
            }
        }
        outline.finish()
    }
}

/// The outline of a letter, in units of its font.
struct GlyphPath(PathBuilder);

impl OutlineBuilder for GlyphPath {
    fn move_to(&mut self, x: f32, y: f32) {
        self.0.move_to(x, y);
    }

    fn line_to(&mut self, x: f32, y: f32) {
        self.0.line_to(x, y);
    }

    fn quad_to(&mut self, x1: f32, y1: f32, x: f32, y: f32) {
        self.0.quad_to(x1, y1, x, y);
    }

    fn curve_to(&mut self, x1: f32, y1: f32, x2: f32, y2: f32, x: f32, y: f32) {
        self.0.cubic_to(x1, y1, x2, y2, x, y);
    }

    fn close(&mut self) {
        self.0.close();
    }
}
