//! Fast and slow typing: commands that need an answer wait for it, so that the same keys lead to the same end.

use std::collections::BTreeSet;

use proptest::prelude::*;

use super::recorded::assert_alike;
use super::strange::any_key;
use super::{Trial, answered};
use crate::flow::Reason;
use crate::question::NoAnswer;
use crate::scene::library;
use crate::session::replay::{Action, Player, parse};
use crate::session::{Command, Effect, Keymap, Msg, update};

/// Gives a message and answers only what it waits for; returns whether it waits.
fn hurry(trial: &mut Trial, message: Msg) -> bool {
    let effects = update(&mut trial.session, message);
    trial.effects.extend(effects);
    let waits = trial.session.waiting.is_some();
    for round in 0.. {
        let Some(waiting) = &trial.session.waiting else { break };
        assert!(round < 10, "waits again and again: {waiting:?}");
        let request = waiting.request.clone();
        assert!(trial.open_questions().contains(&request), "waits for what nobody answers");
        let answer = answered(request);
        let effects = update(&mut trial.session, answer);
        trial.effects.extend(effects);
    }
    waits
}

/// Presses keys without answering in between; returns those that waited.
fn type_ahead(trial: &mut Trial, keys: &str) -> Vec<String> {
    let mut player = Player::new(parse(keys).unwrap());
    let mut waited = Vec::new();
    while let Action::Give(message) = player.next(true, String::new).unwrap() {
        let before = trial.effects.len();
        if hurry(trial, message.clone()) {
            waited.push(format!("{message:?}"));
        }
        for effect in &trial.effects[before..] {
            if let Effect::Play(script) = effect {
                player.interject(script.clone()).unwrap();
            }
        }
    }
    waited
}

/// For each command that needs an answer, keys that ask something new and run the command at once.
const HASTY: [(&str, &str, &str); 26] = [
    ("start-inside", "supercritical", "<right>i"),
    // The first plot is a diagram with variants; the border is that of the present friction.
    ("start-inside", "fig16a", "<right>i"),
    ("start-outside", "supercritical", "<right>o"),
    ("start-outside", "supercritical", "<right>:start-outside<enter>"),
    ("start-inside", "supercritical", "<right><space>start-inside<enter>"),
    (
        "start-on-cycle",
        "supercritical",
        ":view<space>energy-ledger<enter><down*3>:set<space>r=0.2<enter><enter>",
    ),
    (
        "start-here",
        "supercritical",
        ":view<space>time-series<enter><right*9>:set<space>q0=2<enter><enter>",
    ),
    ("play-motion", "linear", "<right><f8>"),
    ("motion-on", "linear", "<right><f9*3>"),
    ("motion-back", "linear", "<f9*9><right><f7>"),
    ("use-method", "plain", ":view<space>trade<enter><left*30><enter>"),
    ("walk", "supercritical", ":set<space>r=0.2<enter>:walk<enter><right*2><enter>"),
    // The view that asked for the answer was replaced by one that does not.
    ("start-inside", "linear", "<left>;i"),
    // A key of a plot that is not in focus.
    ("walk", "supercritical", "<down*2><right>w<right*2><enter>"),
    ("walk-on", "supercritical", ":walk<enter>:set<space>r=0.2<enter><right>"),
    ("walk-take", "supercritical", ":walk<enter>:set<space>r=0.2<enter><tab><enter>"),
    ("walk-back", "supercritical", ":walk<enter>:set<space>r=0.2<enter><left>"),
    ("walk-to-last", "supercritical", ":set<space>r=0.2<enter>:walk<enter><end>"),
    ("walk-to-first", "supercritical", ":set<space>r=0.2<enter>:walk<enter><home>"),
    ("walk-to-previous", "supercritical", ":set<space>r=0.2<enter>:walk<enter><S-tab>"),
    ("walk-far-on", "supercritical", ":set<space>r=0.2<enter>:walk<enter><pgup>"),
    ("cursor-left", "supercritical", "<right><tab>0<left><up><enter>"),
    ("zoom-in", "supercritical", "<right><tab>0++"),
    ("pan-left", "supercritical", "<right><tab>0H"),
    ("next-ordinate", "supercritical", "<tab*2>XY"),
    ("retry", "linear", "<right><f5>"),
];

#[test]
fn whatever_needs_an_answer_leads_to_the_same_end_however_fast_it_is_typed() {
    for (command, scene, keys) in HASTY {
        let [mut slow, mut fast] = [(); 2].map(|()| Trial::open(scene));
        slow.press(keys);
        let waited = type_ahead(&mut fast, keys);
        assert!(!waited.is_empty(), "{command}: nothing in {keys} waited");
        fast.settle();
        assert_alike(&slow.session, &fast.session, keys);
    }
    let keymap = Keymap::default();
    let all = || keymap.commands().chain(keymap.lines());
    let tried = all().filter(|command| HASTY.iter().any(|(name, ..)| *name == command.name));
    let needs = |command: &'static Command| command.needs.split_whitespace();
    let tried: BTreeSet<&str> = tried.flat_map(needs).collect();
    assert_eq!(tried, all().flat_map(needs).collect(), "every need is tried");
}

#[test]
fn what_waits_is_forgotten_by_escape_as_if_it_had_not_been_pressed() {
    let mut trial = Trial::open("supercritical");
    update(&mut trial.session, Msg::Key("<right>".parse().unwrap()));
    let before = trial.session.clone();
    update(&mut trial.session, Msg::Key("i".parse().unwrap()));
    assert!(trial.session.waiting.is_some());
    update(&mut trial.session, Msg::Key("<esc>".parse().unwrap()));
    assert!(trial.session.waiting.is_none());
    assert_eq!(trial.session.problem, before.problem);
    trial.settle();
    assert_eq!(trial.session.problem, before.problem, "and it stays forgotten");
}

#[test]
fn what_waits_is_run_when_its_computation_gives_up_and_says_so() {
    for (keys, said) in [
        ("i", "the cycles are not known"),
        ("<tab*2>w", "the branch is not known"),
        ("<f8>", "no motion"),
    ] {
        let mut trial = Trial::open("supercritical");
        update(&mut trial.session, Msg::Run("set D=-0.3 r=0.2".to_owned()));
        let mut player = Player::new(parse(keys).unwrap());
        while let Action::Give(message) = player.next(true, String::new).unwrap() {
            update(&mut trial.session, message);
        }
        while let Some(waiting) = trial.session.waiting.clone() {
            let result = Err(NoAnswer::Reason(Reason::OutOfRange));
            update(&mut trial.session, Msg::answered(waiting.request, result, 0.0));
        }
        assert!(trial.notice().contains(said), "{keys}: {}", trial.notice());
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(96))]

    #[test]
    fn any_keys_lead_to_the_same_end_however_fast_they_are_typed(
        scene in 0..library().len(),
        keys in prop::collection::vec((any_key(), 0..4_usize), 0..50),
    ) {
        let scene = &library()[scene].name;
        let [mut slow, mut fast] = [(); 2].map(|()| Trial::open(scene));
        let mut pressed = String::new();
        for (key, answers) in keys {
            pressed += &key.to_string();
            // What a key plays is not: the tour expects texts on the screen.
            slow.give(Msg::Key(key));
            hurry(&mut fast, Msg::Key(key));
            // Some questions are answered before the next key.
            for request in fast.open_questions().into_iter().take(answers) {
                let answer = answered(request);
                update(&mut fast.session, answer);
            }
        }
        fast.settle();
        assert_alike(&slow.session, &fast.session, &pressed);
    }
}
