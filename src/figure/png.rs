//! A page as PNG, with letters that come with the program, so that it looks the same on every machine.

use png::{BitDepth, ColorType, Encoder, PixelDimensions, Unit};
use tiny_skia::{
    FillRule, LineJoin, Mask, Paint, Path, PathBuilder, Pixmap, Stroke, StrokeDash, Transform,
};

use super::Figure;
use super::data::remarks;
use super::elements::{Color, Element, Page, PathStep, Pen, Shape, Spot, TextLine, Tint, single};
use crate::numerics::truncated;

/// Paints a page with as many dots to the inch as its sheet says. Fails with one line if these are too many.
pub fn png(page: &Page, figure: &Figure) -> Result<Vec<u8>, String> {
    /// Dots of the largest picture, which take 400 MB.
    const MOST: f64 = 1e8;
    let dots = figure.sheet.dpi();
    let scale = dots * page.unit.in_points() / 72.0;
    let [width, height] = [page.size.0, page.size.1].map(|side| (scale * side).round().max(1.0));
    let size = format!("{width} x {height} dots");
    let whole = |side: f64| u32::try_from(truncated(side)).unwrap_or(u32::MAX);
    let canvas = (width * height <= MOST).then(|| Pixmap::new(whole(width), whole(height)));
    let canvas = canvas.flatten();
    let mut canvas = canvas.ok_or_else(|| format!("not painted: {size}, of at most {MOST:e}"))?;
    canvas.fill(tiny_skia::Color::WHITE);
    let scale = Transform::from_scale(single(scale), single(scale));
    let mut painter = Painter { canvas, scale, mask: None };
    page.elements.iter().for_each(|part| painter.element(part));
    encoded(&painter.canvas, figure, dots).map_err(|why| format!("not painted: {why}"))
}

/// The dots as a file, which says how large it is meant to be and what it shows.
fn encoded(canvas: &Pixmap, figure: &Figure, dots: f64) -> Result<Vec<u8>, png::EncodingError> {
    let mut file = Vec::new();
    let mut encoder = Encoder::new(&mut file, canvas.width(), canvas.height());
    encoder.set_color(ColorType::Rgb);
    encoder.set_depth(BitDepth::Eight);
    let in_metre = u32::try_from(truncated((dots / 0.0254).round())).unwrap_or(u32::MAX);
    let (xppu, yppu, unit) = (in_metre, in_metre, Unit::Meter);
    encoder.set_pixel_dims(Some(PixelDimensions { xppu, yppu, unit }));
    let said = [
        ("Title", figure.title.clone()),
        ("Software", figure.program.to_owned()),
        ("Description", remarks(figure).join("\n")),
    ];
    for (keyword, text) in said {
        encoder.add_itxt_chunk(keyword.to_owned(), text)?;
    }
    let mut writer = encoder.write_header()?;
    // Everything stands on white, through which nothing is seen.
    let colors = canvas.data().chunks_exact(4).flat_map(|dot| dot[..3].iter().copied());
    writer.write_image_data(&colors.collect::<Vec<u8>>())?;
    writer.finish()?;
    Ok(file)
}

struct Painter {
    canvas: Pixmap,
    /// From the unit of the page to dots.
    scale: Transform,
    /// What is seen of what is painted, if not all.
    mask: Option<Mask>,
}

impl Painter {
    fn element(&mut self, element: &Element) {
        match element {
            Element::Shape(shape) => self.shape(shape, true),
            Element::Cells(cells) => cells.iter().for_each(|cell| self.shape(cell, false)),
            Element::Text(line) => self.text(line),
            Element::Clipped(corner, size, inside) => {
                let mut mask = Mask::new(self.canvas.width(), self.canvas.height());
                if let Some((mask, window)) =
                    mask.as_mut().zip(path(&Shape::rectangle(*corner, *size).steps))
                {
                    mask.fill_path(&window, FillRule::Winding, true, self.scale);
                }
                let outer = std::mem::replace(&mut self.mask, mask);
                inside.iter().for_each(|part| self.element(part));
                self.mask = outer;
            }
        }
    }

    fn shape(&mut self, Shape { steps, pen, tint }: &Shape, smooth: bool) {
        let Some(path) = path(steps) else { return };
        if let Some(Tint { color, opacity }) = tint {
            let paint = Paint { anti_alias: smooth, ..paint(*color, *opacity) };
            self.canvas.fill_path(&path, &paint, FillRule::EvenOdd, self.scale, self.mask.as_ref());
        }
        if let Some(pen) = pen {
            self.draw(&path, *pen);
        }
    }

    fn text(&mut self, line: &TextLine) {
        let Some(letters) = path(&line.outline()) else { return };
        if let Some(pen) = line.edge {
            self.draw(&letters, pen);
        }
        let paint = paint(line.color, 1.0);
        self.canvas.fill_path(&letters, &paint, FillRule::Winding, self.scale, self.mask.as_ref());
    }

    fn draw(&mut self, path: &Path, Pen { width, color, dash }: Pen) {
        let dash = StrokeDash::new(dash.iter().map(|length| single(*length)).collect(), 0.0);
        let stroke =
            Stroke { width: single(width), line_join: LineJoin::Round, dash, ..Stroke::default() };
        self.canvas.stroke_path(path, &paint(color, 1.0), &stroke, self.scale, self.mask.as_ref());
    }
}

fn paint([red, green, blue]: Color, opacity: f64) -> Paint<'static> {
    let mut paint = Paint::default();
    let mut color = tiny_skia::Color::from_rgba8(red, green, blue, 255);
    color.set_alpha(single(opacity));
    paint.set_color(color);
    paint
}

/// A path, if it leads anywhere.
fn path(steps: &[PathStep]) -> Option<Path> {
    let at = |(x, y): Spot| (single(x), single(y));
    let mut path = PathBuilder::new();
    for step in steps {
        match *step {
            PathStep::Move((x, y)) => path.move_to(single(x), single(y)),
            PathStep::Line((x, y)) => path.line_to(single(x), single(y)),
            PathStep::Curve(leave, reach, to) => {
                let [(x1, y1), (x2, y2), (x, y)] = [leave, reach, to].map(at);
                path.cubic_to(x1, y1, x2, y2, x, y);
            }
            PathStep::Close => path.close(),
        }
    }
    path.finish()
}
