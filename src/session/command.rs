//! The commands: one table that feeds the keys, the help, the footer and what a key does.
//!
//! A new command is one row here and one small function in `session::update`.

use super::input::Input;
use super::key::Key;
use super::keymap::Context::{
    self, Always, Count, Diagram, EnergyLedger, Entry, Everywhere, Help, Layers, Letter, Lists,
    Offer, Palette, Parameters, Phase, Plots, Prompt, Regimes, ReturnMap, Scenes, Search,
    TimeSeries, Views, Walk,
};
use super::message::Effect;
use super::pending::{self, Letter as Ask};
use super::state::Session;
use super::update::{
    axes, copy, desk, entry, general, lists, macros, mouse, palette, parameters, plots, prompt,
    starts, typing, walk,
};
use crate::scene::Layer;

/// What a command does to a session; the key is the one that was pressed for it.
pub type Run = fn(&mut Session, Key) -> Vec<Effect>;

/// Something that a key can do.
#[derive(Clone, Copy, Debug)]
pub struct Command {
    /// Its name, for settings and the palette.
    pub name: &'static str,
    /// Where it applies, and its default keys there, the first one shown in the footer.
    pub keys: &'static [(Context, &'static [&'static str])],
    /// A word for the footer; empty where the footer has more important things to say. Commands with
    /// the same word share it.
    pub hint: &'static str,
    /// What it does, in one line for the help.
    pub doc: &'static str,
    /// Does it.
    pub run: Run,
}

impl PartialEq for Command {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name
    }
}

