//! The border of the basin for any multiplier, against numbers computed elsewhere and against motions.

use hopfscope::flow::trajectory::trajectory;
use hopfscope::flow::{Detail, Fate, Limits, Motion, Outcome, Problem, Reason};
use hopfscope::model::{Parameters, State};
use hopfscope::numerics::elementary::{hypot, pow};
use hopfscope::portrait::basin::StartWindow;
use hopfscope::portrait::{Border, Edge, Portrait};
use hopfscope::scan::measure::{Measure, Value, measure};
use hopfscope::session::fate::{End, fate};
use proptest::prelude::*;
use rayon::prelude::*;
use serde::Deserialize;

const LIMITS: Limits = Limits::PATIENT;

/// A row of `data/borders.json`: half maps run backward by series of order 34 in quadruple precision, from the
/// end points of the sticking set until convergence, and 9 x 9 motions run forward.
#[derive(Debug, Deserialize)]
struct Row {
    #[serde(flatten)]
    parameters: Parameters,
    displacement: f64,
    impulse: f64,
    area: Option<f64>,
    /// Logarithm of the multiplier, if the border is a cycle.
    log_multiplier: Option<f64>,
    window: [f64; 4],
    captured: usize,
}

fn rows() -> Vec<Row> {
    serde_json::from_str(include_str!("../data/borders.json")).expect("a table of borders")
}

fn same(one: f64, other: f64, within: f64) -> bool {
    (one - other).abs() <= within * other.abs()
}

#[test]
fn borders_are_those_computed_elsewhere() {
    let wrong: Vec<String> = rows()
        .par_iter()
        .filter_map(|row| {
            let [left, right, low, high] = row.window;
            let window = StartWindow { q: (left, right), v: (low, high) };
            let found =
                Portrait::of_oscillator(&row.parameters, left.abs().max(right.abs()), &LIMITS);
            let right = found.as_ref().is_ok_and(|found| {
                let near = |found: Option<f64>, expected: Option<f64>| match (found, expected) {
                    (Some(found), Some(expected)) => same(found, expected, 1e-10),
                    (found, expected) => found == expected,
                };
                let margin = found.margin;
                let counts = found.count(&window, (9, 9), &LIMITS).unwrap();
                near(margin.displacement, Some(row.displacement))
                    && near(margin.impulse, Some(row.impulse))
                    && near(found.area(), row.area)
                    && counts.captured == row.captured
            });
            (!right).then(|| format!("{row:?}\n{found:?}"))
        })
        .collect();
    assert!(wrong.is_empty(), "{}: {wrong:#?}", wrong.len());
}

#[test]
fn the_margin_is_the_extreme_of_the_cycle_that_borders_the_basin() {
    let mut largest = 0.0_f64;
    for row in rows().iter().filter(|row| row.log_multiplier.is_some()) {
        let found = Portrait::of_oscillator(&row.parameters, 1e3, &LIMITS)
            .and_then(|found| found.drawn(&row.parameters, 12))
            .unwrap();
        let cycle = found.cycles[0];
        largest = largest.max(cycle.log_multiplier);
        let expected = row.log_multiplier.unwrap();
        assert!(same(cycle.log_multiplier, expected, 1e-9), "{row:?} {cycle:?}");
        let displacement = found.margin.displacement.unwrap();
        assert!(same(displacement, cycle.q_max.min(-cycle.q_min), 1e-12), "{row:?}");
        // The drawn curve has the extremes of the cycle, up to the spacing of its points.
        let extreme =
            |part: fn(&State) -> f64| found.curves[0].iter().map(part).fold(0.0, f64::max);
        for (drawn, exact) in [
            (extreme(|it| it.q), cycle.q_max),
            (extreme(|it| -it.q), -cycle.q_min),
            (extreme(|it| it.v), cycle.v_max),
            (extreme(|it| -it.v), -cycle.v_min),
        ] {
            assert!(same(drawn, exact, 5e-3), "{row:?}: {drawn} for {exact}");
        }
    }
    assert!(largest > 300.0, "{largest}");
}

