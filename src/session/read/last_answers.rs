//! The last answer on each topic, named after its content.

use crate::accuracy::harmonic_error::HarmonicBalance;
use crate::accuracy::trade::Trade;
use crate::flow::Trajectory;
use crate::portrait::{Cycles, ReturnMap};
use crate::question::Borders;
use crate::question::speeds::Speeds;
use crate::question::zones::Zones;
use crate::scene::{Answer, Topic};
use crate::session::state::Session;

macro_rules! last_answers {
    (
        in_use { $($name:ident: $topic:ident => $found:ty,)* }
        of_any_plot { $($of_any:ident: $its_topic:ident => $of_it:ty,)* }
    ) => {
        impl Session {
            $(
                /// The last answer on this topic for the plot in use, stale or not.
                pub fn $name(&self) -> Option<&$found> {
                    let Answer::$topic(found) = self.answer(Topic::$topic, self.plot)? else {
                        return None;
                    };
                    Some(found)
                }
            )*
            $(
                /// The last answer on this topic for a plot, stale or not.
                pub fn $of_any(&self, plot: usize) -> Option<&$of_it> {
                    let Answer::$its_topic(found) = self.answer(Topic::$its_topic, plot)? else {
                        return None;
                    };
                    Some(found)
                }
            )*
        }
    };
}

last_answers! {
    in_use {
        trajectory: Trajectory => Trajectory,
        cycles: Cycles => Cycles,
        balance: Balance => HarmonicBalance,
        zones: Zones => Zones,
        trade: Trade => Trade,
    }
    of_any_plot {
        borders: Capture => Borders,
        return_map: ReturnMap => ReturnMap,
        speeds: Speeds => Speeds,
    }
}
