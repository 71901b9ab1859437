//! A machine as a page that can be signed.

use super::text::{
    MachineAnswer, OnBelt, allowed, cycles, disturbance, friction, margins, quantities, varying,
};
use crate::report::Columns;
use crate::report::cycles::{NO_CYCLE, gaps, machine_border};
use crate::report::page::{Page, PagePart, Section, SourceFile, origin};
use crate::words::number::rounded_down;
use crate::words::provenance::Provenance;
use crate::words::with_unit;

/// The page of a machine: with its pictures, what computed it, and the files of the machine.
pub fn page(
    answer: &MachineAnswer,
    pictures: &[String],
    provenance: &Provenance,
    sources: &[SourceFile],
) -> String {
    let MachineAnswer { about, course, .. } = answer;
    let (name, title) = about.machine.as_ref().map_or(("", ""), |(name, title)| (name, title));
    let portrait = &course.portrait;
    let section = |heading, parts| Section { heading, parts };
    let (margins, known) = margins(answer);
    let known = known.unwrap_or_default();
    let numbers = Columns::default()
        .text("number", |(name, _): &&(String, String)| name.clone())
        .text("value", |(_, value)| value.clone())
        .table(&about.numbers);
    let mut machine = vec![PagePart::Table("", numbers)];
    if let Some(OnBelt { expansion, .. }) = &answer.on_belt {
        machine.push(PagePart::Table("", quantities(expansion, portrait)));
        machine.push(PagePart::Text(friction(&expansion.belt.law, &expansion.reduced.mu)));
    }
    let unknown = PagePart::List(gaps(portrait));
    let cycles = cycles(&portrait.cycles);
    let cycles = if cycles.is_empty() {
        PagePart::Text(NO_CYCLE.trim_end().to_owned())
    } else {
        PagePart::Table("", cycles)
    };
    let pictures = if pictures.is_empty() { vec![] } else { vec![PagePart::Pictures(pictures)] };
    Page {
        kind: if answer.on_belt.is_some() { "A mass on a belt" } else { "A vibration mode" },
        title,
        subject: name.to_owned(),
        sections: vec![
            section(
                "",
                vec![
                    statement(answer),
                    PagePart::Text(machine_border(portrait).to_owned()),
                    unknown,
                ],
            ),
            section("Margins", vec![PagePart::Table(&known, margins)]),
            section("Machine", machine),
            section("Cycles", vec![cycles]),
            section("Pictures", pictures),
            section("Remarks", vec![PagePart::List(answer.remarks())]),
            origin(provenance, sources),
        ],
    }
    .html()
}

/// The sentence about the impulse that is survived from any rest position: the guaranteed one, if it was asked for. Its
/// number is rounded down.
fn statement<'a>(answer: &MachineAnswer) -> PagePart<'a> {
    let belt = answer.on_belt.as_ref();
    let certain = belt.and_then(|belt| Some((belt, belt.certain.as_ref()?)));
    let nominal = answer.course.portrait.margin;
    let margin = match certain {
        Some((belt, Err(reason))) => {
            let text = format!("No kick is survived for certain, for {}: {reason}.", allowed(belt));
            return PagePart::Statement { text, holds: false };
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
    PagePart::Statement { text, holds: margin.from_rest.impulse != Some(0.0) }
}
