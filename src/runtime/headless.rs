//! A keystroke file played without a terminal: the same machine, the same worker, no screen.
//!
//! Nothing here waits for time to pass. While something is wanted the worker's next message is waited
//! for; when nothing is wanted the file goes on.

use std::io;

use crossbeam_channel::unbounded;
use ratatui::buffer::Buffer;
use ratatui::layout::Size;

use super::panics::Notes;
use super::picture;
use super::pump::Machine;
use super::worker::Worker;
use crate::export;
use crate::flow::{Limits, Reason};
use crate::scene::{Answer, Request};
use crate::session::replay::{Action, Player, Script, Unmet};
use crate::session::{Effect, Msg};

/// What a keystroke file showed.
#[derive(Clone, Debug)]
pub struct Played<M> {
    /// The machine at the end.
    pub machine: M,
    /// The last picture; [`crate::export::screen::text`] has its characters.
    pub screen: Buffer,
    /// The pictures that the file names, in its order.
    pub kept: Vec<(String, Buffer)>,
    /// The first expectation that was not met; the file was not played further.
    pub unmet: Option<Unmet>,
}

/// Plays a file on a machine at this size, until its end, the first expectation that is not met, or
/// until the machine wants to quit.
///
/// Effects on the world outside are not carried out: a replay writes no files and copies nothing.
///
/// # Errors
/// If the system gives no thread for the worker.
pub fn play<M: Machine>(
    mut machine: M,
    answer: impl Fn(&Request, &Limits) -> Result<Answer, Reason> + Send + 'static,
    script: Script,
    size: Size,
) -> io::Result<Played<M>> {
    let (send, messages) = unbounded();
    let worker = Worker::start(answer, Notes::default(), move |msg| drop(send.send(msg)))?;
    let mut player = Player::new(script);
    let mut size = size;
    let mut kept = Vec::new();
    let mut asked = Vec::new();
    let mut given = Some(Msg::Resize { width: size.width, height: size.height });
    let unmet = loop {
        if let Some(msg) = given.take() {
            if let Msg::Resize { width, height } = msg {
                size = Size { width, height };
            }
            if does(&mut machine, &mut player, msg) {
                break None;
            }
        }
        let wanted = machine.wants();
        if wanted != asked {
            worker.submit(wanted.clone());
            asked.clone_from(&wanted);
        }
        let screen = || export::screen::text(&picture::of(&machine, size));
        match player.next(wanted.is_empty(), screen) {
            Ok(Action::Give(msg)) => given = Some(msg),
            Ok(Action::Keep(name)) => kept.push((name, picture::of(&machine, size))),
            // The worker lives as long as its handle does, so there is a message.
            Ok(Action::Wait) => given = messages.recv().ok(),
            Ok(Action::Done) => break None,
            Err(unmet) => break Some(unmet),
        }
    };
    let screen = picture::of(&machine, size);
    Ok(Played { machine, screen, kept, unmet })
}

/// Gives a message to the machine; `true` if it wants to quit.
fn does(machine: &mut impl Machine, player: &mut Player, msg: Msg) -> bool {
    for effect in machine.update(msg) {
        match effect {
            Effect::Quit => return true,
            Effect::Play(script) => player.interject(script),
            Effect::Suspend | Effect::Repaint | Effect::Copy(_) | Effect::Write { .. } => {}
        }
    }
    false
}