/// A start next to a border, and whether it is inside.
fn beside_the_border(found: &Portrait, part: f64) -> Vec<(State, bool)> {
    /// Relative distance from the border.
    const BESIDE: f64 = 1e-5;
    let r = found.model.guide;
    let Edge::Orbit(border) = &found.borders[0] else { panic!("no belt") };
    let reach = |clearance: f64| {
        if clearance.is_finite() {
            r + clearance
        } else {
            5.0 * r
        }
    };
    let left = -reach(border.upper.clearance().value);
    let right = reach(border.lower.clearance().value);
    let q = left + part * (right - left);
    let Some((low, high)) = border.span_at(q) else { return Vec::new() };
    let mut starts = Vec::new();
    for speed in [low, high] {
        if speed.is_finite() && speed != 0.0 {
            starts.push((State { q, v: speed * (1.0 - BESIDE) }, true));
            starts.push((State { q, v: speed * (1.0 + BESIDE) }, false));
        }
    }
    starts
}

/// Whether a motion is captured; `None` where neither end is reached in time.
fn is_captured(parameters: Parameters, initial: State) -> Option<bool> {
    // Without nonlinear damping, a motion outside grows until it leaves the range of numbers, and one inside may be slow.
    let until = if parameters.is_piecewise_linear() { 3e4 } else { 300.0 };
    let problem = Problem { parameters, initial, until, tolerance: 1e-13, ..Problem::default() };
    let motion = trajectory(&problem, Detail::default(), &LIMITS);
    match motion.outcome {
        Outcome::Captured { .. } => Some(true),
        Outcome::Escaped { .. } | Outcome::GaveUp { reason: Reason::OutOfRange, .. } => Some(false),
        Outcome::Moving { .. } | Outcome::GaveUp { .. } => None,
    }
}

#[test]
fn a_motion_that_rests_late_is_captured() {
    let parameters = Parameters { d: -0.034_406_894_384_943_01, d2: 0.0, d3: 0.0, r: 0.05 };
    let found = Portrait::of_oscillator(&parameters, 0.5, &LIMITS).unwrap();
    for (start, inside) in beside_the_border(&found, 0.02) {
        assert_eq!(is_captured(parameters, start), Some(inside), "{start:?}");
    }
}

#[test]
fn motions_beside_the_border_are_captured_inside_and_run_away_outside() {
    let wrong: Vec<_> = rows()
        .par_iter()
        .flat_map_iter(|row| {
            let found =
                Portrait::of_oscillator(&row.parameters, 10.0 * row.parameters.r, &LIMITS).unwrap();
            let parts = [0.03, 0.2, 0.4, 0.5, 0.6, 0.8, 0.97];
            let starts: Vec<_> =
                parts.iter().flat_map(|&part| beside_the_border(&found, part)).collect();
            let parameters = row.parameters;
            starts.into_iter().filter_map(move |(start, inside)| {
                let fate = found.fate(start.q, start.v) == Ok(Fate::Rest);
                let motion = is_captured(parameters, start);
                let agree = fate == inside && motion.is_none_or(|captured| captured == inside);
                (!agree).then_some((parameters, start, inside, motion))
            })
        })
        .collect();
    assert!(wrong.is_empty(), "{}: {wrong:#?}", wrong.len());
}

