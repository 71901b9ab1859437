//! The options for computing and printing an answer, how long that takes, and the printing.

use std::hint::black_box;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Instant;

use clap::Args;

use super::{Call, Failure, Result};
use crate::flow::{Limits, Reason};
use crate::numerics::{real, truncated};
use crate::report::{Answer, Format};
use crate::runtime::{Readers, new_file, packed, provenance_file, standard};
use crate::words::printable;

/// How an answer is printed.
#[derive(Args)]
pub struct Output {
    /// Output format (default: the ending of FILE, or table)
    #[arg(long, value_enum)]
    format: Option<Format>,

    /// Computes N times and reports the median time
    #[arg(long, value_name = "N", default_value_t = 1, hide_default_value = true,
          value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    pub repeat: u32,

    /// Writes the answer to FILE, and its provenance (program, version, command line) to FILE.provenance; the ending .npz
    /// or .parquet makes arrays of its comma-separated values
    #[arg(long, value_name = "FILE")]
    write: Option<PathBuf>,

    /// The caller that is answered in place of all that, if one asks in this process.
    #[arg(skip)]
    pub call: Option<Arc<Call>>,
}

impl Output {
    /// The format that is asked for.
    pub fn format(&self) -> Format {
        let of_file = self.write.as_deref().and_then(Format::of_ending);
        self.format.or(of_file).unwrap_or(Format::Table)
    }

    /// Computes as often as asked for; returns the answer and the median time in seconds. `failed` begins the
    /// message of a failure.
    pub fn timed<T>(
        &self,
        failed: &str,
        compute: impl FnMut() -> Result<T, Reason>,
    ) -> Result<(T, f64)> {
        let (found, seconds) = timed(self.repeat, compute);
        Ok((found.map_err(|why| Failure::unanswered(failed, why))?, seconds))
    }

    /// What a question may cost, and what interrupts it.
    pub fn limits(&self) -> Limits<'_> {
        self.call.as_ref().map_or(Limits::PATIENT, |call| call.limits())
    }

    /// The width of the terminal in which the answer is shown, if it is shown in one.
    pub fn width(&self) -> Option<usize> {
        terminal_width().filter(|_| self.write.is_none())
    }

    /// The file, if it is one of arrays.
    pub fn archive(&self) -> Option<&Path> {
        self.write.as_deref().filter(|path| packed::is_of_arrays(path))
    }

    /// Refuses a file of arrays that are not made of comma-separated values, or that this build does not write.
    pub fn check(&self) -> Result<()> {
        let Some(path) = self.archive() else { return Ok(()) };
        if self.format() != Format::Csv {
            return Err(Failure::file(path, "arrays are made of csv: leave out --format"));
        }
        packed::packed_rows(path, "").map(drop).map_err(|why| Failure::file(path, why))
    }

    /// Prints an answer or writes it to a file. The provenance is part of a JSON document, and beside any other
    /// file.
    pub fn print(&self, answer: Answer) -> Result<()> {
        if let Some(call) = &self.call {
            call.replace(Some(answer));
            return Ok(());
        }
        self.check()?;
        let content = sourced(answer, self.format());
        let Some(path) = &self.write else { return print(&content) };
        let content = printable::lines(&content);
        match self.format() {
            Format::Json => new_file::write(path, content.as_bytes(), Readers::Usual, KEEP),
            _ => keep(path, &packed::packed_rows(path, &content)?),
        }
    }
}

/// What becomes of a file that holds something else.
const KEEP: Option<&str> = Some("--write replaces nothing");

/// Writes a new file, with its provenance beside it.
pub fn keep(path: &Path, content: &[u8]) -> Result<()> {
    new_file::write(path, content, Readers::Usual, KEEP)?;
    provenance_file::write(path, &provenance_file::of_process())
}

/// The answer, with its provenance if it is a JSON document.
pub fn sourced(answer: Answer, format: Format) -> String {
    answer.from(&provenance_file::of_process()).told(format)
}

/// Number of columns of the terminal to which the output goes; `None` if it goes elsewhere.
pub fn terminal_width() -> Option<usize> {
    crate::terminal::system::size().map(|size| size.width.into())
}

/// What the option `--certify` does.
pub const CERTIFY: &str = "Encloses the answer between proved bounds, or says what remains open";

/// Refuses that option where a machine is asked about.
pub fn provable(certify: bool, is_machine: bool) -> Result<()> {
    const WHY: &str = "--certify: proofs are of the oscillator of the paper, not of machines";
    if certify && is_machine {
        Err(WHY.into())
    } else {
        Ok(())
    }
}

/// Prints an answer in printable characters. A closed pipe is not an error: its reader has seen enough.
pub fn print(text: &str) -> Result<()> {
    match standard::print(text) {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => {
            Err(Failure::unanswered("cannot write to standard output", error))
        }
        _ => Ok(()),
    }
}

