//! Every keystroke file of the project plays to its end, on a small and on a large screen.

use hopfscope::runtime::replay;
use hopfscope::scene::plain;
use hopfscope::session::replay::parse;
use hopfscope::session::{Session, Size};
use hopfscope::terminal::Environment;
use ratatui::layout;

/// Name and text of every file in `assets/replays`.
fn files() -> Vec<(String, String)> {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/assets/replays");
    let read = |entry: std::io::Result<std::fs::DirEntry>| {
        let path = entry.unwrap().path();
        (path.display().to_string(), std::fs::read_to_string(path).unwrap())
    };
    std::fs::read_dir(folder).unwrap().map(read).collect()
}

#[test]
fn every_file_meets_its_expectations() {
    assert!(!files().is_empty());
    for (name, text) in files() {
        let script = parse(&text).unwrap_or_else(|error| panic!("{name}: {error}"));
        for (width, height) in [(80, 24), (200, 60)] {
            let session = Session::new(plain(), Size { width, height });
            let size = layout::Size { width, height };
            let played = replay(session, Environment::default(), script.clone(), size).unwrap();
            if let Some(unmet) = played.unmet {
                panic!("{name} at {width}x{height}: {unmet}");
            }
            let left = played.application.session().quit;
            assert!(left || name.ends_with("tour.keys"), "{name} leaves by its last key");
        }
    }
}

#[test]
fn every_keystroke_file_of_the_handbook_plays() {
    let page = include_str!("../docs/explorer.md");
    let blocks: Vec<&str> =
        page.split("```keys\n").skip(1).filter_map(|rest| rest.split("```").next()).collect();
    assert!(!blocks.is_empty());
    for text in blocks {
        let script = parse(text).unwrap_or_else(|error| panic!("docs/explorer.md: {error}"));
        let session = Session::new(plain(), Size { width: 120, height: 40 });
        let size = layout::Size { width: 120, height: 40 };
        let played = replay(session, Environment::default(), script, size).unwrap();
        assert_eq!(played.unmet, None);
    }
}

/// What a newcomer reads: a screen along the way and words on it, at every size.
const READ: [(&str, &[&str]); 8] = [
    ("opened", &["parameters", "phase plane", "grows without bound", "q quit"]),
    ("captured", &["comes to rest at q = ", "margin from rest: shift "]),
    ("scenes", &["Lessons", "supercritical fig16b"]),
    ("supercritical", &["onto the stable cycle, q_max 1.158", "margin from rest: shift 0.1247"]),
    ("beyond-the-fold", &["comes to rest", "every kick is survived"]),
    ("inside", &["comes to rest at q = ", "(inside the unstable cycle)"]),
    ("outside", &["grows onto the stable cycle", "(outside the unstable cycle)"]),
    ("help-undo", &["undo"]),
];

#[test]
fn a_newcomer_reads_a_verdict_on_every_screen_of_every_size() {
    let script = parse(include_str!("../assets/replays/newcomer.keys")).unwrap();
    for (width, height) in [(80, 24), (120, 40), (200, 60)] {
        let session = Session::new(plain(), Size { width, height });
        let size = layout::Size { width, height };
        let played = replay(session, Environment::default(), script.clone(), size).unwrap();
        assert_eq!(played.unmet, None, "{width}x{height}");
        for (name, words) in READ {
            let kept = played.kept.iter().find(|(kept, _)| kept == name);
            let (_, screen) = kept.unwrap_or_else(|| panic!("{name} is kept"));
            let screen = hopfscope::view::screen::text(screen);
            for word in words {
                assert!(screen.contains(word), "{name} at {width}x{height}: {word}\n{screen}");
            }
        }
    }
}
