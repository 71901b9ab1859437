//! Panics: one of the interface ends the program, one of another thread does not.

use std::any::Any;
use std::cell::RefCell;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::thread::ThreadId;

use crate::terminal::Guard;

thread_local! {
    /// Message and place of the last panic of this thread, noted by the hook: the code that catches a panic does not
    /// know the place.
    static NOTE: RefCell<Option<String>> = const { RefCell::new(None) };
}

/// Installs a hook by which a panic of the thread `interface` gives the terminal back before it is reported as
/// usual.
///
/// A panic in any other thread is not reported and leaves the terminal alone, because the interface continues
/// and shows what [`caught`] tells.
pub fn install(guard: Guard, interface: ThreadId) {
    let report = std::panic::take_hook();
    std::panic::set_hook(Box::new(move |panic| {
        if std::thread::current().id() == interface {
            guard.leave();
            report(panic);
        } else {
            let place = panic.location().map(|place| format!(" ({place})"));
            NOTE.set(Some(message(panic.payload()) + &place.unwrap_or_default()));
        }
    }));
}

/// What `work` returns. Fails with the message of its panic, and the place if the hook is installed.
pub fn caught<T>(work: impl FnOnce() -> T) -> Result<T, String> {
    let told = |panic: Box<dyn Any + Send>| NOTE.take().unwrap_or_else(|| message(&*panic));
    catch_unwind(AssertUnwindSafe(work)).map_err(told)
}

/// The message of a panic.
fn message(payload: &(dyn Any + Send)) -> String {
    let text = payload.downcast_ref::<&str>().copied();
    let owned = || payload.downcast_ref::<String>().map(String::as_str);
    text.or_else(owned).unwrap_or("no message").to_owned()
}
