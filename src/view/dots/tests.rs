//! Dots, cell by cell.

use proptest::prelude::*;
use ratatui::buffer::Buffer;
use ratatui::style::Color;

use super::*;
use crate::numerics::elementary::hypot;
use crate::session::settings;
use crate::view::Look;

const SOLID: DotPen = DotPen { role: Role::Trajectory, dash: Dash::Solid };

fn painted(dots: &Dots) -> Vec<String> {
    let look = Look::new(settings::DisplaySettings {
        glyphs: dots.glyphs,
        ..settings::DisplaySettings::default()
    });
    let mut buffer = Buffer::empty(dots.area);
    dots.paint(&mut Surface { look: &look, buffer: &mut buffer });
    let rows = buffer.content.chunks(usize::from(dots.area.width.max(1)));
    rows.map(|row| row.iter().map(ratatui::buffer::Cell::symbol).collect()).collect()
}

#[test]
fn a_diagonal_is_one_dot_wide() {
    let mut dots = Dots::new(Rect::new(0, 0, 2, 1), Glyphs::Braille);
    dots.stroke([(0.0, 0.0), (3.9, 3.9)], SOLID);
    assert_eq!(painted(&dots), ["⠑⢄"]);
}

#[test]
fn corners_of_a_curve_in_small_steps_are_cut() {
    let mut dots = Dots::new(Rect::new(0, 0, 2, 1), Glyphs::Braille);
    dots.stroke([(0.5, 0.5), (1.5, 0.5), (1.5, 1.5), (2.5, 1.5), (2.5, 2.5), (3.5, 3.5)], SOLID);
    assert_eq!(painted(&dots), ["⠑⢄"]);
}

#[test]
fn dashes_differ_in_their_dots() {
    let drawn = |dash| {
        let mut dots = Dots::new(Rect::new(0, 0, 8, 1), Glyphs::Braille);
        dots.stroke([(0.0, 0.0), (15.9, 0.0)], DotPen { role: Role::Stable, dash });
        painted(&dots).remove(0)
    };
    assert_eq!(drawn(Dash::Solid), "⠉⠉⠉⠉⠉⠉⠉⠉");
    assert_eq!(drawn(Dash::Dashed), "⠉⠉ ⠉⠉ ⠉⠉");
    assert_eq!(drawn(Dash::DashDot), "⠉⠁⠁⠉⠁⠁⠉⠁");
    assert_eq!(drawn(Dash::Dotted), "⠁⠁⠁⠁⠁⠁⠁⠁");
    assert_eq!(drawn(Dash::Sparse), "⠁ ⠁ ⠁ ⠁ ");
}

#[test]
fn each_set_of_glyphs_draws_the_same_cross() {
    let drawn = |glyphs| {
        let mut dots = Dots::new(Rect::new(0, 0, 3, 3), glyphs);
        let (width, height) = dots.size();
        dots.stroke([(0.0, height / 2.0), (width, height / 2.0)], SOLID);
        dots.stroke([(width / 2.0, 0.0), (width / 2.0, height)], SOLID);
        painted(&dots)
    };
    assert_eq!(drawn(Glyphs::Ascii), [" * ", "***", " * "]);
    assert_eq!(drawn(Glyphs::Block), [" ▐ ", "▄▟▄", " ▐ "]);
    assert_eq!(drawn(Glyphs::Braille), [" ⢸ ", "⠤⢼⠤", " ⢸ "]);
}

#[test]
fn strokes_hide_texture_and_symbols_hide_strokes() {
    let mut dots = Dots::new(Rect::new(0, 0, 3, 1), Glyphs::Ascii);
    (0..3).for_each(|column| dots.texture((column, 0), '.', Role::Basin));
    dots.symbol((2, 0), 'F', Role::Special);
    dots.stroke([(1.0, 0.0), (2.9, 0.0)], SOLID);
    dots.texture((1, 0), '.', Role::Basin);
    assert_eq!(painted(&dots), [".*F"]);
    let covered = [0, 1, 2, 3].map(|column| dots.covering((column, 0)));
    let expected = [Covering::Texture, Covering::Curve, Covering::Symbol, Covering::Outside];
    assert_eq!(covered, expected);
}

