//! From an application to a running program: takes the terminal, starts the threads, runs the loop, and gives
//! the terminal back.

use std::convert::Infallible;
use std::io;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::path::Path;
use std::sync::Arc;

use crossbeam_channel::unbounded;

use super::failure::exit_code;
use super::{Application, Compute, Files, LoopEnd, Options, Pump, Readers, input, panics, tell};
use crate::session::Notice;
use crate::terminal::{Guard, Screen, system};

/// The signal that a process receives when its terminal goes away, by its number on every system that has it.
const SIGHUP: i32 = 1;

/// Runs an application in the terminal at standard input and output; [`crate::terminal::Environment::admit`]
/// says whether there is one. Returns the exit code: 0 if the user quit, 128 + n after signal n.
///
/// A panic of the calling thread gives the terminal back and ends the program; panics of other threads do not.
/// Fails if the terminal cannot be used, or goes away while it is written to.
pub fn launch(
    application: impl Application,
    answer: Arc<Compute>,
    options: Options,
) -> io::Result<u8> {
    let guard = Guard::new()?;
    panics::install(guard.clone(), std::thread::current().id());
    let (send, events) = unbounded();
    #[cfg(unix)]
    super::signals::start(send.clone(), guard.clone())?;
    guard.mouse(options.mouse)?;
    guard.enter()?;
    input::start(send.clone())?;
    let size = || system::size().unwrap_or_default();
    let screen = Screen::new(Arc::clone(&guard.out), size());
    let mut pump = Pump::new(application, screen, answer, (send, events), options, size);
    pump.repaint()?;
    // A panic has already been reported and the terminal given back; the panic still ends the program.
    let conducted = catch_unwind(AssertUnwindSafe(|| conduct(&mut pump, &guard)));
    pump.close_record();
    let left = matches!(conducted, Ok(Err(LoopEnd::Quit)));
    let place = if left { &pump.options.last } else { &pump.options.keep };
    let kept = keep(&pump, place.as_deref());
    let Err(end) = conducted.unwrap_or_else(|panic| resume_unwind(panic));
    if !matches!(end, LoopEnd::Closed | LoopEnd::Broken(_)) {
        pump.await_terminal();
    }
    guard.leave();
    if let (Err(why), LoopEnd::Quit | LoopEnd::Ended { .. }) = (kept, &end) {
        tell(format!("the session is not kept: {why}"));
    }
    match end {
        LoopEnd::Ended { signal } => Ok(exit_code(signal)),
        LoopEnd::Closed => Ok(exit_code(SIGHUP)),
        LoopEnd::Broken(why) => Err(io::Error::other(why)),
        _ => Ok(0),
    }
}

/// Saves the session that was interrupted or left, if anything would be lost. Fails with one line that says why
/// it could not be saved.
fn keep<M: Application, W: io::Write>(
    pump: &Pump<M, W>,
    path: Option<&Path>,
) -> Result<(), String> {
    // After a panic, the state may be inconsistent.
    let text = catch_unwind(AssertUnwindSafe(|| pump.application.what_to_keep())).ok().flatten();
    let Some(text) = text else { return Ok(()) };
    let path = path.ok_or("there is no folder for it; XDG_STATE_HOME names one")?;
    Files::write(path, &text, true, Readers::Owner).map(drop)
}

/// Runs the loop through all pauses. It does not return but for an end of the program.
fn conduct<M: Application>(
    pump: &mut Pump<M, Arc<std::fs::File>>,
    guard: &Guard,
) -> Result<Infallible, LoopEnd> {
    // A stop from here is followed by an event that the process continues, which needs no further reaction.
    let mut expected = false;
    loop {
        match pump.run() {
            #[cfg(unix)]
            end @ (LoopEnd::Suspend | LoopEnd::Suspended) if super::signals::can_be_continued() => {
                pump.hold();
                pump.await_terminal();
                guard.leave();
                if end == LoopEnd::Suspend {
                    super::signals::suspend_job()?;
                    continue;
                }
                // Stops this process; returns when it continues.
                signal_hook::low_level::emulate_default_handler(signal_hook::consts::SIGTSTP)?;
                expected = true;
                guard.enter()?;
                pump.repaint()?;
            }
            LoopEnd::Suspend | LoopEnd::Suspended => {
                let text = "not stopped: there is no shell that could make it go on".to_owned();
                pump.tell(Notice { error: true, text })?;
            }
            LoopEnd::Mouse(on) => guard.mouse(on)?,
            LoopEnd::Continued if std::mem::take(&mut expected) => {}
            LoopEnd::Continued => {
                guard.leave();
                guard.enter()?;
                pump.repaint()?;
            }
            end => return Err(end),
        }
    }
}
