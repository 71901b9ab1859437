//! The rings of the house: imports point inwards only, and the inner rings touch nothing outside.
//!
//! `src/lib.rs` describes the rings; these tests read the paths in the sources and keep it so.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

/// The modules, from the innermost ring to the outermost; those of one ring may use each other.
const RINGS: [&[&str]; 9] = [
    &["numerics"],
    &["oscillator", "closed_form"],
    &["flow"],
    &["proof"],
    &["study", "machine"],
    &["fit"],
    &["session", "scene"],
    &["view", "export"],
    &["terminal", "runtime", "cli"],
];

/// Rings that know no terminal, thread, clock, environment variable or file: all within `view`.
const PURE: usize = 7;

/// Crates and modules that only the outer rings may use, and what they stand for.
const OUTSIDE: [(&str, &str); 13] = [
    ("std::env", "the environment"),
    ("std::fs", "files"),
    ("std::net", "the network"),
    ("std::process", "processes"),
    ("std::thread", "threads"),
    ("std::time", "the clock"),
    ("std::io", "input and output"),
    ("crossterm", "the terminal"),
    ("crossbeam_channel", "threads"),
    ("ratatui", "the terminal"),
    ("rustix", "the system"),
    ("signal_hook", "signals"),
    ("termina", "the terminal"),
];

/// A source file: its path, its top module, and its text without tests.
struct Source {
    path: PathBuf,
    module: String,
    text: String,
}

/// Every source file of the library.
fn sources() -> Vec<Source> {
    fn visit(folder: &Path, found: &mut Vec<PathBuf>) {
        for entry in fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                visit(&path, found);
            } else if path.extension().is_some_and(|extension| extension == "rs") {
                found.push(path);
            }
        }
    }
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut found = Vec::new();
    visit(&root, &mut found);
    found.sort();
    let source = |path: PathBuf| {
        let inner = path.strip_prefix(&root).unwrap();
        let module = inner.iter().next().unwrap().to_str().unwrap();
        Source {
            module: module.trim_end_matches(".rs").to_owned(),
            text: without_tests(&fs::read_to_string(&path).unwrap()),
            path,
        }
    };
    found.into_iter().map(source).filter(|source| !is_test(&source.path)).collect()
}

/// Whether a whole file is compiled for tests only.
fn is_test(path: &Path) -> bool {
    path.file_stem().is_some_and(|stem| stem == "tests") || path.iter().any(|part| part == "tests")
}

/// The lines before the tests, without comments.
fn without_tests(text: &str) -> String {
    let code = text.split("#[cfg(test)]\nmod ").next().unwrap();
    code.lines().map(|line| line.split("//").next().unwrap()).collect::<Vec<_>>().join("\n")
}

/// The names that follow a prefix such as `crate::`: the first segments of paths, braces included.
fn first_segments(text: &str, prefix: &str) -> Vec<String> {
    let is_name = |char: char| char.is_alphanumeric() || char == '_';
    let mut names = Vec::new();
    for (place, _) in text.match_indices(prefix) {
        if text[..place].chars().next_back().is_some_and(|char| is_name(char) || char == ':') {
            continue;
        }
        let rest = &text[place + prefix.len()..];
        if let Some(group) = rest.strip_prefix('{') {
            let mut depth = 0;
            let mut name = String::new();
            let mut taking = true;
            for char in group.chars() {
                match char {
                    '{' => depth += 1,
                    '}' if depth == 0 => break,
                    '}' => depth -= 1,
                    ',' if depth == 0 => {
                        names.push(std::mem::take(&mut name));
                        taking = true;
                    }
                    char if depth == 0 && taking && is_name(char) => name.push(char),
                    ':' if depth == 0 => taking = false,
                    _ => {}
                }
            }
            names.push(name);
        } else {
            names.push(rest.chars().take_while(|char| is_name(*char)).collect());
        }
    }
    names.retain(|name| !name.is_empty());
    names
}

/// The ring of a module, from 0 inside.
fn ring(module: &str) -> Option<usize> {
    RINGS.iter().position(|ring| ring.contains(&module))
}

#[test]
fn every_module_has_its_ring() {
    let modules: BTreeSet<String> = sources().into_iter().map(|source| source.module).collect();
    for module in modules.iter().filter(|module| !["lib", "main"].contains(&module.as_str())) {
        assert!(ring(module).is_some(), "the module {module} stands in no ring");
    }
    assert!(modules.len() > 3, "no sources found");
}

#[test]
fn imports_point_inwards() {
    let mut checked = 0;
    let mut wrong = Vec::new();
    for source in sources() {
        let Some(own) = ring(&source.module) else { continue };
        for prefix in ["crate::", "super::", "super::super::"] {
            for name in first_segments(&source.text, prefix) {
                let Some(other) = ring(&name) else { continue };
                checked += 1;
                if other > own {
                    wrong.push(format!("{} uses {prefix}{name}", source.path.display()));
                }
            }
        }
    }
    assert!(checked > 50, "only {checked} imports found");
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn the_inner_rings_touch_nothing_outside() {
    let mut wrong = Vec::new();
    for source in sources() {
        if ring(&source.module).is_none_or(|ring| ring >= PURE) {
            continue;
        }
        let std =
            first_segments(&source.text, "std::").into_iter().map(|name| format!("std::{name}"));
        let used: Vec<String> = std.collect();
        for (outside, meaning) in OUTSIDE {
            let named = match outside.strip_prefix("std::") {
                Some(module) => used.iter().any(|name| name == module),
                None => source.text.contains(&format!("{outside}::")),
            };
            if named {
                wrong.push(format!("{} uses {outside} ({meaning})", source.path.display()));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn this_test_sees_what_it_is_for() {
    let text = "use crate::{flow::Limits, view};\nlet x = crate::runtime::x(); std::{fmt, fs}";
    assert_eq!(first_segments(text, "crate::"), ["flow", "view", "runtime"]);
    assert_eq!(first_segments(text, "std::"), ["fmt", "fs"]);
    assert_eq!(first_segments("my_crate::view", "crate::"), Vec::<String>::new());
    assert_eq!(without_tests("a // b\n#[cfg(test)]\nmod tests { crate::cli }"), "a ");
}
