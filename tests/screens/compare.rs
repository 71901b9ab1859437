//! A beside B: what differs of two states stands side by side, at every size and in every scene.

use super::by_hand::{open, settle_with};
use super::texts::{SIZES, pane};
use super::{all_pictures, braille, draw, settled};
use hopfscope::flow::Limits;
use hopfscope::question::answer;
use hopfscope::scene::{Request, library};
use hopfscope::session::{Msg, Session, update};
use hopfscope::view::screen::text;

#[test]
fn both_values_of_what_differs_stand_in_one_row_at_every_size_in_every_scene() {
    for scene in library() {
        for (width, height) in SIZES {
            let session = settled(&scene.name, width, height, "p <right> <right>");
            let pane = pane(&session);
            let case = format!("{} {width}x{height}\n{pane}", scene.name);
            assert!(pane.contains("parameters  of B"), "{case}");
            let mut rows = pane.lines().filter(|line| line.starts_with('▸'));
            let told = rows.find_map(|row| row.split_once(" A "));
            let (_, there) = told.unwrap_or_else(|| panic!("{case}"));
            let there = there.split(' ').next().unwrap().parse::<f64>().unwrap();
            let opened = session.marks.left.as_ref().unwrap();
            let value = session.value_in(opened, session.selected.stepped().unwrap());
            assert!((there - value).abs() <= 1e-3 * value.abs(), "{case}: {value}");
        }
    }
}

/// A session after these keys, with computed answers: the motions drawn by hand are all alike.
fn pressed(scene: &str, keys: &str) -> Session {
    let computed = |request: &Request| answer(request, &Limits::PATIENT).unwrap();
    let mut session = open(scene, 120, 40);
    settle_with(&mut session, computed);
    for key in keys.split(' ') {
        update(&mut session, Msg::Key(key.parse().unwrap()));
        settle_with(&mut session, computed);
    }
    session
}

#[test]
fn both_margins_and_both_motions_are_told_where_they_differ_and_once_where_not() {
    let told = |keys: &str| text(&draw(&pressed("supercritical", keys), braille()));
    assert!(
        told("p").contains(" margin from rest: shift 0.1247, impulse 0.1847;"),
        "{}",
        told("p")
    );
    let both = told("p <down> <down> <right>");
    let margins = "margin from rest: A shift 0.1247, impulse 0.1847; B 0.1388, 0.2052";
    assert!(both.contains(margins) && both.contains("parameters  of B"), "{both}");
    assert!(told("p <right> b").contains("parameters  of A"));
}

#[test]
fn lines_of_both_have_their_letters_and_lines_in_common_have_none() {
    let session = pressed("plain", "p <right>");
    let pictures = all_pictures(&session);
    let letters = |plot: usize| {
        let all = pictures[plot].captions.iter().map(|caption| caption.short.to_string());
        let mut all: Vec<String> = all.filter(|text| text == "A" || text == "B").collect();
        all.sort();
        all.dedup();
        all
    };
    assert_eq!([letters(0), letters(1)], [["A", "B"], ["A", "B"]]);
    assert!(pictures[0].items.iter().any(|item| {
        item.seen(pictures[0].window).is_some_and(|line| line.name.ends_with(", A"))
    }));
    let settled = settled("plain", 120, 40, "p <right> <esc>");
    let captions = all_pictures(&settled).into_iter().flat_map(|picture| picture.captions);
    assert!(captions.into_iter().all(|caption| caption.short != "A" && caption.short != "B"));
}
