//! The limit cycles along D, the fold between them, and the same for a grid of D and r.
//!
//!     cargo run --example branch

use hopfscope::branch::{Points, branch};
use hopfscope::flow::{Limits, Problem, Reason};
use hopfscope::model::{Knob, Parameters};
use hopfscope::portrait::StartWindow;
use hopfscope::scan::{Measure, Scan, Spacing, Sweep};

fn main() -> Result<(), Reason> {
    let parameters = Parameters { d: 0.0, d2: 0.0, d3: 0.5, r: 0.1 };
    let range = (-1.0, 0.0);
    let found = branch(&parameters, Knob::D, range, Points::Even(50), 1e-10, &Limits::PATIENT)?;
    for special in &found.special {
        println!("{special:?}");
    }

    let sweep = |knob, from, to| Sweep::new(knob, (from, to), 3, Spacing::Even);
    let over = [sweep(Knob::D, -0.6, -0.2), sweep(Knob::R, 0.05, 0.2)];
    let over = over.into_iter().collect::<Result<_, _>>().expect("ranges that make sense");
    let problem = Problem { parameters, ..Problem::default() };
    let scan = Scan::new(problem, over, vec![Measure::Margin], StartWindow::default());
    let scan = scan.expect("the margin depends on both");
    for index in 0..scan.points() {
        let (inputs, row) = (scan.inputs(index), scan.row(index, &Limits::PATIENT)?);
        println!("{inputs:?}: {:?}", row.values);
    }
    Ok(())
}
