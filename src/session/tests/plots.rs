//! Cursor, zoom, pan and fit; starts beside the cycle.

use super::Trial;
use crate::model::State;
use crate::portrait::{Border, Drawing, Margin};
use crate::scene::{Finding, Point, Span, Topic, Window};
use crate::session::{Framing, VariantTag};

#[test]
fn the_cursor_moves_on_round_numbers_and_sets_the_start() {
    Trial::open("plain").goes(&[
        // A 64th of the width 4 is close to 0.05.
        ("<tab><right>", "cursor 1.05 0"),
        ("k k h <C-left>", "cursor 0.6 0.1"),
        ("<enter>", "q0 0.6 | v0 0.1"),
        ("<esc>", "cursor none | quit false"),
        ("<enter>", "notice no cursor yet: left, up and so on show it"),
    ]);
}

#[test]
fn the_cursor_stays_inside_its_window() {
    for keys in ["<right*500>", "<C-right*99>", "<left*500>", "<up*99>", "<C-down*99>"] {
        let mut trial = Trial::open("plain");
        trial.press("<tab>+L");
        trial.press(keys);
        let plot = &trial.session.plots[0];
        assert!(plot.window.contains(plot.cursor.unwrap()), "{keys}");
    }
}

#[test]
fn the_diagram_is_jumped_to_and_knows_its_limits() {
    let mut trial = Trial::open("plain");
    trial.goes(&[("<tab><tab><left*3><enter>", "focus 1 diagram | D -0.13")]);
    trial.session.plots[1].axes.abscissa = crate::model::Knob::R;
    trial.session.plots[1].cursor = Some(Point { x: -0.2, y: 1.0 });
    trial.goes(&[("<enter>", "notice r = -0.2 is outside its range..")]);
}

#[test]
fn a_diagram_outside_the_range_of_its_parameter_asks_nothing() {
    let mut trial = Trial::open("plain");
    trial.session.plots[1].axes.abscissa = crate::model::Knob::R;
    trial.session.plots[1].window.x = Span::new(-2.0, -1.0).unwrap();
    assert_eq!(trial.session.request(crate::scene::Topic::Branch, 1), None);
    assert_eq!(trial.session.wants().len(), 3, "the motion, the cycles and their proof");
}

#[test]
fn zoom_keeps_the_cursor_in_place_and_home_undoes_it() {
    let mut trial = Trial::open("plain");
    trial.press("<tab><right*4><up*4>");
    let before = trial.session.plots[0].clone();
    let cursor = before.cursor.unwrap();
    trial.press("++");
    let after = &trial.session.plots[0];
    assert_eq!((after.cursor, after.framing), (Some(cursor), Framing::User));
    assert!(after.window.x.width() < before.window.x.width());
    let place = |window: Window| (window.x.fraction(cursor.x), window.y.fraction(cursor.y));
    assert!((place(after.window).0 - place(before.window).0).abs() < 1e-12);
    assert!((place(after.window).1 - place(before.window).1).abs() < 1e-12);
    trial.press("L K <home>");
    assert_eq!(
        (trial.session.plots[0].window, trial.session.plots[0].framing),
        (before.window, Framing::Scene)
    );
}

#[test]
fn fit_shows_all_that_is_computed() {
    let mut trial = Trial::open("supercritical");
    trial.press("<tab>0");
    let window = trial.session.plots[0].window;
    assert_eq!(trial.session.plots[0].framing, Framing::Fitted);
    // In the made-up answer, the stable cycle reaches r + 3 in every direction.
    assert!(window.contains(Point { x: 3.1, y: -3.1 }) && window.x.to() < 3.5);
    trial.press("<tab>0");
    assert_eq!(trial.session.plots[1].framing, Framing::Fitted);
    assert!(trial.session.plots[1].window.y.contains(3.1));
    assert_eq!(trial.session.plots[1].window.x, trial.session.scene.plots[1].opening().x);
}

