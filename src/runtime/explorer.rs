//! The explorer: a session, drawn for the present terminal; and a keystroke file played on one without a terminal, in
//! the same loop and with the same workers.

use std::cell::Cell;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::{Duration, Instant};

use crossbeam_channel::unbounded;
use ratatui::buffer::Buffer;
use ratatui::layout::Size;

use super::{
    Application, Files, Options, Pump, ReplayResult, Tell, Work, launch, new_file, print,
    provenance_file, scanning, wav,
};
use crate::figure::{self, Figure, FigureForm, panels};
use crate::fit::NoEstimate;
use crate::flow::{Limits, Result};
use crate::question::{self, Fit, Recording};
use crate::report::shown::shown;
use crate::scan::Sound;
use crate::scene::{Finding, Request, plain};
use crate::session::replay::{Recorder, parse};
use crate::session::{ComputedContent, Effect, Msg, Playback, Session, save, update};
use crate::terminal::{Cast, Environment, Screen};
use crate::view::{self, Look, verdict};
use crate::words::joined;
use crate::words::provenance::Provenance;

/// A session and its appearance in the present terminal.
pub struct Explorer {
    pub session: Session,
    environment: Environment,
    look: Look,
}

/// A session computed once more for print, and the figure of these plots.
fn drawn(mut session: Session, plots: &[usize], limits: &Limits) -> (Session, Figure) {
    let limits = limits.up_to(print::MOST);
    print::refine(&mut session, &limits);
    let drawn = print::figure(&mut session, plots, &limits);
    (session, drawn.from(provenance_file::of_process()))
}

impl Explorer {
    /// A page of what is on show, and beside it a recording of how the session came there.
    fn page(&self, path: PathBuf, forget: u32, keys: &Recorder) -> Result<Work, String> {
        let (mut session, mut keys) = (self.session.clone(), keys.clone());
        // On paper the whole motion is drawn and told.
        (session.playback.at, session.playback.playing) = (None, false);
        keys.forget(forget);
        let replay = Some(parse(&keys.text()).map_err(|why| why.to_string())?);
        let beside = path.with_extension("cast");
        let (outcome, environment) = (verdict::outcome(&session).0, self.environment.clone());
        Ok(Box::new(move |limits: &Limits| {
            let mut empty = Session::new(plain(), session.size);
            empty.display = session.display;
            let options = Options { replay, cast: Some(Cast::default()), ..Options::default() };
            let cast = play(empty, environment, options, limits).cast;
            let plots: Vec<_> = session.on_show().collect();
            let (session, figure) = drawn(session, &plots, limits);
            let (answer, provenance) =
                (shown(&session, outcome, &beside), provenance_file::of_process());
            let page = answer.page("Shown by hopfscope", &panels(&figure), &provenance, &[]);
            let cast = cast.map(Cast::end).unwrap_or_default();
            Ok(vec![(path, page.into_bytes()), (beside, cast.into_bytes())])
        }))
    }

    /// A figure that names the command that draws it again; before it the session that this command opens, unless it is there.
    fn figure(&self, path: PathBuf, plot: Option<usize>) -> Result<Work, String> {
        let form = FigureForm::of_file(&path)?;
        let mut session = self.session.clone();
        session.playback = Playback::default();
        let plots = plot.map_or_else(|| session.on_show().collect(), |plot| vec![plot]);
        let (text, beside) = (save::text(&session)?, new_file::beside(&path, ".toml"));
        let panels = joined(plots.iter().map(|plot| plot + 1), ",");
        let (from, to) = (beside.display().to_string(), path.display().to_string());
        let words = ["figure", "--open", &from, "--panels", &panels, "--output", &to];
        let provenance = Provenance::of(&words.map(str::to_owned));
        let old = Files::read(&beside);
        if old.as_ref().is_ok_and(|old| save::summary(old).is_err()) {
            return Err(format!("{from}: no session of a figure, and so it is kept"));
        }
        let is_there = old.as_ref() == Ok(&text);
        let mut files = Vec::from_iter((!is_there).then(|| (beside, text.into_bytes())));
        Ok(Box::new(move |limits: &Limits| {
            let drawn = drawn(session, &plots, limits).1.from(provenance);
            files.push((path, figure::file(&drawn, form)?));
            Ok(files)
        }))
    }

    /// A session that looks as good as the environment allows.
    pub fn new(session: Session, environment: Environment) -> Explorer {
        let look = Look::new(environment.fit(session.display));
        Explorer { session, environment, look }
    }
}

