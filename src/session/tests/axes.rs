//! The axes of the diagram.

use super::Desk;
use crate::oscillator::Symbol;
use crate::scene::{Layer, ORDINATES, Ordinate, Topic, Unit};
use crate::session::{Framing, Overlay};

#[test]
fn every_parameter_comes_below_the_diagram_and_the_scene_s_own_comes_back() {
    let mut desk = Desk::open("supercritical");
    let scene = desk.session.plots[1].clone();
    desk.press("<tab><tab>");
    let mut seen = Vec::new();
    for asked in [&[Topic::Branch][..], &[Topic::Branch], &[Topic::Branch], &[]] {
        assert_eq!(desk.press("X"), asked, "the first one is known");
        assert_eq!(desk.branch(1).parameter, desk.session.plots[1].axes.abscissa);
        let today = desk.session.value(desk.session.plots[1].axes.abscissa);
        assert!(desk.session.plots[1].window.x.contains(today));
        seen.push((desk.session.plots[1].axes.abscissa, desk.session.plots[1].framing));
    }
    let fitted = Framing::Fitted;
    assert_eq!(
        seen,
        [
            (Symbol::D2, fitted),
            (Symbol::D3, fitted),
            (Symbol::R, fitted),
            (Symbol::D, Framing::Scene)
        ]
    );
    assert_eq!(desk.session.exhibit(1), desk.session.scene.plots.get(1).copied());
    assert_eq!(desk.session.plots[1].window, scene.window);
}

#[test]
fn the_window_follows_a_value_of_today_that_is_out_of_the_ordinary() {
    let mut desk = Desk::open("supercritical");
    desk.press("<down>7<enter><tab><tab>X X");
    assert_eq!(desk.session.plots[1].axes.abscissa, Symbol::D3);
    assert!(desk.session.plots[1].window.x.contains(7.0));
}

#[test]
fn every_ordinate_is_fitted_to_the_cycles_that_are_there() {
    let mut desk = Desk::open("supercritical");
    desk.press("<tab><tab>");
    for row in ORDINATES.iter().cycle().skip(1).take(ORDINATES.len()) {
        assert_eq!(desk.press("Y"), [], "{}", row.name);
        assert_eq!(desk.session.plots[1].axes.ordinate, row.ordinate);
        let window = desk.session.plots[1].window;
        for point in desk.branch(1).pieces.iter().flatten() {
            let height = row.ordinate.of(&point.cycle);
            // The scene's own window is not fitted.
            let shown = window.y.contains(height) || row.ordinate == Ordinate::QMax;
            assert!(shown, "{}: {height} in {window:?}", row.name);
        }
    }
    assert_eq!(desk.session.plots[1].framing, Framing::Scene);
}

#[test]
fn home_brings_the_axes_of_the_scene_back() {
    let mut desk = Desk::open("supercritical");
    desk.press("<tab><tab>Y X");
    assert_eq!(desk.press("<home>"), [], "known still");
    assert_eq!(
        (desk.session.plots[1].axes.abscissa, desk.session.plots[1].axes.ordinate),
        (Symbol::D, Ordinate::QMax)
    );
    assert_eq!(desk.session.plots[1].window, desk.session.scene.plots[1].opening());
}

#[test]
fn the_harmonic_answer_has_no_multiplier() {
    let mut desk = Desk::open("supercritical");
    desk.press("<tab><tab>");
    assert_eq!(desk.session.not_drawn(Layer::Harmonic), None);
    desk.press("Y Y Y Y Y Y");
    assert_eq!(desk.session.plots[1].axes.ordinate, Ordinate::Multiplier);
    assert!(desk.session.not_drawn(Layer::Harmonic).is_some());
    assert_eq!(desk.session.not_drawn(Layer::Branch), None);
}

#[test]
fn ratios_to_r_are_another_look_at_the_same_branch() {
    let mut desk = Desk::open("linear");
    desk.press(":axes<space>D<space>q_max/r<enter>");
    let plot = desk.session.plot;
    let axes = desk.session.plots[plot].axes;
    assert_eq!((axes.unit, axes.label()), (Unit::Friction, "A_q/r"));
    assert_eq!(desk.press("N"), [], "the branch is the same");
    assert_eq!(desk.session.plots[plot].axes.label(), "q_max");
    desk.press("N");
    assert_eq!(desk.notice(), "A_q/r: right turning point of the cycles, in units of r");
    let r = desk.session.problem.parameters.r;
    let height = desk.session.height(plot, 0);
    let point = desk.branch(plot).pieces[0][1];
    assert_eq!(height.of(point.value, &point.cycle), point.cycle.q_max / r);
    // Over r each point has its own.
    desk.press("X X X");
    assert_eq!(desk.session.plots[plot].axes.abscissa, Symbol::R);
    let point = desk.branch(plot).pieces[0][1];
    let height = desk.session.height(plot, 0);
    assert_eq!(height.of(point.value, &point.cycle), point.cycle.q_max / point.value);
    desk.press("Y Y Y Y Y N");
    assert_eq!(desk.notice(), "period is no length, and has no unit");
    for (line, words) in [
        (
            "axes<space>D<space>period/r",
            "no property \"period/r\"; there are q_max, q_max/r, q_min",
        ),
        ("axes<space>D<space>size", "no property \"size\"; there are q_max"),
    ] {
        desk.press(&format!("<esc>:{line}<enter>"));
        let Some(Overlay::Prompt(prompt)) = &desk.session.overlay else { panic!("{line}: taken") };
        let refused = prompt.refused.clone().unwrap_or_default();
        assert!(refused.contains(words), "{refused}");
    }
}
