//! Scans: their line, rows in pieces, stopping and continuing, moving over points.

use std::ops::Range;
use std::sync::Arc;

use super::Trial;
use super::facts::refuses;
use crate::flow::Cost;
use crate::question::Rows;
use crate::scan::{Scan, ScanRow, Value};
use crate::scene::{Finding, Reply, Request, Topic, View};
use crate::session::{Content, Effect, Msg, Pane, ScanOnShow, ScanProgress, Session, update};

/// Made-up rows: the index of the point in each column.
pub fn rows(scan: &Scan, points: Range<usize>) -> Vec<ScanRow> {
    let row = |index: usize| ScanRow {
        values: vec![Value::Count(index); scan.measured().len()],
        reason: None,
        cost: Cost::default(),
    };
    points.map(row).collect()
}

fn scanned(session: &Session) -> &ScanOnShow {
    session.scanned.as_ref().expect("a scan")
}

/// Gives rows to the session as the worker does.
fn piece(session: &mut Session, request: &Request, points: Range<usize>) {
    let Request::Scan { scan, .. } = request else { panic!("{request:?}") };
    let complete = points.end == scan.points();
    let rows = Rows { first: points.start, rows: rows(scan, points) };
    let (request, result) = (request.clone(), Ok(Finding::Scan(rows)));
    let reply = Reply { request, result, seconds: 1.0, complete };
    update(session, Msg::Answered(Box::new(reply)));
}

/// A session that scans D over 6 values, without any row yet.
fn begun() -> (Session, Request) {
    let mut session = Trial::open("plain").session;
    crate::session::run_line(&mut session, "scan D=-0.6:-0.1:6 margin").unwrap();
    let request = session.scan_request().expect("a question");
    (session, request)
}

#[test]
fn a_key_opens_the_line_of_a_scan_that_makes_sense_and_later_that_of_the_last_one() {
    let mut trial = Trial::open("plain");
    trial.goes(&[("%", "typed scan D=-0.5:0.1:100 from-rest")]);
    assert_eq!(trial.press("<enter>"), [Topic::Scan]);
    let session = &trial.session;
    assert!(session.overlay.is_none() && session.focuses_scan());
    assert_eq!(scanned(session).scan.points(), 100);
    assert_eq!(scanned(session).progress, ScanProgress::Done);
    trial.goes(&[
        (": scan r=log:0.1:0.3:2 D=-0.6:-0.1:6 area,margin", "scanned 0"),
        ("%", "typed scan r=log:0.1:0.3:2 D=-0.6:-0.1:6 area,margin"),
    ]);
}

#[test]
fn a_scan_that_makes_no_sense_leaves_its_line_open_and_says_why() {
    refuses(
        "plain",
        &[
            (": scan x=0:1:5 area", "scan: no number \"x\"; there are D, D2"),
            (": scan q0=0:1:5 from-rest", "scan: from-rest does not depend on q0"),
            (": scan D=one:1:5 area", "scan: \"one\" is not a number"),
            (": scan D=-1e9:0:5 area", "scan: D = -1000000000 is outside its range"),
            (": scan D=:0:5 area", "scan: \"\" is not a number"),
            (": scan D=-0.5:0:1 area", "scan: COUNT = 1 is not a whole number in 2 .. 1000000"),
            (": scan D=-0.5:0:5 margin,much", "scan: there is no measure \"much\""),
        ],
    );
}

#[test]
fn rows_are_there_as_soon_as_their_piece_and_the_scan_counts_as_work_until_its_end() {
    let (mut session, request) = begun();
    assert!(session.is_open(&request) && session.wants().contains(&request));
    piece(&mut session, &request, 0..2);
    assert_eq!(scanned(&session).rows.len(), 2);
    assert_eq!(session.scan_request().as_ref(), Some(&request), "the same question goes on");
    assert!(session.is_busy());
    piece(&mut session, &request, 2..6);
    assert_eq!((scanned(&session).rows.len(), session.is_busy()), (6, false));
    assert_eq!(scanned(&session).progress, ScanProgress::Done);
}

