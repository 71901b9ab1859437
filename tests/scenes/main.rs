//! Each scene fulfils the promises of its texts, under the keys that they name.

mod costs;
#[path = "../explorer/mod.rs"]
mod explorer;
mod lists;
mod replays;

use hopfscope::closed_form::harmonic::amplitudes;
use hopfscope::flow::trajectory::trajectory;
use hopfscope::flow::{Detail, Fate, Limits, Method, Outcome, Reason};
use hopfscope::model::{Group, Knob};
use hopfscope::numerics::elementary::hypot;
use hopfscope::portrait::{Border, Cycle, Return};
use hopfscope::question::answer;
use hopfscope::scene::{Finding, Request, Topic, find};
use hopfscope::session::replay::{Action, Player, parse};
use hopfscope::session::{MachineMargins, Msg, Session, Size, run_line, settle, update};

/// A scene with its motion and cycles computed; diagrams are ignored here.
struct Stage(Session);

/// The computed answer to a request.
fn computed(request: &Request) -> Msg {
    Msg::answered(request.clone(), Ok(answer(request, &Limits::PATIENT).unwrap()), 0.0)
}

impl Stage {
    fn open(scene: &str) -> Self {
        let mut stage = Stage(Session::new(find(scene).unwrap(), Size { width: 80, height: 24 }));
        stage.settle();
        stage
    }

    fn press(mut self, keys: &str) -> Self {
        let mut player = Player::new(parse(keys).unwrap());
        while let Action::Give(message) = player.next(true, String::new).unwrap() {
            update(&mut self.0, message);
            self.settle();
        }
        self
    }

    fn settle(&mut self) {
        settle(&mut self.0, |_, request| {
            let diagram = matches!(request.topic(), Topic::Branch | Topic::MachineBranch);
            (!diagram).then(|| computed(request))
        });
    }

    fn outcome(&self) -> Outcome {
        self.0.trajectory().unwrap().outcome
    }

    fn is_captured(&self) -> bool {
        matches!(self.outcome(), Outcome::Captured { .. })
    }

    fn cycles(&self) -> &[Cycle] {
        &self.0.cycles().unwrap().cycles
    }

    fn edge(&self) -> Border {
        self.0.cycles().unwrap().portrait.border
    }
}

#[test]
fn plain_five_steps_of_damping_bring_the_start_into_the_basin() {
    let stage = Stage::open("plain");
    assert_eq!(stage.edge(), Border::Cycle);
    let Outcome::Moving { q, v, .. } = stage.outcome() else { panic!("the swings grow") };
    assert!(hypot(q, v) > 2.0);
    assert!(!Stage::open("plain").press("<right*2>").is_captured());
    assert!(Stage::open("plain").press("<right*5>").is_captured());
}

#[test]
fn every_border_that_is_a_cycle_has_two_sides() {
    for scene in ["plain", "linear", "marginal", "supercritical", "subcritical", "asymmetry"] {
        assert_eq!(Stage::open(scene).edge(), Border::Cycle);
        assert!(Stage::open(scene).press("i").is_captured(), "inside of {scene}");
        assert!(!Stage::open(scene).press("o").is_captured(), "outside of {scene}");
    }
}

#[test]
fn capture_each_half_swing_loses_twice_the_friction() {
    let stage = Stage::open("capture");
    let crossings = &stage.0.trajectory().unwrap().crossings;
    let places = [-0.85, 0.65, -0.45, 0.25, -0.05];
    assert_eq!(crossings.len(), places.len());
    for (crossing, place) in crossings.iter().zip(places) {
        assert!((crossing.q - place).abs() < 1e-10, "{crossing:?} at {place}");
    }
    assert!(stage.is_captured());
}

#[test]
fn basin_closes_around_the_sticking_set() {
    let near = Stage::open("linear").press("<left*6>");
    assert_eq!(near.0.problem.parameters.d, -0.7);
    assert!((near.cycles()[0].q_max - 1.1).abs() < 0.005);
    let nearer = Stage::open("linear").press("-0.99<enter>");
    assert!(nearer.cycles()[0].clearance < 1e-9);
    assert!(!nearer.press("o").is_captured());
}

#[test]
fn basin_has_a_border_even_where_no_number_lies_between_it_and_the_sticking_set() {
    let nearest = Stage::open("linear").press("-0.999<enter>");
    assert!(nearest.cycles()[0].clearance < 1e-30);
    assert!(!nearest.press("o").is_captured());
}

