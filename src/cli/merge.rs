//! `hopfscope merge`: joins the parts of a scan if none is missing.

use std::io::{self, BufWriter, Write};
use std::ops::Range;
use std::path::{Path, PathBuf};

use clap::Args;

use super::output::without;
use super::part::Shard;
use super::scan::ScanCommand;
use super::{Failure, Result};
use crate::flow::Limits;
use crate::report::Format;
use crate::report::scan::ScanPart;
use crate::runtime::packed::is_of_arrays;
use crate::runtime::{NewFile, PartFile, Readers, merge, provenance_file, tell};
use crate::words::provenance::{Checksum, Provenance};

/// Merges the parts of a scan, or lists the rows that are missing and how to compute them
#[derive(Args)]
pub struct MergeCommand {
    /// Files written by scan --output, each with its .provenance beside it, or directories of them
    #[arg(required = true, value_name = "PART")]
    parts: Vec<PathBuf>,
    /// Writes the merged rows to FILE
    #[arg(long, value_name = "FILE", required_unless_present = "check")]
    output: Option<PathBuf>,
    /// Computes the first and the last row of each part again and compares them
    #[arg(long)]
    check: bool,
    /// Replaces what FILE holds
    #[arg(long, requires = "output")]
    force: bool,
}

/// Options for which rows a scan computes and where they are written.
pub(super) const OWN: [&str; 6] =
    ["--shard", "--shard-index0", "--rows", "--output", "--resume", "--force"];

impl MergeCommand {
    /// Merges; exit code 1 if rows are missing.
    pub fn run(&self) -> Result<()> {
        let (sources, absent) = self.sources()?;
        let first = &sources[0];
        for other in &sources[1..] {
            must_belong_with(other, first)?;
        }
        let recheck = self.check.then_some(&Limits::PATIENT);
        let mut output = None;
        if let Some(path) = &self.output {
            if is_of_arrays(path) {
                return Err(Failure::file(path, "rows are merged as .csv, .json or .jsonl"));
            }
            let file = NewFile::begin(path, Readers::Usual).map_err(Failure::unwritten(path))?;
            output = Some((BufWriter::new(file), path));
        }
        // The first line is the heading.
        let mut checksum: Option<Checksum> = None;
        let mut write = |line: &[u8]| {
            checksum = Some(checksum.map_or(Checksum::NONE, |checksum| checksum.and(line)));
            let Some((output, path)) = &mut output else { return Ok(()) };
            output.write_all(line).map_err(Failure::unwritten(path))
        };
        let points = 0..first.part.scan.points();
        let whole = ScanPart { points, headed: true, brackets: None, ..first.part.clone() };
        let whole = self.output.iter().fold(whole, |whole, path| whole.in_file(path));
        let missing = merge(&sources, &whole, recheck, &mut write)?;
        if !missing.is_empty() {
            for gap in &missing {
                report(gap, &missing, &sources);
            }
            return Err(Failure::Said(1));
        }
        if let Some(path) = absent {
            return Err(Failure::file(path, io::Error::from(io::ErrorKind::NotFound)));
        }
        if let Some((output, path)) = output {
            let written = output.into_inner().map_err(io::IntoInnerError::into_error);
            let how = Some("add --force to overwrite");
            let written = written.and_then(|file| file.end(self.force));
            written.map_err(|error| Failure::not_replaced(path, &error, how))?;
            let command = command(without(&first.arguments, &OWN), first.part.form, path);
            let provenance = Provenance { command, checksum, ..first.provenance.clone() };
            provenance_file::write(path, &provenance)?;
        }
        Ok(())
    }

    /// The parts that exist, at least one, and the first path that does not.
    fn sources(&self) -> Result<(Vec<PartFile>, Option<&Path>)> {
        let (mut sources, mut absent) = (Vec::new(), None);
        for path in &self.parts {
            if path.is_dir() {
                for file in provenance_file::files_in(path)? {
                    sources.push(part_of(file)?);
                }
            } else if path.exists() && !path.is_file() {
                return Err(Failure::file(path, "not a file"));
            } else if path.exists() {
                sources.push(part_of(path.clone())?);
            } else {
                absent = absent.or(Some(path.as_path()));
            }
        }
        if sources.is_empty() {
            return Err(Failure::file(&self.parts[0], "there is no part of a scan"));
        }
        Ok((sources, absent))
    }
}

