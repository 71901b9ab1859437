//! Keys, and their notation in keystroke files, in the key table and in the help.
//!
//! A character stands for itself. Other keys are named in angle brackets, with optional modifiers: `a`, `Z`,
//! `?`, `<space>`, `<lt>`, `<hash>`, `<C-r>`, `<S-tab>`, `<A-left>`, `<f1>`, `<pgup>`, `<esc>`. Every printed
//! key can be read back.

use std::fmt;
use std::str::FromStr;

use crate::numerics::most_similar;
use crate::words::printable::is_printable;

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Code {
    /// A printable character, as typed (shift already applied).
    Char(char),
    /// Function key 1 to 12.
    F(u8),
    Left,
    Right,
    Up,
    Down,
    Enter,
    Esc,
    /// Tab (with shift: back tab).
    Tab,
    Backspace,
    Delete,
    Insert,
    Home,
    End,
    PageUp,
    PageDown,
}

/// A key with its modifiers. Shift is recorded only for keys that are not characters.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Key {
    pub code: Code,
    pub control: bool,
    pub alt: bool,
    /// With Shift, for keys that are not characters.
    pub shift: bool,
}

/// Keys with a name, and alternative names that are also read.
const NAMES: [(Code, &str, &[&str]); 18] = [
    (Code::Left, "left", &[]),
    (Code::Right, "right", &[]),
    (Code::Up, "up", &[]),
    (Code::Down, "down", &[]),
    (Code::Enter, "enter", &["cr", "ret", "return"]),
    (Code::Esc, "esc", &["escape"]),
    (Code::Tab, "tab", &[]),
    (Code::Backspace, "backspace", &["bs"]),
    (Code::Delete, "del", &["delete"]),
    (Code::Insert, "ins", &["insert"]),
    (Code::Home, "home", &[]),
    (Code::End, "end", &[]),
    (Code::PageUp, "pgup", &["pageup"]),
    (Code::PageDown, "pgdn", &["pagedown", "pgdown"]),
    (Code::Char(' '), "space", &[]),
    // Characters with a special meaning in keystroke files.
    (Code::Char('<'), "lt", &[]),
    (Code::Char('>'), "gt", &[]),
    (Code::Char('#'), "hash", &[]),
];

/// Number of the last function key; the first one is 1.
const LAST_F: u8 = 12;

impl Key {
    /// A key without modifiers.
    pub const fn plain(code: Code) -> Self {
        Key { code, control: false, alt: false, shift: false }
    }

    /// A key as terminals report it: shift is part of a character, and Control ignores the character's case.
    pub fn new(code: Code, control: bool, alt: bool, shift: bool) -> Self {
        match code {
            Code::Char(char) => {
                let char = if control { char.to_ascii_lowercase() } else { char };
                Key { code: Code::Char(char), control, alt, shift: false }
            }
            code => Key { code, control, alt, shift },
        }
    }

    pub fn typed(self) -> Option<char> {
        match self.code {
            Code::Char(char) if !self.control && !self.alt && !char.is_control() => Some(char),
            _ => None,
        }
    }

    /// The key as the screen names it: a character as it is, any other key by the name on keyboards.
    pub fn said(self) -> String {
        if let Some(typed) = self.typed().filter(|typed| *typed != ' ') {
            return typed.to_string();
        }
        let written = self.to_string();
        let name = written.trim_start_matches('<').trim_end_matches('>');
        if let Code::F(_) = self.code {
            name.replace('f', "F")
        } else {
            name.to_owned()
        }
    }

    /// Reads the text between angle brackets. Fails with one line, which has the most similar name.
    pub fn named(text: &str) -> Result<Self, String> {
        let (mut control, mut alt, mut shift) = (false, false, false);
        let mut rest = text;
        while let Some((modifier, after)) = rest.split_at_checked(2).filter(|(_, r)| !r.is_empty())
        {
            match modifier {
                "C-" | "c-" => control = true,
                "A-" | "a-" => alt = true,
                "S-" | "s-" => shift = true,
                _ => break,
            }
            rest = after;
        }
        let refused = || unknown(text, most_similar(rest, names()));
        let code = code_named(rest).ok_or_else(refused)?;
        Ok(Key::new(code, control, alt, shift))
    }
}

