//! The commands: one table that feeds the keys, the help and the footer, and decides what a key does.
//!
//! A new command is one row here and one small function in `session::act`.

use std::sync::{Arc, LazyLock};

use crate::scene::View::{
    Belt, Diagram, EnergyLedger, EnergyRate, Phase, Regimes, ReturnMap, Scan, Speeds, TimeSeries,
    Trade,
};
use crate::scene::{LAYERS, Layer, LayerSpec, Scene};
use crate::session::act::{
    axes, copy, entry, files, focus, general, history, lists, mouse, palette, parameters, pending,
    playback, plots, prompt, scan, screen_setup, starts, typing, walk,
};
use crate::session::command_row::{CommandAction, CommandRow, chooses, row, tries};
use crate::session::effect::Effect;
use crate::session::lines::lines;
use crate::session::state::context::Context::{
    self, Always, Count, Entry, Everywhere, Form, Help, Interrupted, Layers, Letter, Lists, Offer,
    Palette, Paper, Parameters, Plots, Prompt, Scenes, Search, View as In, Views, Walk,
};
use crate::session::state::pending::Letter as Ask;
use crate::session::state::{Command, Input, Keymap, Listed, Session, Size};

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
        "Select the row above", |s, _| parameters::select(s, -1)),
    row("select-next", &[(Parameters, &["<down>", "j"])], "select",
        "Select the row below", |s, _| parameters::select(s, 1)),
    tries("step-down", &[(Parameters, &["<left>", "h"]), (Plots, &["<lt>"])], "step",
        "Step the selected value down by its step size", |s| parameters::step(s, -1)),
    tries("step-up", &[(Parameters, &["<right>", "l"]), (Plots, &["<gt>"])], "step",
        "Step the selected value up by its step size", |s| parameters::step(s, 1)),
    tries("step-far-down", &[(Parameters, &["<S-left>", "H"])], "",
        "Ten steps down", |s| parameters::step(s, -10)),
    tries("step-far-up", &[(Parameters, &["<S-right>", "L"])], "",
        "Ten steps up", |s| parameters::step(s, 10)),
    tries("step-size-smaller", &[(Parameters, &["["])], "step size",
        "Make the step smaller: 5, 2, 1 and so on", |s| parameters::step_size(s, false)),
    tries("step-size-larger", &[(Parameters, &["]"])], "step size",
        "Make the step larger: 1, 2, 5 and so on", |s| parameters::step_size(s, true)),
    tries("narrower", &[(Parameters, &["<lt>"])], "",
        "Narrow what is known of the selected parameter by a step", |s| parameters::half_width(s, -1)),
    tries("wider", &[(Parameters, &[">"])], "",
        "Widen what is known of the selected parameter by a step", |s| parameters::half_width(s, 1)),
    row("edit", &[(Parameters, &["<enter>"])], "type a value",
        "Edit the selected value", |s, _| entry::edit(s)),
    row("type-number", &[(Parameters, NUMERIC)], "",
        "Type a new value for the selected row", entry::begin),
    row("reset-value", &[(Parameters, &["r", "<backspace>", "<del>"])], "reset",
        "Reset the selected row to the scene's value and step", |s, _| parameters::reset_row(s)),

    tries("start-here", &[(In(Phase), &["<enter>"]), (In(TimeSeries), &["<enter>"]), (In(ReturnMap), &["<enter>"]), (In(Belt), &["<enter>"]), (In(EnergyRate), &["<enter>"])], "start here",
        "Start a motion at the cursor, in the phase plane beside the others", plots::start_here),
    tries("start-on-cycle", &[(In(EnergyLedger), &["<enter>"])], "start there",
        "Start the motion on the cycle that the cursor is at", plots::start_here),
    tries("use-method", &[(In(Trade), &["<enter>"])], "use this method",
        "Integrate by the method and at the accuracy under the cursor", plots::use_method),
    tries("jump-here", &[(In(Diagram), &["<enter>"])], "jump here",
        "Set the diagram's parameter to the value under the cursor", plots::jump_here),

    tries("take-parameters", &[(In(Regimes), &["<enter>"])], "take these",
        "Set both parameters of the chart to the values under the cursor", plots::jump_here),

    row("next-abscissa", &[(In(Diagram), &["X"])], "axes",
        "Draw the diagram over the next parameter: D, D2, D3, r", |s, _| axes::next_abscissa(s)),
    row("next-ordinate", &[(In(Diagram), &["Y"]), (Walk, &["Y"])], "axes",
        "Show the next property of the cycles: q_max, q_min, v_max and so on", |s, _| axes::next_ordinate(s)),
    row("next-chart-right", &[(In(Regimes), &["X"])], "axes",
        "Draw the chart over the next parameter to the right: D, D2, D3, r", |s, _| axes::next_of_chart(s, false)),
    row("next-chart-up", &[(In(Regimes), &["Y"])], "axes",
        "Draw the chart over the next parameter upwards", |s, _| axes::next_of_chart(s, true)),
    tries("next-unit", &[(In(Diagram), &["N"]), (Walk, &["N"])], "",
        "Measure lengths of the cycles in units of r, or not", axes::next_unit),
    tries("walk", &[(In(Diagram), &["w"])], "walk",
        "Take hold of the branch, at the present value or the cursor", walk::take_hold),
    row("walk-back", &[(Walk, &["<left>", "h", "<down>", "j"])], "walk",
        "Go back to the last computed point of the branch", |s, _| walk::go(s, -1)),
    row("walk-on", &[(Walk, &["<right>", "l", "<up>", "k"])], "walk",
        "Go on to the next computed point of the branch", |s, _| walk::go(s, 1)),
    row("walk-far-back", &[(Walk, &["<S-left>", "H", "<C-left>", "<A-left>", "<pgdn>"])], "",
        "Go back ten points of the branch", |s, _| walk::go(s, -walk::FAR)),
    row("walk-far-on", &[(Walk, &["<S-right>", "L", "<C-right>", "<A-right>", "<pgup>"])], "",
        "Go on ten points of the branch", |s, _| walk::go(s, walk::FAR)),
    row("walk-to-next", &[(Walk, &["<tab>"])], "special",
        "Go to the next special point or end of a branch", |s, _| walk::go_to_landmark(s, true)),
    row("walk-to-previous", &[(Walk, &["<S-tab>"])], "",
        "Go to the previous special point or end of a branch", |s, _| walk::go_to_landmark(s, false)),
    row("walk-to-first", &[(Walk, &["<home>"])], "",
        "Go to the first point of this branch", |s, _| walk::go(s, isize::MIN)),
    row("walk-to-last", &[(Walk, &["<end>"])], "",
        "Go to the last point of this branch", |s, _| walk::go(s, isize::MAX)),
    tries("walk-take", &[(Walk, &["<enter>"])], "take",
        "Take parameter and cycle of the point into the phase plane", walk::take),
    row("walk-let-go", &[(Walk, &["<esc>", "w"])], "let go",
        "Let go of the branch", |s, _| walk::let_go(s)),

    row("scan-form", &[(Everywhere, &["%"])], "",
        "Scan over one or two parameters: a form asks for them", |s, _| scan::open(s)),
    tries("scan-back", &[(In(Scan), &["<left>", "h"])], "points",
        "Go to the point before, on a grid to the left", |s| scan::go(s, -1, 0)),
    tries("scan-on", &[(In(Scan), &["<right>", "l"])], "points",
        "Go to the next point, on a grid to the right", |s| scan::go(s, 1, 0)),
    tries("scan-up", &[(In(Scan), &["<up>", "k"])], "",
        "Go to the row or the point above", |s| scan::go(s, 0, 1)),
    tries("scan-down", &[(In(Scan), &["<down>", "j"])], "",
        "Go to the row or the point below", |s| scan::go(s, 0, -1)),
    tries("scan-far-back", &[(In(Scan), &["<pgup>", "<S-left>", "H"])], "",
        "Go back ten points of the scan", |s| scan::go(s, -scan::PAGE, 0)),
    tries("scan-far-on", &[(In(Scan), &["<pgdn>", "<S-right>", "L"])], "",
        "Go on ten points of the scan", |s| scan::go(s, scan::PAGE, 0)),
    tries("scan-first", &[(In(Scan), &["<home>"])], "",
        "Go to the first point of the scan", |s| scan::go(s, isize::MIN, 0)),
    tries("scan-last", &[(In(Scan), &["<end>"])], "",
        "Go to the last point of the scan", |s| scan::go(s, isize::MAX, 0)),
    tries("scan-take", &[(In(Scan), &["<enter>"])], "take",
        "Take the parameters of the point into the phase plane", scan::take),
    tries("scan-column", &[(In(Scan), &["Y", "<C-down>"])], "measure",
        "Plot the next measured number", |s| scan::next_column(s, 1)),
    tries("scan-column-back", &[(In(Scan), &["<C-up>"])], "",
        "Plot the measured number before", |s| scan::next_column(s, -1)),
    tries("scan-table", &[(In(Scan), &["t"])], "table",
        "List the rows of the scan, or plot them", scan::table),
    tries("scan-pause", &[(In(Scan), &["P"])], "pause",
        "Pause the scan and keep what is done, or continue it", scan::pause),
    tries("scan-save", &[(In(Scan), &["S"])], "save",
        "Write the rows to scan.csv, as the command scan does", |s| scan::save(s, scan::FILE)),

    row("cursor-left", &[(Plots, &["<left>", "h"])], "cursor",
        "Move the cursor left", |s, _| plots::move_cursor(s, -1, 0)),
    row("cursor-right", &[(Plots, &["<right>", "l"])], "cursor",
        "Move the cursor right", |s, _| plots::move_cursor(s, 1, 0)),
    row("cursor-up", &[(Plots, &["<up>", "k"])], "",
        "Move the cursor up", |s, _| plots::move_cursor(s, 0, 1)),
    row("cursor-down", &[(Plots, &["<down>", "j"])], "",
        "Move the cursor down", |s, _| plots::move_cursor(s, 0, -1)),
    row("cursor-far-left", &[(Plots, &["<C-left>", "<A-left>"])], "",
        "Move the cursor far left", |s, _| plots::move_cursor(s, -plots::FAR, 0)),
    row("cursor-far-right", &[(Plots, &["<C-right>", "<A-right>"])], "",
        "Move the cursor far right", |s, _| plots::move_cursor(s, plots::FAR, 0)),
    row("cursor-far-up", &[(Plots, &["<C-up>", "<A-up>"])], "",
        "Move the cursor far up", |s, _| plots::move_cursor(s, 0, plots::FAR)),
    row("cursor-far-down", &[(Plots, &["<C-down>", "<A-down>"])], "",
        "Move the cursor far down", |s, _| plots::move_cursor(s, 0, -plots::FAR)),
    row("zoom-in", &[(Plots, &["+", "="]), (Walk, &["+", "="])], "zoom",
        "Zoom in, about the cursor if there is one", |s, _| plots::zoom(s, true)),
    row("zoom-out", &[(Plots, &["-"]), (Walk, &["-"])], "zoom",
        "Zoom out, about the cursor if there is one", |s, _| plots::zoom(s, false)),
    row("fit-window", &[(Plots, &["0"]), (Walk, &["0"])], "fit",
        "Fit the window to what is on show", |s, _| plots::fit(s)),
    row("home", &[(Plots, &["<home>"])], "",
        "Go back to the scene's window", |s, _| plots::home(s)),
    row("pan-left", &[(Plots, &["H", "<S-left>"])], "pan",
        "Move the window left", |s, _| plots::pan(s, -1, 0)),
    row("pan-down", &[(Plots, &["J", "<S-down>"])], "pan",
        "Move the window down", |s, _| plots::pan(s, 0, -1)),
    row("pan-up", &[(Plots, &["K", "<S-up>"])], "pan",
        "Move the window up", |s, _| plots::pan(s, 0, 1)),
    row("pan-right", &[(Plots, &["L", "<S-right>"])], "pan",
        "Move the window right", |s, _| plots::pan(s, 1, 0)),

    row("next-pane", &[(Everywhere, &["<tab>"])], "pane",
        "Move the focus to the next pane", |s, _| focus::focus(s, 1)),
    row("previous-pane", &[(Everywhere, &["<S-tab>"])], "",
        "Move the focus to the previous pane", |s, _| focus::focus(s, -1)),
    row("enlarge", &[(Everywhere, &["z"])], "",
        "Give one plot the room of all, or share it again", |s, _| focus::enlarge(s)),
    row("paper", &[(Everywhere, &["<f10>", "<A-p>"])], "",
        "List the claims of the paper against computation", |s, _| lists::open(s, Listed::Paper)),
    row("views", &[(Everywhere, &["V"])], "view",
        "Pick what the plot in use shows", |s, _| lists::open(s, Listed::Views)),
    row("next-view", &[(Everywhere, &[";"])], "",
        "Show the next view in the plot in use", |s, _| screen_setup::next_view(s, 1)),
    row("previous-view", &[(Everywhere, &[","])], "",
        "Show the previous view in the plot in use", |s, _| screen_setup::next_view(s, -1)),
    tries("add-plot", &[(Everywhere, &["W"])], "",
        "Add a plot beside the one in use, up to four", screen_setup::add),
    tries("remove-plot", &[(Everywhere, &["Q"])], "",
        "Remove the plot in use", screen_setup::remove),
    tries("move-plot", &[(Everywhere, &["M"])], "",
        "Swap the plot in use with the next one", screen_setup::move_on),
    row("arrange", &[(Everywhere, &["Z"])], "",
        "Arrange the plots: as suits them best, in columns, in rows", |s, _| screen_setup::arrange(s)),
    row("help", &[(Everywhere, &["?", "<f1>"]), (Walk, &["?", "<f1>"])], "help",
        "List everything: keys, scenes, views, layers, machines, claims", |s, _| lists::open(s, Listed::Palette)),
    row("palette", &[(Everywhere, &["<space>", "<C-p>"]), (Walk, &["<space>", "<C-p>"])], "all",
        "Search everything that has a name, and run it", |s, _| {
            lists::open(s, Listed::Palette);
            lists::search(s);
        }),
    row("prompt", &[(Everywhere, &[":"]), (Walk, &[":"])], "command",
        "Type a command by its name: set, scene, until and so on", |s, _| prompt::open(s)),
    row("scenes", &[(Everywhere, &["s"])], "scenes",
        "Pick a scene", |s, _| lists::open(s, Listed::Scenes)),
    row("layers", &[(Everywhere, &["v"])], "layers",
        "List the layers, to switch them on and off", |s, _| lists::open(s, Listed::Layers)),
    tries("undo", &[(Everywhere, &["u"]), (Walk, &["u"])], "undo",
        "Undo the last change of a parameter or scene", history::undo),
    tries("redo", &[(Everywhere, &["<C-r>", "U"])], "",
        "Redo what was undone", history::redo),
    tries("start-inside", &[(Everywhere, &["i"])], "in/outside",
        "Start just inside the border of the basin", |s| starts::beside_edge(s, starts::INSIDE)),
    tries("start-outside", &[(Everywhere, &["o"])], "in/outside",
        "Start just outside the border of the basin", |s| starts::beside_edge(s, starts::OUTSIDE)),
    tries("drop-motion", &[(Everywhere, &["d"])], "",
        "Remove the newest motion", starts::drop_newest),
    tries("drop-other-motions", &[(Everywhere, &["c"])], "",
        "Remove all motions but the newest", starts::drop_others),
    tries("play-motion", &[(Everywhere, &["<f8>"])], "play",
        "Play the motion in time, or hold it", playback::play),
    tries("motion-on", &[(Everywhere, &["<f9>"])], "",
        "Move a little on along the motion", |s| playback::step(s, 1.0)),
    tries("motion-back", &[(Everywhere, &["<f7>"])], "",
        "Move a little back along the motion", |s| playback::step(s, -1.0)),
    row("motion-pace", &[(Everywhere, &["<C-t>"])], "",
        "Play at the next faster pace; after the fastest, at the slowest", |s, _| playback::pace(s)),
    row("unfold", &[(Everywhere, &["x"])], "unfold",
        "Show the parameters that the scene does not need, or hide them", |s, _| parameters::unfold(s)),
    row("reset-scene", &[(Everywhere, &["R"])], "",
        "Restore the scene as it was opened", |s, _| history::reset_scene(s)),
    tries("coarser", &[(Everywhere, &["{"])], "",
        "Compute less exactly: reference, fine, normal, draft", |s| parameters::dial(s, false)),
    tries("finer", &[(Everywhere, &["}"])], "",
        "Compute more exactly: draft, normal, fine, reference", |s| parameters::dial(s, true)),
    row("next-method", &[(Everywhere, &["m"])], "",
        "Integrate by the next method", |s, _| parameters::next_method(s, 1)),

    tries("fewer-harmonics", &[(Everywhere, &["("])], "",
        "Fewer harmonics", |s| general::harmonics(s, false)),
    tries("more-harmonics", &[(Everywhere, &[")"])], "",
        "More harmonics", |s| general::harmonics(s, true)),
    tries("take-speed", &[(In(Speeds), &["<enter>"])], "take it",
        "Set the belt to the speed under the cursor", plots::take_speed),

    row("count", &[(Plots, DIGITS), (Walk, DIGITS), (Lists, DIGITS), (Count, MORE_DIGITS)], "",
        "A digit: press the next key that many times, as one change", pending::count),
    row("begin-count", &[(Everywhere, &["*"]), (Walk, &["*"]), (Lists, &["*"])], "",
        "Begin a count where digits are values: *12 and a key", pending::count),
    row("delete-digit", &[(Count, &["<backspace>"])], "",
        "Delete the last digit of the count", |s, _| pending::delete_digit(s)),
    row("forget-pending", &[(Count, &["<esc>"]), (Letter, &["<esc>"])], "forget",
        "Forget the count, or the question for a letter", |s, _| pending::forget(s)),
    row("set-mark", &[(Everywhere, &["\""])], "",
        "Mark this point by a letter: parameters, start, method", |s, _| pending::ask(s, Ask::Mark)),
    row("go-to-mark", &[(Everywhere, &["'"])], "",
        "Go to a mark; twice: to the point left last", |s, _| pending::ask(s, Ask::GoTo)),

    row("explain", &[(Everywhere, &["!"]), (Walk, &["!"])], "",
        "Show what there is to see in this scene, and what to press", |s, _| general::explain(s)),
    tries("tour", &[(Everywhere, &["<f6>"])], "",
        "A tour with captions, which can be left at any point", files::tour),
    tries("restore", &[(Everywhere, &["<f3>"])], "",
        "Resume the interrupted session; of several, list them", files::restore),
    tries("forget-interrupted", &[(Everywhere, &["<f4>"])], "",
        "Forget the interrupted sessions: they are not offered again", files::forget),
    row("restore-selected", &[(Interrupted, &["<enter>"])], "resume",
        "Resume the selected session", |s, _| files::restore_selected(s)),
    tries("forget-one", &[(Interrupted, &["x", "<del>"])], "forget it",
        "Forget the selected session", files::forget_selected),
    tries("forget-all", &[(Interrupted, &["X", "<f4>"])], "forget all",
        "Forget all of these sessions", files::forget),

    row("costs", &[(Everywhere, &["$"])], "",
        "List what the picture costs, and what each step recomputes", |s, _| lists::open(s, Listed::Cost)),
    row("retry", &[(Everywhere, &["<f5>"])], "",
        "Compute again what has failed", |s, _| general::retry(s)),
    row("save-figure", &[(Everywhere, &["<A-f>"]), (Walk, &["<A-f>"])], "",
        "Write the plot in use to a file, whose name can be changed", |s, _| files::offer_figure(s)),
    row("copy-command", &[(Always, &["<C-y>"])], "",
        "Copy the command line that gives the numbers of this pane", |s, _| copy::command(s)),
    tries("copy-number", &[(Everywhere, &["y"]), (Walk, &["y"])], "",
        "Copy the number or the point at the cursor", copy::number),
    tries("copy-row", &[(Everywhere, &["<A-r>"]), (Walk, &["<A-r>"])], "",
        "Copy the number with all that belongs to it, as NAME=VALUE", copy::row),
    row("copy-screen", &[(Always, &["<A-y>"])], "",
        "Copy the characters on the screen", |s, _| s.effects.push(Effect::CopyScreen)),
    row("glyphs", &[(Everywhere, &["g"])], "",
        "Draw with other characters: braille, octants, blocks, ASCII", |s, _| general::glyphs(s)),
    row("units", &[(Everywhere, &["<A-m>"])], "",
        "Show axes of machines in mm, mm/s and s, or as q, v, tau", |s, _| general::units(s)),
    row("equal", &[(Everywhere, &["E"])], "",
        "Draw phase planes with equal units, or let them fill their panes", |s, _| general::equal(s)),
    row("mouse", &[(Everywhere, &["<f2>"])], "",
        "Let the mouse start motions and zoom, or leave it to the terminal", |s, _| mouse::toggle(s)),
    row("theme", &[(Everywhere, &["T"])], "",
        "Use the next theme", |s, _| general::theme(s)),
    row("drop-cursor", &[(Everywhere, &["<esc>"])], "",
        "Hide the cursor; stop a scan, a fit or a figure; never quits", |s, _| plots::drop_cursor(s)),
    row("back", &[(Lists, &["<esc>", "q"]), (Entry, &["<esc>"]), (Prompt, &["<esc>"]), (Palette, &["<esc>"]), (Form, &["<esc>"]), (Offer, &["<esc>"])], "close",
        "Close what is open", |s, _| general::back(s)),
    row("close-again", &[(Help, &["?", "<f1>", "$"]), (Scenes, &["s"]), (Layers, &["v"]), (Views, &["V"]), (Paper, &["<f10>", "<A-p>"]), (Interrupted, &["<f3>"])], "",
        "Close with the key that opened", |s, _| general::back(s)),
    row("quit", &[(Everywhere, &["q"]), (Walk, &["q"]), (Always, &["<C-c>"])], "quit",
        "Quit: leave the explorer", |s, _| general::quit(s)),

    row("list-up", &[(Lists, &["<up>", "k"]), (Search, &["<up>"]), (Palette, &["<up>"])], "move",
        "Move up in a list", |s, _| lists::move_by(s, -1)),
    row("list-down", &[(Lists, &["<down>", "j"]), (Search, &["<down>"]), (Palette, &["<down>"])], "move",
        "Move down in a list", |s, _| lists::move_by(s, 1)),
    row("list-page-up", &[(Lists, &["<pgup>", "<C-b>"]), (Search, &["<pgup>"]), (Palette, &["<pgup>"])], "page",
        "Move ten rows up", |s, _| lists::move_by(s, -lists::PAGE)),
    row("list-page-down", &[(Lists, &["<pgdn>", "<C-f>"]), (Search, &["<pgdn>"]), (Palette, &["<pgdn>"])], "page",
        "Move ten rows down", |s, _| lists::move_by(s, lists::PAGE)),
    row("list-first", &[(Lists, &["<home>", "g"])], "",
        "Go to the first row", |s, _| lists::move_by(s, isize::MIN)),
    row("list-last", &[(Lists, &["<end>", "G"])], "",
        "Go to the last row", |s, _| lists::move_by(s, isize::MAX)),
    row("search", &[(Lists, &["/"])], "search",
        "Show only the rows that contain some text", |s, _| lists::search(s)),
    tries("open-scene", &[(Scenes, &["<enter>", "<space>"])], "open",
        "Open the selected scene", lists::choose),
    row("toggle-letter", &[(Layers, LETTERS)], "",
        "Switch the layer that has this letter", lists::toggle_letter),
    tries("toggle-layer", &[(Layers, &["<enter>", "<space>"])], "on/off",
        "Switch the selected layer on or off", lists::choose),
    tries("show-claim", &[(Paper, &["<enter>"])], "its scene",
        "Open the scene that shows the selected claim", lists::choose),
    tries("show-view", &[(Views, &["<enter>", "<space>"])], "show",
        "Show the selected view", lists::choose),
    chooses("run-command", &[(Palette, &["<enter>"]), (Help, &["<enter>"])], "run",
        "Run what is selected", palette::choose),
    tries("search-done", &[(Search, &["<enter>"])], "done",
        "Keep the rows found; in a picker, take the selected one", lists::search_done),
    row("search-drop", &[(Search, &["<esc>"])], "all rows",
        "Show all rows again", |s, _| lists::search_drop(s)),
    row("search-delete", &[(Search, &["<backspace>"]), (Palette, &["<backspace>"])], "",
        "Delete the last character of the search", |s, _| lists::search_with(s, |it| _ = it.pop())),
    row("search-clear", &[(Search, &["<C-u>"]), (Palette, &["<C-u>"])], "",
        "Clear the search", |s, _| lists::search_with(s, String::clear)),

    row("accept", &[(Entry, &["<enter>"])], "accept",
        "Take the typed value", |s, _| entry::accept(s)),
    chooses("run-line", &[(Prompt, &["<enter>"])], "accept",
        "Run the typed command", |s| Ok(prompt::accept(s))),
    row("complete", &[(Prompt, &["<tab>"])], "complete",
        "Complete the word; again, its next possibility", |s, _| prompt::complete(s, 1)),
    row("complete-back", &[(Prompt, &["<S-tab>"])], "",
        "Complete the word by the possibility before", |s, _| prompt::complete(s, -1)),
    row("older-line", &[(Prompt, &["<up>", "<C-p>"])], "history",
        "Get the line typed before this one", |s, _| prompt::recall(s, 1)),
    row("newer-line", &[(Prompt, &["<down>", "<C-n>"])], "history",
        "Get the line typed after this one", |s, _| prompt::recall(s, -1)),
    row("start-scan", &[(Form, &["<enter>"])], "accept",
        "Start the scan that is typed", |s, _| scan::accept(s)),
    row("next-field", &[(Form, &["<down>", "<tab>"])], "field",
        "Go to the next field", |s, _| scan::go_to_field(s, 1)),
    row("previous-field", &[(Form, &["<up>", "<S-tab>"])], "field",
        "Go to the field before", |s, _| scan::go_to_field(s, -1)),
    row("next-choice", &[(Form, &["<right>"])], "choose",
        "Take the next choice, or move the caret right", |s, _| scan::sideways(s, 1)),
    row("previous-choice", &[(Form, &["<left>"])], "choose",
        "Take the choice before, or move the caret left", |s, _| scan::sideways(s, -1)),
    row("clear", &[(Entry, &["<C-u>"]), (Prompt, &["<C-u>"]), (Form, &["<C-u>"])], "clear",
        "Clear the line", |s, _| typing::with(s, Input::clear)),
    row("delete-word", &[(Entry, &["<C-w>"]), (Prompt, &["<C-w>"]), (Form, &["<C-w>"])], "",
        "Delete the word before the caret", |s, _| typing::with(s, Input::delete_word)),
    row("delete-before", &[(Entry, &["<backspace>"]), (Prompt, &["<backspace>"]), (Form, &["<backspace>"])], "",
        "Delete the character before the caret", |s, _| typing::with(s, Input::delete_before)),
    row("delete-after", &[(Entry, &["<del>"]), (Prompt, &["<del>"]), (Form, &["<del>"])], "",
        "Delete the character after the caret", |s, _| typing::with(s, Input::delete_after)),
    row("caret-left", &[(Entry, &["<left>"]), (Prompt, &["<left>"])], "",
        "Move the caret left", |s, _| typing::with(s, |i| i.move_caret(-1))),
    row("caret-right", &[(Entry, &["<right>"]), (Prompt, &["<right>"])], "",
        "Move the caret right", |s, _| typing::with(s, |i| i.move_caret(1))),
    row("caret-home", &[(Entry, &["<home>", "<C-a>"]), (Prompt, &["<home>", "<C-a>"]), (Form, &["<home>", "<C-a>"])], "",
        "Move the caret to the beginning", |s, _| typing::with(s, |i| i.move_caret(isize::MIN))),
    row("caret-end", &[(Entry, &["<end>", "<C-e>"]), (Prompt, &["<end>", "<C-e>"]), (Form, &["<end>", "<C-e>"])], "",
        "Move the caret to the end", |s, _| typing::with(s, |i| i.move_caret(isize::MAX))),

    row("replay-pasted", &[(Offer, &["<enter>", "y"])], "replay",
        "Press the pasted keys", |s, _| general::accept_offer(s)),
    row("forget-pasted", &[(Offer, &["n", "q"])], "",
        "Forget the pasted keys", |s, _| general::back(s)),

    row("suspend", &[(Always, &["<C-z>"])], "",
        "Suspend; fg brings it back", |s, _| s.effects.push(Effect::Suspend)),
    row("repaint", &[(Always, &["<C-l>"])], "",
        "Redraw the whole screen", |s, _| s.effects.push(Effect::Repaint)),
];

