//! Commands that belong to no pane: layers, harmonics, appearance, retry, counts, quitting.

use crate::accuracy::ladder;
use crate::scene::{Layer, LayerSpec};
use crate::session::{
    DisplaySettings, Done, Effect, Key, LARGEST_COUNT, MOST_HARMONICS, NamedValue, Overlay,
    PendingInput, Session, next_of,
};

/// Shows or hides a layer.
pub fn toggle(session: &mut Session, layer: Layer) {
    let on = !session.layers.remove(&layer);
    if on {
        session.layers.insert(layer);
    }
    let LayerSpec { name, view, meaning, .. } = layer.spec();
    let text = match session.not_drawn(layer) {
        Some(why) if on => format!("{name}: {why}"),
        _ if on && !session.shows(layer) => {
            format!("{name}: no plot shows the {}; {{views}} picks one", view.spec().title)
        }
        _ => format!("{name} {}: {meaning}", if on { "on" } else { "off" }),
    };
    session.inform_of_keys(&text);
}

/// Shows the cycles with the next number of harmonics on a ladder of numbers.
pub fn harmonics(session: &mut Session, more: bool) -> Done {
    let ladder = ladder(MOST_HARMONICS);
    let now = session.harmonics;
    let (next, way) = if more {
        (ladder.iter().find(|count| **count > now), "more")
    } else {
        (ladder.iter().rfind(|count| **count < now), "fewer")
    };
    session.layers.insert(Layer::Balance);
    balance(session, *next.ok_or_else(|| format!("{now} harmonics: there are no {way}"))?);
    Ok(())
}

/// Shows the cycles by this number of harmonics.
pub fn balance(session: &mut Session, harmonics: usize) {
    session.harmonics = harmonics;
    session.layers.insert(Layer::Balance);
    session.inform(format!("harmonic balance with N = {harmonics}"));
}

/// Takes the next value for a setting of the screen.
pub fn turn<T: NamedValue>(
    session: &mut Session,
    what: &str,
    setting: fn(&mut DisplaySettings) -> &mut T,
) {
    let place = setting(&mut session.display);
    let (next, name) = next_of(*place);
    *place = next;
    session.inform(format!("{what}: {name}"));
}

/// Switches a setting of the screen on or off, and says what it is then.
pub fn flip(
    session: &mut Session,
    setting: fn(&mut DisplaySettings) -> &mut bool,
    [on, off]: [&str; 2],
) {
    let switch = setting(&mut session.display);
    *switch = !*switch;
    let text = if *switch { on } else { off };
    session.inform(text);
}

/// Switches phase planes between equal units and filling their whole space.
pub fn equal(session: &mut Session) {
    let on = "phase planes fill their panes: a circle need not look like one";
    flip(session, |it| &mut it.stretched, [on, "equal units: a circle looks like one"]);
}

/// Shows axes of machines with or without units.
pub fn units(session: &mut Session) {
    let said = ["axes without units: q, v and tau", "axes of machines in their units"];
    flip(session, |it| &mut it.dimensionless, said);
}

/// Shows what a class reads, or everything.
pub fn lecture(session: &mut Session) {
    let said = ["lecture: {lecture} brings everything back", "everything is shown again"];
    let said = said.map(|text| session.with_keys(text));
    flip(session, |it| &mut it.lecture, [&said[0], &said[1]]);
}

/// Asks questions that have no answer again.
pub fn retry(session: &mut Session) -> Done {
    session.answers.forget_failures().then_some(()).ok_or_else(|| "nothing has failed".to_owned())
}

/// Plays the pasted keys after confirmation.
pub fn accept_offer(session: &mut Session) {
    match session.overlay.take() {
        Some(Overlay::Offer(script)) => session.effects.push(Effect::Play(script)),
        other => session.overlay = other,
    }
}

pub fn quit(session: &mut Session) {
    session.quit = true;
    session.effects.push(Effect::Quit);
}

/// Adds the digit of this key to a count, and waits for more.
pub fn count(session: &mut Session, key: Key) {
    let before = if let Some(PendingInput::Count(before)) = session.pending {
        before
    } else {
        0
    };
    let digit = key.typed().and_then(|char| char.to_digit(10)).unwrap_or(0);
    session.pending = Some(PendingInput::Count((10 * before + digit).min(LARGEST_COUNT)));
}

/// Deletes the last digit of a count.
pub fn delete_digit(session: &mut Session) {
    if let Some(PendingInput::Count(count)) = &mut session.pending {
        *count /= 10;
    }
}
