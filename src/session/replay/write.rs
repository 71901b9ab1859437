//! Writes steps as text that the parser can read back.

use super::mouse;
use super::parse::ESCAPES;
use super::script::Instruction;

impl std::fmt::Display for Instruction {
    fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Instruction::Key { key, count: 1 } => write!(out, "{key}"),
            Instruction::Key { key, count } => {
                let key = key.to_string();
                let name = key.strip_prefix('<').and_then(|name| name.strip_suffix('>'));
                write!(out, "<{}*{count}>", name.unwrap_or(&key))
            }
            Instruction::Pointed(pointed) => write!(out, "{}", mouse::text(pointed)),
            Instruction::Paste(text) => write!(out, "<paste {}>", quoted(text)),
            Instruction::Elapse(seconds) => write!(out, "<elapse {seconds}>"),
            Instruction::Wait => write!(out, "<wait>"),
            Instruction::Async => write!(out, "<async>"),
            Instruction::Resize { width, height } => write!(out, "<resize {width}x{height}>"),
            Instruction::Expect(text) => write!(out, "<expect {}>", quoted(text)),
            Instruction::Run(line) => write!(out, "<run {}>", quoted(line)),
            Instruction::Say(text) => write!(out, "<say {}>", quoted(text)),
            Instruction::Screen(name) => write!(out, "<screen {name}>"),
            Instruction::Start(names) => {
                write!(out, "<start")?;
                names.iter().try_for_each(|symbol| write!(out, " {}", symbol.spec().name))?;
                write!(out, ">")
            }
            Instruction::File { name, text } => {
                write!(out, "<file {} {}>", quoted(name), quoted(text))
            }
        }
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
    quoted.push('"');
    quoted
}
