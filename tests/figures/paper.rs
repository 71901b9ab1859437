//! Figures as journals print them: every text in its place, and lines that are told apart without colour.

use std::collections::BTreeMap;

use hopfscope::figure::facts;
use hopfscope::numerics::elementary::ln;
use hopfscope::scene::{JournalStyle, LegendPlace, Sheet};
use ttf_parser::Face;

use super::*;

/// Widths of the columns of journals: those of Springer, and those of the IEEE.
const WIDTHS: [&str; 5] = ["84 mm", "129 mm", "174 mm", "3.5 in", "7.16 in"];

fn printed(figure: &Figure, width: &str, style: JournalStyle, legend: LegendPlace) -> Figure {
    let width = Some(width.parse().unwrap());
    let (style, legend) = (Some(style), Some(legend));
    Figure { sheet: Sheet { width, style, legend, ..Sheet::default() }, ..figure.clone() }
}

/// A text on paper: what it says, the size of its smallest letters, and its box.
struct Written {
    text: String,
    smallest: f64,
    /// Left, right, top, bottom.
    sides: [f64; 4],
}

fn number(node: &roxmltree::Node, name: &str) -> Option<f64> {
    node.attribute(name)?.parse().ok()
}

/// The texts of a picture, by the widths of the fonts with which it is printed.
fn written(picture: &Document) -> Vec<Written> {
    let font = fs::read("assets/fonts/DejaVuSans.ttf").unwrap();
    let face = Face::parse(&font, 0).unwrap();
    let wide = |text: &str, size: f64| -> f64 {
        let advance = |char| face.glyph_hor_advance(face.glyph_index(char).unwrap()).unwrap();
        let units: u32 = text.chars().map(|char| u32::from(advance(char))).sum();
        size * f64::from(units) / f64::from(face.units_per_em())
    };
    let texts = picture.descendants().filter(|node| node.has_tag_name("text"));
    let texts = texts.filter(|node| node.attribute("fill") != Some("none"));
    let of = |node: roxmltree::Node| {
        let size = number(&node, "font-size").unwrap();
        let runs: Vec<(String, f64)> = node
            .descendants()
            .filter(roxmltree::Node::is_text)
            .map(|part| {
                let own = part.parent().and_then(|parent| number(&parent, "font-size"));
                (part.text().unwrap().to_owned(), own.unwrap_or(size))
            })
            .collect();
        let width: f64 = runs.iter().map(|(text, size)| wide(text, *size)).sum();
        let start = match node.attribute("text-anchor") {
            Some("middle") => 0.5 * width,
            Some("end") => width,
            _ => 0.0,
        };
        let (x, y) = (number(&node, "x").unwrap(), number(&node, "y").unwrap());
        // Capitals and digits are 0.73 high; what reaches below the base line may be beside other texts.
        let (above, below) = (0.73 * size, 0.02 * size);
        let sides = if node.has_attribute("transform") {
            [x - above, x + below, y + start - width, y + start]
        } else {
            [x - start, x - start + width, y - above, y + below]
        };
        let smallest = runs.iter().map(|(_, size)| *size).fold(size, f64::min);
        Written { text: runs.into_iter().map(|(text, _)| text).collect(), smallest, sides }
    };
    texts.map(of).collect()
}

#[test]
fn on_every_width_texts_lie_on_the_page_apart_and_are_large_enough_to_read() {
    for scene in scenes() {
        let drawn = figure(scene, Fineness::SCREEN);
        for (style, legend) in [
            (JournalStyle::Springer, LegendPlace::Below),
            (JournalStyle::Ieee, LegendPlace::Inside),
            (JournalStyle::Plain, LegendPlace::Below),
        ] {
            for width in WIDTHS {
                let svg = text(&printed(&drawn, width, style, legend), FigureForm::Svg);
                let picture = Document::parse(&svg).unwrap();
                let page = picture.root_element().attribute("viewBox").unwrap();
                let page: Vec<f64> = page.split(' ').map(|side| side.parse().unwrap()).collect();
                let texts = written(&picture);
                for (index, one) in texts.iter().enumerate() {
                    let Written { text, smallest, sides: [left, right, top, bottom] } = one;
                    let place = format!("{scene}, {style:?}, {width}: {text:?}");
                    assert!(*smallest >= 6.0, "{place} is set in {smallest} pt");
                    let within =
                        *left >= 0.0 && *right <= page[2] && *top >= 0.0 && *bottom <= page[3];
                    assert!(within, "{place} leaves the page: {:?}, {page:?}", one.sides);
                    for other in &texts[..index] {
                        let [from, to, high, low] = other.sides;
                        let apart = from >= *right || to <= *left || high >= *bottom || low <= *top;
                        assert!(apart, "{place} covers {:?}", other.text);
                    }
                }
            }
        }
    }
}

