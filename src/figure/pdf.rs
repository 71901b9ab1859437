//! A page as PDF: letters as text in subsets of the fonts of the program, lengths in points. The same figure is the same
//! file, byte for byte: nothing in it depends on when and where it was written.

use krilla::color::rgb;
use krilla::geom::{Path, PathBuilder, Point, Transform};
use krilla::metadata::Metadata;
use krilla::num::NormalizedF32;
use krilla::page::PageSettings;
use krilla::paint::{Fill, FillRule, LineJoin, Paint, Stroke, StrokeDash};
use krilla::surface::Surface;
use krilla::text::{Font, GlyphId, KrillaGlyph};
use krilla::{Data, Document};

use super::Figure;
use super::data::remarks;
use super::elements::{Color, Element, Page, PathStep, Pen, Shape, Spot, TextLine, Tint, single};
use super::letters::{FONTS, PlacedRun, placed};
use crate::numerics::truncated;

/// Writes a page of a figure. Fails with one line if it cannot be one of a document.
pub fn pdf(page: &Page, figure: &Figure) -> Result<Vec<u8>, String> {
    let failed = |why: &str| format!("not written: {why}");
    let unit = page.unit.in_points();
    let (width, height) = (single(unit * page.size.0), single(unit * page.size.1));
    let size = PageSettings::from_wh(width, height).ok_or_else(|| failed("it has no size"))?;
    let fonts = FONTS.map(|font| Font::new(Data::from(font), 0));
    let [Some(upright), Some(italic)] = fonts else { return Err(failed("its fonts are damaged")) };
    let mut document = Document::new();
    document.set_metadata(about(figure));
    let mut sheet = document.start_page_with(size);
    let mut printer = Printer { surface: sheet.surface(), unit, fonts: [upright, italic] };
    page.elements.iter().for_each(|part| printer.element(part));
    drop(printer);
    sheet.finish();
    document.finish().map_err(|why| failed(&format!("{why:?}")))
}

/// What the document says of itself. It names no author: that is whoever publishes it.
fn about(figure: &Figure) -> Metadata {
    let about = Metadata::new()
        .title(figure.title.clone())
        .description(remarks(figure).join("\n"))
        .language("en".to_owned())
        .creator(figure.program.to_owned());
    match &figure.provenance {
        Some(provenance) => about.keywords(vec![provenance.command.clone()]),
        None => about,
    }
}

struct Printer<'a> {
    surface: Surface<'a>,
    /// The unit of the page in points.
    unit: f64,
    /// Upright and slanted letters.
    fonts: [Font; 2],
}

impl Printer<'_> {
    fn element(&mut self, element: &Element) {
        match element {
            Element::Shape(shape) => self.shape(shape),
            Element::Cells(cells) => cells.iter().for_each(|cell| self.shape(&overlapping(cell))),
            Element::Text(line) => self.text(line),
            Element::Clipped(corner, size, inside) => {
                let Some(window) = self.path(&Shape::rectangle(*corner, *size).steps) else {
                    return;
                };
                self.surface.push_clip_path(&window, &FillRule::NonZero);
                inside.iter().for_each(|part| self.element(part));
                self.surface.pop();
            }
        }
    }

    fn shape(&mut self, Shape { steps, pen, tint }: &Shape) {
        let Some(path) = self.path(steps) else { return };
        let fill = tint.map(|tint| Fill { rule: FillRule::EvenOdd, ..filled(tint) });
        self.paint(&path, fill, pen.map(|pen| self.stroked(pen)));
    }

    fn paint(&mut self, path: &Path, fill: Option<Fill>, stroke: Option<Stroke>) {
        self.surface.set_fill(fill);
        self.surface.set_stroke(stroke);
        self.surface.draw_path(path);
    }

    /// The edge of a text is no text, so that whoever searches finds it once.
    fn text(&mut self, line: &TextLine) {
        if let Some((pen, letters)) = line.edge.zip(self.path(&line.outline())) {
            let stroke = self.stroked(pen);
            self.paint(&letters, None, Some(stroke));
        }
        let (x, y) = self.at(line.at);
        let turned = if line.upward {
            Transform::from_row(0.0, -1.0, 1.0, 0.0, x, y)
        } else {
            Transform::from_translate(x, y)
        };
        self.surface.push_transform(&turned);
        self.surface.set_fill(Some(filled(Tint { color: line.color, opacity: 1.0 })));
        self.surface.set_stroke(None);
        let (runs, width) = placed(&line.runs, line.size);
        for run in runs {
            self.run(&run, line.anchor.before(width));
        }
        self.surface.pop();
    }

    fn run(
        &mut self,
        PlacedRun { run, size, at: (along, down), letters }: &PlacedRun,
        before: f64,
    ) {
        let glyphs = run.text.char_indices().zip(letters).map(|((at, char), letter)| {
            let (glyph, place) = (GlyphId::new(letter.glyph.0.into()), at..at + char.len_utf8());
            KrillaGlyph::new(glyph, single(letter.advance), 0.0, 0.0, 0.0, place, None)
        });
        let (x, y) = self.at((along - before, *down));
        let font = self.fonts[run.slant as usize].clone();
        let glyphs: Vec<KrillaGlyph> = glyphs.collect();
        let size = single(self.unit * size);
        self.surface.draw_glyphs(Point::from_xy(x, y), &glyphs, font, &run.text, size, false);
    }

    fn at(&self, (x, y): Spot) -> (f32, f32) {
        (single(self.unit * x), single(self.unit * y))
    }

    /// A path, if it leads anywhere.
    fn path(&self, steps: &[PathStep]) -> Option<Path> {
        let mut path = PathBuilder::new();
        for step in steps {
            match *step {
                PathStep::Move(to) => {
                    let (x, y) = self.at(to);
                    path.move_to(x, y);
                }
                PathStep::Line(to) => {
                    let (x, y) = self.at(to);
                    path.line_to(x, y);
                }
                PathStep::Curve(leave, reach, to) => {
                    let [(x1, y1), (x2, y2), (x, y)] = [leave, reach, to].map(|at| self.at(at));
                    path.cubic_to(x1, y1, x2, y2, x, y);
                }
                PathStep::Close => path.close(),
            }
        }
        path.finish()
    }

    fn stroked(&self, Pen { width, color, dash }: Pen) -> Stroke {
        let length = |length: &f64| single(self.unit * length);
        let dash = StrokeDash { array: dash.iter().map(length).collect(), offset: 0.0 };
        Stroke {
            paint: paint(color),
            width: length(&width),
            line_join: LineJoin::Round,
            dash: (!dash.array.is_empty()).then_some(dash),
            ..Stroke::default()
        }
    }
}

/// A cell that reaches a little into its neighbours: what shows a document smooths all edges.
fn overlapping(cell: &Shape) -> Shape {
    let Some(Tint { color, opacity }) = cell.tint else { return cell.clone() };
    // On white; a colour through which one sees would be darker where cells overlap.
    let on_white = |part: u8| (255.0 - opacity * (255.0 - f64::from(part))).round();
    let color = color.map(|part| u8::try_from(truncated(on_white(part))).unwrap_or(u8::MAX));
    cell.clone().solid(color).drawn(Pen::solid(0.25, color))
}

fn filled(Tint { color, opacity }: Tint) -> Fill {
    let opacity = NormalizedF32::new(single(opacity)).unwrap_or(NormalizedF32::ONE);
    Fill { paint: paint(color), opacity, ..Fill::default() }
}

fn paint([red, green, blue]: Color) -> Paint {
    rgb::Color::new(red, green, blue).into()
}
