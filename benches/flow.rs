//! Cost of motions, cycles, basins and branches: `cargo bench`.
//!
//! W1 is the motion D = -0.1, D3 = 0.05, r = 0.1 from (3, 0) until tau = 200: 63 half swings.

use divan::{Bencher, black_box};
use hopfscope::branch::along::{Points, branch};
use hopfscope::flow::trajectory::trajectory;
use hopfscope::flow::{Detail, Limits, Method, Outcome, Problem};
use hopfscope::model::{Knob, Parameters, State};
use hopfscope::portrait::Portrait;
use hopfscope::portrait::basin::StartWindow;
use hopfscope::portrait::basin::cycle::cycles;

fn main() {
    divan::main();
}

/// Every method with the setting of its accuracy: tolerance, step or epsilon.
const METHODS_AND_DIALS: [(Method, f64); 26] = [
    (Method::Auto, 1e-4),
    (Method::Auto, 1e-8),
    (Method::Auto, 1e-12),
    (Method::Taylor, 1e-4),
    (Method::Taylor, 1e-8),
    (Method::Taylor, 1e-12),
    (Method::Taylor, 1e-15),
    (Method::Dop853, 1e-4),
    (Method::Dop853, 1e-8),
    (Method::Dop853, 1e-12),
    (Method::Dop853, 1e-15),
    (Method::Dopri5, 1e-4),
    (Method::Dopri5, 1e-8),
    (Method::Dopri5, 1e-12),
    (Method::Stiff, 1e-4),
    (Method::Stiff, 1e-8),
    (Method::Stiff, 1e-12),
    (Method::Rk4, 0.1),
    (Method::Rk4, 0.01),
    (Method::Rk4, 0.001),
    (Method::Smoothed, 1e-2),
    (Method::Smoothed, 1e-4),
    (Method::SignRk4, 0.01),
    (Method::SignRk4, 0.001),
    (Method::TimeStepping, 0.01),
    (Method::TimeStepping, 0.001),
];

fn w1(method: Method, dial: f64) -> Problem {
    let problem = Problem {
        parameters: Parameters { d: -0.1, d2: 0.0, d3: 0.05, r: 0.1 },
        initial: State { q: 3.0, v: 0.0 },
        until: 200.0,
        method,
        tolerance: 1e-8,
        ..Problem::default()
    };
    problem.with_setting(dial)
}

fn follow(bencher: Bencher, problem: Problem, detail: Detail) {
    bencher.bench(|| trajectory(black_box(&problem), detail, &Limits::PATIENT));
}

#[divan::bench(args = METHODS_AND_DIALS)]
fn w1_by(bencher: Bencher, (method, dial): (Method, f64)) {
    follow(bencher, w1(method, dial), Detail::default());
}

/// Far out, cubic damping is stiff: 15,000 units of time until the first arrival at v = 0.
#[divan::bench(args = [Method::Auto, Method::Stiff])]
fn far_out(bencher: Bencher, method: Method) {
    let problem = Problem {
        parameters: Parameters { d: -0.1, d2: 0.0, d3: 1.0, r: 0.1 },
        initial: State { q: 1e6, v: 0.0 },
        until: 20_000.0,
        ..w1(method, 1e-8)
    };
    follow(bencher, problem, Detail::default());
}

#[divan::bench]
fn w1_with_energy_ledger(bencher: Bencher) {
    follow(bencher, w1(Method::Taylor, 1e-12), Detail { energy: true, ..Detail::default() });
}

#[divan::bench]
fn w1_with_points_for_drawing(bencher: Bencher) {
    follow(
        bencher,
        w1(Method::Taylor, 1e-10),
        Detail { samples_per_step: 16, energy: true, crossings: true },
    );
}

/// As many half swings without cubic damping, in closed form.
#[divan::bench]
fn piecewise_linear_exact(bencher: Bencher) {
    let mut problem = w1(Method::Exact, 1e-12);
    problem.parameters.d = 0.0;
    problem.parameters.d3 = 0.0;
    problem.parameters.r = 0.01;
    follow(bencher, problem, Detail::default());
}

/// Both cycles for the parameters of the reference values, with their multipliers.
#[divan::bench]
fn two_cycles(bencher: Bencher) {
    let parameters = Parameters { d: -0.2, d2: 0.2, d3: 0.5, r: 0.1 };
    bencher.bench(|| cycles(black_box(&parameters), &Limits::PATIENT));
}

/// The single cycle of a piecewise linear oscillator with slight asymmetry.
#[divan::bench]
fn one_cycle(bencher: Bencher) {
    let parameters = Parameters { d: -0.2, d2: 0.3, d3: 0.0, r: 0.5 };
    bencher.bench(|| cycles(black_box(&parameters), &Limits::PATIENT));
}

/// The basin of 320 by 384 starts, by ordering.
#[divan::bench]
fn basin_by_ordering(bencher: Bencher) {
    let parameters = Parameters { d: -0.2, d2: 0.2, d3: 0.5, r: 0.1 };
    let window = StartWindow { q: (-6.0, 6.0), v: (-6.0, 6.0) };
    bencher.bench(|| {
        let found = Portrait::of_oscillator(black_box(&parameters), 6.0, &Limits::PATIENT).unwrap();
        found.count(&window, (320, 384), &Limits::PATIENT)
    });
}

/// The same basin by brute force, for only 32 by 38 starts: a hundredth of them.
#[divan::bench(sample_count = 3)]
fn basin_by_brute_force_one_start_in_a_hundred(bencher: Bencher) {
    let parameters = Parameters { d: -0.2, d2: 0.2, d3: 0.5, r: 0.1 };
    bencher.bench(|| {
        let place = |index: u32, count: u32| -6.0 + 12.0 * f64::from(index) / f64::from(count - 1);
        let starts = (0..32 * 38).map(|index| (place(index % 32, 32), place(index / 32, 38)));
        let captured = |&(q, v): &(f64, f64)| {
            let problem = Problem {
                parameters,
                initial: State { q, v },
                until: 200.0,
                method: Method::Taylor,
                tolerance: 1e-8,
                ..Problem::default()
            };
            let motion = trajectory(&problem, Detail::default(), &Limits::PATIENT);
            matches!(motion.outcome, Outcome::Captured { .. })
        };
        starts.filter(captured).count()
    });
}

/// From D = -0.95 through the fold and back, 400 points to 1e-10.
#[divan::bench(sample_count = 20)]
fn branch_through_the_fold(bencher: Bencher) {
    let parameters = Parameters { d: 0.0, d2: 0.2, d3: 0.5, r: 0.1 };
    bencher.bench(|| {
        branch(
            black_box(&parameters),
            Knob::D,
            (-0.95, 0.0),
            Points::Even(400),
            1e-10,
            &Limits::PATIENT,
        )
    });
}