#[test]
fn a_figure_has_the_width_that_is_asked_for_and_letters_of_eight_points() {
    let drawn = figure("fig10", Fineness::SCREEN);
    for (width, millimetres) in [("84 mm", "84mm"), ("174 mm", "174mm"), ("240 pt", "84.667mm")] {
        let sheet = printed(&drawn, width, JournalStyle::Springer, LegendPlace::Below);
        let svg = text(&sheet, FigureForm::Svg);
        let picture = Document::parse(&svg).unwrap();
        assert_eq!(picture.root_element().attribute("width"), Some(millimetres));
        let axis = |it: &Written| it.text == "D";
        let names: Vec<Written> = written(&picture).into_iter().filter(axis).collect();
        assert!(names.len() == 2 && names.iter().all(|name| name.smallest == 8.0), "{width}");
        let strokes = picture.descendants().filter(|node| node.attribute("fill") == Some("none"));
        let lines = strokes.filter(|node| node.has_tag_name("path"));
        let widths: BTreeSet<&str> =
            lines.filter_map(|line| line.attribute("stroke-width")).collect();
        assert!(widths.is_subset(&BTreeSet::from(["0.5", "0.8", "1.2"])), "{widths:?}");
        // Titles and the names of panels are the caption's.
        assert!(!written(&picture).iter().any(|it| it.text.contains("amplitudes")), "{width}");
    }
}

/// The lightness of a colour such as `#1b8a4e`, from 0 to 100, by CIE 1976 from sRGB.
fn lightness(color: &str) -> f64 {
    let value = u32::from_str_radix(color.trim_start_matches('#'), 16).unwrap();
    let linear = |shift: u32| {
        let part = f64::from(value >> shift & 0xff) / 255.0;
        if part <= 0.04045 {
            part / 12.92
        } else {
            exp(2.4 * ln((part + 0.055) / 1.055))
        }
    };
    let luminance = 0.2126 * linear(16) + 0.7152 * linear(8) + 0.0722 * linear(0);
    if luminance > 0.008_856 {
        116.0 * cbrt(luminance) - 16.0
    } else {
        903.3 * luminance
    }
}

#[test]
fn lines_with_the_same_dashes_differ_in_lightness() {
    let table = include_str!("../../assets/paper.txt");
    let inks: BTreeMap<&str, [f64; 2]> = table
        .lines()
        .filter_map(|line| match line.split(" | ").collect::<Vec<_>>()[..] {
            [role, _, color, _, _, grey] => Some((role, [lightness(color), lightness(grey)])),
            _ => None,
        })
        .collect();
    let of = |role: &str| inks.get(role).copied().unwrap_or([lightness("#222222"), 0.0]);
    let mut pairs = BTreeSet::new();
    for scene in scenes() {
        for panel in figure(scene, Fineness::SCREEN).panels {
            let look = |curve: &Outline| (curve.style.map_or("", Into::into), curve.role.name());
            let looks: BTreeSet<(&str, &str)> = panel.curves.iter().map(look).collect();
            for (dash, role) in &looks {
                let alike = looks.iter().filter(|(other, _)| other == dash);
                pairs.extend(alike.filter(|(_, it)| it < role).map(|(_, it)| (*dash, *it, *role)));
            }
        }
    }
    assert!(pairs.len() >= 15, "{pairs:?}");
    for (dash, one, other) in pairs {
        let [color, grey] = [0, 1].map(|ink| (of(one)[ink] - of(other)[ink]).abs());
        assert!(color >= 10.0, "{dash}: {one} and {other} differ by {color} in colour");
        assert!(grey >= 20.0, "{dash}: {one} and {other} differ by {grey} in grey");
    }
}