/// A row of the table.
const fn row(
    name: &'static str,
    keys: &'static [(Context, &'static [&'static str])],
    hint: &'static str,
    doc: &'static str,
    run: Run,
) -> Command {
    Command { name, keys, hint, doc, run }
}

/// Characters with which a number can begin.
const NUMERIC: &[&str] = &["0", "1", "2", "3", "4", "5", "6", "7", "8", "9", "-", "."];

/// Digits with which a count can begin where no number is typed.
const DIGITS: &[&str] = &["1", "2", "3", "4", "5", "6", "7", "8", "9"];

/// Digits with which a count goes on.
const MORE_DIGITS: &[&str] = &["0", "1", "2", "3", "4", "5", "6", "7", "8", "9"];

/// Every command, in the order in which the help lists them.
#[rustfmt::skip]
pub const COMMANDS: &[Command] = &[
    row("select-previous", &[(Parameters, &["<up>", "k"])], "select",
        "Select the row above", |s, _| parameters::select(s, -1)),
    row("select-next", &[(Parameters, &["<down>", "j"])], "select",
        "Select the row below", |s, _| parameters::select(s, 1)),
    row("step-down", &[(Parameters, &["<left>", "h"]), (Plots, &["<lt>"])], "step",
        "Step the selected value down by its step size", |s, _| parameters::step(s, -1)),
    row("step-up", &[(Parameters, &["<right>", "l"]), (Plots, &["<gt>"])], "step",
        "Step the selected value up by its step size", |s, _| parameters::step(s, 1)),
    row("step-far-down", &[(Parameters, &["<S-left>", "H"])], "",
        "Ten steps down", |s, _| parameters::step(s, -10)),
    row("step-far-up", &[(Parameters, &["<S-right>", "L"])], "",
        "Ten steps up", |s, _| parameters::step(s, 10)),
    row("step-size-smaller", &[(Parameters, &["["])], "step size",
        "Make the step smaller: 5, 2, 1 and so on", |s, _| parameters::step_size(s, false)),
    row("step-size-larger", &[(Parameters, &["]"])], "step size",
        "Make the step larger: 1, 2, 5 and so on", |s, _| parameters::step_size(s, true)),
    row("edit", &[(Parameters, &["<enter>"])], "type a value",
        "Edit the selected value", |s, _| entry::edit(s)),
    row("type-number", &[(Parameters, NUMERIC)], "",
        "Type a new value for the selected row", entry::begin),
    row("reset-value", &[(Parameters, &["r", "<backspace>", "<del>"])], "reset",
        "Give the selected row the scene's value and step", |s, _| parameters::reset_row(s)),

    row("start-here", &[(Phase, &["<enter>"]), (TimeSeries, &["<enter>"]), (ReturnMap, &["<enter>"])], "start here",
        "Start the motion at the cursor", |s, _| plots::start_here(s)),
    row("start-on-cycle", &[(EnergyLedger, &["<enter>"])], "start there",
        "Start the motion on the cycle that the cursor is at", |s, _| plots::start_here(s)),
    row("jump-here", &[(Diagram, &["<enter>"])], "jump here",
        "Give the diagram's parameter the value under the cursor", |s, _| plots::jump_here(s)),

    row("take-parameters", &[(Regimes, &["<enter>"])], "take these",
        "Give both parameters of the chart the values under the cursor", |s, _| plots::jump_here(s)),

    row("next-abscissa", &[(Diagram, &["X"])], "axes",
        "Draw the diagram over the next parameter: D, D2, D3, r", |s, _| axes::next_abscissa(s)),
    row("next-ordinate", &[(Diagram, &["Y"]), (Walk, &["Y"])], "axes",
        "Show the next property of the cycles: q_max, q_min, v_max and so on", |s, _| axes::next_ordinate(s)),
    row("next-chart-right", &[(Regimes, &["X"])], "axes",
        "Draw the chart over the next parameter to the right: D, D2, D3, r", |s, _| axes::next_of_chart(s, false)),
    row("next-chart-up", &[(Regimes, &["Y"])], "axes",
        "Draw the chart over the next parameter upwards", |s, _| axes::next_of_chart(s, true)),
    row("walk", &[(Diagram, &["w"])], "walk",
        "Take hold of the branch, at today's value or the cursor", |s, _| walk::take_hold(s)),
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
    row("walk-take", &[(Walk, &["<enter>"])], "take",
        "Take parameter and cycle of the point into the phase plane", |s, _| walk::take(s)),
    row("walk-let-go", &[(Walk, &["<esc>", "w"])], "let go",
        "Let go of the branch", |s, _| walk::let_go(s)),

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
    row("fit", &[(Plots, &["0"]), (Walk, &["0"])], "fit",
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
        "Give the focus to the next pane", |s, _| general::focus(s, 1)),
    row("previous-pane", &[(Everywhere, &["<S-tab>"])], "",
        "Give the focus to the previous pane", |s, _| general::focus(s, -1)),
    row("enlarge", &[(Everywhere, &["z"])], "",
        "Give one plot the place of all, or share it again", |s, _| general::enlarge(s)),
    row("views", &[(Everywhere, &["V"])], "view",
        "Pick what the plot in use shows", |s, _| lists::open_views(s)),
    row("next-view", &[(Everywhere, &[";"])], "",
        "Show the next view in the plot in use", |s, _| desk::next_view(s, 1)),
    row("previous-view", &[(Everywhere, &[","])], "",
        "Show the previous view in the plot in use", |s, _| desk::next_view(s, -1)),
    row("add-plot", &[(Everywhere, &["W"])], "",
        "Add a plot beside the one in use, up to four", |s, _| desk::add(s)),
    row("remove-plot", &[(Everywhere, &["Q"])], "",
        "Remove the plot in use", |s, _| desk::remove(s)),
    row("move-plot", &[(Everywhere, &["M"])], "",
        "Swap the plot in use with the next one", |s, _| desk::move_on(s)),
    row("arrange", &[(Everywhere, &["Z"])], "",
        "Arrange the plots: as suits them best, in columns, in rows", |s, _| desk::arrange(s)),
    row("help", &[(Everywhere, &["?", "<f1>"]), (Walk, &["?", "<f1>"])], "help",
        "List all keys", |s, _| lists::open_help(s)),
    row("palette", &[(Everywhere, &["<space>", "<C-p>"]), (Walk, &["<space>", "<C-p>"])], "all",
        "List all commands, to search one and run it", |s, _| palette::open(s)),
    row("prompt", &[(Everywhere, &[":"]), (Walk, &[":"])], "command",
        "Type a command by its name: set, scene, until and so on", |s, _| prompt::open(s)),
    row("scenes", &[(Everywhere, &["s"])], "scenes",
        "Pick a scene", |s, _| lists::open_scenes(s)),
    row("layers", &[(Everywhere, &["v"])], "layers",
        "List the layers, to switch them on and off", |s, _| lists::open_layers(s)),
    row("undo", &[(Everywhere, &["u"]), (Walk, &["u"])], "undo",
        "Undo the last change of a parameter or scene", |s, _| general::undo(s)),
    row("redo", &[(Everywhere, &["<C-r>", "U"])], "",
        "Redo what was undone", |s, _| general::redo(s)),
    row("start-inside", &[(Everywhere, &["i"])], "in/outside",
        "Start just inside the edge of the basin", |s, _| starts::beside_edge(s, starts::INSIDE)),
    row("start-outside", &[(Everywhere, &["o"])], "in/outside",
        "Start just outside the edge of the basin", |s, _| starts::beside_edge(s, starts::OUTSIDE)),
    row("unfold", &[(Everywhere, &["x"])], "unfold",
        "Show the parameters that the scene does not need, or hide them", |s, _| parameters::unfold(s)),
    row("reset-scene", &[(Everywhere, &["R"])], "",
        "Bring the scene back as it was opened", |s, _| general::reset_scene(s)),
    row("coarser", &[(Everywhere, &["{"])], "",
        "Compute less exactly: ten times the tolerance", |s, _| parameters::dial(s, 1)),
    row("finer", &[(Everywhere, &["}"])], "",
        "Compute more exactly: a tenth of the tolerance", |s, _| parameters::dial(s, -1)),
    row("next-method", &[(Everywhere, &["m"])], "",
        "Integrate by the next method", |s, _| parameters::next_method(s, 1)),

    row("toggle-trajectory", &[(Everywhere, &["t"])], "",
        "Show or hide the motion", |s, _| general::toggle(s, Layer::Trajectory)),
    row("toggle-sticking", &[(Everywhere, &["e"])], "",
        "Show or hide the equilibria (the sticking set)", |s, _| general::toggle(s, Layer::Sticking)),
    row("toggle-cycles", &[(Everywhere, &["c"])], "",
        "Show or hide the limit cycles", |s, _| general::toggle(s, Layer::Cycles)),
    row("toggle-basin", &[(Everywhere, &["b"])], "",
        "Show or hide the basin of the sticking set", |s, _| general::toggle(s, Layer::Basin)),
    row("toggle-field", &[(Everywhere, &["d"])], "",
        "Show or hide the directions of the flow", |s, _| general::toggle(s, Layer::Field)),
    row("toggle-lyapunov", &[(Everywhere, &["y"])], "",
        "Show or hide the Lyapunov circle", |s, _| general::toggle(s, Layer::Lyapunov)),
    row("toggle-bands", &[(Everywhere, &["f"])], "",
        "Show or hide the bands of capture: half swings until rest", |s, _| general::toggle(s, Layer::Bands)),
    row("toggle-balance", &[(Everywhere, &["N"])], "",
        "Show or hide the cycles of N harmonics", |s, _| general::toggle(s, Layer::Balance)),
    row("toggle-ghost", &[(Phase, &["G"])], "",
        "Show or hide the point left for a mark", |s, _| general::toggle(s, Layer::Ghost)),
    row("fewer-harmonics", &[(Everywhere, &["("])], "",
        "Fewer harmonics", |s, _| general::harmonics(s, false)),
    row("more-harmonics", &[(Everywhere, &[")"])], "",
        "More harmonics", |s, _| general::harmonics(s, true)),
    row("toggle-branch", &[(Everywhere, &["n"])], "",
        "Show or hide the computed cycles in the diagram", |s, _| general::toggle(s, Layer::Branch)),
    row("toggle-harmonic", &[(Everywhere, &["a"])], "",
        "Show or hide the first-order harmonic amplitudes", |s, _| general::toggle(s, Layer::Harmonic)),
    row("toggle-asymptotes", &[(Everywhere, &["S"])], "",
        "Show or hide the asymptotes A1 and A2", |s, _| general::toggle(s, Layer::Asymptotes)),
    row("toggle-special", &[(Everywhere, &["p"])], "",
        "Show or hide the labels of special points", |s, _| general::toggle(s, Layer::Special)),
    row("toggle-position", &[(TimeSeries, &["P"])], "",
        "Show or hide the displacement", |s, _| general::toggle(s, Layer::Position)),
    row("toggle-velocity", &[(TimeSeries, &["I"])], "",
        "Show or hide the velocity", |s, _| general::toggle(s, Layer::Velocity)),
    row("toggle-friction", &[(TimeSeries, &["F"])], "",
        "Show or hide the force of dry friction", |s, _| general::toggle(s, Layer::Friction)),
    row("toggle-energy", &[(TimeSeries, &["E"])], "",
        "Show or hide the energy", |s, _| general::toggle(s, Layer::Energy)),
    row("toggle-events", &[(TimeSeries, &["G"])], "",
        "Show or hide turning points and capture", |s, _| general::toggle(s, Layer::Events)),
    row("toggle-cycle-works", &[(EnergyLedger, &["P"])], "",
        "Show or hide the works over a turn of each cycle", |s, _| general::toggle(s, Layer::CycleWorks)),
    row("toggle-motion-works", &[(EnergyLedger, &["I"])], "",
        "Show or hide the works along the motion", |s, _| general::toggle(s, Layer::MotionWorks)),
    row("toggle-map", &[(ReturnMap, &["F"])], "",
        "Show or hide the map", |s, _| general::toggle(s, Layer::Map)),
    row("toggle-cobweb", &[(ReturnMap, &["G"])], "",
        "Show or hide the cobweb of the motion", |s, _| general::toggle(s, Layer::Cobweb)),
    row("toggle-fixed-points", &[(ReturnMap, &["P"])], "",
        "Show or hide the limit cycles as fixed points", |s, _| general::toggle(s, Layer::FixedPoints)),
    row("toggle-regimes", &[(Regimes, &["F"])], "",
        "Show or hide what becomes of kicks", |s, _| general::toggle(s, Layer::Regimes)),
    row("toggle-borders", &[(Regimes, &["G"])], "",
        "Show or hide the computed borders", |s, _| general::toggle(s, Layer::Borders)),
    row("toggle-harmonic-border", &[(Regimes, &["P"])], "",
        "Show or hide the border by one harmonic (48)", |s, _| general::toggle(s, Layer::HarmonicBorder)),

    row("count", &[(Plots, DIGITS), (Walk, DIGITS), (Lists, DIGITS), (Count, MORE_DIGITS)], "",
        "A digit: press the next key so many times, as one change", pending::count),
    row("begin-count", &[(Everywhere, &["*"]), (Walk, &["*"]), (Lists, &["*"])], "",
        "Begin a count where digits are values: *12 and a key", pending::count),
    row("delete-digit", &[(Count, &["<backspace>"])], "",
        "Delete the last digit of the count", |s, _| pending::delete_digit(s)),
    row("forget-pending", &[(Count, &["<esc>"]), (Letter, &["<esc>"])], "forget",
        "Forget the count, or the question for a letter", |s, _| pending::drop(s)),
    row("set-mark", &[(Everywhere, &["\""])], "",
        "Mark this point by a letter: parameters, start, method", |s, _| pending::ask(s, Ask::Mark)),
    row("go-to-mark", &[(Everywhere, &["'"])], "",
        "Go to a mark; twice: to the point left last", |s, _| pending::ask(s, Ask::GoTo)),
    row("record-macro", &[(Everywhere, &["&"])], "",
        "Record keys into a register; again: end that", |s, _| macros::record_or_end(s)),
    row("play-macro", &[(Everywhere, &["@"])], "",
        "Play the keys of a register; twice: the last one again", |s, _| pending::ask(s, Ask::Play)),

    row("retry", &[(Everywhere, &["<f5>"])], "",
        "Compute again what has failed", |s, _| general::retry(s)),
    row("copy-command", &[(Always, &["<C-y>"])], "",
        "Copy the command line that gives the numbers of this pane", |s, _| copy::command(s)),
    row("copy-screen", &[(Always, &["<A-y>"])], "",
        "Copy the characters on the screen", |_, _| vec![Effect::CopyScreen]),
    row("glyphs", &[(Everywhere, &["g"])], "",
        "Draw with other characters: braille, octants, blocks, ASCII", |s, _| general::glyphs(s)),
    row("mouse", &[(Everywhere, &["<f2>"])], "",
        "Let the mouse start motions and zoom, or leave it to the terminal", |s, _| mouse::toggle(s)),
    row("theme", &[(Everywhere, &["T"])], "",
        "Use the next theme", |s, _| general::theme(s)),
    row("drop-cursor", &[(Everywhere, &["<esc>"])], "",
        "Drop the cursor; never leaves, never discards", |s, _| plots::drop_cursor(s)),
    row("back", &[(Lists, &["<esc>", "q"]), (Entry, &["<esc>"]), (Prompt, &["<esc>"]), (Offer, &["<esc>"])], "close",
        "Close what is open", |s, _| general::back(s)),
    row("close-again", &[(Help, &["?", "<f1>"]), (Scenes, &["s"]), (Layers, &["v"]), (Views, &["V"])], "",
        "Close with the key that opened", |s, _| general::back(s)),
    row("quit", &[(Everywhere, &["q"]), (Walk, &["q"]), (Always, &["<C-c>"])], "quit",
        "Leave", |s, _| general::quit(s)),

    row("list-up", &[(Lists, &["<up>", "k"]), (Search, &["<up>"])], "move",
        "Move up in a list", |s, _| lists::move_by(s, -1)),
    row("list-down", &[(Lists, &["<down>", "j"]), (Search, &["<down>"])], "move",
        "Move down in a list", |s, _| lists::move_by(s, 1)),
    row("list-page-up", &[(Lists, &["<pgup>", "<C-b>"]), (Search, &["<pgup>"])], "page",
        "Move ten rows up", |s, _| lists::move_by(s, -lists::PAGE)),
    row("list-page-down", &[(Lists, &["<pgdn>", "<C-f>"]), (Search, &["<pgdn>"])], "page",
        "Move ten rows down", |s, _| lists::move_by(s, lists::PAGE)),
    row("list-first", &[(Lists, &["<home>", "g"])], "",
        "Go to the first row", |s, _| lists::move_by(s, isize::MIN)),
    row("list-last", &[(Lists, &["<end>", "G"])], "",
        "Go to the last row", |s, _| lists::move_by(s, isize::MAX)),
    row("search", &[(Lists, &["/"])], "search",
        "Show only the rows that contain some text", |s, _| lists::search(s)),
    row("open-scene", &[(Scenes, &["<enter>", "<space>"])], "open",
        "Open the selected scene", |s, _| lists::choose(s)),
    row("toggle-layer", &[(Layers, &["<enter>", "<space>"])], "on/off",
        "Switch the selected layer on or off", |s, _| lists::choose(s)),
    row("show-view", &[(Views, &["<enter>", "<space>"])], "show",
        "Show the selected view", |s, _| lists::choose(s)),
    row("run-command", &[(Palette, &["<enter>", "<space>"])], "run",
        "Run the selected command", palette::choose),
    row("close-help", &[(Help, &["<enter>"])], "",
        "Close the help", |s, _| general::back(s)),
    row("search-done", &[(Search, &["<enter>"])], "done",
        "Keep the rows found; in a picker, take the selected one", lists::search_done),
    row("search-drop", &[(Search, &["<esc>"])], "all rows",
        "Show all rows again", |s, _| lists::search_drop(s)),
    row("search-delete", &[(Search, &["<backspace>"])], "",
        "Delete the last character of the search", |s, _| lists::search_delete(s)),
    row("search-clear", &[(Search, &["<C-u>"])], "",
        "Clear the search", |s, _| lists::search_clear(s)),

    row("accept", &[(Entry, &["<enter>"])], "accept",
        "Take the typed value", |s, _| entry::accept(s)),
    row("run-line", &[(Prompt, &["<enter>"])], "accept",
        "Run the typed command", |s, _| prompt::accept(s)),
    row("complete", &[(Prompt, &["<tab>"])], "complete",
        "Complete the word; again, its next possibility", |s, _| prompt::complete(s, 1)),
    row("complete-back", &[(Prompt, &["<S-tab>"])], "",
        "Complete the word by the possibility before", |s, _| prompt::complete(s, -1)),
    row("older-line", &[(Prompt, &["<up>", "<C-p>"])], "history",
        "Get the line typed before this one", |s, _| prompt::recall(s, 1)),
    row("newer-line", &[(Prompt, &["<down>", "<C-n>"])], "history",
        "Get the line typed after this one", |s, _| prompt::recall(s, -1)),
    row("clear", &[(Entry, &["<C-u>"]), (Prompt, &["<C-u>"])], "clear",
        "Clear the line", |s, _| typing::with(s, Input::clear)),
    row("delete-word", &[(Entry, &["<C-w>"]), (Prompt, &["<C-w>"])], "",
        "Delete the word before the caret", |s, _| typing::with(s, Input::delete_word)),
    row("delete-before", &[(Entry, &["<backspace>"]), (Prompt, &["<backspace>"])], "",
        "Delete the character before the caret", |s, _| typing::with(s, Input::delete_before)),
    row("delete-after", &[(Entry, &["<del>"]), (Prompt, &["<del>"])], "",
        "Delete the character after the caret", |s, _| typing::with(s, Input::delete_after)),
    row("caret-left", &[(Entry, &["<left>"]), (Prompt, &["<left>"])], "",
        "Move the caret left", |s, _| typing::with(s, |i| i.move_caret(-1))),
    row("caret-right", &[(Entry, &["<right>"]), (Prompt, &["<right>"])], "",
        "Move the caret right", |s, _| typing::with(s, |i| i.move_caret(1))),
    row("caret-home", &[(Entry, &["<home>", "<C-a>"]), (Prompt, &["<home>", "<C-a>"])], "",
        "Move the caret to the beginning", |s, _| typing::with(s, |i| i.move_caret(isize::MIN))),
    row("caret-end", &[(Entry, &["<end>", "<C-e>"]), (Prompt, &["<end>", "<C-e>"])], "",
        "Move the caret to the end", |s, _| typing::with(s, |i| i.move_caret(isize::MAX))),

    row("replay-pasted", &[(Offer, &["<enter>", "y"])], "replay",
        "Press the pasted keys", |s, _| general::accept_offer(s)),
    row("forget-pasted", &[(Offer, &["n", "q"])], "",
        "Forget the pasted keys", |s, _| general::back(s)),

    row("suspend", &[(Always, &["<C-z>"])], "",
        "Suspend; fg comes back", |_, _| vec![Effect::Suspend]),
    row("repaint", &[(Always, &["<C-l>"])], "",
        "Draw the whole screen again", |_, _| vec![Effect::Repaint]),
];

/// The command with this name.
#[must_use]
pub fn command(name: &str) -> Option<&'static Command> {
    COMMANDS.iter().find(|command| command.name == name)
}

