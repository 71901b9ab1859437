//! A machine in the explorer: played, shown with its units, opened from a file.

use super::*;

/// Plays keys on a scene, without a terminal; returns the session and the last screen.
fn screen(scene: Scene, keys: &str) -> (Session, String) {
    let size = Size { width: 100, height: 30 };
    let session = Session::new(Arc::new(scene), size);
    let script = parse(keys).unwrap_or_else(|error| panic!("{keys}: {error}"));
    let size = layout::Size { width: size.width, height: size.height };
    let played = replay(session, Environment::default(), script, size).unwrap();
    assert_eq!(played.unmet, None, "{keys}");
    (played.application.session().clone(), hopfscope::view::screen::text(&played.screen))
}

fn figure() -> Scene {
    (*hopfscope::scene::find("fig01").unwrap()).clone()
}

#[test]
fn a_played_motion_moves_with_the_time_it_is_told_and_then_stands_still() {
    let (session, start) = screen(figure(), "");
    assert!(session.head().is_none() && !session.is_playing());
    assert!(start.contains("x [mm]") && start.contains("t 0 s  x 1 mm  v 0 m/s"), "{start}");
    // The period is 4 s: after 2 s of playing, half a period has passed and the motion is near the left turning point.
    let (session, half) = screen(figure(), "<f8> <elapse 1.5> <elapse 0.5>");
    let head = session.head().unwrap();
    assert!(session.is_playing() && (head.tau - std::f64::consts::PI).abs() < 1e-12);
    assert!(head.q < -0.1 && head.v.abs() < 0.01, "{head:?}");
    assert_ne!(start, half);
    // While paused, time does not count; a step advances by a fortieth of a period.
    let (held, _) = screen(figure(), "<f8> <elapse 2> <f8> <elapse 5> <f9> <f9> <f7>");
    let step = std::f64::consts::TAU / 40.0;
    assert!((held.head().unwrap().tau - std::f64::consts::PI - step).abs() < 1e-12);
    // Captured: the motion rests at its end, and nothing moves any more.
    let (rest, _) = screen(figure(), "<f8> <elapse 600>");
    let motion = rest.trajectory().unwrap();
    let (tau, q) = match motion.outcome {
        Outcome::Captured { tau, q } => (tau, q),
        other => panic!("{other:?}"),
    };
    assert!(!rest.is_playing());
    assert_eq!((rest.head().unwrap().tau, rest.head().unwrap().q), (tau, q));
    // Played again, it restarts.
    let (again, _) = screen(figure(), "<f8> <elapse 600> <f8> <elapse 1>");
    assert!((again.head().unwrap().tau - 0.25 * std::f64::consts::TAU).abs() < 1e-12);
    // In real time a second is omega_0 = 50.
    let (real, _) = screen(figure(), "<C-t*3> <f8> <elapse 0.01>");
    assert!((real.head().unwrap().tau - 0.5).abs() < 1e-12);
}

#[test]
fn playing_computes_nothing() {
    let (before, _) = screen(figure(), "<f8>");
    let (after, _) = screen(figure(), "<f8> <elapse 0.3> <f9> <elapse 0.2> <C-t>");
    assert!(after.price.recomputed.is_empty());
    assert_eq!(before.wants(), after.wants());
}

#[test]
fn few_cells_change_from_frame_to_frame() {
    let cells = |text: &str| -> Vec<char> {
        text.lines().flat_map(|row| row.chars().chain(std::iter::repeat(' ')).take(100)).collect()
    };
    let mut keys = "<f8> <elapse 1>".to_owned();
    let mut last = cells(&screen(figure(), &keys).1);
    for _ in 0..5 {
        keys += " <elapse 0.016>";
        let next = cells(&screen(figure(), &keys).1);
        let changed = last.iter().zip(&next).filter(|(one, other)| one != other).count();
        assert!(next.len() == last.len() && changed < 220, "{changed} cells of {}", next.len());
        last = next;
    }
}

#[test]
fn a_machine_is_a_scene_with_physical_values_beside_the_numbers() {
    let machine = hopfscope::scene::machine::library::find("textbook").unwrap();
    let scene = ScaledMachine::new(machine.clone()).unwrap().scene();
    let (session, text) = screen(scene.clone(), "");
    assert_eq!(session.contact(), None);
    for words in ["1 N", "1 mm", "2 s", "margin from rest: 1.249 mm, 0.1448 N s", "belt"] {
        assert!(text.contains(words), "{words} in {text}");
    }
    // The line is where the velocity of the mass equals that of the belt.
    let line = |text: &str| text.matches("belt").count();
    let (_, without) = screen(scene.clone(), "<tab> v e <esc>");
    assert!(line(&without) < line(&text));
    // Less damping: the whole model sticks to the belt.
    let (whole, text) = screen(scene.clone(), "<left*30> o");
    assert!(whole.contact().is_none() && text.contains("tends to stick-slip"), "{text}");
    assert!(text.contains("whole model") && text.contains("cubic expansion: "), "{text}");
    // The expansion overtakes the belt; a motion that does so is stopped there.
    let (wild, text) = screen(scene, "| <left*30> o");
    let (tau, _) = wild.contact().expect("a motion that reaches the belt");
    assert!(
        text.contains("sticks to the belt at t = ") && text.contains("! stable cycle > belt"),
        "{text}"
    );
    let (end, _) = screen((*wild.scene).clone(), "| <left*30> o <f8> <elapse 3600>");
    assert!(!end.is_playing() && (end.head().unwrap().tau / tau - 1.0).abs() < 1e-12);
}

#[test]
fn a_machine_of_a_file_opens_in_the_explorer_only_if_it_is_one() {
    run(&["--belt", "nowhere.toml"]).is_refused(&["the machines of the program are textbook"]);
}
