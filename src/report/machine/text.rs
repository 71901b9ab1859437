//! The answer about a machine as readable text, and as rows of comma-separated values.

use super::expansion;
use crate::flow::machine::motion::MachineState;
use crate::flow::{Fate, MachineMotion};
use crate::model::belt::{Derivatives, FrictionLaw};
use crate::model::{Interval, Knob, Tolerances};
use crate::portrait::design::{FrictionNeeded, Kick};
use crate::portrait::guarantee::Uncertain;
use crate::portrait::{Course, CubicExpansion, Cycle, Margin, Portrait};
use crate::report::answer::{PLACES, interval};
use crate::report::cycle_numbers::NUMBERS;
use crate::report::cycles::{NO_CYCLE, known, machine_cycles};
use crate::report::margin::margin_table;
use crate::report::{About, Columns, Quantity, Table};
use crate::words::{significant, stability, with_unit};

/// A part of a window; `None` if it is not known.
pub type RestShare = Option<f64>;

/// The whole answer about a mass on a belt or a vibration mode.
pub struct MachineAnswer<'a> {
    pub about: &'a About,
    /// Displacement (m) and velocity (m/s) at the start.
    pub start: (f64, f64),
    pub course: Course,
    /// The fraction of the starts in a window from which the mass comes to rest, if asked for; of that `None` where motions
    /// from the window leave the range that is known.
    pub rest_share: Option<RestShare>,
    /// The friction needed for a margin, if asked for.
    pub design: Option<DesignAnswer>,
    /// `None` for a mode.
    pub on_belt: Option<OnBelt<'a>>,
    pub seconds: f64,
}

/// The part of the answer that only a mass on a belt has.
pub struct OnBelt<'a> {
    pub expansion: CubicExpansion,
    pub tolerances: &'a Tolerances,
    /// The kicks that are survived for certain, or why none is; `None` if not asked for.
    pub certain: Option<Result<Margin, Uncertain>>,
}

impl OnBelt<'_> {
    /// The numbers that are not known exactly, each with its interval in SI units.
    pub(super) fn uncertain(&self) -> Vec<(Knob, Interval)> {
        self.tolerances.intervals(&self.expansion.belt)
    }
}

/// The friction needed for a margin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DesignAnswer {
    /// The kick that is to be survived.
    pub kick: Kick,
    /// Its size: m for a displacement, N s for an impulse.
    pub wanted: f64,
    /// The friction needed, in N.
    pub needed: FrictionNeeded,
    /// Speed of the belt in m/s; `None` for a mode.
    pub at: Option<f64>,
    /// The friction that the machine has, in N.
    pub has: f64,
}

impl MachineAnswer<'_> {
    /// The numbers, the margins, the cycles, the motion, and what else was asked for.
    pub(super) fn text(&self) -> String {
        let portrait = &self.course.portrait;
        let known: String = known(portrait).into_iter().map(|line| line + "\n").collect();
        let mut out = format!("{}\n", self.about.heading(&[]));
        if let Some(OnBelt { expansion, .. }) = &self.on_belt {
            let mu = friction(&expansion.belt.law, &expansion.reduced.mu);
            out += &format!("{mu}\n\n{}", quantities(expansion, portrait));
        }
        if self.on_belt.as_ref().is_none_or(|belt| belt.certain.is_some()) {
            let (table, known) = margins(self);
            out += &format!("\n{table}{}", known.map(|line| line + "\n").unwrap_or_default());
        }
        out += &format!("\n{known}\n");
        let cycles = cycles(&portrait.cycles);
        out += &if cycles.is_empty() { NO_CYCLE.to_owned() } else { cycles.to_string() };
        out + &self.remarks().into_iter().map(|line| line + "\n").collect::<String>()
    }

    /// The motion, and what else was asked for, a line each.
    pub(super) fn remarks(&self) -> Vec<String> {
        let fate = fate(self.start, &self.course);
        let mut all: Vec<String> = fate.lines().map(str::to_owned).collect();
        all.extend(self.rest_share.map(|share| match share {
            Some(share) => format!("of the window, {} comes to rest", significant(share, 10)),
            None => "of the window, the part that comes to rest is not known: motions from its corners leave what \
                     is known"
                .to_owned(),
        }));
        let expansion = self.on_belt.as_ref().map(|belt| &belt.expansion);
        all.extend(expansion.map(|it| expansion::sentence(it, &self.course.portrait)));
        all.extend(self.design.as_ref().map(DesignAnswer::sentence));
        all
    }
}

impl DesignAnswer {
    /// The friction needed, in N; `None` if any suffices.
    pub(super) fn force(&self) -> Option<f64> {
        match self.needed {
            FrictionNeeded::Any => None,
            FrictionNeeded::Friction { r } | FrictionNeeded::Fold { r, .. } => Some(r),
        }
    }

