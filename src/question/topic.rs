//! What questions are about.

/// The table of topics, the most urgent first: each with its name on the screen.
macro_rules! topics {
    ($($(#[$doc:meta])* $topic:ident $name:literal;)*) => {
        /// What a request asks about.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
        pub enum Topic {
            $($(#[$doc])* $topic,)*
        }

        /// Every topic, the most urgent first.
        pub const TOPICS: &[Topic] = &[$(Topic::$topic),*];

        impl Topic {
            /// The name on the screen.
            #[must_use]
            pub fn name(self) -> &'static str {
                match self {
                    $(Topic::$topic => $name,)*
                }
            }
        }
    };
}

topics! {
    /// The fit of a record.
    Fit "fit";
    /// The motion.
    Trajectory "motion";
    /// Cycles and basin edge.
    Cycles "cycles";
    /// What is safe and what is lost for certain.
    Zones "certainty";
    /// The bands of capture.
    Capture "bands";
    /// The diagram.
    Branch "branch";
    /// Harmonic balance.
    Balance "harmonics";
    /// The return map.
    ReturnMap "return map";
    /// The chart of regimes.
    Regimes "regimes";
    /// The cycles over the speed of the belt.
    Speeds "speeds";
    /// What accuracy costs.
    Trade "trade";
    /// The scan.
    Scan "scan";
    /// The claims of the paper.
    Claims "paper";
    /// How many cycles there are for certain.
    Proof "proof";
    /// What errors are measured against: wanted last of all.
    Reference "reference";
}

impl Topic {
    /// Whether it is asked of each variant that a plot shows.
    #[must_use]
    pub fn is_of_variants(self) -> bool {
        matches!(self, Topic::Trajectory | Topic::Cycles | Topic::Branch)
    }
}
