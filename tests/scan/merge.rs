//! `hopfscope merge` and `scan --plan`: parts that make up the whole, or what they lack.

use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};

use crate::program::{Ran, command};
use serde_json::Value;

/// A scan of 60 rows.
const SCAN: &str = "scan --over D=-0.6:-0.1:12 --over D3=0.1:0.5:5 --measure margin";

/// Runs the program in a folder.
fn run_in(folder: &Path, line: &str) -> Ran {
    let words: Vec<&str> = line.split_whitespace().collect();
    let output = command(&words).current_dir(folder).output().unwrap();
    let text = |bytes| String::from_utf8(bytes).unwrap();
    let code = output.status.code().expect("no signal");
    Ran { code, out: text(output.stdout), err: text(output.stderr) }
}

/// A folder with the scan in one piece, `whole.csv`, and in shards, `parts/1.csv` etc.
fn folder_with_parts(shards: usize, ending: &str) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    fs::create_dir(folder.path().join("parts")).unwrap();
    assert_eq!(run_in(folder.path(), &format!("{SCAN} --output whole.{ending}")).code, 0);
    for shard in 1..=shards {
        // Every second one has a header line; the last is counted from 0.
        let header = if shard % 2 == 0 { "--header always" } else { "" };
        let own = if shard == shards {
            format!("--shard-index0 {}/{shards}", shard - 1)
        } else {
            format!("--shard {shard}/{shards}")
        };
        let line = format!("{SCAN} {own} {header} --output parts/{shard}.{ending}");
        assert_eq!(run_in(folder.path(), &line).code, 0);
    }
    folder
}

fn read(folder: &Path, name: &str) -> String {
    fs::read_to_string(folder.join(name)).unwrap()
}

/// The commands at the ends of the lines that report gaps.
fn commands(ran: &Ran) -> Vec<&str> {
    ran.err.lines().map(|line| line.rsplit_once(": hopfscope ").expect(line).1).collect()
}

#[test]
fn parts_in_any_order_are_the_whole_to_the_last_byte_and_no_file_is_lost() {
    for ending in ["csv", "json"] {
        let folder = folder_with_parts(3, ending);
        let folder = folder.path();
        let line = format!("merge parts/3.{ending} parts/1.{ending} parts/2.{ending}");
        let ran = run_in(folder, &format!("{line} --output all.{ending} --check"));
        assert_eq!((ran.code, ran.err.as_str(), ran.out.as_str()), (0, "", ""));
        let whole = read(folder, &format!("whole.{ending}"));
        assert!(read(folder, &format!("all.{ending}")) == whole);
        // A folder stands for the parts in it; writing the same whole again loses nothing.
        assert_eq!(run_in(folder, &format!("merge parts --output all.{ending}")).code, 0);
        // The output of a merge is itself a scan in one part.
        assert_eq!(run_in(folder, &format!("merge all.{ending} --check")).code, 0);
        let again = run_in(folder, &format!("{SCAN} --output all.{ending} --resume"));
        assert_eq!((again.code, again.err.as_str()), (0, ""), "its checksum is known");
        assert_eq!(read(folder, &format!("all.{ending}")), whole);
        fs::write(folder.join("mine"), "mine\n").unwrap();
        let ran = run_in(folder, "merge parts --output mine");
        ran.is_refused(&["add --force to overwrite"]);
        assert_eq!(read(folder, "mine"), "mine\n");
        assert_eq!(run_in(folder, "merge parts --output mine --force").code, 0);
        assert_eq!(fs::read_dir(folder).unwrap().count(), 7, "nothing else is left behind");
    }
}

