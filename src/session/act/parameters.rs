//! Commands of the parameter pane: select, step, reset.

use std::sync::Arc;

use crate::flow::{METHODS, Method, Problem, QUALITIES};
use crate::machine::stepped::SteppedMethod;
use crate::numerics::decimal::shortest;
use crate::numerics::elementary::log10;
use crate::oscillator::{Knob, KnobSpec};
use crate::scene::{Running, Setting, View};
use crate::session::act::notice::{inform, refuse};
use crate::session::read::numbers::{number, with_number};
use crate::session::state::history::Before;
use crate::session::state::plot::{Framing, Plot};
use crate::session::state::rows::{Row, Steps};
use crate::session::state::session::Session;
use crate::session::state::setup::Setup;
use crate::session::state::step_size::StepSize;
use crate::session::state::uncertainty::Uncertainty;

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
pub fn step(session: &mut Session, count: i32) {
    match session.selected {
        Row::Method => return next_method(session, count.signum() as isize),
        Row::Tolerance => return turn(session, count.signum()),
        Row::Quantity(quantity) => return step_machine(session, quantity, count),
        Row::Disturbance => return step_disturbance(session, count),
        Row::Parameter(_) | Row::Until => {}
    }
    let row = session.selected;
    let Some(size) = session.steps.of_row(row) else { return };
    let knob = row.knob_in(&session.problem);
    let value = number(&session.setup(), row);
    let (stepped, why) = stepped(knob, size, value, count);
    if let Err(refused) = knob.check(stepped) {
        return refuse(session, refused.to_string());
    }
    let changed = with_number(session.problem, row, stepped);
    if !change(session, changed) {
        refuse(session, why);
    }
}

/// A value after some steps, within its range, and why it stays where it does.
fn stepped(knob: Knob, size: StepSize, value: f64, count: i32) -> (f64, String) {
    let KnobSpec { symbol, min, max, .. } = *knob.spec();
    let wanted = size.from(value, count);
    let why = if (min..=max).contains(&wanted) {
        format!("the step is too small to change {symbol} = {}", knob.print(value))
    } else {
        knob.at_end(value)
    };
    (wanted.clamp(min, max), why)
}

/// Steps a number of the machine; if the parameters are off the belt, this leads back onto it. A value out of
/// range is refused and not clamped: the end of the range of speeds, far below that of any belt, would be no
/// useful place to stop.
fn step_machine(session: &mut Session, quantity: Knob, count: i32) {
    let Some(size) = session.steps.of_row(Row::Quantity(quantity)) else { return };
    let value = size.from(session.quantity(quantity), count);
    match session.with_quantity(&session.setup(), quantity, value) {
        Ok(setup) if put(session, &setup) => {}
        Ok(_) => {
            let (_, why) = stepped(quantity, size, session.quantity(quantity), count);
            refuse(session, why)
        }
        Err(why) => refuse(session, why),
    }
}

/// Steps the bound on the disturbance, which stays at least 0.
fn step_disturbance(session: &mut Session, count: i32) {
    let Some(size) = session.steps.of_row(Row::Disturbance) else { return };
    let present = session.setup();
    let (disturbance, why) = stepped(Knob::Disturbance, size, present.doubt.disturbance, count);
    let doubt = Uncertainty { disturbance, ..present.doubt };
    if !put(session, &Setup { doubt, ..present }) {
        refuse(session, why);
    }
}

/// Makes the half width of the selected parameter wider or narrower by a step.
pub fn half_width(session: &mut Session, count: i32) {
    let present = session.setup();
    let Row::Parameter(symbol) = session.selected else {
        return refuse(session, "only D, D2, D3 and r have a half width");
    };
    let Some(step) = session.steps.of_row(session.selected) else { return };
    let half = step.from(present.doubt.half_width(symbol), count).max(0.0);
    match present.doubt.with_half_width(symbol, half) {
        Ok(doubt) if put(session, &Setup { doubt, ..present }) => {}
        Ok(_) => refuse(session, format!("{symbol} has no half width")),
        Err(why) => refuse(session, why),
    }
}

/// Makes the step size of the selected row larger or smaller.
pub fn step_size(session: &mut Session, larger: bool) {
    let Some(size) = session.steps.of_row_mut(session.selected) else {
        return refuse(session, format!("{} has no step size", session.selected.name()));
    };
    *size = if larger { size.larger() } else { size.smaller() };
}

