//! The form in which a scan is typed.

use crate::oscillator::{PARAMETERS, Symbol};
use crate::session::state::input::Input;
use crate::study::measure::MEASURES;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FormField {
    /// The name of a parameter.
    Parameter,
    From,
    To,
    Count,
    Measure,
}

/// One row of [`FIELDS`].
#[derive(Clone, Copy, Debug)]
pub struct FieldSpec {
    pub field: FormField,
    /// Its name on the screen.
    pub name: &'static str,
    /// What may be typed.
    pub help: &'static str,
}

const FROM: FieldSpec = FieldSpec {
    field: FormField::From,
    name: "from",
    help: "first value; log: before it for equal ratios",
};

const TO: FieldSpec = FieldSpec { field: FormField::To, name: "to", help: "last value" };

const COUNT: FieldSpec =
    FieldSpec { field: FormField::Count, name: "count", help: "how many values" };

/// Every field of the form, in the order in which they stand.
pub const FIELDS: [FieldSpec; 9] = [
    FieldSpec { field: FormField::Parameter, name: "over", help: "D, D2, D3, r, q0 or v0" },
    FROM,
    TO,
    COUNT,
    FieldSpec {
        field: FormField::Parameter,
        name: "and over",
        help: "a second parameter, or nothing",
    },
    FROM,
    TO,
    COUNT,
    FieldSpec {
        field: FormField::Measure,
        name: "measure",
        help: "one or more, with commas between",
    },
];

/// A scan being typed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ScanForm {
    /// What is typed, one line for each of [`FIELDS`].
    pub inputs: [Input; 9],
    /// The field that is typed in.
    pub at: usize,
    /// Why it was refused, until it changes.
    pub refused: Option<String>,
}

impl ScanForm {
    /// The field of the second parameter.
    pub const SECOND: usize = 4;

    /// The form as it opens the first time: over a parameter and its values.
    pub fn new(symbol: Symbol, (from, to): (f64, f64)) -> Self {
        let text = |value: f64| format!("{value:?}");
        let name = symbol.spec().name.to_owned();
        let over = [name, text(from), text(to), "100".to_owned()];
        let second = ["", "", "", "20"].map(str::to_owned);
        let mut texts = over.into_iter().chain(second).chain(["margin".to_owned()]);
        ScanForm {
            inputs: std::array::from_fn(|_| Input::new(texts.next().unwrap_or_default())),
            at: 0,
            refused: None,
        }
    }

    /// The line that is typed in.
    pub fn input_mut(&mut self) -> &mut Input {
        &mut self.inputs[self.at]
    }

    /// What a field offers to choose from.
    pub fn choices(at: usize) -> Vec<&'static str> {
        match FIELDS[at].field {
            FormField::Parameter => {
                let none = (at > 0).then_some("");
                none.into_iter().chain(PARAMETERS.map(|row| row.name)).collect()
            }
            FormField::Measure => MEASURES.map(|row| row.name).to_vec(),
            FormField::From | FormField::To | FormField::Count => Vec::new(),
        }
    }
}
