//! `hopfscope [SCENE]` and `hopfscope tour`: the explorer in this terminal.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::SystemTime;

use clap::Args;

use super::replay::script;
use super::settings::{Looks, Memory, Settings};
use super::study::file_of;
use super::{CommandCase, Failure, Result, StartOptions};
use crate::numerics::similar;
use crate::runtime::{Files, Options, RecordingFile, explore, provenance_file};
use crate::scene::library::{FIRST, names};
use crate::scene::machine::NO_BELT;
use crate::scene::{PLAIN, Scene, find, plain};
use crate::session::act::history::FIRST_KEYS;
use crate::session::config::Config;
use crate::session::replay::{Instruction, Recorder, Script};
use crate::session::save::opening;
use crate::session::{KeptSession, LESSONS, Msg, Session, Size, save};
use crate::terminal::Environment;
use crate::words::joined;

/// Opens the explorer.
#[derive(Args)]
pub struct ExploreCommand {
    /// Scene to open, by its name or file; `hopfscope scenes` lists those of the program
    #[arg(value_name = "SCENE", conflicts_with = "scene")]
    named: Option<String>,
    /// Opens a machine in physical units: a file, or the name of a built-in one; see `hopfscope belt`
    #[arg(long, value_name = "FILE", conflicts_with_all = ["named", "scene"])]
    belt: Option<String>,
    #[command(flatten)]
    start: StartOptions,
    #[command(flatten)]
    looks: Looks,
    #[command(flatten)]
    settings: Settings,
    /// Resumes a saved session
    #[arg(long, value_name = "FILE", conflicts_with_all = ["named", "scene", "set", "method", "tol", "step", "epsilon"])]
    open: Option<PathBuf>,
    /// Resumes the last session
    #[arg(long, conflicts_with_all = ["named", "scene", "set", "method", "tol", "step", "epsilon", "belt", "open"])]
    last: bool,
    /// Plays a keystroke file first, then hands over to the keyboard
    #[arg(long, value_name = "FILE")]
    play: Option<PathBuf>,
    /// Lets the keystroke files that are played write files
    #[arg(long)]
    allow_write: bool,
    /// Records the keys that are pressed in a keystroke file
    #[arg(long, value_name = "FILE")]
    record: Option<PathBuf>,
    /// Lets --record replace a file that is not a recording
    #[arg(long, requires = "record")]
    force: bool,
}

impl ExploreCommand {
    /// Whether nothing is asked for, and nothing was kept before.
    fn is_first_start(&self) -> bool {
        let asks = self.belt.is_some() || self.start.asks() || self.last;
        let files = [&self.open, &self.play, &self.record];
        let asks = asks || files.iter().any(|file| file.is_some());
        !asks && Memory::open().is_some_and(|memory| !memory.keeps())
    }

