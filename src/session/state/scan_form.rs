//! The form for typing a scan.

use crate::model::Knob;
use crate::scan::measure::MEASURES;
use crate::session::state::input::Input;

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
    /// Explanation of what may be typed.
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

/// All fields of the form, in their order on the screen.
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

/// The form of a scan being typed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ScanForm {
    /// The typed texts, one for each of [`FIELDS`].
    pub inputs: [Input; 9],
    /// Index of the field with the caret.
    pub at: usize,
    /// Why the form was refused, until it is changed.
    pub refused: Option<String>,
}

impl ScanForm {
    /// Index of the field for the second parameter.
    pub const SECOND: usize = 4;

    /// The form as it opens the first time: for a sweep of this parameter over this range.
    pub fn new(symbol: Knob, (from, to): (f64, f64)) -> Self {
        let text = |value: f64| format!("{value:?}");
        let name = symbol.spec().name.to_owned();
        let over = [name, text(from), text(to), "100".to_owned()];
        let second = ["", "", "", "20"].map(str::to_owned);
        let mut texts = over.into_iter().chain(second).chain(["from-rest".to_owned()]);
        ScanForm {
            inputs: std::array::from_fn(|_| Input::new(texts.next().unwrap_or_default())),
            at: 0,
            refused: None,
        }
    }

    /// The line of the field with the caret.
    pub fn input_mut(&mut self) -> &mut Input {
        &mut self.inputs[self.at]
    }

    /// The values that a field offers for selection.
    pub fn choices(at: usize) -> Vec<&'static str> {
        match FIELDS[at].field {
            FormField::Parameter => {
                let none = (at > 0).then_some("");
                none.into_iter().chain(Knob::MOTION.map(|knob| knob.spec().name)).collect()
            }
            FormField::Measure => MEASURES.map(|row| row.name).to_vec(),
            FormField::From | FormField::To | FormField::Count => Vec::new(),
        }
    }
}
