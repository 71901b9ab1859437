//! Screens of hand-made answers: pictures kept as text, and facts that hold for every picture.

mod axes;
mod by_hand;
mod bytes;
mod compare;
mod cut;
mod explained;
mod legends;
mod pictures;
mod playback;
mod texts;

use hopfscope::branch::BranchPoint;
use hopfscope::flow::{Method, Outcome, Problem, Reason, Sample};
use hopfscope::model::{Knob, Parameters, State};
use hopfscope::picture::Picture;
use hopfscope::portrait::Return;
use hopfscope::question::NoAnswer;
use hopfscope::question::zones::Extent;
use hopfscope::scene::{
    Axes, Finding, LAYERS, Layer, PlotSetup, Point, Scene, Span, View, Window, find, library,
};
use hopfscope::session::settings::{Colors, Glyphs, Theme, choices};
use hopfscope::session::{
    BranchStop, Msg, Notice, Overlay, PointerTarget, Session, Size, settings, update,
};
use hopfscope::view::frame::render;
use hopfscope::view::layout::layout;
use hopfscope::view::screen::text;
use hopfscope::view::{Look, place};
use proptest::prelude::*;
use ratatui::buffer::Buffer;
use ratatui::layout::{Position, Rect};
use ratatui::style::Modifier;
use std::sync::Arc;

use by_hand::{by_hand, circle, cycle, drawing, drawn_over, open, press, settle, settle_with};

fn draw(session: &Session, look: settings::DisplaySettings) -> Buffer {
    let Size { width, height } = session.size;
    let screen = Rect::new(0, 0, width, height);
    let mut buffer = Buffer::empty(screen);
    render(screen, session, &Look::new(look), &mut buffer);
    buffer
}

/// The pictures of all plots of a session.
fn all_pictures(session: &Session) -> Vec<Picture<'_>> {
    (0..session.plots.len()).map(|index| hopfscope::picture::of(session, index)).collect()
}

fn braille() -> settings::DisplaySettings {
    settings::DisplaySettings {
        glyphs: Glyphs::Braille,
        colors: Colors::Sixteen,
        ..settings::DisplaySettings::default()
    }
}

fn letters() -> settings::DisplaySettings {
    settings::DisplaySettings {
        glyphs: Glyphs::Ascii,
        colors: Colors::Never,
        ..settings::DisplaySettings::default()
    }
}

fn settled(scene: &str, width: u16, height: u16, keys: &str) -> Session {
    let mut session = open(scene, width, height);
    settle(&mut session);
    press(&mut session, keys);
    session
}

/// A scene of its own, so that the pictures do not change with the library.
fn approved() -> Scene {
    let library = find("supercritical").unwrap();
    let parameters = Parameters { d: -0.3, d2: 0.0, d3: 0.5, r: 0.1 };
    let problem = Problem {
        parameters,
        initial: State { q: 1.0, v: 0.0 },
        until: 60.0,
        method: Method::Taylor,
        tolerance: 1e-10,
        ..Problem::default()
    };
    let span = |from, to| Span::new(from, to).unwrap();
    let plot_setup = |view, window| PlotSetup {
        window: Some(window),
        ..PlotSetup::fitting(view, Axes::default())
    };
    Scene {
        name: "approved".into(),
        title: "A scene with a fold".into(),
        watch: "Two cycles meet in the fold. ".repeat(4),
        press: "Right on D, past the fold. ".repeat(3),
        terms: [Knob::D, Knob::D3, Knob::R].into(),
        problem,
        layers: LAYERS.iter().map(|row| row.layer).filter(|layer| !drawn_over(*layer)).collect(),
        plots: vec![
            plot_setup(View::Phase, Window { x: span(-1.6, 1.6), y: span(-1.6, 1.6) }),
            plot_setup(View::Diagram, Window { x: span(-0.8, 0.1), y: span(0.0, 2.0) }),
        ],
        ..Scene::clone(&library)
    }
}

