//! The commands: one table that feeds the keys, the command line, the help and the footer, and decides what a key does.
//!
//! A command is a line of `assets/commands.txt`, which says its name, its keys and what it does, a row here, and one small
//! function in `session::act`. Every command of a key can also be typed by its name. A line is run completely or not at
//! all, and a refused line says what is allowed.

use std::sync::{Arc, LazyLock};

use crate::scene::machine::library::machines;
use crate::scene::{LAYERS, Layer, LayerSpec, Scene, VIEWS, library};
use crate::session::Listed::{Cost, Layers, Palette as Everything, Paper, Scenes, Views};
use crate::session::act::{
    copy, files, general, history, lists, motions, parameters, plots, prompt, scan, screen_setup,
    values, walk,
};
use crate::session::read::completion;
use crate::session::settings::{Colors, Glyphs, Theme, choices};
use crate::session::state::keymap::CommandAction::{self, Act, Choose, Line, Toggle, Try};
use crate::session::state::keymap::contexts;
use crate::session::{
    Command, Context, Effect, Input, Key, Keymap, Letter as Ask, Pending, Purpose, Session, Size,
};

/// What each command does, by its name, or by its name behind a colon if it takes words.
#[rustfmt::skip]
const ACTIONS: &[(&str, CommandAction)] = &[
    ("select-previous", Act(|s, _| parameters::select(s, -1))),
    ("select-next", Act(|s, _| parameters::select(s, 1))),
    ("step-down", Try(|s| parameters::step(s, -1))),
    ("step-up", Try(|s| parameters::step(s, 1))),
    ("step-far-down", Try(|s| parameters::step(s, -10))),
    ("step-far-up", Try(|s| parameters::step(s, 10))),
    ("step-size-smaller", Try(|s| parameters::step_size(s, false))),
    ("step-size-larger", Try(|s| parameters::step_size(s, true))),
    ("narrower", Try(|s| parameters::half_width(s, -1))),
    ("wider", Try(|s| parameters::half_width(s, 1))),
    ("edit", Act(|s, _| parameters::edit(s))),
    ("type-number", Act(parameters::begin)),
    ("reset-value", Act(|s, _| parameters::reset_row(s))),

    ("start-here", Try(plots::start_here)),
    ("start-on-cycle", Try(plots::start_here)),
    ("use-method", Try(plots::use_method)),
    ("jump-here", Try(plots::jump_here)),

    ("take-parameters", Try(plots::jump_here)),

    ("next-abscissa", Act(|s, _| plots::next_parameter(s, false))),
    ("next-ordinate", Act(|s, _| plots::next_ordinate(s))),
    ("next-chart-right", Act(|s, _| plots::next_parameter(s, false))),
    ("next-chart-up", Act(|s, _| plots::next_parameter(s, true))),
    ("next-unit", Try(plots::next_unit)),
    ("walk", Try(walk::take_hold)),
    ("walk-back", Act(|s, _| walk::go(s, -1))),
    ("walk-on", Act(|s, _| walk::go(s, 1))),
    ("walk-far-back", Act(|s, _| walk::go(s, -walk::FAR))),
    ("walk-far-on", Act(|s, _| walk::go(s, walk::FAR))),
    ("walk-to-next", Act(|s, _| walk::go_to_landmark(s, true))),
    ("walk-to-previous", Act(|s, _| walk::go_to_landmark(s, false))),
    ("walk-to-first", Act(|s, _| walk::go(s, isize::MIN))),
    ("walk-to-last", Act(|s, _| walk::go(s, isize::MAX))),
    ("walk-take", Try(walk::take)),
    ("walk-let-go", Act(|s, _| s.held = None)),

    ("scan", Act(|s, _| scan::open(s))),
    ("scan-back", Try(|s| scan::go(s, -1, 0))),
    ("scan-on", Try(|s| scan::go(s, 1, 0))),
    ("scan-up", Try(|s| scan::go(s, 0, 1))),
    ("scan-down", Try(|s| scan::go(s, 0, -1))),
    ("scan-far-back", Try(|s| scan::go(s, -scan::PAGE, 0))),
    ("scan-far-on", Try(|s| scan::go(s, scan::PAGE, 0))),
    ("scan-first", Try(|s| scan::go(s, isize::MIN, 0))),
    ("scan-last", Try(|s| scan::go(s, isize::MAX, 0))),
    ("scan-take", Try(scan::take)),
    ("scan-column", Try(|s| scan::next_column(s, 1))),
    ("scan-column-back", Try(|s| scan::next_column(s, -1))),
    ("scan-table", Try(scan::table)),
    ("scan-pause", Try(scan::pause)),
    ("scan-save", Try(|s| scan::save(s, scan::FILE))),

    ("cursor-left", Act(|s, _| plots::move_cursor(s, -1, 0))),
    ("cursor-right", Act(|s, _| plots::move_cursor(s, 1, 0))),
    ("cursor-up", Act(|s, _| plots::move_cursor(s, 0, 1))),
    ("cursor-down", Act(|s, _| plots::move_cursor(s, 0, -1))),
    ("cursor-far-left", Act(|s, _| plots::move_cursor(s, -plots::FAR, 0))),
    ("cursor-far-right", Act(|s, _| plots::move_cursor(s, plots::FAR, 0))),
    ("cursor-far-up", Act(|s, _| plots::move_cursor(s, 0, plots::FAR))),
    ("cursor-far-down", Act(|s, _| plots::move_cursor(s, 0, -plots::FAR))),
    ("zoom-in", Act(|s, _| plots::zoom(s, true))),
    ("zoom-out", Act(|s, _| plots::zoom(s, false))),
    ("fit-window", Act(|s, _| plots::fit(s))),
    ("home", Act(|s, _| plots::home(s))),
    ("pan-left", Act(|s, _| plots::pan(s, -1, 0))),
    ("pan-down", Act(|s, _| plots::pan(s, 0, -1))),
    ("pan-up", Act(|s, _| plots::pan(s, 0, 1))),
    ("pan-right", Act(|s, _| plots::pan(s, 1, 0))),

    ("next-pane", Act(|s, _| screen_setup::focus(s, 1))),
    ("previous-pane", Act(|s, _| screen_setup::focus(s, -1))),
    ("enlarge", Act(|s, _| s.enlarged = !s.enlarged)),
    ("paper", Act(|s, _| lists::open(s, Paper))),
    ("views", Act(|s, _| lists::open(s, Views))),
    ("next-view", Act(|s, _| screen_setup::next_view(s, 1))),
    ("previous-view", Act(|s, _| screen_setup::next_view(s, -1))),
    ("add-plot", Try(screen_setup::add)),
    ("remove-plot", Try(screen_setup::remove)),
    ("move-plot", Try(screen_setup::move_on)),
    ("arrange", Act(|s, _| screen_setup::arrange(s))),
    ("help", Act(|s, _| lists::open(s, Everything))),
    ("palette", Act(|s, _| {
            lists::open(s, Everything);
            lists::search(s);
        })),
    ("prompt", Act(|s, _| prompt::open(s, ""))),
    ("scenes", Act(|s, _| lists::open(s, Scenes))),
    ("layers", Act(|s, _| lists::open(s, Layers))),
    ("undo", Try(history::undo)),
    ("redo", Try(history::redo)),
    ("start-inside", Try(|s| motions::beside_edge(s, motions::INSIDE))),
    ("start-outside", Try(|s| motions::beside_edge(s, motions::OUTSIDE))),
    ("drop-motion", Try(motions::drop_newest)),
    ("drop-other-motions", Try(motions::drop_others)),
    ("play-motion", Try(motions::play)),
    ("motion-on", Try(|s| motions::step(s, 1.0))),
    ("motion-back", Try(|s| motions::step(s, -1.0))),
    ("motion-pace", Act(|s, _| motions::pace(s))),
    ("unfold", Act(|s, _| s.unfolded = !s.unfolded)),
    ("reset-scene", Act(|s, _| history::reset_scene(s))),
    ("coarser", Try(|s| parameters::dial(s, false))),
    ("finer", Try(|s| parameters::dial(s, true))),
    ("next-method", Act(|s, _| parameters::next_method(s, 1))),

    ("fewer-harmonics", Try(|s| general::harmonics(s, false))),
    ("more-harmonics", Try(|s| general::harmonics(s, true))),
    ("take-speed", Try(plots::jump_here)),

    ("count", Act(general::count)),
    ("begin-count", Act(general::count)),
    ("delete-digit", Act(|s, _| general::delete_digit(s))),
    ("forget-pending", Act(|s, _| s.pending = None)),
    ("set-mark", Act(|s, _| s.pending = Some(Pending::Letter(Ask::Mark)))),
    ("go-to-mark", Act(|s, _| s.pending = Some(Pending::Letter(Ask::GoTo)))),

    ("explain", Act(|s, _| s.caption.explain())),
    ("tour", Try(files::tour)),
    ("restore", Try(files::restore)),
    ("forget-interrupted", Try(files::forget)),
    ("restore-selected", Act(|s, _| files::restore_selected(s))),
    ("forget-one", Try(files::forget_selected)),
    ("forget-all", Try(files::forget)),

    ("costs", Act(|s, _| lists::open(s, Cost))),
    ("retry", Act(|s, _| general::retry(s))),
    ("save-figure", Act(|s, _| files::offer_figure(s))),
    ("copy-command", Act(|s, _| s.effects.push(Effect::Copy(copy::command_line(s))))),
    ("copy-number", Try(copy::number)),
    ("copy-row", Try(copy::row)),
    ("copy-screen", Act(|s, _| s.effects.push(Effect::CopyScreen))),
    ("glyphs", Act(|s, _| general::turn(s, "glyphs", |it| &mut it.glyphs))),
    ("units", Act(|s, _| general::units(s))),
    ("equal", Act(|s, _| general::equal(s))),
    ("mouse", Act(|s, _| plots::toggle_mouse(s))),
    ("theme", Act(|s, _| general::turn(s, "theme", |it| &mut it.theme))),
    ("drop-cursor", Act(|s, _| plots::drop_cursor(s))),
    ("back", Act(|s, _| s.overlay = None)),
    ("close-again", Act(|s, _| s.overlay = None)),
    ("quit", Act(|s, _| general::quit(s))),

    ("list-up", Act(|s, _| lists::move_by(s, -1))),
    ("list-down", Act(|s, _| lists::move_by(s, 1))),
    ("list-page-up", Act(|s, _| lists::move_by(s, -lists::PAGE))),
    ("list-page-down", Act(|s, _| lists::move_by(s, lists::PAGE))),
    ("list-first", Act(|s, _| lists::move_by(s, isize::MIN))),
    ("list-last", Act(|s, _| lists::move_by(s, isize::MAX))),
    ("search", Act(|s, _| lists::search(s))),
    ("open-scene", Choose(prompt::choose)),
    ("toggle-letter", Act(lists::toggle_letter)),
    ("toggle-layer", Choose(prompt::choose)),
    ("show-claim", Choose(prompt::choose)),
    ("show-view", Choose(prompt::choose)),
    ("run-command", Choose(prompt::choose)),
    ("search-done", Choose(prompt::search_done)),
    ("search-drop", Act(|s, _| lists::search_drop(s))),
    ("search-delete", Act(|s, _| lists::search_with(s, |it| _ = it.pop()))),
    ("search-clear", Act(|s, _| lists::search_with(s, String::clear))),

    ("accept", Choose(|s| Ok(prompt::accept(s)))),
    ("run-line", Choose(|s| Ok(prompt::accept(s)))),
    ("complete", Act(|s, _| prompt::complete(s, 1))),
    ("complete-back", Act(|s, _| prompt::complete(s, -1))),
    ("older-line", Act(|s, _| prompt::recall(s, 1))),
    ("newer-line", Act(|s, _| prompt::recall(s, -1))),
    ("clear", Act(|s, _| prompt::with(s, |i| *i = Input::default()))),
    ("delete-word", Act(|s, _| prompt::with(s, Input::delete_word))),
    ("delete-before", Act(|s, _| prompt::with(s, |i| _ = i.before.pop()))),
    ("delete-after", Act(|s, _| prompt::with(s, Input::delete_after))),
    ("caret-left", Act(|s, _| prompt::with(s, |i| i.move_caret(-1)))),
    ("caret-right", Act(|s, _| prompt::with(s, |i| i.move_caret(1)))),
    ("caret-home", Act(|s, _| prompt::with(s, |i| i.move_caret(isize::MIN)))),
    ("caret-end", Act(|s, _| prompt::with(s, |i| i.move_caret(isize::MAX)))),

    ("replay-pasted", Act(|s, _| general::accept_offer(s))),
    ("forget-pasted", Act(|s, _| s.overlay = None)),

    ("suspend", Act(|s, _| s.effects.push(Effect::Suspend))),
    ("repaint", Act(|s, _| s.effects.push(Effect::Repaint))),

    (":set", Line(completion::assignments, values::set)),
    (":method", Line(completion::methods, |s, rest| values::set_row(s, "method", rest))),
    (":tol", Line(completion::nothing, |s, rest| values::set_row(s, "tolerance", rest))),
    (":until", Line(completion::nothing, |s, rest| values::set_row(s, "until", rest))),
    (":scene", Line(|_, _| completion::all(library::names()), values::scene)),
    (":belt", Line(|_, _| completion::all(machines().iter().map(|it| &it.name)), values::belt)),
    (":machine", Line(completion::nothing, |s, rest| files::ask(s, rest, Purpose::Machine))),
    (":view", Line(|_, _| completion::all(VIEWS.iter().map(|row| row.name)), values::view)),
    (":layer", Line(completion::layers, values::layer)),
    (":window", Line(completion::window, values::window)),
    (":axes", Line(completion::axes, values::axes)),
    (":scan", Line(completion::scan, scan::scan)),
    (":save-scan", Line(completion::nothing, scan::save)),
    (":harmonics", Line(completion::nothing, values::harmonics)),
    (":kicks", Line(completion::nothing, values::kicks)),
    (":mark", Line(|s, _| completion::all(s.marks.places.keys()), |s, rest| values::letter(rest).map(|name| history::set_mark(s, name)))),
    (":goto", Line(|s, _| completion::all(s.marks.places.keys()), |s, rest| history::go_to_mark(s, values::letter(rest)?))),
    (":write", Line(completion::nothing, |s, rest| files::write(s, rest, false))),
    (":write!", Line(completion::nothing, |s, rest| files::write(s, rest, true))),
    (":open", Line(completion::nothing, |s, rest| files::ask(s, rest, Purpose::Open))),
    (":fit", Line(completion::nothing, files::fit)),
    (":figure", Line(completion::nothing, |s, rest| files::figure(s, rest, None, false))),
    (":figure!", Line(completion::nothing, |s, rest| files::figure(s, rest, None, true))),
    (":figure-pane", Line(completion::nothing, |s, rest| files::figure(s, rest, Some(s.plot), false))),
    (":figure-pane!", Line(completion::nothing, |s, rest| files::figure(s, rest, Some(s.plot), true))),
    (":record", Line(completion::nothing, |s, rest| files::record(s, rest, false))),
    (":record!", Line(completion::nothing, |s, rest| files::record(s, rest, true))),
    (":play", Line(completion::nothing, |s, rest| files::ask(s, rest, Purpose::Play))),
    (":theme", Line(|_, _| completion::all(choices::<Theme>().map(|row| row.0)), |s, name| values::choice(name).map(|it| s.display.theme = it))),
    (":units", Line(completion::switch, |s, state| values::is_on("units", state).map(|on| s.display.dimensionless = !on))),
    (":equal", Line(completion::switch, |s, state| values::is_on("equal units", state).map(|on| s.display.stretched = !on))),
    (":glyphs", Line(|_, _| completion::all(choices::<Glyphs>().map(|row| row.0)), |s, name| values::choice(name).map(|it| s.display.glyphs = it))),
    (":color", Line(|_, _| completion::all(choices::<Colors>().map(|row| row.0)), |s, name| values::choice(name).map(|it| s.display.colors = it))),
];

