//! Dates and times of day as instruments write them.

/// Dates count modulo this many days, so that seconds stay small enough for a resolution of about 15 ns.
const REPEAT: i64 = 1000;

/// Seconds of `12:34:56.789`, `34:56,789` or `2026-03-02T12:34:56.789Z`; `None` for anything else.
pub fn seconds(cell: &str) -> Option<f64> {
    let (days, clock) = match cell.split_once(['T', ' ']) {
        Some((date, clock)) => (days(date)?, clock.trim()),
        None => (0, cell),
    };
    let clock = clock.strip_suffix('Z').unwrap_or(clock).replace(',', ".");
    let parts: Vec<f64> = clock.split(':').map(plain).collect::<Option<_>>()?;
    // A leap second is the 61st of its minute.
    let within = match parts[..] {
        [hours, minutes, seconds] if minutes < 60.0 && seconds < 61.0 => {
            (hours * 60.0 + minutes) * 60.0 + seconds
        }
        [minutes, seconds] if seconds < 61.0 => minutes * 60.0 + seconds,
        _ => return None,
    };
    #[expect(clippy::cast_precision_loss, reason = "less than a thousand")]
    let before = days.rem_euclid(REPEAT) as f64;
    Some(before * 86400.0 + within)
}

/// A number written with digits and at most one point.
fn plain(text: &str) -> Option<f64> {
    let digits = text.chars().all(|char| char.is_ascii_digit() || char == '.');
    text.parse().ok().filter(|_| digits)
}

/// Number of the day `2026-03-02`, `2.3.2026` or `3/2/2026` in the calendar; in the last form the month comes first
/// unless it cannot be a month.
fn days(date: &str) -> Option<i64> {
    let part = |text: &str| text.parse::<i64>().ok();
    let three = |sign: char| {
        let parts: Vec<i64> = date.split(sign).map(part).collect::<Option<_>>()?;
        <[i64; 3]>::try_from(parts).ok()
    };
    let [year, month, day] = three('-')
        .or_else(|| three('.').map(|[day, month, year]| [year, month, day]))
        .or_else(|| {
            three('/').map(|[one, two, three]| match one {
                32.. => [one, two, three],
                // No month: the day comes first.
                13.. => [three, two, one],
                _ => [three, one, two],
            })
        })?;
    if !(1..=12).contains(&month) || !(1..=31).contains(&day) {
        return None;
    }
    // If years begin in March, the leap day is their last day.
    let (year, month) = if month > 2 { (year, month - 3) } else { (year - 1, month + 9) };
    let leap = year.div_euclid(4) - year.div_euclid(100) + year.div_euclid(400);
    Some(365 * year + leap + (153 * month + 2) / 5 + day)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn clocks_go_on_over_midnight_and_the_ends_of_months() {
        let step = |one: &str, other: &str| seconds(other).unwrap() - seconds(one).unwrap();
        assert_eq!(step("2026-02-28 23:59:59.5", "2026-03-01T00:00:00.5Z"), 1.0);
        assert_eq!(step("28.2.2024 23:59:59,5", "29.02.2024 00:00:00"), 0.5);
        assert_eq!(step("12/31/2025 23:59:59", "1/1/2026 00:00:01"), 2.0);
        assert_eq!(seconds("01:02:03.25"), Some(3723.25));
        assert_eq!(seconds("02:03"), Some(123.0));
        assert_eq!(step("31/12/2025 23:59:59", "31/12/2025 23:59:60"), 1.0);
        for text in [
            "12",
            "a:b",
            "12:",
            "rig 4: 3",
            "1:2:3:4",
            "-1:00",
            "12:61",
            "1:60:00",
            "2026-13-01 1:00",
        ] {
            assert_eq!(seconds(text), None, "{text}");
        }
    }
}
