//! Keystroke files: how they are read, written and played; and every one of the project plays to its end, on a small
//! and on a large screen.

use hopfscope::flow::Limits;
use hopfscope::runtime::{Options, play};
use hopfscope::scene::plain;
use hopfscope::session::replay::{Action, Player, Recorder, parse, text};
use hopfscope::session::{Instruction, LESSONS, Msg, Notice, Script, Session, Size};
use hopfscope::terminal::Environment;

/// Name and text of every file in `assets/replays`.
fn files() -> Vec<(String, String)> {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/assets/replays");
    let read = |entry: std::io::Result<std::fs::DirEntry>| {
        let path = entry.unwrap().path();
        (path.display().to_string(), std::fs::read_to_string(path).unwrap())
    };
    std::fs::read_dir(folder).unwrap().map(read).collect()
}

/// The same script, with a picture of the screen when a task has been told.
fn before_tasks(script: &Script) -> Script {
    let mut script = script.clone();
    for mut located in std::mem::take(&mut script.steps) {
        if let Instruction::Until { task, .. } = &located.step {
            let told = Msg::Ask { text: task.clone(), answer: None, place: None };
            let until = located.step.clone();
            for step in [Instruction::Give(told), Instruction::Screen("task".to_owned())] {
                located.step = step;
                script.steps.push(located.clone());
            }
            located.step = until;
        }
        script.steps.push(located);
    }
    script
}

#[test]
fn every_lesson_holds_what_it_says_at_every_size_and_in_a_lecture() {
    for (name, text) in LESSONS {
        let script = parse(text).unwrap_or_else(|error| panic!("{name}: {error}"));
        let count = |word: &str| text.matches(word).count();
        assert!(count("<ask ") + count("<until ") >= 3, "{name} asks before it shows");
        assert!(count("<chapter ") >= 2 && text.starts_with("# Lesson: "), "{name}");
        let sizes = [((60, 16), false), ((80, 24), false), ((80, 24), true), ((200, 60), false)];
        for ((width, height), lecture) in sizes {
            let mut session = Session::new(plain(), Size { width, height });
            session.display.lecture = lecture;
            let played = play(
                session,
                Environment::of(|_| None),
                Options { replay: Some(before_tasks(&script)), ..Options::default() },
                &Limits::PATIENT,
            );
            let place = format!("{name} at {width}x{height}, lecture: {lecture}");
            assert_eq!(played.unmet, None, "{place}");
            let tasks = script.steps.iter().filter_map(|located| match &located.step {
                Instruction::Until { shown, .. } => Some(shown),
                _ => None,
            });
            let mut kept = played.kept.iter();
            for shown in tasks {
                let screen = kept.next().map(|(_, screen)| hopfscope::view::screen::text(screen));
                let screen = screen.expect("a screen of each task");
                assert!(!screen.contains(shown), "{place}: nothing is left to do\n{screen}");
            }
        }
    }
}

#[test]
fn while_a_question_is_open_nothing_tells_its_answer() {
    let text = "<run \"scene supercritical\"> <ask \"Does it come to rest?\" n> <screen asked>";
    for lecture in [false, true] {
        let mut session = Session::new(plain(), Size { width: 120, height: 40 });
        session.display.lecture = lecture;
        let played = play(
            session,
            Environment::of(|_| None),
            Options { replay: Some(parse(text).unwrap()), ..Options::default() },
            &Limits::PATIENT,
        );
        let screen = hopfscope::view::screen::text(&played.kept[0].1);
        assert!(screen.contains("what becomes of it?"), "{screen}");
        for telling in [
            "onto the stable cycle",
            "(outside",
            "margin from rest",
            "margin 0",
            "Two cycles",
            "border: ",
        ] {
            assert!(!screen.contains(telling), "{telling}\n{screen}");
        }
    }
}

