//! Questions about certainty: for all parameters within their half widths, and all bounded disturbances.

use std::sync::Arc;

use crate::model::Parameters;
use crate::question;
use crate::scene::{Layer, Request, View};
use crate::session::state::Session;

impl Session {
    /// Whether a plot states guaranteed margins: something is uncertain, or a layer asks for them.
    pub fn tells_certain(&self, plot: usize) -> bool {
        let layers = [Layer::Safe, Layer::Lost].iter().any(|it| self.layers.contains(it));
        let phase = self.plots.get(plot).is_some_and(|plot| plot.view == View::Phase);
        phase && (layers || !self.doubt.is_certain())
    }

    /// The question for the starts that are certainly safe or lost at these parameters, by the model that is
    /// drawn. `None` if something uncertain corresponds to no part of the machine.
    pub(in crate::session) fn zones_request(&self, parameters: &Parameters) -> Option<Request> {
        let running = self.running().filter(|_| self.draws_whole());
        Some(match running.zip(self.machine()) {
            Some((running, belt)) => Request::MachineZones(question::machine_zones::Inputs {
                tolerances: self.doubt.on_machine(&running, &belt).ok()?,
                belt: Arc::new(belt),
            }),
            None => Request::Zones(question::zones::Inputs {
                known: self.doubt.known(parameters),
                disturbance: self.doubt.disturbance,
            }),
        })
    }
}
