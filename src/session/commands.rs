//! The commands: one table that feeds the keys, the command line, the help and the footer, and decides what a key does.
//!
//! A command is a line of `assets/commands.txt`, which says its name, its keys and what it does, with a row here and
//! one small function in `session::act` for what no other command does. Every command of a key can also be typed by
//! its name. A line is run completely or not at all, and a refused line says what is allowed.

use std::sync::LazyLock;

use crate::scene::machine::library::machines;
use crate::scene::{LAYERS, Layer, LayerSpec, VIEWS, library};
use crate::session::CommandAction::{self, Act, Line, Move, Press, Toggle, Try};
use crate::session::ListKind::{Cost, Layers, Paper, Scenes, Views};
use crate::session::act::{
    compare, copy, files, general, history, kick, lists, motions, parameters, plots, prompt, scan,
    screen_setup, values, walk,
};
use crate::session::read::completion::{self, all, nothing};
use crate::session::{
    COMMANDS, Colors, Command, Context, Effect, Explanation, Glyphs, Input, Key, Keymap, Overlay,
    PendingInput, Purpose, Theme, named,
};

/// What commands do: by the name that their line ends with, which is that of the command where the line does not say
/// it; by its name behind a colon if it takes words. What moves something takes the steps to the right and upwards
/// from there.
#[rustfmt::skip]
const ACTIONS: &[(&str, CommandAction)] = &[
    ("select", Move(|s, [by, _]| parameters::select(s, by as isize))),
    ("step", Move(|s, [by, _]| s.attempt(|s| parameters::step(s, by)))),
    ("step-size", Move(|s, [by, _]| s.attempt(|s| parameters::step_size(s, by)))),
    ("half-width", Move(|s, [by, _]| s.attempt(|s| parameters::half_width(s, by)))),
    ("edit", Act(|s| if !history::goes_deeper(s) { parameters::edit(s) })),
    ("type-number", Press(parameters::begin)),
    ("reset-value", Act(parameters::reset_row)),

    ("start-here", Try(plots::start_here)),
    ("use-method", Try(plots::use_method)),
    ("jump-here", Try(plots::jump_here)),

    ("next-abscissa", Move(|s, [_, up]| plots::next_abscissa(s, up > 0))),
    ("next-ordinate", Act(plots::next_ordinate)),
    ("next-unit", Try(plots::next_unit)),
    ("walk", Try(walk::take_hold)),
    ("walk-by", Move(|s, [by, _]| walk::go(s, by as isize))),
    ("walk-to", Move(|s, [by, _]| walk::go_to_landmark(s, by > 0))),
    ("walk-take", Try(walk::take)),
    ("walk-let-go", Act(|s| s.held = None)),

    ("scan", Act(scan::open)),
    ("scan-by", Move(|s, by| s.attempt(|s| scan::go(s, by.map(|by| by as isize))))),
    ("scan-take", Try(scan::take)),
    ("scan-column", Move(|s, [by, _]| s.attempt(|s| scan::next_column(s, by as isize)))),
    ("scan-table", Try(scan::table)),
    ("scan-pause", Try(scan::pause)),
    ("scan-save", Try(|s| scan::save(s, scan::FILE))),

    ("cursor", Move(plots::move_cursor)),
    ("zoom", Move(|s, [by, _]| plots::zoom(s, by > 0))),
    ("fit-window", Act(plots::fit)),
    ("home", Act(plots::home)),
    ("pan", Move(plots::pan)),

    ("pane", Move(|s, [by, _]| screen_setup::focus(s, by as isize))),
    ("enlarge", Act(|s| s.enlarged = !s.enlarged)),
    ("paper", Act(|s| lists::open(s, Paper))),
    ("views", Act(|s| lists::open(s, Views))),
    ("next-view", Move(|s, [by, _]| screen_setup::next_view(s, by as isize))),
    ("add-plot", Try(screen_setup::add)),
    ("remove-plot", Try(screen_setup::remove)),
    ("move-plot", Try(screen_setup::move_on)),
    ("arrange", Act(screen_setup::arrange)),
    ("help", Act(lists::help)),
    ("palette", Act(|s| lists::search_everything(s, String::new()))),
    ("prompt", Act(|s| prompt::open(s, ""))),
    ("type-parameter", Act(|s| prompt::open(s, "set D"))),
    ("scenes", Act(|s| lists::open(s, Scenes))),
    ("layers", Act(|s| lists::open(s, Layers))),
    ("undo", Try(history::undo)),
    ("redo", Try(history::redo)),
    ("start-inside", Try(|s| motions::beside_edge(s, motions::INSIDE))),
    ("start-outside", Try(|s| motions::beside_edge(s, motions::OUTSIDE))),
    ("drop-motion", Try(motions::drop_newest)),
    ("drop-other-motions", Try(motions::drop_others)),
    ("play-motion", Try(motions::play)),
    ("motion-by", Move(|s, [by, _]| s.attempt(|s| motions::step(s, f64::from(by))))),
    ("motion-pace", Act(motions::pace)),
    ("try-kick", Try(kick::kick)),
    ("kick-by", Move(|s, [by, _]| s.attempt(|s| kick::resize(s, by)))),
    ("kick-turn", Try(kick::turn)),
    ("kick-let-go", Act(|s| s.kicking = false)),
    ("unfold", Act(|s| s.unfolded = !s.unfolded)),
    ("reset-scene", Act(history::reset_scene)),
    ("accuracy", Move(|s, [by, _]| s.attempt(|s| parameters::dial(s, by > 0)))),
    ("next-method", Act(|s| parameters::next_method(s, 1))),

    ("harmonics", Move(|s, [by, _]| s.attempt(|s| general::harmonics(s, by > 0)))),

    ("count", Press(general::count)),
    ("delete-digit", Act(general::delete_digit)),
    ("forget-pending", Act(|s| s.pending = None)),
    ("set-mark", Act(|s| s.pending = Some(PendingInput::Mark))),
    ("go-to-mark", Act(|s| s.pending = Some(PendingInput::GoTo))),
    ("pin", Act(compare::pin)),
    ("swap", Try(compare::swap)),

    ("what-is", Act(|s| s.overlay = Some(Overlay::Explanation(Explanation::default())))),
    ("explain-by", Move(|s, by| if let Some(Overlay::Explanation(it)) = &mut s.overlay { it.steps.push(by); })),
    ("explain-more", Act(|s| if let Some(Overlay::Explanation(it)) = &mut s.overlay { it.more = !it.more; })),
    ("explain", Act(|s| s.caption.explain())),
    ("tour", Try(files::tour)),
    ("restore", Try(files::restore)),
    ("forget-interrupted", Try(files::forget)),
    ("restore-selected", Act(files::restore_selected)),
    ("forget-one", Try(files::forget_selected)),

    ("costs", Act(|s| lists::open(s, Cost))),
    ("retry", Try(general::retry)),
    ("save-figure", Act(|s| files::offer(s, "figure-pane", &format!("-{}.svg", s.plot + 1)))),
    ("save-page", Act(|s| files::offer(s, "page", ".html"))),
    ("save-sound", Act(|s| files::offer(s, "sound", ".wav"))),
    ("copy-command", Try(|s| s.effect(Effect::Copy(copy::command_line(s))))),
    ("copy-number", Try(copy::number)),
    ("copy-row", Try(copy::row)),
    ("copy-screen", Try(|s| s.effect(Effect::CopyScreen))),
    ("glyphs", Act(|s| general::turn(s, "glyphs", |it| &mut it.glyphs))),
    ("units", Act(general::units)),
    ("equal", Act(general::equal)),
    ("mouse", Act(plots::toggle_mouse)),
    ("lecture", Act(general::lecture)),
    ("theme", Act(|s| general::turn(s, "theme", |it| &mut it.theme))),
    ("drop-cursor", Act(plots::drop_cursor)),
    ("back", Act(lists::close)),
    ("quit", Act(general::quit)),

    ("list-by", Move(|s, [by, _]| lists::move_by(s, by as isize))),
    ("search", Act(|s| lists::with(s, |list| list.searching = true))),
    ("choose", Try(prompt::choose)),
    ("toggle-letter", Press(lists::toggle_letter)),
    ("search-done", Try(prompt::search_done)),
    ("search-drop", Act(|s| {
            lists::search_with(s, String::clear);
            lists::with(s, |list| list.searching = false);
        })),
    ("search-delete", Act(|s| lists::search_with(s, |it| _ = it.pop()))),
    ("search-clear", Act(|s| lists::search_with(s, String::clear))),

    ("accept", Act(prompt::accept)),
    ("complete", Move(|s, [by, _]| prompt::complete(s, by as isize))),
    ("line-back", Move(|s, [by, _]| prompt::recall(s, by as isize))),
    ("clear", Act(|s| prompt::with(s, |i| *i = Input::default()))),
    ("delete-word", Act(|s| prompt::with(s, Input::delete_word))),
    ("delete-before", Act(|s| prompt::with(s, |i| _ = i.before.pop()))),
    ("delete-after", Act(|s| prompt::with(s, Input::delete_after))),
    ("caret", Move(|s, [by, _]| prompt::with(s, |i| i.move_caret(by as isize)))),

    ("replay-pasted", Act(general::accept_offer)),

    ("suspend", Try(|s| s.effect(Effect::Suspend))),
    ("repaint", Try(|s| s.effect(Effect::Repaint))),

    (":set", Line(completion::assignments, values::set)),
    (":method", Line(completion::methods, |s, rest| values::set_row(s, "method", rest))),
    (":tol", Line(nothing, |s, rest| values::set_row(s, "tolerance", rest))),
    (":until", Line(nothing, |s, rest| values::set_row(s, "until", rest))),
    (":scene", Line(|_, _| all(library::names()), values::scene)),
    (":belt", Line(|_, _| all(machines().iter().map(|it| &it.name)), values::belt)),
    (":machine", Line(nothing, |s, rest| files::ask(s, rest, Purpose::Machine))),
    (":view", Line(|_, _| all(VIEWS.iter().map(|row| row.name)), values::view)),
    (":layer", Line(completion::layers, values::layer)),
    (":window", Line(completion::window, values::window)),
    (":axes", Line(completion::axes, values::axes)),
    (":scan", Line(completion::scan, scan::scan)),
    (":level", Line(nothing, values::level)),
    (":save-scan", Line(nothing, scan::save)),
    (":harmonics", Line(nothing, values::harmonics)),
    (":kicks", Line(nothing, values::kicks)),
    (":mark", Line(completion::marks, |s, rest| values::letter(rest).map(|it| compare::set_mark(s, it)))),
    (":goto", Line(completion::marks, |s, rest| compare::go_to_mark(s, values::letter(rest)?))),
    (":write", Line(nothing, |s, rest| files::write(s, rest, false))),
    (":write!", Line(nothing, |s, rest| files::write(s, rest, true))),
    (":study", Line(nothing, |s, rest| files::study(s, rest, false))),
    (":study!", Line(nothing, |s, rest| files::study(s, rest, true))),
    (":open", Line(nothing, |s, rest| files::ask(s, rest, Purpose::Open))),
    (":fit", Line(nothing, files::fit)),
    (":figure", Line(nothing, |s, rest| files::figure(s, rest, None, false))),
    (":figure!", Line(nothing, |s, rest| files::figure(s, rest, None, true))),
    (":figure-pane", Line(nothing, |s, rest| files::figure(s, rest, Some(s.plot), false))),
    (":figure-pane!", Line(nothing, |s, rest| files::figure(s, rest, Some(s.plot), true))),
    (":page", Line(nothing, |s, rest| files::page(s, rest, false))),
    (":page!", Line(nothing, |s, rest| files::page(s, rest, true))),
    (":sound", Line(nothing, |s, rest| files::sound(s, rest, false))),
    (":sound!", Line(nothing, |s, rest| files::sound(s, rest, true))),
    (":record", Line(nothing, |s, rest| files::record(s, rest, false))),
    (":record!", Line(nothing, |s, rest| files::record(s, rest, true))),
    (":play", Line(nothing, |s, rest| files::ask(s, rest, Purpose::Play))),
    (":lesson", Line(|_, _| all(files::LESSONS.map(|(name, _)| name)), files::lesson)),
    (":theme", Line(completion::values::<Theme>, |s, name| named(name).map(|it| s.display.theme = it))),
    (":units", Line(completion::switch, |s, state| values::is_on("units", state).map(|on| s.display.dimensionless = !on))),
    (":equal", Line(completion::switch, |s, state| values::is_on("equal units", state).map(|on| s.display.stretched = !on))),
    (":glyphs", Line(completion::values::<Glyphs>, |s, name| named(name).map(|it| s.display.glyphs = it))),
    (":color", Line(completion::values::<Colors>, |s, name| named(name).map(|it| s.display.colors = it))),
];

