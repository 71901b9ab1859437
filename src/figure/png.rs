//! A page as PNG, with letters that come with the program, so that it looks the same on every machine.

use png::{ColorType, Encoder, EncodingError, PixelDimensions, Unit};
use tiny_skia::{FillRule, LineJoin, Mask, Paint, Pixmap, Stroke, StrokeDash, Transform};

use super::Figure;
use super::data::remarks;
use super::elements::{Element, Page, PlotPen, Shape, Tint, single};
use crate::numerics::truncated;

/// Paints a page with as many dots to the inch as its sheet says. Fails with one line if these are too many.
pub fn png(page: &Page, figure: &Figure) -> Result<Vec<u8>, String> {
    /// Dots of the largest picture, which take 400 MB.
    const MOST: f64 = 1e8;
    let scale = figure.sheet.dpi() * page.unit.in_points() / 72.0;
    let [width, height] = [page.size.0, page.size.1].map(|side| (scale * side).round().max(1.0));
    let canvas = (width * height <= MOST).then(|| Pixmap::new(whole(width), whole(height)));
    let too_large = || format!("not painted: {width} x {height} dots, of at most {MOST:e}");
    let mut canvas = canvas.flatten().ok_or_else(too_large)?;
    canvas.fill(tiny_skia::Color::WHITE);
    let scale = Transform::from_scale(single(scale), single(scale));
    let mut painter = Painter { canvas, scale, mask: None };
    painter.paint(&page.elements);
    encoded(&painter.canvas, figure).map_err(|why| format!("not painted: {why}"))
}

fn whole(number: f64) -> u32 {
    u32::try_from(truncated(number.round())).unwrap_or(u32::MAX)
}

/// The dots as a file, which says how large it is meant to be and what it shows.
fn encoded(canvas: &Pixmap, figure: &Figure) -> Result<Vec<u8>, EncodingError> {
    let mut file = Vec::new();
    let mut encoder = Encoder::new(&mut file, canvas.width(), canvas.height());
    encoder.set_color(ColorType::Rgb);
    let in_metre = whole(figure.sheet.dpi() / 0.0254);
    let dimensions = PixelDimensions { xppu: in_metre, yppu: in_metre, unit: Unit::Meter };
    encoder.set_pixel_dims(Some(dimensions));
    encoder.add_itxt_chunk("Title".into(), figure.title.clone())?;
    encoder.add_itxt_chunk("Software".into(), figure.program.into())?;
    encoder.add_itxt_chunk("Description".into(), remarks(figure).join("\n"))?;
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
    fn paint(&mut self, elements: &[Element]) {
        for element in elements {
            match element {
                Element::Shape(shape) => self.shape(shape, FillRule::EvenOdd),
                Element::Text(line) => {
                    let [edge, letters] = line.shapes();
                    self.shape(&edge, FillRule::Winding);
                    self.shape(&letters, FillRule::Winding);
                }
                Element::Clipped(corner, size, inside) => {
                    let mut mask = Mask::new(self.canvas.width(), self.canvas.height());
                    let window = Shape::rectangle(*corner, *size).path;
                    if let Some((mask, window)) = mask.as_mut().zip(window) {
                        mask.fill_path(&window, FillRule::Winding, true, self.scale);
                    }
                    let outer = std::mem::replace(&mut self.mask, mask);
                    self.paint(inside);
                    self.mask = outer;
                }
            }
        }
    }

    fn shape(&mut self, Shape { path, pen, tint }: &Shape, rule: FillRule) {
        let (Some(path), mask) = (path, self.mask.as_ref()) else { return };
        if let Some(tint) = tint {
            self.canvas.fill_path(path, &paint(*tint), rule, self.scale, mask);
        }
        if let Some(PlotPen { width, color, dash }) = *pen {
            let dash = StrokeDash::new(dash.iter().map(|length| single(*length)).collect(), 0.0);
            let (width, line_join) = (single(width), LineJoin::Round);
            let stroke = Stroke { width, line_join, dash, ..Stroke::default() };
            let paint = paint(Tint { color, opacity: 1.0 });
            self.canvas.stroke_path(path, &paint, &stroke, self.scale, mask);
        }
    }
}

fn paint(Tint { color: [red, green, blue], opacity }: Tint) -> Paint<'static> {
    let mut color = tiny_skia::Color::from_rgba8(red, green, blue, 255);
    color.set_alpha(single(opacity));
    let mut paint = Paint::default();
    paint.set_color(color);
    paint
}