#[test]
fn missing_rows_are_named_by_shard_and_the_suggested_commands_compute_just_them() {
    let folder = folder_with_parts(4, "csv");
    let folder = folder.path();
    // Shards of 15 rows: the first stops after 10, the second has a gap, the third is missing.
    let lines = |name: &str| read(folder, name).lines().map(|line| format!("{line}\n")).collect();
    let first: Vec<String> = lines("parts/1.csv");
    fs::write(folder.join("parts/1.csv"), first[..=10].concat() + "-0.5").unwrap();
    let mut second: Vec<String> = lines("parts/2.csv");
    second.drain(4..6);
    fs::write(folder.join("parts/2.csv"), second.concat()).unwrap();
    fs::remove_file(folder.join("parts/3.csv")).unwrap();
    let ran = run_in(folder, "merge parts --output all.csv");
    assert_eq!((ran.code, ran.out.as_str()), (1, ""));
    let told: Vec<&str> = ran.err.lines().collect();
    for (told, expected) in told.iter().zip([
        "shard 1/4: rows 11 to 15 are missing",
        "shard 2/4: rows 19 to 20 are missing",
        "shard 3/4: rows 31 to 45 are missing",
    ]) {
        assert!(told.contains(expected), "{told}");
    }
    assert_eq!(told.len(), 3, "{}", ran.err);
    assert!(!folder.join("all.csv").exists());
    for (line, rows) in commands(&ran).into_iter().zip([5, 2, 15]) {
        let before = count_rows(folder);
        assert_eq!(run_in(folder, line).code, 0, "{line}");
        assert_eq!(count_rows(folder) - before, rows, "{line}");
    }
    assert_eq!(run_in(folder, "merge parts --output all.csv --check").code, 0);
    assert!(read(folder, "all.csv") == read(folder, "whole.csv"));
}

/// Number of complete rows in all parts.
fn count_rows(folder: &Path) -> usize {
    let paths = fs::read_dir(folder.join("parts")).unwrap().map(|entry| entry.unwrap().path());
    let texts = paths
        .filter(|path| path.extension().is_some_and(|ending| ending == "csv"))
        .map(|path| fs::read_to_string(path).unwrap());
    texts
        .map(|text| {
            let whole = |line: &&str| line.starts_with('-') && line.ends_with('\n');
            text.split_inclusive('\n').filter(whole).count()
        })
        .sum()
}

#[test]
fn parts_that_do_not_belong_together_are_refused_in_one_line() {
    let folder = folder_with_parts(2, "csv");
    let folder = folder.path();
    let other = SCAN.replace("0.1:0.5", "0.1:0.6");
    run_in(folder, &format!("{other} --shard 2/2 --output other.csv"));
    run_in(folder, &format!("{SCAN} --rows 30:31 --output twice.csv"));
    let provenance = read(folder, "parts/2.csv.provenance");
    fs::copy(folder.join("parts/2.csv"), folder.join("old.csv")).unwrap();
    let old = provenance.replace(env!("CARGO_PKG_VERSION"), "0.0.1");
    fs::write(folder.join("old.csv.provenance"), old).unwrap();
    fs::copy(folder.join("parts/2.csv"), folder.join("alone.csv")).unwrap();
    // The last digit of the first row is wrong, which its checksum reveals or, without one, recomputing it.
    let right = read(folder, "parts/2.csv");
    let row = right.lines().nth(1).unwrap();
    let last = row.len() - 2;
    let digit = if &row[last..=last] == "1" { "2" } else { "1" };
    let wrong = right.replace(row, &format!("{}{digit},", &row[..last]));
    assert!(row.ends_with(',') && wrong != right, "{row}");
    fs::write(folder.join("wrong.csv"), wrong).unwrap();
    fs::write(folder.join("wrong.csv.provenance"), &provenance).unwrap();
    run_in(folder, "merge parts/1.csv wrong.csv --output all.csv")
        .is_refused(&["wrong.csv: altered", "first 30 rows"]);
    let unknown: Vec<&str> = provenance.lines().filter(|it| !it.contains("checksum")).collect();
    let unknown = unknown.join("\n").replace("\",\n}", "\"\n}");
    fs::write(folder.join("wrong.csv.provenance"), unknown).unwrap();
    assert_eq!(run_in(folder, "merge parts/1.csv wrong.csv --output unchecked.csv").code, 0);
    for (line, names) in [
        ("parts/1.csv other.csv", &["other.csv", "different scans"][..]),
        ("parts/1.csv old.csv", &["different versions", "hopfscope 0.0.1"]),
        ("parts twice.csv", &["twice.csv", "both hold row 30"]),
        ("parts/1.csv parts/1.csv parts/2.csv", &["both hold row 1"]),
        ("parts/1.csv alone.csv", &["alone.csv.provenance"]),
        ("parts/1.csv wrong.csv --check", &["wrong.csv", "different when computed again"]),
        ("parts/1.csv parts/2.csv nowhere.csv", &["nowhere.csv"]),
        ("nowhere.csv", &["nowhere.csv"]),
    ] {
        let ran = run_in(folder, &format!("merge {line} --output all.csv"));
        ran.is_refused(names);
        assert!(!folder.join("all.csv").exists(), "{line}");
    }
    // A file begun by another version is not continued.
    let ran =
        run_in(folder, &format!("{SCAN} --shard 2/2 --header always --output old.csv --resume"));
    assert!(ran.code == 2 && ran.err.contains("begun by hopfscope 0.0.1"), "{}", ran.err);
}

