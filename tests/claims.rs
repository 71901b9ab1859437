//! The paper against computation: what is known to be wrong is found to be wrong, by numbers.

use std::collections::BTreeSet;

use hopfscope::flow::{Limits, Reason};
use hopfscope::scene::library::library;
use hopfscope::study::claims::{Examined, Finding, UNSAID, Verdict, claims, examine};

fn all() -> Vec<Examined> {
    claims().map(|claim| examine(claim, &Limits::PATIENT).unwrap()).collect()
}

/// The findings about an equation whose statement contains some words.
fn about<'a>(all: &'a [Examined], equation: &str, words: &str) -> &'a Finding {
    let matching =
        |one: &&Examined| one.claim.equation == equation && one.claim.statement.contains(words);
    let found: Vec<_> = all.iter().filter(matching).collect();
    assert_eq!(found.len(), 1, "{equation} {words}");
    found[0].finding.as_ref().unwrap_or_else(|reason| panic!("{equation} {words}: {reason}"))
}

#[test]
fn every_claim_is_decided_by_numbers() {
    let all = all();
    assert!(all.len() > 100);
    for one in &all {
        let name = format!("{} {}", one.claim.equation, one.claim.statement);
        let finding = one.finding.as_ref().unwrap_or_else(|reason| panic!("{name}: {reason}"));
        assert!(finding.computed.value.is_finite() && finding.computed.error >= 0.0, "{name}");
        assert!(finding.bound() >= 0.0 && finding.difference().unwrap().is_finite(), "{name}");
        assert!(finding.cases > 0, "{name}");
        assert_eq!(finding.paper.is_none(), one.claim.section == UNSAID, "{name}");
        // What is computed is known well enough to decide: to six digits or a count.
        assert!(finding.computed.error <= 1e-5 * finding.computed.value.abs().max(1e-5), "{name}");
    }

    // What is printed wrong fails, and its corrected form holds.
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
        let finding = about(&all, equation, words);
        assert!(matches!(finding.verdict(), Verdict::Corrected { .. }), "{equation}: {finding:?}");
        assert!(finding.miss() > 1e-3, "{equation}: {finding:?}");
    }

    // What is said and not so.
    for (equation, words) in [
        ("5", "periodic solution"),
        ("5.1", "trapped"),
        ("(39)", "strong"),
        ("Fig. 9", "between"),
        ("(51)", "D = -0.4"),
        ("(51)", "D = -0.7"),
        ("Fig. 12a", "approaches"),
        ("Fig. 13", "large amplitude"),
    ] {
        let finding = about(&all, equation, words);
        assert_eq!(finding.verdict(), Verdict::False, "{equation}: {finding:?}");
    }

    // The belt is overtaken where it is slow: at the speeds at which `hopfscope belt --sweep` says so.
    let slower = about(&all, "after (2)", "stay slower");
    assert_eq!(slower.verdict(), Verdict::InPart, "{slower:?}");
    assert_eq!((slower.cases, slower.computed.value), (6, 3.0));
    assert!(slower.place.contains("v0 = 0.05 m/s"), "{}", slower.place);
    let contact = about(&all, "x' < v0", "overtakes");
    assert!(matches!(contact.verdict(), Verdict::Approximates { .. }), "{contact:?}");
    assert!((0.22..0.24).contains(&contact.computed.value), "{contact:?}");

    // Known numbers, computed elsewhere.
    let close = |equation, words, expected: f64, digits: f64| {
        let found = about(&all, equation, words).computed.value;
        assert!((found - expected).abs() < digits, "{equation} {words}: {found}");
    };
    close("(51)", "D = -0.7", 0.109_641, 1e-6);
    close("(48)", "D2 = 0.2", -0.047_785_9, 1e-7);
    close("(48)", "D2 = 0.5", -0.054_101_4, 1e-7);
    close("D_c", "worst", -0.776_232, 1e-6);
    close("(30)", "-0.999", 6.539_33e-31, 1e-36);
    let within = |equation, words, most: f64| match about(&all, equation, words).verdict() {
        Verdict::Approximates { within } => assert!(within < most, "{equation}: {within}"),
        other => panic!("{equation}: {other:?}"),
    };
    within("(48)", "D2 = 0:", 0.006);
    within("D_c", "worst", 0.03);
}

#[test]
fn the_scenes_that_show_claims_exist() {
    let scenes: BTreeSet<_> = library().iter().map(|scene| scene.name.clone()).collect();
    for claim in claims() {
        assert!(claim.scene.is_none_or(|name| scenes.contains(name)), "{claim:?}");
    }
}

#[test]
fn an_interrupted_examination_says_so() {
    let stopped = Limits { evaluations: 1_000_000, interrupted: &|| true };
    let claim = claims().find(|claim| claim.equation == "(31)").unwrap();
    assert_eq!(examine(claim, &stopped).unwrap_err(), Reason::Interrupted);
}
