//! The program `hopfscope`: parse, run one command, turn an error into an exit code.

use std::process::ExitCode;

fn main() -> color_eyre::Result<ExitCode> {
    // For defects of the program only: what users do wrong is said in one line.
    color_eyre::install()?;
    Ok(hopfscope::cli::main())
}
