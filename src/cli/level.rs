//! `hopfscope level`: the curves over two numbers along which a column of a scan has a value.

use clap::Args;

use super::conditions::ConditionOptions;
use super::{QuestionOptions, Result, read};
use crate::report::level::level;
use crate::scan::{LevelTarget, Scan};

/// Points of each range on which curves are sought.
const LATTICE: usize = 24;

/// Largest distance between a curve and the chords of its points, as a part of the ranges.
const CHORD: f64 = 1e-3;

/// Follows the curves over two numbers along which a column of scan has a value
#[derive(Args)]
pub struct LevelCommand {
    /// A column of scan and its value, such as impulse=0.2
    #[arg(long, value_name = "COLUMN=VALUE", value_parser = LevelTarget::read)]
    of: LevelTarget,
    /// A number and its range, with log: before FROM for one of equal ratios; twice, the first one to the right
    #[arg(long, value_name = "NAME=FROM:TO", required = true)]
    over: Vec<String>,
    #[command(flatten)]
    conditions: ConditionOptions,
}

impl LevelCommand {
    pub fn run(&self, asked: &QuestionOptions) -> Result<()> {
        let numbers = asked.source.numbers()?;
        let over = |text: &String| read("--over", text, |text| numbers.range(text, LATTICE));
        let over = self.over.iter().map(over).collect::<Result<Vec<_>>>()?;
        if over.len() != 2 {
            return Err("a level curve goes over two numbers: --over twice".to_owned().into());
        }
        let measures = vec![self.of.measure];
        let (base, conditions) = self.conditions.of(&asked.source, &measures)?;
        let scan = Scan::new(base, over, measures, conditions)?;
        let limits = asked.output.limits();
        let follow = || scan.curves(self.of, CHORD, &limits);
        let timed = asked.output.timed("the curves could not be followed", follow)?;
        let about = asked.source.case()?.about();
        asked.output.print(level(about, &scan, self.of, &timed))
    }
}
