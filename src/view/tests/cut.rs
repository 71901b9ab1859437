//! No row of any screen is cut without a sign.

use std::collections::BTreeSet;

use super::by_hand::{press, settle};
use super::{braille, draw};
use crate::picture::items::{Item, Marks};
use crate::scene::library::{find, library};
use crate::scene::{LAYERS, VIEWS};
use crate::session::{Session, Size};
use crate::view::screen::text;

/// A screen on which everything has room.
const WIDEST: Size = Size { width: 320, height: 110 };

/// Screens that people have.
const SIZES: [(u16, u16); 7] =
    [(60, 16), (72, 20), (80, 24), (100, 30), (120, 40), (160, 48), (200, 60)];

/// What stands on narrow screens in place of longer words.
const SHORT: [&str; 5] = ["ev", "of", "more", "says", "what"];

/// The words of a text, each with whether a mark follows that says that it is cut.
fn words(text: &str) -> Vec<(String, bool)> {
    let mut found = Vec::new();
    let mut word = String::new();
    for letter in text.chars().chain([' ']) {
        if letter.is_alphabetic() || (letter == '-' && !word.is_empty()) {
            word.push(letter);
        } else {
            if word.chars().count() > 1 {
                found.push((word.trim_end_matches('-').to_owned(), letter == '\u{2026}'));
            }
            word.clear();
        }
    }
    found
}

/// Every word that belongs on the screens of a session.
fn known(session: &Session) -> BTreeSet<String> {
    let mut widest = session.clone();
    widest.size = WIDEST;
    let mut texts = vec![text(&draw(&widest, braille()))];
    for index in 0..session.plots.len() {
        let picture = crate::picture::of(session, index);
        for item in &picture.items {
            match item {
                Item::Caption { long, short, .. } => {
                    texts.extend([long.to_string(), short.to_string()]);
                }
                Item::Marks(Marks { brief, .. }) => texts.push((*brief).to_owned()),
                _ => {}
            }
        }
        texts.extend([picture.title.to_string(), picture.x.to_string(), picture.y.to_string()]);
    }
    texts.extend(
        crate::picture::legend::entries(
            &(0..session.plots.len())
                .map(|index| crate::picture::of(session, index))
                .collect::<Vec<_>>(),
        )
        .into_iter()
        .map(|entry| entry.text),
    );
    let known = texts.iter().flat_map(|text| words(text)).map(|(word, _)| word);
    known.chain(SHORT.map(str::to_owned)).collect()
}

/// Rows of a scene, after these keys, with parts of words.
fn cut(name: &str, keys: &str) -> Vec<String> {
    let mut session = Session::new(find(name).unwrap(), WIDEST);
    settle(&mut session);
    press(&mut session, keys);
    let known = known(&session);
    let mut found = Vec::new();
    for (width, height) in SIZES {
        session.size = Size { width, height };
        let screen = text(&draw(&session, braille()));
        for row in screen.lines() {
            let parts = words(row).into_iter();
            let mut parts = parts.filter(|(word, marked)| !marked && !known.contains(word));
            if let Some((part, _)) = parts.next() {
                found.push(format!("{name} [{keys}] at {width}x{height}: {part:?} in\n{row}"));
            }
        }
    }
    found
}

#[test]
fn words_know_whether_they_are_cut() {
    let expected = [("edge", false), ("stick-slip", false), ("unst", true)];
    let expected = expected.map(|(word, marked)| (word.to_owned(), marked));
    assert_eq!(words("edge: 3 stick-slip - a unst\u{2026}"), expected);
}

#[test]
fn no_row_of_any_screen_is_cut_without_a_sign() {
    let mut found = Vec::new();
    for scene in library() {
        for keys in ["", "!"] {
            found.extend(cut(&scene.name, keys));
        }
    }
    for view in VIEWS {
        let name: Vec<String> = view.name.chars().map(String::from).collect();
        found.extend(cut("supercritical", &format!("<tab> Q V / {} <enter>", name.join(" "))));
    }
    for keys in ["?", "s", "v", "V", "$", "%", "% <enter>", "% <enter> z t", "}", ":", "<enter>"] {
        found.extend(cut("supercritical", keys));
    }
    assert!(found.is_empty(), "{} rows are cut:\n{}", found.len(), found.join("\n"));
    assert!(LAYERS.len() > 20);
}

/// At the sizes at which the side pane has texts, what to look at and what to press stand there whole.
#[test]
fn no_text_beside_the_plots_is_cut() {
    let mut found = Vec::new();
    for scene in library() {
        for (width, height, pane) in [(120, 40, 34), (160, 48, 52), (200, 60, 52)] {
            let mut session = Session::new(scene.clone(), Size { width, height });
            settle(&mut session);
            let screen = text(&draw(&session, braille()));
            let rows = screen.lines().map(|row| row.chars().take(pane).collect::<String>());
            let rows: Vec<String> = rows.collect();
            // Where the first tells of most, the second may make way for a key.
            let whole = scene.name == "benchmark" && width < 160
                || !rows.iter().any(|row| row.contains("! says what"));
            if !whole || rows.iter().any(|row| row.contains('\u{2026}')) {
                found.push(format!("{} at {width}x{height}:\n{}", scene.name, rows.join("\n")));
            }
        }
    }
    assert!(found.is_empty(), "{} texts are cut:\n{}", found.len(), found.join("\n"));
}
