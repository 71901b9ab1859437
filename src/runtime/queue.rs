//! The work of a worker, and its order.
//!
//! The most urgent request comes first. It must not hold up the others if it takes long, though, and how long
//! it takes is not known beforehand. So each request has turns: when its turn is over and others wait that have
//! had no more turns, it is put aside, and starts over when they have had theirs. Each turn is four times as
//! long as the last one, so that at most a third of the work is wasted. A request that merely refines a draft
//! begins with a later turn, because there is a picture already.

use std::time::Duration;

use crate::scene::Request;

/// The first turn: half a frame.
pub const TURN: Duration = Duration::from_millis(8);

/// Ratio of the lengths of successive turns.
const LONGER: u32 = 4;

/// The turn with which a request begins if its draft is wanted too.
const REFINEMENT: u32 = 2;

#[derive(Debug, Default)]
pub struct Queue {
    /// The wanted requests, the most urgent first, including the one in progress.
    wanted: Vec<QueuedRequest>,
    /// The request in progress, unless it is no longer wanted.
    running: Option<Request>,
    /// Requests whose answers were reported but have not arrived at the session yet.
    reported: Vec<Request>,
    /// Whether the thread is computing an answer, wanted or not.
    busy: bool,
    closed: bool,
}

/// A request that waits or is in progress.
#[derive(Debug)]
struct QueuedRequest {
    request: Request,
    turns: u32,
}

impl Queue {
    /// Replaces the wanted requests; `true` if the request in progress is no longer among them.
    pub fn want(&mut self, wanted: Vec<Request>) -> bool {
        let before = std::mem::take(&mut self.wanted);
        let turns = |request: &Request| {
            let known = before.iter().find(|known| known.request == *request);
            let refines = || request.draft().is_some_and(|draft| wanted.contains(&draft));
            known.map_or_else(|| if refines() { REFINEMENT } else { 0 }, |known| known.turns)
        };
        let turns: Vec<u32> = wanted.iter().map(turns).collect();
        let all = wanted.into_iter().zip(turns);
        self.wanted = all
            .filter(|(request, _)| !self.reported.contains(request))
            .map(|(request, turns)| QueuedRequest { request, turns })
            .collect();
        let wanted = &self.wanted;
        let is_wanted = |running: &Request| wanted.iter().any(|it| it.request == *running);
        self.running.take_if(|running| !is_wanted(running)).is_some()
    }

    fn waiting(&self) -> impl Iterator<Item = &QueuedRequest> {
        self.wanted.iter().filter(|wanted| self.running.as_ref() != Some(&wanted.request))
    }

    /// Starts the next request: the most urgent of those with the fewest turns. Also returns the length of its
    /// turn, in units of the first one.
    pub fn begin(&mut self) -> Option<(Request, u32)> {
        let next = self.waiting().min_by_key(|wanted| wanted.turns)?;
        let (request, turns) = (next.request.clone(), next.turns);
        self.running = Some(request.clone());
        self.busy = true;
        Some((request, LONGER.saturating_pow(turns)))
    }

    /// Whether another request waits that has had no more turns than the one in progress.
    pub fn is_contested(&self) -> bool {
        let running = self.wanted.iter().find(|it| self.running.as_ref() == Some(&it.request));
        running.is_some_and(|running| self.waiting().any(|other| other.turns <= running.turns))
    }

    /// Ends the turn of the request in progress, which remains unanswered.
    pub fn put_aside(&mut self) {
        self.busy = false;
        let running = self.running.take();
        let running = self.wanted.iter_mut().find(|it| running.as_ref() == Some(&it.request));
        if let Some(running) = running {
            running.turns += 1;
        }
    }

    /// Ends the request in progress; returns it if its answer is still wanted and must be reported.
    pub fn finish(&mut self) -> Option<Request> {
        self.busy = false;
        let request = self.running.take()?;
        self.wanted.retain(|wanted| wanted.request != request);
        self.reported.push(request.clone());
        Some(request)
    }