    /// The answer in a sentence.
    pub(super) fn sentence(&self) -> String {
        let (name, unit) = match self.kick {
            Kick::Displacement => ("displacement", "m"),
            Kick::Impulse => ("impulse", "N s"),
        };
        let wanted = with_unit(self.wanted, PLACES, unit);
        let at = self.at.map(|v0| format!(" at v0 = {}", with_unit(v0, PLACES, "m/s")));
        let has = with_unit(self.has, PLACES, "N");
        let lead = format!("for a margin of {wanted} ({name}){}: ", at.unwrap_or_default());
        let force = self.force().map(|force| with_unit(force, 10, "N")).unwrap_or_default();
        lead + &match self.needed {
            FrictionNeeded::Any => {
                "any R suffices, however small; damping alone keeps it".to_owned()
            }
            FrictionNeeded::Friction { .. } => {
                format!("R = {force} is needed (the machine has {has})")
            }
            FrictionNeeded::Fold { below, .. } => format!(
                "R above {force} is needed (the machine has {has}); every kick is survived then, while just \
                 below the margin is {}",
                with_unit(below, PLACES, unit)
            ),
        }
    }
}

/// A number of the answer: a label, the dimensionless value, and the physical value with its SI unit.
struct QuantityRow {
    what: String,
    dimensionless: Option<f64>,
    physical: Option<f64>,
    unit: &'static str,
}

impl QuantityRow {
    fn pure(what: &str, value: Option<f64>) -> Self {
        QuantityRow { what: what.to_owned(), dimensionless: value, physical: None, unit: "" }
    }

    fn physical(what: &str, value: Option<f64>, unit: &'static str) -> Self {
        QuantityRow { what: what.to_owned(), dimensionless: None, physical: value, unit }
    }

    /// With its dimensionless value, of which the physical one is `scale` times as large.
    fn scaled(what: &str, value: Option<f64>, scale: f64, unit: &'static str) -> Self {
        let dimensionless = value.map(|value| value / scale);
        let unit = value.map_or("", |_| unit);
        QuantityRow { what: what.to_owned(), dimensionless, physical: value, unit }
    }
}

/// The columns of these numbers.
fn quantity_columns<'a>() -> Columns<'a, QuantityRow> {
    let physical = |row: &QuantityRow| Quantity::of(row.unit, PLACES).or("").text(row.physical);
    Columns::default()
        .word("what", |row: &QuantityRow| row.what.clone())
        .titled("")
        .number("dimensionless", Quantity::pure(10), |row| row.dimensionless)
        .file("physical", |row| row.physical)
        .text("physical", physical)
        .file("unit", |row| row.unit)
}

/// The single numbers that describe a mass on a belt.
fn rows(
    CubicExpansion { belt, reduced, .. }: &CubicExpansion,
    portrait: &Portrait,
) -> Vec<QuantityRow> {
    let (parameters, units) = (&reduced.parameters, &reduced.units);
    let Margin { displacement, impulse, from_rest } = portrait.margin;
    let (pure, scaled) = (QuantityRow::pure, QuantityRow::scaled);
    let velocity = impulse.map(|impulse| impulse / belt.mass);
    let held = belt.static_guide.unwrap_or(belt.friction) / belt.stiffness;
    vec![
        pure("D", Some(parameters.d)),
        pure("D2", Some(parameters.d2)),
        pure("D3", Some(parameters.d3)),
        scaled("friction r", Some(belt.friction), units.force, "N"),
        scaled("unit of displacement x0", Some(units.displacement), units.displacement, "m"),
        scaled("unit of time", Some(units.time), units.time, "s"),
        scaled("rests within +-", Some(held), units.displacement, "m"),
        scaled("sticks to the belt at", Some(belt.belt_speed), units.velocity, "m/s"),
        scaled("from rest: displacement", from_rest.displacement, units.displacement, "m"),
        scaled("from rest: impulse", from_rest.impulse, units.impulse, "N s"),
        scaled("margin: displacement", displacement, units.displacement, "m"),
        scaled("margin: impulse", impulse, units.impulse, "N s"),
        scaled("margin: velocity", velocity, units.velocity, "m/s"),
    ]
}

/// The table of these numbers.
pub(super) fn quantities(expansion: &CubicExpansion, portrait: &Portrait) -> Table {
    quantity_columns().table(rows(expansion, portrait))
}

/// The friction law at the belt speed.
pub(super) fn friction(law: &FrictionLaw, mu: &Derivatives) -> String {
    let Derivatives { value, first, second, third } = *mu;
    let from = match law {
        FrictionLaw::Table(spline) => format!(
            "the smoothest curve near {} points, {} away in the quadratic mean",
            spline.points(),
            significant(spline.missed(), 3)
        ),
        _ => law.name().to_owned(),
    };
    let number = |value| significant(value, PLACES);
    format!(
        "friction ({from}) at v0: mu = {}, mu' = {} s/m, mu'' = {} s^2/m^2, mu''' = {} s^3/m^3",
        number(value),
        number(first),
        number(second),
        number(third)
    )
}

/// The table of cycles.
pub(super) fn cycles(cycles: &[Cycle]) -> Table {
    machine_cycles(|cycle: &Cycle| Some(*cycle)).table(cycles.iter().copied())
}

