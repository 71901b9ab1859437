//! Tells the program which revision of its source it is built from, in `HOPFSCOPE_REVISION`.
//!
//! Asked again only when what is compiled changes: a commit alone does not build the program anew.

use std::path::Path;
use std::process::Command;

/// What the program is compiled from.
const SOURCES: [&str; 5] = ["assets", "build.rs", "Cargo.lock", "Cargo.toml", "src"];

fn main() {
    println!("cargo::rerun-if-env-changed=HOPFSCOPE_REVISION");
    // Cargo takes a file that is missing for one that has changed.
    for source in SOURCES.iter().filter(|source| Path::new(source).exists()) {
        println!("cargo::rerun-if-changed={source}");
    }
    if std::env::var_os("HOPFSCOPE_REVISION").is_none()
        && let Some(revision) = revision()
    {
        println!("cargo::rustc-env=HOPFSCOPE_REVISION={revision}");
    }
}

/// The commit, with `-dirty` appended if the sources differ from it. Without git, what the clone itself or the package says,
/// with `-unchecked` appended; `None` in neither.
fn revision() -> Option<String> {
    // A package may lie unpacked in the repository of something else.
    if git(&["rev-parse", "--show-prefix"]).is_none_or(|prefix| !prefix.is_empty()) {
        return noted().map(|commit| format!("{}-unchecked", &commit[..12]));
    }
    let commit = git(&["rev-parse", "--short=12", "HEAD"])?;
    if git(&[&["status", "--porcelain", "--"], &SOURCES[..]].concat())?.is_empty() {
        return Some(commit);
    }
    // What is published should name a commit; tests should not wait for a build because of one.
    let log = git(&["rev-parse", "--git-path", "logs/HEAD"])?;
    if std::env::var("PROFILE").is_ok_and(|it| it == "release") && Path::new(&log).exists() {
        println!("cargo::rerun-if-changed={log}");
    }
    Some(commit + "-dirty")
}

/// The commit that is noted in the files of a clone or of a package.
fn noted() -> Option<String> {
    let read = |path: &str| std::fs::read_to_string(path).ok();
    let hex = |text: &str| -> Option<String> {
        let found = text.split(|char: char| !char.is_ascii_hexdigit()).find(|it| it.len() == 40);
        found.map(str::to_owned)
    };
    if let Some(package) = read(".cargo_vcs_info.json") {
        return hex(&package);
    }
    let head = read(".git/HEAD")?;
    let Some(name) = head.trim().strip_prefix("ref: ") else { return hex(&head) };
    let packed =
        || read(".git/packed-refs")?.lines().find(|line| line.ends_with(name)).and_then(hex);
    read(&format!(".git/{name}")).and_then(|text| hex(&text)).or_else(packed)
}

/// What git prints; `None` if it is missing or fails. It takes no lock that a command of the user may want.
fn git(arguments: &[&str]) -> Option<String> {
    // A clone of another user, as in a container, is read all the same.
    let settings = ["--no-optional-locks", "-c", "safe.directory=*"];
    let output = Command::new("git").args(settings).args(arguments).output().ok()?;
    let text = String::from_utf8(output.stdout).ok()?;
    output.status.success().then(|| text.trim().to_owned())
}
