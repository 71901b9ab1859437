//! Opening a recorded motion: its file, and details that the file does not contain.

use std::path::Path;

use crate::fit::{
    Choice, Column, Inertia, LENGTHS, LOSSES, LossName, NAMES, Reading, Signal, assigned,
    length_in_metres, listed, named, parse,
};
use crate::model::Knob;
use crate::question::Opened;
use crate::session::effect::{Done, Effect};
use crate::session::message::Purpose;
use crate::session::state::Session;

/// Words that may follow the name of the file.
const WORDS: [&str; 8] =
    ["mass", "stiffness", "unit", "signal", "columns", "peaks", "loss", "free"];

/// Details that the file does not contain.
#[derive(Debug, Default)]
struct Said {
    inertia: Option<Inertia>,
    reading: Reading,
    choice: Choice,
    loss: LossName,
}

/// Asks for the file that a line names: `FILE mass=2 kg columns=1,3 peaks`.
pub fn ask(session: &mut Session, rest: &str) -> Done {
    let begins = |word: &str| {
        let name = word.split_once('=').map_or(word, |(name, _)| name);
        let known = WORDS.contains(&name) || named(name).is_some();
        known && (word.contains('=') || name == "peaks")
    };
    let mut blanks = rest.match_indices(' ').map(|(at, _)| at);
    let end = blanks.find(|at| begins(rest[at + 1..].split(' ').next().unwrap_or_default()));
    let (file, words) = rest.split_at(end.unwrap_or(rest.len()));
    said(words)?;
    let (path, purpose) = (file.trim().into(), Purpose::Fit(words.trim().to_owned()));
    session.effects.push(Effect::Read { path, purpose });
    Ok(())
}

fn said(words: &str) -> Result<Said, String> {
    let mut given: Vec<(&str, String)> = Vec::new();
    for word in words.split_whitespace() {
        match (word.split_once('='), given.last_mut()) {
            (Some((name, value)), _) => given.push((name, value.to_owned())),
            (None, _) if word == "peaks" => given.push((word, String::new())),
            (None, Some((_, value))) => *value = format!("{value} {word}"),
            (None, None) => return Err(unknown(word)),
        }
    }
    let mut said = Said::default();
    for (name, value) in given {
        match name {
            "mass" => said.inertia = Some(Inertia::Mass(Knob::Mass.parse(&value)?)),
            "stiffness" => {
                said.inertia = Some(Inertia::Stiffness(Knob::Stiffness.parse(&value)?));
            }
            "unit" => said.reading.unit = Some(value),
            "signal" => said.reading.signal = Some(signal(&value)?),
            "columns" => (said.reading.time, said.reading.displacement) = columns(&value)?,
            "peaks" => said.reading.peaks = true,
            "loss" => said.loss = loss(&value)?,
            "free" => said.choice.free = Some(listed(&value)?),
            _ if named(name).is_some() => {
                said.choice.held.push(assigned(&format!("{name}={value}"))?);
            }
            _ => return Err(unknown(name)),
        }
    }
    Ok(said)
}

fn unknown(word: &str) -> String {
    let numbers = NAMES.map(|row| row.name).join(", ");
    format!(
        "after the file name stands {}, or a value of {numbers}, not {word:?}",
        WORDS.join(", ")
    )
}

fn loss(text: &str) -> Result<LossName, String> {
    let found = LOSSES.iter().find(|(name, _)| *name == text).map(|(_, loss)| *loss);
    let names = LOSSES.map(|(name, _)| name).join(", ");
    found.ok_or_else(|| format!("loss={text}; allowed are {names}"))
}

fn signal(text: &str) -> Result<Signal, String> {
    Signal::named(text).ok_or_else(|| format!("signal={text}; allowed are {}", Signal::names()))
}

/// The columns of times and displacements, by number from 1 or by name.
fn columns(text: &str) -> Result<(Option<Column>, Option<Column>), String> {
    let (time, displacement) =
        text.split_once(',').ok_or_else(|| format!("{text:?} is not columns=1,3"))?;
    let column = |name: &str| match name.trim().parse() {
        Ok(0) => Err("columns are counted from 1".to_owned()),
        Ok(number) => Ok(Some(Column::Number(number))),
        Err(_) => Ok(Some(Column::Name(name.trim().to_owned()))),
    };
    Ok((column(time)?, column(displacement)?))
}

/// Reads the record. Fails with one line that says what is wrong, where, and what is allowed.
pub(in crate::session) fn opened(path: &Path, words: &str, text: &str) -> Result<Opened, String> {
    let Said { inertia, reading, choice, loss } = said(words)?;
    let record = parse(text.as_bytes(), &reading).map_err(|error| error.to_string())?;
    let known = record.unit.as_deref().is_some_and(|unit| length_in_metres(unit).is_some());
    if inertia.is_some() && !known {
        let lengths = LENGTHS.map(|it| it.0).join(", ");
        return Err(format!("the file names no known unit of length; unit= one of {lengths}"));
    }
    let name = path.file_name().unwrap_or(path.as_os_str()).to_string_lossy().into_owned();
    Ok(Opened { name, record, inertia, peaks: reading.peaks, choice, loss })
}
