//! The whole model against an independent integration in twice the working precision: fixed Taylor steps, and
//! switching lines located by a dense scan of every step.

use super::follow_by_series;
use hopfscope::model::belt::FrictionLaw;
use hopfscope::model::{Belt, ContactState, Model, Phase};
use hopfscope::numerics::twofold::Twofold;

/// Order of the series.
const ORDER: usize = 26;

/// Length of a step, for which the last term is far below the last digit.
const STEP: f64 = 1.0 / 64.0;

/// Number of places examined in a step.
const SCAN: u32 = 40;

type Series = [Twofold; ORDER + 1];

const ZERO: Twofold = Twofold { high: 0.0, low: 0.0 };

fn two(value: f64) -> Twofold {
    Twofold::from(value)
}

fn sum(terms: impl Iterator<Item = Twofold>) -> Twofold {
    terms.fold(ZERO, |sum, term| sum + term)
}

/// The value of a polynomial at a time.
fn at(series: &Series, t: Twofold) -> Twofold {
    series.iter().rev().fold(ZERO, |sum, term| sum * t + *term)
}

/// `exp(x)` by its series at `x/4096`, followed by twelve squarings.
fn exp(x: Twofold) -> Twofold {
    let small = x.times(1.0 / 4096.0);
    let series = (1..=12).rev().fold(two(1.0), |sum, k| sum * small / two(f64::from(k)) + two(1.0));
    (0..12).fold(series, |power, _| power * power)
}

/// A machine with unit mass, stiffness and normal force, and `mu = kinetic + drop exp(-w/velocity)`.
#[derive(Clone, Copy, Debug)]
struct Machine {
    kinetic: f64,
    drop: f64,
    velocity: f64,
    held: f64,
    damping: f64,
    cubic: f64,
    guide: f64,
    speed: f64,
}

impl Machine {
    fn belt(&self) -> Belt {
        Belt {
            mass: 1.0,
            stiffness: 1.0,
            damping: self.damping,
            cubic_damping: self.cubic,
            normal_force: 1.0,
            friction: self.guide,
            belt_speed: self.speed,
            law: FrictionLaw::Stribeck {
                rest: self.kinetic + self.drop,
                kinetic: self.kinetic,
                velocity: self.velocity,
                exponent: 1.0,
                viscous: 0.0,
            },
            static_coefficient: Some(self.kinetic + self.drop + self.held),
            static_guide: None,
        }
    }

    fn falling(&self, slip: Twofold) -> Twofold {
        exp(slip / two(-self.velocity)).times(self.drop)
    }

    fn steady(&self) -> Twofold {
        two(self.kinetic) + self.falling(two(self.speed))
    }

    /// The series of x and y in a phase.
    fn series(&self, phase: Phase, x: Twofold, y: Twofold) -> (Series, Series) {
        let faster = phase == Phase::Above;
        let side = if faster { -1.0 } else { 1.0 };
        let slip = (two(self.speed) - y).times(side);
        let constant = two(side * self.kinetic) - self.steady() - two(phase.sign() * self.guide);
        let (mut xs, mut ys, mut fall) = ([ZERO; ORDER + 1], [ZERO; ORDER + 1], [ZERO; ORDER + 1]);
        let (mut square, mut cube) = (fall, fall);
        (xs[0], ys[0], fall[0]) = (x, y, self.falling(slip));
        for k in 0..ORDER {
            square[k] = sum((0..=k).map(|j| ys[j] * ys[k - j]));
            cube[k] = sum((0..=k).map(|j| square[j] * ys[k - j]));
            let mut rate = fall[k].times(side) - xs[k];
            rate = rate - ys[k].times(self.damping) - cube[k].times(self.cubic);
            rate = if k == 0 { rate + constant } else { rate };
            let count = two(f64::from(u32::try_from(k + 1).unwrap()));
            xs[k + 1] = ys[k] / count;
            ys[k + 1] = rate / count;
            let products = (0..=k).map(|j| {
                let order = f64::from(u32::try_from(k - j + 1).unwrap());
                fall[j] * ys[k - j + 1].times(order)
            });
            // The slip decreases as the velocity rises, or increases with it.
            fall[k + 1] = sum(products).times(side) / two(self.velocity) / count;
        }
        (xs, ys)
    }

    /// The state of contact of the mass at a place, from the forces there.
    fn place(&self, x: Twofold, on_belt: bool) -> ContactState {
        if !on_belt {
            return if x.value().abs() <= self.guide {
                ContactState::Rests
            } else {
                ContactState::Slips(if x.value() > 0.0 {
                    Phase::Below
                } else {
                    Phase::Between
                })
            };
        }
        let damper = self.speed * (self.damping + self.cubic * self.speed * self.speed);
        let needed = (x + self.steady()).value() + damper + self.guide;
        let held = self.kinetic + self.drop + self.held;
        // A release is exactly at the end of the band.
        if needed >= held - 1e-14 {
            ContactState::Slips(Phase::Between)
        } else if needed < -held {
            ContactState::Slips(Phase::Above)
        } else {
            ContactState::Sticks
        }
    }

