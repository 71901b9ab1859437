//! How keys are named on the screen: arrows as arrows, other keys by name, without brackets.

use super::Look;
use crate::session::settings::Glyphs;
use crate::session::{Code, Key, Keymap};

pub fn name(key: Key, look: &Look) -> String {
    const ARROWS: [(Code, char); 4] =
        [(Code::Left, '←'), (Code::Right, '→'), (Code::Up, '↑'), (Code::Down, '↓')];
    let arrow = ARROWS.iter().find(|(code, _)| *code == key.code);
    if let (Some((_, arrow)), false) = (arrow, look.glyphs == Glyphs::Ascii) {
        let modifier = [(key.control, "C-"), (key.alt, "A-"), (key.shift, "S-")];
        let held: String =
            modifier.into_iter().filter_map(|(on, text)| on.then_some(text)).collect();
        return format!("{held}{arrow}");
    }
    key.said()
}

/// Several keys, side by side; single characters need no space between them.
pub fn names(keys: impl IntoIterator<Item = Key>, look: &Look) -> String {
    let names: Vec<String> = keys.into_iter().map(|key| name(key, look)).collect();
    let short = names.iter().all(|name| name.chars().count() == 1);
    names.join(if short { "" } else { " " })
}

/// A sentence of a scene, with the keys that the user has in place of the commands that it names.
pub fn sentence(text: &str, keymap: &Keymap, look: &Look) -> String {
    keymap.fill(text, |key| name(key, look))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::session::settings;

    #[test]
    fn keys_have_short_names() {
        let rich = Look::new(settings::DisplaySettings::default());
        let letters = Look::new(settings::DisplaySettings {
            glyphs: Glyphs::Ascii,
            ..settings::DisplaySettings::default()
        });
        let cases = [
            ("<left>", "←", "left"),
            ("<S-up>", "S-↑", "S-up"),
            ("<enter>", "enter", "enter"),
            ("<space>", "space", "space"),
            ("<lt>", "<", "<"),
            ("<C-r>", "C-r", "C-r"),
            ("<f6>", "F6", "F6"),
            ("<S-f6>", "S-F6", "S-F6"),
            ("?", "?", "?"),
        ];
        for (written, drawn, plain) in cases {
            let key: Key = written.parse().unwrap();
            assert_eq!((name(key, &rich).as_str(), name(key, &letters).as_str()), (drawn, plain));
        }
    }
}