#[test]
fn screens_look_as_they_were_approved() {
    let cases = [
        ("opened", (80, 24), "", braille()),
        ("letters", (80, 24), "", letters()),
        ("wide", (160, 48), "<right>", braille()),
        ("tall", (100, 60), "", braille()),
        ("narrow", (60, 16), "<tab>", letters()),
        ("cursor", (100, 30), "<tab> <up> <up> <right>", braille()),
        ("diagram", (80, 24), "<tab> <tab> z <right>", braille()),
        ("walking", (80, 24), "<tab> <tab> w <tab>", braille()),
        ("multiplier", (100, 30), "<tab> <tab> Y Y Y Y Y Y", braille()),
        ("unfolded", (80, 24), "x <down>", braille()),
        ("card", (40, 9), "", braille()),
        ("three", (80, 24), "<tab> <tab> W V / d i a <enter> X", braille()),
        ("four", (160, 48), "<tab> <tab> W W W", braille()),
        ("four-small", (80, 24), "<tab> <tab> W W W", letters()),
        ("rows", (100, 40), "Z Z", braille()),
        ("time-series", (80, 24), "<tab> <tab> ; v n <esc> z <right>", braille()),
        ("energy-ledger", (80, 24), "<tab> <tab> V / l e d <enter> <down>", braille()),
        ("return-map", (80, 24), "<tab> Q V / r e t <enter> <right>", braille()),
        ("trade", (80, 24), "<tab> Q V / t r a d e <enter> <right>", letters()),
        ("costs", (100, 30), "$", letters()),
        ("help", (80, 24), "?", letters()),
        ("help-walk", (120, 40), "<tab> <tab> w ?", braille()),
        ("everything", (80, 24), "? ?", letters()),
        ("everything-wide", (120, 40), "<tab> <space> f o l d", braille()),
        ("layers", (80, 24), "v", letters()),
        ("dial", (100, 24), "}", letters()),
        ("regimes", (80, 24), "<tab> Q V / r e g <enter> <right>", braille()),
        ("views", (80, 24), "V", letters()),
        ("scan", (80, 24), "% <enter> z <right> <right>", braille()),
        ("scan-table", (80, 24), "% <enter> z t <down> <down>", braille()),
        ("scan-map", (100, 30), "% <space> D 3 = 0 : 1 : 2 0 <enter> z", braille()),
        ("scan-map-letters", (80, 24), "% <space> D 3 = 0 : 1 : 2 0 <enter>", letters()),
    ];
    for (name, (width, height), keys, look) in cases {
        let mut session = Session::new(Arc::new(approved()), Size { width, height });
        settle(&mut session);
        press(&mut session, keys);
        insta::assert_snapshot!(name, picture_of(&session, look));
    }
}

/// The screen without its last line, whose keys are the business of the command table.
fn picture_of(session: &Session, look: settings::DisplaySettings) -> String {
    let screen = text(&draw(session, look));
    let rows: Vec<&str> = screen.lines().collect();
    rows[..rows.len() - 1].join("\n")
}

#[test]
fn before_the_first_answer_the_formulas_are_there() {
    let session = Session::new(Arc::new(approved()), Size { width: 80, height: 24 });
    insta::assert_snapshot!("waiting", picture_of(&session, braille()));
}

#[test]
fn a_refused_value_says_why_where_it_is_typed() {
    let screen = text(&draw(&settled("plain", 100, 24, "<enter> x <enter>"), letters()));
    let line = screen.lines().last().unwrap();
    assert!(line.starts_with(" D = -0.1x") && line.contains("number"), "{line}");
}

#[test]
fn of_a_long_command_the_part_around_the_caret_is_seen_and_the_reason_of_a_refusal_whole() {
    let numbers = "D=-0.30000000000000004:0.30000000000000004:200 D3=2:2:50";
    let line = format!("scan {numbers} outcome,rest,from-rest");
    let reason = "scan: D3: FROM and TO are both 2.0";
    for width in [60, 80] {
        for (keys, begin, end, under) in [
            ("", " :\u{2026}", "outcome,rest,from-rest", " "),
            ("<home>", " :scan D=", "\u{2026}", "s"),
            ("<home> <right>", " :scan D=", "\u{2026}", "c"),
            ("<enter>", " :\u{2026}", &format!(",from-rest   {reason}"), " "),
            ("<home> <enter>", " :scan D=", &format!("\u{2026}  {reason}"), "s"),
        ] {
            let mut session = settled("plain", width, 24, ":");
            update(&mut session, Msg::Paste(line.clone()));
            press(&mut session, keys);
            let buffer = draw(&session, braille());
            let screen = text(&buffer);
            let row = screen.lines().last().unwrap();
            assert!(row.starts_with(begin) && row.ends_with(end), "{keys} at {width}: {row}");
            let mut cells = (0..width).map(|x| &buffer[(x, 23)]);
            let caret = cells.find(|cell| cell.modifier.contains(Modifier::REVERSED)).unwrap();
            assert_eq!(caret.symbol(), under, "{keys} at {width}: {row}");
        }
    }
}

