//! A figure as a page: its panels beside and above each other, the legend and the scales of maps below.

use super::captions::{self, Surroundings};
use super::elements::{Anchor, BLACK, Element, Page, PlotPen, TextLine};
use super::paper::{Frame, LETTERS, PageLayout, TITLES};
use super::symbols::{LetterStyle, TextRun};
use super::{Figure, legend, map, panel::draw};
use crate::numerics::real;
use crate::scene::{JournalStyle, LegendPlace, PanelLetters};

/// A page of all panels, below a title if it has one.
pub fn page(figure: &Figure) -> Page {
    let paper = PageLayout::of(figure);
    let (width, scale) = (paper.panel().0 * real(paper.columns), paper.scale);
    let usual = Some(&figure.title).filter(|_| paper.style == JournalStyle::Plain);
    let title = figure.sheet.title.as_ref().or(usual);
    let lines = title.map(|title| paper.wrapped(title, TITLES[0], width)).unwrap_or_default();
    let mut out = Vec::new();
    for (line, words) in lines.iter().enumerate() {
        let at = (width / 2.0, (22.0 + 18.0 * real(line)) * scale);
        out.push(TextLine::new(at, Anchor::Middle, TITLES[0] * scale, words).into());
    }
    let head = if lines.is_empty() {
        0.0
    } else {
        16.0 + 18.0 * real(lines.len())
    };
    whole(figure, out, head * scale, paper)
}

/// A page of the only panel of a figure, which needs no title above its own.
pub fn alone(figure: &Figure) -> Page {
    whole(figure, Vec::new(), 0.0, PageLayout::of(figure))
}

/// A page with all panels below what stands above them, and with the legend and the scales of maps below.
fn whole(figure: &Figure, mut out: Vec<Element>, head: f64, paper: PageLayout) -> Page {
    let (width, height) = paper.panel();
    let width = width * real(paper.columns);
    let mut below = Vec::new();
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
        bottom += map::SCALE * paper.scale;
    }
    Page { size: (width, bottom + 12.0 * paper.scale), unit: paper.unit, elements: out }
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