/// A command for each layer. Only that of the whole model has a default key, because it changes what all views
/// draw; the others get keys from the user's settings.
fn toggles() -> &'static [CommandRow] {
    static TOGGLES: LazyLock<Vec<CommandRow>> = LazyLock::new(|| {
        let row = |spec: &LayerSpec| {
            // The names must live as long as the program, like those of the other commands.
            let name = Box::leak(format!("toggle-{}", spec.name).into_boxed_str());
            let doc = Box::leak(format!("Show or hide {}", spec.meaning).into_boxed_str());
            let keys: &[(Context, &[&str])] = if spec.layer == Layer::Whole {
                &[(Everywhere, &["|"])]
            } else {
                &[(Everywhere, &[])]
            };
            let command = Command { name, keys, hint: "", doc };
            CommandRow { command, run: CommandAction::Toggle(spec.layer) }
        };
        LAYERS.iter().map(row).collect()
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

pub(super) fn run(name: &str) -> Option<CommandAction> {
    rows().find(|row| row.command.name == name).map(|row| row.run)
}

impl Default for Keymap {
    /// The default keys of every command.
    fn default() -> Self {
        Keymap::new(commands(), lines())
    }
}

impl Session {
    /// A session that has just opened a scene, with the default keys.
    pub fn new(scene: Arc<Scene>, size: Size) -> Self {
        Session::opened(scene, size, Arc::new(Keymap::default()))
    }
}