#[test]
fn a_line_on_the_lower_edge_is_seen_and_a_thick_one_is_thick() {
    let drawn = |y, dash| {
        let mut dots = Dots::new(Rect::new(0, 0, 3, 1), Glyphs::Braille);
        dots.stroke([(0.0, y), (5.9, y)], DotPen { role: Role::Stable, dash });
        painted(&dots).remove(0)
    };
    assert_eq!(drawn(4.0, Dash::Solid), "⣀⣀⣀");
    assert_eq!([4.0, 3.9, 2.0, 0.0].map(|y| drawn(y, Dash::Thick)), ["⣤⣤⣤", "⣤⣤⣤", "⠶⠶⠶", "⠛⠛⠛"]);
    assert_eq!(drawn(4.6, Dash::Thick), "   ");
}

#[test]
fn curves_hide_guides_even_in_the_gaps_of_their_dashes() {
    let mut dots = Dots::new(Rect::new(0, 0, 6, 1), Glyphs::Ascii);
    let line = [(0.0, 0.0), (4.9, 0.0)];
    dots.stroke([(0.0, 0.0), (5.9, 0.0)], DotPen { role: Role::Harmonic, dash: Dash::Dotted });
    assert_eq!(painted(&dots), ["~ ~ ~ "]);
    dots.stroke(line, DotPen { role: Role::Unstable, dash: Dash::Dashed });
    dots.stroke(line, DotPen { role: Role::Axis, dash: Dash::Sparse });
    assert_eq!(painted(&dots), ["oo oo "]);
}

#[test]
fn a_later_stroke_takes_the_colour_of_a_shared_cell() {
    let look = Look::new(settings::DisplaySettings::default());
    let mut dots = Dots::new(Rect::new(0, 0, 1, 1), Glyphs::Braille);
    dots.stroke([(0.0, 0.0)], SOLID);
    dots.stroke([(1.0, 3.0)], DotPen { role: Role::Stable, dash: Dash::Solid });
    let mut buffer = Buffer::empty(dots.area);
    dots.paint(&mut Surface { look: &look, buffer: &mut buffer });
    assert_eq!(
        (buffer[(0, 0)].symbol(), buffer[(0, 0)].fg),
        ("⢁", look.style(Role::Stable).fg.unwrap())
    );
}

#[test]
fn a_curve_and_an_area_in_one_cell_have_the_colour_of_the_curve() {
    let look = Look::new(settings::DisplaySettings::default());
    let area = DotPen { role: Role::Sticking, dash: Dash::Thick };
    let curve = DotPen { role: Role::Unstable, dash: Dash::Dashed };
    for pens in [[area, curve], [curve, area]] {
        let mut dots = Dots::new(Rect::new(0, 0, 6, 1), Glyphs::Braille);
        for pen in pens {
            let y = if pen.dash == Dash::Thick { 2.5 } else { 1.5 };
            dots.stroke([(0.0, y), (11.9, y)], pen);
        }
        let mut buffer = Buffer::empty(dots.area);
        dots.paint(&mut Surface { look: &look, buffer: &mut buffer });
        // Dashes of four dots and gaps of two: the third and the sixth cell have the area alone.
        let colours: Vec<Color> = buffer.content.iter().map(|cell| cell.fg).collect();
        let [red, yellow] = [curve, area].map(|pen| look.style(pen.role).fg.unwrap());
        assert_eq!(colours, [red, red, yellow, red, red, yellow], "{pens:?}");
    }
}