/// One line about a text, without its angle brackets, that names no key.
fn unknown(text: &str, nearest: Option<&str>) -> String {
    let meant = nearest.map(|name| format!("did you mean <{name}>?"));
    let form = || "a key is a character or a name such as <esc>, <C-r> or <S-tab>".to_owned();
    format!("unknown key <{text}>; {}", meant.unwrap_or_else(form))
}

fn code_named(name: &str) -> Option<Code> {
    if let Ok(char) = name.parse::<char>() {
        return (!char.is_whitespace() && !char.is_control()).then_some(Code::Char(char));
    }
    let lower = name.to_ascii_lowercase();
    let has = |names: &[&str]| names.contains(&lower.as_str());
    let named = NAMES.iter().find(|(_, name, others)| *name == lower || has(others));
    let function = || lower.strip_prefix('f')?.parse().ok().filter(|it| (1..=LAST_F).contains(it));
    // Any character by its code point, as in `u+1b`.
    let point = || char::from_u32(u32::from_str_radix(lower.strip_prefix("u+")?, 16).ok()?);
    let named = named.map(|(code, ..)| *code).or_else(|| function().map(Code::F));
    named.or_else(|| point().map(Code::Char))
}

/// The names of all keys that are not characters.
pub fn names() -> impl Iterator<Item = &'static str> {
    NAMES.iter().map(|(_, name, _)| *name)
}

impl fmt::Display for Code {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some((_, name, _)) = NAMES.iter().find(|(code, ..)| code == self) {
            return out.write_str(name);
        }
        match *self {
            Code::F(number) => write!(out, "f{number}"),
            // Nobody sees it in a file, and at its beginning a byte order mark is not read as a key.
            Code::Char(char) if !is_printable(char) || char.is_whitespace() => {
                write!(out, "u+{:x}", u32::from(char))
            }
            Code::Char(char) => write!(out, "{char}"),
            _ => Ok(()), // Every other key is in `NAMES`.
        }
    }
}

impl fmt::Display for Key {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let code = self.code.to_string();
        let modifiers = [(self.control, "C-"), (self.alt, "A-"), (self.shift, "S-")];
        let modifiers: String =
            modifiers.into_iter().filter_map(|(on, prefix)| on.then_some(prefix)).collect();
        if modifiers.is_empty() && code.chars().count() == 1 {
            return out.write_str(&code);
        }
        write!(out, "<{modifiers}{code}>")
    }
}

impl FromStr for Key {
    type Err = String;

    /// Reads one key, with its angle brackets if it has a name.
    fn from_str(text: &str) -> Result<Self, String> {
        match text.parse() {
            Ok(char) if !matches!(char, '<' | '#') && !char.is_whitespace() => {
                Ok(Key::plain(Code::Char(char)))
            }
            _ => match text.strip_prefix('<').and_then(|rest| rest.strip_suffix('>')) {
                Some(name) => Key::named(name),
                None => Err(unknown(text, None)),
            },
        }
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use proptest::prelude::*;

    use super::*;

    /// Any key that a terminal can send.
    pub fn any_key() -> impl Strategy<Value = Key> {
        let named = prop::sample::select(NAMES.iter().map(|row| row.0).collect::<Vec<_>>());
        let code = prop_oneof![
            named,
            (1..=LAST_F).prop_map(Code::F),
            any::<char>().prop_map(Code::Char),
            prop::char::range(' ', '~').prop_map(Code::Char),
        ];
        (code, any::<bool>(), any::<bool>(), any::<bool>())
            .prop_map(|(code, control, alt, shift)| Key::new(code, control, alt, shift))
    }
}
