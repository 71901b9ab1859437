//! `hopfscope scenes`, `keys`, `paper` and `extremes`: what there is, what of the paper holds, and how exact the extremes are.

use std::sync::Arc;

use clap::Args;
use rayon::prelude::*;

use super::output::{self, sourced};
use super::settings::Settings;
use super::{Failure, Output, Result, input, print, timed};
use crate::accuracy::extremes::verdict::TOLERANCE;
use crate::accuracy::extremes::{Case, cases, judge, judge_set, named, sets};
use crate::flow::Limits;
use crate::model::Parameters;
use crate::paper::examine_all;
use crate::question::answer;
use crate::report::extremes::{extreme_cycles, extremes};
use crate::report::scenes::{OPENING, QuestionBatch, QuestionCost, SceneCost, costs, scenes};
use crate::report::{Answer, Columns, Format, SCREEN, claims};
use crate::runtime::tell;
use crate::scene::{Scene, find, library};
use crate::session::{
    self, CONTEXTS, Command, ContextSpec, Msg, Row, Session, Size, commands, update,
};

/// Lists the scenes
#[derive(Args)]
pub struct ScenesCommand {
    /// Output format
    #[arg(long, value_enum, default_value_t = Format::Table)]
    format: Format,
    /// Shows what each scene computes, what that costs, and what a step of each number recomputes
    #[arg(long)]
    cost: bool,
    /// Prints the file of a scene, to begin one of your own with: hopfscope scenes --show fig17 > my.toml
    #[arg(long, value_name = "SCENE", conflicts_with_all = ["format", "cost"])]
    show: Option<String>,
}

impl ScenesCommand {
    pub fn run(&self) -> Result<()> {
        if let Some(name) = &self.show {
            return print(library::text(&*find(name)?).unwrap_or_default());
        }
        let answer = if self.cost {
            costs(&library().iter().map(cost_of).collect::<Result<Vec<_>>>()?)
        } else {
            scenes(library())
        };
        print(&answer.told(self.format))
    }
}

/// Lists the keys of the explorer, as the settings file changes them
#[derive(Args)]
pub struct KeysCommand {
    #[command(flatten)]
    settings: Settings,
    /// Output format
    #[arg(long, value_enum, default_value_t = Format::Table)]
    format: Format,
}

/// The name of a context, a command in it, and its keys there.
type KeyRow = (&'static str, &'static Command, Vec<String>);

impl KeysCommand {
    pub fn run(&self) -> Result<()> {
        let keymap = self.settings.read()?.keymap;
        let mut rows = Vec::new();
        for &ContextSpec { context, name, .. } in CONTEXTS.iter() {
            let here = commands().filter(|row| row.keys.iter().any(|(at, _)| *at == context));
            rows.extend(here.map(|command| {
                let keys = keymap.keys_in(context, command).map(|key| key.to_string());
                (name, command, keys.collect())
            }));
        }
        let columns = Columns::default()
            .word("context", |(context, ..): &KeyRow| *context)
            .word("command", |(_, command, _)| command.name)
            .word("keys", |(.., keys)| keys.clone())
            .word("meaning", |(_, command, _)| command.doc);
        let list = Answer::list_of(&columns, &rows, output::terminal_width());
        print(&list.told(self.format))?;
        if let (Some(path), Format::Table) = (self.settings.path(), self.format) {
            let there = if path.exists() { "" } else { " (not there)" };
            tell(format!("settings file: {}{there}", path.display()));
        }
        Ok(())
    }
}

/// Tests every equation and claim of the paper that can be tested
#[derive(Args)]
pub struct PaperCommand {
    #[command(flatten)]
    output: Output,
}

impl PaperCommand {
    pub fn run(&self) -> Result<()> {
        let examine = || examine_all(&Limits::PATIENT);
        let (examined, seconds) = self.output.timed("the examination gave up", examine)?;
        self.output.print(claims::claims(&examined, self.output.width().unwrap_or(SCREEN), seconds))
    }
}

