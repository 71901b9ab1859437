//! Tables of friction, in the form of measured data.

use crate::model::quantity;

/// Reads a table. Each line has a velocity and a coefficient of friction, separated by a comma, or by a
/// semicolon or a tab (numbers may then have a decimal comma). `#` begins a comment, and the first line may
/// hold column names. Velocities are in m/s unless they have a unit themselves, or the name of their column has
/// one in brackets (`v [mm/s]`). Fails with one line that names the file, the line and what is expected there.
pub fn table(file: &str, text: &str) -> Result<Vec<(f64, f64)>, String> {
    let mut unit = String::new();
    let mut points = Vec::new();
    let mut names_allowed = true;
    for (index, line) in text.lines().enumerate() {
        let line = line.split('#').next().unwrap_or(line).trim();
        if line.is_empty() {
            continue;
        }
        let wrong = |what: &str| format!("{file}:{}: {what}", index + 1);
        let separator = [';', '\t'].into_iter().find(|sign| line.contains(*sign));
        // A comma that separates does not stand in a number.
        let cells = line.split(separator.unwrap_or(',')).map(|it| it.trim().replace(',', "."));
        let [v, mu] = &cells.collect::<Vec<String>>()[..] else {
            return Err(wrong(&format!(
                "{line:?} is not a velocity and a coefficient, such as 0.1, 0.35"
            )));
        };
        let names = v.starts_with(|first: char| first.is_alphabetic() || first == '"');
        if std::mem::take(&mut names_allowed) && names {
            let bracketed = v.split_once('[').and_then(|(_, rest)| rest.split_once(']'));
            unit = bracketed.map_or_else(String::new, |(unit, _)| unit.to_owned());
            continue;
        }
        let number = |text: &str, unit| quantity(text, unit).map_err(|message| wrong(&message));
        let is_bare = v.ends_with(|last: char| last.is_ascii_digit() || last == '.');
        let velocity = if is_bare { format!("{v} {unit}") } else { v.clone() };
        points.push((number(&velocity, "m/s")?, number(mu, "")?));
    }
    Ok(points)
}
