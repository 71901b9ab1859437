//! No number on any screen is a part of another one.

use std::collections::BTreeSet;

use ratatui::layout::Rect;

use super::by_hand::{press, settle};
use super::{braille, draw, letters};
use crate::picture::items::Item;
use crate::picture::ticks::{Scale, Ticks};
use crate::scene::library::{find, library};
use crate::scene::{Span, VIEWS};
use crate::session::{Session, Size};
use crate::view::layout::layout;
use crate::view::plot::shown;
use crate::view::screen::text;
use crate::words::number::significant;

/// A screen on which everything has room.
const WIDEST: Size = Size { width: 320, height: 110 };

/// Screens that people have.
const SIZES: [(u16, u16); 11] = [
    (60, 16),
    (67, 18),
    (72, 20),
    (80, 24),
    (91, 26),
    (100, 30),
    (110, 32),
    (120, 40),
    (139, 36),
    (160, 48),
    (200, 60),
];

/// The numbers in a text, each as far as its letters go.
fn numbers(text: &str) -> BTreeSet<String> {
    let letters: Vec<char> = text.chars().chain([' ']).collect();
    let mut found = BTreeSet::new();
    let mut at = 0;
    while at < letters.len() {
        if !letters[at].is_ascii_digit() {
            at += 1;
            continue;
        }
        // Where there is no sign for plus or minus it is written as two.
        let minus = at > 0 && letters[at - 1] == '-' && (at < 2 || letters[at - 2] != '+');
        let start = if minus { at - 1 } else { at };
        let digit = |at: usize| letters[at].is_ascii_digit();
        while digit(at) || (letters[at] == '.' && digit(at + 1)) {
            at += 1;
        }
        let sign = usize::from(letters[at] == 'e' && letters[at + 1] == '-');
        if letters[at] == 'e' && digit(at + 1 + sign) {
            at += 1 + sign;
            while digit(at) {
                at += 1;
            }
        }
        found.insert(letters[start..at].iter().collect());
    }
    found
}

/// All labels that an axis can have.
fn labels(scale: Scale, axis: Span) -> String {
    let with = |most: usize| Ticks::on(scale, axis, |ticks| ticks.len() <= most);
    let labels = (1..60).flat_map(|most| with(most).ticks).map(|tick| tick.label);
    labels.collect::<Vec<_>>().join(" ")
}

/// Every number that belongs on the screens of a session, whatever their size.
fn known(session: &Session) -> BTreeSet<String> {
    let mut widest = session.clone();
    widest.size = WIDEST;
    let mut known = numbers(&text(&draw(&widest, braille())));
    for index in 0..session.plots.len() {
        for item in &crate::picture::of(session, index).items {
            if let Item::Caption { long, .. } = item {
                known.extend(numbers(long));
            }
        }
    }
    known
}

/// Every number that the axes can have at the size of a session: the shape of a screen decides to which side
/// equal units widen a window.
fn on_axes(session: &Session) -> BTreeSet<String> {
    let screen = Rect::new(0, 0, session.size.width, session.size.height);
    let areas = layout(screen, session).map_or_else(Vec::new, |parts| parts.plots);
    let mut known = BTreeSet::new();
    for (index, area) in areas.into_iter().enumerate().filter(|(_, area)| !area.is_empty()) {
        let [x, y] = crate::picture::scales(session, index);
        let window = shown(area, session, index, [x, y]);
        known.extend(numbers(&labels(x, window.x)));
        known.extend(numbers(&labels(y, window.y)));
    }
    known
}

/// Whether a number is one of these, or one of them in fewer digits, correctly rounded.
fn is_among(known: &BTreeSet<String>, number: &str) -> bool {
    let mantissa = number.split('e').next().unwrap_or_default();
    let digits = mantissa.trim_start_matches(['-', '0', '.']);
    let digits = digits.chars().filter(char::is_ascii_digit).count();
    let rounded = |other: &String| {
        other.parse().is_ok_and(|value: f64| value != 0.0 && significant(value, digits) == number)
    };
    known.contains(number) || (digits > 0 && known.iter().any(rounded))
}

/// Numbers of a scene, after these keys, that are parts of others.
fn cut(name: &str, keys: &str) -> Vec<String> {
    let mut session = Session::new(find(name).unwrap(), WIDEST);
    settle(&mut session);
    press(&mut session, keys);
    let anywhere = known(&session);
    let mut cut = Vec::new();
    for (width, height) in SIZES {
        session.size = Size { width, height };
        let known = &on_axes(&session) | &anywhere;
        // Letters stand where dots do.
        for look in if width == 80 { vec![braille(), letters()] } else { vec![braille()] } {
            let screen = text(&draw(&session, look));
            let parts = numbers(&screen).into_iter().filter(|number| !is_among(&known, number));
            cut.extend(parts.map(|number| {
                let line = screen.lines().find(|line| line.contains(&number)).unwrap_or_default();
                format!("{name} [{keys}] at {width}x{height}: {number} in\n{line}")
            }));
        }
    }
    cut
}

#[test]
fn numbers_are_found_in_texts() {
    let found = numbers("D -0.25 1e-10 v=3. a1.5e+ e^2.5-3 +-0.7");
    let expected = ["-0.25", "1e-10", "3", "1.5", "2.5", "-3", "0.7"].map(str::to_owned);
    assert_eq!(found, expected.into());
    let known = ["0.0100305".to_owned()].into();
    assert!(is_among(&known, "0.0100305") && is_among(&known, "0.01003"));
    assert!(!is_among(&known, "0") && !is_among(&known, "0.0") && !is_among(&known, "0.0100"));
}

#[test]
fn no_number_on_any_screen_is_cut() {
    let mut found = Vec::new();
    let mut check = |scene: &str, keys: &str| found.extend(cut(scene, keys));
    for scene in library() {
        for keys in ["", "<tab> <right>"] {
            check(&scene.name, keys);
        }
    }
    for view in VIEWS {
        let name: Vec<String> = view.name.chars().map(String::from).collect();
        let name = name.join(" ");
        for scene in ["supercritical", "belt-speed", "fig16b"] {
            check(scene, &format!("<tab> Q V / {name} <enter> <right>"));
        }
    }
    let over = "% <up> <up> <up> <up> <up> <right> <right> <tab> 0 <tab> 1 <enter>";
    for keys in
        ["% <enter>", "% <enter> z <right>", over, "? ", "$", "s", "v", "}", "<tab> <tab> w"]
    {
        check("supercritical", keys);
    }
    for keys in ["<right> <right>", "<right> <right> <up> <up>", "G", "G <down> <down>"] {
        check("supercritical", &format!("% <enter> <tab> {keys}"));
        check("supercritical", &format!("{over} <tab> {keys}"));
    }
    assert!(found.is_empty(), "{} numbers are cut:\n{}", found.len(), found.join("\n"));
}