    /// Whether the answer of the request in progress is still wanted.
    pub fn is_wanted(&self) -> bool {
        self.running.is_some()
    }

    /// Notes that the reported answer to a request has arrived.
    pub fn taken(&mut self, request: &Request) {
        if let Some(index) = self.reported.iter().position(|reported| reported == request) {
            self.reported.remove(index);
        }
    }

    /// Drops all work and accepts no more.
    pub fn close(&mut self) {
        self.closed = true;
        self.running = None;
        self.wanted.clear();
    }

    /// Whether the queue was closed.
    pub fn is_closed(&self) -> bool {
        self.closed
    }

    /// Whether nothing is in progress and nothing waits.
    pub fn is_idle(&self) -> bool {
        !self.busy && self.waiting().next().is_none()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::flow::Problem;
    use crate::model::Parameters;

    fn cycles(d: f64) -> Request {
        let parameters = Parameters { d, d2: 0.0, d3: 0.0, r: 0.1 };
        Request::Cycles { parameters, machine: None, whole: false }
    }

    #[test]
    fn what_is_put_aside_comes_after_all_others_and_then_has_a_longer_turn() {
        let mut queue = Queue::default();
        let [slow, quick, last] = [1.0, 2.0, 3.0].map(cycles);
        assert!(!queue.want(vec![slow.clone(), quick.clone(), last.clone()]));
        assert_eq!(queue.begin(), Some((slow.clone(), 1)));
        assert!(queue.is_contested());
        queue.put_aside();
        for other in [&quick, &last] {
            assert_eq!(queue.begin(), Some((other.clone(), 1)));
            assert_eq!(queue.finish().as_ref(), Some(other));
            queue.taken(other);
            // A request that is still wanted keeps its count of turns.
            assert!(!queue.want(vec![slow.clone(), last.clone()]));
            if other == &last {
                queue.want(vec![slow.clone()]);
            }
        }
        assert_eq!(queue.begin(), Some((slow.clone(), 4)));
        assert!(!queue.is_contested(), "alone it may take as long as it likes");
        // A new key asks a new question, which has had no turn yet.
        queue.want(vec![slow, cycles(4.0)]);
        assert!(queue.is_contested());
    }

    #[test]
    fn a_refinement_waits_for_whatever_has_no_picture_yet() {
        let mut queue = Queue::default();
        let parameters = Parameters { d: -0.1, d2: 0.0, d3: 0.5, r: 0.1 };
        let problem = Problem { parameters, ..Problem::default() };
        let full = Request::Trajectory { problem, machine: None };
        let draft = full.draft().unwrap();
        queue.want(vec![draft.clone(), full.clone(), cycles(1.0)]);
        assert_eq!(queue.begin(), Some((draft.clone(), 1)));
        assert!(queue.is_contested());
        queue.finish();
        queue.taken(&draft);
        queue.want(vec![full.clone(), cycles(1.0)]);
        for length in [1, 4] {
            assert_eq!(queue.begin(), Some((cycles(1.0), length)));
            assert!(!queue.is_contested(), "a refinement has its turn later");
            queue.put_aside();
        }
        assert_eq!(queue.begin(), Some((full.clone(), 16)), "the more urgent of the two");
        assert!(queue.is_contested());
    }

    #[test]
    fn what_nobody_wants_any_more_is_superseded_and_forgotten() {
        let mut queue = Queue::default();
        queue.want(vec![cycles(1.0)]);
        queue.begin();
        assert!(queue.want(vec![cycles(2.0)]));
        assert!(!queue.is_contested() && !queue.is_idle());
        assert_eq!(queue.finish(), None, "that answer is no longer wanted");
        assert_eq!(queue.begin(), Some((cycles(2.0), 1)));
        assert_eq!(queue.finish(), Some(cycles(2.0)));
        assert!(queue.is_idle());
    }
}
