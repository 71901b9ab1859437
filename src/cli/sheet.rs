//! Options that say how a figure is printed, each in place of what the scene says.

use clap::Args;

use super::{Result, read};
use crate::model::{dimension_of, in_si, measured, quantity};
use crate::numerics::log10;
use crate::picture::{Scale, scales};
use crate::scene::{
    Dpi, JournalStyle, LegendPlace, PanelLetters, PaperWidth, Scene, Sheet, Span, Window,
};
use crate::session::{Framing, Session};

#[derive(Args)]
#[command(next_help_heading = "On paper")]
pub struct SheetOptions {
    /// Width of the figure, for which it is laid out: 84mm, 129mm, 174mm, 3.5in, ..
    #[arg(long)]
    width: Option<PaperWidth>,
    /// Journal that it is for
    #[arg(long, value_enum)]
    style: Option<JournalStyle>,
    /// How panels are lettered
    #[arg(long, value_enum)]
    letters: Option<PanelLetters>,
    /// Title above the figure
    #[arg(long, value_name = "TEXT")]
    title: Option<String>,
    /// Where lines are explained
    #[arg(long, value_enum)]
    legend: Option<LegendPlace>,
    /// Shades of grey, dashes and marks in place of colours
    #[arg(long)]
    grey: bool,
    /// Dots of an inch of a .png
    #[arg(long, value_name = "N")]
    dpi: Option<Dpi>,
    /// Panels to draw, in this order, such as 1,3
    #[arg(long, value_delimiter = ',', value_name = "NUMBERS")]
    panels: Vec<usize>,
    /// Part to show, of all panels or of one of those that are drawn, in the units of its axes or with a unit;
    /// repeatable
    #[arg(long, value_name = "[PANEL=]XMIN:XMAX,YMIN:YMAX")]
    window: Vec<String>,
    /// Also writes the facts for the caption, as .txt beside a picture
    #[arg(long, requires = "output")]
    caption: bool,
}

impl SheetOptions {
    /// Prints a scene as the options say, with only the plots that are drawn. Fails if there is no such plot.
    pub fn apply(&self, scene: &mut Scene) -> Result<()> {
        let Sheet { width, style, letters, title, legend, grey, dpi, panels, caption } =
            &mut scene.sheet;
        *width = self.width.or(*width);
        *style = self.style.unwrap_or(*style);
        *letters = self.letters.or(*letters);
        *title = self.title.clone().or(title.take());
        *legend = self.legend.unwrap_or(*legend);
        *grey |= self.grey;
        *dpi = self.dpi.or(*dpi);
        *caption |= self.caption;
        if !self.panels.is_empty() {
            panels.clone_from(&self.panels);
        }
        let plots = scene.sheet.plots(scene.plots.len())?;
        scene.plots = plots.into_iter().map(|plot| scene.plots[plot]).collect();
        scene.sheet.panels.clear();
        Ok(())
    }

    /// Shows the parts that are asked for.
    pub fn look(&self, session: &mut Session) -> Result<()> {
        for text in &self.window {
            let (only, sides) = match text.split_once('=') {
                Some((panel, sides)) => (Some(panel), sides),
                None => (None, &**text),
            };
            let drawn = 1..=session.plots.len();
            let only = only.map(|panel| {
                let number = panel.trim().parse().ok().filter(|number| drawn.contains(number));
                let refused =
                    || format!("there is no panel {panel:?} among {} .. {}", 1, drawn.end());
                number.ok_or_else(refused)
            });
            let only = read("--window", text, |_| only.transpose())?;
            for number in drawn.clone().filter(|number| only.is_none_or(|it| it == *number)) {
                let scales = scales(session, number - 1);
                let plot = &mut session.plots[number - 1];
                plot.window = read("--window", text, |_| window(sides, scales))?;
                plot.framing = Framing::User;
            }
        }
        Ok(())
    }
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
        Scale::Logarithmic(sign) => {
            let size = measured(text.trim().trim_start_matches(sign))?.value;
            let refused = || format!("{text:?} does not stand on a logarithmic axis");
            (size > 0.0).then(|| log10(size)).ok_or_else(refused)
        }
    }
}
