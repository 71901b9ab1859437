//! What a proof costs beside the plain computation: `cargo bench --bench proof`.
//!
//! The cases are those of three reference systems; both half swings of a case start at the same clearance.

use divan::{Bencher, black_box};
use hopfscope::flow::Limits;
use hopfscope::numerics::Interval;
use hopfscope::oscillator::{HalfPlane, Parameters};
use hopfscope::proof::cycles::prove;
use hopfscope::proof::enclose::enclose;
use hopfscope::proof::field::{Field, ParameterBox};
use hopfscope::proof::map::ReturnMap;
use hopfscope::proof::swing::{Start, swing};
use hopfscope::study::closings::STEP;
use hopfscope::study::cycle::cycles;
use hopfscope::study::half_map::{HalfMap, Length};

fn main() {
    divan::main();
}

/// D, D2, D3 in the frame of a half plane, and the clearance at which a half swing starts.
const SWINGS: [[f64; 4]; 3] =
    [[-0.2, -0.2, 0.5, 0.2848], [-0.3, 0.0, 0.5, 1.0584], [-0.2, 0.2, 0.5, 0.7933]];

/// Parameters with two cycles.
const CASES: [Parameters; 2] = [
    Parameters { d: -0.2, d2: 0.2, d3: 0.5, r: 0.1 },
    Parameters { d: -0.3, d2: 0.0, d3: 0.5, r: 0.1 },
];

#[divan::bench(args = [0, 1, 2])]
fn half_swing_plain(bencher: Bencher, case: usize) {
    let [d, d2, d3, z] = SWINGS[case];
    let mut map = HalfMap::new(HalfPlane { d, d2, d3 }, STEP);
    bencher.bench_local(|| map.swing(black_box(Length::new(z)), &Limits::PATIENT).is_ok());
}

#[divan::bench(args = [0, 1, 2])]
fn half_swing_certified(bencher: Bencher, case: usize) {
    let [a, b, c, z] = SWINGS[case].map(Interval::point);
    let field = Field { a: a.twice(), b, c };
    bencher.bench_local(|| swing(&field, &Start::at_rest(black_box(z)), false));
}

/// Existence, uniqueness, all bounds and the multiplier of the inner cycle, from a guess of ten digits.
#[divan::bench(args = [0, 1])]
fn one_cycle_enclosed(bencher: Bencher, case: usize) {
    let inner = cycles(&CASES[case], false, &Limits::PATIENT).unwrap().cycles[0];
    let guess = inner.clearance * (1.0 + 1e-10);
    let parameters = ParameterBox::from(&CASES[case]);
    bencher.bench_local(|| {
        let mut map = ReturnMap::new(&parameters);
        enclose(&mut map, black_box(guess), Interval::around(guess, 0.01 * guess), false)
    });
}

/// All cycles at all amplitudes, enclosed, without hints.
#[divan::bench(args = [0, 1])]
fn all_cycles_proved(bencher: Bencher, case: usize) {
    let parameters = ParameterBox::from(&CASES[case]);
    bencher.bench_local(|| prove(black_box(&parameters), &[]));
}

/// The search that the proof checks.
#[divan::bench(args = [0, 1])]
fn all_cycles_searched(bencher: Bencher, case: usize) {
    bencher.bench_local(|| cycles(black_box(&CASES[case]), false, &Limits::PATIENT).is_ok());
}
