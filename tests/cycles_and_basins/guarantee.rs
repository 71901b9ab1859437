//! Guaranteed margins: no bounded disturbance and no parameters of the box lead out of them, and the worst
//! disturbance leads out from just beyond.

use crate::explorer::{Trial, refuses, reopened};
use hopfscope::flow::Limits;
use hopfscope::model::{Body, Interval, Knob, ParameterBox, Parameters, State, Tolerances};
use hopfscope::numerics::elementary::sin;
use hopfscope::numerics::random::Random;
use hopfscope::portrait::Portrait;
use hopfscope::portrait::guarantee::oscillator::{TwoSidedOscillator, guaranteed};
use hopfscope::portrait::{Border, Margin};
use hopfscope::question::answer;
use hopfscope::scene::{Finding, Request, Topic};
use hopfscope::session::{Row, Uncertainty};

fn between(random: &mut Random, interval: Interval) -> f64 {
    let (low, high) = (interval.lower(), interval.upper());
    low + random.even() * (high - low)
}

/// A disturbance as a function of time and the sign of the velocity, in units of its bound.
#[derive(Clone, Copy)]
enum Force {
    /// Always in the direction of the motion: the worst.
    Along,
    /// In the direction of the motion for this fraction of the time, otherwise against it.
    Mostly(f64),
    /// Harmonic, with this frequency and phase.
    Harmonic(f64, f64),
    /// Changes sign every so many steps, shifted by so many.
    Telegraph(u32, u32),
}

impl Force {
    fn any(random: &mut Random) -> Self {
        let pick = random.even();
        if pick < 0.25 {
            Force::Along
        } else if pick < 0.5 {
            Force::Mostly(random.even())
        } else if pick < 0.75 {
            Force::Harmonic(0.2 + 2.0 * random.even(), 6.3 * random.even())
        } else {
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "small")]
            let steps = [400.0, 30.0].map(|most| (1.0 + most * random.even()) as u32);
            Force::Telegraph(steps[0], steps[1])
        }
    }

    fn at(self, step: u32, side: f64, random: &mut Random) -> f64 {
        match self {
            Force::Along => side,
            Force::Mostly(part) => {
                if random.even() < part {
                    side
                } else {
                    -side
                }
            }
            Force::Harmonic(frequency, phase) => sin(frequency * STEP * f64::from(step) + phase),
            Force::Telegraph(length, shift) => {
                if ((step + shift) / length).is_multiple_of(2) {
                    1.0
                } else {
                    -1.0
                }
            }
        }
    }
}

/// Length of a step, during which the disturbance is constant.
const STEP: f64 = 0.02;

/// Follows a disturbed motion by the Runge-Kutta method, step by step and half swing by half swing. Returns how
/// far its turning points go to the left and to the right, and whether it is at rest in the end.
fn extent(
    system: &TwoSidedOscillator,
    bound: f64,
    force: Force,
    start: State,
    until: f64,
    random: &mut Random,
) -> (f64, f64, bool) {
    let r = system.upper.r;
    let State { mut q, mut v } = start;
    let (mut low, mut high) = (q.min(0.0), q.max(0.0));
    let mut side = v.signum() * f64::from(u8::from(v != 0.0));
    let mut step = 0;
    while STEP * f64::from(step) < until {
        let mut force = |side: f64| bound * force.at(step, side, random);
        if side == 0.0 {
            // At rest: the side to which the springs and the disturbance pull, if they overcome friction.
            let pull = [1.0, -1.0].into_iter().find(|side| side * (force(*side) - q) > r);
            side = pull.unwrap_or(0.0);
        }
        let u = if side == 0.0 { 0.0 } else { force(side) };
        step += 1;
        if side == 0.0 || side * (u - q) <= r && v == 0.0 {
            side = 0.0;
            continue;
        }
        let Parameters { d, d2, d3, .. } = if side > 0.0 { system.upper } else { system.lower };
        let slope = |q: f64, v: f64| (v, -q - v * (2.0 * d + v * (d2 + v * d3)) - r * side + u);
        let advance = |h: f64| {
            let a = slope(q, v);
            let b = slope(q + 0.5 * h * a.0, v + 0.5 * h * a.1);
            let c = slope(q + 0.5 * h * b.0, v + 0.5 * h * b.1);
            let e = slope(q + h * c.0, v + h * c.1);
            let mean = |a: f64, b: f64, c: f64, e: f64| h / 6.0 * (a + 2.0 * (b + c) + e);
            (q + mean(a.0, b.0, c.0, e.0), v + mean(a.1, b.1, c.1, e.1))
        };
        let next = advance(STEP);
        if side * next.1 > 0.0 {
            (q, v) = next;
        } else {
            let (mut before, mut after) = (0.0, STEP);
            for _ in 0..40 {
                let middle = 0.5 * (before + after);
                if side * advance(middle).1 > 0.0 {
                    before = middle;
                } else {
                    after = middle;
                }
            }
            (q, v, side) = (advance(before).0, 0.0, 0.0);
        }
        (low, high) = (low.min(q), high.max(q));
        if !q.is_finite() || q.abs() > 1e6 {
            return (f64::NEG_INFINITY, f64::INFINITY, false);
        }
    }
    // A motion may also just turn there, but then farther out.
    (low, high, side == 0.0 && q.abs() <= r + bound)
}

