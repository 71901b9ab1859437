//! A machine, a mass on a belt in SI units: its cycles, the kick that it survives, and one motion at given times.
//!
//!     cargo run --example machine

use hopfscope::flow::{Detail, Limits, Problem, Reason};
use hopfscope::model::{Belt, Model, State, belt::FrictionLaw};
use hopfscope::portrait::Portrait;

fn main() -> Result<(), Reason> {
    let belt = Belt {
        mass: 2.0,
        stiffness: 800.0,
        damping: 3.0,
        cubic_damping: 40.0,
        normal_force: 60.0,
        friction: 1.5,
        belt_speed: 0.25,
        law: FrictionLaw::Polynomial { coefficients: vec![0.5, -0.6, 0.8] },
        static_coefficient: None,
        static_guide: None,
    };
    let model = Model::new(&belt)?;
    let portrait = Portrait::of(&model)?;
    for cycle in &portrait.cycles {
        println!("{}: {:.4} .. {:.4} m", cycle.kind(), cycle.q_min, cycle.q_max);
    }
    println!("smallest impulse that is not survived: {:?} N s", portrait.margin.impulse);

    let initial = State { q: 0.005, v: 0.0 };
    let problem = Problem { initial, until: 2.0, ..Problem::default() };
    let times = [0.0, 0.1, 0.2];
    let (motion, samples) =
        problem.at_times(Some(&model), &times, Detail::default(), &Limits::PATIENT);
    println!("{:?}", motion.outcome);
    for sample in samples.into_iter().flatten() {
        println!("t = {} s: x = {:.6} m, v = {:.6} m/s", sample.tau, sample.q, sample.v);
    }
    Ok(())
}
