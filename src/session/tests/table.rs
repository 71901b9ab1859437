//! The table of commands: names, keys, explanations.

use std::collections::{BTreeMap, BTreeSet};

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
fn an_arrow_key_that_arrives_in_pieces_destroys_nothing() {
    // Over a slow line, <up> can arrive as <esc>, [, A; application mode sends O instead of [.
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

/// Commands with the same meaning in different panes: directions, and what is drawn along an axis.
const ALIKE: [&[&str]; 9] = [
    &["step-down", "walk-back", "scan-back", "cursor-left"],
    &["step-up", "walk-on", "scan-on", "cursor-right"],
    &["select-next", "walk-back", "scan-down", "cursor-down"],
    &["select-previous", "walk-on", "scan-up", "cursor-up"],
    &["step-far-down", "walk-far-back", "scan-far-back", "pan-left"],
    &["step-far-up", "walk-far-on", "scan-far-on", "pan-right"],
    &["next-abscissa", "next-chart-right"],
    &["next-ordinate", "next-chart-up", "scan-column"],
    &["walk", "walk-let-go"],
];

#[test]
fn no_letter_means_two_things_outside_of_lists_and_forms() {
    let mut meanings: BTreeMap<char, BTreeSet<&str>> = BTreeMap::new();
    for (context, key, name) in bindings() {
        let letter = key.typed().filter(char::is_ascii_alphabetic);
        if let Some(letter) = letter.filter(|_| !context.is_overlay()) {
            meanings.entry(letter).or_default().insert(name);
        }
    }
    assert!(meanings.len() > 30, "{meanings:?}");
    meanings.retain(|_, names| {
        names.len() > 1 && !ALIKE.iter().any(|alike| names.iter().all(|it| alike.contains(it)))
    });
    assert!(meanings.is_empty(), "{meanings:?}");
}
