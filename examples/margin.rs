//! How large a kick is survived: one set of parameters, and the same for certain while they are known to a tenth only.
//!
//!     cargo run --example margin

use hopfscope::flow::{Limits, Reason};
use hopfscope::model::{Interval, Knob, ParameterBox, Parameters};
use hopfscope::portrait::Portrait;
use hopfscope::portrait::guarantee::oscillator::guaranteed;

fn main() -> Result<(), Reason> {
    let parameters = Parameters { d: -0.3, d2: 0.0, d3: 0.5, r: 0.1 };
    let portrait = Portrait::of_oscillator(&parameters, 0.0, &Limits::PATIENT)?;
    for cycle in &portrait.cycles {
        let kind = if cycle.stable { "stable" } else { "unstable" };
        println!("{kind} cycle: amplitude {:.6}, period {:.6}", cycle.q_max, cycle.period);
    }
    let nominal = portrait.margin.impulse;
    println!("smallest impulse that is not survived: {nominal:?}");

    let mut known = ParameterBox::from(&parameters);
    for (knob, value) in Knob::PARAMETERS.into_iter().zip(parameters.numbers()) {
        let tenth = 0.1 * value.abs();
        known.set(knob, Interval::new(value - tenth, value + tenth)).expect("within all ranges");
    }
    let disturbance = 0.01;
    match guaranteed(&known, disturbance, 0.0, &Limits::PATIENT)? {
        Ok((_, certain)) => {
            println!(
                "for certain, each number known to a tenth, a force of 0.01: {:?}",
                certain.impulse
            );
            assert!(certain.impulse < nominal);
        }
        Err(why) => println!("nothing is guaranteed: {why}"),
    }
    Ok(())
}
