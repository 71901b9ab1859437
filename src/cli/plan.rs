//! `hopfscope scan --plan`: the recipe by which a batch engine computes a scan in shards and merges them.

use std::ffi::OsStr;
use std::path::Path;

use clap::{Args, ValueEnum};

use super::output::without;
use super::part::MOST;
use super::{Result, input, print, write};
use crate::report::Format;
use crate::runtime::provenance_file;
use crate::words::provenance::{Provenance, quoted};

/// The options that ask for a recipe.
#[derive(Args)]
pub struct Plan {
    /// Instead of computing the scan, prints a recipe that computes it in shards and merges them. The rows go to
    /// rows.csv, or to an --output that ends in .csv, .json or .jsonl; any other --output is the recipe itself
    #[arg(long, value_name = "ENGINE", requires = "shards", conflicts_with_all = ["part", "resume"])]
    plan: Option<Engine>,
    /// Number of shards of the recipe
    #[arg(long, value_name = "N", requires = "plan", value_parser = |text: &str| input::whole(text, 1..=MOST))]
    shards: Option<usize>,
}

/// A batch engine.
#[derive(Clone, Copy, ValueEnum)]
enum Engine {
    /// A Snakefile.
    Snakemake,
    /// A script for sbatch: a job array.
    Slurm,
    /// A DAG for `condor_submit_dag`.
    Htcondor,
    /// A script around GNU parallel.
    Parallel,
}

/// Maximum number of times that a failed shard is retried.
const RETRIES: usize = 3;

/// The file of the merged rows if none is named.
const ROWS: &str = "rows.csv";

/// Options of the scan that are not passed to its shards.
pub(super) const OWN: [&str; 6] =
    ["--plan", "--shards", "--output", "--force", "--jobs", "--header"];

impl Engine {
    fn template(self) -> &'static str {
        match self {
            Engine::Snakemake => include_str!("../../assets/plans/snakemake"),
            Engine::Slurm => include_str!("../../assets/plans/slurm"),
            Engine::Htcondor => include_str!("../../assets/plans/htcondor"),
            Engine::Parallel => include_str!("../../assets/plans/parallel"),
        }
    }
}

impl Plan {
    /// Whether a recipe is asked for.
    pub fn is_wanted(&self) -> bool {
        self.plan.is_some()
    }

    /// Prints or writes the recipe for the scan of this process, with `jobs` threads for each shard.
    pub fn run(&self, jobs: u16, output: Option<&Path>, force: bool) -> Result<()> {
        let (engine, shards) = self.plan.zip(self.shards).ok_or("--plan needs --shards")?;
        let is_of_rows = |path: &&Path| {
            let ending = path.extension().and_then(OsStr::to_str);
            ending.is_some_and(|ending| ["csv", "json", "jsonl"].contains(&ending))
        };
        let rows = output.filter(is_of_rows).unwrap_or(Path::new(ROWS));
        let recipe = recipe(engine, shards, jobs, rows)?;
        match output.filter(|path| !is_of_rows(path)) {
            Some(path) => write(path, recipe.as_bytes(), force),
            None => print(&recipe),
        }
    }
}

/// The template of an engine, filled in for the scan of this process.
fn recipe(engine: Engine, shards: usize, jobs: u16, rows: &Path) -> Result<String> {
    let scan = without(&provenance_file::arguments(), &OWN);
    let rows = rows.to_string_lossy().into_owned();
    let special =
        |word: &&String| quoted(std::slice::from_ref(*word)) != **word || word.contains('@');
    if let Some(word) = scan.iter().chain([&rows]).find(special) {
        let line = format!(
            "{word:?} has characters that mean something to a batch engine; allowed: letters, \
                            digits and -_=+.,:/%"
        );
        return Err(line.into());
    }
    let parts = format!("{rows}.parts");
    let ending = Format::of_file(Path::new(&rows)).ending();
    let fields = [
        ("@version@", env!("CARGO_PKG_VERSION").to_owned()),
        ("@scan@", Provenance::of(&scan).command),
        ("@merge@", format!("hopfscope merge {parts} --output {rows} --check")),
        ("@shards@", shards.to_string()),
        ("@jobs@", jobs.to_string()),
        ("@retries@", RETRIES.to_string()),
        ("@rows@", rows),
        ("@parts@", parts),
        ("@ending@", ending.to_owned()),
    ];
    let fill = |line: &str| {
        fields.iter().fold(line.to_owned(), |line, (field, value)| line.replace(field, value))
            + "\n"
    };
    let lines = engine.template().lines().map(|line| match line.strip_prefix("@each@ ") {
        None => fill(line),
        Some(line) => {
            let line = fill(line);
            (0..shards).map(|shard| line.replace("@shard0@", &shard.to_string())).collect()
        }
    });
    Ok(lines.collect())
}
