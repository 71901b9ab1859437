//! The words on the screen say what is so: in every state, of every view, in the units of the axes.

use ratatui::layout::Rect;

use super::by_hand::{press, record, settle};
use super::pictures::computed;
use super::{braille, draw, settled};
use hopfscope::flow::Limits;
use hopfscope::model::Knob;
use hopfscope::picture::Role;
use hopfscope::question::answer;
use hopfscope::scene::{LAYERS, Topic, VIEWS, View, library};
use hopfscope::session::{Msg, Purpose, Session, Size, update};
use hopfscope::view::Look;
use hopfscope::view::layout::layout;
use hopfscope::view::screen::text;

/// Screens that people have.
pub const SIZES: [(u16, u16); 3] = [(80, 24), (120, 40), (200, 60)];

fn run(session: &mut Session, line: &str) {
    update(session, Msg::Run(line.to_owned()));
    settle(session);
}

/// A record that is open and fitted.
fn recorded() -> Session {
    let mut session = settled("plain", 80, 24, "");
    let purpose = Purpose::Fit("mass=2 kg".to_owned());
    let result = Ok(record());
    update(&mut session, Msg::Read { path: "decay.csv".into(), purpose, result });
    settle(&mut session);
    session
}

/// The rows of the parameter pane.
pub fn pane(session: &Session) -> String {
    let Size { width, height } = session.size;
    let columns = layout(Rect::new(0, 0, width, height), session).unwrap().parameters.width;
    let screen = text(&draw(session, braille()));
    screen
        .lines()
        .map(|line| line.chars().take(columns.into()).collect::<String>() + "\n")
        .collect()
}

#[test]
fn a_step_is_called_one_and_plus_minus_is_an_error() {
    for (width, height) in SIZES {
        for scene in ["plain", "fig01", "benchmark"] {
            let mut session = settled(scene, width, height, "");
            for _ in 0..session.rows().len() {
                let step = session.selected.stepped();
                let pane = pane(&session);
                let selected = pane.lines().skip(2).find(|line| line.starts_with('\u{25b8}'));
                let selected = selected.unwrap_or_else(|| panic!("{pane}"));
                assert!(step.is_none() || selected.contains("step "), "{scene}: {selected}");
                assert!(!pane.contains('\u{b1}'), "{scene} at {width}: {pane}");
                press(&mut session, "<down>");
            }
        }
        let mut session = settled("plain", width, height, "> > >");
        session.selected = hopfscope::session::Row::default();
        let pane = pane(&session);
        let row = pane.lines().find(|line| line.starts_with("\u{25b8}D")).unwrap();
        let words: Vec<&str> = row.split_whitespace().collect();
        assert_eq!(words[1..5], ["-0.1", "\u{b1}0.03", "step", "0.01"], "{row}");
    }
}

#[test]
fn a_typed_number_stands_as_it_was_typed_and_one_that_follows_has_few_digits() {
    for (width, height) in SIZES {
        let mut session = settled("fig01", width, height, "");
        let value = |session: &Session, name: &str| {
            let row = |line: &&str| line[1..].starts_with(name) && line[1..].contains(' ');
            let pane = pane(session).replace('\u{25b8}', " ");
            let row = pane.lines().find(row).unwrap().to_owned();
            row.split_whitespace().nth(1).unwrap().to_owned()
        };
        // 1 mm, in units of the oscillator.
        assert_eq!(value(&session, "q0 "), "0.18276");
        assert_eq!(value(&session, "D "), "-0.097626");
        for typed in ["0.1", "-0.25", "0.123456"] {
            run(&mut session, &format!("set q0={typed}"));
            assert_eq!(value(&session, "q0 "), typed);
        }
    }
}

#[test]
fn every_view_draws_something_or_says_what_it_needs() {
    let axes = Look::new(braille());
    let quiet = [Role::Axis, Role::Current, Role::Quiet].map(|role| axes.style(role).fg);
    let kinds: Vec<(&str, Session)> = vec![
        ("plain", settled("plain", 80, 24, "")),
        ("without damping and friction", {
            let mut session = settled("plain", 80, 24, "");
            run(&mut session, "set D=0 r=0 q0=0");
            session
        }),
        ("without friction", settled("hopf", 80, 24, "")),
        ("variants", settled("fig16", 80, 24, "")),
        ("whole model", settled("benchmark", 80, 24, "")),
        ("cubic expansion", settled("fig01", 80, 24, "")),
        ("by computation", computed("escape")),
        ("record", recorded()),
    ];
    let mut said = std::collections::BTreeSet::new();
    for (kind, session) in kinds {
        for row in VIEWS.iter() {
            for with_layers in [true, false] {
                let mut session = session.clone();
                session.size = Size { width: 80, height: 24 };
                while session.plots.len() > 1 {
                    run(&mut session, "remove-plot");
                }
                run(&mut session, &format!("view {}", row.name));
                if !with_layers {
                    session.layers.retain(|layer| layer.spec().view != row.view);
                    settle(&mut session);
                }
                let area = layout(Rect::new(0, 0, 80, 24), &session).unwrap().plots[0];
                let area = Rect { y: area.y + 1, height: area.height - 1, ..area };
                let buffer = draw(&session, braille());
                let cells = || area.positions().map(|at| &buffer[at]);
                let letters: String = cells().map(ratatui::buffer::Cell::symbol).collect();
                let words =
                    |text: &str| text.split_whitespace().take(3).collect::<Vec<_>>().join(" ");
                let drawn = cells().filter(|cell| {
                    !cell.symbol().trim().is_empty() && !quiet.contains(&Some(cell.fg))
                });
                let sentence = session.nothing(0).unwrap_or_default();
                let says = !sentence.is_empty() && letters.contains(&words(&sentence));
                if says {
                    said.insert(sentence);
                }
                // A sentence stands in place of the axes, and never beside a picture.
                assert!(
                    says != letters.contains('\u{2514}') || row.view == View::Scan,
                    "{kind}: {}",
                    row.name
                );
                assert!(drawn.count() > 3, "{kind}: {} is empty\n{}", row.name, text(&buffer));
            }
        }
    }
    assert!(said.len() >= 5, "{said:?}");
    // Each view has its own words, and keys that exist.
    let keymap = settled("plain", 80, 24, "").keymap;
    let own: std::collections::BTreeSet<_> = VIEWS.iter().map(|row| row.nothing).collect();
    assert_eq!(own.len(), VIEWS.len());
    for text in VIEWS.iter().flat_map(|row| [row.nothing, row.needs.sentence()]) {
        for name in text.split('{').skip(1).filter_map(|rest| rest.split('}').next()) {
            assert!(keymap.key_of(name).is_some(), "{text}: {name}");
        }
    }
    assert!(LAYERS.iter().all(|layer| layer.view.spec().view == layer.view));
}

