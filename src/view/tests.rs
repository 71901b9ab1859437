//! Screens of hand-made answers: pictures kept as text, and facts that hold for every picture.

use std::f64::consts::TAU;
use std::sync::{Arc, LazyLock};

use proptest::prelude::*;
use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Modifier;

use super::frame::render;
use super::layout::layout;
use super::look::Look;
use crate::export::screen::text;
use crate::flow::{Cost, Crossing, Limits, Method, Outcome, Problem, Reason, Sample, Trajectory};
use crate::oscillator::{Ledger, Parameters, State, Symbol};
use crate::scene::answer::{Borders, Failure, Rows};
use crate::scene::library::{find, library};
use crate::scene::{
    Answer, Answered, Axes, Exhibit, LAYERS, Layer, Point, Request, Scene, Slot, Span, View, Window,
};
use crate::session::settings::{self, Colors, GLYPHS, Glyphs, THEMES};
use crate::session::{Key, Msg, Notice, Session, Size, Stop, update};
use crate::study::chart::{Band, Chart, Line, Plane};
use crate::study::harmonic_error::HarmonicBalance;
use crate::study::measure::Value;
use crate::study::regime::Regime;
use crate::study::scan::Row;
use crate::study::trade::Trade;
use crate::study::{
    Branch, BranchPoint, Cycle, Cycles, Edge, Margin, Picture, Return, ReturnMap, Special,
    SpecialKind,
};

/// A scene whose questions are not answered yet.
fn open(scene: &str, width: u16, height: u16) -> Session {
    Session::new(find(scene).unwrap(), Size { width, height })
}

/// Answers every open question by hand, at a price that is always the same.
fn settle(session: &mut Session) {
    for request in session.wants() {
        if session.is_open(&request) {
            let result = Ok(by_hand(&request));
            update(
                session,
                Msg::Answered(Box::new(Answered {
                    request,
                    result,
                    seconds: 0.000_25,
                    complete: true,
                })),
            );
        }
    }
    update(session, Msg::Idle);
}

fn press(session: &mut Session, keys: &str) {
    for key in keys.split_whitespace() {
        update(session, Msg::Key(key.parse::<Key>().unwrap()));
        settle(session);
    }
}

/// Whether a layer belongs to single figures and would be drawn over the others.
fn drawn_over(layer: Layer) -> bool {
    matches!(layer, Layer::Extents | Layer::Eigenvalues | Layer::Levels | Layer::Spirals)
}

fn by_hand(request: &Request) -> Answer {
    match request {
        Request::Trajectory(problem) => Answer::Trajectory(spiral(*problem)),
        Request::Cycles { parameters, .. } => {
            let cycles = vec![cycle(0.5, false), cycle(1.2, true)];
            let curves: Vec<Vec<State>> = vec![circle(0.5), circle(1.2)];
            Answer::Cycles(Cycles {
                parameters: *parameters,
                edge: Edge::Cycle,
                harmonic: Vec::new(),
                cost: Cost { evaluations: 1_200, steps: 60, rejected: 0 },
                cycles,
                picture: Some(picture(curves[0].clone(), curves)),
            })
        }
        Request::Scan { scan, from } => {
            let measured = scan.measured().len();
            let row = |index: usize| Row {
                // A slope with a hole in it.
                values: (0..measured)
                    .map(|column| match index % 7 {
                        3 => Value::Nothing,
                        _ => Value::Count(index * (column + 1)),
                    })
                    .collect(),
                reason: (index == 17).then(|| "edge: budget of 40 evaluations spent".to_owned()),
                cost: Cost::default(),
            };
            let rows = (*from..scan.points()).map(row).collect();
            Answer::Rows(Rows { first: *from, rows })
        }
        Request::Capture { .. } => Answer::Capture(Borders {
            curves: vec![circle(0.2), circle(0.35)],
            cost: Cost { evaluations: 800, steps: 40, rejected: 0 },
        }),
        Request::Balance { parameters, harmonics } => Answer::Balance(HarmonicBalance {
            parameters: *parameters,
            harmonics: *harmonics,
            balanced: Vec::new(),
            unknown: None,
            cost: Cost { evaluations: 200, steps: 10, rejected: 0 },
        }),
        Request::Branch { parameter, .. } => Answer::Branch(folded(*parameter)),
        Request::ReturnMap { parameters, .. } => Answer::ReturnMap(halving(*parameters)),
        Request::Regimes { plane, .. } => Answer::Regimes(parted(*plane)),
        Request::Family { members, .. } => {
            Answer::Family(members.iter().map(|member| Ok(by_hand(member))).collect())
        }
        Request::Trade { .. } => Answer::Trade(compared()),
        Request::Reference { .. } => Answer::Reference(Err(Reason::OutOfRange)),
        Request::Claims => Answer::Claims(Vec::new()),
    }
}

