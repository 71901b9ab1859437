//! What questions are about.

/// What a request asks about.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Topic {
    /// The fit of a record.
    Fit,
    /// The motion.
    Trajectory,
    /// Cycles and basin edge.
    Cycles,
    /// What is safe and what is lost for certain.
    Zones,
    /// The bands of capture.
    Capture,
    /// The diagram.
    Branch,
    /// Harmonic balance.
    Balance,
    /// The return map.
    ReturnMap,
    /// The chart of regimes.
    Regimes,
    /// The cycles over the speed of the belt.
    Speeds,
    /// What accuracy costs.
    Trade,
    /// The scan.
    Scan,
    /// The claims of the paper.
    Claims,
    /// What errors are measured against: wanted last of all.
    Reference,
}

/// Every topic, the most urgent first.
pub const TOPICS: [Topic; 14] = [
    Topic::Fit,
    Topic::Trajectory,
    Topic::Cycles,
    Topic::Zones,
    Topic::Capture,
    Topic::Branch,
    Topic::Balance,
    Topic::ReturnMap,
    Topic::Regimes,
    Topic::Speeds,
    Topic::Trade,
    Topic::Scan,
    Topic::Claims,
    Topic::Reference,
];

impl Topic {
    /// Whether it is asked of each variant that a plot shows.
    #[must_use]
    pub fn is_of_variants(self) -> bool {
        matches!(self, Topic::Trajectory | Topic::Cycles | Topic::Branch)
    }

    /// The name on the screen.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Topic::Trajectory => "motion",
            Topic::Cycles => "cycles",
            Topic::Zones => "certainty",
            Topic::Capture => "bands",
            Topic::Branch => "branch",
            Topic::Balance => "harmonics",
            Topic::ReturnMap => "return map",
            Topic::Regimes => "regimes",
            Topic::Speeds => "speeds",
            Topic::Trade => "trade",
            Topic::Reference => "reference",
            Topic::Scan => "scan",
            Topic::Claims => "paper",
            Topic::Fit => "fit",
        }
    }
}
