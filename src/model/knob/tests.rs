//! What the table promises.

use super::*;
use crate::model::belt::FrictionLaw;
use crate::model::unit::dimension_of;
use crate::model::{Body, Mode, ParameterBox, Source};

fn belt(law: FrictionLaw) -> Belt {
    Belt {
        mass: 2.0,
        stiffness: 800.0,
        damping: 3.0,
        cubic_damping: 40.0,
        normal_force: 60.0,
        friction: 1.5,
        belt_speed: 0.25,
        law,
        static_coefficient: None,
        static_guide: None,
    }
}

#[test]
fn every_number_is_found_under_its_name_and_takes_its_default() {
    for row in KNOBS {
        let source = Group::SOURCE.contains(&row.group);
        let groups = if source { Group::SOURCE } else { &[row.group] };
        assert_eq!(Knob::named(row.name, groups), Ok(row.knob), "{row:?}");
        assert_eq!(row.knob.spec().name, row.name);
        assert!(row.default.is_none_or(|value| row.knob.check(value) == Ok(value)), "{row:?}");
        assert!(row.min < row.max && row.step > 0.0 && !row.meaning.is_empty(), "{row:?}");
        assert_eq!(measured(&format!("1 {}", row.unit)).unwrap().value, 1.0, "{row:?}");
    }
    assert!(Group::Motion.knobs().eq(Knob::MOTION));
    let symbols = |group: Group| group.knobs().map(|knob| knob.spec().symbol);
    let pane =
        [Group::Motion, Group::Machine, Group::Law, Group::Setting].into_iter().flat_map(symbols);
    let names: std::collections::BTreeSet<&str> = pane.clone().collect();
    assert_eq!(names.len(), pane.count(), "rows of the pane with one name");
}

#[test]
fn what_is_set_is_read_back() {
    let mut parameters = Parameters::default();
    let value = |place: usize| 0.5 + f64::from(u8::try_from(place).unwrap());
    for (place, knob) in Knob::PARAMETERS.into_iter().enumerate() {
        parameters = parameters.with(knob, value(place));
    }
    assert_eq!(Knob::PARAMETERS.map(|knob| parameters.value(knob)), std::array::from_fn(value));
    assert!(parameters.value(Knob::Mass).is_nan());

    let stribeck = FrictionLaw::Stribeck {
        rest: 0.5,
        kinetic: 0.2,
        velocity: 0.3,
        exponent: 1.0,
        viscous: 0.0,
    };
    let polynomial = FrictionLaw::Polynomial { coefficients: vec![0.5; 6] };
    let mut set = 0;
    for law in [FrictionLaw::Constant { mu: 0.3 }, stribeck, polynomial] {
        let mut belt = belt(law);
        let all = KNOBS.iter().map(|row| row.knob);
        let has: Vec<Knob> = all.filter(|knob| knob.of_belt(&belt).is_some()).collect();
        for (place, knob) in has.iter().enumerate() {
            knob.set_in_belt(&mut belt, value(place)).unwrap();
        }
        for (place, knob) in has.iter().enumerate() {
            assert_eq!(knob.of_belt(&belt), Some(value(place)), "{knob}");
        }
        set += has.len();
    }
    assert_eq!(set, 3 * 9 + 1 + 5 + 6, "nine that every belt has, and those of its law");
}

#[test]
fn static_friction_that_is_not_given_is_that_of_the_law_at_rest_and_of_the_moving_mass() {
    let mut belt = belt(FrictionLaw::Constant { mu: 0.3 });
    assert_eq!(Knob::StaticCoefficient.of_belt(&belt), Some(0.3));
    assert_eq!(Knob::StaticGuide.of_belt(&belt), Some(1.5));
    Knob::StaticGuide.set_in_belt(&mut belt, 2.0).unwrap();
    assert_eq!((belt.static_guide, belt.static_coefficient), (Some(2.0), None));
    let refused = Knob::Rest.set_in_belt(&mut belt, 0.5).unwrap_err();
    assert_eq!(refused, "no rest here; there are m, c, d1, d3, F, R, v0, mu_s, R_static, mu");
    let (friction, static_guide) = (1.0, None);
    let damping_ratio = vec![-0.1, 0.0];
    let mode = Mode { frequency: 250.0, mass: 4.0, damping_ratio, friction, static_guide };
    let mut mode = Source::from(Body::Mode(mode));
    mode.set(Knob::Ratio1, 0.2).unwrap();
    assert_eq!([Knob::Ratio0, Knob::Ratio1].map(|ratio| mode.get(ratio)), [Some(-0.1), Some(0.2)]);
    let refused = mode.set(Knob::BeltSpeed, 0.5).unwrap_err();
    assert_eq!(refused, "no v0 here; there are R, R_static, frequency, modal_mass, ratio0, ratio1");
}

