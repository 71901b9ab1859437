//! Files and pipes as they go wrong: full disks, closed pipes, files without end, keystroke files that write.

use std::fs;
use std::io::Write;
use std::os::unix::fs::PermissionsExt;
use std::path::Path;
use std::process::{Command, Stdio};

use crate::program::{Ran, command, run};

/// Runs the program in a folder by a shell that says `first` and then executes it, `redirected`.
fn shell(folder: &Path, first: &str, line: &str, redirected: &str) -> Ran {
    let script = format!("{first}; exec \"$0\" {line} {redirected}");
    let output = Command::new("sh")
        .args(["-c", &script, env!("CARGO_BIN_EXE_hopfscope")])
        .current_dir(folder)
        .env("XDG_CONFIG_HOME", folder)
        .stdin(Stdio::null())
        .output()
        .unwrap();
    let text = |bytes| String::from_utf8(bytes).unwrap();
    let code = output.status.code().unwrap_or_else(|| panic!("{line}: {}", output.status));
    Ran { code, out: text(output.stdout), err: text(output.stderr) }
}

/// The names in a folder.
fn names(folder: &Path) -> Vec<String> {
    let name = |entry: std::io::Result<fs::DirEntry>| entry.unwrap().file_name().into_string();
    let mut names: Vec<String> =
        fs::read_dir(folder).unwrap().map(|it| name(it).unwrap()).collect();
    names.sort();
    names
}

/// Every command that writes a file, here over an old one.
const WRITERS: [&str; 14] = [
    "figure fig17 --output old.svg --force",
    "cycles --set D=-0.3 --set D3=0.5 --certificate old.svg --force",
    "fit record.csv --output old.svg --force",
    "fit record.csv --report old.html --force",
    "belt groan --report new.html",
    "sound supercritical --seconds 0.1 --output new.wav",
    "replay screen.keys --cast new.cast",
    "man . --force",
    "scan --over D=-0.3:-0.1:3 --measure margin --output old.svg --force",
    "scan --over D=-0.3:-0.1:3 --measure margin --format json --output old.svg --force",
    "scan --over D=-0.3:-0.1:3 --measure margin --plan slurm --shards 2 --output old.svg --force",
    "merge part.csv --output old.svg --force",
    "replay screen.keys --screens .",
    "cycles --write new.txt",
];

#[test]
fn a_disk_without_room_leaves_every_file_as_it_was() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    fs::write(folder.join("old.svg"), "old\n").unwrap();
    fs::write(folder.join("screen.keys"), "<screen old>").unwrap();
    fs::write(folder.join("old.txt"), "old\n").unwrap();
    fs::write(folder.join("old.html"), "old\n").unwrap();
    fs::write(folder.join("hopfscope.1"), "old\n").unwrap();
    let page =
        fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/fit/coulomb_rest.csv"));
    fs::write(folder.join("record.csv"), page.unwrap()).unwrap();
    let part = "scan --over D=-0.3:-0.1:3 --measure margin --output part.csv";
    assert_eq!(shell(folder, ":", part, "").code, 0);
    let before = names(folder);
    for line in WRITERS {
        // No file may grow beyond nothing: each write fails as on a full disk.
        let ran = shell(folder, "ulimit -f 0", line, "");
        assert_eq!((ran.code, ran.err.lines().count()), (1, 1), "{line}: {}{}", ran.out, ran.err);
        assert!(ran.err.contains("not written"), "{line}: {}", ran.err);
        assert_eq!(names(folder), before, "{line}");
        for old in ["old.svg", "old.html", "old.txt", "hopfscope.1"] {
            assert_eq!(fs::read_to_string(folder.join(old)).unwrap(), "old\n", "{line}");
        }
    }
    assert_eq!(shell(folder, ":", "figure fig17 --output old.svg --force", "").code, 0);
    assert!(fs::read(folder.join("old.svg")).unwrap().starts_with(b"<svg"));
    // Devices and pipes are written to where they are.
    let line = "cycles --set D=-0.3 --set D3=0.5 --format csv --write";
    assert_eq!(shell(folder, ":", &format!("{line} new.csv"), "").code, 0);
    let full = shell(folder, ":", &format!("{line} /dev/full"), "");
    assert_eq!((full.code, full.err.lines().count()), (1, 1), "{}", full.err);
    let piped = shell(folder, ":", &format!("{line} /dev/stdout"), "| cat");
    assert_eq!(piped.out, fs::read_to_string(folder.join("new.csv")).unwrap());
    let redirected = shell(folder, ":", &format!("{line} /dev/stdout"), "> redirected.csv");
    assert_eq!((redirected.code, redirected.err.as_str()), (0, ""));
    assert_eq!(fs::read_to_string(folder.join("redirected.csv")).unwrap(), piped.out);
    assert!(!Path::new("/dev/stdout.provenance").exists());
}

