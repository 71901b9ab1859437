//! `hopfscope scan`: the same measures at every point of a line or grid of parameters.

use std::io::{self, IsTerminal};
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

use clap::{Args, ValueEnum};
use signal_hook::{consts, flag};

use super::conditions::ConditionOptions;
use super::output::holds_something;
use super::part::RowChoice;
use super::plan::Plan;
use super::points::columns;
use super::progress::{Outlet, StatusLine, message};
use super::{Failure, Result, SourceOptions, of_words, print, read};
use crate::flow::Limits;
use crate::report::Format;
use crate::report::scan::ScanPart;
use crate::runtime::failure::exit_code;
use crate::runtime::scan_file::{pack, rows_of};
use crate::runtime::scanning::rows;
use crate::runtime::{ScanFile, packed, provenance_file, tell};
use crate::scan::{MEASURES, Measure, Scan, Sweep};
use crate::scene::{ScanOption, ScanOptions};
use crate::words::joined;

/// Measures at every point of a line or grid of parameters, on all cores, one row per point
#[derive(Args)]
#[command(name = "scan")]
pub struct ScanCommand {
    #[command(flatten)]
    pub source: SourceOptions,
    /// A parameter and its values, evenly spaced, or at equal ratios with log: before FROM; repeatable, the last
    /// one varies fastest
    #[arg(long, value_name = "NAME=FROM:TO:COUNT", required_unless_present = "list")]
    over: Vec<String>,
    /// A list of parameter sets in place of --over: comma-separated values below a line of names, such as D,r
    #[arg(long = "points", value_name = "FILE", conflicts_with = "over")]
    list: Option<PathBuf>,
    #[arg(long, value_name = "NAME,..", required = true, value_delimiter = ',',
          value_parser = Measure::named, help = measures_help(), long_help = measures_list())]
    measure: Vec<Measure>,
    /// Also measures `proved`, which is the same as naming it
    #[arg(long)]
    certify: bool,
    #[command(flatten)]
    conditions: ConditionOptions,
    /// Number of threads (default: one per core)
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub jobs: Option<u16>,
    /// Output format; json writes one object per line (default: the extension of FILE, or csv)
    #[arg(long)]
    format: Option<Format>,
    /// Writes the rows to FILE instead of standard output
    #[arg(long, value_name = "FILE")]
    pub output: Option<PathBuf>,
    /// Continues an earlier scan to the same FILE
    #[arg(long, requires = "output")]
    resume: bool,
    /// Starts over even if FILE is not empty
    #[arg(long, requires = "output", conflicts_with = "resume")]
    force: bool,
    #[command(flatten)]
    pub part: RowChoice,
    /// Which parts begin with the header line; merge accepts both
    #[arg(long, value_enum, value_name = "WHEN", default_value_t = HeaderWhen::First)]
    header: HeaderWhen,
    #[command(flatten)]
    plan: Plan,
}

/// Which parts begin with the header line.
#[derive(Clone, Copy, PartialEq, ValueEnum)]
enum HeaderWhen {
    /// The first one, so that cat puts parts together.
    First,
    /// All, so that each can be read alone.
    Always,
}

fn measures_help() -> String {
    let names = joined(MEASURES.iter().map(|row| row.name), ", ");
    format!("What to measure; repeatable: {names}")
}

/// The same with the meaning of each measure, in the form in which clap lists possible values.
fn measures_list() -> String {
    let rows = MEASURES.iter().map(|row| format!("- {}: {}", row.name, row.meaning));
    format!("What to measure; repeatable:\n{}", joined(rows, "\n"))
}

impl ScanCommand {
    /// The scan of a command line without the program name; `None` if this version cannot parse it.
    pub fn of_line(arguments: &[String]) -> Option<Self> {
        arguments.first().filter(|command| *command == "scan")?;
        of_words(arguments).ok()
    }