#[test]
fn a_part_with_a_header_can_be_read_alone_and_rows_say_where_they_come_from() {
    let folder = folder_with_parts(2, "csv");
    let names = |name: &str| read(folder.path(), name).lines().next().unwrap().to_owned();
    assert_eq!(names("parts/2.csv"), names("whole.csv"));
    let provenance: Value =
        serde_json::from_str(&read(folder.path(), "whole.csv.provenance")).unwrap();
    assert_eq!(provenance["program"], "hopfscope");
    assert_eq!(provenance["version"], env!("CARGO_PKG_VERSION"));
    assert_eq!(provenance["command"], format!("hopfscope {SCAN} --output whole.csv"));
}

/// The recipe of an engine for the scan in 6 shards.
fn recipe(folder: &Path, engine: &str) -> String {
    let ran = run_in(folder, &format!("{SCAN} --plan {engine} --shards 6 --output all.csv"));
    assert_eq!((ran.code, ran.err.as_str()), (0, ""), "{engine}");
    assert!(!ran.out.contains('@'), "{}", ran.out);
    ran.out
}

/// A shell in a folder, with the program on its path.
fn shell(folder: &Path, arguments: &[&str]) -> Command {
    let program = Path::new(env!("CARGO_BIN_EXE_hopfscope")).parent().unwrap();
    let path =
        format!("{}:{}:{}", folder.display(), program.display(), std::env::var("PATH").unwrap());
    let mut shell = Command::new("sh");
    shell.args(arguments).current_dir(folder).env("PATH", path).stdin(Stdio::null());
    shell
}

#[test]
fn the_script_for_slurm_computes_every_shard_and_asks_for_the_merge() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    fs::write(folder.join("job.sh"), recipe(folder, "slurm")).unwrap();
    // In place of sbatch, a script that records its arguments.
    fs::write(folder.join("sbatch"), "#!/bin/sh\nprintf '%s\\n' \"$@\" >> asked\n").unwrap();
    assert!(shell(folder, &["-c", "chmod +x sbatch"]).status().unwrap().success());
    assert!(read(folder, "job.sh").contains("#SBATCH --array=1-6\n"));
    for task in 1..=6 {
        let mut job = shell(folder, &["job.sh"]);
        job.env("SLURM_ARRAY_TASK_ID", task.to_string()).env("SLURM_ARRAY_JOB_ID", "77");
        assert!(job.status().unwrap().success());
    }
    let asked = read(folder, "asked");
    assert!(asked.contains("--dependency=afterany:77\n"), "{asked}");
    let merge = asked.lines().find(|line| line.starts_with("hopfscope merge")).unwrap();
    assert!(shell(folder, &["-c", merge]).status().unwrap().success());
    run_in(folder, &format!("{SCAN} --output whole.csv"));
    assert!(read(folder, "all.csv") == read(folder, "whole.csv"));
}

#[test]
fn the_shards_of_a_scan_of_a_machine_are_its_whole_and_are_resumed() {
    const SCAN: &str = "scan --machine clutch --over v0=0.2:2:20 --measure margin,cycles";
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let whole = run_in(folder, SCAN).out;
    assert_eq!(whole.lines().count(), 21);
    for shard in ["1/3", "3/3"] {
        let (number, _) = shard.split_once('/').unwrap();
        run_in(folder, &format!("{SCAN} --shard {shard} --output {number}.csv"));
    }
    let lacks = run_in(folder, "merge 1.csv 3.csv --output all.csv");
    assert_eq!(lacks.code, 1);
    let [again] = commands(&lacks)[..] else { panic!("{}", lacks.err) };
    assert_eq!(run_in(folder, again).code, 0);
    // What a killed process leaves.
    let begun = read(folder, "rows-8-14.csv");
    fs::write(folder.join("rows-8-14.csv"), &begun[..begun.len() / 2]).unwrap();
    assert_eq!(run_in(folder, &format!("{again} --resume")).code, 0);
    assert_eq!(read(folder, "rows-8-14.csv"), begun);
    let merged = run_in(folder, "merge 1.csv rows-8-14.csv 3.csv --output all.csv --check");
    assert_eq!((merged.code, read(folder, "all.csv") == whole), (0, true), "{}", merged.err);
}

