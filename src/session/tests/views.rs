//! The questions of each view, and what can be taken from it into the phase plane.

use super::Trial;
use crate::model::{Knob, State};
use crate::paper::claims;
use crate::scene::{LAYERS, Request, Topic, VIEWS, View};
use crate::session::{Context, Pane};

/// A scene with a single plot, which shows a view.
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
        // Where cycles are shown, their proof is asked last.
        assert!(!needs.contains(&Topic::Cycles) || wanted.pop() == Some(Topic::Proof), "{view}");
        assert_eq!(wanted, needs, "{view}");
        assert_eq!(trial.press("<S-tab><down*3><right>"), on_q0, "q0 in {view}");
        assert_eq!(trial.press("<up><right>"), needs, "r in {view}");
    }
}

#[test]
fn the_parameters_of_a_chart_move_its_point_and_nothing_else() {
    let mut trial = turned_to("regimes");
    trial.goes(&[
        ("<S-tab>", ""),
        ("<right*3>", "asked"),                   // D
        ("<down><right>", "asked"),               // D3
        ("<down><right>", "asked Regimes"),       // r
        ("<tab>Y", "asked Regimes | abscissa D"), // D over r
    ]);
    assert_eq!(trial.session.plots[0].axes.against, Knob::R);
    trial.goes(&[
        // r is already the upward axis.
        ("X", "asked Regimes | abscissa D2"),
        ("<run \"layer regimes\"><run \"layer borders\">", "asked"),
        // A hidden chart is not computed.
        ("L", "asked"),
    ]);
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
    Trial::alone("supercritical").goes(&[
        // The cycles come with their works.
        ("<tab>V/energy<enter>", "asked"),
        ("V/time<enter>", "asked"),
        ("v f n e p t <esc>", "asked"),
        // Asked once, when the window is known.
        ("V/return<enter>", "asked ReturnMap"),
        ("<run \"layer map\">", "asked"),
        // A hidden map is not computed.
        ("L", "asked"),
        ("<run \"layer map\">", "asked ReturnMap"),
    ]);
}

#[test]
fn every_view_has_its_keys_and_can_be_looked_around_in() {
    // In the view of a scan, arrows move over its points instead.
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
    // In the made-up answers, the motion stays at its start, and the unstable cycle turns at r + 1 = 1.1.
    assert_eq!(initial("time-series", "<right*5><enter>"), opened);
    assert_eq!(initial("energy-ledger", "<down><enter>"), State { q: 1.1, v: 0.0 });
    assert_eq!(initial("return-map", "<right*4><enter>").v, 0.0);
    assert_ne!(initial("return-map", "<right*4><enter>"), opened);
}

#[test]
fn a_view_that_the_scene_does_not_know_opens_with_its_usual_layers() {
    // A scan is asked for by its form, not by layers; a view whose layers are drawn by formulas asks nothing.
    for row in VIEWS.iter().filter(|row| row.view != View::Scan) {
        let trial = turned_to(row.name);
        let shown = trial.session.layers.iter().any(|layer| trial.session.shows_in(*layer, 0));
        assert!(shown, "{}", row.name);
        let mut usual = LAYERS.iter().filter(|layer| layer.view == row.view && layer.usual);
        let asks = usual.any(|layer| layer.needs.is_some());
        assert_eq!(!trial.session.needs(0).is_empty(), asks, "{}", row.name);
    }
    // Layers that are on stay as they are.
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
    trial.goes(&[
        // The present accuracy and method are no inputs; every number of the motion is one.
        ("} m {", "asked"),
        ("<S-tab><down*3><right>", "asked Trade"),
        // Enter selects the method and the accuracy of the nearest row.
        ("<tab><enter>", "notice no cursor yet: left, up and so on show it"),
        ("<right*200> <down*200> <enter>", "method dop853 | tolerance 1e-12"),
        ("<left*200> <up*200> <enter>", "method taylor | tolerance 0.0001"),
    ]);
}

#[test]
fn the_claims_of_the_paper_are_examined_once_when_they_are_first_looked_at() {
    let claim = claims().find(|claim| claim.equation == "(33)").unwrap();
    let scene = format!("open none | scene {}", claim.scene.unwrap());
    Trial::open("plain").goes(&[
        ("<A-p>", "asked Claims"),
        // The claims do not change, and cost nothing while hidden.
        ("<esc><f10>", "asked"),
        ("/(33)<enter><enter>", &scene),
        ("<right>", "asked"),
    ]);
}
