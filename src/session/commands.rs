//! The commands: one table that feeds the keys, the help and the footer, and decides what a key does.
//!
//! A new command is one row here and one small function in `session::act`.

use std::sync::{Arc, LazyLock};

use crate::scene::View::{
    Belt, Diagram, EnergyLedger, EnergyRate, Phase, Regimes, ReturnMap, Scan, Speeds, TimeSeries,
    Trade,
};
use crate::scene::{LAYERS, Layer, LayerSpec, Scene};
use crate::session::Context::{
    self, Always, Count, Entry, Everywhere, Letter, List as On, Lists, Offer, Palette, Parameters,
    Plots, Prompt, Search, View as In, Walk,
};
use crate::session::Listed::{
    Cost, Interrupted, Layers, Palette as Everything, Paper, Scenes, Views,
};
use crate::session::act::{
    copy, files, general, history, lists, motions, parameters, plots, prompt, scan, screen_setup,
    walk,
};
use crate::session::lines::CommandAction::{self, Act, Choose, Toggle, Try};
use crate::session::lines::{CommandRow, LINES, lines, row};
use crate::session::{Command, Effect, Input, Keymap, Letter as Ask, Pending, Session, Size};

/// Characters with which a number can begin.
const NUMERIC: &[&str] = &["0", "1", "2", "3", "4", "5", "6", "7", "8", "9", "-", "."];

/// Letters available for layers: all that do not move in a list or close it.
const LETTERS: &[&str] = &[
    "a", "b", "c", "d", "e", "f", "h", "i", "l", "m", "n", "o", "p", "r", "s", "t", "u", "w", "x",
    "y", "z",
];

/// Digits with which a count can begin, where no number is typed.
const DIGITS: &[&str] = &["1", "2", "3", "4", "5", "6", "7", "8", "9"];

/// Digits with which a count continues.
const MORE_DIGITS: &[&str] = &["0", "1", "2", "3", "4", "5", "6", "7", "8", "9"];

