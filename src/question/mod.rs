//! Questions that the screen asks, and their answers.
//!
//! Each kind of question has a file with its inputs, its answer, its draft (a rougher question that is answered
//! first) and its measure of likeness. The table below lists them all; [`request`] derives the types of
//! requests, topics and answers from it, and is the only place where a question becomes a computation.

/// The table of questions by topic, the most urgent topic first: the module of the question, the name of the
/// topic on the screen, and the cost of an answer. If a machine has a question in a module of its own, that
/// follows, with the function that wraps its answer.
macro_rules! questions {
    ($make:ident) => {
        $make! {
            /// The fit of the oscillator to a record, and the margin that follows.
            Fit(fit) "fit" costs |_| Cost::default();
            /// The same with some numbers held.
            Refit(refit) "refit" costs |_| Cost::default();
            /// The motion on show.
            Trajectory(motion) "motion" costs |found| found.cost,
                or Machine(machine) answered by Whole::motion;
            /// All cycles, and the border of the basin.
            Cycles(cycles) "cycles" costs |found| found.cost,
                or Portrait(portrait) answered by Whole::cycles;
            /// Starts that are certainly safe or certainly lost.
            Zones(zones) "certainty" costs |found| found.cost,
                or MachineZones(machine_zones) answered by Answer::Zones;
            /// The fraction of random kicks that is lost.
            Kicks(kicks) "kicks" costs |found| found.cost;
            /// The borders of the bands of capture.
            Capture(capture) "bands" costs |found| found.cost;
            /// The cycles along a parameter.
            Branch(branch) "branch" costs |found| found.cost;
            /// The cycles by N harmonics.
            Balance(balance) "harmonics" costs |found| found.cost;
            /// The return map.
            ReturnMap(return_map) "return map" costs |found| found.cost;
            /// The fate of kicks over two parameters.
            Regimes(regimes) "regimes" costs |found| found.cost;
            /// The cycles of a machine over the speed of its belt.
            Speeds(speeds) "speeds" costs |found| found.cost;
            /// Accuracy against cost of every method.
            Trade(trade) "trade" costs |found| found.cost();
            /// The rows of a scan that are still missing.
            Scan(scan) "scan" costs |found| found.cost();
            /// The claims of the paper, checked by computation.
            Claims(claims) "paper" costs |_| Cost::default();
            /// A proof of the number of cycles.
            Proof(proof) "proof" costs |_| Cost::default();
            /// The reference against which errors are measured; the least urgent.
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
pub mod motion;
pub mod portrait;
pub mod proof;
pub mod reference;
pub mod refit;
pub mod regimes;
pub mod request;
pub mod resources;
pub mod return_map;
pub mod scan;
pub mod speeds;
pub mod trade;
pub mod whole;
pub mod zones;

pub use answered::{Answered, NoAnswer};
pub use capture::Borders;
pub use fit::{Fit, Fitted, Opened, Recording};
pub use kind::Motion;
pub use request::{Answer, Request, TOPICS, Topic, Whole, answer, answer_by, answer_for};
pub use resources::{Fineness, Resources, Rows};
