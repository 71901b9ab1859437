//! How a figure is printed: its size, and the style of the journal that it is for.

use std::str::FromStr;

use clap::ValueEnum;
use serde::{Deserialize, Serialize};

use crate::model::quantity;

/// How a figure is printed. What a scene or a study leaves out is as the style has it.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Sheet {
    /// The width of the whole figure; `None`: a column of the style, or in `plain` as large as its panels are.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub width: Option<PaperWidth>,
    pub style: JournalStyle,
    /// How panels are lettered, if not as the style has it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub letters: Option<PanelLetters>,
    /// What stands above the figure; `None`: its own title in `plain`, and nothing in a journal.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub title: Option<String>,
    pub legend: LegendPlace,
    /// Whether shades of grey, dashes and marks take the place of colours.
    pub grey: bool,
    /// Dots of an inch of a `.png`, if not as the style has it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub dpi: Option<Dpi>,
    /// The plots to draw by their numbers from 1, in this order; empty for all of them.
    pub panels: Vec<usize>,
    /// Whether the facts for the caption stand in a text file beside a picture.
    pub caption: bool,
}

/// What a figure looks like.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, ValueEnum)]
#[serde(rename_all = "kebab-case")]
pub enum JournalStyle {
    /// For screens: large, with titles.
    #[default]
    Plain,
    /// Journals of Springer: bold letters at the panels, no titles, colours that also differ in grey print.
    Springer,
    /// Journals of the IEEE: (a), (b), .. below the panels, no titles.
    Ieee,
}

/// How the panels of a figure are told apart.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, ValueEnum)]
pub enum PanelLetters {
    /// A bold letter at the upper left corner.
    #[serde(rename = "a")]
    #[value(name = "a")]
    Bold,
    /// A letter in parentheses below.
    #[serde(rename = "(a)")]
    #[value(name = "(a)")]
    Below,
    #[serde(rename = "none")]
    None,
}

/// Where the lines of a figure are explained.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, ValueEnum)]
#[serde(rename_all = "kebab-case")]
pub enum LegendPlace {
    /// Below all panels.
    #[default]
    Below,
    /// Within the panel in which a line is first seen, where it covers least.
    Inside,
    None,
}

/// Dots of an inch.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(try_from = "u32", into = "u32")]
pub struct Dpi(u32);

/// A width on paper, such as `84 mm`, in millimetres.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub struct PaperWidth(f64);

impl Sheet {
    /// Whether it says nothing.
    pub fn is_usual(&self) -> bool {
        *self == Sheet::default()
    }

    /// The width in points; `None` where a figure is as large as its panels are.
    pub fn points(&self) -> Option<f64> {
        /// A column of a journal of each style, in millimetres.
        const COLUMNS: [(JournalStyle, f64); 2] =
            [(JournalStyle::Springer, 84.0), (JournalStyle::Ieee, 88.9)];
        let usual = COLUMNS.iter().find(|(style, _)| *style == self.style);
        let width = self.width.map(|PaperWidth(width)| width).or(usual.map(|(_, width)| *width));
        width.map(|width| width * 72.0 / 25.4)
    }

    /// The letters at the panels. In `plain` their titles tell them apart.
    pub fn letters(&self) -> PanelLetters {
        self.letters.unwrap_or(match self.style {
            JournalStyle::Plain => PanelLetters::None,
            JournalStyle::Springer => PanelLetters::Bold,
            JournalStyle::Ieee => PanelLetters::Below,
        })
    }

    /// Dots of an inch of a `.png`: journals want 600 where lines and areas meet.
    pub fn dpi(&self) -> f64 {
        let usual = if self.style == JournalStyle::Plain { 288 } else { 600 };
        f64::from(self.dpi.map_or(usual, |Dpi(dpi)| dpi))
    }

    /// The indices of the plots that are drawn, of so many. Fails with one line if there is no such plot.
    pub fn plots(&self, count: usize) -> Result<Vec<usize>, String> {
        if self.panels.is_empty() {
            return Ok((0..count).collect());
        }
        let index = |panel: &usize| match panel.checked_sub(1) {
            Some(index) if index < count => Ok(index),
            _ => Err(format!("there is no panel {panel}; panels are numbered from 1 to {count}")),
        };
        self.panels.iter().map(index).collect()
    }
}

