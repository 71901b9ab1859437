//! The bifurcation diagram: a property of the cycles, over a parameter.
//!
//! Computed branches are solid where the cycle is stable and dashed where it is not; the first-order harmonic answer
//! is dotted beside them. Rest belongs to every diagram: with friction the sticking set, a band that attracts;
//! without, the equilibrium at 0, stable on one side of the Hopf point and unstable on the other. A dotted upright
//! stands at the present value of the parameter, and the cycles there are marked. Beside the branch of the present
//! values those of others are paler, without marks. A point of the branch that is held has a cross.

use super::{Dash, Fill, Item, LineStyle, Picture, Role, Text, cycle_mark, cycle_name};
use crate::branch::{Branch, BranchPoint, Special, SpecialKind};
use crate::closed_form::{amplitudes, damping_at, large_asymptote, mean, small_asymptote};
use crate::model::{Knob, Parameters};
use crate::numerics::bisect;
use crate::scene::{Axes, Height, Layer, Ordinate, Point};
use crate::session;
use crate::session::{Session, ShownMotion};
use crate::words::{significant, stability};

pub fn draw<'a>(picture: &mut Picture<'a>, session: &'a Session, index: usize) {
    let diagram = &session.plots[index];
    let abscissa = diagram.axes.abscissa;
    let (name, label) = (abscissa.spec().name, diagram.axes.label());
    let velocity = Axes { ordinate: Ordinate::VMax, ..diagram.axes }.label();
    let beside = session.layers.contains(&Layer::Extents) && velocity != label;
    let label: Text = if beside {
        format!("{label}, {velocity}").into()
    } else {
        label.into()
    };
    let window = diagram.window;
    picture.varied = vec![abscissa];
    picture.cursor = held(session, index).or(picture.cursor);
    picture.axes(name, label);
    let shows = |layer| session.layers.contains(&layer);
    let current = session.value(abscissa);
    let all = session.shown(index);
    let has_present = all.iter().any(|one| one.present);
    let computed = session.branches(index).into_iter().filter_map(|(variant, branch)| {
        let (shown, height) = (all.get(variant)?, session.height(index, variant));
        Some(ComputedBranch { shown, branch, height, beside: has_present && !shown.present })
    });
    let mut found: Vec<ComputedBranch> = computed.collect();
    // The present one over the others.
    found.sort_by_key(|found| !found.beside);

    picture.upright(LineStyle::guide(), 0.0);
    if window.y.from() < 0.0 && window.y.to() > 0.0 {
        picture.level(LineStyle::guide(), 0.0);
    }
    super::present(picture, session, current, window.y.to());
    // Beside branches of other values the formulas stand for the present one alone.
    for shown in all.iter().filter(|shown| shown.present || !has_present) {
        if shows(Layer::Asymptotes) {
            asymptotes(picture, shown, diagram.axes);
        }
        if shows(Layer::Harmonic) {
            harmonic(picture, shown, diagram, &found);
        }
    }
    let rest = |shown: &ShownMotion| match (shown.present || all.len() == 1, has_present) {
        (true, _) => (REST, Dash::Thick),
        (false, true) => ("rest at other values", Dash::Solid),
        (false, false) => (REST, Dash::Solid),
    };
    for shown in &all {
        rest_in(picture, shown, rest(shown), diagram.axes);
    }
    let pieces = || {
        found.iter().flat_map(|found| found.branch.pieces.iter().map(move |piece| (found, piece)))
    };
    if shows(Layer::Branch) {
        pieces().for_each(|(found, piece)| branch(picture, piece, found));
        for (found, piece) in pieces().filter(|(found, _)| !found.beside) {
            here(picture, piece, found, current);
        }
    }
    if shows(Layer::Extents) {
        pieces().for_each(|(found, piece)| extents(picture, piece, found));
    }
    if shows(Layer::Special) {
        let mut named: Vec<&Special> = Vec::new();
        for ComputedBranch { branch, height, .. } in found.iter().rev() {
            for special in &branch.special {
                // Several variants may have one in common.
                if !named.contains(&special) {
                    caption(picture, special, *height, window.y.to());
                    named.push(special);
                }
            }
        }
    }
}

/// A branch that was computed: whose it is, and how high its cycles stand.
struct ComputedBranch<'a> {
    shown: &'a ShownMotion,
    branch: &'a Branch,
    height: Height,
    /// Whether it stands beside that of the present values.
    beside: bool,
}

