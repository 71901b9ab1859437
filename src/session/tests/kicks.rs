//! Random kicks over the basin.

use super::Trial;
use super::saved::reopened;
use crate::flow::Limits;
use crate::picture;
use crate::picture::Item;
use crate::portrait::Portrait;
use crate::portrait::kicks::repeated::repeated;
use crate::question::{Finding, Request, answer};
use crate::scene::{Layer, Topic};
use crate::session::Msg;

/// The titles of the plots.
fn titles(trial: &Trial) -> Vec<String> {
    let plots = 0..trial.session.plots.len();
    plots.map(|index| picture::of(&trial.session, index).title.into_owned()).collect()
}

#[test]
fn kicks_are_drawn_their_lost_part_is_told_and_a_saved_session_keeps_them() {
    let mut trial = Trial::alone("supercritical");
    assert_eq!(trial.press("<run \"kicks q=0.1+-0.2,v=0+-0.05\">"), [Topic::Kicks]);
    assert!(trial.session.layers.contains(&Layer::Kicks));
    let phase = titles(&trial).remove(0);
    assert!(phase.ends_with("kicks lost 0.125 +- 1e-11"), "{phase}");
    let drawn = picture::of(&trial.session, 0);
    let right = drawn.items.iter().filter_map(|item| match item {
        Item::Curve(line, points) if line.name.starts_with("kicks, 3") => {
            Some(points.iter().map(|at| at.x).fold(0.0, f64::max))
        }
        _ => None,
    });
    let right = right.fold(0.0, f64::max);
    assert!((right - 0.7).abs() < 1e-12, "mean and three deviations: {right}");

    reopened(&trial.session);
}

#[test]
fn kicks_that_cannot_be_read_change_nothing() {
    let mut trial = Trial::alone("supercritical");
    let before = trial.session.kicks;
    for line in ["kicks q", "kicks q=0+--1", "kicks q=nan", "kicks q=0+-1e300"] {
        trial.give(Msg::Run(line.to_owned()));
        assert_eq!(trial.session.kicks, before, "{line}");
        assert!(!trial.session.layers.contains(&Layer::Kicks), "{line}");
    }
}

#[test]
fn the_part_told_is_that_of_the_headless_command() {
    let mut trial = Trial::alone("supercritical");
    trial.press("<run \"set D=-0.3 D2=0.2 D3=0.5 r=0.1\"><run \"kicks q=0.02+-0.08,v=0+-0.1\">");
    let asked = trial.session.wants().into_iter().chain(trial.session.asks());
    let asked = asked.filter(|request| request.topic() == Topic::Kicks).collect::<Vec<Request>>();
    let Ok(Finding::Kicks(found, _)) = answer(&asked[0], &Limits::PATIENT) else {
        panic!("{asked:?}")
    };
    let parameters = trial.session.problem.parameters;
    let portrait = Portrait::of_oscillator(&parameters, 5.0, &Limits::PATIENT).unwrap();
    let whole = repeated(&portrait, &trial.session.kicks, &Limits::PATIENT).unwrap();
    assert!(found.part > 0.02 && found.error < 1e-8, "{found:?}");
    assert!((found.part - whole.first.part).abs() <= found.error + whole.first.error);
}

#[test]
fn of_the_whole_model_of_a_machine_nothing_is_told() {
    let mut trial = Trial::open("groan");
    trial.press("<run \"layer whole on\"><run \"layer kicks on\">");
    assert!(trial.session.draws_whole());
    assert!(titles(&trial).iter().any(|title| title.contains("not known of the whole model")));
    assert!(trial.session.asks().iter().all(|request| request.topic() != Topic::Kicks));
    let before = trial.session.kicks;
    trial.give(Msg::Run("kicks q=0+-0.1".to_owned()));
    assert_eq!(trial.session.kicks, before);
}