/// A part, with the scan to which it belongs according to its provenance.
fn part_of(path: PathBuf) -> Result<PartFile> {
    let unknown = |why: Failure| Failure::file(&path, format!("of which scan is it a part? {why}"));
    let provenance = provenance_file::read(&path).map_err(unknown)?;
    let arguments = provenance.arguments().unwrap_or_default();
    let Some(command) = ScanCommand::of_line(&arguments) else {
        let why = format!("{:?} is not a scan", provenance.command);
        return Err(Failure::file(&provenance_file::beside(&path), why));
    };
    let part = command.asked()?;
    if part.form == Format::Table {
        let why = "a table rounds its numbers; merge needs csv or json";
        return Err(Failure::file(&path, why));
    }
    Ok(PartFile { path, part, provenance, arguments })
}

/// Refuses a part of another scan or from another version.
fn must_belong_with(own: &PartFile, first: &PartFile) -> Result<()> {
    let refused = |what: &str, of: fn(&Provenance) -> String| {
        let [here, there] = [own, first].map(|file| of(&file.provenance));
        let (path, first) = (own.path.display(), first.path.display());
        Err(format!("{path} and {first} {what}: {here}, and {there}").into())
    };
    if own.provenance.build() != first.provenance.build() {
        return refused("are from different versions", Provenance::build);
    }
    if own.part.scan != first.part.scan || own.part.form != first.part.form {
        return refused("are parts of different scans", |it| it.command.clone());
    }
    Ok(())
}

/// Reports the missing rows of a gap, one line for each shard that it overlaps, with the command that computes
/// them.
fn report(gap: &Range<usize>, missing: &[Range<usize>], sources: &[PartFile]) {
    let all = sources[0].part.scan.points();
    let shard = |source: &PartFile| ScanCommand::of_line(&source.arguments)?.part.shard();
    let shard = sources.iter().find_map(shard);
    let named = |it: Shard| (format!("shard {}/{}: ", it.number, it.of), it.points(all));
    let pieces: Vec<_> = match shard {
        Some(shard) => shard.siblings().map(named).collect(),
        None => vec![(String::new(), 0..all)],
    };
    for (name, points) in pieces {
        let piece = gap.start.max(points.start)..gap.end.min(points.end);
        if !piece.is_empty() {
            let (first, last) = (piece.start + 1, piece.end);
            let command = command_for(&piece, missing, sources);
            tell(format!("{name}rows {first} to {last} are missing: {command}"));
        }
    }
}

/// The command that computes just these rows: the original one with `--resume` if only the end of its part is
/// missing, else one with `--rows`.
fn command_for(piece: &Range<usize>, missing: &[Range<usize>], sources: &[PartFile]) -> String {
    let stopped_here = |source: &&PartFile| {
        let points = &source.part.points;
        let earlier = |gap: &Range<usize>| {
            gap.start.max(points.start) < piece.start && gap.end > points.start
        };
        points.end == piece.end && points.start <= piece.start && !missing.iter().any(earlier)
    };
    let (first, form) = (&sources[0], sources[0].part.form);
    if let Some(source) = sources.iter().find(stopped_here) {
        let mut arguments = without(&source.arguments, &OWN[3..]);
        arguments.push("--resume".to_owned());
        return command(arguments, form, &source.path);
    }
    let (from, to) = (piece.start + 1, piece.end);
    let mut arguments = without(&first.arguments, &OWN);
    arguments.extend(["--rows".to_owned(), format!("{from}:{to}")]);
    let path = first.path.with_file_name(format!("rows-{from}-{to}.{}", form.ending()));
    command(arguments, form, &path)
}

/// The command line that writes rows of this form to a file, whatever its extension.
fn command(mut arguments: Vec<String>, form: Format, path: &Path) -> String {
    if form != Format::of_file(path) {
        arguments = without(&arguments, &["--format"]);
        arguments.extend(["--format", form.ending()].map(str::to_owned));
    }
    arguments.extend(["--output".to_owned(), path.to_string_lossy().into_owned()]);
    Provenance::of(&arguments).command
}
