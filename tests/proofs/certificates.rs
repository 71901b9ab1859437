//! Certificates of limit cycles: what is written is accepted, and nothing else.

use hopfscope::check::motion::Field;
use hopfscope::check::{Certificate, Kind, Step, check};
use hopfscope::numerics::Interval;
use hopfscope::oscillator::Parameters;
use hopfscope::proof::certificate::{certificate, text as file};
use hopfscope::proof::{ParameterBox, prove};
use serde_json::Value;

fn written(d: f64, d2: f64, d3: f64, r: f64) -> String {
    let proof = prove(&ParameterBox::from(&Parameters { d, d2, d3, r }), &[]);
    file(&certificate(&proof).unwrap()).unwrap()
}

#[test]
fn what_is_written_is_accepted() {
    for ([d, d2, d3, r], cycles) in [
        ([-0.2, 0.2, 0.5, 0.1], 2),
        ([-0.5, 0.2, 0.5, 0.1], 2),
        ([-0.3, 0.2, -0.5, 0.1], 1),
        ([-0.3, 0.5, 0.0, 0.1], 1),
        ([-0.02, 0.5, 0.0, 0.1], 0),
        ([-0.1, 0.0, 0.5, 0.1], 0),
        ([-0.1, 0.0, 0.0, 0.1], 1),
        ([0.1, 0.0, -0.5, 0.0], 1),
        ([-1.5, 0.3, -1.0, 0.1], 0),
    ] {
        let text = written(d, d2, d3, r);
        let accepted =
            check(&text).unwrap_or_else(|why| panic!("{d} {d2} {d3} {r}: {why}\n{text}"));
        assert_eq!(accepted.cycles, cycles, "{d} {d2} {d3} {r}");
        let shown = accepted.steps.iter().filter(|step| step.clearance.is_some()).count();
        let by_theorem = matches!(accepted.steps[..], [Step { to: None, from: 0.0, .. }]);
        assert!(by_theorem || shown == cycles);
    }
}

/// The clearance in a certificate holds the reference of thirty digits, whose leading digits these are.
#[test]
fn the_clearance_holds_the_reference() {
    let accepted = check(&written(-0.2, 0.2, 0.5, 0.1)).unwrap();
    let stable = accepted.steps.iter().find(|step| step.kind == Kind::Stable).unwrap();
    let [low, high] = stable.clearance.unwrap();
    assert!(low < 0.622_333_333_030_272_5 && 0.622_333_333_030_272_5 < high);
    assert!(high - low < 1e-11);
}

/// All places of a document at which there is a number, a truth or a word.
fn places(value: &Value, path: &str, found: &mut Vec<String>) {
    match value {
        Value::Object(fields) => {
            for (key, inner) in fields {
                places(inner, &format!("{path}/{key}"), found);
            }
        }
        Value::Array(items) => {
            for (index, inner) in items.iter().enumerate() {
                places(inner, &format!("{path}/{index}"), found);
            }
        }
        _ => found.push(path.to_owned()),
    }
}

/// A fence that is none does not bound anything: without it nothing is certain from far out.
#[test]
fn a_fence_is_verified() {
    let text = written(-0.2, 0.2, 0.5, 0.1);
    let whole = check(&text).unwrap();
    let last = whole.steps.len() - 1;
    assert!(whole.steps[last].to.is_none() && whole.steps[last].fences.is_some());
    for fences in
        [None, Some([0.0, 0.0]), Some([-2.5, -2.2]), Some([0.1, 0.1]), Some([1e200, 1e200])]
    {
        let mut changed = whole.clone();
        changed.steps[last].fences = fences;
        let refusal = check(&file(&changed).unwrap()).unwrap_err();
        assert_eq!(line(&refusal), last + 5, "{fences:?}: {refusal}");
    }
}

