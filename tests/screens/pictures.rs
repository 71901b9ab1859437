//! Facts about what pictures show: rest in every diagram, names of what is drawn, maps of what is dangerous.

use super::by_hand::{press, settle};
use super::{all_pictures, braille, draw, letters, settled};
use hopfscope::flow::Limits;
use hopfscope::model::Knob;
use hopfscope::picture;
use hopfscope::picture::{Dash, Item, LineStyle, Mark, Role};
use hopfscope::question::answer;
use hopfscope::scene::{Ordinate, Point, View, find, library};
use hopfscope::session::{Msg, Session, Size, update};
use hopfscope::view::Look;
use hopfscope::view::screen::text;

/// A scene whose questions about branches are answered by computation.
pub fn computed(scene: &str) -> Session {
    let mut session = Session::new(find(scene).unwrap(), Size { width: 120, height: 40 });
    answered(&mut session);
    session
}

/// Answers what a session asks for by computation.
pub fn answered(session: &mut Session) {
    // Some ask for what others find.
    for _ in 0..2 {
        for request in session.wants() {
            let result = Ok(answer(&request, &Limits::PATIENT).unwrap());
            update(session, Msg::answered(request, result, 0.0));
        }
    }
}

/// The heights of what is called rest at a value of the parameter of a diagram, with its line.
fn rests(session: &Session, index: usize, at: f64) -> Vec<(LineStyle, f64)> {
    let picture = picture::of(session, index);
    let heights = picture.items.iter().filter_map(|item| match item {
        Item::Graph(line, value) if line.name.starts_with("rest") => {
            Some((line.clone(), value(at)?))
        }
        _ => None,
    });
    heights.collect()
}

#[test]
fn rest_is_in_every_bifurcation_diagram() {
    let mut looked = 0;
    for scene in library() {
        let session = Session::new(scene.clone(), Size { width: 120, height: 40 });
        let diagrams = session.plots.iter().enumerate().filter(|(_, it)| it.view == View::Diagram);
        for (index, plot) in diagrams {
            let family = session.shown(index).len() > 1;
            for shown in session.shown(index) {
                let own: Vec<_> = [plot.window.x.from(), plot.window.x.to()]
                    .into_iter()
                    .filter(|at| plot.axes.abscissa != Knob::D || *at != 0.0)
                    .flat_map(|at| {
                        let found = rests(&session, index, at);
                        let of =
                            |line: &LineStyle| line.variant.as_ref().map(|it| it.label.clone());
                        let ours = |(line, _): &(LineStyle, f64)| {
                            of(line).unwrap_or_default() == shown.variant.label
                        };
                        found
                            .into_iter()
                            .filter(ours)
                            .map(move |found| (at, found))
                            .collect::<Vec<_>>()
                    })
                    .collect();
                assert!(!own.is_empty(), "{} {index}: {:?}", scene.name, shown.variant.label);
                let r = shown.problem.parameters.r;
                for (at, (line, height)) in own {
                    let unit = if plot.axes.label().ends_with("/r") { r } else { 1.0 };
                    let band = matches!(plot.axes.ordinate, Ordinate::QMax | Ordinate::Mean);
                    let expected = if band { r / unit } else { 0.0 };
                    assert!((height.abs() - expected).abs() < 1e-15, "{}: {height}", scene.name);
                    // Without friction the equilibrium is stable to the right of the Hopf point.
                    let beside = family && !shown.present;
                    let pen = match (r > 0.0, at > 0.0) {
                        (true, _) if beside => (Role::Sticking, Dash::Solid),
                        (true, _) => (Role::Sticking, Dash::Thick),
                        (false, true) => (Role::Stable, Dash::Thick),
                        (false, false) => (Role::Unstable, Dash::DashDot),
                    };
                    assert_eq!((line.role, line.dash), pen, "{} at {at}", scene.name);
                    looked += 1;
                }
            }
        }
    }
    assert!(looked > 60, "{looked}");
}

#[test]
fn an_h_stands_only_where_a_hopf_point_is() {
    let letters_h = |session: &Session| -> Vec<Point> {
        let captions = all_pictures(session).into_iter().flat_map(|picture| picture.captions);
        captions.filter(|caption| caption.short == "H").map(|caption| caption.at).collect()
    };
    let frictionless = letters_h(&computed("hopf"));
    assert!(frictionless.iter().all(|at| at.x == 0.0 && at.y == 0.0), "{frictionless:?}");
    assert_eq!(frictionless.len(), 1);
    for scene in ["supercritical", "subcritical", "regimes", "fig10", "fig16b"] {
        assert_eq!(letters_h(&computed(scene)), [], "{scene}");
    }
}

