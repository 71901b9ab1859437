//! What a lecture shows besides plots: the numbers in one line, the outcome in letters that are read from the back of a
//! room, and below it why.

use std::collections::BTreeMap;
use std::sync::LazyLock;

use ratatui::layout::Rect;
use ratatui::text::Span;

use super::{Surface, margin, pane, parameters, status, verdict};
use crate::model::Knob;
use crate::numerics::cells;
use crate::picture::Role;
use crate::session::{Glyphs, Pane, Row, Session};
use crate::words::joined;

/// Rows of a letter, before it is enlarged.
const HEIGHT: usize = 5;

/// The rows of each letter, from above.
static LETTERS: LazyLock<BTreeMap<char, Vec<&str>>> = LazyLock::new(|| {
    let lines = include_str!("../../assets/letters.txt").lines();
    let letter = |line: &'static str| {
        let (letter, rows) =
            line.split_once(' ').filter(|(letter, _)| letter.len() == 1 && *letter != "#")?;
        Some((letter.chars().next()?, rows.split(' ').collect()))
    };
    lines.filter_map(letter).collect()
});

/// What is said in large letters of a motion, by the beginning of the sentence about it; nothing where that is no outcome.
fn large(sentence: &str) -> &'static str {
    let mut rows = include_str!("../../assets/outcomes.txt").lines().filter_map(cells::<2>);
    rows.find(|[begin, _]| sentence.starts_with(begin)).map_or("", |[_, large]| large)
}

/// Draws the numbers of the scene in a line, the selected one marked.
pub fn numbers(area: Rect, session: &Session, screen: &mut Surface) {
    let look = screen.look;
    let focused = session.focus == Pane::Parameters;
    let internal = |row: &Row| match row {
        Row::Method | Row::Tolerance => true,
        Row::Number(knob) => [Knob::Until, Knob::Step, Knob::Epsilon].contains(knob),
    };
    let mut rows = session.rows();
    // On the belt D, D2, D3 and r follow from the numbers of the machine, of which its speed is changed most.
    let on_the_belt = session.is_on_the_belt() == Some(true);
    let follows = |row: &Row| {
        on_the_belt && row.stepped().is_some_and(|knob| Knob::PARAMETERS.contains(&knob))
    };
    let left_out =
        |row: &Row| internal(row) || follows(row) || (!on_the_belt && row.is_of_machine());
    let is_selected = |row: &Row| focused && *row == session.selected;
    rows.retain(|row| is_selected(row) || !left_out(row));
    rows.sort_by_key(|row| *row != Row::BELT && !follows(row));
    let number = |row: Row| {
        let selected = is_selected(&row);
        let pointer = if selected { &look.symbols().pointer } else { " " };
        let value = |of: &Session| parameters::value(of, &of.setup(), row, NUMBER, look);
        let own = value(session);
        let [unit, theirs] = [unit(row), theirs(session, &own, value)];
        let text = format!("{pointer}{} {own}{unit}{theirs} ", row.name_in(&session.problem));
        let role = if selected { Role::Focus } else { Role::Text };
        look.span(text, role)
    };
    let mut texts: Vec<Span> = rows.iter().map(|row| number(*row)).collect();
    let selected = rows.iter().position(is_selected).unwrap_or(0);
    // Where not all fit, the selected one does, and none is cut.
    let fits =
        |texts: &[Span]| texts.iter().map(Span::width).sum::<usize>() <= usize::from(area.width);
    let first = (0..selected).find(|first| fits(&texts[*first..=selected])).unwrap_or(selected);
    texts.drain(..first);
    let fitting = (0..=texts.len()).rev().find(|count| fits(&texts[..*count]));
    texts.truncate(fitting.unwrap_or(0).max(1));
    screen.line(area, 0, texts);
}

/// The unit of a number of a machine.
fn unit(row: Row) -> String {
    let knob = row.stepped().filter(|_| row.is_of_machine());
    let unit = knob.map(|knob| knob.spec().unit).filter(|unit| !unit.is_empty());
    unit.map_or_else(String::new, |unit| format!(" {unit}"))
}

/// The value of the pinned point, where it is another.
fn theirs(session: &Session, own: &str, value: impl Fn(&Session) -> String) -> String {
    let pinned = session.letters().zip(session.other.as_deref());
    let theirs = pinned.map(|([_, letter], other)| (letter, value(other)));
    let theirs = theirs.filter(|(_, theirs)| theirs != own);
    theirs.map_or_else(String::new, |(letter, theirs)| format!(" ({letter} {theirs})"))
}