#[test]
fn a_pipe_that_is_closed_behind_both_streams_changes_no_exit_code() {
    for (words, code) in [
        (&["belt", "nowhere.toml"][..], 2),
        (&["cycles", "--set", "D=nan"], 2),
        (&["trajectory", "--until", "1e5", "--set", "D=-0.999999", "--set", "r=0"], 1),
        (&["keys"], 0),
        (&["--help"], 0),
        (&["scan", "--over", "D=-0.3:-0.1:3", "--measure", "margin"], 0),
    ] {
        let (reader, writer) = std::io::pipe().unwrap();
        drop(reader);
        let status =
            command(words).stdout(writer.try_clone().unwrap()).stderr(writer).status().unwrap();
        assert_eq!(status.code(), Some(code), "{words:?}: {status}");
    }
}

#[test]
fn an_answer_that_cannot_be_printed_is_a_failure() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    for line in ["cycles", "--help", "scan --over D=-0.3:-0.1:3 --measure margin", "scenes"] {
        for closed in [">&-", "1</dev/null", ">/dev/full"] {
            let ran = shell(folder, ":", line, closed);
            assert_eq!((ran.code, ran.err.lines().count()), (1, 1), "{line} {closed}: {}", ran.err);
        }
        // Whoever asks for nothing gets nothing.
        for null in [">/dev/null", "1<>/dev/null"] {
            assert_eq!(shell(folder, ":", line, null).code, 0, "{line} {null}");
        }
    }
    assert_eq!(shell(folder, ":", "cycles --write answer.txt", ">&-").code, 0);
}

/// Every command that reads a file of the user's, at the place of `FILE`.
const READERS: [&str; 14] = [
    "belt FILE",
    "--belt FILE",
    "keys --config FILE",
    "--config FILE",
    "--open FILE",
    "--play FILE",
    "replay FILE",
    "check FILE",
    "fit FILE",
    "merge FILE --check",
    "scan --over D=-0.3:-0.1:3 --measure margin --output FILE --resume",
    "scan --over D=-0.3:-0.1:3 --measure margin --format json --output FILE --resume",
    "cycles --write FILE",
    "figure fig17 --output FILE.svg",
];

#[test]
fn what_never_ends_is_refused_in_one_line() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    for name in ["sparse", "sparse.svg"] {
        fs::File::create(folder.join(name)).unwrap().set_len(5 << 30).unwrap();
    }
    fs::write(folder.join("sparse.provenance"), "{}").unwrap();
    fs::create_dir_all(folder.join("folder.svg")).unwrap();
    fs::create_dir(folder.join("folder")).unwrap();
    assert!(Command::new("mkfifo").arg(folder.join("pipe")).status().unwrap().success());
    assert!(Command::new("mkfifo").arg(folder.join("pipe.svg")).status().unwrap().success());
    for line in READERS {
        for file in ["sparse", "folder", "pipe", "/dev/zero"] {
            let writes = line.contains("--write") || line.starts_with("figure");
            if writes && file == "/dev/zero" {
                continue;
            }
            // So much memory holds no file of 5 GB.
            let ran = shell(folder, "ulimit -v 3000000", &line.replace("FILE", file), "");
            let ends = [1, 2].contains(&ran.code) && ran.out.is_empty();
            let line = line.replace("FILE", file);
            assert!(ends && ran.err.lines().count() == 1, "{line}: {} {}", ran.code, ran.err);
            assert!(ran.err.contains(file), "{line}: {}", ran.err);
        }
    }
    // A pipe that is written to is read.
    let machine = "mass = \"2 kg\"\nstiffness = \"100 N/m\"\n";
    fs::write(folder.join("machine"), machine).unwrap();
    let told = |line: &str| shell(folder, ":", line, "").err;
    let (read, piped) = (told("belt machine"), told("belt /dev/stdin < machine"));
    assert_eq!(piped, read.replace("machine:", "/dev/stdin:"));
    let mut child = command(&["belt", "/dev/stdin"])
        .stdin(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    child.stdin.take().unwrap().write_all(machine.as_bytes()).unwrap();
    let output = child.wait_with_output().unwrap();
    assert_eq!(String::from_utf8(output.stderr).unwrap(), piped);
}

/// Runs a keystroke file of this text in a folder.
fn replay(folder: &Path, keys: &str, more: &str) -> Ran {
    fs::write(folder.join("test.keys"), keys).unwrap();
    shell(folder, ":", &format!("replay test.keys {more}"), "")
}