#[test]
fn values_are_read_with_their_unit_and_refused_in_the_same_words() {
    assert_eq!(Knob::Mass.parse("250 g"), Ok(0.25));
    assert_eq!(Knob::BeltSpeed.parse("20 cm/s"), Ok(0.2));
    assert_eq!(Knob::D.parse(" \u{2212}0.3 "), Ok(-0.3));
    assert_eq!(Knob::D.parse("-0").map(f64::is_sign_positive), Ok(true), "zero has one sign");
    for (knob, text, expected) in [
        (Knob::R, "-1", "r = -1 is outside its range 0 .. 1e150"),
        (
            Knob::D2,
            "-1e-151",
            "D2 = -1e-151 is too close to 0; allowed: 0, or 1e-150 and more in magnitude",
        ),
        (Knob::D, "2e6", "D = 2000000 is outside its range -1e6 .. 1e6"),
        (Knob::Mass, "0", "m = 0 kg is outside its range 1e-12 .. 1e12 kg"),
        (Knob::Mass, "1e300", "m = 1e300 kg is outside its range 1e-12 .. 1e12 kg"),
        (Knob::D, "nan", "\"nan\" is not a number; D takes -1e6 .. 1e6"),
        (Knob::Q0, "1e400", "\"1e400\" is not a finite number; q0 takes -1e150 .. 1e150"),
        (Knob::R, "", "\"\" is not a number; r takes 0 .. 1e150"),
        (Knob::R, "0,1", "\"0,1\" is not a number; r takes 0 .. 1e150"),
        (Knob::Mass, "2 mm", "m = 2 mm has the wrong unit; it takes one such as kg"),
        (Knob::D, "2 kg", "D = 2 kg has a unit; it takes none"),
    ] {
        assert_eq!(knob.parse(text), Err(expected.to_owned()));
    }
    assert_eq!(Knob::D2.parse("-1e-150"), Ok(-1e-150));
    let at_rest = Knob::BeltSpeed.parse("0").unwrap_err();
    assert!(at_rest.starts_with("v0 = 0 m/s is") && at_rest.contains("only brakes"), "{at_rest}");
    assert!(Knob::R.check(f64::NAN).is_err() && Knob::R.check(f64::INFINITY).is_err());
}

#[test]
fn tolerances_stay_within_the_range() {
    let r = Knob::R.parse_toleranced("0.1+-0.1").unwrap();
    assert_eq!((r.middle.value, r.half_width, r.ends.lower()), (0.1, 0.1, 0.0));
    let d2 = Knob::D2.parse_toleranced("-0.1+-0.1").unwrap();
    assert_eq!(d2.ends.upper(), 0.0);
    assert_eq!(ParameterBox::from(&Parameters::default()).set(Knob::D2, d2.ends), Ok(()));
    let d = Knob::D.parse_toleranced("-0.3..-0.28").unwrap();
    assert_eq!(d.ends, Interval::new(-0.3, -0.28));
    assert_eq!(Knob::D.parse_toleranced("0.2").unwrap().ends, Interval::point(0.2));
    for (text, words) in [
        ("0.1+-0.2", "r = -0.1 is outside its range 0 .. 1e150"),
        ("1e-151..1", "r = 1e-151 is too close to 0"),
        ("0.1+-", "\"\" is not a number; r takes"),
        ("0.2..0.1", "LOW .. HIGH ascend"),
        ("0.1+--1", "an uncertainty is 0 or more"),
    ] {
        let refused = Knob::R.parse_toleranced(text).unwrap_err();
        assert!(refused.contains(words), "{text}: {refused}");
    }
}

#[test]
fn an_unknown_name_is_refused_with_the_one_that_was_meant() {
    let motion = |name| Knob::named(name, &[Group::Motion]).unwrap_err();
    assert_eq!(motion("d2"), "no number \"d2\"; did you mean D2? there are D, D2, D3, r, q0, v0");
    assert_eq!(motion("k"), "no number \"k\"; there are D, D2, D3, r, q0, v0");
    let machine = Knob::named("Rstatic", Group::SOURCE).unwrap_err();
    assert!(machine.contains("did you mean R_static? there are m, c, d1"), "{machine}");
    assert_eq!(serde_json::to_value(Knob::R).unwrap(), "r");
    assert_eq!(serde_json::from_str::<Knob>("\"v0\"").unwrap(), Knob::V0);
    assert!(serde_json::from_str::<Knob>("\"m\"").unwrap_err().to_string().contains("D, D2, D3"));
}

#[test]
fn units_of_numbers_have_their_dimensions() {
    assert_eq!(dimension_of(Knob::Stiffness.spec().unit), [1, 0, -2]);
    assert_eq!(dimension_of(Knob::CubicDamping.spec().unit), [1, -2, 1]);
    assert_eq!(dimension_of(Knob::D.spec().unit), [0; 3]);
}
