//! Which answers depend on which numbers, by the formulas, and what each key recomputes, in every scene.
//!
//! The table below is written from the mathematics: a motion needs everything, a cycle needs the equation
//! and no start, a branch over D needs no D. What a key asks in every scene must be exactly that.

use std::collections::BTreeSet;

use super::Desk;
use crate::oscillator::Symbol;
use crate::scene::{Axes, Slot, library};
use crate::session::ROWS;
use crate::session::act::parameters;
use crate::session::{Row, Session};

/// Whether an answer of this kind changes with a number, whatever a plot looks at. The columns are the
/// four parameters of the equation, the two of the start, the end time, the method, and its accuracy.
const DEPENDS: [(Slot, &str); 9] = [
    //                   equation start until method accuracy
    (Slot::Trajectory, "  xxxx     xx    x     x       x"),
    (Slot::Cycles, "      xxxx     ..    .     .       ."),
    (Slot::Capture, "     xxxx     ..    .     .       ."),
    (Slot::Branch, "      xxxx     ..    .     .       x"),
    (Slot::Balance, "     xxxx     ..    .     .       ."),
    (Slot::ReturnMap, "   xxxx     ..    .     .       ."),
    (Slot::Regimes, "     xxxx     ..    .     .       ."),
    (Slot::Trade, "       xxxx     xx    x     .       ."),
    (Slot::Claims, "      ....     ..    .     .       ."),
];

fn depends(slot: Slot, row: Row) -> bool {
    let (_, letters) = DEPENDS.iter().find(|(of, _)| *of == slot).unwrap();
    let mut letters = letters.chars().filter(|letter| *letter != ' ');
    if row == Row::Belt {
        // Its speed moves the equation, and the start with the unit of length.
        return letters.take(6).any(|letter| letter == 'x');
    }
    // The rows are D, D2, D3, r, q0, v0, until, method, tolerance.
    let mut rows = ROWS.iter().filter(|row| **row != Row::Belt);
    let column = rows.position(|other| *other == row).unwrap();
    letters.nth(column).unwrap() == 'x'
}

/// Whether a plot looks along this number, or holds it for all of its variants: then it does not matter.
fn is_free(session: &Session, slot: Slot, plot: usize, row: Row) -> bool {
    let Row::Parameter(symbol) = row else { return true };
    let Axes { abscissa, against, .. } = session.plots[plot].axes;
    let along = match slot {
        Slot::Branch => symbol == abscissa,
        Slot::Regimes => symbol == abscissa || symbol == against,
        _ => false,
    };
    !along
}

fn is_held(session: &Session, plot: usize, row: Row) -> bool {
    let Row::Parameter(symbol) = row else { return false };
    let holds = |variants: &[crate::scene::Variant]| {
        variants.iter().all(|variant| variant.held.contains_key(&symbol))
    };
    session.variants(plot).is_some_and(holds)
}

/// The kinds on show that depend on a number.
fn expected(session: &Session, row: Row) -> BTreeSet<Slot> {
    let mut found = BTreeSet::new();
    for plot in session.on_show() {
        for slot in session.needs(plot) {
            let of_variants = DEPENDS.iter().find(|(one, _)| one.of_variants() == Some(slot));
            let one = of_variants.map_or(slot, |(one, _)| *one);
            let held = of_variants.is_some() && is_held(session, plot, row);
            if depends(one, row) && is_free(session, one, plot, row) && !held {
                found.insert(slot);
            }
        }
    }
    found
}

#[test]
fn in_every_scene_a_key_recomputes_exactly_what_depends_on_it() {
    let mut seen = BTreeSet::new();
    for scene in library() {
        let mut desk = Desk::open(&scene.name);
        desk.session.unfolded = true;
        for row in desk.session.rows() {
            let mut stepped =
                Desk { session: desk.session.clone(), asked: Vec::new(), effects: Vec::new() };
            stepped.session.selected = row;
            // At the end of a range the step goes the other way.
            for count in [1, -1] {
                if stepped.session.stand() == desk.session.stand() {
                    parameters::step(&mut stepped.session, count);
                }
            }
            // With constant friction the speed of the belt moves no number of the expansion.
            assert!(stepped.session.stand() != desk.session.stand(), "{} {row:?}", scene.name);
            // What an error is measured against is asked while the user rests on the dial.
            stepped.session.selected = Row::Until;
            stepped.session.effort.measuring = false;
            stepped.settle();
            let expected = expected(&stepped.session, row);
            let asked: BTreeSet<Slot> = stepped.asked.iter().copied().collect();
            assert_eq!(asked, expected, "{}: a step of {}", scene.name, row.name());
            let most = stepped.session.on_show().count() * expected.len();
            assert!(stepped.asked.len() <= most, "{}: asked twice", scene.name);
            seen.extend(asked);
        }
    }
    // Nothing above is vacuous: the scenes show these, alone and of variants.
    for slot in [Slot::Trajectory, Slot::Cycles, Slot::Branch] {
        assert!(seen.contains(&slot) && seen.contains(&slot.of_variants().unwrap()), "{slot:?}");
    }
    for slot in [Slot::ReturnMap, Slot::Regimes] {
        assert!(seen.contains(&slot), "{slot:?}");
    }
    assert!(
        !expected(&Desk::open("supercritical").session, Row::Parameter(Symbol::Q0))
            .contains(&Slot::Branch)
    );
}