#[test]
fn every_file_meets_its_expectations() {
    assert!(!files().is_empty());
    for (name, text) in files() {
        let script = parse(&text).unwrap_or_else(|error| panic!("{name}: {error}"));
        for (width, height) in [(80, 24), (200, 60)] {
            let session = Session::new(plain(), Size { width, height });
            let played = play(
                session,
                Environment::of(|_| None),
                Options { replay: Some(script.clone()), ..Options::default() },
                &Limits::PATIENT,
            );
            if let Some(unmet) = played.unmet {
                panic!("{name} at {width}x{height}: {unmet}");
            }
            let left = played.application.session.quit;
            assert!(left || name.ends_with("tour.keys"), "{name} leaves by its last key");
        }
    }
}

#[test]
fn every_keystroke_file_of_the_handbook_plays() {
    let page = include_str!("../../docs/explorer.md");
    let blocks: Vec<&str> =
        page.split("```keys\n").skip(1).filter_map(|rest| rest.split("```").next()).collect();
    assert!(!blocks.is_empty());
    for text in blocks {
        let script = parse(text).unwrap_or_else(|error| panic!("docs/explorer.md: {error}"));
        let session = Session::new(plain(), Size { width: 120, height: 40 });
        let played = play(
            session,
            Environment::of(|_| None),
            Options { replay: Some(script), ..Options::default() },
            &Limits::PATIENT,
        );
        assert_eq!(played.unmet, None);
    }
}

/// What a newcomer reads: a screen along the way and words on it, at every size.
const READ: [(&str, &[&str]); 8] = [
    ("opened", &["parameters", "phase plane", "grows without bound", "q quit"]),
    ("captured", &["comes to rest at q = ", "margin from rest: shift "]),
    ("scenes", &["Lessons", "supercritical fig16b"]),
    ("supercritical", &["onto the stable cycle, q_max 1.158", "margin from rest: shift 0.1247"]),
    ("beyond-the-fold", &["comes to rest", "every kick is survived"]),
    ("inside", &["comes to rest at q = ", "(inside the unstable cycle)"]),
    ("outside", &["grows onto the stable cycle", "(outside the unstable cycle)"]),
    ("help-undo", &["undo"]),
];

#[test]
fn a_newcomer_reads_a_verdict_on_every_screen_of_every_size() {
    let script = parse(include_str!("../../assets/replays/newcomer.keys")).unwrap();
    for (width, height) in [(80, 24), (120, 40), (200, 60)] {
        let session = Session::new(plain(), Size { width, height });
        let played = play(
            session,
            Environment::of(|_| None),
            Options { replay: Some(script.clone()), ..Options::default() },
            &Limits::PATIENT,
        );
        assert_eq!(played.unmet, None, "{width}x{height}");
        for (name, words) in READ {
            let kept = played.kept.iter().find(|(kept, _)| kept == name);
            let (_, screen) = kept.unwrap_or_else(|| panic!("{name} is kept"));
            let screen = hopfscope::view::screen::text(screen);
            for word in words {
                assert!(screen.contains(word), "{name} at {width}x{height}: {word}\n{screen}");
            }
        }
    }
}

/// The steps of a keystroke file.
fn steps(text: &str) -> Vec<Instruction> {
    let script = parse(text).unwrap_or_else(|error| panic!("{text}: {error}"));
    script.steps.into_iter().map(|located| located.step).collect()
}

/// A key that is pressed this many times.
fn key(text: &str, count: u32) -> Instruction {
    Instruction::Key { key: text.parse().unwrap(), count }
}

#[test]
fn every_instruction_of_the_contract_is_read() {
    let text = "# a comment\n<right*5> <wait>\n[ ] j k   one # and a comment\n<space><lt>\
                <C-r><S-tab> <f1> <pgup>\n<resize 80x24><expect \"captured\">\n\
                <screen after-five-steps>\n<async>";
    let mut wanted = vec![key("<right>", 5), Instruction::Wait];
    wanted.extend("[]jkone".chars().map(|char| key(&char.to_string(), 1)));
    for name in ["<space>", "<lt>", "<C-r>", "<S-tab>", "<f1>", "<pgup>"] {
        wanted.push(key(name, 1));
    }
    wanted.push(Instruction::Give(Msg::Resize { width: 80, height: 24 }));
    wanted.push(Instruction::Expect("captured".to_owned()));
    wanted.push(Instruction::Screen("after-five-steps".to_owned()));
    wanted.push(Instruction::Async);
    assert_eq!(steps(text), wanted);
}

