//! Keystroke files as data: their steps, the messages that these give to a session, and how they are written and read.

use std::fmt;
use std::sync::LazyLock;

use thiserror::Error;

use crate::model::{Group, Knob};
use crate::numerics::most_similar;
use crate::scene::Point;
use crate::session::Instruction::Give;
use crate::session::{Code, Done, Gesture, Key, MouseAction, Msg, PointerTarget, key};
use crate::words::{joined, printable};

/// Longest time in a single step, in s.
pub const LONGEST: f64 = 3600.0;

/// Maximum number of steps that are run, presses of a key one by one: those of a file, and those of the files that
/// it plays. The quickest take a tenth of a millisecond each.
pub const MOST: u32 = 100_000;

/// The keys that answer a question: yes and no.
pub const ANSWERS: [Key; 2] = [Key::plain(Code::Char('y')), Key::plain(Code::Char('n'))];

/// Characters that are escaped by a backslash in quoted text, and the letters after it.
pub(super) const ESCAPES: [(char, char); 5] =
    [('"', '"'), ('\\', '\\'), ('\n', 'n'), ('\r', 'r'), ('\t', 't')];

/// Why a text is no keystroke file, or why its replay ends early: the screen does not show an expected text, or there
/// are too many keys.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("line {line}, column {column}: {}", printable::line(.why))]
pub struct ScriptError {
    /// Line, from 1; of keys from another file, that of the step that plays them.
    pub line: usize,
    /// Column in characters, from 1.
    pub column: usize,
    /// What is wrong and what is allowed, in one line.
    pub why: String,
}

/// Why a file with more steps is not run.
pub(super) fn too_long() -> String {
    format!(
        "with what is played here there are more than {MOST} keys, the most that a file may press"
    )
}

/// One instruction of a keystroke file.
#[derive(Clone, Debug, PartialEq)]
pub enum Instruction {
    /// A key, pressed this many times: `x`, `<right>`, `<right*5>`.
    Key { key: Key, count: u32 },
    /// A message: the mouse, `<click 1 0.5 -0.25>` on the first plot, `<click row 2>`, and `<nearer ..>` and
    /// `<farther ..>` for its wheel; text pasted at once, `<paste "text">`; time that passes, in seconds, `<elapse 0.25>`;
    /// the size of the screen, `<resize 80x24>`; a line of the command line, independently of key bindings,
    /// `<run "set D=-0.3">`; a caption, for which the explorer waits for a key, `<say "text">`; a question, for which it
    /// waits for y or n, `<ask "text" y>`; the chapter of what follows, `<chapter "text">`; and the present state as the
    /// start of the session, with an empty history: `<start>`, or `<start D3 r>` with the parameters that are added to
    /// those of its scene.
    Give(Msg),
    /// Wait until no computation is pending: `<wait>`.
    Wait,
    /// From here on, do not wait after each key: `<async>`.
    Async,
    /// The screen must show this text on one of its rows: `<expect "text">`.
    Expect(String),
    /// A task, with a caption that stays until the screen shows a text; meanwhile keys have their usual effect. The line
    /// does what is asked, for who does not find it: `<until "Step to the fold." "fold" "walk-to-next">`.
    Until { task: String, shown: String, line: String },
    /// Keep a picture of the screen under this name: `<screen name>`.
    Screen(String),
    /// Embed a file: a command that reads a file of this name during the replay gets this text. `<file "a.toml"
    /// "text">`.
    File {
        /// The name by which the file is asked for.
        name: String,
        text: String,
    },
}

impl Instruction {
    /// The step that gives this message; `None` for a message that results from other steps.
    pub fn of(message: &Msg) -> Option<Self> {
        match message {
            Msg::Key(key) => Some(Instruction::Key { key: *key, count: 1 }),
            Msg::Paste(text) | Msg::Say(text, _) if text.is_empty() => None,
            Msg::Say(text, _) => Some(Give(Msg::Say(text.clone(), None))),
            // What can be written is a step.
            _ => Some(Give(message.clone())).filter(|step| step.written().is_some()),
        }
    }

