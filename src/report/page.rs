//! An answer as a page that can be kept, printed and signed: one file of HTML that needs no other file, no network
//! and no script, and is well-formed as XML.

use super::{Answer, Part, Table};
use crate::words::printable::xml;
use crate::words::provenance::Provenance;

/// A file that an answer was computed from.
#[derive(Clone, Debug)]
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
        let sections = self.parts.chunk_by(|_, next| !matches!(next, Part::Heading(_)));
        let mut sections: String = sections.map(section).collect();
        if !pictures.is_empty() {
            let pictures = pictures.iter().map(|picture| element("figure", picture));
            let pictures = element("div class=\"pictures\"", &pictures.collect::<String>());
            sections += &element("section", &(element("h2", "Pictures") + &pictures));
        }
        let [name, subject] = self.head.map(|text| xml(&text));
        format!(
            include_str!("../../assets/page.html"),
            kind = xml(kind),
            name = name,
            subject = subject,
            // How the page looks on a screen, on a phone and on A4.
            style = include_str!("../../assets/report.css"),
            sections = sections,
            origin = origin(provenance, sources),
        )
    }
}

/// What computed an answer, and from which files.
fn origin(provenance: &Provenance, sources: &[SourceFile]) -> String {
    let fact = |name, value: &str| element("dt", name) + &element("dd", &xml(value));
    let mut facts = fact("program", &provenance.build()) + &fact("command", &provenance.command);
    if sources.is_empty() {
        facts += &fact("file", "none, a part of the program");
    }
    for SourceFile { name, changed, sha256 } in sources {
        facts += &fact("file", name);
        facts.extend(changed.iter().map(|date| fact("last changed", date)));
        facts += &fact("SHA-256", sha256);
    }
    facts
}

/// Parts below their heading as a section; nothing if there is nothing in it.
fn section(parts: &[Part]) -> String {
    let (headings, parts): (Vec<_>, Vec<_>) =
        parts.iter().partition(|part| matches!(part, Part::Heading(_)));
    let html = |parts: Vec<&Part>| parts.into_iter().map(part_html).collect::<String>();
    let inside = html(parts);
    if inside.is_empty() {
        inside
    } else {
        element("section", &(html(headings) + &inside))
    }
}

fn part_html(part: &Part) -> String {
    match part {
        Part::Heading(heading) => element("h2", heading),
        Part::Statement { text, holds } => {
            let class = if *holds { "statement" } else { "statement broken" };
            element(&format!("p class=\"{class}\""), &xml(text))
        }
        Part::Line(text) => element("p", &xml(text)),
        Part::Table(table) => table_html(table),
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
    let mut parts = head + &body;
    if !table.caption.is_empty() {
        parts.insert_str(0, &element("caption", &xml(&table.caption)));
    }
    element("div class=\"table\"", &element("table", &parts))
}
