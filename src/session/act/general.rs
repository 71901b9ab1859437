//! Commands that belong to no pane: layers, harmonics, the scene's caption, appearance, retry, quitting.

use crate::accuracy::harmonic_error::ladder;
use crate::scene::Layer;
use crate::session::act::notice::{inform, with_keys};
use crate::session::effect::{Done, Effect};
use crate::session::state::session::MOST_HARMONICS;
use crate::session::state::settings::{DisplaySettings, GLYPHS, THEMES, next_of};
use crate::session::state::{Overlay, Session, SessionCaption};

/// Shows or hides a layer.
pub fn toggle(session: &mut Session, layer: Layer) {
    let on = !session.layers.remove(&layer);
    if on {
        session.layers.insert(layer);
    }
    let spec = layer.spec();
    let state = if on { "on" } else { "off" };
    let absent = !session.on_show().any(|plot| session.plots[plot].view == spec.view);
    let text = match session.not_drawn(layer) {
        Some(why) if on => format!("{}: {why}", spec.name),
        _ if on && absent => {
            format!(
                "{}: no plot shows the {}; {{views}} picks one",
                spec.name,
                spec.view.spec().title
            )
        }
        _ => format!("{} {state}: {}", spec.name, spec.meaning),
    };
    let text = with_keys(session, &text);
    inform(session, text);
}

/// Shows the cycles with the next number of harmonics on a ladder of numbers.
pub fn harmonics(session: &mut Session, more: bool) -> Done {
    let ladder = ladder(MOST_HARMONICS);
    let now = session.harmonics;
    let next = if more {
        ladder.iter().find(|count| **count > now)
    } else {
        ladder.iter().rev().find(|count| **count < now)
    };
    session.layers.insert(Layer::Balance);
    let way = if more { "more" } else { "fewer" };
    session.harmonics = *next.ok_or_else(|| format!("{now} harmonics: there are no {way}"))?;
    inform(session, format!("harmonic balance with N = {}", session.harmonics));
    Ok(())
}

/// Shows or hides the caption of the scene: what there is to see, and what to press.
pub fn explain(session: &mut Session) {
    session.caption = if session.caption == SessionCaption::Scene {
        SessionCaption::Nothing
    } else {
        SessionCaption::Scene
    };
}

/// Draws with the next set of characters.
pub fn glyphs(session: &mut Session) {
    let (glyphs, name) = next_of(&GLYPHS, session.display.glyphs);
    session.display.glyphs = glyphs;
    inform(session, format!("glyphs: {name}"));
}

/// Uses the next theme.
pub fn theme(session: &mut Session) {
    let (theme, name) = next_of(&THEMES, session.display.theme);
    session.display.theme = theme;
    inform(session, format!("theme: {name}"));
}

/// Switches a setting of the screen on or off, and says what it is then.
pub(in crate::session) fn flip(
    session: &mut Session,
    setting: fn(&mut DisplaySettings) -> &mut bool,
    [on, off]: [&str; 2],
) {
    let switch = setting(&mut session.display);
    *switch = !*switch;
    let text = if *switch { on } else { off };
    inform(session, text);
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

/// Closes the overlay.
pub fn back(session: &mut Session) {
    session.overlay = None;
}

/// Asks questions that have no answer again.
pub fn retry(session: &mut Session) {
    if !session.answers.forget_failures() {
        inform(session, "nothing has failed");
    }
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
