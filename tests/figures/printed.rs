//! What is printed, read back from its files: sizes, letters, lines, and what files say of themselves.

use std::io::Read;

use flate2::read::ZlibDecoder;
use hopfscope::scene::{JournalStyle, Sheet};
use hopfscope::words::provenance::Provenance;

use super::*;

fn printed(scene: &str) -> Figure {
    figure(scene, Fineness::SCREEN).from(Provenance {
        program: "hopfscope".into(),
        version: "0.1.0".into(),
        revision: None,
        command: "hopfscope figure plain --set r=0.1".into(),
        checksum: None,
    })
}

/// A document as text, its compressed streams in the clear.
struct Document {
    plain: String,
    streams: Vec<Vec<u8>>,
}

impl Document {
    fn of(figure: &Figure) -> Self {
        let file = file(figure, FigureForm::Pdf).unwrap();
        assert_eq!(file, super::file(figure, FigureForm::Pdf).unwrap(), "the same bytes again");
        // Each byte as a letter.
        let plain: String = file.iter().map(|byte| char::from(*byte)).collect();
        let streams = plain.split("\nstream\n").skip(1).map(|part| {
            let (content, _) = part.split_once("\nendstream").expect("an end");
            let bytes: Vec<u8> = content.chars().map(|char| u8::try_from(char).unwrap()).collect();
            let mut out = Vec::new();
            if ZlibDecoder::new(&bytes[..]).read_to_end(&mut out).is_ok() {
                out
            } else {
                bytes
            }
        });
        let streams = streams.collect();
        Document { plain, streams }
    }

    /// The numbers before each of these operators on the page.
    fn operands(&self, operator: &str) -> Vec<f64> {
        let pages = self.streams.iter().map(|stream| String::from_utf8_lossy(stream));
        let page = pages.into_iter().find(|text| text.contains(" Tf\n")).expect("a page");
        let lines = page.lines().filter_map(|line| line.strip_suffix(operator));
        lines.filter_map(|line| line.split(' ').nth_back(1)?.parse().ok()).collect()
    }

    /// What stands behind a key, up to the end of its line.
    fn entry(&self, key: &str) -> Option<&str> {
        let (_, rest) = self.plain.split_once(&format!("/{key} "))?;
        rest.lines().next()
    }
}

fn once(numbers: &[f64]) -> Vec<f64> {
    let mut numbers = numbers.to_vec();
    numbers.sort_by(f64::total_cmp);
    numbers.dedup();
    numbers
}

#[test]
fn a_document_has_its_size_its_fonts_as_subsets_and_the_letters_and_lines_of_its_page() {
    let figure = printed("fig17");
    let document = Document::of(&figure);
    // Two by two panels of 460 x 374 pixels below a title, a line of legend; a pixel is 0.75 points.
    let height = 34.0 + 2.0 * 374.0 + 18.0 + 12.0;
    let size = format!("[0 0 {} {}]", 0.75 * 2.0 * 460.0, 0.75 * height);
    assert_eq!(document.entry("MediaBox"), Some(size.as_str()));
    let fonts = document.plain.match_indices("/BaseFont /").map(|(at, found)| {
        let name = &document.plain[at + found.len()..];
        name.lines().next().unwrap()
    });
    let fonts: BTreeSet<&str> = fonts.collect();
    for name in &fonts {
        let (tag, font) = name.split_once('+').expect("a subset");
        assert!(tag.len() == 6 && tag.bytes().all(|letter| letter.is_ascii_uppercase()), "{name}");
        assert!(["DejaVuSans", "DejaVuSans-Oblique"].contains(&font), "{name}");
    }
    assert_eq!((fonts.len(), document.plain.matches("/FontFile2").count()), (2, 2));
    let embedded = document.streams.iter().filter(|stream| stream.starts_with(&[0, 1, 0, 0]));
    assert!(embedded.map(Vec::len).all(|length| length < 20_000), "not the whole fonts");
    // Sizes of letters: titles, axes, legend, captions, and their subscripts; a page in pixels is scaled.
    let sizes = once(&document.operands("Tf"));
    for size in [14.0, 12.5, 12.0, 11.0, 10.5] {
        assert!(sizes.contains(&size), "{size} is none of {sizes:?}");
    }
    assert!(sizes.iter().all(|size| *size >= 7.5), "{sizes:?}");
    // Stable and unstable cycles, the frame, ticks, guides, and the white around letters.
    let widths = once(&document.operands("w"));
    for width in [0.6, 0.8, 0.9, 1.6, 3.0] {
        assert!(widths.contains(&width), "{width} is none of {widths:?}");
    }
}

#[test]
fn a_document_for_a_journal_has_its_width_and_the_letters_and_lines_that_it_asks_for() {
    // White around letters, and what makes letters bold, are no lines.
    let (halo, bold) = (2.0, 0.4 * 2.0 / 3.0);
    for scene in ["fig17", "benchmark"] {
        let drawn = figure(scene, Fineness::SCREEN);
        for (style, finest) in [(JournalStyle::Springer, 0.5), (JournalStyle::Ieee, 0.25)] {
            for millimetres in [84.0, 174.0] {
                let width = Some(format!("{millimetres} mm").parse().unwrap());
                let sheet = Sheet { width, style: Some(style), ..Sheet::default() };
                let document = Document::of(&Figure { sheet, ..drawn.clone() });
                let size = document.entry("MediaBox").unwrap();
                let wide: f64 = size.split(' ').nth(2).unwrap().parse().unwrap();
                let place = format!("{scene}, {style:?}, {millimetres} mm");
                assert!((wide - millimetres * 72.0 / 25.4).abs() < 1e-3, "{place}: {wide}");
                let sizes = once(&document.operands("Tf"));
                assert!(sizes.contains(&8.0) && sizes.contains(&7.0), "{place}: {sizes:?}");
                assert!(sizes.iter().all(|size| (6.0..=8.0).contains(size)), "{place}: {sizes:?}");
                let widths = once(&document.operands("w"));
                for width in widths {
                    let known = [finest, 0.5, 0.8, 1.2, halo, bold];
                    let is_known = known.iter().any(|it| (it - width).abs() < 1e-6);
                    assert!(is_known, "{place}: {width} pt");
                }
            }
        }
    }
}