#[test]
fn brackets_and_quotes_may_be_keys_and_text() {
    assert_eq!(steps(">"), [key(">", 1)]);
    assert_eq!(steps("<gt*2>x"), [key(">", 2), key("x", 1)]);
    assert_eq!(steps("<\">"), [key("\"", 1)]);
    assert_eq!(steps("<**3>"), [key("*", 3)]);
    assert_eq!(steps("a>>b"), [key("a", 1), key(">", 1), key(">", 1), key("b", 1)]);
    assert_eq!(steps("<esc>>"), [key("<esc>", 1), key(">", 1)]);
    let text = r#"<expect "a > b \"c\" # \\ d">x"#;
    assert_eq!(steps(text), [Instruction::Expect("a > b \"c\" # \\ d".to_owned()), key("x", 1)]);
}

#[test]
fn places_are_lines_and_columns_in_characters() {
    let script = parse("# é\n éé <wait>\r\n  x").unwrap();
    let places: Vec<_> = script.steps.iter().map(|step| (step.line, step.column)).collect();
    assert_eq!(places, [(2, 2), (2, 3), (2, 5), (3, 3)]);
}

#[test]
fn mistakes_are_named_with_their_place_before_anything_runs() {
    for (text, line) in [
        ("j k\n  <rigth*5>", "line 2, column 3: unknown key <rigth>; did you mean <right>?"),
        ("<right", "line 1, column 1: \"<\" without \">\""),
        ("a <right*0>", "line 1, column 3: a key is pressed 1 to 100000 times, not 0"),
        ("<right*99999999999>", "line 1, column 1: a key is pressed 1 to"),
        ("<resize 80>", "line 1, column 1: <resize 80>: resize takes columns and rows"),
        ("<resize 0x24>", "line 1, column 1: <resize 0x24>: resize takes columns and rows"),
        ("<expect captured>", "line 1, column 1: <expect captured>: expect takes text in quotes"),
        ("<expect \"a>", "line 1, column 1: <expect \"a>: expect takes text in quotes"),
        (
            "<expect \"\\q\">",
            "line 1, column 1: <expect \"\\q\">: expect takes text in quotes, which may have \\\" \\\\ \\n",
        ),
        ("<screen ../x>", "line 1, column 1: <screen ../x>: screen takes a name of letters"),
        ("<screen>", "line 1, column 1: <screen>: screen takes a name"),
        (
            "<ask \"a\" x>",
            "line 1, column 1: <ask \"a\" x>: ask takes a question in quotes and y or n",
        ),
        (
            "<until \"lost?\" \"lost\" \"set D=-1\">",
            "line 1, column 1: <until \"lost?\" \"lost\" \"set D=-1\">: until takes a task, a text of the screen",
        ),
        (
            "<until \"a\">",
            "line 1, column 1: <until \"a\">: until takes a task, a text of the screen",
        ),
        ("<wait 3>", "line 1, column 1: <wait 3>: wait takes nothing"),
        (
            "<excpect \"a\">",
            "line 1, column 1: unknown key <excpect \"a\">; did you mean <expect>?",
        ),
    ] {
        let said = parse(text).unwrap_err().to_string();
        assert!(said.starts_with(line), "{text}: {said}");
    }
}

/// The actions of the player, on a screen that shows `screen`; the session is idle whenever the player
/// waits.
fn actions(text: &str, screen: &str) -> Vec<String> {
    let mut player = Player::new(parse(text).unwrap());
    let (mut acts, mut idle) = (Vec::new(), true);
    loop {
        let act = player.next(idle, || screen.to_owned());
        idle = matches!(act, Ok(Action::Wait));
        match act {
            Ok(Action::Give(Msg::Key(key))) => acts.push(key.to_string()),
            Ok(Action::Give(message)) => acts.push(format!("{message:?}")),
            Ok(Action::Keep(name)) => acts.push(format!("keep {name}")),
            Ok(Action::Wait) => acts.push("wait".to_owned()),
            Ok(Action::Task(message)) => {
                acts.push(format!("task {message:?}"));
                player.helped();
            }
            Ok(Action::Done) => break,
            Err(unmet) => {
                acts.push(unmet.to_string());
                break;
            }
        }
    }
    acts
}

