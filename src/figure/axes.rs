//! The axes of a panel: as many numbers as have room, and their names.

use tiny_skia_path::PathBuilder;

use super::Panel;
use super::elements::{Anchor, Element, Shape, Spot, TextLine, lead};
use super::inks::DARK;
use super::paper::{BESIDE, Frame, LETTERS, PageLayout, TITLES};
use crate::numerics::real;
use crate::scene::JournalStyle;

/// Draws the frame of a plot with its numbers and names, and what the plot needs where it can show nothing.
pub fn axes(out: &mut Vec<Element>, panel: &Panel, frame: Frame) {
    let Frame { left, top, paper, .. } = frame;
    let ((width, height), scale) = (paper.plot, paper.scale);
    let (right, bottom) = (left + width, top + height);
    out.push(Shape::rectangle((left, top), paper.plot).drawn(paper.line(0.9, DARK)).into());
    let [rightward, upward] = paper.ticks(panel);
    let size = LETTERS * scale;
    let (long, gap) = (5.0 * scale, BESIDE[0] * scale);
    let mut notches = PathBuilder::new();
    let mut notch = |from: Spot, to: Spot| lead(&mut notches, [from, to]);
    for tick in &rightward.ticks {
        let x = left + tick.fraction * width;
        notch((x, bottom), (x, bottom - long));
        notch((x, top), (x, top + long));
        let at = (x, bottom + 17.0 * scale);
        out.push(TextLine::new(at, Anchor::Middle, size, &tick.label).into());
    }
    for tick in &upward.ticks {
        let y = top + (1.0 - tick.fraction) * height;
        notch((left, y), (left + long, y));
        notch((right, y), (right - long, y));
        let at = (left - gap, y + 4.0 * scale);
        out.push(TextLine::new(at, Anchor::End, size, &tick.label).into());
    }
    out.push(Shape::along(notches).drawn(paper.line(0.8, DARK)).into());
    let (center, middle) = (left + width / 2.0, top + height / 2.0);
    let around = |at: Spot, text: &str| TextLine::new(at, Anchor::Middle, size, text);
    let names = [rightward.named(&panel.names[0]), upward.named(&panel.names[1])];
    out.push(around((center, bottom + 35.0 * scale), &names[0]).into());
    let beside = (left - paper.margin.left + BESIDE[1] * scale, middle);
    out.push(TextLine { upward: true, ..around(beside, &names[1]) }.into());
    let nothing = panel.nothing.iter().flat_map(|text| paper.wrapped(text, LETTERS, width));
    for (line, words) in nothing.enumerate() {
        out.push(around((center, middle + 16.0 * scale * real(line)), &words).into());
    }
    if paper.style == JournalStyle::Plain {
        title(out, panel, (center, top - 9.0 * scale), &paper);
    }
}

/// Writes the title of a panel, its last line at this spot.
fn title(out: &mut Vec<Element>, panel: &Panel, (center, last): Spot, paper: &PageLayout) {
    for (line, words) in paper.titled(panel).iter().rev().enumerate() {
        let at = (center, last - 15.0 * paper.scale * real(line));
        out.push(TextLine::new(at, Anchor::Middle, TITLES[1] * paper.scale, words).into());
    }
}
