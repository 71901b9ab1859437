//! The rings of modules: imports point inwards only, no files import each other in a cycle, and the inner rings
//! use nothing from outside.
//!
//! `src/lib.rs` describes the rings; these tests read the paths in the sources and keep it so.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

/// The modules, from the innermost ring to the outermost; those of one ring may use each other.
const RINGS: [&[&str]; 15] = [
    &["numerics"],
    &["check"],
    &["model", "closed_form"],
    &["flow"],
    &["proof"],
    &["portrait"],
    &["branch"],
    &["scan", "fit", "accuracy", "paper"],
    &["words"],
    &["question"],
    &["session", "scene"],
    &["picture"],
    &["report"],
    &["view", "figure"],
    &["terminal", "runtime", "cli"],
];

/// Modules that must not use each other: both draw the same pictures, each in its own way.
const SIBLINGS: [(&str, &str); 2] = [("view", "figure"), ("view", "report")];

/// Number of inner rings, all within `view`, that use no terminal, thread, clock, environment variable or file.
const PURE: usize = 13;

/// Crates and modules reserved for the outer rings, and what they give access to.
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

/// What stands before the name in a definition.
const ITEMS: [&str; 7] = ["const", "enum", "fn", "static", "struct", "trait", "type"];

/// A source file: its path, the path of its module, and its text without tests and comments.
struct Source {
    path: PathBuf,
    module: Vec<String>,
    text: String,
}

impl Source {
    /// Its top module.
    fn top(&self) -> &str {
        self.module.first().map_or("", String::as_str)
    }

    /// Whether it defines something of this name.
    fn defines(&self, name: &str) -> bool {
        let is_word = |char: char| char.is_alphanumeric() || char == '_';
        self.text.lines().filter(|line| line.starts_with("pub")).any(|line| {
            let words: Vec<&str> = line.split(|char| !is_word(char)).collect();
            words.windows(2).any(|pair| ITEMS.contains(&pair[0]) && pair[1] == name)
        })
    }
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
        let inner = path.strip_prefix(&root).unwrap().with_extension("");
        let mut module: Vec<String> =
            inner.iter().map(|part| part.to_str().unwrap().to_owned()).collect();
        module.pop_if(|last| ["mod", "lib"].contains(&last.as_str()));
        Source { module, text: without_tests(&fs::read_to_string(&path).unwrap()), path }
    };
    found.into_iter().map(source).filter(|source| !is_test(&source.path)).collect()
}

/// Whether a whole file is compiled only for tests.
fn is_test(path: &Path) -> bool {
    path.file_stem().is_some_and(|stem| stem == "tests") || path.iter().any(|part| part == "tests")
}

/// The lines before the tests, without comments.
fn without_tests(text: &str) -> String {
    let mut code = text;
    for visibility in ["", "pub(crate) ", "pub(super) ", "pub(in crate::session) "] {
        code = code.split(&format!("#[cfg(test)]\n{visibility}mod ")).next().unwrap();
    }
    code.lines().map(|line| line.split("//").next().unwrap()).collect::<Vec<_>>().join("\n")
}

/// A path that a file uses, and the name under which it re-exports it, if it does.
#[derive(Debug, PartialEq)]
struct Used {
    path: Vec<String>,
    offered: Option<String>,
}

/// Every path that a text uses, from the root: those in `use` declarations and those written out.
fn used(module: &[String], text: &str) -> Vec<Used> {
    let is_word = |char: char| char.is_alphanumeric() || char == '_';
    let mut found = Vec::new();
    let mut rest = String::new();
    let mut lines = text.split_inclusive('\n');
    while let Some(line) = lines.next() {
        let head = line.trim_start();
        let offers = head.starts_with("pub");
        let start = if offers {
            head.find(" use ").map(|at| at + 1)
        } else {
            Some(0)
        };
        let Some(tree) = start.and_then(|at| head[at..].strip_prefix("use ")) else {
            rest += line;
            continue;
        };
        let mut tree = tree.to_owned();
        while !tree.contains(';') {
            tree += lines.next().unwrap();
        }
        expand(tree.split(';').next().unwrap(), &[], &mut |path, name| {
            let offered = offers.then(|| name.to_owned());
            found.push(Used { path: from_root(module, path), offered });
        });
    }
    for prefix in ["crate::", "super::", "self::", "std::"] {
        for (at, _) in rest.match_indices(prefix) {
            if rest[..at].ends_with(|char| is_word(char) || char == ':') {
                continue;
            }
            let end = rest[at..].find(|char| !is_word(char) && char != ':');
            let path = &rest[at..end.map_or(rest.len(), |end| at + end)];
            let path: Vec<String> = path.split("::").map(str::to_owned).collect();
            found.push(Used { path: from_root(module, path), offered: None });
        }
    }
    found
}

