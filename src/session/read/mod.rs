//! Questions about a session, each answered by a pure function of its state.

pub mod belt;
pub(in crate::session) mod certain;
pub mod completion;
pub mod contexts;
pub mod fate;
pub mod fit;
pub mod fitted;
mod last_answers;
pub mod ledger;
pub mod lists;
pub mod motion;
pub mod motions;
pub mod numbers;
pub mod palette;
pub mod playback;
pub mod plots;
pub mod requirement;
pub mod scan;
pub(in crate::session) mod search;
pub mod trade;
pub mod variants;
pub mod waiting;
pub mod walk;
pub mod wants;
