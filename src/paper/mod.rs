//! The paper against computation: every claim that can be tested, tested.
//!
//! `assets/claims.txt` is the table. A [`Claim`] says where it stands, what it says, at which oscillators it is tested, and
//! holds a [`Test`], by its name in the files of this folder, that evaluates the paper's formula and computes the same
//! thing without it: by integrating motions, by searching cycles, by differentiating the physical law. From that follows
//! an [`Evidence`], numbers and nothing else, and from the numbers the [`Verdict`] by one rule for all claims
//! ([`Evidence::verdict`]). Where a proof encloses what was computed, a [`Certainty`] says what is certain.

mod beyond;
mod bifurcation;
mod equilibria;
mod harmonic;
mod measure;
pub(crate) mod model;
mod verdict;

pub(crate) use measure::*;

pub use verdict::{Approximation, Certainty, Conclusion, Evidence, POOR, Sense, Verdict};

use std::sync::LazyLock;

use crate::flow::{Limits, Reason, Result};
use crate::numerics::cells;
use measure::ClaimCase;

/// A sentence or an equation of the paper that numbers can decide.
#[derive(Debug)]
pub struct Claim {
    /// Number of the equation or of the figure, or a word for what has no number.
    pub equation: &'static str,
    /// Section of the paper; [`UNSAID`] for what the paper does not say.
    pub section: &'static str,
    /// What it says.
    pub statement: &'static str,
    /// What its numbers are compared with: an equation of the paper by its number, or what is computed without
    /// any, such as the true `cycle`, a `motion`, the `border` of the basin, the friction `law` itself.
    pub basis: &'static str,
    /// A scene that shows it.
    pub scene: Option<&'static str>,
    /// Where it is tested, a line for the cases of each [`ClaimCase::all`].
    cases: Vec<&'static str>,
    test: &'static Test,
}

/// What is asked in a case, or why there is no answer.
type Ask<T> = fn(&ClaimCase) -> Result<T>;

/// How a claim is put to the test: a formula is evaluated, and the same thing computed otherwise.
#[derive(Debug)]
enum Test {
    /// By numbers, of which those of the worst case decide.
    Worst(Ask<Evidence>),
    /// By whether it holds in each case.
    Always(Ask<Conclusion<bool>>),
    /// By a formula and what it approaches, in one case and in the next one, which is nearer to the limit.
    Tends(Ask<(f64, Approximation)>),
}

impl Test {
    fn run(&self, cases: &[ClaimCase]) -> Result<Evidence> {
        match self {
            Test::Worst(compare) => Evidence::worst(cases.iter().map(|case| {
                let evidence = compare(case)?;
                let unnamed = evidence.place.is_empty();
                Ok(if unnamed { evidence.at(&case.place) } else { evidence })
            })),
            Test::Always(holds) => {
                Evidence::always(cases.iter().map(|case| Ok((&case.place, holds(case)?))))
            }
            Test::Tends(compare) => Evidence::worst(cases.chunks_exact(2).map(|pair| {
                let evidence = Evidence::tends(compare(&pair[0])?, compare(&pair[1])?);
                Ok(evidence.at(&pair[1].place))
            })),
        }
    }
}