/// Calls `each` with every path of a `use` tree and the name that it introduces.
fn expand(tree: &str, before: &[String], each: &mut dyn FnMut(Vec<String>, &str)) {
    let mut depth = 0;
    let branches = tree.split(|char| {
        depth += i32::from(char == '{') - i32::from(char == '}');
        char == ',' && depth == 0
    });
    for branch in branches.map(str::trim).filter(|branch| !branch.is_empty()) {
        let (stem, inner) = branch.split_once('{').map_or((branch, None), |it| (it.0, Some(it.1)));
        let (stem, alias) = stem.split_once(" as ").unwrap_or((stem, ""));
        let words = stem.split("::").map(str::trim).filter(|word| !word.is_empty());
        let mut path: Vec<String> =
            before.iter().cloned().chain(words.map(str::to_owned)).collect();
        if let Some(inner) = inner {
            expand(inner.rsplit_once('}').unwrap().0, &path, each);
            continue;
        }
        path.pop_if(|last| last == "self");
        let last = path.last().cloned().unwrap_or_default();
        each(path, if alias.is_empty() { &last } else { alias });
    }
}

/// A path as written in a module, from the root; external paths unchanged.
fn from_root(module: &[String], path: Vec<String>) -> Vec<String> {
    let mut base = module.to_vec();
    let mut words = path.into_iter().peekable();
    match words.peek().map(String::as_str) {
        Some("crate") => base.clear(),
        Some("self") => {}
        Some("super") => {
            while words.next_if(|word| word == "super").is_some() {
                base.pop();
            }
            return base.into_iter().chain(words).collect();
        }
        // A path that begins with the name of a child is in the module itself; anything else is external.
        _ => return words.collect(),
    }
    words.next();
    base.into_iter().chain(words).collect()
}

/// The files, and which others each of them uses.
struct Files {
    sources: Vec<Source>,
    by_module: BTreeMap<Vec<String>, usize>,
    used: Vec<Vec<Used>>,
}

impl Files {
    fn read() -> Self {
        Files::of(sources())
    }

    fn of(sources: Vec<Source>) -> Self {
        let modules = sources.iter().enumerate();
        let by_module: BTreeMap<_, _> =
            modules.map(|(index, source)| (source.module.clone(), index)).collect();
        let mut used: Vec<Vec<Used>> =
            sources.iter().map(|source| used(&source.module, &source.text)).collect();
        for (source, used) in sources.iter().zip(&mut used) {
            for it in used {
                let child: Vec<String> =
                    source.module.iter().chain(it.path.first()).cloned().collect();
                if child.len() > source.module.len() && by_module.contains_key(&child) {
                    it.path.splice(0..1, child);
                }
            }
        }
        Files { sources, by_module, used }
    }

    /// The file in which the target of a path is defined; re-exports are followed to their origin.
    fn home(&self, path: &[String], depth: usize) -> Option<usize> {
        let mut file = *self.by_module.get(&path[..1])?;
        for at in 1..path.len() {
            if let Some(child) = self.by_module.get(&path[..=at]) {
                file = *child;
                continue;
            }
            let mut from = self.origins(file, &path[at]).filter(|from| *from != path[..=at]);
            let Some(from) = from.next().filter(|_| depth < 9) else { break };
            let path: Vec<String> = from.iter().chain(&path[at + 1..]).cloned().collect();
            return self.home(&path, depth + 1).or(Some(file));
        }
        Some(file)
    }

    /// Where a name may come from that a file offers: by itself, or with all of a module that defines it or offers it on.
    fn origins<'a>(&'a self, file: usize, name: &'a str) -> impl Iterator<Item = Vec<String>> + 'a {
        let by_name = |it: &&Used| it.offered.as_deref() == Some(name);
        let from_all = move |it: &Used| {
            let (last, module) = it.path.split_last().filter(|_| it.offered.is_some())?;
            let within = *self.by_module.get(module).filter(|_| last == "*")?;
            let has =
                self.sources[within].defines(name) || self.origins(within, name).next().is_some();
            has.then(|| module.iter().cloned().chain([name.to_owned()]).collect())
        };
        let named = self.used[file].iter().filter(by_name).map(|it| it.path.clone());
        named.chain(self.used[file].iter().filter_map(from_all))
    }

