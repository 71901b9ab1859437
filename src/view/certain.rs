//! What is safe for certain, in words: the kicks that are survived whatever the parameters and the disturbance
//! are, beside those that are survived without doubt.

use crate::oscillator::Symbol;
use crate::scene::Topic;
use crate::session::Session;
use crate::study::Margin;
use crate::words::number::significant;
use crate::words::quantity::with_unit;

/// Columns of a screen that has room for margins as forces too.
const WIDE: u16 = 110;

/// Digits of a margin.
const PLACES: usize = 4;

/// The status line about margins; `None` where nothing is in doubt and no layer asks.
pub fn status(session: &Session) -> Option<String> {
    let (nominal, sure) = margins(session)?;
    let nominal = match size(session, &nominal, PLACES) {
        Some(size) => format!("nominal: kicks up to {size}"),
        None => "nominal: every kick is survived".to_owned(),
    };
    let sure = match sure.map(|sure| size(session, &sure, PLACES)) {
        Ok(Some(size)) => format!("for certain: {size}"),
        Ok(None) => "for certain: every kick".to_owned(),
        Err(why) => format!("nothing is certain: {why}"),
    };
    Some(format!("{nominal}; {sure}"))
}

/// The line of the pane, as wide as it may be.
pub fn line(session: &Session, width: usize) -> Option<String> {
    let (_, sure) = margins(session)?;
    let Ok(sure) = sure else { return Some("sure: no kick".to_owned()) };
    let text = |places| match size(session, &sure, places) {
        Some(size) => format!("sure {size}"),
        None => "sure: every kick".to_owned(),
    };
    // Fewer digits are better than a number that is cut.
    (1..=PLACES).rev().map(text).find(|text| text.chars().count() < width)
}

/// The nominal margin, and the one that holds for certain or why none does.
fn margins(session: &Session) -> Option<(Margin, Result<Margin, String>)> {
    let told = session.on_show().any(|plot| session.tells_certain(plot));
    if !told || session.value(Symbol::R) == 0.0 {
        return None;
    }
    let found = session.zones().filter(|_| !session.is_stale(Topic::Zones, session.plot))?;
    Some((found.nominal, found.guaranteed.clone()))
}

/// A displacement and an impulse, in the units of the machine where there is one.
pub fn size(session: &Session, margin: &Margin, places: usize) -> Option<String> {
    let (q, v) = (margin.displacement?, margin.impulse?);
    Some(match session.units() {
        Some(units) => {
            let x = with_unit(q * units.displacement, places, "m");
            if !units.force.is_finite() {
                return Some(format!("{x} or {}", with_unit(v * units.velocity, places, "m/s")));
            }
            // The force that holds the mass there.
            let wide = session.size.width >= WIDE;
            let force = with_unit(q * units.force, places, "N");
            let force = if wide { format!(" ({force})") } else { String::new() };
            format!("{x}{force} or {}", with_unit(v * units.impulse, places, "N s"))
        }
        None => format!("q {} or v {}", significant(q, places), significant(v, places)),
    })
}
