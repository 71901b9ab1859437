//! Colours of themes, in as many as a terminal has.

use std::str::FromStr;

use ratatui::style::{Color, Modifier, Style};

use crate::session::settings::Colors;

/// Steps of the grounds of maps.
pub(super) const STEPS: u8 = 16;

/// Red, green and blue.
pub(super) type Rgb = (u8, u8, u8);

/// Reads a style such as `red bold #ff7b72`: the finer colour serves where the terminal has more
/// than 16. Returns the word that it does not know.
pub(super) fn parsed(words: &str) -> Result<(Style, Option<Rgb>), &str> {
    let mut style = Style::new();
    let mut fine = None;
    for word in words.split_whitespace() {
        match word {
            "default" => {}
            "bold" => style = style.add_modifier(Modifier::BOLD),
            "dim" => style = style.add_modifier(Modifier::DIM),
            "italic" => style = style.add_modifier(Modifier::ITALIC),
            "underlined" => style = style.add_modifier(Modifier::UNDERLINED),
            "reversed" => style = style.add_modifier(Modifier::REVERSED),
            colour => match Color::from_str(colour).map_err(|_| colour)? {
                Color::Rgb(red, green, blue) => fine = Some((red, green, blue)),
                basic => style = style.fg(basic),
            },
        }
    }
    Ok((style, fine))
}

/// A style in colours of some depth.
pub(super) fn in_depth(mut style: Style, fine: Option<Rgb>, colors: Colors) -> Style {
    match (color_of(colors), fine) {
        (Some(color), Some(rgb)) => {
            // A finer colour is quiet by itself where the 16 colours need the attribute.
            style.add_modifier.remove(Modifier::DIM);
            style.fg(color(rgb))
        }
        _ if colors == Colors::Never => Style { fg: None, ..style },
        _ => style,
    }
}

/// How a colour is sent to a terminal with more than sixteen.
pub(super) fn color_of(colors: Colors) -> Option<fn(Rgb) -> Color> {
    match colors {
        Colors::Indexed => Some(|rgb| Color::Indexed(nearest(rgb))),
        Colors::True => Some(|(red, green, blue)| Color::Rgb(red, green, blue)),
        Colors::Auto | Colors::Never | Colors::Sixteen => None,
    }
}

/// A colour this many steps on the way from one to another.
pub(super) fn mixed(from: Rgb, to: Rgb, step: u8) -> Rgb {
    let last = u16::from(STEPS - 1);
    let part = |a: u8, b: u8| {
        let step = u16::from(step);
        let sum = u16::from(a) * (last - step) + u16::from(b) * step;
        u8::try_from(sum / last).unwrap_or(u8::MAX)
    };
    (part(from.0, to.0), part(from.1, to.1), part(from.2, to.2))
}

/// The nearest of xterm's 240 fixed colours: a cube of 6 levels a side and a ramp of 24 greys.
fn nearest((red, green, blue): Rgb) -> u8 {
    const LEVELS: [u8; 6] = [0, 95, 135, 175, 215, 255];
    let distance = |other: Rgb| {
        let part = |a: u8, b: u8| u32::from(a.abs_diff(b)).pow(2);
        part(red, other.0) + part(green, other.1) + part(blue, other.2)
    };
    let of_index = |index: u8| {
        if index < 216 {
            let level = |place: u8| LEVELS[usize::from(index / place % 6)];
            (level(36), level(6), level(1))
        } else {
            let grey = 8 + 10 * (index - 216);
            (grey, grey, grey)
        }
    };
    16 + (0..240).min_by_key(|index| distance(of_index(*index))).unwrap_or(0)
}

/// The hue of a colour in degrees; none of what is nearly grey.
#[cfg(test)]
pub(super) fn hue((red, green, blue): Rgb) -> Option<f64> {
    let [red, green, blue] = [red, green, blue].map(f64::from);
    let (least, most) = (red.min(green).min(blue), red.max(green).max(blue));
    let spread = most - least;
    let sextant = if most == red {
        (green - blue) / spread
    } else if most == green {
        2.0 + (blue - red) / spread
    } else {
        4.0 + (red - green) / spread
    };
    (spread > 0.15 * most).then(|| (60.0 * sextant).rem_euclid(360.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fixed_colours_are_their_own_nearest() {
        for (rgb, index) in
            [((0, 0, 0), 16), ((255, 255, 255), 231), ((95, 135, 175), 67), ((238, 238, 238), 255)]
        {
            assert_eq!(nearest(rgb), index);
        }
    }
}
