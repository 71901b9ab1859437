//! Figures: one data set in every form, correct curves, and polylines that look smooth.

mod looks;
mod numbers;
mod paper;
mod printed;
#[path = "../program/mod.rs"]
mod program;
mod studies;

use std::collections::BTreeSet;
use std::f64::consts::PI;
use std::fs;

use hopfscope::figure::{Figure, FigureForm, Outline, facts, file, runs};
use hopfscope::flow::Limits;
use hopfscope::numerics::elementary::{atan2, cbrt, exp, exp_m1, hypot, powi};
use hopfscope::question::Fineness;
use hopfscope::runtime::print;
use hopfscope::runtime::print::complete;
use hopfscope::scene::library::names;
use hopfscope::scene::{Point, Span, Window, find, library};
use hopfscope::session::{Framing, Msg, Session, Size, update};
use program::run;
use roxmltree::Document;
use serde_json::Value;

/// A figure of a scene.
fn figure(scene: &str, fineness: Fineness) -> Figure {
    let scene = find(scene).expect("a scene");
    let mut session = Session::new(scene, Size { width: 100, height: 30 });
    complete(&mut session, fineness, &Limits::PATIENT).expect("every scene can be computed");
    let plots = 0..session.plots.len();
    Figure::of(&session, plots)
}

fn text(figure: &Figure, form: FigureForm) -> String {
    String::from_utf8(file(figure, form).unwrap()).unwrap()
}

fn scenes() -> impl Iterator<Item = &'static str> {
    library().iter().map(|scene| scene.name.as_str())
}

/// The curves of a panel (counted from 0) whose name begins with `name`.
fn curves<'a>(figure: &'a Figure, panel: usize, name: &str) -> Vec<&'a Outline> {
    let all = figure.panels[panel].curves.iter();
    let found: Vec<_> = all.filter(|curve| curve.name.starts_with(name)).collect();
    assert!(!found.is_empty(), "{} has no {name}", figure.figure);
    found
}

#[test]
fn a_figure_of_a_beside_b_holds_both_by_name_with_the_parameters_of_each() {
    let mut session = Session::new(find("plain").unwrap(), Size { width: 100, height: 30 });
    for key in ["p", "<right>"] {
        update(&mut session, Msg::Key(key.parse().unwrap()));
    }
    complete(&mut session, Fineness::PRINT, &Limits::PATIENT).unwrap();
    let drawn = Figure::of(&session, 0..2);
    let damping = |name: &str| curves(&drawn, 0, name)[0].parameters["D"];
    let names = ["motion, A", "motion, B", "unstable cycle, A", "unstable cycle, B"];
    assert_eq!(names.map(damping), [-0.1, -0.09, -0.1, -0.09]);
    // The branch over D is that of both.
    let branch: Vec<_> = curves(&drawn, 1, "unstable cycle").iter().map(|it| &it.name).collect();
    assert_eq!(branch, ["unstable cycle"]);
    for form in [FigureForm::Csv, FigureForm::Json, FigureForm::Svg] {
        assert!(text(&drawn, form).contains("motion, A"), "{form:?}");
    }
}

#[test]
fn every_scene_is_the_same_figure_in_every_form() {
    for scene in scenes() {
        let drawn = figure(scene, Fineness::PRINT);
        let json: Value = serde_json::from_str(&text(&drawn, FigureForm::Json)).unwrap();
        for field in ["figure", "title", "program", "units", "parameters", "method", "tolerance"] {
            assert!(!json[field].is_null(), "{scene}: {field}");
        }
        assert_eq!(json["figure"], scene);
        same_numbers(scene, &json, &text(&drawn, FigureForm::Csv));
        let told = facts(&drawn);
        for word in
            ["D = ", "q0 = ", "method ", "tolerance ", "hopfscope 0.", "dimensionless", "panel 1: "]
        {
            assert!(told.contains(word), "{scene}: {word}");
        }
        vector_picture(&drawn, &text(&drawn, FigureForm::Svg));
    }
}

/// Every point of the JSON is in the CSV, and nothing else is.
fn same_numbers(scene: &str, json: &Value, csv: &str) {
    let value =
        |value: &Value| value.as_f64().map_or_else(String::new, |value| format!("{value:?}"));
    let mut expected = Vec::new();
    for (panel, shown) in (1..).zip(json["panels"].as_array().unwrap()) {
        for (kind, list, points) in [("curve", "curves", "points"), ("area", "areas", "edge")] {
            for (number, one) in (1..).zip(shown[list].as_array().unwrap()) {
                assert!(one["parameters"].is_object(), "{scene}: {one:?}");
                for point in one[points].as_array().unwrap() {
                    let (x, y) = (value(&point[0]), value(&point[1]));
                    expected.push(format!("{panel},{kind},{number};{x},{y}"));
                }
            }
        }
        for (number, mark) in (1..).zip(shown["marks"].as_array().unwrap()) {
            expected.push(format!(
                "{panel},mark,{number};{},{}",
                value(&mark["x"]),
                value(&mark["y"])
            ));
        }
    }
    let rows = csv.lines().skip(1).map(|line| {
        let first: Vec<&str> = line.splitn(4, ',').take(3).collect();
        let last: Vec<&str> = line.rsplitn(3, ',').take(2).collect();
        let number =
            |text: &str| text.parse::<f64>().map_or_else(|_| String::new(), |x| format!("{x:?}"));
        format!("{};{},{}", first.join(","), number(last[1]), number(last[0]))
    });
    assert!(rows.eq(expected), "{scene}");
}

