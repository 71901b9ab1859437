//! Derivatives of the proved map with respect to the parameters.

use super::*;

/// Scaling implies `z X_z - b X_b - 2 c X_c = X` for a half swing; without b and c its end is `z exp(-pi D/omega)`.
#[test]
fn derivatives_by_the_parameters_obey_scaling_and_the_closed_form() {
    let point = Interval::point;
    for (d, b, c, z) in [
        (-0.2, 0.2, 0.5, 0.25),
        (-0.3, -0.4, 0.5, 1.1),
        (0.1, 0.3, -0.1, 0.8),
        (-0.4, 0.0, 0.0, 0.7),
    ] {
        let field = Field { a: point(2.0 * d), b: point(b), c: point(c) };
        let found = swing_with_derivatives(&field, &StartBox::at_rest(point(z))).arrived().unwrap();
        let [by_a, by_b, by_c] = found.derivatives.unwrap();
        let by_z = point(z) / found.end * found.divergence.exp();
        let off = point(z) * by_z - point(b) * by_b - (point(c) * by_c).twice() - found.end;
        assert!(off.contains(0.0) && off.width() < 1e-10 * z, "{d} {b} {c}: {off}");
        assert!([by_a, by_b, by_c].iter().all(|it| it.upper() < 0.0), "{by_a} {by_b} {by_c}");
        if b == 0.0 && c == 0.0 {
            let omega = f64::sqrt(1.0 - d * d);
            let end = z * exp(-std::f64::consts::PI * d / omega);
            let exact = -0.5 * std::f64::consts::PI / powi(omega, 3) * end;
            let near = Interval::around(exact, 1e-14 * exact.abs());
            assert!(by_a.intersection(near).is_some() && by_a.width() < 1e-9, "{by_a} {exact}");
        }
    }
}

/// The derivatives of the map and of its fixed points, against difference quotients.
#[test]
fn derivatives_by_the_parameters_are_those_of_the_map_and_of_its_cycles() {
    const STEP: f64 = 1e-4;
    let base = exactly(-0.2, 0.2, 0.5, 0.1);
    let cycle = prove(&base, &[]).cycles[1].enclosure.unwrap().clearance;
    let found = derivatives(&base, cycle).unwrap();
    assert!(found.image.intersection(cycle).is_some());
    let of_cycle = cycle_derivatives(&base, cycle).unwrap();
    let slopes = [found.d, found.d2, found.d3, found.r];
    for (index, (symbol, value)) in
        [(Knob::D, -0.2), (Knob::D2, 0.2), (Knob::D3, 0.5), (Knob::R, 0.1)].into_iter().enumerate()
    {
        let at = |value: f64| {
            let there = base.with(symbol, Interval::point(value));
            let image = derivatives(&there, Interval::point(cycle.middle())).unwrap().image;
            let moved = prove(&there, &[]).cycles[1].enclosure.unwrap().clearance;
            (image.middle(), moved.middle())
        };
        let (more, less) = (at(value + STEP), at(value - STEP));
        let quotients = [(more.0 - less.0) / (2.0 * STEP), (more.1 - less.1) / (2.0 * STEP)];
        for (enclosed, quotient) in [slopes[index], of_cycle[index]].into_iter().zip(quotients) {
            // The error of the quotient is a sixth of the third derivative times the square of the step.
            assert!((enclosed.middle() / quotient - 1.0).abs() < 1e-4, "{symbol:?} {enclosed}");
            assert!(enclosed.width() < 1e-9 * quotient.abs(), "{symbol:?} {enclosed}");
        }
    }
}
