//! The paper against computation: every claim that can be tested, tested.
//!
//! `assets/claims.txt` is the table. A [`Claim`] says where it stands, what it says, and holds a function, by its name in the
//! files of this folder, that evaluates the paper's formula and computes the same thing without it: by integrating
//! motions, by searching cycles, by differentiating the physical law. That function returns an [`Evidence`], numbers
//! and nothing else; the [`Verdict`] follows from the numbers by one rule for all claims
//! ([`Evidence::verdict`]). Where a proof encloses what was computed, a [`Certainty`] says what is certain.

mod amplitudes;
pub(crate) mod belt;
mod beyond;
mod bifurcation;
mod equilibria;
mod harmonic;
mod known;
mod linear;
mod measure;
mod model;
mod verdict;

pub use known::{Certainty, POOR, Sense};
pub use verdict::{Evidence, Verdict};

use std::sync::LazyLock;

use crate::flow::{Limits, Reason};

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
    /// Evaluates the formula and computes the same thing otherwise.
    pub check: fn(&Limits) -> Result<Evidence, Reason>,
}

/// The function that puts a claim to the test, by the name that the table has for it.
type Check = (&'static str, fn(&Limits) -> Result<Evidence, Reason>);

/// Stands for the section of what the paper does not say.
pub const UNSAID: &str = "-";

/// A claim and what became of it.
#[derive(Clone, Debug)]
pub struct ClaimResult {
    pub claim: &'static Claim,
    /// The numbers, or why there are none.
    pub evidence: Result<Evidence, Reason>,
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
}

/// The functions that put claims to the test, section by section.
const SECTIONS: [&[Check]; 7] = [
    model::CHECKS,
    equilibria::CHECKS,
    linear::CHECKS,
    harmonic::CHECKS,
    amplitudes::CHECKS,
    bifurcation::CHECKS,
    beyond::CHECKS,
];

static CLAIMS: LazyLock<Vec<Claim>> = LazyLock::new(|| {
    const TABLE: &str = include_str!("../../assets/claims.txt");
    let lines = TABLE.lines().filter(|line| !line.is_empty() && !line.starts_with('#'));
    lines.filter_map(claim).collect()
});

/// A line of the table; `None` if there is no function of its name.
fn claim(line: &'static str) -> Option<Claim> {
    let mut cells = line.split(" | ");
    let mut cell = || cells.next();
    let (name, equation, section) = (cell()?, cell()?, cell()?);
    let (basis, scene, statement) = (cell()?, cell()?, cell()?);
    let (_, check) = SECTIONS.into_iter().flatten().find(|(known, _)| *known == name)?;
    let scene = Some(scene).filter(|scene| *scene != "-");
    Some(Claim { equation, section, statement, basis, scene, check: *check })
}

/// Every claim, in the order of the paper.
pub fn claims() -> impl Iterator<Item = &'static Claim> {
    CLAIMS.iter()
}

/// Puts all claims to the test. Fails with [`Reason::Interrupted`] and no other.
pub fn examine_all(limits: &Limits) -> Result<Vec<ClaimResult>, Reason> {
    claims().map(|claim| examine(claim, limits)).collect()
}

/// Puts one claim to the test. Fails with [`Reason::Interrupted`] and no other: any other reason belongs to the
/// answer.
pub fn examine(claim: &'static Claim, limits: &Limits) -> Result<ClaimResult, Reason> {
    match (claim.check)(limits) {
        Err(Reason::Interrupted) => Err(Reason::Interrupted),
        Ok(evidence) if claim.section == UNSAID => {
            Ok(ClaimResult { claim, evidence: Ok(evidence.unsaid()) })
        }
        evidence => Ok(ClaimResult { claim, evidence }),
    }
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
}
