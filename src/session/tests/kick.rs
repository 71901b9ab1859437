//! Kicks of the mass at rest, with true answers: where the margin lies, and how it is tried and told.

use crate::flow::Limits;
use crate::model::{Parameters, State};
use crate::numerics::hypot;
use crate::question::answer;
use crate::scene::{Layer, View, find};
use crate::session::replay::{Action, Player, parse};
use crate::session::settings::DisplaySettings;
use crate::session::{Context, Msg, Session, Size, settle, update};
use crate::view::{Look, picture, screen};

/// A session that is answered truly.
struct Kicked(Session);

impl Kicked {
    fn open(scene: &str, size: (u16, u16)) -> Self {
        let size = Size { width: size.0, height: size.1 };
        let mut kicked = Kicked(Session::new(find(scene).unwrap(), size));
        kicked.settle();
        kicked
    }

    /// The plain oscillator at other parameters.
    fn at(parameters: Parameters) -> Self {
        let mut kicked = Kicked::open("plain", (80, 24));
        kicked.0.problem.parameters = parameters;
        kicked.press("<esc>");
        kicked
    }

    fn settle(&mut self) {
        settle(&mut self.0, |_, request| {
            let found = |request| answer(request, &Limits::PATIENT).expect("it has an answer");
            Some(Msg::answered(request.clone(), Ok(found(request)), 0.0))
        });
    }

    fn press(&mut self, keys: &str) -> &mut Self {
        let mut player = Player::new(parse(keys).unwrap());
        while let Action::Give(message) = player.next(true, String::new).unwrap() {
            update(&mut self.0, message);
            self.settle();
        }
        self
    }

    /// Whether a motion from this start survives.
    fn survives(&mut self, start: State) -> Option<bool> {
        self.0.problem.initial = start;
        self.press("<esc>");
        self.0.survives()
    }

    /// The rows of the screen.
    fn rows(&self) -> Vec<String> {
        let Size { width, height } = self.0.size;
        let look = Look::new(DisplaySettings::default());
        let drawn = picture((width, height).into(), &self.0, &look);
        screen::text(&drawn).lines().map(str::to_owned).collect()
    }

    /// The two status lines.
    fn told(&self) -> [String; 2] {
        let rows = self.rows();
        let [outcome, margin, _] = &rows[rows.len() - 3..] else { panic!("{rows:?}") };
        [outcome, margin].map(|row| row.trim().to_owned())
    }
}

/// Oscillators with a border, of an unstable cycle or a separatrix, symmetric and not.
const SETS: [[f64; 4]; 6] = [
    [-0.1, 0.0, 0.0, 0.1],
    [-0.3, 0.0, 0.5, 0.1],
    [-0.3, 0.2, 0.5, 0.1],
    [-0.2, -0.2, 0.0, 0.5],
    [0.1, 0.0, -0.5, 0.2],
    [0.05, 0.3, 0.0, 0.1],
];

#[test]
fn below_the_margin_a_kick_from_the_worst_rest_position_is_survived_and_above_it_is_lost() {
    let of_set = |[d, d2, d3, r]: [f64; 4]| Kicked::at(Parameters { d, d2, d3, r });
    let machines = ["slow-belt", "inside", "benchmark"].map(|name| Kicked::open(name, (80, 24)));
    for mut kicked in SETS.map(of_set).into_iter().chain(machines) {
        let found = kicked.0.cycles().unwrap().clone();
        let nearest = found.nearest.expect("there is a border");
        let margin = found.margin.from_rest.impulse.unwrap();
        assert!((nearest.v.abs() / margin - 1.0).abs() < 1e-12, "{nearest:?} {margin}");
        for (part, survives) in [(0.99, true), (1.01, false)] {
            let start = State { v: part * nearest.v, ..nearest };
            assert_eq!(kicked.survives(start), Some(survives), "{part} {start:?}");
            let border = kicked.0.kick().unwrap().border.unwrap();
            assert!((border / margin - 1.0).abs() < 1e-12, "{border} {margin}");
        }
        // Elsewhere, and in the other direction, it takes no less.
        for start in [nearest.q, 0.0, -nearest.q].map(|q| State { q, v: nearest.v }) {
            for v in [start.v, -start.v].map(|v| 0.999 * v) {
                assert_eq!(kicked.survives(State { v, ..start }), Some(true), "{start:?}");
            }
        }
    }
}

#[test]
fn six_keys_lead_to_a_kick_survived_and_one_lost() {
    for scene in ["plain", "supercritical", "subcritical", "escape", "slow-belt", "inside"] {
        let mut kicked = Kicked::open(scene, (80, 24));
        let before = kicked.0.problem.initial;
        kicked.press("t");
        assert!(kicked.0.playback.playing && kicked.0.kicking, "{scene}");
        assert_eq!(kicked.0.survives(), Some(true), "{scene}");
        let mut keys = 1;
        while kicked.0.survives() == Some(true) {
            kicked.press("<right>");
            keys += 1;
        }
        assert!(keys <= 6, "{scene}: {keys}");
        // Each change is undone by itself, the first one last.
        kicked.press(&"u".repeat(keys));
        assert_eq!(kicked.0.problem.initial, before, "{scene}");
    }
}

