//! What the loop and the replay without a terminal run, and how it gets what it asks for.

use std::io;
use std::path::Path;

use ratatui::Frame;
use ratatui::layout::Size;

use super::event::LoopEnd;
use super::figure_writer::Work;
use crate::scene::Request;
use crate::session::{Effect, Key, Msg, PointerTarget};

/// A session and the way it is drawn; tests have simpler ones.
pub trait Application {
    fn update(&mut self, msg: Msg) -> Vec<Effect>;

    /// The requests to be computed now: wanted, and neither answered nor failed.
    fn wants(&self) -> Vec<Request>;

    /// Whether the passing of time changes the state, so that it wants to be told of it.
    fn is_moving(&self) -> bool {
        false
    }

    /// Whether a press waits for an answer: then everything that the user does has to wait.
    fn is_waiting(&self) -> bool {
        false
    }

    /// Whether a key does its own work while a caption waits to be read, instead of going on.
    fn tries(&self, _key: Key) -> bool {
        false
    }

    /// How many presses the last command took that asked for something outside.
    fn asked(&self) -> u32 {
        1
    }

    /// What a cell of a screen of this size stands for, if anything.
    fn place(&self, _size: Size, _column: u16, _row: u16) -> Option<PointerTarget> {
        None
    }

    /// What to keep of it if it is interrupted, as the text of a file; `None`: nothing would be missed.
    fn what_to_keep(&self) -> Option<String> {
        None
    }

    /// Makes a figure of what it shows, or of one plot of it, in the form that the ending of a file asks
    /// for; the work is done elsewhere. Fails with one line that says why there is none.
    fn figure(&self, _path: &Path, _plot: Option<usize>) -> Result<Work, String> {
        Err("nothing to write".to_owned())
    }

    /// Whether the background of the terminal matters and is not known.
    fn asks_for_background(&self) -> bool {
        false
    }

    /// The terminal has a light background, or a dark one.
    fn background(&mut self, _is_light: bool) {}

    fn draw(&self, frame: &mut Frame);
}

/// What comes of an effect.
#[derive(Debug)]
pub enum EffectOutcome {
    Done,
    /// The application is to be told something, which may have effects of its own.
    Told(Msg),
    /// The loop ends, or pauses.
    Stop(LoopEnd),
}

/// What runs an application: it carries out what the application asks for.
pub trait Host {
    type Application: Application;

    fn application(&mut self) -> &mut Self::Application;

    fn carry_out(&mut self, effect: Effect) -> io::Result<EffectOutcome>;

    /// Gives the application a message, and what comes of its effects in their order.
    fn give(&mut self, msg: Msg) -> io::Result<Option<LoopEnd>> {
        for effect in self.application().update(msg) {
            let stop = match self.carry_out(effect)? {
                EffectOutcome::Done => None,
                EffectOutcome::Told(msg) => self.give(msg)?,
                EffectOutcome::Stop(stop) => Some(stop),
            };
            if stop.is_some() {
                return Ok(stop);
            }
        }
        Ok(None)
    }
}