/// A box of parameters and a disturbance.
fn case(d: [f64; 2], d2: [f64; 2], d3: [f64; 2], r: [f64; 2], w: f64) -> (ParameterBox, f64) {
    let [d, d2, d3, r] = [d, d2, d3, r].map(|[low, high]| Interval::new(low, high));
    (ParameterBox { d, d2, d3, r }, w)
}

/// Borders that are a cycle or a separatrix, for boxes and for single systems.
fn cases() -> [(ParameterBox, f64); 5] {
    [
        case([-0.3; 2], [0.2; 2], [0.5; 2], [0.1; 2], 0.02),
        case([-0.3, -0.28], [-0.1, 0.3], [0.4, 0.5], [0.09, 0.11], 0.03),
        case([-0.1, -0.05], [-0.5, -0.3], [-0.2, 0.1], [0.2, 0.25], 0.1),
        case([0.1, 0.2], [0.4, 0.5], [0.0; 2], [0.1; 2], 0.05),
        case([-0.05, 0.05], [-0.2, 0.2], [-0.1, 0.0], [0.1, 0.2], 0.0),
    ]
}

/// Starts disturbed motions at a fraction of the margins, with parameters of the box. Returns how many leave
/// the interior of the border.
fn leaving(known: &ParameterBox, w: f64, motions: usize, random: &mut Random) -> u32 {
    let margin = guaranteed(known, w, 0.0, &Limits::PATIENT).unwrap().unwrap().1;
    // Values of r, each with the extent of the interior of the border that holds for it.
    let frictions = [0.0, 0.25, 0.5, 0.75, 1.0].map(|part| {
        let r = known.r.lower() + part * (known.r.upper() - known.r.lower());
        let known = ParameterBox { r: Interval::new(r, r), ..*known };
        let safe = guaranteed(&known, w, 0.0, &Limits::PATIENT).unwrap().unwrap().0;
        let turning = |sign: f64| {
            let border = safe.borders[0].curve(4);
            border.iter().map(|state| sign * state.q).fold(f64::NEG_INFINITY, f64::max)
        };
        // A separatrix goes to infinity outwards; the end where it turns is the one that matters.
        (r, -turning(-1.0), turning(1.0))
    });
    let (displacement, impulse) = (margin.displacement.unwrap(), margin.impulse.unwrap());
    let (shift, push) = (margin.from_rest.displacement.unwrap(), margin.from_rest.impulse.unwrap());
    let corner = |random: &mut Random, interval: Interval| match random.even() {
        part if part < 0.3 => interval.lower(),
        part if part < 0.6 => interval.upper(),
        _ => between(random, interval),
    };
    let mut left_behind = 0;
    for &(r, left, right) in frictions.iter().cycle().take(motions) {
        let ParameterBox { d, d2, d3, .. } = *known;
        let [d, d2, d3] = [d, d2, d3].map(|interval| corner(random, interval));
        let parameters = Parameters { d, d2, d3, r };
        let system = TwoSidedOscillator { upper: parameters, lower: parameters };
        let sign = if random.even() < 0.5 { 1.0 } else { -1.0 };
        // Where friction and the disturbance hold the mass.
        let rest = (2.0 * random.even() - 1.0).signum() * random.even().sqrt() * (r + w);
        let start = match random.even() {
            part if part < 0.25 => State { q: 0.999 * sign * displacement, v: 0.0 },
            part if part < 0.5 => State { q: 0.0, v: 0.999 * sign * impulse },
            part if part < 0.75 => State { q: rest + 0.999 * sign * shift, v: 0.0 },
            _ => State { q: rest, v: 0.999 * sign * push },
        };
        let force = Force::any(random);
        let (low, high, _) = extent(&system, w, force, start, 30.0, random);
        left_behind += u32::from(low < left || high > right);
    }
    left_behind
}

