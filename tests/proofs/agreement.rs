//! The search and the proof where they are hardest to compare.

use hopfscope::branch::fold::fold;
use hopfscope::flow::Limits;
use hopfscope::model::{Border, Kicks, Margin, Parameters};
use hopfscope::numerics::Interval;
use hopfscope::numerics::elementary::pow;
use hopfscope::numerics::random::Random;
use hopfscope::portrait::Portrait;
use hopfscope::portrait::basin::cycle::cycles;
use hopfscope::portrait::proved::{agreed, matching, proved};
use hopfscope::proof::kicks::kicks;
use hopfscope::proof::{ParameterBox, prove};

/// Compares search and proof; returns how many cycles are proved.
fn compared(parameters: &Parameters) -> usize {
    let found = cycles(parameters, &Limits::PATIENT).unwrap();
    let proof = proved(&found).unwrap_or_else(|wrong| panic!("{parameters:?}: {wrong}"));
    let mut matched = Vec::new();
    for cycle in &found.cycles {
        let Some(proved) = matching(&proof, cycle) else { continue };
        assert_eq!(proved.stable, cycle.stable, "{parameters:?}");
        assert!(!matched.contains(&proved.within.lower()), "{parameters:?}: {cycle:?} {proof:?}");
        matched.push(proved.within.lower());
        if let Some(bounds) = proved.enclosure {
            let near = bounds.q_max.widened(cycle.errors.unwrap().q_max);
            assert!(near.contains(cycle.q_max), "{parameters:?}: {} {cycle:?}", bounds.q_max);
        }
    }
    assert_eq!(matched.len(), proof.cycles.len(), "{parameters:?}");
    matched.len()
}

/// Just below a fold two cycles are closer to each other than the numbers of a search usually need to be to
/// their enclosures.
#[test]
fn next_to_a_fold_search_and_proof_agree() {
    const FOLDS: usize = 80;
    for (d, d3, r) in [
        (-0.160_284_293_573_615_73, 2.027_890_111_334_697_7, 0.044_469_434_139_195_345),
        (-0.103_614_069_590_636_76, 3.556_393_885_871_639e-5, 5.520_650_863_841_507_5),
    ] {
        compared(&Parameters { d, d2: 0.0, d3, r });
    }
    let mut chance = Random::new(3);
    let mut both = 0;
    for _ in 0..FOLDS {
        let mut even = |low: f64, high: f64| low + (high - low) * chance.even();
        let (d2, d3, r) = (even(-3.0, 3.0), pow(10.0, even(-5.0, 1.0)), pow(10.0, even(-3.0, 0.5)));
        let below = pow(10.0, even(-15.0, -10.0));
        let at = Parameters { d: 0.0, d2, d3, r };
        let (found, _) = fold(&at, &Limits::PATIENT).unwrap();
        let d = found.unwrap().d;
        both += usize::from(compared(&Parameters { d: d - below * d.abs(), ..at }) == 2);
    }
    assert!(both >= FOLDS / 10, "{both} of {FOLDS} are proved");
}

/// What is proved about one basin contradicts what is found about another.
#[test]
fn a_proof_that_contradicts_the_basin_found_is_not_shown() {
    let all = |d: f64| Parameters { d, d2: 0.2, d3: 0.5, r: 0.1 };
    let survey = |parameters| Portrait::of_oscillator(&parameters, 1.0, &Limits::PATIENT);
    let kicks = |parameters: Parameters| {
        kicks(&prove(&ParameterBox::from(&parameters), &[]), &Margin::ENDLESS)
    };
    let [cycle, none] = [-0.2, 0.2].map(all);
    for (parameters, edge) in [(cycle, Border::Cycle), (none, Border::None)] {
        let shown = agreed(kicks(parameters), &survey(parameters).unwrap());
        assert_eq!((shown.edge, shown.open), (Some(edge), None));
    }
    let off = |bounds: Option<Interval>| bounds.map(|it| it * 1.001);
    let same = kicks(cycle);
    let mut displaced = same;
    displaced.sizes.displacement = off(same.sizes.displacement);
    let mut pushed = same;
    pushed.sizes.impulse = off(same.sizes.impulse);
    for proved in [kicks(none), displaced, pushed] {
        let shown = agreed(proved, &survey(cycle).unwrap());
        assert_eq!((shown.edge, shown.sizes), (None, Kicks::default()));
        assert!(shown.open.unwrap().starts_with("not proved, because"), "{shown:?}");
    }
}
