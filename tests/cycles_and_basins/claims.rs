//! The paper against computation: statements known to be wrong are found wrong, by numbers.

use std::sync::LazyLock;

use hopfscope::flow::{Limits, Reason};
use hopfscope::paper::{Certainty, ClaimResult, Evidence, Sense, UNSAID, Verdict, claims, examine};
use hopfscope::scene::find;

/// Change of energy of the piecewise linear motion with D = -0.1, r = 0.1 from rest at q = 1.5 until tau = 20,
/// from its closed form with 30 digits.
const CHANGE_OF_ENERGY: f64 = 21.673_075_535_168_95;

/// All claims, examined once for all tests.
static ALL: LazyLock<Vec<ClaimResult>> =
    LazyLock::new(|| claims().map(|claim| examine(claim, &Limits::PATIENT).unwrap()).collect());

/// The evidence about an equation whose statement contains some words.
fn about(equation: &str, words: &str) -> &'static Evidence {
    let matching =
        |one: &&ClaimResult| one.claim.equation == equation && one.claim.statement.contains(words);
    let found: Vec<_> = ALL.iter().filter(matching).collect();
    assert_eq!(found.len(), 1, "{equation} {words}");
    found[0].evidence.as_ref().unwrap_or_else(|reason| panic!("{equation} {words}: {reason}"))
}

#[test]
fn every_claim_is_decided_by_numbers() {
    let mut told = std::collections::BTreeSet::new();
    for one in ALL.iter() {
        let name = format!("{} {}", one.claim.equation, one.claim.statement);
        let evidence = one.evidence.as_ref().unwrap_or_else(|reason| panic!("{name}: {reason}"));
        assert!(evidence.computed.value.is_finite() && evidence.computed.error >= 0.0, "{name}");
        assert!(evidence.bound() >= 0.0 && evidence.difference().unwrap().is_finite(), "{name}");
        assert!((1..).contains(&evidence.cases) && evidence.held <= evidence.cases, "{name}");
        // A claim stands once, with what it is compared with.
        assert!(told.insert(one.claim.statement) && !one.claim.basis.is_empty(), "{name}");
        assert_eq!(evidence.paper.is_none(), one.claim.section == UNSAID, "{name}");
        // Computed numbers are known well enough to decide: to six digits, or as a count.
        assert!(
            evidence.computed.error <= 1e-5 * evidence.computed.value.abs().max(1e-5),
            "{name}"
        );
    }
}

#[test]
fn misprints_fail_and_their_corrections_hold() {
    for (equation, words) in [
        ("after (3)", "c/m"),
        ("(6)", "2 D ="),
        ("(6)", "D2 ="),
        ("(7)", "D3 ="),
        ("(7)", "r ="),
        ("(8)", "f_R"),
        ("(9)", "frequency"),
        ("(11)", "cross"),
        ("(12)", "stop"),
        ("(18)", "f_R"),
        ("(24)", "D2 acts"),
        ("(25)", "q - r"),
        ("(33)", "A_v"),
        ("(36)", "sin"),
        ("(41)", "in a turn"),
        ("before (52)", "8 D3"),
        ("(53)", "A_01"),
    ] {
        let evidence = about(equation, words);
        assert!(
            matches!(evidence.verdict(), Verdict::Corrected { .. }),
            "{equation}: {evidence:?}"
        );
        assert!(evidence.miss() > 1e-3, "{equation}: {evidence:?}");
    }
}

#[test]
fn false_statements_are_found_false() {
    for (equation, words) in [
        ("5", "periodic solution"),
        ("5.1", "trapped"),
        ("Fig. 9", "between"),
        ("(51)", "amplitude of the cycle"),
        ("6.4", "with D2 as without"),
    ] {
        let evidence = about(equation, words);
        assert_eq!(evidence.verdict(), Verdict::False, "{equation}: {evidence:?}");
    }
}

/// The first of these cases lies in the paper's own range.
#[test]
fn general_statements_fail_in_some_cases() {
    for (equation, words, fails) in [
        ("Fig. 10", "D3 > 0", "D = -0.637, D3 = 0.25, r = 1"),
        ("Fig. 10", "D3 < 0", "D = -1, D3 = -0.1, r = 0.1"),
        ("Fig. 10", "D3 = 0", "D = -1, r = 0.1"),
        ("6.4", "for all values of D", "D = -1, r = 1"),
        ("6.4, Fig. 13", "merely distorts", "D = -0.07, D2 = 0.2, r = 0.5"),
    ] {
        let evidence = about(equation, words);
        assert_eq!(evidence.verdict(), Verdict::InPart, "{equation}: {evidence:?}");
        assert_eq!(evidence.place, format!("first fails at {fails}"), "{equation} {words}");
    }
}

/// At D = -0.3 alone (52) would pass, 9.2 % off: next to the fold it is off by 45 %.
#[test]
fn approximations_are_judged_over_a_range() {
    for (equation, words, held, off) in [
        ("(39)", "frequency", 4, 1.294),
        ("(41)", "size of the basin", 4, 0.295),
        ("(42)", "unstable", 4, 0.294),
        ("(48)", "does not depend", 1, 0.1347),
        ("(51)", "small amplitude", 2, 0.294),
        ("(52)", "large amplitude", 2, 0.446),
    ] {
        let evidence = about(equation, words);
        assert_eq!((evidence.verdict(), evidence.held), (Verdict::InPart, held), "{evidence:?}");
        assert!((evidence.miss() - off).abs() < 2e-3, "{equation}: {evidence:?}");
    }
}

