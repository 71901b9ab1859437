//! Completion of the words of a line, and the rows of the parameter pane as text.

use crate::flow::METHODS;
use crate::model::{Group, Knob};
use crate::numerics::shortest;
use crate::scan::MEASURES;
use crate::scene::{LAYERS, ORDINATES, Ordinate, Unit, Window};
use crate::session::{
    Command, Completion, Context, Keymap, NamedValue, Row, Session, Setup, called, choices,
};
use crate::words::{counted, in_unit, joined, significant};

/// These names as candidates.
pub fn all<Name: ToString>(names: impl IntoIterator<Item = Name>) -> Vec<String> {
    names.into_iter().map(|name| name.to_string()).collect()
}

/// A layer, then on or off.
pub fn layers(session: &Session, given: &[&str]) -> Vec<String> {
    match given {
        [_, state @ ..] if !state.is_empty() => switch(session, state),
        _ => all(LAYERS.iter().map(|row| row.name)),
    }
}

/// No candidates, where the words are numbers or files.
pub fn nothing(_: &Session, _: &[&str]) -> Vec<String> {
    Vec::new()
}

/// The letters of marks that are set.
pub fn marks(session: &Session, _: &[&str]) -> Vec<String> {
    all(session.marks.places.keys())
}

/// The values of a setting of the screen.
pub fn values<T: NamedValue>(_: &Session, _: &[&str]) -> Vec<String> {
    all(choices::<T>().map(|row| row.0))
}

pub fn switch(_: &Session, given: &[&str]) -> Vec<String> {
    if given.len() == 1 {
        all(["on", "off"])
    } else {
        Vec::new()
    }
}

/// A number of the diagram in use, then a property of the cycles.
pub fn axes(session: &Session, given: &[&str]) -> Vec<String> {
    match given.len() {
        1 => {
            let plot = session.diagram().unwrap_or(session.plot);
            all(session.abscissae(session.plots[plot].view))
        }
        2 => properties().map(|row| row.0).collect(),
        _ => Vec::new(),
    }
}

/// The rows to which a line can assign a value; without a machine, none of a machine. The accuracy of every method has
/// one.
pub fn rows(session: &Session) -> impl Iterator<Item = Row> {
    let accuracy = [Knob::Step, Knob::Epsilon].map(Row::Number);
    Row::all().filter(|row| session.has(*row)).chain(accuracy)
}

/// The properties of the cycles by their names; those that are lengths also in units of r.
pub fn properties() -> impl Iterator<Item = (String, (Ordinate, Unit))> {
    ORDINATES.iter().flat_map(|row| {
        let ratio = row.ratio.map(|_| (format!("{}/r", row.name), (row.ordinate, Unit::Friction)));
        std::iter::once((row.name.to_owned(), (row.ordinate, Unit::One))).chain(ratio)
    })
}

/// Candidates for an assignment: names with `=`, or after a name its present value.
pub fn assignments(session: &Session, words: &[&str]) -> Vec<String> {
    match words.last().copied().unwrap_or_default().split_once('=') {
        Some(("method", _)) => METHODS.iter().map(|row| format!("method={}", row.name)).collect(),
        Some((name, "")) => {
            let row = rows(session).find(|row| row.name() == name);
            row.map(|row| format!("{name}={}", plain_value(session, row))).into_iter().collect()
        }
        Some(_) => Vec::new(),
        None => rows(session).map(|row| format!("{}=", row.name())).collect(),
    }
}

/// The names of the methods.
pub fn methods(_: &Session, _: &[&str]) -> Vec<String> {
    all(METHODS.iter().map(|row| row.name))
}

/// The present window of the plot in use, in a form that can be typed.
pub fn window(session: &Session, _: &[&str]) -> Vec<String> {
    let Window { x, y } = session.plots[session.plot].window;
    let [x, y] = [x, y].map(|span| joined(span.ends().map(shortest), ":"));
    vec![format!("{x},{y}")]
}

