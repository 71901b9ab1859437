//! Basins as arrays, and what an archive holds.

use std::fs;
use std::path::Path;

use serde_json::Value;

use crate::program::{json, number, run};
use crate::{file, word};

/// An array as it stands in an archive: its kind, its lengths, its bytes.
pub struct Stored {
    pub kind: String,
    pub shape: Vec<usize>,
    data: Vec<u8>,
}

impl Stored {
    /// Its numbers; those of smaller kinds are exact.
    pub fn numbers(&self) -> Vec<f64> {
        let eight = |bytes: &[u8]| <[u8; 8]>::try_from(bytes).unwrap();
        match self.kind.as_str() {
            "<f8" => self.data.chunks(8).map(|it| f64::from_le_bytes(eight(it))).collect(),
            "<i8" => self.data.chunks(8).map(|it| i64::from_le_bytes(eight(it)) as f64).collect(),
            "|u1" | "|b1" => self.data.iter().map(|it| f64::from(*it)).collect(),
            kind => panic!("{kind} is no number"),
        }
    }

    /// Its words.
    pub fn words(&self) -> Vec<String> {
        let length: usize = self.kind.strip_prefix("<U").unwrap().parse().unwrap();
        let char = |it: &[u8]| char::from_u32(u32::from_le_bytes(it.try_into().unwrap())).unwrap();
        let word = |it: &[u8]| it.chunks(4).map(char).filter(|char| *char != '\0').collect();
        self.data.chunks(4 * length).map(word).collect()
    }
}

/// The arrays of an archive, read by its central directory as a reader of zip files does.
pub fn arrays(path: &Path) -> Vec<(String, Stored)> {
    let bytes = fs::read(path).unwrap();
    let two = |at: usize| usize::from(u16::from_le_bytes([bytes[at], bytes[at + 1]]));
    let four = |at: usize| two(at) + (two(at + 2) << 16);
    let end = bytes.len() - 22;
    assert_eq!(&bytes[end..end + 4], b"PK\x05\x06");
    let (count, mut entry) = (two(end + 10), four(end + 16));
    let mut found = Vec::new();
    for _ in 0..count {
        assert_eq!(&bytes[entry..entry + 4], b"PK\x01\x02");
        let (size, named, at) = (four(entry + 24), two(entry + 28), four(entry + 42));
        let name = String::from_utf8(bytes[entry + 46..entry + 46 + named].to_vec()).unwrap();
        assert_eq!(&bytes[at..at + 4], b"PK\x03\x04");
        let from = at + 30 + two(at + 26) + two(at + 28);
        found.push((
            name.strip_suffix(".npy").unwrap().to_owned(),
            stored(&bytes[from..from + size]),
        ));
        entry += 46 + named;
    }
    found
}

/// A file of numpy.
fn stored(bytes: &[u8]) -> Stored {
    assert_eq!(&bytes[..8], b"\x93NUMPY\x01\x00");
    let length = usize::from(u16::from_le_bytes([bytes[8], bytes[9]]));
    assert_eq!((10 + length) % 64, 0);
    let header = std::str::from_utf8(&bytes[10..10 + length]).unwrap();
    assert!(header.ends_with('\n') && header.contains("'fortran_order': False"));
    let kind = header.split('\'').nth(3).unwrap().to_owned();
    let shape = header.split(['(', ')']).nth(1).unwrap().split(',');
    let shape = shape.filter_map(|length| length.trim().parse().ok()).collect();
    Stored { kind, shape, data: bytes[10 + length..].to_vec() }
}

#[test]
fn the_labels_of_a_basin_are_its_counts_and_its_border_encloses_its_area() {
    for (line, edge) in [
        (
            "basin --set D=-0.3 --set D3=0.5 --set r=0.1 --window=-1:1,-0.5:0.5 --grid 41x31",
            "cycle",
        ),
        ("basin --set D=0.1 --set D2=0.4 --set r=0.1 --grid 30x20", "separatrix"),
        ("basin --machine clutch --grid 30x20", "cycle"),
    ] {
        let (_folder, path) = file("b.npz");
        let words: Vec<&str> = line.split(' ').chain(["--write", word(&path)]).collect();
        assert_eq!(run(&words).code, 0);
        let found = arrays(&path);
        let of = |name: &str| &found.iter().find(|(own, _)| own == name).unwrap().1;
        let answer = json(line);
        let labels = of("labels").numbers();
        for (code, name) in of("legend").words().iter().enumerate() {
            let count = labels.iter().filter(|label| **label == code as f64).count();
            assert_eq!(Some(count as u64), answer["counts"][name].as_u64(), "{line}: {name}");
        }
        assert_eq!(of("labels").kind, "|u1");
        assert_eq!(of("labels").shape, [of("v").shape[0], of("q").shape[0]]);
        let margins = of("margin").numbers();
        let names = ["displacement", "impulse", "from_rest_displacement", "from_rest_impulse"];
        for (name, size) in names.iter().zip(&margins) {
            let margin = &answer["margin"];
            let told = match name.strip_prefix("from_rest_") {
                Some(kick) => &margin["from_rest"][kick],
                None => &margin[name],
            };
            assert_eq!(told.as_f64(), Some(*size).filter(|it| !it.is_nan()), "{line}: {name}");
        }
        assert_eq!(of("regime").words(), [answer["margin"]["regime"].as_str().unwrap()]);
        let border = of("border").numbers();
        let points: Vec<&[f64]> = border.chunks(2).collect();
        assert_eq!(answer["edge"], edge, "{line}");
        assert!(points.len() > 100, "{line}");
        if edge == "cycle" {
            assert_eq!(points[0], points[points.len() - 1], "{line}: it is closed");
            let cross = |pair: &[&[f64]]| pair[0][0] * pair[1][1] - pair[1][0] * pair[0][1];
            let area: f64 = 0.5 * points.windows(2).map(cross).sum::<f64>().abs();
            let expected = answer["area"].as_f64().unwrap_or_else(|| {
                // The document of a machine has no area; a scan measures it.
                let words =
                    ["scan", "--machine", "clutch", "--over", "v0=1:2:2", "--measure", "area"];
                let rows = run(&[&words[..], &["--format", "json"]].concat()).out;
                let row = rows.lines().next().unwrap();
                number(&serde_json::from_str::<Value>(row).unwrap()["area"])
            });
            assert!((area / expected - 1.0).abs() < 1e-3, "{line}: {area} {expected}");
        }
    }
}

