//! What each view asks, and what can be taken from it into the phase plane.

use super::Trial;
use crate::flow::Method;
use crate::oscillator::{State, Symbol};
use crate::scene::{LAYERS, Request, Topic, VIEWS, View};
use crate::session::{Context, Pane};
use crate::study::claims::claims;

/// A scene with one plot, turned to a view.
fn turned_to(view: &str) -> Trial {
    let mut trial = Trial::alone("supercritical");
    trial.press(&format!("<tab>Q :view<space>{view}<enter>"));
    assert_eq!(trial.session.plots.len(), 1);
    trial
}

#[test]
fn a_view_asks_what_its_layers_need_and_a_step_asks_that_again() {
    for (view, needs, on_q0) in [
        ("phase", &[Topic::Trajectory, Topic::Cycles][..], &[Topic::Trajectory][..]),
        ("diagram", &[Topic::Branch], &[]),
        ("time-series", &[Topic::Trajectory], &[Topic::Trajectory]),
        ("energy-ledger", &[Topic::Trajectory, Topic::Cycles], &[Topic::Trajectory]),
        ("return-map", &[Topic::Trajectory, Topic::Cycles, Topic::ReturnMap], &[Topic::Trajectory]),
        ("regimes", &[Topic::Regimes], &[]),
        ("trade", &[Topic::Trade], &[Topic::Trade]),
    ] {
        let mut trial = turned_to(view);
        let mut wanted: Vec<Topic> = trial.session.wants().iter().map(Request::topic).collect();
        // Where cycles are shown their proof is asked, last.
        assert!(!needs.contains(&Topic::Cycles) || wanted.pop() == Some(Topic::Proof), "{view}");
        assert_eq!(wanted, needs, "{view}");
        assert_eq!(trial.press("<S-tab><down*3><right>"), on_q0, "q0 in {view}");
        assert_eq!(trial.press("<up><right>"), needs, "r in {view}");
    }
}

#[test]
fn the_parameters_of_a_chart_move_its_point_and_nothing_else() {
    let mut trial = turned_to("regimes");
    trial.press("<S-tab>");
    assert_eq!(trial.press("<right*3>"), [], "D");
    assert_eq!(trial.press("<down><right>"), [], "D3");
    assert_eq!(trial.press("<down><right>"), [Topic::Regimes], "r");
    assert_eq!(trial.press("<tab>Y"), [Topic::Regimes], "D over r");
    let axes = trial.session.plots[0].axes;
    assert_eq!((axes.abscissa, axes.against), (Symbol::D, Symbol::R));
    assert_eq!(trial.press("X"), [Topic::Regimes]);
    assert_eq!(trial.session.plots[0].axes.abscissa, Symbol::D2, "r stands upwards already");
    assert_eq!(trial.press("<run \"layer regimes\"><run \"layer borders\">"), []);
    assert_eq!(trial.press("L"), [], "a chart that is not shown is not computed");
}

#[test]
fn enter_on_a_chart_takes_both_parameters_as_one_change() {
    let mut trial = turned_to("regimes");
    let before = trial.session.problem.parameters;
    trial.press("<left*5><up*3><enter>");
    let (after, cursor) =
        (trial.session.problem.parameters, trial.session.plots[0].cursor.unwrap());
    assert_eq!((after.d, after.d3), (cursor.x, cursor.y));
    assert!(after.d < before.d && after.d3 > before.d3);
    trial.press("u");
    assert_eq!(trial.session.problem.parameters, before);
}

#[test]
fn views_of_the_same_answers_cost_nothing() {
    let mut trial = Trial::alone("supercritical");
    assert_eq!(trial.press("<tab>V/energy<enter>"), [], "the cycles have their works");
    assert_eq!(trial.press("V/time<enter>"), []);
    assert_eq!(trial.press("v f n e p t <esc>"), []);
    assert_eq!(
        trial.press("V/return<enter>"),
        [Topic::ReturnMap],
        "once, when its window is known"
    );
    assert_eq!(trial.press("<run \"layer map\">"), []);
    assert_eq!(trial.press("L"), [], "a map that is not shown is not computed");
    assert_eq!(trial.press("<run \"layer map\">"), [Topic::ReturnMap]);
}