/// All commands, in the order in which the help lists them.
fn table() -> &'static [Command] {
    static COMMANDS: LazyLock<Vec<Command>> = LazyLock::new(|| {
        let lines = include_str!("../../assets/commands.txt").lines();
        let (keys, words): (Vec<_>, Vec<_>) =
            lines.filter_map(command).partition(|command| command.words().is_none());
        keys.into_iter().chain(LAYERS.iter().map(toggle)).chain(words).collect()
    });
    &COMMANDS
}

/// The command that a line of the file describes; `None` for a comment. A test reads every line.
fn command(line: &'static str) -> Option<Command> {
    let (name, rest) = line.split_once(" | ")?;
    let (place, rest) = rest.split_once(" | ")?;
    let run = ACTIONS.iter().find(|row| row.0 == name)?.1;
    Some(match (name.strip_prefix(':'), rest.split_once(" | ")) {
        (Some(name), _) => {
            Command { name, keys: Vec::new(), hint: "", doc: rest, arguments: place, run }
        }
        (None, described) => {
            let (hint, doc) = described?;
            let hint = if hint == "-" { "" } else { hint };
            Command { name, keys: keys(place), hint, doc, arguments: "", run }
        }
    })
}

/// Contexts by their names, each followed by the keys there.
fn keys(text: &str) -> Vec<(Context, Vec<Key>)> {
    let mut places: Vec<(Context, Vec<Key>)> = Vec::new();
    for word in text.split_whitespace() {
        match (contexts().find(|row| row.name == word), places.last_mut()) {
            (Some(row), _) => places.push((row.context, Vec::new())),
            (None, Some((_, keys))) => keys.extend(word.parse::<Key>()),
            (None, None) => {}
        }
    }
    places
}

