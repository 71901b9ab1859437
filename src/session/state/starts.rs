//! Starts of the motions that are shown beside the present one.

use crate::model::State;

/// Maximum number of motions on show, including the present one.
pub const MOST_MOTIONS: usize = 8;

const REST: State = State { q: 0.0, v: 0.0 };

/// Starts, the oldest first; at most one fewer than motions can be shown.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Starts {
    states: [State; MOST_MOTIONS - 1],
    count: usize,
}

impl Default for Starts {
    fn default() -> Self {
        Starts { states: [REST; MOST_MOTIONS - 1], count: 0 }
    }
}

impl Starts {
    /// These starts; `None` if there are too many.
    pub fn of(states: &[State]) -> Option<Self> {
        let mut starts = Starts::default();
        starts.states.get_mut(..states.len())?.copy_from_slice(states);
        Some(Starts { count: states.len(), ..starts })
    }

    /// All starts, the oldest first.
    pub fn all(&self) -> &[State] {
        &self.states[..self.count]
    }

    /// Adds a start as the newest one, or makes it the newest; returns whether the oldest was removed.
    pub fn add(&mut self, start: State) -> bool {
        let mut states: Vec<State> =
            self.all().iter().copied().filter(|known| *known != start).collect();
        states.push(start);
        let full = states.len() == MOST_MOTIONS;
        *self = Starts::of(&states[usize::from(full)..]).unwrap_or(*self);
        full
    }

    pub fn without(&self, start: State) -> Self {
        let states: Vec<State> =
            self.all().iter().copied().filter(|known| *known != start).collect();
        Starts::of(&states).unwrap_or(*self)
    }

    /// Applies `change` to every start.
    pub fn map(mut self, change: impl Fn(State) -> State) -> Self {
        self.states[..self.count].iter_mut().for_each(|state| *state = change(*state));
        self
    }
}