/// The letters of a text element, whatever they are set in.
fn said(node: &roxmltree::Node) -> String {
    node.descendants().filter(roxmltree::Node::is_text).filter_map(|it| it.text()).collect()
}

/// The letters in which a figure sets a text.
fn set(text: &str) -> String {
    runs(text).into_iter().map(|run| run.text).collect()
}

/// A well-formed SVG with axes, a legend, and lines that are solid for stable and dashed for unstable objects.
fn vector_picture(figure: &Figure, svg: &str) {
    let scene = &figure.figure;
    let picture = Document::parse(svg).unwrap_or_else(|error| panic!("{scene}: {error}"));
    let letters: BTreeSet<String> = picture
        .descendants()
        .filter(|node| node.has_tag_name("text"))
        .map(|node| said(&node))
        .collect();
    let dashed = picture.descendants().any(|node| node.has_attribute("stroke-dasharray"));
    assert!(letters.contains(&set(&figure.title)), "{scene}");
    for panel in &figure.panels {
        assert!(
            letters.iter().any(|text| text.starts_with(&set(panel.scales[0].title(&panel.x.name)))),
            "{scene}: {:?}",
            panel.x
        );
        assert!(
            letters.iter().any(|text| text.starts_with(&set(panel.scales[1].title(&panel.y.name)))),
            "{scene}: {:?}",
            panel.y
        );
        for curve in &panel.curves {
            let name = curve.name.split(", ").next().unwrap();
            assert!(letters.contains(&set(name)), "{scene}: {name} is not in the legend");
            assert!(
                curve.style != Some(hopfscope::picture::Dash::Dashed) || dashed,
                "{scene}: {name}"
            );
            let style: &str = curve.style.map_or("", Into::into);
            let expected = match curve.name.split(' ').next() {
                Some("stable") => "solid",
                Some("unstable") => "dashed",
                _ => style,
            };
            assert_eq!(style, expected, "{scene}: {name}");
        }
    }
    assert!(!svg.contains("NaN") && !svg.contains("inf"), "{scene}");
    no_text_covers_another(scene, &picture);
}

/// Texts next to points and curves: none covers another.
fn no_text_covers_another(scene: &str, picture: &Document) {
    /// Minimum width of a letter, and height of a line, in pixels.
    const LETTER: (f64, f64) = (5.0, 11.0);
    let number = |node: &roxmltree::Node, name: &str| -> f64 {
        node.attribute(name).and_then(|text| text.parse().ok()).unwrap()
    };
    let beside = |node: &roxmltree::Node| {
        node.has_tag_name("text")
            && node.attribute("font-size") == Some("10.5")
            && node.attribute("fill") != Some("none")
    };
    let texts = picture.descendants().filter(beside).map(|node| {
        let text = said(&node);
        let letters = f64::from(u16::try_from(text.chars().count()).unwrap());
        (text, number(&node, "x"), number(&node, "y"), LETTER.0 * letters)
    });
    let texts: Vec<_> = texts.collect();
    for (index, (text, x, y, width)) in texts.iter().enumerate() {
        for (other, left, line, length) in &texts[..index] {
            let apart = x > &(left + length) || left > &(x + width) || (y - line).abs() >= LETTER.1;
            assert!(apart, "{scene}: {text} covers {other}");
        }
    }
}

/// Width and height of a panel, in pixels.
const PANEL: (f64, f64) = (380.0, 300.0);

/// A curve within its panel, in pixels.
fn on_paper(figure: &Figure, panel: usize, curve: &Outline) -> Vec<(f64, f64)> {
    let window = figure.panels[panel].window;
    let place =
        |[x, y]: &[f64; 2]| (PANEL.0 * window.x.fraction(*x), PANEL.1 * window.y.fraction(*y));
    curve.points.iter().map(place).collect()
}

