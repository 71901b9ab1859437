//! Answers as pages to print and sign.

use std::fs;
use std::path::Path;

use roxmltree::{Document, Node, ParsingOptions};
use serde_json::Value;

use super::program::{json, number, run};

const RECORD: &str = "tests/data/fit/negative_captured.csv";

fn at_root(path: &str) -> String {
    format!("{}/{path}", env!("CARGO_MANIFEST_DIR"))
}

/// Answers a command line, given as words, with a page, and returns it.
fn page(line: &[&str]) -> String {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("page.html");
    let ran = run(&[line, &["--report", path.to_str().unwrap()]].concat());
    assert!((ran.code, ran.err.as_str()) == (0, ""), "{line:?}: {}", ran.err);
    fs::read_to_string(path).unwrap()
}

fn parsed(page: &str) -> Document<'_> {
    let options = ParsingOptions { allow_dtd: true, ..ParsingOptions::default() };
    Document::parse_with_options(page, options).unwrap()
}

/// All text within a node.
fn text(node: Node) -> String {
    node.descendants().filter(Node::is_text).filter_map(|it| it.text()).collect::<String>()
}

fn all<'a>(node: Node<'a, 'a>, name: &'a str) -> impl Iterator<Item = Node<'a, 'a>> {
    node.descendants().filter(move |it| it.tag_name().name() == name)
}

/// The cells of the row that begins with this one.
fn row(document: &Document, first: &str) -> Vec<String> {
    let rows = all(document.root(), "tr");
    let cells = |row: Node| -> Vec<String> {
        let cells = row.children().filter(Node::is_element);
        cells.map(|cell| text(cell).trim().to_owned()).collect()
    };
    let mut rows = rows.map(cells).filter(|cells| cells[0] == first);
    rows.next().unwrap_or_else(|| panic!("no row {first}"))
}

#[test]
fn a_page_is_well_formed_and_needs_nothing_else() {
    let record = at_root(RECORD);
    for line in [&["fit", &record, "--draws", "40", "--mass", "2 kg"][..], &["belt", "groan"]] {
        let page = page(line);
        let document = parsed(&page);
        let root = document.root_element();
        assert!(page.starts_with("<!DOCTYPE html>"));
        assert_eq!((root.tag_name().name(), root.attribute("lang")), ("html", Some("en")));
        for (name, count) in [("title", 1), ("h1", 1), ("main", 1), ("script", 0), ("link", 0)] {
            let found =
                all(root, name).filter(|it| it.parent().unwrap().tag_name().name() != "svg");
            assert_eq!(found.count(), count, "{line:?}: {name}");
        }
        for table in all(root, "table") {
            let is_title = |it: &Node| it.attribute("scope") == Some("col");
            let is_name = |it: &Node| it.attribute("scope") == Some("row");
            let titles: usize = all(table, "th")
                .filter(is_title)
                .map(|it| it.attribute("colspan").map_or(1, |wide| wide.parse().unwrap()))
                .sum();
            for row in all(table, "tr").skip(1) {
                let width =
                    |it: Node| it.attribute("colspan").map_or(1, |wide| wide.parse().unwrap());
                let cells: usize = row.children().filter(Node::is_element).map(width).sum();
                assert_eq!((cells, all(row, "th").filter(is_name).count()), (titles, 1));
            }
        }
        let ids: Vec<&str> = root.descendants().filter_map(|it| it.attribute("id")).collect();
        let mut once = ids.clone();
        once.sort_unstable();
        once.dedup();
        assert!(!ids.is_empty() && once.len() == ids.len(), "{ids:?}");
        // Addresses occur as names of namespaces alone, parts of the page as those of its own pictures.
        assert_eq!(
            page.matches("http").count(),
            page.matches("xmlns=\"http://www.w3.org/").count()
        );
        assert_eq!(page.matches("url(").count(), page.matches("url(#panel").count());
        for outside in ["src=", "href=", "@import"] {
            assert!(!page.contains(outside), "{outside}");
        }
    }
}

#[test]
fn a_page_of_a_fit_says_what_its_document_says() {
    let line = format!("fit {} --draws 40 --stiffness 800N/m --disturbance 0.05N", at_root(RECORD));
    let told = json(&line);
    let words: Vec<&str> = line.split_whitespace().collect();
    let page = page(&words);
    let document = parsed(&page);
    let with_class = |class: &str| {
        let found = document.descendants().find(|it| it.attribute("class") == Some(class));
        found.map(text)
    };
    assert_eq!(with_class("statement").unwrap().trim(), told["statement"]["text"]);
    for condition in told["conditions"].as_array().unwrap() {
        let [name, result, detail] = &row(&document, condition["name"].as_str().unwrap())[..]
        else {
            panic!("{condition}")
        };
        let held = if condition["holds"] == true {
            "pass"
        } else {
            "caution"
        };
        assert_eq!(
            (result.as_str(), detail.as_str()),
            (held, condition["detail"].as_str().unwrap()),
            "{name}"
        );
    }
    let near = |cell: &str, value: &Value, error: f64| {
        let shown: f64 = cell.parse().unwrap();
        assert!((shown - number(value)).abs() <= error, "{cell}: {value}");
    };
    for (name, it) in told["parameters"].as_object().unwrap() {
        let cells = row(&document, name);
        let error = number(&it["standard_error"]);
        for (cell, key) in [(1, "value"), (3, "lower"), (4, "upper")] {
            near(&cells[cell], &it[key], 0.05 * error);
        }
        near(&cells[2], &it["standard_error"], 0.05 * error);
    }
    for (name, it) in told["physical"]["numbers"].as_object().unwrap() {
        let error = number(&it["standard_error"]).max(1e-5 * number(&it["value"]).abs());
        let cells = row(&document, name);
        near(&cells[1], &it["value"], 0.05 * error);
        assert_eq!(cells[3], it["unit"].as_str().unwrap());
    }
    let cells = row(&document, "margin impulse from rest");
    let spread = &told["physical"]["from_rest"]["impulse"];
    for (cell, key) in [(1, "median"), (2, "lower"), (3, "upper")] {
        near(&cells[cell], &spread[key], 1e-3 * number(&spread[key]));
    }
}