#[test]
fn the_legend_names_what_is_seen_and_nothing_else() {
    let rows = |session: &Session, name: &str| {
        let screen = text(&draw(session, letters()));
        let legend = screen.lines().skip(55).take(2).collect::<Vec<_>>().join("  ");
        let entry = |entry: &&str| *entry == name || entry.ends_with(&format!(" {name}"));
        legend.split("  ").filter(entry).count()
    };
    let names = ["stable cycle", "unstable cycle", "sticking set", "first harmonic"];
    let mut session = settled("supercritical", 200, 60, "");
    for name in names {
        assert_eq!(rows(&session, name), 1, "{name}");
    }
    // Far out there are no cycles to see.
    for plot in &mut session.plots {
        plot.window.x = hopfscope::scene::Span::new(50.0, 60.0).unwrap();
    }
    for name in ["stable cycle", "unstable cycle", "first harmonic", "motion"] {
        assert_eq!(rows(&session, name), 0, "{name}");
    }
}

/// The map of a scan of margins over D and r, and its session.
fn map() -> Session {
    let mut session = settled("supercritical", 100, 30, "");
    let line = "scan D=-0.9:-0.1:9 r=log:0.01:1:9 margin";
    let keys: Vec<String> = line
        .chars()
        .map(|key| match key {
            ' ' => "<space>".to_owned(),
            key => key.to_string(),
        })
        .collect();
    press(&mut session, &format!(": {} <enter>", keys.join(" ")));
    settle(&mut session);
    session
}

#[test]
fn a_map_labels_decades_and_is_the_stronger_the_more_dangerous_in_one_hue() {
    let session = map();
    let screen = text(&draw(&session, braille()));
    for label in ["0.01", "0.1", "1"] {
        let at_the_axis = |line: &str| line.contains(&format!(" {label}\u{2524}"));
        assert!(screen.lines().any(at_the_axis), "{label}: {screen}");
    }
    assert!(!screen.contains("log10"), "{screen}");
    assert!(screen.contains("r over D"), "{screen}");
    let scanned = session.scanned.as_ref().unwrap();
    let (low, high) = scanned.range().unwrap();
    let legend =
        screen.lines().rfind(|line| line.contains("dangerous ") && line.contains('\u{2588}'));
    let legend = legend.unwrap_or_else(|| panic!("{screen}"));
    for value in [low, high] {
        let three = hopfscope::words::number::significant(value, 3);
        assert!(legend.contains(&three), "{three}: {legend}");
    }
    // The smallest margin is the strongest shade, and comes first.
    let strong = legend.find('\u{2588}').unwrap();
    assert!(strong < legend.find('\u{2591}').unwrap(), "{legend}");
    let look = Look::new(braille());
    let buffer = draw(&session, braille());
    let shades = buffer
        .content
        .iter()
        .filter(|cell| "\u{2591}\u{2592}\u{2593}\u{2588}".contains(cell.symbol()));
    let colours: Vec<_> = shades.map(|cell| cell.fg).collect();
    let hue = look.style(Role::Danger).fg.unwrap();
    assert!(!colours.is_empty() && colours.iter().all(|fg| *fg == hue));
}

#[test]
fn a_map_says_which_end_is_dangerous_and_what_has_no_number() {
    let mut session = map();
    let screen = text(&draw(&session, braille()));
    let legend = screen.lines().find(|line| line.contains("dangerous ")).unwrap();
    let place = |word: &str| legend.find(word).unwrap_or_else(|| panic!("{word}: {legend}"));
    assert!(
        place("dangerous") < place("\u{2588}") && place("\u{2591}") < place("safe"),
        "{legend}"
    );
    assert!(screen.contains("- every kick survived  ? gave up"), "{screen}");
    assert!(!screen.contains("none"), "{screen}");
    // A point without a number is read in the same words.
    session.scanned.as_mut().unwrap().at = 3;
    let screen = text(&draw(&session, braille()));
    assert!(screen.contains("displacement every kick survived"), "{screen}");
}

#[test]
fn beside_the_present_branch_others_are_paler_and_have_no_marks() {
    let session = computed("supercritical");
    let picture = picture::of(&session, 1);
    let mut marked: Vec<Point> = Vec::new();
    for item in &picture.items {
        match item {
            Item::Marks(marks) if marks.role == Role::Current => marked.extend(&marks.at),
            Item::Curve(line, _) if line.name.contains("stable cycle") => {
                let label = line.variant.as_ref().map_or("", |variant| &variant.label);
                let present = label == "r = 0.1";
                assert_eq!(matches!(line.role, Role::Stable | Role::Unstable), present, "{label}");
                assert_eq!(line.name.ends_with("at other values"), !present, "{label}");
            }
            _ => {}
        }
    }
    let found = session.cycles().unwrap();
    assert_eq!(marked.len(), found.cycles.len());
    for cycle in &found.cycles {
        assert!(marked.iter().any(|at| (at.y - cycle.q_max).abs() < 1e-6), "{marked:?}");
    }
}

