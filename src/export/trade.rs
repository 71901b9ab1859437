//! What accuracy costs, in every form: rows of numbers, and for reading also a plot of error over cost.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use serde::Serialize;

use super::csv::{exact_or_empty, line};
use super::json;
use super::screen;
use super::table::Table;
use crate::flow::method::Dial;
use crate::flow::{Method, Outcome};
use crate::scene::{Point, Span, Window};
use crate::session::settings;
use crate::study::accuracy::{Reference, Row, front};
use crate::view::Look;
use crate::view::look::Role;
use crate::view::number::{count, duration, significant};
use crate::view::pane::Heading;
use crate::view::plot::{Names, Plot};

/// A row of the table, and the seconds that it took.
pub type Timed = (Row, f64);

#[derive(Serialize)]
struct Line {
    method: Method,
    tolerance: Option<f64>,
    step: Option<f64>,
    epsilon: Option<f64>,
    error: Option<f64>,
    evaluations: u64,
    steps: u64,
    seconds: f64,
    outcome: &'static str,
    arrivals: usize,
    best: bool,
    reason: Option<String>,
}

#[derive(Serialize)]
struct Document {
    rows: Vec<Line>,
    reference: String,
    reference_error: f64,
}

/// The lines of the table; the best choices are those of error and seconds.
fn lines(rows: &[Timed]) -> Vec<Line> {
    let choices: Vec<_> = rows.iter().map(|(row, seconds)| (*seconds, row.error)).collect();
    let best = front(&choices);
    let line = |((row, seconds), best): (&Timed, bool)| {
        let dial = row.problem.method.spec().dial;
        let set = |kind, value| (dial == kind).then_some(value);
        let (outcome, reason) = match row.outcome {
            Outcome::Captured { .. } => ("captured", None),
            Outcome::Moving { .. } => ("moving", None),
            Outcome::Escaped { .. } => ("escaped", None),
            Outcome::GaveUp { reason, .. } => ("gave-up", Some(reason.to_string())),
        };
        Line {
            method: row.problem.method,
            tolerance: set(Dial::Tolerance, row.problem.tolerance),
            step: set(Dial::Step, row.problem.step),
            epsilon: set(Dial::Epsilon, row.problem.epsilon),
            error: row.error,
            evaluations: row.cost.evaluations,
            steps: row.cost.steps,
            seconds: *seconds,
            outcome,
            arrivals: row.arrivals,
            best,
            reason,
        }
    };
    rows.iter().zip(best).map(line).collect()
}

/// What the errors are measured against, in words.
#[must_use]
pub fn reference_in_words(reference: &Reference) -> String {
    let error = significant(reference.error, 2);
    match reference.confirmed_by {
        None => format!("closed form, rounding {error}"),
        Some(method) => {
            let own = reference.motion.method;
            format!("{own} at its finest, {error} from {method} at its finest")
        }
    }
}

/// As a JSON document.
#[must_use]
pub fn json(reference: &Reference, rows: &[Timed]) -> String {
    json::text(&Document {
        rows: lines(rows),
        reference: reference_in_words(reference),
        reference_error: reference.error,
    })
}

/// As comma-separated values.
#[must_use]
pub fn csv(rows: &[Timed]) -> String {
    let mut out = String::from(
        "method,tolerance,step,epsilon,error,evaluations,steps,seconds,outcome,arrivals,best,reason\n",
    );
    for row in lines(rows) {
        out += &line(&[
            row.method.to_string(),
            exact_or_empty(row.tolerance),
            exact_or_empty(row.step),
            exact_or_empty(row.epsilon),
            exact_or_empty(row.error),
            row.evaluations.to_string(),
            row.steps.to_string(),
            format!("{:?}", row.seconds),
            row.outcome.to_owned(),
            row.arrivals.to_string(),
            row.best.to_string(),
            row.reason.unwrap_or_default(),
        ]);
    }
    out
}

/// Aligned columns, the plot below them, and what the errors are measured against.
#[must_use]
pub fn table(reference: &Reference, rows: &[Timed], look: &Look) -> String {
    let mut table =
        Table::new(&["method", "setting", "error", "evaluations", "time", "end", "best"]);
    let lines = lines(rows);
    for row in &lines {
        let setting = [
            row.tolerance.map(|value| format!("tolerance {value:e}")),
            row.step.map(|value| format!("step {value}")),
            row.epsilon.map(|value| format!("epsilon {value:e}")),
        ];
        let end = match row.outcome {
            "captured" => "rests".to_owned(),
            "moving" => format!("moves, {} arrivals", row.arrivals),
            other => row.reason.clone().unwrap_or_else(|| other.to_owned()),
        };
        table.row(vec![
            row.method.to_string(),
            setting.into_iter().flatten().next().unwrap_or_default(),
            row.error.map_or("-".to_owned(), |error| format!("{error:.1e}")),
            count(row.evaluations),
            duration(row.seconds),
            end,
            if row.best { "*" } else { "" }.to_owned(),
        ]);
    }
    let reference = reference_in_words(reference);
    format!(
        "{table}\n{}\nreference: {reference}\n*: nothing else is both faster and better\n",
        plot(&lines, look)
    )
}

/// The letter of a method in the plot.
fn letter(method: Method) -> char {
    match method {
        Method::Auto => 'a',
        Method::Exact => 'e',
        Method::Taylor => 't',
        Method::Dop853 => '8',
        Method::Dopri5 => '5',
        Method::Rk4 => '4',
        Method::Stiff => 'i',
        Method::Smoothed => '~',
        Method::SignRk4 => 's',
        Method::TimeStepping => 'm',
    }
}

/// The logarithm of the error over that of the time, one letter a row; later methods lie below.
fn plot(lines: &[Line], look: &Look) -> String {
    const AREA: Rect = Rect { x: 0, y: 0, width: 78, height: 24 };
    let points: Vec<(Point, char)> = lines
        .iter()
        .filter_map(|line| {
            let error = line.error.filter(|error| *error > 0.0)?;
            let point = Point { x: (1e3 * line.seconds).log10(), y: error.log10() };
            Some((point, letter(line.method)))
        })
        .collect();
    let around = |place: fn(&Point) -> f64| {
        let span = Span::covering(points.iter().map(|(point, _)| place(point)))?;
        Some(span.scaled(span.at(0.5), 1.1))
    };
    let (Some(x), Some(y)) = (around(|point| point.x), around(|point| point.y)) else {
        return String::new();
    };
    let mut buffer = Buffer::empty(AREA);
    let names = Names { title: "trade", x: "log10(time/ms)", y: "log10(error)" };
    let mut plot = Plot::new(AREA, Window { x, y }, names, &Heading::default(), look, &mut buffer);
    for (point, letter) in points.into_iter().rev() {
        plot.mark(point, letter, Role::Text);
    }
    plot.finish(&mut buffer);
    let methods: Vec<Method> = lines.iter().map(|line| line.method).collect();
    let mut key: Vec<String> = Vec::new();
    for method in methods {
        let entry = format!("{} {method}", letter(method));
        if !key.contains(&entry) {
            key.push(entry);
        }
    }
    format!("{}      {}\n", screen::text(&buffer), key.join("  "))
}

/// How the plot in a table looks.
#[must_use]
pub fn plain() -> Look {
    Look::new(settings::Look {
        glyphs: settings::Glyphs::Ascii,
        colors: settings::Colors::Never,
        ..settings::Look::default()
    })
}