    /// Which files each file uses. A re-export of definitions of a child module makes no cycle.
    fn uses(&self) -> Vec<BTreeSet<usize>> {
        let of_file = |file: usize| {
            let own = &self.sources[file].module;
            let offers_child = |it: &&Used| it.offered.is_some() && it.path.starts_with(own);
            let used = self.used[file].iter().filter(|it| !offers_child(it));
            let used = used.filter(|it| !it.path.is_empty());
            used.filter_map(|it| self.home(&it.path, 0)).filter(|home| *home != file).collect()
        };
        (0..self.sources.len()).map(of_file).collect()
    }
}

/// The largest sets of files each of which uses every other, directly or indirectly.
fn circles(uses: &[BTreeSet<usize>]) -> Vec<BTreeSet<usize>> {
    let reach = |from: usize| {
        let mut found = BTreeSet::new();
        let mut open = vec![from];
        while let Some(file) = open.pop() {
            open.extend(uses[file].iter().filter(|next| found.insert(**next)));
        }
        found
    };
    let reached: Vec<BTreeSet<usize>> = (0..uses.len()).map(reach).collect();
    let mut circles: Vec<BTreeSet<usize>> = Vec::new();
    for (file, reach) in reached.iter().enumerate() {
        let circle: BTreeSet<usize> =
            reach.iter().copied().filter(|other| reached[*other].contains(&file)).collect();
        if !circle.is_empty() && !circles.contains(&circle) {
            circles.push(circle);
        }
    }
    circles
}

/// The ring of a module, counted from 0 at the centre.
fn ring(module: &str) -> Option<usize> {
    RINGS.iter().position(|ring| ring.contains(&module))
}

#[test]
fn every_module_has_its_ring() {
    let modules: BTreeSet<String> =
        sources().iter().map(|source| source.top().to_owned()).collect();
    for module in modules.iter().filter(|module| !["", "main"].contains(&module.as_str())) {
        assert!(ring(module).is_some(), "the module {module} stands in no ring");
    }
    assert!(modules.len() > 3, "no sources found");
}