impl Application for Explorer {
    fn update(&mut self, msg: Msg) -> Vec<Effect> {
        let wishes = self.session.display;
        let effects = update(&mut self.session, msg);
        if self.session.display != wishes {
            self.look = Look::new(self.environment.fit(self.session.display));
        }
        effects
    }

    fn session(&self) -> Option<&Session> {
        Some(&self.session)
    }

    fn make(&self, path: &Path, content: ComputedContent, keys: &Recorder) -> Result<Work, String> {
        let (path, session) = (path.to_owned(), self.session.clone());
        match content {
            ComputedContent::Page { forget } => self.page(path, forget, keys),
            ComputedContent::Sound => {
                let sound = Sound::usual(session.subject()).map_err(|why| why.to_string())?;
                Ok(Box::new(move |limits: &Limits| {
                    Ok(vec![(path, wav::wav(&sound, limits)?.content)])
                }))
            }
            ComputedContent::Figure { plot } => self.figure(path, plot),
        }
    }

    fn asks_for_background(&self) -> bool {
        self.environment.asks_for_background(self.session.display)
    }

    fn background(&mut self, is_light: bool) {
        self.environment.is_light = Some(is_light);
        self.look = Look::new(self.environment.fit(self.session.display));
    }

    fn picture(&self, size: Size) -> Buffer {
        view::picture(size, &self.session, &self.look)
    }
}

/// Answers a request: a scan on all cores, everything else on this thread.
pub fn answer(request: &Request, limits: &Limits, tell: &Tell) -> Result<Finding> {
    match request {
        Request::Fit { recording } => fitted(recording, limits, tell).map(Finding::Fit),
        Request::Scan { scan, from } => {
            scanning::answer(scan, *from, limits, tell).map(Finding::Scan)
        }
        _ => question::answer(request, limits),
    }
}

/// Fits a record, and reports its progress from time to time.
fn fitted(recording: &Recording, limits: &Limits, tell: &Tell) -> Result<Fit> {
    const EVERY: Duration = Duration::from_millis(200);
    let told = Cell::new(Instant::now());
    Fit::of(recording, limits, &|motions| {
        if told.get().elapsed() >= EVERY {
            told.set(Instant::now());
            tell(Finding::Fit(NoEstimate::Underway { motions }.into()));
        }
    })
}

/// Runs a session in the terminal, until the user quits or a signal ends the program.
///
/// Call [`Environment::admit`] first: it says in one line why there is no usable terminal. Fails if the
/// terminal cannot be used, or goes away while it is written to.
pub fn explore(session: Session, environment: Environment, options: Options) -> io::Result<u8> {
    launch(Explorer::new(session, environment), Arc::new(answer), options)
}

/// Plays the file among the options on a session at its size, until it ends, an expectation is not met, the session quits,
/// or the limits say so.
///
/// Effects outside the program are not carried out: a replay copies nothing, and writes files only if it may. It
/// does read the files that the session asks for.
pub fn play(
    session: Session,
    environment: Environment,
    options: Options,
    limits: &Limits,
) -> ReplayResult<Explorer> {
    let crate::session::Size { width, height } = session.size;
    let screen = Screen::new(io::sink(), Size { width, height });
    let explorer = Explorer::new(session, environment);
    let answer = Arc::new(answer);
    Pump::new(explorer, screen, answer, unbounded(), options, Size::default).unattended(limits)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::find;
    use crate::scene::library::PLAIN;

    /// Plays a file on the plain scene.
    fn played(file: &str) -> ReplayResult<Explorer> {
        let size = crate::session::Size { width: 80, height: 24 };
        let session = Session::new(find(PLAIN).unwrap(), size);
        let options = Options { replay: Some(parse(file).unwrap()), ..Options::default() };
        play(session, Environment::of(|_| None), options, &Limits::PATIENT)
    }

    #[test]
    fn the_screen_has_the_size_that_the_file_sets() {
        let end = played("<right> <resize 100x30>");
        assert_eq!(end.screen.area.as_size(), Size { width: 100, height: 30 });
    }

    #[test]
    fn quitting_ends_it_and_later_keys_are_not_pressed() {
        let end = played("q <expect \"no such text\">");
        assert_eq!(end.unmet, None);
    }

    #[test]
    fn waiting_for_every_answer_and_for_none_end_on_the_same_numbers() {
        let slow = played("<right*30>").application.session.problem;
        let fast = played("<async> <right*30>").application.session.problem;
        assert_eq!(slow, fast);
    }
}