#[test]
fn the_margin_known_from_elsewhere() {
    let known = case([-0.3; 2], [0.2; 2], [0.5; 2], [0.1; 2], 0.0).0;
    for (w, expected) in [(0.0, 0.2190), (0.02, 0.1743)] {
        let (_, margin) = guaranteed(&known, w, 0.0, &Limits::PATIENT).unwrap().unwrap();
        let displacement = margin.displacement.unwrap();
        assert!((displacement - expected).abs() < 5e-5, "w = {w}: {displacement}");
        let nominal = Portrait::innermost(&known.middle(), 0.0, &Limits::PATIENT).unwrap().margin;
        assert!(displacement < nominal.displacement.unwrap());
    }
}

#[test]
fn where_there_may_be_no_friction_nothing_is_guaranteed_and_no_number_is_below_zero() {
    let (known, w) = case([-0.1; 2], [0.0; 2], [0.0; 2], [0.0, 0.1], 0.0);
    let margin = guaranteed(&known, w, 0.0, &Limits::PATIENT).unwrap().unwrap().1;
    assert_eq!(margin, Margin::ZERO);
}

#[test]
fn a_border_far_out_on_one_side_is_that_of_the_plain_system() {
    // D2 brakes on one side and drives on the other, and a tiny D3 prevents escape: the far end is where swings
    // have lost memory of their starts.
    let far = [(0.1157, -5e-3), (0.1157, -5e-4), (0.1157, -1e-9), (0.65, -1e-3), (0.36, -2e-4)];
    for (d, d3) in far {
        let plain = Parameters { d, d2: 0.3517, d3, r: 0.22 };
        let margin = Portrait::of_oscillator(&plain, 0.0, &Limits::PATIENT).unwrap().margin;
        let exact = [plain.d, plain.d2, plain.d3, plain.r].map(|value| [value; 2]);
        let (known, _) = case(exact[0], exact[1], exact[2], exact[3], 0.0);
        let (_, found) = guaranteed(&known, 0.0, 0.0, &Limits::PATIENT).unwrap().unwrap();
        for (sure, one) in [
            (found.displacement, margin.displacement),
            (found.impulse, margin.impulse),
            (found.from_rest.displacement, margin.from_rest.displacement),
            (found.from_rest.impulse, margin.from_rest.impulse),
        ] {
            let (sure, one) = (sure.unwrap(), one.unwrap());
            assert!((-1e-9..1e-12).contains(&(sure / one - 1.0)), "{d3}: {sure} {one}");
        }
        // Uncertain parameters only reduce the margin.
        let (wide, w) = case(exact[0], [0.3143, 0.3517], [d3, -d3], [0.28, 0.3], 0.06);
        let (_, found) = guaranteed(&wide, w, 0.0, &Limits::PATIENT).unwrap().unwrap();
        let least = found.displacement.unwrap();
        assert!(least < 1.001 * margin.displacement.unwrap() && least > 1.9, "{d3}: {least}");
    }
}

