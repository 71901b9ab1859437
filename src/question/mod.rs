//! Questions that the screen asks, and their answers.
//!
//! Each kind of question has a file: what it asks, how that is answered, by which rougher question first, and
//! what makes two alike. The table here names them all; [`request`] makes of it what a request, a topic and an
//! answer are, and is the one place where a question becomes a computation.

/// The table of questions by topic, the most urgent topic first: the file of what is asked, the name of the topic
/// on the screen, and what the answer cost. Where a machine is asked about by another file, that follows, with what
/// its answer becomes.
macro_rules! questions {
    ($make:ident) => {
        $make! {
            /// The oscillator that a record is of, and the margin that follows.
            Fit(fit) "fit" costs |_| Cost::default();
            /// The same with some numbers held.
            Refit(refit) "refit" costs |_| Cost::default();
            /// The motion on show.
            Trajectory(motion) "motion" costs |found| found.cost,
                or Machine(machine) answered by Whole::motion;
            /// All cycles, and the border of the basin.
            Cycles(cycles) "cycles" costs |found| found.cost,
                or Portrait(portrait) answered by Whole::cycles;
            /// What is safe and what is lost for certain.
            Zones(zones) "certainty" costs |found| found.cost,
                or MachineZones(machine_zones) answered by Answer::Zones;
            /// What fraction of random kicks is lost.
            Kicks(kicks) "kicks" costs |found| found.cost;
            /// The borders of the bands of capture.
            Capture(capture) "bands" costs |found| found.cost;
            /// The cycles along a parameter.
            Branch(branch) "branch" costs |found| found.cost;
            /// The cycles of N harmonics.
            Balance(balance) "harmonics" costs |found| found.cost;
            /// From turning points to the next ones.
            ReturnMap(return_map) "return map" costs |found| found.cost;
            /// What becomes of kicks, over two parameters.
            Regimes(regimes) "regimes" costs |found| found.cost;
            /// The cycles of a machine over the speed of its belt.
            Speeds(speeds) "speeds" costs |found| found.cost;
            /// What accuracy costs.
            Trade(trade) "trade" costs |found| found.cost();
            /// The rows of a scan that are not there yet.
            Scan(scan) "scan" costs |found| found.cost();
            Claims(claims) "paper" costs |_| Cost::default();
            /// How many cycles there are for certain.
            Proof(proof) "proof" costs |_| Cost::default();
            /// What errors are measured against: wanted last of all.
            Reference(reference) "reference" costs |found|
                found.as_ref().map_or_else(|_| Cost::default(), |found| found.cost);
        }
    };
}

pub mod answered;
pub mod balance;
pub mod branch;
pub mod capture;
pub mod claims;
pub mod cycles;
pub mod fit;
pub mod kicks;
pub mod kind;
pub mod machine;
pub mod machine_zones;
pub mod means;
pub mod motion;
pub mod portrait;
pub mod proof;
pub mod reference;
pub mod refit;
pub mod regimes;
pub mod request;
pub mod return_map;
pub mod scan;
pub mod speeds;
pub mod trade;
pub mod whole;
pub mod zones;

pub use answered::{Answered, Failure};
pub use capture::Borders;
pub use fit::{Fit, Fitted, Opened, Recording};
pub use kind::Motion;
pub use means::{Fineness, Means, Rows};
pub use request::{Answer, Request, TOPICS, Topic, Whole, answer, answer_by, answer_for};