/// Columns of a number.
const NUMBER: usize = 9;

/// Draws the outcome: in large letters what becomes of the motion, in two lines why, and which kicks are survived.
pub fn outcome(area: Rect, session: &Session, screen: &mut Surface) {
    let look = screen.look;
    let (sentence, role) = verdict::outcome(session);
    let tall = Rect { height: area.height.saturating_sub(2), ..area };
    // While it is played, one looks.
    if !session.playback.playing {
        let large = large(&sentence);
        let whose = session.letter().filter(|_| !large.is_empty());
        letters(tall, &joined(whose.into_iter().chain([large]), " "), screen);
    }
    let width = usize::from(area.width);
    let below = Rect { y: tall.bottom(), height: area.height.min(2), ..area };
    screen.line(below, 0, look.span(pane::cut(&format!(" {sentence}"), width, look), role));
    if session.kicking {
        return status::survived(below, session, screen);
    }
    let margin = margin::status(session).filter(|_| !session.is_asked()).unwrap_or_default();
    let margin = margin.split(';').next().unwrap_or_default();
    screen.line(below, 1, look.span(format!(" {margin}"), Role::Text));
}

/// Writes large letters into an area, twice as large where there is room: two rows of dots in a row of cells, or as spaced
/// capitals where there are no blocks.
fn letters(area: Rect, text: &str, screen: &mut Surface) {
    let style = screen.look.style(Role::Title);
    if screen.look.glyphs == Glyphs::Ascii {
        let spaced: String = text.chars().flat_map(|letter| [letter, ' ']).collect();
        screen.buffer.set_string(area.x + 1, area.y + area.height / 2, spaced, style);
        return;
    }
    let blank = vec!["."; HEIGHT];
    let drawn: Vec<&Vec<&str>> =
        text.chars().map(|letter| LETTERS.get(&letter).unwrap_or(&blank)).collect();
    let row = |row: usize| drawn.iter().map(|letter| letter[row]).collect::<Vec<_>>().join(".");
    let rows: Vec<Vec<bool>> =
        (0..HEIGHT).map(|index| row(index).chars().map(|dot| dot == '#').collect()).collect();
    let columns = rows[0].len();
    let fits = |scale: &usize| {
        columns * scale < usize::from(area.width)
            && (HEIGHT * scale).div_ceil(2) <= usize::from(area.height)
    };
    let Some(scale) = [2, 1].into_iter().find(fits) else { return };
    let dot = |x: usize, y: usize| rows.get(y / scale).is_some_and(|row| row[x / scale]);
    for y in 0..(HEIGHT * scale).div_ceil(2) {
        let cell = |x: usize| match (dot(x, 2 * y), dot(x, 2 * y + 1)) {
            (true, true) => '█',
            (true, false) => '▀',
            (false, true) => '▄',
            (false, false) => ' ',
        };
        let line: String = (0..columns * scale).map(cell).collect();
        screen.buffer.set_string(area.x + 1, area.y + pane::cells(y), line, style);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::flow::Limits;
    use crate::question::answer;
    use crate::scene::library;
    use crate::session::{Msg, Size, settle};

    #[test]
    fn what_becomes_of_the_motion_of_every_scene_has_large_letters() {
        let mut told = 0;
        for scene in library() {
            let mut session = Session::new(scene.clone(), Size { width: 80, height: 24 });
            session.playback.at = None;
            settle(&mut session, |_, request| {
                let found = answer(request, &Limits::PATIENT).ok()?;
                Some(Msg::answered(request.clone(), Ok(found), 0.0))
            });
            let (sentence, role) = verdict::outcome(&session);
            if role == Role::Text && session.follows_motion() {
                assert!(!large(&sentence).is_empty(), "{}: {sentence}", scene.name);
                told += 1;
            }
        }
        assert!(told > 20, "{told}");
    }

    #[test]
    fn every_outcome_can_be_written_in_large_letters() {
        let rows = include_str!("../../assets/outcomes.txt").lines().filter_map(cells::<2>);
        for [begin, text] in rows {
            assert_eq!(large(begin), text, "no row before hides it");
            assert!(
                text.chars().all(|letter| letter == ' ' || LETTERS.contains_key(&letter)),
                "{text}"
            );
        }
        for (letter, rows) in LETTERS.iter() {
            assert_eq!(rows.len(), HEIGHT, "{letter}");
            assert!(rows.iter().all(|row| row.len() == rows[0].len()), "{letter}");
        }
    }
}
