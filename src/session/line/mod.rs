//! The command line: everything that has a name, typed after a colon.
//!
//! [`LINES`] is the one table of the commands that take words; it feeds the line itself, its completion,
//! the palette and the help. Every command of [`COMMANDS`] can be typed by its name too. A line is run as
//! a whole or not at all, and a line that is refused says what is allowed.

mod scan;
mod values;

pub(super) use values::letter;

use super::command::{COMMANDS, Command, command};
use super::key::{Code, Key};
use super::message::{Effect, Purpose};
use super::overlay::Completion;
use super::state::Session;
use super::update::{files, palette};
use crate::scene::misread::printable;

/// What a line does to a session, given the words behind its name; or one line that says why not.
pub type RunLine = fn(&mut Session, &str) -> Result<Vec<Effect>, String>;

/// What the last of these words can become; all words behind the name are given.
pub type Complete = fn(&Session, &[&str]) -> Vec<String>;

/// A command that takes words.
#[derive(Clone, Copy, Debug)]
pub struct LineCommand {
    /// Its name.
    pub name: &'static str,
    /// What follows the name, for the help.
    pub arguments: &'static str,
    /// What it does, in one line for the help.
    pub doc: &'static str,
    /// Completes its words.
    pub complete: Complete,
    /// Does it.
    pub run: RunLine,
}

/// A row of the table.
const fn row(
    name: &'static str,
    arguments: &'static str,
    doc: &'static str,
    complete: Complete,
    run: RunLine,
) -> LineCommand {
    LineCommand { name, arguments, doc, complete, run }
}

/// Every command that takes words, in the order in which the help lists them.
#[rustfmt::skip]
pub const LINES: &[LineCommand] = &[
    row("set", "NAME=VALUE ..", "Give values, as one change: set D=-0.3 D3=0.5 until=100",
        values::assignments, values::set),
    row("method", "NAME", "Integrate by this method",
        |_, _| values::methods(), |s, rest| values::set_row(s, "method", rest)),
    row("tol", "X", "Compute to this relative error of a step",
        |_, _| Vec::new(), |s, rest| values::set_row(s, "tolerance", rest)),
    row("until", "TAU", "Follow the motion until this time",
        |_, _| Vec::new(), |s, rest| values::set_row(s, "until", rest)),
    row("scene", "NAME", "Open a scene",
        |_, _| values::scenes(), values::scene),
    row("view", "NAME", "Show a view in the plot in use",
        |_, _| values::views(), values::view),
    row("layer", "NAME [on|off]", "Switch a layer",
        values::layer_words, values::layer),
    row("window", "X0:X1,Y0:Y1", "Show this part of the world in the plot in use",
        values::windows, values::window),
    row("axes", "PARAMETER [PROPERTY]", "Draw the diagram in use over a parameter: axes r period",
        values::axis_words, values::axes),
    row("scan", "NAME=FROM:TO:COUNT .. MEASURE,..", "Scan: scan D=-0.9:0:100 r=log:0.01:1:20 margin",
        scan::words, scan::scan),
    row("save-scan", "FILE", "Write the rows of the scan to a file, .csv or .json",
        |_, _| Vec::new(), scan::save),
    row("harmonics", "N", "Show the cycles of N harmonics",
        |_, _| Vec::new(), values::harmonics),
    row("mark", "LETTER", "Mark this point by a letter",
        |s, _| values::letters(s.marks.places.keys()), values::mark),
    row("goto", "LETTER", "Go to a mark",
        |s, _| values::letters(s.marks.places.keys()), values::go_to),
    row("macro", "LETTER [TIMES]", "Play the keys of a register",
        |s, _| values::letters(s.macros.registers.keys()), values::play),
    row("write", "FILE", "Save the session; write! replaces a file that is there",
        |_, _| Vec::new(), |s, rest| files::write(s, rest, false)),
    row("write!", "FILE", "Save the session, in place of what is there",
        |_, _| Vec::new(), |s, rest| files::write(s, rest, true)),
    row("open", "FILE", "Go on with a saved session",
        |_, _| Vec::new(), |_, rest| Ok(files::ask(rest, Purpose::Open))),
    row("figure", "FILE", "Write what is shown as .svg, .png, .csv or .json",
        |_, _| Vec::new(), |s, rest| files::figure(s, rest, None, false)),
    row("figure!", "FILE", "The same, in place of what is there",
        |_, _| Vec::new(), |s, rest| files::figure(s, rest, None, true)),
    row("figure-pane", "FILE", "Write the plot in use as .svg, .png, .csv or .json",
        |_, _| Vec::new(), |s, rest| files::figure(s, rest, Some(s.plot), false)),
    row("figure-pane!", "FILE", "The same, in place of what is there",
        |_, _| Vec::new(), |s, rest| files::figure(s, rest, Some(s.plot), true)),
    row("record", "FILE", "Write what was pressed since the start to a file",
        |_, _| Vec::new(), |s, rest| Ok(files::record(s, rest, false))),
    row("record!", "FILE", "The same, in place of what is there",
        |_, _| Vec::new(), |s, rest| Ok(files::record(s, rest, true))),
    row("play", "FILE", "Press the keys of a keystroke file",
        |_, _| Vec::new(), |_, rest| Ok(files::ask(rest, Purpose::Play))),
    row("write-macro", "LETTER FILE", "Write a register to a keystroke file",
        |s, _| values::letters(s.macros.registers.keys()), files::write_macro),
    row("read-macro", "LETTER FILE", "Read a register from a keystroke file",
        |s, _| values::letters(s.macros.registers.keys()), files::read_macro),
    row("theme", "NAME", "Use these colours",
        |_, _| values::themes(), values::theme),
    row("glyphs", "NAME", "Draw with these characters",
        |_, _| values::glyph_names(), values::glyphs),
    row("color", "DEPTH", "Use this many colours",
        |_, _| values::colors(), values::color),
];