#[test]
fn a_scan_measures_what_the_basin_has() {
    for row in rows() {
        let parameters = row.parameters;
        let [left, right, low, high] = row.window;
        let window = StartWindow { q: (left, right), v: (low, high) };
        let problem = Problem { parameters, ..Problem::default() };
        let measures = [Measure::Margin, Measure::Area, Measure::Stability];
        let measured = measure(&problem.into(), &measures, &window.into(), &LIMITS).unwrap();
        let found =
            Portrait::of_oscillator(&parameters, left.abs().max(right.abs()), &LIMITS).unwrap();
        let share = found.rest_share(window.q, window.v).unwrap();
        let margin = found.margin;
        let expected = [
            margin.displacement.into(),
            margin.impulse.into(),
            Value::Word(margin.regime(found.border)),
            found.area().into(),
            Value::Number(share.part),
        ];
        for (value, expected) in measured.values.into_iter().zip(expected) {
            let near = match (value.number(), expected.number()) {
                (Some(value), Some(expected)) => same(value, expected, 1e-12),
                (value, expected) => value == expected,
            };
            assert!(near, "{row:?}: {value:?} for {expected:?}");
        }
    }
}

/// The area is that of the captured part of a window around the basin: a quadrature over the displacement,
/// compared with the area, which is a quadrature over time.
#[test]
fn areas_are_those_of_the_captured_part_of_a_window() {
    let closed = rows().into_iter().filter_map(|row| row.area.map(|area| (row, area)));
    for (row, area) in closed {
        let found = Portrait::of_oscillator(&row.parameters, 1.0, &LIMITS).unwrap();
        let Edge::Orbit(cycle) = &found.borders[0] else { panic!("no belt") };
        let width = 2.0
            * (row.parameters.r + cycle.upper.clearance().value)
                .max(row.parameters.r + cycle.lower.clearance().value);
        let height =
            2.0 * found.borders[0].curve(8).iter().fold(0.0_f64, |top, it| top.max(it.v.abs()));
        let window = StartWindow { q: (-width, width), v: (-height, height) };
        let share = found.rest_share(window.q, window.v).unwrap();
        let whole = 4.0 * width * height;
        let error = whole * (share.error + 1e-12) + 1e-10 * area;
        assert!((share.part * whole - area).abs() <= error, "{row:?}: {share:?}");
    }
}

/// `2 r^2/abs(D)`: both half planes contain the triangle-like region between the node and `2 r`, in which only
/// the work of friction and damping is decisive.
#[test]
fn the_linear_basin_beside_repelling_nodes_has_its_closed_form() {
    for (d, r) in [(-1.0, 1.0), (-2.0, 1.0), (-1.5, 0.3), (-50.0, 2.0), (-1.000_000_1, 1e-3)] {
        let found =
            Portrait::of_oscillator(&Parameters { d, d2: 0.0, d3: 0.0, r }, 1.0, &LIMITS).unwrap();
        assert!(
            same(found.area().unwrap(), 2.0 * r * r / -d, 1e-12),
            "D = {d}: {:?}",
            found.area()
        );
        assert_eq!(found.margin.displacement, Some(r));
    }
}

#[test]
fn the_motions_of_a_centre_are_neutral() {
    // Inside the parabola where the first integral of D2 vanishes all motions are periodic; outside all run away.
    let parameters = Parameters { d: 0.0, d2: 0.5, d3: 0.0, r: 0.0 };
    let found = Portrait::of_oscillator(&parameters, 3.0, &LIMITS).unwrap();
    for index in 0..400 {
        let place = |step: i32| -3.0 + 6.0 * f64::from(index * step % 400) / 399.0;
        let start = State { q: place(1), v: place(37) };
        let first_integral = 0.5 * start.v * start.v + start.q - 1.0;
        let expected = if first_integral < 0.0 {
            Fate::Neutral
        } else {
            Fate::Escapes
        };
        assert_eq!(found.fate(start.q, start.v), Ok(expected), "{start:?}");
    }
    assert_eq!(found.area(), None);
    let window = StartWindow { q: (-0.5, 0.5), v: (-0.5, 0.5) };
    assert_eq!(found.rest_share(window.q, window.v).unwrap().part, 0.0);
}

