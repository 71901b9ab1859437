//! `hopfscope scan`: rows, files that survive a kill, parts that make up the whole.

mod level;
mod merge;
#[path = "../program/mod.rs"]
mod program;

use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};

use hopfscope::flow::Limits;
use hopfscope::model::Parameters;
use hopfscope::portrait::Portrait;
use hopfscope::words::provenance::Checksum;
use program::{Ran, command, run};
use serde_json::Value;

/// Runs `hopfscope scan` with these words.
fn scan(line: &str) -> Ran {
    run(&["scan"].into_iter().chain(line.split_whitespace()).collect::<Vec<_>>())
}

/// The rows of a CSV text as maps from column to cell.
fn rows(text: &str) -> Vec<std::collections::BTreeMap<&str, &str>> {
    let mut lines = text.lines();
    let names: Vec<&str> = lines.next().expect("names").split(',').collect();
    lines.map(|line| names.iter().copied().zip(line.split(',')).collect()).collect()
}

#[test]
fn each_point_has_its_row_in_order_and_the_numbers_are_those_of_the_questions() {
    let ran = scan("--over D=-0.3:-0.2:3 --set D3=0.5 --measure margin,cycles --jobs 4");
    assert_eq!((ran.code, ran.err.as_str()), (0, ""));
    let rows = rows(&ran.out);
    let values: Vec<&str> = rows.iter().map(|row| row["D"]).collect();
    assert_eq!(values, ["-0.3", "-0.25", "-0.2"]);
    for row in rows {
        let d = row["D"].parse().unwrap();
        let parameters = Parameters { d, d3: 0.5, ..Parameters::default() };
        let found = Portrait::of_oscillator(&parameters, 1e3, &Limits::PATIENT)
            .and_then(|found| found.drawn(&parameters, 12))
            .unwrap();
        let margin = found.margin;
        assert_eq!(row["displacement"].parse(), Ok(margin.displacement.unwrap()));
        assert_eq!(row["impulse"].parse(), Ok(margin.impulse.unwrap()));
        assert_eq!(row["cycles"], "2");
        assert_eq!(row["q_max_2"].parse(), Ok(found.cycles[1].q_max));
        assert_eq!(row["reason"], "");
    }
}

#[test]
fn a_json_row_is_one_object_a_line_and_null_is_what_does_not_exist() {
    let ran = scan("--over D=-0.3:0.1:3 --over q0=0.2:3:2 --measure outcome,margin --format json");
    let rows: Vec<Value> =
        ran.out.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    assert_eq!(rows.len(), 6);
    assert_eq!(rows[0]["outcome"], "captured");
    assert_eq!(rows[1]["outcome"], "moving");
    assert!(rows[1]["displacement"].is_number() && rows[1]["half_swings"].is_number());
    assert_eq!(rows[5]["displacement"], Value::Null);
    assert_eq!(rows[5]["reason"], Value::Null);
    assert_eq!((rows[5]["q0"].as_f64(), rows[5]["method"].as_str()), (Some(3.0), Some("auto")));
}

#[test]
fn a_row_that_cannot_be_computed_says_why_and_the_others_go_on() {
    let line = "--over D=-0.999999:-0.1:2 --set r=0 --until 1e5 --measure rest,outcome";
    let ran = scan(line);
    assert_eq!(ran.code, 0);
    assert_eq!(ran.err.lines().count(), 1, "{}", ran.err);
    assert!(ran.err.contains("2 of 2 rows, ") && ran.err.contains("given up"), "{}", ran.err);
    assert!(!ran.out.contains("NaN") && !ran.out.contains("inf"), "{}", ran.out);
    let row = &rows(&ran.out)[0];
    assert_eq!((row["rest_q"], row["outcome"]), ("", "gave-up"));
    assert!(row["reason"].starts_with("outcome: "), "{}", row["reason"]);
}

