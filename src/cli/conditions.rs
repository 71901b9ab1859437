//! The options that say what the measures of a scan depend on beside the numbers that vary.

use clap::Args;

use super::input::{self, WINDOW};
use super::{Result, SourceOptions, given, half_widths, number};
use crate::flow::Subject;
use crate::model::Knob;
use crate::scan::{Conditions, Measure, Origin};

/// What measures depend on beside the numbers that vary.
#[derive(Args)]
pub struct ConditionOptions {
    /// Displacements and velocities of the starts of `stability`, `settling` and `finite-time` (default: -3:3,-3:3;
    /// none for a machine)
    #[arg(long, value_name = "QMIN:QMAX,VMIN:VMAX")]
    window: Option<String>,
    /// Measures the window's displacements from the relaxed spring of a machine instead of the steady position
    #[arg(long, requires_all = ["window", "machine"])]
    elongation: bool,
    /// The margin of `design`: a displacement, such as q=0.3, or an impulse, such as v=0.3; of a machine "2 mm" or
    /// "0.1 N s"
    #[arg(long, value_name = "MARGIN")]
    design: Option<String>,
    /// Bound on the disturbing force of `guaranteed`, in the units of r
    #[arg(long, value_name = "W")]
    disturbance: Option<String>,
    /// Half width of a parameter for `guaranteed`, such as r=0.01; repeatable. Of a machine --set takes it
    #[arg(long, value_name = "NAME=HALFWIDTH", value_parser = input::half_width, conflicts_with = "machine")]
    half_width: Vec<(Knob, f64)>,
    /// Random kicks of `lost` and `repeated`, mean and standard deviation; with uniform: before them, mean and
    /// half width (default: q=0+-1,v=0+-1; none for a machine)
    #[arg(long, value_name = "q=MEAN+-SPREAD,v=MEAN+-SPREAD")]
    kicks: Option<String>,
    /// Time at which the motions of `outcome`, `rest`, `settling` and `finite-time` stop (default: the scene's)
    #[arg(long, value_name = "T")]
    until: Option<String>,
}

impl ConditionOptions {
    /// What is measured, and what these measures depend on beside it.
    pub fn of(
        &self,
        source: &SourceOptions,
        measures: &[Measure],
    ) -> Result<(Subject, Conditions)> {
        let numbers = source.numbers()?;
        let until = number("--until", self.until.as_ref(), numbers.until)?;
        let window = given("--window", self.window.as_ref(), |text| numbers.window(text))?;
        let kicks = given("--kicks", self.kicks.as_ref(), |text| numbers.kicks(text))?;
        let disturbance = self.disturbance.as_ref();
        let disturbance = number("--disturbance", disturbance, numbers.disturbance)?;
        let wanted = given("--design", self.design.as_ref(), numbers.margin)?;
        let conditions = Conditions {
            origin: [Origin::Steady, Origin::Relaxed][usize::from(self.elongation)],
            kicks: kicks.unwrap_or_default(),
            wanted,
            ..window.unwrap_or(WINDOW).into()
        };
        let mut case = source.case()?;
        let Subject { tolerances, motion, .. } = &mut case.described.subject;
        motion.until = until.unwrap_or(motion.until);
        tolerances.disturbance = disturbance.unwrap_or(tolerances.disturbance);
        let half_widths = Knob::PARAMETERS.into_iter().zip(half_widths(&self.half_width)?);
        let wide = half_widths.filter(|(_, half_width)| *half_width > 0.0);
        tolerances.half_widths.extend(wide.map(|(knob, half)| (knob.to_string(), half)));
        let subject = case.checked()?.described.subject;
        let machine = subject.paper().is_none();
        for measure in measures.iter().filter(|_| machine) {
            let needs = match (measure.is_over_window(), measure.is_of_kicks()) {
                (true, _) if window.is_none() => "a --window",
                (_, true) if kicks.is_none() => "--kicks",
                _ => continue,
            };
            let name = measure.spec().name;
            return Err(format!("{name} of a machine needs {needs}").into());
        }
        Ok((subject, conditions))
    }
}