impl ComputedBranch<'_> {
    fn place(&self, point: &BranchPoint) -> Point {
        Point { x: point.value, y: self.height.of(point.value, &point.cycle) }
    }

    /// Where the fold between two neighbours stands.
    fn fold_between(&self, one: &BranchPoint, other: &BranchPoint) -> Option<Point> {
        let (one, other) = (one.cycle.q_max, other.cycle.q_max);
        let folds = self.branch.special.iter().filter(|it| it.kind == SpecialKind::Fold);
        let mut cycles = folds.filter_map(|fold| Some((fold.value, fold.cycle?)));
        cycles
            .find(|(_, cycle)| (one.min(other)..=one.max(other)).contains(&cycle.q_max))
            .map(|(value, cycle)| Point { x: value, y: self.height.of(value, &cycle) })
    }
}

/// Where the point that is held stands in a diagram: in every one over its parameter. A cycle that has
/// gone to infinity stands at the top.
fn held(session: &Session, index: usize) -> Option<Point> {
    let (held, diagram) = (session.held?, &session.plots[index]);
    let over = diagram.axes.abscissa;
    let same = session.focused().is_some_and(|focused| focused.axes.abscissa == over);
    let (top, height) = (diagram.window.y.to(), session.height(index, held.variant));
    let y = held.cycle.map_or(top, |cycle| height.of(held.value, &cycle));
    same.then_some(Point { x: held.value, y })
}

/// The asymptotes A1 and A2 (51, 52), their height read out of A0 and A.
fn asymptotes(picture: &mut Picture, shown: &ShownMotion, axes: Axes) {
    let own = shown.problem.parameters;
    let height = axes.height(own.r);
    let Some(size) = height.ordinate.spec().harmonic else { return };
    // Of the mean they are asymptotes of their own, with names of their own (53, 54).
    let names = match height.ordinate {
        Ordinate::Mean => ["asymptote A01", "asymptote A02"],
        _ => ["asymptote A1", "asymptote A2"],
    };
    let asymptotes = [small_asymptote as fn(&Parameters) -> Option<f64>, large_asymptote];
    for (name, asymptote) in names.into_iter().zip(asymptotes) {
        picture.graph(LineStyle::from(name).of(&shown.variant), move |value| {
            let parameters = own.with(axes.abscissa, value);
            let amplitude = asymptote(&parameters)?;
            Some(height.scaled(value, size(mean(parameters.d2, amplitude), amplitude)))
        });
    }
}

/// The first-order harmonic answer, its height read out of A0 and A.
///
/// Over D it is drawn along the amplitude, up to the largest on show, which leads through the fold without a gap;
/// over the other parameters each amplitude is a curve of its own.
fn harmonic(
    picture: &mut Picture,
    shown: &ShownMotion,
    diagram: &session::Plot,
    found: &[ComputedBranch],
) {
    /// Samples along the amplitude: more than any screen has dots.
    const SAMPLES: u16 = 1000;
    let own @ Parameters { d2, d3, r, .. } = shown.problem.parameters;
    let (abscissa, height) = (diagram.axes.abscissa, diagram.axes.height(r));
    let Some(size) = height.ordinate.spec().harmonic else { return };
    let line = LineStyle::from("first harmonic").of(&shown.variant);
    if abscissa == Knob::D {
        let largest = largest_amplitude(diagram, height, found);
        let points = (1..=SAMPLES).map(|sample| {
            let amplitude = largest * f64::from(sample) / f64::from(SAMPLES);
            let x = damping_at(d3, r, amplitude).unwrap_or(f64::NAN);
            [x, height.scaled(x, size(mean(d2, amplitude), amplitude))]
        });
        return picture.curve(line, points);
    }
    for stable in [false, true] {
        picture.graph(line.clone(), move |value| {
            let mut found = amplitudes(&own.with(abscissa, value)).into_iter();
            let found = found.find(|answer| answer.stable == stable);
            found.map(|answer| height.scaled(value, size(answer.mean, answer.amplitude)))
        });
    }
}

/// Twice the largest amplitude that can be on show: beyond it the harmonic curve need not be followed.
///
/// Where the ordinate is not a length, that is twice the largest amplitude of the computed branches.
fn largest_amplitude(diagram: &session::Plot, height: Height, found: &[ComputedBranch]) -> f64 {
    let unit = height.friction.filter(|_| height.is_ratio()).unwrap_or(1.0);
    match diagram.axes.ordinate {
        Ordinate::QMax | Ordinate::QMin | Ordinate::VMax | Ordinate::Amplitude => {
            2.0 * unit * diagram.window.y.farthest()
        }
        Ordinate::Mean | Ordinate::Period | Ordinate::Multiplier => {
            let points = found.iter().flat_map(|found| found.branch.pieces.iter().flatten());
            2.0 * points.map(|point| point.cycle.q_max).fold(0.5, f64::max)
        }
    }
}