#[test]
fn the_layer_list_says_which_are_on() {
    let screen = text(&draw(&settled("plain", 80, 70, "v"), letters()));
    for row in LAYERS.iter() {
        let on = if find("plain").unwrap().layers.contains(&row.layer) {
            "[x]"
        } else {
            "[ ]"
        };
        assert!(screen.contains(&format!("{on} {}", row.name)), "{screen}");
    }
}

#[test]
fn a_search_leaves_what_contains_it() {
    let screen = text(&draw(&settled("plain", 80, 24, "? / z o o m"), letters()));
    assert!(screen.contains("everything: /zoom_") && screen.contains("Zoom in"), "{screen}");
    assert!(!screen.contains("Undo"));
    let screen = text(&draw(&settled("plain", 80, 24, "? / x q z"), letters()));
    assert!(screen.contains("nothing found"), "{screen}");
}

#[test]
fn the_scene_picker_shows_every_scene_and_what_the_selected_one_is_about() {
    let session = settled("linear", 90, 60, "s");
    let screen = text(&draw(&session, letters()));
    assert!(library().iter().all(|scene| screen.contains(&scene.title)), "{screen}");
    assert!(screen.contains("supercritical fig16b Friction turns"), "{screen}");
    assert!(
        ["Lessons", "Figures of the paper", "Machines"].iter().all(|group| screen.contains(group))
    );
    let always = hopfscope::scene::said::said_by(&session.scene, &session.scene.watch);
    let first: Vec<&str> = always.split_whitespace().take(4).collect();
    assert!(screen.contains(&first.join(" ")), "{screen}");
}

#[test]
fn a_stale_picture_stays_and_says_so() {
    let mut session = settled("supercritical", 80, 24, "");
    let before = text(&draw(&session, braille()));
    update(&mut session, Msg::Key("<right>".parse().unwrap()));
    let after = text(&draw(&session, braille()));
    let cycles_of = |screen: &str| screen.lines().nth(13).map(str::to_owned);
    assert_eq!(cycles_of(&before), cycles_of(&after));
    let titles = |screen: &str| screen.lines().nth(1).unwrap_or_default().to_owned();
    assert!(!titles(&before).contains("stale") && titles(&after).contains("stale"), "{after}");
    assert!(after.contains("computing"));
}

#[test]
fn a_question_without_an_answer_says_why() {
    let mut session = open("plain", 80, 24);
    for request in session.wants() {
        let result = Err(NoAnswer::Reason(Reason::Budget { evaluations: 5 }));
        update(&mut session, Msg::answered(request, result, 0.1));
    }
    let screen = text(&draw(&session, braille()));
    assert!(screen.contains("no motion: budget of 5 evaluations spent"), "{screen}");
    assert!(screen.contains("no answer"));
}

#[test]
fn what_does_not_fit_is_cut_with_a_mark() {
    let mut session = settled("plain", 60, 16, "");
    let text_of = |session: &Session| text(&draw(session, braille()));
    session.notice = Some(Notice { error: true, text: "word ".repeat(20) });
    let screen = text_of(&session);
    assert!(screen.lines().last().unwrap().ends_with('…'), "{screen}");
}

#[test]
fn letters_are_letters_in_every_corner_of_the_program() {
    for keys in ["", "?", "s", "v", "<enter>", "<tab> <up>", "<tab> <tab> <up>"] {
        let session = settled("supercritical", 120, 40, keys);
        let screen = text(&draw(&session, letters()));
        assert!(screen.is_ascii(), "{keys}: {screen}");
        // No letter stands for a sign that has none.
        let marks = |screen: &str| screen.matches('?').count();
        assert!(marks(&screen) <= marks(&text(&draw(&session, braille()))), "{keys}: {screen}");
    }
}