fn picture(edge: Vec<State>, curves: Vec<Vec<State>>) -> Picture {
    let margin = Margin { displacement: Some(0.5), impulse: Some(0.5) };
    let ledger = Ledger {
        start: 0.72,
        end: 0.72,
        linear: 2.5,
        quadratic: 0.25,
        cubic: -2.0,
        friction: -0.75,
        residual: 3e-15,
    };
    let works = curves.iter().map(|_| ledger).collect();
    Picture { curves, works, edge, margin, area: Some(0.8), lyapunov_share: Some(0.3) }
}

/// A motion that winds inwards and comes to rest after three half swings.
fn spiral(problem: Problem) -> Trajectory {
    let State { q, .. } = problem.initial;
    let sample = |index: u16| {
        let tau = 9.47 * f64::from(index) / 300.0;
        let radius = q * (1.0 - tau / 10.0);
        Sample { tau, q: radius * tau.cos(), v: -radius * tau.sin() }
    };
    let ledger = Ledger { start: 0.5, residual: 2e-14, ..Ledger::default() };
    Trajectory {
        problem,
        method: problem.method,
        implicit_steps: 0,
        outcome: Outcome::Captured { tau: 9.47, q: -0.053 },
        crossings: [3.1, 6.3, 9.47].map(|tau| Crossing { tau, q: 0.1 }).to_vec(),
        ledger: Some(ledger),
        samples: (0..=300).map(sample).collect(),
        cost: Cost { evaluations: 432, steps: 18, rejected: 0 },
    }
}

fn circle(radius: f64) -> Vec<State> {
    let corner = |index: u8| (TAU * f64::from(index) / 120.0).sin_cos();
    (0..=120).map(corner).map(|(sin, cos)| State { q: radius * cos, v: -radius * sin }).collect()
}

fn cycle(radius: f64, stable: bool) -> Cycle {
    Cycle {
        stable,
        q_min: -radius,
        q_max: radius,
        v_min: -radius,
        v_max: radius,
        period: 6.3,
        multiplier: (!stable).then_some(3.8),
        log_multiplier: if stable { -710.0 } else { 3.8_f64.ln() },
        clearance: radius - 0.1,
        log_clearance: (radius - 0.1).ln(),
        error: 1e-14,
    }
}

/// A map on which every turning point on the right comes to half of it, or from far out to twice it.
fn halving(parameters: Parameters) -> ReturnMap {
    let turn = |index: u8| {
        let from = 0.02 * f64::from(index);
        Return { from, to: Some(if from < 1.0 { 0.5 * from } else { 2.0 * from - 1.5 }) }
    };
    ReturnMap {
        parameters,
        sides: [Vec::new(), (5..=100).map(turn).collect()],
        cost: Cost { evaluations: 900, steps: 30, rejected: 0 },
    }
}

/// A chart whose lines are parted by a border that moves to the left.
fn parted(plane: Plane) -> Chart {
    let line = |index: u8| {
        let part = f64::from(index) / 20.0;
        let (from, to) = plane.right_range;
        let fold = -0.4 * part;
        let band = |from, to, regime| Band { from, to, regime: Some(regime) };
        let bands = vec![band(from, fold, Regime::Coexisting), band(fold, to, Regime::Global)];
        let at = plane.up_range.0 + part * (plane.up_range.1 - plane.up_range.0);
        let harmonic = Some(0.9 * fold);
        Line { at, bands, fold: Some(fold), harmonic, escape: None, failure: None }
    };
    let cost = Cost { evaluations: 9_000, steps: 300, rejected: 0 };
    Chart { plane, along: plane.right, lines: (0..=20).map(line).collect(), cost }
}

/// What accuracy costs on a short motion, computed once and for all.
fn compared() -> Box<Trade> {
    static FOUND: LazyLock<Box<Trade>> = LazyLock::new(|| {
        let parameters = Parameters { d: -0.1, d2: 0.0, d3: 0.05, r: 0.1 };
        let problem = Problem { parameters, until: 20.0, ..Problem::default() };
        let limits = Limits { evaluations: 50_000, ..Limits::PATIENT };
        Box::new(Trade::of(&problem, &limits).unwrap())
    });
    FOUND.clone()
}

/// A branch that turns back at a fold.
fn folded(parameter: Symbol) -> Branch {
    let point = |index: u16| {
        let q_max = 0.05 + f64::from(index) * 0.02;
        BranchPoint {
            value: -0.05 / q_max - 0.15 * q_max * q_max,
            cycle: cycle(q_max, q_max > 0.55),
        }
    };
    let fold = Special::new(SpecialKind::Fold, -0.136_2, Some(cycle(0.55, false)));
    let escape = Special::new(SpecialKind::Escape, 0.05, None);
    Branch {
        parameter,
        pieces: vec![(0..120).map(point).collect()],
        special: vec![fold, escape],
        cost: Cost { evaluations: 56_000, steps: 900, rejected: 3 },
    }
}

