//! The start of a session as steps of a keystroke file, which lead to the same state from anywhere.
//!
//! A built-in scene with other numbers is described by lines that could be typed. Anything else, such as a
//! machine or a saved session, is described by a saved session embedded in the file.

use crate::flow::Problem;
use crate::model::Knob;
use crate::numerics::decimal::shortest;
use crate::scene::{Scene, find};
use crate::session::settings::{DisplaySettings, NamedValue};
use crate::session::{Instruction, Msg, Session, save};

/// The name under which a file embeds a session.
const CARRIED: &str = "start.toml";

/// The steps that lead to this session, which must have nothing open. Fails with one line if the session cannot
/// be saved; no such session is known.
pub fn opening(session: &Session) -> Result<Vec<Instruction>, String> {
    let mut steps: Vec<Instruction> = display_lines(session.display);
    let text = save::text(session)?;
    let new = Session::new(session.scene.clone(), session.size);
    let is_new = save::text(&new)? == text;
    if let Some((lines, names)) = scene(&session.scene).filter(|_| is_new) {
        steps.extend(lines);
        steps.push(Instruction::Give(Msg::Start(names)));
    } else {
        steps.push(Instruction::File { name: CARRIED.to_owned(), text });
        steps.push(run(format!("open {CARRIED}")));
        // The scene opens with these numbers, so they are no change; an earlier change can still be undone.
        steps.extend(is_new.then(|| Instruction::Give(Msg::Start(Vec::new()))));
    }
    Ok(steps)
}

/// The step that runs a line.
fn run(line: String) -> Instruction {
    Instruction::Give(Msg::Run(line))
}

/// The steps that set the user's wishes for the screen, where they differ from the defaults.
fn display_lines(display: DisplaySettings) -> Vec<Instruction> {
    fn line<T: NamedValue + Default>(name: &str, value: T) -> Option<String> {
        (value != T::default()).then(|| format!("{name} {}", value.into()))
    }
    let switched = |on: bool, line: &str| on.then(|| line.to_owned());
    let lines = [
        line("glyphs", display.glyphs),
        line("color", display.colors),
        line("theme", display.theme),
        switched(display.stretched, "equal off"),
        switched(display.dimensionless, "units off"),
        switched(display.mouse, "mouse"),
    ];
    lines.into_iter().flatten().map(run).collect()
}

/// The lines that open a built-in scene with other numbers, and the parameters that were added to its terms;
/// `None` for any other scene.
fn scene(scene: &Scene) -> Option<(Vec<Instruction>, Vec<Knob>)> {
    let known = find(&scene.name).ok()?;
    let mut with_numbers = Scene::clone(&known);
    with_numbers.problem = scene.problem;
    with_numbers.terms.extend(&scene.terms);
    if with_numbers != *scene {
        return None;
    }
    let names = scene.terms.difference(&known.terms).copied().collect();
    let words = numbers(&known.problem, &scene.problem);
    let set = (!words.is_empty()).then(|| run(format!("set {}", words.join(" "))));
    let lines = std::iter::once(run(format!("scene {}", scene.name))).chain(set);
    Some((lines.collect(), names))
}

/// The assignments that lead from one motion to another.
fn numbers(from: &Problem, to: &Problem) -> Vec<String> {
    let accuracy = [Knob::Until, Knob::Tolerance, Knob::Step, Knob::Epsilon];
    let numbers = Knob::MOTION.into_iter().chain(accuracy);
    let given = numbers.filter(|knob| from.get(*knob) != to.get(*knob));
    let words = given.map(|knob| format!("{knob}={}", shortest(to.get(knob))));
    // Last, because the tolerance is the number that sets the accuracy of the method.
    let method = (from.method != to.method).then(|| format!("method={}", to.method));
    words.chain(method).collect()
}