#[test]
fn in_grey_nothing_has_a_colour() {
    for scene in ["fig07", "fig10", "benchmark", "regimes"] {
        let drawn = figure(scene, Fineness::SCREEN);
        let sheet = Sheet { grey: true, ..drawn.sheet.clone() };
        let svg = text(&Figure { sheet, ..drawn }, FigureForm::Svg);
        let colors = svg.split('#').skip(1).filter_map(|rest| rest.get(..6));
        let colors: Vec<&str> = colors.filter(|it| u32::from_str_radix(it, 16).is_ok()).collect();
        assert!(colors.len() > 20, "{scene}");
        assert!(colors.iter().all(|it| it[..2] == it[2..4] && it[..2] == it[4..]), "{scene}");
    }
}

/// The corners of all lines and areas of a picture.
fn corners(svg: &str) -> usize {
    svg.matches(['M', 'L']).count()
}

#[test]
fn a_picture_has_the_points_that_are_seen_and_data_have_all() {
    let drawn = figure("fig10", Fineness::PRINT);
    let outlines = |panel: &hopfscope::figure::Panel| {
        panel.curves.iter().chain(&panel.areas).map(|line| line.points.len()).sum::<usize>()
    };
    let all: usize = drawn.panels.iter().map(outlines).sum();
    let seen = corners(&text(&drawn, FigureForm::Svg));
    assert!(all > 5000 && seen < all / 5, "{seen} of {all}");
    let rows = text(&drawn, FigureForm::Csv);
    assert!(rows.lines().filter(|row| !row.starts_with('#')).count() > all, "{all}");
}

#[test]
fn the_facts_name_every_line_with_its_look_and_its_numbers() {
    let drawn = figure("fig07", Fineness::SCREEN);
    let sheet = Sheet { grey: true, style: Some(JournalStyle::Springer), ..Sheet::default() };
    let told = facts(&Figure { sheet, ..drawn.clone() });
    for line in [
        "panel 1: phase plane, v over q",
        "  unstable cycle, D = -0.7: dashed line, dark grey, 0.8 pt; D = -0.7, D2 = 0, D3 = 0, r = 1",
        "  rest: square, grey",
    ] {
        assert!(told.lines().any(|it| it == line), "{line}: {told}");
    }
    for panel in &drawn.panels {
        for outline in panel.curves.iter().chain(&panel.areas) {
            assert!(told.contains(&format!("  {}: ", outline.name)), "{}", outline.name);
        }
    }
}

#[test]
fn the_facts_about_a_machine_are_in_si_units() {
    let drawn = figure("slow-belt", Fineness::SCREEN);
    let told = facts(&drawn);
    let numbers: Vec<&str> =
        told.lines().find(|it| it.starts_with("m = ")).unwrap().split(", ").collect();
    // As in the file of the machine, but for the speed; the motion lasts 100 over omega0 = 50 1/s.
    for number in
        ["m = 2 kg", "c = 5000 N/m", "d3 = 600 N s^3/m^3", "R = 1 N", "v0 = 0.2 m/s", "x = 0.001 m"]
    {
        assert!(numbers.contains(&number), "{number}: {told}");
    }
    assert_eq!(numbers.last(), Some(&"until = 2 s"));
    assert!(told.contains("panel 1: phase plane, whole model, v [mm/s] over x [mm]"), "{told}");
    assert!(told.contains("panel 3: mass on belt, over x [mm]"), "{told}");
    // Displacements count in x0 = F mu(v0)/c, in mm.
    let x0 = 1e3 * 100.0 * (0.2 + 0.2 * exp(-0.2 / 0.3)) / 5000.0;
    let ends = told.lines().find_map(|it| it.strip_prefix("  from ")).unwrap();
    let right: f64 = ends.split(' ').nth(2).unwrap().parse().unwrap();
    let expected = x0 * drawn.panels[0].x.to;
    assert!((right / expected - 1.0).abs() < 1e-5, "{right} for {expected}");
}
