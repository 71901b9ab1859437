//! Letters as paths, for what paints them without knowing fonts, and for the white around them.

use ttf_parser::OutlineBuilder;

use super::elements::{PathStep, Spot, TextLine};
use super::letters::{FACES, PlacedRun, placed};

impl TextLine {
    /// The outlines of its letters on the page.
    pub fn outline(&self) -> Vec<PathStep> {
        let (runs, width) = placed(&self.runs, self.size);
        let (before, (x, y)) = (self.anchor.before(width), self.at);
        let on_page = |along: f64, down: f64| match self.upward {
            true => (x + down, y - along),
            false => (x + along, y + down),
        };
        let mut steps = Vec::new();
        for PlacedRun { run, size, at: (start, down), letters } in runs {
            let face = &FACES[run.slant as usize];
            let (scale, mut origin) = (size / f64::from(face.units_per_em()), start - before);
            for letter in letters {
                let place = |right: f32, up: f32| {
                    on_page(origin + scale * f64::from(right), down - scale * f64::from(up))
                };
                // A space has no outline; the fonts are those of the program, so that no letter is damaged.
                let _ =
                    face.outline_glyph(letter.glyph, &mut GlyphPath { place, steps: &mut steps });
                origin += size * letter.advance;
            }
        }
        steps
    }
}

/// Takes the outline of a letter; `place` says where a point of its font stands on the page.
struct GlyphPath<'a, P: Fn(f32, f32) -> Spot> {
    place: P,
    steps: &'a mut Vec<PathStep>,
}

impl<P: Fn(f32, f32) -> Spot> OutlineBuilder for GlyphPath<'_, P> {
    fn move_to(&mut self, x: f32, y: f32) {
        self.steps.push(PathStep::Move((self.place)(x, y)));
    }

    fn line_to(&mut self, x: f32, y: f32) {
        self.steps.push(PathStep::Line((self.place)(x, y)));
    }

    fn quad_to(&mut self, x1: f32, y1: f32, x: f32, y: f32) {
        let (control, end) = ((self.place)(x1, y1), (self.place)(x, y));
        let from = match self.steps.last() {
            Some(PathStep::Move(at) | PathStep::Line(at) | PathStep::Curve(_, _, at)) => *at,
            Some(PathStep::Close) | None => control,
        };
        // A curve of second degree as one of third.
        let toward = |(x, y): Spot| (x + (control.0 - x) / 1.5, y + (control.1 - y) / 1.5);
        self.steps.push(PathStep::Curve(toward(from), toward(end), end));
    }

    fn curve_to(&mut self, x1: f32, y1: f32, x2: f32, y2: f32, x: f32, y: f32) {
        let place = &self.place;
        self.steps.push(PathStep::Curve(place(x1, y1), place(x2, y2), place(x, y)));
    }

    fn close(&mut self) {
        self.steps.push(PathStep::Close);
    }
}
