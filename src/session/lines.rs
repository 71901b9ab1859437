//! The rows of the tables of commands; and the command line, everything that can be run by name, typed after a colon.
//!
//! The one table of the commands that take words. It feeds the line itself, its completion, the palette and the
//! help. Every command of a key can also be typed by its name. A line is run completely or not at all, and a
//! refused line says what is allowed.

use crate::scene::machine::library::machines;
use crate::scene::{Layer, VIEWS, library};
use crate::session::act::{files, history, scan, values};
use crate::session::read::completion;
use crate::session::settings::{Colors, Glyphs, Theme, choices};
use crate::session::{Candidates, Command, Context, Done, Key, NextCommand, Purpose, Session};

/// How a command is run.
#[derive(Clone, Copy, Debug)]
pub(super) enum CommandAction {
    /// It changes the session; the key is the one that was pressed.
    Act(fn(&mut Session, Key)),
    /// It changes the session, unless it fails with one line that says why not.
    Try(fn(&mut Session) -> Done),
    /// It switches a layer.
    Toggle(Layer),
    /// It chooses another command to run.
    Choose(fn(&mut Session) -> Result<Option<NextCommand>, String>),
    /// It takes the words after its name, and fails with one line that says why it cannot.
    Line(fn(&mut Session, &str) -> Done),
}

#[derive(Debug)]
pub(super) struct CommandRow {
    pub(super) command: Command,
    pub(super) run: CommandAction,
}

/// A row for a command of keys.
pub(super) const fn row(
    name: &'static str,
    keys: &'static [(Context, &'static [&'static str])],
    hint: &'static str,
    doc: &'static str,
    run: CommandAction,
) -> CommandRow {
    CommandRow { command: Command { name, keys, hint, doc, arguments: "", words: None }, run }
}

/// A row for a command that takes words.
pub(super) const fn line(
    name: &'static str,
    arguments: &'static str,
    doc: &'static str,
    words: Candidates,
    run: fn(&mut Session, &str) -> Done,
) -> CommandRow {
    let command = Command { name, keys: &[], hint: "", doc, arguments, words: Some(words) };
    CommandRow { command, run: CommandAction::Line(run) }
}

/// Every command that takes words, in the order in which the help lists them.
#[rustfmt::skip]
pub(super) const LINES: &[CommandRow] = &[
    line("set", "NAME=VALUE ..", "Set values, as one change: set D=-0.3 D3=0.5 until=100",
        completion::assignments, values::set),
    line("method", "NAME", "Integrate by this method",
        completion::methods, |s, rest| values::set_row(s, "method", rest)),
    line("tol", "X", "Compute to this relative error per step",
        |_, _| vec![], |s, rest| values::set_row(s, "tolerance", rest)),
    line("until", "TAU", "Follow the motion until this time",
        |_, _| vec![], |s, rest| values::set_row(s, "until", rest)),
    line("scene", "NAME", "Open a scene",
        |_, _| completion::all(library::names()), values::scene),
    line("belt", "NAME", "Open a machine that comes with the program",
        |_, _| completion::all(machines().iter().map(|it| &it.name)), values::belt),
    line("machine", "FILE", "Open the machine of a file",
        |_, _| vec![], |s, rest| files::ask(s, rest, Purpose::Machine)),
    line("view", "NAME", "Show a view in the plot in use",
        |_, _| completion::all(VIEWS.map(|row| row.name)), values::view),
    line("layer", "NAME [on|off]", "Switch a layer",
        completion::layers, values::layer),
    line("window", "X0:X1,Y0:Y1", "Show this window in the plot in use",
        completion::window, values::window),
    line("axes", "PARAMETER [PROPERTY]", "Draw the diagram in use over a parameter: axes r period",
        completion::axes, values::axes),
    line("scan", "NAME=FROM:TO:COUNT .. MEASURE,..", "Scan over values: D=-0.9:0:100 r=log:0.01:1:20 from-rest",
        completion::scan, scan::scan),
    line("save-scan", "FILE", "Write the rows of the scan to a file, .csv or .json",
        |_, _| vec![], scan::save),
    line("harmonics", "N", "Show the cycles of N harmonics",
        |_, _| vec![], values::harmonics),
    line("kicks", "q=MEAN+-SPREAD,v=MEAN+-SPREAD", "Show random kicks over the basin, and the part lost",
        |_, _| vec![], values::kicks),
    line("mark", "LETTER", "Mark this point by a letter",
        |s, _| completion::all(s.marks.places.keys()), |s, rest| values::letter(rest).map(|name| history::set_mark(s, name))),
    line("goto", "LETTER", "Go to a mark",
        |s, _| completion::all(s.marks.places.keys()), |s, rest| history::go_to_mark(s, values::letter(rest)?)),
    line("write", "FILE", "Save the session; write! replaces a file that is there",
        |_, _| vec![], |s, rest| files::write(s, rest, false)),
    line("write!", "FILE", "Save the session and replace what is there",
        |_, _| vec![], |s, rest| files::write(s, rest, true)),
    line("open", "FILE", "Resume a saved session",
        |_, _| vec![], |s, rest| files::ask(s, rest, Purpose::Open)),
    line("fit", "FILE [mass=2 kg] [columns=1,3] ..", "Fit a recorded motion: times and displacements",
        |_, _| vec![], files::fit),
    line("figure", "FILE", "Write what is shown as .svg, .png, .csv or .json",
        |_, _| vec![], |s, rest| files::figure(s, rest, None, false)),
    line("figure!", "FILE", "The same, replacing what is there",
        |_, _| vec![], |s, rest| files::figure(s, rest, None, true)),
    line("figure-pane", "FILE", "Write the plot in use as .svg, .png, .csv or .json",
        |_, _| vec![], |s, rest| files::figure(s, rest, Some(s.plot), false)),
    line("figure-pane!", "FILE", "The same, replacing what is there",
        |_, _| vec![], |s, rest| files::figure(s, rest, Some(s.plot), true)),
    line("record", "FILE", "Write what was pressed since the start to a file",
        |_, _| vec![], |s, rest| files::record(s, rest, false)),
    line("record!", "FILE", "The same, replacing what is there",
        |_, _| vec![], |s, rest| files::record(s, rest, true)),
    line("play", "FILE", "Press the keys of a keystroke file",
        |_, _| vec![], |s, rest| files::ask(s, rest, Purpose::Play)),
    line("theme", "NAME", "Use these colours",
        |_, _| completion::all(choices::<Theme>().map(|row| row.0)), |s, name| values::choice(name).map(|it| s.display.theme = it)),
    line("units", "on|off", "Show axes of machines in mm, mm/s and s, or as q, v, tau",
        completion::switch, |s, state| values::is_on("units", state).map(|on| s.display.dimensionless = !on)),
    line("equal", "on|off", "Draw a circle in a phase plane as one, or use all the room",
        completion::switch, |s, state| values::is_on("equal units", state).map(|on| s.display.stretched = !on)),
    line("glyphs", "NAME", "Draw with these characters",
        |_, _| completion::all(choices::<Glyphs>().map(|row| row.0)), |s, name| values::choice(name).map(|it| s.display.glyphs = it)),
    line("color", "DEPTH", "Use this many colours",
        |_, _| completion::all(choices::<Colors>().map(|row| row.0)), |s, name| values::choice(name).map(|it| s.display.colors = it)),
];

/// Every command that takes words, in the order in which the help lists them.
pub fn lines() -> impl Iterator<Item = &'static Command> {
    LINES.iter().map(|row| &row.command)
}
