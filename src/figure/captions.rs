//! Places texts beside their points, where they cover nothing and cannot be mistaken for the name of another
//! curve.

use super::elements::{Anchor, Element, PlotPen, Spot, TextLine, WHITE};
use super::paper::{Frame, LINE, NAMES};
use super::{Outline, Panel};
use crate::numerics::{hypot, real};
use crate::picture::{Caption, Dash, along};

/// Room between a text and its point.
const GAP: f64 = 6.0;

/// Harm of covering another text, a mark, a curve, a line that is there to be read against, and its own curve.
const COVERED: [f64; 5] = [1000.0, 12.0, 30.0, 1.0, 9.0];

/// Curves are examined at this spacing in pixels.
const SPACING: f64 = 3.0;

/// The box of a text; y points down.
#[derive(Clone, Copy, Debug)]
struct Rectangle {
    left: f64,
    top: f64,
    width: f64,
    height: f64,
}

impl Rectangle {
    fn overlaps(&self, other: &Rectangle) -> bool {
        let gap = 0.5 * GAP;
        let beside =
            self.left > other.left + other.width + gap || other.left > self.left + self.width + gap;
        let apart = self.top >= other.top + other.height || other.top >= self.top + self.height;
        !beside && !apart
    }

    /// How far a spot is from the box; 0 inside.
    fn distance(&self, (x, y): Spot) -> f64 {
        let aside = (self.left - x).max(x - self.left - self.width).max(0.0);
        hypot(aside, (self.top - y).max(y - self.top - self.height).max(0.0))
    }
}

/// What a text should not cover, in pixels of `plain` whatever the paper.
pub struct Surroundings {
    frame: Frame,
    /// What a pixel of `plain` is on paper.
    scale: f64,
    curves: Vec<Vec<Spot>>,
    /// Lines to be read against.
    guides: Vec<Vec<Spot>>,
    marks: Vec<Spot>,
    /// Where texts stand already.
    taken: Vec<Rectangle>,
}

/// The places along a curve that lie in the plot.
fn followed(points: &[[f64; 2]], frame: Frame) -> Vec<Spot> {
    let mut spots: Vec<Spot> = Vec::new();
    for pair in points.windows(2) {
        let [from, to] = [pair[0], pair[1]].map(|point| frame.spot(point.into()));
        spots.extend(along(from, to, SPACING).filter(|spot| frame.holds(*spot, 0.0)));
    }
    spots.dedup_by(|next, last| apart(*next, *last) < 0.5 * SPACING);
    spots
}

fn apart(one: Spot, other: Spot) -> f64 {
    hypot(one.0 - other.0, one.1 - other.1)
}

impl Surroundings {
    pub fn of(panel: &Panel, frame: Frame) -> Self {
        let (scale, frame) = (frame.paper.scale, frame.in_pixels());
        // A bar may run through its own name. Asymptotes and the line of the present value are there to be read
        // against.
        let thin = panel.curves.iter().filter(|curve| curve.style != Some(Dash::Thick));
        let (sparse, curves): (Vec<_>, Vec<_>) =
            thin.partition(|it| it.style == Some(Dash::Sparse));
        let spots = |curve: &Outline| followed(&curve.points, frame);
        let guides = panel.guides.iter().map(|guide| followed(guide, frame));
        Surroundings {
            frame,
            scale,
            taken: Vec::new(),
            curves: curves.into_iter().map(spots).collect(),
            guides: guides.chain(sparse.into_iter().map(spots)).collect(),
            marks: panel.marks.iter().map(|mark| frame.spot(mark.at)).collect(),
        }
    }

    /// The upper left corner of a place on paper where something of this size covers no curve and no mark, if there is one;
    /// it is taken then.
    pub fn room(&mut self, (width, height): Spot) -> Option<Spot> {
        /// Places along each side.
        const PLACES: u32 = 12;
        let Frame { left, top, paper, .. } = self.frame;
        let (width, height) = (width / self.scale, height / self.scale);
        let free = (paper.plot.0 - width - 2.0 * GAP, paper.plot.1 - height - 2.0 * GAP);
        let mut places = (0..PLACES * PLACES).map(|number| {
            let [across, down] = [number % PLACES, number / PLACES]
                .map(|place| f64::from(place) / f64::from(PLACES - 1));
            let (left, top) = (left + GAP + across * free.0, top + GAP + down * free.1);
            Rectangle { left, top, width, height }
        });
        let is_free = |place: &Rectangle| {
            let mut spots = self.curves.iter().chain([&self.marks]).flatten();
            spots.all(|spot| place.distance(*spot) >= 0.5 * GAP)
        };
        let found = places.find(is_free).filter(|_| free.0 >= 0.0 && free.1 >= 0.0)?;
        self.taken.push(found);
        Some((self.scale * found.left, self.scale * found.top))
    }

    /// How bad a place is for a text that belongs to a spot; 0 is perfect.
    fn harm(&self, place: &Rectangle, spot: Spot) -> f64 {
        /// Harm of standing nearer to another curve than to its own, within this many pixels.
        const MISTAKEN: (f64, f64) = (24.0, 40.0);
        let nearest = |spots: &[Spot]| {
            spots.iter().map(|spot| place.distance(*spot)).fold(f64::INFINITY, f64::min)
        };
        // Its own curves pass through the spot, and it may stand on them.
        let touches = |other: &Spot| apart(*other, spot) < 2.0 * SPACING;
        let own = place.distance(spot);
        let (covers, upon) = (|spots: &&Vec<Spot>| nearest(spots) < 1.0, own == 0.0);
        let (under, lines): (Vec<_>, Vec<_>) =
            self.curves.iter().filter(covers).partition(|spots| upon && spots.iter().any(touches));
        let covered = [
            self.taken.iter().filter(|other| place.overlaps(other)).count(),
            self.marks.iter().filter(|mark| place.distance(**mark) < 3.0).count(),
            lines.len(),
            self.guides.iter().filter(covers).count(),
            under.len(),
        ];
        let covered: f64 =
            covered.into_iter().zip(COVERED).map(|(count, harm)| real(count) * harm).sum();
        let others = self.curves.iter().filter(|spots| !spots.iter().any(touches));
        let mistaken = others.map(|spots| nearest(spots)).any(|it| it < own.min(MISTAKEN.1));
        covered + if mistaken { MISTAKEN.0 } else { 0.0 }
    }

