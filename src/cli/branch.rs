//! `hopfscope branch` and `hopfscope border`: the limit cycles along a number, and where the basin changes its kind along
//! D, or along a number of a machine, while another one varies.

use clap::Args;
use rayon::prelude::*;

use super::cycles::outlines;
use super::input::{self, MACHINE};
use super::{CERTIFY, CommandCase, Output, QuestionOptions, Result, given, provable, read, timed};
use crate::branch::{
    Boundary, BoundaryPoint, BranchPoint, MachineBranch, Points, PortraitPoint, border, branch,
};
use crate::flow::{Limits, Problem};
use crate::model::{Belt, Knob, Source};
use crate::proof::bifurcation::{enclose_escape, enclose_fold};
use crate::proof::{ParameterBox, change_near, range};
use crate::report::{BorderProof, branch as report};
use crate::scan::{Spacing, Sweep};

/// Follows the limit cycles along a parameter, with folds and other special points
#[derive(Args)]
pub struct BranchCommand {
    #[arg(long, help = CERTIFY)]
    certify: bool,
    /// The parameter (D, D2, D3 or r, or a number of the machine), its range, and the number of points, which is
    /// approximate for D, D2, D3 and r
    #[arg(long, value_name = "NAME=FROM:TO:COUNT")]
    over: String,
    /// Adds the orbit of each cycle: N points evenly spaced in time over one period, both ends included
    #[arg(long, value_name = "N", value_parser = |text: &str| input::whole(text, 2..=1_000_000))]
    orbit: Option<usize>,
}

/// The ends of a range, the smaller first.
fn range_of(over: &Sweep) -> (f64, f64) {
    (over.from.min(over.to), over.from.max(over.to))
}

/// The cycles of a machine along a number, and the changes between its values.
fn followed(subject: &Source, over: &Sweep, limits: &Limits) -> Result<MachineBranch, String> {
    let (range, values) = ((over.from, over.to), (over.count, Some([].as_slice())));
    MachineBranch::along(subject, over.symbol, range, values, limits)
}

impl BranchCommand {
    pub fn run(&self, asked: &QuestionOptions) -> Result<()> {
        let (case, limits) = (asked.source.exact()?, asked.output.limits());
        let numbers = asked.source.numbers()?;
        let over = read("--over", &self.over, |text| numbers.over(text))?;
        let Sweep { symbol, count, .. } = over;
        let about = case.about().but(&[symbol]).told_as(asked.output.format());
        provable(self.certify, about.is_machine())?;
        let Some(problem) = case.described.subject.paper() else {
            let source = &case.described.subject.source;
            let (found, seconds) = timed(asked.output.repeat, || followed(source, &over, &limits));
            let found = found?;
            let answer = report::of_machine(&about, symbol, &found, seconds);
            // A value without an answer has a row, but no orbit.
            let orbits = self.orbit.map(|count| {
                let orbits = |PortraitPoint { value, found }: &PortraitPoint| match found {
                    Err(_) => vec![(*value, None)],
                    Ok(found) => {
                        let motion = &case.described.subject.motion;
                        outlines((*value, &found.cycles), motion, Some(&found.model), count)
                    }
                };
                found.points.iter().flat_map(orbits).collect()
            });
            return asked.output.print(answer.orbits("points", Some(symbol), orbits));
        };
        if !symbol.is_parameter() {
            let line = format!("cycles do not depend on {symbol}; allowed: D, D2, D3, r");
            return Err(line.into());
        }
        let (base, tolerance) = (&problem.parameters, problem.tolerance);
        let ends = range_of(&over);
        let follow = || branch(base, symbol, ends, Points::Even(count), tolerance, &limits);
        let (found, seconds) = asked.output.timed("the branch could not be completed", follow)?;
        let certified = self.certify.then(|| range(&ParameterBox::from(base), symbol, ends));
        let certified = certified.as_ref();
        let answer = report::branch(&about, &found, certified, tolerance, seconds);
        let orbits = self.orbit.map(|count| {
            let orbit = |BranchPoint { value, cycle }: &BranchPoint| {
                let at = Problem { parameters: base.with(symbol, *value), ..problem };
                (*value, cycle.orbit(&at, None, count, &limits))
            };
            found.pieces.iter().flatten().map(orbit).collect()
        });
        asked.output.print(answer.orbits("points", Some(symbol), orbits))
    }
}

