//! Text from outside: titles, headings, names of files, words of the command line.

use std::path::Path;

use hopfscope::words::printable::is_printable;
use proptest::prelude::*;
use roxmltree::{Document, ParsingOptions};
use serde_json::Value;

use super::program::run;

/// A short text with characters that control a terminal or hide in it. Neither a file name nor an argument can have
/// all of them.
fn text() -> impl Strategy<Value = String> {
    let hostile = prop::sample::select(vec![
        '\u{1b}', '\u{7f}', '\u{9b}', '\u{202e}', '\u{200b}', '\u{feff}',
    ]);
    let control =
        prop_oneof![prop::char::range('\u{1}', '\u{1f}'), prop::char::range('\u{7f}', '\u{9f}')];
    let hidden = prop::char::range('\u{200b}', '\u{206f}');
    let seen = prop::sample::select(vec!['a', '[', ']', ';', 'c', '"', '<', '&', '\u{e9}']);
    prop::collection::vec(prop_oneof![hostile, control, hidden, seen], 1..12)
        .prop_map(String::from_iter)
}

/// A string of a TOML file.
fn quoted(text: &str) -> String {
    let escaped = text.chars().map(|char| format!("\\U{:08X}", u32::from(char)));
    format!("\"{}\"", escaped.collect::<String>())
}

fn holds(value: &Value, text: &str) -> bool {
    match value {
        Value::String(string) => string.contains(text),
        Value::Array(values) => values.iter().any(|value| holds(value, text)),
        Value::Object(fields) => fields.values().any(|value| holds(value, text)),
        _ => false,
    }
}

/// The pages that the command lines write.
const PAGES: [&str; 2] = ["machine.html", "fit.html"];

/// Files in a folder that quote a text, each with the text in its name, and the command lines that read them.
fn command_lines(folder: &Path, text: &str) -> Vec<Vec<String>> {
    let data = Path::new(env!("CARGO_MANIFEST_DIR"));
    let read = |path: &str| std::fs::read_to_string(data.join(path)).unwrap();
    let write = |ending: &str, content: String| {
        let path = folder.join(format!("{text}.{ending}"));
        std::fs::write(&path, content).unwrap();
        path.to_str().unwrap().to_owned()
    };
    let machine = read("assets/belts/straight.toml");
    let (_, numbers) = machine.split_once("\nm = ").unwrap();
    let machine = write("toml", format!("title = {}\nm = {numbers}", quoted(text)));
    let torn = write("torn", format!("title = \"{text}\n{text} = 3\nm = \"{text}\""));
    let heading = text.replace('"', "\"\"");
    let recorded = read("tests/data/fit/peaks_times.csv");
    let (_, recorded) = recorded.split_once('\n').unwrap();
    let recorded = write("csv", format!("no,peak time [s],\"peak [{heading}]\"\n{recorded}"));
    let drawn = folder.join("drawn.svg").to_str().unwrap().to_owned();
    let pages = PAGES.map(|name| folder.join(name).to_str().unwrap().to_owned());
    let script = write("keys", format!("<say {text:?}>"));
    let wrong = write("wrong", format!("<expect \"{text}\"> <{text}> {text}"));
    let missing = folder.join("none").join(text).to_str().unwrap().to_owned();
    let picture = format!("{missing}.svg");
    let words: [&[&str]; 25] = [
        &["belt", &machine, "--report", &pages[0]],
        &["belt", &machine, "--format", "csv"],
        &["belt", &machine, "--format", "json"],
        &["branch", "--machine", &machine, "--over", "v0=0.2 m/s:0.3 m/s:2"],
        &["belt", &torn],
        &["belt", &missing],
        &["belt", "--set", text],
        &["fit", &recorded, "--peaks"],
        &["fit", &recorded, "--mass", "1 kg", "--peaks"],
        &[
            "fit", &recorded, "--peaks", "--format", "json", "--output", &drawn, "--report",
            &pages[1],
        ],
        &["fit", &recorded, "--columns", text],
        &["fit", &torn],
        &["replay", &script],
        &["replay", &wrong],
        &["keys", "--config", &torn],
        &["keys", "--config", &missing],
        &["check", &torn],
        &["merge", &torn],
        &["figure", text],
        &["figure", "plain", "--output", &picture],
        &["cycles", "--scene", text],
        &["cycles", "--set", text],
        &["scan", "--over", text, "--measure", text],
        &["scan", "--over", "D=0:1:2", "--measure", "rest", "--output", &missing],
        &[text],
    ];
    words.into_iter().map(|line| line.iter().map(|word| (*word).to_owned()).collect()).collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(12))]

    #[test]
    fn whatever_is_quoted_only_printable_characters_are_written(text in text()) {
        let folder = tempfile::tempdir().unwrap();
        for line in command_lines(folder.path(), &text) {
            let line: Vec<&str> = line.iter().map(String::as_str).collect();
            let ran = run(&line);
            for written in [&ran.out, &ran.err] {
                let raw = written.chars().find(|char| *char != '\n' && !is_printable(*char));
                prop_assert_eq!(raw, None, "{:?}: {:?}", line, written);
            }
            prop_assert!(ran.code <= 2, "{:?}: {}", line, ran.err);
            if line.contains(&"json") && ran.code == 0 {
                let document: Value = serde_json::from_str(&ran.out).unwrap();
                prop_assert!(holds(&document, &text), "{}", ran.out);
            }
        }
        // It has the name of the file in its title.
        for file in ["drawn.svg", PAGES[0], PAGES[1]] {
            let drawn = std::fs::read_to_string(folder.path().join(file)).unwrap();
            prop_assert!(drawn.chars().all(|char| char == '\n' || is_printable(char)), "{}", drawn);
            let options = ParsingOptions { allow_dtd: true, ..ParsingOptions::default() };
            let document = Document::parse_with_options(&drawn, options).unwrap();
            // The text is nowhere an element.
            let own = |name: &str| document.descendants().filter(|it| it.tag_name().name() == name).count();
            prop_assert_eq!((own("a"), own("c")), (0, 0), "{}", drawn);
        }
    }
}