#[test]
fn starts_of_a_hair_beside_the_sticking_set_go_where_they_belong() {
    let node = Parameters { d: -1.5, d2: 0.0, d3: 0.0, r: 1.0 };
    let nearly =
        Parameters { d: -0.999_975_931_443_767_5, d2: -8.747_989_131_568_893, d3: 0.0, r: 0.1 };
    // The cycle has the clearance 6.5e-31: a motion that passes the rim of the sticking set by less returns.
    let close = Parameters { d: -0.999, d2: 0.0, d3: 0.0, r: 1.0 };
    for (parameters, q, v, captured) in [
        (node, 1.0, 1e-9, false),
        (node, -1.0, -1e-9, false),
        (node, 1.0, -1e-9, false),
        (node, 1.0, 1e-14, false),
        (node, 1.0, 0.0, true),
        (node, 1.0 + f64::EPSILON, 0.0, false),
        (node, 1.0 - f64::EPSILON, 1e-9, true),
        (node, 1.0 - f64::EPSILON, 1e-7, false),
        (nearly, -0.1, -2.375_549_830_316_453_7e-9, false),
        (close, 1.0, 1e-16, true),
        (close, 1.0, 2e-15, false),
        (close, 1.0 + f64::EPSILON, 0.0, false),
        (close, -1.0, 1e-33, true),
        (close, -1.0, 1e-15, false),
    ] {
        let start = State { q, v };
        let found = Portrait::of_oscillator(&parameters, 3.0, &LIMITS).unwrap();
        assert_eq!(
            found.fate(start.q, start.v) == Ok(Fate::Rest),
            captured,
            "{parameters:?} {start:?}"
        );
        let problem = Problem { parameters, initial: start, until: 250.0, ..Problem::default() };
        let outcome = trajectory(&problem, Detail::default(), &LIMITS).outcome;
        let rests = matches!(outcome, Outcome::Captured { .. });
        assert_eq!(rests, captured, "{parameters:?} {start:?} {outcome:?}");
    }
    // For a start within rounding of the rim, a grid counts the rest and nothing beside it.
    let window = StartWindow { q: (1.0, 1.0), v: (-1e-9, 1e-9) };
    let counts = Portrait::of_oscillator(&node, 3.0, &LIMITS)
        .unwrap()
        .count(&window, (1, 3), &LIMITS)
        .unwrap();
    assert_eq!((counts.captured, counts.escaped), (1, 2));
}

fn signed_magnitude(exponents: std::ops::Range<f64>) -> impl Strategy<Value = f64> {
    prop_oneof![
        1 => Just(0.0),
        5 => (exponents, any::<bool>())
            .prop_map(|(exponent, negative)| pow(10.0, exponent) * if negative { -1.0 } else { 1.0 }),
    ]
}

/// Motions on either side of the border do what the basin predicts.
fn borders_part(parameters: &Parameters, part: f64) -> Result<(), TestCaseError> {
    let r = parameters.r;
    let Ok(found) = Portrait::of_oscillator(parameters, 10.0 * r, &LIMITS) else { return Ok(()) };
    if found.border == Border::None {
        return Ok(());
    }
    let margin = found.margin;
    prop_assert!(margin.displacement.is_some_and(|it| it >= r) && margin.impulse.is_some());
    for (start, inside) in beside_the_border(&found, part) {
        prop_assert_eq!(found.fate(start.q, start.v) == Ok(Fate::Rest), inside, "{:?}", start);
        if let Some(captured) = is_captured(*parameters, start) {
            prop_assert_eq!(captured, inside, "{:?} {:?}", parameters, start);
        }
    }
    Ok(())
}

