//! What the explorer shows, as a page: its words and numbers, and the commands that give these again.

use std::collections::BTreeSet;
use std::path::Path;

use super::cycle_numbers::{machine_cycles, number_columns};
use super::cycles::{NO_CYCLE, border, known};
use super::margin::{MarginRow, margin_columns};
use super::{About, Answer, Columns};
use crate::numerics::distinct;
use crate::portrait::{Cycle, Portrait};
use crate::scene::GlossaryEntry;
use crate::session::act::copy::command_line;
use crate::session::{Key, Pane, Session};
use crate::words::stability;

/// Digits of a number without a unit.
const DIGITS: usize = 10;

/// What a session shows. What becomes of the motion is said in a sentence; a file beside the page plays how it came there.
pub fn shown(session: &Session, outcome: String, beside: &Path) -> Answer {
    let scene = &session.scene;
    let text = |text: &str| session.keymap.fill(&session.said(text), Key::said);
    let (source, _) = session.source(&session.problem.parameters);
    let about = About::new(&scene.name, &scene.title, &source);
    let mut answer = Answer::new(&scene.name, scene.title.clone())
        .statement(outcome, true)
        .lines([text(&scene.watch), about.heading()]);
    if let Some(found) = session.cycles() {
        answer = portrayed(answer, &about, &found.portrait);
    }
    let meaning = |entry: &&GlossaryEntry| format!("{}: {}", entry.name, text(entry.definition));
    answer
        .heading("What the words mean")
        .lines(words(session).iter().map(meaning))
        .heading("The same on the command line")
        .lines(commands(session))
        .heading("The same in the explorer")
        .lines([text(&scene.press), format!("asciinema play {}: every key", beside.display())])
}

/// With the cycles and the margins.
fn portrayed(answer: Answer, about: &About, found: &Portrait) -> Answer {
    let (cycles, lines) = if about.is_machine() {
        (machine_cycles(|cycle: &Cycle| Some(*cycle)).table(&found.cycles), known(found))
    } else {
        let named = Columns::default().text("cycle", |cycle: &Cycle| stability(cycle.stable));
        let cycles = number_columns(named, |cycle, number| number.text(cycle, DIGITS));
        (cycles.table(&found.cycles), vec![border(found.border)])
    };
    let margin = Columns::default().text("smallest kick", |_: &MarginRow| "not survived");
    answer
        .heading("Limit cycles")
        .table(cycles)
        .lines(found.cycles.is_empty().then_some(NO_CYCLE))
        .lines(lines)
        .heading("Margins")
        .table(margin.and(margin_columns(about, DIGITS)).table([("", found.margin)]).transposed())
}

/// What explains the numbers and the layers on show, and the margin, each once.
fn words(session: &Session) -> Vec<&'static GlossaryEntry> {
    let numbers = session.rows().into_iter().map(|row| ("number", row.name_in(&session.problem)));
    let layers = session.layers.iter().filter(|layer| session.shows(**layer));
    let layers = layers.map(|layer| ("layer", layer.spec().name));
    let all = numbers.chain(layers).chain([("word", "margin")]);
    distinct(all.filter_map(|(kind, name)| GlossaryEntry::of(kind, name)))
}

/// The commands that give the numbers of the panes, each once.
fn commands(session: &Session) -> BTreeSet<String> {
    let panes = [Pane::Parameters].into_iter().chain(session.on_show().map(Pane::Plot));
    let command = |focus| command_line(&Session { focus, ..session.clone() });
    panes.map(command).collect()
}