    /// The word of its directive and what follows it; `None` for a key, and for what results from other steps.
    fn written(&self) -> Option<(&'static str, String)> {
        Some(match self {
            Instruction::Wait => ("wait", String::new()),
            Instruction::Async => ("async", String::new()),
            Instruction::Expect(text) => ("expect", quoted(text)),
            Instruction::Screen(name) => ("screen", name.clone()),
            Instruction::Until { task, shown, line } => {
                ("until", joined([task, shown, line].map(|text| quoted(text)), " "))
            }
            Instruction::File { name, text } => {
                ("file", format!("{} {}", quoted(name), quoted(text)))
            }
            Give(Msg::Pointed(MouseAction { gesture, place })) => {
                // Positions refer to the plots, not to the screen, so that a file has the same effect at every size.
                let place = match place {
                    PointerTarget::Row(row) => format!("row {row}"),
                    PointerTarget::Plot(index, Point { x, y }) => {
                        format!("{} {x:?} {y:?}", index + 1)
                    }
                };
                (gesture.into(), place)
            }
            Give(Msg::Paste(text)) => ("paste", quoted(text)),
            Give(Msg::Elapsed { seconds }) => ("elapse", seconds.to_string()),
            Give(Msg::Resize { width, height }) => ("resize", format!("{width}x{height}")),
            Give(Msg::Run(line)) => ("run", quoted(line)),
            Give(Msg::Say(text, _) | Msg::Ask { text, answer: None, .. }) => ("say", quoted(text)),
            Give(Msg::Ask { text, answer: Some(key), .. }) => {
                ("ask", format!("{} {key}", quoted(text)))
            }
            Give(Msg::Chapter(name)) => ("chapter", quoted(name)),
            Give(Msg::Start(names)) => ("start", joined(names, " ")),
            Instruction::Key { .. }
            | Give(
                Msg::Key(_) | Msg::Read { .. } | Msg::Answered(_) | Msg::Written(_) | Msg::Told(_),
            ) => {
                return None;
            }
        })
    }

    /// Number of times that it is done.
    pub(super) fn length(&self) -> u64 {
        if let Instruction::Key { count, .. } = self {
            u64::from(*count)
        } else {
            1
        }
    }
}

/// A step and its place in the file, counted from 1.
#[derive(Clone, Debug, PartialEq)]
pub struct ScriptStep {
    pub line: usize,
    pub column: usize,
    pub step: Instruction,
}

/// A parsed keystroke file.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Script {
    /// Its steps, in order.
    pub steps: Vec<ScriptStep>,
}

impl Script {
    /// A file of these steps.
    pub fn of(steps: Vec<Instruction>) -> Self {
        let located = (1..).zip(steps).map(|(column, step)| ScriptStep { line: 1, column, step });
        Script { steps: located.collect() }
    }

    /// Number of steps, presses of a key one by one.
    pub fn length(&self) -> u64 {
        self.steps.iter().map(|located| located.step.length()).sum()
    }

    /// Number of key presses.
    pub fn keys(&self) -> u64 {
        let keys = self.steps.iter().map(|located| &located.step);
        keys.filter(|step| matches!(step, Instruction::Key { .. })).map(Instruction::length).sum()
    }
}

/// Text that the parser can read back.
impl fmt::Display for Instruction {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Instruction::Key { key, count } = self {
            let key = key.to_string();
            let name = key.strip_prefix('<').and_then(|name| name.strip_suffix('>'));
            let name = name.unwrap_or(&key);
            return if *count == 1 {
                out.write_str(&key)
            } else {
                write!(out, "<{name}*{count}>")
            };
        }
        let (word, rest) = self.written().unwrap_or_default();
        let blank = if rest.is_empty() { "" } else { " " };
        write!(out, "<{word}{blank}{rest}>")
    }
}

/// Text in quotes on one line, with exactly the escapes that the parser knows.
fn quoted(text: &str) -> String {
    let mut quoted = String::from("\"");
    for char in text.chars() {
        match ESCAPES.iter().find(|(plain, _)| *plain == char) {
            Some((_, letter)) => quoted.extend(['\\', *letter]),
            None => quoted.push(char),
        }
    }
    quoted + "\""
}

