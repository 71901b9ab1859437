//! `hopfscope fit`: the parameters of the oscillator from a recorded motion.

use std::cell::{LazyCell, RefCell};
use std::io::{self, IsTerminal};
use std::path::PathBuf;
use std::sync::Arc;

use clap::{ArgGroup, ArgMatches, Args};

use super::progress::{Outlet, StatusLine};
use super::{Caller, Failure, Output, Result, half_widths, input, parsed, timed, write};
use crate::figure::{self, Figure, FigureForm};
use crate::fit::{DRAWS, FitResult, Inertia, MarginQuestion, NoEstimate, Record, length_in_metres};
use crate::model::{DimensionalNumber, Knob, LENGTH, measured};
use crate::question::{OpenedRecord, record::RecordOptions};
use crate::report::fit as forms;
use crate::runtime::{bounded, provenance_file};
use crate::words::fit::signed;

/// Estimates omega0, offset, D, D2, D3 and r of a recorded motion, with errors, and the margin that follows
#[derive(Args)]
#[command(group = ArgGroup::new("written").args(["pictures", "report"]).multiple(true))]
pub struct FitCommand {
    /// Record: a column of times and one of displacements, as instruments write them
    file: PathBuf,
    #[command(flatten)]
    record: RecordOptions,
    /// Largest force that may act beside the kick, such as "0.5 N"; without --mass or --stiffness over the stiffness, as a
    /// length
    #[arg(long, value_name = "FORCE", value_parser = not_negative)]
    disturbance: Option<DimensionalNumber>,
    /// How much D, D2, D3 or r may change after the record, such as r=0.01 in its unit; repeatable
    #[arg(long, value_name = "NAME=HALFWIDTH", value_parser = input::half_width)]
    half_width: Vec<(Knob, f64)>,
    /// Probability with which the kicks of the statement are survived (default: 0.95)
    #[arg(long, value_name = "P", default_value_t = 0.95, hide_default_value = true,
          value_parser = |text: &str| Knob::Confidence.parse(text))]
    confidence: f64,
    /// Least number of draws from the estimate, for the distribution of the margin; a confidence above 0.975 takes more
    #[arg(long, value_name = "N", default_value_t = DRAWS, hide_default_value = true,
          value_parser = |text: &str| input::whole(text, 40..=1_000_000))]
    draws: usize,
    /// Also writes figures: record and residuals, damping over amplitude, phase plane, margin; the extension sets the
    /// format: .pdf, .svg, .png, .csv or .json
    #[arg(long = "output", value_name = "FILE", value_parser = input::figure_file)]
    pictures: Option<(PathBuf, FigureForm)>,
    /// Also writes the answer as a page to print and sign: numbers, what they rest on, figures, SHA-256 of the record
    #[arg(long, value_name = "FILE.html", value_parser = |text: &str| input::file(text, "a page", "html"))]
    report: Option<PathBuf>,
    /// Replaces the files if they hold something else
    #[arg(long, requires = "written")]
    force: bool,
    #[command(flatten)]
    pub output: Output,
}

fn not_negative(text: &str) -> Result<DimensionalNumber, String> {
    let read = measured(text)?;
    if read.value >= 0.0 {
        Ok(read)
    } else {
        Err(format!("{text:?} is negative"))
    }
}

/// Runs the command, for a caller in this process if there is one.
pub fn run(given: &ArgMatches, caller: Option<Caller>) -> Result<()> {
    let mut fit: FitCommand = parsed(given)?;
    fit.output.call = caller.map(|(call, _)| Arc::clone(call));
    fit.run()
}

impl FitCommand {
    pub fn run(&self) -> Result<()> {
        let bytes = bounded::bytes(&self.file)?;
        let fitted = self.fitted(&bytes)?;
        let provenance = provenance_file::of_process();
        // Contours of a figure take motions of their own: it is drawn once for both files.
        let drawn = LazyCell::new(|| Figure::of_fit(&fitted).from(provenance.clone()));
        if let Some((path, form)) = &self.pictures {
            let content = figure::file(&drawn, *form).map_err(Failure::Unanswered)?;
            write(path, &content, self.force)?;
        }
        if let Some(path) = &self.report {
            let pictures = figure::panels(&drawn);
            let source = provenance_file::source(&self.file, &bytes);
            let title = "Fit of a recorded motion";
            let page = forms::fit(&fitted).page(title, &pictures, &provenance, &[source]);
            write(path, page.as_bytes(), self.force)?;
        }
        self.output.print(forms::fit(&fitted))?;
        let broken = signed(&fitted).broken();
        broken.map_or(Ok(()), |line| Err(Failure::unanswered(&fitted.name, line)))
    }

    fn fitted(&self, bytes: &[u8]) -> Result<FitResult> {
        let name = self.file.display().to_string();
        let bad = |problem: String| Failure::from(format!("{name}: {problem}"));
        // What contradicts itself is not the fault of the file.
        self.record.question()?;
        let half_widths = half_widths(&self.half_width)?;
        let opened = self.record.opened(&self.file, bytes).map_err(bad)?;
        let (inertia, record) = (opened.metric(), &opened.record);
        let disturbance = self.disturbance.map_or(Ok(0.0), |it| disturbance(it, inertia, record));
        let disturbance = disturbance.map_err(bad)?;
        let FitCommand { draws, confidence, .. } = *self;
        let asked = MarginQuestion { draws, confidence, disturbance, half_widths, inertia };
        let place = if io::stderr().is_terminal() {
            Outlet::Line
        } else {
            Outlet::Nowhere
        };
        let line = RefCell::new(StatusLine::new(place));
        let report = |motions| line.borrow_mut().renew(|_| format!("fitting: {motions} motions"));
        let (found, seconds) =
            timed(self.output.repeat, || opened.estimated(&asked, &self.output.limits(), &report));
        line.borrow().end();
        let (estimate, margins) = found.map_err(|reason| match reason {
            NoEstimate::TooFew { .. } | NoEstimate::NotAlternating { .. } => {
                bad(reason.to_string())
            }
            _ => Failure::unanswered(&name, reason),
        })?;
        let OpenedRecord { name, record, .. } = opened;
        Ok(FitResult { seconds, ..FitResult::new(name, record, estimate, margins) })
    }
}

/// A disturbance in N, or without a mass or stiffness in the unit of the record.
fn disturbance(
    read: DimensionalNumber,
    inertia: Option<(Inertia, f64)>,
    record: &Record,
) -> Result<f64, String> {
    let refused = |problem: String| format!("--disturbance {problem}");
    match (inertia, read.dimension) {
        (Some(_), _) => read.in_unit("N").map_err(refused),
        (None, None) => Ok(read.value),
        (None, Some(LENGTH)) => {
            let unit = record.unit.as_deref().and_then(length_in_metres);
            let unknown = "is a length, but the file names no unit of length; give it with --unit";
            unit.map(|metres| read.value / metres).ok_or_else(|| refused(unknown.to_owned()))
        }
        _ => Err(refused(
            "in N takes --mass or --stiffness; without them it is the force over the stiffness, a length".to_owned(),
        )),
    }
}
