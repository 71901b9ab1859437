use super::*;
use crate::flow::{Limits, Problem, Reason, Subject};
use crate::model::{Parameters, State};
use crate::portrait::{Kick, StartWindow};

const WINDOW: StartWindow = StartWindow { q: (-3.0, 3.0), v: (-3.0, 3.0) };

fn problem(d: f64, d2: f64, d3: f64, r: f64) -> Problem {
    Problem { parameters: Parameters { d, d2, d3, r }, ..Problem::default() }
}

fn measured(problem: Problem, measures: &[Measure]) -> ScanRow {
    measure(&problem.into(), measures, &WINDOW.into(), &Limits::PATIENT).unwrap()
}

#[test]
fn every_measure_fills_its_columns_and_no_number_is_none() {
    for problem in [
        problem(-0.1, 0.0, 0.0, 0.1),
        problem(-0.25, 0.2, 0.5, 0.1),
        problem(-0.01, 0.5, 0.0, 0.1),
        problem(0.3, 0.0, -0.5, 0.1),
        problem(-0.2, 0.0, 0.3, 0.0),
        problem(-1.5, 0.0, 0.0, 0.2),
    ] {
        // The chain of kicks follows ten thousands of motions; it has its own tests.
        let rows = MEASURES.iter().filter(|row| row.measure != Measure::Repeated);
        let measures: Vec<_> = rows.clone().map(|row| row.measure).collect();
        let conditions = Conditions { wanted: Some((Kick::Displacement, 0.5)), ..WINDOW.into() };
        let found = measure(&problem.into(), &measures, &conditions, &Limits::PATIENT).unwrap();
        let ScanRow { values, reason, .. } = found;
        assert_eq!(values.len(), rows.map(|row| row.columns.len()).sum::<usize>());
        // Beyond critical negative damping nothing is guaranteed.
        let repels = |reason: &String| problem.parameters.d < -1.0 && reason.ends_with("set repel");
        assert!(reason.as_ref().is_none_or(repels), "{problem:?}: {reason:?}");
        assert!(values.iter().all(|value| value.number().is_none_or(f64::is_finite)));
    }
}

#[test]
fn measures_share_what_they_need() {
    let problem = problem(-0.2, 0.2, 0.5, 0.1);
    let cost = |measures: &[Measure]| measured(problem, measures).cost;
    assert_eq!(cost(&[Measure::Cycles, Measure::Multipliers]), cost(&[Measure::Cycles]));
    assert_eq!(cost(&[Measure::Outcome, Measure::Rest]), cost(&[Measure::Outcome]));
    let edge = [Measure::Margin, Measure::Stability, Measure::Area];
    assert_eq!(cost(&edge), cost(&[Measure::Stability]));
    assert!(cost(&[Measure::Margin]).evaluations > 0);
    // The edge is one of the cycles: beside them only its two arcs are followed.
    let [both, cycles] = [&[Measure::Margin, Measure::Cycles][..], &[Measure::Cycles]]
        .map(|it| cost(it).evaluations);
    assert!(both < cycles + 800, "{both} {cycles}");
    let mut sum = cost(&[Measure::Cycles]);
    sum += cost(&[Measure::Rest]);
    let all = [Measure::Cycles, Measure::Rest, Measure::Multipliers, Measure::Outcome];
    assert_eq!(cost(&all), sum);
}

#[test]
fn a_guaranteed_margin_is_that_of_the_worst_and_says_where_there_is_none() {
    let mut subject = Subject::from(problem(-0.3, 0.2, 0.5, 0.1));
    let at = |subject: &Subject| {
        measure(subject, &[Measure::Guaranteed], &WINDOW.into(), &Limits::PATIENT).unwrap()
    };
    subject.tolerances.disturbance = 0.02;
    let ScanRow { values, reason, .. } = at(&subject);
    // Computed elsewhere.
    assert!((values[0].number().unwrap() - 0.1743).abs() < 5e-5 && reason.is_none());
    subject.tolerances.half_widths.insert("r".to_owned(), 0.09);
    let ScanRow { values, reason, .. } = at(&subject);
    assert_eq!(values, [Value::Nothing, Value::Nothing, Value::Word("unknown")]);
    assert!(reason.unwrap().starts_with("guaranteed: the disturbance"));
}

#[test]
fn a_circle_fills_a_part_of_the_basin_and_the_starts_settle_where_there_is_no_border() {
    let linear = problem(-0.1, 0.0, 0.0, 0.1);
    let ScanRow { values, .. } =
        measured(linear, &[Measure::Integrity, Measure::Area, Measure::Settling]);
    let [radius, integrity, area] = [0, 1, 2].map(|index| values[index].number().unwrap());
    let filled = std::f64::consts::PI * radius * radius / area;
    assert!((integrity - filled).abs() < 1e-12 && (0.9..1.0).contains(&integrity));
    assert_eq!(values[3..], [Value::Nothing; 2], "the window reaches out of the basin");
    let mut damped = problem(0.1, 0.0, 0.0, 0.1);
    damped.until = 200.0;
    let ScanRow { values, .. } = measured(damped, &[Measure::Settling, Measure::FiniteTime]);
    let [largest, mean, part, error] = [0, 1, 2, 3].map(|index| values[index].number().unwrap());
    assert!(mean < largest && largest < 30.0 && part == 1.0 && error == 0.0);
    damped.until = mean;
    let ScanRow { values, .. } = measured(damped, &[Measure::Settling, Measure::FiniteTime]);
    assert_eq!(values[0], Value::Nothing);
    assert!((0.2..0.8).contains(&values[2].number().unwrap()));
}

#[test]
fn a_motion_that_cannot_be_followed_says_why_and_leaves_its_cells_empty() {
    let mut stuck = problem(-0.999_999, 0.0, 0.0, 0.0);
    (stuck.initial, stuck.until) = (State { q: 1.0, v: 0.0 }, 1e5);
    let ScanRow { values, reason, .. } = measured(stuck, &[Measure::Rest, Measure::Outcome]);
    assert_eq!(values[..2], [Value::Nothing; 2]);
    assert_eq!(values[2], Value::Word("gave-up"));
    assert!(reason.unwrap().starts_with("outcome: "));
    let limits = Limits { interrupted: &|| true, ..Limits::PATIENT };
    let ended =
        measure(&problem(-0.1, 0.1, 0.1, 0.1).into(), &[Measure::Margin], &WINDOW.into(), &limits);
    assert_eq!(ended.unwrap_err(), Reason::Interrupted);
}
