//! Answers as JSON documents: numbers in shortest round-trip form, `null` where a value does not exist.

use serde::Serialize;

use super::{balance, proof};
use crate::closed_form::harmonic::Harmonic;
use crate::flow::{Cost, Crossing, Method, Outcome, Trajectory};
use crate::oscillator::{Ledger, Parameters, State, Symbol};
use crate::proof::cycles::Proof;
use crate::scene::Scene;
use crate::scene::said::{Condition, said};
use crate::session::Keymap;
use crate::study::basin::Survey;
use crate::study::fold::{Border, BorderPoint};
use crate::study::harmonic_error::HarmonicBalance;
use crate::study::{Branch, BranchPoint, Cycles, Edge, Special};

/// What an answer cost, counted and timed.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Price {
    /// Counted.
    #[serde(flatten)]
    pub counted: Cost,
    /// Wall-clock seconds inside the process.
    pub seconds: f64,
}

#[derive(Serialize)]
struct TrajectoryDocument<'a> {
    parameters: &'a Parameters,
    initial: &'a State,
    method: Method,
    tolerance: f64,
    outcome: &'a Outcome,
    events: &'a [Crossing],
    energy: Option<&'a Ledger>,
    cost: Price,
}

#[derive(Serialize)]
struct Basin {
    edge: Edge,
}

#[derive(Serialize)]
struct CyclesDocument<'a> {
    parameters: &'a Parameters,
    cycles: Vec<proof::Row<'a>>,
    count: proof::Count<'a>,
    harmonic: &'a [Harmonic],
    #[serde(skip_serializing_if = "Option::is_none")]
    balance: Option<Vec<balance::Row>>,
    basin: Basin,
    cost: Price,
}

#[derive(Serialize)]
struct PieceOf<'a> {
    piece: usize,
    #[serde(flatten)]
    point: &'a BranchPoint,
}

#[derive(Serialize)]
struct BranchDocument<'a> {
    parameter: Symbol,
    points: Vec<PieceOf<'a>>,
    special: &'a [Special],
    cost: Price,
}

#[derive(Serialize)]
struct SurveyDocument<'a> {
    #[serde(flatten)]
    found: &'a Survey,
    cost: Price,
}

#[derive(Serialize)]
struct BorderDocument<'a> {
    parameters: &'a Parameters,
    parameter: Symbol,
    points: &'a [BorderPoint],
    cost: Price,
}

#[derive(Serialize)]
struct SceneDocument<'a> {
    name: &'a str,
    title: &'a str,
    look: String,
    press: String,
    parameters: &'a Parameters,
    initial: &'a State,
    until: f64,
}

/// A motion.
#[must_use]
pub fn trajectory(motion: &Trajectory, seconds: f64) -> String {
    text(&TrajectoryDocument {
        parameters: &motion.problem.parameters,
        initial: &motion.problem.initial,
        method: motion.method,
        tolerance: motion.problem.tolerance,
        outcome: &motion.outcome,
        events: &motion.crossings,
        energy: motion.ledger.as_ref(),
        cost: Price { counted: motion.cost, seconds },
    })
}

/// Every cycle with what is proved about it, and beside them the harmonic balance if asked for.
#[must_use]
pub fn cycles(
    found: &Cycles,
    proof: &Proof,
    rungs: Option<&[HarmonicBalance]>,
    seconds: f64,
) -> String {
    text(&CyclesDocument {
        parameters: &found.parameters,
        cycles: proof::rows(&found.cycles, proof),
        count: proof::count(proof),
        harmonic: &found.harmonic,
        balance: rungs.map(balance::rows),
        basin: Basin { edge: found.edge },
        cost: Price { counted: found.cost, seconds },
    })
}

/// The cycles along a parameter; `piece` numbers the connected pieces.
#[must_use]
pub fn branch(branch: &Branch, seconds: f64) -> String {
    let pieces = branch.pieces.iter().enumerate();
    text(&BranchDocument {
        parameter: branch.parameter,
        points: pieces
            .flat_map(|(piece, points)| points.iter().map(move |point| PieceOf { piece, point }))
            .collect(),
        special: &branch.special,
        cost: Price { counted: branch.cost, seconds },
    })
}

/// A basin over a window.
#[must_use]
pub fn basin(found: &Survey, seconds: f64) -> String {
    text(&SurveyDocument { found, cost: Price { counted: found.cost, seconds } })
}

/// The fold and the escape point along a second parameter.
#[must_use]
pub fn border(found: &Border, seconds: f64) -> String {
    text(&BorderDocument {
        parameters: &found.parameters,
        parameter: found.second,
        points: &found.points,
        cost: Price { counted: found.cost, seconds },
    })
}

/// The list of scenes.
#[must_use]
pub fn scenes<'a>(scenes: impl IntoIterator<Item = &'a Scene>) -> String {
    let keymap = Keymap::default();
    // What always holds, and what holds of the numbers given here.
    let here = |one| matches!(one, Condition::Here | Condition::Opened);
    let sentence = |text: &str| keymap.fill(&said(text, here), |key| key.to_string());
    let document = |scene: &'a Scene| SceneDocument {
        name: &scene.name,
        title: &scene.title,
        look: sentence(&scene.look),
        press: sentence(&scene.press),
        parameters: &scene.problem.parameters,
        initial: &scene.problem.initial,
        until: scene.problem.until,
    };
    text(&scenes.into_iter().map(document).collect::<Vec<_>>())
}

/// A document and a newline.
///
/// # Panics
/// Never: strings, numbers and structs of them have no way to fail, and keys are strings.
pub fn text(document: &impl Serialize) -> String {
    match serde_json::to_string(document) {
        Ok(text) => text + "\n",
        Err(error) => unreachable!("a document cannot be written: {error}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_that_do_not_exist_are_null_and_the_others_come_back() {
        let special = Special::new(crate::study::SpecialKind::Escape, 0.1, None);
        let branch = Branch {
            parameter: Symbol::D,
            pieces: Vec::new(),
            special: vec![special],
            cost: Cost::default(),
        };
        let expected = r#"{"parameter":"D","points":[],"special":[{"kind":"escape","value":0.1,"q_max":null}],"cost":{"evaluations":0,"steps":0,"rejected":0,"seconds":null}}"#;
        assert_eq!(super::branch(&branch, f64::NAN), format!("{expected}\n"));
    }
}
