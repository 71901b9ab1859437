//! A session for tests: keys are pressed, and of its questions only those for fits are answered, and for the motion and
//! the cycles of a fitted record.

// Each test program compiles this file and uses only a part of it.
#![allow(dead_code)]

use hopfscope::flow::Limits;
use hopfscope::question::answer;
use hopfscope::scene::{Topic, find};
use hopfscope::session::replay::{Action, Player, parse};
use hopfscope::session::{Effect, Msg, Session, Size, run_line, save, settle, update};

/// A session, and what it has asked for so far.
pub struct Trial {
    pub session: Session,
    /// The topics of the questions answered since the last keys.
    pub asked: Vec<Topic>,
    pub effects: Vec<Effect>,
}

impl Trial {
    /// A session that has just opened a scene.
    pub fn open(scene: &str) -> Self {
        Trial::of(Session::new(find(scene).unwrap(), Size { width: 80, height: 24 }))
    }

    pub fn of(session: Session) -> Self {
        let mut trial = Trial { session, asked: Vec::new(), effects: Vec::new() };
        trial.settle();
        trial
    }

    /// Gives a message and answers the resulting questions.
    pub fn give(&mut self, message: Msg) {
        self.effects.extend(update(&mut self.session, message));
        self.settle();
    }

    /// Presses keys; returns the topics that were answered.
    pub fn press(&mut self, keys: &str) -> Vec<Topic> {
        self.asked.clear();
        let mut player = Player::new(parse(keys).unwrap_or_else(|error| panic!("{keys}: {error}")));
        while let Action::Give(message) = player.next(true, String::new).unwrap() {
            self.give(message);
        }
        self.asked.clone()
    }

    fn settle(&mut self) {
        settle(&mut self.session, |session, request| {
            let topic = request.topic();
            let of_fit = matches!(topic, Topic::Fit | Topic::Refit);
            let of_record = matches!(topic, Topic::Trajectory | Topic::Cycles);
            let answers = of_fit || (of_record && session.scene.recording.is_some());
            answers.then(|| {
                self.asked.push(topic);
                let result = answer(request, &Limits::PATIENT).unwrap();
                Msg::answered(request.clone(), Ok(result), 0.0)
            })
        });
    }

    /// The notice to the user.
    pub fn notice(&self) -> &str {
        self.session.notice.as_ref().map_or("", |notice| &notice.text)
    }
}

/// For each row, opens the scene and runs the line: it is refused in one line that says this, and nothing changes.
pub fn refuses(scene: &str, rows: &[(&str, &str)]) {
    for (line, said) in rows {
        let mut session = Trial::open(scene).session;
        let before = session.setup();
        let why = run_line(&mut session, line).unwrap_err();
        assert!(why.contains(said) && !why.contains('\n'), "{line}: {why}");
        assert_eq!(session.setup(), before, "{line}: all of it or nothing");
    }
}

/// A session after it was saved and opened again, from where it is saved as the same file.
pub fn reopened(session: &Session) -> Session {
    let text = save::text(session).unwrap();
    let mut other = Trial::open("plain").session;
    save::open(&mut other, &text).unwrap_or_else(|why| panic!("{why}\n{text}"));
    assert_eq!(save::text(&other), Ok(text));
    other
}