    /// `commands` are the names of the others, for who misspelt one.
    pub fn run(&self, commands: &[&'static str]) -> Result<()> {
        let config = self.settings.read()?;
        let named = self.named.as_ref().or(self.start.scene.as_ref()).or(config.scene.as_ref());
        let name = named.map_or(if self.is_first_start() { FIRST } else { PLAIN }, String::as_str);
        let scene = if let Some(file) = &self.belt {
            let scene = CommandCase::named(file)?.scene()?;
            self.start.applied(scene.ok_or_else(|| format!("{file}: {NO_BELT}"))?)?
        } else {
            if self.named.is_some() && file_of(name).is_none() {
                find(name).map_err(|_| neither_scene_nor_command(name, commands))?;
            }
            self.start.scene(Some(name))?
        };
        let play = self.play.as_deref().map(played).transpose()?.unwrap_or_default();
        let mut session = session(scene, self.looks, config);
        if let Some(text) = session.unlikely_number() {
            session.inform(text);
        }
        let last = self.last.then(last).transpose()?;
        if let Some(path) = self.open.as_ref().or(last.as_ref()) {
            let text = Files::read(path)?;
            save::open(&mut session, &text).map_err(|why| Failure::file(path, why))?;
            session.inform(format!("opened {}", path.display()));
        }
        let record = self.record.as_deref().map(|path| (path, self.force));
        go(session, &play, record, self.allow_write)
    }
}

/// Guided tour of the explorer: the keys named in a caption work, any other key continues, Esc leaves
#[derive(Args)]
pub struct TourCommand {
    #[command(flatten)]
    looks: Looks,
    #[command(flatten)]
    settings: Settings,
}

impl TourCommand {
    pub fn run(&self) -> Result<()> {
        let session = session(plain(), self.looks, self.settings.read()?);
        go(session, &[Instruction::Give(Msg::Run("tour".to_owned()))], None, false)
    }
}

/// A lesson that asks before it shows; y or n answers
#[derive(Args)]
pub struct LessonCommand {
    /// Lesson
    #[arg(value_name = "NAME", value_parser = LESSONS.map(|(name, _)| name))]
    name: String,
    #[command(flatten)]
    looks: Looks,
    #[command(flatten)]
    settings: Settings,
}

impl LessonCommand {
    pub fn run(&self) -> Result<()> {
        let session = session(plain(), self.looks, self.settings.read()?);
        let line = format!("lesson {}", self.name);
        go(session, &[Instruction::Give(Msg::Run(line))], None, false)
    }
}

/// A session of a scene, with the user's settings.
fn session(scene: Arc<Scene>, looks: Looks, config: Config) -> Session {
    // The terminal reports its size before the first picture is drawn.
    let mut session = Session::new(scene, Size { width: 80, height: 24 });
    session.display = looks.wishes(&config);
    session.keymap = Arc::new(config.keymap);
    session
}

/// The file of the last session.
fn last() -> Result<PathBuf> {
    let path = Memory::open().map(|memory| memory.last).filter(|path| path.exists());
    path.ok_or("there is no last session; a session without changes is not kept".into())
}

/// The steps that play a file. The file is parsed first, so that an error shows before anything runs.
fn played(path: &Path) -> Result<Vec<Instruction>> {
    script(path)?;
    let text = Files::read(path)?;
    let name = path.display().to_string();
    let run = Instruction::Give(Msg::Run(format!("play {name}")));
    Ok(vec![Instruction::File { name, text }, run])
}

/// Runs the explorer until it is left. `play` holds the steps that are played first; `record` is the file to
/// record to, and whether it may replace a file that is not a recording. Keystroke files write files only if they
/// may.
pub fn go(
    mut session: Session,
    play: &[Instruction],
    record: Option<(&Path, bool)>,
    may_play_write: bool,
) -> Result<()> {
    let environment = Environment::of_process();
    environment.admit()?;
    let mut steps = opening(&session).map_err(Failure::Unanswered)?;
    steps.extend(play.iter().cloned());
    let mut recorder = Recorder::new(provenance_file::of_process().command, steps);
    // A file that cannot be written is reported before the session, not after it.
    let record = record.map(|(path, force)| RecordingFile::begin(path, force, &mut recorder));
    let record = record.transpose()?;
    let memory = Memory::open();
    if let Some(memory) = &memory {
        session.interrupted = memory.interrupted().into_iter().map(kept).collect();
        welcome(&mut session, memory);
    }
    let files = Files {
        copies: memory.as_ref().map(|memory| memory.copies.clone()),
        may_play_write,
        ..Files::default()
    };
    let mouse = session.display.mouse;
    let (keep, last) = memory.map(|memory| (memory.keep, memory.last)).unzip();
    let replay = (!play.is_empty()).then(|| Script::of(play.to_vec()));
    let options = Options { replay, recorder, record, keep, last, mouse, files, cast: None };
    let ended = explore(session, environment, options)
        .map_err(|why| Failure::unanswered("the terminal", why))?;
    if ended == 0 {
        Ok(())
    } else {
        Err(Failure::Said(ended))
    }
}

/// An interrupted session, with a summary of its content.
fn kept((ended, path): (SystemTime, PathBuf)) -> KeptSession {
    let what = Files::read(&path).and_then(|text| save::summary(&text));
    let what = what.unwrap_or_else(|why| {
        let why = why.strip_prefix(&format!("{}: ", path.display())).unwrap_or(&why);
        format!("cannot be resumed: {why}")
    });
    KeptSession { when: ago(ended.elapsed().unwrap_or_default().as_secs()), what, path }
}

/// `just now`, `5 min ago`, `yesterday`.
fn ago(seconds: u64) -> String {
    match seconds {
        0..60 => "just now".to_owned(),
        60..3_600 => format!("{} min ago", seconds / 60),
        3_600..86_400 => format!("{} h ago", seconds / 3_600),
        86_400..172_800 => "yesterday".to_owned(),
        _ => format!("{} days ago", seconds / 86_400),
    }
}

/// Says before the first key that sessions were interrupted or, at the first start, which keys to press.
fn welcome(session: &mut Session, memory: &Memory) {
    let said = if session.interrupted.len() > 1 {
        "sessions were interrupted: {restore} lists them, {forget-interrupted} forgets all"
    } else if !session.interrupted.is_empty() {
        "a session was interrupted: {restore} resumes it, {forget-interrupted} forgets it"
    } else if memory.is_new && session.scene.next.is_none() {
        FIRST_KEYS
    } else {
        return;
    };
    session.inform_of_keys(said);
}

/// The error for a first word that is neither a scene nor a command, with names that are similar.
fn neither_scene_nor_command(name: &str, commands: &[&'static str]) -> Failure {
    let told = |found| {
        let lead = if names().any(|scene| scene == found) {
            ""
        } else {
            "the command "
        };
        lead.to_owned() + found
    };
    let meant = similar(name, names().chain(commands.iter().copied())).into_iter();
    let meant = joined(meant.map(told), " or ");
    let line = format!("there is no scene and no command {name:?}");
    if meant.is_empty() {
        format!("{line}; hopfscope scenes lists the scenes, hopfscope --help the commands").into()
    } else {
        format!("{line}; did you mean {meant}?").into()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_word_that_names_nothing_is_answered_by_what_may_be_meant() {
        let complaint = |name| neither_scene_nor_command(name, &["trajectory"]).to_string();
        for (name, said) in [
            ("trajectry", "did you mean the command trajectory?"),
            ("supercitical", "did you mean supercritical or subcritical?"),
            ("xyz", "hopfscope scenes lists the scenes, hopfscope --help the commands"),
        ] {
            let line = format!("there is no scene and no command {name:?}; {said}");
            assert_eq!(complaint(name), line);
        }
    }
}
