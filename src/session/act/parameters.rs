//! Commands of the parameter pane: select, step, reset.

use std::sync::Arc;

use crate::flow::machine::stepped::SteppedMethod;
use crate::flow::{METHODS, Method, Problem, QUALITIES};
use crate::model::{Knob, KnobSpec};
use crate::numerics::decimal::shortest;
use crate::numerics::elementary::log10;
use crate::scene::{Running, Setting, View};
use crate::session::act::notice::inform;
use crate::session::effect::Done;
use crate::session::state::{Before, Framing, Plot, Row, Session, Setup, StepSizes};

/// Changes the motion on show, as one change that can be undone; the belt keeps its speed. Returns whether
/// anything differs.
pub(in crate::session) fn change(session: &mut Session, problem: Problem) -> bool {
    put(session, &Setup { problem, ..session.setup() })
}

/// Changes the setup, as one change that can be undone. Returns whether anything differs.
pub(in crate::session) fn put(session: &mut Session, setup: &Setup) -> bool {
    let before = session.setup();
    let setup = holding(session, &before, *setup);
    let differs = setup != before;
    if differs {
        let was_on = session.is_on_the_belt() == Some(true);
        session.history.record(Before::Setup(Box::new(before)));
        session.set_setup(&setup);
        if was_on && session.is_on_the_belt() == Some(false) {
            inform(session, "off the belt: no speed has these numbers; the row belt leads back");
        }
    }
    differs
}

/// Marks as held the numbers of a fitted record that a change by hand has moved; the fit of all others follows.
fn holding(session: &Session, before: &Setup, mut setup: Setup) -> Setup {
    // A mark determines what is held.
    if session.scene.recording.is_some() && setup.doubt.held == before.doubt.held {
        for knob in Knob::MOTION {
            if setup.problem.get(knob) != before.problem.get(knob) {
                setup.doubt.held[knob as usize] = true;
            }
        }
    }
    setup
}

/// Moves the selection among the rows that the pane shows.
pub fn select(session: &mut Session, by: isize) {
    let rows = session.rows();
    let at = rows.iter().position(|row| *row == session.selected).unwrap_or(0);
    session.selected = rows[at.saturating_add_signed(by).min(rows.len() - 1)];
}

/// Steps the selected value.
pub fn step(session: &mut Session, count: i32) -> Done {
    match session.selected {
        Row::Number(knob) => step_number(session, knob, count),
        Row::Method => {
            next_method(session, count.signum() as isize);
            Ok(())
        }
        Row::Tolerance => turn(session, count.signum()),
    }
}

/// Steps a number, within its range. One of the machine leads back onto its belt; out of range it is refused: the
/// end of the range of speeds, far below that of any belt, would be no useful place to stop.
fn step_number(session: &mut Session, knob: Knob, count: i32) -> Done {
    let KnobSpec { symbol, min, max, .. } = *knob.spec();
    let value = session.value(knob);
    let wanted = session.steps.of(knob).from(value, count);
    let within = if knob.is_of_machine() { wanted } else { wanted.clamp(min, max) };
    let stepped = session.with(&session.setup(), knob, within)?;
    if put(session, &stepped) {
        Ok(())
    } else if (min..=max).contains(&wanted) {
        Err(format!("the step is too small to change {symbol} = {}", knob.print(value)))
    } else {
        Err(knob.at_end(value))
    }
}

/// Makes the half width of the selected parameter wider or narrower by a step.
pub fn half_width(session: &mut Session, count: i32) -> Done {
    let present = session.setup();
    let knob = session.selected.knob_in(&session.problem);
    let half = session.steps.of(knob).from(present.doubt.half_width(knob), count).max(0.0);
    let doubt = present.doubt.with_half_width(knob, half)?;
    let differs = put(session, &Setup { doubt, ..present });
    if differs { Ok(()) } else { Err(format!("{knob} has no half width")) }
}

/// Makes the step size of the selected row larger or smaller.
pub fn step_size(session: &mut Session, larger: bool) -> Done {
    let row = session.selected;
    let size = session.steps.of_row_mut(row);
    let size = size.ok_or_else(|| format!("{} has no step size", row.name()))?;
    *size = if larger { size.larger() } else { size.smaller() };
    Ok(())
}

/// Resets the selected row to the scene's value and step size.
pub fn reset_row(session: &mut Session) {
    let row = session.selected;
    let (of_scene, present) = (Setup::of_scene(&session.scene), session.setup());
    let steps = StepSizes::of_scene(&session.scene);
    if let (Some(size), Some(wanted)) = (session.steps.of_row_mut(row), steps.of_row(row)) {
        *size = wanted;
    }
    let Setup { mut problem, mut doubt, .. } = present;
    let reset = match row {
        Row::Method => {
            problem.method = of_scene.problem.method;
            Setup { problem, ..present }
        }
        Row::Tolerance => {
            Setup { problem: problem.with_setting(of_scene.problem.setting()), ..present }
        }
        Row::Number(knob) if session.scene.recording.is_some() && Knob::MOTION.contains(&knob) => {
            doubt = doubt.with_half_width(knob, 0.0).unwrap_or(doubt);
            doubt.held[knob as usize] = false;
            Setup { doubt, ..present }
        }
        Row::Number(knob) => {
            let half = of_scene.doubt.half_width(knob);
            doubt = doubt.with_half_width(knob, half).unwrap_or(doubt);
            let value = session.value_in(&of_scene, knob);
            session.with(&Setup { doubt, ..present }, knob, value).unwrap_or(present)
        }
    };
    if !put(session, &reset) {
        inform(session, format!("{} has the scene's value", row.name_in(&session.problem)));
    }
}