    /// Place and time at which each phase of a motion begins, up to a time.
    fn legs(&self, x: f64, y: f64, until: f64) -> Vec<(ContactState, f64, f64)> {
        let (mut x, mut y, mut t) = (two(x), two(y), ZERO);
        let mut place = match y.value() {
            0.0 => self.place(x, false),
            y if y < 0.0 => ContactState::Slips(Phase::Below),
            y if y < self.speed => ContactState::Slips(Phase::Between),
            _ => ContactState::Slips(Phase::Above),
        };
        let mut legs = Vec::new();
        while t.value() < until {
            legs.push((place, t.value(), x.value()));
            match place {
                ContactState::Rests => break,
                ContactState::Sticks => {
                    let damper = two(self.damping) + two(self.cubic * self.speed).times(self.speed);
                    let release = two(self.kinetic + self.drop + self.held)
                        - damper.times(self.speed)
                        - two(self.guide)
                        - self.steady();
                    t = t + (release - x) / two(self.speed);
                    (x, y, place) = (release, two(self.speed), ContactState::Slips(Phase::Between));
                }
                ContactState::Slips(phase) => loop {
                    let (xs, ys) = self.series(phase, x, y);
                    if let Some((time, level)) = self.first_line(phase, &ys) {
                        (x, y, t) = (at(&xs, time), two(level), t + time);
                        place = self.place(x, level != 0.0);
                        break;
                    }
                    let step = two(STEP);
                    (x, y, t) = (at(&xs, step), at(&ys, step), t + step);
                    if t.value() > until {
                        break;
                    }
                },
            }
        }
        legs
    }

    /// The first line that a step meets after its start, by a dense scan.
    fn first_line(&self, phase: Phase, ys: &Series) -> Option<(Twofold, f64)> {
        let levels: &[f64] = match phase {
            Phase::Below => &[0.0],
            Phase::Between => &[0.0, self.speed],
            Phase::Above => &[self.speed],
        };
        let middle = match phase {
            Phase::Below => -1.0,
            Phase::Between => 0.5 * self.speed,
            Phase::Above => self.speed + 1.0,
        };
        for part in 1..=SCAN {
            let time = STEP * f64::from(part) / f64::from(SCAN);
            let y = at(ys, two(time));
            for level in levels {
                let beyond = (y - two(*level)).value();
                if beyond * (middle - level) < 0.0 {
                    let (mut low, mut high) = (two(time - STEP / f64::from(SCAN)), two(time));
                    for _ in 0..100 {
                        let half = (low + high).times(0.5);
                        let side = (at(ys, half) - two(*level)).value();
                        if side * (middle - level) < 0.0 {
                            high = half;
                        } else {
                            low = half;
                        }
                    }
                    return Some((high, *level));
                }
            }
        }
        None
    }
}

#[test]
fn phases_and_their_times_are_those_of_a_dense_scan_in_twice_the_precision() {
    let base = Machine {
        kinetic: 0.5,
        drop: 0.5,
        velocity: 0.5,
        held: 0.0,
        damping: 0.1,
        cubic: 0.0,
        guide: 0.0,
        speed: 1.5,
    };
    let machines = [
        base,
        Machine { held: 0.2, guide: 0.05, cubic: 0.03, speed: 0.7, ..base },
        // Fed by its damper, it overtakes the belt.
        Machine { damping: -0.3, guide: 0.02, speed: 0.6, ..base },
        Machine { kinetic: 0.3, drop: 0.0, held: 0.2, guide: 0.02, speed: 0.3, ..base },
    ];
    let starts = [(0.9, 0.0), (-1.7, 0.0), (0.2, 2.1), (-0.4, -0.8)];
    let (mut compared, mut sticks, mut overtakes) = (0, 0, 0);
    for machine in machines {
        let model = Model::new(&machine.belt()).unwrap();
        for (x, y) in starts {
            let until = 21.0;
            let motion = follow_by_series(&model, (x, y), until);
            let expected = machine.legs(x, y, until);
            assert_eq!(motion.legs.len(), expected.len(), "{machine:?} from {x}, {y}");
            for (leg, (place, t, x)) in motion.legs.iter().zip(expected) {
                assert_eq!(leg.place, place, "{machine:?} at {t}");
                let errors = ((leg.start.tau - t).abs(), (leg.start.q - x).abs());
                assert!(errors.0 < 1e-12 && errors.1 < 1e-12, "{machine:?} at {t}: {errors:?}");
                compared += 1;
                sticks += usize::from(place == ContactState::Sticks);
                overtakes += usize::from(place == ContactState::Slips(Phase::Above));
            }
        }
    }
    assert!(compared > 100 && sticks > 10 && overtakes > 5, "{compared} {sticks} {overtakes}");
}