/// Largest width and height that a file may ask for.
const LARGEST: u16 = 1000;

/// A directive in angle brackets, as opposed to a key.
struct Directive {
    /// Its first word.
    word: &'static str,
    /// What follows the word, with an example.
    takes: String,
    /// How that is read; `None` where it is something else.
    read: fn(&str) -> Option<Instruction>,
}

const NOTHING: &str = "nothing";
const TEXT: &str =
    "text in quotes, which may have \\\" \\\\ \\n \\r \\t, as in <expect \"captured\">";
const PLACE: &str = "\"N X Y\" on plot N, from 1, or \"row N\", as in <click 1 0.5 -0.25>";
const NAME: &str = "a name of letters, digits, \"-\", \"_\" and \".\", as in <screen a-1>";
const NUMBERS: &str = "some of D, D2, D3, r, q0, v0, or nothing, as in <start D3 r>";
const ASK: &str = "a question in quotes and y or n, as in <ask \"Does it rest?\" y>";
const UNTIL: &str = "a task, a text of the screen that it does not say itself and a line that does it, each in quotes, as in \
                     <until \"Let it rest.\" \"comes to rest\" \"set D=0.1\">";
const FILE: &str = "a name and a text, both in quotes, as in <file \"a.toml\" \"..\">";

static DIRECTIVES: LazyLock<[Directive; 17]> = LazyLock::new(|| {
    let directive = |word, takes: &str, read| Directive { word, takes: takes.to_owned(), read };
    let seconds = format!("seconds, 0 .. {LONGEST}, as in <elapse 0.25>");
    let cells = format!("columns and rows from 1 to {LARGEST}, as in <resize 80x24>");
    [
        directive("wait", NOTHING, |rest| rest.is_empty().then_some(Instruction::Wait)),
        directive("async", NOTHING, |rest| rest.is_empty().then_some(Instruction::Async)),
        directive("elapse", &seconds, elapse),
        directive("resize", &cells, resize),
        directive("expect", TEXT, |rest| text(rest).map(Instruction::Expect)),
        directive("paste", TEXT, |rest| text(rest).map(|it| Give(Msg::Paste(it)))),
        directive("run", TEXT, |rest| text(rest).map(|it| Give(Msg::Run(it)))),
        directive("say", TEXT, |rest| text(rest).map(|it| Give(Msg::Say(it, None)))),
        directive("ask", ASK, ask),
        directive("chapter", TEXT, |rest| text(rest).map(|it| Give(Msg::Chapter(it)))),
        directive("until", UNTIL, until),
        directive("screen", NAME, screen),
        directive("start", NUMBERS, start),
        directive("file", FILE, file),
        directive("click", PLACE, |rest| pointed(Gesture::Click, rest)),
        directive("nearer", PLACE, |rest| pointed(Gesture::Nearer, rest)),
        directive("farther", PLACE, |rest| pointed(Gesture::Farther, rest)),
    ]
});

/// Reads a whole keystroke file. Fails with [`ScriptError`], which has the place of the first mistake.
pub fn parse(text: &str) -> Result<Script, ScriptError> {
    let (mut steps, mut presses) = (Vec::new(), 0);
    for (index, line) in text.trim_start_matches('\u{feff}').lines().enumerate() {
        let mut rest = line;
        while let Some(first) = rest.chars().next() {
            let column = line[..line.len() - rest.len()].chars().count() + 1;
            let length = match first {
                '#' => break,
                '<' => length_of_name(rest),
                _ => first.len_utf8(),
            };
            let (token, after) = rest.split_at(length);
            rest = after;
            if first.is_ascii_whitespace() {
                continue;
            }
            let line = index + 1;
            let step = step(token).map_err(|why| ScriptError { line, column, why })?;
            presses += step.length();
            if presses > u64::from(MOST) {
                return Err(ScriptError { line, column, why: too_long() });
            }
            steps.push(ScriptStep { line, column, step });
        }
    }
    Ok(Script { steps })
}

