//! Files: saving and opening sessions, recorded motions and machines, recording and playing keys. The outer rings
//! access the disk; this module makes the content that is written and interprets the content that was read.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use crate::question::record::{RecordOptions, apart};
use crate::scene::machine::file;
use crate::scene::{Machine, Recording, ScaledMachine};
use crate::session::act::{history, lists, prompt};
use crate::session::{
    ComputedContent, Content, Done, Effect, ListKind, Overlay, Purpose, Session, replay, save,
    study,
};
use crate::words::one_of;

/// The built-in tour.
const TOUR: &str = include_str!("../../../assets/replays/tour.keys");

/// The lessons that come with the program, by name.
pub const LESSONS: [(&str, &str); 6] = [
    ("mass", include_str!("../../../assets/lessons/mass.keys")),
    ("capture", include_str!("../../../assets/lessons/capture.keys")),
    ("basin", include_str!("../../../assets/lessons/basin.keys")),
    ("margin", include_str!("../../../assets/lessons/margin.keys")),
    ("fold", include_str!("../../../assets/lessons/fold.keys")),
    ("stick-slip", include_str!("../../../assets/lessons/stick-slip.keys")),
];

/// Saves the session.
pub fn write(session: &mut Session, path: &str, replace: bool) -> Done {
    if ends_in(Path::new(path), &FIGURES) {
        return figure(session, path, None, replace);
    }
    let content = Content::Text(save::text(session)?);
    session.effect(Effect::Write { path: path.into(), content, replace })
}

/// Writes what is on show as a study.
pub fn study(session: &mut Session, path: &str, replace: bool) -> Done {
    if Path::new(path).extension().is_none_or(|ending| ending != "toml") {
        return Err(format!("a study ends in .toml, not {path:?}"));
    }
    let content = Content::Text(study::text(session)?);
    session.effect(Effect::Write { path: path.into(), content, replace })
}

/// Writes the recording since the start, without the presses that asked for that.
pub fn record(session: &mut Session, path: &str, replace: bool) -> Done {
    let content = Content::Record { forget: session.chord };
    session.effect(Effect::Write { path: path.into(), content, replace })
}

/// Asks for a file.
pub fn ask(session: &mut Session, path: &str, purpose: Purpose) -> Done {
    session.effect(Effect::Read { path: path.into(), purpose })
}

/// Said where there is no interrupted session.
const NONE_INTERRUPTED: &str = "no session was interrupted";

/// The endings of figures. What else is written by name is a session.
const FIGURES: [&str; 5] = ["pdf", "svg", "png", "csv", "json"];

fn ends_in(path: &Path, endings: &[&str]) -> bool {
    let ending = path.extension().and_then(|ending| ending.to_str()).unwrap_or_default();
    endings.iter().any(|known| known.eq_ignore_ascii_case(ending))
}

/// Writes a figure of one plot, or of all.
pub fn figure(session: &mut Session, path: &str, plot: Option<usize>, replace: bool) -> Done {
    let content = ComputedContent::Figure { plot };
    make(session, path, ("a figure", &FIGURES), content, replace)
}

/// Writes what is on show as a page, and beside it how the session came there.
pub fn page(session: &mut Session, path: &str, replace: bool) -> Done {
    let content = ComputedContent::Page { forget: session.chord };
    make(session, path, ("a page", &["html"]), content, replace)
}

/// Writes the motion as it sounds.
pub fn sound(session: &mut Session, path: &str, replace: bool) -> Done {
    make(session, path, ("a sound", &["wav"]), ComputedContent::Sound, replace)
}

/// Writes what takes time to make, unless something else is in work, to a file with one of these endings.
fn make(
    session: &mut Session,
    path: &str,
    (kind, endings): (&str, &[&str]),
    content: ComputedContent,
    replace: bool,
) -> Done {
    let path = PathBuf::from(path);
    if !ends_in(&path, endings) {
        let (path, endings) = (path.display().to_string(), endings.join(", ."));
        return Err(format!("{kind} ends in .{endings}, not {path:?}"));
    }
    if let Some(other) = &session.writing {
        let stops = session.with_keys("{drop-cursor} stops that");
        return Err(format!("{} is still being written; {stops}", other.display()));
    }
    session.writing = Some(path.clone());
    session.effect(Effect::Write { path, content: Content::Computed(content), replace })
}

/// Offers to write a file that is named after the scene: opens the line with a command and the file name, to be edited or
/// accepted.
pub fn offer(session: &mut Session, command: &str, ending: &str) {
    let plain = |letter: char| if letter.is_ascii_alphanumeric() { letter } else { '-' };
    let scene: String = session.scene.name.chars().map(plain).collect();
    prompt::open(session, format!("{command} {scene}{ending}"));
}