fn draw(session: &Session, look: settings::Look) -> Buffer {
    let Size { width, height } = session.size;
    let screen = Rect::new(0, 0, width, height);
    let mut buffer = Buffer::empty(screen);
    render(screen, session, &Look::new(look), &mut buffer);
    buffer
}

fn braille() -> settings::Look {
    settings::Look { glyphs: Glyphs::Braille, colors: Colors::Sixteen, ..settings::Look::default() }
}

fn letters() -> settings::Look {
    settings::Look { glyphs: Glyphs::Ascii, colors: Colors::Never, ..settings::Look::default() }
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
    let exhibit =
        |view, window| Exhibit { view, axes: Axes::default(), window: Some(window), family: None };
    Scene {
        name: "approved".into(),
        title: "A scene with a fold".into(),
        look: "Two cycles meet in the fold. ".repeat(4),
        press: "Right on D, past the fold. ".repeat(3),
        terms: [Symbol::D, Symbol::D3, Symbol::R].into(),
        problem,
        layers: LAYERS.iter().map(|row| row.layer).filter(|layer| !drawn_over(*layer)).collect(),
        plots: vec![
            exhibit(View::Phase, Window { x: span(-1.6, 1.6), y: span(-1.6, 1.6) }),
            exhibit(View::Diagram, Window { x: span(-0.8, 0.1), y: span(0.0, 2.0) }),
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
        ("time-series", (80, 24), "<tab> <tab> ; E z <right>", braille()),
        ("energy-ledger", (80, 24), "<tab> <tab> V / l e d <enter> <down>", braille()),
        ("return-map", (80, 24), "<tab> Q V / r e t <enter> <right>", braille()),
        ("trade", (80, 24), "<tab> Q V / t r a d e <enter> <right>", letters()),
        ("costs", (100, 30), "$", letters()),
        ("dial", (100, 24), "}", letters()),
        ("regimes", (80, 24), "<tab> Q V / r e g <enter> <right>", braille()),
        ("views", (80, 24), "V", letters()),
        ("scan", (80, 24), "% <enter> z <right> <right>", braille()),
        ("scan-form", (80, 24), "% <down> x <enter>", letters()),
        ("scan-table", (80, 24), "% <enter> z G <down> <down>", braille()),
        (
            "scan-map",
            (100, 30),
            "% <up> <up> <up> <up> <up> <right> <right> <tab> 0 <tab> 1 <enter> z",
            braille(),
        ),
        (
            "scan-map-letters",
            (80, 24),
            "% <up> <up> <up> <up> <up> <right> <right> <tab> 0 <tab> 1 <enter>",
            letters(),
        ),
    ];
    for (name, (width, height), keys, look) in cases {
        let mut session = Session::new(Arc::new(approved()), Size { width, height });
        settle(&mut session);
        press(&mut session, keys);
        insta::assert_snapshot!(name, picture_of(&session, look));
    }
}

/// The screen without its last line, whose keys are the business of the command table.
fn picture_of(session: &Session, look: settings::Look) -> String {
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
fn the_layer_list_says_which_are_on() {
    let screen = text(&draw(&settled("plain", 80, 60, "v"), letters()));
    for row in &LAYERS {
        let on = if find("plain").unwrap().layers.contains(&row.layer) { "[x]" } else { "[ ]" };
        assert!(screen.contains(&format!("{on} {}", row.name)), "{screen}");
    }
}

#[test]
fn a_search_leaves_what_contains_it() {
    let screen = text(&draw(&settled("plain", 80, 24, "? / z o o m"), letters()));
    assert!(screen.contains("keys: /zoom_") && screen.contains("Zoom in"), "{screen}");
    assert!(!screen.contains("Undo"));
    let screen = text(&draw(&settled("plain", 80, 24, "? / x q z"), letters()));
    assert!(screen.contains("nothing found"), "{screen}");
}

#[test]
fn the_scene_picker_shows_every_scene_and_what_the_selected_one_is_about() {
    let session = settled("linear", 100, 60, "s");
    let screen = text(&draw(&session, letters()));
    assert!(library().iter().all(|scene| screen.contains(&scene.title)), "{screen}");
    let first: Vec<&str> = session.scene.look.split_whitespace().take(4).collect();
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
        let result = Err(Failure::Reason(Reason::Budget { evaluations: 5 }));
        let answered = Answered { request, result, seconds: 0.1, complete: true };
        update(&mut session, Msg::Answered(Box::new(answered)));
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
        assert!(!screen.contains('?') || keys != "s", "{screen}");
    }
}

#[test]
fn without_colour_no_cell_has_any_and_stable_still_differs_from_unstable() {
    for (glyphs, _) in GLYPHS {
        for (theme, _) in THEMES {
            let colors = Colors::Never;
            let look = settings::Look { glyphs, colors, theme, mouse: false };
            let session = settled("supercritical", 80, 24, "");
            let colourless = draw(&session, look);
            let coloured = draw(&session, settings::Look { colors: Colors::Sixteen, ..look });
            assert_eq!(text(&colourless), text(&coloured), "colour changes no character");
            for cell in &colourless.content {
                assert_eq!((cell.fg, cell.bg), Default::default());
            }
        }
    }
    let only = |stable: bool| {
        let mut session = settled("supercritical", 80, 24, "");
        session.layers = [Layer::Cycles].into();
        if let Some(Ok(Answer::Cycles(found))) =
            session.answers.get_mut(&Slot::Cycles).map(|held| Arc::make_mut(held).result.as_mut())
        {
            found.cycles = vec![cycle(1.0, stable)];
            found.picture = Some(picture(Vec::new(), vec![circle(1.0)]));
        }
        text(&draw(&session, settings::Look { colors: Colors::Never, ..braille() }))
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
    let help = settled("plain", 100, 500, "?");
    let screen = text(&draw(&help, letters()));
    for command in crate::session::COMMANDS {
        assert!(screen.contains(command.doc), "{}", command.name);
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
fn every_scene_fits_every_size() {
    for scene in library() {
        let sizes =
            (1..=25).map(|n| (n * 8, n * 3)).chain([(1, 1), (500, 200), (200, 16), (60, 200)]);
        for (width, height) in sizes {
            for keys in ["", "?", "s", "<enter>"] {
                let session = settled(&scene.name, width, height, keys);
                for (glyphs, _) in GLYPHS {
                    draw(&session, settings::Look { glyphs, ..braille() });
                }
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
        let mut session = settled("supercritical", width, height, "<tab>");
        session.layers = LAYERS.iter().map(|row| row.layer).collect();
        settle(&mut session);
        let states: Vec<State> = curve.iter().map(|(q, v)| State { q: *q, v: *v }).collect();
        let own = session.plots.iter_mut().flat_map(|plot| plot.answers.values_mut());
        for held in session.answers.values_mut().chain(own) {
            match &mut Arc::make_mut(held).result {
                Ok(Answer::Trajectory(found)) => {
                    found.samples = curve.iter().map(|(q, v)| Sample { tau: 0.0, q: *q, v: *v }).collect();
                    found.outcome = Outcome::Moving { tau: value, q: low, v: high };
                }
                Ok(Answer::Cycles(found)) => {
                    found.picture = Some(picture(states.clone(), vec![states.clone(), states.clone()]));
                    found.cycles = vec![cycle(value, true), cycle(low, false)];
                }
                Ok(Answer::Branch(found)) => {
                    found.pieces = vec![curve.iter().map(|(value, q_max)| {
                        BranchPoint { value: *value, cycle: cycle(*q_max, *q_max > 0.0) }
                    }).collect()];
                    found.special[0].cycle = Some(cycle(value, true));
                    session.held = Some(Stop::at(0, &found.special[0]));
                }
                Ok(Answer::Balance(found)) => found.balanced.clear(),
                Ok(Answer::ReturnMap(found)) => {
                    let turn = |(from, to): &(f64, f64)| Return { from: *from, to: Some(*to) };
                    found.sides = [curve.iter().map(turn).collect(), Vec::new()];
                }
                Ok(Answer::Regimes(found)) => {
                    for (line, (at, fold)) in found.lines.iter_mut().zip(&curve) {
                        (line.at, line.fold, line.harmonic) = (*at, Some(*fold), Some(low));
                    }
                }
                Ok(Answer::Capture(found)) => found.curves = vec![states.clone()],
                Ok(
                    Answer::Family(_)
                    | Answer::Trade(_)
                    | Answer::Reference(_)
                    | Answer::Rows(_)
                    | Answer::Claims(_),
                )
                | Err(_) => {}
            }
        }
        session.plots[0].cursor = Some(Point { x: value, y: low });
        if let Ok(span) = Span::new(low.min(high), low.max(high)) {
            session.plots.iter_mut().for_each(|plot| plot.window = Window { x: span, y: span });
        }
        for (glyphs, _) in GLYPHS {
            draw(&session, settings::Look { glyphs, ..braille() });
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
        assert!(session.measures() && session.unmeasured().is_some());
        let drawn = draw(&session, braille());
        let screen = text(&drawn);
        assert!(screen.contains(expected), "{width}: {screen}");
        press(&mut session, "g");
        assert!(!text(&draw(&session, braille())).contains("gave up"));
    }
}
