//! The command line: everything that can be run by name, typed after a colon.
//!
//! The one table of the commands that take words. It feeds the line itself, its completion, the palette and the
//! help. Every command of a key can also be typed by its name. A line is run completely or not at all, and a
//! refused line says what is allowed.

use crate::session::act::{files, measurement, scan, values};
use crate::session::effect::Done;
use crate::session::message::Purpose;
use crate::session::state::settings::{COLORS, GLYPHS, THEMES};
use crate::session::state::{LineCommand, Session, WordKind};

/// Runs a line on a session, given the words after its name; fails with one line that says why it cannot.
pub(super) type RunLine = fn(&mut Session, &str) -> Done;

/// A command that takes words, and its function.
#[derive(Debug)]
struct LineRow {
    line: LineCommand,
    run: RunLine,
}

/// A row of the table.
const fn row(
    name: &'static str,
    arguments: &'static str,
    doc: &'static str,
    words: WordKind,
    run: RunLine,
) -> LineRow {
    LineRow { line: LineCommand { name, arguments, doc, words }, run }
}

/// Every command that takes words, in the order in which the help lists them.
#[rustfmt::skip]
const LINES: &[LineRow] = &[
    row("set", "NAME=VALUE ..", "Set values, as one change: set D=-0.3 D3=0.5 until=100",
        WordKind::Assignments, values::set),
    row("method", "NAME", "Integrate by this method",
        WordKind::Methods, |s, rest| values::set_row(s, "method", rest)),
    row("tol", "X", "Compute to this relative error per step",
        WordKind::Unknown, |s, rest| values::set_row(s, "tolerance", rest)),
    row("until", "TAU", "Follow the motion until this time",
        WordKind::Unknown, |s, rest| values::set_row(s, "until", rest)),
    row("scene", "NAME", "Open a scene",
        WordKind::Scenes, values::scene),
    row("belt", "NAME", "Open a machine that comes with the program",
        WordKind::Machines, values::belt),
    row("machine", "FILE", "Open the machine of a file",
        WordKind::Unknown, |s, rest| files::ask(s, rest, Purpose::Machine)),
    row("view", "NAME", "Show a view in the plot in use",
        WordKind::Views, values::view),
    row("layer", "NAME [on|off]", "Switch a layer",
        WordKind::Layers, values::layer),
    row("window", "X0:X1,Y0:Y1", "Show this window in the plot in use",
        WordKind::Window, values::window),
    row("axes", "PARAMETER [PROPERTY]", "Draw the diagram in use over a parameter: axes r period",
        WordKind::Axes, values::axes),
    row("scan", "NAME=FROM:TO:COUNT .. MEASURE,..", "Scan over values: D=-0.9:0:100 r=log:0.01:1:20 from-rest",
        WordKind::Scan, scan::scan),
    row("save-scan", "FILE", "Write the rows of the scan to a file, .csv or .json",
        WordKind::Unknown, scan::save),
    row("harmonics", "N", "Show the cycles of N harmonics",
        WordKind::Unknown, values::harmonics),
    row("kicks", "q=MEAN+-SPREAD,v=MEAN+-SPREAD", "Show random kicks over the basin, and the part lost",
        WordKind::Unknown, values::kicks),
    row("mark", "LETTER", "Mark this point by a letter",
        WordKind::Marks, values::mark),
    row("goto", "LETTER", "Go to a mark",
        WordKind::Marks, values::go_to),
    row("write", "FILE", "Save the session; write! replaces a file that is there",
        WordKind::Unknown, |s, rest| files::write(s, rest, false)),
    row("write!", "FILE", "Save the session and replace what is there",
        WordKind::Unknown, |s, rest| files::write(s, rest, true)),
    row("open", "FILE", "Resume a saved session",
        WordKind::Unknown, |s, rest| files::ask(s, rest, Purpose::Open)),
    row("fit", "FILE [mass=2 kg] [columns=1,3] ..", "Fit a recorded motion: times and displacements",
        WordKind::Unknown, measurement::ask),
    row("figure", "FILE", "Write what is shown as .svg, .png, .csv or .json",
        WordKind::Unknown, |s, rest| files::figure(s, rest, None, false)),
    row("figure!", "FILE", "The same, replacing what is there",
        WordKind::Unknown, |s, rest| files::figure(s, rest, None, true)),
    row("figure-pane", "FILE", "Write the plot in use as .svg, .png, .csv or .json",
        WordKind::Unknown, |s, rest| files::figure(s, rest, Some(s.plot), false)),
    row("figure-pane!", "FILE", "The same, replacing what is there",
        WordKind::Unknown, |s, rest| files::figure(s, rest, Some(s.plot), true)),
    row("record", "FILE", "Write what was pressed since the start to a file",
        WordKind::Unknown, |s, rest| files::record(s, rest, false)),
    row("record!", "FILE", "The same, replacing what is there",
        WordKind::Unknown, |s, rest| files::record(s, rest, true)),
    row("play", "FILE", "Press the keys of a keystroke file",
        WordKind::Unknown, |s, rest| files::ask(s, rest, Purpose::Play)),
    row("theme", "NAME", "Use these colours",
        WordKind::Themes, |s, name| values::choice(&THEMES, name).map(|it| s.display.theme = it)),
    row("units", "on|off", "Show axes of machines in mm, mm/s and s, or as q, v, tau",
        WordKind::Switch, |s, state| values::is_on("units", state).map(|on| s.display.dimensionless = !on)),
    row("equal", "on|off", "Draw a circle in a phase plane as one, or use all the room",
        WordKind::Switch, |s, state| values::is_on("equal units", state).map(|on| s.display.stretched = !on)),
    row("glyphs", "NAME", "Draw with these characters",
        WordKind::Glyphs, |s, name| values::choice(&GLYPHS, name).map(|it| s.display.glyphs = it)),
    row("color", "DEPTH", "Use this many colours",
        WordKind::Colors, |s, name| values::choice(&COLORS, name).map(|it| s.display.colors = it)),
];

/// Every command that takes words, in the order in which the help lists them.
pub fn lines() -> impl Iterator<Item = &'static LineCommand> {
    LINES.iter().map(|row| &row.line)
}

/// The function of the command with this name, if it is one that takes words.
pub(super) fn run(name: &str) -> Option<RunLine> {
    LINES.iter().find(|row| row.line.name == name).map(|row| row.run)
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;
    use crate::session::commands::commands;

    #[test]
    fn every_line_has_a_name_of_its_own_and_one_line_of_explanation() {
        let names: BTreeSet<_> = lines().map(|line| line.name).collect();
        assert_eq!(names.len(), LINES.len());
        for LineCommand { name, arguments, doc, .. } in lines() {
            assert!(!arguments.is_empty(), "{name} takes nothing: it is a row of COMMANDS");
            assert!(doc.len() > 4 && doc.len() <= 60, "{name}: {doc}");
            assert!(doc.starts_with(char::is_uppercase) && !doc.ends_with('.'), "{name}: {doc}");
        }
    }

    #[test]
    fn a_name_may_mean_a_key_too_only_where_the_key_takes_the_next_of_the_same() {
        let is_key = |name: &&str| commands().any(|command| command.name == *name);
        let both: Vec<_> = lines().map(|line| line.name).filter(is_key).collect();
        assert_eq!(both, ["theme", "units", "equal", "glyphs"]);
    }
}
