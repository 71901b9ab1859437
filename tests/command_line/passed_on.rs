//! What is passed on: sounds, recordings of the screen, pages of what is on show.

use std::fs;
use std::path::Path;

use hopfscope::numerics::elementary::{cos, sin};
use roxmltree::{Document, ParsingOptions};
use serde_json::Value;

use crate::program::{Ran, run};

/// Runs a command line that ends with a file in a folder, and returns that file, too.
fn written(folder: &Path, line: &str) -> (Ran, Option<Vec<u8>>) {
    let (line, name) = line.rsplit_once(' ').unwrap();
    let path = folder.join(name);
    let words: Vec<&str> = line.split(' ').chain([path.to_str().unwrap()]).collect();
    (run(&words), fs::read(&path).ok())
}

/// The samples of a sound, as parts of the full scale.
fn samples(bytes: &[u8]) -> Vec<f64> {
    let word = |at: usize| u16::from_le_bytes([bytes[at], bytes[at + 1]]);
    let long = |at: usize| u32::from(word(at)) + 65_536 * u32::from(word(at + 2));
    assert_eq!((&bytes[..4], &bytes[8..16]), (b"RIFF".as_slice(), b"WAVEfmt ".as_slice()));
    assert_eq!([word(20), word(22), word(34)], [1, 1, 16], "PCM, mono, 16 bit");
    assert_eq!((long(24), long(28)), (48_000, 96_000));
    assert_eq!(
        (&bytes[36..40], usize::try_from(long(40)).unwrap()),
        (b"data".as_slice(), bytes.len() - 44)
    );
    let level = |pair: &[u8]| f64::from(i16::from_le_bytes([pair[0], pair[1]])) / 32_767.0;
    bytes[44..].chunks(2).map(level).collect()
}

/// Number of passages through zero upwards.
fn rises(samples: &[f64]) -> usize {
    samples.windows(2).filter(|pair| pair[0] < 0.0 && pair[1] >= 0.0).count()
}

#[test]
fn an_undamped_oscillator_is_a_pure_tone_of_the_pitch_that_is_asked_for() {
    let folder = tempfile::tempdir().unwrap();
    let line = "sound --set D=0 --set r=0 --set q0=1 --seconds 2 --pitch 440 --output tone.wav";
    let (ran, file) = written(folder.path(), line);
    assert_eq!((ran.code, ran.err.as_str()), (0, ""));
    let heard = "louder than a hundredth of its peak from 0 to 2 s";
    let told = format!("tone.wav: 2 s, the natural frequency at 440 Hz, {heard}\n");
    assert!(ran.out.ends_with(&told), "{}", ran.out);
    let tone = samples(&file.unwrap());
    assert_eq!(tone.len(), 96_000);
    // The mean of -sin over a sample is a difference of cos; its largest value is nine tenths of the full scale.
    let step = std::f64::consts::TAU * 440.0 / 48_000.0;
    let mean = |at: f64| cos(step * (at + 1.0)) - cos(step * at);
    let most = 2.0 * sin(0.5 * step);
    for (sample, at) in tone.iter().zip(0..96_000) {
        let expected = 0.9 * mean(f64::from(at)) / most;
        assert!((sample - expected).abs() < 2e-4, "{at}: {sample} {expected}");
    }
}

#[test]
fn the_scene_of_a_slow_belt_sticks_and_slips_at_its_own_count() {
    let folder = tempfile::tempdir().unwrap();
    let line = "sound slow-belt --pitch 100 --seconds 2 --output squeal.wav";
    let (ran, file) = written(folder.path(), line);
    assert_eq!(ran.code, 0, "{}", ran.err);
    let late = samples(&file.unwrap()).split_off(48_000);
    // With the belt the mass never moves faster than this, and it rides on it for a while in each period.
    let most = late.iter().copied().fold(0.0, f64::max);
    let rides = late.iter().filter(|level| most - **level < 1e-4).count();
    // `cycles textbook --set v0=0.2`: it sticks for 11.961 of 126.99 ms, between -0.21524 and 0.2 m/s. A sample or two
    // beside each ride differ by less than can be told.
    assert!((4_500..=4_700).contains(&rides), "{rides}");
    let lowest = late.iter().copied().fold(0.0, f64::min);
    assert!((most / lowest + 0.2 / 0.215_24).abs() < 1e-3, "{most} {lowest}");
    assert!(rises(&late) < 100, "sticking makes the period longer than that of the free mass");
}

