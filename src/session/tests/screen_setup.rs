//! One to four plots, each with its own view, and what they ask together.

use super::Trial;
use crate::model::Knob;
use crate::scene::{Arrangement, Axes, Ordinate, Topic, View};
use crate::session::{Framing, Pane};

/// The views on show by their first letters, with a capital for the one in focus.
fn views(trial: &Trial) -> String {
    let letter = |(index, view): (usize, View)| {
        let letter = view.spec().name.chars().next().unwrap_or(' ');
        let focused = trial.session.focus == Pane::Plot(index);
        if focused { letter.to_ascii_uppercase() } else { letter }
    };
    trial.session.plots.iter().map(|plot| plot.view).enumerate().map(letter).collect()
}

#[test]
fn plots_are_added_removed_moved_and_each_change_is_undone() {
    let mut trial = Trial::alone("supercritical");
    let opened = trial.session.plots.clone();
    assert_eq!(views(&trial), "pd");
    let mut seen = vec![views(&trial)];
    for keys in ["<tab>", "M", "Q", "W", "V/diagram<enter>", "Z"] {
        trial.press(keys);
        seen.push(views(&trial));
    }
    assert_eq!(trial.session.history.depth(), (5, 0), "the focus is no change");
    assert_eq!(trial.session.arrangement, Arrangement::Columns);
    let mut changes = seen.iter().rev().skip(1).map(|views| views.to_lowercase());
    for _ in 0..5 {
        trial.press("u");
        assert_eq!(Some(views(&trial).to_lowercase()), changes.next());
    }
    assert_eq!(trial.session.arrangement, Arrangement::Auto);
    for (plot, before) in trial.session.plots.iter().zip(&opened) {
        assert_eq!((plot.view, plot.window, plot.axes), (before.view, before.window, before.axes));
    }
}

#[test]
fn there_are_one_to_four_plots() {
    Trial::alone("supercritical").goes(&[
        ("W W W", "plots 4 | notice there are 4 plots already; no more fit"),
        ("Q Q Q Q", "plots 1 | notice the last plot cannot be removed"),
    ]);
}

#[test]
fn equal_questions_of_two_plots_are_one() {
    let mut trial = Trial::alone("supercritical");
    // A second diagram with the same axes: its branch is known.
    trial.press("<tab>");
    assert_eq!(trial.press("; , ;"), []);
    let [first, second] = &trial.session.plots[..] else { panic!("two plots") };
    assert_eq!((first.view, first.axes), (second.view, second.axes));
    // A step of D3 recomputes both branches in one computation.
    assert_eq!(trial.press("<S-tab><down><right>"), [Topic::Branch]);
    assert!((0..2).all(|plot| trial.session.is_fresh(Topic::Branch, plot)));
    // Another ordinate needs no other branch.
    assert_eq!(trial.press("<tab>Y Y Y Y Y"), []);
    assert_eq!(trial.session.plots[0].axes.ordinate, Ordinate::Period);
    assert_eq!(trial.press("<S-tab><left>"), [], "the way back is known");
}

#[test]
fn two_diagrams_over_different_axes_stand_side_by_side() {
    let mut trial = Trial::alone("supercritical");
    trial.goes(&[("<tab>;", ""), ("X", "asked Branch")]);
    for (plot, over) in [(0, Knob::D2), (1, Knob::D)] {
        assert_eq!(trial.session.plots[plot].axes.abscissa, over);
        assert_eq!(trial.branch(plot).parameter, over);
    }
    // D is the abscissa of one diagram and an input of the other's branch.
    trial.goes(&[("<S-tab><right>", "asked Branch"), ("<down><right>", "asked Branch Branch")]);
}

#[test]
fn a_plot_turned_to_a_view_shows_what_the_scene_does() {
    let mut trial = Trial::alone("supercritical");
    trial.press("<tab><tab>Y<tab><tab>V/diagram<enter>");
    assert_eq!(trial.session.plots[0].axes, Axes::default(), "the scene's is on show no more");
    trial.press("<tab> Q V/diagram<enter>");
    let plot = &trial.session.plots[0];
    assert_eq!(plot.window, trial.session.scene.plots[1].opening());
    assert_eq!((plot.framing, plot.axes), (Framing::Scene, Axes::default()));
}

#[test]
fn the_hidden_plots_of_an_enlarged_one_ask_nothing() {
    let mut trial = Trial::alone("supercritical");
    trial.press("<tab>W z");
    let asked = trial.press("<S-tab><S-tab><down><right>");
    assert_eq!(asked.len() + 1, trial.session.wants().len(), "and a proof");
    assert_eq!(trial.session.on_show().len(), 1);
    trial.press("W");
    assert!(!trial.session.enlarged, "what is added is seen");
}

#[test]
fn no_list_puts_a_view_that_can_show_nothing_in_place_of_a_plot() {
    let mut trial = Trial::alone("supercritical");
    let opened = trial.session.plots.clone();
    trial.goes(&[
        ("V/damping<enter>", "notice damping needs a recorded motion: :fit FILE opens one"),
        ("V/speeds<enter>", "notice belt diagram needs a machine: :belt clutch opens one"),
        ("V/residuals<enter>", "notice residuals needs a recorded motion: .."),
        ("V/margin<enter>", "notice margin distribution needs a recorded motion: .."),
        ("V/scan<enter>", "notice scan needs a scan: % opens the line for one"),
    ]);
    assert_eq!((&trial.session.plots, trial.session.history.depth()), (&opened, (0, 0)));
    for key in [";", ",", "W"] {
        for _ in 0..20 {
            trial.press(key);
            let shown = trial.session.plots.iter().map(|plot| plot.view);
            assert!(shown.into_iter().all(|view| trial.session.lacks(view).is_none()), "{key}");
        }
    }
    // What is typed by its name is done.
    trial.goes(&[(":view<space>damping<enter>", "notice damping: ..")]);
    assert_eq!(
        trial.session.lacks(View::Damping),
        trial.session.nothing(trial.session.plot).as_deref()
    );
    // A machine gives what the speeds of its belt need.
    trial.goes(&[(":belt<space>clutch<enter><tab>V/speeds<enter>", "notice belt diagram: ..")]);
}
