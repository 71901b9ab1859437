//! Nothing on any screen is cut without a sign: no number is a part of another one, no word a part of a word.

use std::collections::BTreeSet;

use ratatui::layout::Rect;

use super::by_hand::{press, settle};
use super::{all_pictures, braille, draw, letters};
use hopfscope::picture;
use hopfscope::picture::legend::entries;
use hopfscope::picture::{Caption, Item, Marks, Scale, Ticks};
use hopfscope::scene::{Span, VIEWS, find, library};
use hopfscope::session::settings::DisplaySettings;
use hopfscope::session::{Session, Size};
use hopfscope::view::layout::layout;
use hopfscope::view::plot::shown;
use hopfscope::view::screen::text;
use hopfscope::words::significant;

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

/// What stands on narrow screens in place of longer words.
const SHORT: [&str; 5] = ["ev", "of", "more", "says", "what"];

/// The keys that make a map of a scan over two parameters.
const MAP: &str = "% <space> D 3 = 0 : 1 : 2 0 <enter>";

/// The keys that show a view in one large plot.
fn alone(view: &str) -> String {
    let letters: Vec<String> = view.chars().map(String::from).collect();
    format!("<tab> Q V / {} <enter>", letters.join(" "))
}

/// A scene after these keys.
fn opened(scene: &str, keys: &str) -> Session {
    let mut session = Session::new(find(scene).unwrap(), WIDEST);
    settle(&mut session);
    press(&mut session, keys);
    session
}

/// All texts of a session: its widest screen, and the captions, legends, titles and axes of its pictures.
fn whole(session: &Session) -> Vec<String> {
    let mut texts = vec![text(&draw(session, braille()))];
    let pictures = all_pictures(session);
    texts.extend(entries(&pictures).into_iter().map(|entry| entry.text));
    for picture in pictures {
        for item in &picture.items {
            if let Item::Marks(Marks { brief, .. }) = item {
                texts.push((*brief).to_owned());
            }
        }
        for Caption { long, short, .. } in &picture.captions {
            texts.extend([long.to_string(), short.to_string()]);
        }
        texts.extend([picture.title, picture.x, picture.y].map(String::from));
    }
    texts
}

/// What `parts` finds on the screens of a session, of every size and in these looks, each with its row.
fn found(
    mut session: Session,
    about: &str,
    looks: fn(u16) -> Vec<DisplaySettings>,
    parts: impl Fn(&Session, &str) -> Vec<String>,
) -> Vec<String> {
    let mut found = Vec::new();
    for (width, height) in SIZES {
        session.size = Size { width, height };
        for look in looks(width) {
            let screen = text(&draw(&session, look));
            found.extend(parts(&session, &screen).into_iter().map(|part| {
                let row = screen.lines().find(|row| row.contains(&part)).unwrap_or_default();
                format!("{about} at {width}x{height}: {part} in\n{row}")
            }));
        }
    }
    found
}

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

/// Parts of words on the screens of a scene after these keys.
fn cut_words(scene: &str, keys: &str) -> Vec<String> {
    let session = opened(scene, keys);
    let known = whole(&session).iter().flat_map(|text| words(text)).collect::<Vec<_>>();
    let known = known.iter().map(|(word, _)| word.as_str()).chain(SHORT);
    let known: BTreeSet<&str> = known.collect();
    let is_part = |(word, marked): &(String, bool)| !marked && !known.contains(word.as_str());
    found(
        session,
        &format!("{scene} [{keys}]"),
        |_| vec![braille()],
        |_, screen| words(screen).into_iter().filter(is_part).map(|(word, _)| word).collect(),
    )
}

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