#[test]
fn the_table_is_for_reading() {
    let ran = scan("--over r=log:0.01:1:3 --measure margin --format table");
    let lines: Vec<&str> = ran.out.lines().collect();
    assert_eq!(lines[0].split_whitespace().collect::<Vec<_>>(), ["r", "displacement", "impulse"]);
    assert_eq!(lines.len(), 4);
    assert!(lines.iter().all(|line| line.len() == lines[0].len()), "{}", ran.out);
}

#[test]
fn a_wrong_scan_is_refused_in_one_line() {
    for (line, expected) in [
        ("--over D=-1:0:3", "--measure"),
        ("--measure margin", "--over"),
        ("--over D=-1:0:3 --measure margins", "margin, from-rest"),
        ("--over x=-1:0:3 --measure margin", "D, D2, D3, r, q0, v0"),
        ("--over D=-1:0 --measure margin", "NAME=FROM:TO:COUNT"),
        ("--over q0=-1:0:3 --measure margin", "margin does not depend on q0"),
        ("--over D=-1:0:3 --measure margin --shard 4/3", "1 <= K <= N"),
        ("--over D=-1:0:3 --measure margin --jobs 0", "1..=1024"),
        ("--over D=-1:0:3 --measure margin --resume", "--output"),
        ("--over D=-1:0:3 --measure margin --output nowhere/x.csv", "nowhere/x.csv"),
        ("--over D=-1:0:3 --measure margin --window 1:0,0:1", "not below"),
    ] {
        let ran = scan(line);
        assert_eq!(ran.out, "", "{line}");
        ran.is_refused(&[expected]);
    }
}

/// A scan that takes several seconds, so that it is running when it is killed.
const LONG: &str =
    "--over D=-0.6:-0.1:40 --over D3=0.1:0.5:25 --set D2=0.2 --measure margin,cycles";

/// The same scan into this file, with further options.
fn to_file(path: &Path, more: &str) -> Command {
    let mut words = vec!["scan", "--output", path.to_str().unwrap()];
    words.extend(LONG.split_whitespace().chain(more.split_whitespace()));
    command(&words)
}

/// Starts a scan repeatedly, killing it whenever the file has grown by some rows, until it is done; returns how
/// often it was killed.
fn killed_until_done(path: &Path, more: &str, rows: &mut dyn FnMut() -> usize) -> usize {
    for kills in 0.. {
        let length = || fs::metadata(path).map_or(0, |file| file.len());
        let enough = length() + 150 * rows() as u64;
        let mut child = to_file(path, &format!("{more} --resume")).spawn().unwrap();
        let ended = loop {
            if let Some(status) = child.try_wait().unwrap() {
                break Some(status);
            }
            if length() >= enough {
                break None;
            }
            std::thread::yield_now();
        };
        if let Some(status) = ended {
            assert!(status.success());
            return kills;
        }
        child.kill().unwrap();
        child.wait().unwrap();
    }
    unreachable!("a scan ends")
}

/// Irregular numbers, the same in every run.
fn jumps(seed: u64) -> impl FnMut() -> usize {
    let mut state = seed;
    move || {
        state =
            state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        usize::try_from(state >> 56).unwrap()
    }
}

#[test]
fn a_scan_that_is_killed_and_resumed_is_the_same_to_the_last_byte() {
    let folder = tempfile::tempdir().unwrap();
    for form in ["csv", "json"] {
        let whole = folder.path().join(format!("whole.{form}"));
        assert!(to_file(&whole, "").status().unwrap().success());
        let whole = fs::read_to_string(whole).unwrap();
        assert_eq!(whole.lines().count(), 1000 + usize::from(form == "csv"));
        let path = folder.path().join(format!("killed.{form}"));
        let kills = killed_until_done(&path, "", &mut jumps(7));
        assert!(kills >= 3, "killed {kills} times only");
        assert!(fs::read_to_string(&path).unwrap() == whole, "after {kills} kills");
        // A file may also end anywhere, e.g. because the disk was full.
        for end in [0, 1, 40, whole.len() / 2, whole.len() - 1] {
            fs::write(&path, &whole[..end]).unwrap();
            assert!(to_file(&path, "--resume").status().unwrap().success());
            assert!(fs::read_to_string(&path).unwrap() == whole, "cut at {end}");
        }
    }
}