/// All commands, in the order in which the help lists them.
fn table() -> &'static [Command] {
    static ALL: LazyLock<Vec<Command>> = LazyLock::new(|| {
        let (keys, words): (Vec<_>, Vec<_>) =
            COMMANDS.lines().filter_map(command).partition(|command| command.words().is_none());
        keys.into_iter().chain(LAYERS.iter().map(toggle)).chain(words).collect()
    });
    &ALL
}

/// The command that a line of the file describes; `None` for a comment. A test reads every line.
fn command(line: &'static str) -> Option<Command> {
    let fields: Vec<&str> = line.split(" | ").collect();
    let [name, places, hint, doc, ref does @ ..] = fields[..] else { return None };
    let mut words = does.first().unwrap_or(&name).split(' ');
    let action = words.next()?;
    let (_, run) = *ACTIONS.iter().find(|row| row.0 == action)?;
    let mut by = [0; 2];
    for (by, word) in by.iter_mut().zip(words) {
        *by = match word {
            "first" => i32::MIN,
            "last" => i32::MAX,
            number => number.parse().ok()?,
        };
    }
    let hint = if hint == "-" { "" } else { hint };
    let needs = does.get(1).unwrap_or(&"");
    let (name, keys, arguments) = match name.strip_prefix(':') {
        Some(name) => (name, Vec::new(), places),
        None => (name, keys(places), ""),
    };
    Some(Command { name, keys, hint, doc, arguments, run, by, needs })
}

