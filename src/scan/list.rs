//! A list of parameter sets, which a scan goes through in place of a grid.

use crate::model::{Group, Knob};

/// Numbers, and their values at each point.
#[derive(Clone, Debug, PartialEq)]
pub struct PointList {
    /// The numbers that are set.
    pub(super) knobs: Vec<Knob>,
    /// Their values, a row for each point.
    pub(super) rows: Vec<Vec<f64>>,
}

impl PointList {
    /// Reads comma-separated values whose first line names numbers of these groups. A value has a unit or is in SI units.
    ///
    /// # Errors
    /// One line that says what is wrong where, and what is allowed.
    pub fn read(text: &str, groups: &[Group]) -> Result<Self, String> {
        let lines = text.lines().enumerate().filter(|(_, line)| !line.trim().is_empty());
        let mut lines = lines.map(|(index, line)| (index + 1, cells(line)));
        let (first, names) = lines.next().ok_or("expected a line of names, such as D,r")?;
        let mut knobs = Vec::new();
        for name in names {
            let knob = Knob::named(name, groups).map_err(|why| format!("line {first}: {why}"))?;
            if knobs.contains(&knob) {
                return Err(format!("line {first}: two columns {knob}"));
            }
            knobs.push(knob);
        }
        let row = |(line, cells): (usize, Vec<&str>)| {
            if let Some(knob) = knobs.get(cells.len()) {
                return Err(format!("line {line}: no value of {knob}"));
            }
            if cells.len() > knobs.len() {
                let (given, known) = (cells.len(), knobs.len());
                return Err(format!("line {line}: {given} values for {known} columns"));
            }
            let value = |(knob, cell): (&Knob, &str)| {
                let value = knob.parse(cell);
                value.map_err(|why| format!("line {line}, column {knob}: {why}"))
            };
            knobs.iter().zip(cells).map(value).collect()
        };
        let rows = lines.map(row).collect::<Result<Vec<_>, _>>()?;
        if rows.is_empty() {
            return Err("no parameter set below the line of names".to_owned());
        }
        Ok(PointList { knobs, rows })
    }
}

/// The cells of a line, without blanks and quotes around them.
fn cells(line: &str) -> Vec<&str> {
    let cells = line.trim_start_matches('\u{feff}').split(',');
    cells.map(|cell| cell.trim().trim_matches('"').trim()).collect()
}