/// The command of a layer. Only that of the whole model has a default key, because it changes what all views draw; the
/// others get keys from the user's settings.
fn toggle(spec: &LayerSpec) -> Command {
    // The names must live as long as the program, like those of the other commands.
    let leaked = |text: String| -> &'static str { Box::leak(text.into_boxed_str()) };
    Command {
        name: leaked(format!("toggle-{}", spec.name)),
        keys: keys(if spec.layer == Layer::Whole { "everywhere |" } else { "everywhere" }),
        hint: "",
        doc: leaked(format!("Show or hide {}", spec.meaning)),
        arguments: "",
        run: Toggle(spec.layer),
    }
}

/// Every command of keys, in the order in which the help lists them.
pub fn commands() -> impl Iterator<Item = &'static Command> {
    table().iter().filter(|command| command.words().is_none())
}

impl Default for Keymap {
    /// The default keys of every command.
    fn default() -> Self {
        Keymap::new(table().iter())
    }
}

impl Session {
    /// A session that has just opened a scene, with the default keys.
    pub fn new(scene: Arc<Scene>, size: Size) -> Self {
        Session::opened(scene, size, Arc::new(Keymap::default()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_line_of_the_file_has_a_function_and_keys_that_can_be_read() {
        let lines = include_str!("../../assets/commands.txt").lines();
        let lines: Vec<_> = lines.filter(|line| line.contains(" | ")).collect();
        let named = |line: &&str| line.split(" | ").next().unwrap().to_owned();
        let named: Vec<_> = lines.iter().map(named).collect();
        assert_eq!(named, ACTIONS.iter().map(|row| row.0.to_owned()).collect::<Vec<_>>());
        assert_eq!(lines.iter().filter_map(|line| command(line)).count(), lines.len());
        for line in lines.into_iter().filter(|line| !line.starts_with(':')) {
            let [_, words, ..] = line.split(" | ").collect::<Vec<_>>()[..] else {
                panic!("{line}")
            };
            let read = keys(words).iter().map(|(_, keys)| 1 + keys.len()).sum::<usize>();
            assert_eq!(read, words.split_whitespace().count(), "{line}");
        }
    }
}
