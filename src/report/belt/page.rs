//! A machine as a page that can be signed.

use super::table::{
    MarginRow, NO_CYCLE, allowed, border, certain, cycles, disturbance, fate, friction, gaps,
    nominal, quantities, varying,
};
use super::{MachineAnswer, OnBelt, expansion};
use crate::report::columns::Columns;
use crate::report::page::{Page, Part, Section, Source, origin};
use crate::words::number::rounded_down;
use crate::words::provenance::Provenance;
use crate::words::quantity::with_unit;

/// The page of a machine: with its pictures, what computed it, and the files of the machine.
pub fn page(
    answer: &MachineAnswer,
    pictures: &[String],
    provenance: &Provenance,
    sources: &[Source],
) -> String {
    let MachineAnswer { head, course, .. } = answer;
    let portrait = &course.portrait;
    let section = |heading, parts| Section { heading, parts };
    let mut rows = Vec::from(nominal(portrait));
    let mut known = String::new();
    if let Some(belt) = &answer.on_belt
        && let Some(Ok(margin)) = &belt.certain
    {
        rows.extend(certain(*margin));
        known = format!("guaranteed for {}", allowed(belt));
    }
    let margins = Columns::default()
        .text("smallest kick not survived", |it: &MarginRow| format!("{}, {}", it.what, it.from))
        .text("displacement", |it| it.displacement.clone())
        .text("impulse", |it| it.impulse.clone())
        .table(rows);
    let numbers = Columns::default()
        .text("number", |(name, _): &&(String, String)| name.clone())
        .text("value", |(_, value)| value.clone())
        .table(&head.numbers);
    let mut machine = vec![Part::Table("", numbers)];
    if let Some(OnBelt { expansion, .. }) = &answer.on_belt {
        machine.push(Part::Table("", quantities(expansion, portrait)));
        machine.push(Part::Text(friction(&expansion.belt.law, &expansion.reduced.mu)));
    }
    let unknown = Part::List(gaps(portrait));
    let cycles = cycles(&portrait.cycles);
    let cycles =
        if cycles.is_empty() { Part::Text(NO_CYCLE.to_owned()) } else { Part::Table("", cycles) };
    let pictures = if pictures.is_empty() { vec![] } else { vec![Part::Pictures(pictures)] };
    Page {
        kind: if answer.on_belt.is_some() { "A mass on a belt" } else { "A vibration mode" },
        title: head.title,
        subject: head.name.to_owned(),
        sections: vec![
            section("", vec![statement(answer), Part::Text(border(portrait).to_owned()), unknown]),
            section("Margins", vec![Part::Table(&known, margins)]),
            section("Machine", machine),
            section("Cycles", vec![cycles]),
            section("Pictures", pictures),
            section("Remarks", vec![Part::List(remarks(answer))]),
            origin(provenance, sources),
        ],
    }
    .html()
}

/// The sentence about the impulse that is survived from any rest position: the guaranteed one, if it was asked for. Its
/// number is rounded down.
fn statement<'a>(answer: &MachineAnswer) -> Part<'a> {
    let belt = answer.on_belt.as_ref();
    let certain = belt.and_then(|belt| Some((belt, belt.certain.as_ref()?)));
    let nominal = answer.course.portrait.margin;
    let margin = match certain {
        Some((belt, Err(reason))) => {
            let text = format!("No kick is survived for certain, for {}: {reason}.", allowed(belt));
            return Part::Statement { text, holds: false };
        }
        Some((_, Ok(margin))) => *margin,
        None => nominal,
    };
    let kick = match margin.from_rest.impulse {
        None => "every impulse".to_owned(),
        Some(0.0) => "no impulse, however small,".to_owned(),
        Some(least) => {
            format!("an impulse below {}", with_unit(rounded_down(least, 3), 3, "N s"))
        }
    };
    let varying = belt.map(varying).unwrap_or_default();
    let whichever = match varying[..] {
        [] => String::new(),
        _ => format!(", with {}", varying.join(", ")),
    };
    let whatever = belt.and_then(disturbance).map_or_else(
        || "provided that no other force acts".to_owned(),
        |force| format!("whatever a force of at most {force} does"),
    );
    let text = format!("From any rest position{whichever}, {kick} is survived, {whatever}.");
    Part::Statement { text, holds: margin.from_rest.impulse != Some(0.0) }
}

/// What else the answer says, a sentence each.
fn remarks(answer: &MachineAnswer) -> Vec<String> {
    let portrait = &answer.course.portrait;
    let fate = fate(answer.start, &answer.course);
    let mut all: Vec<String> = fate.lines().map(str::to_owned).collect();
    all.extend(answer.rest_share.line().lines().map(str::to_owned));
    all.extend(answer.on_belt.as_ref().map(|it| expansion::sentence(&it.expansion, portrait)));
    all.extend(answer.design.as_ref().map(super::DesignAnswer::sentence));
    all
}
