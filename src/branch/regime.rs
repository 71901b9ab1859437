//! What becomes of kicks at given parameters: the regimes of the oscillator, and what separates them.
//!
//! With friction the rest always attracts, at least for `D > -1`. How far, is decided by two numbers: the
//! fold `D_F` where `D3 > 0`, below which a stable cycle coexists, and the escape point `D_c` where
//! `D3 = 0`, above which no cycle is left to border the basin. Everything else is a matter of signs. So a
//! regime needs no search for cycles.

use serde::Serialize;

use crate::model::Parameters;

/// What becomes of motions.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Regime {
    /// Every motion comes to rest.
    Global,
    /// Motions come to rest inside an unstable cycle, and escape outside.
    Finite,
    /// Motions come to rest inside a border, and tend to a stable cycle outside.
    Coexisting,
    /// No cycle: a separatrix borders the starts that come to rest, others escape.
    Escape,
    /// Without friction: the rest repels, and every motion tends to a stable cycle.
    Cycle,
    /// Without friction: the rest repels, and nothing attracts.
    Repelling,
    /// Without friction and damping: nothing is gained or lost.
    Neutral,
}

/// Every regime with its name.
pub const REGIMES: [(Regime, &str); 7] = [
    (Regime::Global, "global"),
    (Regime::Finite, "finite"),
    (Regime::Coexisting, "coexisting"),
    (Regime::Escape, "escape"),
    (Regime::Cycle, "cycle"),
    (Regime::Repelling, "repelling"),
    (Regime::Neutral, "neutral"),
];

impl Regime {
    /// One word.
    #[must_use]
    pub fn name(self) -> &'static str {
        REGIMES[self as usize].1
    }

    /// The regime at parameters of which the boundary in D is known.
    ///
    /// That is `D_F` where `D3 > 0` (asked for only where `r > 0`; minus infinity where it is lower than
    /// anyone asks), and `D_c` where `D3 = 0` (only where `D2 != 0`; `None` where it lies below -1).
    ///
    /// Why nothing else is needed: for a given clearance exactly one D closes a cycle, so for `D3 > 0` all
    /// cycles are one graph with one maximum, the fold; for `D3 < 0` the graph rises through all `D > -1`;
    /// and between, for `D3 = 0`, it ends at `D_c`. Beyond critical negative damping the rest is a node
    /// that a motion can leave.
    #[must_use]
    pub fn of(parameters: &Parameters, boundary: Option<f64>) -> Self {
        let Parameters { d, d2, d3, r } = *parameters;
        if r == 0.0 {
            return Self::without_friction(d, d2, d3);
        }
        let below = boundary.is_some_and(|boundary| d < boundary);
        if d3 > 0.0 {
            return if below { Regime::Coexisting } else { Regime::Global };
        }
        if d <= -1.0 {
            return Regime::Escape;
        }
        if d3 < 0.0 {
            return Regime::Finite;
        }
        let cycle = if d2 == 0.0 { d < 0.0 } else { below };
        match (cycle, d2 == 0.0) {
            (true, _) => Regime::Finite,
            (false, true) => Regime::Global,
            (false, false) => Regime::Escape,
        }
    }

    fn without_friction(d: f64, d2: f64, d3: f64) -> Self {
        // The lowest term that is not zero decides next to the rest, D3 far out.
        let repels = if d == 0.0 { d3 < 0.0 } else { d < 0.0 };
        if d == 0.0 && d3 == 0.0 {
            Regime::Neutral
        } else if repels {
            if d3 > 0.0 { Regime::Cycle } else { Regime::Repelling }
        } else if d3 < 0.0 {
            Regime::Finite
        } else if d3 == 0.0 && d2 != 0.0 {
            Regime::Escape
        } else {
            Regime::Global
        }
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::branch::escape::escape_point;
    use crate::branch::fold::fold;
    use crate::flow::Limits;
    use crate::portrait::basin::cycle::cycles;
    use crate::portrait::{Border, Cycles};

    fn oscillator(d: f64, d2: f64, d3: f64, r: f64) -> Parameters {
        Parameters { d, d2, d3, r }
    }

    /// The regime at these parameters, from the boundary in D where it matters.
    pub fn regime(parameters: &Parameters) -> Regime {
        let Parameters { d, d3, r, .. } = *parameters;
        let patient = &Limits::PATIENT;
        // Without self-excitation there is none: no cycle folds there.
        let boundary = if d >= 0.0 {
            None
        } else if d3 > 0.0 && r > 0.0 {
            fold(parameters, patient).unwrap().0.map(|fold| fold.d)
        } else {
            escape_point(parameters, patient).unwrap().0
        };
        Regime::of(parameters, boundary)
    }

    /// The regime as the search for cycles sees it; with friction.
    fn by_search(found: &Cycles) -> Regime {
        let stable_outside = found.cycles.last().is_some_and(|cycle| cycle.stable);
        match (found.border, stable_outside) {
            (Border::None, false) => Regime::Global,
            (Border::None, true) => Regime::Cycle,
            (_, true) => Regime::Coexisting,
            (Border::Cycle, false) => Regime::Finite,
            (Border::Separatrix, false) => Regime::Escape,
            (other, false) => panic!("{other:?} borders no basin of the paper's oscillator"),
        }
    }

    #[test]
    fn every_regime_stands_at_its_own_row() {
        for (regime, name) in REGIMES {
            assert_eq!(regime.name(), name);
            assert_eq!(serde_json::to_value(regime).unwrap(), name);
        }
    }

    #[test]
    fn signs_and_boundaries_decide() {
        let at = |d, d2, d3, r| regime(&oscillator(d, d2, d3, r));
        assert_eq!(at(-0.3, 0.0, 0.5, 0.1), Regime::Coexisting);
        assert_eq!(at(-0.1, 0.0, 0.5, 0.1), Regime::Global);
        assert_eq!(at(-0.3, 0.0, 0.0, 0.1), Regime::Finite);
        assert_eq!(at(0.0, 0.0, 0.0, 0.1), Regime::Global);
        assert_eq!(at(0.3, 0.0, -0.5, 0.1), Regime::Finite);
        assert_eq!(at(-0.02, 0.5, 0.0, 0.1), Regime::Escape);
        assert_eq!(at(-0.05, 0.5, 0.0, 0.1), Regime::Finite);
        assert_eq!(at(-1.5, 0.0, 0.0, 0.1), Regime::Escape);
        assert_eq!(at(-0.1, 0.3, 0.5, 0.0), Regime::Cycle);
        assert_eq!(at(-0.1, 0.3, 0.0, 0.0), Regime::Repelling);
        assert_eq!(at(0.1, 0.3, 0.0, 0.0), Regime::Escape);
        assert_eq!(at(-0.0, 0.3, 0.0, 0.0), Regime::Neutral);
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(48))]
        #[test]
        fn the_search_for_cycles_sees_the_same(
            d in -0.98..0.5, d2 in -1.0..1.0, d3 in -1.0..1.0, r in 0.01..0.5, kind in 0..4,
        ) {
            let (d2, d3) = match kind {
                0 => (0.0, d3),
                1 => (d2, 0.0),
                2 => (0.0, 0.0),
                _ => (d2, d3),
            };
            let parameters = oscillator(d, d2, d3, r);
            let found = cycles(&parameters, &Limits::PATIENT).unwrap();
            let seen = if found.border == Border::None { Regime::Global } else { by_search(&found) };
            prop_assert_eq!(regime(&parameters), seen);
        }
    }
}
