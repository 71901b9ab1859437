//! Cost of a machine by the whole model, compared with plain time stepping: `cargo bench --bench belt`.
//!
//! The case is the open benchmark of basin stability (Stribeck friction on a belt): the fate of a start, a
//! portrait with all cycles, and the share of a window. The comparison integrates the same motion with a fixed
//! step and sticks where the velocity crosses that of the belt. It is merely plausible, but it is the obvious
//! approach.

use divan::Bencher;
use divan::black_box;
use hopfscope::flow::{Detail, Limits, Method, Problem};
use hopfscope::model::belt::FrictionLaw;
use hopfscope::model::{Belt, Model, State};
use hopfscope::numerics::elementary::exp;
use hopfscope::portrait::Portrait;

fn main() {
    divan::main();
}

/// The oscillator of the benchmark at a belt speed of 1.5.
fn machine() -> Belt {
    Belt {
        mass: 1.0,
        stiffness: 1.0,
        damping: 0.1,
        cubic_damping: 0.0,
        normal_force: 1.0,
        friction: 0.0,
        belt_speed: 1.5,
        law: FrictionLaw::Stribeck {
            rest: 1.0,
            kinetic: 0.5,
            velocity: 0.5,
            exponent: 1.0,
            viscous: 0.0,
        },
        static_coefficient: None,
        static_guide: None,
    }
}

fn portrait() -> Portrait {
    Model::new(&machine())
        .ok()
        .and_then(|model| Portrait::of(&model).ok())
        .unwrap_or_else(|| unreachable!("the machine has a portrait"))
}

#[divan::bench]
fn fate_of_a_start(bencher: Bencher) {
    let found = portrait();
    bencher.bench_local(|| found.fate(black_box(-0.611), black_box(0.994)));
}

#[divan::bench]
fn all_cycles_and_the_border(bencher: Bencher) {
    bencher.bench_local(portrait);
}

#[divan::bench]
fn share_of_a_window(bencher: Bencher) {
    bencher.bench_local(|| portrait().rest_share(black_box((-2.5, 1.5)), black_box((0.0, 2.0))));
}

#[divan::bench]
fn motion_of_a_hundred_time_units(bencher: Bencher) {
    let model = portrait().model;
    let (method, tolerance) = (Method::Taylor, model.tolerance);
    let initial = State { q: 1.4, v: 0.0 };
    let problem = Problem { initial, until: 100.0, method, tolerance, ..Problem::default() };
    let detail = Detail { energy: true, ..Detail::default() };
    let follow = || black_box(problem).followed(Some(&model), detail, &Limits::PATIENT);
    bencher.bench_local(|| follow().end());
}

/// The same motion by the classical Runge-Kutta method with a fixed step of 1e-3.
fn stepped((mut x, mut v): (f64, f64), until: u32) -> (f64, f64) {
    let steady = 0.5 + 0.5 * exp(-3.0_f64);
    let slope = |x: f64, v: f64| {
        let slip: f64 = 1.5 - v;
        let pull = slip.signum() * (0.5 + 0.5 * exp(-2.0 * slip.abs()));
        (v, pull - 0.1 * v - x - steady)
    };
    let h = 1e-3;
    for _ in 0..1000 * until {
        if v == 1.5 && (x + steady + 0.15).abs() <= 1.0 {
            x += h * v;
            continue;
        }
        let k1 = slope(x, v);
        let k2 = slope(x + 0.5 * h * k1.0, v + 0.5 * h * k1.1);
        let k3 = slope(x + 0.5 * h * k2.0, v + 0.5 * h * k2.1);
        let k4 = slope(x + h * k3.0, v + h * k3.1);
        let next = v + h / 6.0 * (k1.1 + 2.0 * k2.1 + 2.0 * k3.1 + k4.1);
        x += h / 6.0 * (k1.0 + 2.0 * k2.0 + 2.0 * k3.0 + k4.0);
        v = if (v - 1.5) * (next - 1.5) < 0.0 { 1.5 } else { next };
    }
    (x, v)
}

#[divan::bench]
fn time_stepping_of_a_hundred_time_units(bencher: Bencher) {
    bencher.bench_local(|| stepped((black_box(1.4), black_box(0.0)), 100));
}

/// The decision as in the benchmark: by what is still moving after 400 time units. A cycle is found in the same
/// way, and a share from some thousand such starts.
#[divan::bench]
fn fate_of_a_start_by_time_stepping(bencher: Bencher) {
    bencher.bench_local(|| stepped((black_box(-0.611), black_box(0.994)), 400).1.abs() > 0.2);
}
