//! The README and the pages of `docs/` describe what the program does.
//!
//! In a `console` block each line that begins with `$ hopfscope` is run, and the lines below it must match its
//! output; a line `..` stands for any number of lines.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use crate::program::run;

/// Every page, with name and text.
fn pages() -> Vec<(String, String)> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let folder = fs::read_dir(root.join("docs")).unwrap().map(|entry| entry.unwrap().path());
    let folder = folder.filter(|path| path.is_file());
    let read = |path: std::path::PathBuf| {
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        (name, fs::read_to_string(&path).unwrap())
    };
    let found: Vec<_> = folder.chain([root.join("README.md")]).map(read).collect();
    assert!(found.len() > 5, "{found:?}");
    found
}

/// The contents of the blocks of one kind.
fn blocks<'a>(text: &'a str, kind: &str) -> Vec<&'a str> {
    let fence = format!("```{kind}\n");
    text.split(&fence).skip(1).filter_map(|rest| rest.split("```").next()).collect()
}

/// Whether `given` matches `shown`, where a line `..` stands for any number of lines.
fn matches(shown: &[&str], given: &[&str]) -> bool {
    match (shown, given) {
        ([], []) | ([".."], _) => true,
        (["..", rest @ ..], _) => (0..=given.len()).any(|skipped| matches(rest, &given[skipped..])),
        ([line, rest @ ..], [first, others @ ..]) => {
            line.trim_end() == first.trim_end() && matches(rest, others)
        }
        _ => false,
    }
}

#[test]
fn every_answer_shown_is_the_one_that_is_given() {
    let mut shown_answers = 0;
    for (name, text) in pages() {
        for block in blocks(&text, "console") {
            for shown in block.split("$ hopfscope ").skip(1) {
                let (line, answer) = shown.split_once('\n').unwrap();
                let words: Vec<&str> = line.split_whitespace().collect();
                let ran = run(&words);
                let given: Vec<&str> = ran.out.trim_end().lines().collect();
                let answer: Vec<&str> = answer.trim_end().lines().collect();
                assert!(matches(&answer, &given), "{name}: hopfscope {line}\n{}", ran.out);
                shown_answers += 1;
            }
        }
    }
    assert!(shown_answers > 1);
}

#[test]
fn the_oldest_rust_is_the_one_that_cargo_asks_for() {
    let readme = pages().into_iter().find(|(name, _)| name == "README.md").unwrap().1;
    let promised = format!("With Rust {} or newer", env!("CARGO_PKG_RUST_VERSION"));
    assert!(readme.contains(&promised), "README.md lacks {promised:?}");
}

/// The names of the commands in the help text.
fn commands() -> BTreeSet<String> {
    let help = run(&["--help"]).out;
    let listed = help.split("Commands:\n").nth(1).unwrap().split("\n\n").next().unwrap();
    // The continuation of a wrapped description is indented further.
    let rows = listed.lines().filter(|line| line.starts_with("  ") && !line.starts_with("   "));
    let names = rows.filter_map(|line| line.split_whitespace().next());
    names.filter(|name| *name != "help").map(str::to_owned).collect()
}

#[test]
fn every_command_is_in_the_page_of_the_command_line() {
    let page = pages().into_iter().find(|(name, _)| name == "command-line.md").unwrap().1;
    for command in commands() {
        let named = [format!("`{command}"), format!("`hopfscope {command}")];
        assert!(named.iter().any(|name| page.contains(name)), "command-line.md lacks {command}");
    }
}

#[test]
fn every_option_that_a_page_names_exists() {
    let mut known: BTreeSet<String> = BTreeSet::new();
    let helps = commands().into_iter().map(|command| run(&[&command, "--help"]).out);
    for help in helps.chain([run(&["--help"]).out]) {
        known.extend(options(&help));
    }
    // Options of cargo and of other programs.
    known.extend(
        [
            "release",
            "test",
            "bench",
            "path",
            "lib",
            "all-targets",
            "profile",
            "features",
            "no-default-features",
            "target",
            "ignore-missing",
            "array",
            "wrap",
            "ignored",
            "cores",
        ]
        .map(|option| format!("--{option}")),
    );
    for (name, text) in pages() {
        for option in options(&text) {
            assert!(known.contains(&option), "{name} names {option}, which no command has");
        }
    }
}

/// The words of a text that begin with two hyphens.
fn options(text: &str) -> BTreeSet<String> {
    let word = |rest: &str| {
        let end = rest.find(|c: char| !c.is_ascii_lowercase() && c != '-' && !c.is_ascii_digit());
        format!("--{}", &rest[..end.unwrap_or(rest.len())])
    };
    text.split("--").skip(1).map(word).filter(|option| option.len() > 3).collect()
}

#[test]
fn the_readme_is_read_in_five_minutes() {
    let readme = pages().into_iter().find(|(name, _)| name == "README.md").unwrap().1;
    assert!(readme.lines().count() <= 150);
    for (name, _) in pages().iter().filter(|(name, _)| name != "README.md") {
        assert!(readme.contains(&format!("docs/{name}")), "README.md does not mention docs/{name}");
    }
}

#[test]
fn manuals_and_completions_name_every_command() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().to_str().unwrap();
    assert_eq!(run(&["man", path]).code, 0);
    let script = run(&["completions", "bash"]).out;
    for command in commands() {
        let page =
            fs::read_to_string(folder.path().join(format!("hopfscope-{command}.1"))).unwrap();
        assert!(page.contains(".TH") && page.contains("OPTIONS"), "{command}");
        assert!(script.contains(&command), "{command}");
    }
    // A second run changes nothing, and a page of another origin is kept.
    assert_eq!(run(&["man", path]).code, 0);
    fs::write(folder.path().join("hopfscope.1"), "mine").unwrap();
    run(&["man", path]).is_refused(&["hopfscope.1", "add --force to overwrite"]);
    assert_eq!(fs::read_to_string(folder.path().join("hopfscope.1")).unwrap(), "mine");
}
