//! The axes of the diagram.

use super::Trial;
use crate::oscillator::Symbol;
use crate::scene::{Layer, ORDINATES, Ordinate, Topic, Unit};
use crate::session::Framing;

#[test]
fn every_parameter_comes_below_the_diagram_and_the_scene_s_own_comes_back() {
    let mut trial = Trial::alone("supercritical");
    let scene = trial.session.plots[1].clone();
    trial.press("<tab><tab>");
    let mut seen = Vec::new();
    for asked in [&[Topic::Branch][..], &[Topic::Branch], &[Topic::Branch], &[]] {
        assert_eq!(trial.press("X"), asked, "the first one is known");
        assert_eq!(trial.branch(1).parameter, trial.session.plots[1].axes.abscissa);
        let present = trial.session.value(trial.session.plots[1].axes.abscissa);
        assert!(trial.session.plots[1].window.x.contains(present));
        seen.push((trial.session.plots[1].axes.abscissa, trial.session.plots[1].framing));
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
    assert_eq!(trial.session.plot_setup(1), trial.session.scene.plots.get(1).copied());
    assert_eq!(trial.session.plots[1].window, scene.window);
}

#[test]
fn the_window_follows_a_value_of_today_that_is_out_of_the_ordinary() {
    let mut trial = Trial::alone("supercritical");
    trial.press("<down>7<enter><tab><tab>X X");
    assert_eq!(trial.session.plots[1].axes.abscissa, Symbol::D3);
    assert!(trial.session.plots[1].window.x.contains(7.0));
}

#[test]
fn every_ordinate_is_fitted_to_the_cycles_that_are_there() {
    let mut trial = Trial::alone("supercritical");
    trial.press("<tab><tab>");
    for row in ORDINATES.iter().cycle().skip(1).take(ORDINATES.len()) {
        assert_eq!(trial.press("Y"), [], "{}", row.name);
        assert_eq!(trial.session.plots[1].axes.ordinate, row.ordinate);
        let window = trial.session.plots[1].window;
        for point in trial.branch(1).pieces.iter().flatten() {
            let height = row.ordinate.of(&point.cycle);
            // The scene's own window is not fitted.
            let shown = window.y.contains(height) || row.ordinate == Ordinate::QMax;
            assert!(shown, "{}: {height} in {window:?}", row.name);
        }
    }
    assert_eq!(trial.session.plots[1].framing, Framing::Scene);
}

#[test]
fn home_brings_the_axes_of_the_scene_back() {
    let mut trial = Trial::alone("supercritical");
    trial.press("<tab><tab>Y X");
    assert_eq!(trial.press("<home>"), [], "known still");
    assert_eq!(
        (trial.session.plots[1].axes.abscissa, trial.session.plots[1].axes.ordinate),
        (Symbol::D, Ordinate::QMax)
    );
    assert_eq!(trial.session.plots[1].window, trial.session.scene.plots[1].opening());
}

#[test]
fn the_harmonic_answer_has_no_multiplier() {
    let mut trial = Trial::alone("supercritical");
    trial.press("<tab><tab>");
    assert_eq!(trial.session.not_drawn(Layer::Harmonic), None);
    trial.press("Y Y Y Y Y Y");
    assert_eq!(trial.session.plots[1].axes.ordinate, Ordinate::Multiplier);
    assert!(trial.session.not_drawn(Layer::Harmonic).is_some());
    assert_eq!(trial.session.not_drawn(Layer::Branch), None);
}

#[test]
fn ratios_to_r_are_another_look_at_the_same_branch() {
    let mut trial = Trial::open("linear");
    trial.press(":axes<space>D<space>q_max/r<enter>");
    let plot = trial.session.plot;
    let axes = trial.session.plots[plot].axes;
    assert_eq!((axes.unit, axes.label()), (Unit::Friction, "A_q/r"));
    assert_eq!(trial.press("N"), [], "the branch is the same");
    assert_eq!(trial.session.plots[plot].axes.label(), "q_max");
    trial.press("N");
    assert_eq!(trial.notice(), "A_q/r: right turning point of the cycles, in units of r");
    let r = trial.session.problem.parameters.r;
    let height = trial.session.height(plot, 0);
    let point = trial.branch(plot).pieces[0][1];
    assert_eq!(height.of(point.value, &point.cycle), point.cycle.q_max / r);
    // Over r each point has its own.
    trial.press("X X X");
    assert_eq!(trial.session.plots[plot].axes.abscissa, Symbol::R);
    let point = trial.branch(plot).pieces[0][1];
    let height = trial.session.height(plot, 0);
    assert_eq!(height.of(point.value, &point.cycle), point.cycle.q_max / point.value);
    trial.press("Y Y Y Y Y N");
    assert_eq!(trial.notice(), "period is no length, and has no unit");
    for (line, words) in [
        (
            "axes<space>D<space>period/r",
            "no property \"period/r\"; there are q_max, q_max/r, q_min",
        ),
        ("axes<space>D<space>size", "no property \"size\"; there are q_max"),
    ] {
        trial.press(&format!("<esc>:{line}<enter>"));
        let refused = trial.refused();
        assert!(refused.contains(words), "{refused}");
    }
}