#[test]
fn without_colour_no_cell_has_any_and_stable_still_differs_from_unstable() {
    for (_, glyphs) in choices::<Glyphs>() {
        for (_, theme) in choices::<Theme>() {
            let colors = Colors::Never;
            let look = settings::DisplaySettings { glyphs, colors, theme, ..braille() };
            let session = settled("supercritical", 80, 24, "");
            let colourless = draw(&session, look);
            let coloured =
                draw(&session, settings::DisplaySettings { colors: Colors::Sixteen, ..look });
            assert_eq!(text(&colourless), text(&coloured), "colour changes no character");
            for cell in &colourless.content {
                assert_eq!((cell.fg, cell.bg), Default::default());
            }
        }
    }
    let only = |stable: bool| {
        let mut session = open("supercritical", 80, 24);
        session.layers = [Layer::Cycles].into();
        settle_with(&mut session, |request| {
            let mut answer = by_hand(request);
            if let Finding::Cycles(found, _) = &mut answer {
                *found = drawing(vec![cycle(1.0, stable)], Vec::new(), vec![circle(1.0)]);
            }
            answer
        });
        text(&draw(&session, settings::DisplaySettings { colors: Colors::Never, ..braille() }))
    };
    assert_ne!(only(true), only(false));
}

#[test]
fn the_pane_that_gets_the_keys_is_marked_without_colour() {
    for keys in ["", "<tab>", "<tab> <tab>"] {
        let session = settled("plain", 80, 24, keys);
        let screen = text(&draw(&session, letters()));
        let titles = screen.lines().nth(1).unwrap();
        assert_eq!(titles.matches('>').count(), 1, "{titles}");
    }
}

#[test]
fn the_footer_and_the_help_name_the_keys_that_do_it() {
    let footer = |keys: &str| {
        let screen = text(&draw(&settled("plain", 100, 24, keys), letters()));
        screen.lines().last().unwrap_or_default().to_owned()
    };
    assert!(footer("").contains("left right step") && footer("").contains("q quit"));
    assert!(footer("<tab>").contains("enter start here"));
    assert!(footer("<enter>").contains("enter accept"));
    let help = settled("plain", 100, 700, "? ?");
    let screen = text(&draw(&help, letters()));
    let Some(Overlay::List(_, list)) = &help.overlay else { panic!("a list") };
    for row in help.palette_rows(list) {
        let told = help.refused(list, row).unwrap_or(row.meaning());
        assert!(screen.contains(row.name()) || screen.contains(told), "{}", row.name());
    }
}

#[test]
fn a_value_that_differs_from_the_scene_is_underlined() {
    let underlined = |keys: &str| {
        let buffer = draw(&settled("plain", 80, 24, keys), braille());
        buffer.content.iter().filter(|cell| cell.modifier.contains(Modifier::UNDERLINED)).count()
    };
    assert_eq!((underlined(""), underlined("<right>")), (0, "-0.09".len()));
}

#[test]
fn the_selected_row_is_on_show_and_can_be_clicked_however_many_there_are() {
    let mut session = settled("fig01", 80, 24, "x");
    let (screen, rows) = (Rect::new(0, 0, 80, 24), session.rows());
    assert!(rows.len() > 22, "{}", rows.len());
    for (index, row) in rows.into_iter().enumerate() {
        session.selected = row;
        let shown = picture_of(&session, letters());
        let pointer = format!(">{} ", row.name_in(&session.problem));
        let y = shown.lines().position(|line| line.starts_with(&pointer)).unwrap();
        let cell = Position { x: 1, y: u16::try_from(y).unwrap() };
        assert_eq!(place(screen, &session, cell), Some(PointerTarget::Row(index)), "{pointer}");
    }
}

