//! What a user says about a record beside its file: how it is read, and what is estimated from it. The command line and
//! the explorer take the same options.

use std::path::Path;

use clap::{Arg, Args, Command};

use super::OpenedRecord;
use crate::fit::{
    Choice, Inertia, LENGTHS, LossName, NAMES, NameSpec, Question, Record, RecordFormat, Signal,
    assigned, length_in_metres, listed, named, parse, quantity,
};
use crate::model::Knob;
use crate::words::usage;

/// The options of a record.
#[derive(Clone, Debug, Args)]
pub struct RecordOptions {
    /// Columns of times and displacements, by number from 1 or by name
    #[arg(long, value_name = "t=1,x=2", value_parser = columns)]
    columns: Option<(Option<String>, Option<String>)>,
    /// Rows are successive turning points, with or without times
    #[arg(long)]
    peaks: bool,
    /// Quantities to estimate: omega0, offset, D, D2, D3, r; damping and friction not listed are held (at 0 unless set)
    // The full path keeps the parser of options from taking each of them as a value of its own.
    #[arg(long, value_name = "NAMES", value_parser = listed)]
    free: Option<std::vec::Vec<&'static NameSpec>>,
    /// Holds a quantity at a value, such as D3=0; repeatable
    #[arg(long, value_name = "NAME=VALUE", value_parser = assigned)]
    set: Vec<(&'static NameSpec, f64)>,
    /// How residuals are weighted
    #[arg(long, value_enum, default_value_t = LossName::Auto)]
    loss: LossName,
    /// Mass of the oscillator, such as "2 kg": forces and damping in N, N s/m
    #[arg(long, value_parser = |text: &str| Knob::Mass.parse(text), conflicts_with = "stiffness")]
    mass: Option<f64>,
    /// Stiffness of the spring, such as "800 N/m", instead of the mass
    #[arg(long, value_parser = |text: &str| Knob::Stiffness.parse(text))]
    stiffness: Option<f64>,
    /// What the second column holds, if the file does not tell it by a unit
    #[arg(long)]
    signal: Option<Signal>,
    /// Unit of the displacements, velocities or accelerations, if the file does not name it, such as mm or m/s^2
    #[arg(long, value_parser = unit)]
    unit: Option<String>,
}

/// `t=1,x=3`, `x=2`, `t=time,x=position`, or without the letters `1,3`.
fn columns(text: &str) -> Result<(Option<String>, Option<String>), String> {
    let mut chosen = (None, None);
    for (index, part) in text.split(',').enumerate() {
        let key = ["t", "x"].get(index).copied().unwrap_or_default();
        let bare = text.contains(',') && !text.contains('=');
        let (key, value) = part.split_once('=').or(bare.then_some((key, part))).unwrap_or_default();
        let column = value.trim().to_owned();
        if column.parse() == Ok(0_usize) {
            return Err(format!("{part:?}: columns are counted from 1"));
        }
        match key.trim() {
            "t" => chosen.0 = Some(column),
            "x" => chosen.1 = Some(column),
            _ => {
                return Err(format!(
                    "{text:?} does not name columns; expected for example t=1,x=3, x=2, or t=time,x=position"
                ));
            }
        }
    }
    Ok(chosen)
}

fn unit(text: &str) -> Result<String, String> {
    let known = || {
        let lengths = LENGTHS.join(", ");
        format!(
            "{text:?} is not a unit; there are lengths such as {lengths}, each also with /s or /s^2, and g"
        )
    };
    quantity(text).map(|_| text.to_owned()).ok_or_else(known)
}

/// The options as a command without a name.
fn command() -> Command {
    RecordOptions::augment_args(Command::new("fit").no_binary_name(true))
}

/// The beginning of the option that begins with this word, as the parser takes it: of `mass=2`, `--mass=2` or `--mass`,
/// whose value follows; of `peaks`; of a number to be held, `D3=0`.
fn begun(word: &str) -> Option<String> {
    let bare = word.trim_start_matches('-');
    let (name, value) = match bare.split_once('=') {
        Some((name, value)) => (name, Some(value)),
        None => (bare, word.starts_with("--").then_some("")),
    };
    if named(name).is_some() {
        return value.map(|value| format!("--set={name}={value}"));
    }
    let command = command();
    let option = command.get_arguments().find(|it| it.get_long() == Some(name))?;
    if option.get_action().takes_values() {
        value.map(|value| format!("--{name}={value}"))
    } else {
        (bare == name).then(|| format!("--{name}"))
    }
}

/// That no option begins with this word, and what there is.
fn unknown(word: &str) -> String {
    let command = command();
    let options = command.get_arguments().filter_map(Arg::get_long);
    let known: Vec<&str> = options.chain(NAMES.iter().map(|row| row.name)).collect();
    format!("no option {word:?}; there are {}", known.join(", "))
}

/// The file and the options of a line such as `my file.csv mass=2 kg columns=1,3 peaks`.
pub fn apart(line: &str) -> (&str, &str) {
    let mut blanks = line.match_indices(' ').map(|(at, _)| at);
    let begins = |at: &usize| begun(line[at + 1..].split(' ').next().unwrap_or_default()).is_some();
    let (file, words) = line.split_at(blanks.find(begins).unwrap_or(line.len()));
    (file.trim(), words.trim())
}

impl RecordOptions {
    /// The options of a line such as `mass=2 kg columns=1,3 D3=0 peaks`. Fails with one line.
    pub fn of_words(line: &str) -> Result<Self, String> {
        let mut given: Vec<String> = Vec::new();
        for word in line.split_whitespace() {
            // What another option would look like, known or not; in "t=time of day,x=2" the value of one goes on.
            let begins = word.split_once('=').is_some_and(|(name, _)| !name.contains(','));
            match (begun(word), given.last_mut()) {
                // The value, or the next one of several, is still to come, whatever it looks like.
                (_, Some(last)) if last.ends_with(['=', ',']) => last.push_str(word),
                (Some(option), _) => given.push(option),
                // A unit or the rest of a name.
                (None, Some(last)) if last.contains('=') && !begins && !word.starts_with("--") => {
                    *last = format!("{last} {word}");
                }
                _ => return Err(unknown(word)),
            }
        }
        let read = command().try_get_matches_from(given);
        let read = read.and_then(|given| clap::FromArgMatches::from_arg_matches(&given));
        read.map_err(|error| usage::line(&error))
    }

