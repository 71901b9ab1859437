//! The mass on its belt and what is played: proportions, what is drawn so far, and what it costs on the line.

use super::bytes::Explorer;
use super::pictures::answered;
use super::{braille, draw};
use hopfscope::picture::{Item, Picture, in_room};
use hopfscope::scene::{Point, View, find, library};
use hopfscope::session::replay::{Action, Player, parse};
use hopfscope::session::{Msg, Session, Size, update};
use hopfscope::view::screen::text;

/// A session of a scene, with all answers, after these keys.
fn played(scene: &str, size: (u16, u16), keys: &str) -> Session {
    let size = Size { width: size.0, height: size.1 };
    let mut session = Session::new(find(scene).unwrap(), size);
    answered(&mut session);
    let mut player = Player::new(parse(keys).unwrap());
    while let Action::Give(message) = player.next(true, String::new).unwrap() {
        update(&mut session, message);
        answered(&mut session);
    }
    session
}

/// The points of the curves with this name.
fn curves(picture: &Picture, name: &str) -> Vec<Vec<Point>> {
    let named = picture.items.iter().filter_map(|item| match item {
        Item::Curve(line, points) if line.name == name => Some(points.clone()),
        _ => None,
    });
    named.collect()
}

fn plot(session: &Session, view: View) -> usize {
    session.plots.iter().position(|plot| plot.view == view).unwrap()
}

#[test]
fn the_mass_is_as_high_as_wide_and_inside_whatever_the_shape_of_its_plot() {
    for scene in ["first", "fig01", "slow-belt"] {
        let session = played(scene, (120, 40), "");
        for columns in [20.0, 26.0, 54.0, 90.0, 140.0] {
            for rows in [5.0, 7.0, 14.0, 30.0, 55.0] {
                let picture = in_room(&session, plot(&session, View::Belt), [columns, rows]);
                let mass = &curves(&picture, "mass")[0];
                let (x, y) = (picture.window.x, picture.window.y);
                // A row is twice as high as a column is wide.
                let wide = (mass[1].x - mass[0].x) / x.width() * columns;
                let high = (mass[2].y - mass[1].y) / y.width() * rows * 2.0;
                assert!((wide - high).abs() < 1e-9, "{scene} {columns} {rows}: {wide} {high}");
                assert!(wide >= 2.0 && high <= 2.0 * rows, "{scene} {columns} {rows}");
                let inside =
                    mass.iter().all(|at| (y.from() - 1e-9..=y.to() + 1e-9).contains(&at.y));
                assert!(inside, "{scene} {columns} {rows}");
            }
        }
    }
}

#[test]
fn a_played_motion_is_drawn_up_to_its_head_and_its_end_told_when_it_is_there() {
    for (keys, at_end) in
        [("", false), ("<elapse 5>", false), ("<elapse 60>", true), ("<esc>", true)]
    {
        let session = played("first", (80, 24), keys);
        let picture = in_room(&session, plot(&session, View::Phase), [30.0, 20.0]);
        let motion = &curves(&picture, "motion")[0];
        let last = *motion.last().unwrap();
        let end = session.trajectory().unwrap().end();
        let until = if at_end { end } else { session.head().unwrap() };
        assert_eq!((last.x, last.y), (until.q, until.v), "{keys}");
        let screen = text(&draw(&session, braille()));
        assert_eq!(screen.contains("comes to rest at q"), at_end, "{keys}: {screen}");
        assert_eq!(screen.contains("under way"), !at_end, "{keys}");
    }
}

#[test]
fn the_line_of_playback_says_whether_it_plays_and_how_far_it_is() {
    for size in [(80, 24), (120, 40), (200, 60), (60, 16)] {
        let line = |keys: &str| {
            let screen = text(&draw(&played("first", size, keys), braille()));
            let lines: Vec<&str> = screen.lines().collect();
            let below = if size.1 < 20 { 3 } else { 4 };
            lines[lines.len() - below].to_owned()
        };
        for (keys, words) in [
            ("<elapse 2>", ["playing", "3.14 of", "F8 pauses"]),
            ("<elapse 2> <f8> <elapse 9>", ["paused", "3.14 of", "F8 plays"]),
            ("<elapse 99>", ["ended", " of ", "F8 plays"]),
            // Scrubbing goes on playing: four steps of a fortieth of a period.
            ("<elapse 2> <f9*4>", ["playing", "3.77 of", "F8 pauses"]),
        ] {
            let line = line(keys);
            for word in words {
                assert!(line.contains(word), "{size:?} {keys}: {line}");
            }
            assert!(!line.contains('\u{2026}'), "{size:?}: cut: {line}");
        }
    }
    let still = text(&draw(&played("plain", (80, 24), ""), braille()));
    assert!(!still.contains("paused"), "nothing is played: {still}");
}

#[test]
fn a_second_of_playback_takes_four_kilobytes_at_80x24_and_ten_at_120x40() {
    for (width, height, most) in [(80, 24, 4_000), (120, 40, 10_000)] {
        for scene in library().iter().filter(|scene| scene.families.is_empty()) {
            let mut explorer = Explorer::open(scene, width, height);
            explorer.draw();
            if !explorer.session.playback.playing {
                explorer.press("<f8>");
            }
            if !explorer.session.playback.playing {
                continue;
            }
            let (mut passed, mut bytes, mut frames) = (0.0, 0, 0);
            explorer.elapse(0.25);
            while passed < 2.0 {
                let pause = explorer.screen.pause().as_secs_f64();
                bytes += explorer.elapse(pause);
                (passed, frames) = (passed + pause, frames + 1);
            }
            let name = &scene.name;
            assert!(bytes <= 2 * most, "{name}: {bytes} bytes in 2 s at {width}x{height}");
            let ended = !explorer.session.playback.playing;
            assert!(ended || frames >= 14, "{name}: {frames} frames in 2 s at {width}x{height}");
        }
    }
}

#[test]
fn enter_goes_deeper_from_the_first_screen_and_nothing_moves_any_more() {
    let session = played("first", (80, 24), "<elapse 1> <enter>");
    assert_eq!(session.scene.name, "plain");
    assert!(session.playback.at.is_none() && !session.is_moving());
    let back = played("first", (80, 24), "<elapse 1> <enter> u");
    assert_eq!((back.scene.name.as_str(), back.is_moving()), ("first", false));
}

#[test]
fn the_first_motion_comes_to_rest_and_then_nothing_is_drawn() {
    let session = played("first", (80, 24), "<elapse 60>");
    assert!(!session.is_moving());
    assert!(session.trajectory().unwrap().crossings.len() > 4, "a few visible swings");
    let mut later = session.clone();
    update(&mut later, Msg::Elapsed { seconds: 1.0 });
    assert_eq!(later.playback, session.playback);
}