#[test]
fn escape_stops_a_scan_and_keeps_what_is_done_and_a_key_goes_on() {
    let (mut session, request) = begun();
    piece(&mut session, &request, 0..4);
    let press = |session: &mut Session, key: &str| {
        update(session, Msg::Key(key.parse().unwrap()));
    };
    press(&mut session, "<esc>");
    assert_eq!(scanned(&session).progress, ScanProgress::Stopped);
    assert!(session.scan_request().is_none() && !session.is_open(&request));
    // A piece that arrives after the scan was stopped is discarded.
    piece(&mut session, &request, 4..6);
    assert_eq!(scanned(&session).rows.len(), 4);
    press(&mut session, "P");
    let again = session.scan_request().expect("a question");
    assert_eq!(again, Request::Scan { scan: Arc::clone(&scanned(&session).scan), from: 4 });
    piece(&mut session, &again, 4..6);
    assert_eq!(scanned(&session).progress, ScanProgress::Done);
    assert_eq!(scanned(&session).rows, rows(&scanned(&session).scan, 0..6));
}

#[test]
fn a_scan_goes_on_while_something_else_is_on_show_and_asks_nothing_when_it_is_done() {
    let (mut session, request) = begun();
    update(&mut session, Msg::Key(",".parse().unwrap()));
    assert!(session.plots.iter().all(|plot| plot.view != View::Scan));
    assert!(session.wants().contains(&request));
    let mut trial = Trial { session, asked: Vec::new(), effects: Vec::new() };
    assert_eq!(trial.press("<right>").iter().filter(|topic| **topic == Topic::Scan).count(), 1);
    assert!(!trial.press("<right>").contains(&Topic::Scan));
}

#[test]
fn points_are_walked_over_as_they_stand_and_enter_takes_one_into_the_phase_plane() {
    let mut trial = Trial::open("plain");
    let before = trial.session.problem;
    trial.goes(&[
        (": scan D=-0.6:-0.1:6 r=0.1:0.3:3 area", "scanned 0"),
        ("<right*2> <up> <enter>", "scanned 7 | D -0.4 | r 0.2"),
        ("u", "changes 1 1"),
    ]);
    assert_eq!(trial.session.problem, before);
    trial.goes(&[
        (": scan D=-0.6:-0.1:6 r=0.1:0.3:3 area", "scanned 0"),
        ("<up>", "scanned 1"),
        ("<right>", "scanned 4"),
        ("<up*5>", "scanned 5"),
        ("<left*9>", "scanned 2"),
        ("<end>", "scanned 17"),
        ("<home>", "scanned 2"),
        // In the table, the arrows move from row to row.
        ("t <down*2>", "scanned 4"),
        ("<up> <pgdn>", "scanned 13"),
        ("<end>", "scanned 17"),
        ("<home>", "scanned 0"),
    ]);
}

#[test]
fn a_key_saves_what_is_there() {
    let (mut session, request) = begun();
    piece(&mut session, &request, 0..3);
    let effects = update(&mut session, Msg::Key("S".parse().unwrap()));
    let scan = Arc::clone(&scanned(&session).scan);
    let rows = rows(&scan, 0..3);
    let (path, content) = ("scan.csv".into(), Content::Scan(scan, rows));
    assert_eq!(effects, [Effect::Write { path, content, replace: false }]);
}

#[test]
fn keys_for_a_scan_that_is_not_there_say_so_and_do_nothing() {
    let mut trial = Trial::open("plain");
    trial.press(":view<space>scan<enter>");
    assert!(trial.session.focuses_scan(), "{:?}", trial.session.focus);
    for key in ["<right>", "<up>", "<enter>", "Y", "t", "P", "S", "<esc>"] {
        trial.press(key);
        assert!(
            trial.session.scanned.is_none() && trial.session.focus != Pane::Parameters,
            "{key}"
        );
    }
}

/// How a margin is to be read is no measure of its own: the map of it would show nothing.
#[test]
fn the_measures_that_are_plotted_in_turn_have_numbers() {
    let mut trial = Trial::open("plain");
    trial.press("<run \"scan D=-0.6:-0.1:6 margin,from-rest\">");
    let mut seen = Vec::new();
    for key in ["Y", "Y", "Y", "Y", "<C-up>"] {
        trial.press(key);
        let scanned = scanned(&trial.session);
        seen.push(scanned.scan.measured()[scanned.column]);
    }
    let [impulse, shift, from_rest] = ["impulse", "from_rest_displacement", "from_rest_impulse"];
    assert_eq!(seen, [impulse, shift, from_rest, "displacement", from_rest]);
}