    /// The best place of a text of a caption and the harm that it does there, if there is one.
    fn best<'a>(&self, caption: &Caption, text: &'a str) -> Option<(f64, &'a str, Rectangle)> {
        /// Harm of the next point of a curve, and of the next place around a point.
        const LESS_GOOD: (f64, f64) = (0.05, 0.1);
        /// Harm of a pixel further away from a point than needed: what names a curve may be anywhere beside
        /// it, what names a point stands there.
        const FAR: (f64, f64) = (0.5, 1.0);
        let width = self.frame.paper.width(text, NAMES);
        let inside = |Rectangle { left, top, .. }: &Rectangle| {
            let corners = [(*left, *top), (left + width, top + LINE)];
            corners.into_iter().all(|corner| self.frame.holds(corner, 2.0))
        };
        let far = if caption.or_at.is_empty() { FAR.1 } else { FAR.0 };
        let mut best: Option<(f64, &str, Rectangle)> = None;
        let spots = std::iter::once(&caption.at).chain(&caption.or_at);
        for (later, spot) in spots.map(|at| self.frame.spot(*at)).enumerate() {
            let upon = Rectangle {
                left: spot.0 - 0.5 * width,
                top: spot.1 - 0.5 * LINE,
                width,
                height: LINE,
            };
            let upon = Some(upon).filter(|_| !caption.or_at.is_empty());
            let places = around(spot, width).chain(upon).enumerate();
            for (farther, place) in places.filter(|(_, place)| inside(place)) {
                let harm = LESS_GOOD.0 * real(later) + LESS_GOOD.1 * real(farther);
                let is_least = |harm| best.is_none_or(|(least, ..)| harm < least);
                if is_least(harm) {
                    let away = (place.distance(spot) - GAP).max(0.0) * far;
                    let harm = harm + away + self.harm(&place, spot);
                    if is_least(harm) {
                        best = Some((harm, text, place));
                    }
                }
            }
        }
        best
    }
}

/// The boxes of a text of this width around a spot, the best first: beside it, above and below it, and
/// further away.
fn around((x, y): Spot, width: f64) -> impl Iterator<Item = Rectangle> {
    let rows = [0.0, -1.0, 1.0, -2.0, 2.0, -3.0, 3.0, -4.0, 4.0, -6.0, 6.0, -8.0, 8.0];
    rows.into_iter().flat_map(move |row: f64| {
        let top = y + (0.5 * row - 0.5) * LINE * if row.abs() > 4.0 { 2.0 } else { 1.0 };
        let over = row.abs() > 1.0;
        let beside = [x + GAP, x - GAP - width];
        let middle = over.then_some(x - 0.5 * width);
        beside.into_iter().chain(middle).map(move |left| Rectangle {
            left,
            top,
            width,
            height: LINE,
        })
    })
}

/// A caption with the form of its text that is written, and where.
type Placed<'a> = (&'a Caption, &'a str, Rectangle);

/// The places of all texts of a panel, those that need none left out. What would cover a curve is written
/// in its short form, where that covers less.
fn places<'a>(panel: &'a Panel, surroundings: &mut Surroundings) -> Vec<Placed<'a>> {
    /// Harm from which on the short form is tried: that of a covered curve.
    const MUCH: f64 = 30.0;
    let mut placed: Vec<Placed<'a>> = Vec::new();
    // What names a point has few places to go to and comes first.
    let (points, curves): (Vec<_>, Vec<_>) =
        panel.captions.iter().partition(|caption| caption.or_at.is_empty());
    for caption in points.into_iter().chain(curves) {
        let said = |other: &&Placed| (other.0.at, &other.0.long) == (caption.at, &caption.long);
        if !surroundings.frame.window.contains(caption.at) || placed.iter().find(said).is_some() {
            continue;
        }
        let find = |text: &'a str| surroundings.best(caption, text);
        let long = find(&caption.long);
        let short = long.filter(|(harm, ..)| *harm >= MUCH).and_then(|_| find(&caption.short));
        let found = [long, short].into_iter().flatten().min_by(|a, b| a.0.total_cmp(&b.0));
        // A text on another one says nothing.
        if let Some((_, text, place)) = found.filter(|(harm, ..)| *harm < COVERED[0]) {
            surroundings.taken.push(place);
            placed.push((caption, text, place));
        }
    }
    placed
}

/// Writes the texts of a panel, where its surroundings have room.
pub fn write(out: &mut Vec<Element>, panel: &Panel, frame: Frame, mut surroundings: Surroundings) {
    let scale = frame.paper.scale;
    for (Caption { role, .. }, text, place) in places(panel, &mut surroundings) {
        let at = (scale * place.left, scale * (place.top + LINE - 2.5));
        let line = TextLine::new(at, Anchor::Start, scale * NAMES, text);
        let edge = Some(PlotPen::solid(3.0 * scale, WHITE));
        out.push(TextLine { color: frame.paper.color(*role), edge, ..line }.into());
    }
}
