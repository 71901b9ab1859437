//! Commands of the parameter pane: select, step, reset, and typing a value.

use crate::flow::{METHODS, Method, MethodSpec, Problem, QUALITIES};
use crate::model::{Knob, KnobSpec, Parameters, measured};
use crate::numerics::{cycled, log10, shortest};
use crate::scene::{Setting, View};
use crate::session::read::completion::typed;
use crate::session::{
    Done, EarlierState, Framing, Key, Overlay, Prompt, Row, Session, Setup, StepSizes, symbol_of,
};
use crate::words::one_of;

/// Changes the motion on show, as one change that can be undone; the belt keeps its speed. Returns whether
/// anything differs.
pub fn change(session: &mut Session, problem: Problem) -> bool {
    put(session, Setup { problem, ..session.setup() })
}

/// Changes the setup, as one change that can be undone. Returns whether anything differs.
///
/// Of a fitted record, the numbers that a change by hand has moved are held; the fit of all others follows.
pub fn put(session: &mut Session, mut setup: Setup) -> bool {
    let before = session.setup();
    // A mark determines what is held.
    if session.scene.recording.is_some() && setup.doubt.held == before.doubt.held {
        for knob in Knob::MOTION {
            setup.doubt.held[knob as usize] |= setup.problem.get(knob) != before.problem.get(knob);
        }
    }
    if setup == before {
        return false;
    }
    let was_on = session.is_on_the_belt() == Some(true);
    session.history.record(EarlierState::Setup(Box::new(before)));
    session.set_setup(setup);
    if was_on && session.is_on_the_belt() == Some(false) {
        session.inform("off the belt: no speed has these numbers; the row belt leads back");
    }
    true
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
        Row::Number(knob) => return step_number(session, knob, count),
        Row::Tolerance => return turn(session, count.signum()),
        Row::Method => next_method(session, count.signum() as isize),
    }
    Ok(())
}

/// Steps a number, within its range. One of the machine leads back onto its belt; out of range it is refused: the
/// end of the range of speeds, far below that of any belt, would be no useful place to stop.
fn step_number(session: &mut Session, knob: Knob, count: i32) -> Done {
    let KnobSpec { symbol, min, max, .. } = *knob.spec();
    let value = session.value(knob);
    let wanted = session.steps.of(knob).from(value, count);
    let within = if knob.is_of_machine() {
        wanted
    } else {
        wanted.clamp(min, max)
    };
    let stepped = session.with(&session.setup(), knob, within)?;
    if put(session, stepped) {
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
    let differs = put(session, Setup { doubt, ..present });
    if differs {
        Ok(())
    } else {
        Err(format!("{knob} has no uncertainty"))
    }
}

/// Makes the step size of the selected row this many places larger.
pub fn step_size(session: &mut Session, by: i32) -> Done {
    let row = session.selected;
    let knob = row.stepped().ok_or_else(|| format!("{} has no step size", row.name()))?;
    *session.steps.of_mut(knob) = session.steps.of(knob).moved(by);
    Ok(())
}

/// Resets the selected row to the scene's value and step size.
pub fn reset_row(session: &mut Session) {
    let row = session.selected;
    let (of_scene, mut reset) = (Setup::of_scene(&session.scene), session.setup());
    match row {
        Row::Method => reset.problem.method = of_scene.problem.method,
        Row::Tolerance => reset.problem = reset.problem.with_setting(of_scene.problem.setting()),
        Row::Number(knob) => {
            *session.steps.of_mut(knob) = StepSizes::of_scene(&session.scene).of(knob);
            let follows = session.scene.recording.is_some() && Knob::MOTION.contains(&knob);
            let half = if follows {
                0.0
            } else {
                of_scene.doubt.half_width(knob)
            };
            reset.doubt = reset.doubt.with_half_width(knob, half).unwrap_or(reset.doubt);
            if follows {
                reset.doubt.held[knob as usize] = false;
            } else {
                let value = session.value_in(&of_scene, knob);
                reset = session.with(&reset, knob, value).unwrap_or(reset);
            }
        }
    }
    if !put(session, reset) {
        session.inform(format!("{} has the scene's value", row.name_in(&session.problem)));
    }
}

/// Changes the accuracy to its next stop: draft, normal, fine, reference.
pub fn dial(session: &mut Session, finer: bool) -> Done {
    session.measuring = true;
    let quality = session.problem.next_quality(finer).ok_or_else(|| {
        let [coarsest, .., finest] = QUALITIES.map(|quality| quality.name);
        let (end, name) = if finer {
            ("finest", finest)
        } else {
            ("coarsest", coarsest)
        };
        format!("the accuracy is at its {end}, {name}")
    })?;
    change(session, session.problem.at(quality));
    let (knob, setting) = (session.problem.method.dial(), shortest(session.problem.setting()));
    session.inform(format!("{}: {knob} {setting}; {}", quality.name, quality.meaning));
    Ok(())
}

/// Multiplies the number that sets the accuracy by a power of ten.
fn turn(session: &mut Session, decades: i32) -> Done {
    let knob = session.problem.method.dial();
    let KnobSpec { min, max, .. } = *knob.spec();
    let exponent = log10(session.problem.setting()).round() + f64::from(decades);
    // Parsed, because the power of ten must be exact to the last bit, which powi does not guarantee.
    let setting = format!("1e{exponent}").parse().unwrap_or(max).clamp(min, max);
    let turned = session.problem.with_setting(setting);
    if change(session, turned) {
        Ok(())
    } else {
        Err(knob.at_end(setting))
    }
}

/// Selects the next method of the list, cycling.
pub fn next_method(session: &mut Session, by: isize) {
    // Without a closed form, that method could only give up.
    let Parameters { d2, d3, .. } = session.problem.parameters;
    let nonlinear = d2 != 0.0 || d3 != 0.0;
    let whole = session.draws_whole();
    let usable = |row: &&MethodSpec| match row.method {
        method if whole => method.follows_machines(),
        method => !(nonlinear && method == Method::Exact),
    };
    let rows: Vec<_> = METHODS.iter().filter(usable).collect();
    let at = rows.iter().position(|row| row.method == session.problem.method).unwrap_or(0);
    let row = rows[cycled(at, by, rows.len())];
    session.measuring = true;
    change(session, Problem { method: row.method, ..session.problem });
    session.inform(format!("{}: {}", row.name, row.guarantee));
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
        if up.setup() == self.setup() {
            self.stepped(row, -1)
        } else {
            up
        }
    }

    /// Makes this setup the present one. There is a setting of the machine if and only if there is a machine; one with
    /// which there is no machine gives way to the present one.
    pub(crate) fn set_setup(&mut self, setup: Setup) {
        let Setup { problem, others, setting, doubt } = setup;
        let scaled = self.scene.machine.clone();
        let built = |setting: Setting| {
            let machine = setting.on(&scaled.as_ref()?.machine).ok()?;
            Some((setting, Box::new(machine)))
        };
        let set = setting.and_then(built).or_else(|| self.setting.take().and_then(built));
        let own = || {
            let scaled = scaled.clone()?;
            Some((Setting::of_speed(scaled.machine.belt.belt_speed), scaled))
        };
        let units = |it: &Session| it.running().map(|running| running.reduced.units);
        let before = units(self);
        (self.setting, self.scaled) = set.or_else(own).unzip();
        // Kicks keep their metres, unless these are too many.
        if let Some((from, to)) = before.zip(units(self)) {
            let length = to.displacement / from.displacement;
            let kicks = self.kicks.in_units(length, to.velocity / from.velocity).checked();
            self.kicks = kicks.unwrap_or(self.kicks);
        }
        // The energy ledger has lines for each motion.
        if self.others.len() != others.len() {
            for plot in &mut self.plots {
                if plot.view == View::EnergyLedger && plot.framing != Framing::User {
                    plot.framing = Framing::Fitting;
                }
            }
        }
        (self.problem, self.others, self.doubt) = (problem, others, doubt);
    }
}

