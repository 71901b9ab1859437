//! Half widths of the parameters and the disturbance: typed, stepped, undone, saved, and asked for.

use super::Trial;
use super::facts::refuses;
use super::saved::reopened;
use crate::model::{Interval, Knob, Parameters, Tolerances};
use crate::question;
use crate::question::answer;
use crate::scene::{Answer, Request, Topic};
use crate::session::{Row, Uncertainty};

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
    trial.goes(&[(": set D=-0.3..-0.25", "D -0.275")]);
    assert!((trial.session.doubt.half_width(Knob::D) - 0.025).abs() < 1e-16);
    trial.goes(&[(": set D=-0.3", "D -0.3")]);
    assert_eq!(trial.session.doubt, Uncertainty::default());
    refuses(
        "plain",
        &[
            (": set r=0.1+--1", "..a tolerance is 0 or more"),
            (": set r=0.1+-0.2", "..r = -0.1"),
            (": set q0=1+-0.1", "..q0 has no half width; only D, D2, D3 and r have one"),
            (": set w=-1", "..disturbance = -1 is outside its range 0 .. 1e150"),
        ],
    );
}

/// Compared with reference numbers for D = -0.3, D2 = 0.2, D3 = 0.5, r = 0.1.
#[test]
fn what_is_certain_is_asked_with_the_box_and_answers_the_reference() {
    let mut trial = Trial::open("plain");
    trial.press(":set<space>D=-0.3<space>D2=0.2<space>D3=0.5<space>r=0.1<space>w=0.02<enter>");
    let request = certainty(&trial).unwrap();
    let Answer::Zones(found) = answer(&request, &crate::flow::Limits::PATIENT).unwrap() else {
        panic!("{request:?}")
    };
    let margin = found.guaranteed.unwrap().displacement.unwrap();
    assert!((margin - 0.1743).abs() < 5e-5, "{margin}");
    assert!((found.nominal.displacement.unwrap() - 0.2190).abs() < 5e-5);
    trial.press(":set<space>D3=0.5+-0.1<enter>");
    let Some(Request::Zones(question::zones::Inputs { known, disturbance })) = certainty(&trial)
    else {
        panic!()
    };
    assert_eq!((known.d3, disturbance), (Interval::around(0.5, 0.1), 0.02));
    // However close to 0 its ends are: a tolerance that were left out would promise too much.
    for (d2, half) in [(0.2, 0.2), (3e-150, 2.5e-150)] {
        let doubt = Uncertainty::default().with_half_width(Knob::D2, half).unwrap();
        let known = doubt.known(&Parameters { d2, ..Parameters::default() });
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
            trial.session.doubt.on_machine(&running, &belt).unwrap();
        (half_widths["R"], disturbance)
    };
    let before = newtons(&trial);
    trial.press(":set<space>belt=0.4<space>m/s<enter>");
    let after = newtons(&trial);
    assert!((after.0 / before.0 - 1.0).abs() < 1e-12, "{before:?} {after:?}");
    assert!((after.1 / before.1 - 1.0).abs() < 1e-12, "{before:?} {after:?}");
    trial.press(":layer<space>whole<space>on<enter>");
    assert!(matches!(certainty(&trial), Some(Request::MachineZones(_))), "by the whole model");
}
