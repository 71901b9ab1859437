//! The settings file: the appearance of the screen, and the keys of commands.
//!
//! Keys are given by context and command, and replace the default keys of that command there:
//!
//! ```toml
//! theme = "light"
//!
//! [keys.parameters]
//! step-up = ["<right>", "l", "+"]
//! ```

use std::collections::BTreeMap;

use serde::de::Error;
use serde::{Deserialize, Deserializer};
use toml::Spanned;

use crate::numerics::most_similar;
use crate::scene::mistake::Complaint;
use crate::scene::{FileMistake, find, placed};
use crate::session::{
    CONTEXTS, Colors, Command, Context, Glyphs, Key, Keymap, NamedValue, Theme, full_name, named,
};
use crate::words::joined;

/// The content of a settings file; whatever is missing keeps its default.
#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Config {
    /// The scene to open unless another is named.
    #[serde(deserialize_with = "scene")]
    pub scene: Option<String>,
    /// The characters that form the dots of plots.
    #[serde(deserialize_with = "by_name")]
    pub glyphs: Option<Glyphs>,
    /// Colour depth.
    #[serde(rename = "color", deserialize_with = "by_name")]
    pub colors: Option<Colors>,
    #[serde(deserialize_with = "by_name")]
    pub theme: Option<Theme>,
    /// Whether the terminal reports the mouse.
    pub mouse: bool,
    /// Whether the screen is read by a class.
    pub lecture: bool,
    /// The keys that differ from those by default, by context, until [`Config::keymap`] is made of them.
    keys: BTreeMap<Spanned<String>, Keys>,
    /// The keys of all commands.
    #[serde(skip)]
    pub keymap: Keymap,
}

/// A command's keys as given in a file.
type Given<'a> = (Context, &'static Command, &'a Spanned<Vec<Spanned<String>>>);

/// The keys of commands, by command name.
type Keys = BTreeMap<Spanned<String>, Spanned<Vec<Spanned<String>>>>;

/// Commands that must have a key, because there is no other way out.
const INDISPENSABLE: [&str; 2] = ["quit", "back"];

/// Contexts of former versions: files that still have keys for them are read as if they had none there.
const FORMER_CONTEXTS: [&str; 1] = ["form"];

/// Reads a settings file; `file` is its name in error messages. Fails with [`FileMistake`], which names the place
/// of the first mistake and what is allowed there.
pub fn parse(file: &str, text: &str) -> Result<Config, FileMistake> {
    let mut config: Config = placed::toml(file, text)?;
    let keymap = keymap(&std::mem::take(&mut config.keys));
    config.keymap = keymap.map_err(|complaint| complaint.in_file(file, text))?;
    Ok(config)
}

/// Reads the name of a scene.
fn scene<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<String>, D::Error> {
    let name = String::deserialize(deserializer)?;
    find(&name).map(|_| Some(name)).map_err(D::Error::custom)
}

/// Reads a value by its name.
fn by_name<'de, D: Deserializer<'de>, T: NamedValue>(
    deserializer: D,
) -> Result<Option<T>, D::Error> {
    let name = String::deserialize(deserializer)?;
    named(&name).map(Some).map_err(D::Error::custom)
}

/// A complaint about an unknown name, with the most similar known one.
fn unknown<'a>(
    given: &Spanned<String>,
    what: &str,
    names: impl Iterator<Item = &'a str>,
) -> Complaint {
    let name = given.get_ref();
    let nearest = most_similar(name, names);
    let nearest = nearest.map_or(String::new(), |name| format!("; did you mean {name}?"));
    Complaint { at: given.span(), message: format!("no {what} {name:?}{nearest}") }
}

/// The default keys, changed as the file says. All replaced keys are removed before new ones are added, so that
/// two commands can swap theirs.
fn keymap(read: &BTreeMap<Spanned<String>, Keys>) -> Result<Keymap, Complaint> {
    let mut keymap = Keymap::default();
    let mut given: Vec<Given> = Vec::new();
    let former = |context: &Spanned<String>| FORMER_CONTEXTS.contains(&context.get_ref().as_str());
    for (context, commands) in read.iter().filter(|(context, _)| !former(context)) {
        let names = CONTEXTS.iter().map(|row| row.name);
        let known = Context::named(context.get_ref());
        let known = known.ok_or_else(|| unknown(context, "context", names))?;
        for (name, keys) in commands {
            let names = keymap.commands().map(|row| row.name);
            let found = keymap.named(full_name(name.get_ref()));
            let found = found.ok_or_else(|| unknown(name, "command", names))?;
            if !found.contexts().any(|context| context == known) {
                let places = joined(found.contexts().map(|context| context.spec().name), ", ");
                let message = format!("{} applies in {places}", found.name);
                return Err(Complaint { at: name.span(), message });
            }
            given.push((known, found, keys));
            if known == Context::Everywhere && follows(read, found) {
                given.push((Context::Walk, found, keys));
            }
        }
    }
    for (context, command, _) in &given {
        keymap.unbind(*context, command);
    }
    for (context, command, keys) in given {
        for text in keys.get_ref() {
            let complain = |message: String| Complaint { at: text.span(), message };
            let key: Key = text.get_ref().parse().map_err(complain)?;
            keymap.bind(context, command, key).map_err(complain)?;
        }
        if INDISPENSABLE.contains(&command.name)
            && keymap.keys_in(context, command).next().is_none()
        {
            let message = format!("{} needs a key here: there is no other way out", command.name);
            return Err(Complaint { at: keys.span(), message });
        }
    }
    Ok(keymap)
}

/// Whether a command's keys for `everywhere` also hold on a walk: by default, both are the same, and the file
/// gives no keys for the walk.
fn follows(read: &BTreeMap<Spanned<String>, Keys>, command: &Command) -> bool {
    let own = |at| command.keys.iter().find(|(context, _)| *context == at).map(|(_, keys)| keys);
    let everywhere = own(Context::Everywhere);
    let alike = everywhere.is_some() && everywhere == own(Context::Walk);
    let walk = read.iter().filter(|(context, _)| context.get_ref() == Context::Walk.spec().name);
    let said = walk.flat_map(|(_, commands)| commands.keys());
    alike && said.map(Spanned::get_ref).all(|name| name != command.name)
}
