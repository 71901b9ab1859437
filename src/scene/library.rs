//! The built-in scenes, and a search for one by its name.

use std::sync::{Arc, LazyLock};

use super::file::parse;
use super::mistake::{built_in, texts};
use super::scene::Scene;
use crate::numerics::similar;
use crate::words::joined;

/// The scene that opens unless another is named.
pub const PLAIN: &str = "plain";

/// The scene that opens on a first start.
pub const FIRST: &str = "first";

/// The files, in the order in which they are listed.
const FILES: [(&str, &str); 33] = texts! { "/assets/scenes/":
    "plain" "first" "capture" "linear" "marginal" "hopf" "supercritical" "subcritical" "asymmetry" "escape"
    "return-map" "regimes" "energy" "belt-speed" "inside" "benchmark" "groan" "slow-belt" "fig01"
    "fig02" "fig03" "fig04" "fig05" "fig06" "fig08" "fig09" "fig10" "fig11" "fig12" "fig14" "fig15"
    "fig16" "fig17"
};

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum SceneGroup {
    /// To learn about the oscillator.
    Lesson,
    /// To see a figure of the paper.
    Figure,
    /// A mass on a belt, in physical units.
    Machine,
}

impl SceneGroup {
    /// The group of a built-in scene.
    pub fn of(scene: &Scene) -> Self {
        match scene.machine {
            _ if scene.name.starts_with("fig") => SceneGroup::Figure,
            Some(_) => SceneGroup::Machine,
            None => SceneGroup::Lesson,
        }
    }

    /// Its heading in a list.
    pub fn title(self) -> &'static str {
        match self {
            SceneGroup::Lesson => "Lessons",
            SceneGroup::Figure => "Figures of the paper",
            SceneGroup::Machine => "Machines",
        }
    }
}

/// The built-in scenes, in the order in which they are listed.
pub fn library() -> &'static [Arc<Scene>] {
    static SCENES: LazyLock<Vec<Arc<Scene>>> =
        LazyLock::new(|| built_in(&FILES, parse).into_iter().map(Arc::new).collect());
    &SCENES
}

/// All names by which a built-in scene can be opened.
pub fn names() -> impl Iterator<Item = &'static str> {
    library().iter().flat_map(|scene| scene.names())
}

/// The file of a built-in scene, to begin one of one's own with.
pub fn text(scene: &Scene) -> Option<&'static str> {
    FILES.iter().find(|(name, _)| *name == scene.name).map(|(_, text)| *text)
}

/// The plain oscillator: linear damping and dry friction with the defaults of the parameter table.
pub fn plain() -> Arc<Scene> {
    Arc::clone(&library()[0])
}