#[test]
fn the_dag_for_htcondor_names_every_shard_and_its_lines_compute_the_whole() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let dag = recipe(folder, "htcondor");
    let field = |name: &str, of: &str| {
        let node = dag.split(&format!("SUBMIT-DESCRIPTION {of} ")).nth(1).unwrap();
        let line = node.lines().find(|line| line.trim().starts_with(name)).unwrap();
        line.split_once(" = ").unwrap().1.to_owned()
    };
    fs::create_dir(folder.join("all.csv.parts")).unwrap();
    for shard in 0..6 {
        assert!(dag.contains(&format!("\nVARS shard{shard} shard=\"{shard}\"\n")), "{dag}");
        assert!(dag.contains(&format!("\nPARENT shard{shard} CHILD merge\n")), "{dag}");
        let line = field("arguments", "shard").replace("$(shard)", &shard.to_string());
        assert!(shell(folder, &["-c", &line]).status().unwrap().success(), "{line}");
    }
    assert!(shell(folder, &["-c", &field("arguments", "merge")]).status().unwrap().success());
    run_in(folder, &format!("{SCAN} --output whole.csv"));
    assert!(read(folder, "all.csv") == read(folder, "whole.csv"));
}

#[test]
fn a_recipe_goes_to_its_file_and_wrong_options_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let line = format!("{SCAN} --plan snakemake --shards 40");
    let printed = run_in(folder, &line).out;
    assert_eq!(run_in(folder, &format!("{line} --output Snakefile")).code, 0);
    assert_eq!(read(folder, "Snakefile"), printed);
    assert!(printed.contains("SHARDS = 40\n") && printed.contains("\"rows.csv\""), "{printed}");
    for (more, expected) in [
        ("--plan snakemake", "--shards"),
        ("--shards 4", "--plan"),
        ("--plan pbs --shards 4", "snakemake, slurm, htcondor, parallel"),
        ("--plan slurm --shards 0", "1 .. 1000000"),
        ("--plan slurm --shards 4 --shard 1/4", "--shard"),
        ("--plan slurm --shards 4 --output {x}.csv", "batch engine"),
        ("--header never", "first, always"),
        ("--rows 60:61", "the scan has 60 rows"),
        ("--rows 1:2 --shard 1/2", "--shard"),
    ] {
        let ran = run_in(folder, &format!("{SCAN} {more}"));
        ran.is_refused(&[expected]);
    }
}

/// Runs a recipe with an engine, killing one job once in the middle of its shard.
fn with_a_kill(engine: &str, line: &str) {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    // Proofs take long enough for the kill to come in time, even on a busy machine.
    let scan = SCAN.replace(":12", ":600").replace("margin", "margin,cycles,proved");
    run_in(folder, &format!("{scan} --output whole.csv"));
    let ran = run_in(folder, &format!("{scan} --plan {engine} --shards 40 --output all.csv"));
    fs::write(folder.join("recipe"), ran.out).unwrap();
    // In place of the program, a script that kills it when it first computes shard 17.
    let program = env!("CARGO_BIN_EXE_hopfscope");
    let script = format!(
        "#!/bin/sh\ncase \"$*\" in *' 17/40 '*) ;; *) exec {program} \"$@\" ;; esac\n\
         [ -e killed ] && exec {program} \"$@\"\n\
         {program} \"$@\" &\n\
         while [ \"$(cat all.csv.parts/17.csv 2>/dev/null | wc -l)\" -lt 3 ]; do :; done\n\
         kill -9 $!; wc -l < all.csv.parts/17.csv > killed; exit 137\n"
    );
    fs::write(folder.join("hopfscope"), script).unwrap();
    assert!(shell(folder, &["-c", "chmod +x hopfscope"]).status().unwrap().success());
    let output = shell(folder, &["-c", line]).output().unwrap();
    let told = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{told}");
    let left: usize = read(folder, "killed").trim().parse().unwrap();
    assert!((3..76).contains(&left), "{left} lines when it was killed");
    assert!(read(folder, "all.csv") == read(folder, "whole.csv"), "{told}");
}

#[test]
#[ignore = "needs Snakemake: cargo test --test scan -- --ignored snakemake"]
fn snakemake_computes_the_whole_though_a_job_is_killed() {
    with_a_kill("snakemake", "snakemake --snakefile recipe --cores 2");
}

#[test]
#[ignore = "needs GNU parallel: cargo test --test scan -- --ignored parallel"]
fn gnu_parallel_computes_the_whole_though_a_job_is_killed() {
    with_a_kill("parallel", "sh recipe");
}