    /// A scan of a scene, which goes on with its file unless that may be replaced. Fails if an option is wrong.
    pub fn of_scene(options: &ScanOptions, source: &SourceOptions, force: bool) -> Result<Self> {
        let mut words = vec!["scan".to_owned()];
        for (name, option) in options {
            let values = match option {
                ScanOption::One(value) => std::slice::from_ref(value),
                ScanOption::Several(values) => values,
            };
            words.extend(values.iter().map(|value| format!("--{name}={value}")));
        }
        words.push(if force { "--force" } else { "--resume" }.to_owned());
        let command = ScanCommand { source: source.clone(), ..of_words(&words)? };
        command.asked()?;
        Ok(command)
    }

    /// Computes and writes rows until all are done or a signal stops it.
    pub fn run(&self) -> Result<()> {
        let part = self.asked()?;
        if self.plan.is_wanted() {
            return self.plan.run(self.jobs.unwrap_or(1), self.output.as_deref(), self.force);
        }
        let stop = stop_signal()?;
        let interrupted = || stop.load(Ordering::Relaxed) != 0;
        let (all, scan) = (part.points.len(), part.scan.clone());
        let mut file = self.opened(part, &interrupted)?;
        let (left, open) = (file.left(), file.open());
        let done = all - left + file.ahead();
        let jobs = self.jobs.map(usize::from);
        let place = match (io::stderr().is_terminal(), &self.output) {
            (true, None) if io::stdout().is_terminal() => Outlet::Nowhere,
            (true, _) => Outlet::Line,
            (false, _) => Outlet::Log,
        };
        let mut progress = StatusLine::new(place);
        let (mut computed, mut given_up, mut broken) = (0, 0, None);
        let took = rows(&scan, open, jobs, 0, &interrupted, &mut |index, row| {
            broken = file.add(index, &row).err();
            if broken.is_some() {
                return ControlFlow::Break(());
            }
            given_up += usize::from(row.reason.is_some());
            computed += 1;
            progress.renew(|seconds| message(computed, done, all - done, seconds));
            ControlFlow::Continue(())
        });
        progress.end();
        took.map_err(|why| Failure::unanswered("cannot start threads for the scan", why))?;
        let lost = (given_up > 0).then(|| format!(", {given_up} of them given up"));
        let lost = lost.unwrap_or_default();
        let tally = format!("{} of {left} rows{lost}", left - file.left());
        let (stopped, path) = (stop.load(Ordering::Relaxed), self.output.as_ref());
        match broken {
            // A closed pipe is not an error: its reader has seen enough.
            Some(error) if path.is_none() && error.kind() == io::ErrorKind::BrokenPipe => {}
            Some(error) => {
                let path = path.map(|path| path.display().to_string());
                let to = path.unwrap_or_else(|| "standard output".to_owned());
                return Err(Failure::unanswered(to, format!("{error}; {tally}")));
            }
            None if stopped != 0 && file.left() > 0 => {
                let again = if path.is_some() { "; --resume continues" } else { "" };
                tell(format!("stopped: {tally}{again}"));
                return Err(Failure::Said(u8::try_from(stopped).unwrap_or(u8::MAX)));
            }
            None if given_up > 0 => tell(format!("note: {tally}; the last column says why")),
            None => {}
        }
        match self.archive() {
            Some(path) if file.left() == 0 => {
                pack(path, &provenance_file::of_process(), self.force)
            }
            _ => Ok(()),
        }
    }

