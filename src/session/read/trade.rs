//! The view of accuracy against cost: the row nearest to the cursor.

use crate::accuracy::trade::TradePoint;
use crate::numerics::elementary::hypot;
use crate::scene::{Point, View, Window};
use crate::session::state::Session;

impl Session {
    /// The row that is nearest to the cursor of a plot on the screen.
    pub fn row_under_cursor(&self, plot: usize) -> Option<&TradePoint> {
        let plot = self.plots.get(plot).filter(|plot| plot.view == View::Trade)?;
        let Point { x, y } = plot.cursor?;
        let Window { x: across, y: up } = plot.window;
        let distance = |row: &&TradePoint| {
            row.place().map_or(f64::INFINITY, |(right, high)| {
                hypot((right - x) / across.width(), (high - y) / up.width())
            })
        };
        let rows = self.trade()?.rows.iter().filter(|row| row.place().is_some());
        rows.min_by(|one, other| distance(one).total_cmp(&distance(other)))
    }
}
