//! The command line: everything that can be run by name, typed after a colon.
//!
//! The one table of the commands that take words. It feeds the line itself, its completion, the palette and the
//! help. Every command of a key can also be typed by its name. A line is run completely or not at all, and a
//! refused line says what is allowed.

use crate::session::act::{files, history, scan, values};
use crate::session::command_row::{CommandRow, line};
use crate::session::settings::{COLORS, GLYPHS, THEMES};
use crate::session::{Command, Purpose, WordKind};

/// Every command that takes words, in the order in which the help lists them.
#[rustfmt::skip]
pub(super) const LINES: &[CommandRow] = &[
    line("set", "NAME=VALUE ..", "Set values, as one change: set D=-0.3 D3=0.5 until=100",
        WordKind::Assignments, values::set),
    line("method", "NAME", "Integrate by this method",
        WordKind::Methods, |s, rest| values::set_row(s, "method", rest)),
    line("tol", "X", "Compute to this relative error per step",
        WordKind::Unknown, |s, rest| values::set_row(s, "tolerance", rest)),
    line("until", "TAU", "Follow the motion until this time",
        WordKind::Unknown, |s, rest| values::set_row(s, "until", rest)),
    line("scene", "NAME", "Open a scene",
        WordKind::Scenes, values::scene),
    line("belt", "NAME", "Open a machine that comes with the program",
        WordKind::Machines, values::belt),
    line("machine", "FILE", "Open the machine of a file",
        WordKind::Unknown, |s, rest| files::ask(s, rest, Purpose::Machine)),
    line("view", "NAME", "Show a view in the plot in use",
        WordKind::Views, values::view),
    line("layer", "NAME [on|off]", "Switch a layer",
        WordKind::Layers, values::layer),
    line("window", "X0:X1,Y0:Y1", "Show this window in the plot in use",
        WordKind::Window, values::window),
    line("axes", "PARAMETER [PROPERTY]", "Draw the diagram in use over a parameter: axes r period",
        WordKind::Axes, values::axes),
    line("scan", "NAME=FROM:TO:COUNT .. MEASURE,..", "Scan over values: D=-0.9:0:100 r=log:0.01:1:20 from-rest",
        WordKind::Scan, scan::scan),
    line("save-scan", "FILE", "Write the rows of the scan to a file, .csv or .json",
        WordKind::Unknown, scan::save),
    line("harmonics", "N", "Show the cycles of N harmonics",
        WordKind::Unknown, values::harmonics),
    line("kicks", "q=MEAN+-SPREAD,v=MEAN+-SPREAD", "Show random kicks over the basin, and the part lost",
        WordKind::Unknown, values::kicks),
    line("mark", "LETTER", "Mark this point by a letter",
        WordKind::Marks, |s, rest| values::letter(rest).map(|name| history::set_mark(s, name))),
    line("goto", "LETTER", "Go to a mark",
        WordKind::Marks, |s, rest| history::go_to_mark(s, values::letter(rest)?)),
    line("write", "FILE", "Save the session; write! replaces a file that is there",
        WordKind::Unknown, |s, rest| files::write(s, rest, false)),
    line("write!", "FILE", "Save the session and replace what is there",
        WordKind::Unknown, |s, rest| files::write(s, rest, true)),
    line("open", "FILE", "Resume a saved session",
        WordKind::Unknown, |s, rest| files::ask(s, rest, Purpose::Open)),
    line("fit", "FILE [mass=2 kg] [columns=1,3] ..", "Fit a recorded motion: times and displacements",
        WordKind::Unknown, files::fit),
    line("figure", "FILE", "Write what is shown as .svg, .png, .csv or .json",
        WordKind::Unknown, |s, rest| files::figure(s, rest, None, false)),
    line("figure!", "FILE", "The same, replacing what is there",
        WordKind::Unknown, |s, rest| files::figure(s, rest, None, true)),
    line("figure-pane", "FILE", "Write the plot in use as .svg, .png, .csv or .json",
        WordKind::Unknown, |s, rest| files::figure(s, rest, Some(s.plot), false)),
    line("figure-pane!", "FILE", "The same, replacing what is there",
        WordKind::Unknown, |s, rest| files::figure(s, rest, Some(s.plot), true)),
    line("record", "FILE", "Write what was pressed since the start to a file",
        WordKind::Unknown, |s, rest| files::record(s, rest, false)),
    line("record!", "FILE", "The same, replacing what is there",
        WordKind::Unknown, |s, rest| files::record(s, rest, true)),
    line("play", "FILE", "Press the keys of a keystroke file",
        WordKind::Unknown, |s, rest| files::ask(s, rest, Purpose::Play)),
    line("theme", "NAME", "Use these colours",
        WordKind::Themes, |s, name| values::choice(&THEMES, name).map(|it| s.display.theme = it)),
    line("units", "on|off", "Show axes of machines in mm, mm/s and s, or as q, v, tau",
        WordKind::Switch, |s, state| values::is_on("units", state).map(|on| s.display.dimensionless = !on)),
    line("equal", "on|off", "Draw a circle in a phase plane as one, or use all the room",
        WordKind::Switch, |s, state| values::is_on("equal units", state).map(|on| s.display.stretched = !on)),
    line("glyphs", "NAME", "Draw with these characters",
        WordKind::Glyphs, |s, name| values::choice(&GLYPHS, name).map(|it| s.display.glyphs = it)),
    line("color", "DEPTH", "Use this many colours",
        WordKind::Colors, |s, name| values::choice(&COLORS, name).map(|it| s.display.colors = it)),
];

/// Every command that takes words, in the order in which the help lists them.
pub fn lines() -> impl Iterator<Item = &'static Command> {
    LINES.iter().map(|row| &row.command)
}