/// Contexts by their names, each followed by the keys there.
fn keys(text: &str) -> Vec<(Context, Vec<Key>)> {
    let mut places: Vec<(Context, Vec<Key>)> = Vec::new();
    for word in text.split_whitespace() {
        match (Context::named(word), places.last_mut()) {
            (Some(context), _) => places.push((context, Vec::new())),
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
        keys: keys(if spec.layer == Layer::Whole {
            "everywhere |"
        } else {
            "everywhere"
        }),
        hint: "",
        doc: leaked(format!("Show or hide {}", spec.meaning)),
        arguments: "",
        run: Toggle(spec.layer),
        by: [0; 2],
        needs: "",
    }
}

/// Every command of keys, in the order in which the help lists them.
pub fn commands() -> impl Iterator<Item = &'static Command> {
    table().iter().filter(|command| command.words().is_none())
}

impl Default for Keymap {
    /// The default keys of every command.
    fn default() -> Self {
        Keymap::new(table())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::TOPICS;

    #[test]
    fn every_line_of_the_file_has_a_function_and_keys_that_can_be_read() {
        let lines: Vec<_> = COMMANDS.lines().filter(|line| line.contains(" | ")).collect();
        let does = |line: &&str| {
            let does = line.split(" | ").nth(4).or(line.split(" | ").next());
            does.unwrap().split(' ').next().unwrap().to_owned()
        };
        let used: std::collections::BTreeSet<_> = lines.iter().map(does).collect();
        assert_eq!(used, ACTIONS.iter().map(|row| row.0.to_owned()).collect());
        assert_eq!(lines.iter().filter_map(|line| command(line)).count(), lines.len());
        for line in lines.into_iter().filter(|line| !line.starts_with(':')) {
            let [_, words, ..] = line.split(" | ").collect::<Vec<_>>()[..] else {
                panic!("{line}")
            };
            let read = keys(words).iter().map(|(_, keys)| 1 + keys.len()).sum::<usize>();
            assert_eq!(read, words.split_whitespace().count(), "{line}");
        }
    }

    #[test]
    fn what_a_command_waits_for_is_a_topic_or_has_a_meaning_of_its_own() {
        let own = ["cycles-at-present", "motion-over-time", "window", "everything"];
        for command in table() {
            for need in command.needs.split_whitespace() {
                let topic = TOPICS.iter().any(|topic| topic.name() == need);
                assert!(topic || own.contains(&need), "{}: {need}", command.name);
            }
        }
    }

    #[test]
    fn what_the_scenes_of_opened_files_say_to_press_are_commands() {
        let machine = include_str!("../../assets/templates/machine.toml");
        let record = include_str!("../../assets/templates/record.toml");
        for text in [machine, record] {
            let press = text.lines().find(|line| line.starts_with("press = ")).unwrap();
            let names: Vec<_> = press.split('{').skip(1).map(|it| it.split('}').next()).collect();
            let known = |name: &&str| commands().any(|command| command.name == *name);
            assert!(names.iter().all(|name| name.as_ref().is_some_and(known)), "{names:?}");
        }
    }
}