#[test]
fn what_plays_has_a_sign_for_as_long_as_it_plays() {
    let mut session = settled("plain", 80, 24, "<f8>");
    for keys in ["<down>", "<tab>", "<right>"] {
        press(&mut session, keys);
        assert!(session.playback.playing);
        let screen = text(&draw(&session, braille()));
        assert!(screen.contains(" playing ") && screen.contains("F8 pauses"), "{keys}: {screen}");
    }
    press(&mut session, "<f8> <down>");
    assert!(!text(&draw(&session, braille())).contains("playing"));
}

#[test]
fn a_machine_is_told_of_in_the_units_of_its_axes() {
    let with_units = |session: &Session| {
        let screen = text(&draw(session, braille()));
        // What the motion comes to, and the table of cycles.
        let row = |part: &str| screen.lines().find(|line| line.contains(part)).map(str::to_owned);
        let table = row(" cycles ").unwrap();
        let motion =
            row("comes to rest at").or(row("moving at")).or(row("stable cycle, ")).unwrap();
        (table.contains("x_max"), motion.contains(" x = ") || motion.contains(" x_max "))
    };
    for (width, height) in SIZES {
        for scene in ["fig01", "belt-speed"] {
            let mut session = settled(scene, width, height, "");
            assert_eq!(with_units(&session), (true, true), "{scene} at {width}");
            run(&mut session, "units off");
            assert_eq!(with_units(&session), (false, false), "{scene} at {width}");
        }
    }
    assert_eq!(with_units(&recorded()), (true, true));
}

/// Words of the texts of scenes, and when they are true.
type True = fn(&Session) -> bool;
const WORDS: [(&str, True); 8] = [
    ("egative", |it| it.value(Knob::D) < 0.0),
    ("damping feeds the motion", |it| it.value(Knob::D) < 0.0),
    ("feeds the swing", |it| it.value(Knob::D) < 0.0),
    ("segment on the q axis", |it| it.value(Knob::R) > 0.0),
    ("stop for ever", |it| it.value(Knob::R) > 0.0),
    ("dry friction makes", |it| it.value(Knob::R) > 0.0),
    ("proves the circle", |it| it.value(Knob::D) < 0.0 && it.value(Knob::R) > 0.0),
    ("broken curve", |it| {
        it.cycles().is_some_and(|found| found.cycles.iter().any(|cycle| !cycle.stable))
    }),
];

#[test]
fn the_texts_of_scenes_follow_the_state() {
    let mut told = 0;
    for scene in library() {
        for line in ["", "D=0", "D=0 r=0", "D=0.1", "D=-0.1 r=0", "D3=-0.2", "D=0.1 D3=-0.2 r=0"] {
            let mut session = Session::new(scene.clone(), Size { width: 80, height: 24 });
            if !line.is_empty() {
                update(&mut session, Msg::Run(format!("set {line}")));
            }
            for request in session.asks() {
                if matches!(request.topic(), Topic::Cycles | Topic::Trajectory)
                    && let Ok(found) = answer(&request, &Limits::PATIENT)
                {
                    update(&mut session, Msg::answered(request, Ok(found), 0.0));
                }
            }
            let look = session.said(&scene.watch);
            assert!(look.ends_with('.') && look.len() > 20, "{} at {line}: {look}", scene.name);
            for (words, holds) in WORDS.iter().filter(|(words, _)| look.contains(words)) {
                assert!(holds(&session), "{} at {line}: {words} in {look}", scene.name);
                told += 1;
            }
        }
    }
    assert!(told > 10, "{told}");
}

#[test]
fn no_text_names_a_shading_or_a_colour_that_a_screen_may_lack() {
    let colours = ["shaded", "yellow", "red", "green", "blue", "grey"];
    let texts = library().iter().flat_map(|scene| [scene.watch.as_str(), scene.press.as_str()]);
    let tour = include_str!("../../assets/replays/tour.keys");
    for text in texts.chain([tour]) {
        let mut words = text.split(|letter: char| !letter.is_alphabetic());
        assert!(words.all(|word| !colours.contains(&word)), "{text}");
    }
}
