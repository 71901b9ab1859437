//! An answer as a page that can be kept, printed and signed: one file of HTML that needs no other file, no network
//! and no script, and is well-formed as XML.

use super::Table;
use crate::numerics::count::real;
use crate::words::printable::xml;
use crate::words::provenance::Provenance;

/// How the page looks on a screen, on a phone and on A4.
const STYLE: &str = include_str!("../../assets/report.css");

/// A page.
pub struct Page<'a> {
    /// What kind of answer it is.
    pub kind: &'static str,
    /// What it is about.
    pub title: &'a str,
    /// A line below the title.
    pub subject: String,
    pub sections: Vec<Section<'a>>,
}

/// A part of a page with its heading; left out if there is nothing in it.
pub struct Section<'a> {
    /// Empty for what stands below the title.
    pub heading: &'static str,
    pub parts: Vec<PagePart<'a>>,
}

/// What a section consists of.
pub enum PagePart<'a> {
    /// The sentence that is signed, and whether all that it rests on holds.
    Statement {
        text: String,
        holds: bool,
    },
    Text(String),
    List(Vec<String>),
    /// A table and what it shows; the first cell of a row names it.
    Table(&'a str, Table),
    /// Names and values, such as those of the program and its files.
    Facts(Vec<(&'static str, String)>),
    /// Pictures as SVG; the names of their parts differ.
    Pictures(&'a [String]),
    /// Room for a date and a signature on paper.
    Signature,
}

/// A file that an answer was computed from.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SourceFile {
    pub name: String,
    /// When it was last changed; `None` for a pipe and for a file of the program.
    pub changed: Option<String>,
    /// The SHA-256 of its bytes, in hexadecimal digits.
    pub sha256: String,
}

/// What computed an answer, and from which files.
pub fn origin<'a>(provenance: &Provenance, sources: &[SourceFile]) -> Section<'a> {
    let mut facts = vec![("program", provenance.build()), ("command", provenance.command.clone())];
    if sources.is_empty() {
        facts.push(("file", "none, a part of the program".to_owned()));
    }
    for source in sources {
        facts.push(("file", source.name.clone()));
        facts.extend(source.changed.clone().map(|date| ("last changed", date)));
        facts.push(("SHA-256", source.sha256.clone()));
    }
    Section { heading: "Origin", parts: vec![PagePart::Facts(facts), PagePart::Signature] }
}

impl Page<'_> {
    /// The page as a file.
    pub fn html(&self) -> String {
        let title = element("title", &xml(&format!("{}: {}", self.title, self.kind)));
        let head = format!(
            "<meta charset=\"utf-8\"/>\n<meta name=\"viewport\" content=\"width=device-width\"/>\n{title}\n{}",
            element("style", STYLE)
        );
        let above = element(
            "header",
            &[
                element("p class=\"kind\"", &xml(self.kind)),
                element("h1", &xml(self.title)),
                element("p", &xml(&self.subject)),
            ]
            .concat(),
        );
        let sections: String = self.sections.iter().map(Section::html).collect();
        let body = element("body", &element("main", &(above + &sections)));
        let page = element(
            "html lang=\"en\" xmlns=\"http://www.w3.org/1999/xhtml\"",
            &(element("head", &head) + &body),
        );
        format!("<!DOCTYPE html>\n{page}")
    }
}

impl Section<'_> {
    fn html(&self) -> String {
        let parts: String = self.parts.iter().map(PagePart::html).collect();
        if parts.is_empty() {
            return parts;
        }
        let heading = Some(self.heading).filter(|heading| !heading.is_empty());
        let heading = heading.map(|heading| element("h2", &xml(heading)));
        element("section", &(heading.unwrap_or_default() + &parts))
    }
}

impl PagePart<'_> {
    fn html(&self) -> String {
        let all = |name: &str, texts: &[String]| -> String {
            texts.iter().map(|text| element(name, &xml(text))).collect()
        };
        match self {
            PagePart::Statement { text, holds } => {
                let class = if *holds { "statement" } else { "statement broken" };
                element(&format!("p class=\"{class}\""), &xml(text))
            }
            PagePart::Text(text) => element("p", &xml(text)),
            PagePart::List(texts) if texts.is_empty() => String::new(),
            PagePart::List(texts) => element("ul", &all("li", texts)),
            PagePart::Table(caption, table) => table_html(caption, table),
            PagePart::Facts(facts) => {
                let fact = |(name, value): &(&str, String)| {
                    element("dt", &xml(name)) + &element("dd", &xml(value))
                };
                element("dl", &facts.iter().map(fact).collect::<String>())
            }
            PagePart::Pictures(pictures) => {
                let pictures = pictures.iter().map(|picture| element("figure", picture));
                element("div class=\"pictures\"", &pictures.collect::<String>())
            }
            PagePart::Signature => {
                let lines = ["Name", "Date", "Signature"].map(|line| element("span", line));
                element("p class=\"signature\"", &lines.concat())
            }
        }
    }
}