#[test]
fn a_label_is_where_its_start_ends() {
    let (_folder, path) = file("b.npz");
    let line = "basin --set D=-0.3 --set D3=0.5 --set r=0.1 --window=-0.4:0.4,-0.3:0.3 --grid 9x7";
    let words: Vec<&str> = line.split(' ').chain(["--write", word(&path)]).collect();
    assert_eq!(run(&words).code, 0);
    let found = arrays(&path);
    let of = |name: &str| &found.iter().find(|(own, _)| own == name).unwrap().1;
    let (q, v, labels) = (of("q").numbers(), of("v").numbers(), of("labels").numbers());
    for (row, v) in v.iter().enumerate() {
        for (column, q) in q.iter().enumerate() {
            let set = format!(
                "trajectory --set D=-0.3 --set D3=0.5 --set r=0.1 --set q0={q} --set v0={v}"
            );
            let outcome = json(&(set + " --until 400"))["outcome"]["kind"].clone();
            let expected = if outcome == "captured" { 0.0 } else { 1.0 };
            assert_eq!(labels[row * 9 + column], expected, "{q} {v}");
        }
    }
}

/// Whether this build writes Parquet.
const IS_BUILT: bool = cfg!(feature = "parquet");

#[test]
fn what_arrays_cannot_hold_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    for (line, name, expected) in [
        ("basin --grid 2x2 --certify", "b.npz", "hold no proof"),
        ("basin --grid 2x2", "b.parquet", if IS_BUILT { ".npz" } else { "--features parquet" }),
        ("basin --grid 2x2 --format json", "b.npz", "leave out --format"),
        ("cycles --format table", "c.NPZ", "leave out --format"),
        ("margin --format json", "m.npz", "leave out --format"),
    ] {
        let path = folder.path().join(name);
        let words: Vec<&str> = line.split(' ').chain(["--write", word(&path)]).collect();
        run(&words).is_refused(&[name, expected]);
        assert!(!path.exists(), "{line}");
    }
    let path = folder.path().join("c.NPZ");
    assert_eq!(run(&["cycles", "--set", "D=-0.3", "--write", word(&path)]).code, 0);
    assert_eq!(arrays(&path)[0].0, "stable");
}

/// The points of a curve in a document.
fn curve<'a>(document: &'a Value, name: &'a str) -> impl Iterator<Item = [f64; 2]> + 'a {
    let rows = document["curves"].as_array().unwrap().iter();
    // Without a next turning point there is none.
    let number = |value: &Value| value.as_f64().unwrap_or(f64::NAN);
    rows.filter(move |row| row["curve"] == name)
        .map(move |row| [number(&row["x"]), number(&row["y"])])
}

#[test]
fn the_curves_of_a_basin_are_its_border_and_the_return_map() {
    let line = "basin --set D=-0.3 --set D3=0.5 --set r=0.1 --grid 2x2 --curves";
    let document = json(line);
    let margin = number(&document["margin"]["displacement"]);
    let farthest = curve(&document, "border").map(|[q, _]| q).fold(0.0, f64::max);
    assert!((farthest / margin - 1.0).abs() < 1e-9);
    // A turning point within the margin comes nearer to rest, one beyond it goes away from there, up to the stable cycle.
    for side in ["return_map_left", "return_map_right"] {
        let turns: Vec<_> = curve(&document, side).collect();
        assert!(turns.len() > 400);
        for [from, to] in turns.into_iter().map(|turn| turn.map(f64::abs)) {
            let is_beyond_both = from > 1.158_372_454_745_3;
            let comes_nearer = is_beyond_both || from < margin;
            assert!(to.is_finite() && ((to < from) == comes_nearer || from == 0.1), "{from} {to}");
        }
    }
    let words: Vec<&str> = line.split(' ').chain(["--format", "csv"]).collect();
    let rows = run(&words).out;
    assert!(rows.starts_with("curve,x,y\nborder,"));
    assert_eq!(rows.lines().count() - 1, {
        let names = ["border", "return_map_left", "return_map_right"];
        names.map(|name| curve(&document, name).count()).iter().sum::<usize>()
    });
    let machine = json("basin --machine clutch --grid 2x2 --curves");
    // Motions of the clutch grow between its unstable cycle and its stable one.
    let document = json("cycles --machine clutch");
    let [unstable, stable] = [0, 1].map(|cycle| number(&document["cycles"][cycle]["q_max"]));
    let turns = curve(&machine, "return_map_right");
    let (within, beyond): (Vec<[f64; 2]>, Vec<[f64; 2]>) =
        turns.partition(|[from, _]| *from < unstable);
    assert!(within.len() > 10 && within.iter().all(|[from, to]| to <= from));
    let between: Vec<_> = beyond.iter().filter(|[from, _]| *from < stable).collect();
    assert!(between.len() > 10 && between.iter().all(|[from, to]| to > from));
}
