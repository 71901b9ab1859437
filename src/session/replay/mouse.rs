//! The mouse in keystroke files: positions refer to the plots, not to the screen, so that a file has the same
//! effect at every size.

use crate::scene::Point;
use crate::session::message::pointer::{Gesture, Pointed, PointerTarget};
use crate::session::replay::script::Instruction;

/// The instruction as it is written in a file.
pub(super) fn text(Pointed { gesture, place }: &Pointed) -> String {
    let gesture = match gesture {
        Gesture::Click => "click",
        Gesture::Nearer => "nearer",
        Gesture::Farther => "farther",
    };
    match place {
        PointerTarget::Row(row) => format!("<{gesture} row {row}>"),
        PointerTarget::Plot(index, Point { x, y }) => {
            format!("<{gesture} {} {x:?} {y:?}>", index + 1)
        }
    }
}

/// Reads the text after the gesture.
pub(super) fn read(gesture: Gesture, rest: &str) -> Result<Instruction, String> {
    let words: Vec<&str> = rest.split_whitespace().collect();
    let finite = |word: &str| word.parse().ok().filter(|number: &f64| number.is_finite());
    let place = match words[..] {
        ["row", row] => row.parse().ok().map(PointerTarget::Row),
        [number, x, y] => {
            let index = number.parse().ok().and_then(|number: usize| number.checked_sub(1));
            let point = finite(x).zip(finite(y)).map(|(x, y)| Point { x, y });
            index.zip(point).map(|(index, point)| PointerTarget::Plot(index, point))
        }
        _ => None,
    };
    place.map(|place| Instruction::Pointed(Pointed { gesture, place })).ok_or_else(|| {
        format!("a place of the mouse is \"N X Y\" on plot N, from 1, or \"row N\", not {rest:?}")
    })
}

#[cfg(test)]
mod tests {
    use crate::session::replay::parse;

    #[test]
    fn what_is_written_is_read_back() {
        for line in ["<click 1 0.5 -0.25>", "<nearer 2 1e-300 2.0>", "<farther row 3>"] {
            let script = parse(line).unwrap();
            assert_eq!(script.steps[0].step.to_string(), line);
        }
    }

    #[test]
    fn a_place_that_is_none_is_named() {
        for line in ["<click>", "<click 1 1>", "<click 1 NaN 0>", "<click 0 1 1>", "<click row -1>"]
        {
            let said = parse(line).unwrap_err().to_string();
            assert!(said.contains("a place of the mouse is"), "{said}");
        }
    }
}
