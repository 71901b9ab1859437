//! What the explorer shows, as a page: its words and numbers, and the commands that give these again.

use std::path::Path;

use super::cycle_numbers::{machine_cycles, number_columns};
use super::cycles::{NO_CYCLE, border, known};
use super::margin::{MarginRow, margin_columns};
use super::{About, Answer, Columns, Table};
use crate::portrait::{Cycle, Portrait};
use crate::session::act::copy::command_line;
use crate::session::read::completion::typed;
use crate::session::{Key, Pane, Row, Session};
use crate::words::stability;

/// Digits of a number without a unit.
const DIGITS: usize = 10;

/// What a session shows. What becomes of the motion is said in a sentence; a file beside the page plays how it came there.
pub fn shown(session: &Session, outcome: String, beside: &Path) -> Answer {
    let scene = &session.scene;
    let text = |text: &str| session.keymap.fill(&session.said(text), Key::said);
    let answer = Answer::new(&scene.name, scene.title.clone())
        .statement(outcome, true)
        .lines([text(&scene.watch)])
        .heading("Numbers")
        .table(numbers(session));
    let answer = match session.cycles() {
        Some(found) => portrayed(answer, session, &found.portrait),
        None => answer,
    };
    answer
        .heading("The same on the command line")
        .lines(commands(session))
        .heading("The same in the explorer")
        .lines([
            text(&scene.press),
            format!("Every key up to here: asciinema play {}", beside.display()),
        ])
}

/// The rows of the parameter pane: names, values, meanings.
fn numbers(session: &Session) -> Table {
    let (setup, problem) = (session.setup(), &session.problem);
    let row = |row: Row| {
        let knob = row.knob_in(problem);
        let value = typed(&setup, row).unwrap_or_else(|| knob.print(session.value(knob)));
        vec![row.name_in(problem).to_owned(), value, knob.spec().meaning.to_owned()]
    };
    let rows = session.rows().into_iter().filter(|row| *row != Row::Method);
    Table::new(["", "value", "meaning"].map(str::to_owned).into(), rows.map(row).collect())
}

/// With the cycles and the margins.
fn portrayed(answer: Answer, session: &Session, found: &Portrait) -> Answer {
    let (source, _) = session.source(&session.problem.parameters);
    let about = About::new(&session.scene.name, &session.scene.title, &source);
    let (cycles, lines) = if about.is_machine() {
        (machine_cycles(|cycle: &Cycle| Some(*cycle)).table(&found.cycles), known(found))
    } else {
        let named = Columns::default().text("cycle", |cycle: &Cycle| stability(cycle.stable));
        let cycles = number_columns(named, |cycle, number| number.text(cycle, DIGITS));
        (cycles.table(&found.cycles), vec![border(found.border)])
    };
    let margin: Columns<MarginRow> =
        Columns::default().text("margin", |_: &MarginRow| "smallest kick that is not survived");
    answer
        .heading("Limit cycles")
        .table(cycles)
        .lines(found.cycles.is_empty().then_some(NO_CYCLE))
        .lines(lines)
        .heading("Margins")
        .table(margin.and(margin_columns(&about, DIGITS)).table([("", found.margin)]).transposed())
}

/// The commands that give the numbers of the panes, each once.
fn commands(session: &Session) -> Vec<String> {
    let panes = [Pane::Parameters].into_iter().chain(session.on_show().map(Pane::Plot));
    let command = |focus| command_line(&Session { focus, ..session.clone() });
    let mut lines: Vec<String> = panes.map(command).collect();
    lines.dedup();
    lines
}