/// Every command, in the order in which the help lists them.
#[rustfmt::skip]
const COMMANDS: &[CommandRow] = &[
    row("select-previous", &[(Parameters, &["<up>", "k"])], "select",
        "Select the row above", Act(|s, _| parameters::select(s, -1))),
    row("select-next", &[(Parameters, &["<down>", "j"])], "select",
        "Select the row below", Act(|s, _| parameters::select(s, 1))),
    row("step-down", &[(Parameters, &["<left>", "h"]), (Plots, &["<lt>"])], "step",
        "Step the selected value down by its step size", Try(|s| parameters::step(s, -1))),
    row("step-up", &[(Parameters, &["<right>", "l"]), (Plots, &["<gt>"])], "step",
        "Step the selected value up by its step size", Try(|s| parameters::step(s, 1))),
    row("step-far-down", &[(Parameters, &["<S-left>", "H"])], "",
        "Ten steps down", Try(|s| parameters::step(s, -10))),
    row("step-far-up", &[(Parameters, &["<S-right>", "L"])], "",
        "Ten steps up", Try(|s| parameters::step(s, 10))),
    row("step-size-smaller", &[(Parameters, &["["])], "step size",
        "Make the step smaller: 5, 2, 1 and so on", Try(|s| parameters::step_size(s, false))),
    row("step-size-larger", &[(Parameters, &["]"])], "step size",
        "Make the step larger: 1, 2, 5 and so on", Try(|s| parameters::step_size(s, true))),
    row("narrower", &[(Parameters, &["<lt>"])], "",
        "Narrow what is known of the selected parameter by a step", Try(|s| parameters::half_width(s, -1))),
    row("wider", &[(Parameters, &[">"])], "",
        "Widen what is known of the selected parameter by a step", Try(|s| parameters::half_width(s, 1))),
    row("edit", &[(Parameters, &["<enter>"])], "type a value",
        "Edit the selected value", Act(|s, _| parameters::edit(s))),
    row("type-number", &[(Parameters, NUMERIC)], "",
        "Type a new value for the selected row", Act(parameters::begin)),
    row("reset-value", &[(Parameters, &["r", "<backspace>", "<del>"])], "reset",
        "Reset the selected row to the scene's value and step", Act(|s, _| parameters::reset_row(s))),

    row("start-here", &[(In(Phase), &["<enter>"]), (In(TimeSeries), &["<enter>"]), (In(ReturnMap), &["<enter>"]), (In(Belt), &["<enter>"]), (In(EnergyRate), &["<enter>"])], "start here",
        "Start a motion at the cursor, in the phase plane beside the others", Try(plots::start_here)),
    row("start-on-cycle", &[(In(EnergyLedger), &["<enter>"])], "start there",
        "Start the motion on the cycle that the cursor is at", Try(plots::start_here)),
    row("use-method", &[(In(Trade), &["<enter>"])], "use this method",
        "Integrate by the method and at the accuracy under the cursor", Try(plots::use_method)),
    row("jump-here", &[(In(Diagram), &["<enter>"])], "jump here",
        "Set the diagram's parameter to the value under the cursor", Try(plots::jump_here)),

    row("take-parameters", &[(In(Regimes), &["<enter>"])], "take these",
        "Set both parameters of the chart to the values under the cursor", Try(plots::jump_here)),

    row("next-abscissa", &[(In(Diagram), &["X"])], "axes",
        "Draw the diagram over the next parameter: D, D2, D3, r", Act(|s, _| plots::next_parameter(s, false))),
    row("next-ordinate", &[(In(Diagram), &["Y"]), (Walk, &["Y"])], "axes",
        "Show the next property of the cycles: q_max, q_min, v_max and so on", Act(|s, _| plots::next_ordinate(s))),
    row("next-chart-right", &[(In(Regimes), &["X"])], "axes",
        "Draw the chart over the next parameter to the right: D, D2, D3, r", Act(|s, _| plots::next_parameter(s, false))),
    row("next-chart-up", &[(In(Regimes), &["Y"])], "axes",
        "Draw the chart over the next parameter upwards", Act(|s, _| plots::next_parameter(s, true))),
    row("next-unit", &[(In(Diagram), &["N"]), (Walk, &["N"])], "",
        "Measure lengths of the cycles in units of r, or not", Try(plots::next_unit)),
    row("walk", &[(In(Diagram), &["w"])], "walk",
        "Take hold of the branch, at the present value or the cursor", Try(walk::take_hold)),
    row("walk-back", &[(Walk, &["<left>", "h", "<down>", "j"])], "walk",
        "Go back to the last computed point of the branch", Act(|s, _| walk::go(s, -1))),
    row("walk-on", &[(Walk, &["<right>", "l", "<up>", "k"])], "walk",
        "Go on to the next computed point of the branch", Act(|s, _| walk::go(s, 1))),
    row("walk-far-back", &[(Walk, &["<S-left>", "H", "<C-left>", "<A-left>", "<pgdn>"])], "",
        "Go back ten points of the branch", Act(|s, _| walk::go(s, -walk::FAR))),
    row("walk-far-on", &[(Walk, &["<S-right>", "L", "<C-right>", "<A-right>", "<pgup>"])], "",
        "Go on ten points of the branch", Act(|s, _| walk::go(s, walk::FAR))),
    row("walk-to-next", &[(Walk, &["<tab>"])], "special",
        "Go to the next special point or end of a branch", Act(|s, _| walk::go_to_landmark(s, true))),
    row("walk-to-previous", &[(Walk, &["<S-tab>"])], "",
        "Go to the previous special point or end of a branch", Act(|s, _| walk::go_to_landmark(s, false))),
    row("walk-to-first", &[(Walk, &["<home>"])], "",
        "Go to the first point of this branch", Act(|s, _| walk::go(s, isize::MIN))),
    row("walk-to-last", &[(Walk, &["<end>"])], "",
        "Go to the last point of this branch", Act(|s, _| walk::go(s, isize::MAX))),
    row("walk-take", &[(Walk, &["<enter>"])], "take",
        "Take parameter and cycle of the point into the phase plane", Try(walk::take)),
    row("walk-let-go", &[(Walk, &["<esc>", "w"])], "let go",
        "Let go of the branch", Act(|s, _| s.held = None)),

    row("scan", &[(Everywhere, &["%"])], "",
        "Scan over one or two parameters: opens the line for it", Act(|s, _| scan::open(s))),
    row("scan-back", &[(In(Scan), &["<left>", "h"])], "points",
        "Go to the point before, on a grid to the left", Try(|s| scan::go(s, -1, 0))),
    row("scan-on", &[(In(Scan), &["<right>", "l"])], "points",
        "Go to the next point, on a grid to the right", Try(|s| scan::go(s, 1, 0))),
    row("scan-up", &[(In(Scan), &["<up>", "k"])], "",
        "Go to the row or the point above", Try(|s| scan::go(s, 0, 1))),
    row("scan-down", &[(In(Scan), &["<down>", "j"])], "",
        "Go to the row or the point below", Try(|s| scan::go(s, 0, -1))),
    row("scan-far-back", &[(In(Scan), &["<pgup>", "<S-left>", "H"])], "",
        "Go back ten points of the scan", Try(|s| scan::go(s, -scan::PAGE, 0))),
    row("scan-far-on", &[(In(Scan), &["<pgdn>", "<S-right>", "L"])], "",
        "Go on ten points of the scan", Try(|s| scan::go(s, scan::PAGE, 0))),
    row("scan-first", &[(In(Scan), &["<home>"])], "",
        "Go to the first point of the scan", Try(|s| scan::go(s, isize::MIN, 0))),
    row("scan-last", &[(In(Scan), &["<end>"])], "",
        "Go to the last point of the scan", Try(|s| scan::go(s, isize::MAX, 0))),
    row("scan-take", &[(In(Scan), &["<enter>"])], "take",
        "Take the parameters of the point into the phase plane", Try(scan::take)),
    row("scan-column", &[(In(Scan), &["Y", "<C-down>"])], "measure",
        "Plot the next measured number", Try(|s| scan::next_column(s, 1))),
    row("scan-column-back", &[(In(Scan), &["<C-up>"])], "",
        "Plot the measured number before", Try(|s| scan::next_column(s, -1))),
    row("scan-table", &[(In(Scan), &["t"])], "table",
        "List the rows of the scan, or plot them", Try(scan::table)),
    row("scan-pause", &[(In(Scan), &["P"])], "pause",
        "Pause the scan and keep what is done, or continue it", Try(scan::pause)),
    row("scan-save", &[(In(Scan), &["S"])], "save",
        "Write the rows to scan.csv, as the command scan does", Try(|s| scan::save(s, scan::FILE))),

    row("cursor-left", &[(Plots, &["<left>", "h"])], "cursor",
        "Move the cursor left", Act(|s, _| plots::move_cursor(s, -1, 0))),
    row("cursor-right", &[(Plots, &["<right>", "l"])], "cursor",
        "Move the cursor right", Act(|s, _| plots::move_cursor(s, 1, 0))),
    row("cursor-up", &[(Plots, &["<up>", "k"])], "",
        "Move the cursor up", Act(|s, _| plots::move_cursor(s, 0, 1))),
    row("cursor-down", &[(Plots, &["<down>", "j"])], "",
        "Move the cursor down", Act(|s, _| plots::move_cursor(s, 0, -1))),
    row("cursor-far-left", &[(Plots, &["<C-left>", "<A-left>"])], "",
        "Move the cursor far left", Act(|s, _| plots::move_cursor(s, -plots::FAR, 0))),
    row("cursor-far-right", &[(Plots, &["<C-right>", "<A-right>"])], "",
        "Move the cursor far right", Act(|s, _| plots::move_cursor(s, plots::FAR, 0))),
    row("cursor-far-up", &[(Plots, &["<C-up>", "<A-up>"])], "",
        "Move the cursor far up", Act(|s, _| plots::move_cursor(s, 0, plots::FAR))),
    row("cursor-far-down", &[(Plots, &["<C-down>", "<A-down>"])], "",
        "Move the cursor far down", Act(|s, _| plots::move_cursor(s, 0, -plots::FAR))),
    row("zoom-in", &[(Plots, &["+", "="]), (Walk, &["+", "="])], "zoom",
        "Zoom in, about the cursor if there is one", Act(|s, _| plots::zoom(s, true))),
    row("zoom-out", &[(Plots, &["-"]), (Walk, &["-"])], "zoom",
        "Zoom out, about the cursor if there is one", Act(|s, _| plots::zoom(s, false))),
    row("fit-window", &[(Plots, &["0"]), (Walk, &["0"])], "fit",
        "Fit the window to what is on show", Act(|s, _| plots::fit(s))),
    row("home", &[(Plots, &["<home>"])], "",
        "Go back to the scene's window", Act(|s, _| plots::home(s))),
    row("pan-left", &[(Plots, &["H", "<S-left>"])], "pan",
        "Move the window left", Act(|s, _| plots::pan(s, -1, 0))),
    row("pan-down", &[(Plots, &["J", "<S-down>"])], "pan",
        "Move the window down", Act(|s, _| plots::pan(s, 0, -1))),
    row("pan-up", &[(Plots, &["K", "<S-up>"])], "pan",
        "Move the window up", Act(|s, _| plots::pan(s, 0, 1))),
    row("pan-right", &[(Plots, &["L", "<S-right>"])], "pan",
        "Move the window right", Act(|s, _| plots::pan(s, 1, 0))),

    row("next-pane", &[(Everywhere, &["<tab>"])], "pane",
        "Move the focus to the next pane", Act(|s, _| screen_setup::focus(s, 1))),
    row("previous-pane", &[(Everywhere, &["<S-tab>"])], "",
        "Move the focus to the previous pane", Act(|s, _| screen_setup::focus(s, -1))),
    row("enlarge", &[(Everywhere, &["z"])], "",
        "Give one plot the room of all, or share it again", Act(|s, _| s.enlarged = !s.enlarged)),
    row("paper", &[(Everywhere, &["<f10>", "<A-p>"])], "",
        "List the claims of the paper against computation", Act(|s, _| lists::open(s, Paper))),
    row("views", &[(Everywhere, &["V"])], "view",
        "Pick what the plot in use shows", Act(|s, _| lists::open(s, Views))),
    row("next-view", &[(Everywhere, &[";"])], "",
        "Show the next view in the plot in use", Act(|s, _| screen_setup::next_view(s, 1))),
    row("previous-view", &[(Everywhere, &[","])], "",
        "Show the previous view in the plot in use", Act(|s, _| screen_setup::next_view(s, -1))),
    row("add-plot", &[(Everywhere, &["W"])], "",
        "Add a plot beside the one in use, up to four", Try(screen_setup::add)),
    row("remove-plot", &[(Everywhere, &["Q"])], "",
        "Remove the plot in use", Try(screen_setup::remove)),
    row("move-plot", &[(Everywhere, &["M"])], "",
        "Swap the plot in use with the next one", Try(screen_setup::move_on)),
    row("arrange", &[(Everywhere, &["Z"])], "",
        "Arrange the plots: as suits them best, in columns, in rows", Act(|s, _| screen_setup::arrange(s))),
    row("help", &[(Everywhere, &["?", "<f1>"]), (Walk, &["?", "<f1>"])], "help",
        "List everything: keys, scenes, views, layers, machines, claims", Act(|s, _| lists::open(s, Everything))),
    row("palette", &[(Everywhere, &["<space>", "<C-p>"]), (Walk, &["<space>", "<C-p>"])], "all",
        "Search everything that has a name, and run it", Act(|s, _| {
            lists::open(s, Everything);
            lists::search(s);
        })),
    row("prompt", &[(Everywhere, &[":"]), (Walk, &[":"])], "command",
        "Type a command by its name: set, scene, until and so on", Act(|s, _| prompt::open(s, ""))),
    row("scenes", &[(Everywhere, &["s"])], "scenes",
        "Pick a scene", Act(|s, _| lists::open(s, Scenes))),
    row("layers", &[(Everywhere, &["v"])], "layers",
        "List the layers, to switch them on and off", Act(|s, _| lists::open(s, Layers))),
    row("undo", &[(Everywhere, &["u"]), (Walk, &["u"])], "undo",
        "Undo the last change of a parameter or scene", Try(history::undo)),
    row("redo", &[(Everywhere, &["<C-r>", "U"])], "",
        "Redo what was undone", Try(history::redo)),
    row("start-inside", &[(Everywhere, &["i"])], "in/outside",
        "Start just inside the border of the basin", Try(|s| motions::beside_edge(s, motions::INSIDE))),
    row("start-outside", &[(Everywhere, &["o"])], "in/outside",
        "Start just outside the border of the basin", Try(|s| motions::beside_edge(s, motions::OUTSIDE))),
    row("drop-motion", &[(Everywhere, &["d"])], "",
        "Remove the newest motion", Try(motions::drop_newest)),
    row("drop-other-motions", &[(Everywhere, &["c"])], "",
        "Remove all motions but the newest", Try(motions::drop_others)),
    row("play-motion", &[(Everywhere, &["<f8>"])], "play",
        "Play the motion in time, or hold it", Try(motions::play)),
    row("motion-on", &[(Everywhere, &["<f9>"])], "",
        "Move a little on along the motion", Try(|s| motions::step(s, 1.0))),
    row("motion-back", &[(Everywhere, &["<f7>"])], "",
        "Move a little back along the motion", Try(|s| motions::step(s, -1.0))),
    row("motion-pace", &[(Everywhere, &["<C-t>"])], "",
        "Play at the next faster pace; after the fastest, at the slowest", Act(|s, _| motions::pace(s))),
    row("unfold", &[(Everywhere, &["x"])], "unfold",
        "Show the parameters that the scene does not need, or hide them", Act(|s, _| s.unfolded = !s.unfolded)),
    row("reset-scene", &[(Everywhere, &["R"])], "",
        "Restore the scene as it was opened", Act(|s, _| history::reset_scene(s))),
    row("coarser", &[(Everywhere, &["{"])], "",
        "Compute less exactly: reference, fine, normal, draft", Try(|s| parameters::dial(s, false))),
    row("finer", &[(Everywhere, &["}"])], "",
        "Compute more exactly: draft, normal, fine, reference", Try(|s| parameters::dial(s, true))),
    row("next-method", &[(Everywhere, &["m"])], "",
        "Integrate by the next method", Act(|s, _| parameters::next_method(s, 1))),

    row("fewer-harmonics", &[(Everywhere, &["("])], "",
        "Fewer harmonics", Try(|s| general::harmonics(s, false))),
    row("more-harmonics", &[(Everywhere, &[")"])], "",
        "More harmonics", Try(|s| general::harmonics(s, true))),
    row("take-speed", &[(In(Speeds), &["<enter>"])], "take it",
        "Set the belt to the speed under the cursor", Try(plots::jump_here)),

    row("count", &[(Plots, DIGITS), (Walk, DIGITS), (Lists, DIGITS), (Count, MORE_DIGITS)], "",
        "A digit: press the next key that many times, as one change", Act(general::count)),
    row("begin-count", &[(Everywhere, &["*"]), (Walk, &["*"]), (Lists, &["*"])], "",
        "Begin a count where digits are values: *12 and a key", Act(general::count)),
    row("delete-digit", &[(Count, &["<backspace>"])], "",
        "Delete the last digit of the count", Act(|s, _| general::delete_digit(s))),
    row("forget-pending", &[(Count, &["<esc>"]), (Letter, &["<esc>"])], "forget",
        "Forget the count, or the question for a letter", Act(|s, _| s.pending = None)),
    row("set-mark", &[(Everywhere, &["\""])], "",
        "Mark this point by a letter: parameters, start, method", Act(|s, _| s.pending = Some(Pending::Letter(Ask::Mark)))),
    row("go-to-mark", &[(Everywhere, &["'"])], "",
        "Go to a mark; twice: to the point left last", Act(|s, _| s.pending = Some(Pending::Letter(Ask::GoTo)))),

    row("explain", &[(Everywhere, &["!"]), (Walk, &["!"])], "",
        "Show what there is to see in this scene, and what to press", Act(|s, _| s.caption.explain())),
    row("tour", &[(Everywhere, &["<f6>"])], "",
        "A tour with captions, which can be left at any point", Try(files::tour)),
    row("restore", &[(Everywhere, &["<f3>"])], "",
        "Resume the interrupted session; of several, list them", Try(files::restore)),
    row("forget-interrupted", &[(Everywhere, &["<f4>"])], "",
        "Forget the interrupted sessions: they are not offered again", Try(files::forget)),
    row("restore-selected", &[(On(Interrupted), &["<enter>"])], "resume",
        "Resume the selected session", Act(|s, _| files::restore_selected(s))),
    row("forget-one", &[(On(Interrupted), &["x", "<del>"])], "forget it",
        "Forget the selected session", Try(files::forget_selected)),
    row("forget-all", &[(On(Interrupted), &["X", "<f4>"])], "forget all",
        "Forget all of these sessions", Try(files::forget)),

    row("costs", &[(Everywhere, &["$"])], "",
        "List what the picture costs, and what each step recomputes", Act(|s, _| lists::open(s, Cost))),
    row("retry", &[(Everywhere, &["<f5>"])], "",
        "Compute again what has failed", Act(|s, _| general::retry(s))),
    row("save-figure", &[(Everywhere, &["<A-f>"]), (Walk, &["<A-f>"])], "",
        "Write the plot in use to a file, whose name can be changed", Act(|s, _| files::offer_figure(s))),
    row("copy-command", &[(Always, &["<C-y>"])], "",
        "Copy the command line that gives the numbers of this pane", Act(|s, _| s.effects.push(Effect::Copy(copy::command_line(s))))),
    row("copy-number", &[(Everywhere, &["y"]), (Walk, &["y"])], "",
        "Copy the number or the point at the cursor", Try(copy::number)),
    row("copy-row", &[(Everywhere, &["<A-r>"]), (Walk, &["<A-r>"])], "",
        "Copy the number with all that belongs to it, as NAME=VALUE", Try(copy::row)),
    row("copy-screen", &[(Always, &["<A-y>"])], "",
        "Copy the characters on the screen", Act(|s, _| s.effects.push(Effect::CopyScreen))),
    row("glyphs", &[(Everywhere, &["g"])], "",
        "Draw with other characters: braille, octants, blocks, ASCII", Act(|s, _| general::turn(s, "glyphs", |it| &mut it.glyphs))),
    row("units", &[(Everywhere, &["<A-m>"])], "",
        "Show axes of machines in mm, mm/s and s, or as q, v, tau", Act(|s, _| general::units(s))),
    row("equal", &[(Everywhere, &["E"])], "",
        "Draw phase planes with equal units, or let them fill their panes", Act(|s, _| general::equal(s))),
    row("mouse", &[(Everywhere, &["<f2>"])], "",
        "Let the mouse start motions and zoom, or leave it to the terminal", Act(|s, _| plots::toggle_mouse(s))),
    row("theme", &[(Everywhere, &["T"])], "",
        "Use the next theme", Act(|s, _| general::turn(s, "theme", |it| &mut it.theme))),
    row("drop-cursor", &[(Everywhere, &["<esc>"])], "",
        "Hide the cursor; stop a scan, a fit or a figure; never quits", Act(|s, _| plots::drop_cursor(s))),
    row("back", &[(Lists, &["<esc>", "q"]), (Entry, &["<esc>"]), (Prompt, &["<esc>"]), (Palette, &["<esc>"]), (Offer, &["<esc>"])], "close",
        "Close what is open", Act(|s, _| s.overlay = None)),
    row("close-again", &[(On(Everything), &["?", "<f1>", "$"]), (On(Scenes), &["s"]), (On(Layers), &["v"]), (On(Views), &["V"]), (On(Paper), &["<f10>", "<A-p>"]), (On(Interrupted), &["<f3>"])], "",
        "Close with the key that opened", Act(|s, _| s.overlay = None)),
    row("quit", &[(Everywhere, &["q"]), (Walk, &["q"]), (Always, &["<C-c>"])], "quit",
        "Quit: leave the explorer", Act(|s, _| general::quit(s))),

    row("list-up", &[(Lists, &["<up>", "k"]), (Search, &["<up>"]), (Palette, &["<up>"])], "move",
        "Move up in a list", Act(|s, _| lists::move_by(s, -1))),
    row("list-down", &[(Lists, &["<down>", "j"]), (Search, &["<down>"]), (Palette, &["<down>"])], "move",
        "Move down in a list", Act(|s, _| lists::move_by(s, 1))),
    row("list-page-up", &[(Lists, &["<pgup>", "<C-b>"]), (Search, &["<pgup>"]), (Palette, &["<pgup>"])], "page",
        "Move ten rows up", Act(|s, _| lists::move_by(s, -lists::PAGE))),
    row("list-page-down", &[(Lists, &["<pgdn>", "<C-f>"]), (Search, &["<pgdn>"]), (Palette, &["<pgdn>"])], "page",
        "Move ten rows down", Act(|s, _| lists::move_by(s, lists::PAGE))),
    row("list-first", &[(Lists, &["<home>", "g"])], "",
        "Go to the first row", Act(|s, _| lists::move_by(s, isize::MIN))),
    row("list-last", &[(Lists, &["<end>", "G"])], "",
        "Go to the last row", Act(|s, _| lists::move_by(s, isize::MAX))),
    row("search", &[(Lists, &["/"])], "search",
        "Show only the rows that contain some text", Act(|s, _| lists::search(s))),
    row("open-scene", &[(On(Scenes), &["<enter>", "<space>"])], "open",
        "Open the selected scene", Choose(prompt::choose)),
    row("toggle-letter", &[(On(Layers), LETTERS)], "",
        "Switch the layer that has this letter", Act(lists::toggle_letter)),
    row("toggle-layer", &[(On(Layers), &["<enter>", "<space>"])], "on/off",
        "Switch the selected layer on or off", Choose(prompt::choose)),
    row("show-claim", &[(On(Paper), &["<enter>"])], "its scene",
        "Open the scene that shows the selected claim", Choose(prompt::choose)),
    row("show-view", &[(On(Views), &["<enter>", "<space>"])], "show",
        "Show the selected view", Choose(prompt::choose)),
    row("run-command", &[(Palette, &["<enter>"]), (On(Everything), &["<enter>"])], "run",
        "Run what is selected", Choose(prompt::choose)),
    row("search-done", &[(Search, &["<enter>"])], "done",
        "Keep the rows found; in a picker, take the selected one", Choose(prompt::search_done)),
    row("search-drop", &[(Search, &["<esc>"])], "all rows",
        "Show all rows again", Act(|s, _| lists::search_drop(s))),
    row("search-delete", &[(Search, &["<backspace>"]), (Palette, &["<backspace>"])], "",
        "Delete the last character of the search", Act(|s, _| lists::search_with(s, |it| _ = it.pop()))),
    row("search-clear", &[(Search, &["<C-u>"]), (Palette, &["<C-u>"])], "",
        "Clear the search", Act(|s, _| lists::search_with(s, String::clear))),

    row("accept", &[(Entry, &["<enter>"])], "accept",
        "Take the typed value", Choose(|s| Ok(prompt::accept(s)))),
    row("run-line", &[(Prompt, &["<enter>"])], "accept",
        "Run the typed command", Choose(|s| Ok(prompt::accept(s)))),
    row("complete", &[(Prompt, &["<tab>"])], "complete",
        "Complete the word; again, its next possibility", Act(|s, _| prompt::complete(s, 1))),
    row("complete-back", &[(Prompt, &["<S-tab>"])], "",
        "Complete the word by the possibility before", Act(|s, _| prompt::complete(s, -1))),
    row("older-line", &[(Prompt, &["<up>", "<C-p>"])], "history",
        "Get the line typed before this one", Act(|s, _| prompt::recall(s, 1))),
    row("newer-line", &[(Prompt, &["<down>", "<C-n>"])], "history",
        "Get the line typed after this one", Act(|s, _| prompt::recall(s, -1))),
    row("clear", &[(Entry, &["<C-u>"]), (Prompt, &["<C-u>"])], "clear",
        "Clear the line", Act(|s, _| prompt::with(s, |i| *i = Input::default()))),
    row("delete-word", &[(Entry, &["<C-w>"]), (Prompt, &["<C-w>"])], "",
        "Delete the word before the caret", Act(|s, _| prompt::with(s, Input::delete_word))),
    row("delete-before", &[(Entry, &["<backspace>"]), (Prompt, &["<backspace>"])], "",
        "Delete the character before the caret", Act(|s, _| prompt::with(s, |i| _ = i.before.pop()))),
    row("delete-after", &[(Entry, &["<del>"]), (Prompt, &["<del>"])], "",
        "Delete the character after the caret", Act(|s, _| prompt::with(s, Input::delete_after))),
    row("caret-left", &[(Entry, &["<left>"]), (Prompt, &["<left>"])], "",
        "Move the caret left", Act(|s, _| prompt::with(s, |i| i.move_caret(-1)))),
    row("caret-right", &[(Entry, &["<right>"]), (Prompt, &["<right>"])], "",
        "Move the caret right", Act(|s, _| prompt::with(s, |i| i.move_caret(1)))),
    row("caret-home", &[(Entry, &["<home>", "<C-a>"]), (Prompt, &["<home>", "<C-a>"])], "",
        "Move the caret to the beginning", Act(|s, _| prompt::with(s, |i| i.move_caret(isize::MIN)))),
    row("caret-end", &[(Entry, &["<end>", "<C-e>"]), (Prompt, &["<end>", "<C-e>"])], "",
        "Move the caret to the end", Act(|s, _| prompt::with(s, |i| i.move_caret(isize::MAX)))),

    row("replay-pasted", &[(Offer, &["<enter>", "y"])], "replay",
        "Press the pasted keys", Act(|s, _| general::accept_offer(s))),
    row("forget-pasted", &[(Offer, &["n", "q"])], "",
        "Forget the pasted keys", Act(|s, _| s.overlay = None)),

    row("suspend", &[(Always, &["<C-z>"])], "",
        "Suspend; fg brings it back", Act(|s, _| s.effects.push(Effect::Suspend))),
    row("repaint", &[(Always, &["<C-l>"])], "",
        "Redraw the whole screen", Act(|s, _| s.effects.push(Effect::Repaint))),
];

