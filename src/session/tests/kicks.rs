//! Random kicks over the basin.

use super::Trial;
use super::saved::reopened;
use crate::flow::Limits;
use crate::picture;
use crate::picture::Item;
use crate::portrait::{Portrait, RandomKick, repeated};
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
fn a_machine_is_kicked_in_metres_by_the_whole_model() {
    let mut trial = Trial::open("slow-belt");
    trial.press("<run \"kicks q=0.1 mm+-0.3 mm,v=0+-20 mm/s\">");
    assert!(trial.session.draws_whole());
    let asked = |trial: &Trial| {
        let mut asked = trial.session.asks().into_iter();
        asked.find(|request| request.topic() == Topic::Kicks).unwrap()
    };
    let typed = RandomKick::read("q=1e-4+-3e-4,v=0+-0.02", ["m", "m/s"]).unwrap();
    let close = |request: &Request| {
        let Request::Kicks { kicks: RandomKick { q, v, .. }, .. } = request else { panic!() };
        [(q.0, typed.q.0), (q.1, typed.q.1), (v.1, typed.v.1)]
            .iter()
            .all(|(it, typed)| (it / typed - 1.0).abs() < 1e-14)
    };
    let first = asked(&trial);
    assert!(close(&first), "{first:?}");
    let Ok(Finding::Kicks(found, _)) = answer(&first, &Limits::PATIENT) else { panic!() };
    let belt = trial.session.machine().unwrap();
    let alone = typed.lost(&Portrait::of_belt(&belt).unwrap()).unwrap();
    assert!((found.part - alone.part).abs() <= found.error + alone.error, "{found:?} {alone:?}");
    assert!((0.01..0.5).contains(&found.part), "{found:?}");
    // They keep their metres where the unit of length changes.
    trial.press("<run \"set F=150 N\">");
    let second = asked(&trial);
    assert!(second != first && close(&second), "{second:?}");
    // What they are saved as can be read again, however small the unit becomes.
    reopened(&trial.session);
    trial.press("<run \"kicks q=0+-0.5,v=0+-1\"><run \"set F=1e-9 N\">");
    reopened(&trial.session);
    let before = trial.session.kicks;
    trial.give(Msg::Run("kicks q=0+-1e6".to_owned()));
    assert_eq!(trial.session.kicks, before);
}