#[test]
fn no_disturbance_of_a_hundred_thousand_leads_out_of_the_guaranteed_margin() {
    let mut random = Random::new(2);
    for (known, w) in cases() {
        assert_eq!(leaving(&known, w, 20_000, &mut random), 0, "{known:?}, w = {w}");
    }
}

/// A thousand systems of the boxes, none of which fails to survive a guaranteed kick.
#[test]
fn no_parameters_of_a_box_have_a_smaller_margin() {
    let mut random = Random::new(4);
    let mut looked = 0;
    for (known, _) in cases() {
        let guaranteed = guaranteed(&known, 0.0, 0.0, &Limits::PATIENT).unwrap().unwrap().1;
        let kicks = |Margin { displacement, impulse, from_rest }: Margin| {
            [displacement, impulse, from_rest.displacement, from_rest.impulse]
                .map(|size| size.unwrap_or(f64::INFINITY))
        };
        let least = kicks(guaranteed);
        let ParameterBox { d, d2, d3, r } = known;
        for _ in 0..200 {
            let [d, d2, d3, r] = [d, d2, d3, r].map(|interval| between(&mut random, interval));
            let parameters = Parameters { d, d2, d3, r };
            let own =
                kicks(Portrait::of_oscillator(&parameters, 0.0, &Limits::PATIENT).unwrap().margin);
            let within = own.iter().zip(least).all(|(own, least)| *own >= least);
            assert!(within, "{parameters:?}: {own:?} within {least:?}");
            looked += 1;
        }
    }
    assert_eq!(looked, 1000);
}

#[test]
fn the_worst_disturbance_leads_out_from_just_beyond() {
    let mut random = Random::new(3);
    for (known, w) in cases() {
        let margin = guaranteed(&known, w, 0.0, &Limits::PATIENT).unwrap().unwrap().1;
        // The disturbance compensates for the friction that the worst system lacks.
        let worst = TwoSidedOscillator::worst(&known, 0.0);
        let (q, v) = (margin.displacement.unwrap(), margin.impulse.unwrap());
        let mut leaves_from = |rest: f64, part: f64, kick: State| {
            let start = State { q: rest + part * kick.q, v: part * kick.v };
            !extent(&worst, w, Force::Along, start, 200.0, &mut random).2
        };
        let (shift, push) =
            (margin.from_rest.displacement.unwrap(), margin.from_rest.impulse.unwrap());
        let rest = known.r.lower() + w;
        let mut lost = [0; 2];
        for sign in [-1.0, 1.0] {
            for kick in [State { q: sign * shift, v: 0.0 }, State { q: 0.0, v: sign * push }] {
                for from in [-rest, rest] {
                    assert!(!leaves_from(from, 0.999, kick), "{known:?}, w = {w}: {kick:?}");
                    lost[usize::from(kick.q == 0.0)] += u8::from(leaves_from(from, 1.001, kick));
                }
            }
        }
        assert!(lost.iter().all(|count| *count > 0), "{known:?}, w = {w}: {lost:?}");
        let mut leaves = |part: f64, kick: State| leaves_from(0.0, part, kick);
        let kicks = [(q, 0.0), (0.0, v)].map(|(q, v)| [State { q, v }, State { q: -q, v: -v }]);
        for [kick, mirrored] in kicks {
            assert!(!leaves(0.999, kick) && !leaves(0.999, mirrored), "{known:?}, w = {w}");
            assert!(leaves(1.001, kick) || leaves(1.001, mirrored), "{known:?}, w = {w}: {kick:?}");
        }
    }
}

