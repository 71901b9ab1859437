//! Records of kinds that are hard to fit, by an integrator that shares nothing with the program: Runge and Kutta's
//! method, half swing by half swing.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use hopfscope::fit::{Record, Signal};
use hopfscope::numerics::elementary::{cos, exp, ln, powi, sin};
use hopfscope::numerics::random::Random;

/// A simulated record with its truth.
pub struct Simulation {
    /// omega0, offset, D, D2, D3, r.
    pub truth: [f64; 6],
    /// The largest displacement from the offset.
    pub amplitude: f64,
    /// What was recorded.
    pub record: Record,
    /// Whether the record is a list of turning points.
    pub peaks: bool,
}

/// The kinds of records.
pub const KINDS: [&str; 15] = [
    "coulomb",
    "release",
    "quant",
    "growth",
    "cycle",
    "heavy",
    "narrow",
    "clip",
    "few",
    "shorthold",
    "asymmetric",
    "filtered",
    "viscous",
    "peaks",
    "untimed",
];

/// Records of other signals.
pub const SIGNALS: [&str; 4] =
    ["velocity", "acceleration", "velocity in motion", "acceleration in motion"];

/// Records with a drift of the zero.
pub const DRIFTS: [&str; 3] = ["line", "parabola", "released line"];

/// D, D2, D3, r.
type Law = [f64; 4];

/// Velocity and acceleration with friction of sign `s`.
fn rate(law: &Law, s: f64, [q, v]: [f64; 2]) -> [f64; 2] {
    [v, -2.0 * law[0] * v - law[1] * v * v - law[2] * v * v * v - q - s * law[3]]
}

/// The state after a time `h` with friction of sign `s`.
fn stepped(law: &Law, s: f64, [q, v]: [f64; 2], h: f64) -> [f64; 2] {
    let rate = |state: [f64; 2]| rate(law, s, state);
    let add = |k: [f64; 2], h: f64| [q + h * k[0], v + h * k[1]];
    let one = rate([q, v]);
    let two = rate(add(one, 0.5 * h));
    let three = rate(add(two, 0.5 * h));
    let four = rate(add(three, h));
    [0, 1].map(|i| [q, v][i] + h / 6.0 * (one[i] + 2.0 * (two[i] + three[i]) + four[i]))
}

/// Displacements, velocities and accelerations at ascending times until the mass escapes, and the turning points as
/// times and displacements.
fn motion(law: &Law, start: [f64; 2], times: &[f64]) -> (Vec<[f64; 3]>, Vec<[f64; 2]>) {
    const STEP: f64 = 0.01;
    const FAR: f64 = 1e6;
    let (mut seen, mut turns) = (Vec::new(), Vec::new());
    let (mut at, mut t) = (start, 0.0);
    while seen.len() < times.len() && at[0].abs() < FAR {
        if at[1] == 0.0 && at[0].abs() <= law[3] {
            seen.resize(times.len(), [at[0], 0.0, 0.0]);
            break;
        }
        let s = if at[1] == 0.0 {
            -at[0].signum()
        } else {
            at[1].signum()
        };
        let turned = |h: f64| s * stepped(law, s, at, h)[1] <= 0.0;
        let mut h = STEP;
        let arrives = turned(h);
        if arrives {
            let mut low = 0.0;
            for _ in 0..60 {
                let middle = 0.5 * (low + h);
                if turned(middle) { h = middle } else { low = middle }
            }
        }
        while times.get(seen.len()).is_some_and(|time| *time <= t + h) {
            let [q, v] = stepped(law, s, at, times[seen.len()] - t);
            seen.push([q, v, rate(law, s, [q, v])[1]]);
        }
        (at, t) = (stepped(law, s, at, h), t + h);
        if arrives {
            at[1] = 0.0;
            turns.push([t, at[0]]);
        }
    }
    (seen, turns)
}

/// Random numbers for choices.
struct Chance(Random);

impl Chance {
    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.0.even()
    }

    /// Evenly distributed logarithm.
    fn log(&mut self, low: f64, high: f64) -> f64 {
        exp(self.between(ln(low), ln(high)))
    }

    /// Student's distribution with three degrees of freedom.
    fn heavy(&mut self) -> f64 {
        let squares: f64 = (0..3).map(|_| self.0.normal()).map(|it| it * it).sum();
        self.0.normal() / (squares / 3.0).sqrt()
    }
}

