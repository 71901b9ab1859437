//! A compensated sum.

use super::Scalar;

/// A compensated sum (Neumaier's): terms below its last digit are not lost, however many there are.
#[derive(Clone, Copy, Debug, Default)]
pub struct Sum<N> {
    sum: N,
    lost: N,
}

impl<N: Scalar> Sum<N> {
    /// The sum, rounded.
    pub fn value(self) -> N {
        self.plus(N::default())
    }

    /// The sum with one more term, rounded.
    pub fn plus(self, term: N) -> N {
        self.sum + (self.lost + term)
    }

    /// `end` minus the sum.
    pub fn until(self, end: N) -> N {
        (end - self.sum) - self.lost
    }

    /// Adds a non-negative term.
    pub fn add(&mut self, term: N) {
        let sum = self.sum + term;
        let (more, less) = if self.sum >= term {
            (self.sum, term)
        } else {
            (term, self.sum)
        };
        let lost = (more - sum) + less;
        self.lost = self.lost + lost;
        self.sum = sum;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_million_small_steps_are_not_lost() {
        let mut sum = Sum::default();
        sum.add(1.0);
        for _ in 0..1_000_000 {
            sum.add(1e-17);
        }
        assert_eq!(sum.value(), 1.0 + 1e-11);
    }
}