#[test]
fn parts_of_a_scan_put_together_are_the_whole_though_one_is_killed() {
    let folder = tempfile::tempdir().unwrap();
    let whole = scan(LONG).out;
    let mut parts = Vec::new();
    for part in 1..=3 {
        let path = folder.path().join(format!("part{part}.csv"));
        let shard = format!("--shard {part}/3");
        if part == 2 {
            killed_until_done(&path, &shard, &mut jumps(3));
        } else {
            assert!(to_file(&path, &shard).status().unwrap().success());
        }
        parts.push(fs::read_to_string(path).unwrap());
    }
    assert_eq!(parts.concat(), whole);
}

#[test]
fn a_file_of_something_else_is_refused_and_left_alone() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("rows.csv");
    let name = path.to_str().unwrap();
    let own = "--over D=-0.5:-0.1:5 --measure margin --resume --output";
    let other = |text: &str, expected: &str| {
        fs::write(&path, text).unwrap();
        scan(&format!("{own} {name}")).is_refused(&[name, expected]);
        assert_eq!(fs::read_to_string(&path).unwrap(), text);
    };
    other("Dear diary,\n", "line 1 names other columns");
    other("no line at all", "line 1 names other columns");
    let whole = scan("--over D=-0.5:-0.1:5 --measure margin").out;
    let finer = scan("--over D=-0.5:-0.1:9 --measure margin").out;
    other(&finer, "line 3 is of another point");
    other(&whole.replace("-0.3,", "-0.31,"), "line 4 is of another point");
    other(
        &(whole.clone() + "-0.05,0.0,0.0,0.1,1.0,1.0,\n"),
        "line 7 is one more than it has points",
    );
    let first = whole.lines().nth(1).unwrap();
    let altered = whole.replacen(&first[first.len() - 4..], "999,", 1);
    other(&altered, "line 2 is different when computed again");
    // With different friction the rows belong to other points.
    let rougher = scan("--over D=-0.5:-0.1:5 --measure margin --set r=0.2").out;
    other(&rougher, "line 2 is of another point");
    // The untouched file is complete: nothing is computed or changed.
    fs::write(&path, &whole).unwrap();
    assert_eq!(scan(&format!("{own} {name}")).code, 0);
    assert_eq!(fs::read_to_string(&path).unwrap(), whole);
}

#[test]
fn an_altered_row_is_refused_and_one_without_a_checksum_computed_again() {
    let folder = tempfile::tempdir().unwrap();
    let [path, beside] = ["rows.csv", "rows.csv.provenance"].map(|name| folder.path().join(name));
    let line = format!("--over D=-0.5:-0.1:9 --measure margin --output {}", path.display());
    let resume = || scan(&format!("{line} --resume"));
    assert_eq!(scan(&line).code, 0);
    let [whole, provenance] = [&path, &beside].map(|file| fs::read_to_string(file).unwrap());
    let rows: Vec<&str> = whole.split_inclusive('\n').collect();
    // A digit in the middle of a row in the middle.
    let digit = rows[5].rfind('1').unwrap();
    let altered =
        whole.replace(rows[5], &format!("{}2{}", &rows[5][..digit], &rows[5][digit + 1..]));
    fs::write(&path, &altered).unwrap();
    resume().is_refused(&["rows.csv: altered", "first 9 rows"]);
    assert_eq!(fs::read_to_string(&path).unwrap(), altered, "left alone");
    // Killed between a row and its checksum: the rows up to the checksum stay, the others are computed.
    let all = rows[1..].iter().fold(Checksum::NONE, |sum, row| sum.and(row.as_bytes()));
    let four = rows[1..5].iter().fold(Checksum::NONE, |sum, row| sum.and(row.as_bytes()));
    assert!(provenance.contains(&String::from(all)), "{provenance}");
    fs::write(&beside, provenance.replace(&String::from(all), &String::from(four))).unwrap();
    let resumed = resume();
    assert_eq!((resumed.code, resumed.err.as_str()), (0, ""));
    assert_eq!(fs::read_to_string(&path).unwrap(), whole);
    assert!(fs::read_to_string(&beside).unwrap().contains(&String::from(all)));
    // Where nothing can be known, that is said.
    fs::remove_file(&beside).unwrap();
    fs::write(&path, &altered).unwrap();
    let resumed = resume();
    assert_eq!((resumed.code, resumed.err.lines().count()), (0, 1), "{}", resumed.err);
    assert!(resumed.err.contains("no checksum says whether 7 rows"), "{}", resumed.err);
}

