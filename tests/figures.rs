//! Figures: one data set in every form, curves that are right, and polylines that nobody sees as such.

mod program;

use std::collections::BTreeSet;
use std::f64::consts::PI;
use std::fs;

use hopfscope::figure::{Curve, Figure, Form, file};
use hopfscope::flow::Limits;
use hopfscope::numerics::elementary::{atan2, cbrt, exp, exp_m1, hypot, powi};
use hopfscope::question::Fineness;
use hopfscope::runtime::print::{self, complete};
use hopfscope::scene::library::{find, library, names};
use hopfscope::scene::{Point, Span, Window};
use hopfscope::session::{Framing, Session, Size};
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

fn text(figure: &Figure, form: Form) -> String {
    String::from_utf8(file(figure, form).unwrap()).unwrap()
}

fn scenes() -> impl Iterator<Item = &'static str> {
    library().iter().map(|scene| scene.name.as_str())
}

/// The curves of a panel, from 0, whose name begins so.
fn curves<'a>(figure: &'a Figure, panel: usize, name: &str) -> Vec<&'a Curve> {
    let all = figure.panels[panel].curves.iter();
    let found: Vec<_> = all.filter(|curve| curve.name.starts_with(name)).collect();
    assert!(!found.is_empty(), "{} has no {name}", figure.figure);
    found
}

#[test]
fn every_scene_is_the_same_figure_in_every_form() {
    for scene in scenes() {
        let drawn = figure(scene, Fineness::PRINT);
        let json: Value = serde_json::from_str(&text(&drawn, Form::Json)).unwrap();
        for field in ["figure", "title", "program", "units", "parameters", "method", "tolerance"] {
            assert!(!json[field].is_null(), "{scene}: {field}");
        }
        assert_eq!(json["figure"], scene);
        same_numbers(scene, &json, &text(&drawn, Form::Csv));
        vector_picture(&drawn, &text(&drawn, Form::Svg));
    }
}

/// Every point of the JSON stands in the CSV, and nothing else does.
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
    let rows = csv.lines().filter(|line| !line.starts_with('#')).skip(1).map(|line| {
        let first: Vec<&str> = line.splitn(4, ',').take(3).collect();
        let last: Vec<&str> = line.rsplitn(3, ',').take(2).collect();
        let number =
            |text: &str| text.parse::<f64>().map_or_else(|_| String::new(), |x| format!("{x:?}"));
        format!("{};{},{}", first.join(","), number(last[1]), number(last[0]))
    });
    assert!(rows.eq(expected), "{scene}");
    let head: Vec<&str> = csv.lines().take_while(|line| line.starts_with('#')).collect();
    for word in
        ["D = ", "q0 = ", "method ", "tolerance ", "hopfscope 0.", "dimensionless", "panel 1: "]
    {
        assert!(head.iter().any(|line| line.contains(word)), "{scene}: {word}");
    }
}

/// A well-formed SVG with axes, a legend, and lines that are solid where something is stable and dashed
/// where it is not.
fn vector_picture(figure: &Figure, svg: &str) {
    let scene = &figure.figure;
    let picture = Document::parse(svg).unwrap_or_else(|error| panic!("{scene}: {error}"));
    let letters: BTreeSet<&str> = picture
        .descendants()
        .filter(|node| node.has_tag_name("text"))
        .filter_map(|node| node.text())
        .collect();
    let dashed = picture.descendants().any(|node| node.has_attribute("stroke-dasharray"));
    assert!(letters.contains(figure.title.as_str()), "{scene}");
    for panel in &figure.panels {
        assert!(
            letters.iter().any(|text| text.starts_with(panel.scales[0].title(&panel.x.name))),
            "{scene}: {:?}",
            panel.x
        );
        assert!(
            letters.iter().any(|text| text.starts_with(panel.scales[1].title(&panel.y.name))),
            "{scene}: {:?}",
            panel.y
        );
        for curve in &panel.curves {
            let name = curve.name.split(", ").next().unwrap();
            assert!(letters.contains(name), "{scene}: {name} is not in the legend");
            assert!(curve.style != "dashed" || dashed, "{scene}: {name}");
            let expected = match curve.name.split(' ').next() {
                Some("stable") => "solid",
                Some("unstable") => "dashed",
                _ => curve.style,
            };
            assert_eq!(curve.style, expected, "{scene}: {name}");
        }
    }
    assert!(!svg.contains("NaN") && !svg.contains("inf"), "{scene}");
    no_text_covers_another(scene, &picture);
}