#[test]
fn a_page_names_its_file_and_its_command() {
    let path = at_root("tests/data/fit/peaks_times.csv");
    let page = page(&["fit", &path, "--peaks", "--draws", "40"]);
    // By sha256sum of the GNU core utilities.
    assert!(page.contains("fe5b854ffa8ec80b20a237877e05424a52d0a306ae2e4f98d44d4daac5f1f503"));
    let document = parsed(&page);
    let said: Vec<String> = all(document.root(), "dd").map(text).collect();
    assert!(said[0].contains(env!("CARGO_PKG_VERSION")), "{said:?}");
    assert!(said[1].contains("--peaks") && said[2].trim() == path, "{said:?}");
    assert!(said[3].trim().ends_with(" UTC"), "{said:?}");
}

#[test]
fn a_page_of_a_machine_names_the_table_of_its_friction_too() {
    let page = page(&["belt", &at_root("assets/belts/slideway.toml")]);
    for file in ["slideway.toml", "slideway.csv"] {
        assert!(page.contains(&format!("assets/belts/{file}")), "{file}");
    }
    assert_eq!(page.matches("<dt>SHA-256</dt>").count(), 2);
    assert!(page.contains("are not known"), "what is not known about its motions stands there");
}

#[test]
fn a_machine_that_is_not_sure_to_survive_anything_says_so_first() {
    let text = page(&["belt", "textbook", "--disturbance", "3 N"]);
    assert!(text.contains("class=\"statement broken\">No margin is guaranteed"), "{text}");
    // Within the margin that is guaranteed.
    let sure = page(&["belt", "textbook", "--set", "R=1N+-0.2N", "--disturbance", "0.1 N"]);
    let told = json("belt textbook --set R=1N+-0.2N --disturbance 0.1N");
    let least = number(&told["guaranteed"]["from_rest"]["impulse"]);
    let shown = sure.split("an impulse below ").nth(1).unwrap().split(" mN s").next().unwrap();
    let shown = 1e-3 * shown.parse::<f64>().unwrap();
    assert!(shown <= least && shown > 0.99 * least, "{shown} {least}");
    assert!(sure.contains("R in 0.8 N .. 1.2 N") && sure.contains("a force of at most 0.1 N"));
}

#[test]
fn the_places_of_what_is_left_out_are_told() {
    let path = at_root("tests/data/fit/hard/clip_2.csv");
    let told = json(&format!("fit {path} --draws 40"));
    let stretches = told["left_out"].as_array().unwrap();
    let samples: f64 = stretches.iter().map(|it| number(&it["samples"])).sum();
    assert!(samples > 5.0 && samples == number(&told["saturated"]) + number(&told["outliers"]));
    let page = page(&["fit", &path, "--draws", "40"]);
    for stretch in stretches {
        let place = format!("({} samples)", stretch["samples"]);
        assert!(page.contains(&place), "{place}");
    }
}

#[test]
fn a_page_replaces_nothing_unasked() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("page.html");
    let name = path.to_str().unwrap();
    fs::write(&path, "mine\n").unwrap();
    let record = at_root("tests/data/fit/peaks_times.csv");
    for line in [&["fit", &record, "--peaks", "--draws", "40"][..], &["belt", "groan"]] {
        let line = [line, &["--report", name]].concat();
        run(&line).is_refused(&[name, "already exists; add --force to overwrite"]);
        assert_eq!(fs::read_to_string(&path).unwrap(), "mine\n");
        let forced = run(&[&line[..], &["--force"]].concat());
        assert_eq!(forced.code, 0, "{}", forced.err);
        assert!(fs::read_to_string(&path).unwrap().starts_with("<!DOCTYPE html>"));
        fs::remove_file(&path).unwrap();
        // The same answer may be written again.
        assert_eq!((run(&line).code, run(&line).code), (0, 0));
        fs::write(&path, "mine\n").unwrap();
    }
    for (line, words) in [
        (&["belt", "groan", "--report", "page.pdf"][..], "a page ends in .html"),
        (&["fit", &record, "--report", "page"], "a page ends in .html"),
        (&["belt", "groan", "--force"], "--report"),
        (&["fit", &record, "--force"], "--report"),
    ] {
        run(line).is_refused(&[words]);
    }
    assert!(!Path::new("page.pdf").exists());
}