/// Resets the selected row to the scene's value and step size.
pub fn reset_row(session: &mut Session) {
    let row = session.selected;
    let (scene, present) = (session.scene.problem, session.setup());
    let steps = Steps::of_scene(&session.scene);
    if let (Some(size), Some(wanted)) = (session.steps.of_row_mut(row), steps.of_row(row)) {
        *size = wanted;
    }
    let reset = match row {
        Row::Quantity(quantity) => session.scene.machine.as_ref().map_or_else(
            || Ok(present),
            |scaled| {
                session.with_quantity(
                    &present,
                    quantity,
                    quantity.of_belt(&scaled.machine.belt).unwrap_or(0.0),
                )
            },
        ),
        Row::Method => {
            Ok(Setup { problem: Problem { method: scene.method, ..session.problem }, ..present })
        }
        Row::Disturbance => {
            let disturbance = Setup::of_scene(&session.scene).doubt.disturbance;
            Ok(Setup { doubt: Uncertainty { disturbance, ..present.doubt }, ..present })
        }
        Row::Parameter(symbol) if session.scene.recording.is_some() => {
            let mut doubt = present.doubt.with_half_width(symbol, 0.0).unwrap_or(present.doubt);
            doubt.held[symbol as usize] = false;
            Ok(Setup { doubt, ..present })
        }
        Row::Parameter(symbol) => {
            let value = number(&Setup::alone(scene), row);
            let half = Setup::of_scene(&session.scene).doubt.half_width(symbol);
            let doubt = present.doubt.with_half_width(symbol, half).unwrap_or(present.doubt);
            let problem = with_number(session.problem, row, value);
            Ok(Setup { problem, doubt, ..present })
        }
        Row::Until | Row::Tolerance => {
            let value = number(&Setup::alone(scene), row);
            Ok(Setup { problem: with_number(session.problem, row, value), ..present })
        }
    };
    let reset = reset.unwrap_or(present);
    if !put(session, &reset) {
        inform(session, format!("{} has the scene's value", row.name_in(&session.problem)));
    }
}

/// Shows or hides the parameters that the scene does not declare.
pub fn unfold(session: &mut Session) {
    session.unfolded = !session.unfolded;
}

/// Changes the accuracy to its next stop: draft, normal, fine, reference.
pub fn dial(session: &mut Session, finer: bool) {
    session.measuring = true;
    match session.problem.next_quality(finer) {
        Some(quality) => {
            change(session, session.problem.at(quality));
            let (dial, meaning) = (session.problem.method.spec().dial, quality.meaning);
            let setting = shortest(session.problem.setting());
            inform(session, format!("{}: {} {setting}; {meaning}", quality.name, dial.knob()))
        }
        None => refuse(session, format!("the accuracy is at its {}", end_of_dial(finer))),
    }
}

fn end_of_dial(finer: bool) -> String {
    let [coarsest, .., finest] = QUALITIES.map(|quality| quality.name);
    if finer { format!("finest, {finest}") } else { format!("coarsest, {coarsest}") }
}

/// Multiplies the number that sets the accuracy by a power of ten.
fn turn(session: &mut Session, decades: i32) {
    let knob = session.problem.method.spec().dial.knob();
    let KnobSpec { min, max, .. } = *knob.spec();
    let exponent = log10(session.problem.setting()).round() + f64::from(decades);
    // Parsed, because the power of ten must be exact to the last bit, which powi does not guarantee.
    let setting = format!("1e{exponent}").parse().unwrap_or(max).clamp(min, max);
    let turned = session.problem.with_setting(setting);
    if !change(session, turned) {
        refuse(session, knob.at_end(setting));
    }
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
    /// Makes this setup the present one. There is a setting of the machine if and only if there is a machine.
    pub(in crate::session) fn set_setup(&mut self, setup: &Setup) {
        let Setup { problem, others, setting, doubt } = *setup;
        self.doubt = doubt;
        let scaled = self.scene.machine.as_ref();
        let can_run = |setting: &Setting| {
            scaled.is_some_and(|scaled| {
                Running::at(&setting.on(&scaled.machine), setting.speed).is_ok()
            })
        };
        let own = scaled.map(|scaled| Setting::of_speed(scaled.machine.belt.belt_speed));
        let present = self.setting.filter(can_run);
        self.setting = setting.filter(can_run).or(present).or(own);
        let rebuilt = scaled.zip(self.setting).filter(|(_, setting)| setting.differs());
        self.rebuilt = rebuilt.map(|(scaled, setting)| Arc::new(setting.on(&scaled.machine)));
        // The energy ledger has lines for each motion.
        if self.others.all().len() != others.all().len() {
            let ledgers =
                |plot: &&mut Plot| plot.view == View::EnergyLedger && plot.framing != Framing::User;
            self.plots.iter_mut().filter(ledgers).for_each(|plot| plot.framing = Framing::Fitting);
        }
        (self.problem, self.others) = (problem, others);
    }
}
