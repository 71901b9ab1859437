//! Scans over lists, in every form, and how a margin is to be read.

use std::fs;

use serde_json::Value;

use crate::archive::arrays;
use crate::program::{json, run};
use crate::{file, word};

/// Parameter sets with a margin of each kind.
const SETS: &str = "D,r,D3\n-0.3,0.1,0.5\n0.1,0.1,0\n-0.1,0,0\n-0.2,0.1,0\n";

/// Their margins are to be read so.
const REGIMES: [&str; 4] = ["finite", "every kick survived", "no rest", "finite"];

/// The rows of a scan over them, printed in a form.
fn rows(more: &[&str]) -> String {
    let (_folder, path) = file("sets.csv");
    fs::write(&path, SETS).unwrap();
    let words = ["scan", "--points", word(&path), "--measure", "margin,outcome"];
    let ran = run(&[&words, more].concat());
    assert_eq!((ran.code, ran.err.as_str()), (0, ""));
    ran.out
}

#[test]
fn the_rows_of_a_list_are_single_answers_in_its_order() {
    let rows = rows(&["--format", "json", "--jobs", "3"]);
    let rows: Vec<Value> = rows.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    for ((row, set), regime) in rows.iter().zip(SETS.lines().skip(1)).zip(REGIMES) {
        let values: Vec<&str> = set.split(',').collect();
        let line = format!("--set D={} --set r={} --set D3={}", values[0], values[1], values[2]);
        let own = json(&format!("margin {line}"));
        for kick in ["displacement", "impulse"] {
            assert_eq!(row[kick], own["nominal"][kick], "{set}");
        }
        assert_eq!(
            (row["regime"].as_str(), own["nominal"]["regime"].as_str()),
            (Some(regime), Some(regime))
        );
        let basin = json(&format!("basin --grid 2x2 {line}"));
        assert_eq!(basin["margin"]["regime"], regime);
        let motion = json(&format!("trajectory {line}"));
        assert_eq!(row["outcome"], motion["outcome"]["kind"]);
    }
    assert_eq!(rows.len(), REGIMES.len());
}

#[test]
fn a_grid_and_the_list_of_its_points_have_the_same_rows() {
    let (_folder, path) = file("grid.csv");
    fs::write(&path, "\"r\", D\n0.1,-0.3\n0.1,-0.1\n0.2,-0.3\n0.2,-0.1\n").unwrap();
    let list = run(&["scan", "--points", word(&path), "--measure", "margin,cycles"]);
    let over =
        ["scan", "--over", "r=0.1:0.2:2", "--over", "D=-0.3:-0.1:2", "--measure", "margin,cycles"];
    assert_eq!(list.out, run(&over).out);
    let shards = ["1/2", "2/2"].map(|shard| {
        run(&["scan", "--points", word(&path), "--measure", "margin,cycles", "--shard", shard]).out
    });
    assert_eq!(list.out, shards.concat());
}

#[test]
fn lists_are_refused_by_line_and_column() {
    let (_folder, path) = file("sets.csv");
    for (text, expected) in [
        ("D,x\n1,2\n", "no number \"x\"; there are D, D2, D3, r"),
        ("D,r\n-0.1,0.1\n-0.2\n", "(line: 3, byte: 13): found record with 1 fields"),
        ("D,r\n-0.1,0.1,3\n", "found record with 3 fields"),
        ("D,r\n1,-2\n", "line 2, column r: r = -2 is outside its range 0 .. 1e150"),
        ("D,r\n", "at least one"),
        ("", "at least one"),
        ("D,D\n1,1\n", "D is scanned over twice"),
    ] {
        fs::write(&path, text).unwrap();
        let words = ["scan", "--points", word(&path), "--measure", "margin"];
        run(&words).is_refused(&["sets.csv", expected]);
        run(&[&words[..], &["--over", "D=0:1:2"]].concat()).is_refused(&["--over"]);
    }
}