#[test]
fn a_keystroke_file_writes_only_what_it_is_allowed_to() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    for (run, file) in [
        ("write a.toml", "a.toml"),
        ("figure a.svg", "a.svg"),
        ("scan D=-0.3:-0.1:3 margin\"> <wait> <run \"save-scan a.csv", "a.csv"),
    ] {
        let keys = format!("<right*2> <run \"{run}\"> <wait>");
        let refused = replay(folder, &keys, "");
        assert_eq!((refused.code, refused.err.lines().count()), (1, 1), "{run}: {}", refused.err);
        assert!(refused.err.contains(file) && refused.err.contains("--allow-write"), "{run}");
        assert!(refused.out.contains("not written"), "the last screen says so: {}", refused.out);
        assert_eq!(names(folder), ["test.keys"], "{run}");
        let written = replay(folder, &keys, "--allow-write");
        assert_eq!((written.code, written.err.as_str()), (0, ""), "{run}");
        let mode = fs::metadata(folder.join(file)).unwrap().permissions().mode() & 0o777;
        assert!(mode == 0o600 || file != "a.toml", "{run}: {mode:o}");
        for name in names(folder) {
            fs::remove_file(folder.join(name)).unwrap();
        }
    }
    for path in ["/dev/null", ".", "no/such/folder"] {
        let ran = replay(folder, &format!("<run \"write! {path}\">"), "--allow-write");
        assert_eq!((ran.code, ran.err.lines().count()), (1, 1), "{path}: {}", ran.err);
    }
}

#[test]
fn a_keystroke_file_presses_no_more_keys_than_it_may() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let many = replay(folder, "<right*60000>\n  <left*40000> <left>\n", "");
    assert_eq!(many.out, "");
    many.is_refused(&["line 2, column 16", "more than 100000 keys"]);
    let pictures = replay(folder, &"<screen a>\n".repeat(1001), "--size 20x5");
    assert_eq!((pictures.code, pictures.err.lines().count()), (1, 1), "{}", pictures.err);
    assert!(
        pictures.err.contains("line 1001, column 1: more than 1000 screens"),
        "{}",
        pictures.err
    );
    // Files that play each other, and a file that plays itself and more.
    fs::write(folder.join("a.keys"), "<run \"play b.keys\"> <run \"play b.keys\">").unwrap();
    fs::write(folder.join("b.keys"), "<run \"play a.keys\"> <run \"play a.keys\">").unwrap();
    fs::write(folder.join("c.keys"), "<run \"play c.keys\"> <async> <right*90>").unwrap();
    for (keys, place) in [
        ("<left>\n<right> <run \"play a.keys\">", "line 2, column 9"),
        ("<right> <run \"play c.keys\">", "line 1, column 9"),
    ] {
        let ran = replay(folder, keys, "");
        assert_eq!((ran.code, ran.err.lines().count()), (1, 1), "{keys}: {}", ran.err);
        assert!(ran.err.contains(place) && ran.err.contains("100000 keys"), "{keys}: {}", ran.err);
    }
}

#[test]
fn what_is_no_text_or_no_machine_is_told_in_one_line() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("file");
    let file = path.to_str().unwrap();
    let long = format!("x = \"{}\n", "y".repeat(1 << 20));
    let utf16: Vec<u8> = "mass = 1\r\n".encode_utf16().fold(vec![0xff, 0xfe], |mut bytes, unit| {
        bytes.extend(unit.to_le_bytes());
        bytes
    });
    let contents: [&[u8]; 7] = [
        &[0, 159, 146, 150, 255, 10],
        b"m\xe4ss = 1\n",
        &utf16,
        b"mass = \"2 kg\r\nfoo\r\n",
        b"",
        b"\n\n\n",
        long.as_bytes(),
    ];
    for content in contents {
        fs::write(&path, content).unwrap();
        for words in [
            &["belt", file][..],
            &["check", file],
            &["fit", file],
            &["merge", file, "--check"],
            &["keys", "--config", file],
            &["replay", file, "--size", "80x24"],
        ] {
            let ran = run(words);
            let begin = String::from_utf8_lossy(&content[..content.len().min(20)]).into_owned();
            let told = format!("{words:?} {begin:?}: {} {:.300}", ran.code, ran.err);
            if ran.code == 0 {
                // Settings and keystroke files may be empty, and a line of letters is one of keys.
                assert!(["keys", "replay"].contains(&words[0]), "{told}");
                continue;
            }
            assert!([1, 2].contains(&ran.code) && ran.err.lines().count() == 1, "{told}");
            assert!(ran.err.len() < 600, "{told}");
        }
    }
}