/// An element with its attributes, and what is inside it.
fn element(open: &str, inside: &str) -> String {
    let name = open.split(' ').next().unwrap_or(open);
    format!("<{open}>{inside}</{name}>\n")
}

/// A table whose numbers stand below each other at their points, units and words at their beginnings.
fn table_html(caption: &str, table: &Table) -> String {
    let columns: Vec<CellStyle> =
        (0..table.titles.len()).map(|at| CellStyle::of(table, at)).collect();
    let titles = table.titles.iter().zip(&columns);
    let titles = titles.map(|(title, column)| {
        element(&("th scope=\"col\"".to_owned() + column.wide()), &xml(title))
    });
    let row = |cells: &Vec<String>| {
        let cells = cells.iter().zip(&columns).enumerate().map(|(at, (cell, column))| match at {
            0 => element("th scope=\"row\"", &xml(cell)),
            _ => column.cell(cell),
        });
        element("tr", &cells.collect::<String>())
    };
    let head = element("thead", &element("tr", &titles.collect::<String>()));
    let body = element("tbody", &table.rows.iter().map(row).collect::<String>());
    let shown = Some(caption).filter(|caption| !caption.is_empty());
    let caption = shown.map(|caption| element("caption", &xml(caption))).unwrap_or_default();
    element("div class=\"table\"", &element("table", &(caption + &head + &body)))
}

/// How the cells of a column are set.
enum CellStyle {
    Words,
    Numbers {
        /// Largest number of characters from the decimal point on.
        after: usize,
        /// Whether units follow, in a column of their own.
        units: bool,
    },
}

/// A cell as a number up to its decimal point or exponent, the rest of it, and its unit; `None` for another cell.
fn parts(cell: &str) -> Option<(&str, &str, &str)> {
    let (number, unit) = cell.split_once(' ').unwrap_or((cell, ""));
    number.parse::<f64>().ok()?;
    let (whole, after) = number.split_at(number.find(['.', 'e']).unwrap_or(number.len()));
    Some((whole, after, unit))
}

impl CellStyle {
    fn of(table: &Table, at: usize) -> Self {
        let cells = || table.rows.iter().filter_map(|row| row.get(at));
        let numbers = || cells().filter_map(|cell| parts(cell));
        // The words for a number that does not exist.
        let is_gap = |cell: &String| ["", "-", "none", "any"].contains(&cell.as_str());
        if !cells().all(|cell| is_gap(cell) || parts(cell).is_some()) {
            return CellStyle::Words;
        }
        numbers().map(|(_, after, _)| after.len()).max().map_or(CellStyle::Words, |after| {
            CellStyle::Numbers { after, units: numbers().any(|(.., unit)| !unit.is_empty()) }
        })
    }

    /// The attributes of a cell that is as wide as the column.
    fn wide(&self) -> &'static str {
        match self {
            CellStyle::Words => "",
            CellStyle::Numbers { units: false, .. } => " class=\"number\"",
            CellStyle::Numbers { units: true, .. } => " class=\"number\" colspan=\"2\"",
        }
    }

    fn cell(&self, cell: &str) -> String {
        match (self, parts(cell)) {
            (CellStyle::Numbers { after: most, units }, Some((whole, after, unit))) => {
                // A point is about half as wide as a digit.
                let width = |length: usize| real(length) - if length > 0 { 0.5 } else { 0.0 };
                let room = width(*most) - width(after.len());
                let number = xml(&format!("{whole}{after}"));
                let number = format!("<span style=\"padding-right:{room}ch\">{number}</span>");
                let unit =
                    if *units { element("td class=\"unit\"", &xml(unit)) } else { String::new() };
                element("td class=\"number\"", &number) + &unit
            }
            // The verdicts on conditions have their colours.
            _ if ["pass", "caution", "fail"].contains(&cell) => {
                element(&format!("td class=\"{cell}\""), cell)
            }
            _ => element(&("td".to_owned() + self.wide()), &xml(cell)),
        }
    }
}