/// Tests every method at the extremes of all parameters, and reports its accuracy
///
/// With --cycles, finds the limit cycles there instead.
#[derive(Args)]
pub struct ExtremesCommand {
    /// Output format
    #[arg(long, value_enum, default_value_t = Format::Table)]
    format: Format,
    /// Every motion of the lattice instead of every eleventh; every set of parameters instead of every seventh
    #[arg(long)]
    long: bool,
    /// The limit cycles at these parameters: their number, how well they close, or why the search gave up
    #[arg(long, conflicts_with = "tol")]
    cycles: bool,
    /// Relative error per step, 1e-15 .. 0.01 (default: 1e-10)
    #[arg(long, value_name = "X", value_parser = input::tolerance, default_value_t = TOLERANCE, hide_default_value = true)]
    tol: f64,
}

impl ExtremesCommand {
    pub fn run(&self) -> Result<()> {
        let (limits, format) = (&Limits::PATIENT, self.format);
        let width = output::terminal_width().unwrap_or(SCREEN);
        let answer = if self.cycles {
            let sets: Vec<Parameters> = sets(!self.long).collect();
            let verdicts: Vec<_> = sets.par_iter().map(|set| judge_set(set, limits)).collect();
            extreme_cycles(&verdicts, width)
        } else {
            let cases: Vec<Case> = cases(!self.long).collect();
            let judge = |case| judge(case, self.tol, limits);
            let verdicts: Vec<_> = cases.par_iter().map(judge).collect();
            // Comma-separated values have no place for those that have a name.
            let named = if format == Format::Csv {
                Vec::new()
            } else {
                named(limits)
            };
            extremes(&verdicts, &named, self.tol, width)
        };
        print(&sourced(answer, format))
    }
}

/// Number of times that a quickly answered question is measured for the median of its times.
const TIMES: u32 = 5;

/// Time in seconds below which a single measurement is unreliable.
const QUICK: f64 = 2e-3;

/// What a scene costs: it is opened and stepped as in the explorer, and its questions are timed.
fn cost_of(scene: &Arc<Scene>) -> Result<SceneCost> {
    let mut session = Session::new(Arc::clone(scene), Size { width: 120, height: 40 });
    let questions = settle(&mut session, scene)?;
    let rows = session.rows().into_iter().filter(|row| *row != Row::Method);
    let step = |row: Row| {
        let mut stepped = session.stepped(row, 1);
        update(&mut stepped, Msg::Elapsed { seconds: 0.0 });
        let kept = stepped.requirements().into_iter().map(|part| part.request);
        let reused = kept.filter(|request| !stepped.is_open(request));
        let reused = reused.map(|request| request.topic()).collect();
        let questions = settle(&mut stepped, scene)?;
        Ok(QuestionBatch { after: row.name_in(&session.problem), questions, reused })
    };
    let opening = QuestionBatch { after: OPENING, questions, reused: Vec::new() };
    Ok(SceneCost {
        scene: Arc::clone(scene),
        formulas: session.drawn_by_formulas(),
        asked: std::iter::once(Ok(opening)).chain(rows.map(step)).collect::<Result<_>>()?,
    })
}

/// Answers the questions of a session until it asks no more, and returns their costs.
fn settle(session: &mut Session, scene: &Scene) -> Result<Vec<QuestionCost>> {
    let mut answered = Vec::new();
    let mut failed = None;
    session::settle(session, |session, request| {
        let layers = session.requirements().into_iter();
        let layers = layers.filter(|part| part.request == *request).flat_map(|part| part.layers);
        let layers = layers.collect();
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
                let question = format!("scene {}: {}", scene.name, topic.name());
                failed = Some(Failure::unanswered(question, reason));
                None
            }
        }
    });
    failed.map_or(Ok(answered), Err)
}
