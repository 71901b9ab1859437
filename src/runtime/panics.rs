//! Panics: one of the interface ends the program, one of a worker does not.

use std::any::Any;
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::ThreadId;

use crate::terminal::Guard;

/// Messages and places of panics, noted by the hook: the code that catches a panic does not know the place.
#[derive(Clone, Debug, Default)]
pub struct Notes(Arc<Mutex<Option<String>>>);

impl Notes {
    fn put(&self, note: String) {
        *self.0.lock().unwrap_or_else(PoisonError::into_inner) = Some(note);
    }

    /// Takes the note of the last panic.
    pub fn take(&self) -> Option<String> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).take()
    }
}

/// Installs a hook by which a panic of the thread `interface` gives the terminal back before it is reported as
/// usual.
///
/// A panic in any other thread is not reported and leaves the terminal alone, because the interface continues
/// and shows it; the returned notes contain what to show.
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

/// The message of a panic.
pub fn message(payload: &(dyn Any + Send)) -> String {
    let text = payload.downcast_ref::<&str>().copied();
    let owned = || payload.downcast_ref::<String>().map(String::as_str);
    text.or_else(owned).unwrap_or("no message").to_owned()
}
