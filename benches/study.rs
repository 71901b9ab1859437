//! Cost of questions about many cycles, compared with the simplest independent method: `cargo bench --bench study`.
//!
//! The simplest methods are: for all cycles, a dense scan of the return map with Newton's method at each sign
//! change; for a fold, the top of the graph `D(u)`; for a border, one such fold after the other.

use divan::{Bencher, black_box};
use hopfscope::branch::along::{Points, branch};
use hopfscope::branch::chart::{Plane, Resolution, chart};
use hopfscope::branch::fold::{border, fold};
use hopfscope::branch::fold_graph::highest_cycle;
use hopfscope::flow::{Limits, Problem};
use hopfscope::model::{Knob, Parameters};
use hopfscope::numerics::elementary::ln;
use hopfscope::portrait::basin::StartWindow;
use hopfscope::portrait::basin::cycle::cycles;
use hopfscope::portrait::closing::all::STEP;
use hopfscope::portrait::closing::equation::{Equation, Route};
use hopfscope::runtime::scanning::rows;
use hopfscope::scan::grid::Scan;
use hopfscope::scan::measure::Measure;
use hopfscope::scan::sweep::{Spacing, Sweep};

fn main() {
    divan::main();
}

const CASE: Parameters = Parameters { d: -0.2, d2: 0.2, d3: 0.5, r: 0.1 };

const LIMITS: &Limits = &Limits::PATIENT;

/// Values of D3 along a border, and their range.
const POINTS: usize = 100;
const RANGE: (f64, f64) = (0.1, 2.0);

#[divan::bench]
fn all_cycles() -> usize {
    cycles(black_box(&CASE), LIMITS).unwrap().cycles.len()
}

/// Without any guarantee: two cycles closer than the grid are missed.
#[divan::bench]
fn all_cycles_by_a_dense_scan() -> usize {
    const GRID: u32 = 400;
    let mut equation = Equation::new(black_box(&CASE), STEP, LIMITS);
    let mut at = |u: f64| equation.at(Route::Mixed, u).unwrap().node;
    let place = |index: u32| ln(0.1) + 3.0 * f64::from(index) / f64::from(GRID);
    let mut found = 0;
    let mut before = at(place(0));
    for index in 1..=GRID {
        let here = at(place(index));
        if (before.value > 0.0) != (here.value > 0.0) && here.value.is_finite() {
            let mut node = here;
            for _ in 0..6 {
                node = at(node.at - node.value / node.slope);
            }
            found += usize::from(node.value.abs() < 1e-12);
        }
        before = here;
    }
    found
}

#[divan::bench]
fn one_fold() -> Option<f64> {
    fold(black_box(&CASE), LIMITS).unwrap().0.map(|fold| fold.d)
}

#[divan::bench]
fn one_fold_by_its_graph() -> f64 {
    highest_cycle(black_box(&CASE), 1e-13, LIMITS).0.unwrap().0.d
}

#[divan::bench]
fn a_border() -> usize {
    border(black_box(&CASE), Knob::D3, RANGE, POINTS, LIMITS).unwrap().points.len()
}

#[divan::bench(sample_count = 10)]
fn a_border_by_graphs() -> f64 {
    let step = (RANGE.1 - RANGE.0) / 99.0;
    let folds = (0..100).map(|index| {
        let parameters = Parameters { d3: RANGE.0 + step * f64::from(index), ..CASE };
        highest_cycle(&parameters, 1e-13, LIMITS).0.unwrap().0.d
    });
    folds.sum()
}

/// Regimes over D and D3, and over r and D3, as in the scenes.
#[divan::bench(args = [Knob::D, Knob::R])]
fn a_chart(bencher: Bencher, right: Knob) {
    let right_range = if right == Knob::D { (-0.9, 0.2) } else { (0.0, 0.5) };
    let plane = Plane { right, up: Knob::D3, right_range, up_range: (0.02, 2.0) };
    let resolution = Resolution { lines: 40, chord: f64::INFINITY, tolerance: 1e-13 };
    bencher.bench_local(|| chart(black_box(&CASE), plane, resolution, LIMITS).is_ok());
}

/// One of the branches of an overview, as in the scenes.
#[divan::bench(args = [0.0, 0.1])]
fn a_branch(bencher: Bencher, r: f64) {
    let parameters = Parameters { d2: 0.0, r, ..CASE };
    let (range, points) = ((-0.6, 0.4), Points::Even(160));
    bencher.bench_local(|| {
        branch(black_box(&parameters), Knob::D, range, points, 1e-10, LIMITS).is_ok()
    });
}

/// Twenty thousand points on all cores.
#[divan::bench(sample_count = 1, sample_size = 1)]
fn a_scan_of_margins_and_cycles() -> usize {
    let sweep = Sweep::new(Knob::D, (-0.95, 0.0), 20_000, Spacing::Even).unwrap();
    let window = StartWindow { q: (-1.0, 1.0), v: (-1.0, 1.0) };
    let problem = Problem { parameters: CASE, ..Problem::default() };
    let measures = vec![Measure::Margin, Measure::Cycles];
    let scan = Scan::new(problem, vec![sweep], measures, window).unwrap();
    let mut counted = 0;
    let mut count = |_, _| {
        counted += 1;
        std::ops::ControlFlow::Continue(())
    };
    rows(&scan, 0..scan.points(), None, 0, &|| false, &mut count).unwrap();
    counted
}