    /// Reads the file.
    ///
    /// # Errors
    /// One line that says what is wrong with it or with the options, where, and what is allowed.
    pub fn opened(&self, path: &Path, bytes: &[u8]) -> Result<OpenedRecord, String> {
        let question = self.question()?;
        let (time, displacement) = self.columns.clone().unwrap_or_default();
        let (peaks, signal, unit) = (self.peaks, self.signal, self.unit.clone());
        let reading = RecordFormat { time, displacement, peaks, signal, unit };
        let record = parse(bytes, &reading).map_err(|error| error.to_string())?;
        let inertia = self.inertia(&record)?;
        let name = path.file_name().unwrap_or(path.as_os_str()).to_string_lossy().into_owned();
        Ok(OpenedRecord { name, record, inertia, question })
    }

    /// What is estimated, and how.
    ///
    /// # Errors
    /// One line that names a number which is both held and estimated.
    pub fn question(&self) -> Result<Question, String> {
        let (free, held) = (self.free.clone(), self.set.clone());
        let is_free = |row: &NameSpec| free.iter().flatten().any(|it| *it == row);
        if let Some((row, _)) = held.iter().find(|(row, _)| is_free(row)) {
            return Err(format!("{} is both --free and --set; it can be one of them", row.name));
        }
        let choice = Choice { free, held };
        Ok(Question { choice, loss: self.loss, peaks: self.peaks })
    }

    /// The mass or stiffness, if given. Fails with one line if the record's unit of length is not known.
    fn inertia(&self, record: &Record) -> Result<Option<Inertia>, String> {
        let mass = self.mass.map(Inertia::Mass);
        let Some(inertia) = mass.or(self.stiffness.map(Inertia::Stiffness)) else {
            return Ok(None);
        };
        if record.t.is_empty() {
            let why = "without times there is no frequency: leave out --mass and --stiffness";
            return Err(why.to_owned());
        }
        let wrong = match record.unit.as_deref() {
            None => "the file names no unit of length".to_owned(),
            Some(unit) if length_in_metres(unit).is_some() => return Ok(Some(inertia)),
            Some(unit) => format!("{unit:?} is not a known unit of length"),
        };
        let known = LENGTHS.map(|it| record.signal.unit(it)).join(", ");
        Err(format!("{wrong}; --unit says it, such as {known}"))
    }
}
