//! What a vibration mode does, in physical units.

use serde::Serialize;

use super::document::{Cost, DesignOf, MotionOf, Whole};
use super::table::{border, csv_rows, cycles, fate, gaps, sheet};
use super::{Designed, Head, PLACES, RestShare, margins};
use crate::machine::survey::Course;
use crate::report::json::text;
use crate::scene::machine::mode::Mode;
use crate::words::number::duration;
use crate::words::quantity::with_unit;

/// Everything that is said about a mode.
pub struct ModeAnswer<'a> {
    pub mode: &'a Mode,
    pub course: &'a Course,
    pub rest_share: RestShare,
    /// The friction for a margin, if asked for.
    pub design: Option<Designed>,
    pub seconds: f64,
}

#[derive(Serialize)]
struct Document<'a> {
    machine: &'a str,
    model: &'static str,
    #[serde(flatten)]
    whole: Whole,
    motion: MotionOf,
    #[serde(skip_serializing_if = "RestShare::is_not_asked")]
    rest_share: RestShare,
    #[serde(skip_serializing_if = "Option::is_none")]
    design: Option<DesignOf>,
    cost: Cost,
}

/// The answer as a document, in SI units.
pub fn json(answer: &ModeAnswer) -> String {
    let course = answer.course;
    text(&Document {
        machine: &answer.mode.name,
        model: "whole",
        whole: Whole::new(&course.portrait),
        motion: MotionOf::new(answer.mode.start, course),
        rest_share: answer.rest_share,
        design: answer.design.as_ref().map(DesignOf::new),
        cost: Cost { steps: course.portrait.steps, seconds: answer.seconds },
    })
}

/// The answer, to read.
pub fn table(answer: &ModeAnswer) -> String {
    let (mode, course) = (answer.mode, answer.course);
    let [displacement, impulse] = margins(&course.portrait);
    let all = |value: Option<f64>, unit| {
        value.map_or_else(|| "every one".to_owned(), |value| with_unit(value, PLACES, unit))
    };
    let mut out = format!("{}: {}\n{}\n\n", mode.name, mode.title, Head::of_mode(mode).but(""));
    out += &format!("survives displacements up to: {}\n", all(displacement, "m"));
    out += &format!("survives impulses up to: {}\n", all(impulse, "N s"));
    out += &format!("{}\n\n{}", border(&course.portrait), cycles(&course.portrait.cycles));
    out += &gaps(&course.portrait);
    out += &format!("{}\n", fate(mode.start, course));
    out += &answer.rest_share.line();
    if let Some(designed) = &answer.design {
        out += &format!("{}\n", designed.sentence());
    }
    out + &format!("{} steps, {}\n", course.portrait.steps, duration(answer.seconds))
}

/// One row for each number, in SI units.
pub fn csv(answer: &ModeAnswer) -> String {
    let mut out = sheet();
    csv_rows(&mut out, &answer.course.portrait, answer.rest_share);
    out.into_text()
}
