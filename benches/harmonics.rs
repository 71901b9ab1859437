//! Cost of the harmonic balance: `cargo bench --bench harmonics`.

use divan::{Bencher, black_box};
use hopfscope::closed_form::harmonic::amplitudes;
use hopfscope::closed_form::harmonics::harmonic_cycle;
use hopfscope::model::Parameters;

fn main() {
    divan::main();
}

const HARMONICS: [usize; 4] = [3, 9, 31, 127];

fn balance(bencher: Bencher, parameters: Parameters, harmonics: usize) {
    let first = amplitudes(&parameters)[0];
    bencher.bench(|| harmonic_cycle(black_box(&parameters), &first, harmonics, &|| false));
}

/// D2 = 0: odd harmonics only.
#[divan::bench(args = HARMONICS)]
fn symmetric(bencher: Bencher, harmonics: usize) {
    balance(bencher, Parameters { d: -0.7, d2: 0.0, d3: 0.0, r: 0.1 }, harmonics);
}

/// The inner cycle of the reference values.
#[divan::bench(args = HARMONICS)]
fn asymmetric(bencher: Bencher, harmonics: usize) {
    balance(bencher, Parameters { d: -0.2, d2: 0.2, d3: 0.5, r: 0.1 }, harmonics);
}

/// No cycle exists: the branch ends at its fold.
#[divan::bench(args = HARMONICS)]
fn beyond_the_fold(bencher: Bencher, harmonics: usize) {
    balance(bencher, Parameters { d: -0.1727, d2: 0.2, d3: 0.5, r: 0.1 }, harmonics);
}