#[test]
fn every_scene_fits_every_size() {
    // Every kind of glyphs has its turn with every scene, size and list, but not all of them together.
    let kinds: Vec<Glyphs> = choices().map(|(_, glyphs)| glyphs).collect();
    let mut kinds = kinds.iter().cycle();
    for scene in library() {
        let sizes =
            (1..=25).map(|n| (n * 8, n * 3)).chain([(1, 1), (500, 200), (200, 16), (60, 200)]);
        for (width, height) in sizes {
            for keys in ["", "?", "? ?", "s", "<enter>"] {
                let session = settled(&scene.name, width, height, keys);
                let glyphs = *kinds.next().expect("kinds come again");
                draw(&session, settings::DisplaySettings { glyphs, ..braille() });
            }
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn plots_share_every_screen_without_overlap(
        (width, height) in (1_u16..501, 1_u16..201),
        keys in proptest::collection::vec(prop::sample::select(vec!["<tab>", "W", "Q", "Z", "z", "M", ";"]), 0..12),
    ) {
        let mut session = open("supercritical", width, height);
        press(&mut session, &keys.join(" "));
        let screen = Rect::new(0, 0, width, height);
        if let Some(parts) = layout(screen, &session) {
            prop_assert_eq!(parts.plots.len(), session.plots.len());
            let shown: Vec<Rect> = parts.plots.iter().filter(|area| !area.is_empty()).copied().collect();
            prop_assert!(!parts.plots[session.plot].is_empty(), "the plot in use is seen");
            let all = [parts.title, parts.parameters, parts.status, parts.footer];
            let all: Vec<Rect> = all.into_iter().chain(shown).collect();
            for (index, area) in all.iter().enumerate() {
                prop_assert_eq!(area.intersection(screen), *area);
                prop_assert!(all[..index].iter().all(|other| !area.intersects(*other)));
            }
        }
        draw(&session, braille());
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn whatever_the_numbers_are_a_picture_is_drawn(
        curve in proptest::collection::vec((any::<f64>(), any::<f64>()), 0..40),
        (low, high) in (any::<f64>(), any::<f64>()),
        value in any::<f64>(),
        (width, height) in (60_u16..130, 16_u16..40),
    ) {
        let mut session = open("supercritical", width, height);
        press(&mut session, "<tab>");
        session.layers = LAYERS.iter().map(|row| row.layer).collect();
        let states: Vec<State> = curve.iter().map(|(q, v)| State { q: *q, v: *v }).collect();
        let mut held = None;
        for request in session.wants() {
            let mut answer = by_hand(&request);
            match &mut answer {
                Finding::Trajectory(found) => {
                    found.samples = curve.iter().map(|(q, v)| Sample { tau: 0.0, q: *q, v: *v }).collect();
                    found.outcome = Outcome::Moving { tau: value, q: low, v: high };
                }
                Finding::Cycles(found, _) => {
                    let cycles = vec![cycle(value, true), cycle(low, false)];
                    let curves = vec![states.clone(), states.clone()];
                    *found = drawing(cycles, states.clone(), curves);
                }
                Finding::Branch(found) => {
                    found.pieces = vec![curve.iter().map(|(value, q_max)| {
                        BranchPoint { value: *value, cycle: cycle(*q_max, *q_max > 0.0) }
                    }).collect()];
                    found.special[0].cycle = Some(cycle(value, true));
                    held = Some(BranchStop::at(0, &found.special[0]));
                }
                Finding::Balance(found) => found.balanced.clear(),
                Finding::ReturnMap(found) => {
                    let turn = |(from, to): &(f64, f64)| Return { from: *from, to: Some(*to) };
                    found.sides = [curve.iter().map(turn).collect(), Vec::new()];
                }
                Finding::Regimes(found) => {
                    for (line, (at, fold)) in found.lines.iter_mut().zip(&curve) {
                        (line.at, line.fold, line.harmonic) = (*at, Some(*fold), Some(low));
                    }
                }
                Finding::Zones(found) => found.safe = Extent::Within(states.clone()),
                Finding::Kicks(found, _) => found.part = value,
                Finding::Capture(found, _) => *found = vec![states.clone()],
                _ => {}
            }
            update(&mut session, Msg::answered(request, Ok(answer), 0.0));
        }
        session.held = held;
        session.plots[0].cursor = Some(Point { x: value, y: low });
        if let Ok(span) = Span::new(low.min(high), low.max(high)) {
            session.plots.iter_mut().for_each(|plot| plot.window = Window { x: span, y: span });
        }
        for (_, glyphs) in choices::<Glyphs>() {
            draw(&session, settings::DisplaySettings { glyphs, ..braille() });
        }
    }
}

#[test]
fn an_error_that_could_not_be_measured_is_not_taken_for_the_measured_one() {
    for (width, expected) in [
        (200, "energy error 4e-14 (the tighter run gave up)"),
        (100, "energy error 4e-14 ("),
        (80, "energy error 4e-14"),
    ] {
        // By hand no reference is known.
        let mut session = open("supercritical", width, 24);
        press(&mut session, "}");
        settle(&mut session);
        assert!(session.measures() && session.measured().is_some_and(|found| found.is_err()));
        let drawn = draw(&session, braille());
        let screen = text(&drawn);
        assert!(screen.contains(expected), "{width}: {screen}");
        press(&mut session, "g");
        assert!(!text(&draw(&session, braille())).contains("gave up"));
    }
}