/// A scan whose first row takes long, because its motion never ends, and whose other rows take no time.
const HELD_UP: &str =
    "--over D=-0.2:0.6:21 --set D3=0.5 --set D2=0.2 --set q0=2 --measure rest --jobs 2";

#[test]
fn rows_that_wait_behind_a_slow_one_outlive_a_kill() {
    let folder = tempfile::tempdir().unwrap();
    let [path, ahead] = ["rows.csv", "rows.csv.ahead"].map(|name| folder.path().join(name));
    let line = format!("{HELD_UP} --until 100000 --output {}", path.display());
    let words = || std::iter::once("scan").chain(line.split_whitespace());
    let mut child = command(&words().collect::<Vec<_>>()).spawn().unwrap();
    let noted = || fs::read_to_string(&ahead).unwrap_or_default();
    while noted().lines().count() < 21 {
        assert!(child.try_wait().unwrap().is_none(), "the first row takes longer than all others");
        std::thread::yield_now();
    }
    child.kill().unwrap();
    child.wait().unwrap();
    assert_eq!(fs::read_to_string(&path).unwrap().lines().count(), 1, "only the line of names");
    // A mark with its checksum shows where a row comes from; an altered row, and a line without its end, are
    // computed again.
    let (journal, last) = (noted(), noted().lines().last().unwrap().to_owned());
    let line_of = |index: &str| {
        let line = journal.lines().find(|line| line.starts_with(index)).unwrap().to_owned();
        assert_ne!(line, last);
        line
    };
    let (second, third) = (line_of("1\t"), line_of("2\t"));
    let row = |line: &str| line.splitn(3, '\t').nth(2).unwrap().to_owned();
    let marked = format!("{},from the journal", row(&second).trim_end_matches(','));
    let checksum = String::from(Checksum::NONE.and(format!("{marked}\n").as_bytes()));
    let cut = journal.len() - last.len() / 2;
    let altered = journal[..cut]
        .replace(&second, &format!("1\t{checksum}\t{marked}"))
        .replace(&third, &format!("{},altered", third.trim_end_matches(',')));
    fs::write(&ahead, altered).unwrap();
    let resumed = command(&words().chain(["--resume"]).collect::<Vec<_>>()).status().unwrap();
    assert!(resumed.success() && !ahead.exists());
    let found = fs::read_to_string(&path).unwrap();
    let whole = scan(&format!("{HELD_UP} --until 100000")).out;
    assert!(found.contains(&marked), "{found}");
    assert_eq!(found.replace(&marked, &row(&second)), whole);
    // The journal of another scan is ignored.
    fs::write(&path, "").unwrap();
    fs::write(&ahead, "Dear diary,\n1\t-0.1,nonsense\n").unwrap();
    let short = line.replace("100000", "1");
    let again = words().collect::<Vec<_>>().join(" ").replace(&line, &short) + " --force";
    assert!(command(&again.split(' ').collect::<Vec<_>>()).status().unwrap().success());
    assert_eq!(fs::read_to_string(&path).unwrap(), scan(&format!("{HELD_UP} --until 1")).out);
    assert!(!ahead.exists());
}