/// How a record of a kind is made.
struct Plan {
    law: Law,
    start: [f64; 2],
    noise: f64,
    /// Periods before the release.
    hold: f64,
    /// Periods recorded; the whole decay and some rest if it is none.
    periods: Option<f64>,
}

/// Record number `seed` of a kind.
pub fn simulated(kind: &str, seed: u64) -> Simulation {
    let mut chance =
        Chance(Random::new(seed.wrapping_mul(7919) ^ u64::from(kind.as_bytes()[1]) << 40));
    let a = chance.log(0.4, 18.0);
    let (omega0, offset) = (chance.log(8.0, 350.0), 0.2 * a * chance.0.normal());
    let Plan { law, start, noise, hold, periods } = planned(kind, a, &mut chance);
    if ["peaks", "untimed", "brief"].contains(&kind) {
        return listed(kind, a, [omega0, offset], &law, &mut chance);
    }
    let rate = chance.log(35.0, 90.0);
    let tail = chance.between(0.3, 2.3);
    let periods = periods.unwrap_or_else(|| {
        let end = motion(&law, start, &[4000.0]).1.last().map_or(0.0, |turn| turn[0] / TAU);
        end.min(200.0) + tail + hold
    });
    let step = TAU / omega0 / rate;
    let mut t = Vec::new();
    while step * f64::from(u32::try_from(t.len()).unwrap()) < periods * TAU / omega0 {
        t.push(step * f64::from(u32::try_from(t.len()).unwrap()));
    }
    let release = hold * TAU / omega0;
    let held = t.iter().filter(|t| **t < release).count();
    let times: Vec<f64> = t[held..].iter().map(|t| omega0 * (t - release)).collect();
    let mut seen = vec![[start[0], 0.0, 0.0]; held];
    seen.extend(motion(&law, start, &times).0);
    let signal = measured(kind);
    let order = signal.order();
    let unit = powi(omega0, i32::try_from(order).unwrap());
    let (a, offset, noise) = (unit * a, unit * offset, unit * noise);
    let drift = drift(kind, &t, a, noise, &mut chance);
    let memory = if kind == "filtered" {
        chance.between(0.3, 0.8)
    } else {
        0.0
    };
    let step = noise * chance.log(0.5, 5.0);
    let full = a * chance.between(0.5, 0.85);
    let mut error = 0.0;
    let read = |(index, seen): (usize, [f64; 3])| {
        let fresh = if kind == "heavy" {
            chance.heavy()
        } else {
            chance.0.normal()
        };
        error = memory * error + (1.0 - memory * memory).sqrt() * fresh;
        let x = offset + drift[index] + unit * seen[order] + noise * error;
        match kind {
            "quant" => (x / step).round() * step,
            "clip" => x.clamp(-full, full),
            _ => x,
        }
    };
    let x: Vec<f64> = seen.into_iter().enumerate().map(read).collect();
    let record = Record { t, x, signal, ..Record::default() };
    let a = a / unit;
    let truth = [omega0, offset, law[0], law[1], law[2], law[3]];
    Simulation { truth, amplitude: a, record, peaks: false }
}