/// Writes a whole file. Fails without `force` if the file has other content.
pub fn write(path: &Path, content: &[u8], force: bool) -> Result<()> {
    new_file::write(path, content, Readers::Usual, (!force).then_some("add --force to overwrite"))
}

/// Of the options that are taken out of command lines, those without a value.
const FLAGS: [&str; 2] = ["--resume", "--force"];

/// A command line without these options and their values.
pub fn without(words: &[String], options: &[&str]) -> Vec<String> {
    let mut kept = Vec::new();
    let mut words = words.iter();
    while let Some(word) = words.next() {
        let name = word.split('=').next().unwrap_or_default();
        if !options.contains(&name) {
            kept.push(word.clone());
        } else if word == name && !FLAGS.contains(&name) {
            words.next();
        }
    }
    kept
}

/// Whether there is a regular file that is not empty; a device or a pipe can be written to without loss.
pub fn holds_something(path: &Path) -> bool {
    std::fs::metadata(path).is_ok_and(|file| file.is_file() && file.len() > 0)
}

/// Computes `times` times (at least once); returns the last answer and the median time in seconds.
pub fn timed<T>(times: u32, mut compute: impl FnMut() -> T) -> (T, f64) {
    let mut seconds = Vec::new();
    let mut once = || {
        let started = Instant::now();
        let answer = black_box(compute());
        seconds.push(started.elapsed().as_secs_f64());
        answer
    };
    let mut answer = once();
    for _ in 1..times {
        answer = once();
    }
    (answer, median(&mut seconds))
}

/// If no number of repetitions is asked for, a computation is measured this often, so that one disturbed measurement
/// does not affect the median, unless that takes more than [`LONG`].
const ROUNDS: usize = 5;

/// Time in seconds after which a computation is not measured again unasked.
const LONG: f64 = 0.5;

/// A computation that takes less than this many seconds is measured over as many runs as take this long, after one that
/// warms the caches: a single run of a short computation is unreliable.
const SHORT: f64 = 1e-3;

/// The median times in seconds of `count` computations. Each is measured `times` times, or if that is 1, as
/// [`ROUNDS`] says.
///
/// The computations take turns, so that other load on the machine disturbs all of them alike.
pub fn in_turn<T>(times: u32, count: usize, mut compute: impl FnMut(usize) -> T) -> Vec<f64> {
    let mut seconds = vec![Vec::new(); count];
    let rounds = if times > 1 { times as usize } else { ROUNDS };
    for _ in 0..rounds {
        for (index, seconds) in seconds.iter_mut().enumerate() {
            if times > 1 || seconds.iter().sum::<f64>() < LONG {
                seconds.push(settled(|| compute(index)));
            }
        }
    }
    seconds.iter_mut().map(|seconds| median(seconds)).collect()
}

/// The time of a computation in seconds; that of a short one is the mean of several runs.
fn settled<T>(mut compute: impl FnMut() -> T) -> f64 {
    let (_, cold) = timed(1, &mut compute);
    if cold >= SHORT {
        return cold;
    }
    let times = truncated((SHORT / cold.max(1e-9)).ceil().min(1000.0));
    let started = Instant::now();
    for _ in 0..times {
        black_box(compute());
    }
    started.elapsed().as_secs_f64() / real(times)
}

/// The median; of an even number of values, the mean of the middle two.
fn median(values: &mut [f64]) -> f64 {
    values.sort_by(f64::total_cmp);
    let middle = values.len() / 2;
    if values.len() % 2 == 1 {
        values[middle]
    } else {
        0.5 * (values[middle - 1] + values[middle])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn options_that_are_taken_out_have_a_value_where_the_command_line_says_so() {
        let scan = crate::cli::scan::ScanCommand::augment_args(clap::Command::new("scan"));
        for name in crate::cli::merge::OWN.iter().chain(&crate::cli::plan::OWN) {
            let option = scan.get_arguments().find(|it| it.get_long() == Some(&name[2..]));
            let has_value = option.unwrap().get_action().takes_values();
            assert_eq!(has_value, !FLAGS.contains(name), "{name}");
        }
    }

    #[test]
    fn options_are_taken_out_with_their_values() {
        let words: Vec<String> =
            "scan --over D=0:1:2 --output a --resume --shard=1/2 --measure margin"
                .split(' ')
                .map(str::to_owned)
                .collect();
        let kept = without(&words, &["--output", "--resume", "--shard"]);
        assert_eq!(kept.join(" "), "scan --over D=0:1:2 --measure margin");
    }

    #[test]
    fn the_median_ignores_outliers() {
        assert_eq!(median(&mut [1e9, 2.0, 1.0]), 2.0);
        assert_eq!(median(&mut [4.0, 1.0, 2.0, 1e9]), 3.0);
    }

    #[test]
    fn every_repetition_computes() {
        let mut count = 0;
        let (last, _) = timed(5, || {
            count += 1;
            count
        });
        assert_eq!((last, count), (5, 5));
    }
}
