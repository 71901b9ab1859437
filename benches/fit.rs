//! Fits and their gradients: `cargo bench --bench fit`.
//!
//! Gradients through the events by sensitivities of half swings, compared with forward differences; whole fits
//! of ten thousand samples and of a short record; and a step of a held number until all others have followed.

use divan::{Bencher, black_box};
use hopfscope::fit::{Question, R, Record, Runs, StartKind, UNKNOWNS, Way, estimate, following};
use hopfscope::numerics::random::Random;

fn main() {
    divan::main();
}

/// The unknowns of a motion, how it begins, and its duration in s.
type Motion = ([f64; UNKNOWNS], StartKind, f64);

/// omega0, offset, D, D2, D3, r, q0, and the time of release or the velocity: a decay to rest, and a long ringing.
const DECAY: Motion =
    ([10.0, 0.5, 0.02, 0.005, 0.0005, 0.15, 6.0, 0.3, 0.0, 0.0], StartKind::Release, 6.0);
const RINGING: Motion =
    ([31.4, 0.0, 0.0008, 0.0, 2e-5, 0.001, 6.0, 0.5, 0.0, 0.0], StartKind::Moving, 30.0);

/// A record of zeros.
fn zeros((_, _, seconds): Motion, samples: u32) -> Record {
    let at = |index: u32| seconds * f64::from(index) / f64::from(samples);
    let t: Vec<f64> = (0..samples).map(at).collect();
    let x = vec![0.0; t.len()];
    Record { t, x, ..Record::default() }
}

/// How a motion is followed.
fn way(with_derivatives: bool) -> Way {
    Way { with_derivatives, reach: 1e9, ..Way::default() }
}

fn record(motion: Motion, samples: u32) -> Record {
    let data = zeros(motion, samples);
    let mut chance = Random::new(1);
    let seen = data.compare(motion.1, &motion.0.into(), way(false)).expect("the motion stays");
    let x = seen.residuals.iter().map(|it| 0.01 * chance.normal() - it.value).collect();
    Record { t: data.t, x, ..Record::default() }
}

#[divan::bench(args = [("decay", DECAY), ("ringing", RINGING)])]
fn gradient_by_sensitivities(bencher: Bencher, (_, motion): &(&str, Motion)) {
    let data = zeros(*motion, 10_000);
    bencher.bench(|| data.compare(motion.1, black_box(&motion.0.into()), way(true)));
}

#[divan::bench(args = [("decay", DECAY), ("ringing", RINGING)])]
fn gradient_by_forward_differences(bencher: Bencher, (_, motion): &(&str, Motion)) {
    let data = zeros(*motion, 10_000);
    bencher.bench(|| {
        let mut moved = motion.0;
        let base = data.compare(motion.1, black_box(&moved.into()), way(false));
        let columns: Vec<_> = (0..moved.len())
            .map(|place| {
                let kept = moved[place];
                moved[place] += 1e-6 * kept.abs().max(1e-3);
                let column = data.compare(motion.1, black_box(&moved.into()), way(false));
                moved[place] = kept;
                column
            })
            .collect();
        (base, columns)
    });
}

#[divan::bench(args = [("decay", DECAY, 500), ("decay", DECAY, 10_000), ("ringing", RINGING, 10_000)])]
fn whole_fit(bencher: Bencher, (_, motion, samples): &(&str, Motion, u32)) {
    let record = record(*motion, *samples);
    bencher.bench(|| estimate(black_box(&record), &Question::default(), &|| false));
}

#[divan::bench(args = [("decay", DECAY, 2_000), ("decay", DECAY, 10_000)])]
fn step_of_a_held_number(bencher: Bencher, (_, motion, samples): &(&str, Motion, u32)) {
    let found = estimate(&record(*motion, *samples), &Question::default(), &|| false)
        .expect("a decay is understood");
    let step = found.p[R] + 2.0 * found.covariance.error(R);
    bencher.bench(|| {
        let runs = Runs::new(&|| false);
        let guess = following(&found, &[(R, black_box(step))]);
        found.task(&[R], &runs).solve_roughly(guess)
    });
}