#[test]
fn what_is_drawn_in_red_and_green_is_a_cycle_or_the_edge_of_a_basin() {
    let names = ["stable", "cycle", "border of the basin", "rest", "fixed point", "stick-slip"];
    let mut looked = 0;
    for scene in library() {
        let mut session = settled(&scene.name, 120, 40, "");
        session.layers = hopfscope::scene::LAYERS.iter().map(|row| row.layer).collect();
        settle(&mut session);
        for item in all_pictures(&session).iter().flat_map(|picture| &picture.items) {
            let (role, name) = match item {
                Item::Curve(line, _)
                | Item::Graph(line, _)
                | Item::Upright(line, _)
                | Item::Shade(line, _)
                | Item::Beyond(line, _)
                | Item::Columns(line, ..)
                | Item::Rows(line, ..) => (line.role, line.name.to_string()),
                Item::Arrows(_) => (Role::Field, "direction of flow".to_owned()),
                Item::Marks(marks) => (marks.role, marks.name.to_string()),
                Item::Texture(_) => continue,
            };
            // That of a line whose name `assets/lines.txt` does not know.
            assert_ne!(role, Role::Failure, "{}: {name}", scene.name);
            if matches!(role, Role::Stable | Role::Unstable) {
                let named = names.iter().any(|known| name.contains(known));
                assert!(named, "{}: {name}", scene.name);
                looked += 1;
            }
        }
    }
    assert!(looked > 50, "{looked}");
}

/// By computation, not by hand: the motion from inside of the unstable cycle comes to rest, the one from outside
/// does not, and both stand in one picture, told apart, with the numbers at their starts.
#[test]
fn both_sides_of_the_unstable_cycle_stand_in_one_picture() {
    let mut session = computed("supercritical");
    for key in ["i", "o"] {
        update(&mut session, Msg::Key(key.parse().unwrap()));
        for request in session.asks() {
            let result = Ok(answer(&request, &Limits::PATIENT).unwrap());
            update(&mut session, Msg::answered(request, result, 0.0));
        }
    }
    let picture = picture::of(&session, 0);
    let mut motions = Vec::new();
    let numbered = picture.captions.iter().filter(|it| it.long.parse::<usize>().is_ok());
    let mut numbers: Vec<_> = numbered.map(|it| (it.long.to_string(), it.at)).collect();
    let mut rests = Vec::new();
    for item in &picture.items {
        match item {
            Item::Curve(line, points) if line.name.starts_with("motion ") => {
                motions.push((line.name.to_string(), line.role, line.dash, points[0]));
            }
            Item::Marks(marks) if marks.mark == Mark::Rest => rests.push(marks.role),
            _ => {}
        }
    }
    motions.sort_by(|one, other| one.0.cmp(&other.0));
    numbers.sort_by(|one, other| one.0.cmp(&other.0));
    let found = session.cycles().unwrap();
    let edge = found.cycles.iter().find(|cycle| !cycle.stable).unwrap().q_max;
    let [(_, _, _, first), inside, outside] = &motions[..] else { panic!("{motions:?}") };
    assert!(inside.3.x < edge && edge < outside.3.x, "{edge} between {inside:?} and {outside:?}");
    assert_eq!((inside.1, outside.1, outside.2), (Role::Beside, Role::Trajectory, Dash::Solid));
    let at = |number: &str, at: Point| (number.to_owned(), at);
    let starts = [at("1", *first), at("2", inside.3), at("3", outside.3)];
    assert!(starts.iter().all(|start| numbers.contains(start)), "{numbers:?}");
    // And at the ends.
    assert_eq!(numbers.len(), 6, "{numbers:?}");
    assert_eq!(rests, [Role::Beside], "the one from inside, and no other");
    let screen = text(&draw(&session, braille()));
    assert!(screen.contains("of motion 3"), "{screen}");
    assert!(screen.contains("motion 3 grows onto the stable cycle"), "{screen}");
}

#[test]
fn the_ledger_has_room_for_the_works_of_each_motion() {
    let mut session = settled("supercritical", 120, 60, "<tab> V / l e d g <enter>");
    assert_eq!(session.plots[0].view, View::EnergyLedger);
    let mut lines = Vec::new();
    for key in ["i", "o", "d", "u", "c"] {
        press(&mut session, key);
        lines.push(session.ledger().len());
        let count = f64::from(u32::try_from(session.ledger().len()).unwrap());
        assert_eq!(session.plots[0].window.y.width(), count, "{key}");
    }
    assert!(lines[0] < lines[1] && lines[1] > lines[2] && lines[2] > lines[4], "{lines:?}");
}

#[test]
fn a_label_within_a_picture_takes_no_colour_from_the_curve_below() {
    // So low a diagram has its labels on the band of rest, which is yellow.
    let session = settled("linear", 80, 24, "");
    let buffer = draw(&session, braille());
    let row = |y: u16| (0..80).map(|x| buffer[(x, y)].symbol()).collect::<Vec<_>>();
    let label = ["1", ".", "0"];
    let found: Vec<(u16, u16)> = (2..20)
        .flat_map(|y| (50..77).map(move |x| (x, y)))
        .filter(|&(x, y)| row(y)[usize::from(x)..][..3] == label)
        .collect();
    assert!(!found.is_empty(), "{}", text(&buffer));
    for (x, y) in found {
        assert_eq!(buffer[(x, y)].fg, ratatui::style::Color::Reset, "column {x}, row {y}");
    }
}