/// Shows or hides the parameters that the scene does not declare.
pub fn unfold(session: &mut Session) {
    session.unfolded = !session.unfolded;
}

/// Changes the accuracy to its next stop: draft, normal, fine, reference.
pub fn dial(session: &mut Session, finer: bool) -> Done {
    session.measuring = true;
    let quality = session.problem.next_quality(finer);
    let quality =
        quality.ok_or_else(|| format!("the accuracy is at its {}", end_of_dial(finer)))?;
    change(session, session.problem.at(quality));
    let (knob, setting) = (Row::Tolerance.knob_in(&session.problem), session.problem.setting());
    let (name, meaning) = (quality.name, quality.meaning);
    inform(session, format!("{name}: {knob} {}; {meaning}", shortest(setting)));
    Ok(())
}

fn end_of_dial(finer: bool) -> String {
    let [coarsest, .., finest] = QUALITIES.map(|quality| quality.name);
    if finer { format!("finest, {finest}") } else { format!("coarsest, {coarsest}") }
}

/// Multiplies the number that sets the accuracy by a power of ten.
fn turn(session: &mut Session, decades: i32) -> Done {
    let knob = session.problem.method.spec().dial.knob();
    let KnobSpec { min, max, .. } = *knob.spec();
    let exponent = log10(session.problem.setting()).round() + f64::from(decades);
    // Parsed, because the power of ten must be exact to the last bit, which powi does not guarantee.
    let setting = format!("1e{exponent}").parse().unwrap_or(max).clamp(min, max);
    let turned = session.problem.with_setting(setting);
    if change(session, turned) { Ok(()) } else { Err(knob.at_end(setting)) }
}

/// Selects the next method of the list, cycling.
pub fn next_method(session: &mut Session, by: isize) {
    // Without a closed form, that method could only give up.
    let nonlinear = session.problem.parameters.d2 != 0.0 || session.problem.parameters.d3 != 0.0;
    let whole = session.draws_whole();
    let usable = METHODS.iter().filter(|row| {
        if whole {
            SteppedMethod::of(row.method).is_ok()
        } else {
            !(nonlinear && row.method == Method::Exact)
        }
    });
    let rows: Vec<_> = usable.collect();
    let at = rows.iter().position(|row| row.method == session.problem.method).unwrap_or(0);
    let next = at.checked_add_signed(by).unwrap_or(rows.len() - 1) % rows.len();
    let row = rows[next];
    session.measuring = true;
    change(session, Problem { method: row.method, ..session.problem });
    inform(session, format!("{}: {}", row.name, row.guarantee));
}

impl Session {
    /// The session after some steps of a row; where these are refused, nothing has changed but the selection.
    pub fn stepped(&self, row: Row, count: i32) -> Session {
        let mut stepped = self.clone();
        stepped.selected = row;
        let _ = step(&mut stepped, count);
        stepped
    }

    /// The session after a step of a row; at the end of its range, in the other direction.
    pub fn stepped_once(&self, row: Row) -> Session {
        let up = self.stepped(row, 1);
        if up.setup() == self.setup() { self.stepped(row, -1) } else { up }
    }

    /// Makes this setup the present one. There is a setting of the machine if and only if there is a machine.
    pub(in crate::session) fn set_setup(&mut self, setup: &Setup) {
        let Setup { problem, others, setting, doubt } = *setup;
        self.doubt = doubt;
        let scaled = self.scene.machine.as_ref();
        let can_run = |setting: &Setting| {
            let set = scaled.and_then(|scaled| setting.on(&scaled.machine).ok());
            set.is_some_and(|machine| Running::at(&machine, setting.speed).is_ok())
        };
        let own = scaled.map(|scaled| Setting::of_speed(scaled.machine.belt.belt_speed));
        let present = self.setting.filter(can_run);
        self.setting = setting.filter(can_run).or(present).or(own);
        let rebuilt = scaled.zip(self.setting).filter(|(_, setting)| setting.differs());
        self.rebuilt =
            rebuilt.and_then(|(scaled, setting)| setting.on(&scaled.machine).ok()).map(Arc::new);
        // The energy ledger has lines for each motion.
        if self.others.all().len() != others.all().len() {
            let ledgers =
                |plot: &&mut Plot| plot.view == View::EnergyLedger && plot.framing != Framing::User;
            self.plots.iter_mut().filter(ledgers).for_each(|plot| plot.framing = Framing::Fitting);
        }
        (self.problem, self.others) = (problem, others);
    }
}