/// Length in bytes up to and including the `>` that ends a name; a `>` in quotes does not count.
fn length_of_name(text: &str) -> usize {
    let (mut in_quotes, mut escaped) = (false, false);
    for (at, char) in text.char_indices().skip(1) {
        match char {
            _ if escaped => escaped = false,
            '\\' if in_quotes => escaped = true,
            // A quote begins a text only after the word that takes one; `<">` is a key.
            '"' if in_quotes || text[..at].ends_with(' ') => in_quotes = !in_quotes,
            '>' if !in_quotes => return at + 1,
            _ => {}
        }
    }
    text.len()
}

fn step(token: &str) -> Done<Instruction> {
    /// Longest part of a directive that is repeated where it is refused; it may hold a whole file.
    const REPEATED: usize = 60;
    if !token.starts_with('<') {
        let code = Code::Char(token.chars().next().unwrap_or(' '));
        return Ok(Instruction::Key { key: Key::plain(code), count: 1 });
    }
    let Some(name) = token[1..].strip_suffix('>') else {
        return Err("\"<\" without \">\" on its line; the character itself is <lt>".to_owned());
    };
    let (word, rest) = name.split_once(' ').unwrap_or((name, ""));
    let Some(Directive { takes, read, .. }) = DIRECTIVES.iter().find(|row| row.word == word) else {
        return keys(name);
    };
    read(rest.trim()).ok_or_else(|| {
        let end = name.char_indices().nth(REPEATED);
        let given = end.map_or(token.to_owned(), |(end, _)| format!("<{} ..", &name[..end]));
        format!("{given}: {word} takes {takes}")
    })
}

/// Seconds that pass: at most an hour.
fn elapse(text: &str) -> Option<Instruction> {
    let seconds = text.parse().ok().filter(|seconds| (0.0..=LONGEST).contains(seconds))?;
    Some(Give(Msg::Elapsed { seconds }))
}

/// A key with an optional count: `right`, `right*5`, `*`, `**5`.
fn keys(name: &str) -> Done<Instruction> {
    let counted = name.rsplit_once('*').filter(|(key, count)| {
        !key.is_empty() && !count.is_empty() && count.bytes().all(|byte| byte.is_ascii_digit())
    });
    let (name, digits) = counted.unwrap_or((name, "1"));
    let Ok(count @ 1..=MOST) = digits.parse() else {
        return Err(format!("a key is pressed 1 to {MOST} times, not {digits}"));
    };
    let key = Key::named(name).map_err(|why| nearest_directive(name).unwrap_or(why))?;
    Ok(Instruction::Key { key, count })
}

/// A suggestion if a misspelt directive is more likely than a misspelt key.
fn nearest_directive(name: &str) -> Option<String> {
    let word = name.split(' ').next().unwrap_or(name);
    let mut directives = DIRECTIVES.iter().map(|row| row.word);
    let nearest = most_similar(word, directives.clone().chain(key::names()))?;
    let told = || format!("unknown key <{name}>; did you mean <{nearest}>?");
    directives.any(|word| word == nearest).then(told)
}

/// The place that the mouse points at.
fn pointed(gesture: Gesture, rest: &str) -> Option<Instruction> {
    let words: Vec<&str> = rest.split_whitespace().collect();
    let finite = |word: &str| word.parse().ok().filter(|number: &f64| number.is_finite());
    let place = match words[..] {
        ["row", row] => PointerTarget::Row(row.parse().ok()?),
        [number, x, y] => {
            let index = number.parse::<usize>().ok()?.checked_sub(1)?;
            PointerTarget::Plot(index, Point { x: finite(x)?, y: finite(y)? })
        }
        _ => return None,
    };
    Some(Give(Msg::Pointed(MouseAction { gesture, place })))
}

fn resize(rest: &str) -> Option<Instruction> {
    let read = |text: &str| text.parse().ok().filter(|cells| (1..=LARGEST).contains(cells));
    let (width, height) = rest.split_once('x')?;
    Some(Give(Msg::Resize { width: read(width)?, height: read(height)? }))
}

