//! Cost of a cycle, and relaxations with extreme damping.

use super::*;

#[test]
fn one_cycle_costs_at_most_forty_half_swings() {
    let parameters = Parameters { d: -0.3, d2: 0.2, d3: 0.5, r: 0.1 };
    let found =
        closings(&mut Equation::new(&parameters, f64::EPSILON, &LIMITS), usize::MAX, &[]).unwrap();
    let mut equation = Equation::new(&parameters, f64::EPSILON, &LIMITS);
    let mut at = |u: f64| equation.at(Route::Mixed, u).unwrap().node;
    let near = found[0].node.at;
    let bracket = (at(near - 0.3), at(near + 0.3));
    let closing = polish(&mut equation, bracket).unwrap();
    assert!((closing.node.at - near).abs() < 1e-14);
    let swings: u64 = equation.maps.iter().flatten().map(|map| map.swings).sum();
    assert!(swings <= 40, "{swings} half swings");
}

#[test]
fn a_cycle_is_found_where_two_ways_to_compute_it_are_equally_good() {
    // At the initial guess of one of them the two methods disagree.
    for index in 0..40 {
        let d = -0.2226 + 2e-5 * f64::from(index);
        let parameters = Parameters { d, d2: 0.2, d3: 0.5, r: 0.1 };
        let found = cycles(&parameters, &Limits::PATIENT).unwrap().cycles;
        assert_eq!(found.len(), 2, "D = {d}");
    }
}

/// Without friction and with D3 > 0 the velocity obeys van der Pol's equation with `mu = -2 D`, whose periods
/// are tabulated. For D <= -1 the centre is a repelling node and the cycle a relaxation.
#[test]
fn relaxations_have_the_periods_of_van_der_pol() {
    for (mu, period) in [(1.0, 6.663_29), (2.0, 7.629_87), (5.0, 11.612_23), (10.0, 19.078_37)] {
        for d3 in [1e-12, 0.5, 1e6] {
            let parameters = Parameters { d: -0.5 * mu, d2: 0.0, d3, r: 0.0 };
            let found = cycles(&parameters, &Limits::PATIENT).unwrap().cycles;
            assert_eq!(found.len(), 1, "mu = {mu}, D3 = {d3}");
            assert!(found[0].stable && (found[0].period - period).abs() < 1e-3, "{:?}", found[0]);
        }
    }
}

/// Where damping is so strong that a swing is a relaxation, within a budget. A cycle that repels around the
/// sticking set is surrounded by an attracting one where D3 > 0.
#[test]
fn stiff_cycles_are_found_within_a_budget() {
    let limits = Limits { evaluations: 1_000_000, ..Limits::PATIENT };
    for (d, d2, d3, r) in [
        (-0.1, 0.0, -1e6, 1e12),
        (0.5, 1e6, -1e6, 1.0),
        (-0.1, 1e-12, -1e-12, 1e12),
        (0.0, 0.0, -1e6, 1.0),
        (-0.1, -1e6, 1e6, 1e-12),
        (-0.999, 1e6, 1e6, 0.0),
        (2.0, -1e6, -1e6, 1e12),
    ] {
        let parameters = Parameters { d, d2, d3, r };
        let found = cycles(&parameters, &limits);
        let found = found.unwrap_or_else(|reason| panic!("{parameters:?}: {reason}")).cycles;
        let stable: Vec<bool> = found.iter().map(|cycle| cycle.stable).collect();
        let expected: &[bool] = match (d3 > 0.0, r > 0.0) {
            (true, true) => &[false, true],
            (true, false) => &[true],
            (false, _) => &[false],
        };
        assert_eq!(stable, expected, "{parameters:?}: {found:?}");
        assert!(found.iter().all(|cycle| cycle.log_multiplier.is_finite() && cycle.period > 0.0));
    }
}
