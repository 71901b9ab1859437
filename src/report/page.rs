//! An answer as a page that can be kept, printed and signed: one file of HTML that needs no other file, no network
//! and no script, and is well-formed as XML.

use super::answer::{Answer, Part};
use super::table::Table;
use crate::words::printable::xml;
use crate::words::provenance::Provenance;

/// How the page looks on a screen, on a phone and on A4.
const STYLE: &str = include_str!("../../assets/report.css");

/// A file that an answer was computed from.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SourceFile {
    pub name: String,
    /// When it was last changed; `None` for a pipe and for a file of the program.
    pub changed: Option<String>,
    /// The SHA-256 of its bytes, in hexadecimal digits.
    pub sha256: String,
}

impl Answer {
    /// The answer as a file, with its kind, pictures as SVG, the names of whose parts differ, what computed it, and from
    /// which files.
    pub fn page(
        self,
        kind: &str,
        pictures: &[String],
        provenance: &Provenance,
        sources: &[SourceFile],
    ) -> String {
        let [name, subject] = &self.head;
        let title = element("title", &xml(&format!("{name}: {kind}")));
        let head = format!(
            "<meta charset=\"utf-8\"/>\n<meta name=\"viewport\" content=\"width=device-width\"/>\n{title}\n{}",
            element("style", STYLE)
        );
        let above = [
            element("p class=\"kind\"", &xml(kind)),
            element("h1", &xml(name)),
            element("p", &xml(subject)),
        ];
        let mut sections = vec![("", String::new())];
        for part in self.parts {
            match (part, sections.last_mut()) {
                (Part::Heading(heading), _) => sections.push((heading, String::new())),
                (part, Some((_, inside))) => *inside += &part_html(part),
                (_, None) => {}
            }
        }
        if !pictures.is_empty() {
            let pictures = pictures.iter().map(|picture| element("figure", picture));
            let pictures = element("div class=\"pictures\"", &pictures.collect::<String>());
            sections.push(("Pictures", pictures));
        }
        sections.push(("Origin", origin(provenance, sources)));
        let sections: String = sections.into_iter().map(section).collect();
        let body =
            element("body", &element("main", &(element("header", &above.concat()) + &sections)));
        let page = element(
            "html lang=\"en\" xmlns=\"http://www.w3.org/1999/xhtml\"",
            &(element("head", &head) + &body),
        );
        format!("<!DOCTYPE html>\n{page}")
    }
}

/// What computed an answer, from which files, and room for a date and a signature on paper.
fn origin(provenance: &Provenance, sources: &[SourceFile]) -> String {
    let mut facts = vec![("program", provenance.build()), ("command", provenance.command.clone())];
    if sources.is_empty() {
        facts.push(("file", "none, a part of the program".to_owned()));
    }
    for source in sources {
        facts.push(("file", source.name.clone()));
        facts.extend(source.changed.clone().map(|date| ("last changed", date)));
        facts.push(("SHA-256", source.sha256.clone()));
    }
    let fact = |(name, value): (&str, String)| element("dt", name) + &element("dd", &xml(&value));
    let lines = ["Name", "Date", "Signature"].map(|line| element("span", line)).concat();
    element("dl", &facts.into_iter().map(fact).collect::<String>())
        + &element("p class=\"signature\"", &lines)
}

/// A section with its heading; nothing if there is nothing in it.
fn section((heading, parts): (&str, String)) -> String {
    if parts.is_empty() {
        return parts;
    }
    let heading = Some(heading).filter(|heading| !heading.is_empty());
    let heading = heading.map(|heading| element("h2", heading)).unwrap_or_default();
    element("section", &(heading + &parts))
}

fn part_html(part: Part) -> String {
    match part {
        Part::Heading(heading) => element("h2", heading),
        Part::Statement { text, holds } => {
            let class = if holds { "statement" } else { "statement broken" };
            element(&format!("p class=\"{class}\""), &xml(&text))
        }
        Part::Line(text) => element("p", &xml(&text)),
        Part::Table(table) => table_html(&table),
    }
}

/// An element with its attributes, and what is inside it.
fn element(open: &str, inside: &str) -> String {
    let name = open.split(' ').next().unwrap_or(open);
    format!("<{open}>{inside}</{name}>\n")
}

/// A table whose numbers stand below each other at their points, as in text; the first cell of a row names it.
fn table_html(table: &Table) -> String {
    if table.is_empty() {
        return String::new();
    }
    let mut lines = table.padded().into_iter();
    let titles = lines.next().unwrap_or_default();
    let titles = titles.iter().map(|title| element("th scope=\"col\"", &xml(title)));
    let cell = |(at, cell): (usize, &String)| match cell.trim() {
        name if at == 0 => element("th scope=\"row\"", &xml(name)),
        _ if table.is_number(at) => element("td class=\"number\"", &xml(cell)),
        // The verdicts on conditions have their colours.
        verdict @ ("pass" | "caution" | "fail") => {
            element(&format!("td class=\"{verdict}\""), verdict)
        }
        words => element("td", &xml(words)),
    };
    let row =
        |cells: Vec<String>| element("tr", &cells.iter().enumerate().map(cell).collect::<String>());
    let head = element("thead", &element("tr", &titles.collect::<String>()));
    let body = element("tbody", &lines.map(row).collect::<String>());
    let caption = Some(&table.caption).filter(|caption| !caption.is_empty());
    let caption = caption.map(|caption| element("caption", &xml(caption))).unwrap_or_default();
    element("div class=\"table\"", &element("table", &(caption + &head + &body)))
}