impl TryFrom<u32> for Dpi {
    type Error = String;

    fn try_from(dpi: u32) -> Result<Self, String> {
        let refused = || format!("{dpi} dots of an inch are outside the range 36 .. 2400");
        (36..=2400).contains(&dpi).then_some(Dpi(dpi)).ok_or_else(refused)
    }
}

impl From<Dpi> for u32 {
    fn from(Dpi(dpi): Dpi) -> u32 {
        dpi
    }
}

impl FromStr for Dpi {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let dpi: u32 = text.parse().map_err(|_| "expected a whole number, such as 600")?;
        dpi.try_into()
    }
}

impl FromStr for PaperWidth {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        /// The narrowest and the widest figure, in millimetres.
        const RANGE: [f64; 2] = [30.0, 420.0];
        let refused = |why| format!("{why}; expected a width such as 84mm, 8.4cm, 3.5in or 240pt");
        let points = text.trim_end().strip_suffix("pt").map(str::trim_end);
        let width = match points {
            Some(points) => quantity(points, "").map(|points| points * 25.4 / 72.0),
            None if text.ends_with(|last: char| last.is_ascii_digit() || last == '.') => {
                Err(format!("{text:?} has no unit"))
            }
            None => quantity(text, "m").map(|width| width * 1e3),
        };
        let width = width.map_err(refused)?;
        let [least, most] = RANGE;
        let outside = || refused(format!("{text:?} is outside the range {least} .. {most} mm"));
        (least..=most).contains(&width).then_some(PaperWidth(width)).ok_or_else(outside)
    }
}

impl TryFrom<String> for PaperWidth {
    type Error = String;

    fn try_from(text: String) -> Result<Self, String> {
        text.parse()
    }
}

impl From<PaperWidth> for String {
    fn from(PaperWidth(width): PaperWidth) -> String {
        format!("{width} mm")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn widths_have_a_unit_and_a_range() {
        let width = |text: &str| text.parse().map(|PaperWidth(width)| width);
        for (text, millimetres) in
            [("84mm", 84.0), ("8.4 cm", 84.0), ("3.5in", 88.9), ("144 pt", 50.8)]
        {
            assert!((width(text).unwrap() - millimetres).abs() < 1e-9, "{text}");
        }
        for (text, words) in [
            ("84", "\"84\" has no unit"),
            ("84m", "outside the range 30 .. 420 mm"),
            ("84 s", "wrong unit"),
            ("wide", "\"wide\" is not a number"),
            ("-84mm", "outside"),
            ("NaN mm", "not a"),
            ("84 mm pt", "has a unit"),
            ("", "not a number"),
        ] {
            let refused = width(text).unwrap_err();
            assert!(
                refused.contains(words) && refused.contains("such as 84mm"),
                "{text}: {refused}"
            );
        }
    }

    #[test]
    fn a_sheet_is_read_back_as_it_was_written() {
        let text = "width = \"84 mm\"\nstyle = \"ieee\"\nletters = \"(a)\"\nlegend = \"inside\"\ngrey = true\ndpi = 600\npanels = [3, 1]\n";
        let sheet: Sheet = toml::from_str(text).unwrap();
        assert_eq!(toml::from_str::<Sheet>(&toml::to_string(&sheet).unwrap()).unwrap(), sheet);
        assert_eq!(sheet.plots(3), Ok(vec![2, 0]));
        let refused = sheet.plots(2).unwrap_err();
        assert_eq!(refused, "there is no panel 3; panels are numbered from 1 to 2");
        for text in ["width = 84", "dpi = 0", "legend = \"left\"", "size = 3", "panels = [-1]"] {
            assert!(toml::from_str::<Sheet>(text).is_err(), "{text}");
        }
    }

    #[test]
    fn styles_bring_the_width_of_a_column_and_their_letters() {
        let of = |style| Sheet { style, ..Sheet::default() };
        let springer = of(JournalStyle::Springer);
        assert!((springer.points().unwrap() - 238.110).abs() < 1e-3, "84 mm of 72 points an inch");
        assert_eq!(of(JournalStyle::Ieee).letters(), PanelLetters::Below);
        assert_eq!(Sheet::default().points(), None);
    }
}