    /// The scan and the points to compute, after checking the options.
    pub fn asked(&self) -> Result<ScanPart> {
        let (base, conditions) = self.conditions.of(&self.source, &self.measure)?;
        let mut measures = self.measure.clone();
        if self.certify && !measures.contains(&Measure::Proved) {
            measures.push(Measure::Proved);
        }
        let groups = self.source.numbers()?.set;
        let scan = if let Some(path) = &self.list {
            let scan = Scan::of_list(base, columns(path, groups)?, measures, conditions);
            scan.map_err(|why| Failure::file(path, why))?
        } else {
            let over = self.over.iter();
            let over = over.map(|text| read("--over", text, |text| Sweep::read(text, groups)));
            Scan::new(base, over.collect::<Result<_, _>>()?, measures, conditions)?
        };
        let points = self.part.points(scan.points())?;
        // By default only the first part has a heading, so that `cat` can join the parts.
        let always = self.header == HeaderWhen::Always || self.archive().is_some();
        let headed = points.start == 0 || always;
        let part = ScanPart { scan, form: self.form()?, points, headed, brackets: None };
        Ok(self.output.iter().fold(part, |part, file| part.in_file(file)))
    }

    /// Where the rows go, with those that are already there.
    fn opened(&self, part: ScanPart, interrupted: &(dyn Fn() -> bool + Sync)) -> Result<ScanFile> {
        let Some(path) = self.archive().map(rows_of).or_else(|| self.output.clone()) else {
            print(&part.heading())?;
            return Ok(ScanFile::standard(part));
        };
        let (path, name) = (path.as_path(), path.display());
        let taken = [Some(path), self.archive()].into_iter().flatten();
        let taken =
            taken.filter(|_| !self.resume && !self.force).find(|path| holds_something(path));
        if let Some(taken) = taken.map(Path::display) {
            let line = format!("{taken} is not empty; --resume continues it, --force starts over");
            return Err(line.into());
        }
        let provenance = provenance_file::of_process();
        if !self.resume {
            return ScanFile::create(path, part, provenance);
        }
        let earlier = provenance_file::read(path).ok().filter(|_| holds_something(path));
        let now = provenance.build();
        if let Some(earlier) = earlier.map(|it| it.build()).filter(|it| *it != now) {
            let begun = format!("{name} was begun by {earlier}, and this is {now}");
            return Err(format!("{begun}; --force starts over").into());
        }
        let limits = Limits { interrupted, ..Limits::PATIENT };
        let file = ScanFile::resume(path, part, provenance, "; --force starts over", &limits)?;
        if file.unchecked > 0 {
            let rows = file.unchecked;
            tell(format!(
                "note: {name}: no checksum says whether {rows} rows are as they were written"
            ));
        }
        Ok(file)
    }

    /// The file of arrays, if such are to be written.
    fn archive(&self) -> Option<&Path> {
        self.output.as_deref().filter(|path| packed::is_of_arrays(path))
    }

    fn form(&self) -> Result<Format> {
        let of_file = || self.output.as_deref().map_or(Format::Csv, Format::of_file);
        let form = self.format.unwrap_or_else(of_file);
        if let Some(path) = self.archive() {
            packed::packed_rows(path, "")?;
            if form != Format::Csv || self.plan.is_wanted() {
                return Err("arrays are made of the csv rows of one scan, without --plan".into());
            }
        }
        if form == Format::Table && self.resume {
            return Err("--format table rounds its numbers; --resume needs csv or json".into());
        }
        Ok(form)
    }
}

/// The exit code of the signal that asked the process to stop, 0 if none has; a second signal ends it at once.
fn stop_signal() -> Result<Arc<AtomicUsize>> {
    let (code, came) = (Arc::new(AtomicUsize::new(0)), Arc::new(AtomicBool::new(false)));
    let signals = [
        consts::SIGINT,
        consts::SIGTERM,
        #[cfg(unix)]
        consts::SIGHUP,
    ];
    for signal in signals {
        let ends = exit_code(signal);
        flag::register_conditional_shutdown(signal, ends.into(), Arc::clone(&came))
            .and_then(|_| flag::register(signal, Arc::clone(&came)))
            .and_then(|_| flag::register_usize(signal, Arc::clone(&code), ends.into()))
            .map_err(|why| Failure::unanswered("cannot listen for signals", why))?;
    }
    Ok(code)
}
