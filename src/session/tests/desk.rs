//! One to four plots, each with a view of its own, and what they ask together.

use super::Desk;
use crate::oscillator::Symbol;
use crate::scene::{Arrangement, Axes, Ordinate, Topic, View};
use crate::session::{Framing, Pane};

/// The views on show, a letter each, in capitals in focus.
fn views(desk: &Desk) -> String {
    let letter = |(index, view): (usize, View)| {
        let letter = view.spec().name.chars().next().unwrap_or(' ');
        let focused = desk.session.focus == Pane::Plot(index);
        if focused { letter.to_ascii_uppercase() } else { letter }
    };
    desk.session.plots.iter().map(|plot| plot.view).enumerate().map(letter).collect()
}

#[test]
fn plots_are_added_removed_moved_and_each_change_is_undone() {
    let mut desk = Desk::open("supercritical");
    let opened = desk.session.plots.clone();
    assert_eq!(views(&desk), "pd");
    let mut seen = vec![views(&desk)];
    for keys in ["<tab>", "M", "Q", "W", "V/diagram<enter>", "Z"] {
        desk.press(keys);
        seen.push(views(&desk));
    }
    assert_eq!(desk.session.history.depth(), (5, 0), "the focus is no change");
    assert_eq!(desk.session.arrangement, Arrangement::Columns);
    let mut changes = seen.iter().rev().skip(1).map(|views| views.to_lowercase());
    for _ in 0..5 {
        desk.press("u");
        assert_eq!(Some(views(&desk).to_lowercase()), changes.next());
    }
    assert_eq!(desk.session.arrangement, Arrangement::Auto);
    for (plot, before) in desk.session.plots.iter().zip(&opened) {
        assert_eq!((plot.view, plot.window, plot.axes), (before.view, before.window, before.axes));
    }
}

#[test]
fn there_are_one_to_four_plots() {
    let mut desk = Desk::open("supercritical");
    desk.press("W W W");
    assert_eq!(desk.session.plots.len(), 4);
    assert_eq!(desk.notice(), "there are 4 plots, and no more fit");
    desk.press("Q Q Q Q");
    assert_eq!((desk.session.plots.len(), desk.notice()), (1, "the last plot stays"));
}

#[test]
fn equal_questions_of_two_plots_are_one() {
    let mut desk = Desk::open("supercritical");
    // Another diagram like the first: its branch is known.
    desk.press("<tab>");
    assert_eq!(desk.press("; , ;"), []);
    let [first, second] = &desk.session.plots[..] else { panic!("two plots") };
    assert_eq!((first.view, first.axes), (second.view, second.axes));
    // A step of D3 computes both branches again: by one computation.
    assert_eq!(desk.press("<S-tab><down><right>"), [Topic::Branch]);
    assert!((0..2).all(|plot| desk.session.is_fresh(Topic::Branch, plot)));
    // Another ordinate is another look at the same cycles.
    assert_eq!(desk.press("<tab>Y Y Y Y Y"), []);
    assert_eq!(desk.session.plots[0].axes.ordinate, Ordinate::Period);
    assert_eq!(desk.press("<S-tab><left>"), [], "the way back is known");
}

#[test]
fn two_diagrams_over_different_axes_stand_side_by_side() {
    let mut desk = Desk::open("supercritical");
    desk.press("<tab>;");
    assert_eq!(desk.press("X"), [Topic::Branch]);
    let over = |desk: &Desk, plot: usize| {
        (desk.session.plots[plot].axes.abscissa, desk.branch(plot).parameter)
    };
    assert_eq!(over(&desk, 0), (Symbol::D2, Symbol::D2));
    assert_eq!(over(&desk, 1), (Symbol::D, Symbol::D));
    // D lies on the axis of one and goes into the branch of the other.
    assert_eq!(desk.press("<S-tab><right>"), [Topic::Branch]);
    assert_eq!(desk.press("<down><right>"), [Topic::Branch; 2]);
}

#[test]
fn a_plot_turned_to_a_view_shows_what_the_scene_does() {
    let mut desk = Desk::open("supercritical");
    desk.press("<tab><tab>Y<tab><tab>V/diagram<enter>");
    assert_eq!(desk.session.plots[0].axes, Axes::default(), "the scene's is on show no more");
    desk.press("<tab> Q V/diagram<enter>");
    let plot = &desk.session.plots[0];
    assert_eq!(plot.window, desk.session.scene.plots[1].opening());
    assert_eq!((plot.framing, plot.axes), (Framing::Scene, Axes::default()));
}

#[test]
fn the_hidden_plots_of_an_enlarged_one_ask_nothing() {
    let mut desk = Desk::open("supercritical");
    desk.press("<tab>W z");
    assert_eq!(desk.press("<S-tab><S-tab><down><right>").len(), desk.session.wants().len());
    assert_eq!(desk.session.on_show().len(), 1);
    desk.press("W");
    assert!(!desk.session.enlarged, "what is added is seen");
}
