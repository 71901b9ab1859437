//! The axes of the diagram.

use super::Trial;
use crate::model::Knob;
use crate::picture::{self, Item};
use crate::scene::{Layer, ORDINATES, Ordinate, Topic};
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
        [(Knob::D2, fitted), (Knob::D3, fitted), (Knob::R, fitted), (Knob::D, Framing::Scene)]
    );
    assert_eq!(trial.session.plot_setup(1), trial.session.scene.plots[1]);
    assert_eq!(trial.session.plots[1].window, scene.window);
}

#[test]
fn a_fitted_window_that_is_brought_back_is_not_that_of_the_scene() {
    let mut trial = Trial::alone("supercritical");
    trial.press("<tab><tab>X");
    let fitted = trial.session.plots[1].clone();
    trial.press("Zu");
    assert_eq!(trial.session.plots[1], fitted);
    assert_eq!(trial.session.plot_setup(1).window, Some(fitted.window));
}

#[test]
fn an_undone_number_leaves_windows_those_of_the_scene_that_leaves_them_open() {
    let mut trial = Trial::open("inside");
    let opened = trial.session.clone();
    trial.press(":set<space>q0=0.3<enter>u");
    assert_eq!(trial.session.plots, opened.plots);
    assert!(opened.plots.iter().any(|plot| plot.framing == Framing::Scene));
    assert_eq!(trial.session.screen_setup().plots, opened.scene.plots);
}

#[test]
fn the_window_follows_a_present_value_that_is_out_of_the_ordinary() {
    let mut trial = Trial::alone("supercritical");
    trial.goes(&[("<down>7<enter><tab><tab>X X", "abscissa D3")]);
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
    // The answer is still known.
    trial.goes(&[("<tab><tab>Y X", ""), ("<home>", "asked | abscissa D | ordinate q_max")]);
    assert_eq!(trial.session.plots[1].window, trial.session.scene.plots[1].opening());
}

#[test]
fn the_harmonic_answer_has_no_multiplier() {
    let mut trial = Trial::alone("supercritical");
    assert_eq!(trial.session.not_drawn(Layer::Harmonic), None);
    trial.goes(&[("<tab><tab>Y Y Y Y Y Y", "ordinate multiplier")]);
    assert!(trial.session.not_drawn(Layer::Harmonic).is_some());
    assert_eq!(trial.session.not_drawn(Layer::Branch), None);
}

#[test]
fn ratios_to_r_are_another_look_at_the_same_branch() {
    let mut trial = Trial::open("linear");
    trial.goes(&[
        (": axes D q_max/r", "label A_q/r"),
        ("N", "asked | label q_max"),
        ("N", "notice A_q/r: right turning point of the cycles, in units of r"),
    ]);
    let plot = trial.session.plot;
    // Over r, each point has its own friction.
    for (keys, own) in [("", false), ("X X X", true)] {
        trial.press(keys);
        let point = trial.branch(plot).pieces[0][1];
        let height = trial.session.height(plot, 0);
        let r = if own {
            point.value
        } else {
            trial.session.problem.parameters.r
        };
        assert_eq!(height.of(point.value, &point.cycle), point.cycle.q_max / r);
    }
    trial.goes(&[
        ("", "abscissa r"),
        ("Y Y Y Y Y N", "notice period is not a length and has no unit"),
        (
            ": axes D period/r",
            "refused ..no property \"period/r\"; there are q_max, q_max/r, q_min..",
        ),
        ("<esc>", ""),
        (": axes D size", "refused ..no property \"size\"; there are q_max.."),
    ]);
}

#[test]
fn rest_has_no_period_and_no_multiplier() {
    let mut trial = Trial::alone("supercritical");
    for (property, has_rest) in [("mean", true), ("period", false), ("multiplier", false)] {
        trial.press(&format!("<run \"axes D {property}\">"));
        let drawn = picture::of(&trial.session, 1);
        let rests = drawn.items.iter().filter(|item| match item {
            Item::Curve(line, _) | Item::Graph(line, _) | Item::Rows(line, ..) => {
                line.name.starts_with("rest")
            }
            _ => false,
        });
        assert_eq!(rests.count() > 0, has_rest, "{property}");
    }
}
