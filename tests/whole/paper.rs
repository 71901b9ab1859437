//! The oscillator of the paper is a machine without a belt: its cycles by the closing equation and by the return map
//! of machines, which share no code but elementary functions, are the same within the errors that are told.

use hopfscope::flow::{Detail, Fate, Limits, MotionUnits, Outcome, Problem, follow};
use hopfscope::model::{Model, Parameters, State};
use hopfscope::numerics::random::Random;
use hopfscope::portrait::basin::StartWindow;
use hopfscope::portrait::basin::cycle::cycles;
use hopfscope::portrait::kicks::{Distribution, RandomKick};
use hopfscope::portrait::{Border, Margin, Portrait};

fn margins(margin: &Margin) -> [Option<f64>; 4] {
    let Margin { displacement, impulse, from_rest } = *margin;
    [displacement, impulse, from_rest.displacement, from_rest.impulse]
}

#[test]
fn the_oscillator_of_the_paper_and_a_machine_without_a_belt_have_the_same_cycles_and_margins() {
    let mut chance = Random::new(28);
    let mut between = |low: f64, high: f64| low + (high - low) * chance.even();
    let mut compared = [0; 3];
    for _ in 0..60 {
        let (d, d2, d3) = (between(-1.0, 0.3), between(-1.0, 1.0), between(0.01, 3.0));
        let parameters = Parameters { d, d2, d3, r: between(0.01, 1.0) };
        let found = cycles(&parameters, &Limits::PATIENT).unwrap();
        let model = Model::of_mode(1.0, 1.0, &[d, 0.5 * d2, 0.5 * d3], parameters.r, parameters.r);
        let model = model.unwrap();
        let portrait = Portrait::by_return_map(&model).unwrap();
        let closed = Portrait::of(&model).unwrap();
        assert_eq!((&closed.cycles, closed.border), (&found.cycles, portrait.border));
        for _ in 0..20 {
            let (x, v) = (between(-3.0, 3.0), between(-3.0, 3.0));
            assert_eq!(closed.fate(x, v), portrait.fate(x, v), "{parameters:?} {x} {v}");
        }
        assert_eq!(found.cycles.len(), portrait.cycles.len(), "{parameters:?}");
        for (one, other) in found.cycles.iter().zip(&portrait.cycles) {
            let errors = one.errors.unwrap();
            let numbers = [
                (one.q_min, other.q_min, errors.q_min),
                (one.q_max, other.q_max, errors.q_max),
                (one.v_min, other.v_min, errors.v_min),
                (one.v_max, other.v_max, errors.v_max),
                (one.period, other.period, errors.period),
            ];
            for (value, same, error) in numbers {
                let tolerance = (1e-12 * value.abs()).max(error);
                assert!((value - same).abs() <= tolerance, "{parameters:?}: {one:?} {other:?}");
            }
            let apart = (one.log_multiplier - other.log_multiplier).abs();
            assert!(apart <= errors.log_multiplier.max(1e-11), "{parameters:?}: {one:?} {other:?}");
            assert_eq!(one.stable, other.stable, "{parameters:?}");
            compared[0] += 1;
        }
        assert_eq!(found.border, portrait.border, "{parameters:?}");
        let basin = Portrait::of_oscillator(&parameters, 10.0, &Limits::PATIENT).unwrap();
        let margin = basin.margin;
        assert_eq!(margins(&margin), margins(&closed.margin), "{parameters:?}");
        assert_eq!((basin.area(), basin.integrity()), (closed.area(), closed.integrity()));
        let roundness =
            [(basin.area(), portrait.area()), (basin.inner_radius(), portrait.inner_radius())];
        for (one, other) in roundness {
            assert_eq!(one.is_some(), other.is_some(), "{parameters:?}");
            let apart = one.zip(other).map_or(0.0, |(one, other)| (one / other - 1.0).abs());
            assert!(apart < 1e-9, "{parameters:?}: {one:?} {other:?}");
        }
        for (one, other) in margins(&margin).into_iter().zip(margins(&portrait.margin)) {
            assert_eq!(one.is_some(), other.is_some(), "{parameters:?}");
            compared[1 + usize::from(one.is_none())] += 1;
            // From rest, they are differences of lengths of the size of r.
            let apart = one.zip(other).map_or(0.0, |(one, other)| (one - other).abs());
            assert!(apart <= 1e-12 * one.unwrap_or(1.0).max(parameters.r), "{parameters:?}");
        }
    }
    assert!(compared.into_iter().all(|count| count > 20), "{compared:?}");
}

#[test]
fn a_mass_that_starts_on_a_rest_that_repels_stays_there() {
    let model = Model::of_mode(1.0, 1.0, &[-0.1, 0.0, 0.2], 0.0, 0.0).unwrap();
    let portrait = Portrait::of(&model).unwrap();
    assert_eq!(portrait.border, Border::NoBasin);
    assert_eq!(portrait.fate(0.0, 0.0), Ok(Fate::Rest));
    assert_eq!(portrait.fate(1e-9, 0.0), Ok(Fate::Cycle(0)));
}

/// Where damping grows with the velocity on one side only, motions of a mode come to rest or escape, whatever their size:
/// the border between them is followed as far as the starts lie that are asked about.
#[test]
fn a_border_that_is_not_closed_is_known_at_every_start() {
    let model = Model::of_mode(754.0, 0.2, &[-0.01, 0.2], 5.0, 5.0).unwrap();
    let closed = Portrait::of(&model).unwrap();
    assert_eq!(closed.border, Border::Separatrix);
    let mut ends = [0; 2];
    for x in [-3.0, -2.0, -1.0, -0.1, 0.1, 1.0, 2.0, 3.0] {
        for v in [-900.0, -300.0, -20.0, 1.0, 5.0, 100.0, 700.0] {
            let fate = closed.fate(x, v);
            let problem = Problem { initial: State { q: x, v }, until: 10.0, ..Problem::default() };
            let units = MotionUnits::physical(&model);
            let end = match follow(&model, &problem, units, Detail::default()).outcome {
                Outcome::Captured { .. } => Fate::Rest,
                Outcome::Escaped { .. } => Fate::Escapes,
                other => panic!("{x} {v}: {other:?}"),
            };
            assert_eq!(fate, Ok(end), "{x} {v}");
            ends[usize::from(fate == Ok(Fate::Rest))] += 1;
        }
    }
    assert!(ends.into_iter().all(|count| count > 5), "{ends:?}");
    let (q, v) = ((-3.0, 3.0), (-900.0, 900.0));
    let share = closed.rest_share(q, v).unwrap().part;
    let counts = closed.count(&StartWindow { q, v }, (400, 400), &Limits::PATIENT).unwrap();
    assert!((counts.captured_part() - share).abs() < 5e-3, "{counts:?} {share}");
    let kicks = RandomKick { law: Distribution::Uniform, q: (0.0, 3.0), v: (0.0, 900.0) };
    let lost = kicks.lost(&closed).unwrap();
    assert!((lost.part + share - 1.0).abs() < lost.error + 1e-9, "{lost:?} {share}");
}