/// The texts beside points and curves: none covers another.
fn no_text_covers_another(scene: &str, picture: &Document) {
    /// Width of a letter at least, and height of a line, in pixels.
    const LETTER: (f64, f64) = (5.0, 11.0);
    let number = |node: &roxmltree::Node, name: &str| -> f64 {
        node.attribute(name).and_then(|text| text.parse().ok()).unwrap()
    };
    let beside = |node: &roxmltree::Node| {
        node.attribute("font-size") == Some("10.5") && node.attribute("fill") != Some("none")
    };
    let texts = picture.descendants().filter(beside).map(|node| {
        let text = node.text().unwrap_or_default();
        let letters = f64::from(u16::try_from(text.chars().count()).unwrap());
        (text.to_owned(), number(&node, "x"), number(&node, "y"), LETTER.0 * letters)
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
fn on_paper(figure: &Figure, panel: usize, curve: &Curve) -> Vec<(f64, f64)> {
    let window = figure.panels[panel].window;
    let place =
        |[x, y]: &[f64; 2]| (PANEL.0 * window.x.fraction(*x), PANEL.1 * window.y.fraction(*y));
    curve.points.iter().map(place).collect()
}

/// How far a point is from a polyline; the chords around number `near` are looked at first.
fn aside(point: (f64, f64), line: &[(f64, f64)], near: usize) -> f64 {
    let distance = |pair: &[(f64, f64)]| -> f64 {
        let (along, up) = (pair[1].0 - pair[0].0, pair[1].1 - pair[0].1);
        let (right, above) = (point.0 - pair[0].0, point.1 - pair[0].1);
        let part = (right * along + above * up) / powi(hypot(along, up), 2);
        let part = if part.is_nan() { 0.0 } else { part.clamp(0.0, 1.0) };
        hypot(right - part * along, above - part * up)
    };
    let least = |line: &[(f64, f64)]| line.windows(2).map(distance).fold(f64::INFINITY, f64::min);
    let around = &line[near.saturating_sub(8).min(line.len())..(near + 8).min(line.len())];
    let close = least(around);
    if close < FAINT { close } else { least(line) }
}

/// What nobody sees, in pixels.
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
                        let missed = aside(*point, &line, index * line.len() / dense.len());
                        assert!(missed < FAINT, "{scene}, {}, {point:?}: {missed} px", curve.name);
                    }
                }
            }
        }
    }
}