/// For random systems, undisturbed: every kick just below the smallest one is survived from wherever the mass rests,
/// and just above it one is lost from an end of the sticking set.
#[test]
fn no_rest_position_has_a_smaller_margin_and_one_attains_it() {
    let mut random = Random::new(7);
    let (mut looked, mut drawn) = (0, 0);
    while looked < 1000 {
        drawn += 1;
        assert!(drawn < 4000, "{looked} of {drawn} systems have a border");
        let mut roll = |low: f64, high: f64| low + (high - low) * random.even();
        let d3 = if roll(0.0, 1.0) < 0.5 { roll(-0.5, 0.5) } else { 0.0 };
        let parameters =
            Parameters { d: roll(-0.7, 0.2), d2: roll(-0.6, 0.6), d3, r: roll(0.05, 0.4) };
        let found = Portrait::of_oscillator(&parameters, 0.0, &Limits::PATIENT).unwrap();
        let from_rest = found.margin.from_rest;
        let Some((shift, push)) = from_rest.displacement.zip(from_rest.impulse) else {
            assert_eq!(found.border, Border::None, "{parameters:?}");
            continue;
        };
        looked += 1;
        let system = TwoSidedOscillator { upper: parameters, lower: parameters };
        let mut rests = |rest: f64, part: f64, kick: State| {
            let start = State { q: rest + part * kick.q, v: part * kick.v };
            extent(&system, 0.0, Force::Along, start, 400.0, &mut random).2
        };
        for pair in [State { q: shift, v: 0.0 }, State { q: 0.0, v: push }] {
            let mut lost = 0;
            for sign in [-1.0, 1.0] {
                let kick = State { q: sign * pair.q, v: sign * pair.v };
                for part in [-1.0, -0.4, 0.1, 0.7, 1.0] {
                    let rest = part * parameters.r;
                    assert!(rests(rest, 0.995, kick), "{parameters:?}: {kick:?} from {rest}");
                    lost += usize::from(f64::abs(part) == 1.0 && !rests(rest, 1.005, kick));
                }
            }
            assert!(lost > 0, "{parameters:?}: beyond {pair:?} nothing is lost");
        }
    }
}

/// The question of a session for what is certain.
fn certainty(trial: &Trial) -> Option<Request> {
    trial.session.wants().into_iter().find(|request| request.topic() == Topic::Zones)
}

#[test]
fn a_half_width_is_typed_stepped_undone_and_saved() {
    let mut trial = Trial::open("plain");
    assert_eq!(certainty(&trial), None, "nothing is in doubt");
    trial.press(":set<space>r=0.10+-0.01<space>w=0.02<enter>");
    assert_eq!(trial.session.value(Knob::R), 0.1);
    let doubt = Uncertainty {
        half_widths: [0.0, 0.0, 0.0, 0.01],
        disturbance: 0.02,
        ..Uncertainty::default()
    };
    assert_eq!(trial.session.doubt, doubt);
    reopened(&trial.session);
    trial.press("u");
    assert_eq!(trial.session.doubt, Uncertainty::default());
    trial.press("U");
    assert_eq!(trial.session.doubt, doubt);
    // Keys change the half width of the selected row, and reset it to the scene's.
    trial.session.selected = Row::Number(Knob::R);
    trial.press(">");
    assert_eq!(trial.session.doubt.half_width(Knob::R), 0.02);
    trial.press("<lt><lt><lt>");
    assert_eq!(trial.session.doubt.half_width(Knob::R), 0.0);
    trial.press("<down>");
    assert_eq!(trial.session.selected, Row::Number(Knob::Disturbance));
    trial.press("<right>");
    assert_eq!(trial.session.doubt.disturbance, 0.03);
    trial.press("<backspace>");
    assert_eq!(trial.session.doubt, Uncertainty::default());
}