#[test]
fn files_say_what_they_show_and_how_they_are_made_again_but_not_when() {
    let figure = printed("plain");
    let document = Document::of(&figure);
    assert_eq!(document.entry("Title"), Some(format!("({})", figure.title).as_str()));
    assert_eq!(document.entry("Keywords"), Some("(hopfscope figure plain --set r=0.1)"));
    assert!(document.plain.contains("D = -0.1, D2 = 0.0"));
    assert!(document.entry("Creator").unwrap().starts_with("(hopfscope 0."));
    for absent in ["Author", "CreationDate", "ModDate"] {
        assert_eq!(document.entry(absent), None);
    }
    let dots = file(&figure, FigureForm::Png).unwrap();
    let text = String::from_utf8_lossy(&dots);
    for said in [figure.title.as_str(), "hopfscope figure plain --set r=0.1", "D = -0.1, D2 = 0.0"]
    {
        assert!(text.contains(said), "{said}");
    }
    assert!(super::text(&figure, FigureForm::Svg).contains("hopfscope figure plain --set r=0.1"));
}

/// The part of a PNG with this name.
fn chunk(dots: &[u8], name: [u8; 4]) -> &[u8] {
    let at = dots.windows(4).position(|four| *four == name).expect("a chunk");
    let length = u32::from_be_bytes(dots[at - 4..at].try_into().unwrap());
    &dots[at + 4..][..usize::try_from(length).unwrap()]
}

#[test]
fn a_picture_of_dots_is_as_large_as_it_says_at_any_number_of_dots_to_the_inch() {
    let number = |bytes: &[u8]| f64::from(u32::from_be_bytes(bytes.try_into().unwrap()));
    let mut figure = printed("fig08");
    for dots in [150_u32, 288, 600] {
        figure.sheet.dpi = Some(u16::try_from(dots).unwrap());
        let file = file(&figure, FigureForm::Png).unwrap();
        let (head, size) = (chunk(&file, *b"IHDR"), chunk(&file, *b"pHYs"));
        // 1 stands for metres.
        assert_eq!(size[8], 1);
        for (side, pixels) in [(0, 920.0), (1, 438.0)] {
            let [count, in_metre] = [&head[4 * side..][..4], &size[4 * side..][..4]].map(number);
            let (inches, printed) = (pixels / 96.0, count / in_metre / 0.0254);
            assert!((in_metre * 0.0254 - f64::from(dots)).abs() < 0.02, "{in_metre}");
            assert!((printed / inches - 1.0).abs() < 1e-3, "{printed} for {inches}");
        }
    }
}

/// Runs as they are set: `/italic/`, `_subscript_`, `^superscript^`.
fn marked(text: &str) -> String {
    use hopfscope::figure::LetterStyle;
    let mark = |setting: LetterStyle| match setting {
        LetterStyle::Upright => "",
        LetterStyle::Italic => "/",
        LetterStyle::Subscript => "_",
        LetterStyle::Superscript => "^",
    };
    let all = runs(text);
    let parts = all.iter().flat_map(|run| [mark(run.setting), &run.text, mark(run.setting)]);
    parts.collect()
}

#[test]
fn symbols_are_set_as_one_writes_them_and_words_are_not_touched() {
    for (written, set) in [
        ("q_max", "/q/_max_"),
        ("D3 over r", "/D/_3_ over /r/"),
        ("D_F, v_min", "/D/_F_, /v/_min_"),
        ("tau in 1/omega_0", "/\u{3c4}/ in 1//\u{3c9}/_0_"),
        ("omega0 x0^2 [m/s]", "/\u{3c9}/_0_ /x/_0_^2^ [m/s]"),
        ("mu_s, m, 10 N s", "/\u{3bc}/_s_, m, 10 N s"),
        ("A_q/r", "/A/_q_//r/"),
        ("motion, A", "motion, A"),
        ("rate of the energy V'", "rate of the energy /V/\u{2032}"),
        ("the paper's damping", "the paper's damping"),
        ("D = -0.1", "/D/ = \u{2212}0.1"),
        ("-r - l", "\u{2212}/r/ \u{2212} /l/"),
        ("(c)", "(c)"),
        ("D-0.10964", "/D/\u{2212}0.10964"),
        ("1e-6", "1\u{b7}10^\u{2212}6^"),
        ("-1.5e12", "\u{2212}1.5\u{b7}10^12^"),
        ("stick-slip, 2026-11-27", "stick-slip, 2026-11-27"),
        ("0.2 +- 0.1", "0.2 \u{b1} 0.1"),
        ("--set r=0.1+-0.01", "--set /r/=0.1+-0.01"),
        ("Gr\u{f6}\u{df}e q", "Gr\u{f6}\u{df}e /q/"),
        ("Dc -0.04", "/D/_c_ \u{2212}0.04"),
        ("", ""),
    ] {
        assert_eq!(marked(written), set, "{written}");
    }
}
