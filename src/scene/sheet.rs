//! How a figure is printed: its size, and the style of the journal that it is for.

use std::ops::Range;
use std::str::FromStr;

use clap::{Args, ValueEnum, value_parser};
use serde::{Deserialize, Serialize};

use crate::model::{LENGTH, measured, quantity};

/// How a figure is printed, in files and as options. What is left out is as the style has it.
#[derive(Args, Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
#[command(next_help_heading = "On paper")]
pub struct Sheet {
    /// Width of the figure, for which it is laid out: 84mm, 129mm, 174mm, 3.5in, ..
    #[arg(long)]
    pub width: Option<PaperWidth>,
    /// Journal that it is for
    #[arg(long, value_enum)]
    pub style: Option<JournalStyle>,
    /// How panels are lettered
    #[arg(long, value_enum)]
    pub letters: Option<PanelLetters>,
    /// Title above the figure
    #[arg(long, value_name = "TEXT")]
    pub title: Option<String>,
    /// Where lines are explained
    #[arg(long, value_enum)]
    pub legend: Option<LegendPlace>,
    /// Shades of grey, dashes and marks in place of colours
    #[arg(long)]
    pub grey: bool,
    /// Dots of an inch of a .png
    #[arg(long, value_name = "N", value_parser = value_parser!(u16).range(36..=2400))]
    pub dpi: Option<u16>,
    /// Panels to draw, in this order, such as 1,3
    #[arg(long, value_delimiter = ',', value_name = "NUMBERS")]
    pub panels: Vec<usize>,
    /// Also writes the facts for the caption, as .txt beside a picture
    #[arg(long)]
    pub caption: bool,
}

/// What a figure looks like.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, ValueEnum)]
#[serde(rename_all = "kebab-case")]
pub enum JournalStyle {
    /// For screens: large, with titles.
    #[default]
    Plain,
    /// Journals of Springer: bold letters above the panels, no titles, colours that also differ in grey print.
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
    Above,
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
    /// Within the panel in which a line is first seen, where that has room; else below.
    Inside,
    None,
}

/// A width on paper, such as `84 mm`, in millimetres.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub struct PaperWidth(f64);

impl Sheet {
    /// Whether it says nothing.
    pub fn is_usual(&self) -> bool {
        *self == Sheet::default()
    }

    /// The same, with what it leaves out as the other one has it.
    pub fn over(self, other: Sheet) -> Sheet {
        Sheet {
            width: self.width.or(other.width),
            style: self.style.or(other.style),
            letters: self.letters.or(other.letters),
            title: self.title.or(other.title),
            legend: self.legend.or(other.legend),
            grey: self.grey || other.grey,
            dpi: self.dpi.or(other.dpi),
            panels: if self.panels.is_empty() {
                other.panels
            } else {
                self.panels
            },
            caption: self.caption || other.caption,
        }
    }

    /// The style, which is that of screens where none is said.
    pub fn style(&self) -> JournalStyle {
        self.style.unwrap_or_default()
    }

    /// The width in points; `None` where a figure is as large as its panels are.
    pub fn points(&self) -> Option<f64> {
        // Without a width, that of a column.
        let width = match (&self.width, self.style()) {
            (Some(PaperWidth(width)), _) => *width,
            (None, JournalStyle::Springer) => 84.0,
            (None, JournalStyle::Ieee) => 88.9,
            (None, JournalStyle::Plain) => return None,
        };
        Some(width * 72.0 / 25.4)
    }

    /// The letters at so many panels. A single one needs none, and in `plain` titles tell them apart.
    pub fn letters(&self, panels: usize) -> PanelLetters {
        self.letters.unwrap_or(match self.style() {
            JournalStyle::Springer if panels > 1 => PanelLetters::Above,
            JournalStyle::Ieee if panels > 1 => PanelLetters::Below,
            _ => PanelLetters::None,
        })
    }

    /// Dots of an inch of a `.png`: journals want 600 where lines and areas meet.
    pub fn dpi(&self) -> f64 {
        let usual = if self.style() == JournalStyle::Plain {
            288
        } else {
            600
        };
        f64::from(self.dpi.unwrap_or(usual))
    }

    /// The indices of the plots that are drawn, of so many; these where none are named. Fails with one line if there is no such plot.
    pub fn plots(&self, count: usize, usual: Range<usize>) -> Result<Vec<usize>, String> {
        if self.panels.is_empty() {
            return Ok(usual.collect());
        }
        let index = |panel: &usize| match panel.checked_sub(1) {
            Some(index) if index < count => Ok(index),
            _ => Err(format!("there is no panel {panel}; panels are numbered from 1 to {count}")),
        };
        self.panels.iter().map(index).collect()
    }
}

impl FromStr for PaperWidth {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        const ALLOWED: &str = "expected 30 .. 420 mm, such as 84mm, 8.4cm, 3.5in or 240pt";
        let millimetres = match text.trim_end().strip_suffix("pt") {
            Some(points) => quantity(points, "").map(|points| points * 25.4 / 72.0),
            None => measured(text).and_then(|read| match read.dimension {
                Some(LENGTH) => Ok(read.value * 1e3),
                _ => Err(format!("{text:?} has no unit of length")),
            }),
        };
        let millimetres = millimetres.map_err(|why| format!("{why}; {ALLOWED}"))?;
        let fits = (30.0..=420.0).contains(&millimetres);
        fits.then_some(PaperWidth(millimetres)).ok_or_else(|| format!("{text:?}: {ALLOWED}"))
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
            ("84", "\"84\" has no unit of length"),
            ("84m", "\"84m\": expected 30 .. 420 mm"),
            ("84 s", "no unit of length"),
            ("wide", "\"wide\" is not a number"),
            ("-84mm", "\"-84mm\": "),
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
        assert_eq!(sheet.plots(3, 0..3), Ok(vec![2, 0]));
        let refused = sheet.plots(2, 0..2).unwrap_err();
        assert_eq!(refused, "there is no panel 3; panels are numbered from 1 to 2");
        for text in ["width = 84", "dpi = -1", "legend = \"left\"", "size = 3", "panels = [-1]"] {
            assert!(toml::from_str::<Sheet>(text).is_err(), "{text}");
        }
    }

    #[test]
    fn styles_bring_the_width_of_a_column_and_their_letters() {
        let of = |style| Sheet { style: Some(style), ..Sheet::default() };
        let springer = of(JournalStyle::Springer);
        assert!((springer.points().unwrap() - 238.110).abs() < 1e-3, "84 mm of 72 points an inch");
        assert_eq!(of(JournalStyle::Ieee).letters(2), PanelLetters::Below);
        assert_eq!(Sheet::default().points(), None);
    }
}