#[test]
fn a_list_resumes_and_merges() {
    let (folder, path) = file("sets.csv");
    fs::write(&path, SETS).unwrap();
    let out = folder.path().join("rows.csv");
    let words = ["scan", "--points", word(&path), "--measure", "margin", "--output", word(&out)];
    assert_eq!(run(&words).code, 0);
    let whole = fs::read_to_string(&out).unwrap();
    let two: String = whole.split_inclusive('\n').take(3).collect();
    fs::write(&out, two).unwrap();
    assert_eq!(run(&[&words[..], &["--resume"]].concat()).code, 0);
    assert_eq!(fs::read_to_string(&out).unwrap(), whole);
    let merged = folder.path().join("all.csv");
    let ran = run(&["merge", word(&out), "--check", "--output", word(&merged)]);
    assert_eq!((ran.code, fs::read_to_string(&merged).unwrap()), (0, whole), "{}", ran.err);
}

#[test]
fn lines_of_json_are_the_rows_of_standard_output() {
    let (_folder, path) = file("rows.jsonl");
    rows(&["--output", word(&path)]);
    assert_eq!(fs::read_to_string(&path).unwrap(), rows(&["--format", "json"]));
}

#[test]
fn a_file_of_json_is_one_document_whole_in_parts_merged_and_resumed() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    let asked = |more: &[&str]| {
        let words = ["scan", "--over", "D=-0.3:-0.1:5", "--measure", "margin"];
        let ran = run(&[&words, more].concat());
        assert_eq!(ran.code, 0, "{}", ran.err);
        ran.out
    };
    let read = |name: &str| fs::read_to_string(path(name)).unwrap();
    let document = |name: &str| serde_json::from_str::<Vec<Value>>(&read(name)).unwrap();
    let lines = asked(&["--format", "json"]);
    let rows: Vec<Value> = lines.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    asked(&["--output", word(&path("all.json"))]);
    assert_eq!(document("all.json"), rows);
    for part in ["1", "2"] {
        let name = format!("{part}.json");
        asked(&["--output", word(&path(&name)), "--shard", &format!("{part}/2")]);
    }
    assert_eq!([document("1.json"), document("2.json")].concat(), rows);
    for name in ["merged.json", "merged.jsonl"] {
        let [one, two, all] = ["1.json", "2.json", name].map(path);
        let ran = run(&["merge", word(&one), word(&two), "--check", "--output", word(&all)]);
        assert_eq!((ran.code, ran.err.as_str()), (0, ""));
    }
    assert_eq!((read("merged.json"), read("merged.jsonl")), (read("all.json"), lines));
    let whole = read("all.json");
    for length in [0, 1, whole.len() / 2, whole.len() - 1] {
        fs::write(path("all.json"), &whole[..length]).unwrap();
        asked(&["--output", word(&path("all.json")), "--resume"]);
        assert_eq!(read("all.json"), whole, "{length}");
    }
}

#[test]
fn an_archive_has_the_columns_of_the_rows() {
    let (_folder, path) = file("rows.npz");
    rows(&["--output", word(&path)]);
    let text = rows(&[]);
    let names: Vec<&str> = text.lines().next().unwrap().split(',').collect();
    let found = arrays(&path);
    assert_eq!(found.iter().map(|(name, _)| name.as_str()).collect::<Vec<_>>(), names);
    for (at, (name, array)) in found.iter().enumerate() {
        let cells: Vec<&str> =
            text.lines().skip(1).map(|row| row.split(',').nth(at).unwrap()).collect();
        assert_eq!(array.shape, [cells.len()]);
        if array.kind.starts_with("<U") {
            assert_eq!(array.words(), cells, "{name}");
        } else {
            let number = |cell: &&str| cell.parse().unwrap_or(f64::NAN);
            let bits = |values: Vec<f64>| values.into_iter().map(f64::to_bits).collect::<Vec<_>>();
            assert_eq!(bits(array.numbers()), bits(cells.iter().map(number).collect()), "{name}");
        }
    }
    let kind = |name: &str| found.iter().find(|(own, _)| own == name).unwrap().1.kind.clone();
    assert_eq!([kind("D"), kind("half_swings"), kind("regime")], ["<f8", "<f8", "<U19"]);
}