/// The paper draws them as curves of its own equation, and as such they are right.
#[test]
fn the_figures_of_amplitudes_are_compared_with_the_equation_that_they_show() {
    for (equation, words, basis) in [
        ("Fig. 12a", "A_1 and A_2", "(42)"),
        ("Fig. 12b", "A_1 as D", "(42)"),
        ("Fig. 14", "shifts", "(40, 42)"),
        ("(51)", "exact solution", "(42)"),
        ("(51)", "amplitude of the cycle", "cycle"),
    ] {
        let verdict = about(equation, words).verdict();
        assert_eq!(verdict == Verdict::False, basis == "cycle", "{equation}: {verdict:?}");
        let stands = |claim: &&hopfscope::paper::Claim| {
            claim.equation == equation && claim.statement.contains(words)
        };
        assert_eq!(claims().find(stands).unwrap().basis, basis);
    }
}

/// (18, 19) over the motion, compared with the closed form half swing by half swing.
#[test]
fn the_rates_of_the_energy_add_up_to_its_change() {
    for equation in ["(18)", "(19)"] {
        let change = about(equation, "change of the energy").computed.value;
        assert!((change - CHANGE_OF_ENERGY).abs() < 1e-9, "{equation}: {change}");
    }
}

#[test]
fn nothing_passes_as_an_approximation_that_is_off_by_more_than_a_tenth() {
    for one in ALL.iter() {
        if let Some(Verdict::Approximates { within }) = one.verdict() {
            let limit = one.evidence.as_ref().unwrap().sense == Sense::Tends;
            assert!(within <= 0.1 || limit, "{} {within}", one.claim.statement);
        }
    }
}

/// At the speeds where `hopfscope scan --machine` reports it.
#[test]
fn the_belt_is_overtaken_where_it_is_slow() {
    let slower = about("after (2)", "stay slower");
    assert_eq!(slower.verdict(), Verdict::InPart, "{slower:?}");
    assert_eq!((slower.cases, slower.computed.value), (6, 3.0));
    assert!(slower.place.contains("v0 = 0.05 m/s"), "{}", slower.place);
    let contact = about("x' < v0", "overtakes");
    assert!(matches!(contact.verdict(), Verdict::Approximates { .. }), "{contact:?}");
    assert!((0.22..0.24).contains(&contact.computed.value), "{contact:?}");
}

#[test]
fn numbers_computed_elsewhere_are_found_again() {
    let close = |equation, words, expected: f64, digits: f64| {
        let found = about(equation, words).computed.value;
        assert!((found - expected).abs() < digits, "{equation} {words}: {found}");
    };
    close("(51)", "amplitude of the cycle", 0.100_305, 1e-6);
    close("(48)", "does not depend", -0.054_101_4, 1e-7);
    close("D_c", "worst", -0.776_232, 1e-6);
    close("(30)", "-0.999", 6.539_33e-31, 1e-36);
    let within = |equation, words, most: f64| match about(equation, words).verdict() {
        Verdict::Approximates { within } => assert!(within < most, "{equation}: {within}"),
        other => panic!("{equation}: {other:?}"),
    };
    within("(48)", "D2 = 0:", 0.006);
    within("D_c", "worst", 0.03);
}

#[test]
fn what_proofs_reach_carries_a_mark_and_no_mark_contradicts_a_verdict() {
    let marked = ALL.iter().filter(|one| one.evidence.as_ref().unwrap().mark.is_some()).count();
    assert!(3 * marked >= 2 * ALL.len(), "{marked} claims are marked");
    for one in ALL.iter() {
        let evidence = one.evidence.as_ref().unwrap();
        let (mark, name) = (evidence.mark, one.claim.statement);
        match evidence.verdict() {
            Verdict::Agrees | Verdict::Approximates { .. } => {
                assert_ne!(mark, Some(Certainty::Refuted), "{name}");
            }
            _ => assert!([None, Some(Certainty::Refuted)].contains(&mark), "{name}: {mark:?}"),
        }
        if let Some(bounds) = evidence.computed.bounds {
            // A number found by the search lies within the proved bounds, up to its own error.
            let (value, slack) = (evidence.computed.value, evidence.computed.error);
            let within = bounds.lower() - slack <= value && value <= bounds.upper() + slack;
            assert!(within, "{name}: {value} {bounds}");
        }
    }
    for (equation, words, mark) in [
        ("5", "periodic solution", Certainty::Refuted),
        ("(24)", "D2 acts", Certainty::Refuted),
        ("(30)", "-0.999", Certainty::Enclosed),
        ("(48)", "D2 = 0:", Certainty::Proved),
        ("(48)", "does not depend", Certainty::Refuted),
        ("Fig. 9", "between", Certainty::Refuted),
        ("Fig. 9", "below both", Certainty::Proved),
        ("Fig. 10", "D3 > 0", Certainty::Refuted),
        ("multiplier", "slope", Certainty::Enclosed),
        ("escape", "D3 < 0", Certainty::Proved),
        ("D_c", "worst", Certainty::Proved),
        ("D_c", "none above", Certainty::Proved),
    ] {
        assert_eq!(about(equation, words).mark, Some(mark), "{equation} {words}");
    }
}

#[test]
fn the_scenes_that_show_claims_exist() {
    for claim in claims() {
        assert!(claim.scene.is_none_or(|name| find(name).is_ok()), "{claim:?}");
    }
}

#[test]
fn an_interrupted_examination_says_so() {
    let stopped = Limits { evaluations: 1_000_000, interrupted: &|| true };
    let claim = claims().find(|claim| claim.equation == "(31)").unwrap();
    assert_eq!(examine(claim, &stopped).unwrap_err(), Reason::Interrupted);
}