/// Adds a piece, run by run of equal stability; neighbouring runs meet at the fold between them. One of
/// several branches has its label where it is highest in the window.
fn branch(picture: &mut Picture, piece: &[BranchPoint], found: &ComputedBranch) {
    let ComputedBranch { shown: ShownMotion { variant, present, .. }, beside, .. } = found;
    let place = |point: &BranchPoint| found.place(point);
    let mut start = None;
    for run in piece.chunk_by(|one, other| one.cycle.stable == other.cycle.stable) {
        let (stable, last) = (run[0].cycle.stable, &run[run.len() - 1]);
        let next = piece.iter().skip_while(|point| *point != last).nth(1);
        let end = next.map(|next| found.fold_between(last, next).unwrap_or(place(next)));
        let mut line = LineStyle::from(cycle_name(stable));
        let points: Vec<Point> = run.iter().map(place).collect();
        if *present {
            // Figures have it in their legend.
            picture.name_curve(&points, "", stability(stable), line.role);
        }
        if *beside {
            // Its values stand beside it.
            let name = format!("{} at other values", line.name);
            line = LineStyle::new(name, line.role.paler(), line.dash).captioned();
        }
        picture.curve(line.of(variant), start.into_iter().chain(points).chain(end));
        // Without a fold the runs share a point, which this one has as its last.
        start = end.filter(|end| next.is_none_or(|next| *end != place(next)));
    }
    let points: Vec<Point> = piece.iter().map(place).collect();
    let role = if *beside { Role::Quiet } else { Role::Special };
    picture.name_curve(&points, &variant.label, &variant.label, role);
}

/// The largest velocities of a piece.
fn extents(picture: &mut Picture, piece: &[BranchPoint], found: &ComputedBranch) {
    let height = Height { ordinate: Ordinate::VMax, ..found.height };
    let points = piece.iter().map(|point| [point.value, height.of(point.value, &point.cycle)]);
    let line = LineStyle::from("largest velocity A_v").of(&found.shown.variant);
    picture.curve(line, points);
}

/// Marks the cycles of a piece at the present value.
fn here(picture: &mut Picture, piece: &[BranchPoint], found: &ComputedBranch, value: f64) {
    for (index, pair) in piece.windows(2).enumerate() {
        let (a, b) = (&pair[0], &pair[1]);
        if (a.value < value) != (b.value < value) {
            let places: Vec<[f64; 2]> = piece.iter().map(|it| found.place(it).into()).collect();
            let y = between(&places, index, value);
            picture.mark(cycle_mark(a.cycle.stable), [value, y], Role::Current);
        }
    }
}

/// The height of a curve at `value`, which lies between its points number `index` and `index + 1`: on the
/// polynomials through six points over their numbers, which also lead around a fold.
///
/// Points of a branch are spread evenly, so both coordinates are smooth in the number; the error falls
/// with the sixth power of their distance.
fn between(places: &[[f64; 2]], index: usize, value: f64) -> f64 {
    /// Points that a polynomial goes through.
    const THROUGH: usize = 6;
    /// Halvings of a step: as many as a number has digits.
    const HALVINGS: u32 = 53;
    let first = (index + 1).saturating_sub(THROUGH / 2).min(places.len().saturating_sub(THROUGH));
    let near = &places[first..places.len().min(first + THROUGH)];
    let nodes: Vec<f64> = (0_u8..).take(near.len()).map(f64::from).collect();
    let at = |number: f64, axis: usize| -> f64 {
        let weight = |own: f64| -> f64 {
            let others = nodes.iter().filter(|node| **node != own);
            others.map(|node| (number - node) / (own - node)).product()
        };
        nodes.iter().zip(near).map(|(own, place)| weight(*own) * place[axis]).sum()
    };
    let (low, high) = (nodes[index - first], nodes[index + 1 - first]);
    let rising = places[index][0] < value;
    at(bisect(low, high, HALVINGS, |number| (at(number, 0) < value) != rising).0, 1)
}

