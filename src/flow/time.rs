//! Time that adds up right over a million swings, and over steps shorter than its last digit.

/// A sum that remembers what rounding took: a million swings later the time is still right.
#[derive(Clone, Copy, Default)]
pub struct Time {
    sum: f64,
    lost: f64,
}

impl Time {
    /// The time and a little more.
    #[must_use]
    pub fn plus(self, duration: f64) -> f64 {
        self.sum + (self.lost + duration)
    }

    /// How long it is until `end`.
    #[must_use]
    pub fn until(self, end: f64) -> f64 {
        (end - self.sum) - self.lost
    }

    /// Lets time pass.
    pub fn advance(&mut self, duration: f64) {
        // Neumaier's compensated summation.
        let sum = self.sum + duration;
        self.lost += if self.sum >= duration {
            (self.sum - sum) + duration
        } else {
            (duration - sum) + self.sum
        };
        self.sum = sum;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_million_small_steps_are_not_lost() {
        let mut time = Time::default();
        time.advance(1.0);
        for _ in 0..1_000_000 {
            time.advance(1e-17);
        }
        assert_eq!(time.plus(0.0), 1.0 + 1e-11);
    }
}
