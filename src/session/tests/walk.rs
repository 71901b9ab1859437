//! Walking along the made-up branch: unstable at 1.1, a fold at 1.5, stable at 3.1.

use super::Trial;
use crate::model::{Parameters, State};
use crate::scene::{Topic, View};
use crate::session::{BranchStop, Context};

fn held(trial: &Trial) -> BranchStop {
    trial.session.held.expect("a point is held")
}

#[test]
fn the_arrows_walk_along_the_branch_tab_jumps_and_esc_lets_go() {
    let mut trial = Trial::alone("supercritical");
    trial.goes(&[("<tab><tab>w<home>", "held 1.1")]);
    assert_eq!(trial.session.contexts()[0], Context::Walk);
    trial.goes(&[
        ("<right>", "held 1.5"),
        ("l", "held 3.1"),
        ("<right>", "held 3.1"),
        ("<down>", "held 1.5"),
        ("<home>", "held 1.1"),
        ("<S-right>", "held 3.1"),
        ("<right>", "notice the branch ends here.."),
        // Special points and ends, cycling.
        ("<home><tab>", "special Fold"),
        ("<tab>", "held 3.1"),
        ("<tab>", "held 1.1"),
        ("<S-tab><S-tab>", "special Fold"),
        ("<esc>", "held none | quit false"),
    ]);
    assert_eq!(trial.session.contexts()[0], Context::View(View::Diagram));
}

#[test]
fn enter_takes_the_point_into_the_phase_plane_as_one_change() {
    let mut trial = Trial::alone("supercritical");
    let before = trial.session.problem;
    trial.press("<tab><tab>w<home><tab><enter>");
    let taken = trial.session.problem;
    assert_eq!(taken.parameters.d, held(&trial).value);
    assert_eq!(taken.initial, State { q: 1.5, v: 0.0 });
    assert_eq!(trial.session.history.depth(), (1, 0));
    trial.press("u");
    assert_eq!(trial.session.problem, before);
    assert!(trial.session.held.is_some(), "the walk goes on");
}

#[test]
fn the_cursor_says_where_to_take_hold() {
    let mut trial = Trial::alone("supercritical");
    trial.press("<tab><tab><right>");
    trial.session.plots[1].cursor.as_mut().unwrap().y = 3.0;
    trial.goes(&[("<C-left*9> w", "held 3.1")]);
}

#[test]
fn there_must_be_a_branch_to_hold() {
    let mut trial = Trial::alone("supercritical");
    trial.press("<tab><tab> <run \"layer branch\"><run \"layer special\"> w");
    assert_eq!(trial.notice(), "the branch is not shown: v lists the layers");
    assert_eq!(trial.session.held, None);
    trial.press("<run \"layer branch\"> w<home>");
    assert!(trial.session.held.is_some());
    // Zooming recomputes the branch; the walk stays at a point of it.
    trial.press("+");
    let held = held(&trial);
    assert!(trial.branch(1).pieces.iter().flatten().any(|point| BranchStop::on(0, point) == held));
}

#[test]
fn of_variants_the_present_one_is_walked_first_and_each_brings_its_values() {
    // Three frictions; the first is the present one.
    let mut trial = Trial::open("fig16b");
    trial.press("<tab>w");
    assert_eq!(held(&trial).variant, 0);
    let mut seen = Vec::new();
    for _ in 0..9 {
        trial.press("<tab>");
        seen.push(held(&trial).variant);
    }
    assert!([0, 1, 2].iter().all(|variant| seen.contains(variant)), "{seen:?}");
    while held(&trial).variant != 2 {
        trial.press("<tab>");
    }
    trial.press("<enter>");
    let taken = trial.session.problem;
    assert_eq!((taken.parameters.r, taken.parameters.d), (0.3, held(&trial).value));
    assert_eq!(taken.initial.q, held(&trial).cycle.unwrap().q_max);
    assert!(trial.notice().contains(", r = 0.3, and the motion starts on its cycle"));
    assert_eq!(trial.session.history.depth(), (1, 0));
}

#[test]
fn another_scene_takes_the_hold_away() {
    let mut trial = Trial::alone("supercritical");
    // Undo opens the previous scene.
    trial.goes(&[("s/basin<enter> <tab><tab>w<home>", "held 2"), ("u", "held none")]);
}

#[test]
fn a_level_curve_is_drawn_by_a_line_walked_and_removed_by_the_same_line() {
    let mut trial = Trial::open("regimes");
    let asked = trial.press("<run \"level impulse=0.3\">");
    assert_eq!(asked, [Topic::Level]);
    assert_eq!(trial.session.levels.len(), 1);
    trial.press("<tab>w<home>");
    let corner = held(&trial);
    let window = trial.session.plots[0].window;
    assert_eq!((corner.value, corner.up), (window.x.from(), Some(window.y.from())));
    let before = trial.session.problem;
    trial.press("<end><enter>");
    let Parameters { d, d3, .. } = trial.session.problem.parameters;
    assert_eq!((d, Some(d3)), (held(&trial).value, held(&trial).up));
    assert!(held(&trial).value > corner.value);
    trial.press("u");
    assert_eq!(trial.session.problem, before);
    assert_eq!(trial.press("<esc><run \"level impulse=0.3\">"), []);
    assert_eq!(trial.session.levels, []);
}

#[test]
fn level_curves_need_a_column_and_a_plot_over_two_numbers() {
    let mut trial = Trial::open("regimes");
    for (line, words) in [
        ("level impuls=1", "there is no column \"impuls\""),
        ("level impulse", "expected COLUMN=VALUE"),
        ("level regime=1", "there is no column \"regime\""),
        ("level D_F=1", "fold does not depend on D"),
        ("level impulse=900", "no curve impulse=900: impulse is 0 .. 1 on it"),
    ] {
        trial.press(&format!("<run \"{line}\">"));
        assert!(trial.notice().contains(words), "{}", trial.notice());
    }
    let mut trial = Trial::open("plain");
    trial.press("<run \"level impulse=0.3\">");
    assert!(trial.notice().contains("in a chart of regimes"), "{}", trial.notice());
    assert_eq!(trial.session.levels, []);
}
