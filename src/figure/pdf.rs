//! A page as PDF: letters as text in subsets of the fonts of the program. The same figure is the same file, byte for byte:
//! nothing in it depends on when and where it was written.

use krilla::color::rgb;
use krilla::geom::{Path, PathBuilder, Point, Transform};
use krilla::metadata::Metadata;
use krilla::num::NormalizedF32;
use krilla::page::PageSettings;
use krilla::paint::{Fill, FillRule, LineJoin, Stroke, StrokeDash};
use krilla::surface::Surface;
use krilla::text::{Font, GlyphId, KrillaGlyph};
use krilla::{Data, Document};
use tiny_skia_path::PathSegment;

use super::Figure;
use super::data::remarks;
use super::elements::{Element, Page, PlotPen, Shape, TextLine, Tint, single};
use super::letters::{FONTS, placed};

/// Writes a page of a figure. Fails with one line if it cannot be one of a document.
pub fn pdf(page: &Page, figure: &Figure) -> Result<Vec<u8>, String> {
    let unit = page.unit.in_points();
    let [width, height] = [page.size.0, page.size.1].map(|side| single(unit * side));
    let size = PageSettings::from_wh(width, height).ok_or("not written: the page has no size")?;
    let fonts = FONTS.map(|font| Font::new(Data::from(font), 0).expect("a font of the program"));
    let mut document = Document::new();
    document.set_metadata(about(figure));
    let mut sheet = document.start_page_with(size);
    let mut surface = sheet.surface();
    surface.push_transform(&Transform::from_scale(single(unit), single(unit)));
    draw(&mut surface, &page.elements, &fonts);
    surface.pop();
    surface.finish();
    sheet.finish();
    document.finish().map_err(|why| format!("not written: {why:?}"))
}

/// What the document says of itself. It names no author: that is whoever publishes it.
fn about(figure: &Figure) -> Metadata {
    let command = figure.provenance.iter().map(|it| it.command.clone());
    Metadata::new()
        .title(figure.title.clone())
        .description(remarks(figure).join("\n"))
        .keywords(command.collect())
        .language("en".to_owned())
        .creator(figure.program.to_owned())
}

fn draw(surface: &mut Surface, elements: &[Element], fonts: &[Font; 2]) {
    for element in elements {
        match element {
            Element::Shape(shape) => outline(surface, shape),
            Element::Text(line) => text(surface, line, fonts),
            Element::Clipped(corner, size, inside) => {
                let Some(window) = path(&Shape::rectangle(*corner, *size)) else { continue };
                surface.push_clip_path(&window, &FillRule::NonZero);
                draw(surface, inside, fonts);
                surface.pop();
            }
        }
    }
}

fn outline(surface: &mut Surface, shape: &Shape) {
    let Some(path) = path(shape).filter(|_| shape.pen.is_some() || shape.tint.is_some()) else {
        return;
    };
    surface.set_fill(shape.tint.map(filled));
    surface.set_stroke(shape.pen.map(stroked));
    surface.draw_path(&path);
}

/// The line around a text is no text, so that whoever searches finds it once.
fn text(surface: &mut Surface, line: &TextLine, fonts: &[Font; 2]) {
    outline(surface, &line.shapes()[0]);
    let [sx, ky, kx, sy, tx, ty] = line.turned();
    surface.push_transform(&Transform::from_row(sx, ky, kx, sy, tx, ty));
    surface.set_fill(Some(filled(Tint { color: line.color, opacity: 1.0 })));
    surface.set_stroke(None);
    for run in placed(&line.runs, line.size, line.anchor).0 {
        let places = run.text.char_indices().map(|(at, char)| at..at + char.len_utf8());
        let letters = places.zip(&run.letters).map(|(place, (glyph, advance))| {
            let (glyph, advance) = (GlyphId::new(glyph.0.into()), single(*advance));
            KrillaGlyph::new(glyph, advance, 0.0, 0.0, 0.0, place, None)
        });
        let letters: Vec<KrillaGlyph> = letters.collect();
        let start = Point::from_xy(single(run.at.0), single(run.at.1));
        let font = fonts[run.font].clone();
        surface.draw_glyphs(start, &letters, font, run.text, single(run.size), false);
    }
    surface.pop();
}

fn path(shape: &Shape) -> Option<Path> {
    let mut path = PathBuilder::new();
    for segment in shape.path.as_ref()?.segments() {
        match segment {
            PathSegment::MoveTo(to) => path.move_to(to.x, to.y),
            PathSegment::LineTo(to) => path.line_to(to.x, to.y),
            PathSegment::QuadTo(by, to) => path.quad_to(by.x, by.y, to.x, to.y),
            PathSegment::CubicTo(one, two, to) => {
                path.cubic_to(one.x, one.y, two.x, two.y, to.x, to.y);
            }
            PathSegment::Close => path.close(),
        }
    }
    path.finish()
}

fn filled(Tint { color: [red, green, blue], opacity }: Tint) -> Fill {
    let opacity = NormalizedF32::new(single(opacity)).unwrap_or(NormalizedF32::ONE);
    Fill { paint: rgb::Color::new(red, green, blue).into(), opacity, rule: FillRule::EvenOdd }
}

fn stroked(PlotPen { width, color, dash }: PlotPen) -> Stroke {
    let array: Vec<f32> = dash.iter().map(|length| single(*length)).collect();
    let dash = (!array.is_empty()).then_some(StrokeDash { array, offset: 0.0 });
    let paint = filled(Tint { color, opacity: 1.0 }).paint;
    Stroke { paint, width: single(width), line_join: LineJoin::Round, dash, ..Stroke::default() }
}