/// Numbers with `=`, and once one of them is given, also measures.
pub fn scan(session: &Session, words: &[&str]) -> Vec<String> {
    let knobs = session.scanned_groups().iter().flat_map(|group| group.knobs());
    let knobs = knobs.filter(|knob| session.has(Row::Number(*knob)));
    let moved = words.iter().any(|word| word.contains('='));
    let measures = MEASURES.iter().filter(|_| moved).map(|row| row.name.to_owned());
    knobs.map(|knob| format!("{knob}=")).chain(measures).collect()
}

/// Every name with which a line can begin, in the order of the tables.
pub fn names(keymap: &Keymap) -> impl Iterator<Item = &'static str> {
    let typed = |command: &&Command| !command.contexts().all(Context::is_overlay);
    let commands = keymap.commands().filter(typed).map(|command| command.name);
    let commands = commands.filter(move |name| keymap.line(name).is_none());
    keymap.lines().map(|line| line.name).chain(commands)
}

/// The candidates for the last word of a text; `None` if there are none.
pub fn completion(session: &Session, text: &str) -> Option<Completion> {
    let start = text.trim_end_matches(|char: char| !char.is_whitespace()).len();
    let (stem, word) = text.split_at(start);
    let words = match stem.split_whitespace().next() {
        None => names(&session.keymap).map(str::to_owned).collect(),
        Some(name) => {
            let given: Vec<&str> = stem.split_whitespace().skip(1).chain([word]).collect();
            session.keymap.line(name)?.words()?(session, &given)
        }
    };
    let fits = |candidate: &String| candidate.starts_with(word) && candidate != word;
    let words: Vec<String> = words.into_iter().filter(fits).collect();
    (!words.is_empty()).then(|| Completion { stem: stem.to_owned(), words, at: 0 })
}

/// The syntax and the explanation of the command with which a line begins; of a measure at the end of a scan, its name
/// and its meaning.
pub fn described(keymap: &Keymap, text: &str) -> Option<(&'static str, &'static str)> {
    let (name, _) = called(text);
    let last = text.rsplit([' ', ',']).next().filter(|_| name == "scan");
    if let Some(row) = MEASURES.iter().find(|row| Some(row.name) == last) {
        return Some((row.name, row.meaning));
    }
    let found = keymap.line(name).or(keymap.named(name))?;
    Some((found.arguments, found.doc))
}

/// The value of a row in a form that can be typed, with its unit and its half width; `None` for a number of a
/// machine that is as in its file.
pub(crate) fn typed(setup: &Setup, row: Row) -> Option<String> {
    if row == Row::Method {
        return Some(setup.problem.method.to_string());
    }
    let knob = row.knob_in(&setup.problem);
    let value = knob.print(setup.get(knob)?);
    let half_width = setup.doubt.half_width(knob);
    Some(if half_width > 0.0 {
        format!("{value}+-{}", shortest(half_width))
    } else {
        value
    })
}

/// The present value of a row in a single word: a number in SI units without its unit.
pub(crate) fn plain_value(session: &Session, row: Row) -> String {
    match row {
        Row::Method => session.problem.method.to_string(),
        row => shortest(session.value(row.knob_in(&session.problem))),
    }
}

/// Letters of a number that somebody may have typed.
const TYPED: usize = 14;

/// The differences of `new` from `old`, as `name = value`. If a number of the machine differs, only that: the
/// parameters follow from it.
pub(crate) fn difference(old: &Setup, new: &Setup) -> String {
    let belt = new.setting.is_some() && old.setting != new.setting;
    let follows = |row: &Row| row.knob_in(&new.problem).spec().group == Group::Motion;
    let rows = Row::all().filter(|row| !(belt && follows(row)));
    let said = rows.filter(|row| typed(old, *row) != typed(new, *row)).map(|row| {
        let value = typed(new, row).unwrap_or_else(|| "as in its file".to_owned());
        let knob = row.knob_in(&new.problem);
        let number = new.get(knob).filter(|number| shortest(*number).len() > TYPED);
        // One that follows from others is not told to all its digits.
        let value = number.map_or(value, |it| in_unit(&significant(it, 5), knob.spec().unit));
        format!("{} = {value}", row.name_in(&new.problem))
    });
    let count = |setup: &Setup| setup.others.len() + 1;
    let motions = (count(old) != count(new)).then(|| counted(count(new), "motion"));
    joined(said.chain(motions), ", ")
}