/// The command that takes words with this name.
#[must_use]
pub fn line(name: &str) -> Option<&'static LineCommand> {
    LINES.iter().find(|line| line.name == name)
}

/// The key that commands run from a line are told: the one that ran it.
pub(super) fn enter() -> Key {
    Key::plain(Code::Enter)
}

/// Runs a line; nothing is open any more.
///
/// # Errors
/// One line that says what is wrong and what is allowed; the session is as it was.
pub fn run(session: &mut Session, text: &str) -> Result<Vec<Effect>, String> {
    let (name, rest) = text.split_once(char::is_whitespace).unwrap_or((text, ""));
    let rest = rest.trim();
    match (line(name), command(name)) {
        (_, Some(command)) if rest.is_empty() => Ok(palette::run(session, command, enter())),
        (Some(line), _) if rest.is_empty() => {
            Err(format!("{name} needs {}: {}", line.arguments, line.doc))
        }
        (Some(line), _) => {
            (line.run)(session, rest).map_err(|why| printable(&format!("{name}: {why}")).into())
        }
        (None, Some(_)) => Err(format!("{name} takes no words, but there are {rest:?}")),
        (None, None) => Err(match nearest(name, names()) {
            Some(nearest) => format!("no command {name:?}; did you mean {nearest}?"),
            None => format!("no command {name:?}; Tab lists them"),
        }),
    }
}

/// Every name that a line can begin with, in the order of the tables.
fn names() -> impl Iterator<Item = &'static str> {
    let typed = |command: &&Command| command.keys.iter().any(|(context, _)| !context.is_overlay());
    let commands = COMMANDS.iter().filter(typed).map(|command| command.name);
    let commands = commands.filter(|name| line(name).is_none());
    LINES.iter().map(|line| line.name).chain(commands)
}

/// The name that looks most like this one.
fn nearest<'a>(wanted: &str, names: impl Iterator<Item = &'a str>) -> Option<&'a str> {
    /// How much two names must have in common (0: nothing, 1: equal).
    const ALIKE: f64 = 0.7;
    let rated = names.map(|name| (strsim::jaro(wanted, name), name));
    let best = rated.max_by(|a, b| a.0.total_cmp(&b.0))?;
    (best.0 >= ALIKE).then_some(best.1)
}

/// What the last word of a text can become.
#[must_use]
pub fn completion(session: &Session, text: &str) -> Option<Completion> {
    let start = text.trim_end_matches(|char: char| !char.is_whitespace()).len();
    let (stem, word) = text.split_at(start);
    let words = match stem.split_whitespace().next() {
        None => names().map(str::to_owned).collect(),
        Some(name) => {
            let given: Vec<&str> = stem.split_whitespace().skip(1).chain([word]).collect();
            (line(name)?.complete)(session, &given)
        }
    };
    let fits = |candidate: &String| candidate.starts_with(word) && candidate != word;
    let words: Vec<String> = words.into_iter().filter(fits).collect();
    (!words.is_empty()).then(|| Completion { stem: stem.to_owned(), words, at: 0 })
}

/// What is known about the line being typed: the command that it begins with.
#[must_use]
pub fn described(text: &str) -> Option<(&'static str, &'static str)> {
    let name = text.split_whitespace().next()?;
    let of_line = line(name).map(|line| (line.arguments, line.doc));
    of_line.or(command(name).map(|command| ("", command.doc)))
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;

    #[test]
    fn every_line_has_a_name_of_its_own_and_one_line_of_explanation() {
        let names: BTreeSet<_> = LINES.iter().map(|line| line.name).collect();
        assert_eq!(names.len(), LINES.len());
        for LineCommand { name, arguments, doc, .. } in LINES {
            assert!(!arguments.is_empty(), "{name} takes nothing: it is a row of COMMANDS");
            assert!(doc.len() > 4 && doc.len() <= 60, "{name}: {doc}");
            assert!(doc.starts_with(char::is_uppercase) && !doc.ends_with('.'), "{name}: {doc}");
        }
    }

    #[test]
    fn a_name_may_mean_a_key_too_only_where_the_key_takes_the_next_of_the_same() {
        let both: Vec<_> =
            LINES.iter().map(|line| line.name).filter(|name| command(name).is_some()).collect();
        assert_eq!(both, ["theme", "glyphs"]);
    }
}