/// Adds the letter of a special point, and its value where there is room.
fn caption(picture: &mut Picture, special: &Special, height: Height, top: f64) {
    // A cycle that has gone to infinity is named at the top, where its branch leaves.
    if special.cycle.is_none() {
        let line = LineStyle::new("escape", Role::Asymptote, Dash::Dotted).captioned();
        picture.upright(line, special.value);
    }
    let y = special.cycle.map_or(top, |cycle| height.of(special.value, &cycle));
    let letter = special.kind.letter(special.cycle.as_ref());
    picture.special([special.value, y], letter, &significant(special.value, 4));
}

/// The name of rest in every diagram.
const REST: &str = "rest (attracts)";

/// Draws where one of the motions of a diagram can rest; nothing where the ordinate is not a property of a
/// rest (its period, its multiplier).
fn rest_in(
    picture: &mut Picture,
    shown: &ShownMotion,
    (name, dash): (&'static str, Dash),
    axes: Axes,
) {
    let own = shown.problem.parameters;
    let (abscissa, height) = (axes.abscissa, axes.height(own.r));
    let has_band = match height.ordinate {
        Ordinate::QMax | Ordinate::QMin | Ordinate::Mean => true,
        Ordinate::VMax | Ordinate::Amplitude => false,
        Ordinate::Period | Ordinate::Multiplier => return,
    };
    if own.r == 0.0 && abscissa != Knob::R {
        // There is no height in units of a friction that is zero.
        if !height.is_ratio() {
            rest_without_friction(picture, shown, abscissa);
        }
        return;
    }
    let line = LineStyle { dash, ..LineStyle::from(name) }.of(&shown.variant);
    if !has_band {
        return picture.level(line, 0.0);
    }
    let edge = move |value: f64| {
        let r = own.with(abscissa, value).r;
        let unit = if height.is_ratio() { r } else { 1.0 };
        (r >= 0.0 && unit > 0.0).then_some(r / unit)
    };
    picture.graph(line.clone(), edge);
    if picture.window.y.from() < 0.0 {
        picture.graph(line.clone(), move |value| edge(value).map(|edge| -edge));
    }
    if abscissa == Knob::R {
        let fill = Fill { role: Role::Sticking, name };
        let within =
            move |at: Point| edge(at.x).is_some_and(|edge| at.y.abs() <= edge).then_some(fill);
        picture.items.push(Item::Texture(Box::new(within)));
    } else if let Some(edge) = edge(picture.window.x.from()) {
        picture.items.push(Item::Rows(line, -edge, edge));
    }
}

/// Whether the equilibrium without friction is stable: decided by the eigenvalues (9), on the imaginary axis
/// by cubic damping, whatever D2 (its first integral grows or falls with D3 alone); `None` for a centre.
fn is_stable(parameters: &Parameters) -> Option<bool> {
    let Parameters { d, d3, .. } = *parameters;
    let decisive = if d == 0.0 { d3 } else { d };
    (decisive != 0.0).then_some(decisive > 0.0)
}

/// The equilibrium at 0 without friction.
fn rest_without_friction(picture: &mut Picture, shown: &ShownMotion, abscissa: Knob) {
    let own = shown.problem.parameters;
    for (stable, name) in [(true, "rest (stable)"), (false, "rest (unstable)")] {
        picture.graph(LineStyle::from(name).of(&shown.variant), move |value| {
            (is_stable(&own.with(abscissa, value)) == Some(stable)).then_some(0.0)
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numerics::elementary::sin_cos;

    #[test]
    fn between_points_a_curve_is_followed_around_its_fold() {
        // An arc of a circle that turns back at x = 1, and its ends, where one neighbour is missing.
        let places: Vec<[f64; 2]> = (0..=128_u32)
            .map(|step| {
                let (sin, cos) = sin_cos(f64::from(step) / 128.0 * 3.0 - 1.5);
                [cos, sin]
            })
            .collect();
        let mut checked = 0;
        for (index, pair) in places.windows(2).enumerate() {
            let value = f64::midpoint(pair[0][0], pair[1][0]);
            let angle = f64::midpoint(pair[0][1], pair[1][1]);
            if (pair[0][0] < value) != (pair[1][0] < value) {
                let expected = (1.0 - value * value).sqrt() * angle.signum();
                let found = between(&places, index, value);
                assert!((found - expected).abs() < 1e-10, "{index}: {found} {expected}");
                checked += 1;
            }
        }
        assert!(checked > 120, "{checked}");
    }
}
