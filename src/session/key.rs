//! Keys, and the notation in which keystroke files, the key table and the help write them.
//!
//! A character stands for itself; the others are named in angle brackets with optional modifiers:
//! `a`, `Z`, `?`, `<space>`, `<lt>`, `<C-r>`, `<S-tab>`, `<A-left>`, `<f1>`, `<pgup>`, `<esc>`.

/// Which key.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Code {
    /// A printable character, as typed (shift is already in it).
    Char(char),
    /// Function key 1 to 12.
    F(u8),
    /// Arrow.
    Left,
    /// Arrow.
    Right,
    /// Arrow.
    Up,
    /// Arrow.
    Down,
    /// Enter.
    Enter,
    /// Escape.
    Esc,
    /// Tab (with shift: back tab).
    Tab,
    /// Backspace.
    Backspace,
    /// Delete.
    Delete,
    /// Insert.
    Insert,
    /// Home.
    Home,
    /// End.
    End,
    /// Page up.
    PageUp,
    /// Page down.
    PageDown,
}

/// A key with its modifiers. Shift is only recorded for keys that are not characters.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Key {
    /// Which key.
    pub code: Code,
    /// With Control.
    pub control: bool,
    /// With Alt.
    pub alt: bool,
    /// With Shift, for keys that are not characters.
    pub shift: bool,
}