/// Every field perturbed in turn, by a part in a thousand: refused at its line, unless a bound of the clearance has
/// become wider and is still true.
#[test]
fn every_field_that_is_changed_is_refused() {
    let text = written(0.3, 0.2, -0.5, 0.1);
    let document: Value = serde_json::from_str(&text).unwrap();
    let mut found = Vec::new();
    places(&document, "", &mut found);
    assert!(found.len() > 20);
    let (mut true_yet, mut refused) = (Vec::new(), 0);
    for place in &found {
        for factor in [0.999, 1.001] {
            let mut changed = document.clone();
            let target = changed.pointer_mut(place).unwrap();
            *target = match target {
                Value::Number(number) if number.is_u64() => {
                    Value::from(number.as_u64().unwrap() + 1)
                }
                Value::Number(number) if number.as_f64() == Some(0.0) => Value::from(factor - 1.0),
                Value::Number(number) => Value::from(number.as_f64().unwrap() * factor),
                Value::String(word) => Value::from(format!("{word}x")),
                other => panic!("{other}"),
            };
            let text = serde_json::to_string_pretty(&changed).unwrap();
            match check(&text) {
                Err(refusal) => {
                    refused += 1;
                    assert!((1..=text.lines().count()).contains(&line(&refusal)), "{refusal}");
                }
                Ok(_) => true_yet.push(format!("{place} {factor}")),
            }
        }
    }
    let may = |place: &String| place.contains("/clearance/");
    assert!(true_yet.iter().all(may) && true_yet.len() <= 2, "{true_yet:?}");
    assert!(refused > 40, "{refused}");
}

/// The line that a refusal names.
fn line(refusal: &str) -> usize {
    refusal.strip_prefix("line ").and_then(|it| it.split_once(':')).unwrap().0.parse().unwrap()
}

#[test]
fn a_step_that_is_missing_or_out_of_place_is_refused_with_its_line() {
    let text = written(-0.2, 0.2, 0.5, 0.1);
    let whole = check(&text).unwrap();
    for gone in 0..whole.steps.len() {
        let mut steps = whole.steps.clone();
        steps.remove(gone);
        let text = file(&Certificate { steps, ..whole.clone() }).unwrap();
        let refusal = check(&text).unwrap_err();
        // The step that now stands there, or the one before it, does not fit. Steps begin in line 5.
        let there = gone + 5;
        assert!((there - 1..=there).contains(&line(&refusal)), "without step {gone}: {refusal}");
    }
    let steps =
        vec![Step { kind: Kind::OneWay, from: 0.0, to: None, clearance: None, fences: None }];
    let claimed = file(&Certificate { parameters: whole.parameters, cycles: 0, steps }).unwrap();
    assert_eq!(line(&check(&claimed).unwrap_err()), 5);
    assert_eq!(line(&check("{\n\"cycles\": x").unwrap_err()), 2);
    assert!(check(&text.replace("\"cycles\"", "\"circles\"")).is_err());
    assert!(check(&text.replace("0.5,0.5", "0.5,null")).is_err());
}

/// A certificate for intervals of parameters, and none where the number of cycles is open.
#[test]
fn intervals_of_parameters_are_certified_and_what_is_open_is_not() {
    let mut wide = ParameterBox::from(&Parameters { d: -0.2, d2: 0.2, d3: 0.5, r: 0.1 });
    wide.r = Interval::new(0.099_99, 0.100_01);
    let text = file(&certificate(&prove(&wide, &[])).unwrap()).unwrap();
    assert_eq!(check(&text).unwrap().parameters[3], [0.099_99, 0.100_01]);
    wide.d = Interval::new(-0.18, -0.17);
    assert!(certificate(&prove(&wide, &[])).is_err());
}

/// From far out all motions fall onto one curve: the end of all starts is that of one of them, and they come closer.
#[test]
fn swings_from_far_out_end_together() {
    let field = Field::new([0.2, 25.0, 0.03].map(Interval::point), 0.16);
    let all = field.swing(Interval::new(2e6, 2.1e6), 0.0);
    let one = field.swing(Interval::point(2.05e6), 0.0);
    assert!(
        all.end.is_finite() && all.end.intersection(one.end).is_some(),
        "{} {}",
        all.end,
        one.end
    );
    assert!(all.end.width() < 1e-10 && all.damping.lower() > 1e6, "{} {}", all.end, all.damping);
}
