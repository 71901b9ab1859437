//! Which answers depend on which numbers, by the formulas, and what each key recomputes, in every scene.
//!
//! The table below follows from the mathematics: a motion depends on everything, a cycle on the equation but
//! not on the start, a branch over D not on D. In every scene, a key must ask exactly what the table says.

use std::collections::BTreeSet;

use super::Trial;
use crate::model::Knob;
use crate::scene::{Axes, Request, Topic, library};
use crate::session::{Row, Session};

/// Whether an answer on this topic changes with a number, regardless of the plots. The columns are the four
/// parameters of the equation, the disturbance, the two numbers of the start, the end time, the method, and its
/// accuracy.
const DEPENDS: [(Topic, &str); 12] = [
    //                   equation w start until method accuracy
    (Topic::Trajectory, "  xxxx  .     xx    x     x       x"),
    (Topic::Cycles, "      xxxx  .     ..    .     .       ."),
    (Topic::Zones, "       xxxx  x     ..    .     .       ."),
    (Topic::Kicks, "       xxxx  .     ..    .     .       ."),
    (Topic::Capture, "     xxxx  .     ..    .     .       ."),
    (Topic::Branch, "      xxxx  .     ..    .     .       x"),
    (Topic::Balance, "     xxxx  .     ..    .     .       ."),
    (Topic::ReturnMap, "   xxxx  .     ..    .     .       ."),
    (Topic::Regimes, "     xxxx  .     ..    .     .       ."),
    (Topic::Trade, "       xxxx  .     xx    x     .       ."),
    (Topic::MachineBranch, "      xxxx  .     ..    .     .       ."),
    (Topic::Claims, "      ....  .     ..    .     .       ."),
];

fn depends(topic: Topic, row: Row) -> bool {
    let (_, letters) = DEPENDS.iter().find(|(of, _)| *of == topic).unwrap();
    let mut letters = letters.chars().filter(|letter| *letter != ' ');
    if row.is_of_machine() {
        // A number of the machine changes the equation and, with the unit of length, the start.
        return letters.take(7).any(|letter| letter == 'x');
    }
    // The rows are D, D2, D3, r, w, q0, v0, until, method, tolerance.
    let mut rows = Row::all().filter(|row| !row.is_of_machine());
    let column = rows.position(|other| other == row).unwrap();
    letters.nth(column).unwrap() == 'x'
}

/// Whether a number is an input of this topic's questions in a plot: one that the plot itself varies is not.
fn is_free(session: &Session, topic: Topic, plot: usize, row: Row) -> bool {
    let Row::Number(symbol) = row else { return true };
    let Axes { abscissa, against, .. } = session.plots[plot].axes;
    let along = match topic {
        Topic::Branch => symbol == abscissa,
        Topic::Regimes => symbol == abscissa || symbol == against,
        Topic::MachineBranch => symbol == Knob::BeltSpeed,
        _ => false,
    };
    !along
}

/// Whether the problem with this index in a plot holds a number.
fn is_held(session: &Session, plot: usize, index: usize, row: Row) -> bool {
    let Row::Number(symbol) = row else { return false };
    let variant = session.variants(plot).and_then(|variants| variants.get(index));
    variant.is_some_and(|variant| variant.held.contains_key(&symbol))
}

/// The questions on show that depend on a number.
fn expected(session: &Session, row: Row) -> Vec<Request> {
    let mut found = Vec::new();
    for plot in session.on_show() {
        for topic in session.needs(plot) {
            let depends = depends(topic, row) && is_free(session, topic, plot, row);
            for (index, request) in session.requests(topic, plot).into_iter().enumerate() {
                let Some(request) = request else { continue };
                let held = topic.is_of_variants() && is_held(session, plot, index, row);
                if depends && !held && !found.contains(&request) {
                    found.push(request);
                }
            }
        }
    }
    found
}

#[test]
fn in_every_scene_a_key_recomputes_exactly_what_depends_on_it() {
    let (mut seen, mut several) = (BTreeSet::new(), false);
    for scene in library() {
        let mut trial = Trial::open(&scene.name);
        trial.session.unfolded = true;
        // Of the numbers of the machine, only the speed of the belt is kept: the others differ in the
        // parameters they move.
        let fixed = |row: &Row| !row.is_of_machine() || *row == Row::BELT;
        for row in trial.session.rows().into_iter().filter(fixed) {
            let session = trial.session.stepped_once(row);
            let mut stepped = Trial { session, asked: Vec::new(), effects: Vec::new() };
            // With constant friction, the speed of the belt changes no parameter of the expansion, but it
            // changes the setup.
            assert!(stepped.session.setup() != trial.session.setup(), "{} {row:?}", scene.name);
            // The reference is asked only while the row of the accuracy is selected.
            stepped.session.selected = Row::Number(Knob::Until);
            stepped.session.measuring = false;
            stepped.settle();
            // The proof is asked together with the cycles.
            stepped.asked.retain(|request| request.topic() != Topic::Proof);
            let expected = expected(&stepped.session, row);
            let missing = expected.iter().any(|request| !stepped.asked.contains(request));
            let step = format!("{}: a step of {}", scene.name, row.name());
            assert!(!missing && stepped.asked.len() == expected.len(), "{step}: {expected:#?}");
            seen.extend(expected.iter().map(Request::topic));
            several |= expected.len() > 1 && expected.len() < stepped.session.asks().len();
        }
    }
    // None of these checks is vacuous.
    for topic in [Topic::Trajectory, Topic::Cycles, Topic::Branch, Topic::ReturnMap, Topic::Regimes]
    {
        assert!(seen.contains(&topic), "{topic:?}");
    }
    assert!(several);
    assert!(
        !expected(&Trial::open("supercritical").session, Row::Number(Knob::Q0))
            .iter()
            .any(|request| request.topic() == Topic::Branch)
    );
}

/// Counted: a plot of variants asks one question for each variant that depends on the number.
#[test]
fn a_step_asks_again_only_the_variants_that_depend_on_it() {
    use Topic::{Branch, Cycles, Trajectory};
    for (scene, opening, row, asked) in [
        ("fig17", 12, Knob::D, &[][..]),
        ("fig17", 12, Knob::D3, &[]),
        ("fig16b", 6, Knob::D, &[Trajectory, Cycles]),
        ("fig16b", 6, Knob::R, &[Trajectory, Cycles, Branch]),
        ("fig16b", 6, Knob::D3, &[Trajectory, Cycles, Branch, Branch, Branch]),
        ("fig15", 10, Knob::R, &[Trajectory, Cycles]),
    ] {
        let mut trial = Trial::open(scene);
        assert_eq!(trial.session.asks().len(), opening, "{scene}");
        trial.session.selected = Row::Number(row);
        assert_eq!(trial.press("<right>"), asked, "{scene}: a step of {row}");
        assert_eq!(trial.press("<left>"), [], "{scene}: the way back is known");
    }
}
