//! Questions about a session, each answered by a pure function of its state.

pub mod answers;
pub(crate) mod compare;
pub mod completion;
pub mod contexts;
mod explanation;
pub mod fate;
pub mod forces;
pub mod help;
pub mod kick;
pub mod ledger;
pub mod levels;
pub(crate) mod lists;
pub mod machine;
pub mod motion;
pub mod number_line;
pub mod plots;
pub mod walk;
pub mod wants;
pub(crate) mod windows;
