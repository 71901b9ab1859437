//! Panics: the interface's end the program, a worker's do not.

use std::any::Any;
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::ThreadId;

use crate::terminal::Guard;

/// What the panic hook knows and the code that catches the panic does not: where it happened.
#[derive(Clone, Debug, Default)]
pub struct Notes(Arc<Mutex<Option<String>>>);

impl Notes {
    fn put(&self, note: String) {
        *self.0.lock().unwrap_or_else(PoisonError::into_inner) = Some(note);
    }

    /// The note of the last panic, once.
    pub fn take(&self) -> Option<String> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).take()
    }
}

/// Makes a panic of the thread `interface` give the terminal back before it is reported as usual.
///
/// A panic in any other thread is not reported and leaves the terminal alone, since the interface
/// continues and shows it; the notes tell what to show.
pub fn install(guard: Guard, interface: ThreadId) -> Notes {
    let notes = Notes::default();
    let kept = notes.clone();
    let report = std::panic::take_hook();
    std::panic::set_hook(Box::new(move |panic| {
        if std::thread::current().id() == interface {
            guard.leave();
            report(panic);
        } else {
            let place = panic.location().map(|place| format!(" ({place})"));
            kept.put(message(panic.payload()) + &place.unwrap_or_default());
        }
    }));
    notes
}

/// What a panic said.
pub fn message(payload: &(dyn Any + Send)) -> String {
    let text = payload.downcast_ref::<&str>().copied();
    let owned = || payload.downcast_ref::<String>().map(String::as_str);
    text.or_else(owned).unwrap_or("no message").to_owned()
}