/// The distance of a point from a polyline, and the number of the closest chord; those around number `near` are tried
/// first.
fn aside(point: (f64, f64), line: &[(f64, f64)], near: usize) -> (f64, usize) {
    let distance = |pair: &[(f64, f64)]| -> f64 {
        let (along, up) = (pair[1].0 - pair[0].0, pair[1].1 - pair[0].1);
        let (right, above) = (point.0 - pair[0].0, point.1 - pair[0].1);
        let part = (right * along + above * up) / powi(hypot(along, up), 2);
        let part = if part.is_nan() { 0.0 } else { part.clamp(0.0, 1.0) };
        hypot(right - part * along, above - part * up)
    };
    let least = |from: usize, to: usize| {
        let chords = line[from.min(line.len())..to.min(line.len())].windows(2).map(distance);
        chords
            .enumerate()
            .map(|(index, apart)| (apart, from + index))
            .min_by(|(one, _), (other, _)| one.total_cmp(other))
    };
    let close = least(near.saturating_sub(8), near + 8).filter(|(apart, _)| *apart < FAINT);
    close.or_else(|| least(0, line.len())).unwrap_or((f64::INFINITY, 0))
}

/// Invisible distance, in pixels.
const FAINT: f64 = 0.05;

#[test]
fn no_chord_misses_its_curve_by_more_than_a_twentieth_of_a_pixel() {
    for scene in names().filter(|scene| scene.starts_with("fig")) {
        let (print, truth) =
            (figure(scene, Fineness::PRINT), figure(scene, Fineness::PRINT.finer(3)));
        for (panel, (shown, finer)) in print.panels.iter().zip(&truth.panels).enumerate() {
            assert_eq!(shown.curves.len(), finer.curves.len(), "{scene}");
            for (curve, truth) in shown.curves.iter().zip(&finer.curves) {
                let line = on_paper(&print, panel, curve);
                let dense = on_paper(&print, panel, truth);
                for (index, point) in dense.iter().enumerate() {
                    let inside =
                        (0.0..=PANEL.0).contains(&point.0) && (0.0..=PANEL.1).contains(&point.1);
                    if inside {
                        let (missed, _) = aside(*point, &line, index * line.len() / dense.len());
                        assert!(missed < FAINT, "{scene}, {}, {point:?}: {missed} px", curve.name);
                    }
                }
            }
        }
    }
}

/// Magnified a hundredfold around a point of a curve of each kind: the chords are as close as before, because
/// there are more of them, and only there.
#[test]
fn no_chord_misses_its_curve_after_zooming_either() {
    let mut coarse = 0;
    for (scene, panel, part) in [
        ("supercritical", 0, 0.3),
        ("supercritical", 1, 0.9),
        ("fig07", 0, 0.5),
        ("fig07", 2, 0.4),
        ("fig12", 0, 0.6),
        ("fig13", 2, 0.3),
        ("return-map", 1, 0.5),
    ] {
        let open = || Session::new(find(scene).expect("a scene"), Size { width: 100, height: 30 });
        let mut session = open();
        complete(&mut session, Fineness::PRINT, &Limits::PATIENT).expect("an answer");
        let whole = Figure::of(&session, [panel]);
        // A point of the longest curve inside the window.
        let Window { x, y } = whole.panels[0].window;
        let longest = whole.panels[0].curves.iter().max_by_key(|curve| curve.points.len()).unwrap();
        let inside =
            |[px, py]: &&[f64; 2]| whole.panels[0].window.contains(Point { x: *px, y: *py });
        let seen: Vec<&[f64; 2]> = longest.points.iter().filter(inside).collect();
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            clippy::cast_precision_loss,
            reason = "an index"
        )]
        let middle = *seen[(part * seen.len() as f64) as usize];
        let around = |middle: f64, span: Span| {
            Span::new(middle - 0.005 * span.width(), middle + 0.005 * span.width()).unwrap()
        };
        let window = Window { x: around(middle[0], x), y: around(middle[1], y) };
        let look = |session: &mut Session| {
            session.plots[panel].window = window;
            session.plots[panel].framing = Framing::User;
        };
        look(&mut session);
        complete(&mut session, Fineness::PRINT, &Limits::PATIENT).expect("an answer");
        coarse += usize::from(Figure::of(&session, [panel]).panels[0].chord() > FAINT);
        let shown = print::figure(&mut session, &[panel], &Limits::PATIENT);
        let mut truth = open();
        look(&mut truth);
        // Nothing else is computed that finely.
        truth.plots = vec![truth.plots.remove(panel)];
        complete(&mut truth, Fineness::PRINT.finer(40), &Limits::PATIENT).expect("an answer");
        let truth = Figure::of(&truth, [0]);
        let mut looked = 0;
        for (curve, finer) in shown.panels[0].curves.iter().zip(&truth.panels[0].curves) {
            assert_eq!(curve.name, finer.name);
            let near = |points: &[[f64; 2]]| -> Vec<(f64, f64)> {
                let paper = |[x, y]: &[f64; 2]| {
                    (PANEL.0 * window.x.fraction(*x), PANEL.1 * window.y.fraction(*y))
                };
                points.iter().map(paper).filter(|(x, y)| hypot(*x, *y) < 4000.0).collect()
            };
            let (line, dense) = (near(&curve.points), near(&finer.points));
            let mut chord = 0;
            for point in dense
                .iter()
                .filter(|(x, y)| (0.0..=PANEL.0).contains(x) && (0.0..=PANEL.1).contains(y))
            {
                let missed;
                (missed, chord) = aside(*point, &line, chord);
                assert!(missed < FAINT, "{scene}, {}, {point:?}: {missed} px", curve.name);
                looked += 1;
            }
        }
        assert!(looked > 3, "{scene}: nothing to see");
        let points = |figure: &Figure| {
            figure.panels[0].curves.iter().map(|curve| curve.points.len()).sum::<usize>()
        };
        assert!(
            points(&shown) < 4 * points(&whole),
            "{scene}: {} of {}",
            points(&shown),
            points(&whole)
        );
    }
    assert!(coarse >= 2, "with the usual points {coarse} would show");
}