/// How a claim is tested, by the name that the table has for it.
type Check = (&'static str, Test);

const fn worst(name: &'static str, compare: Ask<Evidence>) -> Check {
    (name, Test::Worst(compare))
}

const fn always(name: &'static str, holds: Ask<Conclusion<bool>>) -> Check {
    (name, Test::Always(holds))
}

const fn tends(name: &'static str, compare: Ask<(f64, Approximation)>) -> Check {
    (name, Test::Tends(compare))
}

/// Stands for the section of what the paper does not say.
pub const UNSAID: &str = "-";

/// A claim and what became of it.
#[derive(Clone, Debug)]
pub struct ClaimResult {
    pub claim: &'static Claim,
    /// The numbers, or why there are none.
    pub evidence: Result<Evidence>,
}

impl PartialEq for ClaimResult {
    fn eq(&self, other: &Self) -> bool {
        std::ptr::eq(self.claim, other.claim) && self.evidence == other.evidence
    }
}

impl ClaimResult {
    /// What the numbers say; `None` where they could not be computed.
    pub fn verdict(&self) -> Option<Verdict> {
        self.evidence.as_ref().ok().map(Evidence::verdict)
    }

    /// What is certain, if anything is.
    pub fn mark(&self) -> Option<Certainty> {
        self.evidence.as_ref().ok()?.mark
    }
}

/// The tests of claims, section by section.
const SECTIONS: [&[Check]; 5] =
    [model::CHECKS, equilibria::CHECKS, harmonic::CHECKS, bifurcation::CHECKS, beyond::CHECKS];

static CLAIMS: LazyLock<Vec<Claim>> = LazyLock::new(|| {
    const TABLE: &str = include_str!("../../assets/claims.txt");
    let mut claims: Vec<Claim> = Vec::new();
    for line in TABLE.lines().filter(|line| !line.is_empty() && !line.starts_with('#')) {
        match (line.strip_prefix("  "), claims.last_mut()) {
            (Some(cases), Some(claim)) => claim.cases.push(cases),
            _ => claims.extend(claim(line)),
        }
    }
    claims
});

/// A line of the table; `None` if there is no test of its name.
fn claim(line: &'static str) -> Option<Claim> {
    let [name, equation, section, basis, scene, statement] = cells(line)?;
    let (_, test) = SECTIONS.into_iter().flatten().find(|(known, _)| *known == name)?;
    let scene = Some(scene).filter(|scene| *scene != "-");
    Some(Claim { equation, section, statement, basis, scene, cases: Vec::new(), test })
}

/// Every claim, in the order of the paper.
pub fn claims() -> impl Iterator<Item = &'static Claim> {
    CLAIMS.iter()
}

/// Puts all claims to the test. Fails with [`Reason::Interrupted`] and no other.
pub fn examine_all(limits: &Limits) -> Result<Vec<ClaimResult>> {
    claims().map(|claim| examine(claim, limits)).collect()
}

/// Puts one claim to the test. Fails with [`Reason::Interrupted`] and no other: any other reason belongs to the
/// answer.
pub fn examine(claim: &'static Claim, limits: &Limits) -> Result<ClaimResult> {
    let lines = if claim.cases.is_empty() {
        &[""]
    } else {
        claim.cases.as_slice()
    };
    let cases: Vec<_> = lines.iter().flat_map(|line| ClaimCase::all(line, limits)).collect();
    let evidence = Reason::tolerated(claim.test.run(&cases))?;
    let is_said = claim.section != UNSAID;
    let evidence = evidence.map(|found| if is_said { found } else { found.unsaid() });
    Ok(ClaimResult { claim, evidence })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_line_of_the_table_has_a_function_and_every_function_a_line() {
        let functions: Vec<_> = SECTIONS.into_iter().flatten().map(|(name, _)| *name).collect();
        let sections: Vec<&str> = claims().map(|claim| claim.section).collect();
        assert_eq!(sections.len(), functions.len());
        let lines = include_str!("../../assets/claims.txt").lines();
        let names = lines.filter_map(|line| line.split_once(" | ")).map(|(name, _)| name);
        assert_eq!(names.collect::<Vec<_>>(), functions);
    }

    #[test]
    fn a_line_of_cases_has_one_for_each_combination_of_its_values() {
        let line = "from q = 1 2, D = 0.5 0.9 D_F, r = 0.1 1, at rest";
        let all = ClaimCase::all(line, &Limits::PATIENT);
        assert_eq!(all.len(), 8);
        assert_eq!(all[3].place, "from q = 1, D = 0.9 D_F, r = 1, at rest");
        assert_eq!((all[3].d, all[3].r, all[3].more), (0.0, 1.0, 0.9));
        // A limit is approached in pairs.
        let limits = claims().filter(|claim| matches!(claim.test, Test::Tends(_)));
        for claim in limits {
            let cases = claim.cases.iter().flat_map(|line| ClaimCase::all(line, &Limits::PATIENT));
            assert!([2, 4].contains(&cases.count()), "{claim:?}");
        }
    }
}