/// A hundred times closer, on a point of a curve of each kind: the chords are as near as before, because
/// there are more of them, and only there.
#[test]
fn no_chord_misses_its_curve_after_zooming_either() {
    let mut coarse = 0;
    for (scene, panel, part) in [
        ("supercritical", 0, 0.3),
        ("supercritical", 1, 0.9),
        ("fig07", 2, 0.4),
        ("fig12", 0, 0.6),
        ("fig13", 2, 0.3),
        ("return-map", 1, 0.5),
    ] {
        let open = |fineness: Fineness| {
            let scene = find(scene).expect("a scene");
            let mut session = Session::new(scene, Size { width: 100, height: 30 });
            complete(&mut session, fineness, &Limits::PATIENT).expect("an answer");
            session
        };
        let mut session = open(Fineness::PRINT);
        let whole = Figure::of(&session, [panel]);
        // A point of the longest curve that is in the window.
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
        let mut truth = open(Fineness::PRINT.finer(40));
        look(&mut truth);
        complete(&mut truth, Fineness::PRINT.finer(40), &Limits::PATIENT).expect("an answer");
        let truth = Figure::of(&truth, [panel]);
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
            for point in dense
                .iter()
                .filter(|(x, y)| (0.0..=PANEL.0).contains(x) && (0.0..=PANEL.1).contains(y))
            {
                let missed = aside(*point, &line, 0);
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

/// The fold of the cycles for D2 = 0 over kappa = r^2 D3, from reference computations.
fn reference_folds() -> Vec<(f64, f64)> {
    let document: Value = serde_json::from_str(include_str!("data/folds.json")).unwrap();
    let rows = document["folds"].as_array().unwrap().iter();
    rows.map(|row| (row["kappa"].as_f64().unwrap(), row["D_F"].as_f64().unwrap())).collect()
}

/// The extents of the cycle of the piecewise linear oscillator, (32) and (33) as corrected.
fn linear_extents(d: f64, r: f64) -> (f64, f64) {
    let omega = (1.0 - d * d).sqrt();
    let x = -PI * d / omega;
    let clearance = 2.0 * r / exp_m1(x);
    (r + clearance, clearance * exp(-(d / omega) * atan2(omega, d)))
}

#[test]
fn extents_of_the_basin_are_those_of_the_formulas() {
    for (scene, r) in [("fig08", 0.1), ("fig09", 0.1), ("fig16a", 0.02)] {
        let drawn = figure(scene, Fineness::PRINT);
        for (panel, shown) in
            drawn.panels.iter().enumerate().filter(|(_, shown)| shown.x.name == "D")
        {
            let of_velocity = ["v_max", "A_v/r"].contains(&shown.y.name.as_str());
            let unit = if shown.y.name.ends_with("/r") { r } else { 1.0 };
            assert_eq!(unit == r, scene == "fig08", "{}", shown.y.name);
            let mut checked = 0;
            for curve in curves(&drawn, panel, "unstable cycle") {
                if curve.parameters["r"] != r {
                    continue;
                }
                // Within 1e-3 of -1 the formula as written here loses its digits.
                for [d, height] in curve.points.iter().filter(|[d, _]| *d > -0.999) {
                    let (q, v) = linear_extents(*d, r);
                    let expected = if of_velocity { v } else { q };
                    let found = unit * height;
                    assert!((found / expected - 1.0).abs() < 1e-12, "{scene}: D = {d}, {height}");
                    checked += 1;
                }
            }
            assert!(checked > 500, "{scene}: {checked}");
        }
    }
    let drawn = figure("fig09", Fineness::PRINT);
    for [d, v] in &curves(&drawn, 0, "largest velocity A_v")[0].points[1..] {
        assert!((v / linear_extents(*d, 0.1).1 - 1.0).abs() < 1e-12);
    }
    // The mark at the present value is no chord either: A_q at D = -0.4.
    let mark = drawn.panels[0].marks.iter().find(|mark| mark.x == -0.4).unwrap();
    assert!((mark.y / linear_extents(-0.4, 0.1).0 - 1.0).abs() < 1e-9, "{}", mark.y);
}

#[test]
fn the_borders_of_the_basins_are_the_cycles_of_the_formulas() {
    let drawn = figure("fig07", Fineness::PRINT);
    for (panel, d) in [(0, -0.4), (2, -0.7), (3, -0.999)] {
        let (q, v) = linear_extents(d, 1.0);
        let [cycle] = &curves(&drawn, panel, "unstable cycle")[..] else { panic!("one cycle") };
        let areas = &drawn.panels[panel].areas;
        let basin = areas.iter().find(|area| area.name == "basin of the sticking set").unwrap();
        for (points, parameters) in
            [(&cycle.points, &cycle.parameters), (&basin.edge, &basin.parameters)]
        {
            assert_eq!(parameters["D"], d);
            let farthest = |axis: usize| points.iter().map(|at| at[axis]).fold(0.0, f64::max);
            assert!((farthest(0) / q - 1.0).abs() < 1e-9, "{d}: {}", farthest(0));
            assert!((farthest(1) / v - 1.0).abs() < 1e-4, "{d}: {}", farthest(1));
        }
        let radius = -1.0 / (2.0 * d);
        for [q, v] in &curves(&drawn, panel, "Lyapunov circle")[0].points {
            assert!((hypot(*q, *v) / radius - 1.0).abs() < 1e-14);
        }
    }
}

#[test]
fn harmonic_curves_obey_the_amplitude_equation() {
    for (scene, panels) in [("fig09", 0..1), ("fig10", 1..2), ("fig12", 0..2), ("fig14", 0..1)] {
        let drawn = figure(scene, Fineness::PRINT);
        for panel in panels {
            for curve in curves(&drawn, panel, "first harmonic") {
                let own = &curve.parameters;
                let (d2, d3, r) = (own["D2"], own["D3"], own["r"]);
                for [d, height] in &curve.points {
                    // (40) and (42).
                    let shift = drawn.panels[panel].y.name == "mean";
                    let a = if shift { (-2.0 * height / d2).sqrt() } else { *height };
                    let terms = [4.0 * r / PI, 2.0 * d * a, 0.75 * d3 * powi(a, 3)];
                    let size: f64 = terms.iter().map(|term| term.abs()).sum();
                    assert!(
                        terms.iter().sum::<f64>().abs() < 1e-13 * size,
                        "{scene}: {d} {height}"
                    );
                }
            }
        }
    }
}

#[test]
fn computed_and_harmonic_folds_stand_where_they_are_known_to() {
    // Over (D, D3) at r = 0.1, (r, D3) at D = -0.2: each point has its kappa = r^2 D3 and its D_F.
    let mut known = 0;
    for (scene, d) in [("fig10", None), ("fig11", Some(-0.2))] {
        let drawn = figure(scene, Fineness::PRINT);
        let kappa_and_d = |[x, y]: &[f64; 2]| match d {
            None => (0.01 * y, *x),
            Some(d) => (x * x * y, d),
        };
        for point in &curves(&drawn, 0, "fold of the first harmonic")[0].points {
            let (kappa, d) = kappa_and_d(point);
            let formula = -0.5 * cbrt(kappa * powi(9.0 / PI, 2));
            assert!((d / formula - 1.0).abs() < 1e-9, "{scene}: {point:?}");
        }
        let all = curves(&drawn, 0, "fold");
        let fold = all.iter().find(|curve| curve.name == "fold").unwrap();
        let points: Vec<(f64, f64)> = fold.points.iter().map(kappa_and_d).collect();
        for (kappa, d) in reference_folds() {
            for point in points.iter().filter(|point| (point.0 / kappa - 1.0).abs() < 1e-12) {
                assert!((point.1 / d - 1.0).abs() < 1e-7, "{scene}: {point:?}");
                known += 1;
            }
        }
        // At D = -0.2 the fold has one kappa, wherever r and D3 stand.
        if d.is_some() {
            assert!(points.iter().all(|point| (point.0 / points[0].0 - 1.0).abs() < 1e-9));
        }
    }
    assert!(known >= 2, "{known}");
}

#[test]
fn amplitudes_are_those_of_the_reference_cycles() {
    // fig16 and fig10 mark the cycles at the present D: those of r = 0.1 are in the reference.
    let document: Value = serde_json::from_str(include_str!("data/cycles.json")).unwrap();
    let drawn = figure("supercritical", Fineness::PRINT);
    let mut checked = 0;
    for cycle in document.as_array().unwrap() {
        let is = |name: &str, value: f64| cycle[name] == value;
        if is("D", -0.3) && is("D2", 0.0) && is("D3", 0.5) && is("r", 0.1) {
            let q_max = cycle["q_max"].as_f64().unwrap();
            let found = |mark: f64| (mark / q_max - 1.0).abs() < 1e-8;
            assert!(drawn.panels[1].marks.iter().any(|mark| found(mark.y)), "{q_max}");
            checked += 1;
        }
    }
    assert!(checked > 0);
}

#[test]
fn files_of_every_form_are_written_and_nothing_is_lost() {
    let folder = tempfile::tempdir().unwrap();
    let name = |name: &str| folder.path().join(name).display().to_string();
    for ending in ["svg", "png", "csv", "json"] {
        let path = name(&format!("a.{ending}"));
        let ran = run(&["figure", "fig08", "--output", &path]);
        assert_eq!((ran.code, ran.out.as_str(), ran.err.as_str()), (0, "", ""), "{ending}");
        let content = fs::read(&path).unwrap();
        assert!(content.len() > 1000, "{ending}");
        // The same once more loses nothing.
        assert_eq!(run(&["figure", "fig08", "--output", &path]).code, 0);
        let ran = run(&["figure", "fig09", "--output", &path]);
        ran.is_refused(&[&path, "--force"]);
        assert_eq!(fs::read(&path).unwrap(), content);
        assert_eq!(run(&["figure", "fig09", "--output", &path, "--force"]).code, 0);
        assert_ne!(fs::read(&path).unwrap(), content);
    }
    // A picture of two panels, three dots to a pixel; its beginning says so.
    let dots = fs::read(name("a.png")).unwrap();
    assert_eq!(dots[..8], *b"\x89PNG\r\n\x1a\n");
    let size = |at: usize| u32::from_be_bytes(dots[at..at + 4].try_into().unwrap());
    assert_eq!((size(16), size(20)), (3 * 920, 3 * 456));
    // What is printed is what is written.
    let printed = run(&["figure", "fig09", "--format", "csv"]);
    let written = fs::read_to_string(name("a.csv")).unwrap();
    let origin =
        |text: &str| text.lines().find(|line| line.starts_with("# hopfscope")).unwrap().to_owned();
    assert!(
        origin(&written)
            .ends_with(&format!(": hopfscope figure fig09 --output {} --force", name("a.csv")))
    );
    assert!(origin(&printed.out).ends_with(": hopfscope figure fig09 --format csv"));
    assert_eq!(printed.out.replace(&origin(&printed.out), &origin(&written)), written);
    let ran = run(&["figure", "fig08", "--output", &name("a.pdf")]);
    ran.is_refused(&[".svg, .png, .csv or .json"]);
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
    // A fast belt feeds nothing: d1 alone is left of D, and the lower coefficient of friction in r.
    assert!((at(fast)[0] - 5.0 / 200.0).abs() < 1e-12 && (at(fast)[1] - 0.05).abs() < 1e-12);
    let speeds: Vec<f64> = figure.panels[0]
        .marks
        .iter()
        .filter_map(|mark| {
            let speed = mark.name.strip_prefix("v0 = ")?.strip_suffix(" m/s")?.parse().ok()?;
            assert_eq!([mark.x, mark.y], at(speed), "{}", mark.name);
            Some(speed)
        })
        .collect();
    assert!(speeds.len() >= 4 && speeds.contains(&0.1), "{speeds:?}");
}

#[test]
fn figures_have_no_two_panels_alike_and_no_circles_that_belong_to_nothing() {
    for scene in names().filter(|scene| scene.starts_with("fig")) {
        let drawn = figure(scene, Fineness::SCREEN);
        for (index, panel) in drawn.panels.iter().enumerate() {
            let alike = |other: &&hopfscope::figure::Panel| {
                !panel.curves.is_empty() && other.curves == panel.curves && other.x == panel.x
            };
            assert!(drawn.panels[..index].iter().find(alike).is_none(), "{scene}: panel {index}");
            for start in panel.marks.iter().filter(|mark| mark.name == "start") {
                let begins = |curve: &Curve| curve.points.first() == Some(&[start.x, start.y]);
                let on = |curve: &&Curve| begins(curve) || curve.role == "energy";
                assert!(panel.curves.iter().any(|it| on(&it)), "{scene}: {start:?} starts nothing");
            }
        }
    }
}

#[test]
fn legends_name_what_is_drawn_once_and_as_it_is_called() {
    let legend = |scene: &str| -> Vec<String> {
        let svg = text(&figure(scene, Fineness::SCREEN), Form::Svg);
        let picture = Document::parse(&svg).unwrap();
        let entry = |node: &roxmltree::Node| {
            node.has_tag_name("text") && node.attribute("font-size") == Some("11")
        };
        let entries = picture.descendants().filter(entry);
        entries.filter_map(|node| node.text().map(str::to_owned)).collect()
    };
    for scene in scenes() {
        let names = legend(scene);
        for (index, name) in names.iter().enumerate() {
            let plural = |other: &String| *other == format!("{name}s") || *other == *name;
            assert!(!names[..index].iter().any(plural), "{scene}: {names:?}");
            assert!(!names.contains(&format!("{name}s")), "{scene}: {names:?}");
        }
    }
    let names = legend("fig14");
    assert!(names.iter().any(|name| name == "asymptote A01"), "{names:?}");
    assert!(names.iter().all(|name| name != "asymptote A1" && name != "asymptote A2"), "{names:?}");
}

#[test]
fn the_dashes_of_the_constructed_cycle_lie_over_its_half_turns() {
    let drawn = figure("fig06", Fineness::SCREEN);
    let order: Vec<&str> = drawn.panels[0].curves.iter().map(|curve| curve.name.as_str()).collect();
    let place = |name: &str| order.iter().position(|it| it.starts_with(name)).unwrap();
    assert!(place("unstable cycle") > place("half turn about the left end"), "{order:?}");
    assert!(place("unstable cycle") > place("half turn about the right end"), "{order:?}");
}

#[test]
fn the_name_of_a_fold_covers_no_branch() {
    let drawn = figure("fig11", Fineness::SCREEN);
    let svg = text(&drawn, Form::Svg);
    let picture = Document::parse(&svg).unwrap();
    let number = |node: &roxmltree::Node, name: &str| -> f64 {
        node.attribute(name).and_then(|text| text.parse().ok()).unwrap()
    };
    // The second panel begins 460 pixels to the right of the first.
    let (x0, y0) = (460.0 + 64.0, 34.0 + 30.0);
    let branches =
        curves(&drawn, 1, "stable cycle").into_iter().chain(curves(&drawn, 1, "unstable"));
    let spots: Vec<(f64, f64)> = branches
        .flat_map(|curve| on_paper(&drawn, 1, curve))
        .map(|(x, y)| (x0 + x, y0 + PANEL.1 - y))
        .collect();
    let mut folds = 0;
    for node in picture.descendants().filter(|node| {
        node.attribute("font-size") == Some("10.5")
            && node.attribute("fill") != Some("none")
            && node.text().is_some_and(|text| text.starts_with('F'))
    }) {
        let letters = f64::from(u32::try_from(node.text().unwrap().len()).unwrap());
        let (left, line) = (number(&node, "x"), number(&node, "y"));
        let covered = |(x, y): &&(f64, f64)| {
            (left..left + 5.0 * letters).contains(x) && (line - 8.0..line).contains(y)
        };
        assert_eq!(spots.iter().find(covered), None, "{:?}", node.text());
        folds += 1;
    }
    assert_eq!(folds, 3);
}

#[test]
fn a_circle_looks_like_one_in_every_phase_plane() {
    let units = |stretched: bool| {
        let mut session = Session::new(find("linear").unwrap(), Size { width: 100, height: 30 });
        session.look.stretched = stretched;
        let Window { x, y } = Figure::of(&session, [0]).panels[0].window;
        (x.width() / 380.0) / (y.width() / 300.0)
    };
    assert!((units(false) - 1.0).abs() < 1e-12);
    assert!((units(true) - 1.0).abs() > 0.1, "the scene's window fills the panel");
}