/// The nominal margins, the guaranteed ones rounded down, and the uncertainties for which these hold.
pub(super) fn margins(answer: &MachineAnswer) -> (Table, Option<String>) {
    let certain = answer.on_belt.as_ref().and_then(|belt| Some((belt, belt.certain?)));
    let guaranteed = certain.and_then(|(_, found)| found.ok());
    let title = "smallest kick that is not survived";
    let nominal = answer.course.portrait.margin;
    let table = margin_table(title, answer.about.kicks(PLACES), nominal, guaranteed);
    let known = certain.map(|(belt, found)| match found {
        Ok(_) => format!("guaranteed for {}", allowed(belt)),
        Err(reason) => format!("nothing is guaranteed for {}: {reason}", allowed(belt)),
    });
    (table, known)
}

/// The numbers that are not known exactly, each with its interval.
pub(super) fn varying(belt: &OnBelt) -> Vec<String> {
    belt.uncertain().iter().map(interval).collect()
}

/// The largest force of a disturbance, if there is one.
pub(super) fn disturbance(belt: &OnBelt) -> Option<String> {
    let force = Some(belt.tolerances.disturbance).filter(|force| *force > 0.0);
    force.map(|force| with_unit(force, 12, "N"))
}

/// What the guaranteed margins allow for.
pub(super) fn allowed(belt: &OnBelt) -> String {
    let disturbance = disturbance(belt).map(|force| format!("disturbance {force}"));
    varying(belt).into_iter().chain(disturbance).collect::<Vec<_>>().join(", ")
}

/// How the motion ends, in a sentence.
fn fate((x, v): (f64, f64), course: &Course) -> String {
    let length = |x| with_unit(x, PLACES, "m");
    let from = format!("from x = {}, v = {}: ", length(x), with_unit(v, PLACES, "m/s"));
    let end = &course.motion.end;
    from + &match course.fate {
        Fate::Rest => {
            let place = course.rest.map_or_else(String::new, |x| format!(" at x = {}", length(x)));
            if course.motion.outcome == Fate::Rest {
                format!("comes to rest{place}, at t = {}", with_unit(end.t, PLACES, "s"))
            } else {
                format!("comes to rest{place}")
            }
        }
        Fate::Cycle(index) => {
            let cycle = &course.portrait.cycles[index];
            format!("ends on the {} cycle up to x = {}", cycle.kind(), length(cycle.q_max))
        }
        Fate::Neutral => "is periodic, one of a family".to_owned(),
        Fate::Moving => "still moves".to_owned(),
        Fate::Escapes => "grows without bound".to_owned(),
        Fate::Unknown(stop) => format!("is not known: {stop}"),
    } + &course.second.as_ref().map_or_else(String::new, |second| by(second, course))
}

/// The motion by the second method, compared with the first, in a sentence.
fn by(second: &MachineMotion, course: &Course) -> String {
    let MachineState { t, x, v } = course.motion.end;
    let lead = format!("\nby {} at {:e}: ", second.method, second.tolerance);
    lead + &match second.known_end() {
        Ok(end) => format!(
            "at t = {} x = {}, v = {}; Taylor series differ by {} and {}",
            with_unit(t, PLACES, "s"),
            with_unit(end.x, 12, "m"),
            with_unit(end.v, 12, "m/s"),
            with_unit((end.x - x).abs(), 2, "m"),
            with_unit((end.v - v).abs(), 2, "m/s"),
        ),
        Err(stop) => stop.to_string(),
    }
}

/// One row for each number, in SI units.
pub(super) fn csv(answer: &MachineAnswer) -> String {
    let portrait = &answer.course.portrait;
    let mut rows = Vec::new();
    if let Some(OnBelt { expansion, certain, .. }) = &answer.on_belt {
        rows.extend(self::rows(expansion, portrait));
        if let Some(certain) = certain {
            let Margin { displacement, impulse, from_rest } = certain.unwrap_or(Margin::ENDLESS);
            let physical = QuantityRow::physical;
            rows.extend([
                physical("guaranteed from rest: displacement", from_rest.displacement, "m"),
                physical("guaranteed from rest: impulse", from_rest.impulse, "N s"),
                physical("guaranteed: displacement", displacement, "m"),
                physical("guaranteed: impulse", impulse, "N s"),
            ]);
        }
    }
    for (index, cycle) in portrait.cycles.iter().enumerate() {
        let lead = format!("{} {} cycle {index}", stability(cycle.stable), cycle.kind());
        let shown = NUMBERS.iter().filter(|number| !number.title.is_empty());
        rows.extend(shown.map(|number| {
            let what = format!("{lead}: {}", number.physical_name());
            QuantityRow::physical(&what, (number.value)(cycle), number.unit)
        }));
    }
    let share = |share| QuantityRow::pure("rest share of the window", share);
    rows.extend(answer.rest_share.map(share));
    if let Some(designed) = &answer.design {
        rows.push(QuantityRow::physical("R for the margin", designed.force(), "N"));
    }
    quantity_columns().csv(rows)
}