#[test]
fn arrays_are_written_whole_and_their_rows_resume() {
    let (folder, path) = file("rows.npz");
    let words = ["scan", "--over", "D=-0.3:-0.1:3", "--measure", "margin", "--output", word(&path)];
    run(&[&words[..], &["--format", "json"]].concat()).is_refused(&["csv rows of one scan"]);
    let plan = ["--plan", "parallel", "--shards", "2"];
    run(&[&words[..], &plan].concat()).is_refused(&["csv rows of one scan"]);
    assert!(!path.exists());
    assert_eq!(run(&words).code, 0);
    let whole = fs::read(&path).unwrap();
    let names: Vec<_> =
        fs::read_dir(folder.path()).unwrap().map(|it| it.unwrap().file_name()).collect();
    assert_eq!(names.len(), 2, "the arrays and where they come from: {names:?}");
    run(&words).is_refused(&["rows.npz is not empty", "--force"]);
    // The same scan again gives the same file; another one does not replace it.
    assert_eq!(run(&[&words[..], &["--resume"]].concat()).code, 0);
    let other = [&words[..], &["--resume", "--set", "r=0.2"]].concat();
    run(&other).is_refused(&["rows.npz already exists", "--force"]);
    assert_eq!(fs::read(&path).unwrap(), whole);
    fs::remove_file(folder.path().join("rows.npz.csv")).unwrap();
    // What a killed scan leaves.
    fs::remove_file(&path).unwrap();
    let rows = folder.path().join("rows.npz.csv");
    let csv = [&words[..5], &["--output", word(&rows)]].concat();
    assert_eq!(run(&csv).code, 0);
    let two: String = fs::read_to_string(&rows).unwrap().split_inclusive('\n').take(2).collect();
    fs::write(&rows, two).unwrap();
    run(&words).is_refused(&["rows.npz.csv is not empty; --resume continues it"]);
    assert_eq!(run(&[&words[..], &["--resume"]].concat()).code, 0);
    assert_eq!(fs::read(&path).unwrap(), whole);
    let merged = folder.path().join("all.npz");
    let parts = run(&csv);
    assert_eq!(parts.code, 0, "{}", parts.err);
    run(&["merge", word(&rows), "--output", word(&merged)]).is_refused(&["all.npz", ".csv"]);
}

#[test]
fn a_row_that_was_given_up_says_that_its_margin_is_unknown() {
    let ran =
        run(&["scan", "--machine", "clutch", "--over", "v0=0.2:1e4:2", "--measure", "from-rest"]);
    let text = ran.out;
    let names: Vec<&str> = text.lines().next().unwrap().split(',').collect();
    let at = |name: &str| names.iter().position(|own| *own == name).unwrap();
    let rows: Vec<Vec<&str>> = text.lines().skip(1).map(|row| row.split(',').collect()).collect();
    assert!(rows.iter().any(|row| !row[at("reason")].is_empty()), "{text}");
    for row in rows {
        let is_unknown = row[at("from_rest_regime")] == "unknown";
        assert_eq!(is_unknown, !row[at("reason")].is_empty(), "{row:?}");
    }
}

#[test]
fn the_ending_of_a_file_says_in_which_form_an_answer_is_written() {
    let folder = tempfile::tempdir().unwrap();
    let written = |name: &str, option: &str| {
        let path = folder.path().join(name);
        let ran = run(&["cycles", "--set", "D=-0.3", option, word(&path)]);
        assert_eq!((ran.code, ran.out.as_str()), (0, ""), "{}", ran.err);
        fs::read_to_string(path).unwrap()
    };
    let document: Value = serde_json::from_str(&written("a.json", "--output")).unwrap();
    assert!(document["cycles"].is_array() && document["provenance"].is_object());
    assert!(written("a.csv", "--write").starts_with("stable,"));
    assert!(written("a.txt", "--write").starts_with("D = -0.3"));
}

