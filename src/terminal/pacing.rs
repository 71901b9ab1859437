//! When the next frame may be sent: not too soon, and not before the terminal has shown the last one.
//!
//! Over a slow line, frames queue in the SSH server and in the network, where reading keys promptly does not
//! help: without a limit, the picture lags minutes behind a held-down key. So every frame ends with a request
//! for a cursor position report. The terminal answers when it has read that far, and no other frame is sent
//! until then. Changes in the meantime appear in the next frame, which shows only the newest state.
//!
//! A terminal that never answers must not become slower by this. Until the first answer arrives, frames are
//! limited by [`FRAME_TIME`] alone, and after `TRIES` unanswered requests no more are made. If a terminal has
//! answered and then falls silent (a dropped line), the next frame waits, but only for [`Pacing::PATIENCE`], or
//! four times the longest wait so far if that is longer.

use std::collections::VecDeque;
use std::time::{Duration, Instant};

/// Minimum time between two frames: about 60 a second.
pub const FRAME_TIME: Duration = Duration::from_millis(16);

/// Unanswered requests after which a terminal counts as silent.
const TRIES: u32 = 16;

/// How long the program waits for a pending answer before it leaves the terminal; longer if answers were slow
/// so far.
const LAST_WAIT: Duration = Duration::from_millis(300);

/// The state of the line between program and terminal. Time is an argument; no clock is read here.
#[derive(Clone, Debug, Default)]
pub struct Pacing {
    /// When the last frame was sent.
    last: Option<Instant>,
    /// Times of the requests that are not answered yet, the oldest first.
    owed: VecDeque<Instant>,
    /// Whether the next frame waits for these answers.
    waits: bool,
    /// Longest time until an answer; `None` before the first one.
    slowest: Option<Duration>,
    /// Requests since the last answer.
    unanswered: u32,
}

impl Pacing {
    /// Shortest limit on the wait for a terminal that is known to answer.
    pub const PATIENCE: Duration = Duration::from_secs(1);

    /// Whether the next frame should ask for an answer.
    pub fn asks(&self) -> bool {
        self.unanswered < TRIES
    }

    /// Earliest time for the next frame; an answer from the terminal can make it earlier.
    pub fn next(&self, now: Instant) -> Instant {
        let spaced = self.last.map_or(now, |last| last + FRAME_TIME);
        let patience = self.patience().filter(|_| self.waits);
        patience.map_or(spaced, |until| spaced.max(until))
    }

    /// When the answers count as lost; `None` if none is owed, or none has ever come.
    fn patience(&self) -> Option<Instant> {
        Some(*self.owed.back()? + Self::PATIENCE.max(4 * self.slowest?))
    }

    /// A frame was sent, with or without a request.
    pub fn sent(&mut self, now: Instant, asked: bool) {
        self.last = Some(now);
        self.waits = true;
        if !asked || self.patience().is_some_and(|until| until <= now) {
            self.owed.clear();
        }
        if asked {
            self.owed.push_back(now);
            self.unanswered += 1;
        }
    }

    /// A request was sent to a terminal that was just taken. The next frame does not wait for the answer, nor for
    /// earlier ones, which may have gone elsewhere.
    pub fn asked(&mut self, now: Instant) {
        self.owed = VecDeque::from([now]);
        self.waits = false;
        self.unanswered += 1;
    }

    /// The terminal answered: `false` if nothing had been asked.
    ///
    /// In that case, the apparent answer is a key: xterm sends `ESC[1;5R` for Ctrl-F3.
    pub fn answered(&mut self, now: Instant) -> bool {
        let Some(since) = self.owed.pop_front() else { return false };
        self.slowest = self.slowest.max(Some(now.saturating_duration_since(since)));
        self.unanswered = 0;
        true
    }