/// The scene with this name. Fails with one line that suggests similar names.
pub fn find(name: &str) -> Result<Arc<Scene>, String> {
    let known = library().iter().find(|scene| scene.names().any(|own| own == name));
    known.cloned().ok_or_else(|| {
        let nearest = similar(name, names());
        if nearest.is_empty() {
            return format!("no scene {name:?}; there are {}", joined(names(), ", "));
        }
        format!("no scene {name:?}; did you mean {}?", nearest.join(" or "))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{Knob, State};
    use crate::scene::{Axes, said};
    use crate::scene::{View, Window};

    #[test]
    fn every_scene_of_a_figure_names_it_says_what_is_in_it_and_where_its_numbers_are_from() {
        let figures = names().filter_map(|name| Some((name, name.strip_prefix("fig")?)));
        let mut count = 0;
        for (name, number) in figures {
            let scene = find(name).unwrap();
            let number = number.trim_start_matches('0');
            assert!(scene.title.ends_with(&format!(" (Fig. {number})")), "{name}: {}", scene.title);
            let whole = |text: &str| said::said(text, |_| true);
            let said = format!("{} {}", whole(&scene.watch), whole(&scene.press));
            let sources = ["paper", "caption"];
            assert!(sources.iter().any(|source| said.contains(source)), "{name}: whose numbers?");
            assert!(scene.press.contains('{'), "{name}: something to press");
            let sentences = whole(&scene.watch).matches(". ").count() + 1;
            assert!((1..=5).contains(&sentences), "{name}: {sentences} sentences");
            // The text mentions what each plot shows.
            let spoken: [(View, &[&str]); 7] = [
                (
                    View::Phase,
                    &["phase plane", "cycle", "motion", "start", "basin", "sticking set", "spiral"],
                ),
                (View::Diagram, &["over D", "amplitude", "displacement", "branch"]),
                (View::Regimes, &["boundary", "chart"]),
                (View::TimeSeries, &["time"]),
                (View::EnergyRate, &["V'"]),
                (View::Eigenvalues, &["eigenvalue"]),
                (View::Belt, &["belt"]),
            ];
            for plot in &scene.plots {
                let words = spoken.iter().find(|(view, _)| *view == plot.view);
                let (_, words) = words.unwrap_or_else(|| panic!("{name}: {:?}", plot.view));
                let text = format!("{} {said}", scene.title);
                assert!(words.iter().any(|word| text.contains(word)), "{name}: {:?}", plot.view);
            }
            count += 1;
        }
        assert_eq!(count, 20, "fig01 to fig17, and the three parts of fig16");
    }

    #[test]
    fn every_scene_of_the_program_reads_and_explains_itself() {
        for (name, text) in FILES {
            let scene = parse(name, name, text).unwrap_or_else(|error| panic!("{error}"));
            assert!(!scene.layers.is_empty(), "{name} shows nothing");
            for (what, text) in [("look", &scene.watch), ("press", &scene.press)] {
                for sentence in [said::said(text, |_| true), said::said_by(&scene, text)] {
                    assert!(sentence.ends_with('.') && sentence.len() > 20, "{name}: {what}");
                    assert!(!sentence.contains('['), "{name}: {what} has an unknown condition");
                    assert!(
                        !sentence.contains("  ") && !sentence.contains(" ."),
                        "{name}: {sentence}"
                    );
                }
            }
            assert!(scene.title.chars().count() <= 52, "{name}: the title is one short line");
            let initial = scene.problem.initial;
            for plot in &scene.plots {
                let Window { x, y } = plot.opening();
                match plot.view {
                    View::Diagram => {
                        assert!(x.contains(scene.problem.get(plot.axes.abscissa)));
                    }
                    View::Belt => assert!(x.contains(initial.q)),
                    View::Phase => {
                        let variants = plot.family.map(|family| &scene.families[family]);
                        let starts = variants.map_or(vec![initial], |variants| {
                            variants.iter().map(|one| one.of(scene.problem).initial).collect()
                        });
                        let seen = |start: &State| x.contains(start.q) && y.contains(start.v);
                        assert!(starts.iter().all(seen), "{name}");
                    }
                    View::TimeSeries => assert!(x.contains(0.0)),
                    View::Regimes => {
                        let value = |symbol: Knob| scene.problem.get(symbol);
                        let Axes { abscissa, against, .. } = plot.axes;
                        assert!(x.contains(value(abscissa)) && y.contains(value(against)));
                    }
                    View::EnergyRate => assert!(x.contains(initial.v)),
                    // The windows of other views do not depend on the numbers of the scene.
                    _ => {}
                }
            }
        }
    }

    #[test]
    fn the_library_lists_every_file_of_the_folder() {
        let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/assets/scenes");
        let mut on_disk: Vec<String> = std::fs::read_dir(folder)
            .unwrap()
            .map(|entry| entry.unwrap().path().file_stem().unwrap().to_string_lossy().into_owned())
            .collect();
        let mut listed: Vec<String> = FILES.iter().map(|(name, _)| (*name).to_owned()).collect();
        on_disk.sort();
        listed.sort();
        assert_eq!(on_disk, listed);
    }

    #[test]
    fn both_names_of_a_lesson_that_shows_a_figure_open_it() {
        let both = library().iter().filter_map(|scene| Some((scene, scene.also.as_deref()?)));
        let found: Vec<_> = both.clone().map(|(scene, also)| (scene.name.as_str(), also)).collect();
        let expected = [
            ("linear", "fig07"),
            ("marginal", "fig16a"),
            ("supercritical", "fig16b"),
            ("subcritical", "fig16c"),
            ("asymmetry", "fig13"),
        ];
        assert_eq!(found, expected);
        for (scene, also) in both {
            assert!(Arc::ptr_eq(&find(also).unwrap(), scene), "{also}");
            assert_eq!(SceneGroup::of(scene), SceneGroup::Lesson, "{also}");
        }
        let all: std::collections::BTreeSet<_> = names().collect();
        assert_eq!(all.len(), names().count(), "each name opens one scene");
    }

    #[test]
    fn plain_is_the_oscillator_of_the_parameter_table() {
        assert_eq!(plain().name, PLAIN);
        assert_eq!(plain().problem.parameters, crate::model::Parameters::default());
        assert_eq!(plain().problem.initial, crate::model::State::default());
    }

    #[test]
    fn a_wrong_name_gets_the_nearest_ones() {
        for (wrong, expected) in [
            ("super-critical", "; did you mean supercritical"),
            ("Linear", "; did you mean linear"),
            ("xyz", "; there are plain, first"),
        ] {
            let line = find(wrong).unwrap_err();
            assert!(line.starts_with(&format!("no scene {wrong:?}{expected}")), "{line}");
        }
    }
}