#[test]
fn marginal_the_harmonic_amplitude_lies_below_the_cycle() {
    assert!(Stage::open("marginal").is_captured());
    assert!(!Stage::open("marginal").press("<left>").is_captured());
    let share = |keys| {
        let stage = Stage::open("marginal").press(keys);
        let found = stage.0.cycles().unwrap();
        amplitudes(&found.parameters)[0].amplitude / found.cycles[0].q_max
    };
    assert!((0.99..1.0).contains(&share("")));
    assert!((share("-0.7<enter>") - 5.0 / 6.0).abs() < 0.01);
}

#[test]
fn hopf_without_friction_every_motion_tends_to_the_cycle() {
    let stage = Stage::open("hopf");
    assert_eq!(stage.0.problem.parameters.r, 0.0);
    let [cycle] = stage.cycles() else { panic!("one cycle") };
    assert!(cycle.stable);
    // The explorer does not look for turning points without friction; here they are needed.
    assert!(stage.0.trajectory().unwrap().crossings.is_empty());
    let motion = trajectory(&stage.0.problem, Detail::default(), &Limits::PATIENT);
    let last = motion.crossings.last().unwrap().q;
    assert!((last.abs() - cycle.q_max).abs() < 1e-4);
    // Four times the damping gives twice the amplitude.
    let smaller = Stage::open("hopf").press("-0.025<enter>").cycles()[0].q_max;
    assert!((cycle.q_max / smaller - 2.0).abs() < 0.01);
    assert!(Stage::open("hopf").press("<right*11>").cycles().is_empty());
    let friction = Stage::open("hopf").press("x<down*3><right>");
    assert!(friction.0.problem.parameters.r > 0.0 && friction.edge() == Border::Cycle);
}

#[test]
fn supercritical_two_cycles_meet_in_a_fold() {
    let stage = Stage::open("supercritical");
    let [inner, outer] = stage.cycles() else { panic!("two cycles") };
    assert!(!inner.stable && outer.stable);
    assert_eq!(Stage::open("supercritical").press("<right*12>").cycles().len(), 2);
    let beyond = Stage::open("supercritical").press("<right*13>");
    assert!(beyond.cycles().is_empty() && beyond.is_captured());
    assert_eq!(beyond.press("u").cycles().len(), 2);
}

#[test]
fn subcritical_the_border_stays_when_damping_turns_positive() {
    let mut last = 0.0;
    for keys in ["", "<right*10>", "<right*20>"] {
        let stage = Stage::open("subcritical").press(keys);
        let [cycle] = stage.cycles() else { panic!("one cycle") };
        assert!(!cycle.stable && cycle.q_max > last);
        last = cycle.q_max;
        let kicked = stage.press("o").outcome();
        assert!(matches!(kicked, Outcome::Escaped { .. }), "{kicked:?}");
    }
}

#[test]
fn asymmetry_moves_the_mean_to_the_left_and_ends_the_cycle() {
    let stage = Stage::open("asymmetry");
    assert!(stage.is_captured());
    assert!(stage.cycles()[0].q_min + stage.cycles()[0].q_max < -0.3);
    assert_eq!(Stage::open("asymmetry").press("<right*12>").edge(), Border::Cycle);
    let beyond = Stage::open("asymmetry").press("<right*13>");
    assert!(beyond.cycles().is_empty());
    assert_eq!(beyond.edge(), Border::Separatrix);
}

#[test]
fn escape_in_finite_time_until_the_start_is_slow_enough() {
    let stage = Stage::open("escape");
    assert!(matches!(stage.outcome(), Outcome::Escaped { tau } if tau < 2.0));
    assert_eq!(stage.edge(), Border::Separatrix);
    let slow = Stage::open("escape").press("<down*4><right*5>");
    assert_eq!(slow.0.problem.initial.v, -1.0);
    assert!(slow.is_captured());
    assert_eq!(Stage::open("escape").press("<left>").edge(), Border::Separatrix);
    assert_eq!(Stage::open("escape").press("<left*3>").edge(), Border::Cycle);
}