#[test]
fn every_view_has_its_keys_and_can_be_looked_around_in() {
    // In a scan one walks over its points instead.
    for row in VIEWS.iter().filter(|row| row.view != View::Scan) {
        let mut trial = turned_to(row.name);
        assert_eq!(trial.session.focus, Pane::Plot(0));
        assert_eq!(trial.session.contexts()[1], Context::Plots);
        let before = trial.session.plots[0].window;
        trial.press("<right> + L");
        assert_ne!(trial.session.plots[0].window, before);
        assert!(trial.session.plots[0].cursor.is_some());
        trial.press("0 <home>");
    }
}

#[test]
fn enter_takes_the_point_under_the_cursor_into_the_phase_plane() {
    let initial = |view: &str, keys: &str| {
        let mut trial = turned_to(view);
        trial.press("W");
        assert_eq!(trial.session.plots[1].view, View::Phase);
        trial.press("<S-tab>");
        trial.press(keys);
        trial.session.problem.initial
    };
    let opened = Trial::alone("supercritical").session.problem.initial;
    // By hand the motion stays where it starts, and the unstable cycle turns at r + 1 = 1.1.
    assert_eq!(initial("time-series", "<right*5><enter>"), opened);
    assert_eq!(initial("energy-ledger", "<down><enter>"), State { q: 1.1, v: 0.0 });
    assert_eq!(initial("return-map", "<right*4><enter>").v, 0.0);
    assert_ne!(initial("return-map", "<right*4><enter>"), opened);
}

#[test]
fn a_view_that_the_scene_does_not_know_opens_with_its_usual_layers() {
    // A scan is asked for by its form, not by layers; a view whose layers formulas draw asks nothing.
    for row in VIEWS.iter().filter(|row| row.view != View::Scan) {
        let trial = turned_to(row.name);
        let shown = trial.session.layers.iter().any(|layer| trial.session.shows_in(*layer, 0));
        assert!(shown, "{}", row.name);
        let mut usual = LAYERS.iter().filter(|layer| layer.view == row.view && layer.usual);
        let asks = usual.any(|layer| layer.needs.is_some());
        assert_eq!(!trial.session.needs(0).is_empty(), asks, "{}", row.name);
    }
    // What is on stays as it is.
    let mut trial = turned_to("time-series");
    trial.press("<run \"layer position\"><run \"layer events\">");
    let layers = trial.session.layers.clone();
    trial.press(", ;");
    assert_eq!(trial.session.layers, layers);
}

#[test]
fn the_trade_is_asked_for_the_motion_and_not_for_the_method_that_computes_it() {
    let mut trial = turned_to("trade");
    assert_eq!(trial.session.needs(0).into_iter().collect::<Vec<_>>(), [Topic::Trade]);
    // The dial and the method are no inputs; every number of the motion is.
    assert_eq!(trial.press("} m {"), []);
    assert_eq!(trial.press("<S-tab><down*3><right>"), [Topic::Trade]);
    // Enter takes the method and the accuracy of the nearest row.
    trial.press("<tab><enter>");
    assert_eq!(trial.notice(), "no cursor yet: <left>, <up> and so on show it");
    trial.press("<right*200> <down*200> <enter>");
    let problem = trial.session.problem;
    assert_eq!((problem.method, problem.tolerance), (Method::Dop853, 1e-12));
    trial.press("<left*200> <up*200> <enter>");
    let problem = trial.session.problem;
    assert_eq!((problem.method, problem.tolerance), (Method::Taylor, 1e-4));
}

#[test]
fn the_claims_of_the_paper_are_examined_once_when_they_are_first_looked_at() {
    let mut trial = Trial::open("plain");
    assert_eq!(trial.press("<f10>"), [Topic::Claims]);
    assert_eq!(trial.press("<esc><f10>"), [], "they do not change");
    trial.press("/(33)<enter><enter>");
    assert_eq!(trial.session.overlay, None);
    let claim = claims().find(|claim| claim.equation == "(33)").unwrap();
    assert_eq!(Some(trial.session.scene.name.as_str()), claim.scene);
    assert!(!trial.press("<right>").contains(&Topic::Claims), "hidden they cost nothing");
}
