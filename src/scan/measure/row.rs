//! The row of a point while it is computed, and the cells that the oscillator of the paper and machines fill alike.

use std::collections::{BTreeMap, BTreeSet};
use std::error::Error;

use super::table::CYCLES;
use super::{Conditions, Measure, Value};
use crate::flow::{Cost, Limits, Motion, Outcome, Result, Subject};
use crate::portrait::{Border, Cycle, Cycles, Margin, Portrait, Share, StartWindow};

/// What was measured at a point.
#[derive(Clone, Debug, PartialEq)]
pub struct ScanRow {
    /// The cells, one for each column of the measures.
    pub values: Vec<Value>,
    /// What could not be computed, and why.
    pub reason: Option<String>,
    /// What it cost.
    pub cost: Cost,
}

/// Why a computation gave no answer.
pub(super) type Failed = Box<dyn Error>;

/// A row that is being computed.
pub(super) struct Cells<'a> {
    pub subject: &'a Subject,
    measures: &'a [Measure],
    pub conditions: &'a Conditions,
    pub limits: &'a Limits<'a>,
    filled: BTreeMap<Measure, Vec<Value>>,
    /// What gave up, and why.
    pub reasons: Vec<String>,
    pub cost: Cost,
    /// The cycles of the oscillator, once they are known.
    pub known: Option<Cycles>,
    /// All motions, once they are known; of the oscillator for repeated kicks only.
    pub portrait: Option<Portrait>,
}

/// Fills the columns of these measures at a point, in their order. What could not be computed is [`Value::Nothing`],
/// and [`ScanRow::reason`] says why.
///
/// # Errors
/// [`Reason::Interrupted`](crate::model::Reason::Interrupted), and no other.
pub fn measure(
    subject: &Subject,
    measures: &[Measure],
    conditions: &Conditions,
    limits: &Limits,
) -> Result<ScanRow> {
    // Those with which each of them is computed.
    let mut wanted: BTreeSet<_> = measures.iter().map(|measure| measure.with()).collect();
    // Of a machine cycles and margin are one computation, on which repeated kicks rest.
    if subject.paper().is_none()
        && (wanted.remove(&Measure::Margin) || wanted.contains(&Measure::Repeated))
    {
        wanted.insert(Measure::Cycles);
    }
    let mut cells = Cells {
        subject,
        measures,
        conditions,
        limits,
        filled: BTreeMap::new(),
        reasons: Vec::new(),
        cost: Cost::default(),
        known: None,
        portrait: None,
    };
    for measure in wanted {
        limits.go_on()?;
        let computed = cells.compute(measure);
        limits.go_on()?;
        if let Err(why) = computed {
            cells.reasons.push(format!("{}: {why}", measure.spec().name));
        }
    }
    let columns = |measure: &Measure| {
        let mut filled = cells.filled.remove(measure).unwrap_or_default();
        filled.extend(measure.spec().unfilled().skip(filled.len()));
        filled
    };
    let values = measures.iter().flat_map(columns).collect();
    let reason = (!cells.reasons.is_empty()).then(|| cells.reasons.join("; "));
    Ok(ScanRow { values, reason, cost: cells.cost })
}

impl Cells<'_> {
    pub fn asks(&self, measure: Measure) -> bool {
        self.measures.contains(&measure)
    }

    /// Fills the columns of a measure, the first ones at least, if it is asked for.
    pub fn fill<V: Into<Value>, C: IntoIterator<Item = V>>(
        &mut self,
        measure: Measure,
        cells: impl FnOnce() -> C,
    ) {
        if self.asks(measure) {
            self.filled.insert(measure, cells().into_iter().map(Into::into).collect());
        }
    }

    /// How a motion ended, when and after how many half swings, and where it rests. Fails with why it was given up.
    pub fn motion(&mut self, found: &Motion) -> Result<()> {
        let (outcome, swings) = (found.outcome, Value::Count(found.crossings.len()));
        self.cost += found.cost;
        let ended = outcome.answered().map(|()| [outcome.tau().into(), swings]);
        let word = Value::Word(outcome.word());
        self.fill(Measure::Outcome, || {
            std::iter::once(word).chain(ended.iter().flatten().copied())
        });
        if let Outcome::Captured { tau, q } = outcome {
            self.fill(Measure::Rest, || [q, tau]);
        }
        outcome.answered()
    }

    /// The limit cycles, by amplitude.
    pub fn cycles(&mut self, cycles: &[Cycle]) {
        let each = || cycles.iter().take(CYCLES);
        self.fill(Measure::Cycles, || {
            let extremes = each().flat_map(|it| [it.q_min, it.q_max, it.v_min, it.v_max]);
            std::iter::once(Value::Count(cycles.len())).chain(extremes.map(Value::from))
        });
        self.fill(Measure::Multipliers, || {
            each().flat_map(|it| [Some(it.period), it.multiplier, Some(it.log_multiplier)])
        });
    }

    /// The edge of the basin, the kicks that it leaves, and how much it encloses.
    pub fn around_rest(&mut self, portrait: &Portrait) {
        let (conditions, margin) = (self.conditions, portrait.margin);
        self.fill(Measure::Border, || [Value::Word(portrait.border.name())]);
        self.margin(Measure::Margin, portrait.border, margin);
        self.margin(Measure::FromRest, portrait.border, margin);
        self.share(Measure::Stability, || {
            let StartWindow { q, v } = conditions.about(&portrait.model);
            portrait.rest_share(q, v)
        });
        self.share(Measure::Lost, || conditions.kicks.lost(portrait).ok());
        self.fill(Measure::Area, || portrait.area());
        self.fill(Measure::Integrity, || [portrait.inner_radius(), portrait.integrity()]);
    }

    /// A margin, of this measure, within this border, and how it is to be read.
    pub fn margin(&mut self, measure: Measure, border: Border, margin: Margin) {
        let rest = margin.from_rest;
        let [displacement, impulse] = match measure {
            Measure::FromRest => [rest.displacement, rest.impulse],
            _ => [margin.displacement, margin.impulse],
        };
        let regime = Value::Word(margin.regime(border));
        self.fill(measure, || [displacement.into(), impulse.into(), regime]);
    }

    /// A fraction and its error, where it is known.
    fn share(&mut self, measure: Measure, share: impl FnOnce() -> Option<Share>) {
        self.fill(measure, || share().into_iter().flat_map(|it| [it.part, it.error]));
    }
}
