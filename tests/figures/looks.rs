//! Visible properties of figures: panels, legends, dashes, labels, proportions.

use super::*;

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
                let begins = |curve: &Outline| curve.points.first() == Some(&start.at.into());
                let on = |curve: &&Outline| begins(curve) || curve.role.name() == "energy";
                assert!(panel.curves.iter().any(|it| on(&it)), "{scene}: {start:?} starts nothing");
            }
        }
    }
}

#[test]
fn legends_name_what_is_drawn_once_and_as_it_is_called() {
    let legend = |scene: &str| -> Vec<String> {
        let svg = text(&figure(scene, Fineness::SCREEN), FigureForm::Svg);
        let picture = Document::parse(&svg).unwrap();
        let entry = |node: &roxmltree::Node| {
            node.has_tag_name("text") && node.attribute("font-size") == Some("11")
        };
        let entries = picture.descendants().filter(entry);
        entries.map(|node| said(&node)).collect()
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
fn a_plot_that_can_show_nothing_says_in_the_figure_what_it_needs() {
    let mut session = Session::new(find("plain").unwrap(), Size { width: 100, height: 30 });
    hopfscope::session::run_line(&mut session, "view speeds").unwrap();
    complete(&mut session, Fineness::SCREEN, &Limits::PATIENT).unwrap();
    let drawn = Figure::of(&session, [session.plot]);
    let needs = drawn.panels[0].nothing.clone().unwrap();
    assert!(needs.contains("machine") && !needs.contains('{'), "{needs}");
    let svg = text(&drawn, FigureForm::Svg);
    let picture = Document::parse(&svg).unwrap();
    let texts: Vec<String> = picture.descendants().map(|node| said(&node)).collect();
    assert!(
        needs
            .split([':', ';', ','])
            .all(|part| texts.iter().any(|it| it.contains(&set(part.trim()))))
    );
    assert!(figure("plain", Fineness::SCREEN).panels.iter().all(|panel| panel.nothing.is_none()));
}

#[test]
fn the_name_of_a_fold_covers_no_branch() {
    let drawn = figure("fig11", Fineness::SCREEN);
    let svg = text(&drawn, FigureForm::Svg);
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
        node.has_tag_name("text")
            && node.attribute("font-size") == Some("10.5")
            && node.attribute("fill") != Some("none")
            && said(node).starts_with('F')
    }) {
        let letters = f64::from(u32::try_from(said(&node).chars().count()).unwrap());
        let (left, line) = (number(&node, "x"), number(&node, "y"));
        let covered = |(x, y): &&(f64, f64)| {
            (left..left + 5.0 * letters).contains(x) && (line - 8.0..line).contains(y)
        };
        assert_eq!(spots.iter().find(covered), None, "{}", said(&node));
        folds += 1;
    }
    assert_eq!(folds, 3);
}

#[test]
fn a_circle_looks_like_one_in_every_phase_plane() {
    let units = |stretched: bool| {
        let mut session = Session::new(find("linear").unwrap(), Size { width: 100, height: 30 });
        session.display.stretched = stretched;
        let Window { x, y } = Figure::of(&session, [0]).panels[0].window;
        (x.width() / 380.0) / (y.width() / 300.0)
    };
    assert!((units(false) - 1.0).abs() < 1e-12);
    assert!((units(true) - 1.0).abs() > 0.1, "the scene's window fills the panel");
}

/// A map of margins in every form: its cells, what those without a number are, and the scale.
#[test]
fn the_map_of_a_scan_has_its_cells_and_its_scale_in_every_form() {
    let mut session = Session::new(find("regimes").unwrap(), Size { width: 120, height: 40 });
    for letter in ":scan D=-0.9:0:10 D3=-0.5:1:7 margin".chars() {
        let key = if letter == ' ' {
            "<space>".to_owned()
        } else {
            letter.to_string()
        };
        update(&mut session, Msg::Key(key.parse().unwrap()));
    }
    update(&mut session, Msg::Key("<enter>".parse().unwrap()));
    complete(&mut session, Fineness::SCREEN, &Limits::PATIENT).unwrap();
    let drawn = Figure::of(&session, [0]);
    let json: Value = serde_json::from_str(&text(&drawn, FigureForm::Json)).unwrap();
    let map = &json["panels"][0]["map"];
    assert_eq!(map["name"], "displacement [x0]");
    assert_eq!(map["scale"]["dangerous"], "small");
    let columns = map["values"].as_array().unwrap();
    let cells: Vec<&Value> = columns.iter().flat_map(|column| column.as_array().unwrap()).collect();
    assert_eq!((columns.len(), cells.len()), (10, 70));
    // D = -0.9, D3 = -0.5: hardly more than r is survived. D = 0, D3 = 1: everything is.
    let smallest = cells[0].as_f64().unwrap();
    assert!((smallest - 0.100_301_996_083).abs() < 1e-11, "{smallest}");
    assert_eq!(cells[69], "every kick survived");

    let csv = text(&drawn, FigureForm::Csv);
    let rows: Vec<&str> = csv.lines().filter(|line| line.starts_with("1,map,")).collect();
    assert_eq!(rows.len(), 70);
    assert!(
        rows[0].starts_with("1,map,1,displacement [x0],,,-0.9,-0.5,0.1003019960833"),
        "{}",
        rows[0]
    );
    assert!(rows[69].ends_with(",0.0,1.0,every kick survived"), "{}", rows[69]);
    assert!(
        csv.lines().any(|line| line.ends_with(",x,y,value")),
        "{}",
        csv.lines().nth(8).unwrap()
    );

    assert_eq!(drawn.panels[0].nothing, None, "a map is something to see");
    let svg = text(&drawn, FigureForm::Svg);
    let picture = Document::parse(&svg).unwrap();
    let texts: Vec<String> = picture.descendants().map(|node| said(&node)).collect();
    for words in ["D", "D3", "displacement [x0]", "every kick survived", "0.1003 (dangerous)"] {
        assert!(texts.iter().any(|text| text == words), "{words}: {texts:?}");
    }
    assert!(texts.iter().any(|text| text.ends_with(" (safe)")), "{texts:?}");
    // Strong colours are dark, and the darkest is that of the smallest margin.
    let brightness = |color: &str| {
        let part = |at: usize| u32::from_str_radix(&color[at..at + 2], 16).unwrap();
        part(1) + part(3) + part(5)
    };
    let fills: Vec<u32> = picture
        .descendants()
        .filter(|node| {
            // A cell has a hair of its own colour around it.
            node.attribute("fill").is_some_and(|fill| node.attribute("stroke") == Some(fill))
        })
        .map(|node| brightness(node.attribute("fill").unwrap()))
        .collect();
    assert!(fills.len() > 10 && fills.iter().all(|fill| *fill >= fills[0]), "{fills:?}");
    assert!(fills.iter().any(|fill| *fill > 2 * fills[0]), "{fills:?}");

    let png = file(&drawn, FigureForm::Png).unwrap();
    assert!(png.starts_with(b"\x89PNG") && png.len() > 10_000, "{}", png.len());
}
