//! The parts of the world that a figure shows, as an option.

use super::{Result, read};
use crate::model::{dimension_of, in_si, quantity};
use crate::numerics::log10;
use crate::picture::{Scale, scales};
use crate::scene::{Span, Window};
use crate::session::{Framing, Session};

/// Shows these parts: one for all plots, or one for each.
pub fn show_windows(session: &mut Session, windows: &[String]) -> Result<()> {
    let plots = session.plots.len();
    if windows.len() > 1 && windows.len() != plots {
        let given = windows.len();
        return Err(
            format!("--window: {given} for {plots} panels; give one, or one for each").into()
        );
    }
    for (index, text) in (0..plots).zip(windows.iter().cycle()) {
        let scales = scales(session, index);
        session.plots[index].window = read("--window", text, |text| window(text, scales))?;
        session.plots[index].framing = Framing::User;
    }
    Ok(())
}

/// The part of the world between these values of its axes.
fn window(text: &str, scales: [Scale; 2]) -> Result<Window, String> {
    const FORM: &str = "expected XMIN:XMAX,YMIN:YMAX, such as -3:3,-2:2";
    let (x, y) = text.split_once(',').ok_or(FORM)?;
    let span = |text: &str, scale| {
        let (from, to) = text.split_once(':').ok_or(FORM)?;
        Span::new(value(from, scale)?, value(to, scale)?)
    };
    Ok(Window { x: span(x, scales[0])?, y: span(y, scales[1])? })
}

/// Where a value stands along an axis.
fn value(text: &str, scale: Scale) -> Result<f64, String> {
    match scale {
        Scale::Even => quantity(text, ""),
        Scale::Times { factor, name } => {
            let unit = name.split_once(" [").map_or("", |(_, unit)| unit.trim_end_matches(']'));
            Ok(quantity(text, unit)? / in_si(unit, dimension_of(unit)).unwrap_or(1.0) / factor)
        }
        // What does not stand there is no end of an interval.
        Scale::Logarithmic(sign) => Ok(log10(quantity(text.trim().trim_start_matches(sign), "")?)),
    }
}