fn planned(kind: &str, a: f64, chance: &mut Chance) -> Plan {
    let phase = TAU * chance.0.even();
    let moving = [a * cos(phase), a * sin(phase)];
    let at_rest = [if chance.0.even() < 0.5 { -a } else { a }, 0.0];
    let law = [chance.log(0.004, 0.05), 0.0, 0.0, a * chance.log(0.03, 0.15)];
    let noise = a * chance.log(0.003, 0.015);
    let released =
        Plan { law, start: at_rest, noise, hold: chance.between(0.4, 2.0), periods: None };
    let in_motion = Plan { start: moving, hold: 0.0, ..released };
    match kind {
        "growth" => {
            // Between an unstable cycle and a stable one of amplitude a.
            let d = -chance.log(0.03, 0.09);
            let d3 = -d / (0.375 * a * a) * chance.between(1.0, 1.1);
            let unstable = a * chance.log(0.05, 0.25);
            let r = unstable * FRAC_PI_2 * (-d - 0.375 * d3 * unstable * unstable);
            let law = [d, 0.03 * chance.0.normal() / a, d3, r];
            let start = [unstable * chance.log(1.05, 1.6), 0.0];
            let noise = a * chance.log(0.002, 0.012);
            let hold = chance.between(0.5, 3.0);
            Plan { law, start, noise, hold, periods: Some(chance.between(20.0, 45.0)) }
        }
        "cycle" => {
            let d = -chance.log(0.03, 0.09);
            let d3 = -d / (0.375 * a * a) * chance.log(1.0, 1.6);
            let law = [d, 0.05 * chance.0.normal() / a, d3, a * chance.log(0.005, 0.02)];
            let part = chance.log(0.5, 1.4);
            let periods = Some(chance.between(20.0, 40.0));
            Plan { law, start: moving.map(|it| part * it), periods, ..in_motion }
        }
        "narrow" => {
            let law = [chance.between(-0.015, 0.015), 0.0, 0.0, a * chance.log(0.004, 0.03)];
            let periods = Some(chance.between(3.0, 5.0));
            Plan { law, noise: a * chance.log(0.01, 0.03), periods, ..in_motion }
        }
        "few" => {
            let law = [law[0], 0.0, 0.0, a * chance.log(0.1, 0.25)];
            let hold = chance.between(0.4, 1.0);
            Plan {
                law,
                noise: 0.5 * noise,
                hold,
                periods: Some(hold + chance.between(1.0, 1.8)),
                ..released
            }
        }
        "shorthold" => {
            let law = [law[0], 0.0, 0.0, a * chance.log(0.008, 0.05)];
            Plan { law, hold: chance.between(0.03, 0.4), ..released }
        }
        "asymmetric" => {
            let lean = 0.12 * chance.0.normal().clamp(-1.5, 1.5) / a;
            let law = [law[0], lean, 0.05 * chance.0.normal().abs() / (a * a), law[3]];
            Plan { law, ..released }
        }
        "viscous" => {
            let law = [law[0], 0.0, 0.0, 0.002 * a];
            Plan { law, periods: Some(chance.between(8.0, 16.0)), ..in_motion }
        }
        "release" | "heavy" | "filtered" | "velocity" | "acceleration" | "released line" => {
            released
        }
        _ => in_motion,
    }
}

/// What a record of a kind measures.
fn measured(kind: &str) -> Signal {
    let name = kind.split(' ').next().unwrap_or_default();
    match name {
        "velocity" => Signal::Velocity,
        "acceleration" => Signal::Acceleration,
        _ => Signal::Displacement,
    }
}

/// A drift of the zero between three deviations of the noise and a fifth of the swing, about its mean.
fn drift(kind: &str, t: &[f64], a: f64, noise: f64, chance: &mut Chance) -> Vec<f64> {
    let [bends, slopes] = [kind == "parabola", kind.ends_with("line")];
    if !bends && !slopes {
        return vec![0.0; t.len()];
    }
    let sign = if chance.0.even() < 0.5 { -1.0 } else { 1.0 };
    let height = sign * chance.log(3.0 * noise, 0.4 * a);
    let bend = if bends {
        chance.between(0.5, 2.0) * height
    } else {
        0.0
    };
    let span = t[t.len() - 1] - t[0];
    t.iter()
        .map(|time| (time - t[0]) / span - 0.5)
        .map(|s| height * s + bend * (s * s - 1.0 / 12.0))
        .collect()
}

/// A list of 9 to 12 turning points of a decay, or of 7 to 9 of them.
fn listed(
    kind: &str,
    a: f64,
    [omega0, offset]: [f64; 2],
    law: &Law,
    chance: &mut Chance,
) -> Simulation {
    let law = [law[0], 0.05 * chance.0.normal() / a, 0.0, a * chance.log(0.01, 0.03)];
    let (_, turns) = motion(&law, [a, 0.0], &[20.0 * PI]);
    let more = [1, 2].map(|peaks| peaks * usize::from(chance.0.even() < 0.5));
    let count = if kind == "brief" {
        7 + more[1] / 2 + more[0]
    } else {
        9 + more[0] + more[1]
    };
    let noise = a * chance.log(0.0005, 0.003);
    let turns: Vec<[f64; 2]> = turns.into_iter().take(count).collect();
    let x = turns.iter().map(|turn| offset + turn[1] + noise * chance.0.normal()).collect();
    let late = 3.0 * noise / (a * omega0);
    let t = turns.iter().map(|turn| turn[0] / omega0 + late * chance.0.normal()).collect();
    let record =
        Record { t: if kind == "untimed" { Vec::new() } else { t }, x, ..Record::default() };
    let truth = [omega0, offset, law[0], law[1], law[2], law[3]];
    Simulation { truth, amplitude: a, record, peaks: true }
}
