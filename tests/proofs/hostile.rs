//! Certificates that claim more than holds: whatever the checker accepts is true.

use hopfscope::check::{Certificate, CertificateStep, StepKind, check};
use hopfscope::numerics::Interval;
use hopfscope::numerics::elementary::pow;
use hopfscope::numerics::random::Random;
use hopfscope::proof::certificate::certificate;
use hopfscope::proof::{ParameterBox, Proof, prove};
use rayon::prelude::*;

/// Why a certificate is refused.
fn refusal(parameters: &str, cycles: &str, steps: &str) -> String {
    let text = format!(r#"{{"parameters": {parameters}, "cycles": {cycles}, "steps": [{steps}]}}"#);
    let refused = check(&text).expect_err(&text);
    assert!(refused.starts_with("line 1: "), "{refused}");
    refused
}

#[test]
fn a_theorem_says_nothing_of_a_clearance() {
    let some = r#""from": 0.0, "clearance": [7.0, 7.0000000000001]"#;
    for (kind, parameters, cycles) in [
        ("affine", "[[-0.2, -0.2], [0, 0], [0, 0], [0.1, 0.1]]", "1"),
        ("frictionless", "[[-0.2, -0.2], [0.3, 0.3], [0.5, 0.5], [0, 0]]", "1"),
        ("overdamped", "[[-1.5, -1.5], [0.3, 0.3], [-1, -1], [0.1, 0.1]]", "0"),
        ("one-way", "[[0.2, 0.2], [0.3, 0.3], [0.5, 0.5], [0.1, 0.1]]", "0"),
    ] {
        let with = |fields: &str| format!(r#"{{"step": "{kind}", {fields}}}"#);
        let why = refusal(parameters, cycles, &with(some));
        assert!(why.ends_with("only a cycle has a clearance"), "{kind}: {why}");
        let why = refusal(parameters, cycles, &with(r#""from": 0.0, "fences": [0.5, 0.5]"#));
        assert!(why.ends_with("a theorem needs no fences"), "{kind}: {why}");
        let why = refusal(parameters, cycles, &with(r#""from": 0.0, "to": 1e300"#));
        assert!(why.ends_with("a theorem is the only step"), "{kind}: {why}");
    }
}

/// What is no number, no count, or said twice.
#[test]
fn what_cannot_be_read_in_one_way_is_refused() {
    let (point, one) =
        ("[[0.1, 0.1], [0, 0], [0, 0], [1, 1]]", r#"{"step": "one-way", "from": 0}"#);
    for (parameters, cycles, steps) in [
        ("[[0.1, NaN], [0, 0], [0, 0], [1, 1]]", "0", one),
        ("[[0.1, 1e999], [0, 0], [0, 0], [1, 1]]", "0", one),
        ("[[0.1, null], [0, 0], [0, 0], [1, 1]]", "0", one),
        ("[[0.2, 0.1], [0, 0], [0, 0], [1, 1]]", "0", one),
        ("[[0.1, 0.1], [0, 0], [0, 0], [1, 1], [0, 0]]", "0", one),
        (point, "-1", one),
        (point, "0.0", one),
        (point, "0, \"cycles\": 0", one),
        (point, "18446744073709551616", one),
        (point, "0", ""),
        (point, "0", r#"{"step": "one-way", "from": 0, "from": 0}"#),
        (point, "0", r#"{"step": "one-way", "from": 0, "shown": 7}"#),
        (point, "0", r#"{"step": "one-way", "from": null}"#),
        (point, "0", r#"{"step": "one-way", "from": 5e-324}"#),
        (point, "0", r#"{"step": "one-way", "from": 0}, {"step": "one-way", "from": 0}"#),
        (point, "0", r#"{"step": "one-way", "from": 0, "to": 0}, {"step": "one-way", "from": 0}"#),
    ] {
        refusal(parameters, cycles, steps);
    }
    assert!(check(&format!(r#"{{"parameters": {point}, "cycles": 0, "steps": [{one}]}}"#)).is_ok());
}

/// A whole number below `count`.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    clippy::cast_precision_loss,
    reason = "small counts"
)]
fn pick(chance: &mut Random, count: usize) -> usize {
    (chance.even() * count as f64) as usize
}

/// A power of ten between two others.
fn power(chance: &mut Random, low: f64, high: f64) -> f64 {
    pow(10.0, low + (high - low) * chance.even())
}

/// Another number, most often near this one.
fn other(chance: &mut Random, number: f64) -> f64 {
    match pick(chance, 8) {
        0 => number.next_up(),
        1 => number.next_down(),
        2 => -number,
        3 => power(chance, -300.0, 308.0),
        4 => number * power(chance, -1.0, 1.0),
        5 => number - number.abs() * power(chance, -16.0, -1.0),
        _ => number + number.abs() * power(chance, -16.0, -1.0),
    }
}

const KINDS: [StepKind; 9] = [
    StepKind::Within,
    StepKind::Below,
    StepKind::Above,
    StepKind::Stable,
    StepKind::Unstable,
    StepKind::OneWay,
    StepKind::Overdamped,
    StepKind::Affine,
    StepKind::Frictionless,
];

/// Makes one random change.
fn change(of: &mut Certificate, chance: &mut Random) {
    let parameter = pick(chance, 4);
    match pick(chance, 5) {
        0 => {
            let place = &mut of.parameters[parameter][pick(chance, 2)];
            *place = other(chance, *place);
        }
        1 => of.parameters[parameter] = [other(chance, of.parameters[parameter][0]); 2],
        2 if pick(chance, 4) == 0 => of.parameters.swap(parameter, pick(chance, 4)),
        2 => of.cycles = pick(chance, 4),
        _ if !of.steps.is_empty() => change_steps(&mut of.steps, chance),
        _ => {}
    }
}

/// Makes one random change in the steps.
fn change_steps(steps: &mut Vec<CertificateStep>, chance: &mut Random) {
    let at = pick(chance, steps.len());
    let step = &mut steps[at];
    match pick(chance, 12) {
        0 => step.from = other(chance, step.from),
        1 => step.kind = KINDS[pick(chance, KINDS.len())],
        2 => step.fences = Some([0; 2].map(|_| power(chance, -6.0, 6.0))),
        3 => step.fences = None,
        4 => step.clearance = None,
        5 => {
            let low = power(chance, -2.0, 2.0);
            step.clearance = Some([low, low * (1.0 + power(chance, -14.0, 0.0))]);
        }
        6 | 7 => {
            if let Some(clearance) = &mut step.clearance {
                let bound = &mut clearance[pick(chance, 2)];
                *bound = other(chance, *bound);
            }
        }
        8 => {
            step.to = None;
            steps.truncate(at + 1);
        }
        9 => {
            let gone = steps.remove(at);
            if let Some(next) = steps.get_mut(at) {
                next.from = gone.from;
            }
        }
        10 => steps.insert(at, steps[at].clone()),
        // The border between two steps.
        _ => {
            let border = step.to.map(|to| other(chance, to));
            step.to = border;
            if let (Some(border), Some(next)) = (border, steps.get_mut(at + 1)) {
                next.from = border;
            }
        }
    }
}

/// Whether what a certificate states agrees with a proof for the same parameters, or for some of them.
fn agrees(accepted: &Certificate, proof: &Proof) -> bool {
    let claimed = || accepted.steps.iter().filter_map(|step| Some((step.kind, step.clearance?)));
    let by_theorem = claimed().next().is_none() && accepted.steps.len() == 1;
    let same = |((kind, [low, high]), cycle): ((StepKind, [f64; 2]), &_)| {
        let hopfscope::proof::cycles::ProvedCycle { stable, enclosure, .. } = cycle;
        let place = enclosure
            .map(|it| it.clearance)
            .and_then(|it| it.intersection(Interval::new(low, high)));
        (kind == StepKind::Stable) == *stable && low <= high && place.is_some()
    };
    accepted.cycles == proof.cycles.len()
        && (by_theorem || claimed().count() == proof.cycles.len())
        && claimed().zip(&proof.cycles).all(same)
}

/// Proofs for all of the parameters of a certificate and for two corners.
fn proofs(of: &Certificate) -> Vec<Proof> {
    let corners = [0, 1].map(|end| of.parameters.map(|it| [it[end]; 2]));
    let mut boxes = vec![of.parameters, corners[0], corners[1]];
    boxes.dedup();
    let parameters = |of: [[f64; 2]; 4]| {
        let [d, d2, d3, r] = of.map(|[low, high]| Interval::new(low, high));
        ParameterBox { d, d2, d3, r }
    };
    boxes.into_iter().map(|of| prove(&parameters(of), &[])).collect()
}

/// Whether a certificate is true by the proofs for its parameters; `None` where these leave the number of cycles open.
fn is_true(accepted: &Certificate, proofs: &[Proof]) -> Option<bool> {
    let complete = || proofs.iter().filter(|proof| proof.is_complete());
    complete().next().is_some().then(|| complete().all(|proof| agrees(accepted, proof)))
}

#[test]
fn whatever_is_accepted_is_true() {
    /// Changed certificates for each set of parameters.
    const CHANGED: usize = 120;
    let cases = [
        ([-0.2, 0.2, 0.5, 0.1], 0.0),
        ([-0.2, 0.2, 0.5, 0.1], 1e-5),
        ([-0.5, 0.2, 0.5, 0.1], 0.0),
        ([-0.3, 0.2, -0.5, 0.1], 0.0),
        ([0.3, 0.2, -0.5, 0.1], 0.0),
        ([-0.3, 0.5, 0.0, 0.1], 0.0),
        ([-0.02, 0.5, 0.0, 0.1], 0.0),
        ([-1.2, 0.3, 0.5, 0.1], 0.0),
        ([-0.1, 0.0, 0.5, 0.1], 0.0),
        ([-0.1, 0.0, 0.0, 0.1], 0.0),
        ([0.1, 0.0, -0.5, 0.0], 0.0),
        ([-1.5, 0.3, -1.0, 0.1], 0.0),
    ];
    let mut chance = Random::new(26);
    let cases = cases.map(|([d, d2, d3, r], wide)| {
        let [d, d2, d3] = [d, d2, d3].map(Interval::point);
        let r = Interval::new(r - wide, r + wide);
        let whole = certificate(&prove(&ParameterBox { d, d2, d3, r }, &[])).unwrap();
        let changed = [(); CHANGED].map(|()| {
            let mut changed = whole.clone();
            for _ in 0..=pick(&mut chance, 3) {
                change(&mut changed, &mut chance);
            }
            changed
        });
        (whole, changed)
    });
    // Refused, accepted though changed, and of these open.
    let counts = cases.par_iter().flat_map(|(whole, changed)| {
        let known = proofs(whole);
        assert_eq!(is_true(whole, &known), Some(true), "{whole:?}");
        changed.par_iter().map(move |changed| {
            let text = serde_json::to_string(changed).unwrap();
            let Ok(accepted) = check(&text) else {
                return [1, 0, 0];
            };
            let holds = if accepted.parameters == whole.parameters {
                is_true(&accepted, &known)
            } else {
                is_true(&accepted, &proofs(&accepted))
            };
            assert_ne!(holds, Some(false), "{text}");
            [0, usize::from(accepted != *whole), usize::from(holds.is_none())]
        })
    });
    let [refused, true_yet, open] =
        counts.reduce(|| [0; 3], |a, b| [a[0] + b[0], a[1] + b[1], a[2] + b[2]]);
    let counts = format!("{refused} refused, {true_yet} accepted, {open} of them open");
    assert!(refused > 480 && true_yet > 144 && 20 * open < true_yet, "{counts}");
}
