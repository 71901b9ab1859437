//! `hopfscope cycles` and `hopfscope check`: every limit cycle, and whether a proof of them holds.

use std::path::PathBuf;

use clap::Args;

use super::{Failure, QuestionOptions, Result, input, print, timed, troubled, write};
use crate::accuracy::{HarmonicBalance, compare, ladder};
use crate::check::check;
use crate::closed_form::MOST;
use crate::flow::{Limits, Problem, Reason};
use crate::model::{Model, Parameters};
use crate::portrait::{Cycle, Cycles, cycles, proved};
use crate::proof::certificate::{certificate, text};
use crate::proof::{Proof, prove};
use crate::report::cycles::OrbitRow;
use crate::report::{boxed, certificate_table, cycles as report};
use crate::runtime::{bounded, provenance_file};

/// The harmonic balance with ever more harmonics, if asked for.
type Rungs = Option<Vec<HarmonicBalance>>;

/// The orbits of cycles at a value, as far as they close.
pub fn outlines(
    (value, cycles): (f64, &[Cycle]),
    problem: &Problem,
    model: Option<&Model>,
    count: usize,
) -> Vec<OrbitRow> {
    let orbit = |cycle: &Cycle| cycle.orbit(problem, model, count, &Limits::PATIENT);
    cycles.iter().map(|cycle| (value, orbit(cycle))).collect()
}

/// Finds every limit cycle, proves that there are no others, and names the border of the basin
#[derive(Args)]
pub struct CyclesCommand {
    /// Shows the harmonic balance beside the cycles: 1, 3, 5, .. up to N harmonics, and their errors
    #[arg(long, value_name = "N", value_parser = |text: &str| input::whole(text, 1..=MOST))]
    harmonics: Option<usize>,
    /// Writes the proof, step by step, for `hopfscope check`, and its provenance to FILE.provenance
    #[arg(long, value_name = "FILE")]
    certificate: Option<PathBuf>,
    /// Adds the orbit of each cycle: N points evenly spaced in time over one period, both ends included
    #[arg(long, value_name = "N", value_parser = |text: &str| input::whole(text, 2..=1_000_000))]
    orbit: Option<usize>,
    /// Replaces a file that holds something else
    #[arg(long, requires = "certificate")]
    force: bool,
}

impl CyclesCommand {
    pub fn run(&self, asked: &QuestionOptions) -> Result<()> {
        if let Some(case) = asked.source.portrayed()? {
            if self.harmonics.is_some() || self.certificate.is_some() {
                return Err("--harmonics and --certificate are not for machines".into());
            }
            // Fails where the friction law ends before all motions are known.
            let (found, seconds) = case.portrait(&asked.output, 0.0)?;
            let answer = report::of_machine(&case.about(), &found, seconds);
            let problem = case.described.subject.motion;
            let orbits = self
                .orbit
                .map(|count| outlines((0.0, &found.cycles), &problem, Some(&found.model), count));
            asked.output.print(answer.orbits("cycles", None, orbits))?;
            return found.incomplete().map_or(Ok(()), |stop| Err(troubled(stop)));
        }
        let known = asked.source.known()?;
        if !known.is_point() {
            if self.harmonics.is_some() || self.orbit.is_some() {
                let line =
                    "intervals of parameters: --harmonics and --orbit have no place for them";
                return Err(line.into());
            }
            let proof = prove(&known, &[]);
            self.certify(&proof)?;
            return asked.output.print(boxed(&proof));
        }
        let (problem, limits) = (asked.source.scene()?.problem, asked.output.limits());
        let (found, seconds) =
            timed(asked.output.repeat, || self.find(&problem.parameters, &limits));
        let (found, proof, rungs) = found?;
        self.certify(&proof)?;
        let answer = report::cycles(&found, Some(&proof), rungs.as_deref(), seconds);
        let orbits = self.orbit.map(|count| outlines((0.0, &found.cycles), &problem, None, count));
        asked.output.print(answer.orbits("cycles", None, orbits))
    }

    /// Writes the certificate, if asked for.
    fn certify(&self, proof: &Proof) -> Result<()> {
        let Some(path) = &self.certificate else { return Ok(()) };
        let failed = |why: String| Failure::unanswered("no certificate", why);
        let made = certificate(proof).map_err(failed)?;
        let text = text(&made).map_err(|error| failed(error.to_string()))?;
        check(&text).map_err(failed)?;
        write(path, text.as_bytes(), self.force)?;
        provenance_file::write(path, &provenance_file::of_process())
    }

    /// The cycles, their proof, and the harmonic balance if asked for.
    fn find(&self, parameters: &Parameters, limits: &Limits) -> Result<(Cycles, Proof, Rungs)> {
        let gave_up = |why: Reason| Failure::unanswered("the search gave up", why);
        let found = cycles(parameters, limits).map_err(&gave_up)?;
        let proof = proved(&found).map_err(|wrong| Failure::Unanswered(wrong.to_string()))?;
        let balance = |rung| compare(parameters, &found.cycles, rung, 0, limits);
        let convergence = |most| ladder(most).into_iter().map(balance).collect();
        let rungs = self.harmonics.map(convergence).transpose().map_err(gave_up)?;
        Ok((found, proof, rungs))
    }
}

/// Verifies, step by step, a certificate written by `cycles --certificate`
#[derive(Args)]
pub struct CheckCommand {
    /// The certificate
    file: PathBuf,
}

impl CheckCommand {
    pub fn run(&self) -> Result<()> {
        let text = bounded::text(&self.file)?;
        let refused = |why| format!("{}: refused, {why}", self.file.display());
        print(&certificate_table(&check(&text).map_err(refused).map_err(Failure::Unanswered)?))
    }
}