#[test]
fn it_waits_after_each_key_unless_told_otherwise() {
    assert_eq!(actions("<right*2>x", ""), ["<right>", "wait", "<right>", "wait", "x", "wait"]);
    assert_eq!(actions("<async><right*2>x", ""), ["<right>", "<right>", "x", "wait"]);
    assert_eq!(actions("<async>x<wait>y", ""), ["x", "wait", "y", "wait"]);
}

#[test]
fn the_first_unmet_expectation_ends_it_with_its_place() {
    assert_eq!(
        actions("<expect \"here\">\n  <screen a> <expect \"there\"> x", "I am\nhere"),
        ["keep a", "wait", "line 2, column 14: the screen does not show \"there\""]
    );
}

#[test]
fn another_file_is_played_in_between() {
    let mut player = Player::new(parse("a b").unwrap());
    let next = |player: &mut Player| match player.next(true, String::new).unwrap() {
        Action::Give(Msg::Key(key)) => key.to_string(),
        other => format!("{other:?}"),
    };
    let mut keys = vec![next(&mut player)];
    player.interject(parse("x<y*2>").unwrap()).unwrap();
    keys.extend((0..5).map(|_| next(&mut player)));
    assert_eq!(keys, ["a", "x", "y", "y", "b", "Done"]);
}

#[test]
fn a_recording_is_short_and_readable() {
    let mut recorder = Recorder::new("hopfscope basin".to_owned(), Vec::new());
    for _ in 0..5 {
        recorder.note(&Msg::Key("<right>".parse().unwrap()));
    }
    recorder.note(&Msg::Told(Notice { error: false, text: String::new() }));
    recorder.note(&Msg::Key("#".parse().unwrap_or("<hash>".parse().unwrap())));
    recorder.note(&Msg::Resize { width: 10, height: 10 });
    recorder.note(&Msg::Resize { width: 80, height: 24 });
    recorder.note(&Msg::Paste("a\n\"b\"".to_owned()));
    let text = recorder.text();
    assert_eq!(
        text,
        "# A recording of hopfscope; `hopfscope replay FILE` plays it.\n# hopfscope basin\n\
         <right*5> <hash> <resize 80x24> <paste \"a\\n\\\"b\\\"\">\n"
    );
}

#[test]
fn the_last_presses_can_be_forgotten() {
    let mut recorder = Recorder::default();
    let key = |recorder: &mut Recorder, name: &str| recorder.note(&Msg::Key(name.parse().unwrap()));
    for name in ["<right>", "<right>", "<right>", "@", "a"] {
        key(&mut recorder, name);
    }
    recorder.note(&Msg::Resize { width: 80, height: 24 });
    recorder.embed("a.keys", "x", 2);
    recorder.embed("a.keys", "x", 2);
    let steps = |recorder: &Recorder| text("", recorder.steps());
    assert_eq!(steps(&recorder), "<right*3> <file \"a.keys\" \"x\"> @ a <resize 80x24>\n");
    recorder.forget(3);
    assert_eq!(steps(&recorder), "<right*2> <resize 80x24>\n", "only presses are forgotten");
    recorder.forget(9);
    assert_eq!(steps(&recorder), "<resize 80x24>\n");
}

#[test]
fn it_knows_whether_it_is_as_it_was() {
    let mut recorder = Recorder::default();
    let key = |recorder: &mut Recorder, name: &str| recorder.note(&Msg::Key(name.parse().unwrap()));
    for name in ["<right>", "u", "u"] {
        key(&mut recorder, name);
    }
    assert!(recorder.take_changed());
    assert!(!recorder.take_changed());
    key(&mut recorder, "u");
    assert!(recorder.take_changed(), "the last step has a count more");
    recorder.embed("a", "", 2);
    assert!(recorder.take_changed());
}
