//! Signals, converted to events by a thread that waits for them.
//!
//! After a signal that ends the program, the loop restores the terminal and leaves with exit code 128 + n. If a
//! second one arrives, or the loop does not react because the terminal accepts no output, this module ends the
//! program.

use std::io;
use std::thread;
use std::time::Duration;

use crossbeam_channel::Sender;
use rustix::event::{PollFd, PollFlags, Timespec, poll};
use rustix::process::{Signal, getpgrp, getsid, kill_current_process_group};
use signal_hook::consts::{SIGCONT, SIGHUP, SIGINT, SIGQUIT, SIGTERM, SIGTSTP, SIGWINCH};
use signal_hook::iterator::Signals;

use super::failure::exit_code;
use super::{Event, LoopEnd};
use crate::terminal::Guard;

/// How long the loop may take to end after the first such signal.
const GRACE: Duration = Duration::from_secs(2);

/// Signals that end the program.
const ENDING: [i32; 4] = [SIGTERM, SIGHUP, SIGINT, SIGQUIT];

/// Starts the thread that waits for signals. Fails if the system provides no thread, or refuses a handler.
pub fn start(events: Sender<Event>, guard: Guard) -> io::Result<()> {
    let mut signals = Signals::new(ENDING.into_iter().chain([SIGTSTP, SIGCONT, SIGWINCH]))?;
    thread::Builder::new().name("signals".to_owned()).spawn(move || {
        let mut ending = false;
        for signal in signals.forever() {
            let event = match signal {
                SIGTSTP => Event::End(LoopEnd::Suspended),
                SIGCONT => Event::End(LoopEnd::Continued),
                SIGWINCH => Event::Resized,
                _ if ending => end_at_once(&guard, signal),
                _ => {
                    ending = true;
                    let guard = guard.clone();
                    thread::spawn(move || {
                        thread::sleep(GRACE);
                        end_at_once(&guard, signal);
                    });
                    Event::End(LoopEnd::Ended { signal })
                }
            };
            drop(events.send(event));
        }
    })?;
    Ok(())
}

/// Ends the program without waiting for anything, not even the terminal.
fn end_at_once(guard: &Guard, signal: i32) -> ! {
    guard.leave_at_once(|out| {
        let mut ready = [PollFd::new(out, PollFlags::OUT)];
        let at_once = Timespec { tv_sec: 0, tv_nsec: 0 };
        poll(&mut ready, Some(&at_once)).is_ok_and(|ready| ready > 0)
    });
    std::process::exit(exit_code(signal).into());
}

/// Whether a shell with job control can continue the process after a stop.
///
/// Nobody can continue the leader of a session, as in `ssh -t host hopfscope`: after a stop, it would hang
/// forever.
pub fn can_be_continued() -> bool {
    getsid(None).is_ok_and(|session| session != getpgrp())
}

/// Asks all processes of the job to stop, as the terminal does for Ctrl-Z: one of them may be a wrapper for
/// which the shell waits. This process gets [`LoopEnd::Suspended`]. Fails if the system refuses.
pub fn suspend_job() -> io::Result<()> {
    Ok(kill_current_process_group(Signal::TSTP)?)
}
