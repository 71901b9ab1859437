//! Axes have names and units, and what belongs to a line stands on it.

use ratatui::layout::Rect;

use super::pictures::{answered, computed};
use super::{all_pictures, braille, draw, settled};
use hopfscope::picture;
use hopfscope::picture::{Item, Picture};
use hopfscope::scene::{VIEWS, View, library};
use hopfscope::session::{Session, Size};
use hopfscope::view::layout::layout;
use hopfscope::view::plot::{rows, shown};

/// The title line of a plot at the sizes that most screens have.
fn title_lines(session: &mut Session, about: &str) -> Vec<(String, String, Picture<'static>)> {
    let mut lines = Vec::new();
    for (width, height) in [(80, 24), (120, 40), (200, 60)] {
        session.size = Size { width, height };
        let buffer = draw(session, braille());
        let parts = layout(Rect::new(0, 0, width, height), session).unwrap();
        for (index, area) in parts.plots.iter().enumerate().filter(|(_, area)| !area.is_empty()) {
            let row =
                (area.x..area.right()).map(|x| buffer[(x, area.y)].symbol()).collect::<String>();
            let of = picture::of(session, index);
            let axes = Picture {
                x: of.x.clone(),
                y: of.y.clone(),
                scales: of.scales,
                reading: of.reading.clone(),
                ..Picture::new("", "", "", of.window)
            };
            lines.push((format!("{about} {width}x{height} plot {index}"), row, axes));
        }
    }
    lines
}

#[test]
fn every_axis_of_every_plot_has_its_name() {
    let mut missing = Vec::new();
    let scenes = library().iter().map(|scene| computed(&scene.name));
    let views = VIEWS.iter().filter(|view| {
        ![View::Scan, View::Damping, View::Residuals, View::Spread].contains(&view.view)
    });
    let alone = views.map(|view| {
        let letters: Vec<String> = view.name.chars().map(String::from).collect();
        settled("supercritical", 120, 40, &format!("<tab> Q V / {} <enter>", letters.join(" ")))
    });
    for mut session in scenes.chain(alone) {
        let about = format!("{} {:?}", session.scene.name, session.plots[0].view);
        for (about, row, axes) in title_lines(&mut session, &about) {
            for (scale, name) in axes.scales.iter().zip([&axes.x, &axes.y]) {
                let name = scale.title(name);
                // The sketch of a machine reads its position in its units, where there is no room for both.
                let letter = name.split(' ').next().unwrap_or_default();
                let read = axes
                    .reading
                    .as_ref()
                    .is_some_and(|it| it.split(' ').any(|word| word == letter));
                let told = read && row.contains(&format!(" {letter} "));
                if !row.contains(name) && !told {
                    missing.push(format!("{about}: {name} in {row}"));
                }
            }
        }
    }
    assert_eq!(missing, [""; 0]);
}

#[test]
fn the_line_of_rest_runs_through_the_middle_of_its_cells() {
    for scene in ["linear", "asymmetry", "supercritical", "groan"] {
        for (width, height) in [(80, 24), (120, 40), (200, 60), (100, 31)] {
            let session = settled(scene, width, height, "");
            let parts = layout(Rect::new(0, 0, width, height), &session).unwrap();
            for (index, area) in parts.plots.iter().enumerate() {
                if session.plots[index].view != View::Phase || area.is_empty() {
                    continue;
                }
                let window = shown(*area, &session, index, picture::scales(&session, index));
                let rows = window.y.fraction(0.0) * f64::from(rows(*area));
                assert!((rows.fract() - 0.5).abs() < 1e-9, "{scene} {width}x{height}: {rows}");
            }
        }
    }
}

/// Where the curves of this name in a picture end, across.
fn ends(picture: &Picture, name: &str) -> Vec<f64> {
    let named = picture.items.iter().filter_map(|item| match item {
        Item::Curve(line, points) if line.name == name => Some(points[1].x),
        _ => None,
    });
    named.collect()
}

#[test]
fn the_bar_of_friction_ends_within_its_limits_and_that_of_the_spring_opposite_the_mass() {
    let mut bars = 0;
    for scene in library() {
        let mut session = computed(&scene.name);
        let Some(index) = session.plots.iter().position(|plot| plot.view == View::Belt) else {
            continue;
        };
        let width = session.plots[index].window.x.width();
        for q in [-0.3, -0.1, 0.0, 0.1, 0.3] {
            session.problem.initial.q = q * width;
            answered(&mut session);
            let picture = picture::of(&session, index);
            let [limits, friction, spring] =
                ["limit of friction", "friction on the mass", "spring on the mass"]
                    .map(|name| ends(&picture, name));
            assert!((limits[0]..=limits[1]).contains(&friction[0]), "{}: {q}", scene.name);
            assert_eq!(spring, [-q * width], "{}", scene.name);
            bars += 1;
        }
    }
    assert!(bars > 10, "{bars}");
}

#[test]
fn beside_metres_a_displacement_is_called_x() {
    for scene in library() {
        let session = settled(&scene.name, 120, 40, "");
        for picture in all_pictures(&session) {
            let physical = picture.scales.iter().any(|scale| scale.title("").starts_with("x ["));
            let curves = picture.items.iter().filter_map(|item| match item {
                Item::Curve(line, _) => Some(&line.name),
                _ => None,
            });
            let captions = picture.captions.iter().map(|caption| &caption.short);
            for text in curves.chain(captions).filter(|_| physical) {
                assert!(text.split(' ').all(|word| word != "q"), "{}: {text}", scene.name);
            }
        }
    }
}