#[test]
fn what_makes_no_sound_and_what_is_in_the_way_is_refused_in_a_line() {
    let folder = tempfile::tempdir().unwrap();
    let refused = |line: &str, words: &[&str]| {
        written(folder.path(), line).0.is_refused(words);
    };
    refused("sound --output a.mp3", &["a sound ends in .wav"]);
    refused("sound --pitch 20001 --output a.wav", &["not a number in 1 .. 20000 Hz"]);
    refused("sound --over q0=1:2 --output a.wav", &["a start does not glide"]);
    refused("sound --over D=1:2:3 --output a.wav", &["expected NAME=FROM:TO"]);
    refused("sound groany --output a.wav", &["no scene \"groany\""]);
    let lost = |line: &str, words: &str| {
        let (ran, file) = written(folder.path(), line);
        assert!((ran.code, file) == (1, None) && ran.err.contains(words), "{}", ran.err);
    };
    lost("sound --set q0=0 --output a.wav", "the mass is at rest and stays there");
    lost("sound escape --set q0=9 --output a.wav", "the motion grows without bound");
    fs::write(folder.path().join("old.wav"), "mine").unwrap();
    refused("sound linear --output old.wav", &["already exists; add --force to overwrite"]);
    assert_eq!(fs::read(folder.path().join("old.wav")).unwrap(), b"mine");
    assert_eq!(written(folder.path(), "sound linear --force --output old.wav").0.code, 0);
}

/// The events of a recording of frames: its header, and when something is written.
fn events(text: &str) -> (Value, Vec<(f64, String)>) {
    let mut lines = text.lines().map(|line| serde_json::from_str::<Value>(line).unwrap());
    let header = lines.next().unwrap();
    let event = |event: Value| {
        assert!(["o", "r"].contains(&event[1].as_str().unwrap()), "{event}");
        (event[0].as_f64().unwrap(), event[2].as_str().unwrap().to_owned())
    };
    (header, lines.map(event).collect())
}

#[test]
fn a_replay_is_a_recording_in_which_a_motion_takes_its_own_time() {
    let folder = tempfile::tempdir().unwrap();
    let keys = folder.path().join("test.keys");
    fs::write(&keys, "<wait> <f8> <elapse 2> <f8> <right>").unwrap();
    let line = format!("replay {} --size 80x24 --cast a.cast", keys.display());
    let (ran, file) = written(folder.path(), &line);
    assert_eq!((ran.code, ran.err.as_str()), (0, ""));
    let (header, events) = events(&String::from_utf8(file.unwrap()).unwrap());
    assert_eq!([&header["version"], &header["width"], &header["height"]], [2, 80, 24]);
    assert!(
        events.iter().all(|(_, text)| !text.contains("\x1b[6n")),
        "it asks the terminal nothing"
    );
    assert!(events.windows(2).all(|pair| pair[0].0 <= pair[1].0));
    // Half a second for each of three keys, two seconds of motion, and two at the end.
    let end = events.last().unwrap().0;
    assert!((end - 5.5).abs() < 0.1, "{end}");
    let moving = events.iter().filter(|(time, _)| (0.5..2.5).contains(time)).count();
    assert!((30..=51).contains(&moving), "{moving} frames in two seconds");
    // A terminal that plays it ends on the last screen.
    let size = |cells| std::num::NonZero::new(cells).unwrap();
    let mut terminal = vt100::Parser::new(size(24), size(80), 0);
    let (_, shown) = events.split_last().unwrap();
    for (_, text) in shown {
        terminal.process(text.as_bytes());
    }
    let plain = |text: &str| text.replace('\u{2212}', "-");
    let screen = plain(&terminal.screen().contents());
    let ends = |text: &str| text.lines().map(|line| line.trim_end().to_owned()).collect::<Vec<_>>();
    assert_eq!(ends(screen.trim_end()), ends(plain(ran.out.trim_end()).as_str()));
    // Nothing is replaced unasked.
    fs::write(&keys, "<right*2>").unwrap();
    written(folder.path(), &line)
        .0
        .is_refused(&["a.cast already exists; add --force to overwrite"]);
}

#[test]
fn a_page_holds_pictures_numbers_and_commands_and_beside_it_the_way_there() {
    for (scene, words) in [
        ("supercritical", ["unstable", "hopfscope trajectory --set D=", "border of the basin"]),
        ("slow-belt", ["stick-slip", "hopfscope trajectory --machine ", "beyond the margin"]),
    ] {
        let folder = tempfile::tempdir().unwrap();
        let keys = folder.path().join("test.keys");
        let page = folder.path().join("shown.html");
        fs::write(&keys, format!("<wait> <run \"page {}\"> <wait>", page.display())).unwrap();
        let ran = run(&["replay", keys.to_str().unwrap(), "--scene", scene, "--allow-write"]);
        assert_eq!((ran.code, ran.err.as_str()), (0, ""), "{scene}");
        let text = fs::read_to_string(&page).unwrap();
        let options = ParsingOptions { allow_dtd: true, ..ParsingOptions::default() };
        let document = Document::parse_with_options(&text, options).unwrap();
        let count = |name: &str| document.descendants().filter(|it| it.has_tag_name(name)).count();
        assert!(count("script") == 0 && count("svg") >= 2 && count("table") >= 2, "{scene}");
        for word in words {
            assert!(text.contains(word), "{scene}: {word}");
        }
        let cast = fs::read_to_string(page.with_extension("cast")).unwrap();
        assert_eq!(events(&cast).0["version"], 2);
    }
}
