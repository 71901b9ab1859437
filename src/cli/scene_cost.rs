//! What scenes require, measured: each is opened and stepped as in the explorer, and its questions timed.

use std::sync::Arc;

use super::failure::Failure;
use super::timing::timed;
use crate::flow::Limits;
use crate::question::answer;
use crate::report::scene_cost::{Question, SceneCost, StepCost};
use crate::scene::{Answered, Request, Scene, library};
use crate::session::act::parameters;
use crate::session::{Msg, Row, Session, Size, update};

/// How often a question that is answered quickly is answered for the median of its times.
const TIMES: u32 = 5;

/// Seconds below which one measurement says little.
const QUICK: f64 = 2e-3;

/// Rounds of questions after which a scene is taken to ask for ever: windows are fitted after the first.
const ROUNDS: usize = 4;

/// Every scene of the program with what it costs.
pub fn measured() -> Result<Vec<SceneCost>, Failure> {
    library().iter().map(of).collect()
}

fn of(scene: &Arc<Scene>) -> Result<SceneCost, Failure> {
    let mut session = Session::new(Arc::clone(scene), Size { width: 120, height: 40 });
    let questions = settle(&mut session, scene)?;
    let rows = session.rows().into_iter().filter(|row| *row != Row::Method);
    let step = |row: Row| {
        let mut stepped = session.clone();
        stepped.selected = row;
        parameters::step(&mut stepped, 1);
        update(&mut stepped, Msg::Idle);
        let kept = stepped.requirements().into_iter().map(|part| part.request);
        let reused = kept.filter(|request| !stepped.is_open(request));
        let reused = reused.map(|request| request.topic()).collect();
        let recomputed = settle(&mut stepped, scene)?;
        let name = row.name_in(&session.problem);
        Ok(StepCost { name, recomputed, reused })
    };
    Ok(SceneCost {
        scene: Arc::clone(scene),
        formulas: session.drawn_by_formulas(),
        questions,
        steps: rows.map(step).collect::<Result<_, Failure>>()?,
    })
}

/// Answers what a session asks until it asks nothing more.
fn settle(session: &mut Session, scene: &Scene) -> Result<Vec<Question>, Failure> {
    let mut answered = Vec::new();
    for _ in 0..ROUNDS {
        let open: Vec<Request> =
            session.wants().into_iter().filter(|request| session.is_open(request)).collect();
        for request in open {
            let layers = session.requirements().into_iter();
            let layers = layers.filter(|part| part.request == request).flat_map(|part| part.layers);
            let layers = layers.collect();
            let ask = || answer(&request, &Limits::PATIENT);
            let (result, once) = timed(1, ask);
            let seconds = if once < QUICK { timed(TIMES, ask).1 } else { once };
            let found = result.map_err(|reason| {
                let (name, topic) = (&scene.name, request.topic().name());
                Failure::Unanswered(format!("scene {name}: {topic}: {reason}"))
            })?;
            let (topic, cost) = (request.topic(), found.cost());
            answered.push(Question { topic, layers, cost, seconds });
            let answered = Answered { request, result: Ok(found), seconds, complete: true };
            update(session, Msg::Answered(Box::new(answered)));
        }
    }
    Ok(answered)
}