#[cfg(test)]
mod tests {
    use std::collections::{BTreeMap, BTreeSet};

    use super::*;
    use crate::scene::LAYERS;
    use crate::session::keymap::{CHAINS, Keymap};

    /// Every default key with its context and command.
    fn bindings() -> impl Iterator<Item = (Context, Key, &'static str)> {
        COMMANDS.iter().flat_map(|command| {
            command.keys.iter().flat_map(move |(context, keys)| {
                keys.iter().map(move |text| {
                    let key = text.parse().unwrap_or_else(|error| panic!("{text}: {error}"));
                    (*context, key, command.name)
                })
            })
        })
    }

    #[test]
    fn no_key_means_two_things_where_contexts_hold_together() {
        for chain in CHAINS {
            let mut meanings = BTreeMap::new();
            for (_, key, name) in bindings().filter(|(context, ..)| chain.contains(context)) {
                if let Some(other) = meanings.insert(key, name) {
                    panic!("{key} means {other} and {name} in {chain:?}");
                }
            }
        }
    }

    #[test]
    fn every_command_has_a_name_of_its_own_a_key_and_one_line_of_explanation() {
        let names: BTreeSet<_> = COMMANDS.iter().map(|command| command.name).collect();
        assert_eq!(names.len(), COMMANDS.len());
        for Command { name, keys, doc, .. } in COMMANDS {
            assert!(keys.iter().any(|(_, keys)| !keys.is_empty()), "{name} has no key");
            assert!(doc.len() > 4 && doc.len() <= 72, "{name}: {doc}");
            assert!(doc.starts_with(char::is_uppercase) && !doc.ends_with('.'), "{name}: {doc}");
        }
    }

    #[test]
    fn every_default_key_does_in_the_keymap_what_its_row_says() {
        let keymap = Keymap::default();
        for (context, key, name) in bindings() {
            assert_eq!(keymap.command(&[context], key).map(|command| command.name), Some(name));
        }
    }

    #[test]
    fn every_layer_has_a_command() {
        for layer in &LAYERS {
            assert!(command(&format!("toggle-{}", layer.name)).is_some(), "{}", layer.name);
        }
    }

    #[test]
    fn an_arrow_key_that_arrives_in_pieces_destroys_nothing() {
        // Over a slow line <up> can come as <esc>, [, A; application mode sends O in place of [.
        for (context, key, name) in bindings() {
            let piece = key.typed().is_some_and(|char| "OABCD".contains(char));
            assert!(!piece, "{name} is bound to {key} in {context:?}");
        }
        for (_, key, name) in bindings() {
            if key.typed() == Some('[') {
                assert_eq!(name, "step-size-smaller");
            }
            if key.to_string() == "<esc>" {
                assert!(
                    ["back", "drop-cursor", "search-drop", "walk-let-go", "forget-pending"]
                        .contains(&name),
                    "{name}"
                );
            }
        }
    }
}
