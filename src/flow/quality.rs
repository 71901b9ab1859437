//! The dial: one number sets the accuracy of a method, and four values of it have names.
//!
//! Which number it is depends on the method: the error of a step, its length, or the velocity over which
//! friction is smoothed. [`Problem::setting`] returns it for any method.

use super::Problem;

/// A named setting of the dial.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quality {
    /// Its name.
    pub name: &'static str,
    /// Its purpose, in a few words.
    pub meaning: &'static str,
    /// Relative error of a step.
    pub tolerance: f64,
    /// Length of a fixed step.
    pub step: f64,
    /// Velocity over which friction is smoothed.
    pub epsilon: f64,
}

/// A setting, by its name, its purpose, and its tolerance, step and epsilon.
const fn quality(name: &'static str, meaning: &'static str, numbers: [f64; 3]) -> Quality {
    let [tolerance, step, epsilon] = numbers;
    Quality { name, meaning, tolerance, step, epsilon }
}

/// The named settings, from coarse to fine.
pub const QUALITIES: [Quality; 4] = [
    quality("draft", "as good as a screen shows, at once", [1e-4, 0.1, 1e-2]),
    quality(
        "normal",
        "ten digits, at a few percent of the cost of drawing them",
        [1e-10, 0.01, 1e-3],
    ),
    quality("fine", "thirteen digits", [1e-13, 1e-3, 1e-4]),
    quality("reference", "all that doubles hold", [1e-15, 1e-4, 1e-5]),
];

/// The coarsest setting, computed first where the desired quality takes long.
pub const DRAFT: Quality = QUALITIES[0];

impl Problem {
    /// The number that sets the accuracy of the method. For the closed form it is the tolerance, which has no effect.
    #[must_use]
    pub fn setting(&self) -> f64 {
        self.get(self.method.dial())
    }

    /// The same motion by the same method, with another value of [`Problem::setting`].
    pub fn with_setting(mut self, number: f64) -> Self {
        self.set(self.method.dial(), number);
        self
    }

    /// The same motion at a named setting, for any method.
    pub fn at(self, quality: &Quality) -> Self {
        let Quality { tolerance, step, epsilon, .. } = *quality;
        Problem { tolerance, step, epsilon, ..self }
    }

    /// The current named setting, if the dial is at one.
    #[must_use]
    pub fn quality(&self) -> Option<&'static Quality> {
        QUALITIES.iter().find(|quality| self.at(quality).setting() == self.setting())
    }

    /// The next named setting on the finer or the coarser side; `None` beyond the last.
    #[must_use]
    pub fn next_quality(&self, finer: bool) -> Option<&'static Quality> {
        let (at, here) = (|quality: &&Quality| self.at(quality).setting(), self.setting());
        if finer {
            QUALITIES.iter().find(|quality| at(quality) < here)
        } else {
            QUALITIES.iter().rev().find(|quality| at(quality) > here)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::Method;
    use super::*;
    use crate::model::Knob;

    #[test]
    fn the_stops_go_from_coarse_to_fine_within_every_range() {
        for dial in [Knob::Tolerance, Knob::Step, Knob::Epsilon] {
            let numbers = QUALITIES.map(|quality| Problem::default().at(&quality).get(dial));
            assert!(numbers.windows(2).all(|pair| pair[0] > pair[1]), "{numbers:?}");
            assert!(numbers.iter().all(|number| dial.check(*number).is_ok()), "{numbers:?}");
        }
        assert_eq!(Problem::default().quality().map(|quality| quality.name), Some("normal"));
    }

    #[test]
    fn each_method_has_its_number_and_the_stops_set_them_all() {
        for (method, name) in
            [(Method::Auto, "tolerance"), (Method::Rk4, "step"), (Method::Smoothed, "epsilon")]
        {
            let problem = Problem { method, ..Problem::default() };
            assert_eq!(method.dial().spec().name, name);
            assert_eq!(problem.with_setting(0.003).setting(), 0.003);
            let fine = problem.at(problem.next_quality(true).unwrap());
            assert_eq!(fine.quality().unwrap().name, "fine");
            let other = Problem { method: Method::SignRk4, ..fine };
            assert_eq!(other.quality().unwrap().name, "fine", "another method, the same quality");
        }
    }

    #[test]
    fn between_stops_the_next_one_is_near() {
        let typed = Problem { tolerance: 3e-7, ..Problem::default() };
        assert_eq!(typed.quality(), None);
        let name = |finer| typed.next_quality(finer).map(|quality| quality.name);
        assert_eq!((name(true), name(false)), (Some("normal"), Some("draft")));
        assert_eq!(typed.at(&QUALITIES[3]).next_quality(true), None);
        assert_eq!(typed.at(&DRAFT).next_quality(false), None);
    }
}