/// Opens the line with the value of the selected row.
pub fn edit(session: &mut Session) {
    let row = session.selected;
    let knob = row.knob_in(&session.problem);
    let text = typed(&session.setup(), row).unwrap_or_else(|| knob.print(session.value(knob)));
    session.overlay = Some(Overlay::Prompt(Prompt::of_row(row, text)));
}

/// Opens the line with the character that was typed.
pub fn begin(session: &mut Session, key: Key) {
    let text = key.typed().map(String::from).unwrap_or_default();
    session.overlay = Some(Overlay::Prompt(Prompt::of_row(session.selected, text)));
}

/// The setup with the typed value in a row. Fails with one line that says what is allowed.
pub fn read(session: &Session, setup: &Setup, row: Row, text: &str) -> Done<Setup> {
    let text = text.trim();
    let problem = match row {
        Row::Number(knob @ Knob::Disturbance) => {
            // In the unit of r, or with a unit of force.
            let value = if measured(text).is_ok_and(|read| read.dimension.is_some()) {
                Knob::DisturbingForce.parse(text)? / session.unit_of_force(setup)?
            } else {
                knob.parse(text)?
            };
            return session.with(setup, knob, value);
        }
        Row::Number(knob) => return number(session, setup, knob, text),
        Row::Method => {
            let method = one_of("method", text, METHODS.iter().map(|row| (row.name, row.method)))?;
            Problem { method, ..setup.problem }
        }
        Row::Tolerance => match QUALITIES.iter().find(|quality| quality.name == text) {
            Some(quality) => setup.problem.at(quality),
            None => setup.problem.with_setting(row.knob_in(&setup.problem).parse(text)?),
        },
    };
    Ok(Setup { problem, ..setup.clone() })
}

/// The setup with the typed number. A parameter, and a number of the machine to which one corresponds, may have
/// a tolerance; without one, it is known exactly.
fn number(session: &Session, setup: &Setup, knob: Knob, text: &str) -> Done<Setup> {
    let read = knob.parse_toleranced(text)?;
    let mut changed = session.with(setup, knob, read.middle.value)?;
    let half = read.half_width;
    changed.doubt = match symbol_of(knob) {
        Some(symbol) => {
            let scale = session.machine_of(&changed)?.scale(symbol);
            changed.doubt.with_half_width(symbol, half / scale)?
        }
        None if half == 0.0 && !knob.is_parameter() => changed.doubt,
        None if knob.is_of_machine() => {
            let such = "R, d1 and d3 have, all of them in a machine's file";
            return Err(format!("{knob} has no uncertainty here; {such}"));
        }
        None => changed.doubt.with_half_width(knob, half)?,
    };
    Ok(changed)
}
