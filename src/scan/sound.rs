//! A motion as it sounds: its velocity, while a number of the oscillator or the machine may glide.
//!
//! What sounds is the velocity, to which the pressure beside a vibrating body is in proportion. The acceleration would jump
//! where the mass sticks and slips, and a jump has no place between samples. Each sample is the mean velocity over its
//! time, a difference of displacements: this weakens what is too high for the samples to show.

use std::f64::consts::TAU;
use std::ops::RangeInclusive;

use crate::flow::{Detail, Limits, Problem, Subject};
use crate::model::{ContactState, Reason, Result};
use crate::numerics::{real, truncated};
use crate::scan::Sweep;

/// Samples in a second.
pub const RATE: u32 = 48_000;

/// The pitch, in Hz, of an oscillator without units, near that of the open G string of a violin.
const PITCH: f64 = 220.0;

/// What is heard, in Hz.
pub const HEARD: RangeInclusive<f64> = 20.0..=20_000.0;

/// Number of samples after which a number that glides takes its next value, which is 1 ms.
const PIECE: usize = 48;

/// Points of the motion between the ends of a step: fewer would be heard below the last of 16 bits.
const POINTS: usize = 32;

/// What moves from its present state, the steady displacement that this counts from, and whether the mass rides on its belt.
type Place = (Subject, Option<f64>, bool);

/// What sounds.
#[derive(Clone, Debug, PartialEq)]
pub struct Sound {
    /// What moves, and from where.
    pub subject: Subject,
    /// The frequency, in Hz, at which the natural frequency is heard.
    pub pitch: f64,
    /// How long it lasts, in s.
    pub seconds: f64,
    /// A number that glides from the beginning to the end, with a value for each of the [pieces](Sound::pieces).
    pub glide: Option<Sweep>,
}

impl Sound {
    /// A motion for as long and as high as where nothing else is asked for: a machine that can be heard has its own pitch.
    ///
    /// # Errors
    /// [`Reason`] where a machine has no model.
    pub fn usual(subject: Subject) -> Result<Sound> {
        let own = subject.problem()?.1.map(|model| model.omega_0 / TAU);
        let pitch = own.filter(|own| HEARD.contains(own)).unwrap_or(PITCH);
        Ok(Sound { subject, pitch, seconds: 4.0, glide: None })
    }

    /// Number of values of a number that glides for so many seconds.
    pub fn pieces(seconds: f64) -> usize {
        truncated((seconds * f64::from(RATE) / real(PIECE)).round())
    }

    /// The mean velocity over each sample.
    ///
    /// # Errors
    /// Within how many seconds the motion ends, and why: it escapes, or could not be followed.
    pub fn velocities(&self, limits: &Limits) -> Result<Vec<f64>, (f64, Reason)> {
        let mut found = Vec::new();
        let mut from = (self.subject.clone(), None, false);
        for index in 0..Sound::pieces(self.seconds) {
            if let Some(glide) = &self.glide {
                // The command line has refused what the subject has not.
                drop(from.0.set(glide.symbol, glide.value(index)));
            }
            let end = real(found.len() + PIECE) / f64::from(RATE);
            found.extend(self.go_on(&mut from, limits).map_err(|why| (end, why))?);
        }
        Ok(found)
    }