#[test]
fn an_interval_is_taken_by_its_middle_and_a_bare_value_is_exact() {
    let mut trial = Trial::open("plain");
    trial.press("<run \"set D=-0.3..-0.25\">");
    assert_eq!(trial.session.value(Knob::D), -0.275);
    assert!((trial.session.doubt.half_width(Knob::D) - 0.025).abs() < 1e-16);
    trial.press("<run \"set D=-0.3\">");
    assert_eq!(trial.session.value(Knob::D), -0.3);
    assert_eq!(trial.session.doubt, Uncertainty::default());
    refuses(
        "plain",
        &[
            ("set r=0.1+--1", "an uncertainty is 0 or more"),
            ("set r=0.1+-0.2", "r = -0.1"),
            ("set q0=1+-0.1", "q0 has no uncertainty; only D, D2, D3 and r have one"),
            ("set w=-1", "disturbance = -1 is outside its range 0 .. 1e150"),
        ],
    );
}

/// Compared with reference numbers for D = -0.3, D2 = 0.2, D3 = 0.5, r = 0.1.
#[test]
fn what_is_certain_is_asked_with_the_box_and_answers_the_reference() {
    let mut trial = Trial::open("plain");
    trial.press(":set<space>D=-0.3<space>D2=0.2<space>D3=0.5<space>r=0.1<space>w=0.02<enter>");
    let request = certainty(&trial).unwrap();
    let Finding::Zones(found) = answer(&request, &hopfscope::flow::Limits::PATIENT).unwrap() else {
        panic!("{request:?}")
    };
    let margin = found.guaranteed.unwrap().displacement.unwrap();
    assert!((margin - 0.1743).abs() < 5e-5, "{margin}");
    assert!((found.nominal.displacement.unwrap() - 0.2190).abs() < 5e-5);
    trial.press(":set<space>D3=0.5+-0.1<enter>");
    let Some(Request::Zones { source, tolerances }) = certainty(&trial) else { panic!() };
    let Body::Paper(parameters) = &source.body else { panic!() };
    let known = tolerances.around(parameters);
    assert_eq!((known.d3, tolerances.disturbance), (Interval::around(0.5, 0.1), 0.02));
    // However close to 0 its ends are: a tolerance that were left out would promise too much.
    for (d2, half) in [(0.2, 0.2), (3e-150, 2.5e-150)] {
        let doubt = Uncertainty::default().with_half_width(Knob::D2, half).unwrap();
        let known = doubt.tolerances().around(&Parameters { d2, ..Parameters::default() });
        assert_eq!(known.d2, Interval::around(d2, half));
    }
}

#[test]
fn a_machine_brings_its_tolerances_and_keeps_them_in_newtons_at_another_speed() {
    let mut trial = Trial::open("fig01");
    trial.press(":set<space>w=0.005<space>r=0.05+-0.01<enter>");
    let newtons = |trial: &Trial| {
        let running = trial.session.running().unwrap();
        let belt = trial.session.machine().unwrap();
        let Tolerances { half_widths, disturbance } =
            trial.session.doubt.on_machine(running, &belt).unwrap();
        (half_widths["R"], disturbance)
    };
    let before = newtons(&trial);
    trial.press(":set<space>belt=0.4<space>m/s<enter>");
    let after = newtons(&trial);
    assert!((after.0 / before.0 - 1.0).abs() < 1e-12, "{before:?} {after:?}");
    assert!((after.1 / before.1 - 1.0).abs() < 1e-12, "{before:?} {after:?}");
    trial.press(":layer<space>whole<space>on<enter>");
    assert!(
        certainty(&trial).is_some_and(|request| match request {
            Request::Zones { source, .. } => source.of_belt().is_some(),
            _ => false,
        }),
        "by the whole model"
    );
}

#[test]
fn the_nominal_margin_of_very_weak_damping_is_the_turning_point_of_the_innermost_cycle() {
    let parameters = Parameters { d: -1e-11, d2: -1e-12, d3: 0.0, r: 0.1 };
    let found = Portrait::innermost(&parameters, 0.0, &Limits::PATIENT).unwrap();
    let cycle = &hopfscope::portrait::cycles(&parameters, &Limits::PATIENT).unwrap().cycles[0];
    let nearest = cycle.q_max.min(-cycle.q_min);
    let margin = found.margin.displacement.unwrap();
    assert!((margin - nearest).abs() <= 1e-9 * nearest, "{margin} {nearest}");
}