/// Takes a file in, or says what is wrong with it and changes nothing.
pub fn read(session: &mut Session, path: &Path, purpose: Purpose, result: Done<String>) -> Done {
    if let Purpose::Table { path: of, machine } = purpose {
        return open_machine(session, &of, machine, Some(&result));
    }
    let text = result?;
    let of_file = |why: String| format!("{}: {why}", path.display());
    match purpose {
        Purpose::Open => {
            save::open(session, &text).map_err(of_file)?;
            session.inform(format!("opened {}", path.display()));
        }
        Purpose::Restore => {
            save::open(session, &text).map_err(of_file)?;
            let others = match session.interrupted.len() {
                0 => String::new(),
                1 => session.with_keys("; {restore} brings the older one"),
                count => session.with_keys(&format!("; {{restore}} lists {count} others")),
            };
            session.inform(format!("the interrupted session is back{others}"));
            return session.effect(Effect::PutAside(path.to_owned()));
        }
        Purpose::Fit(words) => {
            let options = RecordOptions::of_words(&words).map_err(of_file)?;
            let opened = options.opened(path, text.as_bytes()).map_err(of_file)?;
            history::open_scene(session, Arc::new(Recording::from(opened).scene()));
        }
        Purpose::Machine => return open_machine(session, path, text, None),
        // Handled above, because the table may be unreadable.
        Purpose::Table { .. } => {}
        Purpose::Play => {
            let script = replay::parse(&text).map_err(|error| of_file(error.to_string()))?;
            return session.effect(Effect::Play(script));
        }
    }
    Ok(())
}

/// Opens the machine of a file; asks for the table of friction first if the file names one.
fn open_machine(
    session: &mut Session,
    path: &Path,
    text: String,
    table: Option<&Done<String>>,
) -> Done {
    let file = path.display().to_string();
    let title = path.file_stem().unwrap_or(path.as_os_str()).to_string_lossy();
    let mut wanted = None;
    let found = file::parse(&title, &file, &text, |name| {
        table.cloned().unwrap_or_else(|| {
            wanted = Some(path.with_file_name(name));
            Err(String::new())
        })
    });
    if let Some(table) = wanted {
        let purpose = Purpose::Table { path: path.to_owned(), machine: text };
        return session.effect(Effect::Read { path: table, purpose });
    }
    let described = found.map_err(|error| error.to_string())?;
    let machine = Machine::try_from(described).map_err(|why| format!("{file}: {why}"))?;
    let scaled = ScaledMachine::try_from(machine).map_err(|why| format!("{file}: {why}"))?;
    history::open_scene(session, Arc::new(scaled.scene()));
    session.warn_of_units();
    Ok(())
}

/// Continues the interrupted session, or lists the sessions if there are several.
pub fn restore(session: &mut Session) -> Done {
    match session.interrupted.len() {
        0 => return Err(NONE_INTERRUPTED.to_owned()),
        1 => restore_number(session, 0),
        _ => lists::open(session, ListKind::Interrupted),
    }
    Ok(())
}

/// Continues the selected interrupted session.
pub fn restore_selected(session: &mut Session) {
    if let Some(number) = selected(session) {
        restore_number(session, number);
    }
}

fn restore_number(session: &mut Session, number: usize) {
    session.overlay = None;
    let path = session.interrupted.remove(number).path;
    session.effects.push(Effect::Read { path, purpose: Purpose::Restore });
}

/// Index of the selected session among all interrupted ones.
fn selected(session: &Session) -> Option<usize> {
    let Some(Overlay::List(ListKind::Interrupted, list)) = &session.overlay else { return None };
    session.interrupted_rows(list).get(list.selected).map(|(number, _)| *number)
}

/// Stops offering the selected interrupted session.
pub fn forget_selected(session: &mut Session) -> Done {
    let Some(number) = selected(session) else { return Ok(()) };
    if session.interrupted.len() == 1 {
        return forget(session);
    }
    let path = session.interrupted.remove(number).path;
    lists::move_by(session, 0);
    session.effect(Effect::PutAside(path))
}

/// Stops offering all interrupted sessions.
pub fn forget(session: &mut Session) -> Done {
    let all = std::mem::take(&mut session.interrupted);
    session.overlay = None;
    match all.len() {
        0 => return Err(NONE_INTERRUPTED.to_owned()),
        1 => session.inform("the interrupted session is not offered again"),
        count => session.inform(format!("{count} interrupted sessions are not offered again")),
    }
    // The most recent one is put aside last, so that it remains.
    session.effects.extend(all.into_iter().rev().map(|kept| Effect::PutAside(kept.path)));
    Ok(())
}

/// Plays a lesson; without a name it offers all.
pub fn lesson(session: &mut Session, name: &str) -> Done {
    let text = one_of("lesson", name, LESSONS)?;
    let script = replay::parse(text).map_err(|error| format!("lesson {name}: {error}"))?;
    session.effect(Effect::Play(script))
}

/// Plays the built-in tour, as a test does.
pub fn tour(session: &mut Session) -> Done {
    let script = replay::parse(TOUR).map_err(|error| format!("the tour: {error}"))?;
    session.effect(Effect::Play(script))
}

/// Asks for the record that a line names: `FILE mass=2 kg columns=1,3 peaks`.
pub fn fit(session: &mut Session, rest: &str) -> Done {
    let (file, words) = apart(rest);
    RecordOptions::of_words(words)?;
    ask(session, file, Purpose::Fit(words.to_owned()))
}
