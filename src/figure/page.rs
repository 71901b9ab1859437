//! A figure as a page: its panels beside and above each other, the legend and the scales of maps below.

use super::captions::{self, Surroundings};
use super::elements::{Anchor, BLACK, Element, Page, PlotPen, TextLine};
use super::paper::{Frame, LETTERS, PageLayout, TITLES};
use super::symbols::{LetterStyle, TextRun};
use super::{Figure, legend, map, panel::draw};
use crate::numerics::real;
use crate::scene::{JournalStyle, LegendPlace, PanelLetters};

/// A page of all panels below a title, if it has one, and above the legend and the scales of maps.
pub fn page(figure: &Figure) -> Page {
    let paper = PageLayout::of(figure);
    let (scale, (width, height)) = (paper.scale, paper.panel());
    let width = width * real(paper.columns);
    let (mut out, mut below) = (Vec::new(), Vec::new());
    let head = title(&mut out, figure, width, &paper);
    for ((number, panel), entries) in figure.panels.iter().enumerate().zip(legend::of(figure)) {
        let frame = Frame::of(number, head, panel.window, paper);
        draw(&mut out, panel, frame);
        let mut surroundings = Surroundings::of(panel, frame);
        below.extend(match figure.sheet.legend.unwrap_or_default() {
            LegendPlace::None => Vec::new(),
            LegendPlace::Below => entries,
            LegendPlace::Inside => legend::inside(&mut out, entries, &mut surroundings, &paper),
        });
        captions::write(&mut out, panel, frame, surroundings);
        letter(&mut out, number, frame, figure.sheet.letters(figure.panels.len()));
    }
    let mut bottom = head + height * real(figure.panels.len().div_ceil(paper.columns));
    bottom += legend::below(&mut out, &below, (width, bottom), &paper);
    for shown in figure.panels.iter().filter_map(|panel| panel.map.as_ref()) {
        map::scale(&mut out, shown, (paper.margin.left, bottom), &paper);
        bottom += map::SCALE * scale;
    }
    Page { size: (width, bottom + 12.0 * scale), unit: paper.unit, elements: out }
}

/// Writes the title of a page of this width, if it has one. How high that is.
fn title(out: &mut Vec<Element>, figure: &Figure, width: f64, paper: &PageLayout) -> f64 {
    let usual = Some(&figure.title).filter(|_| paper.style == JournalStyle::Plain);
    let title = figure.sheet.title.as_ref().or(usual).filter(|title| !title.is_empty());
    let Some(title) = title else { return 0.0 };
    let lines = paper.wrapped(title, TITLES[0], width);
    for (line, words) in lines.iter().enumerate() {
        let at = (width / 2.0, (22.0 + 18.0 * real(line)) * paper.scale);
        out.push(TextLine::new(at, Anchor::Middle, TITLES[0] * paper.scale, words).into());
    }
    (16.0 + 18.0 * real(lines.len())) * paper.scale
}

/// Writes the letter of the panel with this number, from 0.
fn letter(out: &mut Vec<Element>, number: usize, frame: Frame, place: PanelLetters) {
    let Frame { left, top, paper, .. } = frame;
    let ((width, height), scale) = (paper.plot, paper.scale);
    let letter = (b'a'..=b'z').map(char::from).nth(number).unwrap_or('?');
    let (at, anchor, text) = match place {
        PanelLetters::None => return,
        PanelLetters::Above => ((left, top - 5.0 * scale), Anchor::Start, letter.to_string()),
        PanelLetters::Below => {
            let at = (left + width / 2.0, top + height + 51.0 * scale);
            (at, Anchor::Middle, format!("({letter})"))
        }
    };
    let runs = vec![TextRun { text, setting: LetterStyle::Upright }];
    let bold = Some(PlotPen::solid(0.4 * scale, BLACK)).filter(|_| place == PanelLetters::Above);
    let line = TextLine::new(at, anchor, LETTERS * scale, "");
    out.push(TextLine { runs, edge: bold, ..line }.into());
}
