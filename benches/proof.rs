//! Cost of a proof, compared with the plain computation: `cargo bench --bench proof`.
//!
//! The cases are those of three reference systems; both half swings of a case start at the same clearance.

use divan::{Bencher, black_box};
use hopfscope::flow::Limits;
use hopfscope::model::{HalfPlane, Knob, Parameters};
use hopfscope::numerics::Interval;
use hopfscope::portrait::basin::cycle::cycles;
use hopfscope::portrait::closing::all::STEP;
use hopfscope::portrait::closing::half_map::{HalfMap, Length};
use hopfscope::proof::bifurcation::enclose_fold;
use hopfscope::proof::enclose::enclose;
use hopfscope::proof::field::FieldBox;
use hopfscope::proof::map::ProvedMap;
use hopfscope::proof::swing::swing;
use hopfscope::proof::{ParameterBox, StartBox, prove};

fn main() {
    println!("{RECORDED}");
    divan::main();
}

/// Times in microseconds of a version handwritten in C for the processor of a similar machine (gcc 12, -O3
/// -march=native): recorded once, for comparison.
const RECORDED: &str = "\
recorded of a version in C: half swings 0, 1, 3 certified 8.0, 12.5, 3.0 us, plain 5.4, 9.9, 1.7 us;
one cycle with its multiplier 12 to 130 us; the count of cases 0, 1 at all amplitudes 700, 600 us";

/// D, D2, D3 in the frame of a half plane, and the clearance at which a half swing starts.
const SWINGS: [[f64; 4]; 4] = [
    [-0.2, -0.2, 0.5, 0.2848],
    [-0.3, 0.0, 0.5, 1.0584],
    [-0.2, 0.2, 0.5, 0.7933],
    [-0.1, 0.0, 0.0, 0.5387],
];

/// Parameters with two cycles.
const CASES: [Parameters; 2] = [
    Parameters { d: -0.2, d2: 0.2, d3: 0.5, r: 0.1 },
    Parameters { d: -0.3, d2: 0.0, d3: 0.5, r: 0.1 },
];

#[divan::bench(args = [0, 1, 2, 3])]
fn half_swing_plain(bencher: Bencher, case: usize) {
    let [d, d2, d3, z] = SWINGS[case];
    let mut map = HalfMap::new(HalfPlane { d, d2, d3 }, STEP);
    bencher.bench_local(|| map.swing(black_box(Length::new(z)), &Limits::PATIENT).is_ok());
}

#[divan::bench(args = [0, 1, 2, 3])]
fn half_swing_certified(bencher: Bencher, case: usize) {
    let [a, b, c, z] = SWINGS[case].map(Interval::point);
    let field = FieldBox { a: a.twice(), b, c };
    bencher.bench_local(|| swing(&field, &StartBox::at_rest(black_box(z))));
}

/// Existence, uniqueness, all bounds and the multiplier of the inner cycle, from a guess of ten digits.
#[divan::bench(args = [0, 1])]
fn one_cycle_enclosed(bencher: Bencher, case: usize) {
    let inner = cycles(&CASES[case], &Limits::PATIENT).unwrap().cycles[0];
    let guess = inner.clearance * (1.0 + 1e-10);
    let parameters = ParameterBox::from(&CASES[case]);
    bencher.bench_local(|| {
        let map = ProvedMap::new(&parameters);
        enclose(&map, black_box(guess), Interval::around(guess, 0.01 * guess), false)
    });
}

/// The fold of case 0 in D, from a guess of twelve digits.
#[divan::bench]
fn fold_enclosed(bencher: Bencher) {
    let parameters = ParameterBox::from(&CASES[0]);
    let near = -0.172_784_103_072;
    bencher.bench_local(|| enclose_fold(&parameters, Knob::D, black_box(near), 0.415_541_875));
}

/// All cycles at all amplitudes, enclosed, without hints.
#[divan::bench(args = [0, 1])]
fn all_cycles_proved(bencher: Bencher, case: usize) {
    let parameters = ParameterBox::from(&CASES[case]);
    bencher.bench_local(|| prove(black_box(&parameters), &[]));
}

/// The search that the proof verifies.
#[divan::bench(args = [0, 1])]
fn all_cycles_searched(bencher: Bencher, case: usize) {
    bencher.bench_local(|| cycles(black_box(&CASES[case]), &Limits::PATIENT).is_ok());
}