#[test]
fn return_map_lies_above_the_diagonal_between_the_cycles_and_below_it_beyond_the_fold() {
    let stage = Stage::open("return-map");
    let [inner, outer] = stage.cycles() else { panic!("two cycles") };
    let (inner, outer) = (inner.q_max, outer.q_max);
    let right = |stage: &Stage| stage.0.return_map(1).unwrap().sides[1].clone();
    for Return { from, to } in right(&stage) {
        let climbs = to.unwrap() > from;
        assert_eq!(climbs, inner < from && from < outer, "{from} to {to:?}");
    }
    assert!(Stage::open("return-map").press("i").is_captured());
    assert!(!Stage::open("return-map").press("o").is_captured());
    let beyond = Stage::open("return-map").press("<right*13>");
    assert!(right(&beyond).iter().skip(1).all(|turn| turn.to.unwrap() < turn.from));
}

#[test]
fn energy_friction_pays_for_the_inner_cycle_and_cubic_damping_for_the_outer_one() {
    let works = |stage: &Stage| stage.0.cycles().unwrap().works.clone();
    let stage = Stage::open("energy");
    let cycles = works(&stage);
    let named =
        |cycle: usize| ["linear", "cubic", "friction"].map(|source| cycles[cycle].work(source));
    for (cycle, ledger) in cycles.iter().enumerate() {
        let [linear, cubic, friction] = named(cycle);
        assert!(linear > 0.0 && friction < 0.0 && cubic < 0.0);
        assert!((ledger.residual / linear).abs() < 1e-12);
    }
    let [[_, inner, inner_friction], [_, outer, outer_friction]] = [named(0), named(1)];
    assert!(inner_friction < 10.0 * inner && outer < 3.0 * outer_friction);
    // The energy gained by the motion is stored: it is that of the outer cycle, at some phase.
    let motion = stage.0.trajectory().unwrap().ledger.clone().unwrap();
    assert!(motion.end > 5.0 * motion.start && motion.residual.abs() < 1e-9);
    let rows = |stage: &Stage| stage.0.ledger().len();
    // D2 adds one source in each part.
    let bent = Stage::open("energy").press("<down><right>");
    assert_eq!(rows(&bent), rows(&stage) + 3);
    assert!(Stage::open("energy").press("<right*13>").cycles().is_empty());
}

