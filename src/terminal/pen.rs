//! The pen: the colours and attributes with which the terminal draws, and the shortest way to change them.

use std::fmt::Write;

use ratatui::buffer::Cell;
use ratatui::style::{Color, Modifier};

/// The attributes of cells that are drawn, each with the codes that switch it on and off.
///
/// One code switches off both bold and dim; `difference` then switches the other on again.
const ATTRIBUTES: [(Modifier, u16, u16); 6] = [
    (Modifier::BOLD, 1, 22),
    (Modifier::DIM, 2, 22),
    (Modifier::ITALIC, 3, 23),
    (Modifier::UNDERLINED, 4, 24),
    (Modifier::REVERSED, 7, 27),
    (Modifier::CROSSED_OUT, 9, 29),
];

/// Attributes that are visible on blank cells too.
const SEEN_ON_BLANKS: Modifier =
    Modifier::UNDERLINED.union(Modifier::REVERSED).union(Modifier::CROSSED_OUT);

/// The colours and attributes of the next character.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Pen {
    /// Colour of the character.
    pub foreground: Color,
    pub background: Color,
    /// Bold and the like.
    pub attributes: Modifier,
}

impl Pen {
    /// The terminal's own colours, no attributes.
    pub const PLAIN: Pen =
        Pen { foreground: Color::Reset, background: Color::Reset, attributes: Modifier::empty() };

    pub fn of(cell: &Cell) -> Pen {
        Pen { foreground: cell.fg, background: cell.bg, attributes: cell.modifier }
    }

    /// Whether a blank looks the same with both pens.
    pub fn is_alike_on_blanks(self, other: Pen) -> bool {
        let seen = self.attributes.union(other.attributes).intersects(SEEN_ON_BLANKS);
        self == other || (self.background == other.background && !seen)
    }

    /// Writes the shorter of two sequences that change to this pen, from the `present` one if it is known: the
    /// differences only, or a reset and all of this pen.
    pub fn take_up(self, present: Option<Pen>, out: &mut String) {
        if present == Some(self) {
            return;
        }
        let anew = Pen::PLAIN.difference(self);
        let parameters = match present.map(|present| present.difference(self)) {
            Some(difference) if length(&difference) <= length(&anew) + 2 => difference,
            _ if self == Pen::PLAIN => anew,
            _ => std::iter::once(0).chain(anew).collect(),
        };
        out.push_str("\x1b[");
        for (place, parameter) in parameters.iter().enumerate() {
            let separator = if place == 0 { "" } else { ";" };
            // Writing to a string cannot fail.
            let _ = write!(out, "{separator}{parameter}");
        }
        out.push('m');
    }

    /// Parameters that change this pen to another: they switch off the attributes that the other lacks, and
    /// switch on those that it adds.
    fn difference(self, to: Pen) -> Vec<u16> {
        let mut parameters = Vec::new();
        let mut present = self.attributes;
        for (attribute, _, off) in ATTRIBUTES {
            if present.contains(attribute) && !to.attributes.contains(attribute) {
                parameters.push(off);
                let alike = ATTRIBUTES.iter().filter(|(.., same)| *same == off);
                alike.for_each(|(other, ..)| present.remove(*other));
            }
        }
        let added = to.attributes.difference(present);
        let added = ATTRIBUTES.iter().filter(|(attribute, ..)| added.contains(*attribute));
        parameters.extend(added.map(|(_, on, _)| on));
        if self.foreground != to.foreground {
            push_colour(&mut parameters, to.foreground, 30);
        }
        if self.background != to.background {
            push_colour(&mut parameters, to.background, 40);
        }
        parameters
    }
}

/// Appends the parameters of a colour; `base` is 30 for the foreground and 40 for the background.
pub(super) fn push_colour(parameters: &mut Vec<u16>, colour: Color, base: u16) {
    match colour {
        Color::Rgb(red, green, blue) => {
            parameters.extend([base + 8, 2, red.into(), green.into(), blue.into()]);
        }
        Color::Indexed(dark @ 0..8) => parameters.push(base + u16::from(dark)),
        Color::Indexed(bright @ 8..16) => parameters.push(base + 60 + u16::from(bright) - 8),
        Color::Indexed(other) => parameters.extend([base + 8, 5, other.into()]),
        // The views name no colour, but number it.
        _ => parameters.push(base + 9),
    }
}

/// Length of a select-graphic-rendition sequence with these parameters, without `ESC[`.
fn length(parameters: &[u16]) -> usize {
    let digits = |number: &u16| {
        if *number < 10 {
            1
        } else {
            2 + usize::from(*number > 99)
        }
    };
    parameters.iter().map(|number| digits(number) + 1).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The sequence from one pen to another.
    fn change(from: Option<Pen>, to: Pen) -> String {
        let mut out = String::new();
        to.take_up(from, &mut out);
        out
    }

    fn pen(foreground: Color, attributes: Modifier) -> Pen {
        Pen { foreground, attributes, ..Pen::PLAIN }
    }

    #[test]
    fn the_sixteen_colours_are_short() {
        let red = pen(Color::Indexed(1), Modifier::empty());
        let cases = [
            (None, red, "\x1b[0;31m"),
            (Some(Pen::PLAIN), red, "\x1b[31m"),
            (Some(red), pen(Color::Indexed(9), Modifier::BOLD), "\x1b[1;91m"),
            (Some(red), Pen { background: Color::Indexed(15), ..red }, "\x1b[107m"),
            (Some(red), pen(Color::Indexed(208), Modifier::empty()), "\x1b[38;5;208m"),
            (Some(red), pen(Color::Rgb(1, 20, 255), Modifier::empty()), "\x1b[38;2;1;20;255m"),
            (Some(red), red, ""),
        ];
        for (from, to, sequence) in cases {
            assert_eq!(change(from, to), sequence, "{from:?} to {to:?}");
        }
    }

    #[test]
    fn superfluous_attributes_are_switched_off_or_all_are_reset_whichever_is_shorter() {
        let bold_red = pen(Color::Indexed(1), Modifier::BOLD);
        assert_eq!(change(Some(bold_red), Pen::PLAIN), "\x1b[m");
        assert_eq!(change(Some(bold_red), pen(Color::Indexed(1), Modifier::empty())), "\x1b[22m");
        assert_eq!(change(Some(bold_red), pen(Color::Reset, Modifier::BOLD)), "\x1b[39m");
    }

    #[test]
    fn switching_bold_off_keeps_dim() {
        let both = pen(Color::Indexed(1), Modifier::BOLD.union(Modifier::DIM));
        assert_eq!(change(Some(both), pen(Color::Indexed(1), Modifier::DIM)), "\x1b[22;2m");
    }

    #[test]
    fn blanks_care_for_what_is_seen_on_them() {
        let red = pen(Color::Indexed(1), Modifier::BOLD);
        assert!(red.is_alike_on_blanks(Pen::PLAIN));
        assert!(!red.is_alike_on_blanks(Pen { background: Color::Indexed(4), ..red }));
        assert!(!red.is_alike_on_blanks(pen(Color::Indexed(1), Modifier::UNDERLINED)));
    }
}