/// Continues the fold `D_F` and the escape point `D_c` in a second parameter
#[derive(Args)]
pub struct BorderCommand {
    #[arg(long, help = CERTIFY)]
    certify: bool,
    /// The second parameter (D2, D3 or r, or a number of the machine), its range, and the number of values
    #[arg(long, value_name = "NAME=FROM:TO:COUNT")]
    over: String,
    /// The number of the machine along which changes are located, in place of D, its range, and the number of
    /// portraits between which they are sought (default: 60 belt speeds from a tenth of its own to three times)
    #[arg(long, value_name = "NAME=FROM:TO:COUNT", requires = "machine")]
    along: Option<String>,
}

impl BorderCommand {
    pub fn run(&self, asked: &QuestionOptions) -> Result<()> {
        let (case, limits) = (asked.source.exact()?, asked.output.limits());
        let numbers = asked.source.numbers()?;
        let over = read("--over", &self.over, |text| numbers.over(text))?;
        provable(self.certify, case.about().is_machine())?;
        let Some(Problem { parameters, .. }) = case.described.subject.paper() else {
            return self.of_machine(&case, &over, &asked.output);
        };
        let Sweep { symbol, count, .. } = over;
        // It is located along D and does not depend on the start of a motion.
        if !matches!(symbol, Knob::D2 | Knob::D3 | Knob::R) {
            return Err(format!(
                "the border is a value of D over another parameter, not over {symbol}: D2, D3 or r"
            )
            .into());
        }
        let range = range_of(&over);
        let follow = || border(&parameters, symbol, range, count, &limits);
        let (found, seconds) = asked.output.timed("the boundary could not be completed", follow)?;
        let certified = self.certify.then(|| enclosed(&found));
        let about = case.about().but(&[symbol]);
        asked.output.print(report::border(&about, &found, certified.as_deref(), seconds))
    }

    fn of_machine(&self, case: &CommandCase, over: &Sweep, output: &Output) -> Result<()> {
        let along = given("--along", self.along.as_ref(), |text| MACHINE.over(text))?;
        let subject = &case.described.subject.source;
        let own = |Belt { belt_speed, .. }: &Belt| {
            let (from, to) = (0.1 * belt_speed, 3.0 * belt_speed);
            Sweep { symbol: Knob::BeltSpeed, from, to, count: 60, spacing: Spacing::Even }
        };
        let along = along
            .or_else(|| subject.of_belt().map(own))
            .ok_or("a mode has no belt speed: along what? --along NAME=FROM:TO:COUNT")?;
        let [first, second] = [&along, over].map(|sweep| sweep.symbol);
        if first == second {
            return Err(format!("{second} is varied twice, by --along and by --over").into());
        }
        let limits = output.limits();
        let row = |index| {
            let value = over.value(index);
            Ok((value, followed(&subject.with(second, value)?, &along, &limits)?))
        };
        let follow = || (0..over.count).map(row).collect::<Result<Vec<_>, String>>();
        let (found, seconds) = timed(output.repeat, follow);
        let about = case.about().but(&[first, second]);
        output.print(report::border_of_machine(&about, (first, second), &found?, seconds))
    }
}

/// The fold and the escape point in D at each point of a border, enclosed.
fn enclosed(found: &Boundary) -> Vec<BorderProof> {
    let at = |point: &BoundaryPoint| {
        let parameters = found.parameters.with(found.second, point.value);
        let known = ParameterBox::from(&parameters);
        // Where two cycles do not merge smoothly, as at a grazing, only the change in the number of cycles can be
        // enclosed.
        let changes = |d: f64| change_near(&known, Knob::D, d);
        let fold = point.fold.and_then(|fold| {
            let clearance = fold.q_max - parameters.r;
            let met = enclose_fold(&known, Knob::D, fold.d, clearance).map(|met| met.value);
            met.or_else(|| changes(fold.d))
        });
        let escape =
            point.escape.and_then(|d| enclose_escape(&known, Knob::D, d).or_else(|| changes(d)));
        BorderProof::new(point, fold, escape)
    };
    found.points.par_iter().map(at).collect()
}