/// A possible statement of a text about the screen, and the check of its truth.
type Claim = (&'static str, fn(&Stage) -> bool);

const CLAIMS: [Claim; 24] = [
    ("Two cycles: the inner one", |stage| stage.kinds() == (true, true)),
    ("This start lies outside", |stage| !stage.rests_in_the_end()),
    ("This start lies inside", Stage::rests_in_the_end),
    ("so the swings grow", |stage| !stage.rests_in_the_end()),
    ("From here it comes to rest", Stage::rests_in_the_end),
    ("From here it swings up", |stage| !stage.rests_in_the_end()),
    ("What the motion gains", |stage| !stage.rests_in_the_end()),
    ("The motion climbs", |stage| !stage.rests_in_the_end()),
    ("an unstable cycle, borders their basin", |stage| stage.edge() == Border::Cycle),
    ("it is the border of the basin", |stage| stage.edge() == Border::Cycle),
    ("the two make the unstable cycle", |stage| stage.kinds().0),
    ("There is one cycle, unstable", |stage| stage.kinds() == (true, false)),
    ("no cycle is left", |stage| stage.cycles().is_empty()),
    ("no cycle exists", |stage| stage.cycles().is_empty()),
    ("Here nothing borders", |stage| stage.edge() == Border::None),
    ("every other motion tends to the stable cycle", |stage| stage.kinds() == (false, true)),
    ("the outer one is shifted", |stage| stage.kinds() == (true, true)),
    ("Here no cycle exists", |stage| stage.edge() == Border::Separatrix),
    ("Here the cycle has gone to infinity", |stage| stage.edge() == Border::Separatrix),
    ("A cycle sticks to the belt", |stage| sticking(stage).0 > 0),
    ("Once stuck", |stage| sticking(stage).0 > 0),
    ("has reached the belt's line", |stage| sticking(stage).0 > 0),
    ("Rest is stable too", |stage| stage.border() == Some(Border::Cycle)),
    ("just touches the belt", |stage| stage.border() == Some(Border::Grazing)),
];

impl Stage {
    /// Whether there are unstable and stable cycles.
    fn kinds(&self) -> (bool, bool) {
        let any = |stable: bool| self.cycles().iter().any(|cycle| cycle.stable == stable);
        (any(false), any(true))
    }

    /// What borders the basin in the whole model.
    fn border(&self) -> Option<Border> {
        self.0.machine_margins().and(self.0.cycles()).map(|found| found.portrait.border)
    }

    /// Whether the motion eventually comes to rest: by the whole model where that is drawn.
    fn rests_in_the_end(&self) -> bool {
        if let Some((_, fate)) = self.0.course().filter(|_| self.0.draws_whole()) {
            return fate == Fate::Rest;
        }
        let problem = hopfscope::flow::Problem { until: 1e4, ..self.0.problem };
        let motion = trajectory(&problem, Detail::default(), &Limits::PATIENT);
        matches!(motion.outcome, Outcome::Captured { .. })
    }

    /// The scene after a line, with motion and cycles computed; `None` where the line is refused.
    fn at(scene: &str, line: &str) -> Option<Stage> {
        let mut session = Session::new(find(scene).unwrap(), Size { width: 80, height: 24 });
        run_line(&mut session, line).ok()?;
        settle(&mut session, |_, request| {
            matches!(request.topic(), Topic::Trajectory | Topic::Cycles).then(|| computed(request))
        });
        Some(Stage(session))
    }
}

#[test]
fn no_text_contradicts_what_is_on_show_anywhere_in_the_ranges_of_its_scene() {
    let ranges: [(&str, &[f64]); 7] = [
        ("D", &[-0.8, -0.5, -0.3, -0.2, -0.15, -0.1, -0.05, -0.02, 0.0, 0.05, 0.3]),
        ("D2", &[-0.5, 0.0, 0.3, 1.0]),
        ("D3", &[-0.5, 0.0, 0.1, 1.0]),
        ("r", &[0.0, 0.02, 0.3, 1.0]),
        ("q0", &[0.05, 0.2, 0.6, 1.2]),
        ("v0", &[-0.5, 0.3, 1.0]),
        ("belt", &[0.02, 0.1, 0.3, 0.6, 1.0, 1.9]),
    ];
    let mut checked = std::collections::BTreeSet::new();
    for scene in hopfscope::scene::library() {
        let said = [scene.watch.as_str(), &scene.press].join(" ");
        let declared = |name: &&(&str, &[f64])| match Knob::named(name.0, &[Group::Motion]).ok() {
            Some(symbol) => scene.declares(symbol),
            None => scene.machine.is_some(),
        };
        for (name, values) in ranges.iter().filter(declared) {
            for value in *values {
                let line = format!("set {name}={value}");
                let Some(stage) = Stage::at(&scene.name, &line) else { continue };
                let text = stage.0.said(&said);
                assert!(!text.contains('['), "{}: {text}", scene.name);
                for (claim, holds) in CLAIMS.iter().filter(|(claim, _)| text.contains(claim)) {
                    assert!(holds(&stage), "{} at {name} = {value}: {text}", scene.name);
                    checked.insert(*claim);
                }
            }
        }
    }
    let silent: Vec<_> = CLAIMS.iter().filter(|(claim, _)| !checked.contains(claim)).collect();
    assert!(
        silent.is_empty(),
        "never said: {:?}",
        silent.iter().map(|row| row.0).collect::<Vec<_>>()
    );
}

/// Number of cycles of the whole model that stick to the belt, and of those that only slip.
fn sticking(stage: &Stage) -> (usize, usize) {
    let cycles = stage.cycles();
    let sticks = cycles.iter().filter(|cycle| cycle.sticks()).count();
    (sticks, cycles.len() - sticks)
}

#[test]
fn benchmark_rest_and_stick_slip_are_parted_by_a_cycle_until_the_belt_is_fast() {
    let stage = Stage::open("benchmark");
    let margins = stage.0.machine_margins().unwrap();
    assert_eq!((stage.edge(), sticking(&stage)), (Border::Cycle, (1, 1)));
    let [whole, cubic] = [margins.whole, margins.cubic].map(|margin| margin.displacement.unwrap());
    assert!(cubic > 1.1 * whole, "{cubic} {whole}");
    assert_eq!(stage.0.course().unwrap().1, Fate::Cycle(1));
    assert!(stage.0.trajectory().unwrap().rides().count() > 3);
    let end = Stage::open("benchmark").press(":set<space>belt=1.836<enter>");
    assert_eq!(sticking(&end), (1, 1));
    let beyond = Stage::open("benchmark").press(":set<space>belt=1.837<enter>");
    assert_eq!((beyond.edge(), sticking(&beyond)), (Border::None, (0, 0)));
    assert_eq!(beyond.0.course().unwrap().1, Fate::Rest);
    // One key switches to the expansion: the question is a different one, and so is the answer.
    let cubic = Stage::open("benchmark").press("|");
    assert!(!cubic.0.draws_whole());
    assert!(cubic.cycles()[0].q_max > 1.1 * stage.cycles()[0].q_max);
}

#[test]
fn groan_needs_no_cycle_to_be_parted_from_rest() {
    let stage = Stage::open("groan");
    let cubic = stage.0.machine_margins().unwrap().cubic;
    assert_eq!((stage.edge(), sticking(&stage)), (Border::Grazing, (1, 0)));
    assert_eq!(stage.0.course().unwrap().1, Fate::Cycle(0));
    assert_eq!(cubic.displacement, None);
    assert!(Stage::open("groan").press("i").is_captured());
    let fast = Stage::open("groan").press(":set<space>belt=0.5<enter>");
    assert_eq!(sticking(&fast), (0, 0));
}

#[test]
fn slow_belt_the_stable_cycle_grows_into_the_line() {
    assert_eq!(sticking(&Stage::open("slow-belt")), (1, 1));
    for (speed, sticks) in [("0.2269", 1), ("0.2271", 0)] {
        let stage = Stage::open("slow-belt").press(&format!(":set<space>belt={speed}<enter>"));
        assert_eq!(sticking(&stage), (sticks, 2 - sticks), "{speed}");
    }
}

#[test]
fn inside_both_models_agree_about_rest() {
    let MachineMargins { whole, cubic } = Stage::open("inside").0.machine_margins().unwrap();
    let ratio = |one: Option<f64>, other: Option<f64>| (one.unwrap() / other.unwrap() - 1.0).abs();
    assert!(ratio(whole.displacement, cubic.displacement) < 1e-12);
    assert!(ratio(whole.impulse, cubic.impulse) < 1e-12);
}

#[test]
fn a_text_about_a_start_disappears_with_it() {
    let here = Stage::open("plain");
    assert!(here.0.said(&here.0.scene.watch).contains("so the swings grow"));
    let inside = here.press("<right*5>");
    assert!(inside.is_captured());
    let text = inside.0.said(&inside.0.scene.watch);
    assert!(!text.contains("grow") && text.contains("comes to rest"), "{text}");
}

#[test]
fn a_machine_is_followed_by_the_method_that_is_chosen_and_as_exactly_as_the_dial_says() {
    let motion = |method, tolerance| {
        let mut session = Session::new(find("benchmark").unwrap(), Size { width: 80, height: 24 });
        (session.problem.method, session.problem.tolerance) = (method, tolerance);
        let mut asked = session.wants().into_iter();
        let asked = asked.find(|request| request.topic() == Topic::Trajectory).unwrap();
        match answer(&asked, &Limits::PATIENT)? {
            Finding::Trajectory(found) => Ok::<_, Reason>(found),
            other => panic!("{other:?}"),
        }
    };
    let exact = motion(Method::Auto, 1e-15).unwrap();
    assert_eq!(exact.method, Method::Taylor);
    for (method, fine, coarse) in [
        (Method::Taylor, 1e-12, 1e-3),
        (Method::Dop853, 1e-12, 1e-3),
        (Method::Dopri5, 1e-10, 1e-3),
    ] {
        let [near, far] = [fine, coarse].map(|tolerance| {
            let found = motion(method, tolerance).unwrap();
            assert_eq!(found.method, method);
            let rides = [&found, &exact].map(|motion| motion.rides().count());
            assert_eq!(rides[0], rides[1], "{method} at {tolerance}");
            assert_eq!(found.crossings.len(), exact.crossings.len());
            let apart = found.crossings.iter().zip(&exact.crossings);
            apart.map(|(one, other)| (one.tau - other.tau).abs()).fold(0.0, f64::max)
        });
        // The steps are short enough for order eight to err by rounding alone, whatever the tolerance.
        let rounding = if method == Method::Dop853 { 1e-11 } else { 0.0 };
        assert!(near < 1e-9 && near < far.max(rounding), "{method}: {near:e} {far:e}");
    }
    assert!(motion(Method::Rk4, 1e-10).is_err(), "it knows one line only");
}
