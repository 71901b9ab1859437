//! Files played without a terminal.
//!
//! Nothing here waits for time to pass. While something is wanted, the next step waits for the workers' next
//! message; otherwise the next step of the file is taken.

use std::io::{self, Write};

use ratatui::layout::Size;

use super::{Application, EffectOutcome, Host, Pump};
use crate::runtime::application::ReplayResult;
use crate::session::replay::Action;
use crate::session::{Effect, Msg, Notice};
use crate::view;

impl<M: Application, W: Write> Pump<M, W> {
    /// Plays a file until it ends, an expectation is not met, or the session quits; keys count at once.
    pub fn unattended(mut self) -> io::Result<ReplayResult<M>> {
        self.unattended = true;
        let mut kept = Vec::new();
        let Size { width, height } = self.screen.size();
        let mut stop = self.give(Msg::Resize { width, height })?;
        while stop.is_none() {
            // Answers are taken first, as in the explorer; otherwise those of asynchronous keys would pile up.
            if let Ok(event) = self.events.try_recv() {
                stop = self.handle(event)?;
                continue;
            }
            self.workers.ask(&self.application.wants());
            let (application, size) = (&self.application, self.screen.size());
            let idle = self.workers.asked().next().is_none() && !self.writing;
            let screen = || view::screen::text(&application.picture(size));
            let Some(playing) = &mut self.playing else { break };
            let next = if application.is_waiting() {
                Ok(Action::Wait)
            } else {
                playing.player.next(idle, screen)
            };
            match next {
                Ok(Action::Give(msg)) => {
                    if let Msg::Resize { width, height } = msg {
                        self.screen.repaint(Size { width, height })?;
                    }
                    stop = self.give(msg)?;
                }
                Ok(Action::Keep(name)) => kept.push((name, application.picture(size))),
                Ok(Action::Wait) => match self.events.recv() {
                    Ok(event) => stop = self.handle(event)?,
                    Err(_) => break,
                },
                Ok(Action::Done) => break,
                Err(unmet) => {
                    self.unmet = Some(unmet);
                    break;
                }
            }
        }
        // A figure that has been begun is written.
        while self.writing {
            let Ok(event) = self.events.recv() else { break };
            self.handle(event)?;
        }
        let screen = self.application.picture(self.screen.size());
        let unwritten = self.playing.and_then(|playing| playing.unwritten);
        let (application, unmet) = (self.application, self.unmet);
        Ok(ReplayResult { application, screen, kept, unmet, unwritten })
    }

    /// The outcome of an effect that is not carried out without a terminal; `None` for one that is.
    pub(super) fn omission(&mut self, effect: &Effect) -> Option<EffectOutcome> {
        match effect {
            _ if !self.unattended => None,
            Effect::Suspend
            | Effect::Repaint
            | Effect::Copy(_)
            | Effect::CopyScreen
            | Effect::Mouse(_)
            | Effect::PutAside(_) => Some(EffectOutcome::Done),
            Effect::Record { .. } => {
                let text = "a replay records nothing".to_owned();
                let notice = Notice { error: true, text };
                self.note_unwritten(&notice);
                Some(EffectOutcome::Told(Msg::Told(notice)))
            }
            _ => None,
        }
    }
}