#[test]
fn fit_shows_every_variant_and_not_the_motion_that_none_of_them_is() {
    for (scene, index) in [("fig15", 1), ("fig13", 2), ("fig05", 1), ("fig16", 1), ("fig17", 3)] {
        let mut trial = Trial::open(scene);
        let variants = trial.session.variants(index).expect("variants").len();
        // A far start is not on show where the variants hold another one.
        let held = trial.session.shown(index).iter().all(|shown| shown.problem.initial.q != 1.2);
        trial.press(&format!("{} 0", "<tab>".repeat(index + 1)));
        assert_eq!(trial.session.plots[index].framing, Framing::Fitted, "{scene}");
        let window = trial.session.plots[index].window;
        let mut seen = Vec::new();
        let found = trial.session.found(Topic::Cycles, index, Finding::try_as_cycles_ref);
        for (VariantTag { label, .. }, (found, _)) in found {
            for cycle in &found.cycles {
                let corners = [(cycle.q_min, cycle.v_min), (cycle.q_max, cycle.v_max)];
                for (x, y) in corners {
                    assert!(window.contains(Point { x, y }), "{scene} {label}: {x}, {y}");
                    seen.push(x.abs());
                }
            }
        }
        let branches = trial.session.branches(index);
        for point in branches.iter().flat_map(|(_, branch)| branch.pieces.iter().flatten()) {
            let height = trial.session.height(index, 0).of(point.value, &point.cycle);
            assert!(window.y.contains(height), "{scene}: {height}");
            seen.push(height.abs());
        }
        assert!(seen.len() >= 2 * variants, "{scene}: every variant has cycles");
        let farthest = seen.into_iter().fold(0.0, f64::max);
        let ends = [window.x.to(), window.y.to()];
        assert!(!held || ends.into_iter().any(|end| end < 1.5 * farthest), "{scene}: {window:?}");
    }
}

#[test]
fn the_motion_starts_on_either_side_of_the_unstable_cycle() {
    // In the made-up answer, the unstable cycle has clearance 1.
    Trial::open("supercritical").goes(&[
        ("<tab><up><enter> i", "r 0.1 | q0 1.05 | v0 0"),
        ("o", "q0 1.15 | v0 0"),
        ("u", "q0 1.05 | v0 0"),
        ("<run \"layer cycles\"><run \"layer basin\"> <S-tab><right> i", "q0 1.05 | v0 0"),
    ]);
}

/// The answered cycles.
fn cycles(trial: &mut Trial) -> &mut Drawing {
    let mut cycles = trial.session.answers.each().filter_map(|held| match &mut held.result {
        Ok(Finding::Cycles(found, _)) => Some(found),
        _ => None,
    });
    cycles.next().unwrap()
}

#[test]
fn a_separatrix_has_two_sides_too() {
    for (d2, sign) in [(0.5, 1.0), (-0.5, -1.0)] {
        let mut trial = Trial::open("escape");
        let found = cycles(&mut trial);
        found.parameters.d2 = d2;
        found.portrait.border = Border::Separatrix;
        found.cycles.clear();
        found.margin = Margin { displacement: Some(1.1), impulse: Some(1.4), ..Margin::ENDLESS };
        // r is 0.1, and the clearance is 1.
        trial.press("i");
        assert_eq!(trial.session.problem.initial, State { q: sign * 1.05, v: 0.0 });
        trial.press("o");
        assert_eq!(trial.session.problem.initial, State { q: sign * 1.15, v: 0.0 });
    }
}

#[test]
fn a_cycle_close_to_the_sticking_set_still_has_two_sides() {
    let mut trial = Trial::open("linear");
    for clearance in [0.5, 1e-9, 1e-14, 3e-16, 1e-16, 6.5e-31, 5e-324] {
        let found = cycles(&mut trial);
        found.cycles[0].clearance = clearance;
        trial.press("i");
        let inside = trial.session.problem.initial.q;
        trial.press("o");
        let outside = trial.session.problem.initial.q;
        // r is 1 here, and differences close to it are exact.
        assert!((0.0..clearance).contains(&(inside - 1.0)), "{inside:?} inside of {clearance:e}");
        assert!(outside - 1.0 > clearance, "{outside:?} outside of {clearance:e}");
    }
}
