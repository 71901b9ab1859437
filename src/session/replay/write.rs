//! Steps as text; the parser reads it back.

use super::mouse;
use super::parse::ESCAPES;
use super::script::Step;

impl std::fmt::Display for Step {
    fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Step::Key { key, count: 1 } => write!(out, "{key}"),
            Step::Key { key, count } => {
                let key = key.to_string();
                let name = key.strip_prefix('<').and_then(|name| name.strip_suffix('>'));
                write!(out, "<{}*{count}>", name.unwrap_or(&key))
            }
            Step::Pointed(pointed) => write!(out, "{}", mouse::text(pointed)),
            Step::Paste(text) => write!(out, "<paste {}>", quoted(text)),
            Step::Elapse(seconds) => write!(out, "<elapse {seconds}>"),
            Step::Wait => write!(out, "<wait>"),
            Step::Async => write!(out, "<async>"),
            Step::Resize { width, height } => write!(out, "<resize {width}x{height}>"),
            Step::Expect(text) => write!(out, "<expect {}>", quoted(text)),
            Step::Run(line) => write!(out, "<run {}>", quoted(line)),
            Step::Say(text) => write!(out, "<say {}>", quoted(text)),
            Step::Screen(name) => write!(out, "<screen {name}>"),
            Step::Start(names) => {
                write!(out, "<start")?;
                names.iter().try_for_each(|symbol| write!(out, " {}", symbol.spec().name))?;
                write!(out, ">")
            }
            Step::File { name, text } => write!(out, "<file {} {}>", quoted(name), quoted(text)),
        }
    }
}

/// Text in quotes on one line; the parser knows the same escapes and no others.
fn quoted(text: &str) -> String {
    let mut quoted = String::from("\"");
    for char in text.chars() {
        match ESCAPES.iter().find(|(plain, _)| *plain == char) {
            Some((_, letter)) => quoted.extend(['\\', *letter]),
            None => quoted.push(char),
        }
    }
    quoted.push('"');
    quoted
}