#[test]
fn a_line_from_far_out_enters_where_it_should() {
    let mut dots = Dots::new(Rect::new(0, 0, 4, 4), Glyphs::Ascii);
    dots.stroke([(-1e300, -1e300), (1e300, 1e300)], SOLID);
    assert_eq!(painted(&dots)[0], "*   ");
    let mut dots = Dots::new(Rect::new(0, 0, 3, 1), Glyphs::Ascii);
    dots.stroke([(-1e9, 0.5), (1.5, 0.5), (1.5, f64::NAN), (2.5, 0.5)], SOLID);
    assert_eq!(painted(&dots), ["***"]);
}

proptest! {
    #[test]
    fn whatever_is_drawn_nothing_breaks(
        width in 0_u16..40, height in 0_u16..20,
        points in proptest::collection::vec((any::<f64>(), any::<f64>()), 0..20),
        near in proptest::collection::vec((-50.0..150.0, -50.0..150.0), 0..20),
    ) {
        for glyphs in [Glyphs::Braille, Glyphs::Octant, Glyphs::Block, Glyphs::Ascii] {
            let mut dots = Dots::new(Rect::new(3, 5, width, height), glyphs);
            for dash in [Dash::Thick, Dash::Dashed, Dash::DashDot, Dash::Dotted, Dash::Sparse] {
                dots.stroke(points.iter().chain(&near).copied(), DotPen { role: Role::Stable, dash });
            }
            prop_assert!(near.iter().all(|point| dots.cell_at(*point).is_none_or(|(column, row)| column < width.into() && row < height.into())));
            painted(&dots);
        }
    }

    #[test]
    fn a_thick_line_covers_the_dots_of_a_thin_one_and_stays_in_its_cells(y in 0.0..=40.0_f64) {
        for glyphs in [Glyphs::Braille, Glyphs::Octant, Glyphs::Block] {
            let bits = |dash| {
                let mut dots = Dots::new(Rect::new(0, 0, 1, 10), glyphs);
                let (width, height) = dots.size();
                let y = y / 40.0 * height;
                dots.stroke([(0.0, y), (width, y)], DotPen { role: Role::Stable, dash });
                dots.cells.iter().map(|cell| cell.dots).collect::<Vec<u8>>()
            };
            let (thin, thick) = (bits(Dash::Solid), bits(Dash::Thick));
            prop_assert!(thin.iter().zip(&thick).all(|(thin, thick)| thin & thick == *thin), "{:?} {:?}", thin, thick);
            let inked = |bits: &[u8]| bits.iter().filter(|bits| **bits != 0).count();
            prop_assert_eq!((inked(&thin), inked(&thick)), (1, 1), "{:?} {:?}", thin, thick);
        }
    }

    #[test]
    fn a_clipped_line_is_the_visible_part_of_the_whole(
        start in (-200.0..200.0, -200.0..200.0), end in (-200.0..200.0, -200.0..200.0),
    ) {
        let size = (40.0, 30.0);
        let on = |(x, y): DotPoint| (0.0..=size.0).contains(&x) && (0.0..=size.1).contains(&y);
        let samples = (0..=1000).map(|index| f64::from(index) / 1000.0)
            .map(|t| (start.0 + (end.0 - start.0) * t, start.1 + (end.1 - start.1) * t));
        let visible = samples.clone().any(|(x, y)| {
            (0.1..39.9).contains(&x) && (0.1..29.9).contains(&y)
        });
        let distance = |a: DotPoint, b: DotPoint| hypot(a.0 - b.0, a.1 - b.1);
        let between = |a: DotPoint, point: DotPoint, b: DotPoint| {
            distance(a, point) + distance(point, b) - distance(a, b) < 1e-3
        };
        match clip(start, end, size) {
            None => prop_assert!(!visible),
            Some((from, to, whole)) => {
                prop_assert!(on(from) && on(to));
                prop_assert!(between(start, from, end) && between(start, to, end));
                prop_assert!(samples.clone().filter(|point| on(*point)).all(|point| between(from, point, to)));
                prop_assert_eq!(whole, distance(to, end) < 1e-5);
            }
        }
    }
}