/// Every number that the axes can have at the size of a session: the shape of a screen decides to which side
/// equal units widen a window.
fn on_axes(session: &Session) -> BTreeSet<String> {
    let screen = Rect::new(0, 0, session.size.width, session.size.height);
    let areas = layout(screen, session).map_or_else(Vec::new, |parts| parts.plots);
    let mut known = BTreeSet::new();
    for (index, area) in areas.into_iter().enumerate().filter(|(_, area)| !area.is_empty()) {
        let [x, y] = picture::scales(session, index);
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

/// Parts of numbers on the screens of a scene after these keys.
fn cut_numbers(scene: &str, keys: &str) -> Vec<String> {
    let session = opened(scene, keys);
    let anywhere: BTreeSet<String> =
        whole(&session).iter().flat_map(|text| numbers(text)).collect();
    found(
        session,
        &format!("{scene} [{keys}]"),
        // Letters stand where dots do.
        |width| {
            if width == 80 {
                vec![braille(), letters()]
            } else {
                vec![braille()]
            }
        },
        |session, screen| {
            let known = &on_axes(session) | &anywhere;
            numbers(screen).into_iter().filter(|number| !is_among(&known, number)).collect()
        },
    )
}

#[test]
fn words_know_whether_they_are_cut() {
    let expected = [("edge", false), ("stick-slip", false), ("unst", true)];
    let expected = expected.map(|(word, marked)| (word.to_owned(), marked));
    assert_eq!(words("edge: 3 stick-slip - a unst\u{2026}"), expected);
}

#[test]
fn no_word_on_any_screen_is_cut_without_a_sign() {
    let mut cut = Vec::new();
    for scene in library() {
        for keys in ["", "!"] {
            cut.extend(cut_words(&scene.name, keys));
        }
    }
    for view in VIEWS.iter() {
        cut.extend(cut_words("supercritical", &alone(view.name)));
    }
    for keys in
        ["?", "? ?", "s", "v", "V", "$", "%", "% <enter>", "% <enter> z t", "}", ":", "<enter>"]
    {
        cut.extend(cut_words("supercritical", keys));
    }
    assert!(cut.is_empty(), "{} words are cut:\n{}", cut.len(), cut.join("\n"));
}

/// At the sizes at which the side pane has texts, what to look at and what to press stand there whole.
#[test]
fn no_text_beside_the_plots_is_cut() {
    let mut found = Vec::new();
    for scene in library() {
        for (width, height, pane) in [(120, 36, 34), (120, 40, 34), (160, 48, 52), (200, 60, 52)] {
            let mut session = Session::new(scene.clone(), Size { width, height });
            settle(&mut session);
            let screen = text(&draw(&session, braille()));
            let rows = screen.lines().map(|row| row.chars().take(pane).collect::<String>());
            let rows: Vec<String> = rows.collect();
            // Beside the numbers of a machine, a key may stand in place of the second text.
            let whole = (scene.machine.is_some() || height < 40) && width < 160
                || !rows.iter().any(|row| row.contains("! says what"));
            if !whole || rows.iter().any(|row| row.contains('\u{2026}')) {
                found.push(format!("{} at {width}x{height}:\n{}", scene.name, rows.join("\n")));
            }
        }
    }
    assert!(found.is_empty(), "{} texts are cut:\n{}", found.len(), found.join("\n"));
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
    let mut cut = Vec::new();
    for scene in library() {
        for keys in ["", "<tab> <right>"] {
            cut.extend(cut_numbers(&scene.name, keys));
        }
    }
    for view in VIEWS.iter() {
        for scene in ["supercritical", "belt-speed", "fig16b"] {
            cut.extend(cut_numbers(scene, &format!("{} <right>", alone(view.name))));
        }
    }
    for keys in
        ["% <enter>", "% <enter> z <right>", MAP, "? ?", "$", "s", "v", "}", "<tab> <tab> w"]
    {
        cut.extend(cut_numbers("supercritical", keys));
    }
    for keys in ["<right> <right>", "<right> <right> <up> <up>", "G", "G <down> <down>"] {
        for scan in ["% <enter>", MAP] {
            cut.extend(cut_numbers("supercritical", &format!("{scan} <tab> {keys}")));
        }
    }
    assert!(cut.is_empty(), "{} numbers are cut:\n{}", cut.len(), cut.join("\n"));
}
