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

use serde::Deserialize;
use toml::Spanned;

use crate::numerics::similar::most_similar;
use crate::scene::library::names;
use crate::scene::misread::Complaint;
use crate::scene::{Misread, misread};
use crate::session::settings::{Colors, Glyphs, NamedValue, Theme, choices};
use crate::session::state::keymap::contexts;
use crate::session::state::keymap::full_name;
use crate::session::{Command, Context, Key, Keymap};
use crate::words;

/// The content of a settings file; whatever is missing keeps its default.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Config {
    /// The scene to open unless another is named.
    pub scene: Option<String>,
    /// The characters that form the dots of plots.
    pub glyphs: Option<Glyphs>,
    /// Colour depth.
    pub colors: Option<Colors>,
    pub theme: Option<Theme>,
    /// Whether the terminal reports the mouse.
    pub mouse: bool,
    /// The keys of all commands.
    pub keymap: Keymap,
}

/// A command's keys as given in a file.
type Given<'a> = (Context, &'static Command, &'a Spanned<Vec<Spanned<String>>>);

/// The keys of commands, by command name.
type Keys = BTreeMap<Spanned<String>, Spanned<Vec<Spanned<String>>>>;

/// The file as it is written.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct SettingsFile {
    scene: Option<Spanned<String>>,
    glyphs: Option<Spanned<String>>,
    color: Option<Spanned<String>>,
    theme: Option<Spanned<String>>,
    #[serde(default)]
    mouse: bool,
    #[serde(default)]
    keys: BTreeMap<Spanned<String>, Keys>,
}

/// Commands that must have a key, because there is no other way out.
const INDISPENSABLE: [&str; 2] = ["quit", "back"];

/// Contexts of former versions: files that still have keys for them are read as if they had none there.
const FORMER_CONTEXTS: [&str; 1] = ["form"];

/// Reads a settings file; `file` is its name in error messages. Fails with [`Misread`], which names the place
/// of the first mistake and what is allowed there.
pub fn parse(file: &str, text: &str) -> Result<Config, Misread> {
    let read: SettingsFile = misread::toml(file, text)?;
    config(&read).map_err(|complaint| complaint.in_file(file, text))
}

fn config(read: &SettingsFile) -> Result<Config, Complaint> {
    let scene = read.scene.as_ref().map(|given| {
        let known = names().find(|name| name == given.get_ref());
        known.map(str::to_owned).ok_or_else(|| unknown(given, "scene", names()))
    });
    Ok(Config {
        scene: scene.transpose()?,
        glyphs: one_of(read.glyphs.as_ref())?,
        colors: one_of(read.color.as_ref())?,
        theme: one_of(read.theme.as_ref())?,
        mouse: read.mouse,
        keymap: keymap(&read.keys)?,
    })
}

/// The value with this name.
fn one_of<T: NamedValue>(given: Option<&Spanned<String>>) -> Result<Option<T>, Complaint> {
    let find = |given: &Spanned<String>| {
        let refused = |message| Complaint { at: given.span(), message };
        words::one_of("", given.get_ref(), choices()).map_err(refused)
    };
    given.map(find).transpose()
}

/// A complaint about an unknown name, with the most similar known one.
fn unknown<'a>(
    given: &Spanned<String>,
    what: &str,
    names: impl Iterator<Item = &'a str>,
) -> Complaint {
    let nearest = most_similar(given.get_ref(), names);
    let nearest = nearest.map_or(String::new(), |name| format!("; did you mean {name}?"));
    Complaint { at: given.span(), message: format!("no {what} {:?}{nearest}", given.get_ref()) }
}

/// The default keys, changed as the file says. All replaced keys are removed before new ones are added, so that
/// two commands can swap theirs.
fn keymap(read: &BTreeMap<Spanned<String>, Keys>) -> Result<Keymap, Complaint> {
    let mut keymap = Keymap::default();
    let mut given: Vec<Given> = Vec::new();
    let former = |context: &Spanned<String>| FORMER_CONTEXTS.contains(&context.get_ref().as_str());
    for (context, commands) in read.iter().filter(|(context, _)| !former(context)) {
        let names = || contexts().map(|row| row.name);
        let known = contexts()
            .find(|row| row.name == context.get_ref())
            .map(|row| row.context)
            .ok_or_else(|| unknown(context, "context", names()))?;
        for (name, keys) in commands {
            let found = keymap
                .named(full_name(name.get_ref()))
                .ok_or_else(|| unknown(name, "command", keymap.commands().map(|row| row.name)))?;
            if !found.keys.iter().any(|(context, _)| *context == known) {
                let places: Vec<_> =
                    found.keys.iter().map(|(context, _)| context.spec().name).collect();
                let message = format!("{} applies in {}", found.name, places.join(", "));
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
    let own = |at: Context| command.keys.iter().find(|(context, _)| *context == at);
    let alike = match (own(Context::Everywhere), own(Context::Walk)) {
        (Some((_, everywhere)), Some((_, walk))) => everywhere == walk,
        _ => false,
    };
    let walk = read.iter().filter(|(context, _)| context.get_ref() == Context::Walk.spec().name);
    let said = walk.flat_map(|(_, commands)| commands.keys());
    alike && said.into_iter().all(|name| name.get_ref() != command.name)
}