#[test]
fn imports_point_inwards() {
    let files = Files::read();
    let mut checked = 0;
    let mut wrong = Vec::new();
    for (source, used) in files.sources.iter().zip(&files.used) {
        let Some(own) = ring(source.top()) else { continue };
        for path in used.iter().map(|it| &it.path) {
            let Some(other) = path.first().and_then(|top| ring(top)) else { continue };
            checked += 1;
            if other > own {
                wrong.push(format!("{} uses {}", source.path.display(), path.join("::")));
            }
        }
    }
    assert!(checked > 1000, "only {checked} imports found");
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn no_files_use_each_other_in_a_circle() {
    let files = Files::read();
    let name = |file: &usize| files.sources[*file].module.join("/");
    let names = circles(&files.uses()).into_iter();
    let names = names.map(|circle| circle.iter().map(name).collect::<Vec<_>>());
    let found: Vec<String> = names.map(|circle| circle.join(" ")).collect();
    assert!(found.is_empty(), "move data below what works on it:\n{}", found.join("\n"));
}

#[test]
fn siblings_do_not_know_each_other() {
    let files = Files::read();
    let mut wrong = Vec::new();
    for (source, used) in files.sources.iter().zip(&files.used) {
        let tops = used.iter().filter_map(|it| it.path.first());
        for top in tops {
            let pair = |(one, other): &(&str, &str)| {
                (source.top(), top.as_str()) == (*one, *other)
                    || (source.top(), top.as_str()) == (*other, *one)
            };
            if SIBLINGS.iter().any(pair) {
                wrong.push(format!("{} uses {top}", source.path.display()));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn the_inner_rings_touch_nothing_outside() {
    let files = Files::read();
    let mut wrong = Vec::new();
    for (source, used) in files.sources.iter().zip(&files.used) {
        if ring(source.top()).is_none_or(|ring| ring >= PURE) {
            continue;
        }
        for (outside, meaning) in OUTSIDE {
            let is_it = |it: &Used| it.path.join("::").starts_with(outside);
            if used.iter().any(is_it) || source.text.contains(&format!("{outside}::")) {
                wrong.push(format!("{} uses {outside} ({meaning})", source.path.display()));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// Files of a small example, each by its module and its text.
fn house(files: &[(&str, &str)]) -> Files {
    let source = |(module, text): &(&str, &str)| Source {
        path: module.into(),
        module: module.split("::").map(str::to_owned).collect(),
        text: without_tests(text),
    };
    Files::of(files.iter().map(source).collect())
}

#[test]
fn this_test_sees_what_it_is_for() {
    let paths = |text: &str| -> Vec<String> {
        let module = ["flow".to_owned(), "run".to_owned()];
        used(&module, text).into_iter().map(|it| it.path.join("::")).collect()
    };
    assert_eq!(
        paths("use crate::{flow::Limits, view as seen};\nlet x = crate::runtime::x() + super::y;"),
        ["flow::Limits", "view", "runtime::x", "flow::y"]
    );
    assert_eq!(
        paths("use std::{fmt, fs::{self, File}};"),
        ["std::fmt", "std::fs", "std::fs::File"]
    );
    assert_eq!(paths("my_crate::view"), Vec::<String>::new());
    assert_eq!(without_tests("a // b\n#[cfg(test)]\nmod tests { crate::cli }"), "a ");
}

#[test]
fn a_circle_is_seen_through_whatever_a_module_offers_again() {
    let [one, other] = ["use crate::b::Other;", "use crate::a::One;"];
    let through = [("a", "mod one;\npub use one::One;"), ("a::one", one)];
    let back = [("b", "mod other;\npub use self::other::Other;"), ("b::other", other)];
    let files = house(&[&through[..], &back[..]].concat());
    assert_eq!(circles(&files.uses()), [BTreeSet::from([1, 3])]);
    let all = [("b", "mod more;\nmod other;\npub use self::{more::*, other::*};")];
    let defined = [("b::more", ""), ("b::other", "use crate::a::One;\npub const fn Other() {}")];
    let files = house(&[&through[..], &all[..], &defined[..]].concat());
    assert_eq!(circles(&files.uses()), [BTreeSet::from([1, 4])]);
    let files = house(&[&through[..], &[back[0], ("b::other", "")][..]].concat());
    assert_eq!(circles(&files.uses()), Vec::<BTreeSet<usize>>::new());
    let parent = [
        ("a", "mod one;\nstruct Data;\nfn f() { one::g() }\nuse one::g;"),
        ("a::one", "use super::Data;"),
    ];
    assert_eq!(
        circles(&house(&parent).uses()).len(),
        1,
        "a parent with data that its children use"
    );
}

/// Whether something named in CONTRIBUTING.md exists: a file, a folder, or an item in the module given for it.
fn is_there(root: &Path, sources: &[Source], name: &str) -> bool {
    let path = name.trim_end_matches("*.toml").trim_end_matches('/');
    if name.contains(['/', '.']) {
        let inside = |source: &Source| source.path.ends_with(path);
        return root.join(path).exists()
            || root.join("src").join(path).exists()
            || root.join("src/session").join(path).exists()
            || sources.iter().any(inside);
    }
    let words: Vec<&str> = name.split("::").collect();
    let (item, module) = words.split_last().unwrap();
    let said = |text: &str| {
        text.split(|char: char| !char.is_alphanumeric() && char != '_').any(|word| word == *item)
    };
    let within =
        |source: &&Source| module.iter().all(|it| source.module.iter().any(|own| own == it));
    sources.iter().filter(within).any(|source| said(&source.text) || source.top() == *item)
}

#[test]
fn the_walks_through_the_code_name_what_is_there() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let text = fs::read_to_string(root.join("CONTRIBUTING.md")).unwrap();
    let sources = sources();
    let is_name =
        |name: &&str| name.starts_with(char::is_alphanumeric) && !name.contains([' ', '=', '-']);
    let named: Vec<&str> = text.split('`').skip(1).step_by(2).filter(is_name).collect();
    assert!(named.len() > 60, "{named:?}");
    let gone: Vec<_> = named.iter().filter(|name| !is_there(root, &sources, name)).collect();
    assert!(gone.is_empty(), "CONTRIBUTING.md names what is not there: {gone:?}");
    for gone in ["src/session/gone.rs", "session/state/gone/", "gone.rs", "session::gone"] {
        assert!(!is_there(root, &sources, gone), "{gone}");
    }
}