#[test]
fn the_mass_is_kicked_where_it_rests_and_a_shift_is_no_kick() {
    let mut kicked = Kicked::open("supercritical", (80, 24));
    kicked.0.problem.initial = State { q: 0.2, v: 0.0 };
    kicked.press("<esc>");
    let shift = kicked.0.kick().unwrap();
    let margin = kicked.0.cycles().unwrap().margin;
    assert_eq!((shift.is_shift, shift.size, shift.border), (true, 0.2, margin.displacement));
    let rest = kicked.0.trajectory().unwrap().outcome.state().unwrap().0;
    kicked.press("t");
    assert_eq!(kicked.0.problem.initial.q, rest);
    // The others act as always, and the trial ends with the kick.
    kicked.press("<tab><lt>");
    assert!(kicked.0.kicking && kicked.0.problem.parameters.d == -0.31);
    assert_eq!(kicked.0.contexts()[..2], [Context::Kick, Context::View(View::Phase)]);
    kicked.press("<run \"set v0=0\">");
    assert!(!kicked.0.kicking);
}

#[test]
fn arrows_change_the_size_and_a_key_turns_the_direction() {
    let mut kicked = Kicked::open("plain", (80, 24));
    let mut speed = |keys: &str| kicked.press(keys).0.problem.initial.v;
    let first = speed("t");
    assert_eq!(first, -0.56);
    assert_eq!([speed("<right>"), speed("<left>")], [-0.58, -0.56]);
    assert_eq!([speed("<up>"), speed("<down>")], [-0.66, -0.56]);
    assert_eq!([speed("-"), speed("<enter>"), speed("-")], [0.56, 0.56, -0.56]);
    assert_eq!(speed("<left*40>"), -0.02);
    assert_eq!(kicked.0.notice.clone().unwrap().text, "no smaller kick; - turns its direction");
    assert!(kicked.press("<esc>").0.contexts()[0] == Context::Parameters);
}

#[test]
fn what_becomes_of_a_kick_is_told_when_it_is_seen() {
    for size in [(80, 24), (120, 40), (200, 60)] {
        let mut kicked = Kicked::open("plain", size);
        let [outcome, gauge] = kicked.press("t").told();
        let told = "kick 0.56 from rest at q = 0.1, 0.9 of the margin there: ..";
        assert!(outcome.starts_with(told), "{size:?} {outcome}");
        assert!(gauge.starts_with("kick ━") && gauge.contains("0.56 of 0.6245"), "{gauge}");
        let [outcome, _] = kicked.press("<elapse 1000>").told();
        assert!(outcome.starts_with("■ survived: comes to rest at q = -0.0568"), "{outcome}");
        let [outcome, _] = kicked.press("<up>").told();
        assert!(outcome.starts_with("kick 0.66 from rest at q = 0.1, 1.1 of the"), "{outcome}");
        // Two periods, of eight seconds in all, show that its swings grow.
        let [outcome, gauge] = kicked.press("<elapse 8.1>").told();
        assert!(outcome.starts_with("● lost: grows without bound"), "{outcome}");
        assert!(gauge.contains("┃╸"), "{gauge}");
        let drawn = kicked.rows().join("\n");
        assert!(drawn.contains("margin 0.6245"), "{drawn}");
        // Letting go brings the numbers back.
        let [_, margin] = kicked.press("<esc>").told();
        assert!(margin.contains("from rest: shift 0.5387"), "{margin}");
    }
}

#[test]
fn where_every_kick_is_survived_kicks_have_a_readable_size() {
    let mut kicked = Kicked::at(Parameters { d: 0.1, d2: 0.0, d3: 0.1, r: 0.1 });
    let [outcome, margin] = kicked.press("t<elapse 1000>").told();
    assert!(outcome.starts_with("■ survived: comes to rest"), "{outcome}");
    assert_eq!(margin, "every kick is survived");
    assert_eq!(kicked.0.problem.initial.v, 0.46);
    // Without friction nothing holds the mass, and no kick is survived where damping feeds it.
    let mut kicked = Kicked::at(Parameters { d: -0.1, d2: 0.0, d3: 0.0, r: 0.0 });
    let [outcome, _] = kicked.press("t<elapse 1000>").told();
    assert!(outcome.starts_with("● lost: grows without bound"), "{outcome}");
}

#[test]
fn the_arrow_of_the_layer_ends_on_the_border() {
    for scene in ["asymmetry", "slow-belt"] {
        let mut kicked = Kicked::open(scene, (120, 40));
        kicked.press("<run \"layer margin on\">");
        assert!(kicked.0.layers.contains(&Layer::Margin));
        let found = kicked.0.cycles().unwrap();
        let tip = found.nearest.unwrap();
        let apart = |at: &State| hypot(at.q - tip.q, at.v - tip.v);
        let least = found.edge.iter().map(apart).fold(f64::INFINITY, f64::min);
        assert!(least < 0.02 * tip.v.abs(), "{scene}: {least} {tip:?}");
    }
}

#[test]
fn where_no_plot_shows_the_motion_it_is_not_kicked() {
    let mut kicked = Kicked::open("plain", (80, 24));
    let before = kicked.press("<run \"view eigenvalues\"><tab>z").0.setup();
    kicked.press("<run \"try-kick\">");
    let why = "no plot shows what a kick does: V or :view phase shows it";
    assert_eq!(kicked.0.notice.clone().unwrap().text, why);
    assert!(!kicked.0.kicking && kicked.0.setup() == before);
}