/// A command for each layer. Only that of the whole model has a default key, because it changes what all views
/// draw; the others get keys from the user's settings.
fn toggles() -> &'static [CommandRow] {
    static TOGGLES: LazyLock<Vec<CommandRow>> = LazyLock::new(|| {
        let toggle = |spec: &LayerSpec| {
            // The names must live as long as the program, like those of the other commands.
            let name = Box::leak(format!("toggle-{}", spec.name).into_boxed_str());
            let doc = Box::leak(format!("Show or hide {}", spec.meaning).into_boxed_str());
            let keys: &[(Context, &[&str])] = if spec.layer == Layer::Whole {
                &[(Everywhere, &["|"])]
            } else {
                &[(Everywhere, &[])]
            };
            row(name, keys, "", doc, Toggle(spec.layer))
        };
        LAYERS.iter().map(toggle).collect()
    });
    &TOGGLES
}

fn rows() -> impl Iterator<Item = &'static CommandRow> {
    COMMANDS.iter().chain(toggles())
}

/// Every command, in the order in which the help lists them.
pub fn commands() -> impl Iterator<Item = &'static Command> {
    rows().map(|row| &row.command)
}

/// How a command is run.
pub(super) fn action(command: &Command) -> Option<CommandAction> {
    let same = |row: &&CommandRow| {
        row.command == *command && row.command.words.is_some() == command.words.is_some()
    };
    rows().chain(LINES).find(same).map(|row| row.run)
}

impl Default for Keymap {
    /// The default keys of every command.
    fn default() -> Self {
        Keymap::new(commands().chain(lines()))
    }
}

impl Session {
    /// A session that has just opened a scene, with the default keys.
    pub fn new(scene: Arc<Scene>, size: Size) -> Self {
        Session::opened(scene, size, Arc::new(Keymap::default()))
    }
}
