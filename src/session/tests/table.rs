//! The table of commands: names, keys, explanations.

use std::collections::{BTreeMap, BTreeSet};

use crate::scene::LAYERS;
use crate::session::keymap::Keymap;
use crate::session::state::context::chains;
use crate::session::{Command, Context, Key, commands};

/// Every default key with its context and command.
fn bindings() -> impl Iterator<Item = (Context, Key, &'static str)> {
    commands().flat_map(|command| {
        command.keys.iter().flat_map(move |(context, keys)| {
            keys.iter().map(move |text| {
                let key = text.parse().unwrap_or_else(|error| panic!("{text}: {error}"));
                (*context, key, command.name)
            })
        })
    })
}

#[test]
fn no_key_means_two_things_where_contexts_hold_together() {
    for chain in chains() {
        let mut meanings = BTreeMap::new();
        for (_, key, name) in bindings().filter(|(context, ..)| chain.contains(context)) {
            if let Some(other) = meanings.insert(key, name) {
                panic!("{key} means {other} and {name} in {chain:?}");
            }
        }
    }
}

#[test]
fn every_command_has_a_name_of_its_own_a_key_and_one_line_of_explanation() {
    let names: BTreeSet<_> = commands().map(|command| command.name).collect();
    assert_eq!(names.len(), commands().count());
    for Command { name, keys, doc, .. } in commands() {
        let of_layer = name.starts_with("toggle-");
        assert!(of_layer || keys.iter().any(|(_, keys)| !keys.is_empty()), "{name} has no key");
        assert!(doc.len() > 4 && doc.len() <= 72, "{name}: {doc}");
        assert!(doc.starts_with(char::is_uppercase) && !doc.ends_with('.'), "{name}: {doc}");
    }
}

#[test]
fn every_default_key_does_in_the_keymap_what_its_row_says() {
    let keymap = Keymap::default();
    for (context, key, name) in bindings() {
        assert_eq!(keymap.command(&[context], key).map(|command| command.name), Some(name));
    }
}

#[test]
fn every_layer_has_a_command() {
    for layer in &LAYERS {
        let name = format!("toggle-{}", layer.name);
        assert!(commands().any(|command| command.name == name), "{name}");
    }
}

#[test]
fn an_arrow_key_that_arrives_in_pieces_destroys_nothing() {
    // Over a slow line <up> can come as <esc>, [, A; application mode sends O in place of [.
    for (context, key, name) in bindings() {
        let piece = key.typed().is_some_and(|char| "OABCD".contains(char));
        assert!(!piece, "{name} is bound to {key} in {context:?}");
    }
    for (_, key, name) in bindings() {
        if key.typed() == Some('[') {
            assert_eq!(name, "step-size-smaller");
        }
        if key.to_string() == "<esc>" {
            assert!(
                ["back", "drop-cursor", "search-drop", "walk-let-go", "forget-pending"]
                    .contains(&name),
                "{name}"
            );
        }
    }
}