#[cfg(feature = "parquet")]
#[test]
fn parquet_has_the_columns_of_the_rows() {
    use parquet::file::reader::{FileReader, SerializedFileReader};
    use parquet::record::Field;

    let (_folder, path) = file("rows.parquet");
    rows(&["--output", word(&path)]);
    let reader = SerializedFileReader::new(fs::File::open(&path).unwrap()).unwrap();
    let text = rows(&[]);
    let mut lines = text.lines();
    let names: Vec<&str> = lines.next().unwrap().split(',').collect();
    for (row, line) in reader.get_row_iter(None).unwrap().zip(lines.by_ref()) {
        let row = row.unwrap();
        for ((name, field), (own, cell)) in
            row.get_column_iter().zip(names.iter().zip(line.split(',')))
        {
            assert_eq!(name, own);
            match field {
                Field::Double(value) => assert_eq!(cell.parse(), Ok(*value), "{name}"),
                Field::Str(value) => assert_eq!(value, cell, "{name}"),
                Field::Null => assert_eq!(cell, "", "{name}"),
                field => panic!("{name}: {field:?}"),
            }
        }
    }
    assert_eq!(lines.next(), None);
}

#[test]
fn each_margin_has_a_regime_of_its_own() {
    // The nominal margin is finite; with these half widths nothing is guaranteed.
    let words = ["scan", "--over", "D=-0.3:-0.2:2", "--set", "D3=0.5", "--set", "r=0.1"];
    let more = ["--measure", "margin,guaranteed", "--half-width", "D=5", "--format", "json"];
    let ran = run(&[&words[..], &more].concat());
    for row in ran.out.lines().map(|row| serde_json::from_str::<Value>(row).unwrap()) {
        assert_eq!(
            (&row["regime"], &row["guaranteed_regime"]),
            (&"finite".into(), &"unknown".into())
        );
        assert!(row["guaranteed_impulse"].is_null() && row["reason"].is_string(), "{row}");
    }
}

#[test]
fn a_column_has_one_type_whatever_it_holds() {
    let kinds = |set: &str| {
        let (_folder, path) = file("rows.NPZ");
        let words = ["scan", "--over", "r=0.1:0.2:2", "--measure", "cycles,margin,border", "--set"];
        assert_eq!(run(&[&words[..], &[set, "--output", word(&path)]].concat()).code, 0);
        let kind =
            |(name, array): (String, crate::archive::Stored)| (name, array.kind[..2].to_owned());
        arrays(&path).into_iter().map(kind).collect::<Vec<_>>()
    };
    // Without cycles, all columns of their extremes are empty; without a reason, that column is.
    assert_eq!(kinds("D=1"), kinds("D=-0.3"));
}

#[test]
fn a_grid_of_too_many_points_is_refused() {
    let over = ["D=-1:0:65536", "D2=0:1:65536", "D3=0:1:65536", "r=0:1:65536"];
    let over = over.iter().flat_map(|over| ["--over", over]);
    let words: Vec<_> = ["scan", "--measure", "margin"].into_iter().chain(over).collect();
    run(&words).is_refused(&["too many points", "1000000000"]);
}

#[test]
fn a_scan_that_has_changed_says_how_it_starts_over() {
    let (_folder, path) = file("rows.csv");
    let words = ["scan", "--over", "D=-0.3:-0.1:3", "--measure", "margin", "--output", word(&path)];
    assert_eq!(run(&words).code, 0);
    let other = run(&[&words[..], &["--set", "r=0.2", "--resume"]].concat());
    other.is_refused(&["rows.csv: not a part of this scan: line 2", "--force starts over"]);
}
