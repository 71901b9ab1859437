//! What is asked and known about certainty: whatever the parameters are within their half widths, and whatever
//! a bounded disturbance does.

use std::sync::Arc;

use crate::oscillator::Parameters;
use crate::question;
use crate::scene::{Layer, Request, View};
use crate::session::state::session::Session;

impl Session {
    /// Whether margins that hold for certain are told in a plot: something is in doubt, or a layer asks.
    pub fn tells_certain(&self, plot: usize) -> bool {
        let layers = [Layer::Safe, Layer::Lost].iter().any(|it| self.layers.contains(it));
        let phase = self.plots.get(plot).is_some_and(|plot| plot.view == View::Phase);
        phase && (layers || !self.doubt.is_certain())
    }

    /// What is safe for certain at these parameters; of a machine by the model that is drawn. `None` where no
    /// part of the machine has what is in doubt.
    pub(in crate::session) fn zones_request(&self, parameters: &Parameters) -> Option<Request> {
        let running = self.running().filter(|_| self.draws_whole());
        Some(match running.zip(self.machine()) {
            Some((running, belt)) => Request::MachineZones(question::machine_zones::Asked {
                tolerances: self.doubt.on_machine(&running, &belt).ok()?,
                belt: Arc::new(belt),
            }),
            None => Request::Zones(question::zones::Asked {
                known: self.doubt.known(parameters),
                disturbance: self.doubt.disturbance,
            }),
        })
    }
}
