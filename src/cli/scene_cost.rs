//! The measured cost of scenes: each is opened and stepped as in the explorer, and its questions are timed.

use std::sync::Arc;

use super::{Failure, timed};
use crate::flow::Limits;
use crate::question::answer;
use crate::report::scenes::{QuestionCost, SceneCost, StepCost};
use crate::scene::{Scene, library};
use crate::session::{self, Msg, Row, Session, Size, update};

/// Number of times that a quickly answered question is measured for the median of its times.
const TIMES: u32 = 5;

/// Time in seconds below which a single measurement is unreliable.
const QUICK: f64 = 2e-3;

/// The cost of every built-in scene.
pub fn measured() -> Result<Vec<SceneCost>, Failure> {
    library().iter().map(of).collect()
}

fn of(scene: &Arc<Scene>) -> Result<SceneCost, Failure> {
    let mut session = Session::new(Arc::clone(scene), Size { width: 120, height: 40 });
    let questions = settle(&mut session, scene)?;
    let rows = session.rows().into_iter().filter(|row| *row != Row::Method);
    let step = |row: Row| {
        let mut stepped = session.stepped(row, 1);
        update(&mut stepped, Msg::Elapsed { seconds: 0.0 });
        let kept = stepped.requirements().into_iter().map(|part| part.request);
        let reused = kept.filter(|request| !stepped.is_open(request));
        let reused = reused.map(|request| request.topic()).collect();
        let recomputed = settle(&mut stepped, scene)?;
        let name = row.name_in(&session.problem);
        Ok(StepCost { name, recomputed, reused })
    };
    Ok(SceneCost {
        scene: Arc::clone(scene),
        formulas: session.drawn_by_formulas().iter().map(|layer| layer.spec().name).collect(),
        questions,
        steps: rows.map(step).collect::<Result<_, Failure>>()?,
    })
}

/// Answers the questions of a session until it asks no more, and returns their costs.
fn settle(session: &mut Session, scene: &Scene) -> Result<Vec<QuestionCost>, Failure> {
    let mut answered = Vec::new();
    let mut failed = None;
    session::settle(session, |session, request| {
        let layers = session.requirements().into_iter();
        let layers = layers.filter(|part| part.request == *request).flat_map(|part| part.layers);
        let layers = layers.map(|layer| layer.spec().name).collect();
        let ask = || answer(request, &Limits::PATIENT);
        let (result, once) = timed(1, ask);
        let seconds = if once < QUICK { timed(TIMES, ask).1 } else { once };
        let topic = request.topic();
        match result {
            Ok(found) => {
                answered.push(QuestionCost { topic, layers, cost: found.cost(), seconds });
                Some(Msg::answered(request.clone(), Ok(found), seconds))
            }
            Err(reason) => {
                failed = Some(format!("scene {}: {}: {reason}", scene.name, topic.name()));
                None
            }
        }
    });
    failed.map_or(Ok(answered), |why| Err(Failure::Unanswered(why)))
}
