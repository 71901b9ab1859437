//! Legends tell everything apart, without colour too, and name as much as there is room for.

use super::by_hand::{record, settle};
use super::pictures::{answered, computed};
use super::{all_pictures, braille, draw, settled};
use hopfscope::picture::LegendEntry;
use hopfscope::picture::legend::entries;
use hopfscope::scene::{LAYERS, library};
use hopfscope::session::settings::{Colors, DisplaySettings};
use hopfscope::session::{Msg, Purpose, Session, update};
use hopfscope::view::Look;
use hopfscope::view::screen::text;

/// Pairs in the legend of a session that nothing but colour tells apart.
fn alike(session: &Session) -> Vec<[String; 2]> {
    let look = Look::new(DisplaySettings { colors: Colors::Never, ..braille() });
    let appearance = |entry: &LegendEntry| (entry.sample, look.style(entry.role).add_modifier);
    let entries = entries(&all_pictures(session));
    assert!(entries.len() > 1, "{}", session.scene.name);
    let mut alike = Vec::new();
    for (index, entry) in entries.iter().enumerate() {
        let same = entries[..index].iter().filter(|other| appearance(other) == appearance(entry));
        alike.extend(same.map(|other| [entry.text.clone(), other.text.clone()]));
    }
    alike
}

#[test]
fn no_two_entries_of_a_legend_look_the_same_without_colour() {
    for scene in library() {
        let mut session = settled(&scene.name, 200, 60, "");
        if session.running().is_some() {
            session = computed(&scene.name);
        }
        assert_eq!(alike(&session), [] as [[String; 2]; 0], "{}", scene.name);
    }
    let several = settled("supercritical", 200, 60, "i o");
    assert_eq!(alike(&several), [] as [[String; 2]; 0], "several motions");
}

#[test]
fn no_two_entries_of_the_legend_of_a_fit_look_the_same_without_colour() {
    let mut session = settled("plain", 200, 60, "");
    let purpose = Purpose::Fit(String::new());
    update(&mut session, Msg::Read { path: "decay.csv".into(), purpose, result: Ok(record()) });
    answered(&mut session);
    assert!(session.fitted().is_some());
    assert_eq!(alike(&session), [] as [[String; 2]; 0]);
}

#[test]
fn legends_of_scenes_have_room_for_all_that_is_drawn() {
    let mut cut = Vec::new();
    for (width, height) in [(80, 24), (120, 40), (200, 60)] {
        for scene in library() {
            let session = settled(&scene.name, width, height, "");
            // Those of machines have most to explain; on small screens the rest is a zoom away.
            if session.running().is_some() && width < 200 {
                continue;
            }
            let screen = text(&draw(&session, braille()));
            let more = screen
                .lines()
                .filter(|line| line.trim_end().ends_with(" more") && line.contains("  +"));
            cut.extend(more.map(|line| format!("{} {width}x{height}: {line}", scene.name)));
        }
    }
    assert_eq!(cut, [""; 0]);
}

#[test]
fn a_legend_without_room_says_how_much_it_leaves_out() {
    let mut session = settled("fig04", 80, 24, "");
    session.layers = LAYERS.iter().map(|row| row.layer).collect();
    settle(&mut session);
    let entries = entries(&all_pictures(&session));
    let screen = text(&draw(&session, braille()));
    let line = screen.lines().find(|line| line.trim_end().ends_with(" more"));
    let line = line.unwrap_or_else(|| panic!("{screen}"));
    let rows: Vec<String> = screen.lines().map(|line| format!("{}  ", line.trim_end())).collect();
    let told = entries
        .iter()
        .filter(|entry| rows.iter().any(|row| row.contains(&format!(" {}  ", entry.text))));
    let left = entries.len() - told.count();
    assert!(line.trim_end().ends_with(&format!("  +{left} more")), "{left}: {screen}");
}