    /// Follows the motion for a piece.
    fn go_on(&self, from: &mut Place, limits: &Limits) -> Result<Vec<f64>> {
        limits.go_on()?;
        let (subject, steady, rides) = from;
        if let (true, Some(belt)) = (*rides, subject.source.of_belt()) {
            // What rides on the belt takes on its speed.
            subject.motion.initial.v = belt.belt_speed;
        }
        let (problem, model) = subject.problem()?;
        let (omega_0, pull) = model.as_ref().map_or((1.0, 0.0), |it| (it.omega_0, it.pull));
        let step = TAU * self.pitch / (omega_0 * f64::from(RATE));
        let mut problem = Problem { until: step * real(PIECE), ..problem };
        // The spring is as long as before, wherever the steady position has gone.
        problem.initial.q += steady.replace(pull).unwrap_or(pull) - pull;
        let detail = Detail { samples_per_step: POINTS, ..Detail::default() };
        let motion = problem.followed(model.as_ref(), detail, limits);
        let end = motion.known_end()?;
        subject.motion.initial = end.state();
        *rides = motion.legs.last().is_some_and(|leg| leg.place == ContactState::Sticks);
        let at = |index: usize| motion.at(step * real(index)).map_or(end.q, |sample| sample.q);
        Ok((0..PIECE).map(|index| (at(index + 1) - at(index)) / step).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{Belt, FrictionLaw, Knob, Parameters, State, Tolerances};
    use crate::numerics::{atan, cos};
    use crate::scan::Spacing;

    /// The sound of an oscillator that starts at q = 1.
    fn sound(parameters: Parameters, pitch: f64, glide: Option<(f64, f64)>) -> Sound {
        let problem =
            Problem { parameters, initial: State { q: 1.0, v: 0.0 }, ..Problem::default() };
        let seconds = 1.0;
        let glide = glide
            .map(|ends| Sweep::new(Knob::D, ends, Sound::pieces(seconds), Spacing::Even).unwrap());
        Sound { subject: problem.into(), pitch, seconds, glide }
    }

    fn crossings(velocities: &[f64]) -> usize {
        velocities.windows(2).filter(|pair| pair[0] < 0.0 && pair[1] >= 0.0).count()
    }

    #[test]
    fn a_linear_oscillator_sounds_at_its_damped_frequency() {
        for (d, pitch) in [(0.0, 220.0), (0.001, 440.0), (-0.001, 9000.0), (0.6, 50.0)] {
            let linear = Parameters { d, d2: 0.0, d3: 0.0, r: 0.0 };
            let velocities = sound(linear, pitch, None).velocities(&Limits::PATIENT).unwrap();
            assert_eq!(velocities.len(), 48_000);
            let expected = pitch * (1.0 - d * d).sqrt();
            let found = real(crossings(&velocities));
            assert!((found - expected).abs() <= 1.0, "D = {d}: {found} of {expected}");
        }
    }

    #[test]
    fn each_sample_is_the_mean_velocity_of_the_closed_form() {
        let linear = Parameters { d: 0.0, d2: 0.0, d3: 0.0, r: 0.0 };
        let velocities = sound(linear, 100.0, None).velocities(&Limits::PATIENT).unwrap();
        let step = TAU * 100.0 / 48_000.0;
        for (index, found) in velocities.iter().enumerate() {
            let [from, to] = [index, index + 1].map(|at| cos(step * real(at)));
            assert!((found - (to - from) / step).abs() < 1e-7, "{index}: {found}");
        }
    }

    #[test]
    fn friction_brings_it_to_silence_and_an_escape_has_no_sound() {
        let braked = Parameters { d: 0.0, d2: 0.0, d3: 0.0, r: 0.1 };
        let velocities = sound(braked, 220.0, None).velocities(&Limits::PATIENT).unwrap();
        // The swings lose 2 r each: five half swings from 1.
        let heard = velocities.iter().rposition(|v| *v != 0.0).unwrap();
        assert!((real(heard) - 2.5 * 48_000.0 / 220.0).abs() <= 1.0, "{heard}");
        let escaping = Parameters { d: -0.1, d2: 0.5, d3: 0.0, r: 0.0 };
        let (when, why) = sound(escaping, 220.0, None).velocities(&Limits::PATIENT).unwrap_err();
        assert!(why == Reason::Escapes && when > 0.0 && when < 1.0, "{when}: {why}");
    }

    #[test]
    fn a_number_that_glides_leaves_no_jump() {
        let parameters = Parameters { d: 0.0, d2: 0.0, d3: 0.05, r: 0.0 };
        let found = sound(parameters, 220.0, Some((-0.05, 0.05)));
        let velocities = found.velocities(&Limits::PATIENT).unwrap();
        // |v'| is at most |q| + 2 D |v| + .., a little above the largest velocity.
        let most = velocities.iter().fold(0.0_f64, |most, v| most.max(v.abs()));
        let step = TAU * 220.0 / 48_000.0;
        for pair in velocities.windows(2) {
            assert!((pair[1] - pair[0]).abs() < 1.3 * step * most, "{pair:?}");
        }
    }

    /// A mass without a damper on a belt of 1 m/s that holds it more firmly than it pulls, once it has stuck.
    fn chatter(glide: Option<(f64, f64)>) -> Vec<f64> {
        let belt = Belt {
            mass: 1.0,
            stiffness: 1.0,
            normal_force: 1.0,
            belt_speed: 1.0,
            law: FrictionLaw::Constant { mu: 0.3 },
            static_coefficient: Some(0.8),
            ..Belt::default()
        };
        let seconds = 1.0;
        let glide = glide.map(|ends| {
            Sweep::new(Knob::BeltSpeed, ends, Sound::pieces(seconds), Spacing::Even).unwrap()
        });
        let start = (-0.5, 1.0);
        let subject = Subject::moving((&belt).into(), Tolerances::default(), start, 1.0);
        Sound { subject, pitch: 100.0, seconds, glide }.velocities(&Limits::PATIENT).unwrap()
    }

    #[test]
    fn a_mass_that_sticks_moves_with_its_belt_for_as_long_as_the_closed_form_says() {
        let velocities = chatter(None);
        // From -0.5 to 0.5 with the belt, then back on a circle around the steady position.
        let (ride, slip) = (1.0, TAU - 2.0 * atan(0.5));
        let rides = velocities.iter().filter(|v| (**v - 1.0).abs() < 1e-12).count();
        let share = real(rides) / 48_000.0;
        // At both ends of each ride a sample is shared.
        let shared = 2.0 * 100.0 * TAU / (ride + slip) / 48_000.0;
        assert!((share - ride / (ride + slip)).abs() < shared, "{share}");
        let lowest = velocities.iter().copied().fold(0.0, f64::min);
        assert!((lowest + 1.25_f64.sqrt()).abs() < 1e-3, "{lowest}");
    }

    #[test]
    fn what_sticks_follows_the_speed_of_its_belt() {
        let velocities = chatter(Some((1.0, 2.0)));
        let pieces = velocities.len() / PIECE;
        let mut rides = 0;
        for (index, piece) in velocities.chunks(PIECE).enumerate() {
            let speed = 1.0 + real(index) / real(pieces - 1);
            rides += piece.iter().filter(|v| (**v - speed).abs() < 1e-12).count();
            assert!(piece.iter().all(|v| *v < speed + 1e-9), "it overtakes at {speed}");
        }
        assert!(rides > 1000, "{rides}");
        let step = TAU * 100.0 / 48_000.0;
        let jump = velocities.windows(2).map(|it| (it[1] - it[0]).abs()).fold(0.0, f64::max);
        // The spring is never longer than the swing: |v'| <= sqrt(0.5^2 + 2^2).
        assert!(jump < 2.1 * step, "{jump}");
    }
}