fn screen(name: &str) -> Option<Instruction> {
    let allowed = |char: char| char.is_ascii_alphanumeric() || matches!(char, '-' | '_' | '.');
    let is_name = !name.is_empty() && name.chars().all(allowed) && !name.starts_with('.');
    is_name.then(|| Instruction::Screen(name.to_owned()))
}

fn start(rest: &str) -> Option<Instruction> {
    let named = |name: &str| Knob::named(name, &[Group::Motion]).ok();
    let names = rest.split_whitespace().map(named).collect::<Option<_>>()?;
    Some(Give(Msg::Start(names)))
}

/// A question in quotes and its answer.
fn ask(rest: &str) -> Option<Instruction> {
    let (text, rest) = leading(rest)?;
    let answer = rest.trim_start().parse().ok().filter(|key| ANSWERS.contains(key))?;
    (!text.is_empty()).then_some(Give(Msg::Ask { text, answer: Some(answer), place: None }))
}

/// A task, what the screen then shows, which the task does not say itself, and the line that does it, each in quotes.
fn until(rest: &str) -> Option<Instruction> {
    let (task, rest) = leading(rest)?;
    let (shown, rest) = leading(rest.trim_start())?;
    let line = text(rest.trim_start())?;
    (!(task.is_empty() || task.contains(&shown))).then_some(Instruction::Until {
        task,
        shown,
        line,
    })
}

/// A name and a text, both in quotes.
fn file(rest: &str) -> Option<Instruction> {
    let (name, rest) = leading(rest)?;
    let (text, rest) = leading(rest.trim_start())?;
    (!name.is_empty() && rest.is_empty()).then_some(Instruction::File { name, text })
}

/// A text in quotes that is not empty, with nothing after it.
fn text(rest: &str) -> Option<String> {
    leading(rest).filter(|(text, rest)| !text.is_empty() && rest.is_empty()).map(|(text, _)| text)
}

/// The text in quotes at the beginning, with the escapes of [`ESCAPES`] resolved, and the rest.
fn leading(rest: &str) -> Option<(String, &str)> {
    let mut chars = rest.strip_prefix('"')?.chars();
    let mut text = String::new();
    loop {
        text.push(match chars.next()? {
            '"' => return Some((text, chars.as_str())),
            '\\' => {
                let letter = chars.next()?;
                ESCAPES.iter().find(|(_, escape)| *escape == letter)?.0
            }
            char => char,
        });
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn steps(text: &str) -> Vec<Instruction> {
        let script = parse(text).unwrap_or_else(|error| panic!("{text}: {error}"));
        script.steps.into_iter().map(|located| located.step).collect()
    }

    #[test]
    fn a_refused_directive_is_repeated_as_far_as_it_is_short() {
        let refused = |text: &str| parse(text).unwrap_err().why;
        assert!(
            refused("<elapse 1 h>").starts_with("<elapse 1 h>: elapse takes seconds, 0 .. 3600")
        );
        assert!(refused("<resize 1001x24>").contains("rows from 1 to 1000, as in"));
        let long = format!("<expect {}>", "u".repeat(100));
        let shown = format!("<expect {} ..: expect takes text", "u".repeat(53));
        assert!(refused(&long).starts_with(&shown), "{}", refused(&long));
    }

    proptest! {
        #[test]
        fn what_is_printed_is_read_back(
            key in crate::session::key::tests::any_key(),
            count in 1..=MOST - 2, // A character stands on each side of it.
            quoted in any::<String>(),
        ) {
            for step in [Instruction::Key { key, count }, Instruction::Key { key, count: 1 }] {
                prop_assert_eq!(steps(&format!("x{step}x"))[1].clone(), step);
            }
            if !quoted.is_empty() {
                let paste = Give(Msg::Paste(quoted.clone()));
                for step in [Instruction::Expect(quoted), paste] {
                    prop_assert_eq!(steps(&format!("x{step}x"))[1].clone(), step);
                }
            }
        }
    }
}