    /// Until when to wait for an answer before leaving the terminal, so that the answer does not turn up as
    /// garbage on the shell's command line; `None` if no answer is due.
    pub fn last_wait(&self) -> Option<Instant> {
        let slowest = self.slowest.or(self.asks().then_some(Duration::ZERO))?;
        Some(*self.owed.back()? + LAST_WAIT.max(2 * slowest))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const MILLISECOND: Duration = Duration::from_millis(1);

    #[test]
    fn the_first_frame_goes_at_once_and_the_second_a_frame_time_later() {
        let now = Instant::now();
        let mut pacing = Pacing::default();
        assert_eq!(pacing.next(now), now);
        pacing.sent(now, false);
        assert_eq!(pacing.next(now + MILLISECOND), now + FRAME_TIME);
    }

    #[test]
    fn a_terminal_that_answers_gets_one_frame_at_a_time() {
        let start = Instant::now();
        let mut pacing = Pacing::default();
        pacing.asked(start);
        assert!(pacing.answered(start + 200 * MILLISECOND));
        let sent = start + 300 * MILLISECOND;
        pacing.sent(sent, pacing.asks());
        assert_eq!(pacing.next(sent), sent + Pacing::PATIENCE);
        assert!(pacing.answered(sent + 700 * MILLISECOND));
        assert_eq!(pacing.next(sent + 700 * MILLISECOND), sent + FRAME_TIME);
        let again = sent + 700 * MILLISECOND;
        pacing.sent(again, pacing.asks());
        assert_eq!(pacing.next(again), again + 4 * 700 * MILLISECOND);
    }

    #[test]
    fn the_next_frame_waits_for_the_answers_to_all_frames() {
        let mut now = Instant::now();
        let mut pacing = Pacing::default();
        // Nobody knows yet whether the terminal answers.
        for _ in 0..3 {
            now = pacing.next(now);
            pacing.sent(now, true);
        }
        for frame in 1..=3 {
            assert!(pacing.answered(now + frame * MILLISECOND));
            let free = pacing.next(now) == now + FRAME_TIME;
            assert_eq!(free, frame == 3);
        }
    }

    #[test]
    fn a_lost_answer_delays_one_frame() {
        let mut now = Instant::now();
        let mut pacing = Pacing::default();
        pacing.asked(now);
        assert!(pacing.answered(now));
        pacing.sent(now, true);
        for delayed in [true, false, false] {
            let next = pacing.next(now);
            assert_eq!(next > now + FRAME_TIME, delayed);
            pacing.sent(next, true);
            now = next;
            assert!(pacing.answered(now));
        }
    }

    #[test]
    fn a_silent_terminal_is_as_fast_as_any_and_soon_left_alone() {
        let mut now = Instant::now();
        let mut pacing = Pacing::default();
        let mut requests = 0;
        for _ in 0..100 {
            now = pacing.next(now);
            requests += u32::from(pacing.asks());
            pacing.sent(now, pacing.asks());
            assert_eq!(pacing.next(now), now + FRAME_TIME);
        }
        assert_eq!(requests, TRIES);
        assert_eq!(pacing.last_wait(), None);
    }

    #[test]
    fn a_terminal_that_falls_silent_is_given_up_after_a_while() {
        let mut now = Instant::now();
        let mut pacing = Pacing::default();
        pacing.asked(now);
        assert!(pacing.answered(now + MILLISECOND));
        for _ in 0..TRIES {
            now = pacing.next(now + MILLISECOND);
            pacing.sent(now, pacing.asks());
        }
        assert!(!pacing.asks());
        pacing.sent(now, pacing.asks());
        assert_eq!(pacing.next(now), now + FRAME_TIME);
    }

    #[test]
    fn an_answer_without_a_request_does_not_count() {
        assert!(!Pacing::default().answered(Instant::now()));
    }

    #[test]
    fn leaving_waits_only_for_an_answer_that_is_due() {
        let now = Instant::now();
        let mut pacing = Pacing::default();
        assert_eq!(pacing.last_wait(), None);
        pacing.asked(now);
        assert_eq!(pacing.last_wait(), Some(now + LAST_WAIT));
        pacing.answered(now + 400 * MILLISECOND);
        assert_eq!(pacing.last_wait(), None);
        pacing.sent(now, true);
        assert_eq!(pacing.last_wait(), Some(now + 800 * MILLISECOND));
    }
}
