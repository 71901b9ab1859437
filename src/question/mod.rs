//! Questions that the screen asks, and their answers.
//!
//! Each kind of question has a file: what it asks, how that is answered, by which rougher question first, and
//! what makes two alike. [`request`] is the one table of them, and the one place where a question becomes a
//! computation.

pub mod answer;
pub mod answered;
pub mod balance;
pub mod branch;
pub mod capture;
pub mod claims;
pub mod cycles;
pub mod fit;
pub mod kind;
pub mod machine;
pub mod machine_zones;
pub mod means;
pub mod motion;
pub mod portrait;
pub mod proof;
pub mod reference;
pub mod regimes;
pub mod request;
pub mod return_map;
pub mod scan;
pub mod speeds;
pub mod topic;
pub mod trade;
pub mod whole;
pub mod zones;

pub use answer::{Answer, Whole};
pub use answered::{Answered, Failure};
pub use capture::Borders;
pub use fit::{Fit, Fitted, Recording};
pub use kind::Motion;
pub use means::{Fineness, Means, Rows};
pub use request::{Request, answer, answer_by, answer_for};
pub use topic::{TOPICS, Topic};