/// A set that was once answered wrongly.
#[test]
fn the_border_by_a_large_quadratic_damping_parts_motions() {
    let parameters = Parameters {
        d: 0.0,
        d2: 13.249_729_195_566_404,
        d3: -0.001_032_636_744_890_547_4,
        r: 0.05,
    };
    borders_part(&parameters, 0.02).unwrap();
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(60))]

    /// For any multiplier.
    #[test]
    fn borders_part_motions(
        d in prop_oneof![-3.0..10.0, -1.2..0.6],
        (d2, d3) in (signed_magnitude(-2.0..1.5), signed_magnitude(-3.0..2.0)),
        r in 0.05..3.0_f64,
        part in 0.02..0.98_f64,
    ) {
        borders_part(&Parameters { d, d2, d3, r }, part)?;
    }
}

/// Parameters for each kind of edge and of cycles.
const SETS: [[f64; 4]; 8] = [
    [-0.3, 0.0, 0.5, 0.1],
    [-0.1, 0.0, 0.5, 0.1],
    [-0.1, 0.0, -0.5, 0.1],
    [0.2, 0.0, -0.5, 0.1],
    [-0.2, 0.2, 0.0, 0.5],
    [-0.3, 0.3, 0.5, 0.1],
    [-0.4, 0.0, 0.0, 1.0],
    [-0.02, 0.5, 0.0, 0.1],
];

fn followed(parameters: Parameters, initial: State, until: f64) -> Motion {
    let problem = Problem { parameters, initial, until, tolerance: 1e-10, ..Problem::default() };
    let detail = Detail { crossings: true, samples_per_step: 2, energy: false };
    trajectory(&problem, detail, &LIMITS)
}

#[test]
fn what_is_said_early_comes_true_late() {
    let mut ends = [0; 3];
    for [d, d2, d3, r] in SETS {
        let parameters = Parameters { d, d2, d3, r };
        let found = Portrait::of_oscillator(&parameters, 1e3, &LIMITS)
            .and_then(|found| found.drawn(&parameters, 2))
            .unwrap();
        for part in [0.3, 0.9, 0.99, 1.01, 1.2, 3.0] {
            for (side, v) in [(1.0, 0.0), (-1.0, 0.0), (1.0, 0.3)] {
                let size = found.cycles.first().map_or(0.6, |cycle| cycle.clearance);
                let initial = State { q: side * (r + part * size), v };
                let Some(fate) = fate(&found, &followed(parameters, initial, 8.0)) else {
                    continue;
                };
                let late = followed(parameters, initial, 300.0);
                let place =
                    format!("{parameters:?} from {initial:?}: {fate:?}, {:?}", late.outcome);
                match fate {
                    End::Rests => {
                        assert!(matches!(late.outcome, Outcome::Captured { .. }), "{place}");
                        ends[0] += 1;
                    }
                    End::Grows => {
                        let far = late.samples.last().unwrap();
                        let grown = hypot(far.q, far.v) > 5.0 * size;
                        let escaped = matches!(late.outcome, Outcome::Escaped { .. });
                        assert!(grown || escaped, "{place}");
                        ends[1] += 1;
                    }
                    End::Onto { q_max, .. } => {
                        let turn = late.crossings.iter().rfind(|turn| turn.q > 0.0).unwrap();
                        assert!((turn.q / q_max - 1.0).abs() < 1e-3, "{place}");
                        ends[2] += 1;
                    }
                    End::Decays | End::OnTheEdge { .. } => panic!("{place}"),
                }
            }
        }
    }
    assert!(ends.iter().all(|count| *count > 10), "{ends:?}");
}

#[test]
fn a_start_on_the_unstable_cycle_is_left_to_rounding() {
    let parameters = Parameters { d: -0.3, d2: 0.0, d3: 0.5, r: 0.1 };
    let found = Portrait::of_oscillator(&parameters, 1e3, &LIMITS)
        .and_then(|found| found.drawn(&parameters, 2))
        .unwrap();
    let initial = State { q: found.cycles[0].q_max, v: 0.0 };
    let fate = fate(&found, &followed(parameters, initial, 8.0)).unwrap();
    let End::OnTheEdge { distance } = fate else { panic!("{fate:?}") };
    assert!(distance < 1e-12, "{distance:e}");
}