#[test]
fn an_interrupt_keeps_what_is_done_and_says_so() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("rows.csv");
    let mut child = to_file(&path, "").stderr(Stdio::piped()).spawn().unwrap();
    while fs::metadata(&path).map_or(0, |file| file.len()) < 1000 {
        std::thread::yield_now();
    }
    let pid = rustix::process::Pid::from_child(&child);
    rustix::process::kill_process(pid, rustix::process::Signal::INT).unwrap();
    let mut told = String::new();
    std::io::Read::read_to_string(child.stderr.as_mut().unwrap(), &mut told).unwrap();
    assert_eq!(child.wait().unwrap().code(), Some(130), "{told}");
    assert!(told.contains("of 1000 rows; --resume continues"), "{told}");
    let text = fs::read_to_string(&path).unwrap();
    let done: usize = told.split_whitespace().nth(2).unwrap().parse().unwrap();
    assert_eq!(text.lines().count(), 1 + done);
    assert!(text.ends_with('\n') && done < 1000);
}

/// The only line of the page on scans that begins with these words.
fn page_line(beginning: &str) -> String {
    let page = fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/docs/scans.md")).unwrap();
    let mut lines = page.lines().map(str::trim).filter(|line| line.starts_with(beginning));
    let line = lines.next().unwrap_or_else(|| panic!("no line {beginning}")).to_owned();
    assert_eq!(lines.next(), None);
    line
}

/// A shell command in a folder, with the program on its path.
fn shell(line: &str, folder: &Path) -> Command {
    let program = Path::new(env!("CARGO_BIN_EXE_hopfscope")).parent().unwrap();
    let path = format!("{}:{}", program.display(), std::env::var("PATH").unwrap());
    let mut shell = Command::new("sh");
    shell.args(["-c", line]).current_dir(folder).env("PATH", path).stdin(Stdio::null());
    shell
}

/// The scan of that page in one piece.
fn page_scan() -> String {
    let line = page_line("hopfscope scan --over D=-0.9:-0.2:400");
    scan(line.strip_prefix("hopfscope scan").unwrap().split('#').next().unwrap()).out
}

#[test]
#[ignore = "needs GNU parallel: cargo test --test scan -- --ignored parallel"]
fn the_line_for_gnu_parallel_makes_the_whole() {
    let folder = tempfile::tempdir().unwrap();
    let line = page_line("parallel hopfscope scan");
    assert!(shell(&line, folder.path()).status().unwrap().success());
    assert!(shell("cat part[1-4].csv > all.csv", folder.path()).status().unwrap().success());
    assert_eq!(fs::read_to_string(folder.path().join("all.csv")).unwrap(), page_scan());
}

#[test]
fn the_line_for_slurm_makes_the_whole() {
    let folder = tempfile::tempdir().unwrap();
    let line = page_line("sbatch --array=1-4");
    let wrapped = line.split('\'').nth(1).expect("a wrapped command");
    let mut parts = String::new();
    for task in ["1", "2", "3", "4"] {
        let mut job = shell(wrapped, folder.path());
        assert!(job.env("SLURM_ARRAY_TASK_ID", task).status().unwrap().success());
        parts += &fs::read_to_string(folder.path().join(format!("part{task}.csv"))).unwrap();
    }
    assert_eq!(parts, page_scan());
}

#[test]
fn a_file_with_content_is_continued_or_replaced_only_on_request() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("rows.csv");
    let name = path.to_str().unwrap();
    let own =
        |more: &str| scan(&format!("--over D=-0.5:-0.1:3 --measure margin --output {name} {more}"));
    assert_eq!(own("").code, 0);
    let whole = fs::read_to_string(&path).unwrap();
    own("").is_refused(&[name, "--force starts over"]);
    // Continuing and starting over exclude each other.
    own("--resume --force").is_refused(&["--force", "--resume"]);
    // --force is also meaningless without a file.
    assert_eq!(scan("--over D=-0.5:-0.1:3 --measure margin --force").code, 2);
    assert_eq!(fs::read_to_string(&path).unwrap(), whole);
    // A different file under this name is not a scan to be continued; --force begins one in its place.
    fs::write(&path, "mine\n").unwrap();
    own("--resume").is_refused(&[name, "line 1 names other columns"]);
    assert_eq!(fs::read_to_string(&path).unwrap(), "mine\n");
    assert_eq!(own("--force").code, 0);
    assert_eq!(fs::read_to_string(&path).unwrap(), whole);
}
