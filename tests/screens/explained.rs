//! Everything that a screen shows is explained, where it stands, with numbers in place of their names.

use std::collections::BTreeSet;

use ratatui::layout::Rect;

use super::pictures::{answered, computed};
use super::{all_pictures, braille, draw, settled};
use hopfscope::picture::legend::called;
use hopfscope::scene::machine::library::machines;
use hopfscope::scene::{GLOSSARY, GlossaryEntry, library};
use hopfscope::session::{Msg, Session, Size, update};
use hopfscope::view::explain::{line_entry, things};
use hopfscope::view::layout::layout;
use hopfscope::view::screen::text;

/// What a screen shows and nothing explains: rows of the pane, what plots draw, and whole lines of text.
fn unexplained(session: &Session) -> Vec<String> {
    let Size { width, height } = session.size;
    let parts = layout(Rect::new(0, 0, width, height), session).unwrap();
    let pictures = all_pictures(session);
    let mut open: Vec<String> = Vec::new();
    for row in session.rows() {
        let name = row.name_in(&session.problem);
        open.extend(GlossaryEntry::of("number", name).is_none().then(|| format!("row {name}")));
    }
    for picture in &pictures {
        let names = picture.items.iter().filter_map(|item| called(picture, item));
        let names = names.map(|(name, _)| name);
        open.extend(names.filter(|name| line_entry(name).is_none()));
        for axis in [&picture.x, &picture.y] {
            let name = axis.split([' ', '/', ',']).next().unwrap();
            let known = GlossaryEntry::of("word", axis).or(GlossaryEntry::of("word", name));
            open.extend((!axis.is_empty() && known.is_none()).then(|| format!("axis {axis}")));
        }
    }
    let buffer = draw(session, braille());
    let things = things(&parts, session, &buffer);
    let screen = text(&buffer);
    let below = parts.parameters.y + 1 + u16::try_from(session.rows().len()).unwrap();
    let pane = below..parts.parameters.bottom();
    let rows: Vec<&str> = screen.lines().collect();
    let pane = pane.map(|y| (y, parts.parameters.width)).take_while(|(y, _)| {
        ![" look", " press"].iter().any(|it| rows[usize::from(*y)].starts_with(it))
    });
    for (y, width) in pane.chain(parts.status.rows().map(|row| (row.y, row.width))) {
        let line: String = rows[usize::from(y)].chars().take(width.into()).collect();
        // Of what stands twice, the first one is pointed at.
        let told = things.iter().any(|it| {
            let there = it.place.y <= y && y < it.place.bottom() && it.place.x < width;
            there || it.entry.texts("word").any(|text| line.contains(text))
        });
        open.extend((!line.trim().is_empty() && !told).then(|| format!("line {}", line.trim())));
    }
    open
}

#[test]
fn everything_on_the_screen_of_every_scene_is_explained() {
    let mut open = BTreeSet::new();
    for scene in library() {
        let mut session = computed(&scene.name);
        open.extend(unexplained(&session));
        for entry in GLOSSARY.iter() {
            let formula = session.with_numbers(entry.formula);
            assert!(!formula.contains(['{', '}']), "{}: {formula}", entry.name);
        }
        update(&mut session, Msg::Run("layer basin on".to_owned()));
        session.unfolded = true;
        answered(&mut session);
        open.extend(unexplained(&session));
    }
    for machine in machines() {
        let mut session = settled("plain", 120, 40, "");
        update(&mut session, Msg::Run(format!("belt {}", machine.name)));
        answered(&mut session);
        open.extend(unexplained(&session));
    }
    assert_eq!(open, BTreeSet::new());
}

#[test]
fn the_margin_is_explained_by_one_key_and_what_is_pointed_at_stands_out() {
    let screen =
        |keys: &str, width, height| text(&draw(&settled("plain", width, height, keys), braille()));
    for (width, height) in [(80, 24), (120, 40), (200, 60)] {
        let first = screen("e", width, height);
        assert!(first.contains(" margin \u{2500}") && first.contains("smallest kick"), "{first}");
        assert!(first.contains(" from rest: "), "not covered: {first}");
        let damping = screen("e <tab> <tab>", width, height);
        assert!(
            damping.contains(" D \u{2500}") && damping.contains("2 D q' = -0.2 q'"),
            "{damping}"
        );
        assert!(!screen("e <tab> <esc>", width, height).contains(" D \u{2500}"));
    }
}