#[test]
fn files_of_every_form_are_written_and_nothing_is_lost() {
    let folder = tempfile::tempdir().unwrap();
    let name = |name: &str| folder.path().join(name).display().to_string();
    for ending in ["pdf", "svg", "png", "csv", "json"] {
        let path = name(&format!("a.{ending}"));
        let ran = run(&["figure", "fig08", "--output", &path]);
        assert_eq!((ran.code, ran.out.as_str(), ran.err.as_str()), (0, "", ""), "{ending}");
        let content = fs::read(&path).unwrap();
        assert!(content.len() > 1000, "{ending}");
        // Writing the same again loses nothing.
        assert_eq!(run(&["figure", "fig08", "--output", &path]).code, 0);
        let ran = run(&["figure", "fig09", "--output", &path]);
        ran.is_refused(&[&path, "--force"]);
        assert_eq!(fs::read(&path).unwrap(), content);
        assert_eq!(run(&["figure", "fig09", "--output", &path, "--force"]).code, 0);
        assert_ne!(fs::read(&path).unwrap(), content);
    }
    // A picture of two panels, three dots per pixel, according to its header.
    let dots = fs::read(name("a.png")).unwrap();
    assert_eq!(dots[..8], *b"\x89PNG\r\n\x1a\n");
    let size = |at: usize| u32::from_be_bytes(dots[at..at + 4].try_into().unwrap());
    assert_eq!((size(16), size(20)), (3 * 920, 3 * 438));
    // Printed and written data are equal.
    let printed = run(&["figure", "fig09", "--format", "csv"]);
    let written = fs::read_to_string(name("a.csv")).unwrap();
    assert_eq!(printed.out, written);
    let origin = fs::read_to_string(name("a.csv.provenance")).unwrap();
    let origin: Value = serde_json::from_str(&origin).unwrap();
    let command = format!("hopfscope figure fig09 --output {} --force", name("a.csv"));
    assert_eq!(origin["command"], command);
    let ran = run(&["figure", "fig08", "--output", &name("a.eps")]);
    ran.is_refused(&[".pdf, .svg, .png, .csv or .json"]);
}

#[test]
fn the_path_of_a_belt_is_that_of_its_machines_at_other_speeds() {
    let figure = figure("belt-speed", Fineness::SCREEN);
    let [path] = curves(&figure, 0, "over the speed of the belt")[..] else { panic!("one path") };
    assert!(path.parameters.is_empty(), "nothing holds all along it");
    let machine = find("belt-speed").unwrap().machine.clone().unwrap().machine;
    let at = |speed: f64| {
        let mut belt = machine.belt.clone();
        belt.belt_speed = speed;
        let parameters = belt.reduce().unwrap().parameters;
        [parameters.d, parameters.r]
    };
    let (slow, fast) = (0.3 / 32.0, 0.3 * 32.0);
    assert_eq!((path.points[0], path.points[path.points.len() - 1]), (at(slow), at(fast)));
    // A fast belt feeds no energy: D contains only d1, and r the lower coefficient of friction.
    assert!((at(fast)[0] - 5.0 / 200.0).abs() < 1e-12 && (at(fast)[1] - 0.05).abs() < 1e-12);
    let speeds: Vec<f64> = figure.panels[0]
        .marks
        .iter()
        .filter_map(|mark| {
            let speed = mark.name.strip_prefix("v0 = ")?.strip_suffix(" m/s")?.parse().ok()?;
            assert_eq!(<[f64; 2]>::from(mark.at), at(speed), "{}", mark.name);
            Some(speed)
        })
        .collect();
    assert!(speeds.len() >= 4 && speeds.contains(&0.1), "{speeds:?}");
}
