//! Parts of the world filled with textures, and directions on a lattice.

use ratatui::layout::Rect;

use super::Canvas;
use crate::numerics::elementary::atan2;
use crate::picture::Role;
use crate::scene::Point;

impl Canvas<'_> {
    /// Shades the cells that `curve` does not separate from the origin, or those that it does.
    ///
    /// The curve may be closed, or open with ends outside the window.
    pub fn shade(&mut self, curve: &[Point], with_origin: bool, role: Role) {
        let climbed = crossings(curve, |point| point.x, |point| point.y);
        let between = |a: f64, b: f64, value: f64| a.min(b) < value && value < a.max(b);
        for row in 0..self.inner.height {
            let y = self.world(0, row).y;
            let walls = crossings(curve, |point| point.y - y, |point| point.x);
            let climbs = climbed.iter().filter(|wall| between(0.0, y, **wall)).count();
            self.shade_row(row, role, |Point { x, .. }| {
                let walks = walls.iter().filter(|wall| between(0.0, x, **wall)).count();
                ((climbs + walks) % 2 == 0) == with_origin
            });
        }
    }

    /// Shades the cells whose middle lies in a part of the world.
    pub fn shade_where(&mut self, role: Role, inside: impl Fn(Point) -> bool) {
        (0..self.inner.height).for_each(|row| self.shade_row(row, role, &inside));
    }

    fn shade_row(&mut self, row: u16, role: Role, inside: impl Fn(Point) -> bool) {
        for column in 0..self.inner.width {
            if inside(self.world(column, row)) {
                // The blanks belong to the texture: to write them is shorter than to skip them.
                let shade = self.look.symbols().shade;
                let symbol = if (column + row).is_multiple_of(2) { shade } else { ' ' };
                self.dots.texture(column, row, symbol, role);
            }
        }
    }

    /// Puts a texture on the cells of parts of the world; blanks leave what is there.
    pub fn texture_where(&mut self, texture: impl Fn(Point) -> Option<(char, Role)>) {
        let Rect { width, height, .. } = self.inner;
        for row in 0..height {
            // Every other cell of every other line, so that borders and names can be read.
            for column in (0..width).filter(|column| (column + 2 * row) % 4 == 0) {
                if let Some((symbol, role)) = texture(self.world(column, row)) {
                    self.dots.texture(column, row, symbol, role);
                }
            }
        }
    }

    /// Puts arrows on a sparse lattice of cells, in the direction that `flow` gives there.
    pub fn arrows(&mut self, role: Role, flow: impl Fn(Point) -> Point) {
        let arrows = self.look.symbols().arrows;
        let Rect { width, height, .. } = self.inner;
        let (dots_across, dots_down) = self.dots.size();
        let (across, down) =
            (dots_across / self.window.x.width(), dots_down / self.window.y.width());
        for row in (1..height).step_by(3) {
            for column in (3..width).step_by(6) {
                let direction = flow(self.world(column, row));
                let angle = atan2(direction.y * down, direction.x * across);
                if angle.is_finite() {
                    let eighth = (angle / std::f64::consts::FRAC_PI_4).round().rem_euclid(8.0);
                    self.dots.texture(column, row, arrows[eighth as usize % 8], role);
                }
            }
        }
    }
}

/// Where a polyline crosses the line `height = 0`, measured by `place`.
fn crossings(
    curve: &[Point],
    height: impl Fn(Point) -> f64,
    place: impl Fn(Point) -> f64,
) -> Vec<f64> {
    let crossing = |pair: &[Point]| {
        let (before, after) = (height(pair[0]), height(pair[1]));
        ((before < 0.0) != (after < 0.0)).then(|| {
            let along = before / (before - after);
            place(pair[0]) + (place(pair[1]) - place(pair[0])) * along
        })
    };
    curve.windows(2).filter_map(crossing).collect()
}
